/* A rotation and a shift by least squares. They change no energy, so nothing has to be solved for
 * them. Without them, pins that all turn by a half circle would meet on their straight ways. */
#include "fit/elastic/rigid_start.h"

#include "fit/elastic/elastic_model.h"
#include "math/elementary.h"

#include <string.h>

/* Returns the number of held vertices, or 0 if some told vertex has no way to go or slides. */
static size_t count_moving(size_t n_points, const uint8_t *hold, const double *images,
                           const double *targets)
{
    size_t n = 0;
    for (size_t v = 0; v < n_points; ++v) {
        if (hold[v] == ICCP_LOOSE)
            continue;
        if (hold[v] == ICCP_SLIDING ||
            memcmp(images + 2 * v, targets + 2 * v, 2 * sizeof *images) == 0)
            return 0;
        ++n;
    }
    return n;
}

static void move_point(const iccp_rigid_motion *m, const double *p, double *moved)
{
    const double x = p[0] - m->from[0], y = p[1] - m->from[1];
    moved[0] = m->turn[0] * x - m->turn[1] * y + m->to[0];
    moved[1] = m->turn[1] * x + m->turn[0] * y + m->to[1];
}

/* Returns true if the motion leaves less than half of the ways, by their squares. */
static bool is_worth_while(const iccp_rigid_motion *m, size_t n_points, const uint8_t *hold,
                           const double *images, const double *targets)
{
    double before = 0, after = 0;
    for (size_t v = 0; v < n_points; ++v) {
        double moved[2];
        if (hold[v] != ICCP_HELD)
            continue;
        move_point(m, images + 2 * v, moved);
        for (size_t d = 0; d < 2; ++d) {
            const double way = targets[2 * v + d] - images[2 * v + d];
            const double left = targets[2 * v + d] - moved[d];
            before += way * way;
            after += left * left;
        }
    }
    return after < before / 2;
}

bool iccp_rigid_motion_find(iccp_rigid_motion *motion, size_t n_points, const uint8_t *hold,
                            const double *images, const double *targets)
{
    iccp_rigid_motion *m = motion;
    const size_t n = count_moving(n_points, hold, images, targets);
    double sum[2] = {0, 0}; /* of conj(a) b, relative to the centroids */
    *m = (iccp_rigid_motion){.turn = {1, 0}};
    for (size_t v = 0; n > 0 && v < n_points; ++v)
        for (size_t d = 0; d < 2 && hold[v] == ICCP_HELD; ++d) {
            m->from[d] += images[2 * v + d] / (double)n;
            m->to[d] += targets[2 * v + d] / (double)n;
        }
    for (size_t v = 0; v < n_points; ++v) {
        if (hold[v] != ICCP_HELD)
            continue;
        const double a[2] = {images[2 * v] - m->from[0], images[2 * v + 1] - m->from[1]};
        const double b[2] = {targets[2 * v] - m->to[0], targets[2 * v + 1] - m->to[1]};
        sum[0] += a[0] * b[0] + a[1] * b[1];
        sum[1] += a[0] * b[1] - a[1] * b[0];
    }
    const double length = iccp_hypot(sum[0], sum[1]);
    for (size_t d = 0; n > 1 && length > 0 && d < 2; ++d)
        m->turn[d] = sum[d] / length;
    return n > 0 && is_worth_while(m, n_points, hold, images, targets);
}

void iccp_rigid_motion_apply(const iccp_rigid_motion *motion, size_t n_points, double *images)
{
    for (size_t v = 0; v < n_points; ++v) {
        double moved[2];
        move_point(motion, images + 2 * v, moved);
        memcpy(images + 2 * v, moved, sizeof moved);
    }
}
