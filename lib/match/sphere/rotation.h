/* How one drawing on the sphere is turned so that like parts of two surfaces come to lie on one
 * another. */
#ifndef ICCP_ROTATION_H
#define ICCP_ROTATION_H

#include "match/surface/half_edges.h"

/* Two surfaces that have been drawn, each alone: the directions of the first are turned so that the
 * map from it to the second, from sphere to sphere, stretches it little. Rotations of a grid are
 * compared on some hundred of its vertices, the best ones are made better. Those are better that
 * bring vertices pairs[0][k] near to pairs[1][k], k < n_pairs. x: coordinates of size about 1. The
 * drawing is certified then as it was before: where rounding spoils all good rotations, which is to
 * say never, it is left as it is. *energy: of the map, area by area on both, 4 for an isometry, and
 * more with the distances of pairs. ICC_ERR_MEMORY, ICC_ERR_CANCELLED without a text. */
icc_status iccp_rotation_find(double *first, const double *second,
                              const iccp_half_edges *const m[2], const double *const x[2],
                              size_t n_pairs, const uint32_t *const pairs[2], double *energy,
                              const iccp_env *env);

#endif
