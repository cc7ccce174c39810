/* All facets of the Kuhn triangulation that have the same lowest corner, and the two simplices that
 * share each. Any dimension. */
#ifndef ICCP_KUHN_FACETS_H
#define ICCP_KUHN_FACETS_H

#include "gradient/grid/lattice.h"

/* Facets with the same apexes: the two corners that the simplices of a facet do not share. `before`
 * and `after` are the neighbours of each apex in the order of the corners of its simplex, the same
 * for all these facets. At an end of that order, they are the apex itself.
 *
 * All are slots, which stand for vertices around the lowest corner. Slot c < 2^dim is the corner of
 * the cell that is one step up along each axis whose bit is set in c. Slot 2^dim + k is one step
 * down along axis k. */
typedef struct iccp_facet_group {
    uint8_t apex[2], before[2], after[2];
    size_t first, end; /* these facets, in iccp_kuhn_facets */
} iccp_facet_group;

typedef struct iccp_kuhn_facets {
    size_t n, n_groups;
    iccp_facet_group *group;
    uint64_t *facet; /* bit c is set if slot c is a corner. Their order is that of the corners */
} iccp_kuhn_facets;

/* Makes dim! (dim + 1) / 2 facets. First come those between two cells. Free them also after
 * ICC_ERR_MEMORY. */
icc_status iccp_kuhn_facets_create(iccp_kuhn_facets *facets, int32_t dim,
                                   const iccp_memory *memory);
void iccp_kuhn_facets_free(iccp_kuhn_facets *facets, const iccp_memory *memory);

#endif
