/* Checks that the mesh of a map follows the network of its source. */
#ifndef ICCP_NETWORK_ROWS_H
#define ICCP_NETWORK_ROWS_H

#include "map/compatible/plmap.h"

/* *follows becomes true under four conditions:
 * - Every vertex belongs to a triangle, and exactly one vertex lies at each node.
 * - Each side of the network is a row of edges from node to node. Triangles lie on each side of the
 *   row where the domain does.
 * - The boundary of the mesh consists of the rows of the rim.
 * - Fixed vertices lie at their places in both domains, within rounding.
 *
 * The source has features. Facets of fixed vertices are valid. */
icc_status iccp_check_rows(bool *follows, const iccp_plmap *map, const icc_domain *target,
                           const iccp_env *env);

/* Whether a fixed vertex lies at its place in both domains, within rounding. */
bool iccp_plmap_is_at_place(const iccp_plmap *map, size_t v, const icc_domain *source,
                            const icc_domain *target);

#endif
