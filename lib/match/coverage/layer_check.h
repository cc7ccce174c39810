/* Checks that the regions of a layer do not overlap. */
#ifndef ICCP_LAYER_CHECK_H
#define ICCP_LAYER_CHECK_H

#include "match/coverage/layer_graph.h"

/* Looks for sides that meet beside their ends, and for parts of the graph that lie in another
 * region than the one around them. The regions around each place agree, and half-sides are in
 * order. Returns ICC_ERR_BOUNDARY if there are any. */
icc_status iccp_layer_check(const iccp_layer_graph *graph, const iccp_env *env, icc_error *err);

#endif
