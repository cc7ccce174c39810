/* Makes the natural spline of a frame in four steps: the affine fit, the choice of margin and
 * smoothing on coarse meshes, the solution on a fine one, and the residuals. What the affine fit
 * leaves is what bends, so an affine truth comes out to rounding. */
#include "fit/spline/spline.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "fit/spline/frame_choice.h"
#include "fit/spline/frame_mesh.h"
#include "fit/spline/jump_refinement.h"
#include "math/vec.h"

#include <string.h>

/* Cells across the box. */
enum { ACROSS = 32 };

/* Least margin. It keeps cells at the boundary from becoming tiny. */
static const double LEAST_MARGIN = 0.01;

/* The margin of fewer than three points, which have an affine map alone. */
static const double USUAL_MARGIN = 0.05;

/* The metric follows the affine fit up to this ratio of its stretches. */
static const double MOST_STRETCH = 8;

/* Edges are halved where a straight edge is off by more than this many median residuals left out.
 * The mean over a triangle is about half of that, so the mesh hardly adds to the error. There are
 * at most MOST_REFINED vertices for each that is solved for. */
static const double TOLERANCE = 1;
enum { MOST_REFINED = 2 };

/* ---- preparation ---- */

/* Sets the metric: lengths after the affine fit, and the box's longest side is about 1. */
static void find_metric(const iccp_trend *t, double size, double metric[4])
{
    const double *m = t->matrix, det = m[0] * m[3] - m[1] * m[2];
    const bool is_mild = iccp_vec_dot(4, m, m) <= (MOST_STRETCH + 1 / MOST_STRETCH) * det;
    for (int k = 0; k < 4; ++k)
        metric[k] = (is_mild ? m[k] / sqrt(det) : k % 3 == 0) / size;
}

/* Writes the targets less the affine fit. */
static void find_rest(const iccp_spline *s)
{
    for (size_t i = 0; i < s->control.n; ++i) {
        double image[2];
        iccp_trend_apply(&s->trend, s->control.points + 2 * i, image);
        for (size_t k = 0; k < 2; ++k)
            s->told[2 * i + k] = s->control.targets[2 * i + k] - image[k];
    }
}

/* Writes the weight of each point for smoothing 1: the square of a mean tolerance over that of its
 * own, or 0 if it is exact. Returns false if all are exact. */
static bool find_shares(size_t n, const double *tolerances, double *share)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < n; ++i)
        if (tolerances[i] > 0) {
            sum += 1 / (tolerances[i] * tolerances[i]);
            ++count;
        }
    for (size_t i = 0; i < n; ++i)
        share[i] = tolerances[i] > 0 ? count / (sum * tolerances[i] * tolerances[i]) : 0;
    return count > 0;
}

static icc_status make_room(iccp_spline *s, size_t n)
{
    s->n = n;
    s->left_out = iccp_alloc(&s->memory, n, 2 * sizeof *s->left_out);
    return s->left_out != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* ---- images and residuals ---- */

/* Returns the root mean square length of n vectors, without those that are not known. NaN if there
 * are none. */
static double mean_length(size_t n, const double *v)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < n; ++i) {
        const double square = iccp_vec_dot(2, v + 2 * i, v + 2 * i);
        if (isfinite(square)) {
            sum += square;
            ++count;
        }
    }
    return count > 0 ? sqrt(sum / count) : NAN;
}

/* With fewer than three points nothing bends, and there is no system. */
static bool has_system(const iccp_spline *s)
{
    return s->base->system.told != NULL;
}

/* Solves for the bending parts of the images, if there is a system, and leaves out points. */
static icc_status solve(iccp_spline *s, double *u, const iccp_env *env)
{
    for (size_t k = 0; k < 2 * s->control.n; ++k)
        s->left_out_own[k] = NAN;
    memset(u, 0, 2 * s->base->solved.n_vertices * sizeof *u);
    if (!has_system(s))
        return ICC_OK;
    const icc_status status = iccp_spline_system_solve(&s->base->system, s->told, u, env);
    return status == ICC_OK
               ? iccp_spline_system_leave_out(&s->base->system, s->told, u, s->left_out_own, env)
               : status;
}

static bool is_exact(const iccp_spline *s, size_t k)
{
    return !has_system(s) || !(s->base->system.weight[k] > 0);
}

/* Adds the affine fit to the images. Exact points get their targets. */
static void add_trend(iccp_spline *s)
{
    for (size_t v = 0; v < s->map.n_vertices; ++v) {
        double image[2];
        iccp_trend_apply(&s->trend, s->map.points + 2 * v, image);
        for (size_t k = 0; k < 2; ++k)
            s->map.images[2 * v + k] += image[k];
    }
    for (size_t k = 0; k < s->control.n; ++k)
        if (is_exact(s, k))
            memcpy(s->map.images + 2 * k, s->control.targets + 2 * k, 2 * sizeof(double));
}

/* Computes the residuals left out of the given points. The own target of a merged point may differ
 * from the common one. Points on segments are never left out alone, so theirs are not known. */
static void find_left_out(iccp_spline *s, const double *targets)
{
    const iccp_edge_set *walls = &s->base->lines.walls;
    for (size_t k = 0; k < 2 * walls->n; ++k)
        for (size_t c = 0; c < 2; ++c)
            s->left_out_own[2 * (size_t)walls->ends[k] + c] = NAN;
    for (size_t i = 0; i < s->n; ++i) {
        const size_t k = s->control.number[i];
        for (size_t c = 0; c < 2; ++c) {
            const double off = s->control.targets[2 * k + c] - targets[2 * i + c];
            s->left_out[2 * i + c] = s->left_out_own[2 * k + c] + off;
        }
    }
    s->left_out_residual = mean_length(s->n, s->left_out);
}

/* ---- the map ---- */

/* Exact points and the boundary are fixed. */
static void mark_fixed(const iccp_spline *s, iccp_plmap *map)
{
    memset(map->fixed, ICCP_FREE, map->n_vertices * sizeof *map->fixed);
    memset(map->facet, 0, map->n_vertices * sizeof *map->facet);
    for (size_t v = 0; v < map->n_vertices; ++v)
        map->along[v] = 0;
    for (size_t k = 0; k < s->control.n; ++k)
        if (is_exact(s, k))
            map->fixed[k] = ICCP_ON_POINT;
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (map->corners.twin[c] == ICCP_NO_NEIGHBOUR)
            map->fixed[map->corners.vertex[iccp_after(c)]] = ICCP_ALONG;
}

/* Copies the mesh into the map, with the bending parts of its vertices for images. */
static icc_status fill_map(iccp_spline *s, const iccp_box_mesh *mesh, const double *u)
{
    const double *m = s->trend.matrix;
    const icc_status status = iccp_plmap_begin(&s->map, mesh->n_vertices, mesh->n_triangles,
                                               sqrt(m[0] * m[3] - m[1] * m[2]), &s->memory);
    if (status != ICC_OK)
        return status;
    iccp_plmap_fill(&s->map, mesh->points, u, mesh->triangles, mesh->twins);
    mark_fixed(s, &s->map);
    return ICC_OK;
}

/* Sets *tolerance to a share of the median length of residuals left out, or 0 if none is known. */
static icc_status find_tolerance(const iccp_spline *s, double *tolerance, const iccp_env *env)
{
    const size_t n = s->n_given;
    double *length = iccp_alloc(&env->memory, n, sizeof *length);
    size_t count = 0;
    *tolerance = 0;
    if (length == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i) {
        length[count] = iccp_vec_norm(2, s->left_out_own + 2 * i);
        count += isfinite(length[count]) ? 1 : 0;
    }
    if (count > 0)
        *tolerance = TOLERANCE * iccp_select(length, count, count / 2);
    iccp_free(&env->memory, length);
    return ICC_OK;
}

/* Makes the map from the bending parts on the solved mesh, refined if that matters. */
static icc_status make_map(iccp_spline *s, const double *u, const iccp_env *env)
{
    double tolerance;
    icc_status status = find_tolerance(s, &tolerance, env);
    if (status != ICC_OK)
        return status;
    if (!(tolerance > 0))
        return fill_map(s, &s->base->solved, u);
    iccp_box_mesh fine;
    double *fine_u;
    status = iccp_jump_refine(&fine, &fine_u, &s->base->solved, u, &s->base->lines.walls, tolerance,
                              MOST_REFINED, env);
    if (status != ICC_OK)
        return status;
    status = fill_map(s, &fine, fine_u);
    iccp_free(&env->memory, fine_u);
    iccp_box_mesh_free(&fine);
    return status;
}

/* Factorises the system on the mesh. */
static icc_status make_system(iccp_spline *s, const double *share, const iccp_env *env)
{
    const size_t n = s->control.n;
    iccp_bending_mesh bending = iccp_bending_mesh_of(&s->base->solved);
    memcpy(bending.metric, s->base->metric, sizeof bending.metric);
    double *weight = iccp_alloc(&env->memory, n, sizeof *weight);
    uint32_t *told = iccp_alloc(&env->memory, n, sizeof *told);
    const bool ready = weight != NULL && told != NULL;
    for (uint32_t k = 0; ready && k < n; ++k) {
        weight[k] = s->base->smoothing > 0 ? share[k] / s->base->smoothing : 0;
        told[k] = k;
    }
    const icc_status status = ready ? iccp_spline_system_create(&s->base->system, &bending, n, told,
                                                                weight, s->trend.is_line, env)
                                    : ICC_ERR_MEMORY;
    iccp_free(&env->memory, weight);
    iccp_free(&env->memory, told);
    return status;
}

/* Solves and makes the map, with the system if there is one. */
static icc_status solve_and_map(iccp_spline *s, const double *targets, const iccp_env *env)
{
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 1}, env);
    double *u = iccp_alloc(&env->memory, s->base->solved.n_vertices, 2 * sizeof *u);
    icc_status status = u != NULL ? solve(s, u, &parts[0]) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = make_map(s, u, &parts[1]);
    iccp_free(&env->memory, u);
    if (status != ICC_OK)
        return status;
    add_trend(s);
    find_left_out(s, targets);
    return ICC_OK;
}

/* ---- beginnings ---- */

/* Merges the points and fits an affine map to them. */
static icc_status begin(iccp_spline *s, const iccp_spline_task *task, const iccp_env *env,
                        icc_error *err)
{
    icc_status status = iccp_distinct_points_create(&s->control, task->n, task->points,
                                                    task->targets, task->tolerances, env, err);
    s->n_given = s->control.n;
    if (status == ICC_OK)
        status = make_room(s, task->n);
    if (status == ICC_OK)
        status = iccp_trend_fit(&s->trend, s->n_given, s->control.points, s->control.targets, err);
    s->affine_residual = s->trend.residual;
    return status;
}

/* Prepares the metric, and the weights of points for smoothing 1. */
static void prepare(iccp_spline *s, const iccp_spline_task *task, double size, double *share)
{
    find_metric(&s->trend, size, s->base->metric);
    const bool has_weights = find_shares(s->control.n, s->control.tolerances, share) &&
                             !(task->smoothing < 0) && s->n_given >= 3;
    if (!has_weights)
        memset(share, 0, s->control.n * sizeof *share);
    s->base->smoothing = has_weights ? task->smoothing : 0;
}

static iccp_frame_question question_of(const iccp_spline *s, const iccp_spline_task *task,
                                       const double *share)
{
    const double *m = s->base->metric;
    return (iccp_frame_question){.n = s->n_given,
                                 .points = s->control.points,
                                 .values = s->told,
                                 .share = share,
                                 .lower = task->lower,
                                 .upper = task->upper,
                                 .metric = {m[0], m[1], m[2], m[3]},
                                 .is_line = s->trend.is_line};
}

/* ---- frames ---- */

iccp_spline_base *iccp_spline_base_retain(iccp_spline_base *base)
{
    (void)atomic_fetch_add(&base->references, 1);
    return base;
}

void iccp_spline_base_release(iccp_spline_base *base)
{
    if (base == NULL || atomic_fetch_sub(&base->references, 1) > 1)
        return;
    const iccp_memory memory = base->memory;
    iccp_box_mesh_free(&base->solved);
    iccp_told_lines_free(&base->lines);
    iccp_spline_system_free(&base->system);
    iccp_free(&memory, base);
}

/* Makes an empty base. */
static icc_status begin_base(iccp_spline *s)
{
    iccp_spline_base *base = iccp_alloc_zero(&s->memory, 1, sizeof *base);
    s->base = base;
    if (base == NULL)
        return ICC_ERR_MEMORY;
    base->memory = base->solved.memory = base->system.memory = s->memory;
    base->lines.memory = base->lines.walls.memory = s->memory;
    base->system.energy.memory = base->system.factor.memory = s->memory;
    atomic_init(&base->references, 1);
    return ICC_OK;
}

/* Chooses margin and smoothing, makes the mesh and factorises. */
static icc_status make_frame(iccp_spline *s, const iccp_spline_task *task, double *share,
                             const iccp_frame_region *region, const iccp_env *env)
{
    iccp_env parts[3];
    iccp_split(parts, 3, (const double[]){2, 1, 3}, env);
    const bool bends = s->n_given >= 3;
    prepare(s, task, region->size, share);
    s->base->margin = task->margin > 0 ? iccp_max(task->margin, LEAST_MARGIN)
                      : bends          ? 0
                                       : USUAL_MARGIN;
    const iccp_frame_question q = question_of(s, task, share);
    icc_status status =
        bends ? iccp_choose_frame(&s->base->margin, &s->base->smoothing, &q, &parts[0]) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_frame_mesh(&s->base->solved, region, s->base->margin, ACROSS, 0, &parts[1]);
    return status == ICC_OK && bends ? make_system(s, share, &parts[2]) : status;
}

/* Divides the segments for a new base. */
static icc_status divide_segments(iccp_spline *s, const iccp_spline_task *task, const iccp_env *env)
{
    iccp_frame_region region;
    uint32_t *segments = iccp_alloc(&env->memory, task->n_segments, 2 * sizeof *segments);
    icc_status status = segments != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t k = 0; status == ICC_OK && k < 2 * task->n_segments; ++k)
        segments[k] = s->control.number[task->segments[k]];
    if (status == ICC_OK)
        status = iccp_frame_region_create(&region, s->n_given, s->control.points, NULL, task->lower,
                                          task->upper, env);
    if (status == ICC_OK) {
        status = iccp_told_lines_create(&s->base->lines, &region, ACROSS, task->n_segments,
                                        segments, env);
        iccp_free(&env->memory, region.spacing);
    }
    iccp_free(&env->memory, segments);
    return status;
}

/* Tells the vertices inside segments, and makes room for what is told. */
static icc_status tell_lines(iccp_spline *s)
{
    const iccp_told_lines *lines = &s->base->lines;
    iccp_distinct_points *c = &s->control;
    const size_t n = c->n, all = n + lines->n;
    s->left_out_own = iccp_alloc(&s->memory, all, 2 * sizeof *s->left_out_own);
    s->told = iccp_alloc(&s->memory, all, 2 * sizeof *s->told);
    if (s->left_out_own == NULL || s->told == NULL ||
        !iccp_enlarge(&c->memory, &c->points, 2 * n, 2 * all, sizeof *c->points) ||
        !iccp_enlarge(&c->memory, &c->targets, 2 * n, 2 * all, sizeof *c->targets) ||
        !iccp_enlarge(&c->memory, &c->tolerances, n, all, sizeof *c->tolerances))
        return ICC_ERR_MEMORY;
    iccp_told_lines_place(lines, c->points, c->points + 2 * n);
    iccp_told_lines_place(lines, c->targets, c->targets + 2 * n);
    for (; c->n < all; ++c->n)
        c->tolerances[c->n] = 0;
    return ICC_OK;
}

/* Fills in a base that has its lines. */
static icc_status make_base(iccp_spline *s, const iccp_spline_task *task, const iccp_env *env)
{
    iccp_frame_region region;
    double *share = iccp_alloc(&env->memory, s->control.n, sizeof *share);
    icc_status status = share != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_frame_region_create(&region, s->control.n, s->control.points,
                                          &s->base->lines.walls, task->lower, task->upper, env);
    if (status == ICC_OK) {
        status = make_frame(s, task, share, &region, env);
        iccp_free(&env->memory, region.spacing);
    }
    iccp_free(&env->memory, share);
    return status;
}

static icc_status create(iccp_spline *s, const iccp_spline_task *task, const iccp_env *env,
                         icc_error *err)
{
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){task->base != NULL ? 0 : 6, 1}, env);
    icc_status status = begin(s, task, env, err);
    if (status != ICC_OK)
        return status;
    if (task->base != NULL)
        s->base = iccp_spline_base_retain(task->base);
    else
        status = begin_base(s);
    if (status == ICC_OK && task->base == NULL && task->n_segments > 0)
        status = divide_segments(s, task, env);
    if (status == ICC_OK)
        status = tell_lines(s);
    if (status == ICC_OK)
        find_rest(s);
    if (status == ICC_OK && task->base == NULL)
        status = make_base(s, task, &parts[0]);
    return status == ICC_OK ? solve_and_map(s, task->targets, &parts[1]) : status;
}

/* ---- all of it ---- */

static iccp_spline nothing(const iccp_memory *memory)
{
    iccp_spline s = {.memory = *memory};
    s.control.memory = s.map.memory = *memory;
    return s;
}

icc_status iccp_spline_create(iccp_spline *spline, const iccp_spline_task *task,
                              const iccp_env *env, icc_error *err)
{
    *spline = nothing(&env->memory);
    const icc_status status = create(spline, task, env, err);
    if (status != ICC_OK)
        iccp_spline_free(spline);
    return status;
}

void iccp_spline_free(iccp_spline *spline)
{
    const iccp_memory memory = spline->memory;
    iccp_distinct_points_free(&spline->control);
    iccp_plmap_free(&spline->map);
    iccp_spline_base_release(spline->base);
    iccp_free(&memory, spline->left_out);
    iccp_free(&memory, spline->left_out_own);
    iccp_free(&memory, spline->told);
    *spline = nothing(&memory);
}
