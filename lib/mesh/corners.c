/* Local changes of a triangle mesh, and its twins. */
#include "mesh/corners.h"

#include "base/compiler.h"

#include <string.h>

static void link_twins(iccp_corners *c, uint32_t a, uint32_t b)
{
    c->twin[a] = b;
    if (b != ICCP_NO_NEIGHBOUR)
        c->twin[b] = a;
}

static void set_triangle(iccp_corners *c, uint32_t t, uint32_t v0, uint32_t v1, uint32_t v2)
{
    c->vertex[3 * (size_t)t] = v0;
    c->vertex[3 * (size_t)t + 1] = v1;
    c->vertex[3 * (size_t)t + 2] = v2;
}

/* Turns the triangle x a b of a corner at x into x a m, and adds a triangle x m b, which is
 * returned. The neighbours across the halves of a b are left open. */
static uint32_t halve(iccp_corners *c, uint32_t corner, uint32_t m)
{
    const uint32_t after = iccp_after(corner), before = iccp_before(corner);
    const uint32_t fresh = (uint32_t)c->n_triangles++;
    set_triangle(c, fresh, c->vertex[corner], m, c->vertex[before]);
    link_twins(c, 3 * fresh + 1, c->twin[after]);
    c->vertex[before] = m;
    link_twins(c, 3 * fresh + 2, after);
    return fresh;
}

void iccp_cut_edge(iccp_corners *corners, uint32_t corner, uint32_t m)
{
    const uint32_t twin = corners->twin[corner];
    const uint32_t near_half = halve(corners, corner, m);
    if (twin == ICCP_NO_NEIGHBOUR) {
        corners->twin[3 * near_half] = ICCP_NO_NEIGHBOUR;
        return;
    }
    const uint32_t far_half = halve(corners, twin, m);
    link_twins(corners, corner, 3 * far_half);
    link_twins(corners, twin, 3 * near_half);
}

void iccp_cut_triangle(iccp_corners *corners, uint32_t triangle, uint32_t m)
{
    iccp_corners *c = corners;
    const uint32_t first = 3 * triangle, second = 3 * (uint32_t)c->n_triangles, third = second + 3;
    const uint32_t v[3] = {c->vertex[first], c->vertex[first + 1], c->vertex[first + 2]};
    const uint32_t beyond[2] = {c->twin[first], c->twin[first + 1]};
    c->n_triangles += 2;
    set_triangle(c, triangle, v[0], v[1], m);
    set_triangle(c, second / 3, v[1], v[2], m);
    set_triangle(c, third / 3, v[2], v[0], m);
    link_twins(c, second + 2, beyond[0]);
    link_twins(c, third + 2, beyond[1]);
    link_twins(c, first, second + 1);
    link_twins(c, second, third + 1);
    link_twins(c, third, first + 1);
}

void iccp_flip_edge(iccp_corners *corners, uint32_t corner)
{
    iccp_corners *c = corners;
    const uint32_t after = iccp_after(corner), before = iccp_before(corner);
    const uint32_t twin = c->twin[corner];
    const uint32_t twin_after = iccp_after(twin), twin_before = iccp_before(twin);
    const uint32_t outer = c->twin[twin_after], twin_outer = c->twin[after];
    c->vertex[before] = c->vertex[twin];
    c->vertex[twin_before] = c->vertex[corner];
    link_twins(c, corner, outer);
    link_twins(c, twin, twin_outer);
    link_twins(c, after, twin_after);
}

void iccp_collapse_edge(iccp_corners *corners, uint32_t corner)
{
    iccp_corners *c = corners;
    const uint32_t to = c->vertex[iccp_after(corner)];
    const uint32_t facing = c->twin[iccp_before(corner)], last = iccp_before(facing);
    uint32_t at = iccp_after(c->twin[iccp_after(corner)]);
    for (; at != last; at = iccp_after(c->twin[iccp_after(at)]))
        c->vertex[at] = to;
    link_twins(c, c->twin[iccp_after(corner)], c->twin[corner]);
    link_twins(c, c->twin[iccp_after(facing)], c->twin[last]);
}

typedef struct half_edge {
    uint32_t to;     /* its larger end */
    uint32_t corner; /* the corner that faces it */
} half_edge;

/* Half-edges sorted by their smaller end. Those that leave it come before those that arrive. */
typedef struct half_edges {
    half_edge *list;
    /* Half-edges that leave vertex v begin at begin[2 v], those that arrive at begin[2 v + 1] */
    uint32_t *begin;
    uint32_t *from; /* by vertex: the other end of the last edge found there */
    uint32_t *twin; /* the corner that faces that edge and has no twin yet, or ICCP_NO_NEIGHBOUR */
} half_edges;

/* Counts the half-edges, or enters them into their lists, backwards. */
static ICCP_INLINE void visit_half_edges(const iccp_corners *c, half_edges *h, bool enters)
{
    for (size_t t = c->n_triangles; t-- > 0;)
        for (size_t k = 3; k-- > 0;) {
            const uint32_t a = c->vertex[3 * t + (k + 1) % 3], b = c->vertex[3 * t + (k + 2) % 3];
            const size_t place = 2 * (size_t)(a < b ? a : b) + (a > b);
            if (enters)
                h->list[--h->begin[place]] = (half_edge){a < b ? b : a, (uint32_t)(3 * t + k)};
            else
                ++h->begin[place];
        }
}

/* Links the half-edges at a vertex. Those that leave it wait at their other ends, where those that
 * arrive find them. */
static bool link_vertex(iccp_corners *c, half_edges *h, uint32_t v, size_t begin, size_t middle,
                        size_t end)
{
    bool is_manifold = true;
    for (size_t k = begin; k < middle; ++k) {
        const half_edge e = h->list[k];
        is_manifold &= h->from[e.to] != v && e.to != v;
        h->from[e.to] = v;
        h->twin[e.to] = e.corner;
        c->twin[e.corner] = ICCP_NO_NEIGHBOUR;
    }
    for (size_t k = middle; k < end; ++k) {
        const half_edge e = h->list[k];
        const uint32_t twin = h->from[e.to] == v ? h->twin[e.to] : ICCP_NO_NEIGHBOUR;
        is_manifold &= h->from[e.to] != v || twin != ICCP_NO_NEIGHBOUR;
        h->from[e.to] = v;
        h->twin[e.to] = ICCP_NO_NEIGHBOUR;
        link_twins(c, e.corner, twin);
    }
    return is_manifold;
}

static bool link_all(iccp_corners *c, half_edges *h, size_t n_vertices)
{
    bool is_manifold = true;
    visit_half_edges(c, h, false);
    for (size_t k = 1; k <= 2 * n_vertices; ++k)
        h->begin[k] += h->begin[k - 1];
    visit_half_edges(c, h, true);
    memset(h->from, 0xff, n_vertices * sizeof *h->from);
    for (size_t v = 0; v < n_vertices; ++v)
        is_manifold &= link_vertex(c, h, (uint32_t)v, h->begin[2 * v], h->begin[2 * v + 1],
                                   h->begin[2 * v + 2]);
    return is_manifold;
}

/* A counting sort puts the half-edges of one edge into the list of the same vertex. */
icc_status iccp_find_twins(iccp_corners *corners, size_t n_vertices, bool *is_manifold,
                           const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    half_edges h = {.list = iccp_alloc(memory, corners->n_triangles, 3 * sizeof *h.list),
                    .begin = iccp_alloc_zero(memory, 2 * n_vertices + 1, sizeof *h.begin),
                    .from = iccp_alloc(memory, n_vertices, sizeof *h.from),
                    .twin = iccp_alloc(memory, n_vertices, sizeof *h.twin)};
    const bool ready = h.list != NULL && h.begin != NULL && h.from != NULL && h.twin != NULL;
    *is_manifold = ready && link_all(corners, &h, n_vertices);
    iccp_free(memory, h.list);
    iccp_free(memory, h.begin);
    iccp_free(memory, h.from);
    iccp_free(memory, h.twin);
    return ready ? ICC_OK : ICC_ERR_MEMORY;
}

bool iccp_link_boundary(const iccp_corners *corners, size_t n_vertices, uint32_t *next)
{
    bool is_clear = true;
    memset(next, 0xff, n_vertices * sizeof *next);
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c)
        if (corners->twin[c] == ICCP_NO_NEIGHBOUR) {
            const uint32_t from = corners->vertex[iccp_after(c)];
            is_clear &= next[from] == UINT32_MAX;
            next[from] = corners->vertex[iccp_before(c)];
        }
    return is_clear;
}
