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
    s->vertices = iccp_alloc(&s->memory, n, sizeof *s->vertices);
    s->residuals = iccp_alloc(&s->memory, n, 2 * sizeof *s->residuals);
    s->left_out = iccp_alloc(&s->memory, n, 2 * sizeof *s->left_out);
    s->left_out_own = iccp_alloc(&s->memory, n, 2 * sizeof *s->left_out_own);
    s->told = iccp_alloc(&s->memory, n, 2 * sizeof *s->told);
    return s->vertices != NULL && s->residuals != NULL && s->left_out != NULL &&
                   s->left_out_own != NULL && s->told != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
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
    return s->system.told != NULL;
}

/* Solves for the bending parts of the images, if there is a system, and leaves out points. */
static icc_status solve(iccp_spline *s, double *u, const iccp_env *env)
{
    find_rest(s);
    for (size_t k = 0; k < 2 * s->control.n; ++k)
        s->left_out_own[k] = NAN;
    memset(u, 0, 2 * s->solved.n_vertices * sizeof *u);
    if (!has_system(s))
        return ICC_OK;
    const icc_status status = iccp_spline_system_solve(&s->system, s->told, u, env);
    return status == ICC_OK
               ? iccp_spline_system_leave_out(&s->system, s->told, u, s->left_out_own, env)
               : status;
}

static bool is_exact(const iccp_spline *s, size_t k)
{
    return !has_system(s) || !(s->system.weight[k] > 0);
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
            memcpy(s->map.images + 2 * (size_t)s->vertices[k], s->control.targets + 2 * k,
                   2 * sizeof(double));
}

/* Computes the residuals of the given points. The own target of a merged point may differ from the
 * common one. */
static void find_residuals(iccp_spline *s, const double *targets)
{
    for (size_t i = 0; i < s->n; ++i) {
        const size_t k = s->control.number[i], v = s->vertices[k];
        for (size_t c = 0; c < 2; ++c) {
            const double off = s->control.targets[2 * k + c] - targets[2 * i + c];
            s->residuals[2 * i + c] = s->map.images[2 * v + c] - targets[2 * i + c];
            s->left_out[2 * i + c] = s->left_out_own[2 * k + c] + off;
        }
    }
    s->residual = mean_length(s->n, s->residuals);
    s->left_out_residual = mean_length(s->n, s->left_out);
}

/* Completes images that are bending parts so far, on the vertices of the system. */
static icc_status finish_images(iccp_spline *s, const double *targets, const iccp_env *env)
{
    const icc_status status = iccp_jump_interpolate(s->map.images, &s->solved, s->map.points,
                                                    s->map.n_vertices, s->parents, env);
    if (status != ICC_OK)
        return status;
    add_trend(s);
    find_residuals(s, targets);
    return ICC_OK;
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
            map->fixed[s->vertices[k]] = ICCP_ON_POINT;
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (map->corners.twin[c] == ICCP_NO_NEIGHBOUR)
            map->fixed[map->corners.vertex[iccp_after(c)]] = ICCP_ALONG;
}

/* Copies the mesh into the map, and the bending parts of its first vertices. */
static icc_status fill_map(iccp_spline *s, const iccp_box_mesh *mesh, const double *u)
{
    const double *m = s->trend.matrix;
    const icc_status status = iccp_plmap_begin(&s->map, mesh->n_vertices, mesh->n_triangles,
                                               sqrt(m[0] * m[3] - m[1] * m[2]), &s->memory);
    if (status != ICC_OK)
        return status;
    iccp_plmap_fill(&s->map, mesh->points, mesh->points, mesh->triangles, mesh->twins);
    memcpy(s->map.images, u, 2 * s->solved.n_vertices * sizeof *u);
    mark_fixed(s, &s->map);
    return ICC_OK;
}

static bool is_less(const void *context, uint32_t a, uint32_t b)
{
    const double *length = context;
    return length[a] < length[b];
}

/* Sets *tolerance to a share of the median length of residuals left out, or 0 if none is known. */
static icc_status find_tolerance(const iccp_spline *s, double *tolerance, const iccp_env *env)
{
    const size_t n = s->control.n;
    uint32_t *order = iccp_alloc(&env->memory, n, 2 * sizeof *order);
    double *length = iccp_alloc(&env->memory, n, sizeof *length);
    const bool ready = order != NULL && length != NULL;
    size_t count = 0;
    *tolerance = 0;
    for (size_t i = 0; ready && i < n; ++i) {
        length[count] = iccp_vec_norm(2, s->left_out_own + 2 * i);
        order[count] = (uint32_t)count;
        count += isfinite(length[count]) ? 1 : 0;
    }
    if (ready && count > 0) {
        iccp_sort_indices(order, order + n, count, length, is_less);
        *tolerance = TOLERANCE * length[order[count / 2]];
    }
    iccp_free(&env->memory, order);
    iccp_free(&env->memory, length);
    return ready ? ICC_OK : ICC_ERR_MEMORY;
}

/* Makes the map from the bending parts on the solved mesh, refined if that is allowed and
 * matters. */
static icc_status make_map(iccp_spline *s, const double *u, bool refines, const iccp_env *env)
{
    double tolerance = 0;
    icc_status status = refines ? find_tolerance(s, &tolerance, env) : ICC_OK;
    if (status != ICC_OK)
        return status;
    if (!(tolerance > 0))
        return fill_map(s, &s->solved, u);
    iccp_box_mesh fine;
    status = iccp_jump_refine(&fine, &s->parents, &s->solved, u, tolerance, MOST_REFINED, env);
    if (status != ICC_OK)
        return status;
    status = fill_map(s, &fine, u);
    iccp_box_mesh_free(&fine);
    return status;
}

/* Factorises the system on the mesh. */
static icc_status make_system(iccp_spline *s, const double *share, const iccp_env *env)
{
    const size_t n = s->control.n;
    iccp_bending_mesh bending = iccp_bending_mesh_of(&s->solved);
    memcpy(bending.metric, s->metric, sizeof bending.metric);
    double *weight = iccp_alloc(&env->memory, n, sizeof *weight);
    if (weight == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t k = 0; k < n; ++k)
        weight[k] = s->smoothing > 0 ? share[k] / s->smoothing : 0;
    const icc_status status = iccp_spline_system_create(&s->system, &bending, n, s->vertices,
                                                        weight, s->trend.is_line, env);
    iccp_free(&env->memory, weight);
    return status;
}

/* Solves and makes the map, with the system if there is one. */
static icc_status solve_first(iccp_spline *s, const double *targets, bool refines,
                              const iccp_env *env)
{
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 1}, env);
    double *u = iccp_alloc(&env->memory, s->solved.n_vertices, 2 * sizeof *u);
    icc_status status = u != NULL ? solve(s, u, &parts[0]) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = make_map(s, u, refines, &parts[1]);
    iccp_free(&env->memory, u);
    return status == ICC_OK ? finish_images(s, targets, env) : status;
}

/* ---- beginnings ---- */

/* Merges the points and fits an affine map to them. */
static icc_status begin(iccp_spline *s, const iccp_spline_task *task, const double *points,
                        const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_distinct_points_create(&s->control, task->n, points, task->targets,
                                                    task->tolerances, env, err);
    if (status == ICC_OK)
        status = make_room(s, task->n);
    if (status == ICC_OK)
        status =
            iccp_trend_fit(&s->trend, s->control.n, s->control.points, s->control.targets, err);
    s->affine_residual = s->trend.residual;
    return status;
}

/* Prepares the values that bend, and the weights of points for smoothing 1. */
static void prepare(iccp_spline *s, const iccp_spline_task *task, double size, double *share)
{
    find_metric(&s->trend, size, s->metric);
    find_rest(s);
    const bool has_weights = find_shares(s->control.n, s->control.tolerances, share) &&
                             !(task->smoothing < 0) && s->control.n >= 3;
    if (!has_weights)
        memset(share, 0, s->control.n * sizeof *share);
    s->smoothing = has_weights ? task->smoothing : 0;
}

static iccp_frame_question question_of(const iccp_spline *s, const iccp_spline_task *task,
                                       const double *share)
{
    const double *m = s->metric;
    return (iccp_frame_question){.n = s->control.n,
                                 .points = s->control.points,
                                 .values = s->told,
                                 .share = share,
                                 .lower = task->lower,
                                 .upper = task->upper,
                                 .metric = {m[0], m[1], m[2], m[3]},
                                 .is_line = s->trend.is_line};
}

/* ---- frames ---- */

static icc_status make_frame(iccp_spline *s, const iccp_spline_task *task, double *share,
                             const iccp_frame_region *region, const iccp_env *env)
{
    iccp_env parts[4];
    iccp_split(parts, 4, (const double[]){2, 1, 3, 1}, env);
    const bool bends = s->control.n >= 3;
    prepare(s, task, region->size, share);
    for (uint32_t k = 0; k < s->control.n; ++k)
        s->vertices[k] = k;
    s->margin = task->margin > 0 ? iccp_max(task->margin, LEAST_MARGIN) : bends ? 0 : USUAL_MARGIN;
    const iccp_frame_question q = question_of(s, task, share);
    icc_status status =
        bends ? iccp_choose_frame(&s->margin, &s->smoothing, &q, &parts[0]) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_frame_mesh(&s->solved, region, s->margin, ACROSS, 0, &parts[1]);
    if (status == ICC_OK && bends)
        status = make_system(s, share, &parts[2]);
    return status == ICC_OK ? solve_first(s, task->targets, true, &parts[3]) : status;
}

static icc_status create(iccp_spline *s, const iccp_spline_task *task, const iccp_env *env,
                         icc_error *err)
{
    icc_status status = begin(s, task, task->points, env, err);
    if (status != ICC_OK)
        return status;
    iccp_frame_region region;
    double *share = iccp_alloc(&env->memory, s->control.n, sizeof *share);
    status = share != NULL ? iccp_frame_region_create(&region, s->control.n, s->control.points,
                                                      task->lower, task->upper, env)
                           : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        status = make_frame(s, task, share, &region, env);
        iccp_free(&env->memory, region.spacing);
    }
    iccp_free(&env->memory, share);
    return status;
}

/* ---- given meshes ---- */

static icc_status copy_mesh(iccp_spline *s, const iccp_box_mesh *mesh)
{
    const size_t n = 2 * mesh->n_vertices, n_corners = 3 * mesh->n_triangles;
    iccp_box_mesh *own = &s->solved;
    own->points = iccp_alloc(&s->memory, n, sizeof *own->points);
    own->triangles = iccp_alloc(&s->memory, n_corners, sizeof *own->triangles);
    own->twins = iccp_alloc(&s->memory, n_corners, sizeof *own->twins);
    if (own->points == NULL || own->triangles == NULL || own->twins == NULL)
        return ICC_ERR_MEMORY;
    own->n_vertices = mesh->n_vertices;
    own->n_triangles = mesh->n_triangles;
    memcpy(own->points, mesh->points, n * sizeof *own->points);
    memcpy(own->triangles, mesh->triangles, n_corners * sizeof *own->triangles);
    memcpy(own->twins, mesh->twins, n_corners * sizeof *own->twins);
    return ICC_OK;
}

/* Returns the longest side of the mesh's bounding box. */
static double size_of(const iccp_box_mesh *mesh)
{
    double size = 0;
    for (size_t k = 0; k < 2; ++k) {
        double low = mesh->points[k], high = low;
        for (size_t v = 0; v < mesh->n_vertices; ++v) {
            low = iccp_min(low, mesh->points[2 * v + k]);
            high = iccp_max(high, mesh->points[2 * v + k]);
        }
        size = iccp_max(size, high - low);
    }
    return size;
}

static icc_status solve_on_mesh(iccp_spline *s, const iccp_spline_task *task, double *share,
                                const iccp_env *env)
{
    iccp_env parts[3];
    iccp_split(parts, 3, (const double[]){3, 3, 1}, env);
    const bool bends = s->control.n >= 3;
    prepare(s, task, size_of(&s->solved), share);
    const iccp_frame_question q = question_of(s, task, share);
    icc_status status = ICC_OK;
    if (!(s->smoothing > 0))
        status = iccp_choose_smoothing(&s->smoothing, &q, &s->solved, s->vertices, &parts[0]);
    if (status == ICC_OK && bends)
        status = make_system(s, share, &parts[1]);
    return status == ICC_OK ? solve_first(s, task->targets, false, &parts[2]) : status;
}

static icc_status create_on_mesh(iccp_spline *s, const iccp_box_mesh *mesh,
                                 const uint32_t *vertices, const iccp_spline_task *task,
                                 const iccp_env *env, icc_error *err)
{
    double *points = iccp_alloc(&env->memory, task->n, 2 * sizeof *points);
    double *share = iccp_alloc(&env->memory, task->n, sizeof *share);
    icc_status status = points != NULL && share != NULL ? copy_mesh(s, mesh) : ICC_ERR_MEMORY;
    for (size_t i = 0; status == ICC_OK && i < task->n; ++i)
        memcpy(points + 2 * i, mesh->points + 2 * (size_t)vertices[i], 2 * sizeof *points);
    if (status == ICC_OK)
        status = begin(s, task, points, env, err);
    for (size_t i = 0; status == ICC_OK && i < task->n; ++i)
        s->vertices[s->control.number[i]] = vertices[i];
    if (status == ICC_OK)
        status = solve_on_mesh(s, task, share, env);
    iccp_free(&env->memory, points);
    iccp_free(&env->memory, share);
    return status;
}

/* ---- all of it ---- */

static iccp_spline nothing(const iccp_memory *memory)
{
    iccp_spline s = {.memory = *memory};
    s.control.memory = s.map.memory = s.system.memory = s.solved.memory = *memory;
    s.system.energy.memory = s.system.factor.memory = *memory;
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

icc_status iccp_spline_create_on_mesh(iccp_spline *spline, const iccp_box_mesh *mesh,
                                      const uint32_t *vertices, const iccp_spline_task *task,
                                      const iccp_env *env, icc_error *err)
{
    *spline = nothing(&env->memory);
    const icc_status status = create_on_mesh(spline, mesh, vertices, task, env, err);
    if (status != ICC_OK)
        iccp_spline_free(spline);
    return status;
}

void iccp_spline_free(iccp_spline *spline)
{
    const iccp_memory memory = spline->memory;
    iccp_distinct_points_free(&spline->control);
    iccp_plmap_free(&spline->map);
    iccp_box_mesh_free(&spline->solved);
    iccp_spline_system_free(&spline->system);
    iccp_free(&memory, spline->vertices);
    iccp_free(&memory, spline->residuals);
    iccp_free(&memory, spline->left_out);
    iccp_free(&memory, spline->left_out_own);
    iccp_free(&memory, spline->told);
    iccp_free(&memory, spline->parents);
    *spline = nothing(&memory);
}

icc_status iccp_spline_aim(iccp_spline *spline, const double *targets, const double *tolerances,
                           const iccp_env *env, icc_error *err)
{
    icc_status status =
        iccp_distinct_points_aim(&spline->control, spline->n, targets, tolerances, env, err);
    if (status == ICC_OK)
        status = iccp_trend_fit(&spline->trend, spline->control.n, spline->control.points,
                                spline->control.targets, err);
    spline->affine_residual = spline->trend.residual;
    if (status == ICC_OK)
        status = solve(spline, spline->map.images, env);
    return status == ICC_OK ? finish_images(spline, targets, env) : status;
}
