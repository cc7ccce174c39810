/* Whether the triangles of a closed surface meet where they should not. Exact. */
#ifndef ICCP_TRIANGLES_H
#define ICCP_TRIANGLES_H

#include "base/env.h"
#include "geometry/facet_tree.h"

/* Whether two different triangles, three vertex indices each, have a point in common that does not
 * belong to the corners or the side that they share. Neither has area 0. */
bool iccp_triangles_meet(const double *vertices, const uint32_t *s, const uint32_t *t);

/* Finds a pair of triangles that meet so, pair[0] < pair[1], or two equal numbers if there is none.
 * The pair is the first in the order of the tree unless very many boxes overlap. All triangles at a
 * vertex, if more than one, must form one ring. ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. */
icc_status iccp_triangles_find(const iccp_facet_tree *tree, size_t n_vertices, uint32_t pair[2],
                               const iccp_env *env);

#endif
