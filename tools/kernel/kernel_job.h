/* The first steps of `weights` and `pose`: reading shape and handles, spreading samples, making
 * weights.
 *
 * Words of this folder
 * - handle: a point that the user moves. pose: a transform for each handle.
 * - weight: the influence of a handle at a point. sampling: the nodes at which weights are
 *   computed.
 * - stroke: weights painted by the user. rigid part: a region that keeps its shape.
 * - binding: points saved with their weights.
 * - certified pose: a pose replaced by a one-to-one map (pose_certified.c).
 *
 * Ways
 * - In: handle_set.c reads handles, pose_json.c poses. linear_edges.h: weights along edges.
 * - Poses: pose_points.c, pose_picture.c; one-to-one: pose_certified.c, by pose_outline.h and
 *   pose_places.h. Reports: kernel_report.c, pose_report.c.
 * - Figures of weights: plot_weight.c, plot_along.c, their colours weight_colour.c.
 *
 * Begin with kernel_job.c. */
#ifndef KERNEL_JOB_H
#define KERNEL_JOB_H

#include "job/job.h"
#include "kernel/handle_set.h"

#include <icc/kernel.h>

typedef struct kernel_job {
    job job;
    handle_set set;
    icc_domain **regions; /* the regions of the handles' file */
    icc_sampling *sampling;
    icc_weights *weights;
    double energy[2]; /* of the rigid parts, before and after */
    double seconds_samples, seconds_weights, seconds_rigid;
} kernel_job;

/* Like job_start() and so on. Files are read first, so that a mistake in a file is reported at
 * once. */
void kernel_job_start(kernel_job *k, const args *a);
int kernel_job_read(kernel_job *k);
int kernel_job_make(kernel_job *k);
void kernel_job_end(kernel_job *k);

/* Begins the report of --json with what was made and how good the weights are at n finite points.
 * The command adds its own members. */
int kernel_report_open(report *r, kernel_job *k, size_t n, const double *points);

#endif
