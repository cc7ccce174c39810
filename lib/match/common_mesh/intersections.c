/* Finds triangles that intersect, with a tree of boxes. */
#include "match/common_mesh/intersections.h"

#include "domain/simplicial.h"
#include "geometry/facet_tree.h"
#include "geometry/triangles.h"

/* Marks the corners of triangles that meet others or have no area. Returns true if there are
 * any. */
static bool mark(const iccp_facet_tree *tree, uint8_t *is_bad)
{
    bool any = false;
    for (size_t place = 0; place < tree->n; ++place) {
        const uint32_t f = iccp_facet_at(tree, place);
        const uint32_t *const s = tree->facets + 3 * (size_t)f;
        iccp_facet_query query;
        uint32_t g = f;
        if (!iccp_simplicial_has_area(tree, f)) {
            any = true;
            is_bad[s[0]] = is_bad[s[1]] = is_bad[s[2]] = 1;
            continue;
        }
        iccp_facet_query_start_after(&query, tree, place);
        while (iccp_facet_query_next(&query, &g)) {
            const uint32_t *const t = tree->facets + 3 * (size_t)g;
            if (!iccp_simplicial_has_area(tree, g) || !iccp_triangles_meet(tree->vertices, s, t))
                continue;
            any = true;
            for (int i = 0; i < 3; ++i)
                is_bad[s[i]] = is_bad[t[i]] = 1;
        }
    }
    return any;
}

bool iccp_intersections_mark(uint8_t *is_bad, bool *any, const iccp_common_surface *c,
                             const iccp_memory *memory)
{
    bool has_memory = true;
    for (int side = 0; side < 2 && has_memory; ++side) {
        iccp_facet_tree tree;
        iccp_facet_tree_create(&tree, 3, c->x[side], c->n_faces, c->faces, memory);
        has_memory = tree.boxes != NULL;
        if (has_memory && mark(&tree, is_bad))
            *any = true;
        iccp_facet_tree_free(&tree, memory);
    }
    return has_memory;
}
