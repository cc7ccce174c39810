/* Turns one drawing on the sphere so that similar parts of two surfaces coincide. */
#ifndef ICCP_ROTATION_H
#define ICCP_ROTATION_H

#include "match/surface/half_edges.h"

/* Turns the directions of the first of two drawings so that the map from the first surface to the
 * second stretches little. Rotations of a grid are compared on 150 vertices, and the best are
 * refined. Pairs pairs[0][k], pairs[1][k], k < n_pairs, should come close to each other. x has
 * coordinates of size about 1.
 *
 * The turned drawing is certified, as it was before. If rounding spoils the rotation, the drawing
 * is not changed. ICC_ERR_MEMORY, ICC_ERR_CANCELLED without a text. */
icc_status iccp_rotation_find(double *first, const double *second,
                              const iccp_half_edges *const m[2], const double *const x[2],
                              size_t n_pairs, const uint32_t *const pairs[2], const iccp_env *env);

#endif
