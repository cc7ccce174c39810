/* Tree and cotree of a surface.
 *
 * Source: D. Eppstein, Dynamic generators of topologically embedded graphs, 2003. A spanning tree
 * of the vertices, and a spanning tree of the faces across other edges, leave two edges for each
 * handle. Each of these edges and the tree's path between its ends form a loop. The loops are a
 * basis of the first homology. */
#include "map/topology/region_surface.h"

#include "base/sets.h"
#include "base/sort.h"
#include "geometry/tuples.h"

#include <string.h>

/* Lists the sides of the pairs, three for each face of the surface. */
static void list_pairs(iccp_tuples *pairs, const iccp_region *region)
{
    uint32_t *at = pairs->vertices, corner[3];
    for (size_t side = 0; side < 4 * region->mesh->n_simplices; ++side) {
        if (!iccp_region_has(region, side / 4) || !iccp_region_ends(region, side))
            continue;
        iccp_simplices_side(region->mesh, side, corner);
        for (size_t k = 0; k < 3; ++k, at += 2) {
            const uint32_t a = corner[k], b = corner[(k + 1) % 3];
            at[0] = a < b ? a : b;
            at[1] = a < b ? b : a;
        }
    }
}

static size_t count_faces(const iccp_region *region)
{
    size_t n = 0;
    for (size_t side = 0; side < 4 * region->mesh->n_simplices; ++side)
        n += iccp_region_has(region, side / 4) && iccp_region_ends(region, side);
    return n;
}

/* Lists edges with their ends and two faces. */
static icc_status list_edges(iccp_region_surface *s, uint32_t **faces, const iccp_region *region)
{
    iccp_tuples pairs;
    *faces = NULL;
    if (iccp_tuples_create(&pairs, 3 * s->n_faces, 2, s->n_vertices, &s->memory) != ICC_OK)
        return ICC_ERR_MEMORY;
    list_pairs(&pairs, region);
    iccp_tuples_sort(&pairs);
    for (size_t k = 0; k < pairs.n; k = iccp_tuples_end(&pairs, k))
        ++s->n_edges;
    s->ends = iccp_alloc(&s->memory, s->n_edges, 2 * sizeof *s->ends);
    uint32_t *to = *faces = iccp_alloc(&s->memory, s->n_edges, 2 * sizeof *to);
    const bool has_memory = s->ends != NULL && to != NULL;
    uint32_t *ends = s->ends;
    for (size_t k = 0, next; has_memory && k < pairs.n; k = next, ends += 2, to += 2) {
        next = iccp_tuples_end(&pairs, k);
        memcpy(ends, pairs.vertices + 2 * (size_t)pairs.order[k], 2 * sizeof *ends);
        to[0] = pairs.order[k] / 3;
        to[1] = pairs.order[next - 1] / 3;
    }
    iccp_tuples_free(&pairs);
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}

/* Reaches all vertices of one component along edges, breadth first. */
static void plant(iccp_region_surface *s, uint32_t root)
{
    size_t done = s->n_tree;
    s->tree[s->n_tree++] = root;
    s->component[root] = (uint32_t)s->n_components;
    s->root[s->n_components++] = root;
    for (; done < s->n_tree; ++done) {
        const uint32_t v = s->tree[done];
        for (size_t i = s->edge_first[v]; i < s->edge_first[v + 1]; ++i) {
            const uint32_t e = s->at_vertex[i], *ends = s->ends + 2 * (size_t)e;
            const uint32_t w = ends[0] == v ? ends[1] : ends[0];
            if (s->component[w] != ICCP_OUTSIDE)
                continue;
            s->component[w] = (uint32_t)s->n_components - 1;
            s->parent[w] = e;
            s->tree[s->n_tree++] = w;
        }
    }
}

static void plant_all(iccp_region_surface *s)
{
    for (size_t v = 0; v < s->n_vertices; ++v)
        s->component[v] = s->parent[v] = ICCP_OUTSIDE;
    for (uint32_t v = 0; v < s->n_vertices; ++v)
        if (s->edge_first[v] < s->edge_first[v + 1] && s->component[v] == ICCP_OUTSIDE)
            plant(s, v);
}

/* Joins faces across the edges that are not in the tree. An edge between faces that are joined
 * already has a loop. Loops are sorted by component, as trees are. */
static void find_loops(iccp_region_surface *s, const uint32_t *faces, uint32_t *sets,
                       uint32_t *has_loop)
{
    size_t n = 0;
    iccp_sets_begin(sets, s->n_faces);
    for (size_t e = 0; e < s->n_edges; ++e) {
        const uint32_t *ends = s->ends + 2 * e;
        const bool in_tree = s->parent[ends[0]] == e || s->parent[ends[1]] == e;
        has_loop[e] = !in_tree && !iccp_sets_join(sets, faces[2 * e], faces[2 * e + 1]);
    }
    for (size_t i = 0, c = 0; i < s->n_tree; ++i) {
        const uint32_t v = s->tree[i];
        for (; c <= s->component[v]; ++c)
            s->loop_first[c] = (uint32_t)n;
        for (size_t k = s->edge_first[v]; k < s->edge_first[v + 1]; ++k)
            if (has_loop[s->at_vertex[k]] && s->ends[2 * (size_t)s->at_vertex[k]] == v)
                s->loops[n++] = s->at_vertex[k];
    }
    s->loop_first[s->n_components] = (uint32_t)n;
}

static icc_status make_graph(iccp_region_surface *s)
{
    const iccp_memory *memory = &s->memory;
    s->at_vertex = iccp_alloc(memory, s->n_edges, 2 * sizeof *s->at_vertex);
    s->edge_first = iccp_alloc_zero(memory, s->n_vertices + 1, sizeof *s->edge_first);
    s->tree = iccp_alloc(memory, s->n_vertices, sizeof *s->tree);
    s->parent = iccp_alloc(memory, s->n_vertices, sizeof *s->parent);
    s->component = iccp_alloc(memory, s->n_vertices, sizeof *s->component);
    s->root = iccp_alloc(memory, s->n_vertices, sizeof *s->root);
    s->loops = iccp_alloc(memory, s->n_edges, sizeof *s->loops);
    s->loop_first = iccp_alloc(memory, s->n_vertices + 1, sizeof *s->loop_first);
    if (s->at_vertex == NULL || s->edge_first == NULL || s->tree == NULL || s->parent == NULL ||
        s->component == NULL || s->root == NULL || s->loops == NULL || s->loop_first == NULL)
        return ICC_ERR_MEMORY;
    iccp_list_groups(s->at_vertex, s->edge_first, s->n_vertices, s->ends, s->n_edges, 2);
    plant_all(s);
    return ICC_OK;
}

icc_status iccp_region_surface_create(iccp_region_surface *surface, const iccp_region *region,
                                      const iccp_memory *memory)
{
    iccp_region_surface *s = surface;
    uint32_t *faces;
    *s = (iccp_region_surface){
        .memory = *memory, .n_vertices = region->mesh->n_points, .n_faces = count_faces(region)};
    icc_status status = list_edges(s, &faces, region);
    uint32_t *sets = iccp_alloc(memory, s->n_faces, sizeof *sets);
    uint32_t *has_loop = iccp_alloc(memory, s->n_edges, sizeof *has_loop);
    if (sets == NULL || has_loop == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = make_graph(s);
    if (status == ICC_OK)
        find_loops(s, faces, sets, has_loop);
    iccp_free(memory, faces);
    iccp_free(memory, sets);
    iccp_free(memory, has_loop);
    if (status != ICC_OK)
        iccp_region_surface_free(s);
    return status;
}

void iccp_region_surface_free(iccp_region_surface *surface)
{
    const iccp_memory memory = surface->memory;
    iccp_free(&memory, surface->ends);
    iccp_free(&memory, surface->edge_first);
    iccp_free(&memory, surface->at_vertex);
    iccp_free(&memory, surface->tree);
    iccp_free(&memory, surface->parent);
    iccp_free(&memory, surface->component);
    iccp_free(&memory, surface->loops);
    iccp_free(&memory, surface->loop_first);
    iccp_free(&memory, surface->root);
    *surface = (iccp_region_surface){.memory = memory};
}
