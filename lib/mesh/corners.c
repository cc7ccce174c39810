#include "mesh/corners.h"

#include "domain/tuples.h"

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

/* The triangle x a b of a corner at x becomes x a m, and a new one x m b, which is returned. What
 * faces the halves of a b is left open. */
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

/* Links the half-edges with the same ends, from `begin` to `end`: one, or two in opposite
 * directions. */
static bool link_equal(iccp_corners *c, const iccp_tuples *edges, size_t begin, size_t end)
{
    const uint32_t a = edges->order[begin], *ends = edges->vertices + 2 * (size_t)a;
    c->twin[a] = ICCP_NO_NEIGHBOUR;
    if (ends[0] == ends[1] || end - begin > 2)
        return false;
    if (end - begin == 1)
        return true;
    const uint32_t b = edges->order[begin + 1];
    link_twins(c, a, b);
    return c->vertex[iccp_after(a)] == c->vertex[iccp_before(b)];
}

/* Sorting the half-edges by their two ends puts those of one edge side by side. */
icc_status iccp_find_twins(iccp_corners *corners, size_t n_vertices, bool *is_manifold,
                           const iccp_env *env)
{
    const size_t n = 3 * corners->n_triangles;
    iccp_tuples edges;
    icc_status status = iccp_tuples_create(&edges, n, 2, n_vertices, &env->memory);
    if (status != ICC_OK)
        return status;
    for (uint32_t c = 0; c < n; ++c) {
        const uint32_t a = corners->vertex[iccp_after(c)], b = corners->vertex[iccp_before(c)];
        edges.vertices[2 * (size_t)c] = a < b ? a : b;
        edges.vertices[2 * (size_t)c + 1] = a < b ? b : a;
    }
    iccp_tuples_sort(&edges);
    *is_manifold = true;
    for (size_t begin = 0, end; begin < n; begin = end) {
        end = iccp_tuples_end(&edges, begin);
        *is_manifold &= link_equal(corners, &edges, begin, end);
    }
    iccp_tuples_free(&edges);
    return ICC_OK;
}
