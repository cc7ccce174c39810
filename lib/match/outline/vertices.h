/* Refines a pairing of two outlines so that it passes through pairs of their vertices. */
#ifndef ICCP_VERTICES_H
#define ICCP_VERTICES_H

#include "match/outline/elastic.h"

/* Refines a pairing that passes through all landmarks (n_landmarks pairs of shares) to pairs of
 * vertices close to it. If there are none, or one outline has few vertices, the pairing stays.
 * Allocates `knots->knot` anew. */
icc_status iccp_pair_vertices(iccp_pairing_knots *knots, const iccp_outline *source,
                              const iccp_outline *target, size_t n_landmarks,
                              const double *landmarks, const iccp_env *env);

#endif
