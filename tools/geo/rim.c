/* The middle of a side of the rim is on the boundary, and that of a side inside is inside. Sides of
 * several rings have equal ends. */
#include "geo/rim.h"

#include "base/allocate.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct side {
    const double *ends[2]; /* the lower one first */
    uint32_t facet;
    bool turned; /* the facet runs from the upper end to the lower */
} side;

static int by_place(const double *p, const double *q)
{
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return (p[1] > q[1]) - (p[1] < q[1]);
}

static int by_ends(const void *a, const void *b)
{
    const side *p = a, *q = b;
    int order = by_place(p->ends[0], q->ends[0]);
    if (order == 0)
        order = by_place(p->ends[1], q->ends[1]);
    return order != 0 ? order : (p->facet > q->facet) - (p->facet < q->facet);
}

static side side_of(const double *vertices, const uint32_t *facets, uint32_t i)
{
    const double *a = vertices + 2 * (size_t)facets[2 * i],
                 *b = vertices + 2 * (size_t)facets[2 * i + 1];
    bool turned = by_place(b, a) < 0;
    return (side){{turned ? b : a, turned ? a : b}, i, turned};
}

/* Numbers the sides, whose duplicates are neighbours, in the order of their first facets. */
static void number_sides(rim *r, size_t n, const side *sides, size_t n_facets)
{
    for (size_t i = 0; i < n; i++) {
        const side *s = &sides[i], *first = s;
        while (first > sides && by_place(first[-1].ends[0], s->ends[0]) == 0 &&
               by_place(first[-1].ends[1], s->ends[1]) == 0)
            first--;
        r->place[s->facet] = 2 * first->facet + (s->turned != first->turned);
    }
    for (uint32_t i = 0; i < n_facets; i++) {
        uint32_t first = r->place[i] / 2;
        if (r->place[i] == NOT_ON_RIM)
            continue;
        if (first == i)
            r->facets[r->n++] = i;
        r->place[i] =
            first == i ? 2 * (uint32_t)(r->n - 1) : (r->place[first] & ~1U) + (r->place[i] & 1);
    }
}

icc_status rim_find(rim *out, const icc_domain *domain, size_t n_facets, const double *vertices,
                    const uint32_t *facets, const icc_env *env)
{
    double *middle = need(n_facets, 2 * sizeof *middle);
    int32_t *where = need(n_facets, sizeof *where);
    side *sides = need(n_facets, sizeof *sides);
    size_t n = 0;
    *out = (rim){.facets = need(n_facets, sizeof *out->facets),
                 .place = need(n_facets, sizeof *out->place)};
    for (size_t i = 0; i < 2 * n_facets; i++) {
        const uint32_t *ends = facets + (i & ~(size_t)1);
        middle[i] =
            vertices[2 * (size_t)ends[0] + i % 2] / 2 + vertices[2 * (size_t)ends[1] + i % 2] / 2;
    }
    icc_status status = icc_domain_locate(domain, n_facets, middle, where, NULL, NULL, env);
    for (uint32_t i = 0; i < n_facets && status == ICC_OK; i++) {
        out->place[i] = NOT_ON_RIM;
        if (where[i] != ICC_INSIDE)
            sides[n++] = side_of(vertices, facets, i);
    }
    if (n > 0)
        qsort(sides, n, sizeof *sides, by_ends);
    if (status == ICC_OK)
        number_sides(out, n, sides, n_facets);
    free(middle);
    free(where);
    free(sides);
    return status;
}

void rim_free(rim *r)
{
    free(r->facets);
    free(r->place);
    *r = (rim){0};
}
