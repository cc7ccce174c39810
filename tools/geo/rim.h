/* The rim of a domain in the plane: the facets that have the domain on one side only. Sides of
 * regions inside are facets too, and several rings may have the same side. */
#ifndef RIM_H
#define RIM_H

#include <icc/icc.h>
#include <stddef.h>
#include <stdint.h>

#define NOT_ON_RIM UINT32_MAX

typedef struct rim {
    size_t n;
    uint32_t *facets; /* n numbers, each side of the rim once */
    uint32_t
        *place; /* of each facet: 2 k if it is side k of the rim, 2 k + 1 if it is the same side
                         and runs the other way, or NOT_ON_RIM */
} rim;

/* Finds the rim of a domain with n_facets facets. Free it in any case. */
icc_status rim_find(rim *out, const icc_domain *domain, size_t n_facets, const double *vertices,
                    const uint32_t *facets, const icc_env *env);
void rim_free(rim *r);

#endif
