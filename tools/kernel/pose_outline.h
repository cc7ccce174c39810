/* An outline as it is posed. Its edges bend, so that they are cut into pieces. */
#ifndef POSE_OUTLINE_H
#define POSE_OUTLINE_H

#include "kernel/pose_job.h"

typedef struct posed_outline {
    size_t n, room_rest, room_posed, room_edges;
    double *rest, *posed; /* 2 n coordinates */
    size_t *edges;        /* of the region, that each vertex begins or lies on */
} posed_outline;

/* Cuts the ring of a region until straight pieces of it, posed, are no farther than `tolerance`
 * from where the pose takes them. Handles on the ring become vertices of it, and are marked in
 * `on_ring`. Free `out` in any case. */
int posed_outline_make(posed_outline *out, pose *p, const icc_domain *region, size_t n,
                       const double *ring, double tolerance, bool *on_ring);
/* The longest side of the box round a ring. */
double ring_size(size_t n, const double *ring);

void posed_outline_free(posed_outline *out);

/* Whether it is a simple polygon that turns as at rest. */
bool posed_outline_is_simple(const posed_outline *out, const pose *p);

/* DONE, or FAILED with a line on stderr that says what keeps the posed outline from being a simple
 * polygon, by edges of the shape. */
int posed_outline_check(const posed_outline *out, pose *p);

#endif
