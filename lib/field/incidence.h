/* Finds the simplices of the Kuhn triangulation that meet a domain, and the boundary facets near
 * each vertex of the grid. Source: docs/theory/charts-space.md, "fields on grids", step 4. */
#ifndef ICCP_INCIDENCE_H
#define ICCP_INCIDENCE_H

#include "gradient/grid/kuhn_simplex.h"

enum { ICCP_MOST_ORDERS = 720 }; /* number of orders of ICC_MAX_DIM axes */

/* The orders of the axes. A simplex at a vertex is given by an order and by the corner that the
 * vertex is. */
typedef struct iccp_orders {
    int32_t dim;
    int32_t n;                                  /* dim! */
    int8_t axis[ICCP_MOST_ORDERS][ICC_MAX_DIM]; /* in lexicographic order */
    ptrdiff_t offset[1 << ICC_MAX_DIM];         /* for each set of axes: the offset of one step
                                                   along each of them */
} iccp_orders;

void iccp_orders_init(iccp_orders *orders, const icc_grid *grid);

/* The number of an order in lexicographic sequence. */
int32_t iccp_order_rank(int32_t dim, const int8_t *axis);

typedef struct iccp_incidence {
    iccp_memory memory;
    const icc_grid *grid;     /* borrowed */
    const icc_domain *domain; /* borrowed */
    /* One bit per simplex, by the lowest corner of its cell: bit r % 32 for order number r. It is
     * set if a facet runs through the simplex. It is also set if the simplex meets the domain but
     * has no inside vertex. Beyond 4-D several simplices share a bit. */
    uint32_t *bits;
    double *normal; /* dim numbers for each facet: its inward normal of length 1 */
    /* These are there until iccp_incidence_trim(): */
    uint32_t *faces; /* by cell: bits of the faces that a facet may meet; see
                        iccp_incidence_face_bit() */
    uint32_t *first; /* n_vertices + 1: where the facets of each vertex begin in `facet` */
    uint32_t *facet; /* facets that run through simplices at each vertex, vertex by vertex */
} iccp_incidence;

/* Sets incidence->memory even on failure, so free it in any case. */
icc_status iccp_incidence_create(iccp_incidence *incidence, const icc_domain *domain,
                                 const icc_grid *grid, const iccp_env *env);
void iccp_incidence_free(iccp_incidence *incidence);

/* Frees the arrays that only the making of vectors needs. */
void iccp_incidence_trim(iccp_incidence *incidence);

/* Allocates `facet`, and computes where the facets of each vertex begin in it. `count` has the
 * number of facets at each vertex, and becomes a copy of `first` for writing. */
icc_status iccp_incidence_make_room(iccp_incidence *incidence, uint32_t *count);

/* Returns true if a facet runs through a simplex, or may do so. */
static inline bool iccp_incidence_has(const iccp_incidence *incidence, uint32_t lowest,
                                      int32_t rank)
{
    return incidence->bits[lowest] >> (rank % 32) & 1;
}

/* The bit of the face opposite to corner i of the simplex with order number r. Beyond 3-D
 * several faces share a bit. */
static inline uint32_t iccp_incidence_face_bit(int32_t dim, int32_t r, int32_t i)
{
    return (uint32_t)1 << ((r * (dim + 1) + i) % 32);
}

/* Returns true if a facet has a point in common with a simplex, or may have one. */
bool iccp_incidence_touches(const iccp_incidence *incidence, uint32_t facet, uint32_t lowest,
                            const int8_t *axis);

#endif
