/* The shortest spanning tree of the edges between components: J. B. Kruskal, On the shortest
 * spanning subtree of a graph, 1956. */
#include "map/isotopy/edge_tree.h"

#include "base/sets.h"
#include "base/sort.h"

#include <string.h>

/* An edge between two components. */
typedef struct bridge {
    double length;
    uint32_t ends[2];
} bridge;

/* Shorter edges come first, then edges of smaller vertices. */
static int compare(const void *x, const void *y)
{
    const bridge *a = x, *b = y;
    if (a->length < b->length || a->length > b->length)
        return a->length < b->length ? -1 : 1;
    for (int k = 0; k < 2; ++k)
        if (a->ends[k] != b->ends[k])
            return a->ends[k] < b->ends[k] ? -1 : 1;
    return 0;
}

/* Lists each edge between two components once. */
static size_t list_bridges(bridge *bridges, const iccp_domain_pair *domains,
                           const iccp_corners *mesh)
{
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->vertex[iccp_after(c)], b = mesh->vertex[iccp_before(c)];
        if (a < b && b != UINT32_MAX && domains->component[a] != domains->component[b])
            bridges[n++] =
                (bridge){iccp_distance_between(domains->domain[0]->vertices, a, b), {a, b}};
    }
    return n;
}

icc_status iccp_edge_tree(iccp_cuts *tree, const iccp_domain_pair *domains,
                          const iccp_corners *mesh, const iccp_env *env)
{
    const size_t n = domains->n_cuts;
    bridge *bridges = iccp_alloc(&env->memory, 3 * mesh->n_triangles / 2 + 1, sizeof *bridges);
    uint32_t *leader = iccp_alloc(&env->memory, domains->n_components, sizeof *leader);
    size_t n_found = 0;
    icc_status status = iccp_cuts_begin(tree, n, &env->memory);
    if (bridges == NULL || leader == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        const size_t n_bridges = list_bridges(bridges, domains, mesh);
        iccp_sort(bridges, n_bridges, sizeof *bridges, compare);
        iccp_sets_begin(leader, domains->n_components);
        for (size_t k = 0; k < n_bridges && n_found < n; ++k) {
            const uint32_t *ends = bridges[k].ends;
            if (iccp_sets_join(leader, domains->component[ends[0]], domains->component[ends[1]]))
                memcpy(tree->ends + 2 * n_found++, ends, 2 * sizeof *ends);
        }
        status = n_found == n ? ICC_OK : ICC_ERR_TOPOLOGY;
    }
    iccp_free(&env->memory, bridges);
    iccp_free(&env->memory, leader);
    return status;
}
