/* What is to be deformed: regions with walls between them, and curves. All points are the
 * caller's. */
#ifndef ICCP_SHAPE_H
#define ICCP_SHAPE_H

#include "domain/domain.h"
#include "icc/kernel.h"
#include "kernel/sampling/segment_graph.h"

#define ICCP_NOWHERE UINT32_MAX

struct icc_shape {
    iccp_memory memory;
    atomic_size_t references;
    size_t dim, n_regions, n_vertices, n_segments;
    icc_domain **regions;      /* n_regions, retained */
    double *vertices;          /* of the curves: n_vertices * dim, the caller's coordinates */
    uint32_t *segments;        /* n_segments * 2 of these vertices */
    double lower[3], upper[3]; /* box around everything */
    iccp_frame frame; /* of everything together: what follows is in its local coordinates */
    double tolerance; /* points this close to a wall are on it */
    size_t n_walled;  /* vertices of walls */
    double *local;    /* vertices of all walls, region after region, then those of the curves */
    uint32_t *facets, *owner;      /* walls: dim of the local vertices each; and the region of
                                      each */
    uint32_t *sticks;              /* the segments, as facets (3-D: with the second end twice) */
    iccp_facet_tree walls, curves; /* empty (n == 0) without */
    iccp_segment_graph graph;      /* of the segments */
};

/* See icc_shape_create(); arguments have been checked for NULL and dim. */
icc_status iccp_shape_create(icc_shape **out, int32_t dim, size_t n_regions,
                             const icc_domain *const *regions, size_t n_vertices,
                             const double *vertices, size_t n_segments, const uint32_t *segments,
                             const iccp_env *env, icc_error *err);
icc_shape *iccp_shape_retain(const icc_shape *shape);
void iccp_shape_release(icc_shape *shape);

/* What is to be known of a point to see from it. */
typedef struct iccp_spot {
    double at[3];     /* local to the shape */
    double clearance; /* local distance of the nearest wall */
    uint32_t wall;    /* the nearest wall if the point is on it, else ICCP_NOWHERE */
    uint32_t region;  /* the innermost that it is in, boundary included; ICCP_NOWHERE outside all */
    uint32_t curve;   /* a segment that it is on, within 1e-9 of the box, or ICCP_NOWHERE */
    bool beside;      /* concluded from another spot */
} iccp_spot;
iccp_spot iccp_shape_spot(const icc_shape *shape, const double *point);

/* The same for a point beside another one. If the other's clearance shows that no wall is within
 * `reach`, nothing is looked up, curves are left out, and the clearance is a lower bound. */
iccp_spot iccp_shape_spot_beside(const icc_shape *shape, const iccp_spot *other,
                                 const double *point, double reach);

/* The innermost region that a point is in, its boundary included; ICCP_NOWHERE outside all. */
uint32_t iccp_shape_region(const icc_shape *shape, const double *point);

/* Whether a point is in the shape: in a region or, within 1e-9 of the box, on a curve. */
bool iccp_shape_holds(const icc_shape *shape, const double *point);

/* Whether a sees b, so that what is at b may spread to a: the segment between them runs through the
 * region of a, its boundary included, and meets no wall but at its ends. A wall belongs to the
 * region that it encloses. So what lies around a wall sees the points on it, but they do not see
 * it: were it mutual, walls would conduct, and the surroundings of a shape lead from one of its
 * limbs to another. What is outside all regions is one region here, for samples beyond the shape,
 * but for points of curves. Points of curves see each other, too, if the way along them is no more
 * than twice as long as the straight one. */
bool iccp_spot_sees(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b);
bool iccp_shape_sees(const icc_shape *shape, const double *a, const double *b);

#endif
