/* Points of two outlines that a caller knows to go together. */
#ifndef ICCP_LANDMARKS_H
#define ICCP_LANDMARKS_H

#include "match/outline/outline.h"

/* The most of them. */
enum { ICCP_MAX_LANDMARKS = 1000 };

/* The share of the outline's point that is nearest to a point as the caller gives it, or of a
 * vertex close by; and how far it is, in diameters. On the way there, of a line. */
double iccp_landmark_share(const iccp_outline *outline, const double *point, double *away);

/* Finds the outlines' nearest points to n landmarks, 4 coordinates each as the caller gave
 * them, who has given them these numbers (NULL: 0, 1, ..): n pairs of shares, in order along
 * the source, the target's growing by less than a turn. ICC_ERR_ARGUMENT names the landmark
 * that is off the outline, out of order or a double. */
icc_status iccp_landmarks_place(double *shares, size_t n, const double *landmarks,
                                const size_t *numbers, const iccp_outline *source,
                                const iccp_outline *target, const iccp_memory *memory,
                                icc_error *err);

#endif
