/* Paths that move with the vertices that they go round. */
#ifndef ICCP_WORD_MOTION_H
#define ICCP_WORD_MOTION_H

#include "map/isotopy/word.h"

/* A triangulation that moves, of its own. */
typedef struct iccp_moving_net {
    iccp_memory memory;
    iccp_corners mesh;
    double *points;
    iccp_net net; /* of these */
} iccp_moving_net;

/* A copy. `points`: where its n vertices are at first. */
icc_status iccp_moving_net_create(iccp_moving_net *moving, const iccp_net *net, size_t n,
                                  const double *points, const iccp_memory *memory);
void iccp_moving_net_free(iccp_moving_net *moving);

/* Moves the vertices to other places, all at once and straight, and takes words along; edges flip
 * as they must. *arrived: whether they are there, which is false if vertices meet walls or one
 * another on the way, or come too close to tell. */
icc_status iccp_words_move(iccp_words *words, iccp_moving_net *moving, const double *places,
                           bool *arrived, const iccp_env *env);

#endif
