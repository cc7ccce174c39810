/* The parts of `libicc pose`. */
#ifndef POSE_JOB_H
#define POSE_JOB_H

#include "geo/carrier.h"
#include "kernel/kernel_job.h"
#include "plot/picture.h"

typedef struct pose {
    kernel_job kernel;
    double *transforms; /* n_handles * dim * (dim + 1) */
    /* with --certified */
    icc_domain *sides[2]; /* the shape and what it becomes, with the handles inside as points */
    icc_map *map;
    carrier carrier;
    double energy, outline_off; /* where the outline met itself: how far it may be off instead */
    size_t n_followed;          /* places of the pose besides the handles */
    double folded, off_mean, off_most; /* of the pose by weights alone: the share of the shape that
                                          is turned over, how far it is from the map */
} pose;

/* The file that the result goes to. */
const char *pose_output(const pose *p);

/* Says something on stdout, or on stderr when the result goes to stdout. */
void pose_say(const pose *p, const char *text);

/* Images of n points, and their dim * dim derivatives unless that is NULL. Points that are not
 * finite have none: NaN, and *n_failed of them; nor have points outside the shape once there is a
 * certified map. */
int pose_points(pose *p, size_t n, const double *points, double *images, double *jacobians,
                size_t *n_failed);

/* Points by what becomes of orientation there. */
typedef struct turned {
    size_t kept, inverted, collapsed;
} turned;

turned pose_count_turned(size_t dim, size_t n, const double *jacobians);

/* Reads a picture from bytes[0..n), and writes it as posed. */
int pose_picture(pose *p, const char *bytes, size_t n);

/* With --certified. First comes the check, before anything is made; then the map of the pose, which
 * pose_points() and pose_picture() use from then on. The last does nothing without a map, nor do
 * those that say and report what it is. */
int pose_certified_check(const pose *p);
int pose_certified_make(pose *p);
int pose_certified_points(pose *p, size_t n, const double *points, double *images,
                          double *jacobians, size_t *n_failed);
int pose_certified_picture(pose *p, const picture *from, picture *to);
void pose_certified_say(const pose *p);
void pose_certified_report(const pose *p, json *out);
void pose_certified_free(pose *p);

/* The report up to what is special: points (those of `points` that are finite tell how good the
 * weights are), how many have no image. */
int pose_report_open(report *r, pose *p, size_t n, const double *points, size_t n_failed,
                     double seconds);

#endif
