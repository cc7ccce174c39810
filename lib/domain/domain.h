/* The domain object: a validated boundary in local coordinates, and where points lie. */
#ifndef ICCP_DOMAIN_H
#define ICCP_DOMAIN_H

#include "base/env.h"
#include "geometry/band.h"
#include "geometry/crossings.h"
#include "geometry/facet_tree.h"
#include "geometry/frame.h"
#include "icc/icc.h"

#include <stdatomic.h>
#include <stdbool.h>

/* Of vertices, facets and simplices of a domain. Whatever is counted per edge is counted in 32
 * bits; geometry/buckets.c has up to about 20 of it. */
#define ICCP_MAX_COUNT ((size_t)UINT32_MAX / 64)

/* Cells of a grid or mesh along the longest side of a domain. */
enum { ICCP_MIN_CELLS = 2, ICCP_MAX_CELLS = 16384 };

struct iccp_features;
struct iccp_locator;
struct iccp_mask;
struct iccp_simplices;

struct icc_domain {
    iccp_memory memory;
    atomic_size_t references;
    int32_t dim;
    int32_t orientation; /* +1 or -1 as icc_domain_info has it, in the caller's and in local
                            coordinates alike */
    size_t n_vertices, n_facets;
    double *given;    /* n_vertices * dim, as the caller gave them; or NULL: `vertices` tell them */
    double *vertices; /* n_vertices * dim, local: what everything else works with. In 2-D the first
                         follows once more. One that belongs
                         to no facet, which polygons do not have, is a copy of one that does. */
    uint32_t *facets; /* n_facets * dim vertex indices, as given or made up. With features, those
                         that are not of the boundary follow: see domain/features.h */
    iccp_frame frame;
    double lower[ICC_MAX_DIM]; /* local bounding box */
    double upper[ICC_MAX_DIM];
    iccp_band
        band; /* points this close to the boundary are on it; `tolerance` apart, points are the
                 same */
    double measure;                 /* local length, area, volume, ... */
    iccp_facet_tree tree;           /* over local vertices; of a polygon without features without
                                       boxes, for corners */
    struct iccp_locator *locator;   /* a polygon without features, else NULL: the polygon in its
                                       order, and faster answers */
    struct iccp_features *features; /* inside a polygon, or NULL */
    struct iccp_mask *mask;         /* what the boundary was made from, or NULL */
    struct iccp_simplices *mesh;    /* a mesh of the inside, or NULL */
};

/* See icc_domain_create(); arguments have been checked for NULL and the range of dim. Facets may be
 * NULL in 2-D. */
icc_status iccp_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                              const double *vertices, size_t n_facets, const uint32_t *facets,
                              const iccp_env *env, icc_error *err);

/* ---- making one ---- */

/* A domain of that dimension with nothing in it yet; NULL if there is no memory. */
icc_domain *iccp_domain_new(int32_t dim, const iccp_memory *memory);

/* Fills in the bounding box and the band from the frame and the local vertices. */
void iccp_domain_measure_box(icc_domain *domain);

/* Takes part in keeping a domain alive, which is logically const for the one who asks. */
icc_domain *iccp_domain_retain(const icc_domain *domain);
void iccp_domain_release(icc_domain *domain);

/* The tree with its boxes, which in 2-D are made when they are first asked for; without them where
 * there is no memory. Any number of threads may ask at the same time. */
const iccp_facet_tree *iccp_domain_tree(const icc_domain *domain);

/* A vertex as the caller gave it. */
void iccp_domain_given(const icc_domain *domain, size_t vertex, double *point);

/* ICC_INSIDE, ICC_BOUNDARY or ICC_OUTSIDE for a local point, in the sense of icc_domain_locate().
 * When `facet` is not NULL the nearest facet and the barycentric coordinates of the nearest point
 * on it are written too (which costs more for points far from the boundary; for ICC_BOUNDARY only,
 * pass `boundary_only` to skip that otherwise). Bary is not negative and sums to 1; a point that is
 * a vertex gets exactly 1 and 0. */
int32_t iccp_domain_locate(const icc_domain *domain, const double *point, bool boundary_only,
                           uint32_t *facet, double *bary);

/* The local point with the given barycentric coordinates on a facet: exact at the vertices, and in
 * a coordinate that all its vertices share. */
void iccp_domain_facet_point(const icc_domain *domain, uint32_t facet, const double *bary,
                             double *point);

/* The first point of the boundary on the way from one local point to another, both included: the
 * share of the way, the facet (of several, the one with the smallest number) and the barycentric
 * coordinates there. False, and nothing written, if there is none. A segment never slips through
 * between two facets; one that runs within a facet meets only those at its ends. */
bool iccp_domain_cross(const icc_domain *domain, const double *from, const double *to,
                       double *share, uint32_t *facet, double *bary);

/* All crossings of the boundary with the line through a local point along an axis, sorted; see
 * iccp_line_crossings(). The inside lies between each even one and the next. */
size_t iccp_domain_line(const icc_domain *domain, int32_t axis, const double *point,
                        size_t capacity, iccp_line_crossing *crossings);

#endif
