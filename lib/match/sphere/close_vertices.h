/* Joins vertices of two drawings on the sphere that differ by rounding alone. */
#ifndef ICCP_CLOSE_VERTICES_H
#define ICCP_CLOSE_VERTICES_H

#include "match/surface/half_edges.h"

/* Moves a vertex of the first drawing to a vertex of the second if they differ by rounding alone
 * and all faces stay positive, exactly. Between equal surfaces this removes slivers too thin to be
 * resolved. Both drawings are one-to-one, and all their vertices are present. */
void iccp_close_vertices_join(const iccp_half_edges *const m[2], double *const directions[2]);

#endif
