/* Carries paths along when the vertices that they pass are moved. */
#ifndef ICCP_SEQUENCE_MOTION_H
#define ICCP_SEQUENCE_MOTION_H

#include "map/isotopy/crossing_sequence.h"

/* A triangulation that can move. It owns its arrays. */
typedef struct iccp_moving_triangulation {
    iccp_memory memory;
    iccp_corners mesh;
    double *points;
    iccp_triangulation triangulation; /* refers to `mesh` and `points` */
} iccp_moving_triangulation;

/* Copies a triangulation. `points` are the first places of its n vertices. */
icc_status iccp_moving_triangulation_create(iccp_moving_triangulation *moving,
                                            const iccp_triangulation *triangulation, size_t n,
                                            const double *points, const iccp_memory *memory);
void iccp_moving_triangulation_free(iccp_moving_triangulation *moving);

/* Moves all vertices at once, each straight to its new place, and carries the sequences along.
 * Edges flip when needed. *arrived is false if vertices meet walls or one another on the way, or
 * come too close to decide. */
icc_status iccp_sequences_move(iccp_sequences *sequences, iccp_moving_triangulation *moving,
                               const double *places, bool *arrived, const iccp_env *env);

#endif
