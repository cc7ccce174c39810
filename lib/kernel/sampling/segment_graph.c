/* Segments between vertices, and which of them meet at each vertex. */
#include "kernel/sampling/segment_graph.h"

#include "base/sort.h"
#include "math/vec.h"

#include <math.h>

icc_status iccp_segment_graph_create(iccp_segment_graph *graph, size_t dim, size_t n_vertices,
                                     const double *vertices, size_t n_segments,
                                     const uint32_t *segments, const iccp_memory *memory)
{
    *graph = (iccp_segment_graph){.memory = *memory,
                                  .dim = dim,
                                  .n_vertices = n_vertices,
                                  .n_segments = n_segments,
                                  .vertices = vertices,
                                  .segments = segments};
    graph->first = iccp_alloc_zero(memory, n_vertices + 1, sizeof *graph->first);
    graph->incident = iccp_alloc(memory, n_segments, 2 * sizeof *graph->incident);
    if (graph->first == NULL || graph->incident == NULL) {
        iccp_segment_graph_free(graph);
        return ICC_ERR_MEMORY;
    }
    iccp_list_groups(graph->incident, graph->first, n_vertices, segments, n_segments, 2);
    return ICC_OK;
}

void iccp_segment_graph_free(iccp_segment_graph *graph)
{
    if (graph->memory.dealloc != NULL) {
        iccp_free(&graph->memory, graph->first);
        iccp_free(&graph->memory, graph->incident);
    }
    *graph = (iccp_segment_graph){0};
}

double iccp_segment_graph_length(const iccp_segment_graph *graph, uint32_t a, uint32_t b)
{
    return iccp_vec_distance(graph->dim, iccp_segment_graph_vertex(graph, a),
                             iccp_segment_graph_vertex(graph, b));
}
