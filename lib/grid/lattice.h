/* The grid object: a regular n-D lattice, each vertex inside or outside. Written once for any
 * dimension; only making one from a polygon (rasterise.h) knows about 2-D. */
#ifndef ICCP_LATTICE_H
#define ICCP_LATTICE_H

#include "base/env.h"
#include "domain/domain.h"
#include "icc/stages.h"

#include <stdatomic.h>

/* No vertex. */
#define ICCP_NONE UINT32_MAX

struct icc_grid {
    iccp_memory memory;
    atomic_size_t references;
    int32_t dim;
    size_t shape[ICC_MAX_DIM];
    size_t stride[ICC_MAX_DIM];  /* stride[0] = 1; index = sum of i_k * stride[k] */
    double origin[ICC_MAX_DIM];  /* local position of vertex 0 */
    double spacing;              /* local */
    iccp_frame frame;            /* of the domain, or the identity for masks */
    size_t n_vertices, n_inside;
    uint8_t *inside;             /* 1 or 0 */
};

/* See icc_grid_create(); cells in 2..16384. Along the longest side there are exactly `cells` vertices
 * inside the bounding box, half a cell away from it at both ends; the other axes are centred. Two
 * layers of vertices lie beyond the bounding box on every side. */
icc_status iccp_grid_create(icc_grid **out, const icc_domain *domain, int32_t cells,
                            const iccp_env *env, icc_error *err);

icc_status iccp_grid_create_mask(icc_grid **out, int32_t dim, const size_t *shape,
                                 const uint8_t *inside, const iccp_env *env, icc_error *err);

icc_grid *iccp_grid_retain(const icc_grid *grid);
void iccp_grid_release(icc_grid *grid);

/* The neighbour of a vertex one step along axis k (step +1 or -1), or ICCP_NONE at the border. */
uint32_t iccp_grid_neighbour(const icc_grid *grid, uint32_t vertex, int32_t k, int32_t step);

/* The inside vertex nearest to a local point; the smallest index of several. ICCP_NONE if none. */
uint32_t iccp_grid_nearest(const icc_grid *grid, const double *point);

#endif
