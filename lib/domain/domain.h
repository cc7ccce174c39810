/* The domain object: a validated boundary in local coordinates, and point queries.
 *
 * Words of this folder. Begin with this file.
 * - domain: a bounded region that is given by its boundary, by a mask or by a mesh.
 * - given: data as the caller passed it. All other coordinates are local (geometry/frame.h).
 * - facet: a simplex of the boundary. A ridge is a face between two facets.
 * - feature: a hole, line or point inside a polygon (features.h). Its rim is the circle that a
 *   radius adds.
 * - checks: geometry/polygon_check.h checks polygons, features_check.h their features. Both ask
 *   geometry/sweep.h what touches or crosses. Of other boundaries, complex.h pairs
 *   the facets, complex_shape.c finds whether they form a manifold, simplicial.h whether they are
 *   flat, or meet, and closed_surfaces.h which surfaces in space lie in which.
 * - mask: a solid made of lattice cells (mask.h).
 * - mesh: simplices that fill the domain (geometry/simplices.h). Another mesh of the same domain is
 *   a filling.
 * - part, ring: a connected piece of a boundary; in the plane, a closed polygon.
 * - locator: the search structure of a polygon without features (geometry/locate.h).
 *
 * Ways
 * - Making: polygon_domain.h from a polygon, simplicial_domain.h from other boundaries,
 *   domain_create.c from either. features.h with features, mesh_domain.h from a mesh,
 *   mask_boundary.h from a mask, which solid.h checks and mask_repair.h repairs.
 * - Asking: iccp_domain_ops. tree_locate.h locates points, tree_cross.h crosses the boundary,
 *   scan_polygon.h and scan_surface.h scan rasters. Bytes: domain_file.h, features_file.h.
 * - Boundaries of meshes that are no domains: boundary_parts.h, in the plane by outlines.h.
 *
 * Invariants: a domain is checked when it is made and when it is read from bytes, and then never
 * changes. Only search trees are built later, on first use, and any number of threads may share
 * it. */
#ifndef ICCP_DOMAIN_H
#define ICCP_DOMAIN_H

#include "base/env.h"
#include "geometry/band.h"
#include "geometry/facet_tree.h"
#include "geometry/frame.h"
#include "icc/icc.h"

#include <stdatomic.h>
#include <stdbool.h>

/* Most vertices, facets or simplices of a domain. Entries per edge are counted in 32 bits, and
 * geometry/buckets.c has up to about 20 of them. */
#define ICCP_MAX_COUNT ((size_t)UINT32_MAX / 64)

/* Cells of a grid or mesh along the longest side of a domain. */
enum { ICCP_MIN_CELLS = 2, ICCP_MAX_CELLS = 16384 };

struct iccp_features;
struct iccp_locator;
struct iccp_mask;
struct iccp_simplices;

/* Number of vertices between progress reports of a loop. */
#define ICCP_VERTICES_PER_REPORT ((size_t)1 << 16)

/* A regular lattice of points, first axis fastest. Positions are origin + spacing * i, rounded, in
 * local coordinates. */
typedef struct iccp_raster {
    size_t shape[ICC_MAX_DIM]; /* points along each axis, at least 1 */
    double origin[ICC_MAX_DIM];
    double spacing;
} iccp_raster;

/* How a domain answers, which depends on how it keeps its boundary. Whoever makes a domain chooses
 * the table. So a program links the answers only for those domains that it makes. The functions of
 * the same names below describe the operations. */
typedef struct iccp_domain_ops {
    const iccp_facet_tree *(*tree)(const icc_domain *domain);
    int32_t (*locate)(const icc_domain *domain, const double *point, bool boundary_only,
                      uint32_t *facet, double *bary);
    bool (*cross)(const icc_domain *domain, const double *from, const double *to, double *share,
                  uint32_t *facet, double *bary);
    icc_status (*scan)(const icc_domain *domain, const iccp_raster *raster, uint8_t *inside,
                       size_t *n_inside, const iccp_env *env);
    /* Frees the tree, the locator and the features. */
    void (*clear)(icc_domain *domain);
} iccp_domain_ops;

struct icc_domain {
    iccp_memory memory;
    atomic_size_t references;
    const iccp_domain_ops *ops;
    int32_t dim;
    /* +1 or -1 as in icc_domain_info, the same in the caller's and in local coordinates */
    int32_t orientation;
    size_t n_vertices, n_facets;
    /* n_vertices * dim, as the caller gave them; NULL: computed from `vertices` */
    double *given;
    /* n_vertices * dim, local; everything else works with these. In 2-D the first vertex follows
     * once more. A vertex without facets, which polygons do not have, is a copy of a vertex with
     * facets. */
    double *vertices;
    /* n_facets * dim vertex indices, as given or generated. With features, facets that are not on
     * the boundary follow (domain/features.h). */
    uint32_t *facets;
    iccp_frame frame;
    double lower[ICC_MAX_DIM]; /* local bounding box */
    double upper[ICC_MAX_DIM];
    /* Points this close to the boundary are on it; points within its `tolerance` are equal */
    iccp_band band;
    double measure; /* local length, area, volume, ... */
    /* In space: handles of all boundary surfaces, and number of surfaces besides the outermost */
    size_t genus, n_voids;
    /* Over local vertices; of a polygon without features: for corners only, without boxes */
    iccp_facet_tree tree;
    /* The polygon in its order, for faster queries. NULL with features and beyond 2-D. */
    struct iccp_locator *locator;
    struct iccp_features *features; /* inside a polygon, or NULL */
    struct iccp_mask *mask;         /* the mask that the boundary was made from, or NULL */
    struct iccp_simplices *mesh;    /* a mesh of the inside, or NULL */
};

/* See icc_domain_create(). The caller has checked arguments for NULL and the range of dim. Facets
 * may be NULL in 2-D. */
icc_status iccp_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                              const double *vertices, size_t n_facets, const uint32_t *facets,
                              const iccp_env *env, icc_error *err);

/* Adds a reference that keeps a domain alive. To its users the domain stays const. */
icc_domain *iccp_domain_retain(const icc_domain *domain);
void iccp_domain_release(icc_domain *domain);

/* Returns a vertex as the caller gave it. */
void iccp_domain_given(const icc_domain *domain, size_t vertex, double *point);

/* Computes the local point with these barycentric coordinates on a facet. It is exact at the
 * vertices, and in a coordinate that all vertices of the facet share. */
void iccp_domain_facet_point(const icc_domain *domain, uint32_t facet, const double *bary,
                             double *point);

/* Returns ICC_ERR_UNSUPPORTED for a domain with features, and ICC_ERR_TOPOLOGY for one with handles
 * or voids. Only maps of kind mesh support these. `what` names the object that does not, such as
 * "the domain of a chart". */
icc_status iccp_domain_require_ball(const icc_domain *domain, const char *what, icc_error *err);

/* Returns ICC_ERR_TOPOLOGY for a domain with handles or voids. */
icc_status iccp_domain_refuse_holes(const icc_domain *domain, const char *what, icc_error *err);

/* ---- questions ---- */

/* Returns the tree with its boxes. In 2-D the first call makes the boxes; they are missing if there
 * is no memory. Any number of threads may call it at the same time. */
static inline const iccp_facet_tree *iccp_domain_tree(const icc_domain *domain)
{
    return domain->ops->tree(domain);
}

/* Returns ICC_INSIDE, ICC_BOUNDARY or ICC_OUTSIDE for a local point, in the sense of
 * icc_domain_locate(). If `facet` is not NULL, it also writes the nearest facet and the barycentric
 * coordinates of the nearest point on it. That takes longer for points far from the boundary; with
 * `boundary_only` it is done only for ICC_BOUNDARY. The coordinates are not negative and have sum
 * 1. A point that is a vertex gets exactly 1 and 0. */
static inline int32_t iccp_domain_locate(const icc_domain *domain, const double *point,
                                         bool boundary_only, uint32_t *facet, double *bary)
{
    return domain->ops->locate(domain, point, boundary_only, facet, bary);
}

/* Finds the first boundary point on the way from one local point to another, both included. Returns
 * its position as a share of the way, the facet (the smallest number if there are several) and the
 * barycentric coordinates there. Returns false and writes nothing if there is none. A segment never
 * slips through between two facets. If it runs within a facet, it meets only the facets at its
 * ends. */
static inline bool iccp_domain_cross(const icc_domain *domain, const double *from, const double *to,
                                     double *share, uint32_t *facet, double *bary)
{
    return domain->ops->cross(domain, from, to, share, facet, bary);
}

/* Sets inside[i], which is 0, to 1 for the points of a raster that lie strictly inside the domain,
 * and counts them. That is exact up to 3-D. The raster contains the bounding box. Returns ICC_OK,
 * ICC_ERR_MEMORY or ICC_ERR_CANCELLED. */
static inline icc_status iccp_domain_scan(const icc_domain *domain, const iccp_raster *raster,
                                          uint8_t *inside, size_t *n_inside, const iccp_env *env)
{
    return domain->ops->scan(domain, raster, inside, n_inside, env);
}

#endif
