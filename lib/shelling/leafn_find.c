/* Finds the simplex of a point. Source: Gaussian elimination with pivoting, which is backward
 * stable. So the barycentric coordinates reproduce the point up to rounding, however flat the
 * simplex is. */
#include "shelling/leafn.h"

#include "base/minmax.h"

#include <math.h>
#include <string.h>

enum { CORNERS = ICCP_LEAFN_CORNERS, MAX = ICC_MAX_DIM };

/* The edges from the first corner as columns, and n_right more columns to their right. */
typedef double system[MAX][2 * MAX];

static ICCP_INLINE void swap_rows(system a, size_t i, size_t j, size_t n)
{
    for (size_t k = 0; k < n; ++k) {
        const double swap = a[i][k];
        a[i][k] = a[j][k];
        a[j][k] = swap;
    }
}

/* Replaces the right columns by the solutions. Returns false if the matrix is singular. */
static ICCP_INLINE bool solve(system a, size_t dim, size_t n_right)
{
    const size_t n = dim + n_right;
    for (size_t c = 0; c < dim; ++c) {
        size_t pivot = c;
        for (size_t i = c + 1; i < dim; ++i)
            pivot = fabs(a[i][c]) > fabs(a[pivot][c]) ? i : pivot;
        if (!(fabs(a[pivot][c]) > 0))
            return false;
        if (pivot != c)
            swap_rows(a, pivot, c, n);
        for (size_t i = c + 1; i < dim; ++i) {
            const double factor = a[i][c] / a[c][c];
            for (size_t k = c + 1; k < n; ++k)
                a[i][k] -= factor * a[c][k];
        }
    }
    for (size_t c = dim; c-- > 0;)
        for (size_t k = dim; k < n; ++k) {
            for (size_t j = c + 1; j < dim; ++j)
                a[c][k] -= a[c][j] * a[j][k];
            a[c][k] /= a[c][c];
        }
    return true;
}

static ICCP_INLINE const double *set_edges(const iccp_leaves *leaves, size_t dim, uint32_t simplex,
                                           system a)
{
    const uint32_t *v = leaves->corners + (dim + 1) * simplex;
    const double *origin = leaves->points + dim * v[0];
    for (size_t j = 0; j < dim; ++j)
        for (size_t k = 0; k < dim; ++k)
            a[k][j] = leaves->points[dim * v[j + 1] + k] - origin[k];
    return origin;
}

/* Computes barycentric coordinates. Returns the least of them, or -HUGE_VAL for a flat simplex. */
static ICCP_INLINE double coordinates(const iccp_leaves *leaves, size_t dim, uint32_t simplex,
                                      const double *point, double *bary)
{
    system a;
    const double *origin = set_edges(leaves, dim, simplex, a);
    for (size_t k = 0; k < dim; ++k)
        a[k][dim] = point[k] - origin[k];
    if (!solve(a, dim, 1))
        return -HUGE_VAL;
    double sum = 0, least = HUGE_VAL;
    for (size_t i = 0; i < dim; ++i) {
        bary[i + 1] = a[i][dim];
        sum += a[i][dim];
        least = iccp_min(least, a[i][dim]);
    }
    bary[0] = 1 - sum;
    return iccp_min(least, bary[0]);
}

static double coordinates_in(const iccp_leaves *leaves, uint32_t simplex, const double *point,
                             double *bary)
{
    return leaves->dim == 3 ? coordinates(leaves, 3, simplex, point, bary)
                            : coordinates(leaves, leaves->dim, simplex, point, bary);
}

void iccp_leafn_gradient(const iccp_leaves *leaves, uint32_t simplex, iccp_leafn_jet *jet)
{
    const size_t dim = leaves->dim;
    system a;
    memset(jet, 0, sizeof *jet);
    jet->n = dim;
    (void)set_edges(leaves, dim, simplex, a);
    for (size_t k = 0; k < dim; ++k)
        for (size_t j = 0; j < dim; ++j)
            a[k][dim + j] = k == j;
    if (!solve(a, dim, dim))
        return;
    for (size_t i = 0; i < dim; ++i)
        for (size_t j = 0; j < dim; ++j) {
            jet->bary[i + 1][j] = a[i][dim + j];
            jet->bary[0][j] -= a[i][dim + j];
        }
}

/* If rounding leaves the point outside all simplices, takes the one that it is least outside of,
 * by an estimate of the distance. */
bool iccp_leafn_find(const iccp_leaves *leaves, const double *point, double tolerance,
                     iccp_leafn_place *place, bool *inner)
{
    const size_t dim = leaves->dim;
    double box[2 * MAX], bary[CORNERS], best = -HUGE_VAL;
    iccp_facet_query query;
    uint32_t simplex;
    for (size_t k = 0; k < dim; ++k) {
        box[k] = point[k] - tolerance;
        box[dim + k] = point[k] + tolerance;
    }
    iccp_facet_query_start(&query, &leaves->tree, box);
    while (best < 0 && iccp_facet_query_next(&query, &simplex)) {
        const double margin = iccp_leafn_record(leaves, simplex)[dim + 2].number;
        const double depth = coordinates_in(leaves, simplex, point, bary) / margin;
        if (!(depth > best))
            continue;
        best = depth;
        place->simplex = simplex;
        memcpy(place->bary, bary, sizeof bary);
    }
    *inner = best > 1;
    for (size_t i = 0; i <= dim; ++i)
        place->bary[i] = place->bary[i] > 0 ? place->bary[i] : 0;
    return best > -HUGE_VAL;
}
