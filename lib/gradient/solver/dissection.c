/* An order of elimination by nested dissection: A. George, Nested dissection of a regular finite
 * element mesh, SIAM J. Numer. Anal. 10, 1973.
 *
 * Neighbours differ by 1 in one coordinate, and by 1 in their generation of the tree, which is used
 * as one more coordinate. So the unknowns with one value of a coordinate separate those below it
 * from those above it. Parts that are thin along the tree are eliminated from their far end.
 *
 * Entries of the factor would join a separator in the middle of a long limb with the limb's ends.
 * They would underflow, and the values beyond would be lost. So the unknowns are first cut into
 * bands. Within each band, values fall by a bounded factor along paths from the root. The farthest
 * band comes first. */
#include "gradient/solver/dissection.h"

#include "base/minmax.h"
#include "math/elementary.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum {
    SMALL = 16,     /* parts with fewer unknowns are not cut */
    MOST_PARTS = 64 /* parts on the stack; the smaller half goes first, so sizes halve */
};

/* Natural logarithm of the factor by which values fall in a band: 2^-288. Entries of a factor may
 * go down to 2^-500 (math/ldlt_scaled.c). */
static const double BAND = 200;

/* Largest share of a part on one side of a cut. */
static const double MOST_SIDE = 0.875;

/* Limits of is_thin(), below which parts are not cut. With these, serpentines, boxes and tubes take
 * the least time (tests/bench/bench_spd). */
static const double THIN_IN_2D = 4, THIN_BEYOND = 0.25;

static const double PI = 3.14159265358979323846;

typedef struct dissection {
    const iccp_unknowns *unknowns;
    const iccp_env *env;
    size_t n_axes;   /* the last axis is the generation */
    uint32_t *order; /* parts are ranges of it; their unknowns are in rising order */
    uint32_t *work;  /* n */
    uint32_t *place; /* n * n_axes: coordinates of each unknown; at first the runs through it */
    uint32_t *count; /* unknowns of a part in each plane across one axis */
    size_t n_done, n_visited;
} dissection;

typedef struct part {
    size_t begin, end;
} part;

typedef struct plane {
    size_t axis;
    uint32_t place;
    double score;
} plane;

static icc_status count_visits(dissection *d, size_t n_rows)
{
    const size_t reports = d->n_visited / ICCP_VERTICES_PER_REPORT;
    d->n_visited += n_rows;
    if (d->n_visited / ICCP_VERTICES_PER_REPORT == reports)
        return ICC_OK;
    return iccp_progress(d->env, "solve", (double)d->n_done / (double)d->unknowns->n);
}

/* ------------------------------------------------------------------- bands */

/* Finds how many unknowns lie in one line through each unknown, along one axis. */
static icc_status find_runs(dissection *d, size_t axis)
{
    const size_t degree = (size_t)d->unknowns->n_neighbours;
    const uint32_t *neighbour = d->unknowns->neighbour;
    for (uint32_t k = 0; k < d->unknowns->n; ++k) {
        if (neighbour[k * degree + 2 * axis] != ICCP_NONE)
            continue;
        uint32_t length = 0;
        for (uint32_t i = k; i != ICCP_NONE; i = neighbour[i * degree + 2 * axis + 1])
            ++length;
        for (uint32_t i = k; i != ICCP_NONE; i = neighbour[i * degree + 2 * axis + 1])
            d->place[i * d->n_axes + axis] = length;
        const icc_status status = count_visits(d, length);
        if (status != ICC_OK)
            return status;
    }
    return ICC_OK;
}

/* Estimates how fast functions fall along the longest run through an unknown, from the widths
 * across it. */
static double rate(const uint32_t *run, size_t dim)
{
    double sum = 0, least = HUGE_VAL;
    for (size_t axis = 0; axis < dim; ++axis) {
        const double bend = 1 / ((run[axis] + 1.0) * (run[axis] + 1.0));
        sum += bend;
        least = iccp_min(least, bend);
    }
    return PI * sqrt(sum - least);
}

/* Writes the band of each unknown to `work`. */
static icc_status find_bands(dissection *d, uint32_t *n_bands)
{
    const size_t n = d->unknowns->n, dim = d->n_axes - 1;
    double *fall = iccp_alloc(&d->env->memory, n, sizeof *fall);
    icc_status status = fall != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t axis = 0; axis < dim && status == ICC_OK; ++axis)
        status = find_runs(d, axis);
    *n_bands = 1;
    for (size_t k = 0; k < n && status == ICC_OK; ++k) {
        const uint32_t parent = d->unknowns->parent[k];
        fall[k] = k == 0 ? 0 : fall[parent] + rate(d->place + k * d->n_axes, dim);
        d->work[k] = (uint32_t)(fall[k] / BAND);
        if (d->work[k] >= *n_bands)
            *n_bands = d->work[k] + 1;
        status = count_visits(d, 1);
    }
    iccp_free(&d->env->memory, fall);
    return status;
}

/* Sorts the unknowns by falling band, and writes the ends of the bands to end[1..]. */
static void sort_bands(dissection *d, size_t *end, uint32_t n_bands)
{
    const size_t n = d->unknowns->n;
    for (size_t k = 0; k < n; ++k)
        ++end[n_bands - d->work[k]];
    for (uint32_t b = 0; b < n_bands; ++b)
        end[b + 1] += end[b];
    for (uint32_t k = 0; k < n; ++k)
        d->order[end[n_bands - 1 - d->work[k]]++] = k;
    for (uint32_t b = n_bands; b > 0; --b)
        end[b] = end[b - 1];
    end[0] = 0;
}

/* ------------------------------------------------------------------- parts */

static icc_status find_places(dissection *d)
{
    const icc_tree *tree = d->unknowns->tree;
    const size_t dim = d->n_axes - 1;
    icc_status status = ICC_OK;
    for (size_t k = 0; k < d->unknowns->n && status == ICC_OK; ++k) {
        uint32_t *place = d->place + k * d->n_axes, rest = d->unknowns->vertex[k];
        place[dim] = (uint32_t)tree->generation[rest];
        for (size_t axis = 0; axis < dim; ++axis) {
            const uint32_t shape = (uint32_t)tree->grid->shape[axis];
            place[axis] = rest % shape;
            rest /= shape;
        }
        status = count_visits(d, 1);
    }
    return status;
}

/* Counts the unknowns of a part in its planes across one axis, from the lowest on. Returns the
 * number of planes. */
static size_t count_planes(const dissection *d, const part *p, size_t axis, uint32_t *lowest)
{
    const uint32_t *place = d->place + axis;
    uint32_t highest = 0;
    *lowest = UINT32_MAX;
    for (size_t i = p->begin; i < p->end; ++i) {
        const uint32_t at = place[d->order[i] * d->n_axes];
        *lowest = at < *lowest ? at : *lowest;
        highest = at > highest ? at : highest;
    }
    const size_t n_planes = (size_t)(highest - *lowest) + 1;
    memset(d->count, 0, n_planes * sizeof *d->count);
    for (size_t i = p->begin; i < p->end; ++i)
        ++d->count[place[d->order[i] * d->n_axes] - *lowest];
    return n_planes;
}

/* Compares the multiplications of an elimination by generations with those of a dissection. */
static bool is_thin(const dissection *d, const part *p, size_t n_generations)
{
    const double dim = (double)d->n_axes - 1, factor = dim > 2 ? THIN_BEYOND : THIN_IN_2D;
    double work = 0;
    for (size_t g = 0; g < n_generations; ++g)
        work += iccp_power(d->count[g], 3);
    return work <= factor * iccp_pow((double)(p->end - p->begin), iccp_max(1, 3 - 3 / dim));
}

/* Chooses a plane with few unknowns in it and many on either side. At the median, neither side is
 * too large. */
static void choose_plane(const dissection *d, const part *p, size_t axis, size_t n_planes,
                         uint32_t lowest, plane *best)
{
    const double n = (double)(p->end - p->begin);
    double low = 0;
    for (size_t i = 0; i < n_planes; low += d->count[i++]) {
        const double high = n - low - d->count[i];
        const double score = (d->count[i] + 1.0) / ((low + 1) * (high + 1));
        if (score < best->score && iccp_max(low, high) <= MOST_SIDE * n)
            *best = (plane){axis, lowest + (uint32_t)i, score};
    }
}

/* Splits a part into the unknowns below a plane, those above it, and those in it. */
static void split(dissection *d, const part *p, const plane *cut, part half[2])
{
    size_t n[3] = {0, 0, 0};
    uint32_t *to[3];
    for (size_t i = p->begin; i < p->end; ++i) {
        const uint32_t at = d->place[d->order[i] * d->n_axes + cut->axis];
        ++n[at < cut->place ? 0 : at > cut->place ? 1 : 2];
    }
    to[0] = d->work;
    to[1] = to[0] + n[0];
    to[2] = to[1] + n[1];
    for (size_t i = p->begin; i < p->end; ++i) {
        const uint32_t at = d->place[d->order[i] * d->n_axes + cut->axis];
        *to[at < cut->place ? 0 : at > cut->place ? 1 : 2]++ = d->order[i];
    }
    memcpy(d->order + p->begin, d->work, (p->end - p->begin) * sizeof *d->work);
    half[0] = (part){p->begin, p->begin + n[0]};
    half[1] = (part){half[0].end, half[0].end + n[1]};
    d->n_done += n[2];
}

static void eliminate_from_far_end(dissection *d, const part *p)
{
    d->n_done += p->end - p->begin;
    for (size_t i = p->begin, j = p->end; i + 1 < j; ++i) {
        const uint32_t row = d->order[i];
        d->order[i] = d->order[--j];
        d->order[j] = row;
    }
}

/* Returns true if the part was cut. */
static bool cut_part(dissection *d, const part *p, part half[2])
{
    plane best = {0, 0, HUGE_VAL};
    if (p->end - p->begin <= SMALL)
        return false;
    for (size_t axis = d->n_axes; axis-- > 0;) {
        uint32_t lowest;
        const size_t n_planes = count_planes(d, p, axis, &lowest);
        if (axis == d->n_axes - 1 && is_thin(d, p, n_planes))
            return false;
        choose_plane(d, p, axis, n_planes, lowest, &best);
    }
    split(d, p, &best, half);
    return true;
}

static icc_status dissect(dissection *d, part band)
{
    part stack[MOST_PARTS] = {band}, half[2];
    icc_status status = ICC_OK;
    for (size_t height = 1; height > 0 && status == ICC_OK;) {
        const part p = stack[--height];
        status = count_visits(d, p.end - p.begin);
        if (!cut_part(d, &p, half)) {
            eliminate_from_far_end(d, &p);
            continue;
        }
        const bool first_is_larger = half[0].end - half[0].begin > half[1].end - half[1].begin;
        stack[height++] = half[!first_is_larger];
        stack[height++] = half[first_is_larger];
    }
    return status;
}

/* Returns the largest number of planes across an axis. */
static size_t most_planes(const iccp_unknowns *unknowns)
{
    const icc_tree *tree = unknowns->tree;
    size_t most = (size_t)tree->generation[unknowns->vertex[unknowns->n - 1]] + 1;
    for (int32_t axis = 0; axis < tree->grid->dim; ++axis)
        most = tree->grid->shape[axis] > most ? tree->grid->shape[axis] : most;
    return most;
}

static icc_status run(dissection *d)
{
    uint32_t n_bands;
    icc_status status = find_bands(d, &n_bands);
    if (status != ICC_OK)
        return status;
    size_t *end = iccp_alloc_zero(&d->env->memory, (size_t)n_bands + 1, sizeof *end);
    if (end == NULL)
        return ICC_ERR_MEMORY;
    sort_bands(d, end, n_bands);
    status = find_places(d);
    for (uint32_t b = 0; b < n_bands && status == ICC_OK; ++b)
        status = dissect(d, (part){end[b], end[b + 1]});
    iccp_free(&d->env->memory, end);
    return status;
}

icc_status iccp_dissection(const iccp_unknowns *unknowns, uint32_t *order, const iccp_env *env)
{
    const iccp_memory *m = &env->memory;
    dissection d = {.unknowns = unknowns,
                    .env = env,
                    .n_axes = (size_t)unknowns->tree->grid->dim + 1,
                    .order = order};
    d.work = iccp_alloc(m, unknowns->n, sizeof *d.work);
    d.place = iccp_alloc(m, unknowns->n, d.n_axes * sizeof *d.place);
    d.count = iccp_alloc(m, most_planes(unknowns), sizeof *d.count);
    icc_status status = ICC_ERR_MEMORY;
    if (d.work != NULL && d.place != NULL && d.count != NULL)
        status = run(&d);
    iccp_free(m, d.work);
    iccp_free(m, d.place);
    iccp_free(m, d.count);
    return status;
}
