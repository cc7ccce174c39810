/* Half edges of a closed surface: building them, collapsing and restoring edges. */
#include "match/surface/half_edges.h"

#include "base/error.h"
#include "domain/complex.h"

#include <string.h>

static void count_neighbours(iccp_half_edges *m, uint32_t vertex, uint32_t degree)
{
    m->degree[vertex] = degree;
    if (degree > m->most_neighbours)
        m->most_neighbours = degree;
}

/* The half-edge of a face that starts at a vertex. */
static uint32_t edge_from(const iccp_half_edges *m, uint32_t face, uint32_t vertex)
{
    uint32_t h = 3 * face;
    while (m->origin[h] != vertex)
        ++h;
    return h;
}

static icc_status join(iccp_half_edges *m, const iccp_env *env, icc_error *err)
{
    iccp_complex c = {3, m->n_vertices, m->n_faces, m->origin, NULL};
    c.across = iccp_alloc(&m->memory, m->n_faces, 3 * sizeof *c.across);
    if (c.across == NULL)
        return iccp_fail_memory(err);
    const icc_status status = iccp_complex_join(&c, env, err);
    for (uint32_t h = 0; h < 3 * m->n_faces && status == ICC_OK; ++h) {
        const uint32_t face = c.across[iccp_before(h)];
        m->twin[h] = edge_from(m, face, iccp_edge_end(m, h));
    }
    iccp_free(&m->memory, c.across);
    return status;
}

icc_status iccp_half_edges_create(iccp_half_edges *m, size_t n_vertices, size_t n_faces,
                                  const uint32_t *faces, const iccp_env *env, icc_error *err)
{
    *m = (iccp_half_edges){.memory = env->memory, .n_vertices = n_vertices, .n_faces = n_faces};
    m->collapsed = iccp_alloc(&m->memory, n_vertices, sizeof *m->collapsed);
    m->origin = iccp_alloc(&m->memory, n_faces, 3 * sizeof *m->origin);
    m->twin = iccp_alloc(&m->memory, n_faces, 3 * sizeof *m->twin);
    m->out = iccp_alloc(&m->memory, n_vertices, sizeof *m->out);
    m->degree = iccp_alloc_zero(&m->memory, n_vertices, sizeof *m->degree);
    if (m->collapsed == NULL || m->origin == NULL || m->twin == NULL || m->out == NULL ||
        m->degree == NULL)
        return iccp_fail_memory(err);
    memcpy(m->origin, faces, 3 * n_faces * sizeof *faces);
    memset(m->out, 0xff, n_vertices * sizeof *m->out);
    for (uint32_t h = 0; h < 3 * n_faces; ++h) {
        const uint32_t v = m->origin[h];
        m->out[v] = h;
        m->n_left += m->degree[v] == 0;
        count_neighbours(m, v, m->degree[v] + 1);
    }
    return join(m, env, err);
}

void iccp_half_edges_free(iccp_half_edges *m)
{
    iccp_free(&m->memory, m->collapsed);
    iccp_free(&m->memory, m->origin);
    iccp_free(&m->memory, m->twin);
    iccp_free(&m->memory, m->out);
    iccp_free(&m->memory, m->degree);
    *m = (iccp_half_edges){.memory = m->memory};
}

bool iccp_are_neighbours(const iccp_half_edges *m, uint32_t a, uint32_t b)
{
    const uint32_t from = m->degree[a] <= m->degree[b] ? a : b, to = from == a ? b : a;
    uint32_t h = m->out[from];
    do {
        if (iccp_edge_end(m, h) == to)
            return true;
        h = iccp_edge_turn(m, h);
    } while (h != m->out[from]);
    return false;
}

bool iccp_edge_collapsible(const iccp_half_edges *m, uint32_t h)
{
    const uint32_t end = iccp_edge_end(m, h);
    if (m->n_left <= 4)
        return false;
    /* The first and the last of these neighbours are neighbours of the edge's end, too. No others
     * may be. */
    uint32_t e = iccp_edge_turn(m, iccp_edge_turn(m, h));
    for (; iccp_edge_turn(m, e) != h; e = iccp_edge_turn(m, e))
        if (iccp_are_neighbours(m, iccp_edge_end(m, e), end))
            return false;
    return true;
}

/* The faces beside half-edge h from u to v are (u, v, b) and (v, u, a). */
typedef struct sides {
    uint32_t vb, bu, ua, av;
} sides;

static sides sides_of(const iccp_half_edges *m, uint32_t h)
{
    const uint32_t g = m->twin[h];
    return (sides){iccp_after(h), iccp_before(h), iccp_after(g), iccp_before(g)};
}

static void pair(iccp_half_edges *m, uint32_t h, uint32_t g)
{
    m->twin[h] = g;
    m->twin[g] = h;
}

/* Gives the half-edges from u another origin, `vertex`, except in the two faces beside the edge.
 * Returns their number. */
static uint32_t rename_between(iccp_half_edges *m, sides s, uint32_t vertex)
{
    uint32_t n = 0;
    for (uint32_t h = m->twin[s.bu]; h != s.ua; h = iccp_edge_turn(m, h), ++n)
        m->origin[h] = vertex;
    return n;
}

void iccp_edge_collapse(iccp_half_edges *m, uint32_t h)
{
    const sides s = sides_of(m, h);
    const uint32_t u = m->origin[h], v = m->origin[s.vb];
    const uint32_t a = m->origin[s.av], b = m->origin[s.bu];
    (void)rename_between(m, s, v);
    m->out[u] = ICCP_NO_EDGE;
    m->out[v] = m->twin[s.bu];
    m->out[a] = m->twin[s.ua];
    m->out[b] = m->twin[s.vb];
    count_neighbours(m, v, m->degree[v] + m->degree[u] - 4);
    m->degree[u] = 0;
    --m->degree[a];
    --m->degree[b];
    pair(m, m->twin[s.vb], m->twin[s.bu]);
    pair(m, m->twin[s.ua], m->twin[s.av]);
    m->collapsed[m->n_collapsed++] = h;
    --m->n_left;
}

void iccp_edge_flip(iccp_half_edges *m, uint32_t h)
{
    const uint32_t g = m->twin[h];
    const sides s = sides_of(m, h);
    const uint32_t u = m->origin[h], v = m->origin[s.vb];
    const uint32_t a = m->origin[s.av], b = m->origin[s.bu];
    m->origin[h] = a;
    m->origin[g] = b;
    m->out[u] = s.ua;
    m->out[v] = s.vb;
    --m->degree[u];
    --m->degree[v];
    count_neighbours(m, a, m->degree[a] + 1);
    count_neighbours(m, b, m->degree[b] + 1);
    pair(m, h, m->twin[s.av]);
    pair(m, g, m->twin[s.bu]);
    pair(m, s.bu, s.av);
}

uint32_t iccp_edge_restore(iccp_half_edges *m)
{
    const uint32_t h = m->collapsed[--m->n_collapsed];
    const sides s = sides_of(m, h);
    const uint32_t u = m->origin[h], v = m->origin[s.vb];
    pair(m, m->twin[s.vb], s.vb);
    pair(m, m->twin[s.bu], s.bu);
    pair(m, m->twin[s.ua], s.ua);
    pair(m, m->twin[s.av], s.av);
    m->degree[u] = 2 + rename_between(m, s, u);
    m->degree[v] -= m->degree[u] - 4;
    ++m->degree[m->origin[s.av]];
    ++m->degree[m->origin[s.bu]];
    m->out[u] = h;
    m->out[v] = m->twin[h];
    ++m->n_left;
    return u;
}
