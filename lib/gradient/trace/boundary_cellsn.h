/* The boundary of a domain as a walk over a grid meets it: the cells that it passes through. So
 * only steps in these need be tested ("while point inside boundary" in Algorithm 5). Any dimension;
 * for the plane see gradient/trace/boundary_cells2.h. */
#ifndef ICCP_BOUNDARY_CELLSN_H
#define ICCP_BOUNDARY_CELLSN_H

#include "domain/domain.h"
#include "gradient/grid/lattice.h"

typedef struct iccp_boundary_cellsn {
    iccp_memory memory;
    const icc_domain *domain; /* borrowed, like the grid */
    const icc_grid *grid;
    uint64_t *bits; /* one bit per grid vertex, for the cell whose lowest corner it is */
} iccp_boundary_cellsn;

/* Where a step meets the boundary. */
typedef struct iccp_boundary_hitn {
    uint32_t facet;
    double bary[ICC_MAX_DIM];
    double share;              /* position on the step, as a share in [0, 1] */
    double point[ICC_MAX_DIM]; /* lattice coordinates */
} iccp_boundary_hitn;

/* Finds the cells. O(n_vertices / 64 + area of the boundary in cells). cells->memory is set even on
 * failure, and `cells` must always be freed. */
icc_status iccp_boundary_cellsn_create(iccp_boundary_cellsn *cells, const icc_domain *domain,
                                       const icc_grid *grid, const iccp_env *env);
void iccp_boundary_cellsn_free(iccp_boundary_cellsn *cells);

/* Finds the first boundary point on a step within the cell with the given lowest corner. Touching
 * counts. A walk whose steps each begin where the last one ended does not slip through. Returns
 * false if there is none. */
bool iccp_boundary_cellsn_cross(const iccp_boundary_cellsn *cells, uint32_t cell,
                                const double *from, const double *to, iccp_boundary_hitn *hit);

/* Returns true if a point in lattice coordinates is on the boundary up to the domain's
 * tolerance. */
bool iccp_boundary_cellsn_touch(const iccp_boundary_cellsn *cells, const double *point,
                                iccp_boundary_hitn *hit);

/* Computes the normal of a facet that leads into the domain. Its length is (dim - 1)! times the
 * measure of the facet. */
void iccp_facet_inward(const icc_domain *domain, uint32_t facet, double *inward);

#endif
