/* What all ways of making a domain share. */
#ifndef ICCP_DOMAIN_MAKE_H
#define ICCP_DOMAIN_MAKE_H

#include "domain/domain.h"

/* Returns an empty domain of this dimension; NULL if there is no memory. */
icc_domain *iccp_domain_new(int32_t dim, const iccp_domain_ops *ops, const iccp_memory *memory);

/* Makes room for the local vertices, and copies the facets. If `facets` is NULL, facet i joins
 * vertices i and i + 1 of a polygon. */
icc_status iccp_domain_copy_facets(icc_domain *domain, size_t n_facets, const uint32_t *facets,
                                   icc_error *err);

/* Fills in the bounding box and the band from the frame and the local vertices. */
void iccp_domain_measure_box(icc_domain *domain);

#endif
