/* Finds independent subtrees of a factor. Source: A. Pothen, C. Sun, A mapping algorithm for
 * parallel sparse Cholesky factorization, SIAM J. Sci. Comput. 14, 1993, in its simplest form: the
 * largest subtrees that take no more than a share of the whole. In a postorder they are runs of
 * supernodes. */
#include "math/subtrees.h"

#include <stdbool.h>

#define NONE ICCP_NO_PARENT

/* Least cost of a run, as a share of the whole. */
static const double LEAST = 1.0 / 512;

/* Appends a run if it is large enough. */
static void add_run(iccp_subtrees *t, uint32_t begin, uint32_t end, double cost, double least)
{
    if (cost < least)
        return;
    t->run[t->n++] = (iccp_subtrees_run){begin, end};
    t->labour += cost;
}

/* Finds the runs. below[s] is the cost of supernode s and its descendants, and a run may cost
 * `most`. A run ends before a supernode whose subtree costs too much, and at the root of a subtree
 * that makes the run large enough. It also ends where a run of `outer` begins or ends. */
static void find_runs(iccp_subtrees *t, const iccp_supernodes *nodes, const iccp_subtrees *outer,
                      const double *below, double most, double least)
{
    uint32_t begin = 0;
    double cost = 0;
    for (uint32_t s = 0, k = 0; s < nodes->n; ++s) {
        const uint32_t parent = nodes->parent[s];
        const bool is_root = parent == NONE || below[parent] > most;
        while (outer != NULL && k < outer->n && outer->run[k].end <= s)
            ++k;
        const bool is_edge = outer != NULL && ((k > 0 && outer->run[k - 1].end == s) ||
                                               (k < outer->n && outer->run[k].begin == s));
        if (is_edge || below[s] > most) {
            add_run(t, begin, s, cost, least);
            begin = below[s] > most ? s + 1 : s;
            cost = 0;
        }
        if (below[s] > most || !is_root)
            continue;
        cost += below[s];
        if (cost > most / 2) {
            add_run(t, begin, s + 1, cost, least);
            begin = s + 1;
            cost = 0;
        }
    }
    add_run(t, begin, (uint32_t)nodes->n, cost, least);
}

icc_status iccp_subtrees_create(iccp_subtrees *subtrees, const iccp_supernodes *nodes, double share,
                                const iccp_subtrees *outer,
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
        find_runs(subtrees, nodes, outer, below, share * all, LEAST * all);
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
