/* The grid object: a regular n-D lattice, each vertex inside or outside. Written once for any
 * dimension; only making one from a domain (rasterise.h) knows what the domain is. */
#ifndef ICCP_LATTICE_H
#define ICCP_LATTICE_H

#include "base/env.h"
#include "domain/domain.h"
#include "icc/stages.h"

#include <stdatomic.h>

/* No vertex. */
#define ICCP_NONE UINT32_MAX

/* Most vertices that a grid may have. */
#define ICCP_MAX_VERTICES ((size_t)1 << 28)

/* Loops over vertices report progress once per so many of them. */
#define ICCP_VERTICES_PER_REPORT ((size_t)1 << 16)

struct icc_grid {
    iccp_memory memory;
    atomic_size_t references;
    int32_t dim;
    size_t shape[ICC_MAX_DIM];
    size_t stride[ICC_MAX_DIM]; /* stride[0] = 1; index = sum of i_k * stride[k] */
    double origin[ICC_MAX_DIM]; /* local position of vertex 0 */
    double spacing;             /* local */
    iccp_frame frame;           /* of the domain, or the identity for masks */
    int32_t cells;              /* along the longest side of a domain; 0 for masks of vertices */
    icc_domain *domain;         /* whose inside the vertices inside lie in, or NULL */
    size_t n_vertices, n_inside;
    size_t n_stray;  /* vertices that were inside and have been taken out */
    uint8_t *inside; /* 1 or 0 */
};

/* A lattice with every vertex outside, origin 0, spacing 1 and the identity frame. The shape has no
 * zeros. ICC_ERR_RESOLUTION beyond ICCP_MAX_VERTICES. */
icc_status iccp_grid_new(icc_grid **out, int32_t dim, const size_t *shape, const iccp_env *env,
                         icc_error *err);

/* See icc_grid_create_mask(). */
icc_status iccp_grid_create_mask(icc_grid **out, int32_t dim, const size_t *shape,
                                 const uint8_t *inside, const iccp_env *env, icc_error *err);

/* See icc_grid_restrict(). */
icc_status iccp_grid_restrict(icc_grid **out, const icc_grid *grid, const uint8_t *keep,
                              const iccp_env *env, icc_error *err);

/* Takes part in keeping a grid alive, which is logically const for the one who asks. */
icc_grid *iccp_grid_retain(const icc_grid *grid);
void iccp_grid_release(icc_grid *grid);

/* The inside vertex nearest to a local point; the smallest index of several. ICCP_NONE if none. */
uint32_t iccp_grid_nearest(const icc_grid *grid, const double *point);

static inline uint32_t iccp_grid_coordinate(const icc_grid *grid, uint32_t vertex, int32_t k)
{
    return vertex / (uint32_t)grid->stride[k] % (uint32_t)grid->shape[k];
}

/* The neighbour of a vertex one step along axis k (step +1 or -1), or ICCP_NONE at the border. */
static inline uint32_t iccp_grid_neighbour(const icc_grid *grid, uint32_t vertex, int32_t k,
                                           int32_t step)
{
    const uint32_t stride = (uint32_t)grid->stride[k];
    const uint32_t block = stride * (uint32_t)grid->shape[k];
    const uint32_t within = vertex % block;
    if (step < 0)
        return within < stride ? ICCP_NONE : vertex - stride;
    return within >= block - stride ? ICCP_NONE : vertex + stride;
}

/* Of the Kuhn triangulation: (dim + 1)!. */
static inline double iccp_simplices_at_vertex(int32_t dim)
{
    double n = 1;
    for (int32_t k = 2; k <= dim + 1; ++k)
        n *= k;
    return n;
}

#endif
