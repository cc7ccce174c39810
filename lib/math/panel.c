/* Blocked L D L^T of a tall dense panel, by columns and left-looking. Source: G. Golub, C. Van
 * Loan, Matrix Computations, section 4.2.
 *
 * Blocks of ICCP_BLOCK columns receive the product of all earlier columns at once. Within a block
 * the same happens for ICCP_SQUARE columns at a time. The rows of the block itself come first, then
 * the other rows, a few strips at a time so that they stay in the cache. */
#include "math/panel.h"

#include "base/minmax.h"

#include <math.h>

#define STRIP ((size_t)ICCP_STRIP)

/* Multiplications between two calls of the progress callback: 20 ms at 1.5e9 a second. */
static const double PER_REPORT = 3e7;

/* Smaller products are finished before threads start. */
static const double PER_THREADS = 1e7;

/* Strips that a thread takes at once. */
enum { GRAIN = 16 };

icc_status iccp_labour_add(iccp_labour *labour, double multiplications)
{
    labour->done += multiplications;
    if (labour->done - labour->reported < PER_REPORT)
        return ICC_OK;
    labour->reported = labour->done;
    return iccp_progress(labour->env, "solve", iccp_min(1, labour->done / labour->all));
}

typedef struct shifted {
    iccp_chunk chunk;
    void *argument;
    size_t begin;
} shifted;

static icc_status run_shifted(void *argument, size_t begin, size_t end)
{
    const shifted *s = argument;
    return s->chunk(s->argument, s->begin + begin, s->begin + end);
}

icc_status iccp_labour_strips(iccp_labour *labour, size_t begin, size_t end, double cost,
                              iccp_chunk chunk, void *argument)
{
    const iccp_env *quiet = &labour->quiet;
    const bool has_threads = quiet->threads > 1 || quiet->parallel_for != NULL;
    const size_t most = (size_t)iccp_max(2, PER_REPORT / cost);
    icc_status status = ICC_OK;
    for (size_t n; status == ICC_OK && begin < end; begin += n) {
        n = end - begin < most ? end - begin : most;
        if (has_threads && n > GRAIN && cost * (double)n > PER_THREADS)
            status = iccp_for_chunks(quiet, "solve", n, GRAIN, run_shifted,
                                     &(shifted){chunk, argument, begin});
        else
            status = chunk(argument, begin, begin + n);
        if (status == ICC_OK)
            status = iccp_labour_add(labour, cost * (double)n);
    }
    return status;
}

/* With a constant width the compiler unrolls the loop over rows. */
static ICCP_INLINE void pack_group(double *packed, const iccp_panel *panel, size_t i, size_t left,
                                   size_t width, size_t first, size_t last)
{
    const double *row[ICCP_TILE];
    for (size_t c = 0; c < width; ++c)
        row[c] = panel->value + iccp_panel_row(panel, c < left ? i + c : i);
    for (size_t k = first; k < last; ++k, packed += width)
        for (size_t c = 0; c < width; ++c)
            packed[c] = row[c][STRIP * k] * panel->pivot[k];
}

void iccp_panel_pack(double *packed, const iccp_panel *panel, size_t begin, size_t end,
                     size_t first, size_t last)
{
    for (size_t i = begin, width; i < end; i += width, packed += width * (last - first)) {
        const size_t left = end - i;
        width = iccp_panel_width(left);
        if (width == ICCP_TILE)
            pack_group(packed, panel, i, left, ICCP_TILE, first, last);
        else
            pack_group(packed, panel, i, left, width, first, last);
    }
}

/* Subtracts the product of columns [first, begin) from columns [begin, end), from row `begin`
 * on. */
typedef struct product {
    const iccp_panel *panel;
    size_t first, begin, end;
    const double *packed;
    const iccp_dense *dense;
} product;

/* Subtracts the product of columns [first, last) from columns [j, j + width) of n strips, from
 * `row` on. Returns the end of the used part of `packed`. */
static const double *subtract(const iccp_panel *p, const iccp_dense *dense, double *row, size_t n,
                              size_t j, size_t left, size_t first, size_t last,
                              const double *packed)
{
    const size_t width = iccp_panel_width(left), here = left < width ? left : width;
    const size_t stride = STRIP * p->columns, depth = last - first;
    double tile[ICCP_STRIPS * ICCP_TILE * ICCP_STRIP];
    dense->multiply(tile, n, width, row + STRIP * first, stride, packed, depth);
    for (size_t t = 0; t < n; ++t)
        for (size_t k = 0; k < STRIP * here; ++k)
            row[t * stride + STRIP * j + k] -= tile[t * ICCP_TILE * STRIP + k];
    return packed + width * depth;
}

/* Like update_strips() in ldlt_factorise.c, but the panel updates itself. Rows and columns of the
 * tile are those of the panel, so nothing is scattered. */
static icc_status update_strips(void *argument, size_t strip, size_t strips)
{
    const product *u = argument;
    const iccp_panel *p = u->panel;
    for (size_t n; strip < strips; strip += n) {
        double *row = p->value + strip * STRIP * p->columns;
        const double *b = u->packed;
        n = iccp_strips_at_once(strips - strip);
        for (size_t j = u->begin; j < u->end && j < STRIP * (strip + n); j += ICCP_TILE)
            b = subtract(p, u->dense, row, n, j, u->end - j, u->first, u->begin, b);
    }
    return ICC_OK;
}

static size_t n_strips_of(const iccp_panel *p)
{
    return (p->rows + STRIP - 1) / STRIP;
}

static icc_status update(const iccp_panel *p, size_t begin, size_t end, const iccp_dense *dense,
                         double *packed, iccp_labour *labour)
{
    product u = {p, 0, begin, end, packed, dense};
    if (begin == 0)
        return ICC_OK;
    iccp_panel_pack(packed, p, begin, end, 0, begin);
    return iccp_labour_strips(labour, begin / STRIP, n_strips_of(p),
                              (double)(STRIP * (end - begin)) * (double)begin, update_strips, &u);
}

static bool is_pivot(double pivot, int sign)
{
    return isfinite(pivot) && (sign > 0 ? pivot > 0 : pivot < 0);
}

/* Factorises the square on the diagonal and the rows in its strip. `scaled` is as in
 * iccp_divide. */
static bool eliminate_square(double *strip, size_t width, double *pivot, const int8_t *sign,
                             double *scaled)
{
    for (size_t c = 0; c < width; ++c) {
        for (size_t k = 0; k < c; ++k)
            for (size_t r = c; r < STRIP; ++r)
                strip[STRIP * c + r] -= strip[STRIP * k + r] * scaled[ICCP_SQUARE * k + c];
        pivot[c] = strip[STRIP * c + c];
        if (!is_pivot(pivot[c], sign == NULL ? 1 : sign[c]))
            return false;
        for (size_t r = c + 1; r < STRIP; ++r)
            strip[STRIP * c + r] /= pivot[c];
        for (size_t r = c + 1; r < width; ++r)
            scaled[ICCP_SQUARE * c + r] = strip[STRIP * c + r] * pivot[c];
    }
    return true;
}

/* Columns [begin, end), which have received the updates of all earlier ones. */
typedef struct block {
    const iccp_panel *panel;
    size_t begin, end;
    const iccp_dense *dense;
    double *packed; /* for each square: its rows, left of it in the block */
    double scaled[ICCP_BLOCK / ICCP_SQUARE][ICCP_SQUARE * ICCP_SQUARE];
} block;

static size_t width_at(const block *b, size_t j)
{
    return b->end - j < ICCP_SQUARE ? b->end - j : ICCP_SQUARE;
}

/* Finishes the columns of the square at j in n strips, at most ICCP_STRIPS. Returns `packed` for
 * the next square. */
static const double *eliminate_strips(const block *b, size_t j, size_t strip, size_t n,
                                      const double *packed)
{
    const iccp_panel *p = b->panel;
    const size_t stride = STRIP * p->columns, width = width_at(b, j);
    double *row = p->value + strip * stride;
    if (j > b->begin)
        packed = subtract(p, b->dense, row, n, j, width, b->begin, j, packed);
    if (strip > j / STRIP)
        b->dense->divide(row + STRIP * j, n, stride, width, p->pivot + j,
                         b->scaled[(j - b->begin) / ICCP_SQUARE]);
    return packed;
}

/* Finishes the rows of the block itself, which all other rows need. Returns false if a pivot has
 * the wrong sign. */
static bool eliminate_rows(block *b, const int8_t *sign)
{
    const iccp_panel *p = b->panel;
    double *packed = b->packed;
    for (size_t j = b->begin; j < b->end; j += ICCP_SQUARE) {
        const size_t width = width_at(b, j), strip = j / STRIP, end = (b->end + STRIP - 1) / STRIP;
        iccp_panel_pack(packed, p, j, j + width, b->begin, j);
        const double *next = eliminate_strips(b, j, strip, 1, packed);
        if (!eliminate_square(p->value + strip * STRIP * p->columns + STRIP * j, width,
                              p->pivot + j, sign == NULL ? NULL : sign + j,
                              b->scaled[(j - b->begin) / ICCP_SQUARE]))
            return false;
        for (size_t s = strip + 1; s < end; ++s)
            (void)eliminate_strips(b, j, s, 1, packed);
        packed += next - packed;
    }
    return true;
}

static icc_status eliminate_below(void *argument, size_t strip, size_t strips)
{
    const block *b = argument;
    for (size_t n; strip < strips; strip += n) {
        const double *packed = b->packed;
        n = iccp_strips_at_once(strips - strip);
        for (size_t j = b->begin; j < b->end; j += ICCP_SQUARE)
            packed = eliminate_strips(b, j, strip, n, packed);
    }
    return ICC_OK;
}

icc_status iccp_panel_factorise(const iccp_panel *panel, const int8_t *sign,
                                const iccp_dense *dense, double *packed, iccp_labour *labour)
{
    const size_t columns = panel->columns;
    icc_status status = ICC_OK;
    for (size_t begin = 0; status == ICC_OK && begin < columns; begin += ICCP_BLOCK) {
        const size_t end = columns - begin < ICCP_BLOCK ? columns : begin + ICCP_BLOCK;
        const double width = (double)(end - begin);
        block b = {.panel = panel, .begin = begin, .end = end, .dense = dense, .packed = packed};
        status = update(panel, begin, end, dense, packed, labour);
        if (status == ICC_OK && !eliminate_rows(&b, sign))
            status = ICC_ERR_SOLVER;
        if (status == ICC_OK)
            status = iccp_labour_strips(labour, (end + STRIP - 1) / STRIP, n_strips_of(panel),
                                        (double)STRIP * width * width / 2, eliminate_below, &b);
    }
    return status;
}
