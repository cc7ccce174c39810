/* Chooses the margin of a frame and the smoothing, by leaving out each point in turn. */
#ifndef ICCP_FRAME_CHOICE_H
#define ICCP_FRAME_CHOICE_H

#include "fit/spline/spline_system.h"

/* Points with their values, and what is known of the frame. */
typedef struct iccp_frame_question {
    size_t n;
    const double *points;        /* 2 n, all different */
    const double *values;        /* 2 n */
    const double *share;         /* n: weight of each point for smoothing 1; 0: exact */
    const double *lower, *upper; /* the box to cover at least, or NULL */
    double metric[4];            /* see iccp_bending_mesh */
    bool is_line;                /* the points lie on one line */
} iccp_frame_question;

/* Replaces *margin and *smoothing by the best ones, if they are 0. *smoothing stays 0 if all points
 * are exact. Of many points a random sample decides. O(1) systems of at most some 10^4 rows. */
icc_status iccp_choose_frame(double *margin, double *smoothing, const iccp_frame_question *question,
                             const iccp_env *env);

#endif
