/* Scalable Vector Graphics 1.1, second edition, 2011, appendix F.6: from both ends to the centre,
 * where the ellipse is a unit circle, and radii that are too small made larger. Angles are halved by
 * chords instead of computed, so that nothing but square roots is needed. */
#include "cage/svg_arc.h"

#include <math.h>
#include <string.h>

/* By Taylor's series within 45 degrees, where 9 terms are as exact as doubles. */
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

/* The middle of an arc of the unit circle: to the right of its chord if it is positive, else to the
 * left. */
static void halve(double out[2], const double from[2], const double to[2], bool positive)
{
    double x = to[0] - from[0], y = to[1] - from[1], length = sqrt(x * x + y * y);
    double side = positive ? 1 : -1;
    out[0] = side * y / length;
    out[1] = -side * x / length;
}

int arc_inner(double out[2 * ARC_EDGES], const double from[2], const arc *a)
{
    double rx = fabs(a->radii[0]), ry = fabs(a->radii[1]), c, s;
    double hx = (from[0] - a->to[0]) / 2, hy = (from[1] - a->to[1]) / 2;
    turn_by(a->turn, &c, &s);
    double u = (c * hx + s * hy) / rx, v = (c * hy - s * hx) / ry, square = u * u + v * v;
    if (!(rx > 0 && ry > 0 && square > 0 && square < HUGE_VAL))
        return 0;
    double reach = square > 1 ? sqrt(square) : 1;
    rx *= reach;
    ry *= reach;
    u /= reach;
    v /= reach;
    square = square > 1 ? 1 : square;
    double off = sqrt((1 - square) / square) * (a->large != a->positive ? 1 : -1);
    const double centre[2] = {off * v, -off * u};
    double on[ARC_EDGES + 1][2] = {{u - centre[0], v - centre[1]}};
    on[ARC_EDGES][0] = -u - centre[0];
    on[ARC_EDGES][1] = -v - centre[1];
    for (int step = ARC_EDGES; step > 1; step /= 2)
        for (int i = 0; i < ARC_EDGES; i += step)
            halve(on[i + step / 2], on[i], on[i + step], a->positive);
    for (int i = 1; i < ARC_EDGES; i++) {
        double x = rx * (on[i][0] + centre[0]), y = ry * (on[i][1] + centre[1]);
        out[2 * i - 2] = c * x - s * y + (from[0] + a->to[0]) / 2;
        out[2 * i - 1] = s * x + c * y + (from[1] + a->to[1]) / 2;
    }
    return ARC_EDGES - 1;
}
