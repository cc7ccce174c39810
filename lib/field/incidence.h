/* Which simplices of the Kuhn triangulation meet a domain, and which facets of its boundary come
 * near each vertex of the grid. */
#ifndef ICCP_INCIDENCE_H
#define ICCP_INCIDENCE_H

#include "gradient/grid/kuhn_simplex.h"

enum { ICCP_MOST_ORDERS = 720 }; /* orders of ICC_MAX_DIM axes */

/* The simplices at a vertex: each has an order of the axes and a corner that is the vertex. */
typedef struct iccp_orders {
    int32_t dim;
    int32_t n;                                  /* dim! */
    int8_t axis[ICCP_MOST_ORDERS][ICC_MAX_DIM]; /* in lexicographic order */
    ptrdiff_t offset[1 << ICC_MAX_DIM];         /* one step along each axis of a set of axes */
} iccp_orders;

void iccp_orders_init(iccp_orders *orders, const icc_grid *grid);

/* The number of an order in lexicographic order. */
int32_t iccp_order_rank(int32_t dim, const int8_t *axis);

typedef struct iccp_incidence {
    iccp_memory memory;
    const icc_grid *grid;     /* borrowed */
    const icc_domain *domain; /* borrowed */
    /* By cell (its lowest corner). Bit r % 32 stands for the simplex with order number r: it meets
     * the domain although no vertex of it is inside, or a facet runs through it. Beyond 4-D several
     * simplices share a bit. */
    uint32_t *bits;
    double *normal; /* dim for each facet: inward, length 1 */
    /* Until iccp_incidence_trim(): */
    uint32_t *faces; /* by cell, iccp_incidence_face_bit(): a facet may meet a face of that
                        simplex */
    uint32_t *first; /* n_vertices + 1: of the facets that run through simplices at each vertex */
    uint32_t *facet; /* those facets, vertex by vertex */
} iccp_incidence;

/* incidence->memory is set even on failure; free it in any case. */
icc_status iccp_incidence_create(iccp_incidence *incidence, const icc_domain *domain,
                                 const icc_grid *grid, const iccp_env *env);
void iccp_incidence_free(iccp_incidence *incidence);

/* Frees what curves do not need, but only vectors while they are made. */
void iccp_incidence_trim(iccp_incidence *incidence);

/* From how many facets to note at each vertex, to where its first is noted, in `count` too. */
icc_status iccp_incidence_make_room(iccp_incidence *incidence, uint32_t *count);

/* Whether a facet runs through a simplex, or may do so. */
static inline bool iccp_incidence_has(const iccp_incidence *incidence, uint32_t lowest,
                                      int32_t rank)
{
    return incidence->bits[lowest] >> (rank % 32) & 1;
}

/* Of the face opposite to corner i of the simplex with order number r. Beyond 3-D several share a
 * bit. */
static inline uint32_t iccp_incidence_face_bit(int32_t dim, int32_t r, int32_t i)
{
    return (uint32_t)1 << ((r * (dim + 1) + i) % 32);
}

/* Whether a facet has a point in common with a simplex, or may have one. */
bool iccp_incidence_touches(const iccp_incidence *incidence, uint32_t facet, uint32_t lowest,
                            const int8_t *axis);

#endif
