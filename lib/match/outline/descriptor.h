/* Describes an outline as seen from a sample of it. The turns of chords of several lengths do not
 * depend on place, size or rotation. The tangent's direction depends on the rotation. */
#ifndef ICCP_DESCRIPTOR_H
#define ICCP_DESCRIPTOR_H

#include "match/outline/outline.h"

enum { ICCP_SCALES = 6 };

/* Weight of tangents in the cost of a pair where they count. The rest is the weight of turns. */
static const double iccp_tangents = 0.6;

/* Turns are scaled by the square roots of their weights, whose sum is 1. So the cost of a pair of
 * turns is 2 minus twice their product. The same holds for tangents. */
typedef struct iccp_descriptor {
    float turns[2 * ICCP_SCALES];
    float tangent[2];
} iccp_descriptor;

/* Describes n samples at the given shares of arc length. Tangents are chords of length 2 *
 * `step`. */
void iccp_descriptors(iccp_descriptor *out, const iccp_outline *outline, size_t n,
                      const double *share, double step);

/* Returns the cost of a pair of samples, between 0 and 4. `rotation` is a complex number that turns
 * the target's tangent. `weight` is that of the tangents; the rest is that of the turns. */
float iccp_descriptor_cost(const iccp_descriptor *a, const iccp_descriptor *b,
                           const double *rotation, double weight);

/* Adds to `sum` the rotation that takes the target's tangent to the source's. The sum over pairs
 * gives the best rotation. */
void iccp_descriptor_turn(double *sum, const iccp_descriptor *a, const iccp_descriptor *b);

/* Scales a complex number to length 1, and sets it to 1 if it is 0. */
void iccp_unit(double *z);

#endif
