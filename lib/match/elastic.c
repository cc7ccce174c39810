/* Elastic matching in two stages: shapes alone find the candidates, among all starts; then each is
 * followed twice with the directions of tangents after its own rotation (the square-root velocity
 * of A. Srivastava et al., Shape analysis of elastic curves in Euclidean spaces, 2011). */
#include "match/elastic.h"

#include "match/descriptor.h"
#include "match/lattice_path.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

enum {
    N = ICCP_MATCH_SAMPLES,
    STRIDE = 4, /* elastic steps reach the starts between */
    N_STARTS = N / STRIDE,
    N_CANDIDATES = 7, /* by shape, and an upright one */
    N_PASSES = 2,
    BAND = N / 10, /* how far a pass may leave the one before */
    MARGIN = 8,    /* columns that steps pass beyond it */
    HALF = N / 64  /* samples on each side of a place that is to be sure */
};

/* Preference for upright; what two different pairings are apart, in samples; and
 * what is added to costs before they are compared, since small ones differ by sampling alone. */
static const double upright = .05, far = .05 * N, noise = .05;

typedef struct candidate {
    double score, rotation[2];
    float place[N]; /* of each source sample in the target, in samples, unwrapped */
    int32_t i, j;   /* where the path begins */
    iccp_lattice_path path;
} candidate;

typedef struct elastic {
    iccp_descriptor a[N], b[N];
    candidate candidates[N_CANDIDATES];
    size_t n_candidates;
    float *cost;
    iccp_lattice lattice;
    iccp_lattice_path paths[N_STARTS];
    int32_t *points; /* of all paths */
} elastic;

enum { PATH_SIZE = 2 * (2 * N + 1) };

static void release(elastic *e, const iccp_memory *memory)
{
    if (e == NULL)
        return;
    iccp_lattice_free(&e->lattice, memory);
    iccp_free(memory, e->cost);
    iccp_free(memory, e->points);
    iccp_free(memory, e);
}

static elastic *prepare(const iccp_outline *source, const iccp_outline *target,
                        const iccp_memory *memory)
{
    elastic *const e = iccp_alloc_zero(memory, 1, sizeof *e);
    if (e == NULL)
        return NULL;
    e->cost = iccp_alloc(memory, (N + 1) * (2 * N + 1), sizeof *e->cost);
    e->points =
        iccp_alloc(memory, (size_t)(N_STARTS + N_CANDIDATES) * PATH_SIZE, sizeof *e->points);
    if (e->cost == NULL || e->points == NULL ||
        iccp_lattice_create(&e->lattice, N, memory) != ICC_OK) {
        release(e, memory);
        return NULL;
    }
    for (size_t k = 0; k < N_STARTS; ++k)
        e->paths[k].points = e->points + k * PATH_SIZE;
    for (size_t k = 0; k < N_CANDIDATES; ++k)
        e->candidates[k].path.points = e->points + (N_STARTS + k) * PATH_SIZE;
    double share[N];
    for (int k = 0; k < N; ++k)
        share[k] = (double)k / N;
    iccp_descriptors(e->a, source, N, share, 1.0 / N);
    iccp_descriptors(e->b, target, N, share, 1.0 / N);
    return e;
}

/* Where a path takes each sample: its first column in a row, and between in proportion. Rows and
 * columns of the path count from (i, j). */
static void place_of(float *place, const iccp_lattice_path *path, int32_t i, int32_t j)
{
    const int32_t *const p = path->points;
    for (int32_t k = 0; k < path->n_points; ++k) {
        if (k > 0 && p[2 * k - 2] == p[2 * k])
            continue;
        for (int32_t e = k > 0 ? p[2 * k - 2] + 1 : p[2 * k]; e <= p[2 * k] && e < N; ++e) {
            const float part =
                e == p[2 * k] ? 0 : (float)(p[2 * k] - e) / (float)(p[2 * k] - p[2 * k - 2]);
            const float at =
                k == 0 ? (float)p[1]
                       : (float)p[2 * k + 1] - part * (float)(p[2 * k + 1] - p[2 * k - 1]);
            const int32_t row = (i + e) % N;
            place[row] = at + (float)j - (float)(i + e - row);
        }
    }
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

/* Costs of all pairs of samples, twice along the target; backwards for its mirror image. */
static void all_costs(elastic *e, double weight, bool is_mirrored)
{
    static const double none[2] = {1, 0};
    for (size_t i = 0; i <= N; ++i) {
        float *const row = e->cost + i * (2 * N + 1);
        for (size_t j = 0; j < N; ++j)
            row[j] = iccp_descriptor_cost(&e->a[i % N], &e->b[is_mirrored ? (N - j) % N : j], none,
                                          weight);
        memcpy(row + N, row, N * sizeof *row);
        row[2 * N] = row[0];
    }
}

/* Takes a path as a candidate unless one is near by. */
static void take(elastic *e, const iccp_lattice_path *path)
{
    candidate *const c = &e->candidates[e->n_candidates];
    place_of(c->place, path, 0, 0);
    for (size_t k = 0; k < e->n_candidates; ++k)
        if (distance(c->place, e->candidates[k].place) <= far)
            return;
    c->score = path->cost;
    c->i = c->j = 0;
    c->path.n_points = path->n_points;
    c->path.cost = path->cost;
    memcpy(c->path.points, path->points, 2 * (size_t)path->n_points * sizeof *path->points);
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

/* The candidates: by shape alone, and the best one that is upright, which shapes alone do not tell
 * from others where they are round. `least`: the least cost by shape. */
static icc_status find_candidates(elastic *e, bool is_free, double *least, const iccp_env *env)
{
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 1}, env);
    if (!is_free) {
        all_costs(e, iccp_tangents, false);
        const icc_status status =
            iccp_lattice_cyclic(e->paths, &e->lattice, N, e->cost, STRIDE, &parts[0]);
        if (status != ICC_OK)
            return status;
        take(e, &e->paths[cheapest(e->paths)]);
    }
    all_costs(e, 0, false);
    const icc_status status =
        iccp_lattice_cyclic(e->paths, &e->lattice, N, e->cost, STRIDE, &parts[1]);
    *least = e->paths[cheapest(e->paths)].cost;
    while (status == ICC_OK && e->n_candidates < N_CANDIDATES) {
        iccp_lattice_path *const path = &e->paths[cheapest(e->paths)];
        if (!(path->cost < HUGE_VAL))
            break;
        take(e, path);
        path->cost = HUGE_VAL;
    }
    return status;
}

/* The least cost by shape of the mirror image, from a coarser search. */
static icc_status mirror_cost(elastic *e, double *least, const iccp_env *env)
{
    all_costs(e, 0, true);
    for (size_t k = 0; k < N_STARTS; ++k)
        e->paths[k].cost = HUGE_VAL;
    const icc_status status =
        iccp_lattice_cyclic(e->paths, &e->lattice, N, e->cost, 4 * STRIDE, env);
    *least = HUGE_VAL;
    for (size_t k = 0; k < N_STARTS / 4; ++k)
        *least = e->paths[k].cost < *least ? e->paths[k].cost : *least;
    return status;
}

static void mean_turns(const iccp_descriptor *b, iccp_descriptor *mean)
{
    *mean = (iccp_descriptor){{0}, {0}};
    for (int k = 0; k < N; ++k)
        for (int m = 0; m < 2 * ICCP_SCALES; ++m)
            mean->turns[m] += b[k].turns[m] / N;
}

/* The sample that is told from others best and is matched well: where a path may be cut. */
static int32_t surest(const elastic *e, const candidate *c)
{
    static const double none[2] = {1, 0};
    iccp_descriptor mean;
    mean_turns(e->b, &mean);
    double here[N], best = -HUGE_VAL;
    for (int k = 0; k < N; ++k) {
        const int32_t j = (int32_t)floor((double)c->place[k] + .5);
        here[k] = (double)iccp_descriptor_cost(&e->a[k], &e->b[(j % N + N) % N], c->rotation,
                                               iccp_tangents);
    }
    int32_t found = 0;
    for (int k = 0; k < N; ++k) {
        double sum = 0;
        for (int m = -HALF; m <= HALF; ++m)
            sum += here[(k + m + N) % N];
        const double value =
            (double)iccp_descriptor_cost(&e->a[k], &mean, none, 0) - 2 * sum / (2 * HALF + 1);
        if (value > best) {
            best = value;
            found = k;
        }
    }
    return found;
}

/* The rotation along a candidate's path. */
static void rotation_of(const elastic *e, candidate *c)
{
    double sum[2] = {0, 0};
    for (int32_t k = 0; k < c->path.n_points; ++k) {
        const int32_t i = c->path.points[2 * k] + c->i, j = c->path.points[2 * k + 1] + c->j;
        iccp_descriptor_turn(sum, &e->a[i % N], &e->b[(j % N + N) % N]);
    }
    iccp_unit(sum);
    memcpy(c->rotation, sum, sizeof sum);
}

/* A better path near the candidate's, with tangents, cut at its surest place. */
static void follow(elastic *e, candidate *c)
{
    rotation_of(e, c);
    const int32_t i = surest(e, c), j = (int32_t)floor((double)c->place[i] + .5);
    for (int32_t row = 0; row <= N; ++row) {
        float *const cost = e->cost + (size_t)row * (N + 1);
        const double place =
            row == N ? N : (double)c->place[(i + row) % N] + (i + row >= N ? N : 0) - j;
        const double low = place - BAND, high = place + BAND;
        e->lattice.low[row] = low > 0 ? (int32_t)low : 0;
        e->lattice.high[row] = high < N ? (int32_t)high : N;
        const int32_t from = e->lattice.low[row] - MARGIN, to = e->lattice.high[row] + MARGIN;
        for (int32_t k = from > 0 ? from : 0; k <= to && k <= N; ++k)
            cost[k] = iccp_descriptor_cost(&e->a[(i + row) % N], &e->b[((j + k) % N + N) % N],
                                           c->rotation, iccp_tangents);
    }
    iccp_lattice_path path = e->paths[0];
    iccp_lattice_search(&path, &e->lattice, N, e->cost, N + 1, 0);
    if (path.n_points == 0)
        return;
    c->i = i;
    c->j = j;
    c->path.n_points = path.n_points;
    c->path.cost = path.cost;
    memcpy(c->path.points, path.points, 2 * (size_t)path.n_points * sizeof *path.points);
    place_of(c->place, &path, i, j);
}

/* A candidate followed as often as it pays. */
static void follow_up(elastic *e, candidate *c)
{
    for (int pass = 0; pass < N_PASSES; ++pass)
        follow(e, c);
}

static void read_knots(iccp_pairing_knots *knots, const candidate *c)
{
    knots->n = (size_t)c->path.n_points - 1;
    for (size_t k = 0; k < knots->n; ++k) {
        knots->knot[2 * k] = (double)(c->path.points[2 * k] + c->i) / N;
        knots->knot[2 * k + 1] = (double)(c->path.points[2 * k + 1] + c->j) / N;
    }
}

/* The best candidate, and how much better it is than the next one elsewhere. */
static const candidate *choose(const elastic *e, iccp_elastic_report *report)
{
    const candidate *best = &e->candidates[0];
    for (size_t k = 1; k < e->n_candidates; ++k)
        if (e->candidates[k].score < best->score)
            best = &e->candidates[k];
    report->cost = best->score;
    report->second = HUGE_VAL;
    for (size_t k = 0; k < e->n_candidates; ++k) {
        const candidate *const c = &e->candidates[k];
        if (c->score < report->second && distance(c->place, best->place) > far)
            report->second = c->score;
    }
    report->sure = (report->second + noise) / (report->cost + noise);
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
    iccp_env parts[3];
    iccp_split(parts, 3, (const double[]){is_free ? 1 : 2, .5, 1}, env);
    double least = 0, mirrored = 0;
    icc_status status = find_candidates(e, is_free, &least, &parts[0]);
    if (status == ICC_OK)
        status = mirror_cost(e, &mirrored, &parts[1]);
    for (size_t k = 0; k < e->n_candidates && status == ICC_OK; ++k) {
        candidate *const c = &e->candidates[k];
        follow_up(e, c);
        c->score = c->path.cost + (is_free ? 0 : upright * (1 - c->rotation[0]) / 2);
        status = iccp_progress(&parts[2], NULL, (double)(k + 1) / (double)e->n_candidates);
    }
    if (status == ICC_OK) {
        read_knots(knots, choose(e, report));
        report->is_mirrored = mirrored + noise < .67 * (least + noise);
    }
    release(e, &env->memory);
    return status;
}

icc_status iccp_elastic_near(iccp_pairing_knots *knots, const iccp_outline *source,
                             const iccp_outline *target, double start, const iccp_memory *memory)
{
    elastic *const e = prepare(source, target, memory);
    if (e == NULL)
        return ICC_ERR_MEMORY;
    candidate *const c = &e->candidates[0];
    for (int k = 0; k < N; ++k)
        c->place[k] = (float)(k + N * start);
    follow_up(e, c);
    read_knots(knots, c);
    release(e, memory);
    return ICC_OK;
}
