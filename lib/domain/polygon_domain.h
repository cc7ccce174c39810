/* Makes domains from polygons. */
#ifndef ICCP_POLYGON_DOMAIN_H
#define ICCP_POLYGON_DOMAIN_H

#include "domain/domain.h"

/* See icc_domain_create(). The caller has checked arguments for NULL. Facets may be NULL. */
icc_status iccp_polygon_domain_create(icc_domain **out, size_t n_vertices, const double *vertices,
                                      size_t n_facets, const uint32_t *facets, const iccp_env *env,
                                      icc_error *err);

#endif
