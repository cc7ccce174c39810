#include "match/sphere/sphere_certificate.h"

#include "match/surface/direction.h"

/* How often the neighbours of a vertex go round it, where each step from one to the next is a turn
 * to the left by less than half the way: how often they come from the right half of the circle of
 * ways into the left one, which begins with the way to the first neighbour. */
static size_t count_turns(const iccp_half_edges *m, const double *directions, uint32_t vertex)
{
    const double *const p = directions + 3 * (size_t)vertex;
    const uint32_t start = m->out[vertex];
    const double *const first = directions + 3 * (size_t)iccp_edge_end(m, start);
    uint32_t h = iccp_edge_turn(m, start);
    const double *const second = directions + 3 * (size_t)iccp_edge_end(m, h);
    bool was_left = true;
    size_t n = 0;
    for (; h != start; h = iccp_edge_turn(m, h)) {
        const double *const q = directions + 3 * (size_t)iccp_edge_end(m, h);
        const int side = iccp_direction_sign(p, first, q);
        /* On the line through the first one: before the second, or opposite. */
        const bool is_left = side > 0 || (side == 0 && iccp_direction_sign(p, q, second) > 0);
        n += is_left && !was_left;
        was_left = is_left;
    }
    return n + !was_left;
}

iccp_sphere_certificate iccp_sphere_certify(const iccp_half_edges *m, const double *directions)
{
    iccp_sphere_certificate c = {0, 0};
    for (size_t f = 0; f < m->n_faces; ++f) {
        const uint32_t *const v = m->origin + 3 * f;
        c.n_faces +=
            iccp_direction_sign(directions + 3 * (size_t)v[0], directions + 3 * (size_t)v[1],
                                directions + 3 * (size_t)v[2]) <= 0;
    }
    for (uint32_t v = 0; v < m->n_vertices && c.n_faces == 0; ++v)
        c.n_stars += m->degree[v] > 0 && count_turns(m, directions, v) != 1;
    return c;
}
