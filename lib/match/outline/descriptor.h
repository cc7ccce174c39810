/* What an outline looks like from a sample of it: how chords of several lengths turn there, which
 * does not depend on place, size or rotation; and the direction of its tangent. */
#ifndef ICCP_DESCRIPTOR_H
#define ICCP_DESCRIPTOR_H

#include "match/outline/outline.h"

enum { ICCP_SCALES = 6 };

/* Share of tangents in the cost of a pair where they count; the rest is that of turns. */
static const double iccp_tangents = .6;

/* Turns are scaled by the square roots of their weights, which sum to 1, so that the cost of a pair
 * of turns is 2 - 2 times their product; likewise of tangents. */
typedef struct iccp_descriptor {
    float turns[2 * ICCP_SCALES];
    float tangent[2];
} iccp_descriptor;

/* Of n samples at the given shares of arc length; tangents are chords of 2 * `step`. */
void iccp_descriptors(iccp_descriptor *out, const iccp_outline *outline, size_t n,
                      const double *share, double step);

/* What a pair of samples costs: between 0 and 4. `rotation` of the target's tangent, a complex
 * number; `weight` of the tangents, the rest is that of the turns. */
float iccp_descriptor_cost(const iccp_descriptor *a, const iccp_descriptor *b,
                           const double *rotation, double weight);

/* The rotation that takes the target's tangents nearest to the source's, as the sum over pairs. */
void iccp_descriptor_turn(double *sum, const iccp_descriptor *a, const iccp_descriptor *b);

/* Makes a complex number one of length 1; 1 if it is 0. */
void iccp_unit(double *z);

#endif
