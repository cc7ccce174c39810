/* Tells whether what was found out about a vertex still holds. It depends on the faces around the
 * vertex and around its neighbours. */
#ifndef ICCP_VERTEX_STAMPS_H
#define ICCP_VERTEX_STAMPS_H

#include "match/surface/half_edges.h"

typedef struct iccp_vertex_stamps {
    uint32_t now;     /* the number of changes so far, plus 1 */
    uint32_t *change; /* by vertex: `now` after the last change of a face around it */
    uint32_t *known;  /* by vertex: `now` when it was examined; 0 if never */
} iccp_vertex_stamps;

/* False if there is no memory. Free it in any case. */
static inline bool iccp_vertex_stamps_create(iccp_vertex_stamps *s, size_t n_vertices,
                                             const iccp_memory *memory)
{
    s->now = 1;
    s->change = iccp_alloc_zero(memory, n_vertices, sizeof *s->change);
    s->known = iccp_alloc_zero(memory, n_vertices, sizeof *s->known);
    return s->change != NULL && s->known != NULL;
}

static inline void iccp_vertex_stamps_free(iccp_vertex_stamps *s, const iccp_memory *memory)
{
    iccp_free(memory, s->change);
    iccp_free(memory, s->known);
}

/* Returns true if no face around a vertex or its neighbours has changed since it was examined. */
static inline bool iccp_vertex_stamps_hold(const iccp_vertex_stamps *s, const iccp_half_edges *m,
                                           uint32_t v)
{
    bool holds = s->known[v] > 0 && s->change[v] <= s->known[v];
    uint32_t h = m->out[v];
    for (uint32_t k = 0; k < m->degree[v] && holds; ++k, h = iccp_edge_turn(m, h))
        holds = s->change[iccp_edge_end(m, h)] <= s->known[v];
    return holds;
}

#endif
