/* The triangles of a surface while they change. No two of them meet. */
#ifndef ICCP_CLEARANCE_H
#define ICCP_CLEARANCE_H

#include "geometry/facet_tree.h"
#include "match/surface/half_edges.h"

typedef struct iccp_clearance {
    const iccp_half_edges *m; /* borrowed: the present triangles */
    iccp_facet_tree tree;     /* boxes around the triangles and all that they replaced */
    uint32_t *place;          /* by triangle: its place in the tree */
} iccp_clearance;

/* x is by vertex and borrowed. False if there is no memory. Free it in any case. */
bool iccp_clearance_create(iccp_clearance *c, const iccp_half_edges *m, const double *x,
                           const iccp_memory *memory);
void iccp_clearance_free(iccp_clearance *c, const iccp_memory *memory);

/* Returns true if new triangles, given by their corners, may replace old ones. They must have
 * areas, and meet neither one another nor any other triangle except in what they share. All have
 * corner 0 at one vertex, or there are two with a common side. Exact, with vertices at their
 * present places. */
bool iccp_clearance_allows(const iccp_clearance *c, size_t n_old, const uint32_t *old, size_t n,
                           const uint32_t (*corners)[3]);

/* Gives the triangles with these numbers their new corners, at their present places. */
void iccp_clearance_replace(iccp_clearance *c, size_t n, const uint32_t *numbers,
                            const uint32_t (*corners)[3]);

#endif
