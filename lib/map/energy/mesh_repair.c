/* Repairs the image of a caller's mesh: gives every point an image, then untangles. */
#include "map/energy/mesh_repair.h"

#include "map/energy/untangle.h"
#include "math/elementary.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

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

/* Moves each point without an image to the mean of its neighbours' images, if there are any.
 * Returns true if points without an image are left. `sum` has dim + 1 numbers for each point. */
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

icc_status iccp_mesh_place(const iccp_simplices *mesh, double *images, const iccp_env *env)
{
    double *sum = iccp_alloc(&env->memory, mesh->n_points, (mesh->dim + 1) * sizeof *sum);
    icc_status status = sum != NULL ? ICC_OK : ICC_ERR_MEMORY;
    while (status == ICC_OK && place_ring(mesh, images, sum))
        status = iccp_progress(env, "repair", 0);
    iccp_free(&env->memory, sum);
    return status;
}

/* ---- repair ---- */

static double measure_of(const iccp_simplices *mesh, const double *points)
{
    const size_t dim = mesh->dim;
    double sum = 0, element[ICCP_MAX_ELEMENT];
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const uint32_t *v = mesh->corners + (dim + 1) * s;
        const double *corner[4];
        for (size_t k = 0; k <= dim; ++k)
            corner[k] = points + dim * v[k];
        iccp_element_create(dim, corner, element);
        sum += fabs(dim == 2 ? iccp_area2d(corner[0], corner[1], corner[2]) : element[0]);
    }
    return sum;
}

icc_status iccp_mesh_repair(const iccp_simplices *mesh, double *images, double most,
                            const iccp_env *env)
{
    size_t n_left;
    iccp_simplicial_map map = iccp_simplicial_map_of(mesh, images);
    const icc_status status = iccp_mesh_place(mesh, images, env);
    if (status != ICC_OK)
        return status;
    const double before = measure_of(mesh, mesh->points), after = measure_of(mesh, images);
    if (before > 0 && after > 0)
        map.stretch = mesh->dim == 2 ? sqrt(after / before) : iccp_cbrt(after / before);
    iccp_work work = {.left = most * (double)mesh->n_simplices};
    return iccp_untangle(&map, &work, &n_left, env);
}

void iccp_mesh_round(const iccp_simplices *mesh, double *images)
{
    const size_t n = mesh->dim * mesh->n_boundary;
    iccp_simplicial_round(mesh->dim * mesh->n_points - n, images + n);
}
