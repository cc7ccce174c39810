#include "kernel/web.h"

#include "math/vec.h"

#include <math.h>

icc_status iccp_web_create(iccp_web *web, size_t dim, size_t n_vertices, const double *vertices,
                           size_t n_segments, const uint32_t *segments, const iccp_memory *memory)
{
    *web = (iccp_web){.memory = *memory,
                      .dim = dim,
                      .n_vertices = n_vertices,
                      .n_segments = n_segments,
                      .vertices = vertices,
                      .segments = segments};
    web->first = iccp_alloc_zero(memory, n_vertices + 1, sizeof *web->first);
    web->incident = iccp_alloc(memory, n_segments, 2 * sizeof *web->incident);
    if (web->first == NULL || web->incident == NULL) {
        iccp_web_free(web);
        return ICC_ERR_MEMORY;
    }
    for (size_t i = 0; i < 2 * n_segments; ++i)
        ++web->first[segments[i]];
    for (size_t v = 0; v < n_vertices; ++v)
        web->first[v + 1] += web->first[v];
    for (size_t i = 2 * n_segments; i-- > 0;)
        web->incident[--web->first[segments[i]]] = (uint32_t)(i / 2);
    return ICC_OK;
}

void iccp_web_free(iccp_web *web)
{
    if (web->memory.dealloc != NULL) {
        iccp_free(&web->memory, web->first);
        iccp_free(&web->memory, web->incident);
    }
    *web = (iccp_web){0};
}

double iccp_web_length(const iccp_web *web, uint32_t a, uint32_t b)
{
    return iccp_vec_distance(web->dim, iccp_web_vertex(web, a), iccp_web_vertex(web, b));
}
