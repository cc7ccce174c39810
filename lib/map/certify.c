/* A piecewise linear map of a mesh is one-to-one when every triangle keeps its orientation and the
 * boundary's image is a simple polygon (the degree of the map is then 1 inside it and 0 outside). */
#include "map/certify.h"

#include "base/error.h"
#include "domain/frame.h"
#include "map/apply.h"
#include "map/outline.h"
#include "map/repair.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

typedef struct mesh_check {
    size_t n_vertices, n_triangles;
    const uint32_t *triangles;
    double *before, *after;   /* local copies of the vertices and of their images */
    icc_certificate *result;
} mesh_check;

static int orientation(const double *points, const uint32_t *v)
{
    return iccp_orient2d(points + 2 * (size_t)v[0], points + 2 * (size_t)v[1],
                         points + 2 * (size_t)v[2]);
}

/* Copies points into coordinates for exact signs. Those that are not finite become 0; their triangles
 * are not looked at. */
static icc_status localise(double *local, iccp_frame *frame, size_t n, const double *points,
                           icc_error *err)
{
    for (size_t k = 0; k < 2 * n; ++k)
        local[k] = isfinite(points[2 * (k / 2)]) && isfinite(points[2 * (k / 2) + 1]) ? points[k] : 0;
    iccp_frame_fit(frame, 2, n, local);
    for (size_t v = 0; v < n; ++v) {
        if (!iccp_frame_holds(frame, 2, local + 2 * v))
            return iccp_fail(err, ICC_ERR_ARGUMENT, (int64_t)v,
                             "vertex %zu has a coordinate too small for exact signs", v);
        iccp_frame_in(frame, 2, local + 2 * v, local + 2 * v);
    }
    return ICC_OK;
}

static bool has_image(const double *image)
{
    return isfinite(image[0]) && isfinite(image[1]);
}

static void check_triangles(const mesh_check *m, const double *images)
{
    icc_certificate *c = m->result;
    c->n_no_image = c->n_flat = c->n_inverted = 0;
    for (size_t v = 0; v < m->n_vertices; ++v)
        c->n_no_image += !has_image(images + 2 * v);
    c->first = -1;
    for (size_t t = 0; t < m->n_triangles; ++t) {
        const uint32_t *v = m->triangles + 3 * t;
        bool fault = false;
        for (int k = 0; k < 3; ++k)
            fault |= !has_image(images + 2 * (size_t)v[k]);
        if (!fault) {
            const int before = orientation(m->before, v), after = orientation(m->after, v);
            c->n_flat += before == 0 || after == 0;
            c->n_inverted += before * after < 0;
            fault = before * after <= 0;
        }
        if (fault && c->first < 0)
            c->first = (int64_t)t;
    }
}

/* Turns every triangle counter-clockwise before the map and finds who is beside whom. */
static icc_status build_corners(const mesh_check *m, iccp_corners *corners, bool *is_manifold,
                                const iccp_env *env)
{
    *corners = (iccp_corners){.n_triangles = m->n_triangles};
    corners->vertex = iccp_alloc(&env->memory, m->n_triangles, 3 * sizeof *corners->vertex);
    corners->twin = iccp_alloc(&env->memory, m->n_triangles, 3 * sizeof *corners->twin);
    if (corners->vertex == NULL || corners->twin == NULL)
        return ICC_ERR_MEMORY;
    memcpy(corners->vertex, m->triangles, 3 * m->n_triangles * sizeof *corners->vertex);
    for (uint32_t *v = corners->vertex; v < corners->vertex + 3 * m->n_triangles; v += 3)
        if (orientation(m->before, v) < 0) {
            const uint32_t swap = v[1];
            v[1] = v[2];
            v[2] = swap;
        }
    return iccp_find_twins(corners, is_manifold, env);
}

static void free_corners(iccp_corners *corners, const iccp_memory *memory)
{
    iccp_free(memory, corners->vertex);
    iccp_free(memory, corners->twin);
}

/* Whether every vertex of the boundary has an image. */
static bool boundary_has_images(const iccp_corners *corners, const double *images)
{
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c)
        if (corners->twin[c] == ICCP_NO_NEIGHBOUR &&
            !has_image(images + 2 * (size_t)corners->vertex[iccp_after(c)]))
            return false;
    return true;
}

static double area_of(const mesh_check *m, const double *points)
{
    double sum = 0;
    for (size_t t = 0; t < m->n_triangles; ++t) {
        const uint32_t *v = m->triangles + 3 * t;
        sum += fabs(iccp_area2d(points + 2 * (size_t)v[0], points + 2 * (size_t)v[1],
                                points + 2 * (size_t)v[2]));
    }
    return sum;
}

/* Moves the images of inner vertices until every triangle is positive, as far as that goes; the
 * triangles stay. */
static icc_status repair(const mesh_check *m, const iccp_corners *corners, const iccp_env *env)
{
    const double before = area_of(m, m->before), after = area_of(m, m->after);
    uint8_t *fixed = iccp_alloc_zero(&env->memory, m->n_vertices, 1);
    if (fixed == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t c = 0; c < 3 * m->n_triangles; ++c)
        if (corners->twin[c] == ICCP_NO_NEIGHBOUR)
            fixed[corners->vertex[iccp_after(c)]] = fixed[corners->vertex[iccp_before(c)]] = 1;
    iccp_plmap pl = {.memory = env->memory,
                     .corners = *corners,
                     .n_vertices = m->n_vertices,
                     .points = m->before,
                     .images = m->after,
                     .fixed = fixed,
                     .stretch = before > 0 && after > 0 ? sqrt(after / before) : 1};
    size_t n_left;
    const icc_status status = iccp_repair(&pl, true, &n_left, env);
    iccp_free(&env->memory, fixed);
    return status;
}

static bool has_flat(const mesh_check *m)
{
    for (size_t t = 0; t < m->n_triangles; ++t)
        if (orientation(m->before, m->triangles + 3 * t) == 0)
            return true;
    return false;
}

/* Repairs if asked to and possible, and judges. */
static icc_status judge(mesh_check *m, bool repaired, double *images, const iccp_frame *frame,
                        const iccp_env *env)
{
    iccp_corners corners;
    bool is_manifold = false;
    check_triangles(m, images);
    icc_status status = build_corners(m, &corners, &is_manifold, env);
    if (status == ICC_OK && repaired && is_manifold && m->result->first >= 0 &&
        m->result->n_no_image == 0 && !has_flat(m)) {
        status = repair(m, &corners, env);
        /* What is judged is what the caller gets, rounded. */
        for (size_t v = 0; status == ICC_OK && v < m->n_vertices; ++v) {
            iccp_frame_out(frame, 2, m->after + 2 * v, images + 2 * v);
            iccp_frame_in(frame, 2, images + 2 * v, m->after + 2 * v);
        }
        if (status == ICC_OK)
            check_triangles(m, images);
    }
    if (status == ICC_OK)
        status = is_manifold && boundary_has_images(&corners, images)
                     ? iccp_outline_check(&corners, m->n_vertices, m->before, m->after, env)
                     : ICC_ERR_BOUNDARY;
    m->result->boundary_simple = status == ICC_OK;
    m->result->certified = status == ICC_OK && m->result->first < 0;
    free_corners(&corners, &env->memory);
    return status == ICC_ERR_BOUNDARY ? ICC_OK : status;
}

icc_status iccp_map_certify(const icc_map *map, size_t n_vertices, const double *vertices,
                            size_t n_triangles, const uint32_t *triangles, bool repaired,
                            double *images, icc_certificate *certificate, const iccp_env *env,
                            icc_error *err)
{
    iccp_frame frame;
    mesh_check m = {n_vertices, n_triangles, triangles, NULL, NULL, certificate};
    m.before = iccp_alloc(&env->memory, n_vertices, 2 * sizeof(double));
    m.after = iccp_alloc(&env->memory, n_vertices, 2 * sizeof(double));
    icc_status status = m.before != NULL && m.after != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_map_apply(map, false, n_vertices, vertices, images, NULL, NULL, env);
    if (status == ICC_OK)
        status = localise(m.before, &frame, n_vertices, vertices, err);
    if (status == ICC_OK)
        status = localise(m.after, &frame, n_vertices, images, err);
    if (status == ICC_OK)
        status = judge(&m, repaired, images, &frame, env);
    iccp_free(&env->memory, m.before);
    iccp_free(&env->memory, m.after);
    return iccp_explain(err, status);
}
