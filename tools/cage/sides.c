/* Sorts the sides by their ends. */
#include "cage/sides.h"

#include "base/allocate.h"

#include <stdlib.h>

static int by_ends(const void *a, const void *b)
{
    const side *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

sides sides_make(const cage *c)
{
    sides s = {.n = 3 * c->n_facets, .all = need(3 * c->n_facets, sizeof *s.all)};
    for (size_t i = 0; i < s.n; i++) {
        const uint32_t *face = c->facets + i / 3 * 3;
        uint32_t a = face[i % 3], b = face[(i + 1) % 3];
        s.all[i] = (side){a < b ? a : b, a < b ? b : a, (uint32_t)(i / 3), (uint32_t)(i % 3)};
    }
    qsort(s.all, s.n, sizeof *s.all, by_ends);
    return s;
}

void sides_free(sides *s)
{
    free(s->all);
    *s = (sides){0};
}

size_t sides_alike(const sides *s, size_t i)
{
    size_t end = i + 1;
    while (end < s->n && s->all[end].low == s->all[i].low && s->all[end].high == s->all[i].high)
        end++;
    return end - i;
}

static int by_ends_only(const void *a, const void *b)
{
    const side *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    return x->high < y->high ? -1 : x->high > y->high;
}

bool sides_have(const sides *s, uint32_t a, uint32_t b)
{
    side wanted = {.low = a < b ? a : b, .high = a < b ? b : a};
    return s->n > 0 && bsearch(&wanted, s->all, s->n, sizeof *s->all, by_ends_only) != NULL;
}

bool side_rises(const cage *c, const side *at)
{
    return c->facets[3 * (size_t)at->face + at->k] == at->low;
}
