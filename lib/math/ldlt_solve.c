/* Triangular solves with a supernodal factor (see ldlt_factorise.c), strip by strip: what a strip
 * of rows needs of the columns before its own is one product, then come the few entries beside the
 * diagonal. */
#include "base/simd.h"
#include "math/ldlt.h"
#include "math/panel.h"

#include <stdbool.h>
#include <string.h>

#define STRIP ((size_t)ICCP_STRIP)

/* Right-hand sides next to each other in the work space: entry i of column s at value[i * width
 * + s]. One pass over a panel serves a whole group of them. */
typedef struct group {
    double *value;
    size_t width;
} group;

enum { MOST_COLUMNS = 4 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Entries i of a panel's rows. */
static double *entries(const group *x, const iccp_panel *p, uint32_t first, const uint32_t *below,
                       size_t i, size_t width)
{
    return x->value + (i < p->columns ? first + i : below[i - p->columns]) * width;
}

/* With a constant width the loops over columns and rows are unrolled and run in vector
 * registers. */
static ICCP_INLINE void forward(const group *x, const iccp_panel *p, uint32_t first,
                                const uint32_t *below, size_t width)
{
    const double *own = x->value + first * width, *strip = p->value;
    for (size_t i = 0; i < p->rows; i += STRIP, strip += STRIP * p->columns) {
        const size_t depth = least(i, p->columns);
        double sum[MOST_COLUMNS][ICCP_STRIP];
        for (size_t s = 0; s < width; ++s)
            for (size_t r = 0; r < STRIP; ++r)
                sum[s][r] = 0;
        for (size_t k = 0; k < depth; ++k)
            for (size_t s = 0; s < width; ++s)
                for (size_t r = 0; r < STRIP; ++r)
                    sum[s][r] += strip[STRIP * k + r] * own[k * width + s];
        for (size_t r = 0; r < least(STRIP, p->rows - i); ++r) {
            double *row = entries(x, p, first, below, i + r, width);
            for (size_t s = 0; s < width; ++s) {
                for (size_t k = depth; k < least(i + r, p->columns); ++k)
                    sum[s][r] += strip[STRIP * k + r] * own[k * width + s];
                row[s] -= sum[s][r];
            }
        }
    }
}

/* x = L^-T D^-1 x for one panel: the mirror image of forward(). Strips are taken from below,
 * each adding to the columns left of it; within the strip on the diagonal, the last row comes
 * first. */
static ICCP_INLINE void backward(const group *x, const iccp_panel *p, uint32_t first,
                                 const uint32_t *below, size_t width)
{
    double *own = x->value + first * width;
    for (size_t k = 0; k < p->columns * width; ++k)
        own[k] /= p->pivot[k / width];
    for (size_t i = (p->rows + STRIP - 1) / STRIP * STRIP; i > 0;) {
        i -= STRIP;
        const double *strip = p->value + i * p->columns;
        const size_t depth = least(i, p->columns);
        double y[ICCP_STRIP][MOST_COLUMNS];
        for (size_t s = 0; s < STRIP * width; ++s)
            y[s / width][s % width] = 0;
        for (size_t r = least(STRIP, p->rows - i); r-- > 0;) {
            const double *row = entries(x, p, first, below, i + r, width);
            for (size_t s = 0; s < width; ++s) {
                y[r][s] = row[s];
                for (size_t k = depth; k < least(i + r, p->columns); ++k)
                    own[k * width + s] -= strip[STRIP * k + r] * y[r][s];
            }
        }
        for (size_t k = 0; k < depth; ++k, strip += STRIP)
            for (size_t s = 0; s < width; ++s)
                own[k * width + s] -= (strip[0] * y[0][s] + strip[1] * y[1][s]) +
                                      (strip[2] * y[2][s] + strip[3] * y[3][s]);
    }
}

static ICCP_INLINE void pass_inline(const iccp_ldlt *factor, size_t s, const group *x,
                                    bool is_forward)
{
    const iccp_supernodes *nodes = &factor->nodes;
    const iccp_panel panel = iccp_panel_of(nodes, s, factor->value, factor->pivot);
    const uint32_t first = nodes->column[s], *below = nodes->row + nodes->first_row[s];
    if (x->width == MOST_COLUMNS && is_forward)
        forward(x, &panel, first, below, MOST_COLUMNS);
    else if (x->width == MOST_COLUMNS)
        backward(x, &panel, first, below, MOST_COLUMNS);
    else if (is_forward)
        forward(x, &panel, first, below, 1);
    else
        backward(x, &panel, first, below, 1);
}

typedef void (*pass)(const iccp_ldlt *factor, size_t s, const group *x, bool is_forward);

static void pass_portable(const iccp_ldlt *factor, size_t s, const group *x, bool is_forward)
{
    pass_inline(factor, s, x, is_forward);
}

#ifdef ICCP_HAS_SIMD

/* The same bits: lanes are rows or columns, and nothing is contracted. */
ICCP_AVX2 static void pass_avx2(const iccp_ldlt *factor, size_t s, const group *x, bool is_forward)
{
    pass_inline(factor, s, x, is_forward);
}

static pass choose_pass(void)
{
    return iccp_simd() == ICCP_SIMD_AVX2 ? pass_avx2 : pass_portable;
}

#else

static pass choose_pass(void)
{
    return pass_portable;
}

#endif

/* The group that begins with column `done`: as wide as can be, or one column alone. */
static group group_at(const iccp_ldlt *factor, size_t n_rhs, size_t done, double *work)
{
    return (group){work + factor->n * done, n_rhs - done < MOST_COLUMNS ? 1 : MOST_COLUMNS};
}

/* A panel goes to all groups while it is in the cache. */
static void pass_all(pass run, const iccp_ldlt *factor, size_t s, size_t n_rhs, double *work,
                     bool is_forward)
{
    for (size_t done = 0; done < n_rhs;) {
        const group x = group_at(factor, n_rhs, done, work);
        run(factor, s, &x, is_forward);
        done += x.width;
    }
}

void iccp_ldlt_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work)
{
    const size_t n_panels = factor->nodes.n;
    const pass run = choose_pass();
    for (size_t done = 0, width; done < n_rhs; done += width) {
        const group x = group_at(factor, n_rhs, done, work);
        width = x.width;
        for (size_t k = 0; k < factor->n; ++k)
            memcpy(x.value + k * width, b + factor->order[k] * n_rhs + done, width * sizeof *b);
    }
    for (size_t s = 0; s < n_panels; ++s)
        pass_all(run, factor, s, n_rhs, work, true);
    for (size_t s = n_panels; s-- > 0;)
        pass_all(run, factor, s, n_rhs, work, false);
    for (size_t done = 0, width; done < n_rhs; done += width) {
        const group x = group_at(factor, n_rhs, done, work);
        width = x.width;
        for (size_t k = 0; k < factor->n; ++k)
            memcpy(b + factor->order[k] * n_rhs + done, x.value + k * width, width * sizeof *b);
    }
}
