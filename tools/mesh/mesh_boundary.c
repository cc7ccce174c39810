/* Sorts the facets of all elements by their vertices. */
#include "mesh/mesh_boundary.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

typedef struct facet {
    uint32_t sorted[3]; /* in the plane the last one is 0 */
    uint32_t corner;    /* the corner of its element that it does not contain */
    size_t element;
} facet;

/* The corners of each facet, by the corner that it does not contain. */
static const unsigned char sides[2][4][3] = {{{1, 2, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}},
                                             {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

static int by_vertices(const void *a, const void *b)
{
    const facet *p = a, *q = b;
    for (size_t k = 0; k < 3; k++)
        if (p->sorted[k] != q->sorted[k])
            return p->sorted[k] < q->sorted[k] ? -1 : 1;
    return p->element != q->element ? (p->element < q->element ? -1 : 1)
                                    : (p->corner > q->corner) - (p->corner < q->corner);
}

static bool is_same(const facet *a, const facet *b)
{
    return memcmp(a->sorted, b->sorted, sizeof a->sorted) == 0;
}

static facet make_facet(size_t dim, const uint32_t *elements, size_t element, size_t corner)
{
    facet f = {.element = element, .corner = (uint32_t)corner};
    for (size_t k = 0; k < dim; k++) {
        uint32_t v = elements[(dim + 1) * element + sides[dim - 2][corner][k]];
        size_t at = k;
        for (; at > 0 && f.sorted[at - 1] > v; at--)
            f.sorted[at] = f.sorted[at - 1];
        f.sorted[at] = v;
    }
    return f;
}

/* Moves the facets of only one element to the front and returns their number. */
static size_t keep_single(facet *all, size_t n, size_t *n_shared)
{
    size_t n_kept = 0;
    for (size_t i = 0, end; i < n; i = end) {
        for (end = i + 1; end < n && is_same(&all[i], &all[end]); end++)
            ;
        if (end == i + 1)
            all[n_kept++] = all[i];
        *n_shared += end > i + 2;
    }
    return n_kept;
}

void mesh_boundary_find(mesh_boundary *out, size_t dim, size_t n, const uint32_t *elements)
{
    facet *all = need(n, (dim + 1) * sizeof *all);
    for (size_t i = 0; i < n * (dim + 1); i++)
        all[i] = make_facet(dim, elements, i / (dim + 1), i % (dim + 1));
    qsort(all, n * (dim + 1), sizeof *all, by_vertices);
    *out = (mesh_boundary){.dim = dim};
    out->n = keep_single(all, n * (dim + 1), &out->n_shared);
    out->facets = need(out->n, dim * sizeof *out->facets);
    out->elements = need(out->n, sizeof *out->elements);
    for (size_t i = 0; i < out->n; i++) {
        out->elements[i] = all[i].element;
        for (size_t k = 0; k < dim; k++)
            out->facets[dim * i + k] =
                elements[(dim + 1) * all[i].element + sides[dim - 2][all[i].corner][k]];
    }
    free(all);
}

void mesh_boundary_free(mesh_boundary *b)
{
    free(b->facets);
    free(b->elements);
    *b = (mesh_boundary){0};
}

bool *mesh_boundary_vertices(const mesh_boundary *b, size_t n)
{
    bool *on = need(n, sizeof *on);
    for (size_t i = 0; i < b->n * b->dim; i++)
        on[b->facets[i]] = true;
    return on;
}
