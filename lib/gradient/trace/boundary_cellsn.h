/* The boundary of a domain as a walk over a grid meets it: the cells that it runs through, so that
 * only steps there need be tested ("while point inside boundary" in Algorithm 5). Any dimension;
 * for the plane see gradient/trace/boundary_cells2.h. */
#ifndef ICCP_BOUNDARY_CELLSN_H
#define ICCP_BOUNDARY_CELLSN_H

#include "domain/domain.h"
#include "gradient/grid/lattice.h"

typedef struct iccp_boundary_cellsn {
    iccp_memory memory;
    const icc_domain *domain; /* borrowed, as is the grid */
    const icc_grid *grid;
    uint64_t *bits; /* one per grid vertex: of the cell of which it is the lowest corner */
} iccp_boundary_cellsn;

/* Where a step meets the boundary. */
typedef struct iccp_boundary_hitn {
    uint32_t facet;
    double bary[ICC_MAX_DIM];
    double share;              /* of the step, in [0, 1] */
    double point[ICC_MAX_DIM]; /* lattice coordinates */
} iccp_boundary_hitn;

/* O(n_vertices / 64 + area of the boundary in cells). cells->memory is set even on failure; free it
 * in any case. */
icc_status iccp_boundary_cellsn_create(iccp_boundary_cellsn *cells, const icc_domain *domain,
                                       const icc_grid *grid, const iccp_env *env);
void iccp_boundary_cellsn_free(iccp_boundary_cellsn *cells);

/* The first point of the boundary on a step within the cell with the given lowest corner; touching
 * counts. A walk whose steps each begin where the last one ended does not slip through. False if
 * there is none. */
bool iccp_boundary_cellsn_cross(const iccp_boundary_cellsn *cells, uint32_t cell,
                                const double *from, const double *to, iccp_boundary_hitn *hit);

/* Whether a point in lattice coordinates is on the boundary up to the domain's tolerance. */
bool iccp_boundary_cellsn_touch(const iccp_boundary_cellsn *cells, const double *point,
                                iccp_boundary_hitn *hit);

/* Across a facet, into the domain; as long as (dim - 1)! times the measure of the facet. */
void iccp_facet_inward(const icc_domain *domain, uint32_t facet, double *inward);

#endif
