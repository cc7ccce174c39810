/* docs/theory.md, the mesh map; the untangling itself is in map/energy/untangle.c. */
#include "map/compatible/repair.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "map/compatible/candidate.h"
#include "map/compatible/redraw.h"
#include "map/energy/untangle.h"
#include "math/predicates.h"

/* Rounds of refinement. */
enum { ROUNDS = 4 };

/* Where more than A_FEW and one triangle in MANY are inverted still after a first untangling,
 * larger patches have never helped on random pairs of shapes: another start is called for. And
 * refinement helps where A_FEW and one in FEW are stuck, at most. */
enum { A_FEW = 10, MANY = 20, FEW = 50 };

/* Where a few rounds multiply the triangles by more than this, refinement is not what is
 * missing. */
enum { MOST_GROWTH = 2 };

/* Triangles whose signs a thread finds at once. */
enum { GRAIN = 1024 };

/* A flipped edge must not make triangles that are flatter than this, as points along one side of
 * the polygon would: their energy would never come down. */
static const double LEAST_ROUNDNESS = 1e-4;

/* ---- flipping edges ---- */

static int sign_of(const double *a, const double *b, const double *c)
{
    return iccp_orient2d(a, b, c) > 0;
}

/* Flipping the edge makes triangles x a y and y b x from x a b and y b a: allowed when neither is
 * flat before the map, wanted when more of them are positive after it. An edge between two fixed
 * vertices must make both positive at once: nothing could repair it later. */
static bool is_worth_flipping(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t twin = map->corners.twin[corner];
    if (twin == ICCP_NO_NEIGHBOUR || iccp_plmap_is_line(map, corner))
        return false;
    const uint32_t after = iccp_after(corner), before = iccp_before(corner);
    if (iccp_roundness(iccp_plmap_point(map, corner), iccp_plmap_point(map, after),
                       iccp_plmap_point(map, twin)) < LEAST_ROUNDNESS ||
        iccp_roundness(iccp_plmap_point(map, twin), iccp_plmap_point(map, before),
                       iccp_plmap_point(map, corner)) < LEAST_ROUNDNESS)
        return false;
    const double *x = iccp_plmap_image(map, corner), *y = iccp_plmap_image(map, twin);
    const double *a = iccp_plmap_image(map, after), *b = iccp_plmap_image(map, before);
    const int flipped = sign_of(x, a, y) + sign_of(y, b, x);
    if (flipped < 2 && map->fixed[map->corners.vertex[corner]] &&
        map->fixed[map->corners.vertex[twin]])
        return false;
    return flipped > sign_of(x, a, b) + sign_of(y, b, a);
}

typedef struct signs {
    const iccp_plmap *map;
    uint8_t *is_bad; /* of each triangle: its image is not positive */
} signs;

static icc_status find_signs(void *argument, size_t begin, size_t end)
{
    const signs *s = argument;
    for (uint32_t t = (uint32_t)begin; t < end; ++t)
        s->is_bad[t] = !iccp_plmap_positive_image(s->map, t);
    return ICC_OK;
}

/* Each flip raises the number of positive images, so this ends. */
static void flip_bad(iccp_plmap *map, uint8_t *is_bad)
{
    bool flipped = true;
    while (flipped) {
        flipped = false;
        for (uint32_t t = 0; t < map->corners.n_triangles; ++t)
            for (uint32_t c = 3 * t; c < 3 * t + 3 && is_bad[t]; ++c)
                if (is_worth_flipping(map, c)) {
                    const uint32_t other = map->corners.twin[c] / 3;
                    iccp_flip_edge(&map->corners, c);
                    is_bad[t] = !iccp_plmap_positive_image(map, t);
                    is_bad[other] = !iccp_plmap_positive_image(map, other);
                    flipped = true;
                }
    }
}

static icc_status flip_edges(iccp_plmap *map, const iccp_env *env)
{
    const size_t n = map->corners.n_triangles;
    iccp_env quiet = *env;
    signs s = {map, iccp_alloc(&env->memory, n, sizeof *s.is_bad)};
    if (s.is_bad == NULL)
        return ICC_ERR_MEMORY;
    quiet.progress = NULL;
    const icc_status status = iccp_for_chunks(&quiet, "repair", n, GRAIN, find_signs, &s);
    if (status == ICC_OK)
        flip_bad(map, s.is_bad);
    iccp_free(&env->memory, s.is_bad);
    return status;
}

/* ---- untangling and refining ---- */

/* Cuts, in `map`, the edges between the corners of triangles that are not positive in `tangled`.
 * Flipped edges make the two differ, but they have the same vertices. */
static icc_status refine_round(iccp_plmap *map, const iccp_plmap *tangled, const iccp_env *env)
{
    const size_t n = map->corners.n_triangles, n_vertices = map->n_vertices;
    uint8_t *marked = iccp_alloc(&env->memory, n_vertices, 1);
    icc_status status = marked != NULL ? ICC_OK : ICC_ERR_MEMORY;
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(tangled);
    if (status == ICC_OK)
        iccp_untangle_mark(&simplicial, 1, marked);
    for (uint32_t c = 0; status == ICC_OK && c < 3 * n; ++c) {
        const uint32_t a = map->corners.vertex[iccp_after(c)];
        const uint32_t b = map->corners.vertex[iccp_before(c)];
        bool done;
        if (a < n_vertices && b < n_vertices && marked[a] && marked[b])
            status = iccp_plmap_cut(map, c, &done);
    }
    iccp_free(&env->memory, marked);
    return status;
}

/* Round k of iccp_untangle(), then flipped edges. */
static icc_status untangle_round(iccp_plmap *map, size_t k, const iccp_trial *trial,
                                 iccp_work *work, size_t *n_left, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    const iccp_env part = iccp_round(env, k, 1);
    uint8_t *marks = iccp_alloc(&env->memory, map->n_vertices, 1);
    icc_status status = marks != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_untangle_patches(&simplicial, k, marks, trial, work, &part);
    if (status == ICC_OK)
        status = flip_edges(map, env);
    if (status == ICC_OK)
        *n_left = iccp_simplicial_count_at_once(&simplicial, env);
    iccp_free(&env->memory, marks);
    return status;
}

/* Draws a copy anew where something is left: the map becomes the copy if that is enough. */
static icc_status mend(iccp_plmap *map, iccp_work *work, size_t *n_left, const iccp_env *env)
{
    iccp_plmap other;
    size_t n;
    icc_status status = iccp_plmap_copy(&other, map, &env->memory);
    if (status == ICC_OK)
        status = iccp_redraw(&other, work, &n, env);
    if (status == ICC_OK && n == 0) {
        const iccp_plmap tangled = *map;
        *map = other;
        other = tangled;
        *n_left = 0;
    }
    iccp_plmap_free(&other);
    return status;
}

/* As iccp_untangle(), with flipped edges in between. Before everything is untangled at once for the
 * sake of a few triangles, they are mended. */
static icc_status untangle_patches(iccp_plmap *map, double trial_work, iccp_work *work,
                                   size_t *n_left, const iccp_env *env)
{
    icc_status status = flip_edges(map, env);
    const iccp_trial trial = {A_FEW + map->corners.n_triangles / MANY, trial_work};
    *n_left = iccp_plmap_count_inverted(map);
    for (size_t k = 0; status == ICC_OK && *n_left > 0 && k < ICCP_PLANE_ROUNDS; ++k) {
        if (k > 1 && *n_left <= A_FEW)
            status = mend(map, work, n_left, env);
        if (status == ICC_OK && *n_left > 0)
            status = untangle_round(map, k, k == 0 ? &trial : NULL, work, n_left, env);
        if (*n_left > trial.most)
            break;
    }
    return status;
}

icc_status iccp_repair(iccp_plmap *map, double trial_work, iccp_work *work, size_t *n_left,
                       const iccp_env *env)
{
    iccp_plmap start;
    const size_t most = MOST_GROWTH * map->corners.n_triangles;
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    *n_left = iccp_simplicial_count_at_once(&simplicial, env);
    if (*n_left == 0)
        return iccp_cut_chords(map);
    icc_status status = iccp_plmap_copy(&start, map, &env->memory);
    if (status != ICC_OK)
        return status;
    const iccp_env first = iccp_round(env, 0, 1);
    status = untangle_patches(map, trial_work, work, n_left, &first);
    for (int round = 0;
         status == ICC_OK && *n_left > 0 && round < ROUNDS &&
         *n_left <= A_FEW + map->corners.n_triangles / FEW && start.corners.n_triangles <= most;
         ++round) {
        status = refine_round(&start, map, env);
        if (status == ICC_OK) {
            iccp_plmap_free(map);
            status = iccp_plmap_copy(map, &start, &env->memory);
        }
        const iccp_env part = iccp_round(env, (size_t)round + 1, 1);
        if (status == ICC_OK)
            status = untangle_patches(map, trial_work, work, n_left, &part);
    }
    iccp_plmap_free(&start);
    /* Flipped edges may join two fixed vertices. */
    return status == ICC_OK && *n_left == 0 ? iccp_cut_chords(map) : status;
}
