/* The boundary of a domain as a walk over a grid meets it: the cells that it runs through, so that
 * only steps there need be tested ("while point inside boundary" in Algorithm 5). Any dimension;
 * for the plane see trace/fence.h. */
#ifndef ICCP_CAGE_CELLS_H
#define ICCP_CAGE_CELLS_H

#include "domain/domain.h"
#include "grid/lattice.h"

typedef struct iccp_cage_cells {
    iccp_memory memory;
    const icc_domain *domain; /* borrowed, as is the grid */
    const icc_grid *grid;
    uint64_t *bits; /* by the lowest corner of each cell */
} iccp_cage_cells;

/* Where a step meets the boundary. */
typedef struct iccp_cage_hit {
    uint32_t facet;
    double bary[ICC_MAX_DIM];
    double share;              /* of the step, in [0, 1] */
    double point[ICC_MAX_DIM]; /* lattice coordinates */
} iccp_cage_hit;

/* O(n_vertices / 64 + area of the boundary in cells). cage->memory is set even on failure; free it
 * in any case. */
icc_status iccp_cage_cells_create(iccp_cage_cells *cage, const icc_domain *domain,
                                  const icc_grid *grid, const iccp_env *env);
void iccp_cage_cells_free(iccp_cage_cells *cage);

/* The first point of the boundary on a step within the cell with the given lowest corner; touching
 * counts. A walk whose steps each begin where the last one ended does not slip through. False if
 * there is none. */
bool iccp_cage_cells_cross(const iccp_cage_cells *cage, uint32_t cell, const double *from,
                           const double *to, iccp_cage_hit *hit);

/* Whether a point in lattice coordinates is on the boundary up to the domain's tolerance. */
bool iccp_cage_cells_touch(const iccp_cage_cells *cage, const double *point, iccp_cage_hit *hit);

/* Across a facet, into the domain; as long as (dim - 1)! times the measure of the facet. */
void iccp_cage_inward(const icc_domain *domain, uint32_t facet, double *inward);

#endif
