/* Makes samples on a grid, or as blue noise. */
#include "kernel/sampling/sampling.h"

#include "base/error.h"
#include "base/minmax.h"
#include "kernel/sampling/blue_noise.h"
#include "kernel/sampling/boundary_samples.h"
#include "kernel/sampling/lattice_filter.h"
#include "math/elementary.h"
#include "math/vec.h"

#include <math.h>

static const double MAX_SAMPLES = 16777216; /* 2^24 */
/* Default spacing as a share of the longest side, in 2-D and in 3-D. The cost of the weights grows
 * with the square of the number of samples. */
static const double DEFAULT_SPACING[] = {0.01, 0.05};
static const int32_t DEFAULT_STEPS = 60;
/* In spacings: the gap on surfaces, where samples are spread at random. It leaves about one per
 * square of the spacing. */
static const double SURFACE_GAP = 0.75;
/* Least spacing, in distances at which a point is on a wall. Inside and edge samples must be
 * distinguishable. */
static const double FINEST = 16;
/* Covers the rounding of counts such as 10 / 0.1. */
static const double COUNT_TOLERANCE = 1e-9;

static icc_status fail_many(icc_error *err)
{
    return iccp_fail(
        err, ICC_ERR_RESOLUTION,
        "the spacing is too small: more than 2^24 samples, or 2^27 places for them in the "
        "shape's box");
}

static double default_spacing(const icc_shape *shape)
{
    double longest = 0;
    for (size_t k = 0; k < shape->dim; ++k)
        longest = iccp_max(longest, shape->upper[k] - shape->lower[k]);
    return DEFAULT_SPACING[shape->dim == 3] * longest;
}

/* -------------------------------------------------------------------- grid */

typedef struct grid {
    size_t dim;
    double lower[3], spacing, border; /* number of points before the lower corner */
} grid;

static void grid_point(const void *lattice, const size_t *at, double *point)
{
    const grid *g = lattice;
    for (size_t k = 0; k < g->dim; ++k)
        point[k] = g->lower[k] + ((double)at[k] - g->border) * g->spacing;
}

/* The grid has a point at the lower corner of the shape's box, so samplings of a shape at one
 * spacing agree. It extends beyond the box by whole spacings, up to the margin. Unlike blue noise,
 * its points are in the caller's coordinates from the start. */
static icc_status spread_grid(iccp_point_list *list, const icc_shape *shape,
                              const icc_sampling_options *options, const iccp_env *env,
                              icc_error *err)
{
    const double *in = shape->frame.in;
    grid g = {.dim = shape->dim, .spacing = options->spacing, .border = floor(options->margin)};
    iccp_lattice_filter filter = {
        .shape = shape, .count = {1, 1, 1}, .point = grid_point, .lattice = &g};
    /* A point at the margin, up to rounding, belongs to it. */
    filter.margin = options->margin * (1 + COUNT_TOLERANCE) * (options->spacing * in[0] * in[1]);
    double all = 1;
    for (size_t k = 0; k < shape->dim; ++k) {
        const double side = (shape->upper[k] - shape->lower[k]) / g.spacing;
        const double n = floor(side + COUNT_TOLERANCE) + 1 + 2 * g.border;
        g.lower[k] = shape->lower[k];
        all *= n;
        if (!(all <= (double)ICCP_MAX_LATTICE))
            return fail_many(err);
        filter.count[k] = (size_t)n;
    }
    const icc_status status = iccp_lattice_filter_add(list, &filter, env);
    return status == ICC_OK && (double)list->n > MAX_SAMPLES ? fail_many(err)
                                                             : iccp_explain(err, status);
}

/* -------------------------------------------------------------- blue noise */

static double facet_size(const icc_shape *shape, const iccp_facet_tree *tree, uint32_t facet)
{
    const double *c[3];
    double u[3] = {0, 0, 0}, v[3] = {0, 0, 0}, n[3];
    iccp_facet_corners(tree, facet, c);
    for (size_t k = 0; k < shape->dim; ++k) {
        u[k] = c[1][k] - c[0][k];
        v[k] = shape->dim == 3 ? c[2][k] - c[0][k] : 0;
    }
    if (shape->dim == 2)
        return iccp_hypot(u[0], u[1]);
    for (int k = 0; k < 3; ++k)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    return 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/* Estimates how many samples there will be. The spacing is local. */
static double expect_samples(const icc_shape *shape, double spacing)
{
    double inside = 0, n = 0;
    for (size_t r = 0; r < shape->n_regions; ++r) {
        const icc_domain *d = shape->regions[r];
        double size = d->measure;
        for (int32_t k = 0; k < d->dim; ++k)
            size *= d->frame.out[0] * shape->frame.in[0] * (d->frame.out[1] * shape->frame.in[1]) /
                    spacing;
        inside = iccp_max(inside, size);
    }
    for (uint32_t f = 0; f < shape->walls.n; ++f)
        n += facet_size(shape, &shape->walls, f) / iccp_power(spacing, shape->dim - 1);
    for (size_t s = 0; s < shape->n_segments; ++s) {
        const double *a = shape->local + shape->dim * (shape->n_walled + shape->segments[2 * s]);
        const double *b =
            shape->local + shape->dim * (shape->n_walled + shape->segments[2 * s + 1]);
        n += iccp_vec_distance(shape->dim, a, b) / spacing;
    }
    return n + inside;
}

static bool on_edge(const iccp_spot *spot)
{
    return spot->wall != ICCP_NOWHERE || spot->curve != ICCP_NOWHERE;
}

/* Fixed points must lie in the shape and differ. Two samples at one place would make the kernel's
 * matrix singular. */
static icc_status check_fixed(const icc_shape *shape, const icc_sampling_options *options,
                              const iccp_env *env, icc_error *err)
{
    iccp_point_list list;
    iccp_point_list_start(&list, shape->dim, env);
    double *distance = iccp_alloc(&env->memory, options->n_fixed, sizeof *distance);
    icc_status status = distance == NULL ? iccp_fail_memory(err) : ICC_OK;
    for (size_t i = 0; status == ICC_OK && i < options->n_fixed; ++i) {
        const iccp_spot spot = iccp_shape_spot(shape, options->fixed + shape->dim * i);
        if (!on_edge(&spot) && spot.region == ICCP_NOWHERE)
            status = iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, (int64_t)i,
                                  "fixed point %zu lies in no region and on no curve", i);
        iccp_point_list_add(&list, spot.at);
    }
    if (status == ICC_OK && list.failed)
        status = iccp_fail_memory(err);
    if (status == ICC_OK)
        status = iccp_explain(
            err, iccp_nearest_distances(shape->dim, list.n, list.points, distance, env));
    for (size_t i = 0; status == ICC_OK && i < options->n_fixed; ++i)
        if (!(distance[i] > 0))
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                  "fixed point %zu is the same as another one", i);
    iccp_point_list_free(&list);
    iccp_free(&env->memory, distance);
    return status;
}

/* Adds the caller's points on walls and curves, or the other ones. */
static void add_fixed(iccp_point_list *list, const icc_shape *shape,
                      const icc_sampling_options *options, bool edge)
{
    for (size_t i = 0; i < options->n_fixed; ++i) {
        const iccp_spot spot = iccp_shape_spot(shape, options->fixed + shape->dim * i);
        if (on_edge(&spot) == edge)
            iccp_point_list_add(list, spot.at);
    }
}

/* Adds samples on lines first, then on surfaces where there is room. */
static icc_status add_boundary_samples(iccp_point_list *list, const icc_shape *shape,
                                       double spacing, uint64_t seed, const iccp_env *env)
{
    const size_t n_fixed = list->n, dim = shape->dim;
    icc_status status =
        iccp_segments_sample(list, shape->local + dim * shape->n_walled, shape->n_vertices,
                             shape->n_segments, shape->segments, spacing, env);
    if (status == ICC_OK && dim == 2)
        status = iccp_segments_sample(list, shape->local, shape->n_walled, shape->walls.n,
                                      shape->facets, spacing, env);
    if (status == ICC_OK && dim == 3 && shape->walls.n > 0)
        status = iccp_creases_sample(list, shape, spacing, env);
    if (status == ICC_OK)
        status = iccp_point_list_thin(list, n_fixed, ICCP_SAMPLE_GAP * spacing, env);
    if (status != ICC_OK || dim == 2 || shape->walls.n == 0)
        return status;
    const size_t n_lines = list->n;
    status = iccp_surface_sample(list, shape, spacing, seed);
    return status == ICC_OK ? iccp_point_list_thin(list, n_lines, SURFACE_GAP * spacing, env)
                            : status;
}

/* Adds all samples that stay where they are, those on walls and curves first. When room is scarce,
 * the caller's points have priority. */
static icc_status add_held(iccp_point_list *list, const icc_shape *shape,
                           const icc_sampling_options *options, double spacing, const iccp_env *env)
{
    iccp_point_list samples;
    iccp_point_list_start(&samples, shape->dim, env);
    add_fixed(&samples, shape, options, true);
    const size_t n_edge = samples.n;
    add_fixed(&samples, shape, options, false);
    const size_t n_fixed = samples.n;
    const icc_status status = add_boundary_samples(&samples, shape, spacing, options->seed, env);
    for (size_t i = 0; status == ICC_OK && i < samples.n; ++i)
        if (i < n_edge || i >= n_fixed)
            iccp_point_list_add(list, samples.points + shape->dim * i);
    for (size_t i = n_edge; status == ICC_OK && i < n_fixed; ++i)
        iccp_point_list_add(list, samples.points + shape->dim * i);
    iccp_point_list_free(&samples);
    return status == ICC_OK && list->failed ? ICC_ERR_MEMORY : status;
}

/* Refuses impossible requests before it allocates much. Then it places held samples and relaxes the
 * others among them. The list is local until the end. */
static icc_status spread_blue(iccp_point_list *list, const icc_shape *shape,
                              const icc_sampling_options *options, const iccp_env *env,
                              icc_error *err)
{
    const int32_t steps = options->steps == 0 ? DEFAULT_STEPS : options->steps;
    const double spacing = options->spacing * shape->frame.in[0] * shape->frame.in[1];
    if (!(spacing >= FINEST * shape->tolerance))
        return iccp_fail(err, ICC_ERR_RESOLUTION,
                         "the spacing is lost in the rounding of the coordinates");
    if (!(expect_samples(shape, spacing) + (double)options->n_fixed <= MAX_SAMPLES))
        return fail_many(err);
    icc_status status = options->n_fixed > 0 ? check_fixed(shape, options, env, err) : ICC_OK;
    if (status != ICC_OK)
        return status;
    status = add_held(list, shape, options, spacing, env);
    if (status == ICC_OK)
        status = iccp_blue_noise_fill(list, shape, spacing, steps, options->seed, env);
    if (status == ICC_ERR_RESOLUTION || (status == ICC_OK && (double)list->n > MAX_SAMPLES))
        return fail_many(err);
    for (size_t i = 0; i < list->n; ++i) {
        double *x = list->points + shape->dim * i;
        iccp_frame_out(&shape->frame, (int32_t)shape->dim, x, x);
    }
    return iccp_explain(err, status);
}

/* ------------------------------------------------------------------ create */

icc_status iccp_sampling_create(icc_sampling **out, const icc_shape *shape,
                                const icc_sampling_options *options, const iccp_env *env,
                                icc_error *err)
{
    icc_sampling_options full = *options;
    iccp_point_list list;
    *out = NULL;
    if (!(full.spacing > 0))
        full.spacing = default_spacing(shape);
    const icc_sampling_info info = {.kind = full.kind, .spacing = full.spacing};
    const iccp_env whole = iccp_part(env, "sample", 0, 1);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, &whole);
    iccp_point_list_start(&list, shape->dim, env);
    icc_status status = full.kind == ICC_SAMPLING_GRID
                            ? spread_grid(&list, shape, &full, &part[0], err)
                            : spread_blue(&list, shape, &full, &part[0], err);
    if (status == ICC_OK)
        status = iccp_sampling_finish(out, shape, list.n, list.points, &info, &part[1], err);
    iccp_point_list_free(&list);
    return status;
}
