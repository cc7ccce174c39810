/* The polygon as a walk over the grid meets it: for every grid cell, the edges that pass through
 * it. So a walk tests a few edges in each cell instead of the whole boundary ("while point inside
 * boundary" in Algorithm 5). */
#ifndef ICCP_BOUNDARY_CELLS2_H
#define ICCP_BOUNDARY_CELLS2_H

#include "gradient/grid/lattice.h"

typedef struct iccp_boundary_cells2 {
    iccp_memory memory;
    size_t nx, ny;        /* number of cells along the axes */
    double *vertices;     /* vertices of the domain, in lattice coordinates */
    const uint32_t *ends; /* 2 * facet + end: the domain's facets; borrowed */
    size_t *first;        /* nx * ny + 1: where each cell's edges begin in `edges` */
    uint32_t *edges;      /* facets, cell by cell */
} iccp_boundary_cells2;

/* Where a step meets the boundary. */
typedef struct iccp_boundary_hit2 {
    uint32_t facet;
    double share; /* position on the step, as a share in [0, 1] */
    double along; /* position on the facet from its first to its second vertex, in [0, 1] */
} iccp_boundary_hit2;

/* Fills in the edges of each cell. O(n + cells + edge pieces) time and memory. */
icc_status iccp_boundary_cells2_create(iccp_boundary_cells2 *cells, const icc_domain *domain,
                                       const icc_grid *grid, const iccp_env *env);
void iccp_boundary_cells2_free(iccp_boundary_cells2 *cells);

/* Finds the first edge that the step from p to q within cell (i, j) meets or touches. The decision
 * is exact for the rounded vertices. Returns false if there is none. */
bool iccp_boundary_cells2_first(const iccp_boundary_cells2 *cells, size_t i, size_t j,
                                const double p[2], const double q[2], iccp_boundary_hit2 *hit);

#endif
