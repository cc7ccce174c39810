/* The vertices of a grid that share a simplex with a given one in the Kuhn triangulation. */
#ifndef ICCP_STAR_H
#define ICCP_STAR_H

#include "gradient/grid/kuhn.h"
#include "gradient/grid/lattice.h"

typedef struct iccp_star {
    const icc_grid *grid; /* borrowed */
    iccp_kuhn kuhn;
    ptrdiff_t offset[ICCP_LINK_SIZE]; /* to the index of each neighbour */
} iccp_star;

/* `n_asked`: about how often iccp_kuhn_regular() will be asked for; it is made ready
 * accordingly. */
void iccp_star_init(iccp_star *star, const icc_grid *grid, size_t n_asked);

/* Whether some neighbour of a vertex would lie beyond the grid. */
bool iccp_star_is_cut(const iccp_star *star, uint32_t v);

/* The neighbours that lie in the grid. */
iccp_link_set iccp_star_within(const iccp_star *star, uint32_t v);

/* Neighbour i, if it lies in the grid. */
static inline uint32_t iccp_star_vertex(const iccp_star *star, uint32_t v, int i)
{
    return (uint32_t)((ptrdiff_t)v + star->offset[i]);
}

/* The number that a vertex has as a neighbour of its neighbour i. */
static inline int iccp_star_opposite(int i)
{
    return i ^ 1;
}

#endif
