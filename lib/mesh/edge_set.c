/* A sorted list of edges. */
#include "mesh/edge_set.h"

#include "base/sort.h"

static int compare(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    const int k = p[0] == q[0];
    return (p[k] > q[k]) - (p[k] < q[k]);
}

icc_status iccp_edge_set_add(iccp_edge_set *set, size_t n, const uint32_t *ends)
{
    const size_t all = set->n + n;
    size_t kept = 0;
    if (n == 0)
        return ICC_OK;
    if (!iccp_enlarge(&set->memory, &set->ends, 2 * set->n, 2 * all, sizeof *set->ends))
        return ICC_ERR_MEMORY;
    uint32_t *own = set->ends;
    for (size_t k = 0; k < n; ++k) {
        const uint32_t a = ends[2 * k], b = ends[2 * k + 1];
        own[2 * (set->n + k)] = a < b ? a : b;
        own[2 * (set->n + k) + 1] = a < b ? b : a;
    }
    iccp_sort(own, all, 2 * sizeof *own, compare);
    for (size_t k = 0; k < all; ++k)
        if (kept == 0 || compare(own + 2 * (kept - 1), own + 2 * k) != 0)
            memmove(own + 2 * kept++, own + 2 * k, 2 * sizeof *own);
    set->n = kept;
    return ICC_OK;
}

void iccp_edge_set_free(iccp_edge_set *set)
{
    const iccp_memory memory = set->memory;
    iccp_free(&memory, set->ends);
    *set = (iccp_edge_set){.memory = memory};
}

bool iccp_edge_set_has(const iccp_edge_set *set, uint32_t a, uint32_t b)
{
    const uint32_t edge[2] = {a < b ? a : b, a < b ? b : a};
    size_t low = 0, high = set != NULL ? set->n : 0;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        const int order = compare(set->ends + 2 * middle, edge);
        if (order == 0)
            return true;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return false;
}
