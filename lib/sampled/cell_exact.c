/* Exact coefficients of a cell. Only cells that plain arithmetic leaves open come here. */
#include "sampled/cell_exact.h"

#include "base/memory.h"
#include "math/expansion.h"

enum { PRODUCT = 18, CROSS = 36, TRIPLE = 216, SUM = 8 * 648 };

/* Terms within these bounds keep all bits in products of three: last places above 2^-1056, and
 * sums below 2^610. */
#define LARGEST 0x1p200
#define SMALLEST 0x1p-299

struct iccp_cell_work {
    size_t n[3][ICCP_CELL_EDGES][3];
    double edge[3][ICCP_CELL_EDGES][3][ICCP_CELL_TERMS];
    double left[PRODUCT], right[PRODUCT], cross[CROSS], part[2 * CROSS], more[PRODUCT];
    double triple[TRIPLE], product[TRIPLE];
    double sum[ICCP_CELL_MOST][SUM], spare[SUM];
    size_t n_sum[ICCP_CELL_MOST];
};

iccp_cell_work *iccp_cell_work_create(const iccp_memory *memory)
{
    return iccp_alloc(memory, 1, sizeof(iccp_cell_work));
}

/* h = e f. h and spare have room for 2 m n components, `part` for 2 m. n is small. */
static size_t multiply(double *h, size_t m, const double *e, size_t n, const double *f,
                       double *part, double *spare)
{
    size_t length = 0;
    for (size_t j = 0; j < n; ++j) {
        const size_t n_part = iccp_expansion_scale(part, m, e, f[j]);
        const size_t n_both = iccp_expansion_sum(spare, length, h, n_part, part);
        memcpy(h, spare, n_both * sizeof *h);
        length = n_both;
    }
    return length;
}

/* Sums up the terms of all edges exactly. */
static bool add_terms(const iccp_cell *cell, iccp_cell_work *w)
{
    for (size_t axis = 0; axis < 3; ++axis)
        for (size_t i = 0; i < cell->n_edges[axis]; ++i)
            for (size_t k = 0; k < 3; ++k) {
                const double *term = cell->term[axis][i][k];
                double pair[2], third[1];
                for (size_t t = 0; t < ICCP_CELL_TERMS; ++t)
                    if (!(fabs(term[t]) <= LARGEST) ||
                        (fabs(term[t]) < SMALLEST && fabs(term[t]) > 0))
                        return false;
                const size_t n = iccp_expansion_two_sum(pair, term[0], term[1]);
                const size_t m = iccp_expansion_push(third, 0, term[2]);
                w->n[axis][i][k] = iccp_expansion_sum(w->edge[axis][i][k], n, pair, m, third);
            }
    return true;
}

/* cross = component k of the cross product of edges a and b. */
static size_t cross_product(iccp_cell_work *w, size_t a, size_t b, size_t k)
{
    const size_t l = (k + 1) % 3, m = (k + 2) % 3;
    const size_t n_left = multiply(w->left, w->n[0][a][l], w->edge[0][a][l], w->n[1][b][m],
                                   w->edge[1][b][m], w->part, w->more);
    const size_t n_right = multiply(w->right, w->n[0][a][m], w->edge[0][a][m], w->n[1][b][l],
                                    w->edge[1][b][l], w->part, w->more);
    for (size_t i = 0; i < n_right; ++i)
        w->right[i] = -w->right[i];
    return iccp_expansion_sum(w->cross, n_left, w->left, n_right, w->right);
}

/* Adds to each coefficient its determinants with edges a and b. */
static void add_determinants(const iccp_cell *cell, iccp_cell_work *w, size_t a, size_t b)
{
    for (size_t k = 0; k < 3; ++k) {
        const size_t n_cross = cross_product(w, a, b, k);
        for (size_t c = 0; c < cell->n_edges[2]; ++c) {
            const size_t to = iccp_cell_coefficient(cell, a, b, c);
            const size_t n = multiply(w->triple, n_cross, w->cross, w->n[2][c][k], w->edge[2][c][k],
                                      w->part, w->product);
            const size_t n_sum =
                iccp_expansion_sum(w->spare, w->n_sum[to], w->sum[to], n, w->triple);
            memcpy(w->sum[to], w->spare, n_sum * sizeof *w->spare);
            w->n_sum[to] = n_sum;
        }
    }
}

bool iccp_cell_bound_exactly(iccp_cell_bounds *out, const iccp_cell *cell, iccp_cell_work *w)
{
    if (!add_terms(cell, w))
        return false;
    memset(w->n_sum, 0, sizeof w->n_sum);
    for (size_t a = 0; a < cell->n_edges[0]; ++a)
        for (size_t b = 0; b < cell->n_edges[1]; ++b)
            add_determinants(cell, w, a, b);
    for (size_t i = 0; i < cell->n; ++i) {
        const double value = cell->sign * iccp_cell_weight(cell, i) *
                             iccp_expansion_estimate(w->n_sum[i], w->sum[i]);
        /* The estimate has its sign and is off by a factor of at most 1 + 2 eps. */
        out->lower[i] = value - 4 * DBL_EPSILON * fabs(value);
        out->upper[i] = value + 4 * DBL_EPSILON * fabs(value);
    }
    return true;
}
