/* Places of two outlines that go together exactly: landmarks, and corners that a pairing takes
 * almost to one another. */
#ifndef ICCP_PINS_H
#define ICCP_PINS_H

#include "match/outline/elastic.h"

/* The share of the target that a pairing takes a share of the source to; both unwrapped: what lies
 * a turn farther is taken a turn farther. Knots grow. */
double iccp_knots_at(const iccp_pairing_knots *knots, double share);

/* Pins corners, then makes the pairing pass through all pins and landmarks (n_landmarks pairs of
 * shares), with slopes that are limited by a share of arc length between them. `knots` has room for
 * 512 pairs and n_landmarks more than it has. */
icc_status iccp_pin(iccp_pairing_knots *knots, const iccp_outline *source,
                    const iccp_outline *target, size_t n_landmarks, const double *landmarks,
                    const iccp_env *env);

#endif
