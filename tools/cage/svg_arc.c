/* Scalable Vector Graphics 1.1, second edition, 2011, appendix F.6: goes from both ends to the
 * centre, where the ellipse is a unit circle, and enlarges radii that are too small. Angles are
 * halved by chords, so only square roots are needed. */
#include "cage/svg_arc.h"

#include <math.h>
#include <string.h>

/* Uses Taylor's series within 45 degrees, where 9 terms are as exact as doubles. */
void turn_by(double degrees, double *cosine, double *sine)
{
    const double degree = 0.017453292519943295;
    double turns = fmod(degrees, 360), quarter = floor(turns / 90 + 0.5);
    double x = (turns - 90 * quarter) * degree, c = 1, s = 1;
    for (int k = 18; k > 0; k -= 2) {
        c = 1 - x * x / ((k - 1) * k) * c;
        s = 1 - x * x / (k * (k + 1)) * s;
    }
    s *= x;
    int n = (int)quarter & 3;
    *cosine = n == 0 ? c : n == 1 ? -s : n == 2 ? -c : s;
    *sine = n == 0 ? s : n == 1 ? c : n == 2 ? -s : -c;
}

/* The middle of an arc of the unit circle: to the right of its chord if `positive`, else to the
 * left. */
static void halve(double out[2], const double from[2], const double to[2], bool positive)
{
    double x = to[0] - from[0], y = to[1] - from[1], length = sqrt(x * x + y * y);
    double side = positive ? 1 : -1;
    out[0] = side * y / length;
    out[1] = -side * x / length;
}

/* An arc of the unit circle. A turn by (c, s) and two scales map the arc to it. */
typedef struct unit_arc {
    double c, s, rx, ry;
    double u, v, square; /* half the chord, and its square */
} unit_arc;

/* False if the arc is a line. */
static bool find_unit(unit_arc *out, const double from[2], const arc *a)
{
    double rx = fabs(a->radii[0]), ry = fabs(a->radii[1]), c, s;
    double hx = (from[0] - a->to[0]) / 2, hy = (from[1] - a->to[1]) / 2;
    turn_by(a->turn, &c, &s);
    double u = (c * hx + s * hy) / rx, v = (c * hy - s * hx) / ry, square = u * u + v * v;
    if (!(rx > 0 && ry > 0 && square > 0 && square < HUGE_VAL))
        return false;
    double reach = square > 1 ? sqrt(square) : 1;
    *out = (unit_arc){c, s, rx * reach, ry * reach, u / reach, v / reach, square > 1 ? 1 : square};
    return true;
}

int arc_inner(double *out, int n_edges, const double from[2], const arc *a)
{
    unit_arc x;
    if (!find_unit(&x, from, a))
        return 0;
    double off = sqrt((1 - x.square) / x.square) * (a->large != a->positive ? 1 : -1);
    const double centre[2] = {off * x.v, -off * x.u};
    out[0] = x.u - centre[0];
    out[1] = x.v - centre[1];
    out[2 * n_edges] = -x.u - centre[0];
    out[2 * n_edges + 1] = -x.v - centre[1];
    for (int step = n_edges; step > 1; step /= 2)
        for (int i = 0; i < n_edges; i += step)
            halve(out + 2 * i + step, out + 2 * i, out + 2 * (i + step), a->positive);
    for (int i = 1; i < n_edges; i++) {
        double px = x.rx * (out[2 * i] + centre[0]), py = x.ry * (out[2 * i + 1] + centre[1]);
        out[2 * i - 2] = x.c * px - x.s * py + (from[0] + a->to[0]) / 2;
        out[2 * i - 1] = x.s * px + x.c * py + (from[1] + a->to[1]) / 2;
    }
    return n_edges - 1;
}

int arc_edges(const double from[2], const arc *a, double tolerance, int most)
{
    unit_arc x;
    if (!find_unit(&x, from, a))
        return 1;
    double cosine = sqrt(1 - x.square) * (a->large ? -1 : 1); /* of half the angle of an edge */
    int n = 1;
    for (; n <= most && fmax(x.rx, x.ry) * (1 - cosine) > tolerance; n *= 2)
        cosine = sqrt((1 + cosine) / 2);
    return n;
}
