/* Affine maps: the one that fits a boundary, and maps that become affine inside because their
 * boundary is. */
#ifndef ICCP_AFFINE_H
#define ICCP_AFFINE_H

#include "domain/domain.h"
#include "map/simplicial_map.h"

/* y = matrix (x - from) + to, in 2 or 3 dimensions. */
typedef struct iccp_affine {
    size_t dim;
    double from[3], to[3], matrix[9];
} iccp_affine;

void iccp_affine_apply(const iccp_affine *a, const double *x, double *y);

/* Fits an affine map to the fixed points of a map and their images, by least squares. False if
 * there is none that keeps orientation. */
bool iccp_affine_fit(iccp_affine *a, const iccp_simplicial_map *map);

/* If the fixed points go to their images by one affine map, up to rounding, the free points follow
 * it, since an affine map has the least energy. The images of fixed points stay as they were given.
 * `before` then holds all images as they were, for the caller to free; else it is NULL and nothing
 * has changed: the boundary is not affine, or the images are as good already, or a simplex would
 * not be positive. */
icc_status iccp_affine_settle(const iccp_simplicial_map *map, const icc_domain *source,
                              const icc_domain *target, double **before, const iccp_env *env);

/* Whether all of a map is affine up to rounding, so that none has less energy. */
bool iccp_affine_is_settled(const iccp_simplicial_map *map, const icc_domain *source,
                            const icc_domain *target);

#endif
