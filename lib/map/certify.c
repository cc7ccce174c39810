/* A piecewise linear map of a mesh is one-to-one when every triangle keeps its orientation and the
 * boundary's image is a simple polygon (the degree of the map is then 1 inside it and 0 outside). */
#include "map/certify.h"

#include "base/error.h"
#include "domain/frame.h"
#include "map/apply.h"
#include "map/outline.h"
#include "math/predicates.h"

#include <math.h>
#include <stdlib.h>
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
static icc_status localise(double *local, size_t n, const double *points, icc_error *err)
{
    iccp_frame frame;
    for (size_t k = 0; k < 2 * n; ++k)
        local[k] = isfinite(points[2 * (k / 2)]) && isfinite(points[2 * (k / 2) + 1]) ? points[k] : 0;
    iccp_frame_fit(&frame, 2, n, local);
    for (size_t v = 0; v < n; ++v) {
        if (!iccp_frame_holds(&frame, 2, local + 2 * v))
            return iccp_fail(err, ICC_ERR_ARGUMENT, (int64_t)v,
                             "vertex %zu has a coordinate too small for exact signs", v);
        iccp_frame_in(&frame, 2, local + 2 * v, local + 2 * v);
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

typedef struct half_edge {
    uint32_t low, high, from, to;
} half_edge;

static int by_ends(const void *a, const void *b)
{
    const half_edge *p = a, *q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    return (p->high > q->high) - (p->high < q->high);
}

/* Half-edges with the triangle on their left before the map, sorted by their ends. */
static void list_edges(const mesh_check *m, half_edge *edges)
{
    for (size_t t = 0; t < m->n_triangles; ++t) {
        const uint32_t *v = m->triangles + 3 * t;
        const bool turned = orientation(m->before, v) < 0;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = v[k], b = v[(k + 1) % 3];
            edges[3 * t + k] = (half_edge){a < b ? a : b, a < b ? b : a, turned ? b : a,
                                           turned ? a : b};
        }
    }
    qsort(edges, 3 * m->n_triangles, sizeof *edges, by_ends);
}

/* Links the ends of edges that belong to one triangle. Returns how many there are, 0 when an edge
 * belongs to more than two triangles or a vertex to more than two such edges. */
static size_t link_boundary(const half_edge *edges, size_t n, uint32_t *next, uint32_t *first)
{
    size_t n_boundary = 0;
    for (size_t k = 0; k < n;) {
        size_t end = k + 1;
        while (end < n && by_ends(&edges[k], &edges[end]) == 0)
            ++end;
        if (end - k > 2)
            return 0;
        if (end - k == 1) {
            if (next[edges[k].from] != UINT32_MAX)
                return 0;
            next[edges[k].from] = edges[k].to;
            *first = edges[k].from;
            ++n_boundary;
        }
        k = end;
    }
    return n_boundary;
}

static icc_status check_boundary(const mesh_check *m, const iccp_env *env)
{
    const size_t n_edges = 3 * m->n_triangles;
    half_edge *edges = iccp_alloc(&env->memory, n_edges, sizeof *edges);
    uint32_t *next = iccp_alloc(&env->memory, m->n_vertices, sizeof *next);
    uint32_t *ring = iccp_alloc(&env->memory, m->n_vertices, sizeof *ring);
    icc_status status = edges != NULL && next != NULL && ring != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        uint32_t first = 0;
        memset(next, 0xff, m->n_vertices * sizeof *next);
        list_edges(m, edges);
        const size_t n = link_boundary(edges, n_edges, next, &first);
        status = ICC_ERR_BOUNDARY;
        if (n > 0 && iccp_outline_follow(next, first, n, ring))
            status = iccp_outline_check(m->before, ring, n, env);
        if (status == ICC_OK)
            status = iccp_outline_check(m->after, ring, n, env);
    }
    iccp_free(&env->memory, edges);
    iccp_free(&env->memory, next);
    iccp_free(&env->memory, ring);
    return status;
}

icc_status iccp_map_certify(const icc_map *map, size_t n_vertices, const double *vertices,
                            size_t n_triangles, const uint32_t *triangles, double *images,
                            icc_certificate *certificate, const iccp_env *env, icc_error *err)
{
    mesh_check m = {n_vertices, n_triangles, triangles, NULL, NULL, certificate};
    m.before = iccp_alloc(&env->memory, n_vertices, 2 * sizeof(double));
    m.after = iccp_alloc(&env->memory, n_vertices, 2 * sizeof(double));
    icc_status status = m.before != NULL && m.after != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_map_apply(map, false, n_vertices, vertices, images, NULL, NULL, env);
    if (status == ICC_OK)
        status = localise(m.before, n_vertices, vertices, err);
    if (status == ICC_OK)
        status = localise(m.after, n_vertices, images, err);
    if (status == ICC_OK) {
        check_triangles(&m, images);
        status = check_boundary(&m, env);
        certificate->boundary_simple = status == ICC_OK;
        certificate->certified = status == ICC_OK && certificate->first < 0;
        if (status == ICC_ERR_BOUNDARY)
            status = ICC_OK;
    }
    iccp_free(&env->memory, m.before);
    iccp_free(&env->memory, m.after);
    return iccp_explain(err, status);
}
