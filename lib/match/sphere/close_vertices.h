/* Vertices of two drawings on the sphere that differ by rounding alone. */
#ifndef ICCP_CLOSE_VERTICES_H
#define ICCP_CLOSE_VERTICES_H

#include "match/surface/half_edges.h"

/* Vertices of the first drawing that are within rounding of one of the second take its direction,
 * where every face stays positive, exactly: between equal surfaces nothing is left then that is
 * thinner than it can be told. Both are one-to-one, all of them there. */
void iccp_close_vertices_join(const iccp_half_edges *const m[2], double *const directions[2]);

#endif
