/* Finds where a vertex may lie by clipping: I. E. Sutherland, G. W. Hodgman, Reentrant Polygon
 * Clipping, 1974, with planes through the centre of the sphere. */
#include "match/surface/kernel_room.h"

#include "match/surface/direction.h"

#include <math.h>
#include <string.h>

/* Starts with a cone around a direction. Its corners are 83 degrees away, which is wide enough for
 * every drawing. */
static void begin(double (*corner)[3], const double *axis)
{
    static const double eighth[ICCP_ROOM_CORNERS][2] = {
        {8, 0}, {5.5, 5.5}, {0, 8}, {-5.5, 5.5}, {-8, 0}, {-5.5, -5.5}, {0, -8}, {5.5, -5.5}};
    double across[2][3];
    iccp_direction_axes(axis, across);
    for (int i = 0; i < ICCP_ROOM_CORNERS; ++i)
        for (int k = 0; k < 3; ++k)
            corner[i][k] = axis[k] + eighth[i][0] * across[0][k] + eighth[i][1] * across[1][k];
}

/* Keeps the part on the positive side of a plane. */
static size_t clip(double (*out)[3], size_t n, const double (*corner)[3], const double normal[3])
{
    size_t n_out = 0;
    double before = iccp_vec_dot(3, corner[n - 1], normal);
    for (size_t i = 0, last = n - 1; i < n; last = i++) {
        const double now = iccp_vec_dot(3, corner[i], normal);
        if ((now > 0) != (before > 0)) {
            const double s = fabs(now) / (fabs(now) + fabs(before));
            for (int k = 0; k < 3; ++k)
                out[n_out][k] = s * corner[last][k] + (1 - s) * corner[i][k];
            ++n_out;
        }
        if (now > 0)
            memcpy(out[n_out++], corner[i], sizeof *out);
        before = now;
    }
    return n_out;
}

size_t iccp_kernel_room(double (*work)[3], const double axis[3], size_t n,
                        const double *const *ring)
{
    double(*from)[3] = work, (*to)[3] = work + ICCP_ROOM_CORNERS + n;
    size_t n_corners = ICCP_ROOM_CORNERS;
    begin(from, axis);
    for (size_t i = 0; i < n && n_corners >= 3; ++i) {
        double normal[3];
        iccp_vec_cross(ring[i], ring[i + 1 < n ? i + 1 : 0], normal);
        n_corners = clip(to, n_corners, (const double(*)[3])from, normal);
        double(*const swap)[3] = from;
        from = to;
        to = swap;
    }
    if (from != work)
        memmove(work, from, n_corners * sizeof *work);
    return n_corners;
}

void iccp_kernel_room_middle(double middle[3], double (*corner)[3], size_t n)
{
    middle[0] = middle[1] = middle[2] = 0;
    for (size_t i = 0; i < n; ++i) {
        const double length = iccp_vec_norm(3, corner[i]);
        for (int k = 0; k < 3; ++k) {
            corner[i][k] /= length;
            middle[k] += corner[i][k] / (double)n;
        }
    }
}
