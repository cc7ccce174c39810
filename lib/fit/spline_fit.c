/* A fit of control points: the spline of a frame around them, repaired where it folds. */
#include "fit/spline_fit.h"

#include "base/error.h"
#include "fit/lines_check.h"
#include "fit/spline/spline.h"
#include "map/given_mesh.h"
#include "map/nearest/nearest.h"

#include <math.h>
#include <string.h>

typedef struct spline_job {
    icc_fit *fit;
    iccp_frame frame[2]; /* of source and target */
    double *local[2];    /* 2 told.n: the points and their targets */
    double lower[2], upper[2];
    size_t n_segments;
    uint32_t *segments; /* 2 n_segments items: the ends of all parts of lines */
    iccp_spline spline;
    iccp_edge_set held; /* the edges of the map that must stay */
} spline_job;

/* ---- coordinates ---- */

/* Fits the source's frame to the points and the box. */
static icc_status fit_source_frame(spline_job *j, const iccp_env *env)
{
    const icc_fit *fit = j->fit;
    const size_t n = fit->told.n, n_box = fit->options.box != NULL ? 2 : 0;
    double *all = iccp_alloc(&env->memory, n + n_box, 2 * sizeof *all);
    if (all == NULL)
        return ICC_ERR_MEMORY;
    memcpy(all, fit->told.source, 2 * n * sizeof *all);
    memcpy(all + 2 * n, fit->box, 2 * n_box * sizeof *all);
    iccp_frame_fit(&j->frame[0], 2, n + n_box, all);
    iccp_free(&env->memory, all);
    iccp_frame_in(&j->frame[0], 2, fit->box, j->lower);
    iccp_frame_in(&j->frame[0], 2, fit->box + 2, j->upper);
    return ICC_OK;
}

/* Whether all points are in one place. */
static bool is_single(const iccp_told *told)
{
    for (size_t i = 2; i < 2 * told->n; ++i)
        if (told->source[i] < told->source[i % 2] || told->source[i] > told->source[i % 2])
            return false;
    return true;
}

static icc_status localise(spline_job *j, const iccp_env *env, icc_error *err)
{
    const iccp_told *told = &j->fit->told;
    const double *const given[2] = {told->source, told->target};
    icc_status status = fit_source_frame(j, env);
    iccp_frame_fit(&j->frame[1], 2, told->n, told->target);
    if (is_single(told)) { /* then lengths do not change */
        memcpy(j->frame[1].in, j->frame[0].in, sizeof j->frame[1].in);
        memcpy(j->frame[1].out, j->frame[0].out, sizeof j->frame[1].out);
    }
    for (int side = 0; status == ICC_OK && side < 2; ++side) {
        j->local[side] = iccp_alloc(&env->memory, told->n, 2 * sizeof **j->local);
        if (j->local[side] == NULL)
            status = ICC_ERR_MEMORY;
        else if (!iccp_frame_in_all(&j->frame[side], told->n, given[side], j->local[side]))
            status = iccp_fail_side(
                err,
                iccp_fail(err, ICC_ERR_ARGUMENT, "a coordinate is too small beside the others"),
                side + 1);
    }
    return status;
}

/* Gives tolerances in local lengths of the target. */
static icc_status localise_tolerances(double **out, const spline_job *j, const iccp_env *env)
{
    const iccp_told *told = &j->fit->told;
    double *local = iccp_alloc(&env->memory, told->n, sizeof *local);
    *out = local;
    if (local == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < told->n; ++i)
        local[i] = told->tolerance[i] * j->frame[1].in[0] * j->frame[1].in[1];
    return ICC_OK;
}

/* ---- lines ---- */

/* Lists the parts of lines, and checks that they meet nothing. */
static icc_status take_lines(spline_job *j, const iccp_env *env, icc_error *err)
{
    const iccp_told *told = &j->fit->told;
    j->segments = iccp_alloc(&env->memory, told->n, 2 * sizeof *j->segments);
    if (j->segments == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t i = 1; i < told->n; ++i)
        if (told->joined[i]) {
            j->segments[2 * j->n_segments] = i - 1;
            j->segments[2 * j->n_segments++ + 1] = i;
        }
    icc_status status = ICC_OK;
    for (int side = 0; status == ICC_OK && j->n_segments > 0 && side < 2; ++side)
        status = iccp_lines_check(told, j->local[side], side + 1, env, err);
    return status;
}

/* ---- model and repair ---- */

static icc_status make_spline(spline_job *j, const iccp_env *env, icc_error *err)
{
    const icc_fit *fit = j->fit;
    double *tolerances = NULL;
    icc_status status = localise_tolerances(&tolerances, j, env);
    const iccp_spline_task task = {.n = fit->told.n,
                                   .points = j->local[0],
                                   .targets = j->local[1],
                                   .tolerances = tolerances,
                                   .n_segments = j->n_segments,
                                   .segments = j->segments,
                                   .lower = fit->options.box != NULL ? j->lower : NULL,
                                   .upper = fit->options.box != NULL ? j->upper : NULL,
                                   .margin = fit->options.margin,
                                   .smoothing = fit->options.smoothing,
                                   .base = fit->base};
    if (status == ICC_OK)
        status = iccp_spline_create(&j->spline, &task, env, err);
    if (status == ICC_OK && fit->base == NULL)
        j->fit->base = iccp_spline_base_retain(j->spline.base);
    if (status == ICC_ERR_SOLVER)
        status = iccp_fail(err, ICC_ERR_RESOLUTION,
                           "doubles cannot solve this: points are too close together beside the "
                           "box, or tolerances too different");
    if (status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE)
        status = iccp_fail(err, ICC_ERR_RESOLUTION,
                           "lines are closer to one another or to points than rounding errors");
    iccp_free(&env->memory, tolerances);
    return status;
}

/* Numbers the facets to which the vertices of the map are fixed. */
static void number_facets(iccp_plmap *map)
{
    uint32_t n = 0;
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (map->corners.twin[c] == ICCP_NO_NEIGHBOUR)
            map->facet[map->corners.vertex[iccp_after(c)]] = n++;
    for (size_t v = 0; v < map->n_vertices; ++v)
        if (map->fixed[v] == ICCP_ON_POINT)
            map->facet[v] = n++;
}

static icc_status repair(spline_job *j, const iccp_env *env, icc_error *err)
{
    iccp_nearest_facts facts = {0};
    icc_fit_info *info = &j->fit->info;
    const iccp_edge_set *walls = &j->spline.base->lines.walls;
    number_facets(&j->spline.map);
    icc_status status = iccp_edge_set_add(&j->held, walls->n, walls->ends);
    if (walls->n > 0)
        j->spline.map.held = &j->held;
    if (status == ICC_OK)
        status = iccp_nearest(&j->spline.map, true, &facts, env, NULL);
    if (status == ICC_ERR_CERTIFICATE)
        status = iccp_fail(err, status,
                           "no one-to-one map through all points was found: the targets are too "
                           "close together or too tangled for doubles, or lines leave a common "
                           "point in another order");
    info->repair = facts.repair;
    info->n_folded = facts.n_folded;
    info->n_patches = facts.n_patches;
    info->changed = facts.changed;
    info->n_iterations = facts.n_iterations;
    return status;
}

/* ---- the map ---- */

/* Converts all vertices to the caller's coordinates. Exact points get the caller's bits. */
static void give_back(const spline_job *j, double *points, double *images)
{
    const iccp_spline *s = &j->spline;
    const iccp_told *told = &j->fit->told;
    for (size_t v = 0; v < s->map.n_vertices; ++v) {
        iccp_frame_out(&j->frame[0], 2, s->map.points + 2 * v, points + 2 * v);
        iccp_frame_out(&j->frame[1], 2, s->map.images + 2 * v, images + 2 * v);
    }
    for (size_t i = 0; i < told->n; ++i) {
        const size_t v = s->control.number[i];
        memcpy(points + 2 * v, told->source + 2 * i, 2 * sizeof *points);
        if (s->map.fixed[v] == ICCP_ON_POINT)
            memcpy(images + 2 * v, told->target + 2 * i, 2 * sizeof *images);
    }
}

/* Lists the vertices of exact points, and returns their number. */
static size_t list_exact(uint32_t *vertices, const iccp_plmap *map)
{
    size_t n = 0;
    for (uint32_t v = 0; v < map->n_vertices; ++v)
        if (map->fixed[v] == ICCP_ON_POINT)
            vertices[n++] = v;
    return n;
}

static void note_residuals(spline_job *j, const double *images)
{
    icc_fit *fit = j->fit;
    const iccp_spline *s = &j->spline;
    const double *unit = j->frame[1].out;
    double sum = 0;
    for (size_t i = 0; i < fit->told.n; ++i)
        for (size_t k = 0; k < 2; ++k) {
            const double off =
                images[2 * (size_t)s->control.number[i] + k] - fit->told.target[2 * i + k];
            fit->residuals[2 * i + k] = off;
            fit->left_out[2 * i + k] = s->left_out[2 * i + k] * unit[0] * unit[1];
            sum += off * off;
        }
    fit->info.margin = s->base->margin;
    fit->info.smoothing = s->base->smoothing;
    fit->info.residual = sqrt(sum / (double)fit->told.n);
    fit->info.left_out = s->left_out_residual * unit[0] * unit[1];
    fit->info.affine_residual = s->affine_residual * unit[0] * unit[1];
}

static icc_status make_map(spline_job *j, const iccp_env *env, icc_error *err)
{
    const iccp_plmap *map = &j->spline.map;
    const size_t n = map->n_vertices;
    uint32_t *exact = iccp_alloc(&env->memory, n, sizeof *exact);
    double *points = iccp_alloc(&env->memory, n, 2 * sizeof *points);
    double *images = iccp_alloc(&env->memory, n, 2 * sizeof *images);
    icc_status status = ICC_ERR_MEMORY;
    if (exact != NULL && points != NULL && images != NULL) {
        give_back(j, points, images);
        note_residuals(j, images);
        const iccp_given_mesh mesh = {.n_vertices = n,
                                      .points = points,
                                      .images = images,
                                      .n_triangles = map->corners.n_triangles,
                                      .triangles = map->corners.vertex,
                                      .n_held = list_exact(exact, map),
                                      .held = exact};
        status = iccp_map_of_mesh(&j->fit->map, &mesh, env, err);
    }
    iccp_free(&env->memory, exact);
    iccp_free(&env->memory, points);
    iccp_free(&env->memory, images);
    return status;
}

icc_status iccp_spline_fit(icc_fit *fit, const iccp_env *env, icc_error *err)
{
    spline_job j = {.fit = fit, .spline.memory = env->memory, .held.memory = env->memory};
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){4, 4, 1}, env);
    icc_status status = localise(&j, env, err);
    if (status == ICC_OK)
        status = take_lines(&j, env, err);
    if (status == ICC_OK) {
        status = make_spline(&j, &part[0], err);
        if (status == ICC_OK)
            status = repair(&j, &part[1], err);
        if (status == ICC_OK)
            status = make_map(&j, &part[2], err);
        iccp_spline_free(&j.spline);
    }
    iccp_edge_set_free(&j.held);
    iccp_free(&env->memory, j.segments);
    iccp_free(&env->memory, j.local[0]);
    iccp_free(&env->memory, j.local[1]);
    return status;
}
