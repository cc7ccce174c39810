/* V. Garanzha et al., Foldover-free maps in 50 lines of code, 2021; the rest: docs/theory.md, the mesh
 * map. */
#include "map/repair.h"

#include "math/predicates.h"

#include <math.h>
#include <string.h>

/* Rings of neighbours round the inverted triangles that are free to move, in turn; 0 means all. */
static const int RINGS[] = {2, 5, 12, 0};

/* Steps of one untangling, steps without fewer inverted triangles after which it is given up, and rounds
 * of refinement. */
enum { STEPS = 60, PATIENCE = 15, ROUNDS = 4 };

/* Half of them, as far as progress goes. */
static const double TYPICAL_STEPS = 10;

/* Where more than A_FEW and one triangle in MANY are inverted still after a first untangling, larger
 * patches have never helped on random pairs of shapes: another start is called for. And refinement
 * helps where A_FEW and one in FEW are stuck, at most. */
enum { A_FEW = 10, MANY = 20, FEW = 50 };

/* Where a few rounds multiply the triangles by more than this, refinement is not what is missing. */
enum { MOST_GROWTH = 2 };

/* Epsilon's lower bound falls by at least this share a step. Newton's method needs few steps for each
 * epsilon; Garanzha et al. take 0.1 with a slower one. */
static const double SLOWEST = 0.3;

/* A turned edge must not make triangles that are flatter than this, as points along one side of the
 * polygon would: their energy would never come down. */
static const double LEAST_ROUNDNESS = 1e-4;

/* ---- turning edges ---- */

static double squared_length(const double *a, const double *b)
{
    return (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
}

/* Twice the area over the square of the longest edge: 0.87 for an equilateral triangle, 0 for a flat
 * one, negative for an inverted one. */
static double roundness(const double *a, const double *b, const double *c)
{
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return twice / fmax(squared_length(a, b), fmax(squared_length(b, c), squared_length(c, a)));
}

static int sign_of(const double *a, const double *b, const double *c)
{
    return iccp_orient2d(a, b, c) > 0;
}

/* Turning the edge makes triangles x a y and y b x from x a b and y b a: allowed when neither is flat
 * before the map, wanted when more of them are positive after it. An edge between two fixed vertices
 * must make both positive at once: nothing could repair it later. */
static bool is_worth_turning(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t twin = map->corners.twin[corner];
    if (twin == ICCP_NO_NEIGHBOUR)
        return false;
    const uint32_t after = iccp_after(corner), before = iccp_before(corner);
    if (roundness(iccp_plmap_point(map, corner), iccp_plmap_point(map, after),
                  iccp_plmap_point(map, twin)) < LEAST_ROUNDNESS ||
        roundness(iccp_plmap_point(map, twin), iccp_plmap_point(map, before),
                  iccp_plmap_point(map, corner)) < LEAST_ROUNDNESS)
        return false;
    const double *x = iccp_plmap_image(map, corner), *y = iccp_plmap_image(map, twin);
    const double *a = iccp_plmap_image(map, after), *b = iccp_plmap_image(map, before);
    const int turned = sign_of(x, a, y) + sign_of(y, b, x);
    if (turned < 2 && map->fixed[map->corners.vertex[corner]] &&
        map->fixed[map->corners.vertex[twin]])
        return false;
    return turned > sign_of(x, a, b) + sign_of(y, b, a);
}

/* Each turn raises the number of positive images, so this ends. */
static void turn_edges(iccp_plmap *map)
{
    bool turned = true;
    while (turned) {
        turned = false;
        for (uint32_t t = 0; t < map->corners.n_triangles; ++t)
            for (uint32_t c = 3 * t; c < 3 * t + 3 && !iccp_plmap_positive_image(map, t); ++c)
                if (is_worth_turning(map, c)) {
                    iccp_turn_edge(&map->corners, c);
                    turned = true;
                }
    }
}

/* ---- untangling ---- */

/* The smallest determinant, and how many are not positive. */
static double smallest_determinant(const iccp_newton *newton, const iccp_plmap *map, size_t *n_bad)
{
    double least = HUGE_VAL;
    *n_bad = 0;
    for (size_t e = 0; e < newton->n_elements; ++e) {
        const uint32_t c = 3 * newton->triangle[e];
        const double *const image[3] = {iccp_plmap_image(map, c), iccp_plmap_image(map, c + 1),
                                        iccp_plmap_image(map, c + 2)};
        double j[4];
        iccp_element_jacobian(&newton->element[e], image, j);
        const double det = j[0] * j[3] - j[1] * j[2];
        least = fmin(least, det);
        *n_bad += det <= 0;
    }
    return least;
}

static icc_status untangle(iccp_plmap *map, const uint8_t *movable, const iccp_env *env)
{
    iccp_newton newton;
    iccp_env part = iccp_round(env, 0, TYPICAL_STEPS);
    icc_status status = iccp_newton_create(&newton, map, movable, &part);
    if (status != ICC_OK)
        return status;
    size_t n_bad, fewest, since = 0;
    double least = smallest_determinant(&newton, map, &n_bad);
    fewest = n_bad;
    double epsilon = iccp_untangle_start(least);
    for (int k = 0; status == ICC_OK && k < STEPS && since < PATIENCE && newton.n_free > 0; ++k) {
        double slope;
        const double before = iccp_newton_energy(&newton, map, ICCP_UNTANGLE, epsilon);
        part = iccp_round(env, (size_t)k + 1, TYPICAL_STEPS);
        status = iccp_progress(&part, "repair", 0);
        if (status == ICC_OK)
            status = iccp_newton_solve(&newton, map, ICCP_UNTANGLE, epsilon, &slope, &part);
        if (status != ICC_OK)
            break;
        const double after =
            iccp_newton_move(&newton, map, ICCP_UNTANGLE, epsilon, before, slope);
        least = smallest_determinant(&newton, map, &n_bad);
        since = n_bad < fewest ? 0 : since + 1;
        fewest = n_bad < fewest ? n_bad : fewest;
        if (least > 0 && after >= 0.99 * before)
            break;
        /* Garanzha et al.: the faster the energy fell, the faster epsilon goes to zero. */
        epsilon = iccp_untangle_next(epsilon, least, fmax(1 - after / before, SLOWEST));
    }
    iccp_newton_free(&newton);
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

/* Marks the corners of inverted triangles and `rings` rings of neighbours. */
static void mark_patch(const iccp_plmap *map, int rings, uint8_t *movable)
{
    const size_t n_triangles = map->corners.n_triangles;
    memset(movable, 0, map->n_vertices);
    for (uint32_t t = 0; t < n_triangles; ++t)
        if (!iccp_plmap_positive_image(map, t))
            for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
                movable[map->corners.vertex[c]] = 1;
    for (int ring = 1; ring < rings; ++ring) {
        const uint8_t old = (uint8_t)ring, fresh = (uint8_t)(ring + 1);
        for (uint32_t t = 0; t < n_triangles; ++t) {
            bool touches = false;
            for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
                touches |= movable[map->corners.vertex[c]] == old;
            for (uint32_t c = 3 * t; touches && c < 3 * t + 3; ++c)
                if (movable[map->corners.vertex[c]] == 0)
                    movable[map->corners.vertex[c]] = fresh;
        }
    }
}

static icc_status untangle_patches(iccp_plmap *map, bool keep_mesh, size_t *n_left,
                                   const iccp_env *env)
{
    uint8_t *movable = iccp_alloc(&env->memory, map->n_vertices, 1);
    icc_status status = movable != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (!keep_mesh)
        turn_edges(map);
    *n_left = iccp_plmap_count_inverted(map);
    for (size_t k = 0; status == ICC_OK && *n_left > 0 && k < sizeof RINGS / sizeof *RINGS; ++k) {
        if (RINGS[k] > 0)
            mark_patch(map, RINGS[k], movable);
        const iccp_env part = iccp_round(env, (size_t)k, 1);
        status = untangle(map, RINGS[k] > 0 ? movable : NULL, &part);
        if (status == ICC_OK) {
            if (!keep_mesh)
                turn_edges(map);
            *n_left = iccp_plmap_count_inverted(map);
            if (!keep_mesh && *n_left > A_FEW + map->corners.n_triangles / MANY)
                break;
        }
    }
    iccp_free(&env->memory, movable);
    return status;
}

/* Cuts, in `map`, the edges between the corners of triangles that are not positive in `tangled`. Turned
 * edges make the two differ, but they have the same vertices. */
static icc_status refine_round(iccp_plmap *map, const iccp_plmap *tangled, const iccp_env *env)
{
    const size_t n = map->corners.n_triangles, n_vertices = map->n_vertices;
    uint8_t *marked = iccp_alloc(&env->memory, n_vertices, 1);
    icc_status status = marked != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        mark_patch(tangled, 1, marked);
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

/* Turned edges may join two fixed vertices; a vertex in their middle gives them something to move. */
static icc_status cut_chords(iccp_plmap *map)
{
    icc_status status = ICC_OK;
    for (uint32_t c = 0; status == ICC_OK && c < 3 * map->corners.n_triangles; ++c) {
        bool done;
        if (map->corners.twin[c] != ICCP_NO_NEIGHBOUR &&
            map->fixed[map->corners.vertex[iccp_after(c)]] &&
            map->fixed[map->corners.vertex[iccp_before(c)]])
            status = iccp_plmap_cut(map, c, &done);
    }
    return status;
}

icc_status iccp_repair(iccp_plmap *map, bool keep_mesh, size_t *n_left, const iccp_env *env)
{
    if (keep_mesh)
        return untangle_patches(map, true, n_left, env);
    iccp_plmap start;
    const size_t most = MOST_GROWTH * map->corners.n_triangles;
    icc_status status = iccp_plmap_copy(&start, map, &env->memory);
    if (status != ICC_OK)
        return status;
    const iccp_env first = iccp_round(env, 0, 1);
    status = untangle_patches(map, false, n_left, &first);
    for (int round = 0; status == ICC_OK && *n_left > 0 && round < ROUNDS &&
                        *n_left <= A_FEW + map->corners.n_triangles / FEW &&
                        start.corners.n_triangles <= most;
         ++round) {
        status = refine_round(&start, map, env);
        if (status == ICC_OK) {
            iccp_plmap_free(map);
            status = iccp_plmap_copy(map, &start, &env->memory);
        }
        const iccp_env part = iccp_round(env, (size_t)round + 1, 1);
        if (status == ICC_OK)
            status = untangle_patches(map, false, n_left, &part);
    }
    iccp_plmap_free(&start);
    return status == ICC_OK && *n_left == 0 ? cut_chords(map) : status;
}
