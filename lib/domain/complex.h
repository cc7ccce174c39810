/* The combinatorics of a boundary in 3 to 6 dimensions: checks that need no coordinates. */
#ifndef ICCP_COMPLEX_H
#define ICCP_COMPLEX_H

#include "base/env.h"

#include <stdbool.h>

/* A complex of n_facets facets with dim corners each. */
typedef struct iccp_complex {
    size_t dim, n_vertices, n_facets;
    const uint32_t *facets; /* n_facets * dim vertex numbers */
    /* n_facets * dim: across[dim f + i] is the other facet at the ridge of facet f opposite its
     * corner i */
    uint32_t *across;
} iccp_complex;

/* Returns ICC_ERR_BOUNDARY unless every index is a vertex and no facet contains a vertex twice. */
icc_status iccp_complex_check_indices(const iccp_complex *c, icc_error *err);

/* Fills in `across`, which is allocated, for a complex with checked indices. Returns
 * ICC_ERR_BOUNDARY unless every ridge belongs to exactly two facets, which run along it in opposite
 * directions. */
icc_status iccp_complex_join(iccp_complex *c, const iccp_env *env, icc_error *err);

/* Returns ICC_ERR_BOUNDARY unless the facets at each vertex are connected across ridges at it. In
 * 3-D they then form one cycle. */
icc_status iccp_complex_check_vertices(const iccp_complex *c, const iccp_env *env, icc_error *err);

/* Like iccp_complex_check_vertices(). Also returns ICC_ERR_TOPOLOGY unless all facets are
 * connected. */
icc_status iccp_complex_check_connected(const iccp_complex *c, const iccp_env *env, icc_error *err);

/* Lists the facets that are connected to facet `first`, including itself, and marks them in
 * reached[]. Returns their number. The queue has room for all facets that were not reached
 * before. */
size_t iccp_complex_flood(const iccp_complex *c, size_t first, bool *reached, uint32_t *queue);

/* Names of a facet and a ridge: "face" and "edge" in 3-D. */
const char *iccp_complex_facet(size_t dim);
const char *iccp_complex_ridge(size_t dim);

#endif
