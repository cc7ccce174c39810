/* Segments between vertices, and which of them meet at each vertex. */
#ifndef ICCP_SEGMENT_GRAPH_H
#define ICCP_SEGMENT_GRAPH_H

#include "base/env.h"

typedef struct iccp_segment_graph {
    iccp_memory memory;
    size_t dim, n_vertices, n_segments;
    const double *vertices;   /* borrowed: dim coordinates each */
    const uint32_t *segments; /* borrowed: two vertices each */
    uint32_t *first;          /* segments at vertex v: incident[first[v]] up to first[v + 1] */
    uint32_t *incident;
} iccp_segment_graph;

icc_status iccp_segment_graph_create(iccp_segment_graph *graph, size_t dim, size_t n_vertices,
                                     const double *vertices, size_t n_segments,
                                     const uint32_t *segments, const iccp_memory *memory);
/* Accepts a graph of all zeros. */
void iccp_segment_graph_free(iccp_segment_graph *graph);

static inline const double *iccp_segment_graph_vertex(const iccp_segment_graph *graph, uint32_t v)
{
    return graph->vertices + graph->dim * v;
}

static inline size_t iccp_segment_graph_degree(const iccp_segment_graph *graph, uint32_t v)
{
    return graph->first[v + 1] - graph->first[v];
}

static inline uint32_t iccp_segment_graph_other_end(const iccp_segment_graph *graph,
                                                    uint32_t segment, uint32_t v)
{
    const uint32_t *ends = graph->segments + 2 * (size_t)segment;
    return ends[0] == v ? ends[1] : ends[0];
}

double iccp_segment_graph_length(const iccp_segment_graph *graph, uint32_t a, uint32_t b);

#endif
