/* Lists edges and faces of tetrahedra by counting sorts. */
#include "map/topology/region_cells.h"

#include "base/sort.h"
#include "geometry/tuples.h"

#include <string.h>

/* The place of the edge between corners p < q among the six of a tetrahedron: 01, 02, 03, 12, 13,
 * 23. */
static uint32_t edge_place(uint32_t p, uint32_t q)
{
    return p == 0 ? q - 1 : p + q;
}

static size_t count_cells(const iccp_region *region, size_t *n_faces)
{
    size_t n = 0;
    *n_faces = 0;
    for (size_t s = 0; s < region->mesh->n_simplices; ++s) {
        if (!iccp_region_has(region, s))
            continue;
        ++n;
        for (size_t i = 4 * s; i < 4 * s + 4; ++i)
            *n_faces += iccp_region_ends(region, i) || region->mesh->across[i] > i;
    }
    return n;
}

/* Numbers the edges. edge_of[6 n + k] is edge k of the region's n-th tetrahedron. */
static icc_status number_edges(iccp_region_cells *cells, uint32_t *edge_of,
                               const iccp_region *region, size_t n_cells)
{
    iccp_tuples pairs;
    if (iccp_tuples_create(&pairs, 6 * n_cells, 2, cells->n_vertices, &cells->memory) != ICC_OK)
        return ICC_ERR_MEMORY;
    uint32_t *at = pairs.vertices;
    for (size_t s = 0; s < region->mesh->n_simplices; ++s) {
        const uint32_t *v = region->mesh->corners + 4 * s;
        for (size_t p = 0; p < 3 && iccp_region_has(region, s); ++p)
            for (size_t q = p + 1; q < 4; ++q, at += 2) {
                at[0] = v[p] < v[q] ? v[p] : v[q];
                at[1] = v[p] < v[q] ? v[q] : v[p];
            }
    }
    iccp_tuples_sort(&pairs);
    for (size_t k = 0; k < pairs.n; ++cells->n_edges)
        for (const size_t end = iccp_tuples_end(&pairs, k); k < end; ++k)
            edge_of[pairs.order[k]] = (uint32_t)cells->n_edges;
    cells->ends = iccp_alloc(&cells->memory, cells->n_edges, 2 * sizeof *cells->ends);
    for (size_t k = 0; cells->ends != NULL && k < pairs.n; ++k)
        memcpy(cells->ends + 2 * (size_t)edge_of[k], pairs.vertices + 2 * k,
               2 * sizeof *cells->ends);
    iccp_tuples_free(&pairs);
    return cells->ends != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Writes the edges of the face opposite corner i in the order ab, bc, ac of its vertices. */
static void order_edges(uint32_t *face_edges, const uint32_t *corners, const uint32_t *edges,
                        size_t i)
{
    uint32_t corner[3], n = 0;
    for (uint32_t k = 0; k < 4; ++k) {
        if (k == i)
            continue;
        uint32_t at = n++;
        for (; at > 0 && corners[corner[at - 1]] > corners[k]; --at)
            corner[at] = corner[at - 1];
        corner[at] = k;
    }
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t p = corner[k == 1 ? 1 : 0], q = corner[k == 0 ? 1 : 2];
        face_edges[k] = edges[p < q ? edge_place(p, q) : edge_place(q, p)];
    }
}

static void number_faces(iccp_region_cells *cells, const uint32_t *edge_of,
                         const iccp_region *region)
{
    const iccp_simplices *mesh = region->mesh;
    size_t f = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        if (!iccp_region_has(region, s))
            continue;
        for (size_t i = 0; i < 4; ++i) {
            const uint32_t across = mesh->across[4 * s + i];
            const bool ends = iccp_region_ends(region, 4 * s + i);
            if (!ends && across < 4 * s + i)
                continue;
            order_edges(cells->face_edges + 3 * f, mesh->corners + 4 * s, edge_of, i);
            cells->face_sides[2 * f] = (uint32_t)s;
            cells->face_sides[2 * f + 1] = ends ? ICCP_OUTSIDE : across / 4;
            ++f;
        }
        edge_of += 6;
    }
}

/* Makes all arrays but `ends`, which is there. */
static icc_status list_faces(iccp_region_cells *c, const uint32_t *edge_of,
                             const iccp_region *region)
{
    const iccp_memory *memory = &c->memory;
    c->face_edges = iccp_alloc(memory, c->n_faces, 3 * sizeof *c->face_edges);
    c->face_sides = iccp_alloc(memory, c->n_faces, 2 * sizeof *c->face_sides);
    c->at_edge = iccp_alloc(memory, c->n_faces, 3 * sizeof *c->at_edge);
    c->face_first = iccp_alloc_zero(memory, c->n_edges + 1, sizeof *c->face_first);
    c->at_vertex = iccp_alloc(memory, c->n_edges, 2 * sizeof *c->at_vertex);
    c->edge_first = iccp_alloc_zero(memory, c->n_vertices + 1, sizeof *c->edge_first);
    if (c->face_edges == NULL || c->face_sides == NULL || c->at_edge == NULL ||
        c->face_first == NULL || c->at_vertex == NULL || c->edge_first == NULL)
        return ICC_ERR_MEMORY;
    number_faces(c, edge_of, region);
    iccp_list_groups(c->at_edge, c->face_first, c->n_edges, c->face_edges, c->n_faces, 3);
    iccp_list_groups(c->at_vertex, c->edge_first, c->n_vertices, c->ends, c->n_edges, 2);
    return ICC_OK;
}

icc_status iccp_region_cells_create(iccp_region_cells *cells, const iccp_region *region,
                                    const iccp_memory *memory)
{
    *cells = (iccp_region_cells){.memory = *memory,
                                 .n_simplices = region->mesh->n_simplices,
                                 .n_vertices = region->mesh->n_points};
    const size_t n_cells = count_cells(region, &cells->n_faces);
    uint32_t *edge_of = iccp_alloc(memory, n_cells, 6 * sizeof *edge_of);
    icc_status status =
        edge_of != NULL ? number_edges(cells, edge_of, region, n_cells) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = list_faces(cells, edge_of, region);
    iccp_free(memory, edge_of);
    if (status != ICC_OK)
        iccp_region_cells_free(cells);
    return status;
}

void iccp_region_cells_free(iccp_region_cells *cells)
{
    const iccp_memory memory = cells->memory;
    iccp_free(&memory, cells->ends);
    iccp_free(&memory, cells->face_edges);
    iccp_free(&memory, cells->face_sides);
    iccp_free(&memory, cells->face_first);
    iccp_free(&memory, cells->at_edge);
    iccp_free(&memory, cells->edge_first);
    iccp_free(&memory, cells->at_vertex);
    *cells = (iccp_region_cells){.memory = memory};
}

size_t iccp_region_edge(const iccp_region_cells *cells, uint32_t a, uint32_t b)
{
    size_t low = 0, high = cells->n_edges;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const uint32_t *ends = cells->ends + 2 * middle;
        if (ends[0] < a || (ends[0] == a && ends[1] < b))
            low = middle + 1;
        else
            high = middle;
    }
    const uint32_t *ends = cells->ends + 2 * low;
    return low < cells->n_edges && ends[0] == a && ends[1] == b ? low : cells->n_edges;
}
