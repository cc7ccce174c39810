/* Holes, regions, lines and points inside a polygon or a solid.
 *
 * In a polygon with features, the vertices of the outer ring come first, then those of the features
 * in their order. The facets of rings come first: the edges of the outer ring, then those of the
 * holes, then those of the regions. The array domain->facets continues with the segments of lines,
 * and a facet for each point, with both ends at that point. So iccp_domain_facet_point() finds
 * places on all of them. Which places and facets coincide, the network tells (network.h).
 *
 * In a solid with features, the vertices of the outer surface come first, then those of the
 * features in their order. The triangles of the outer surface come first, then those of the holes
 * (voids), then those of the regions. domain->n_facets counts only the first two, which are the
 * boundary; n_places counts all. Triangles are listed as they were given. Lines and points have no
 * facets; vertex first + i of a line is joined to vertex first + i + 1. There is no network,
 * because nothing coincides. Every vertex is used.
 *
 * Regions of a solid have numbers. Number 0 is the part at the outer surface. Number 1 + k is the
 * inside of the k-th region among the features, without the regions in it. */
#ifndef ICCP_FEATURES_H
#define ICCP_FEATURES_H

#include "domain/domain.h"

typedef struct iccp_feature {
    int32_t kind;        /* ICC_FEATURE_* */
    int32_t orientation; /* +1 for a ring listed counter-clockwise, -1 for another ring; else 0 */
    uint32_t first, n;   /* its vertices */
    /* The facet from its first vertex to the next; of a point: its only facet */
    uint32_t first_facet;
    uint32_t n_facets;
    uint32_t rim_of; /* of the circle around a point with a radius: that point; else UINT32_MAX */
    /* In a solid: number of the region in which it lies; handles of a surface */
    uint32_t around, genus;
} iccp_feature;

/* In a solid: the side of a facet where there is no domain. */
#define ICCP_NO_REGION UINT32_MAX

typedef struct iccp_features {
    size_t n, n_outer;     /* number of features; vertices of the outer ring or surface */
    size_t n_outer_facets; /* facets of the outer ring or surface */
    bool in_space;         /* the features of a solid */
    size_t n_holes, n_lines, n_points, n_regions;
    size_t n_places; /* number of all facets, including those of lines and points */
    iccp_feature *item;
    struct iccp_network *network; /* of a polygon: network.h */
    /* A solid has two region numbers for each of its n_places facets. sides[2 f] is the region in
     * front of facet f, where its corners appear counter-clockwise. sides[2 f + 1] lies behind */
    uint32_t *sides;
} iccp_features;

/* Returns true for features that are closed polygons. */
static inline bool iccp_feature_is_ring(int32_t kind)
{
    return kind == ICC_FEATURE_HOLE || kind == ICC_FEATURE_REGION;
}

/* Returns true if a feature of this kind may have n vertices, in 2-D or 3-D. Returns false for
 * unknown kinds. */
static inline bool iccp_feature_allows(int32_t dim, int32_t kind, size_t n)
{
    return (iccp_feature_is_ring(kind) && n >= (dim == 2 ? 3 : 4)) ||
           (kind == ICC_FEATURE_LINE && n >= 2) || (kind == ICC_FEATURE_POINT && n == 1);
}

/* Returns the feature that a vertex belongs to, or UINT32_MAX for the outer ring or surface. */
static inline uint32_t iccp_feature_of_vertex(const iccp_features *features, uint32_t vertex)
{
    size_t low = 0, high = features->n + 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (features->item[middle - 1].first <= vertex)
            low = middle;
        else
            high = middle;
    }
    return low > 0 ? (uint32_t)low - 1 : UINT32_MAX;
}

/* Returns the number of facets that icc_domain_get_boundary() lists. */
static inline size_t iccp_domain_n_listed(const icc_domain *domain)
{
    return domain->features != NULL && domain->features->in_space ? domain->features->n_places
                                                                  : domain->n_facets;
}

/* Number of vertices of the line around a point with a radius. */
enum { ICCP_RIM = 16 };

/* See icc_domain_create_features(). The caller has checked pointers, kinds, counts and radii. */
icc_status iccp_domain_create_features(icc_domain **out, size_t n_outer, const double *outer,
                                       size_t n_features, const icc_feature *features,
                                       const iccp_env *env, icc_error *err);

#endif
