/* Reads cuts that the caller gives as ties. */
#ifndef ICCP_TIES_H
#define ICCP_TIES_H

#include "map/isotopy/cuts.h"

/* Turns the caller's ties into cuts. ties[0].size is the distance between two ties in the array.
 * All checks are exact.
 *
 * ICC_ERR_ARGUMENT if bends are missing or not finite. ICC_ERR_TOPOLOGY if the ties are not a tree
 * of all components, or meet a wall or one another, or leave a vertex in different orders in the
 * two domains. The error names the tie and, if it matters, the side. */
icc_status iccp_ties_read(iccp_cuts *cuts, const iccp_domain_pair *domains, size_t n,
                          const icc_tie *ties, const iccp_env *env, icc_error *err);

#endif
