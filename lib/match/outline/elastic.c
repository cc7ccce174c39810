/* Elastic matching in two stages. Shapes alone find candidates among all starts. Then each
 * candidate is refined with the directions of tangents (match/outline/elastic_candidate.c). */
#include "match/outline/elastic.h"

#include "match/outline/elastic_candidate.h"
#include "match/outline/pins.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

enum {
    N = ICCP_MATCH_SAMPLES,
    STRIDE = 4, /* distance of starts; elastic steps reach those in between */
    N_STARTS = N / STRIDE,
    N_CANDIDATES = 7 /* candidates by shape, and an upright one */
};

/* upright: preference for upright pairings. far: pairings this many samples apart are different.
 * noise: added to costs before they are compared, because small costs differ by sampling alone. */
static const double upright = 0.05, far = 0.05 * N, noise = 0.05;

double iccp_elastic_better(double cost, double other)
{
    return (other + noise) / (cost + noise);
}

typedef struct elastic {
    iccp_samples samples;
    iccp_elastic_candidate candidates[N_CANDIDATES];
    size_t n_candidates;
    iccp_lattice_path paths[N_STARTS];
    int32_t *points; /* of all paths */
} elastic;

enum { PATH_SIZE = 2 * (2 * N + 1) };

static void release(elastic *e, const iccp_memory *memory)
{
    if (e == NULL)
        return;
    iccp_lattice_free(&e->samples.lattice, memory);
    iccp_free(memory, e->samples.cost);
    iccp_free(memory, e->points);
    iccp_free(memory, e);
}

static elastic *prepare(const iccp_outline *source, const iccp_outline *target,
                        const iccp_memory *memory)
{
    elastic *const e = iccp_alloc_zero(memory, 1, sizeof *e);
    if (e == NULL)
        return NULL;
    e->samples.cost = iccp_alloc(memory, (N + 1) * (2 * N + 1), sizeof *e->samples.cost);
    e->points =
        iccp_alloc(memory, (size_t)(N_STARTS + N_CANDIDATES) * PATH_SIZE, sizeof *e->points);
    if (e->samples.cost == NULL || e->points == NULL ||
        iccp_lattice_create(&e->samples.lattice, N, memory) != ICC_OK) {
        release(e, memory);
        return NULL;
    }
    for (size_t k = 0; k < N_STARTS; ++k)
        e->paths[k].points = e->points + k * PATH_SIZE;
    e->samples.path = e->paths[0];
    for (size_t k = 0; k < N_CANDIDATES; ++k)
        e->candidates[k].path.points = e->points + (N_STARTS + k) * PATH_SIZE;
    double share[N];
    for (int k = 0; k < N; ++k)
        share[k] = (double)k / N;
    e->samples.are_fine = source->n >= N && target->n >= N;
    e->samples.source = source;
    e->samples.target = target;
    iccp_descriptors(e->samples.a, source, N, share, 1.0 / N);
    iccp_descriptors(e->samples.b, target, N, share, 1.0 / N);
    return e;
}

/* Mean distance of two pairings along the target, in samples. */
static double distance(const float *p, const float *q)
{
    double sum = 0;
    for (int k = 0; k < N; ++k) {
        const double d = fabs((double)p[k] - (double)q[k]);
        const double rest = d - N * floor(d / N);
        sum += rest < N - rest ? rest : N - rest;
    }
    return sum / N;
}

/* Fills in the costs of all pairs of samples. Each row goes twice around the target. */
static void all_costs(elastic *e, double weight)
{
    static const double none[2] = {1, 0};
    for (size_t i = 0; i <= N; ++i) {
        float *const row = e->samples.cost + i * (2 * N + 1);
        for (size_t j = 0; j < N; ++j)
            row[j] = iccp_descriptor_cost(&e->samples.a[i % N], &e->samples.b[j], none, weight);
        memcpy(row + N, row, N * sizeof *row);
        row[2 * N] = row[0];
    }
}

/* Accepts a path as a candidate unless another one is close. */
static void take(elastic *e, const iccp_lattice_path *path)
{
    iccp_elastic_candidate *const c = &e->candidates[e->n_candidates];
    c->i = c->j = 0;
    c->path.n_points = path->n_points;
    c->path.cost = path->cost;
    memcpy(c->path.points, path->points, 2 * (size_t)path->n_points * sizeof *path->points);
    iccp_elastic_candidate_place(c);
    for (size_t k = 0; k < e->n_candidates; ++k)
        if (distance(c->place, e->candidates[k].place) <= far)
            return;
    c->score = path->cost;
    ++e->n_candidates;
}

static size_t cheapest(const iccp_lattice_path *paths)
{
    size_t best = 0;
    for (size_t k = 1; k < N_STARTS; ++k)
        if (paths[k].cost < paths[best].cost)
            best = k;
    return best;
}

/* Finds the candidates by shape alone, and the best upright one. Shapes alone do not distinguish
 * the upright one if they are round. The letter o needs it, and a Q that becomes an @. */
static icc_status find_candidates(elastic *e, bool is_free, const iccp_env *env)
{
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 1}, env);
    e->n_candidates = 0;
    if (!is_free) {
        all_costs(e, iccp_tangents);
        const icc_status status = iccp_lattice_cyclic(e->paths, &e->samples.lattice, N,
                                                      e->samples.cost, STRIDE, &parts[0]);
        if (status != ICC_OK)
            return status;
        take(e, &e->paths[cheapest(e->paths)]);
    }
    all_costs(e, 0);
    const icc_status status =
        iccp_lattice_cyclic(e->paths, &e->samples.lattice, N, e->samples.cost, STRIDE, &parts[1]);
    while (status == ICC_OK && e->n_candidates < N_CANDIDATES) {
        iccp_lattice_path *const path = &e->paths[cheapest(e->paths)];
        if (!(path->cost < HUGE_VAL))
            break;
        take(e, path);
        path->cost = HUGE_VAL;
    }
    return status;
}

/* Finds candidates and refines each. `least` becomes the least cost, whatever the rotation. */
static icc_status search(elastic *e, bool is_free, double *least, const iccp_env *env)
{
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){is_free ? 1 : 2, 1}, env);
    icc_status status = find_candidates(e, is_free, &parts[0]);
    *least = HUGE_VAL;
    for (size_t k = 0; k < e->n_candidates && status == ICC_OK; ++k) {
        iccp_elastic_candidate *const c = &e->candidates[k];
        iccp_elastic_candidate_follow(c, &e->samples);
        c->score = c->path.cost + (is_free ? 0 : upright * (1 - c->rotation[0]) / 2);
        *least = c->path.cost < *least ? c->path.cost : *least;
        status = iccp_progress(&parts[1], NULL, (double)(k + 1) / (double)e->n_candidates);
    }
    return status;
}

/* Turns the target's samples into those of its mirror image with y reversed, or back. The order of
 * the samples is reversed from sample 0 on, so chords turn the same way as before. */
static void mirror(iccp_descriptor *b)
{
    for (size_t i = 1; i < N - i; ++i) {
        const iccp_descriptor swap = b[i];
        b[i] = b[N - i];
        b[N - i] = swap;
    }
    for (size_t i = 0; i < N; ++i)
        b[i].tangent[0] = -b[i].tangent[0];
}

static void read_knots(iccp_pairing_knots *knots, const iccp_elastic_candidate *c)
{
    knots->n = (size_t)c->path.n_points - 1;
    for (size_t k = 0; k < knots->n; ++k) {
        knots->knot[2 * k] = (double)(c->path.points[2 * k] + c->i) / N;
        knots->knot[2 * k + 1] = (double)(c->path.points[2 * k + 1] + c->j) / N;
    }
}

/* Chooses the best candidate and measures how much better it is than the next one elsewhere. */
static iccp_elastic_candidate *choose(elastic *e, iccp_elastic_report *report)
{
    iccp_elastic_candidate *best = &e->candidates[0];
    for (size_t k = 1; k < e->n_candidates; ++k)
        if (e->candidates[k].score < best->score)
            best = &e->candidates[k];
    report->cost = best->score;
    report->second = HUGE_VAL;
    for (size_t k = 0; k < e->n_candidates; ++k) {
        const iccp_elastic_candidate *const c = &e->candidates[k];
        if (c->score < report->second && distance(c->place, best->place) > far)
            report->second = c->score;
    }
    report->sure = iccp_elastic_better(report->cost, report->second);
    report->turn = -iccp_atan2_turns(best->rotation[1], best->rotation[0]);
    return best;
}

icc_status iccp_elastic_search(iccp_pairing_knots *knots, iccp_elastic_report *report,
                               const iccp_outline *source, const iccp_outline *target, bool is_free,
                               const iccp_env *env)
{
    elastic *const e = prepare(source, target, &env->memory);
    if (e == NULL)
        return ICC_ERR_MEMORY;
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 1}, env);
    double least = 0, mirrored = 0;
    mirror(e->samples.b);
    icc_status status = search(e, is_free, &mirrored, &parts[0]);
    mirror(e->samples.b);
    if (status == ICC_OK)
        status = search(e, is_free, &least, &parts[1]);
    if (status == ICC_OK) {
        iccp_elastic_candidate *const best = choose(e, report);
        iccp_elastic_candidate *const spare = &e->candidates[best == e->candidates ? 1 : 0];
        iccp_elastic_candidate_bend(best, spare, &e->samples);
        read_knots(knots, best);
        report->mirrored = iccp_elastic_better(mirrored, least);
    }
    release(e, &env->memory);
    return status;
}

/* Returns true if a candidate passes close to all landmarks. That of d17, a disc with three
 * landmarks, does not. */
static bool passes(const iccp_elastic_candidate *c, size_t n, const double *landmarks)
{
    for (size_t k = 0; k < n; ++k) {
        const size_t row = (size_t)(N * iccp_outline_wrap(landmarks[2 * k]));
        const double at = landmarks[2 * k + 1] - (double)c->place[row % N] / N;
        if (fabs(iccp_outline_wrap(at + 0.5) - 0.5) > far / N)
            return false;
    }
    return true;
}

icc_status iccp_elastic_bend(iccp_pairing_knots *knots, const iccp_outline *source,
                             const iccp_outline *target, size_t n, const double *landmarks,
                             const iccp_memory *memory)
{
    elastic *const e = prepare(source, target, memory);
    if (e == NULL)
        return ICC_ERR_MEMORY;
    iccp_elastic_candidate *const c = &e->candidates[0];
    for (int k = 0; k < N; ++k)
        c->place[k] = (float)(N * iccp_knots_at(knots, (double)k / N));
    iccp_elastic_candidate_bend(c, &e->candidates[1], &e->samples);
    if (c->path.n_points > 0 && passes(c, n, landmarks))
        read_knots(knots, c);
    release(e, memory);
    return ICC_OK;
}

icc_status iccp_elastic_near(iccp_pairing_knots *knots, iccp_elastic_report *report,
                             const iccp_outline *source, const iccp_outline *target, double start,
                             const iccp_memory *memory)
{
    elastic *const e = prepare(source, target, memory);
    if (e == NULL)
        return ICC_ERR_MEMORY;
    iccp_elastic_candidate *const c = &e->candidates[0];
    for (int k = 0; k < N; ++k)
        c->place[k] = (float)(k + N * start);
    iccp_elastic_candidate_follow(c, &e->samples);
    report->cost = c->path.cost;
    read_knots(knots, c);
    release(e, memory);
    return ICC_OK;
}
