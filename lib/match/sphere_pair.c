/* Draws both surfaces on the sphere (match/sphere/sphere.h), turns one drawing to fit the other
 * (match/sphere/rotation.h), and moves each on the other (match/sphere/relax.h). With landmarks,
 * both are drawn from the same few triangles (match/sphere/landmark_sphere.h). Equal surfaces are
 * drawn in the same way (match/sphere/equal_surfaces.h). */
#include "match/sphere_pair.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "match/outline/landmarks.h"
#include "match/sphere/drawn_finder.h"
#include "match/sphere/equal_surfaces.h"
#include "match/sphere/landmark_guesses.h"
#include "match/sphere/landmark_paths.h"
#include "match/sphere/landmark_sphere.h"
#include "match/sphere/likely_pairs.h"
#include "match/sphere/relax.h"
#include "match/sphere/rotation.h"
#include "match/sphere/sphere.h"
#include "match/surface/direction.h"
#include "math/vec.h"

#include <string.h>

/* If there are fewer pairs, more are guessed, so that a limb without a landmark comes to lie on its
 * partner. */
enum { ENOUGH_PAIRS = 12 };

static icc_status make_body(iccp_body *b, const icc_domain *domain, const iccp_env *env,
                            icc_error *err)
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

/* ---- vertices that differ by rounding alone ---- */

/* As a share of the shortest edge at the vertex. Two drawings of equal surfaces, one of them
 * turned, differ by 1e-11. In other pairs (t01, t05, t06, t08) all vertices are at least 1e-4
 * apart. A sphere and a turned copy of it with one more vertex need this. */
static const double close_by = 1e-8;

static double shortest_edge(const iccp_half_edges *m, const double *directions, uint32_t v)
{
    double least2 = HUGE_VAL;
    uint32_t h = m->out[v];
    for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h))
        least2 = iccp_min(least2, iccp_vec_distance2(3, directions + 3 * (size_t)v,
                                                     directions + 3 * (size_t)iccp_edge_end(m, h)));
    return sqrt(least2);
}

static bool is_positive_round(const iccp_half_edges *m, const double *directions, uint32_t v)
{
    uint32_t h = m->out[v];
    for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h))
        if (iccp_direction_sign(directions + 3 * (size_t)v,
                                directions + 3 * (size_t)iccp_edge_end(m, h),
                                directions + 3 * (size_t)m->origin[iccp_before(h)]) <= 0)
            return false;
    return true;
}

/* Moves a vertex of the first drawing to a vertex of the second if they differ by rounding alone
 * and all faces stay positive, exactly. Between equal surfaces this removes slivers too thin to be
 * resolved. Both drawings are one-to-one, and all their vertices are present.
 *
 * A vertex this close is a corner of the face that contains the first one. */
static void join_close_vertices(const iccp_half_edges *const m[2], double *const directions[2])
{
    uint32_t face = 0;
    for (uint32_t v = 0; v < m[0]->n_vertices; ++v) {
        if (m[0]->degree[v] == 0)
            continue;
        double *const p = directions[0] + 3 * (size_t)v;
        const double most = close_by * shortest_edge(m[0], directions[0], v);
        face = iccp_drawn_walk(m[1], directions[1], face, p);
        for (int i = 0; i < 3; ++i) {
            const double *const q =
                directions[1] + 3 * (size_t)m[1]->origin[3 * (size_t)face + (size_t)i];
            const double before[3] = {p[0], p[1], p[2]};
            if (iccp_vec_distance2(3, p, q) > most * most)
                continue;
            memcpy(p, q, sizeof before);
            if (!is_positive_round(m[0], directions[0], v))
                memcpy(p, before, sizeof before);
        }
    }
}

/* ---- drawing ---- */

/* Moves each drawing on the other. */
static icc_status relax(iccp_body bodies[2], const iccp_env *env, icc_error *err)
{
    iccp_drawn_surface side[2];
    for (int s = 0; s < 2; ++s) {
        const iccp_body *const b = &bodies[s];
        side[s] = (iccp_drawn_surface){&b->m, b->x, b->directions, iccp_sphere_scale(&b->m, b->x)};
    }
    iccp_relaxation r;
    double left;
    icc_status status =
        iccp_relaxation_create(&r, side, (const uint8_t *const[]){NULL, NULL}, &env->memory);
    if (status == ICC_OK)
        status = iccp_relax(&r, ICCP_LONGER, true, &left, env);
    iccp_relaxation_free(&r, &env->memory);
    status = iccp_explain(err, status);
    if (status == ICC_OK)
        join_close_vertices((const iccp_half_edges *const[]){side[0].m, side[1].m},
                            (double *const[]){side[0].directions, side[1].directions});
    for (int s = 0; s < 2 && status == ICC_OK; ++s)
        status = iccp_sphere_check(&bodies[s].m, bodies[s].directions, err);
    return status;
}

/* Draws one of the two surfaces, whose directions are allocated. */
static icc_status draw_one(void *argument, size_t side, const iccp_env *env, icc_error *err)
{
    const iccp_body *const bodies = argument, *const b = &bodies[side];
    const icc_status status =
        iccp_sphere_draw(b->directions, b->m.n_vertices, b->x, b->m.n_faces, b->m.origin, env, err);
    return status == ICC_OK ? ICC_OK : iccp_fail_side(err, status, (int32_t)side + 1);
}

/* Draws both surfaces. Equal ones are drawn in the same way; `partner` has the vertex that
 * corresponds to each vertex of the first. Others are drawn side by side and then moved on each
 * other. */
static icc_status draw(iccp_body bodies[2], const uint32_t *partner, const iccp_env *env,
                       icc_error *err)
{
    for (int side = 0; side < 2; ++side) {
        iccp_body *const b = &bodies[side];
        b->directions = iccp_alloc_zero(&env->memory, b->m.n_vertices, 3 * sizeof *b->directions);
        if (b->directions == NULL)
            return iccp_fail_memory(err);
    }
    const iccp_env drawing = iccp_part(env, NULL, 0, 0.5), turning = iccp_part(env, NULL, 0.5, 0.7),
                   last = iccp_part(env, NULL, 0.7, 1);
    icc_status status = iccp_side_by_side(&drawing, partner == NULL ? 2 : 1, draw_one, bodies, err);
    if (status != ICC_OK)
        return status;
    for (size_t v = 0; partner != NULL && v < bodies[0].m.n_vertices; ++v)
        if (bodies[0].m.degree[v] > 0)
            memcpy(bodies[1].directions + 3 * (size_t)partner[v], bodies[0].directions + 3 * v,
                   3 * sizeof(double));
    if (partner != NULL)
        return ICC_OK;
    status = iccp_explain(
        err, iccp_rotation_find(bodies[0].directions, bodies[1].directions,
                                (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
                                (const double *const[]){bodies[0].x, bodies[1].x}, 0,
                                (const uint32_t *const[]){NULL, NULL}, &turning));
    return status == ICC_OK ? relax(bodies, &last, err) : status;
}

/* Finds the vertices nearest to the landmarks of one side. No two may be the same. */
static icc_status find_landmarks(iccp_body *b, size_t n, const double *given, int side,
                                 const iccp_memory *memory, icc_error *err)
{
    const icc_domain *const d = b->domain;
    const double most = iccp_farthest_landmark * iccp_vec_distance(3, d->lower, d->upper);
    b->landmarks = iccp_alloc(memory, n + ENOUGH_PAIRS, sizeof *b->landmarks);
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
                                  "landmark %zu is too far from the vertices", k);
        for (size_t i = 0; i < k && status == ICC_OK; ++i)
            if (b->landmarks[i] == b->landmarks[k])
                status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)k,
                                      "landmark %zu is at the same vertex as landmark %zu", k, i);
        if (status != ICC_OK)
            return iccp_fail_side(err, status, side + 1);
    }
    return ICC_OK;
}

/* Draws both surfaces with landmarks at the same directions. This may halve edges. If landmarks are
 * few, pairs that were guessed help to place the limbs. */
static icc_status draw_by_landmarks(iccp_body bodies[2], size_t n, const iccp_env *env,
                                    icc_error *err)
{
    size_t n_all = n < ICCP_LEAST_SURFACE_LANDMARKS ? ICCP_LEAST_SURFACE_LANDMARKS : n;
    iccp_env parts[3];
    iccp_split(parts, 3, (const double[]){n < n_all ? 1 : 0, n < ENOUGH_PAIRS ? 0.1 : 0, 2}, env);
    iccp_split_surface split[2] = {{.memory = env->memory}, {.memory = env->memory}};
    iccp_half_edges m[2] = {{.memory = env->memory}, {.memory = env->memory}};
    double *directions[2] = {NULL, NULL};
    icc_status status = ICC_OK;
    if (n < n_all)
        status = iccp_landmark_guesses_find(
            (uint32_t *const[]){bodies[0].landmarks, bodies[1].landmarks}, n, n_all,
            (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
            (const double *const[]){bodies[0].x, bodies[1].x}, &parts[0], err);
    if (status == ICC_OK && n_all < ENOUGH_PAIRS)
        status = iccp_explain(
            err, iccp_likely_pairs_find(
                     (uint32_t *const[]){bodies[0].landmarks, bodies[1].landmarks}, &n_all,
                     ENOUGH_PAIRS, (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
                     (const double *const[]){bodies[0].x, bodies[1].x},
                     (const double[]){iccp_sphere_scale(&bodies[0].m, bodies[0].x),
                                      iccp_sphere_scale(&bodies[1].m, bodies[1].x)},
                     &parts[1]));
    if (status == ICC_OK)
        status = iccp_landmark_sphere_draw(
            directions, m, split, (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
            (const double *const[]){bodies[0].x, bodies[1].x}, n_all, n,
            (const uint32_t *const[]){bodies[0].landmarks, bodies[1].landmarks}, &parts[2], err);
    for (int side = 0; side < 2; ++side) {
        iccp_body *const b = &bodies[side];
        iccp_half_edges_free(&b->m);
        b->m = m[side];
        b->split = split[side];
        b->x = split[side].x;
        b->directions = directions[side];
    }
    return status;
}

icc_status iccp_sphere_pair_create(iccp_body bodies[2], const icc_domain *source,
                                   const icc_domain *target, const iccp_env *env, icc_error *err)
{
    const icc_status status = make_body(&bodies[0], source, env, err);
    return status == ICC_OK ? make_body(&bodies[1], target, env, err) : status;
}

icc_status iccp_sphere_pair_draw(iccp_body bodies[2], size_t n_landmarks, const double *landmarks,
                                 const iccp_env *env, icc_error *err)
{
    bool is_equal = false;
    icc_status status = ICC_OK;
    for (int side = 0; side < 2 && status == ICC_OK; ++side)
        status = find_landmarks(&bodies[side], n_landmarks, landmarks, side, &env->memory, err);
    if (status != ICC_OK)
        return status;
    uint32_t *const partner = iccp_alloc(&env->memory, bodies[0].m.n_vertices, sizeof *partner);
    status =
        partner == NULL
            ? ICC_ERR_MEMORY
            : iccp_equal_surfaces_find(
                  partner, &is_equal, (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
                  (const double *const[]){bodies[0].x, bodies[1].x}, n_landmarks,
                  (const uint32_t *const[]){bodies[0].landmarks, bodies[1].landmarks},
                  &env->memory);
    status = iccp_explain(err, status);
    if (status == ICC_OK)
        status = is_equal || n_landmarks == 0 ? draw(bodies, is_equal ? partner : NULL, env, err)
                                              : draw_by_landmarks(bodies, n_landmarks, env, err);
    iccp_free(&env->memory, partner);
    return status;
}

void iccp_sphere_pair_free(iccp_body bodies[2], const iccp_memory *memory)
{
    for (int side = 0; side < 2; ++side) {
        iccp_half_edges_free(&bodies[side].m);
        iccp_split_surface_free(&bodies[side].split);
        iccp_free(memory, bodies[side].landmarks);
        iccp_free(memory, bodies[side].directions);
    }
}
