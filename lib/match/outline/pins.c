/* Finds corners that correspond, and makes a pairing pass through them and all landmarks. */
#include "match/outline/pins.h"

#include "base/sort.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

enum { WINDOWS = 256 }; /* windows of the perimeter; each has at most one corner */

/* least_corner: a corner turns by at least this many turns over a window. alike, near_corner: two
 * corners may correspond if their turns differ by less than `alike`, and they lie within this share
 * of the perimeter. */
static const double least_corner = 25.0 / 360, alike = 60.0 / 360,
                    near_corner = 3.0 / ICCP_MATCH_SAMPLES;

/* arc_share: the weight of arc length in a pairing between pins. least_slope: the smallest slope of
 * steps along one outline alone that results. */
static const double arc_share = 0.01, least_slope = 1.25e-3;

typedef struct corner {
    double share, angle;
} corner;

typedef struct pin {
    double at[2];
    bool is_landmark;
} pin;

static int by_angle(const void *a, const void *b)
{
    const corner *const p = a, *const q = b;
    const double x = fabs(p->angle), y = fabs(q->angle);
    return x > y ? -1 : x < y ? 1 : p->share < q->share ? -1 : p->share > q->share;
}

static int by_place(const void *a, const void *b)
{
    const pin *const p = a, *const q = b;
    if (p->at[0] != q->at[0])
        return p->at[0] < q->at[0] ? -1 : 1;
    return (p->is_landmark ? 0 : 1) - (q->is_landmark ? 0 : 1);
}

/* The difference of two shares, the short way around. */
static double gap(double a, double b)
{
    return iccp_outline_wrap(a - b + 0.5) - 0.5;
}

static double turn_at(const iccp_outline *outline, double share)
{
    double p[2], q[2], r[2];
    iccp_outline_at(outline, share - 1.0 / WINDOWS, p);
    iccp_outline_at(outline, share, q);
    iccp_outline_at(outline, share + 1.0 / WINDOWS, r);
    const double f[2] = {r[0] - q[0], r[1] - q[1]}, b[2] = {q[0] - p[0], q[1] - p[1]};
    return iccp_atan2_turns(f[1] * b[0] - f[0] * b[1], f[0] * b[0] + f[1] * b[1]);
}

/* Finds the corners, the sharpest first, at most one in a window. `out` has room for WINDOWS. */
static icc_status find_corners(corner *out, size_t *n_out, const iccp_outline *outline,
                               const iccp_memory *memory)
{
    corner *const all = iccp_alloc(memory, outline->n, sizeof *all);
    if (all == NULL)
        return ICC_ERR_MEMORY;
    size_t n = 0;
    for (size_t k = 0; k < outline->n; ++k) {
        all[n] = (corner){outline->share[k], turn_at(outline, outline->share[k])};
        n += fabs(all[n].angle) >= least_corner;
    }
    iccp_sort(all, n, sizeof *all, by_angle);
    *n_out = 0;
    for (size_t k = 0; k < n && *n_out < WINDOWS; ++k) {
        bool is_free = true;
        for (size_t m = 0; m < *n_out && is_free; ++m)
            is_free = fabs(gap(all[k].share, out[m].share)) > 1.0 / WINDOWS;
        if (is_free)
            out[(*n_out)++] = all[k];
    }
    iccp_free(memory, all);
    return ICC_OK;
}

double iccp_knots_at(const iccp_pairing_knots *knots, double share)
{
    const double *const k = knots->knot;
    const double turns = floor(share - k[0]);
    double at = share - turns;
    if (at < k[0])
        at = k[0];
    size_t low = 0, high = knots->n;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (k[2 * middle] <= at)
            low = middle;
        else
            high = middle;
    }
    const bool is_last = low + 1 == knots->n;
    const double x = is_last ? k[0] + 1 : k[2 * low + 2], y = is_last ? k[1] + 1 : k[2 * low + 3];
    const double width = x - k[2 * low];
    const double part = width > 0 ? (at - k[2 * low]) / width : 0;
    return turns + k[2 * low + 1] + part * (y - k[2 * low + 1]);
}

/* Finds the corner nearest to a place, among those with a similar turn; n if there is none.
 * `image`: where the pairing takes the corners. */
static size_t nearest(const corner *of, const double *image, size_t n, double share, double angle)
{
    size_t best = n;
    double least = near_corner;
    for (size_t k = 0; k < n; ++k) {
        const double d = fabs(gap(image != NULL ? image[k] : of[k].share, share));
        if (d < least && fabs(of[k].angle - angle) < alike) {
            least = d;
            best = k;
        }
    }
    return best;
}

/* Pins corners that are each other's nearest. */
static size_t pin_corners(pin *pins, const iccp_pairing_knots *knots, const corner *a, size_t n_a,
                          const corner *b, size_t n_b)
{
    double image[WINDOWS];
    for (size_t k = 0; k < n_a; ++k)
        image[k] = iccp_knots_at(knots, a[k].share);
    size_t n = 0;
    for (size_t k = 0; k < n_a; ++k) {
        const size_t other = nearest(b, NULL, n_b, image[k], a[k].angle);
        if (other == n_b || nearest(a, image, n_a, b[other].share, b[other].angle) != k)
            continue;
        const double turns = floor(a[k].share - knots->knot[0]);
        pins[n++] =
            (pin){{a[k].share - turns, image[k] - turns + gap(b[other].share, image[k])}, false};
    }
    return n;
}

/* Drops pins for which landmarks or earlier pins leave no room. The rest are in order. */
static size_t thin_out(pin *pins, size_t n)
{
    size_t kept = 0;
    for (size_t k = 0; k < n; ++k) {
        bool has_room = true;
        if (!pins[k].is_landmark) {
            for (size_t m = 0; m < n && has_room; ++m)
                if (pins[m].is_landmark) {
                    const double dx = gap(pins[k].at[0], pins[m].at[0]);
                    const double dy = gap(pins[k].at[1], pins[m].at[1]);
                    has_room = fabs(dx) > 1e-6 && fabs(dy) > 1e-6 && (dx > 0) == (dy > 0);
                }
            has_room =
                has_room && (kept == 0 || (pins[k].at[0] > pins[kept - 1].at[0] + iccp_one_place &&
                                           pins[k].at[1] > pins[kept - 1].at[1] + iccp_one_place));
        }
        if (has_room)
            pins[kept++] = pins[k];
    }
    while (kept > 1 && !pins[kept - 1].is_landmark &&
           (pins[kept - 1].at[0] >= pins[0].at[0] + 1 - iccp_one_place ||
            pins[kept - 1].at[1] >= pins[0].at[1] + 1 - iccp_one_place))
        --kept;
    return kept;
}

/* The weight of arc length between two pins that are w apart on both sides. It is larger if the two
 * distances are very different, because half of it goes along each side. */
static double share_of_arc(const double *w)
{
    const double ratio = w[0] < w[1] ? w[0] / w[1] : w[1] / w[0];
    const double least = 2 * least_slope / ratio;
    return least < arc_share ? arc_share : least < 1 ? least : 1;
}

/* Makes the knots between two pins. They keep away from the pins, and arc length is blended in. */
static void blend(iccp_pairing_knots *out, const iccp_pairing_knots *from, const double *p,
                  const double *q)
{
    const double margin = 1.5 / ICCP_MATCH_SAMPLES;
    const double w[2] = {q[0] - p[0], q[1] - p[1]}, arc = share_of_arc(w);
    double room[2];
    for (int e = 0; e < 2; ++e)
        room[e] = margin < 0.3 * w[e] ? margin : 0.3 * w[e];
    double *last = out->knot + 2 * out->n++;
    memcpy(last, p, 2 * sizeof *p);
    for (int turn = -1; turn <= 2; ++turn)
        for (size_t k = 0; k < from->n; ++k) {
            const double x = from->knot[2 * k] + turn, y = from->knot[2 * k + 1] + turn;
            if (!(x > p[0] + room[0] && x < q[0] - room[0] && y > p[1] + room[1] &&
                  y < q[1] - room[1]))
                continue;
            const double u = ((x - p[0]) / w[0] + (y - p[1]) / w[1]) / 2;
            const double knot[2] = {(1 - arc) * x + arc * (p[0] + u * w[0]),
                                    (1 - arc) * y + arc * (p[1] + u * w[1])};
            if (!(knot[0] > last[0] && knot[1] > last[1]))
                continue;
            last = out->knot + 2 * out->n++;
            memcpy(last, knot, sizeof knot);
        }
}

/* Collects all pins in order, with the landmarks among them. */
static size_t collect(pin *pins, size_t n, const iccp_pairing_knots *knots, size_t n_landmarks,
                      const double *landmarks)
{
    for (size_t k = 0; k < n_landmarks; ++k) {
        const double *const l = landmarks + 2 * k;
        const double turns = floor(l[0] - knots->knot[0]);
        pins[n++] = (pin){{l[0] - turns, l[1] - turns}, true};
    }
    iccp_sort(pins, n, sizeof *pins, by_place);
    n = thin_out(pins, n);
    if (n == 0)
        pins[n++] = (pin){{knots->knot[0], knots->knot[1]}, false};
    return n;
}

icc_status iccp_pin(iccp_pairing_knots *knots, const iccp_outline *source,
                    const iccp_outline *target, size_t n_landmarks, const double *landmarks,
                    const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    size_t n_a = 0, n_b = 0;
    corner *const corners = iccp_alloc(memory, 2 * WINDOWS, sizeof *corners);
    pin *const pins = iccp_alloc(memory, WINDOWS + n_landmarks + 1, sizeof *pins);
    iccp_pairing_knots from = {.n = knots->n};
    from.knot = iccp_alloc(memory, 2 * (knots->n + 1), sizeof *from.knot);
    icc_status status =
        corners != NULL && pins != NULL && from.knot != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = find_corners(corners, &n_a, source, memory);
    if (status == ICC_OK)
        status = find_corners(corners + WINDOWS, &n_b, target, memory);
    if (status == ICC_OK) {
        memcpy(from.knot, knots->knot, 2 * knots->n * sizeof *from.knot);
        size_t n = pin_corners(pins, &from, corners, n_a, corners + WINDOWS, n_b);
        n = collect(pins, n, &from, n_landmarks, landmarks);
        knots->n = 0;
        for (size_t k = 0; k < n; ++k) {
            double next[2] = {pins[(k + 1) % n].at[0], pins[(k + 1) % n].at[1]};
            if (k + 1 == n) {
                next[0] += 1;
                next[1] += 1;
            }
            blend(knots, &from, pins[k].at, next);
        }
    }
    iccp_free(memory, from.knot);
    iccp_free(memory, pins);
    iccp_free(memory, corners);
    return status;
}
