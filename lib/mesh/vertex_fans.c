/* Lists the fans of vertices where a boundary touches itself. */
#include "mesh/vertex_fans.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* Whether a fan begins at a corner: the edge from its vertex to the vertex after it is on the
 * boundary. */
static bool begins_fan(const iccp_corners *mesh, uint32_t corner)
{
    return mesh->twin[iccp_before(corner)] == NONE;
}

/* Counts the fans of each vertex. first[v + 1] becomes the end of the list of vertex v. */
static void count(iccp_fans *fans, const iccp_corners *mesh)
{
    memset(fans->corner, 0xff, fans->n * sizeof *fans->corner);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        fans->corner[mesh->vertex[c]] = c;
        fans->first[mesh->vertex[c] + 1] += begins_fan(mesh, c);
    }
    for (size_t v = 0; v < fans->n; ++v)
        fans->first[v + 1] = fans->first[v] + (fans->first[v + 1] > 1 ? fans->first[v + 1] : 0);
}

icc_status iccp_fans_create(iccp_fans *fans, const iccp_corners *mesh, size_t n_vertices,
                            const iccp_memory *memory)
{
    *fans = (iccp_fans){.n = n_vertices};
    fans->corner = iccp_alloc(memory, n_vertices, sizeof *fans->corner);
    fans->first = iccp_alloc_zero(memory, n_vertices + 1, sizeof *fans->first);
    if (fans->corner != NULL && fans->first != NULL) {
        count(fans, mesh);
        fans->begin = iccp_alloc(memory, fans->first[n_vertices], sizeof *fans->begin);
        fans->start = iccp_alloc(memory, fans->first[n_vertices], sizeof *fans->start);
    }
    if (fans->begin == NULL || fans->start == NULL) {
        iccp_fans_free(fans, memory);
        return ICC_ERR_MEMORY;
    }
    memset(fans->start, 0xff, fans->first[n_vertices] * sizeof *fans->start);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t v = mesh->vertex[c];
        if (fans->first[v] == fans->first[v + 1] || !begins_fan(mesh, c))
            continue;
        uint32_t fan = fans->first[v];
        while (fans->start[fan] != NONE)
            ++fan;
        fans->start[fan] = c;
        fans->begin[fan] = mesh->vertex[iccp_after(c)];
    }
    return ICC_OK;
}

void iccp_fans_free(iccp_fans *fans, const iccp_memory *memory)
{
    iccp_free(memory, fans->corner);
    iccp_free(memory, fans->first);
    iccp_free(memory, fans->begin);
    iccp_free(memory, fans->start);
    *fans = (iccp_fans){0};
}

void iccp_fans_note(iccp_fans *fans, const iccp_corners *mesh, uint32_t corner)
{
    const uint32_t v = mesh->vertex[corner];
    fans->corner[v] = corner;
    if (v >= fans->n || !begins_fan(mesh, corner))
        return;
    for (uint32_t fan = fans->first[v]; fan < fans->first[v + 1]; ++fan)
        if (fans->begin[fan] == mesh->vertex[iccp_after(corner)])
            fans->start[fan] = corner;
}

iccp_turn iccp_turn_begin(const iccp_fans *fans, const iccp_corners *mesh, uint32_t vertex)
{
    const uint32_t begin = fans->corner[vertex];
    if (begin == NONE)
        return (iccp_turn){.corner = NONE};
    if (vertex < fans->n && fans->first[vertex] < fans->first[vertex + 1]) {
        const uint32_t fan = fans->first[vertex];
        return (iccp_turn){fans->start[fan], fans->start[fan], fan, fans->first[vertex + 1]};
    }
    uint32_t first = begin, twin;
    while ((twin = mesh->twin[iccp_before(first)]) != NONE && iccp_before(twin) != begin)
        first = iccp_before(twin);
    if (twin != NONE)
        first = begin;
    return (iccp_turn){first, first, 0, 0};
}

uint32_t iccp_fans_edge(const iccp_fans *fans, const iccp_corners *mesh, uint32_t a, uint32_t b)
{
    iccp_turn turn = iccp_turn_begin(fans, mesh, a);
    for (; turn.corner != NONE; iccp_turn_next(&turn, fans, mesh)) {
        const bool is_first = mesh->vertex[iccp_after(turn.corner)] == b;
        if (!is_first && mesh->vertex[iccp_before(turn.corner)] != b)
            continue;
        const uint32_t facing = is_first ? iccp_before(turn.corner) : iccp_after(turn.corner);
        const uint32_t twin = mesh->twin[facing];
        return twin < facing ? twin : facing;
    }
    return NONE;
}
