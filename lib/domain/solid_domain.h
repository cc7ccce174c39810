/* Makes solids with features inside: voids, inner surfaces, lines and points. features.h says how
 * they are numbered. */
#ifndef ICCP_SOLID_DOMAIN_H
#define ICCP_SOLID_DOMAIN_H

#include "domain/features.h"

/* An outer surface, in its own numbers. */
typedef struct iccp_outer {
    size_t n_vertices, n_facets;
    const double *vertices;
    const uint32_t *facets;
} iccp_outer;

/* See icc_domain_create_solid(). The caller has checked pointers, kinds and counts. There is at
 * least one feature. */
icc_status iccp_domain_create_solid(icc_domain **out, const iccp_outer *outer, size_t n_features,
                                    const icc_feature *features, const iccp_env *env,
                                    icc_error *err);

/* Copies a solid with features, without its mesh. Returns ICC_OK or ICC_ERR_MEMORY. */
icc_status iccp_solid_domain_copy(icc_domain **out, const icc_domain *solid,
                                  const iccp_memory *memory);

#endif
