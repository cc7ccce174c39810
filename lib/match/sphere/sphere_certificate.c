/* Counts the faces and stars of a drawing that are not right. */
#include "match/sphere/sphere_certificate.h"

#include "match/surface/direction.h"

/* Counts how often the neighbours of a vertex turn around it. Each step from one neighbour to the
 * next is a left turn by less than 180 degrees. So it counts how often they pass from the right
 * half of the circle into the left half, which begins at the first neighbour. */
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
        /* The neighbour lies on the line through the first one: on the same side as it, or
         * opposite. */
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
