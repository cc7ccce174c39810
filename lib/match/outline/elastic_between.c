/* Elastic matching between landmarks. Each piece between two landmarks gets its own search, with
 * the costs of match/outline/elastic.c. No start is searched. */
#include "match/outline/elastic.h"

#include "match/outline/descriptor.h"
#include "match/outline/lattice_path.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

enum { N = ICCP_MATCH_SAMPLES, LEAST = 4, N_PASSES = 3 };

typedef struct piece {
    double from[2], width[2]; /* shares, in the source and in the target */
    int32_t n;                /* samples */
} piece;

typedef struct between {
    iccp_descriptor *a, *b; /* N + 1 */
    float *cost;            /* (N + 1)^2 */
    double share[N + 1];
    iccp_lattice lattice;
    iccp_lattice_path path;
} between;

static void release(between *w, const iccp_memory *memory)
{
    if (w == NULL)
        return;
    iccp_lattice_free(&w->lattice, memory);
    iccp_free(memory, w->path.points);
    iccp_free(memory, w->cost);
    iccp_free(memory, w->a);
    iccp_free(memory, w->b);
    iccp_free(memory, w);
}

/* Makes room for pieces of at most n samples. */
static between *prepare(size_t n, const iccp_memory *memory)
{
    between *const w = iccp_alloc_zero(memory, 1, sizeof *w);
    if (w == NULL)
        return NULL;
    w->a = iccp_alloc(memory, n + 1, sizeof *w->a);
    w->b = iccp_alloc(memory, n + 1, sizeof *w->b);
    w->cost = iccp_alloc(memory, (n + 1) * (n + 1), sizeof *w->cost);
    w->path.points = iccp_alloc(memory, 2 * (2 * n + 1), sizeof *w->path.points);
    if (w->a == NULL || w->b == NULL || w->cost == NULL || w->path.points == NULL ||
        iccp_lattice_create(&w->lattice, (int32_t)n, memory) != ICC_OK) {
        release(w, memory);
        return NULL;
    }
    return w;
}

static piece piece_of(const double *landmarks, size_t n, size_t k)
{
    const double *const p = landmarks + 2 * k, *const q = landmarks + 2 * ((k + 1) % n);
    piece out = {.n = LEAST};
    for (int e = 0; e < 2; ++e) {
        out.from[e] = p[e];
        out.width[e] = q[e] + (k + 1 == n ? 1 : 0) - p[e];
        const double samples = floor(N * out.width[e] + 0.5);
        if (samples > out.n)
            out.n = samples < N ? (int32_t)samples : N;
    }
    return out;
}

static void describe(between *w, iccp_descriptor *out, const iccp_outline *outline, const piece *p,
                     int side, double step)
{
    for (int32_t k = 0; k <= p->n; ++k)
        w->share[k] = p->from[side] + p->width[side] * k / p->n;
    iccp_descriptors(out, outline, (size_t)p->n + 1, w->share, step);
}

/* Finds the best path through one piece: its knots, and its part of the rotation. */
static void match_piece(between *w, const piece *p, const double *rotation, double weight,
                        iccp_pairing_knots *knots, double *sum)
{
    const size_t width = (size_t)p->n + 1;
    for (size_t i = 0; i < width; ++i)
        for (size_t j = 0; j < width; ++j)
            w->cost[i * width + j] = iccp_descriptor_cost(&w->a[i], &w->b[j], rotation, weight);
    for (int32_t i = 0; i <= p->n; ++i) {
        w->lattice.low[i] = 0;
        w->lattice.high[i] = p->n;
    }
    iccp_lattice_search(&w->path, &w->lattice, p->n, w->cost, width, 0);
    for (int32_t k = 0; k + 1 < w->path.n_points; ++k) {
        const int32_t *const at = w->path.points + 2 * k;
        double *const knot = knots->knot + 2 * knots->n++;
        for (int e = 0; e < 2; ++e)
            knot[e] = p->from[e] + p->width[e] * at[e] / p->n;
        double turn[2] = {0, 0};
        iccp_descriptor_turn(turn, &w->a[at[0]], &w->b[at[1]]);
        const double length = p->width[0] * (at[2] - at[0]) / p->n;
        sum[0] += length * turn[0];
        sum[1] += length * turn[1];
    }
}

icc_status iccp_elastic_between(iccp_pairing_knots *knots, iccp_elastic_report *report,
                                const iccp_outline *source, const iccp_outline *target, size_t n,
                                const double *landmarks, const iccp_env *env)
{
    between *const w = prepare(N, &env->memory);
    if (w == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_OK;
    double rotation[2] = {1, 0};
    for (int pass = 0; pass < N_PASSES && status == ICC_OK; ++pass) {
        double sum[2] = {0, 0};
        report->cost = 0;
        knots->n = 0;
        for (size_t k = 0; k < n && status == ICC_OK; ++k) {
            const piece p = piece_of(landmarks, n, k);
            describe(w, w->a, source, &p, 0, 0.5 / N);
            describe(w, w->b, target, &p, 1, 0.5 / N);
            match_piece(w, &p, rotation, pass > 0 ? iccp_tangents : 0, knots, sum);
            report->cost += w->path.cost * (p.width[0] + p.width[1]) / 2;
            status = iccp_progress(env, NULL, (pass + (double)(k + 1) / (double)n) / N_PASSES);
        }
        iccp_unit(sum);
        memcpy(rotation, sum, sizeof sum);
    }
    report->second = report->sure = HUGE_VAL;
    report->turn = -iccp_atan2_turns(rotation[1], rotation[0]);
    release(w, &env->memory);
    return status;
}

icc_status iccp_elastic_open(iccp_pairing_knots *knots, const iccp_outline *source,
                             const iccp_outline *target, const double *from, const double *width,
                             size_t n, const iccp_memory *memory)
{
    between *const w = prepare(n, memory);
    if (w == NULL)
        return ICC_ERR_MEMORY;
    const piece p = {{from[0], from[1]}, {width[0], width[1]}, (int32_t)n};
    const size_t first = knots->n;
    double rotation[2] = {1, 0};
    describe(w, w->a, source, &p, 0, width[0] / (2 * (double)n));
    describe(w, w->b, target, &p, 1, width[1] / (2 * (double)n));
    for (int pass = 0; pass < N_PASSES; ++pass) {
        double sum[2] = {0, 0};
        knots->n = first;
        match_piece(w, &p, rotation, pass > 0 ? iccp_tangents : 0, knots, sum);
        iccp_unit(sum);
        memcpy(rotation, sum, sizeof sum);
    }
    release(w, memory);
    return ICC_OK;
}
