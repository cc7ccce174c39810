/* One step along the gradient of a face of the Kuhn triangulation. */
#ifndef ICCP_WALKN_MOTION_H
#define ICCP_WALKN_MOTION_H

#include "gradient/trace/walkn_star.h"

/* The face that carries a step, and how its points move. A block is the set of coordinates between
 * a corner and the next. They are equal and stay equal. */
typedef struct iccp_motion {
    int n;                         /* number of corners */
    int corner[ICC_MAX_DIM + 1];   /* their numbers in the simplex */
    double speed[ICC_MAX_DIM + 2]; /* speed of the block below corner a; 0 at both ends */
    double y[ICC_MAX_DIM + 2];     /* position of the block; 1 and 0 at the ends */
    int exit;                      /* the number, here, of the corner whose facet is met */
} iccp_motion;

/* Derivatives of a walk with respect to up to dim parameters. */
typedef struct iccp_jetn {
    double x[ICC_MAX_DIM][ICC_MAX_DIM]; /* of the position: by coordinate, then by parameter */
    double s[ICC_MAX_DIM];              /* of the arc length so far */
} iccp_jetn;

/* Finds the motion of the face with the given corners of the place's simplex. */
void iccp_motion_find(iccp_motion *motion, const iccp_place *place, const iccp_slope *slope,
                      unsigned corners);

/* Moves to the first of the facets opposite the corners in `face`, the face in which the step
 * starts. Returns the remaining corners, or 0 if nothing moves. */
unsigned iccp_motion_run(iccp_motion *motion, unsigned face);

/* Updates a jet. Call it after the run, before its result is written to the place. */
void iccp_motion_carry(const iccp_motion *motion, const iccp_place *place, unsigned left,
                       iccp_jetn *jet);

#endif
