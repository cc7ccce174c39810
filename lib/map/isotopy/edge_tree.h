/* Trees of straight cuts. */
#ifndef ICCP_EDGE_TREE_H
#define ICCP_EDGE_TREE_H

#include "map/isotopy/cuts.h"

/* Finds the shortest tree of edges of a mesh that joins all components, or one tree for each part
 * of the domain. The vertices of `mesh` are those of the domains, or UINT32_MAX for others, and
 * lengths are those in the source. The cuts have no bends. ICC_ERR_TOPOLOGY if the mesh does not
 * join the components that belong together. The caller frees the cuts on failure, too.
 * O(n log n). */
icc_status iccp_edge_tree(iccp_cuts *tree, const iccp_domain_pair *domains,
                          const iccp_corners *mesh, const iccp_env *env);

#endif
