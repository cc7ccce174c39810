/* The triangles of a surface while they change, none of which meets another. */
#ifndef ICCP_CLEARANCE_H
#define ICCP_CLEARANCE_H

#include "geometry/facet_tree.h"
#include "match/surface/half_edges.h"

typedef struct iccp_clearance {
    const iccp_half_edges *m; /* borrowed: the triangles, now */
    iccp_facet_tree tree;     /* boxes round what they are, and round what they have been */
    uint32_t *place;          /* by triangle: its place in the tree */
} iccp_clearance;

/* x: by vertex, borrowed. False if there is no memory; to be freed in either case. */
bool iccp_clearance_create(iccp_clearance *c, const iccp_half_edges *m, const double *x,
                           const iccp_memory *memory);
void iccp_clearance_free(iccp_clearance *c, const iccp_memory *memory);

/* Whether triangles, by their corners, that fill the room of old ones, each with corner 0 at a
 * vertex or two with a common side, have areas and meet neither one another nor any other that is
 * there, beside what they share. Exact, with vertices where they are now. */
bool iccp_clearance_allows(const iccp_clearance *c, size_t n_old, const uint32_t *old, size_t n,
                           const uint32_t (*corners)[3]);

/* Says that triangles, by their numbers, will have these corners, where they are now. */
void iccp_clearance_replace(iccp_clearance *c, size_t n, const uint32_t *numbers,
                            const uint32_t (*corners)[3]);

#endif
