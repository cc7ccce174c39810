/* The cells around a corner of a lattice. Tells whether a set of the 2^n cells forms a manifold
 * there. */
#ifndef ICCP_OCTANTS_H
#define ICCP_OCTANTS_H

#include <stdbool.h>
#include <stdint.h>

/* Tests a set of the 2^n_axes orthants at the origin, n_axes <= 6, which is neither empty nor full.
 * Returns true if the set covers a contractible part of a sphere around the origin, or if its
 * complement does. Bit b of `set` stands for the orthant that is positive along the axes of the
 * bits of b.
 *
 * Suppose that this holds, and also for the orthants on each side of each axis, unless none or all
 * of these are in the set. Then the part and the rest are balls: the boundary is a manifold at the
 * origin. Exact up to four axes (tested on all sets). Beyond, true is exact, and false may mean
 * that no proof was found. */
bool iccp_octants_contractible(uint64_t set, int n_axes);

#endif
