/* Finds the cell of each vertex of a common surface, and tells which vertices may move into
 * which cells. */
#include "match/common_mesh/kept_cells.h"

#include <string.h>

bool iccp_kept_cells_create(iccp_kept_cells *cells, const iccp_common_surface *common,
                            const uint32_t *corners, const uint32_t *part_of,
                            const iccp_memory *memory)
{
    const size_t n = common->n_vertices;
    *cells = (iccp_kept_cells){corners, iccp_alloc(memory, n, sizeof *cells->at)};
    if (cells->at == NULL)
        return false;
    memset(cells->at, 0xff, n * sizeof *cells->at);
    for (size_t f = 0; f < common->n_faces; ++f) {
        const uint32_t within = common->within[0][f];
        const uint32_t face = part_of != NULL ? part_of[within] : within;
        for (int i = 0; i < 3; ++i) {
            uint32_t *const at = cells->at[common->faces[3 * f + (size_t)i]];
            if (at[0] == ICCP_NO_EDGE)
                at[0] = at[1] = face;
            else if (at[0] != face)
                at[1] = face;
        }
    }
    for (size_t v = 0; v < n; ++v)
        if (common->origin[0][v] != ICCP_NO_EDGE) {
            cells->at[v][0] = ICCP_NO_EDGE;
            cells->at[v][1] = common->origin[0][v];
        }
    return true;
}

void iccp_kept_cells_free(iccp_kept_cells *cells, const iccp_memory *memory)
{
    iccp_free(memory, cells->at);
}

static bool has(const iccp_kept_cells *cells, uint32_t face, uint32_t v)
{
    const uint32_t *const at = cells->at[v], *const corner = cells->corners + 3 * (size_t)face;
    return at[0] == ICCP_NO_EDGE ? corner[0] == at[1] || corner[1] == at[1] || corner[2] == at[1]
                                 : at[0] == face || at[1] == face;
}

bool iccp_kept_cells_may_go(const iccp_kept_cells *cells, uint32_t u, uint32_t v)
{
    const uint32_t *const at = cells->at[u];
    return at[0] != ICCP_NO_EDGE && has(cells, at[0], v) && has(cells, at[1], v);
}

bool iccp_kept_cells_share(const iccp_kept_cells *cells, const uint32_t places[4])
{
    /* A face has three vertices, so at least one of four places that share a face is inside it or
     * on an edge. That place tells which faces are possible. */
    int i = 0;
    while (i < 3 && cells->at[places[i]][0] == ICCP_NO_EDGE)
        ++i;
    const uint32_t *const at = cells->at[places[i]];
    bool all[2] = {at[0] != ICCP_NO_EDGE, at[0] != ICCP_NO_EDGE};
    for (int k = 0; k < 4; ++k)
        for (int side = 0; side < 2; ++side)
            all[side] = all[side] && has(cells, at[side], places[k]);
    return all[0] || all[1];
}
