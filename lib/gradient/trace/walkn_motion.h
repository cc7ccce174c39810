/* One step along the gradient of a face of the Kuhn triangulation. */
#ifndef ICCP_WALKN_MOTION_H
#define ICCP_WALKN_MOTION_H

#include "gradient/trace/walkn_star.h"

/* The face that carries a step, and how its points move: all coordinates between a corner and the
 * next, a block, are equal and stay so. */
typedef struct iccp_motion {
    int n;                         /* corners */
    int corner[ICC_MAX_DIM + 1];   /* numbers in the simplex */
    double speed[ICC_MAX_DIM + 2]; /* of the block below corner a; 0 at both ends */
    double y[ICC_MAX_DIM + 2];     /* where it is; 1 and 0 at the ends */
    int exit;                      /* the number here of the corner whose facet is met */
} iccp_motion;

/* Derivatives by up to dim parameters of what a walk computes. */
typedef struct iccp_jetn {
    double x[ICC_MAX_DIM][ICC_MAX_DIM]; /* of the position: by coordinate, then by parameter */
    double s[ICC_MAX_DIM];              /* of the arc length so far */
} iccp_jetn;

/* That of the face with the given corners of the place's simplex. */
void iccp_motion_find(iccp_motion *motion, const iccp_place *place, const iccp_slope *slope,
                      unsigned corners);

/* Moves on to the first of the facets opposite to the corners that belong to `face`, the one that
 * the step starts in; returns the corners that are left, or 0 when nothing moves. */
unsigned iccp_motion_run(iccp_motion *motion, unsigned face);

/* Carries a jet along, after the run and before its result is written to the place. */
void iccp_motion_carry(const iccp_motion *motion, const iccp_place *place, unsigned left,
                       iccp_jetn *jet);

#endif
