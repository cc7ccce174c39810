/* Where a vertex of a drawing on the sphere may lie. */
#ifndef ICCP_KERNEL_ROOM_H
#define ICCP_KERNEL_ROOM_H

#include <stddef.h>

/* Corners of a cone with its apex in the centre: work for a ring of n directions has room for
 * ICCP_ROOM_CORNERS + n of them, twice. */
enum { ICCP_ROOM_CORNERS = 8 };

/* The cone of the directions from which all sides of a ring of n directions, n >= 3, are seen from
 * the left, as far as it lies within 83 degrees of an axis that is in it or on its boundary: its
 * corners, to rounding, not of length 1. The first ones of `work`, counter-clockwise; how many,
 * less than 3 if doubles find no room. O(n^2) at worst. */
size_t iccp_kernel_room(double (*work)[3], const double axis[3], size_t n,
                        const double *const *ring);

/* Gives its corners the length 1; their mean. */
void iccp_kernel_room_middle(double middle[3], double (*corner)[3], size_t n);

#endif
