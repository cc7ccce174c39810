/* Tests exactly whether triangles of a closed surface intersect. */
#ifndef ICCP_TRIANGLES_H
#define ICCP_TRIANGLES_H

#include "base/env.h"
#include "geometry/facet_tree.h"

/* Returns true if the closed segment from p to q, which may be equal, meets the closed triangle. It
 * has an area. */
bool iccp_triangle_meets(const double *const *triangle, const double *p, const double *q);

/* Returns true if two different triangles, given by three vertex indices each, have a common point
 * outside their common corners or side. Neither has area 0. */
bool iccp_triangles_meet(const double *vertices, const uint32_t *s, const uint32_t *t);

/* Finds an intersecting pair of triangles, pair[0] < pair[1], or two equal numbers if there is
 * none. The pair is the first in the order of the tree unless very many boxes overlap. All
 * triangles at a vertex must form one ring. Returns ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. */
icc_status iccp_triangles_find(const iccp_facet_tree *tree, size_t n_vertices, uint32_t pair[2],
                               const iccp_env *env);

#endif
