/* Finds pairs of vertices that probably correspond, to use beside few landmarks. */
#include "match/sphere/landmark_guesses.h"

#include "base/error.h"
#include "base/minmax.h"
#include "match/sphere/rotation.h"
#include "match/sphere/sphere.h"
#include "math/vec.h"

static bool is_taken(const uint32_t *vertices, size_t n, uint32_t v)
{
    bool any = false;
    for (size_t k = 0; k < n; ++k)
        any = any || vertices[k] == v;
    return any;
}

/* The squared distance from a direction to the nearest of the given vertices. */
static double room_round(const double *directions, const uint32_t *vertices, size_t n, uint32_t v)
{
    double least = HUGE_VAL;
    for (size_t k = 0; k < n; ++k)
        least = iccp_min(least, iccp_vec_distance2(3, directions + 3 * (size_t)v,
                                                   directions + 3 * (size_t)vertices[k]));
    return least;
}

/* Adds the vertex that is farthest from all pairs, together with the vertex of the other surface
 * that is drawn nearest to it. */
static void add_pair(uint32_t *const vertices[2], size_t n, const iccp_half_edges *const m[2],
                     double *const directions[2])
{
    double most = -1, least = HUGE_VAL;
    for (uint32_t v = 0; v < m[0]->n_vertices; ++v) {
        const double room = m[0]->degree[v] == 0 || is_taken(vertices[0], n, v)
                                ? -1
                                : room_round(directions[0], vertices[0], n, v);
        if (room > most) {
            most = room;
            vertices[0][n] = v;
        }
    }
    const double *const p = directions[0] + 3 * (size_t)vertices[0][n];
    for (uint32_t v = 0; v < m[1]->n_vertices; ++v) {
        const double away = m[1]->degree[v] == 0 || is_taken(vertices[1], n, v)
                                ? HUGE_VAL
                                : iccp_vec_distance2(3, p, directions[1] + 3 * (size_t)v);
        if (away < least) {
            least = away;
            vertices[1][n] = v;
        }
    }
}

icc_status iccp_landmark_guesses_find(uint32_t *const vertices[2], size_t n, size_t n_all,
                                      const iccp_half_edges *const m[2], const double *const x[2],
                                      const iccp_env *env, icc_error *err)
{
    double *directions[2] = {NULL, NULL};
    iccp_env parts[3];
    icc_status status = ICC_OK;
    iccp_split(parts, 3, (const double[]){2, 2, 1}, env);
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        directions[side] =
            iccp_alloc(&env->memory, m[side]->n_vertices, 3 * sizeof *directions[side]);
        status = directions[side] == NULL
                     ? iccp_fail_memory(err)
                     : iccp_sphere_draw(directions[side], m[side]->n_vertices, x[side],
                                        m[side]->n_faces, m[side]->origin, &parts[side], err);
        if (status != ICC_OK && directions[side] != NULL)
            status = iccp_fail_side(err, status, side + 1);
    }
    if (status == ICC_OK)
        status = iccp_explain(
            err,
            iccp_rotation_find(directions[0], directions[1], m, x, n,
                               (const uint32_t *const[]){vertices[0], vertices[1]}, &parts[2]));
    for (size_t k = n; k < n_all && status == ICC_OK; ++k)
        add_pair(vertices, k, m, directions);
    iccp_free(&env->memory, directions[0]);
    iccp_free(&env->memory, directions[1]);
    return status;
}
