/* The grid object: a regular n-D lattice whose vertices are inside or outside. Only the code that
 * makes a grid from a domain (rasterise.h) knows what the domain is.
 *
 * Words of this folder, stage 1 of the papers. Begin with this file.
 * - vertex: a lattice point, numbered along the first axis first. Its neighbours along an axis
 *   differ by one step.
 * - inside: vertices strictly inside the domain. All others are outside.
 * - cell: a cube between lattice points. The Kuhn triangulation cuts it into simplices (kuhn.h,
 *   kuhn_simplex.h).
 * - star, link: the simplices at a vertex, and the neighbours that they contain (star.h, kuhn.h).
 * - regular: a set of neighbours is regular if it and its complement are contractible in the link.
 * - critical vertex: a vertex whose higher neighbours are not regular (critical_count.h).
 * - grassfire: the choice of the maximum farthest from the outside (grassfire.h).
 * - piece: a set of inside vertices connected along the axes. Only the largest is kept (pieces.h).
 *
 * Ways: rasterise.h makes a grid from a domain, pieces.h keeps the largest piece, grassfire.h
 * chooses the maximum, refine.h halves the spacing.
 *
 * Invariants: a grid never changes after it is made, and objects share it by reference counts.
 * `n_inside` counts `inside`. Positions are origin + spacing * i, rounded, and inside is exact for
 * these. */
#ifndef ICCP_LATTICE_H
#define ICCP_LATTICE_H

#include "base/env.h"
#include "domain/domain.h"
#include "icc/stages.h"

#include <stdatomic.h>
#include <stdbool.h>

/* Stands for no vertex. */
#define ICCP_NONE UINT32_MAX

/* Most vertices of a grid. */
#define ICCP_MAX_VERTICES ((size_t)1 << 28)

struct icc_grid {
    iccp_memory memory;
    atomic_size_t references;
    int32_t dim;
    size_t shape[ICC_MAX_DIM];
    size_t stride[ICC_MAX_DIM]; /* stride[0] = 1; index = sum of i_k * stride[k] */
    double origin[ICC_MAX_DIM]; /* local position of vertex 0 */
    double spacing;             /* in local coordinates */
    iccp_frame frame;           /* of the domain, or the identity for masks */
    /* Cells along the longest side of a domain; 0 for masks of vertices */
    int32_t cells;
    icc_domain *domain; /* the domain whose inside is described, or NULL */
    bool is_restricted; /* vertices were moved to the outside: iccp_grid_restrict() */
    size_t n_vertices, n_inside;
    size_t n_stray;  /* number of vertices that were inside and have been removed */
    uint8_t *inside; /* 1 or 0 */
};

/* Makes a lattice whose vertices are all outside, with origin 0, spacing 1 and the identity frame.
 * The shape has no zeros. Returns ICC_ERR_RESOLUTION beyond ICCP_MAX_VERTICES. */
icc_status iccp_grid_new(icc_grid **out, int32_t dim, const size_t *shape, const iccp_env *env,
                         icc_error *err);

/* See icc_grid_create_mask(). */
icc_status iccp_grid_create_mask(icc_grid **out, int32_t dim, const size_t *shape,
                                 const uint8_t *inside, const iccp_env *env, icc_error *err);

/* See icc_grid_restrict(). */
icc_status iccp_grid_restrict(icc_grid **out, const icc_grid *grid, const uint8_t *keep,
                              const iccp_env *env, icc_error *err);

/* Adds a reference that keeps a grid alive. To its users the grid stays const. */
icc_grid *iccp_grid_retain(const icc_grid *grid);
void iccp_grid_release(icc_grid *grid);

/* Returns the inside vertex nearest to a local point, the smallest index if there are several.
 * ICCP_NONE if there is none. */
uint32_t iccp_grid_nearest(const icc_grid *grid, const double *point);

static inline uint32_t iccp_grid_coordinate(const icc_grid *grid, uint32_t vertex, int32_t k)
{
    return vertex / (uint32_t)grid->stride[k] % (uint32_t)grid->shape[k];
}

/* Returns the neighbour of a vertex one step along axis k (step +1 or -1), or ICCP_NONE at the
 * border. */
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

/* Number of simplices of the Kuhn triangulation at a vertex: (dim + 1)!. */
static inline double iccp_simplices_at_vertex(int32_t dim)
{
    double n = 1;
    for (int32_t k = 2; k <= dim + 1; ++k)
        n *= k;
    return n;
}

#endif
