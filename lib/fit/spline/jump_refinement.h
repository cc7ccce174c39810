/* Refines the mesh of a solution where its gradient jumps. A piecewise linear function is off a
 * smooth one by h^2 u'' / 8 at the middle of an edge of length h. Jumps of the gradient tell u'',
 * so no system is solved again. */
#ifndef ICCP_JUMP_REFINEMENT_H
#define ICCP_JUMP_REFINEMENT_H

#include "mesh/graded_box.h"

/* Adds vertices at the middles of edges at which the solution `u` (2 coordinates per vertex) is off
 * by more than `tolerance`. There are at most `most` vertices for each vertex of `solved`. The
 * vertices of `solved` stay the first ones, and `walls` (NULL: none), where the solution is linear,
 * stay edges. *fine_u becomes the solution at all vertices: at new
 * ones it follows cubics along their edges. The caller frees it with the memory of `env`. On
 * failure nothing stays allocated. */
icc_status iccp_jump_refine(iccp_box_mesh *fine, double **fine_u, const iccp_box_mesh *solved,
                            const double *u, const iccp_edge_set *walls, double tolerance,
                            size_t most, const iccp_env *env);

#endif
