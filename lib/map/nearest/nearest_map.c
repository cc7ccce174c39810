/* Makes the one-to-one map that is nearest to a caller's warp: reads the mesh into local
 * coordinates, repairs the images (nearest.h), and makes a map of the result (map/given_mesh.h).
 * Vertices that did not move keep their bits. */
#include "map/nearest/nearest_map.h"

#include "base/error.h"
#include "domain/outlines.h"
#include "geometry/frame.h"
#include "map/given_mesh.h"
#include "map/nearest/nearest.h"
#include "mesh/given_triangles.h"

#include <math.h>
#include <string.h>

typedef struct maker {
    const iccp_warp *warp;
    iccp_frame frame[2]; /* before and after the map */
    iccp_plmap map;
    double *model;           /* the given images in local coordinates */
    double *points, *images; /* of all vertices in the end, in the caller's coordinates */
    uint32_t *inner;         /* held vertices that are not on the boundary */
    size_t n_inner;
} maker;

/* ---- the mesh ---- */

static icc_status localise(maker *m, int side, icc_error *err)
{
    const size_t n = m->warp->n_vertices;
    const double *given = side == 0 ? m->warp->points : m->warp->images;
    double *local = side == 0 ? m->map.points : m->map.images;
    icc_status status = ICC_OK;
    size_t v = 0;
    while (v < n && iccp_all_finite(2, given + 2 * v))
        ++v;
    if (v < n)
        status =
            iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)v, "%s %zu is not finite",
                         side == 0 ? "vertex" : "the image of vertex", v);
    if (status == ICC_OK) {
        iccp_frame_fit(&m->frame[side], 2, n, given);
        if (!iccp_frame_in_all(&m->frame[side], n, given, local))
            status = iccp_fail(err, ICC_ERR_RESOLUTION,
                               "a coordinate is too small beside others for exact signs");
    }
    return status == ICC_OK ? status : iccp_fail_side(err, status, side + 1);
}

/* Links the triangles, and marks the vertices of the boundary and the held ones. Checks the
 * boundary before the map. */
static icc_status fix(maker *m, const iccp_env *env, icc_error *err)
{
    iccp_plmap *map = &m->map;
    const size_t n = map->n_vertices;
    uint32_t *next = iccp_alloc(&env->memory, n, sizeof *next);
    iccp_outlines outlines = {.memory = env->memory};
    icc_status status =
        next != NULL ? iccp_link_triangles(&map->corners, n, next, env, err) : ICC_ERR_MEMORY;
    for (uint32_t v = 0; status == ICC_OK && v < n; ++v) {
        map->fixed[v] = next[v] != UINT32_MAX ? ICCP_ALONG : ICCP_FREE;
        map->facet[v] = v;
        map->along[v] = 0;
    }
    for (size_t i = 0; status == ICC_OK && i < m->warp->n_held; ++i)
        if (map->fixed[m->warp->held[i]] == ICCP_FREE) {
            map->fixed[m->warp->held[i]] = ICCP_ON_POINT;
            m->inner[m->n_inner++] = m->warp->held[i];
        }
    if (status == ICC_OK)
        status = iccp_outlines_create(&outlines, n, next, &env->memory);
    if (status == ICC_OK)
        status = iccp_outlines_check(&outlines, map->points, env, err);
    iccp_outlines_free(&outlines);
    iccp_free(&env->memory, next);
    return status;
}

static icc_status read_mesh(maker *m, const iccp_env *env, icc_error *err)
{
    const iccp_warp *w = m->warp;
    icc_status status = localise(m, 0, err);
    if (status == ICC_OK)
        status = iccp_orient_triangles(m->map.corners.vertex, w->n_triangles, w->triangles,
                                       w->n_vertices, m->map.points, err);
    if (status == ICC_OK)
        status = iccp_check_used(w->n_vertices, w->n_triangles, w->triangles, env, err);
    if (status == ICC_OK)
        status = fix(m, env, err);
    return status == ICC_OK ? status : iccp_fail_side(err, status, 1);
}

/* ---- the images ---- */

/* The areas of the images add up to what the image of the boundary encloses. */
static icc_status check_mirror(const maker *m, icc_error *err)
{
    const uint32_t *v = m->map.corners.vertex;
    const double *q = m->map.images;
    double area = 0;
    for (size_t t = 0; t < m->map.corners.n_triangles; ++t, v += 3) {
        const double *a = q + 2 * (size_t)v[0], *b = q + 2 * (size_t)v[1],
                     *c = q + 2 * (size_t)v[2];
        area += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
    if (area >= 0)
        return ICC_OK;
    (void)iccp_fail(
        err, ICC_ERR_ARGUMENT,
        "the images are a mirror image: their boundary runs the other way round. Change "
        "the sign of one coordinate of all images");
    return iccp_fail_side(err, ICC_ERR_ARGUMENT, 2);
}

static bool is_at(const double *p, const double *q)
{
    return memcmp(p, q, 2 * sizeof *p) == 0;
}

/* Brings all vertices back to the caller's coordinates. */
static icc_status bring_out(maker *m, const iccp_env *env)
{
    const size_t n = m->map.n_vertices, n_given = m->warp->n_vertices;
    m->points = iccp_alloc(&env->memory, n, 2 * sizeof *m->points);
    m->images = iccp_alloc(&env->memory, n, 2 * sizeof *m->images);
    if (m->points == NULL || m->images == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < n; ++v) {
        const size_t i = 2 * v;
        iccp_frame_out(&m->frame[0], 2, m->map.points + i, m->points + i);
        iccp_frame_out(&m->frame[1], 2, m->map.images + i, m->images + i);
        if (v >= n_given)
            continue;
        memcpy(m->points + i, m->warp->points + i, 2 * sizeof *m->points);
        if (is_at(m->map.images + i, m->model + i))
            memcpy(m->images + i, m->warp->images + i, 2 * sizeof *m->images);
    }
    return ICC_OK;
}

static void fill_report(icc_nearest_report *report, const maker *m, const iccp_nearest_facts *facts)
{
    double sum = 0, most = 0;
    for (size_t v = 0; v < m->warp->n_vertices; ++v) {
        const double square = iccp_vec_distance2(2, m->map.images + 2 * v, m->model + 2 * v);
        sum += square;
        most = iccp_max(most, square);
    }
    const double *unit = m->frame[1].out;
    report->repair = facts->repair;
    report->n_folded = facts->n_folded;
    report->n_patches = facts->n_patches;
    report->changed = facts->changed;
    report->moved = sqrt(sum / (double)m->warp->n_vertices) * unit[0] * unit[1];
    report->most_moved = sqrt(most) * unit[0] * unit[1];
    report->n_iterations = facts->n_iterations;
}

static icc_status conclude(icc_map **out, maker *m, const iccp_env *env, icc_error *err)
{
    const icc_status status = bring_out(m, env);
    if (status != ICC_OK)
        return status;
    const iccp_given_mesh mesh = {.n_vertices = m->map.n_vertices,
                                  .points = m->points,
                                  .images = m->images,
                                  .n_triangles = m->map.corners.n_triangles,
                                  .triangles = m->map.corners.vertex,
                                  .n_held = m->n_inner,
                                  .held = m->inner};
    return iccp_map_of_mesh(out, &mesh, env, err);
}

static icc_status make(icc_map **out, maker *m, icc_nearest_report *report, const iccp_env *env,
                       icc_error *err)
{
    const iccp_warp *w = m->warp;
    iccp_nearest_facts facts;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){4, 1}, env);
    m->model = iccp_alloc(&env->memory, w->n_vertices, 2 * sizeof *m->model);
    m->inner = iccp_alloc(&env->memory, w->n_held, sizeof *m->inner);
    if (m->model == NULL || m->inner == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_plmap_begin(&m->map, w->n_vertices, w->n_triangles, 1, &env->memory);
    if (status == ICC_OK)
        status = read_mesh(m, env, err);
    if (status == ICC_OK)
        status = localise(m, 1, err);
    if (status == ICC_OK)
        status = check_mirror(m, err);
    if (status != ICC_OK)
        return status;
    memcpy(m->model, m->map.images, 2 * w->n_vertices * sizeof *m->model);
    status = iccp_nearest(&m->map, false, &facts, &part[0], err);
    if (status == ICC_ERR_BOUNDARY)
        return iccp_fail_side(err, status, 2);
    if (status == ICC_OK)
        status = conclude(out, m, &part[1], err);
    if (status == ICC_OK)
        fill_report(report, m, &facts);
    return status;
}

icc_status iccp_nearest_map_create(icc_map **out, const iccp_warp *warp, icc_nearest_report *report,
                                   const iccp_env *env, icc_error *err)
{
    maker m = {.warp = warp, .map.memory = env->memory};
    *out = NULL;
    const icc_status status = make(out, &m, report, env, err);
    iccp_plmap_free(&m.map);
    iccp_free(&env->memory, m.model);
    iccp_free(&env->memory, m.points);
    iccp_free(&env->memory, m.images);
    iccp_free(&env->memory, m.inner);
    return iccp_explain(err, status);
}
