/* The start of a pairing by arc length. Centres and lengths are made equal. The best start has
 * the least mean square distance, which is the greatest cyclic correlation of the points (S.
 * Marshall, Review of shape coding techniques, 1989, uses it for boundaries). So discs keep
 * their direction. */
#include "match/outline/arc.h"

#include "match/outline/elastic.h"

enum { N = ICCP_MATCH_SAMPLES };

/* Samples relative to their centre, in units of the perimeter. */
static void sample(double *points, const iccp_outline *outline)
{
    double mean[2] = {0, 0};
    for (int k = 0; k < N; ++k) {
        iccp_outline_at(outline, (double)k / N, points + 2 * k);
        for (int e = 0; e < 2; ++e)
            mean[e] += points[2 * k + e] / N;
    }
    for (int k = 0; k < 2 * N; ++k)
        points[k] = (points[k] - mean[k % 2]) / outline->perimeter;
}

static double correlation(const double *p, const double *q, int shift)
{
    double sum = 0;
    for (int k = 0; k < N; ++k) {
        const double *const a = p + 2 * k, *const b = q + 2 * ((k + shift) % N);
        sum += a[0] * b[0] + a[1] * b[1];
    }
    return sum;
}

double iccp_arc_start(const iccp_outline *source, const iccp_outline *target)
{
    double p[2 * N], q[2 * N], best = 0;
    int shift = 0;
    sample(p, source);
    sample(q, target);
    for (int k = 0; k < N; ++k) {
        const double here = correlation(p, q, k);
        if (k == 0 || here > best) {
            best = here;
            shift = k;
        }
    }
    /* The peak of the parabola through the best shift and its neighbours. */
    const double before = correlation(p, q, (shift + N - 1) % N);
    const double after = correlation(p, q, (shift + 1) % N);
    const double bend = before - 2 * best + after;
    const double peak = bend < 0 ? (before - after) / (2 * bend) : 0;
    return iccp_outline_wrap((shift + peak) / N);
}
