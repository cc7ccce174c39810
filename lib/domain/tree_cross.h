/* Where segments and lines cross a domain's boundary, by the tree of its facets. */
#ifndef ICCP_TREE_CROSS_H
#define ICCP_TREE_CROSS_H

#include "domain/domain.h"
#include "geometry/crossings.h"

/* See iccp_domain_cross(). */
bool iccp_tree_cross(const icc_domain *domain, const double *from, const double *to, double *share,
                     uint32_t *facet, double *bary);

/* Finds all crossings of the boundary with the line through a local point along an axis, sorted;
 * see iccp_line_crossings(). The inside lies between each even one and the next. */
size_t iccp_tree_line(const icc_domain *domain, int32_t axis, const double *point, size_t capacity,
                      iccp_line_crossing *crossings);

#endif
