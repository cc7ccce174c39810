/* The room that a ring of neighbours leaves a vertex of a drawing on the sphere. */
#ifndef ICCP_KERNEL_ROOM_H
#define ICCP_KERNEL_ROOM_H

#include <stddef.h>

/* Extra corners: `work` for a ring of n directions has room for twice ICCP_ROOM_CORNERS + n of
 * them. */
enum { ICCP_ROOM_CORNERS = 8 };

/* A vertex of a drawing may jump to another place in its room if its triangles have a mean of the
 * energy to the power 1.5 above iccp_severely_bad. Vertices with more than ICCP_JUMP_NEIGHBOURS
 * neighbours do not jump, so the work stays in proportion: the poles of a globe have many. */
static const double iccp_severely_bad = 90;
enum { ICCP_JUMP_NEIGHBOURS = 64 };

/* Finds the cone of directions that have all sides of a ring of n >= 3 directions on their left. It
 * is cut off at 83 degrees from an axis that lies in the cone or on its boundary. The cone's
 * corners, up to rounding and not of length 1, become the first ones of `work`, counter-clockwise.
 * Returns their number, which is below 3 if doubles find no room. O(n^2) at worst. */
size_t iccp_kernel_room(double (*work)[3], const double axis[3], size_t n,
                        const double *const *ring);

/* Normalises the corners and computes their mean. */
void iccp_kernel_room_middle(double middle[3], double (*corner)[3], size_t n);

#endif
