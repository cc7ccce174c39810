/* Segments between vertices, and which of them meet at each. */
#ifndef ICCP_WEB_H
#define ICCP_WEB_H

#include "base/env.h"

typedef struct iccp_web {
    iccp_memory memory;
    size_t dim, n_vertices, n_segments;
    const double *vertices;   /* borrowed: dim coordinates each */
    const uint32_t *segments; /* borrowed: two vertices each */
    uint32_t *first;          /* segments at vertex v: incident[first[v]] up to first[v + 1] */
    uint32_t *incident;
} iccp_web;

icc_status iccp_web_create(iccp_web *web, size_t dim, size_t n_vertices, const double *vertices,
                           size_t n_segments, const uint32_t *segments, const iccp_memory *memory);
/* Accepts a web that is all zero. */
void iccp_web_free(iccp_web *web);

static inline const double *iccp_web_vertex(const iccp_web *web, uint32_t v)
{
    return web->vertices + web->dim * v;
}

static inline size_t iccp_web_degree(const iccp_web *web, uint32_t v)
{
    return web->first[v + 1] - web->first[v];
}

static inline uint32_t iccp_web_other_end(const iccp_web *web, uint32_t segment, uint32_t v)
{
    const uint32_t *ends = web->segments + 2 * (size_t)segment;
    return ends[0] == v ? ends[1] : ends[0];
}

double iccp_web_length(const iccp_web *web, uint32_t a, uint32_t b);

#endif
