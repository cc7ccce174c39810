/* Both surfaces are drawn on the sphere (surface/sphere.h), one drawing is turned to lie on the
 * other (surface/rotation.h), each is moved on the other (surface/relax.h), and both are cut by one
 * another (surface/sphere_overlay.h), so that they have the same triangles, which are then made
 * fewer (surface/simplify_apart.h). */
#include "match/surfaces.h"

#include "base/error.h"
#include "base/minmax.h"
#include "math/elementary.h"
#include "surface/corner_angle.h"
#include "surface/helpers.h"
#include "surface/landmark_paths.h"
#include "surface/landmark_sphere.h"
#include "surface/relax.h"
#include "surface/rotation.h"
#include "surface/simplify_apart.h"
#include "surface/sphere.h"
#include "surface/stretch.h"

#include <string.h>

/* Of the diagonal. */
static const double default_tolerance = 1e-3;

/* Edges that come about are at most this part of the diagonal, or so many times as long as those
 * that were given are on average: the map between the surfaces bends at vertices only. */
static const double longest_edge = 0.05, times_given = 2;

/* Crossings of the two drawings, at most, for each vertex: with a fair map there are 3. */
enum { MOST_CROSSINGS = 200 };

/* In which drawings are moved on one another where there are no landmarks. */
enum { ROUNDS = 30 };

static const double most_energy = 1e8;

/* Of the diagonal: how far a landmark may be from a vertex. */
static const double farthest_landmark = 0.02;

/* Paths need so many pairs. */
enum { LEAST_PAIRS = 4 };

typedef struct body {
    const icc_domain *domain;
    iccp_half_edges m; /* faces counter-clockwise from outside */
    const double *x;   /* local coordinates, of `split` if that is there */
    double *directions;
    iccp_split_surface split; /* with landmarks: behind the given vertices there are others */
    uint32_t *landmarks;      /* vertices */
} body;

static icc_status make_body(body *b, const icc_domain *domain, const iccp_env *env, icc_error *err)
{
    const size_t n = domain->n_facets;
    uint32_t *const faces = iccp_alloc(&env->memory, n, 3 * sizeof *faces);
    b->domain = domain;
    b->x = domain->vertices;
    if (faces == NULL)
        return iccp_fail_memory(err);
    for (size_t f = 0; f < n; ++f) {
        const uint32_t *const v = domain->facets + 3 * f;
        faces[3 * f] = v[0];
        faces[3 * f + 1] = domain->orientation > 0 ? v[1] : v[2];
        faces[3 * f + 2] = domain->orientation > 0 ? v[2] : v[1];
    }
    const icc_status status = iccp_half_edges_create(&b->m, domain->n_vertices, n, faces, env, err);
    iccp_free(&env->memory, faces);
    return status;
}

static void free_body(body *b, const iccp_memory *memory)
{
    iccp_half_edges_free(&b->m);
    iccp_split_surface_free(&b->split);
    iccp_free(memory, b->landmarks);
    iccp_free(memory, b->directions);
}

static double diagonal_of(const body *b)
{
    return iccp_vec_distance(3, b->domain->lower, b->domain->upper);
}

static double mean_edge(const body *b)
{
    const iccp_half_edges *const m = &b->m;
    double sum = 0;
    for (uint32_t h = 0; h < 3 * m->n_faces; ++h)
        sum += iccp_vec_distance(3, b->x + 3 * (size_t)m->origin[h],
                                 b->x + 3 * (size_t)iccp_edge_end(m, h));
    return sum / (3 * (double)m->n_faces);
}

/* ---- on the sphere ---- */

/* Moves each drawing on the other. */
static icc_status relax(body bodies[2], const iccp_env *env, icc_error *err)
{
    iccp_drawn_surface side[2];
    for (int s = 0; s < 2; ++s) {
        const body *const b = &bodies[s];
        side[s] = (iccp_drawn_surface){&b->m, b->x, b->directions, iccp_sphere_scale(&b->m, b->x)};
    }
    iccp_relaxation r;
    double left;
    icc_status status =
        iccp_relaxation_create(&r, side, (const uint8_t *const[]){NULL, NULL}, &env->memory);
    if (status == ICC_OK)
        status = iccp_relax(&r, ICCP_LONGER, ROUNDS, &left, env);
    iccp_relaxation_free(&r, &env->memory);
    status = iccp_explain(err, status);
    for (int s = 0; s < 2 && status == ICC_OK; ++s)
        status = iccp_sphere_check(&bodies[s].m, bodies[s].directions, err);
    return status;
}

static icc_status draw(body bodies[2], const iccp_env *env, icc_error *err)
{
    icc_status status = ICC_OK;
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        body *const b = &bodies[side];
        b->directions = iccp_alloc(&env->memory, b->m.n_vertices, 3 * sizeof *b->directions);
        if (b->directions == NULL)
            return iccp_fail_memory(err);
        const iccp_env part = iccp_part(env, NULL, 0.25 * side, 0.25 * side + 0.25);
        status = iccp_sphere_draw(b->directions, b->m.n_vertices, b->x, b->m.n_faces, b->m.origin,
                                  &part, err);
        if (status != ICC_OK)
            return iccp_fail_side(err, status, side + 1);
    }
    const iccp_env turning = iccp_part(env, NULL, 0.5, 0.7), last = iccp_part(env, NULL, 0.7, 1);
    double energy;
    status = iccp_explain(
        err, iccp_rotation_find(bodies[0].directions, bodies[1].directions,
                                (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
                                (const double *const[]){bodies[0].x, bodies[1].x}, 0,
                                (const uint32_t *const[]){NULL, NULL}, &energy, &turning));
    return status == ICC_OK ? relax(bodies, &last, err) : status;
}

/* The vertices nearest to the landmarks of one side, which are no two of them the same. */
static icc_status find_landmarks(body *b, size_t n, const double *given, int side,
                                 const iccp_memory *memory, icc_error *err)
{
    const icc_domain *const d = b->domain;
    const double most = farthest_landmark * iccp_vec_distance(3, d->lower, d->upper);
    b->landmarks = iccp_alloc(memory, n + LEAST_PAIRS, sizeof *b->landmarks);
    if (b->landmarks == NULL)
        return iccp_fail_memory(err);
    for (size_t k = 0; k < n; ++k) {
        double p[3], least = HUGE_VAL;
        iccp_frame_in(&d->frame, 3, given + 6 * k + 3 * side, p);
        for (uint32_t v = 0; v < d->n_vertices; ++v) {
            const double distance = iccp_vec_distance2(3, p, d->vertices + 3 * (size_t)v);
            if (b->m.degree[v] > 0 && distance < least) {
                least = distance;
                b->landmarks[k] = v;
            }
        }
        icc_status status = ICC_OK;
        if (!(least <= most * most))
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)k,
                                  "landmark %zu is too far from the vertices of the %s", k,
                                  side == 0 ? "source" : "target");
        for (size_t i = 0; i < k && status == ICC_OK; ++i)
            if (b->landmarks[i] == b->landmarks[k])
                status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)k,
                                      "landmark %zu is at the same vertex of the %s as landmark "
                                      "%zu",
                                      k, side == 0 ? "source" : "target", i);
        if (status != ICC_OK)
            return iccp_fail_side(err, status, side + 1);
    }
    return ICC_OK;
}

/* Draws both surfaces with landmarks in the same places; their edges may be halved then. Where
 * landmarks are few others are found beside them, of which nothing more is asked. */
static icc_status draw_by_landmarks(body bodies[2], size_t n, const double *given,
                                    const iccp_env *env, icc_error *err)
{
    const size_t n_all = n < LEAST_PAIRS ? LEAST_PAIRS : n;
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){n < n_all ? 1 : 0, 2}, env);
    iccp_split_surface split[2] = {{.memory = env->memory}, {.memory = env->memory}};
    iccp_half_edges m[2] = {{.memory = env->memory}, {.memory = env->memory}};
    double *directions[2] = {NULL, NULL};
    icc_status status = ICC_OK;
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        status = find_landmarks(&bodies[side], n, given, side, &env->memory, err);
    }
    if (status == ICC_OK && n < n_all)
        status =
            iccp_helpers_find((uint32_t *const[]){bodies[0].landmarks, bodies[1].landmarks}, n,
                              n_all, (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
                              (const double *const[]){bodies[0].x, bodies[1].x}, &parts[0], err);
    if (status == ICC_OK)
        status = iccp_landmark_sphere_draw(
            directions, m, split, (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
            (const double *const[]){bodies[0].x, bodies[1].x}, n_all,
            (const uint32_t *const[]){bodies[0].landmarks, bodies[1].landmarks}, &parts[1], err);
    for (int side = 0; side < 2; ++side) {
        body *const b = &bodies[side];
        iccp_half_edges_free(&b->m);
        b->m = m[side];
        b->split = split[side];
        b->x = split[side].x;
        b->directions = directions[side];
    }
    return status;
}

static icc_status cut(iccp_common_surface *common, const body bodies[2], const iccp_env *env,
                      icc_error *err)
{
    const iccp_half_edges *const m[2] = {&bodies[0].m, &bodies[1].m};
    const double *const directions[2] = {bodies[0].directions, bodies[1].directions};
    const double *const x[2] = {bodies[0].x, bodies[1].x};
    const size_t most = MOST_CROSSINGS * (m[0]->n_left + m[1]->n_left);
    iccp_sphere_overlay overlay;
    icc_status status = iccp_sphere_overlay_create(&overlay, m, directions, most, env, err);
    if (status == ICC_OK)
        status = iccp_common_surface_create(common, &overlay, m, directions, x, &env->memory, err);
    iccp_sphere_overlay_free(&overlay, &env->memory);
    for (int side = 0; side < 2; ++side)
        for (size_t v = 0; v < common->n_vertices; ++v) {
            const iccp_frame *const frame = &bodies[side].domain->frame;
            double *const p = common->x[side] + 3 * v;
            /* Vertices in the middle of edges were not given. */
            if (common->origin[side][v] >= bodies[side].domain->n_vertices)
                common->origin[side][v] = ICCP_NO_EDGE;
            /* What was not given is rounded as the caller will see it: what meets there has to be
             * seen to meet here. */
            if (common->origin[side][v] == ICCP_NO_EDGE) {
                iccp_frame_out(frame, 3, p, p);
                iccp_frame_in(frame, 3, p, p);
            }
        }
    return status;
}

/* ---- what came of it ---- */

/* Energy, slopes and angles of the common triangles. */
static void measure(icc_match_info *info, const iccp_common_surface *c)
{
    double area[2] = {0, 0}, least_sine = 1, sum = 0;
    for (int round = 0; round < 2; ++round)
        for (size_t f = 0; f < c->n_faces; ++f) {
            const double *p[2][3];
            double scaled[3][3], twice[2];
            const double *to[3];
            /* The target is scaled once its area is known. */
            const double scale = round == 0 ? 1 : sqrt(area[0] / area[1]);
            for (int side = 0; side < 2; ++side) {
                double normal[3];
                for (size_t i = 0; i < 3; ++i)
                    p[side][i] = c->x[side] + 3 * (size_t)c->faces[3 * f + i];
                iccp_triangle_normal(normal, p[side][0], p[side][1], p[side][2]);
                twice[side] = iccp_vec_norm(3, normal);
                if (round == 0)
                    area[side] += twice[side];
                least_sine =
                    iccp_min(least_sine, iccp_least_sine(p[side][0], p[side][1], p[side][2]));
            }
            if (round == 0)
                continue;
            for (int i = 0; i < 3; ++i) {
                for (int k = 0; k < 3; ++k)
                    scaled[i][k] = scale * p[1][i][k];
                to[i] = scaled[i];
            }
            sum += twice[0] * iccp_stretch_energy(p[0], to, most_energy);
            const double slope = twice[1] / twice[0] * scale * scale;
            info->least_slope = f == 0 ? slope : iccp_min(info->least_slope, slope);
            info->most_slope = f == 0 ? slope : iccp_max(info->most_slope, slope);
        }
    info->energy = sum / area[0];
    info->least_angle =
        360 * iccp_atan2_turns(least_sine, sqrt(iccp_max(0, 1 - least_sine * least_sine)));
}

static void fill_in(icc_match_info *info, const iccp_common_surface *c, double off)
{
    info->dim = 3;
    info->cost = info->second = info->sure = HUGE_VAL;
    info->n_vertices = c->n_vertices;
    info->off = off;
    for (size_t v = 0; v < c->n_vertices; ++v)
        info->n_joined += c->origin[0][v] != ICCP_NO_EDGE && c->origin[1][v] != ICCP_NO_EDGE;
    measure(info, c);
}

/* A common surface as a domain, in the caller's coordinates; vertices that were given have the bits
 * that they were given with. */
static icc_status make_domain(icc_domain **out, iccp_common_surface *c, int side, const body *b,
                              const iccp_env *env, icc_error *err)
{
    for (size_t v = 0; v < c->n_vertices; ++v) {
        double *const p = c->x[side] + 3 * v;
        if (c->origin[side][v] != ICCP_NO_EDGE)
            iccp_domain_given(b->domain, c->origin[side][v], p);
        else
            iccp_frame_out(&b->domain->frame, 3, p, p);
    }
    const icc_status status =
        iccp_domain_create(out, 3, c->n_vertices, c->x[side], c->n_faces, c->faces, env, err);
    return status == ICC_OK ? status : iccp_fail_side(err, status, side + 1);
}

/* ---- from beginning to end ---- */

static icc_status simplify(iccp_common_surface *common, double *off, const body bodies[2],
                           size_t n_landmarks, double tolerance, const iccp_env *env)
{
    uint8_t *const keep = iccp_alloc_zero(&env->memory, common->n_vertices, sizeof *keep);
    if (keep == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < common->n_vertices; ++v)
        for (size_t k = 0; k < n_landmarks && common->origin[1][v] != ICCP_NO_EDGE; ++k)
            if (common->origin[0][v] == bodies[0].landmarks[k])
                keep[v] = 1;
    iccp_simplify_limits limits = {.keep = keep};
    const double most_off = tolerance > 0 ? tolerance : default_tolerance;
    for (int side = 0; side < 2; ++side) {
        const double diagonal = diagonal_of(&bodies[side]);
        limits.off[side] = most_off * diagonal;
        limits.edge[side] =
            iccp_max(longest_edge * diagonal, times_given * mean_edge(&bodies[side]));
    }
    const icc_status status = iccp_simplify_apart(
        common, off, (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
        (const double *const[]){bodies[0].x, bodies[1].x}, &limits, tolerance < 0, env);
    iccp_free(&env->memory, keep);
    *off *= most_off;
    return status;
}

static icc_status run(icc_match *match, body bodies[2], iccp_common_surface *common,
                      size_t n_landmarks, const double *landmarks, const icc_match_options *options,
                      const iccp_env *env, icc_error *err)
{
    const double tolerance = options->tolerance == 0 ? default_tolerance : options->tolerance;
    iccp_env parts[4];
    iccp_split(parts, 4, (const double[]){10, 2, 20, 1}, env);
    for (int k = 0; k < 4; ++k)
        parts[k].stage = "match";
    double off = 0;
    icc_status status = n_landmarks == 0
                            ? draw(bodies, &parts[0], err)
                            : draw_by_landmarks(bodies, n_landmarks, landmarks, &parts[0], err);
    if (status == ICC_OK)
        status = cut(common, bodies, &parts[1], err);
    if (status != ICC_OK)
        return status;
    match->info.n_overlay = common->n_vertices;
    status = iccp_explain(err, simplify(common, &off, bodies, n_landmarks, tolerance, &parts[2]));
    if (status != ICC_OK)
        return status;
    fill_in(&match->info, common, off);
    match->info.n_landmarks = n_landmarks;
    match->n = common->n_vertices;
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        status = make_domain(&match->domain[side], common, side, &bodies[side], &parts[3], err);
        match->origin[side] = common->origin[side];
        common->origin[side] = NULL;
    }
    return status;
}

icc_status iccp_match_surfaces(icc_match *match, const icc_domain *source, const icc_domain *target,
                               size_t n_landmarks, const double *landmarks,
                               const icc_match_options *options, const iccp_env *env,
                               icc_error *err)
{
    if (n_landmarks > ICCP_MOST_SURFACE_LANDMARKS)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu landmarks in space are too many; at most %d",
                         n_landmarks, ICCP_MOST_SURFACE_LANDMARKS);
    body bodies[2] = {{0}, {0}};
    iccp_common_surface common = {0};
    icc_status status = make_body(&bodies[0], source, env, err);
    if (status == ICC_OK)
        status = make_body(&bodies[1], target, env, err);
    if (status == ICC_OK)
        status = run(match, bodies, &common, n_landmarks, landmarks, options, env, err);
    iccp_common_surface_free(&common, &env->memory);
    for (int side = 0; side < 2; ++side)
        free_body(&bodies[side], &env->memory);
    return status;
}
