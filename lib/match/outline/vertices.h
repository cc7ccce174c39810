/* A pairing of two outlines that goes through pairs of their vertices. */
#ifndef ICCP_VERTICES_H
#define ICCP_VERTICES_H

#include "match/outline/elastic.h"

/* Refines a pairing, which passes through all landmarks (n_landmarks pairs of shares), to pairs of
 * vertices near it; where there are none, or one outline has few vertices, it stays. `knots->knot`
 * is allocated anew. */
icc_status iccp_pair_vertices(iccp_pairing_knots *knots, const iccp_outline *source,
                              const iccp_outline *target, size_t n_landmarks,
                              const double *landmarks, const iccp_env *env);

#endif
