/* Fits affine maps by least squares, and makes maps affine inside.
 *
 * The fit solves normal equations. One round of iterative refinement regains the digits that they
 * lose: N. J. Higham, Accuracy and Stability of Numerical Algorithms, chapter 20. */
#include "map/energy/affine.h"

#include "base/minmax.h"
#include "math/inverse.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* A boundary counts as affine if all vertices lie within this distance of the fitted map, on either
 * side. The unit is the largest coordinate that the caller gave. Computed doubles are off by some
 * 1e-16 of that. A boundary that was bent on purpose is much farther off. */
static const double ROUNDING = 1e-13;

void iccp_affine_apply(const iccp_affine *a, const double *x, double *y)
{
    double d[ICC_MAX_DIM];
    for (size_t k = 0; k < a->dim; ++k)
        d[k] = x[k] - a->from[k];
    for (size_t k = 0; k < a->dim; ++k)
        y[k] = a->to[k] + iccp_vec_dot(a->dim, a->matrix + a->dim * k, d);
}

/* ---- fitting ---- */

/* Beyond space, the cofactors of a matrix with determinant 0 are left out. */
static double determinant(size_t dim, const double *matrix, double *cofactor)
{
    if (dim > 3) {
        double inverse[ICC_MAX_DIM * ICC_MAX_DIM], det;
        if (iccp_invert(dim, matrix, inverse, &det))
            for (size_t i = 0; i < dim * dim; ++i)
                cofactor[i] = det * inverse[dim * (i % dim) + i / dim];
        return det;
    }
    iccp_cofactors(dim, matrix, cofactor);
    return iccp_vec_dot(dim, matrix, cofactor);
}

/* Adds the mean of `value` over the fixed points. */
static void add_mean(const iccp_simplicial_map *map, size_t n_fixed, const double *value,
                     double *mean)
{
    for (uint32_t v = 0; v < map->n_points; ++v)
        for (size_t k = 0; k < map->dim && iccp_simplicial_is_fixed(map, v); ++k)
            mean[k] += value[map->dim * v + k] / (double)n_fixed;
}

/* Adds the products of the fixed points' differences from a->from. */
static void add_moments(const iccp_affine *a, const iccp_simplicial_map *map, double *second)
{
    for (uint32_t v = 0; v < map->n_points; ++v) {
        const double *x = map->points + a->dim * v;
        if (!iccp_simplicial_is_fixed(map, v))
            continue;
        for (size_t r = 0; r < a->dim; ++r)
            for (size_t c = 0; c < a->dim; ++c)
                second[a->dim * r + c] += (x[r] - a->from[r]) * (x[c] - a->from[c]);
    }
}

/* Corrects the map by a fit to its residuals. */
static void correct(iccp_affine *a, const iccp_simplicial_map *map, size_t n_fixed,
                    const double *cofactor, double det)
{
    const size_t dim = a->dim;
    double mixed[ICC_MAX_DIM * ICC_MAX_DIM] = {0}, mean[ICC_MAX_DIM] = {0};
    double place[ICC_MAX_DIM];
    for (uint32_t v = 0; v < map->n_points; ++v) {
        const double *x = map->points + dim * v, *y = map->images + dim * v;
        if (!iccp_simplicial_is_fixed(map, v))
            continue;
        iccp_affine_apply(a, x, place);
        for (size_t r = 0; r < dim; ++r) {
            mean[r] += (y[r] - place[r]) / (double)n_fixed;
            for (size_t c = 0; c < dim; ++c)
                mixed[dim * r + c] += (y[r] - place[r]) * (x[c] - a->from[c]);
        }
    }
    for (size_t r = 0; r < dim; ++r) {
        a->to[r] += mean[r];
        for (size_t c = 0; c < dim; ++c)
            a->matrix[dim * r + c] += iccp_vec_dot(dim, mixed + dim * r, cofactor + dim * c) / det;
    }
}

bool iccp_affine_fit(iccp_affine *a, const iccp_simplicial_map *map)
{
    double second[ICC_MAX_DIM * ICC_MAX_DIM] = {0}, cofactor[ICC_MAX_DIM * ICC_MAX_DIM];
    size_t n_fixed = 0;
    for (uint32_t v = 0; v < map->n_points; ++v)
        n_fixed += iccp_simplicial_is_fixed(map, v);
    *a = (iccp_affine){.dim = map->dim};
    add_mean(map, n_fixed, map->points, a->from);
    add_moments(a, map, second);
    const double det = determinant(a->dim, second, cofactor);
    if (!(det > 0))
        return false;
    enum { ROUNDS = 2 };
    double scratch[ICC_MAX_DIM * ICC_MAX_DIM];
    for (int round = 0; round < ROUNDS; ++round)
        correct(a, map, n_fixed, cofactor, det);
    return determinant(a->dim, a->matrix, scratch) > 0;
}

/* ---- maps with affine boundaries ---- */

/* The largest of the caller's coordinates, in local units. */
static double largest_coordinate(const icc_domain *domain)
{
    const iccp_frame *f = &domain->frame;
    double largest = 0;
    for (int32_t k = 0; k < domain->dim; ++k) {
        const double shift = f->shift[k] * f->in[0] * f->in[1];
        largest = iccp_max(largest, fabs(domain->lower[k] + shift));
        largest = iccp_max(largest, fabs(domain->upper[k] + shift));
    }
    return largest;
}

/* The distance from their affine images that rounding can explain. */
static double tolerance_of(const iccp_affine *a, const icc_domain *source, const icc_domain *target)
{
    double norm = 0;
    for (size_t i = 0; i < a->dim * a->dim; ++i)
        norm += fabs(a->matrix[i]);
    return ROUNDING * (norm * largest_coordinate(source) + largest_coordinate(target));
}

/* True if the fixed points, or the free ones, go where the affine map takes them. */
static bool agrees(const iccp_affine *a, const iccp_simplicial_map *map, bool fixed,
                   double tolerance)
{
    double place[ICC_MAX_DIM];
    for (uint32_t v = 0; v < map->n_points; ++v) {
        if (iccp_simplicial_is_fixed(map, v) != fixed)
            continue;
        iccp_affine_apply(a, map->points + a->dim * v, place);
        for (size_t k = 0; k < a->dim; ++k)
            if (!(fabs(map->images[a->dim * v + k] - place[k]) <= tolerance))
                return false;
    }
    return true;
}

/* Moves the images of the free points to where the affine map takes them. */
static void follow(const iccp_affine *a, const iccp_simplicial_map *map)
{
    for (uint32_t v = 0; v < map->n_points; ++v) {
        double *image = map->images + a->dim * v;
        if (iccp_simplicial_is_fixed(map, v))
            continue;
        iccp_affine_apply(a, map->points + a->dim * v, image);
        iccp_simplicial_round(a->dim, image);
    }
}

/* True if the boundary is affine. Sets *inside if the inside is, too. */
static bool is_boundary_affine(const iccp_simplicial_map *map, const icc_domain *source,
                               const icc_domain *target, iccp_affine *a, bool *inside)
{
    const bool boundary =
        iccp_affine_fit(a, map) && agrees(a, map, true, tolerance_of(a, source, target));
    *inside = boundary && agrees(a, map, false, ROUNDING); /* local sizes are about 1 */
    return boundary;
}

bool iccp_is_affine(const iccp_simplicial_map *map, const icc_domain *source,
                    const icc_domain *target)
{
    iccp_affine a;
    bool inside;
    return is_boundary_affine(map, source, target, &a, &inside) && inside;
}

icc_status iccp_affine_extend(const iccp_simplicial_map *map, const icc_domain *source,
                              const icc_domain *target, double **before, const iccp_env *env)
{
    const size_t n = map->dim * map->n_points;
    iccp_affine a;
    *before = NULL;
    bool inside;
    if (!is_boundary_affine(map, source, target, &a, &inside) || inside)
        return ICC_OK;
    double *kept = iccp_alloc(&env->memory, n, sizeof *kept);
    if (kept == NULL)
        return ICC_ERR_MEMORY;
    memcpy(kept, map->images, n * sizeof *kept);
    follow(&a, map);
    if (iccp_simplicial_count_at_once(map, env) == 0) {
        *before = kept;
        return ICC_OK;
    }
    memcpy(map->images, kept, n * sizeof *kept);
    iccp_free(&env->memory, kept);
    return ICC_OK;
}
