/* Where points lie with respect to a domain, by the tree of its facets. */
#ifndef ICCP_TREE_LOCATE_H
#define ICCP_TREE_LOCATE_H

#include "domain/domain.h"

/* Returns the domain's own tree, as iccp_domain_tree() does. */
const iccp_facet_tree *iccp_tree_own(const icc_domain *domain);

/* See iccp_domain_locate(). */
int32_t iccp_tree_locate(const icc_domain *domain, const double *point, bool boundary_only,
                         uint32_t *facet, double *bary);

#endif
