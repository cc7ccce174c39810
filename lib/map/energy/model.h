/* The distance of a simplicial map from a model, which gives an image to each point, too. It may
 * fold. The distance is measured by the squared difference of the Jacobians, so that its Hessian
 * does not depend on the images: it is the cotangent Laplacian. */
#ifndef ICCP_MODEL_H
#define ICCP_MODEL_H

#include "map/energy/simplicial_map.h"

/* Computes the Jacobian of the map minus that of the model in one simplex, row by row. */
static ICCP_INLINE void iccp_model_difference(size_t dim, const iccp_simplicial_map *map,
                                              size_t simplex, const double *element, double *j)
{
    const uint32_t *v = map->corners + (dim + 1) * simplex;
    double difference[4][3];
    const double *corner[4];
    for (size_t k = 0; k <= dim; ++k) {
        for (size_t d = 0; d < dim; ++d)
            difference[k][d] = map->images[dim * v[k] + d] - map->model[dim * v[k] + d];
        corner[k] = difference[k];
    }
    (void)iccp_element_jacobian(dim, element, corner, j);
}

/* Returns half the pull times the squared difference of the Jacobians, times the area or volume. */
static ICCP_INLINE double iccp_model_energy(size_t dim, const iccp_simplicial_map *map,
                                            size_t simplex, const double *element)
{
    double j[9];
    iccp_model_difference(dim, map, simplex, element, j);
    return 0.5 * map->pull * element[0] * iccp_squared_norm(dim, j);
}

/* Adds the derivatives of that energy. */
static ICCP_INLINE void iccp_model_add(size_t dim, const iccp_simplicial_map *map, size_t simplex,
                                       const double *element, iccp_local *local)
{
    const size_t n = dim * (dim + 1);
    const double weight = map->pull * element[0];
    double j[9], gradient[12];
    iccp_model_difference(dim, map, simplex, element, j);
    iccp_pull_back(dim, element, j, weight, gradient);
    for (size_t i = 0; i < n; ++i)
        local->gradient[i] += gradient[i];
    for (size_t a = 0; a <= dim; ++a)
        for (size_t b = 0; b <= dim; ++b) {
            double dot = 0;
            for (size_t d = 0; d < dim; ++d)
                dot += element[1 + dim * a + d] * element[1 + dim * b + d];
            for (size_t d = 0; d < dim; ++d)
                local->hessian[n * (dim * a + d) + dim * b + d] += weight * dot;
        }
}

#endif
