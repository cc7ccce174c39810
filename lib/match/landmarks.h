/* Points of two outlines that a caller knows to go together. */
#ifndef ICCP_LANDMARKS_H
#define ICCP_LANDMARKS_H

#include "match/outline.h"

/* The most of them. */
enum { ICCP_MAX_LANDMARKS = 1000 };

/* Finds the outlines' nearest points to n landmarks, 4 coordinates each as the caller gave them: n
 * pairs of shares, in order along the source, the target's growing by less than a turn.
 * ICC_ERR_ARGUMENT names the landmark that is off the outline, out of order or a double. */
icc_status iccp_landmarks_place(double *shares, size_t n, const double *landmarks,
                                const iccp_outline *source, const iccp_outline *target,
                                const iccp_memory *memory, icc_error *err);

#endif
