/* Goes through the bones until no further pin is reached from one that has its place. */
#include "fit/pin_path.h"

#include "base/allocate.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static void find_bone(const double *points, const uint32_t *ends, double out[2])
{
    for (size_t k = 0; k < 2; k++)
        out[k] = points[2 * ends[1] + k] - points[2 * ends[0] + k];
}

double bone_turn(const control_points *pins, size_t bone)
{
    double a[2], b[2];
    find_bone(pins->from, pins->bones + 2 * bone, a);
    find_bone(pins->to, pins->bones + 2 * bone, b);
    return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

/* Turns a bone and changes its length evenly. `end` is the end with a place. */
static void place_other_end(double *places, const control_points *pins, size_t bone, size_t end,
                            double share)
{
    const uint32_t *ends = pins->bones + 2 * bone;
    double a[2], b[2], turn = share * bone_turn(pins, bone), sign = end == 0 ? 1 : -1;
    find_bone(pins->from, ends, a);
    find_bone(pins->to, ends, b);
    double rest = hypot(a[0], a[1]), longer = 1 + share * (hypot(b[0], b[1]) / rest - 1);
    const double *from = places + 2 * ends[end];
    double *to = places + 2 * ends[1 - end];
    to[0] = from[0] + sign * longer * (cos(turn) * a[0] - sin(turn) * a[1]);
    to[1] = from[1] + sign * longer * (sin(turn) * a[0] + cos(turn) * a[1]);
}

/* Places the pins that bones join to pins with places. */
static void follow_bones(double *places, bool *placed, const control_points *pins, double share)
{
    for (bool again = true; again;) {
        again = false;
        for (size_t i = 0; i < pins->n_bones; i++) {
            const uint32_t *ends = pins->bones + 2 * i;
            if (placed[ends[0]] == placed[ends[1]])
                continue;
            size_t end = placed[ends[1]];
            place_other_end(places, pins, i, end, share);
            placed[ends[1 - end]] = true;
            again = true;
        }
    }
}

void pins_places(double *out, const control_points *pins, double share)
{
    bool *placed = need(pins->n, sizeof *placed);
    for (size_t i = 0; i < pins->n; i++) {
        if (placed[i])
            continue;
        for (size_t k = 2 * i; k < 2 * i + 2; k++)
            out[k] = (1 - share) * pins->from[k] + share * pins->to[k];
        placed[i] = true;
        follow_bones(out, placed, pins, share);
    }
    if (!(share < 1))
        memcpy(out, pins->to, pins->n * 2 * sizeof *out);
    free(placed);
}
