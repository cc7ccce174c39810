/* Method gradient: Integral Curve Coordinates as published.
 *
 * Words of this folder, which puts the stages of the papers together. Begin with
 * chart_gradient.c.
 * - stages: grid, maximum, tree and function, as icc/stages.h offers them (gradient_stages.h).
 * - state: the tree, the function and the boundary of a chart (gradient_state.h).
 * - field: the function whose gradient lines are the chart's curves.
 * - line: a gradient line from a point down to the boundary or up to the maximum (gradient_line.h).
 * - merged, alone: a line that others have joined, and the part before they did.
 * - jet: derivatives of a point along a line, with respect to the point where it starts
 *   (gradient_jet.h).
 * - plate: a bi-Laplace function, which may be highest beside the root.
 * - parameters, digest: what a chart is rebuilt from, and a hash of its result
 *   (chart_parameters.h).
 *
 * Ways: chart_gradient.c makes charts and has the coordinates. gradient_file.h saves the
 * stages of a chart that its options do not tell. gradient_boundary.h gives values to vertices
 * outside that no tree reaches, gradient_measure.h samples what is not covered.
 *
 * Invariants: curves end at the maximum, which is the tree's root. A chart that is read from bytes
 * is made again and must have the same digest. */
#ifndef ICCP_CHART_GRADIENT_H
#define ICCP_CHART_GRADIENT_H

#include "chart/chart.h"

/* Charts of this method are saved in one of two formats. The first has the options. The second has
 * the stages: for charts of a function, and for options that the first one lacks. */
extern const iccp_chart_ops iccp_gradient_ops, iccp_gradient_stages_ops;

/* See icc_chart_create_function(). The function's grid has a domain. */
icc_status iccp_gradient_create_function(icc_chart **out, const icc_function *function,
                                         const iccp_env *env);

#endif
