/* Blocked L D L^T of a tall dense panel, by columns and left-looking: G. Golub, C. Van Loan, Matrix
 * Computations, section 4.2. Blocks of ICCP_BLOCK columns get the product of all columns before them
 * at once; within a block the same is done for ICCP_TILE columns at a time. */
#include "math/panel.h"

#include <math.h>

#define STRIP ((size_t)ICCP_STRIP)

/* Between two looks at the clock of whoever waits: 20 ms at 1.5e9 multiplications a second. */
static const double PER_REPORT = 3e7;

icc_status iccp_labour_add(iccp_labour *labour, double multiplications)
{
    labour->done += multiplications;
    if (labour->done - labour->reported < PER_REPORT)
        return ICC_OK;
    labour->reported = labour->done;
    return iccp_progress(labour->env, "factorise", fmin(1, labour->done / labour->all));
}

void iccp_panel_pack(double *packed, const iccp_panel *panel, size_t begin, size_t end, size_t first,
                     size_t last)
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
static void update_strips(const iccp_panel *p, size_t first, size_t begin, size_t end,
                          const double *packed, iccp_multiply multiply, size_t strip, size_t strips)
{
    const size_t stride = STRIP * p->columns, depth = begin - first;
    for (size_t n; strip < strips; strip += n) {
        double *row = p->value + strip * stride;
        n = strip + 1 < strips ? 2 : 1;
        const double *b = packed;
        for (size_t j = begin; j < end && j < STRIP * (strip + n); j += ICCP_TILE) {
            const size_t width = iccp_panel_width(end - j), here = end - j < width ? end - j : width;
            double tile[2 * ICCP_TILE * ICCP_STRIP];
            multiply(tile, n, width, row + STRIP * first, stride, b, depth);
            for (size_t t = 0; t < n; ++t)
                for (size_t k = 0; k < STRIP * here; ++k)
                    row[t * stride + STRIP * j + k] -= tile[t * ICCP_TILE * STRIP + k];
            b += width * depth;
        }
    }
}

static icc_status update(const iccp_panel *p, size_t first, size_t begin, size_t end,
                         iccp_multiply multiply, double *packed, iccp_labour *labour)
{
    const size_t n_strips = (p->rows + STRIP - 1) / STRIP, depth = begin - first;
    icc_status status = ICC_OK;
    if (depth == 0)
        return ICC_OK;
    iccp_panel_pack(packed, p, begin, end, first, begin);
    for (size_t s = begin / STRIP; status == ICC_OK && s < n_strips; s += ICCP_STRIPS_PER_REPORT) {
        const size_t left = n_strips - s;
        const size_t n = left < ICCP_STRIPS_PER_REPORT ? left : ICCP_STRIPS_PER_REPORT;
        update_strips(p, first, begin, end, packed, multiply, s, s + n);
        status = iccp_labour_add(labour, (double)(STRIP * n * (end - begin)) * (double)depth);
    }
    return status;
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
