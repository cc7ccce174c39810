/* Holes, lines and points inside a polygon.
 *
 * A domain with features has the vertices of its outer ring first, then those of the features in
 * their order. Its facets, the boundary, are the edges of the outer ring, then those of the holes.
 * Behind them, in domain->facets too, follow the segments of the lines, and for each point a facet
 * both ends of which are that point: iccp_domain_facet_point() finds places on all of them. */
#ifndef ICCP_FEATURES_H
#define ICCP_FEATURES_H

#include "domain/domain.h"

typedef struct iccp_feature {
    int32_t kind;         /* ICC_FEATURE_* */
    int32_t orientation;  /* of a hole: +1 where it is listed counter-clockwise, else -1; or 0 */
    uint32_t first, n;    /* its vertices */
    uint32_t first_facet; /* the facet from its first vertex to the next; of a point, its own */
    uint32_t n_facets;
    uint32_t rim_of; /* of the circle round a point with a radius: the point; else UINT32_MAX */
} iccp_feature;

typedef struct iccp_features {
    size_t n, n_outer; /* features; vertices and facets of the outer ring */
    size_t n_holes, n_lines, n_points;
    size_t n_places; /* all facets, those of lines and points included */
    iccp_feature *item;
} iccp_features;

/* Whether a feature of some kind may have n vertices; false for other kinds. */
static inline bool iccp_feature_allows(int32_t kind, size_t n)
{
    return (kind == ICC_FEATURE_HOLE && n >= 3) || (kind == ICC_FEATURE_LINE && n >= 2) ||
           (kind == ICC_FEATURE_POINT && n == 1);
}

/* Vertices of the line round a point with a radius. */
enum { ICCP_RIM = 16 };

/* See icc_domain_create_features(); pointers, kinds, counts and radii have been checked. */
icc_status iccp_domain_create_features(icc_domain **out, size_t n_outer, const double *outer,
                                       size_t n_features, const icc_feature *features,
                                       const iccp_env *env, icc_error *err);

/* ICC_ERR_UNSUPPORTED for a domain with features, which only maps of kind mesh can have: `what`
 * cannot, such as "a chart". */
icc_status iccp_features_refuse(const icc_domain *domain, const char *what, icc_error *err);

/* Accepts NULL. */
void iccp_features_free(iccp_features *features, const iccp_memory *memory);

#endif
