/* Maps a solid with a coat onto a star-shaped region. The core goes onto a ball inside, and each
 * point's image keeps its direction from the apex. In each direction there is a point on the ball
 * and one farther out. A prism of the coat is positive if the cone over its face is: over
 * directions a, b, c its tetrahedra have volumes of det(a, b, c) times lengths. So flat faces and
 * dents of the target do not affect the inside. */
#include "map/solid/coat_map.h"

#include "base/minmax.h"
#include "map/solid/coat.h"
#include "map/solid/coat_mesh.h"
#include "map/solid/coat_raise.h"
#include "math/vec.h"

#include <string.h>

/* The ball's radius, as a share of the distance of the nearest vertex. */
static const double INSIDE = 0.8;

/* Final sweeps over all images. */
enum { LAST_SWEEPS = 10 };

/* Two meshes with images: the core's, and the one with the coat, in which points below vertices
 * come last. */
typedef struct dress {
    const iccp_coat *coat;
    const double *images; /* of the core, around the origin */
    const double *boundary, *apex;
    iccp_simplices *mesh;
    double *out;
} dress;

static icc_status alloc_whole(dress *d, const iccp_memory *memory)
{
    const iccp_simplices *core = d->coat->core;
    const size_t n = core->n_points + d->coat->n_below;
    const size_t n_tets = core->n_simplices + d->coat->n_tets;
    d->mesh = iccp_alloc_zero(memory, 1, sizeof *d->mesh);
    if (d->mesh == NULL)
        return ICC_ERR_MEMORY;
    *d->mesh = (iccp_simplices){.memory = *memory,
                                .dim = 3,
                                .n_points = n,
                                .n_boundary = core->n_boundary,
                                .n_simplices = n_tets};
    d->mesh->points = iccp_alloc(memory, n, 3 * sizeof *d->mesh->points);
    d->mesh->corners = iccp_alloc(memory, n_tets, 4 * sizeof *d->mesh->corners);
    d->out = iccp_alloc(memory, n, 3 * sizeof *d->out);
    return d->mesh->points != NULL && d->mesh->corners != NULL && d->out != NULL ? ICC_OK
                                                                                 : ICC_ERR_MEMORY;
}

static void join_corners(const dress *d)
{
    const iccp_coat *coat = d->coat;
    const iccp_simplices *core = coat->core;
    const size_t n = core->n_boundary, n_core = 4 * core->n_simplices;
    for (size_t i = 0; i < n_core; ++i) {
        const uint32_t v = core->corners[i];
        const bool is_below = v < n && coat->below[v] != ICCP_NOTHING_BELOW;
        d->mesh->corners[i] = is_below ? (uint32_t)core->n_points + coat->below[v] : v;
    }
    for (size_t i = 0; i < 4 * coat->n_tets; ++i) {
        const uint32_t v = coat->corners[i];
        d->mesh->corners[n_core + i] = v < n ? v : (uint32_t)(v - n + core->n_points);
    }
}

/* The ball's radius, in terms of the radius of the images. */
static double find_scale(const dress *d)
{
    double least = HUGE_VAL, most = 0;
    for (size_t v = 0; v < d->mesh->n_boundary; ++v) {
        least = iccp_min(least, iccp_vec_distance(3, d->boundary + 3 * v, d->apex));
        most = iccp_max(most, iccp_vec_norm(3, d->images + 3 * v));
    }
    return INSIDE * least / most;
}

/* Vertices without a point below stay on the ball for now. */
static void place_points(const dress *d, const double *vertices)
{
    const iccp_coat *coat = d->coat;
    const iccp_simplices *core = coat->core;
    const size_t n = core->n_boundary;
    const double scale = find_scale(d);
    memcpy(d->mesh->points, core->points, 3 * core->n_points * sizeof *core->points);
    memcpy(d->mesh->points, vertices, 3 * n * sizeof *vertices);
    for (size_t v = 0; v < core->n_points; ++v) {
        const bool is_below = v < n && coat->below[v] != ICCP_NOTHING_BELOW;
        const size_t at = is_below ? core->n_points + coat->below[v] : v;
        memcpy(d->mesh->points + 3 * at,
               v < n && !is_below ? vertices + 3 * v : core->points + 3 * v, 3 * sizeof *vertices);
        for (size_t k = 0; k < 3; ++k)
            d->out[3 * at + k] = d->apex[k] + scale * d->images[3 * v + k];
        if (is_below)
            memcpy(d->out + 3 * v, d->boundary + 3 * v, 3 * sizeof *d->out);
    }
}

/* Raises the vertices without a point below, then moves all images to where there is room. */
static icc_status finish(dress *d, bool *done, const iccp_env *env)
{
    iccp_coat_mesh mesh;
    size_t n_raised = 0;
    iccp_simplices *const whole = d->mesh;
    icc_status status = iccp_simplices_join(whole, 0, NULL, NULL);
    if (status != ICC_OK)
        return status;
    status = iccp_coat_mesh_create(&mesh, whole, d->out, &env->memory);
    *done = true;
    for (uint32_t v = 0; status == ICC_OK && *done && v < whole->n_boundary; ++v)
        if (d->coat->below[v] == ICCP_NOTHING_BELOW) {
            status = iccp_progress(env, "repair", 0.5 * v / (double)whole->n_boundary);
            *done = status == ICC_OK &&
                    iccp_coat_raise(&mesh, d->coat->below, v, d->apex, d->boundary + 3 * (size_t)v);
            n_raised += *done;
        }
    if (status == ICC_OK)
        iccp_log(env, "a coat: %zu of %zu vertices are lifted, %zu raised", d->coat->n_below,
                 whole->n_boundary, n_raised);
    for (int k = 0; k < LAST_SWEEPS && status == ICC_OK && *done; ++k) {
        status = iccp_progress(env, "repair", 0.5 + 0.5 * k / LAST_SWEEPS);
        if (status == ICC_OK)
            iccp_coat_smooth(&mesh);
    }
    if (mesh.tets.no_memory)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK && *done) {
        iccp_simplices_free(whole);
        iccp_free(&env->memory, d->out);
        d->mesh = NULL;
        d->out = NULL;
        status = iccp_coat_mesh_give(&mesh, &d->mesh, &d->out);
    }
    iccp_coat_mesh_free(&mesh);
    return status;
}

icc_status iccp_coat_put_on(iccp_simplices **mesh, double **images, const double *boundary,
                            const double apex[3], bool *done, const iccp_env *env)
{
    iccp_coat coat;
    dress d = {&coat, *images, boundary, apex, NULL, NULL};
    *done = false;
    icc_status status = iccp_coat_create(&coat, *mesh, &env->memory);
    if (status == ICC_OK)
        status = alloc_whole(&d, &env->memory);
    if (status == ICC_OK) {
        join_corners(&d);
        place_points(&d, (*mesh)->points);
        status = finish(&d, done, env);
    }
    if (status == ICC_OK && *done) {
        iccp_simplices *const old = *mesh;
        double *const old_images = *images;
        *mesh = d.mesh;
        *images = d.out;
        d.mesh = old;
        d.out = old_images;
    }
    iccp_simplices_free(d.mesh);
    iccp_free(&env->memory, d.out);
    iccp_coat_free(&coat);
    return status;
}
