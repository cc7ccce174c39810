/* Intersections of half-spaces and their centres. They tell where a vertex of a mesh may be so that
 * all its tetrahedra are positive. */
#ifndef ICCP_HALFSPACES_H
#define ICCP_HALFSPACES_H

#include "base/memory.h"

typedef struct iccp_halfspace {
    double normal[3], offset; /* the points x with normal . x > offset; the normal has length 1 */
} iccp_halfspace;

typedef struct iccp_halfspaces {
    iccp_memory memory;
    size_t n, room;
    iccp_halfspace *item;
} iccp_halfspaces;

void iccp_halfspaces_free(iccp_halfspaces *h);

/* Makes room for this many half-spaces in all. */
bool iccp_halfspaces_reserve(iccp_halfspaces *h, size_t room);

/* Adds the half-space from which the triangle a, b, c is counter-clockwise. Returns false if the
 * triangle has almost no area. There must be room. */
bool iccp_halfspaces_add(iccp_halfspaces *h, const double *a, const double *b, const double *c);

/* Moves a point that is in all half-spaces towards the place where the product of its distances is
 * greatest. The intersection must be bounded. Rounding may move the point outside. O(n). */
void iccp_halfspaces_centre(const iccp_halfspaces *h, size_t steps, double x[3]);

/* Moves a point that is not in all half-spaces to where its least distance is greatest. If that is
 * inside, it goes on towards the centre. The intersection must be bounded, or become bounded if all
 * half-spaces are moved outwards. Returns true if the point is then in all half-spaces, up to
 * rounding. O(n) for each of about ten steps. */
bool iccp_halfspaces_enter(const iccp_halfspaces *h, double x[3]);

#endif
