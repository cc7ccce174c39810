#include "cage/weld.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

typedef struct place {
    double at[3];
    uint32_t vertex;
} place;

static int by_place(const void *a, const void *b)
{
    const place *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->at[k] != q->at[k])
            return p->at[k] < q->at[k] ? -1 : 1;
    return p->vertex < q->vertex ? -1 : 1;
}

static bool is_same_place(const place *p, const place *q)
{
    return p->at[0] == q->at[0] && p->at[1] == q->at[1] && p->at[2] == q->at[2];
}

/* The first vertex at the place of each. */
static uint32_t *find_first(const cage *c, size_t *n_later)
{
    place *places = need(c->n, sizeof *places);
    uint32_t *first = need(c->n, sizeof *first);
    for (size_t i = 0; i < c->n; i++) {
        memcpy(places[i].at, c->points + 3 * i, sizeof places[i].at);
        places[i].vertex = (uint32_t)i;
    }
    qsort(places, c->n, sizeof *places, by_place);
    *n_later = 0;
    for (size_t i = 0; i < c->n; i++) {
        bool later = i > 0 && is_same_place(&places[i - 1], &places[i]);
        first[places[i].vertex] = later ? first[places[i - 1].vertex] : places[i].vertex;
        *n_later += later;
    }
    free(places);
    return first;
}

size_t weld_count(const cage *c)
{
    size_t n = 0;
    if (c->dim == 3)
        free(find_first(c, &n));
    return n;
}

/* Faces with the new numbers of their corners. */
static void renumber(cage *c, const uint32_t *first, const uint32_t *numbers)
{
    size_t kept = 0;
    for (size_t i = 0; i < c->n_facets; i++) {
        uint32_t *to = c->facets + 3 * kept;
        for (size_t k = 0; k < 3; k++)
            to[k] = numbers[first[c->facets[3 * i + k]]];
        if (to[0] != to[1] && to[1] != to[2] && to[2] != to[0])
            c->facet_lines[kept++] = c->facet_lines[i];
    }
    c->n_facets = kept;
}

size_t weld(cage *c)
{
    size_t n_later, kept = 0;
    uint32_t *first = find_first(c, &n_later), *numbers = need(c->n, sizeof *numbers);
    for (size_t i = 0; i < c->n; i++) {
        if (first[i] != i)
            continue;
        memmove(c->points + 3 * kept, c->points + 3 * i, 3 * sizeof *c->points);
        c->lines[kept] = c->lines[i];
        numbers[i] = (uint32_t)kept++;
    }
    renumber(c, first, numbers);
    c->n = kept;
    free(first);
    free(numbers);
    return n_later;
}
