/* Places of an outline that may be paired, their chords, and the bends of a pairing. */
#include "match/outline/places.h"

#include "match/outline/descriptor.h"
#include "match/outline/pins.h"

#include <math.h>

/* The largest slope of a bend. The least one is its inverse. */
static const double most_slope = 16;

icc_status iccp_places_create(iccp_places *places, const iccp_outline *outline,
                              const iccp_outline *other, const iccp_memory *memory)
{
    const size_t n = outline->n + other->n + 4;
    *places = (iccp_places){0};
    places->share = iccp_alloc(memory, n, sizeof *places->share);
    float *const parts =
        iccp_alloc(memory, n, ICCP_CHORD * (size_t)ICCP_CHORD_PARTS * sizeof *parts);
    places->chord[0][0] = parts;
    if (places->share == NULL || parts == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < ICCP_CHORD * (size_t)ICCP_CHORD_PARTS; ++k)
        places->chord[k / ICCP_CHORD_PARTS][k % ICCP_CHORD_PARTS] = parts + k * n;
    return ICC_OK;
}

void iccp_places_free(iccp_places *places, const iccp_memory *memory)
{
    iccp_free(memory, places->share);
    iccp_free(memory, places->chord[0][0]);
}

/* The number of vertices before a share, counted through all turns. */
static int64_t count_before(const iccp_outline *outline, double share)
{
    double along;
    const size_t edge = iccp_outline_edge(outline, share, &along);
    return (int64_t)floor(share) * (int64_t)outline->n + (int64_t)edge + 1;
}

/* The share of a vertex that is counted in this way. */
static double share_of(const iccp_outline *outline, int64_t count)
{
    const int64_t n = (int64_t)outline->n, turns = count >= 0 ? count / n : -((n - 1 - count) / n);
    return (double)turns + outline->share[count - turns * n];
}

static void add(iccp_places *places, double share)
{
    if (places->n == 0 || share > places->share[places->n - 1])
        places->share[places->n++] = share;
}

/* Adds places on an edge that is paired with several vertices: for every second vertex between the
 * first and the last, and for those far from both ends. */
static void add_between(iccp_places *places, const iccp_outline *other,
                        const iccp_pairing_knots *knots, double from, double to)
{
    const double a = iccp_knots_at(knots, from), b = iccp_knots_at(knots, to);
    const int64_t first = count_before(other, a), last = count_before(other, b);
    for (int64_t k = first; k < last; ++k) {
        const double at = from + (share_of(other, k) - a) / (b - a) * (to - from);
        const bool is_far = at > from + iccp_near / 2 && at < to - iccp_near / 2;
        if (at < to && (is_far || ((k - first) % 2 == 1 && k + 1 < last)))
            add(places, at);
    }
}

void iccp_places_find(iccp_places *places, const iccp_outline *outline, const iccp_outline *other,
                      const iccp_pairing_knots *knots, double from, double to)
{
    double last = from;
    places->n = 0;
    add(places, from);
    for (int64_t k = count_before(outline, from); last < to; ++k) {
        const double share = share_of(outline, k), next = share < to ? share : to;
        if (next <= last)
            continue;
        add_between(places, other, knots, last, next);
        add(places, next);
        last = next;
    }
}

void iccp_places_chords(iccp_places *places, const iccp_outline *outline, const iccp_bend *bends)
{
    static const iccp_bend none = {{1, 0}, 1};
    double point[ICCP_CHORD + 1][2];
    for (size_t k = 0; k < places->n; ++k) {
        const double share = places->share[k];
        const double *const to = point[k % (ICCP_CHORD + 1)];
        iccp_outline_at(outline, share, point[k % (ICCP_CHORD + 1)]);
        const iccp_bend *const bend =
            bends != NULL ? &bends[(size_t)(ICCP_BENDS * iccp_outline_wrap(share))] : &none;
        for (size_t n = 1; n <= ICCP_CHORD && n <= k; ++n) {
            const double *const from = point[(k - n) % (ICCP_CHORD + 1)];
            const double root = sqrt(share - places->share[k - n]);
            const double scale = 1 / (root * outline->perimeter);
            const double d[2] = {scale * (to[0] - from[0]), scale * (to[1] - from[1])};
            const double *const z = bend->rotation;
            float *const *const chord = places->chord[n - 1];
            chord[ICCP_CHORD_X][k] = (float)(d[0] * z[0] - d[1] * z[1]);
            chord[ICCP_CHORD_Y][k] = (float)(d[0] * z[1] + d[1] * z[0]);
            chord[ICCP_CHORD_ROOT][k] = (float)(root * bend->root);
        }
    }
}

void iccp_bends_find(iccp_bend *bends, const iccp_pairing_knots *knots, const iccp_outline *source,
                     const iccp_outline *target)
{
    static const double chords[] = {1.0 / 128, 1.0 / 64, 1.0 / 32};
    for (int k = 0; k < ICCP_BENDS; ++k) {
        double sum[2] = {0, 0}, slope = 1;
        for (size_t c = 0; c < sizeof chords / sizeof *chords; ++c) {
            double p[2][2], q[2][2], share[2];
            for (int end = 0; end < 2; ++end) {
                const double at = (k + 0.5) / ICCP_BENDS + (end - 0.5) * chords[c];
                share[end] = iccp_knots_at(knots, at);
                iccp_outline_at(source, at, p[end]);
                iccp_outline_at(target, share[end], q[end]);
            }
            const double x[2] = {p[1][0] - p[0][0], p[1][1] - p[0][1]};
            const double y[2] = {q[1][0] - q[0][0], q[1][1] - q[0][1]};
            sum[0] += (x[0] * y[0] + x[1] * y[1]) / chords[c];
            sum[1] += (x[0] * y[1] - x[1] * y[0]) / chords[c];
            slope = (share[1] - share[0]) / chords[c];
        }
        iccp_unit(sum);
        slope = slope < most_slope ? slope : most_slope;
        slope = slope > 1 / most_slope ? slope : 1 / most_slope;
        bends[k] = (iccp_bend){{sum[0], sum[1]}, sqrt(slope)};
    }
}
