/* Grows cousin trees. Based on: L. Huynh, Bijective Deformations in R^n via Integral Curve
 * Coordinates, thesis, 2013, section 4.2, Algorithm 2; the paper's form: Huynh and Gingold, section
 * 5.2.
 *
 * All of a generation expands along the first axis, then all of it along the second, and so on. No
 * outside vertex has a child inside, so the tree inside does not depend on the outside. It grows
 * first. Then outside vertices are added, again generation by generation. In the paper's form they
 * get no parent.
 *
 * One step differs from the thesis' pseudocode. There an outside vertex may reach the far side of a
 * gap two cells wide before the inside does. The vertex that it reaches then lies higher than its
 * inside neighbours, against the purpose of this layer. Here a neighbour of the inside waits for
 * the inside. If vertices inside and outside compete for one between them, the inside vertex
 * becomes its parent. */
#include "gradient/tree/cousin.h"

#include "base/error.h"

#include <assert.h>

static void visit(icc_tree *tree, uint32_t from, uint32_t vertex)
{
    tree->generation[vertex] = tree->generation[from] + 1;
    if (tree->grid->inside[vertex] || tree->form == ICC_TREE_THESIS)
        tree->parent[vertex] = from;
    tree->order[tree->n_reached++] = vertex;
}

/* Returns the generation that the inside gives to an outside vertex, or INT32_MAX. */
static int32_t generation_due(const icc_tree *tree, uint32_t vertex)
{
    int32_t due = INT32_MAX;
    for (int32_t k = 0; k < tree->grid->dim; ++k)
        for (int32_t step = -1; step <= 1; step += 2) {
            const uint32_t u = iccp_grid_neighbour(tree->grid, vertex, k, step);
            if (u != ICCP_NONE && tree->grid->inside[u] && tree->generation[u] >= 0 &&
                tree->generation[u] < due)
                due = tree->generation[u] + 1;
        }
    return due;
}

/* Expands the generation order[begin..end) along one axis into the inside. With given parents, a
 * vertex expands only to its children. */
static void expand_inside(icc_tree *tree, size_t begin, size_t end, int32_t axis,
                          const uint32_t *parents)
{
    for (size_t i = begin; i < end; ++i)
        for (int32_t step = -1; step <= 1; step += 2) {
            const uint32_t v = tree->order[i];
            const uint32_t u = iccp_grid_neighbour(tree->grid, v, axis, step);
            if (u != ICCP_NONE && tree->grid->inside[u] && tree->generation[u] < 0 &&
                (parents == NULL || parents[u] == v))
                visit(tree, v, u);
        }
}

/* Returns true if an outside vertex may expand into another one: not ahead of the inside. */
static bool may_reach(const icc_tree *tree, uint32_t from, uint32_t vertex)
{
    const int32_t due = generation_due(tree, vertex);
    return due == INT32_MAX || due == tree->generation[from] + 1;
}

/* Expands a generation along one axis into the outside. Outside vertices expand only next to the
 * inside. */
static void expand_outside(icc_tree *tree, size_t begin, size_t end, int32_t axis)
{
    for (size_t i = begin; i < end; ++i) {
        const uint32_t v = tree->order[i];
        const bool inside = tree->grid->inside[v];
        if (!inside && generation_due(tree, v) == INT32_MAX)
            continue;
        for (int32_t step = -1; step <= 1; step += 2) {
            const uint32_t u = iccp_grid_neighbour(tree->grid, v, axis, step);
            if (u != ICCP_NONE && !tree->grid->inside[u] && tree->generation[u] < 0 &&
                (inside || may_reach(tree, v, u)))
                visit(tree, v, u);
        }
    }
}

/* Returns the end of the vertices of one generation that begin at order[begin]. There may be
 * none. */
static size_t end_of(const icc_tree *tree, size_t begin, size_t limit, int32_t generation)
{
    size_t end = begin;
    while (end < limit && tree->generation[tree->order[end]] == generation)
        ++end;
    return end;
}

/* Reports progress when `done` reaches `*next`. */
static icc_status report(const icc_tree *tree, size_t done, size_t *next, const iccp_env *env)
{
    if (done < *next)
        return ICC_OK;
    *next = done + ICCP_VERTICES_PER_REPORT;
    return iccp_progress(env, "tree", 0.5 * (double)done / (double)tree->grid->n_vertices);
}

static icc_status grow_inside(icc_tree *tree, const uint32_t *parents, const iccp_env *env)
{
    size_t next_report = 0, begin = 0;
    tree->generation[tree->root] = 0;
    tree->order[tree->n_reached++] = tree->root;
    while (begin < tree->n_reached) {
        if (report(tree, begin, &next_report, env) != ICC_OK)
            return ICC_ERR_CANCELLED;
        const size_t end = tree->n_reached;
        for (int32_t a = 0; a < tree->grid->dim; ++a)
            expand_inside(tree, begin, end, tree->axis_order[a], parents);
        begin = end;
    }
    tree->n_inside = tree->n_reached;
    return ICC_OK;
}

/* Goes through the inside again, and through outside vertices as they are found. */
static icc_status grow_outside(icc_tree *tree, const iccp_env *env)
{
    size_t next_report = 0, in = 0, out = tree->n_inside;
    for (int32_t generation = 0; in < tree->n_inside || out < tree->n_reached; ++generation) {
        if (report(tree, tree->n_inside + in, &next_report, env) != ICC_OK)
            return ICC_ERR_CANCELLED;
        const size_t in_end = end_of(tree, in, tree->n_inside, generation);
        const size_t out_end = end_of(tree, out, tree->n_reached, generation);
        for (int32_t a = 0; a < tree->grid->dim; ++a) {
            expand_outside(tree, in, in_end, tree->axis_order[a]);
            expand_outside(tree, out, out_end, tree->axis_order[a]);
        }
        in = in_end;
        out = out_end;
    }
    return ICC_OK;
}

/* Makes a tree without visited vertices. */
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

/* Checks that the tree reaches all vertices that were given a parent. */
static icc_status check_parents(const icc_tree *tree, const uint32_t *parents, icc_error *err)
{
    if (parents[tree->root] != ICCP_NONE)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, tree->root,
                            "the root, vertex %lu, has a parent: give it UINT32_MAX",
                            (unsigned long)tree->root);
    for (uint32_t v = 0; v < tree->grid->n_vertices; ++v)
        if (tree->grid->inside[v] && parents[v] != ICCP_NONE && tree->generation[v] < 0)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, v,
                                "the parents of vertex %lu do not lead to the root: each must be "
                                "a neighbour inside",
                                (unsigned long)v);
    return ICC_OK;
}

icc_status iccp_tree_create_parents(icc_tree **out, const icc_grid *grid, uint32_t root,
                                    const uint32_t *parents, int32_t form,
                                    const int32_t *axis_order, const iccp_env *env, icc_error *err)
{
    assert(root < grid->n_vertices && grid->inside[root]);
    *out = NULL;
    icc_tree *tree = new_tree(grid, &env->memory);
    if (tree == NULL)
        return iccp_fail_memory(err);
    tree->root = root;
    tree->form = form;
    tree->is_given = parents != NULL;
    for (int32_t k = 0; k < grid->dim; ++k)
        tree->axis_order[k] = axis_order != NULL ? axis_order[k] : k;
    icc_status status = grow_inside(tree, parents, env);
    if (status == ICC_OK && parents != NULL)
        status = check_parents(tree, parents, err);
    if (status == ICC_OK)
        status = grow_outside(tree, env);
    if (status != ICC_OK) {
        iccp_tree_release(tree);
        return status;
    }
    *out = tree;
    return ICC_OK;
}

icc_status iccp_tree_create(icc_tree **out, const icc_grid *grid, uint32_t root, int32_t form,
                            const int32_t *axis_order, const iccp_env *env, icc_error *err)
{
    return iccp_tree_create_parents(out, grid, root, NULL, form, axis_order, env, err);
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
