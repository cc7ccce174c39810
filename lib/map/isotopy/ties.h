/* Cuts that the caller gives. */
#ifndef ICCP_TIES_H
#define ICCP_TIES_H

#include "map/isotopy/cuts.h"

/* The caller's ties, of which ties[0].size tells how far they are apart, as cuts. Exact.
 * ICC_ERR_ARGUMENT for bends that are missing or not finite; ICC_ERR_TOPOLOGY when they are not a
 * tree of all components, meet a wall or one another, or leave a vertex in different order in the
 * two domains. The error names the tie, and the side where there is one. */
icc_status iccp_ties_read(iccp_cuts *cuts, const iccp_scene *scene, size_t n, const icc_tie *ties,
                          const iccp_env *env, icc_error *err);

#endif
