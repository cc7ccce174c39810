/* Fits: maps from control points alone, of a figure by pins, and of a mesh whose vertices are told.
 *
 * Words of this folder
 * - fit: a map that is made from what is known of it (icc/fit.h).
 * - frame: the box around control points that the map covers.
 * - pin: a control point in a figure whose outline is free.
 * - left out: where the other points alone would take a point.
 * - move: a vertex of a mesh and its new place (moves_file.h).
 *
 * Ways
 * - Points: fit_job.h makes, fit_report.h prints, rectify.h writes pictures. Meshes: mesh_fit.h.
 * - Between cages: job/fit_cages.h. Files of control points: control/control_read.h.
 *
 * Begin with fit_job.c. */
#ifndef FIT_JOB_H
#define FIT_JOB_H

#include "control/control_points.h"
#include "job/job.h"

typedef struct fit_job {
    job job;     /* its map is that of the fit, and its cages are the boundaries of the map */
    job outline; /* of a figure; unused without --outline */
    control_points points; /* as the file has them */
    bool turned;           /* y of the source is reversed for the fit */
    icc_fit_info info;
    double *affine, *residuals, *left_out; /* 2 n each: images minus targets */
} fit_job;

/* Reads the points, which are the first operand, and the outline. Then the other operands are those
 * of the job. Returns DONE, or another exit code after a message. End it in any case. */
int fit_job_start(fit_job *f, const args *a);
void fit_job_end(fit_job *f);

/* Makes the fit and the map of the job, also again after the points have been changed. */
int fit_job_make(fit_job *f);

/* Prints remarks after success. Returns PARTIAL if pins are not at their places, else DONE. */
int fit_job_tell(fit_job *f);

/* Makes the cages of a job from the boundary of its map, which is a mesh map of the plane. */
int fit_take_cages(job *j);

#endif
