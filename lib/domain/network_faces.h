/* Pieces, walks and faces of a network. */
#ifndef ICCP_NETWORK_FACES_H
#define ICCP_NETWORK_FACES_H

#include "domain/network.h"
#include "geometry/graph_sweep.h"

/* Fills in the pieces and faces of a network whose half-sides are in order. `left` and `below` are
 * what iccp_graph_sweep() found for its graph. */
icc_status iccp_network_find_faces(iccp_network *network, const icc_domain *domain,
                                   const iccp_graph *graph, const int32_t *left,
                                   const uint32_t *below, const iccp_env *env);

#endif
