/* Measures how evenly a pairing changes an outline's widths. If one side of a limb is paired with a
 * shifted part of the other outline, each side may look as similar as in the right pairing. But
 * opposite points then no longer correspond. */
#include "match/outline/widths.h"

#include "math/elementary.h"
#include "math/vec.h"

#include <math.h>

enum { N = ICCP_MATCH_SAMPLES, BESIDE = 4 };

/* An opposite point lies within 45 degrees of the normal: the squared cosine. */
static const double least_cosine2 = 0.5;

/* Finds the nearest sample that lies inside, roughly along the normal, and not beside sample k. */
static int32_t find_across(double (*point)[2], int32_t k)
{
    const double *const p = point[k], *const before = point[(k + N - 1) % N],
                        *const after = point[(k + 1) % N];
    const double normal[2] = {before[1] - after[1], after[0] - before[0]};
    const double least_along2 = least_cosine2 * iccp_vec_dot(2, normal, normal);
    double least = HUGE_VAL;
    int32_t best = -1;
    for (int32_t i = BESIDE + 1; i < N - BESIDE; ++i) {
        const double *const q = point[(k + i) % N];
        const double d[2] = {q[0] - p[0], q[1] - p[1]}, square = iccp_vec_dot(2, d, d);
        const double along = iccp_vec_dot(2, d, normal);
        if (square < least && along > 0 && along * along > least_along2 * square) {
            least = square;
            best = (k + i) % N;
        }
    }
    return best;
}

void iccp_widths_measure(iccp_widths *w, const iccp_outline *source, const iccp_outline *target)
{
    const iccp_outline *const outlines[2] = {source, target};
    for (int side = 0; side < 2; ++side) {
        for (int k = 0; k < N; ++k)
            iccp_outline_at(outlines[side], (double)k / N, w->point[side][k]);
        for (int32_t k = 0; k < N; ++k)
            w->across[side][k] = find_across(w->point[side], k);
    }
}

/* A point between two samples. */
static void point_at(double out[2], const iccp_widths *w, int side, double at)
{
    const double whole = floor(at), f = at - whole;
    const int32_t k = (int32_t)(whole - N * floor(whole / N)) % N;
    for (int e = 0; e < 2; ++e)
        out[e] = (1 - f) * w->point[side][k][e] + f * w->point[side][(k + 1) % N][e];
}

/* Inverts a pairing: finds the source's places that are paired with the target's samples. */
static void invert(float *back, const float *place)
{
    for (int k = 0; k < N; ++k) {
        const double from = place[k], step = (double)place[(k + 1) % N] - from;
        const double width = step - N * floor(step / N);
        for (double at = ceil(from); at < from + width && width < N / 2; ++at)
            back[(int32_t)(at - N * floor(at / N)) % N] = (float)(k + (at - from) / width);
    }
}

double iccp_widths_change(const iccp_widths *w, const float *place)
{
    float back[N] = {0};
    double sum = 0, squares = 0;
    size_t n = 0;
    invert(back, place);
    for (int side = 0; side < 2; ++side) {
        const float *const to = side == 0 ? place : back;
        for (int32_t k = 0; k < N; ++k) {
            const int32_t i = w->across[side][k];
            double p[2], q[2];
            if (i < 0)
                continue;
            point_at(p, w, 1 - side, (double)to[k]);
            point_at(q, w, 1 - side, (double)to[i]);
            const double before = iccp_vec_distance2(2, w->point[side][k], w->point[side][i]);
            const double after = iccp_vec_distance2(2, p, q);
            if (!(before > 0 && after > 0))
                continue;
            const double change = iccp_ln(after / before) / 2 * (side == 0 ? 1 : -1);
            sum += change;
            squares += change * change;
            ++n;
        }
    }
    return n > 0 ? squares / (double)n - sum / (double)n * (sum / (double)n) : 0;
}
