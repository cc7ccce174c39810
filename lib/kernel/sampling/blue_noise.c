/* Evenly spaced random samples by inverse mean shift (thesis, section 6.2.1, equation 6.4). Each
 * sample is pushed away from those around it by a Gaussian of their distance. The thesis starts
 * from random points and takes 4,000 to 28,000 steps. Here the start is the densest lattice
 * (hexagonal, face-centred cubic in 3-D) with jitter. It is nearly evenly spaced already, so about
 * ten steps suffice.
 *
 * Containment: a sample that stays farther from all walls than the length of a step never crosses
 * one. */
#include "kernel/sampling/blue_noise.h"

#include "base/minmax.h"
#include "base/random.h"
#include "base/threads.h"
#include "kernel/sampling/lattice_filter.h"
#include "math/elementary.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* All lengths are in spacings. tests/bench/bench_sampling.c shows the effects. */
static const double JITTER = 0.3;    /* largest shift of lattice points along each axis */
static const double CLEARANCE = 0.4; /* least distance of samples from walls */
static const double SCALE = 0.45; /* s of the Gaussian; the thesis has about 1/3, for small steps */
static const double REACH = 3;    /* in s: beyond it the push is below 6 % of the largest */
static const double GAIN = 0.7;   /* lambda / s^2 */
static const double LONGEST_STEP = 0.2; /* less than CLEARANCE, so no step leads through a wall */

/* ----------------------------------------------------------------- lattice */

/* Distances of points in a row, of rows, and of layers: sqrt(3) / 2 and sqrt(2 / 3). */
static const double PITCH[3] = {1, 0.86602540378443865, 0.81649658092772603};

typedef struct lattice {
    const icc_shape *shape;
    double lower[3]; /* local */
    double spacing;
    uint64_t seed;
} lattice;

/* Rows of points, each shifted by half a spacing against the previous row. Layers of such rows lie
 * above the gaps of the previous layer. */
static void lattice_point(const void *argument, const size_t *at, double *point)
{
    const lattice *l = argument;
    const size_t dim = l->shape->dim;
    const double row = (double)at[1], layer = (double)at[2], turn = (double)(at[2] % 3);
    const double rest[3] = {(double)at[0] + 0.5 * (double)(at[1] % 2) + 0.5 * turn - 1.5,
                            PITCH[1] * row + 0.28867513459481288 * turn - 1, PITCH[2] * layer - 1};
    uint64_t state = l->seed ^ (at[0] + ((uint64_t)at[1] << 24) + ((uint64_t)at[2] << 44));
    double local[3];
    (void)iccp_random(&state);
    for (size_t k = 0; k < dim; ++k)
        local[k] =
            l->lower[k] + l->spacing * (rest[k] + JITTER * (2 * iccp_random_unit(&state) - 1));
    iccp_frame_out(&l->shape->frame, (int32_t)dim, local, point);
}

/* The start: the densest lattice over the shape's box, jittered, without the points outside or near
 * a wall. It extends beyond the box on both sides, because offset rows and jitter move its border.
 * Filtered points are in the caller's coordinates, and the list is local. */
static icc_status add_lattice(iccp_point_list *list, const icc_shape *shape, double spacing,
                              uint64_t seed, const iccp_env *env)
{
    lattice l = {.shape = shape, .spacing = spacing, .seed = seed};
    iccp_lattice_filter filter = {.shape = shape,
                                  .point = lattice_point,
                                  .lattice = &l,
                                  .count = {1, 1, 1},
                                  .clearance = CLEARANCE * spacing,
                                  .margin = -1};
    double all = 1, upper[3];
    iccp_frame_in(&shape->frame, (int32_t)shape->dim, shape->lower, l.lower);
    iccp_frame_in(&shape->frame, (int32_t)shape->dim, shape->upper, upper);
    for (size_t k = 0; k < shape->dim; ++k) {
        const double n = floor((upper[k] - l.lower[k]) / (PITCH[k] * spacing)) + 5;
        all *= n;
        if (all > (double)ICCP_MAX_LATTICE)
            return ICC_ERR_RESOLUTION;
        filter.count[k] = (size_t)n;
    }
    const size_t first = list->n;
    const icc_status status = iccp_lattice_filter_add(list, &filter, env);
    for (size_t i = first; i < list->n; ++i) {
        double *x = list->points + shape->dim * i;
        iccp_frame_in(&shape->frame, (int32_t)shape->dim, x, x);
    }
    return status;
}

/* -------------------------------------------------------------- relaxation */

typedef struct relaxation {
    const icc_shape *shape;
    size_t dim, n, n_held;
    double spacing;
    double *points, *next;
    double *clearance; /* by free sample: a lower bound of its distance from walls */
    iccp_cells cells;
} relaxation;

/* Returns the sum of (6.4), without its constants. */
static void push_of(const relaxation *r, size_t i, double *push)
{
    const size_t dim = r->dim;
    const double scale = SCALE * r->spacing, reach = REACH * scale;
    const double rate = -0.5 / (scale * scale), *x = r->points + dim * i;
    iccp_cell_box box;
    (void)iccp_cells_box(&r->cells, x, reach, &box);
    for (size_t z = box.from[2]; z <= box.to[2]; ++z)
        for (size_t y = box.from[1]; y <= box.to[1]; ++y) {
            const size_t row = (z * r->cells.shape[1] + y) * r->cells.shape[0];
            const uint32_t end = r->cells.first[row + box.to[0] + 1];
            for (uint32_t at = r->cells.first[row + box.from[0]]; at < end; ++at) {
                const double *p = r->points + dim * r->cells.order[at];
                double d[3], d2 = 0;
                for (size_t k = 0; k < dim; ++k) {
                    d[k] = x[k] - p[k];
                    d2 += d[k] * d[k];
                }
                const double weight = d2 < reach * reach ? iccp_exp(rate * d2) : 0;
                for (size_t k = 0; k < dim; ++k)
                    push[k] += weight * d[k];
            }
        }
}

/* Returns the distance of the nearest wall, and the direction away from it. */
static double away_from_wall(const relaxation *r, const double *x, double *away)
{
    const double *corners[3];
    double bary[3], distance2;
    const uint32_t wall = iccp_facet_tree_nearest(&r->shape->walls, x, bary, &distance2);
    iccp_facet_corners(&r->shape->walls, wall, corners);
    for (size_t k = 0; k < r->dim; ++k) {
        double foot = 0;
        for (size_t i = 0; i < r->dim; ++i)
            foot += bary[i] * corners[i][k];
        away[k] = x[k] - foot;
    }
    const double distance = iccp_vec_norm(r->dim, away);
    for (size_t k = 0; k < r->dim; ++k)
        away[k] = distance > 0 ? away[k] / distance : 0;
    return distance;
}

/* If a step would lead too near to a wall, it slides along the wall or is not taken. */
static void contain(relaxation *r, size_t i, const double *x, double *step)
{
    double *clearance = r->clearance + (i - r->n_held), away[3], there[3];
    const double least = CLEARANCE * r->spacing;
    double size = iccp_vec_norm(r->dim, step), toward = 0;
    if (r->shape->walls.n == 0 || *clearance - size >= least) {
        *clearance -= size;
        return;
    }
    *clearance = away_from_wall(r, x, away);
    if (*clearance - size >= least) {
        *clearance -= size;
        return;
    }
    for (size_t k = 0; k < r->dim; ++k)
        toward += step[k] * away[k];
    for (size_t k = 0; k < r->dim; ++k) {
        step[k] -= iccp_min(toward, 0) * away[k];
        there[k] = x[k] + step[k];
    }
    const double then = away_from_wall(r, there, away);
    if (then >= iccp_min(least, *clearance)) {
        *clearance = then;
        return;
    }
    for (size_t k = 0; k < r->dim; ++k)
        step[k] = 0;
}

static icc_status move_chunk(void *argument, size_t begin, size_t end)
{
    relaxation *r = argument;
    const double longest = LONGEST_STEP * r->spacing;
    for (size_t i = r->n_held + begin; i < r->n_held + end; ++i) {
        const double *x = r->points + r->dim * i;
        double step[3] = {0, 0, 0};
        push_of(r, i, step);
        const double size = GAIN * iccp_vec_norm(r->dim, step);
        for (size_t k = 0; k < r->dim; ++k)
            step[k] *= size > longest ? GAIN * longest / size : GAIN;
        contain(r, i, x, step);
        for (size_t k = 0; k < r->dim; ++k)
            r->next[r->dim * i + k] = x[k] + step[k];
    }
    return ICC_OK;
}

static icc_status relax_steps(relaxation *r, int32_t steps, const iccp_env *env)
{
    const size_t n_free = r->n - r->n_held, n_numbers = r->dim * n_free;
    for (int32_t step = 0; step < steps; ++step) {
        const iccp_env part = iccp_part(env, NULL, (double)step / steps, (step + 1.0) / steps);
        icc_status status = iccp_cells_create(&r->cells, r->dim, r->n, r->points, r->spacing, env);
        if (status == ICC_OK)
            status = iccp_for_chunks(&part, "sample", n_free, 512, move_chunk, r);
        iccp_cells_free(&r->cells);
        if (status != ICC_OK)
            return status;
        memcpy(r->points + r->dim * r->n_held, r->next + r->dim * r->n_held,
               n_numbers * sizeof *r->points);
    }
    return ICC_OK;
}

static icc_status relax(iccp_point_list *list, size_t n_held, const icc_shape *shape,
                        double spacing, int32_t steps, const iccp_env *env)
{
    relaxation r = {.shape = shape,
                    .dim = list->dim,
                    .n = list->n,
                    .n_held = n_held,
                    .spacing = spacing,
                    .points = list->points};
    r.next = iccp_alloc(&env->memory, r.n, r.dim * sizeof *r.next);
    r.clearance = iccp_alloc_zero(&env->memory, r.n - n_held, sizeof *r.clearance);
    icc_status status = ICC_ERR_MEMORY;
    if (r.next != NULL && r.clearance != NULL)
        status = relax_steps(&r, steps, env);
    iccp_free(&env->memory, r.next);
    iccp_free(&env->memory, r.clearance);
    return status;
}

icc_status iccp_blue_noise_fill(iccp_point_list *list, const icc_shape *shape, double spacing,
                                int32_t steps, uint64_t seed, const iccp_env *env)
{
    const size_t n_held = list->n;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    icc_status status = add_lattice(list, shape, spacing, seed, &part[0]);
    if (status == ICC_OK)
        status = iccp_point_list_thin(list, n_held, 0.5 * ICCP_SAMPLE_GAP * spacing, env);
    if (status == ICC_OK && list->n > n_held)
        status = relax(list, n_held, shape, spacing, steps, &part[1]);
    if (status == ICC_OK)
        status = iccp_point_list_thin(list, n_held, ICCP_SAMPLE_GAP * spacing, env);
    return status;
}
