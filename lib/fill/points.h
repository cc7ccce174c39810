/* The points of a mesh under construction. Some lie exactly on edges or facets of the surface,
 * where no double does. */
#ifndef ICCP_POINTS_H
#define ICCP_POINTS_H

#include "base/memory.h"
#include "geometry/frame.h"
#include "math/predicates.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A point on an edge or a facet. The shares are multiples of 2^-48 and sum to 1. */
typedef struct iccp_dyadic {
    uint32_t of[3]; /* vertices of the surface */
    uint32_t next;  /* of a point on an edge: the next one */
    /* the third share is 0 for a point on an edge; all are 0 after the point was moved */
    double share[3];
} iccp_dyadic;

typedef struct iccp_points {
    size_t n, room;
    size_t n_given; /* number of vertices of the surface; the corners of a box follow */
    size_t n_fixed; /* after these come n_dyadic points that are, or were, on the surface */
    size_t n_dyadic, dyadic_room;
    double *x; /* 3 each, nearest doubles */
    iccp_dyadic *dyadic;
    const iccp_frame *frame; /* leads to the caller's coordinates */
} iccp_points;

static inline const double *iccp_point(const iccp_points *points, uint32_t p)
{
    return points->x + 3 * (size_t)p;
}

static inline bool iccp_is_dyadic(const iccp_points *points, uint32_t p)
{
    return p >= points->n_fixed && p - points->n_fixed < points->n_dyadic &&
           points->dyadic[p - points->n_fixed].share[0] != 0.0;
}

/* iccp_points_orient() if some points are dyadic. */
int iccp_points_orient_dyadic(const iccp_points *points, const uint32_t corner[4]);

/* Like iccp_orient3d(), for points given by their numbers. */
static inline int iccp_points_orient(const iccp_points *points, uint32_t a, uint32_t b, uint32_t c,
                                     uint32_t d)
{
    if (points->n_dyadic > 0 && (iccp_is_dyadic(points, a) || iccp_is_dyadic(points, b) ||
                                 iccp_is_dyadic(points, c) || iccp_is_dyadic(points, d)))
        return iccp_points_orient_dyadic(points, (const uint32_t[4]){a, b, c, d});
    return iccp_orient3d(iccp_point(points, a), iccp_point(points, b), iccp_point(points, c),
                         iccp_point(points, d));
}

/* Moves x to a point that iccp_frame_snap() would leave in place. */
static inline void iccp_points_snap(const iccp_points *points, double x[3])
{
    iccp_frame_snap(points->frame, 3, x);
}

/* Returns six times the volume of a tetrahedron, in doubles. */
static inline double iccp_points_volume(const double *a, const double *b, const double *c,
                                        const double *d)
{
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
    return ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx);
}

#endif
