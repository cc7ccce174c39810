/* A. Pothen, C. Sun, A mapping algorithm for parallel sparse Cholesky factorization, SIAM J. Sci.
 * Comput. 14, 1993, in its simplest form: the largest subtrees that take no more than a share of
 * the whole. In a postorder they are runs of supernodes. */
#include "math/subtrees.h"

#include <stdbool.h>

#define NONE ICCP_NO_PARENT

/* Of the whole: what a run may take, about, and what it must take. */
static const double MOST = 1.0 / 16, LEAST = 1.0 / 512;

/* Appends a run if it is worth it. */
static void add_run(iccp_subtrees *t, uint32_t begin, uint32_t end, double cost, double least)
{
    if (cost < least)
        return;
    t->run[t->n++] = (iccp_subtrees_run){begin, end};
    t->labour += cost;
}

/* below[s]: what supernode s and its descendants take. A run ends before a supernode whose subtree
 * takes too much, and at the root of a subtree that makes the run large enough. */
static void find_runs(iccp_subtrees *t, const iccp_supernodes *nodes, const double *below,
                      double all)
{
    uint32_t begin = 0;
    double cost = 0;
    for (uint32_t s = 0; s < nodes->n; ++s) {
        const uint32_t parent = nodes->parent[s];
        if (below[s] > MOST * all) {
            add_run(t, begin, s, cost, LEAST * all);
            begin = s + 1;
            cost = 0;
        } else if (parent == NONE || below[parent] > MOST * all) {
            cost += below[s];
            if (cost > MOST * all / 2) {
                add_run(t, begin, s + 1, cost, LEAST * all);
                begin = s + 1;
                cost = 0;
            }
        }
    }
    add_run(t, begin, (uint32_t)nodes->n, cost, LEAST * all);
}

icc_status iccp_subtrees_create(iccp_subtrees *subtrees, const iccp_supernodes *nodes,
                                double (*cost)(const iccp_supernodes *nodes, size_t s),
                                const iccp_env *env)
{
    const size_t most = (size_t)(1 / LEAST) + 1;
    double *below = iccp_alloc_zero(&env->memory, nodes->n, sizeof *below), all = 0;
    *subtrees = (iccp_subtrees){0};
    subtrees->run = iccp_alloc(&env->memory, most, sizeof *subtrees->run);
    const bool ready = below != NULL && subtrees->run != NULL;
    for (size_t s = 0; ready && s < nodes->n; ++s) {
        const double own = cost(nodes, s);
        all += own;
        below[s] += own;
        if (nodes->parent[s] != NONE)
            below[nodes->parent[s]] += below[s];
    }
    if (ready)
        find_runs(subtrees, nodes, below, all);
    else
        iccp_subtrees_free(subtrees, &env->memory);
    iccp_free(&env->memory, below);
    return ready ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_subtrees_free(iccp_subtrees *subtrees, const iccp_memory *memory)
{
    iccp_free(memory, subtrees->run);
    *subtrees = (iccp_subtrees){0};
}
