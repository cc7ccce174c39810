/* The parts of `libicc pose`. */
#ifndef POSE_JOB_H
#define POSE_JOB_H

#include "kernel/kernel_job.h"

typedef struct pose {
    kernel_job kernel;
    double *transforms; /* n_handles * dim * (dim + 1) */
} pose;

/* The file that the result goes to. */
const char *pose_output(const pose *p);

/* Says something on stdout, or on stderr when the result goes to stdout. */
void pose_say(const pose *p, const char *text);

/* Images of n points, and their dim * dim derivatives unless that is NULL. Points that are not
 * finite have none: NaN, and *n_failed of them. */
int pose_points(pose *p, size_t n, const double *points, double *images, double *jacobians,
                size_t *n_failed);

/* Points by what becomes of orientation there. */
typedef struct turned {
    size_t kept, inverted, collapsed;
} turned;

turned pose_count_turned(size_t dim, size_t n, const double *jacobians);

/* Reads a picture from bytes[0..n), and writes it as posed. */
int pose_picture(pose *p, const char *bytes, size_t n);

/* The report up to what is special: points (those of `points` that are finite tell how good the
 * weights are), how many have no image. */
int pose_report_open(report *r, pose *p, size_t n, const double *points, size_t n_failed,
                     double seconds);

#endif
