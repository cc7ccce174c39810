/* Signs of three directions that are never 0, as if all directions had been moved infinitely
 * little. */
#ifndef ICCP_PERTURBED_H
#define ICCP_PERTURBED_H

#include <stdint.h>

/* Returns iccp_direction_sign() of three different vertices, or, if that is 0, the sign after an
 * infinitesimal motion. The motion depends on the vertices' numbers alone. So all answers together
 * describe one drawing in which no three vertices lie on a great circle. Exact. -1 or +1. */
int iccp_perturbed_sign(const double *const p[3], const uint32_t number[3]);

#endif
