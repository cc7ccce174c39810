/* Checks the cousin rule. Based on: L. Huynh and Y. Gingold, Bijective Deformations in R^n via
 * Integral Curve Coordinates, Definition 2: neighbours are parent and child, or their parents are
 * neighbours. */
#include "gradient/tree/verify.h"

#include "base/threads.h"

static const size_t GRAIN = 1 << 15; /* vertices per chunk */

/* The results of all chunks. */
typedef struct work {
    const icc_tree *tree;
    icc_tree_report *partial;
} work;

static bool adjacent(const icc_grid *grid, uint32_t a, uint32_t b)
{
    if (a == ICCP_NONE || b == ICCP_NONE)
        return false;
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    for (int32_t k = 0; k < grid->dim; ++k)
        if (high - low == grid->stride[k] && iccp_grid_neighbour(grid, low, k, +1) == high)
            return true;
    return false;
}

static bool related(const icc_tree *tree, uint32_t a, uint32_t b)
{
    return tree->parent[a] == b || tree->parent[b] == a ||
           adjacent(tree->grid, tree->parent[a], tree->parent[b]);
}

static bool in_tree(const icc_tree *tree, uint32_t v)
{
    return tree->grid->inside[v] && tree->generation[v] >= 0;
}

/* Counts each pair of neighbours from the vertex with the smaller coordinate, so every pair belongs
 * to one chunk. A chunk keeps the first of its violations. */
static icc_status check_pairs(void *argument, size_t begin, size_t end)
{
    const work *w = argument;
    const icc_tree *tree = w->tree;
    icc_tree_report report = {.violation = {ICCP_NONE, ICCP_NONE}};
    for (uint32_t v = (uint32_t)begin; v < end; ++v) {
        if (!in_tree(tree, v))
            continue;
        for (int32_t k = 0; k < tree->grid->dim; ++k) {
            const uint32_t other = iccp_grid_neighbour(tree->grid, v, k, +1);
            if (other == ICCP_NONE || !in_tree(tree, other))
                continue;
            ++report.n_pairs;
            if (!related(tree, v, other) && report.n_cousin_violations++ == 0) {
                report.violation[0] = v;
                report.violation[1] = other;
            }
        }
    }
    w->partial[begin / GRAIN] = report;
    return ICC_OK;
}

icc_status iccp_tree_verify(const icc_tree *tree, icc_tree_report *report, const iccp_env *env)
{
    const size_t n = tree->grid->n_vertices, n_chunks = (n + GRAIN - 1) / GRAIN;
    work w = {tree, iccp_alloc(&env->memory, n_chunks, sizeof *w.partial)};
    if (w.partial == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_for_chunks(env, "check", n, GRAIN, check_pairs, &w);
    if (status == ICC_OK) {
        report->n_inside = tree->n_inside;
        report->n_outside = tree->n_reached - tree->n_inside;
        report->n_unreachable = tree->grid->n_inside - tree->n_inside;
        report->n_pairs = report->n_cousin_violations = 0;
        report->violation[0] = report->violation[1] = ICCP_NONE;
        for (size_t c = n_chunks; c-- > 0;) {
            report->n_pairs += w.partial[c].n_pairs;
            report->n_cousin_violations += w.partial[c].n_cousin_violations;
            if (w.partial[c].n_cousin_violations > 0) {
                report->violation[0] = w.partial[c].violation[0];
                report->violation[1] = w.partial[c].violation[1];
            }
        }
    }
    iccp_free(&env->memory, w.partial);
    return status;
}
