/* The state of a gradient chart, shared by the chart and its measures. */
#ifndef ICCP_GRADIENT_STATE_H
#define ICCP_GRADIENT_STATE_H

#include "gradient/coordinates/chart_parameters.h"
#include "gradient/trace/boundary_cellsn.h"
#include "gradient/trace/walk2.h"

typedef struct iccp_gradient_state {
    iccp_chart_parameters parameters;
    icc_tree *tree;
    icc_function *field;
    /* The root that the caller asked for; the tree's root may have moved */
    uint32_t chosen;
    iccp_boundary_cells2 cells2; /* the boundary as walks meet it: in the plane */
    iccp_boundary_cellsn cellsn; /* in other dimensions */
} iccp_gradient_state;

static inline void iccp_gradient_to_lattice(const iccp_gradient_state *state, const double *local,
                                            double *lattice)
{
    const icc_grid *grid = state->tree->grid;
    for (int k = 0; k < grid->dim; ++k)
        lattice[k] = (local[k] - grid->origin[k]) / grid->spacing;
}

static inline void iccp_gradient_to_local(const iccp_gradient_state *state, const double *lattice,
                                          double *local)
{
    const icc_grid *grid = state->tree->grid;
    for (int k = 0; k < grid->dim; ++k)
        local[k] = lattice[k] * grid->spacing + grid->origin[k];
}

/* Finds the cells that the boundary passes through. The tree is set, and its grid has a domain. */
icc_status iccp_gradient_meet_boundary(iccp_gradient_state *state, const iccp_env *env);

/* Frees everything but the struct itself, which may be all zero. */
void iccp_gradient_state_clear(iccp_gradient_state *state);

#endif
