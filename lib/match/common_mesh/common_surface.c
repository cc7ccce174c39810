/* Cuts the faces of an overlay into triangles, and places their vertices on both surfaces. */
#include "match/common_mesh/common_surface.h"

#include "base/error.h"
#include "base/minmax.h"
#include "match/surface/corner_angle.h"
#include "match/surface/drawn_place.h"

#include <string.h>

typedef struct maker {
    iccp_common_surface *common;
    const iccp_sphere_overlay *overlay;
    const iccp_half_edges *m[2];
    const double *directions[2], *x[2];
    uint32_t *vertex; /* by node */
} maker;

static const double *vector_of(const double *all, uint32_t vertex)
{
    return all + 3 * (size_t)vertex;
}

/* Puts the next vertex at vertex `v` of a surface. */
static void put_vertex(const maker *k, int side, uint32_t v)
{
    iccp_common_surface *const c = k->common;
    memcpy(c->x[side] + 3 * c->n_vertices, vector_of(k->x[side], v), 3 * sizeof(double));
    c->origin[side][c->n_vertices] = v;
}

static void put_between(const maker *k, int side, size_t n, const double *const *corners,
                        const double *weight)
{
    iccp_common_surface *const c = k->common;
    double *const p = c->x[side] + 3 * c->n_vertices;
    for (int i = 0; i < 3; ++i) {
        p[i] = 0;
        for (size_t j = 0; j < n; ++j)
            p[i] += weight[j] * corners[j][i];
    }
    c->origin[side][c->n_vertices] = ICCP_NO_EDGE;
}

/* Puts the next vertex on the other surface, in the face where a vertex of this surface is
 * drawn. */
static void put_in_face(const maker *k, int other, const double p[3], uint32_t face)
{
    const double *s[3], *x[3];
    double weight[3];
    for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t v = k->m[other]->origin[3 * face + i];
        s[i] = vector_of(k->directions[other], v);
        x[i] = vector_of(k->x[other], v);
    }
    iccp_drawn_weights(weight, p, s);
    put_between(k, other, 3, x, weight);
}

/* Puts the next vertex on an edge that is crossed. The great circle through the ends of the other
 * edge divides it in the ratio of the determinants with its own ends. */
static void put_on_edge(const maker *k, int side, const uint32_t h[2])
{
    const iccp_half_edges *const m = k->m[side], *const other = k->m[1 - side];
    const uint32_t u = m->origin[h[side]], v = iccp_edge_end(m, h[side]);
    const double *const p = vector_of(k->directions[1 - side], other->origin[h[1 - side]]);
    const double *const q = vector_of(k->directions[1 - side], iccp_edge_end(other, h[1 - side]));
    const double at_u = fabs(iccp_direction_det(p, q, vector_of(k->directions[side], u)));
    const double at_v = fabs(iccp_direction_det(p, q, vector_of(k->directions[side], v)));
    const double sum = at_u + at_v, share = sum > 0 ? at_u / sum : 0.5;
    put_between(k, side, 2,
                (const double *const[]){vector_of(k->x[side], u), vector_of(k->x[side], v)},
                (const double[]){1 - share, share});
}

static void put_vertices(maker *k)
{
    const iccp_sphere_overlay *const o = k->overlay;
    uint32_t node = 0;
    for (int side = 0; side < 2; ++side)
        for (uint32_t v = 0; v < o->n_vertices[side]; ++v, ++node) {
            const bool is_common = side == 0 && o->partner[v] != ICCP_NO_EDGE;
            /* Vertices of the second drawing that are also the first's were put in with these. */
            if (k->m[side]->degree[v] == 0 || k->vertex[node] != ICCP_NO_EDGE)
                continue;
            put_vertex(k, side, v);
            if (is_common) {
                put_vertex(k, 1, o->partner[v]);
                k->vertex[o->n_vertices[0] + o->partner[v]] = (uint32_t)k->common->n_vertices;
            } else {
                put_in_face(k, 1 - side, vector_of(k->directions[side], v), o->face[side][v]);
            }
            k->vertex[node] = (uint32_t)k->common->n_vertices++;
        }
    for (size_t c = 0; c < o->n_crossings; ++c, ++node) {
        for (int side = 0; side < 2; ++side)
            put_on_edge(k, side, o->crossing[c]);
        k->vertex[node] = (uint32_t)k->common->n_vertices++;
    }
}

/* The least angle, on both surfaces, of the triangles into which a face is cut from one corner. */
static double least_angle(const maker *k, const uint32_t *v, size_t n, size_t from)
{
    double least = HUGE_VAL;
    for (size_t i = 1; i + 1 < n; ++i)
        for (int side = 0; side < 2; ++side) {
            const double *const x = k->common->x[side];
            least = iccp_min(least,
                             iccp_least_sine(vector_of(x, v[from]), vector_of(x, v[(from + i) % n]),
                                             vector_of(x, v[(from + i + 1) % n])));
        }
    return least;
}

static void put_faces(const maker *k)
{
    iccp_common_surface *const c = k->common;
    for (size_t f = 0; f < k->overlay->n_faces; ++f) {
        const uint32_t *const corner = k->overlay->corner + k->overlay->begin[f];
        const size_t n = k->overlay->begin[f + 1] - k->overlay->begin[f];
        uint32_t v[ICCP_OVERLAY_CORNERS];
        for (size_t i = 0; i < n; ++i)
            v[i] = k->vertex[corner[i]];
        size_t from = 0;
        double best = n > 3 ? least_angle(k, v, n, 0) : 0;
        for (size_t i = 1; i < n && n > 3; ++i) {
            const double angle = least_angle(k, v, n, i);
            if (angle > best) {
                best = angle;
                from = i;
            }
        }
        for (size_t i = 1; i + 1 < n; ++i, ++c->n_faces) {
            uint32_t *const t = c->faces + 3 * c->n_faces;
            t[0] = v[from];
            t[1] = v[(from + i) % n];
            t[2] = v[(from + i + 1) % n];
            for (int side = 0; side < 2; ++side)
                c->within[side][c->n_faces] = k->overlay->within[side][f];
        }
    }
}

icc_status iccp_common_surface_create(iccp_common_surface *common,
                                      const iccp_sphere_overlay *overlay,
                                      const iccp_half_edges *const m[2],
                                      const double *const directions[2], const double *const x[2],
                                      const iccp_memory *memory, icc_error *err)
{
    const size_t n = overlay->n_nodes, n_faces = 2 * n; /* Euler's formula: 2 n - 4 */
    const size_t n_all = overlay->n_vertices[0] + overlay->n_vertices[1] + overlay->n_crossings;
    maker k = {common, overlay, {m[0], m[1]}, {directions[0], directions[1]}, {x[0], x[1]}, NULL};
    bool has_memory = true;
    *common = (iccp_common_surface){0};
    for (int side = 0; side < 2; ++side) {
        common->x[side] = iccp_alloc(memory, n, 3 * sizeof *common->x[side]);
        common->origin[side] = iccp_alloc(memory, n, sizeof *common->origin[side]);
        common->within[side] = iccp_alloc(memory, n_faces, sizeof *common->within[side]);
        has_memory = has_memory && common->x[side] != NULL && common->origin[side] != NULL &&
                     common->within[side] != NULL;
    }
    common->faces = iccp_alloc(memory, n_faces, 3 * sizeof *common->faces);
    k.vertex = iccp_alloc(memory, n_all, sizeof *k.vertex);
    has_memory = has_memory && common->faces != NULL && k.vertex != NULL;
    if (has_memory) {
        memset(k.vertex, 0xff, n_all * sizeof *k.vertex);
        put_vertices(&k);
        put_faces(&k);
    }
    iccp_free(memory, k.vertex);
    return has_memory ? ICC_OK : iccp_fail_memory(err);
}

icc_status iccp_common_surface_copy(iccp_common_surface *to, const iccp_common_surface *c,
                                    const iccp_memory *memory)
{
    bool has_memory = true;
    *to = (iccp_common_surface){.n_vertices = c->n_vertices, .n_faces = c->n_faces};
    to->faces = iccp_alloc(memory, c->n_faces, 3 * sizeof *to->faces);
    for (int side = 0; side < 2; ++side) {
        to->x[side] = iccp_alloc(memory, c->n_vertices, 3 * sizeof *to->x[side]);
        to->origin[side] = iccp_alloc(memory, c->n_vertices, sizeof *to->origin[side]);
        to->within[side] = iccp_alloc(memory, c->n_faces, sizeof *to->within[side]);
        has_memory = has_memory && to->x[side] != NULL && to->origin[side] != NULL &&
                     to->within[side] != NULL;
    }
    if (!has_memory || to->faces == NULL)
        return ICC_ERR_MEMORY;
    memcpy(to->faces, c->faces, 3 * c->n_faces * sizeof *to->faces);
    for (int side = 0; side < 2; ++side) {
        memcpy(to->x[side], c->x[side], 3 * c->n_vertices * sizeof *to->x[side]);
        memcpy(to->origin[side], c->origin[side], c->n_vertices * sizeof *to->origin[side]);
        memcpy(to->within[side], c->within[side], c->n_faces * sizeof *to->within[side]);
    }
    return ICC_OK;
}

void iccp_common_surface_compact(iccp_common_surface *c, const iccp_half_edges *m, uint32_t *became)
{
    size_t n = 0, n_faces = 0;
    for (uint32_t v = 0; v < m->n_vertices; ++v) {
        became[v] = (uint32_t)n;
        if (m->degree[v] == 0)
            continue;
        for (int side = 0; side < 2; ++side) {
            memmove(c->x[side] + 3 * n, c->x[side] + 3 * (size_t)v, 3 * sizeof(double));
            c->origin[side][n] = c->origin[side][v];
        }
        ++n;
    }
    for (uint32_t f = 0; f < m->n_faces; ++f) {
        const uint32_t *const v = m->origin + 3 * (size_t)f;
        /* The two faces that disappear with a vertex still have it as a corner. */
        if (m->degree[v[0]] == 0 || m->degree[v[1]] == 0 || m->degree[v[2]] == 0)
            continue;
        for (int side = 0; side < 2; ++side)
            c->within[side][n_faces] = c->within[side][f];
        for (int i = 0; i < 3; ++i)
            c->faces[3 * n_faces + (size_t)i] = became[v[i]];
        ++n_faces;
    }
    for (size_t k = m->n_collapsed; k-- > 0;) {
        const uint32_t h = m->collapsed[k];
        became[m->origin[h]] = became[iccp_edge_end(m, h)];
    }
    c->n_vertices = n;
    c->n_faces = n_faces;
}

void iccp_common_surface_free(iccp_common_surface *common, const iccp_memory *memory)
{
    for (int side = 0; side < 2; ++side) {
        iccp_free(memory, common->x[side]);
        iccp_free(memory, common->origin[side]);
        iccp_free(memory, common->within[side]);
    }
    iccp_free(memory, common->faces);
    *common = (iccp_common_surface){0};
}
