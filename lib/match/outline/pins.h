/* Pins: places of two outlines that must correspond exactly. They are landmarks, and corners that a
 * pairing takes almost to each other. */
#ifndef ICCP_PINS_H
#define ICCP_PINS_H

#include "match/outline/elastic.h"

/* Returns the share of the target for a share of the source. Both are unwrapped: a share that is a
 * turn farther gives a share that is a turn farther. The knots grow. */
double iccp_knots_at(const iccp_pairing_knots *knots, double share);

/* Pins corners, then makes the pairing pass through all pins and landmarks (n_landmarks pairs of
 * shares). Between them, slopes are limited by blending in arc length. `knots` has room for 512
 * pairs and n_landmarks more than it has. */
icc_status iccp_pin(iccp_pairing_knots *knots, const iccp_outline *source,
                    const iccp_outline *target, size_t n_landmarks, const double *landmarks,
                    const iccp_env *env);

#endif
