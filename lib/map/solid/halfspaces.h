/* Half-spaces, and the middle of what they have in common: where a vertex of a mesh may be so that
 * all its tetrahedra are positive. */
#ifndef ICCP_HALFSPACES_H
#define ICCP_HALFSPACES_H

#include "base/memory.h"

typedef struct iccp_halfspace {
    double normal[3], offset; /* the points x with normal x > offset; the normal has length 1 */
} iccp_halfspace;

typedef struct iccp_halfspaces {
    iccp_memory memory;
    size_t n, room;
    iccp_halfspace *item;
} iccp_halfspaces;

void iccp_halfspaces_free(iccp_halfspaces *h);

/* Room for so many in all. */
bool iccp_halfspaces_reserve(iccp_halfspaces *h, size_t room);

/* Adds the one from which the triangle a, b, c looks counter-clockwise; false where that is next to
 * nothing. There must be room. */
bool iccp_halfspaces_add(iccp_halfspaces *h, const double *a, const double *b, const double *c);

/* Moves a point that is in all of them to, or towards, where the product of its distances is
 * greatest; what they have in common is bounded. It may end outside by rounding. O(n). */
void iccp_halfspaces_centre(const iccp_halfspaces *h, size_t steps, double x[3]);

/* Moves a point that is not in all of them to where the least distance from one is greatest, and on
 * towards the centre if that is inside; what they have in common, or would if all were moved
 * outwards, is bounded. Whether it has come to be in all, but for rounding. O(n) a turn, of which
 * there are some ten. */
bool iccp_halfspaces_enter(const iccp_halfspaces *h, double x[3]);

#endif
