/* Gives two surfaces in space that have nothing in common the same triangles. */
#ifndef ICCP_MATCH_SURFACES_H
#define ICCP_MATCH_SURFACES_H

#include "match/match.h"

/* Fills in a match of two domains of dimension 3 without meshes. See icc_match_create(). */
icc_status iccp_match_surfaces(icc_match *match, const icc_domain *source, const icc_domain *target,
                               size_t n_landmarks, const double *landmarks,
                               const icc_match_options *options, const iccp_env *env,
                               icc_error *err);

#endif
