/* Based on: L. Huynh, Bijective Deformations in R^n via Integral Curve Coordinates, thesis, 2013,
 * section 4.2, Algorithm 2; the paper's form: Huynh and Gingold, section 5.2.
 *
 * A generation expands along the first axis, all of it, then along the second, and so on. The two
 * forms differ in what becomes of the vertices outside. No vertex outside has a child inside, so
 * neither form's tree inside depends on them, and they are added afterwards, layer by layer.
 *
 * In the thesis' pseudocode a vertex outside may also reach another one across a gap that is two cells
 * wide, before the far side of the gap is reached from inside; that vertex would then lie higher than
 * its neighbours inside, against the purpose of the layer. Here the first layer hangs on the inside
 * only. */
#include "tree/cousin.h"

#include "base/error.h"

#include <assert.h>
#include <string.h>

static void visit(icc_tree *tree, uint32_t from, uint32_t vertex, bool inside)
{
    if (vertex == ICCP_NONE || tree->generation[vertex] >= 0 ||
        (tree->grid->inside[vertex] != 0) != inside)
        return;
    tree->generation[vertex] = tree->generation[from] + 1;
    if (inside || tree->form == ICC_TREE_THESIS)
        tree->parent[vertex] = from;
    tree->order[tree->n_reached++] = vertex;
}

/* One generation, order[begin..end), into its neighbours inside or into those outside. */
static void expand(icc_tree *tree, size_t begin, size_t end, bool inside)
{
    for (int32_t a = 0; a < tree->grid->dim; ++a) {
        const int32_t k = tree->axis_order[a];
        for (size_t i = begin; i < end; ++i) {
            const uint32_t v = tree->order[i];
            visit(tree, v, iccp_grid_neighbour(tree->grid, v, k, -1), inside);
            visit(tree, v, iccp_grid_neighbour(tree->grid, v, k, +1), inside);
        }
    }
}

/* Expands the vertices from order[begin] on, generation by generation: into the inside with all that
 * are found on the way, or into the outside by one layer. */
static icc_status spread(icc_tree *tree, size_t begin, bool inside, const iccp_env *env)
{
    const size_t n_first = tree->n_reached;
    size_t next_report = begin;
    while (begin < (inside ? tree->n_reached : n_first)) {
        if (begin >= next_report) {
            const double share = (double)begin / (double)tree->grid->n_vertices;
            if (iccp_progress(env, "tree", share) != ICC_OK)
                return ICC_ERR_CANCELLED;
            next_report = begin + ICCP_VERTICES_PER_REPORT;
        }
        const size_t limit = inside ? tree->n_reached : n_first;
        const int32_t generation = tree->generation[tree->order[begin]];
        size_t end = begin + 1;
        while (end < limit && tree->generation[tree->order[end]] == generation)
            ++end;
        expand(tree, begin, end, inside);
        begin = end;
    }
    return ICC_OK;
}

static icc_status grow(icc_tree *tree, const iccp_env *env)
{
    tree->generation[tree->root] = 0;
    tree->order[tree->n_reached++] = tree->root;
    icc_status status = spread(tree, 0, true, env);
    tree->n_inside = tree->n_reached;
    if (status == ICC_OK)
        status = spread(tree, 0, false, env);
    if (status == ICC_OK)
        status = spread(tree, tree->n_inside, false, env);
    return status;
}

/* No vertex visited yet. */
static icc_tree *new_tree(const icc_grid *grid, const iccp_memory *memory)
{
    icc_tree *tree = iccp_alloc_zero(memory, 1, sizeof *tree);
    if (tree == NULL)
        return NULL;
    const size_t n = grid->n_vertices;
    tree->memory = *memory;
    atomic_init(&tree->references, 1);
    tree->grid = iccp_grid_retain(grid);
    tree->parent = iccp_alloc(memory, n, sizeof *tree->parent);
    tree->generation = iccp_alloc(memory, n, sizeof *tree->generation);
    tree->order = iccp_alloc(memory, n, sizeof *tree->order);
    if (tree->parent == NULL || tree->generation == NULL || tree->order == NULL) {
        iccp_tree_release(tree);
        return NULL;
    }
    for (size_t v = 0; v < n; ++v) {
        tree->parent[v] = ICCP_NONE;
        tree->generation[v] = -1;
    }
    return tree;
}

icc_status iccp_tree_create(icc_tree **out, const icc_grid *grid, uint32_t root, int32_t form,
                            const int32_t *axis_order, const iccp_env *env, icc_error *err)
{
    assert(root < grid->n_vertices && grid->inside[root]);
    *out = NULL;
    icc_tree *tree = new_tree(grid, &env->memory);
    if (tree == NULL)
        return iccp_fail_memory(err);
    tree->root = root;
    tree->form = form;
    for (int32_t k = 0; k < grid->dim; ++k)
        tree->axis_order[k] = axis_order != NULL ? axis_order[k] : k;
    const icc_status status = grow(tree, env);
    if (status != ICC_OK) {
        iccp_tree_release(tree);
        return status;
    }
    *out = tree;
    return ICC_OK;
}

icc_tree *iccp_tree_retain(const icc_tree *tree)
{
    icc_tree *shared = (icc_tree *)tree;
    atomic_fetch_add_explicit(&shared->references, 1, memory_order_relaxed);
    return shared;
}

void iccp_tree_release(icc_tree *tree)
{
    if (tree == NULL || atomic_fetch_sub(&tree->references, 1) != 1)
        return;
    const iccp_memory memory = tree->memory;
    iccp_grid_release(tree->grid);
    iccp_free(&memory, tree->parent);
    iccp_free(&memory, tree->generation);
    iccp_free(&memory, tree->order);
    iccp_free(&memory, tree);
}
