/* A posed outline. Its edges bend, so they are cut into pieces. */
#ifndef POSE_OUTLINE_H
#define POSE_OUTLINE_H

#include "kernel/pose_job.h"

typedef struct posed_outline {
    size_t n, room_rest, room_posed, room_edges;
    double *rest, *posed; /* 2 n coordinates */
    size_t *edges;        /* for each vertex: the region's edge that it begins or lies on */
} posed_outline;

/* Cuts the ring of a region until its straight pieces, posed, are within `tolerance` of the pose.
 * Handles on the ring become vertices of it and are marked in `on_ring`. Free `out` in any case. */
int posed_outline_make(posed_outline *out, pose *p, const icc_domain *region, size_t n,
                       const double *ring, double tolerance, bool *on_ring);
/* The longest side of the box around a ring. */
double ring_size(size_t n, const double *ring);

void posed_outline_free(posed_outline *out);

/* True if it is a simple polygon with the orientation that it has at rest. */
bool posed_outline_is_simple(const posed_outline *out, const pose *p);

/* DONE, or FAILED with a message on stderr that tells by edges of the shape why the posed outline
 * is not a simple polygon. */
int posed_outline_check(const posed_outline *out, pose *p);

#endif
