/* Moves everything at once as held vertices move in common. */
#ifndef ICCP_RIGID_START_H
#define ICCP_RIGID_START_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A rotation about `from`, which goes to `to`. */
typedef struct iccp_rigid_motion {
    double from[2], to[2];
    double turn[2]; /* cosine and sine */
} iccp_rigid_motion;

/* Finds the motion that takes the held vertices nearest to their targets. Returns false if it is
 * not worth while: no vertex is held, some vertex has no way to go or must stay on a line, or most
 * of the way is left. `hold` is that of iccp_elastic_input. */
bool iccp_rigid_motion_find(iccp_rigid_motion *motion, size_t n_points, const uint8_t *hold,
                            const double *images, const double *targets);

void iccp_rigid_motion_apply(const iccp_rigid_motion *motion, size_t n_points, double *images);

#endif
