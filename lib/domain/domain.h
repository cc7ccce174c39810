/* The domain object: a validated boundary in local coordinates, and where points lie. */
#ifndef ICCP_DOMAIN_H
#define ICCP_DOMAIN_H

#include "base/env.h"
#include "domain/frame.h"
#include "icc/icc.h"

#include <stdatomic.h>
#include <stdbool.h>

struct iccp_locator;
struct iccp_mask;

struct icc_domain {
    iccp_memory memory;
    atomic_size_t references;
    int32_t dim;
    int32_t orientation; /* +1 counter-clockwise, -1 clockwise, in the caller's and in local
                                     coordinates alike */
    size_t n_vertices, n_facets;
    double *given;    /* n_vertices * dim, as the caller gave them */
    double *vertices; /* n_vertices * dim, local: what everything else works with */
    uint32_t *facets; /* n_facets * dim vertex indices, as given or made up */
    iccp_frame frame;
    double lower[ICC_MAX_DIM]; /* local bounding box */
    double upper[ICC_MAX_DIM];
    double tolerance; /* local: 1e-14 of the longest side of the bounding box; points
                                     this close to the boundary are on it */
    double measure;   /* local area */
    struct iccp_locator *locator;
    struct iccp_mask *mask; /* what the boundary was made from, or NULL */
};

/* See icc_domain_create(); arguments have been checked for NULL and dim == 2. */
icc_status iccp_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                              const double *vertices, size_t n_facets, const uint32_t *facets,
                              const iccp_env *env, icc_error *err);

/* Takes part in keeping a domain alive, which is logically const for the one who asks. */
icc_domain *iccp_domain_retain(const icc_domain *domain);
void iccp_domain_release(icc_domain *domain);

/* ICC_INSIDE, ICC_BOUNDARY or ICC_OUTSIDE for a local point, exactly up to `tolerance`. When `facet`
 * is not NULL the nearest facet and the barycentric coordinates of the nearest point on it are
 * written too (which costs more for points far from the boundary; for ICC_BOUNDARY only, pass
 * `boundary_only` to skip that otherwise). Bary is not negative and sums to 1; a point that is a
 * vertex gets exactly 1 and 0. */
int32_t iccp_domain_locate(const icc_domain *domain, const double *point, bool boundary_only,
                           uint32_t *facet, double *bary);

/* The local point with the given barycentric coordinates on a facet: exact at the vertices, and in a
 * coordinate that both ends share. */
void iccp_domain_facet_point(const icc_domain *domain, uint32_t facet, const double *bary,
                             double *point);

#endif
