#include "map/mesh_repair.h"

#include "map/repair.h"
#include "map/tet_repair.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

/* In units of the local coordinates, the largest of which is about 1. */
static const double NEXT_TO_NOTHING = 1e-45;

/* ---- points without an image ---- */

static bool is_placed(const iccp_simplices *mesh, const double *images, uint32_t v)
{
    for (size_t k = 0; k < mesh->dim; ++k)
        if (!isfinite(images[mesh->dim * v + k]))
            return false;
    return true;
}

static void add_corner(const iccp_simplices *mesh, const double *images, uint32_t v, double *sum)
{
    for (size_t k = 0; k < mesh->dim; ++k)
        sum[k] += images[mesh->dim * v + k];
    sum[mesh->dim] += 1;
}

/* Puts the points that have neighbours with images to the mean of these; returns whether any is left. `sum`:
 * dim + 1 for each point. */
static bool place_ring(const iccp_simplices *mesh, double *images, double *sum)
{
    const size_t n = mesh->dim + 1;
    bool is_left = false;
    memset(sum, 0, n * mesh->n_points * sizeof *sum);
    for (size_t c = 0; c < n * mesh->n_simplices; ++c)
        for (size_t i = 1; i < n && !is_placed(mesh, images, mesh->corners[c]); ++i) {
            const uint32_t other = mesh->corners[c - c % n + (c + i) % n];
            if (is_placed(mesh, images, other))
                add_corner(mesh, images, other, sum + n * mesh->corners[c]);
        }
    for (uint32_t v = 0; v < mesh->n_points; ++v)
        for (size_t k = 0; k < mesh->dim && sum[n * v + mesh->dim] > 0; ++k)
            images[mesh->dim * v + k] = sum[n * v + k] / sum[n * v + mesh->dim];
    for (uint32_t v = 0; v < mesh->n_points && !is_left; ++v)
        is_left = !is_placed(mesh, images, v);
    return is_left;
}

/* Ring by ring from the boundary, where all points have images. */
static icc_status place(const iccp_simplices *mesh, double *images, const iccp_env *env)
{
    double *sum = iccp_alloc(&env->memory, mesh->n_points, (mesh->dim + 1) * sizeof *sum);
    icc_status status = sum != NULL ? ICC_OK : ICC_ERR_MEMORY;
    while (status == ICC_OK && place_ring(mesh, images, sum))
        status = iccp_progress(env, "repair", 0);
    iccp_free(&env->memory, sum);
    return status;
}

/* ---- repair ---- */

static double area_of(const iccp_simplices *mesh, const double *points)
{
    double sum = 0;
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        const uint32_t *v = mesh->corners + 3 * t;
        sum += fabs(iccp_area2d(points + 2 * (size_t)v[0], points + 2 * (size_t)v[1],
                                points + 2 * (size_t)v[2]));
    }
    return sum;
}

/* As a mesh map, all of whose triangles stay. */
static icc_status repair_triangles(const iccp_simplices *mesh, double *images, const iccp_env *env)
{
    const size_t n = 3 * mesh->n_simplices;
    const double before = area_of(mesh, mesh->points), after = area_of(mesh, images);
    uint8_t *fixed = iccp_alloc(&env->memory, mesh->n_points, 1);
    uint32_t *twin = iccp_alloc(&env->memory, n, sizeof *twin);
    icc_status status = fixed != NULL && twin != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (size_t v = 0; v < mesh->n_points; ++v)
            fixed[v] = v < mesh->n_rim;
        for (size_t c = 0; c < n; ++c)
            twin[c] = (mesh->across[c] & ICCP_RIM) != 0 ? ICCP_NO_NEIGHBOUR : mesh->across[c];
        iccp_plmap pl = {.memory = env->memory,
                         .corners = {mesh->corners, twin, mesh->n_simplices},
                         .n_vertices = mesh->n_points,
                         .points = mesh->points,
                         .images = images,
                         .fixed = fixed,
                         .stretch = before > 0 && after > 0 ? sqrt(after / before) : 1};
        size_t n_left;
        status = iccp_repair(&pl, true, &n_left, env);
    }
    iccp_free(&env->memory, twin);
    iccp_free(&env->memory, fixed);
    return status;
}

icc_status iccp_mesh_repair(const iccp_simplices *mesh, double *images, const iccp_env *env)
{
    size_t n_left;
    const icc_status status = place(mesh, images, env);
    if (status != ICC_OK)
        return status;
    return mesh->dim == 2 ? repair_triangles(mesh, images, env)
                          : iccp_tet_repair(mesh, images, &n_left, env);
}

void iccp_mesh_round(const iccp_simplices *mesh, double *images)
{
    for (size_t i = mesh->dim * mesh->n_rim; i < mesh->dim * mesh->n_points; ++i)
        if (fabs(images[i]) < NEXT_TO_NOTHING)
            images[i] = 0;
}
