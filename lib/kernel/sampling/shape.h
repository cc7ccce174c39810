/* The shape that is deformed: regions with walls between them, and curves. All points are in the
 * caller's coordinates. */
#ifndef ICCP_SHAPE_H
#define ICCP_SHAPE_H

#include "domain/domain.h"
#include "icc/kernel.h"
#include "kernel/sampling/segment_graph.h"

#define ICCP_NOWHERE UINT32_MAX

/* Local, where the size of the shape is about 1: a point within this distance of a curve, or of an
 * edge between handles, is meant to be on it. */
#define ICCP_ON_LINE 1e-9

struct icc_shape {
    iccp_memory memory;
    atomic_size_t references;
    size_t dim, n_regions, n_vertices, n_segments;
    icc_domain **regions;      /* n_regions; the shape keeps them alive */
    double *vertices;          /* of the curves: n_vertices * dim, in the caller's coordinates */
    uint32_t *segments;        /* n_segments * 2 of these vertices */
    double lower[3], upper[3]; /* box around everything */
    iccp_frame frame; /* frame of the whole shape; all that follows is in its local coordinates */
    double tolerance; /* points this close to a wall are on it */
    size_t n_walled;  /* number of vertices of walls */
    double *local;    /* vertices of all walls, region by region, then those of the curves */
    uint32_t *facets, *owner;      /* walls: dim local vertices each; and the region of each */
    uint32_t *sticks;              /* the segments as facets (in 3-D the second end is repeated) */
    iccp_facet_tree walls, curves; /* empty (n == 0) if there are none */
    iccp_segment_graph graph;      /* graph of the segments */
};

/* See icc_shape_create(). Arguments have been checked for NULL and dim. */
icc_status iccp_shape_create(icc_shape **out, int32_t dim, size_t n_regions,
                             const icc_domain *const *regions, size_t n_vertices,
                             const double *vertices, size_t n_segments, const uint32_t *segments,
                             const iccp_env *env, icc_error *err);
icc_shape *iccp_shape_retain(const icc_shape *shape);
void iccp_shape_release(icc_shape *shape);

/* A point with what must be known to tell what it sees. */
typedef struct iccp_spot {
    double at[3];     /* in local coordinates of the shape */
    double clearance; /* local distance of the nearest wall */
    uint32_t wall;    /* nearest wall if the point is on it, else ICCP_NOWHERE */
    /* Innermost region that contains it, including its boundary; ICCP_NOWHERE outside all */
    uint32_t region;
    uint32_t curve; /* a segment within ICCP_ON_LINE, or ICCP_NOWHERE */
    bool beside;    /* derived from another spot */
} iccp_spot;
iccp_spot iccp_shape_spot(const icc_shape *shape, const double *point);

/* Like iccp_shape_spot(), for a point beside another one. If the other's clearance shows that no
 * wall is within `reach`, nothing is looked up. Then curves are ignored, and the clearance is a
 * lower bound. */
iccp_spot iccp_shape_spot_beside(const icc_shape *shape, const iccp_spot *other,
                                 const double *point, double reach);

/* Returns the innermost region that contains a point, including its boundary; ICCP_NOWHERE outside
 * all. */
uint32_t iccp_shape_region(const icc_shape *shape, const double *point);

/* Returns the innermost region around another region; ICCP_NOWHERE if there is none. */
uint32_t iccp_shape_parent(const icc_shape *shape, uint32_t region);

/* Returns true if a point is in the shape: in a region or, within 1e-9 of the box, on a curve. */
bool iccp_shape_holds(const icc_shape *shape, const double *point);

/* Returns true if a sees b, so that what is at b may spread to a. The segment between them must run
 * through the region of a, including its boundary, and meet no wall except at its ends.
 *
 * A wall belongs to the region that it encloses. So points around a wall see the points on it, but
 * not the other way around. If seeing were mutual, walls would conduct, and the surroundings of a
 * shape would connect its limbs. Everything outside all regions counts as one region, for samples
 * beyond the shape, but not for points of curves. Points of curves also see each other if the way
 * along the curves is at most twice as long as the straight one. */
bool iccp_spot_sees(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b);
bool iccp_shape_sees(const icc_shape *shape, const double *a, const double *b);

#endif
