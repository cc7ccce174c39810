/* Fits an affine map to a boundary, and makes maps affine inside if their boundary is. */
#ifndef ICCP_AFFINE_H
#define ICCP_AFFINE_H

#include "domain/domain.h"
#include "map/energy/simplicial_map.h"

/* y = matrix (x - from) + to, in any dimension. */
typedef struct iccp_affine {
    size_t dim;
    double from[ICC_MAX_DIM], to[ICC_MAX_DIM], matrix[ICC_MAX_DIM * ICC_MAX_DIM];
} iccp_affine;

void iccp_affine_apply(const iccp_affine *a, const double *x, double *y);

/* Fits an affine map to the fixed points of a map and their images, by least squares. Returns false
 * if the fit does not keep orientation. */
bool iccp_affine_fit(iccp_affine *a, const iccp_simplicial_map *map);

/* If one affine map takes the fixed points to their images, up to rounding, the free points follow
 * it, because an affine map has the least energy. The images of fixed points do not change.
 * `before` then holds the earlier images, and the caller frees it. It is NULL if nothing changed:
 * the boundary is not affine, the inside is affine already, or a simplex would not be positive. */
icc_status iccp_affine_extend(const iccp_simplicial_map *map, const icc_domain *source,
                              const icc_domain *target, double **before, const iccp_env *env);

/* True if the whole map is affine up to rounding, so no other has less energy. */
bool iccp_is_affine(const iccp_simplicial_map *map, const icc_domain *source,
                    const icc_domain *target);

#endif
