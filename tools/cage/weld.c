/* Finds close vertices with a hash table of cubes. */
#include "cage/weld.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NONE = -1 };

/* Vertices that are kept, by cubes that are as wide as the tolerance. Without a tolerance, each
 * place is a cube. The vertices of a cube are chained. Cubes may share a chain. */
typedef struct cubes {
    const double *points;
    double width;
    size_t mask;
    int64_t *first, *next;
} cubes;

static cubes cubes_make(const cage *c, double tolerance)
{
    cubes x = {.points = c->points, .width = tolerance, .mask = 1};
    while (x.mask < c->n)
        x.mask = 2 * x.mask + 1;
    x.first = need(x.mask + 1, sizeof *x.first);
    x.next = need(c->n, sizeof *x.next);
    for (size_t i = 0; i <= x.mask; i++)
        x.first[i] = NONE;
    return x;
}

/* Adding 0 turns -0 into 0. */
static double cube_of(const cubes *x, double at)
{
    return x->width > 0 ? floor(at / x->width) : at + 0;
}

/* The chain of a cube. Multiples of the golden ratio mix the bits. */
static int64_t *chain(const cubes *x, const double cube[3])
{
    uint64_t mixed = 0;
    for (int k = 0; k < 3; k++) {
        uint64_t bits;
        memcpy(&bits, &cube[k], sizeof bits);
        mixed = (mixed ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
        mixed ^= mixed >> 32;
    }
    return &x->first[mixed & x->mask];
}

static bool is_near(const cubes *x, size_t i, size_t j)
{
    const double *p = x->points + 3 * i, *q = x->points + 3 * j;
    double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    if (!(x->width > 0))
        return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
    for (int k = 0; k < 3; k++)
        d[k] /= x->width;
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= 1;
}

/* The chain of the cube that lies `step` cubes from that of vertex i. */
static int64_t *chain_beside(const cubes *x, size_t i, const int step[3])
{
    double cube[3];
    for (int k = 0; k < 3; k++)
        cube[k] = cube_of(x, x->points[3 * i + (size_t)k]) + step[k] + 0.0;
    return chain(x, cube);
}

/* The first kept vertex close to vertex i, or NONE. It is in the same cube or in a neighbouring
 * one. */
static int64_t find_near(const cubes *x, size_t i)
{
    int64_t found = NONE;
    int reach = x->width > 0 ? 1 : 0, n = 2 * reach + 1;
    for (int s = 0; s < n * n * n; s++) {
        const int step[3] = {s % n - reach, s / n % n - reach, s / n / n - reach};
        for (int64_t j = *chain_beside(x, i, step); j != NONE; j = x->next[j])
            if (is_near(x, i, (size_t)j) && (found == NONE || j < found))
                found = j;
    }
    return found;
}

static void keep(cubes *x, size_t i)
{
    int64_t *first = chain_beside(x, i, (const int[3]){0, 0, 0});
    x->next[i] = *first;
    *first = (int64_t)i;
}

/* Finds what each vertex becomes: the first kept vertex close to it, or else itself. So kept
 * vertices are farther apart than the tolerance, and a cube has few of them. */
static uint32_t *find_first(const cage *c, double tolerance, size_t *n_later)
{
    uint32_t *first = need(c->n, sizeof *first);
    cubes x = cubes_make(c, tolerance);
    *n_later = 0;
    for (size_t i = 0; i < c->n; i++) {
        int64_t near = find_near(&x, i);
        first[i] = near == NONE ? (uint32_t)i : (uint32_t)near;
        if (near == NONE)
            keep(&x, i);
        else
            ++*n_later;
    }
    free(x.first);
    free(x.next);
    return first;
}

size_t weld_count(const cage *c)
{
    size_t n = 0;
    if (c->dim == 3)
        free(find_first(c, 0, &n));
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

size_t weld(cage *c, double tolerance)
{
    size_t n_later, kept = 0;
    uint32_t *first = find_first(c, tolerance, &n_later), *numbers = need(c->n, sizeof *numbers);
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
