/* Blocked L D L^T of a tall dense panel, by columns and left-looking: G. Golub, C. Van Loan, Matrix
 * Computations, section 4.2. Blocks of ICCP_BLOCK columns get the product of all columns before
 * them at once; within a block the same is done for ICCP_TILE columns at a time. */
#include "math/panel.h"

#include "base/minmax.h"

#include <math.h>

#define STRIP ((size_t)ICCP_STRIP)

/* Between two looks at the clock of whoever waits: 20 ms at 1.5e9 multiplications a second. */
static const double PER_REPORT = 3e7;

/* Less than this is done sooner than threads are started. */
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

void iccp_panel_pack(double *packed, const iccp_panel *panel, size_t begin, size_t end,
                     size_t first, size_t last)
{
    for (size_t i = begin; i < end; i += ICCP_TILE) {
        const size_t left = end - i, width = iccp_panel_width(left);
        for (size_t c = 0; c < width; ++c) {
            const double *row = panel->value + iccp_panel_row(panel, i + c);
            for (size_t k = first; k < last; ++k)
                packed[(k - first) * width + c] = c < left ? row[STRIP * k] * panel->pivot[k] : 0.0;
        }
        packed += width * (last - first);
    }
}

/* Columns [begin, end), from row `begin` on, minus the product of columns [first, begin). */
typedef struct product {
    const iccp_panel *panel;
    size_t first, begin, end;
    const double *packed;
    iccp_multiply multiply;
} product;

/* Like update_strips() in ldlt_factorise.c, but the panel updates itself: rows and columns of
 * the tile are those of the panel, so that nothing is scattered. */
static icc_status update_strips(void *argument, size_t strip, size_t strips)
{
    const product *u = argument;
    const iccp_panel *p = u->panel;
    const size_t stride = STRIP * p->columns, depth = u->begin - u->first;
    for (size_t n; strip < strips; strip += n) {
        double *row = p->value + strip * stride;
        const double *b = u->packed;
        n = strip + 1 < strips ? 2 : 1;
        for (size_t j = u->begin; j < u->end && j < STRIP * (strip + n); j += ICCP_TILE) {
            const size_t left = u->end - j, width = iccp_panel_width(left);
            const size_t here = left < width ? left : width;
            double tile[2 * ICCP_TILE * ICCP_STRIP];
            u->multiply(tile, n, width, row + STRIP * u->first, stride, b, depth);
            for (size_t t = 0; t < n; ++t)
                for (size_t k = 0; k < STRIP * here; ++k)
                    row[t * stride + STRIP * j + k] -= tile[t * ICCP_TILE * STRIP + k];
            b += width * depth;
        }
    }
    return ICC_OK;
}

static icc_status update(const iccp_panel *p, size_t first, size_t begin, size_t end,
                         iccp_multiply multiply, double *packed, iccp_labour *labour)
{
    const size_t n_strips = (p->rows + STRIP - 1) / STRIP, depth = begin - first;
    product u = {p, first, begin, end, packed, multiply};
    if (depth == 0)
        return ICC_OK;
    iccp_panel_pack(packed, p, begin, end, first, begin);
    return iccp_labour_strips(labour, begin / STRIP, n_strips,
                              (double)(STRIP * (end - begin)) * (double)depth, update_strips, &u);
}

static bool is_pivot(double pivot, int sign)
{
    return isfinite(pivot) && (sign > 0 ? pivot > 0 : pivot < 0);
}

/* The square on the diagonal, and the rows that share its strip. scaled[k][c] = d_k L(c, k). */
static bool eliminate_square(double *strip, size_t width, double *pivot, const int8_t *sign,
                             double scaled[ICCP_TILE][ICCP_TILE])
{
    for (size_t c = 0; c < width; ++c) {
        for (size_t k = 0; k < c; ++k)
            for (size_t r = c; r < STRIP; ++r)
                strip[STRIP * c + r] -= strip[STRIP * k + r] * scaled[k][c];
        pivot[c] = strip[STRIP * c + c];
        if (!is_pivot(pivot[c], sign == NULL ? 1 : sign[c]))
            return false;
        for (size_t r = c + 1; r < STRIP; ++r)
            strip[STRIP * c + r] /= pivot[c];
        for (size_t r = c + 1; r < width; ++r)
            scaled[c][r] = strip[STRIP * c + r] * pivot[c];
    }
    return true;
}

static void eliminate_strip(double *strip, size_t width, const double *pivot,
                            double scaled[ICCP_TILE][ICCP_TILE])
{
    for (size_t c = 0; c < width; ++c) {
        double column[ICCP_STRIP];
        for (size_t r = 0; r < STRIP; ++r)
            column[r] = strip[STRIP * c + r];
        for (size_t k = 0; k < c; ++k)
            for (size_t r = 0; r < STRIP; ++r)
                column[r] -= strip[STRIP * k + r] * scaled[k][c];
        for (size_t r = 0; r < STRIP; ++r)
            strip[STRIP * c + r] = column[r] / pivot[c];
    }
}

/* Columns [begin, begin + width), which have got all updates. */
static bool eliminate(const iccp_panel *p, size_t begin, size_t width, const int8_t *sign)
{
    const size_t n_strips = (p->rows + STRIP - 1) / STRIP, stride = STRIP * p->columns;
    double scaled[ICCP_TILE][ICCP_TILE];
    double *strip = p->value + begin * p->columns + STRIP * begin, *pivot = p->pivot + begin;
    if (!eliminate_square(strip, width, pivot, sign == NULL ? NULL : sign + begin, scaled))
        return false;
    for (size_t s = begin / STRIP + 1; s < n_strips; ++s) {
        strip += stride;
        eliminate_strip(strip, width, pivot, scaled);
    }
    return true;
}

icc_status iccp_panel_factorise(const iccp_panel *panel, const int8_t *sign, iccp_multiply multiply,
                                double *packed, iccp_labour *labour)
{
    const size_t columns = panel->columns;
    icc_status status = ICC_OK;
    for (size_t block = 0; status == ICC_OK && block < columns; block += ICCP_BLOCK) {
        const size_t end = columns - block < ICCP_BLOCK ? columns : block + ICCP_BLOCK;
        status = update(panel, 0, block, end, multiply, packed, labour);
        for (size_t j = block; status == ICC_OK && j < end; j += ICCP_TILE) {
            const size_t width = end - j < ICCP_TILE ? end - j : ICCP_TILE;
            status = update(panel, block, j, j + width, multiply, packed, labour);
            if (status == ICC_OK && !eliminate(panel, j, width, sign))
                status = ICC_ERR_SOLVER;
        }
    }
    return status;
}
