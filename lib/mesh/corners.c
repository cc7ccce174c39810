#include "mesh/corners.h"

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

void iccp_turn_edge(iccp_corners *corners, uint32_t corner)
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
