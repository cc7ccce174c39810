/* Finds lines and points of a solid that meet a surface, a line or a point. */
#ifndef ICCP_WIRES_H
#define ICCP_WIRES_H

#include "domain/features.h"

/* A segment of a line, or a point, and what it meets. */
typedef struct iccp_contact {
    uint32_t wire[2];  /* its ends, equal for a point; UINT32_MAX: nothing meets */
    uint32_t facet;    /* the facet that it meets, or UINT32_MAX */
    uint32_t other[2]; /* otherwise: the ends of the segment or point that it meets */
} iccp_contact;

/* Finds the first contact, in the order of the features. The tree is over all facets of the solid.
 * Exact. Returns ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. */
icc_status iccp_wires_find(iccp_contact *contact, const icc_domain *domain,
                           const iccp_facet_tree *facets, const iccp_env *env);

#endif
