/* Signs of three directions that are never 0: as if all had been moved by infinitely little. */
#ifndef ICCP_PERTURBED_H
#define ICCP_PERTURBED_H

#include <stdint.h>

/* iccp_direction_sign() of three different vertices, and where that is 0 the sign for directions
 * moved by infinitesimals that depend on the numbers of the vertices alone, so that all answers
 * together are those for one drawing in which no three vertices lie on a great circle. Exact. -1 or
 * +1. */
int iccp_perturbed_sign(const double *const p[3], const uint32_t number[3]);

#endif
