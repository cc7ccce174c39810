/* Sorts both lists by keys, then goes through them side by side. */
#include "match/coverage/alike.h"

#include "base/sort.h"

#include <stdbool.h>
#include <string.h>

/* Orders two keys: the shorter one first, then word by word. */
static int compare(const iccp_alikes *a, size_t i, const iccp_alikes *b, size_t j)
{
    const iccp_alike *const p = &a->item[i], *const q = &b->item[j];
    if (p->n != q->n)
        return p->n < q->n ? -1 : 1;
    for (uint32_t k = 0; k < p->n; ++k) {
        const uint32_t x = a->word[p->first + k], y = b->word[q->first + k];
        if (x != y)
            return x < y ? -1 : 1;
    }
    return 0;
}

static bool is_before(const void *context, uint32_t i, uint32_t j)
{
    const iccp_alikes *const items = context;
    return compare(items, i, items, j) < 0;
}

icc_status iccp_alike_sort(iccp_alikes *items, const iccp_memory *memory)
{
    uint32_t *const order = iccp_alloc(memory, items->n, 2 * sizeof *order);
    iccp_alike *const sorted = iccp_alloc(memory, items->n, sizeof *sorted);
    const icc_status status = order != NULL && sorted != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (size_t k = 0; k < items->n; ++k)
            order[k] = (uint32_t)k;
        iccp_sort_indices(order, order + items->n, items->n, items, is_before);
        for (size_t k = 0; k < items->n; ++k)
            sorted[k] = items->item[order[k]];
        memcpy(items->item, sorted, items->n * sizeof *sorted);
    }
    iccp_free(memory, order);
    iccp_free(memory, sorted);
    return status;
}

/* Goes through both lists. Finds the next key that both have: items [at[0], end[0]) of a and
 * [at[1], end[1]) of b. */
static bool next_key(const iccp_alikes *a, const iccp_alikes *b, size_t *at, size_t *end)
{
    at[0] = end[0];
    at[1] = end[1];
    while (at[0] < a->n && at[1] < b->n) {
        const int order = compare(a, at[0], b, at[1]);
        if (order == 0)
            break;
        ++at[order < 0 ? 0 : 1];
    }
    if (at[0] >= a->n || at[1] >= b->n)
        return false;
    for (end[0] = at[0]; end[0] < a->n && compare(a, at[0], a, end[0]) == 0;)
        ++end[0];
    for (end[1] = at[1]; end[1] < b->n && compare(b, at[1], b, end[1]) == 0;)
        ++end[1];
    return true;
}

void iccp_alike_sure(uint32_t *partner, const iccp_alikes *a, const iccp_alikes *b)
{
    size_t at[2], end[2] = {0, 0};
    while (next_key(a, b, at, end))
        if (end[0] - at[0] == 1 && end[1] - at[1] == 1)
            partner[a->item[at[0]].spot.number] = b->item[at[1]].spot.number;
}

/* Pairs two groups of items with one key. `spot` has room for both, `found` for the smaller one. */
static icc_status settle(uint32_t *partner, const iccp_alike *a, size_t n, const iccp_alike *b,
                         size_t m, iccp_spot *spot, uint32_t *found, const iccp_env *env)
{
    for (size_t k = 0; k < n + m; ++k)
        spot[k] = k < n ? a[k].spot : b[k - n].spot;
    const bool is_first = n <= m;
    const icc_status status = is_first ? iccp_assign_some(found, spot, n, spot + n, m, env)
                                       : iccp_assign_some(found, spot + n, m, spot, n, env);
    for (size_t k = 0; k < (is_first ? n : m) && status == ICC_OK; ++k) {
        const size_t i = is_first ? k : found[k], j = is_first ? found[k] : k;
        partner[a[i].spot.number] = b[j].spot.number;
    }
    return status;
}

icc_status iccp_alike_settle(uint32_t *partner, const iccp_alikes *a, const iccp_alikes *b,
                             size_t *n_settled, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    size_t at[2], end[2] = {0, 0};
    iccp_spot *const spot = iccp_alloc(memory, a->n + b->n, sizeof *spot);
    uint32_t *const found = iccp_alloc(memory, a->n, sizeof *found);
    icc_status status = spot != NULL && found != NULL ? ICC_OK : ICC_ERR_MEMORY;
    while (status == ICC_OK && next_key(a, b, at, end)) {
        const size_t n = end[0] - at[0], m = end[1] - at[1];
        if (n == 1 && m == 1)
            continue;
        const iccp_env part =
            iccp_part(env, NULL, (double)at[0] / (double)a->n, (double)end[0] / (double)a->n);
        status = settle(partner, a->item + at[0], n, b->item + at[1], m, spot, found, &part);
        *n_settled += n < m ? n : m;
    }
    iccp_free(memory, spot);
    iccp_free(memory, found);
    return status;
}
