/* Draws paths as polylines, given only the edges that they cross. The paths must not cross one
 * another. */
#ifndef ICCP_DRAW_CROSSINGS_H
#define ICCP_DRAW_CROSSINGS_H

#include "map/isotopy/crossing_sequence.h"

/* Draws a polyline for each sequence in one of the two bare triangulations, ends included. The
 * polylines have few bends and meet only at their ends. The sequences must belong to paths that can
 * be drawn without meeting. `line` has one empty polyline for each sequence. The caller frees them
 * even after an error. About n log n for n crossings, unless paths run side by side for long. */
icc_status iccp_draw_crossings(iccp_polyline *line, const iccp_sequences *sequences,
                               const iccp_domain_pair *domains, int side,
                               const iccp_triangulation *triangulation, const iccp_env *env);

#endif
