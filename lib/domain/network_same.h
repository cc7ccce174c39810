/* Tells whether two domains have the same network, and what differs. */
#ifndef ICCP_NETWORK_SAME_H
#define ICCP_NETWORK_SAME_H

#include "domain/network.h"

/* Both domains have features of the same kinds with as many vertices. Returns ICC_ERR_TOPOLOGY
 * unless a one-to-one map can take each vertex to the vertex of the same number, and each facet
 * linearly. The message names what differs. There is such a map exactly if
 * - the same vertices coincide,
 * - sides leave each node in the same order,
 * - each piece lies on the same side of the others, and none is turned inside out. */
icc_status iccp_network_same(const icc_domain *source, const icc_domain *target, icc_error *err);

#endif
