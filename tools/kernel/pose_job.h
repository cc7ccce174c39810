/* The parts of `libicc pose`. */
#ifndef POSE_JOB_H
#define POSE_JOB_H

#include "geo/carrier.h"
#include "kernel/kernel_job.h"
#include "picture/picture.h"

typedef struct pose {
    kernel_job kernel;
    double *transforms; /* n_handles * dim * (dim + 1) */
    /* with --certified */
    icc_domain *sides[2]; /* the shape and its image, with the handles inside as points */
    icc_map *map;
    carrier carrier;
    double energy, outline_off; /* if the outline met itself: the tolerance that was used instead */
    size_t n_followed;          /* places besides the handles where the map follows the pose */
    double folded, off_mean, off_most; /* of the pose by weights alone: the folded share of the
                                          shape, and its distance from the map */
} pose;

/* The file of the result. */
const char *pose_output(const pose *p);

/* Prints a text on stdout, or on stderr if the result goes to stdout. */
void pose_say(const pose *p, const char *text);

/* Computes images of n points, and their dim * dim derivatives unless that is NULL. Points that are
 * not finite have no image, nor have points outside the shape if there is a certified map. They get
 * NaN and are counted in *n_failed. */
int pose_points(pose *p, size_t n, const double *points, double *images, double *jacobians,
                size_t *n_failed);

/* Numbers of points by their orientation after the map. */
typedef struct turned {
    size_t kept, inverted, collapsed;
} turned;

turned pose_count_turned(size_t dim, size_t n, const double *jacobians);

/* Reads a picture from bytes[0..n), poses it and writes it. */
int pose_picture(pose *p, const char *bytes, size_t n);

/* With --certified. The check comes before anything is made. Then comes the map of the pose, which
 * pose_points() and pose_picture() use afterwards. The functions that print and report do nothing
 * without a map. */
int pose_certified_check(const pose *p);
int pose_certified_make(pose *p);
int pose_certified_points(pose *p, size_t n, const double *points, double *images,
                          double *jacobians, size_t *n_failed);
int pose_certified_picture(pose *p, const picture *from, picture *to);
void pose_certified_say(const pose *p);
void pose_certified_report(const pose *p, json *out);
void pose_certified_free(pose *p);

/* Begins the report: the points, whose finite ones tell how good the weights are, and how many have
 * no image. */
int pose_report_open(report *r, pose *p, size_t n, const double *points, size_t n_failed,
                     double seconds);

#endif
