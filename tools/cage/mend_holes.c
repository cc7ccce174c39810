/* Fills small holes with the triangles of least area (G. Barequet and M. Sharir: Filling gaps in
 * the boundary of a polyhedron, 1995). */
#include "cage/mend.h"

#include "base/allocate.h"
#include "cage/sides.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_SIDES = 1000 /* of a hole; the time grows with their third power */ };

/* The sides around holes, as they run around the holes: against their faces. */
typedef struct rim {
    size_t n;
    uint32_t *from, *to; /* sorted by `from` */
    bool *used;
} rim;

static int by_from(const void *a, const void *b)
{
    const uint32_t *x = a, *y = b;
    if (x[0] != y[0])
        return x[0] < y[0] ? -1 : 1;
    return x[1] < y[1] ? -1 : x[1] > y[1];
}

static rim find_rim(const cage *c, const sides *all)
{
    rim r = {0};
    uint32_t *pairs = need(2 * all->n, sizeof *pairs);
    for (size_t i = 0, alike; i < all->n; i += alike) {
        alike = sides_alike(all, i);
        const side *at = &all->all[i];
        bool rises = side_rises(c, at);
        if (alike != 1)
            continue;
        pairs[2 * r.n] = rises ? at->high : at->low;
        pairs[2 * r.n++ + 1] = rises ? at->low : at->high;
    }
    qsort(pairs, r.n, 2 * sizeof *pairs, by_from);
    r.from = need(r.n, sizeof *r.from);
    r.to = need(r.n, sizeof *r.to);
    r.used = need(r.n, sizeof *r.used);
    for (size_t i = 0; i < r.n; i++) {
        r.from[i] = pairs[2 * i];
        r.to[i] = pairs[2 * i + 1];
    }
    free(pairs);
    return r;
}

/* The first unused side that begins at a vertex, or r->n. */
static size_t side_from(const rim *r, uint32_t vertex)
{
    size_t low = 0, high = r->n;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (r->from[middle] < vertex)
            low = middle + 1;
        else
            high = middle;
    }
    while (low < r->n && r->from[low] == vertex && r->used[low])
        low++;
    return low < r->n && r->from[low] == vertex ? low : r->n;
}

/* A hole and its best triangulations: of the part of the loop from i to j. */
typedef struct hole {
    const cage *c;
    const sides *all;
    size_t n;
    const uint32_t *loop;
    /* n * n: twice the least area, or infinity if a side of the surface would be used again */
    double *cost;
    uint32_t *third; /* n * n: the third corner of the triangle at i and j */
} hole;

static const double *place(const hole *h, size_t i)
{
    return h->c->points + 3 * (size_t)h->loop[i];
}

static void solve(hole *h)
{
    for (size_t length = 2; length < h->n; length++)
        for (size_t i = 0; i + length < h->n; i++) {
            size_t j = i + length;
            double best = INFINITY;
            bool is_rim = length == h->n - 1;
            for (size_t k = i + 1; k < j; k++) {
                double cost = h->cost[i * h->n + k] + h->cost[k * h->n + j] +
                              mend_area2(place(h, i), place(h, k), place(h, j));
                if (cost < best) {
                    best = cost;
                    h->third[i * h->n + j] = (uint32_t)k;
                }
            }
            h->cost[i * h->n + j] =
                !is_rim && sides_have(h->all, h->loop[i], h->loop[j]) ? INFINITY : best;
        }
}

/* Adds the triangles between i and j to the surface. `stack` has room for 2 n numbers. */
static void add_faces(const hole *h, cage *c, size_t *stack)
{
    size_t n = 0;
    stack[n++] = 0;
    stack[n++] = h->n - 1;
    while (n > 0) {
        size_t j = stack[--n], i = stack[--n], k;
        if (j - i < 2)
            continue;
        k = h->third[i * h->n + j];
        cage_add_corner(c, 0, h->loop[i], 0);
        cage_add_corner(c, 1, h->loop[k], 0);
        cage_add_corner(c, 2, h->loop[j], 0);
        stack[n++] = i;
        stack[n++] = k;
        stack[n++] = k;
        stack[n++] = j;
    }
}

/* Fills one hole. */
static int fill(cage *c, const char *file, const sides *all, size_t n, const uint32_t *loop,
                double area)
{
    size_t line = c->lines[loop[0]];
    if (n > MOST_SIDES)
        return failed(file, line,
                      "the hole at vertex %u has %zu sides, more than %d; fill it by hand", loop[0],
                      n, (int)MOST_SIDES);
    hole h = {c, all, n, loop, need(n * n, sizeof *h.cost), need(n * n, sizeof *h.third)};
    size_t *stack = need(2 * n + 2, sizeof *stack);
    int result = DONE;
    solve(&h);
    double of_hole = h.cost[n - 1] / 2;
    if (!(of_hole <= MEND_SMALL * area))
        result = failed(file, line,
                        of_hole < INFINITY ? "the hole at vertex %u, of %zu sides, is too large to "
                                             "be filled: more than 5 %% of "
                                             "the surface; fill it by hand"
                                           : "the hole at vertex %u, of %zu sides, cannot be "
                                             "filled without new vertices; fill "
                                             "it by hand",
                        loop[0], n);
    else
        add_faces(&h, c, stack);
    if (result == DONE)
        note("%s: a hole of %zu sides is filled, at vertex %u", file, n, loop[0]);
    free(h.cost);
    free(h.third);
    free(stack);
    return result;
}

/* The holes of a surface, found one after the other. */
typedef struct holes {
    cage *c;
    const char *file;
    double area;
    sides all; /* of the surface before `touched` was set */
    rim rim;
    bool *touched; /* the vertex is at a hole that has been filled */
    size_t *place; /* of each vertex on the path, from 1 */
    uint32_t *path;
    mended *did;
} holes;

/* Fills the hole along the last n vertices of a path. Sides that were added at its vertices
 * count as sides of the surface. */
static int fill_next(holes *h, size_t n, const uint32_t *loop)
{
    bool again = false;
    for (size_t i = 0; i < n; i++) {
        again = again || h->touched[loop[i]];
        h->place[loop[i]] = 0;
    }
    if (again) {
        sides_free(&h->all);
        h->all = sides_make(h->c);
    }
    int result = fill(h->c, h->file, &h->all, n, loop, h->area);
    for (size_t i = 0; i < n; i++)
        h->touched[loop[i]] = true;
    h->did->n_holes += result == DONE;
    return result;
}

/* Follows the rim from side i. Where it comes back to a vertex, what lies between is a hole: one
 * that meets itself at a vertex is several. */
static int follow(holes *h, size_t i)
{
    size_t n = 0;
    int result = DONE;
    while (i < h->rim.n && result == DONE) {
        uint32_t to = h->rim.to[i];
        h->rim.used[i] = true;
        h->path[n++] = h->rim.from[i];
        h->place[h->rim.from[i]] = n;
        size_t first = h->place[to];
        if (first > 0 && n + 1 - first >= 3) {
            result = fill_next(h, n + 1 - first, h->path + first - 1);
            n = first - 1;
        }
        i = side_from(&h->rim, to);
    }
    for (size_t k = 0; k < n; k++)
        h->place[h->path[k]] =
            0; /* the rim ends here; the surface stays open, and is refused later */
    return result;
}

int mend_holes(cage *c, const char *file, double area, mended *did)
{
    holes h = {c, file, area, sides_make(c), {0}, NULL, NULL, NULL, did};
    size_t before = c->n_facets;
    int result = DONE;
    h.rim = find_rim(c, &h.all);
    h.touched = need(c->n, sizeof *h.touched);
    h.place = need(c->n, sizeof *h.place);
    h.path = need(h.rim.n, sizeof *h.path);
    for (size_t i = 0; i < h.rim.n && result == DONE; i++)
        if (!h.rim.used[i])
            result = follow(&h, i);
    did->n_filled_faces = c->n_facets - before;
    free(h.touched);
    free(h.place);
    free(h.path);
    free(h.rim.from);
    free(h.rim.to);
    free(h.rim.used);
    sides_free(&h.all);
    return result;
}
