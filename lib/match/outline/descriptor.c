/* Turns of chords at several scales: the discrete curvature of an outline, as a complex number of
 * length 1. Multi-scale shape contexts by arc length do the same. The idea of several scales is
 * that of F. Mokhtarian and A. Mackworth, A theory of multiscale, curvature-based shape
 * representation for planar curves, 1992. The constants gave the fewest errors on the pairs of
 * tests/bench/bench_match.c. */
#include "match/outline/descriptor.h"

#include "math/elementary.h"

#include <math.h>

/* Chord lengths as shares of the perimeter, and weights whose sum is 1. */
static const double scale[ICCP_SCALES] = {1 / 128.0, 1 / 64.0, 1 / 32.0,
                                          1 / 16.0,  1 / 8.0,  1 / 4.0};
static const double weight[ICCP_SCALES] = {0.5 / 5.5, 1 / 5.5, 1 / 5.5, 1 / 5.5, 1 / 5.5, 1 / 5.5};

void iccp_unit(double *z)
{
    const double length = iccp_hypot(z[0], z[1]);
    z[0] = length > 0 ? z[0] / length : 1;
    z[1] = length > 0 ? z[1] / length : 0;
}

/* Sets f / |f| times the conjugate of b / |b|, or 0 if a chord has no length. */
static void turn(float *out, double size, const double *back, const double *here, const double *on)
{
    const double f[2] = {on[0] - here[0], on[1] - here[1]};
    const double b[2] = {here[0] - back[0], here[1] - back[1]};
    const double length = iccp_hypot(f[0], f[1]) * iccp_hypot(b[0], b[1]);
    out[0] = length > 0 ? (float)(size * (f[0] * b[0] + f[1] * b[1]) / length) : 0;
    out[1] = length > 0 ? (float)(size * (f[1] * b[0] - f[0] * b[1]) / length) : 0;
}

void iccp_descriptors(iccp_descriptor *out, const iccp_outline *outline, size_t n,
                      const double *share, double step)
{
    for (size_t i = 0; i < n; ++i) {
        double here[2], back[2], on[2];
        iccp_outline_at(outline, share[i], here);
        for (int k = 0; k < ICCP_SCALES; ++k) {
            iccp_outline_at(outline, share[i] - scale[k], back);
            iccp_outline_at(outline, share[i] + scale[k], on);
            turn(out[i].turns + 2 * k, sqrt(weight[k]), back, here, on);
        }
        iccp_outline_at(outline, share[i] - step, back);
        iccp_outline_at(outline, share[i] + step, on);
        double along[2] = {on[0] - back[0], on[1] - back[1]};
        iccp_unit(along);
        out[i].tangent[0] = (float)along[0];
        out[i].tangent[1] = (float)along[1];
    }
}

float iccp_descriptor_cost(const iccp_descriptor *a, const iccp_descriptor *b,
                           const double *rotation, double share)
{
    float turns = 0;
    for (int k = 0; k < 2 * ICCP_SCALES; ++k)
        turns += a->turns[k] * b->turns[k];
    const double x = rotation[0] * (double)b->tangent[0] - rotation[1] * (double)b->tangent[1];
    const double y = rotation[0] * (double)b->tangent[1] + rotation[1] * (double)b->tangent[0];
    const double tangents = (double)a->tangent[0] * x + (double)a->tangent[1] * y;
    const double cost = 2 - 2 * ((1 - share) * (double)turns + share * tangents);
    return cost > 0 ? (float)cost : 0;
}

void iccp_descriptor_turn(double *sum, const iccp_descriptor *a, const iccp_descriptor *b)
{
    const double p = (double)a->tangent[0], q = (double)a->tangent[1];
    const double x = (double)b->tangent[0], y = (double)b->tangent[1];
    sum[0] += p * x + q * y;
    sum[1] += q * x - p * y;
}
