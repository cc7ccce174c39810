/* Points of two outlines that the caller knows to correspond. */
#ifndef ICCP_LANDMARKS_H
#define ICCP_LANDMARKS_H

#include "match/outline/outline.h"

/* The largest number of landmarks of outlines. */
enum { ICCP_MAX_LANDMARKS = 1000 };

/* The largest distance of a landmark from an outline, or from a vertex of a surface, as a share of
 * the diagonal of the bounding box. */
static const double iccp_farthest_landmark = 0.02;

/* Returns the share of the outline's point nearest to a point in the caller's coordinates, or of a
 * vertex close to it. *away is the distance in diameters. For a line the share is on the way from
 * its first end. */
double iccp_landmark_share(const iccp_outline *outline, const double *point, double *away);

/* Finds the outlines' nearest points to n landmarks: n pairs of shares, in order along the source,
 * growing along the target by less than a turn. A landmark has 4 coordinates, as the caller gave
 * them. `numbers` are the caller's numbers of the landmarks, or NULL for 0, 1, ... ICC_ERR_ARGUMENT
 * names the landmark that is off the outline, out of order or a double. */
icc_status iccp_landmarks_place(double *shares, size_t n, const double *landmarks,
                                const size_t *numbers, const iccp_outline *source,
                                const iccp_outline *target, const iccp_memory *memory,
                                icc_error *err);

#endif
