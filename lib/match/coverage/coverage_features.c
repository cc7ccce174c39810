/* Puts the common vertices of borders together to rings. */
#include "match/coverage/coverage_features.h"

#include <string.h>

static size_t count(const iccp_layer_rings *rings, const iccp_kept *kept,
                    const iccp_border_vertices *vertices)
{
    size_t n = 0;
    for (size_t r = 0; r < rings->n; ++r)
        for (size_t k = 0; k < rings->ring[r].n && kept->ring[r]; ++k)
            n += vertices->line[rings->course[rings->ring[r].first + k] / 2].n - 1;
    return n;
}

/* Appends the vertices of a course, without the last one. */
static size_t add_course(double *points, size_t n, const iccp_common_line *line, int e,
                         bool is_back)
{
    for (size_t k = 0; k + 1 < line->n; ++k)
        memcpy(points + 2 * n++, line->point[e] + 2 * (is_back ? line->n - 1 - k : k),
               2 * sizeof *points);
    return n;
}

/* Makes the features of one side. */
static void fill(icc_coverage *coverage, int e, const iccp_layer_rings *rings,
                 const iccp_kept *kept, const iccp_border_vertices *vertices)
{
    size_t n = 0, f = 0;
    for (size_t r = 0; r < rings->n; ++r) {
        const iccp_ring *const ring = &rings->ring[r];
        const size_t first = n;
        if (!kept->ring[r])
            continue;
        for (size_t k = ring->first; k < ring->first + ring->n; ++k)
            n = add_course(coverage->point[e], n, &vertices->line[rings->course[k] / 2], e,
                           rings->course[k] % 2 != 0);
        coverage->id[f] = rings->graph->layer->regions->id[ring->region];
        coverage->feature[e][f++] =
            (icc_feature){.size = sizeof(icc_feature),
                          .kind = ring->area > 0 ? ICC_FEATURE_REGION : ICC_FEATURE_HOLE,
                          .n_vertices = n - first,
                          .vertices = coverage->point[e] + 2 * first};
    }
}

/* Counts nodes, borders and different vertices of the coverage. `seen`: of each place. */
static void describe(icc_coverage_info *info, const iccp_layer_rings *rings, const iccp_kept *kept,
                     const iccp_border_vertices *vertices, bool *seen)
{
    const iccp_layer_graph *const graph = rings->graph;
    for (size_t b = 0; b < graph->n_borders; ++b) {
        const iccp_border *const border = &graph->border[b];
        const iccp_common_line *const line = &vertices->line[b];
        if (!kept->border[b])
            continue;
        info->n_islands += border->is_island;
        info->n_sides += !border->is_island;
        info->n_vertices += line->n - (border->is_island ? 1 : 2);
        info->n_joined += line->n_joined - (border->is_island ? 0 : 2);
        for (size_t k = 0; k < 2 && !border->is_island; ++k) {
            bool *const at = &seen[graph->at[border->first + k * border->n]];
            info->n_nodes += !*at;
            *at = true;
        }
    }
    info->n_vertices += info->n_nodes;
    info->n_joined += info->n_nodes;
}

icc_status iccp_coverage_features(icc_coverage *coverage, const iccp_layer_rings *rings,
                                  const iccp_kept *kept, const iccp_border_vertices *vertices,
                                  const iccp_memory *memory)
{
    const size_t n = count(rings, kept, vertices);
    bool *const seen = iccp_alloc_zero(memory, rings->graph->layer->n, sizeof *seen);
    bool has_all = seen != NULL;
    coverage->id = iccp_alloc(memory, kept->n_rings, sizeof *coverage->id);
    has_all = has_all && coverage->id != NULL;
    for (int e = 0; e < 2; ++e) {
        coverage->feature[e] = iccp_alloc(memory, kept->n_rings, sizeof *coverage->feature[e]);
        coverage->point[e] = iccp_alloc(memory, n, 2 * sizeof *coverage->point[e]);
        has_all = has_all && coverage->feature[e] != NULL && coverage->point[e] != NULL;
    }
    if (has_all) {
        coverage->n_features = coverage->info.n_features = kept->n_rings;
        for (int e = 0; e < 2; ++e)
            fill(coverage, e, rings, kept, vertices);
        describe(&coverage->info, rings, kept, vertices, seen);
        for (size_t f = 0; f < coverage->n_features; ++f)
            coverage->info.n_regions += f == 0 || coverage->id[f] != coverage->id[f - 1];
    }
    iccp_free(memory, seen);
    return has_all ? ICC_OK : ICC_ERR_MEMORY;
}
