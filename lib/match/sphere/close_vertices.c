/* Walks to the face that contains a vertex of the other drawing (drawn_finder.c). Moves the vertex
 * there if the exact signs of the faces around it allow this. */
#include "match/sphere/close_vertices.h"

#include "base/minmax.h"
#include "match/sphere/drawn_finder.h"
#include "match/surface/direction.h"

#include <string.h>

/* As a share of the shortest edge at the vertex. Two drawings of equal surfaces, one of them
 * turned, differ by 1e-11. In other pairs (t01, t05, t06, t08) all vertices are at least 1e-4
 * apart. A sphere and a turned copy of it with one more vertex need this. */
static const double close_by = 1e-8;

static double shortest_edge(const iccp_half_edges *m, const double *directions, uint32_t v)
{
    double least2 = HUGE_VAL;
    uint32_t h = m->out[v];
    for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h))
        least2 = iccp_min(least2, iccp_vec_distance2(3, directions + 3 * (size_t)v,
                                                     directions + 3 * (size_t)iccp_edge_end(m, h)));
    return sqrt(least2);
}

static bool is_positive_round(const iccp_half_edges *m, const double *directions, uint32_t v)
{
    uint32_t h = m->out[v];
    for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h))
        if (iccp_direction_sign(directions + 3 * (size_t)v,
                                directions + 3 * (size_t)iccp_edge_end(m, h),
                                directions + 3 * (size_t)m->origin[iccp_before(h)]) <= 0)
            return false;
    return true;
}

/* A vertex this close is a corner of the face that contains the first one. */
void iccp_close_vertices_join(const iccp_half_edges *const m[2], double *const directions[2])
{
    uint32_t face = 0;
    for (uint32_t v = 0; v < m[0]->n_vertices; ++v) {
        if (m[0]->degree[v] == 0)
            continue;
        double *const p = directions[0] + 3 * (size_t)v;
        const double most = close_by * shortest_edge(m[0], directions[0], v);
        face = iccp_drawn_walk(m[1], directions[1], face, p);
        for (int i = 0; i < 3; ++i) {
            const double *const q =
                directions[1] + 3 * (size_t)m[1]->origin[3 * (size_t)face + (size_t)i];
            const double before[3] = {p[0], p[1], p[2]};
            if (iccp_vec_distance2(3, p, q) > most * most)
                continue;
            memcpy(p, q, sizeof before);
            if (!is_positive_round(m[0], directions[0], v))
                memcpy(p, before, sizeof before);
        }
    }
}
