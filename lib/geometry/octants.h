/* The cells around a corner of a lattice: which of the 2^n make a solid there. */
#ifndef ICCP_OCTANTS_H
#define ICCP_OCTANTS_H

#include <stdbool.h>
#include <stdint.h>

/* Whether some of the 2^n_axes orthants at the origin, n_axes <= 6, neither none nor all, cover a
 * contractible part of a sphere round it, or the others do. Bit b of `set` stands for the orthant
 * that is positive along the axes of the bits of b.
 *
 * If that holds, and also for the orthants on each side of each axis (unless none or all of these
 * are in the set), the part is a ball, as is the rest: the boundary is a manifold at the origin.
 * Exact up to four axes (tested on all sets); beyond, true is exact and false may mean that it
 * could not be shown. */
bool iccp_octants_contractible(uint64_t set, int n_axes);

#endif
