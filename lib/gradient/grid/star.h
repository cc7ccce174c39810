/* The neighbours of a grid vertex: the vertices that share a simplex with it in the Kuhn
 * triangulation. */
#ifndef ICCP_STAR_H
#define ICCP_STAR_H

#include "gradient/grid/kuhn.h"
#include "gradient/grid/lattice.h"

typedef struct iccp_star {
    const icc_grid *grid; /* borrowed */
    iccp_kuhn kuhn;
    ptrdiff_t offset[ICCP_LINK_SIZE]; /* from a vertex to the index of each neighbour */
} iccp_star;

/* `n_asked` is about the number of calls of iccp_kuhn_regular() that will follow, for which it
 * prepares. */
void iccp_star_init(iccp_star *star, const icc_grid *grid, size_t n_asked);

/* Returns true if a neighbour of the vertex would lie outside the grid. */
bool iccp_star_is_cut(const iccp_star *star, uint32_t v);

/* Returns the neighbours that lie in the grid. */
iccp_link_set iccp_star_within(const iccp_star *star, uint32_t v);

/* Returns neighbour i, which must lie in the grid. */
static inline uint32_t iccp_star_vertex(const iccp_star *star, uint32_t v, int i)
{
    return (uint32_t)((ptrdiff_t)v + star->offset[i]);
}

/* Returns the number that a vertex has as a neighbour of its neighbour i. */
static inline int iccp_star_opposite(int i)
{
    return i ^ 1;
}

#endif
