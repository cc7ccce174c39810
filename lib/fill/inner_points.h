/* Adds inner points where tetrahedra are too slender or too large for their surroundings. */
#ifndef ICCP_INNER_POINTS_H
#define ICCP_INNER_POINTS_H

#include "fill/constraints.h"
#include "fill/fill_options.h"

/* Inserts points until every circumradius is at most `ratio` times the tetrahedron's shortest edge,
 * or times the local edge length if that is longer. Puts no points close to the surface, and no
 * more than `max_points`. */
icc_status iccp_tets_refine(iccp_tets *m, const iccp_constraints *s,
                            const iccp_fill_options *options, const iccp_env *env, icc_error *err);

#endif
