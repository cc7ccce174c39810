/* Refines a candidate of the elastic search with the directions of tangents after its own rotation
 * (the square-root velocity of A. Srivastava et al., Shape analysis of elastic curves in Euclidean
 * spaces, 2011). The candidate is cut open at its most certain place. Then the best path close to
 * it is found. */
#include "match/outline/elastic_candidate.h"

#include "match/outline/widths.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

enum {
    N = ICCP_MATCH_SAMPLES,
    N_PASSES = 2,
    N_BENT = 4,         /* passes of each kind with a separate rotation for each sample */
    BAND = N / 10,      /* how far a pass may leave the path of the one before */
    MARGIN = 8,         /* columns beyond the band that steps may cross */
    HALF = N / 64,      /* samples on each side of a place that is judged for certainty */
    WIDE = 3 * (N / 32) /* samples on each side in the mean of a rotation */
};

/* Settings for passes in which large scales count little. They are the samples on each side of a
 * patch, the samples in the mean of a rotation, the weight of tangents, and the number of passes.
 *
 * On bent development pairs with few vertices, weights of 0.8, 0.9 and 1 were tried with 12 to 32
 * samples on each side. A weight of 0.8 with 16 samples had the least energy. Coasts have details
 * that identify places within short patches, and may be stretched too unevenly for long ones.
 * There, weights of 0.8 to 1 were tried with 3 to 24 samples. The settings here found the limbs of
 * a swirl most often. */
typedef struct closeness {
    int32_t patch, reach;
    double tangents;
    int rounds;
} closeness;

static const closeness smooth = {16, 16, 0.8, 1}, fine = {6, 10, 0.92, 2};

/* `bent`: a pairing is refined with local rotations if their mean is shorter than this. On the
 * development pairs (tests/bench/bench_match.c), bent limbs, a swirl and a coast in two projections
 * mostly have 0.95 to 0.966. Pairs that one rotation serves better have 0.978 or more. Up to
 * `perhaps_bent`, the result is kept if it changes widths more evenly by the factor `fairer`. A
 * draw of the swirl with 0.976 has the factor 0.5, and others below 0.99 have 0.98 or more. */
static const double bent = 0.97, perhaps_bent = 0.985, fairer = 0.7;

/* Sets each sample's place: its first column in its row. Rows without one are interpolated. */
void iccp_elastic_candidate_place(iccp_elastic_candidate *c)
{
    const int32_t *const p = c->path.points;
    for (int32_t k = 0; k < c->path.n_points; ++k) {
        if (k > 0 && p[2 * k - 2] == p[2 * k])
            continue;
        for (int32_t e = k > 0 ? p[2 * k - 2] + 1 : p[2 * k]; e <= p[2 * k] && e < N; ++e) {
            const float part =
                e == p[2 * k] ? 0 : (float)(p[2 * k] - e) / (float)(p[2 * k] - p[2 * k - 2]);
            const float at =
                k == 0 ? (float)p[1]
                       : (float)p[2 * k + 1] - part * (float)(p[2 * k + 1] - p[2 * k - 1]);
            const int32_t row = (c->i + e) % N;
            c->place[row] = at + (float)c->j - (float)(c->i + e - row);
        }
    }
}

static void mean_turns(const iccp_descriptor *b, iccp_descriptor *mean)
{
    *mean = (iccp_descriptor){{0}, {0}};
    for (int k = 0; k < N; ++k)
        for (int m = 0; m < 2 * ICCP_SCALES; ++m)
            mean->turns[m] += b[k].turns[m] / N;
}

/* Finds the sample that is best distinguished from others and well matched. A path may be cut
 * there. */
static int32_t surest(const iccp_samples *s, const iccp_elastic_candidate *c, double (*rotation)[2])
{
    static const double none[2] = {1, 0};
    iccp_descriptor mean;
    mean_turns(s->b, &mean);
    double here[N], best = -HUGE_VAL;
    for (int k = 0; k < N; ++k) {
        const int32_t j = (int32_t)floor((double)c->place[k] + 0.5);
        here[k] = (double)iccp_descriptor_cost(&s->a[k], &s->b[(j % N + N) % N], rotation[k],
                                               iccp_tangents);
    }
    int32_t found = 0;
    for (int k = 0; k < N; ++k) {
        double sum = 0;
        for (int m = -HALF; m <= HALF; ++m)
            sum += here[(k + m + N) % N];
        const double value =
            (double)iccp_descriptor_cost(&s->a[k], &mean, none, 0) - 2 * sum / (2 * HALF + 1);
        if (value > best) {
            best = value;
            found = k;
        }
    }
    return found;
}

/* The rotation along a candidate's path. */
static void rotation_of(const iccp_samples *s, iccp_elastic_candidate *c)
{
    double sum[2] = {0, 0};
    for (int32_t k = 0; k < c->path.n_points; ++k) {
        const int32_t i = c->path.points[2 * k] + c->i, j = c->path.points[2 * k + 1] + c->j;
        iccp_descriptor_turn(sum, &s->a[i % N], &s->b[(j % N + N) % N]);
    }
    iccp_unit(sum);
    memcpy(c->rotation, sum, sizeof sum);
}

/* Finds the rotation around each sample of the source, where closer samples count more. Returns the
 * length of their mean, which is 1 if all rotations are equal. */
static double rotations_along(double (*rotation)[2], const iccp_samples *s,
                              const iccp_elastic_candidate *c, int reach)
{
    double turn[N][2] = {{0}}, mean[2] = {0, 0};
    for (int k = 0; k < N; ++k) {
        const int32_t j = (int32_t)floor((double)c->place[k] + 0.5);
        iccp_descriptor_turn(turn[k], &s->a[k], &s->b[(j % N + N) % N]);
    }
    for (int k = 0; k < N; ++k) {
        double sum[2] = {0, 0};
        for (int m = -reach; m <= reach; ++m)
            for (int e = 0; e < 2; ++e)
                sum[e] += (reach + 1 - (m < 0 ? -m : m)) * turn[(k + m + N) % N][e];
        iccp_unit(sum);
        memcpy(rotation[k], sum, sizeof sum);
        for (int e = 0; e < 2; ++e)
            mean[e] += sum[e] / N;
    }
    return iccp_hypot(mean[0], mean[1]);
}

/* The cost of a pair by tangents alone: how well the tangents around it agree after the best
 * rotation. */
static float patch_cost(const iccp_samples *s, int32_t i, int32_t j)
{
    const int32_t n = s->are_fine ? fine.patch : smooth.patch;
    double sum[2] = {0, 0};
    for (int32_t m = -n; m <= n; ++m) {
        double turn[2] = {0, 0};
        iccp_descriptor_turn(turn, &s->a[(i + m + N) % N], &s->b[((j + m) % N + N) % N]);
        for (int e = 0; e < 2; ++e)
            sum[e] += (n + 1 - (m < 0 ? -m : m)) * turn[e];
    }
    return (float)(2 - 2 * iccp_hypot(sum[0], sum[1]) / ((n + 1) * (n + 1)));
}

/* Finds a better path close to the candidate's, cut at its most certain place. Tangents count with
 * the weight `share`, after the rotation of each sample of the source. With a `share` of 0, patches
 * are compared without rotations. */
static void follow(iccp_samples *s, iccp_elastic_candidate *c, double (*rotation)[2], double share)
{
    const int32_t i = surest(s, c, rotation), j = (int32_t)floor((double)c->place[i] + 0.5);
    for (int32_t row = 0; row <= N; ++row) {
        float *const cost = s->cost + (size_t)row * (N + 1);
        const int32_t at = (i + row) % N;
        const double place = row == N ? N : (double)c->place[at] + (i + row >= N ? N : 0) - j;
        const double low = place - BAND, high = place + BAND;
        s->lattice.low[row] = low > 0 ? (int32_t)low : 0;
        s->lattice.high[row] = high < N ? (int32_t)high : N;
        const int32_t from = s->lattice.low[row] - MARGIN, to = s->lattice.high[row] + MARGIN;
        for (int32_t k = from > 0 ? from : 0; k <= to && k <= N; ++k)
            cost[k] = share > 0 ? iccp_descriptor_cost(&s->a[at], &s->b[((j + k) % N + N) % N],
                                                       rotation[at], share)
                                : patch_cost(s, at, j + k);
    }
    iccp_lattice_search(&s->path, &s->lattice, N, s->cost, N + 1, 0);
    if (s->path.n_points == 0)
        return;
    c->i = i;
    c->j = j;
    c->path.n_points = s->path.n_points;
    c->path.cost = s->path.cost;
    memcpy(c->path.points, s->path.points, 2 * (size_t)s->path.n_points * sizeof *s->path.points);
    iccp_elastic_candidate_place(c);
}

void iccp_elastic_candidate_follow(iccp_elastic_candidate *c, iccp_samples *s)
{
    double rotation[N][2];
    for (int pass = 0; pass < N_PASSES; ++pass) {
        rotation_of(s, c);
        for (int k = 0; k < N; ++k)
            memcpy(rotation[k], c->rotation, sizeof c->rotation);
        follow(s, c, rotation, iccp_tangents);
    }
}

/* If the target is bent, large scales mislead, and so do rotations along a path that they misled.
 * So they count little once the path is close, and the first of these passes uses no rotation. */
static void follow_near(iccp_elastic_candidate *c, iccp_samples *s, double (*rotation)[2])
{
    const closeness near = s->are_fine ? fine : smooth;
    for (int round = 0; round < near.rounds; ++round) {
        follow(s, c, rotation, 0);
        for (int pass = 0; pass < N_BENT; ++pass) {
            (void)rotations_along(rotation, s, c, near.reach);
            follow(s, c, rotation, near.tangents);
        }
    }
}

static void copy(iccp_elastic_candidate *to, const iccp_elastic_candidate *from)
{
    int32_t *const points = to->path.points;
    *to = *from;
    to->path.points = points;
    memcpy(points, from->path.points, 2 * (size_t)from->path.n_points * sizeof *points);
}

/* Refines the candidate from where it is, and by way of large scales if it is certainly bent. The
 * result with more even widths is kept. Long chords win on d02, d03 and d16. Without them, d17 with
 * one landmark and the coast of Canada (d13) come out better. */
void iccp_elastic_candidate_bend(iccp_elastic_candidate *c, iccp_elastic_candidate *spare,
                                 iccp_samples *s)
{
    iccp_widths widths;
    double rotation[N][2];
    const double straight = rotations_along(rotation, s, c, WIDE);
    if (straight >= perhaps_bent)
        return;
    iccp_widths_measure(&widths, s->source, s->target);
    copy(spare, c);
    follow_near(spare, s, rotation);
    double most = fairer * iccp_widths_change(&widths, c->place);
    if (straight < bent) {
        for (int pass = 0; pass < N_BENT; ++pass) {
            follow(s, c, rotation, iccp_tangents);
            (void)rotations_along(rotation, s, c, WIDE);
        }
        follow_near(c, s, rotation);
        most = iccp_widths_change(&widths, c->place);
    }
    if (iccp_widths_change(&widths, spare->place) < most)
        copy(c, spare);
}
