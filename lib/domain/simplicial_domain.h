/* Makes domains from boundaries that consist of simplices: intervals, surfaces, and so on. */
#ifndef ICCP_SIMPLICIAL_DOMAIN_H
#define ICCP_SIMPLICIAL_DOMAIN_H

#include "domain/domain.h"

/* See icc_domain_create(). The dimension is not 2, and the caller has checked it and the arguments
 * for NULL. */
icc_status iccp_simplicial_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                                         const double *vertices, size_t n_facets,
                                         const uint32_t *facets, const iccp_env *env,
                                         icc_error *err);

#endif
