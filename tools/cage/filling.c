/* Matches the vertices of a mesh with those of a cage by their places. */
#include "cage/filling.h"

#include "base/allocate.h"
#include "mesh/mesh_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far a vertex of the mesh may be from that of the cage, in diagonals of the cage. Files are
 * often written with ten digits. */
static const double NEAR = 1e-9;

void filling_free(filling *f)
{
    free(f->points);
    free(f->corners);
    free(f->facets);
    free(f->regions);
    *f = (filling){0};
}

/* In the plane a cage without facets is a ring. */
static void take_facets(filling *out, const cage *c)
{
    out->n_facets = c->n_facets > 0 ? c->n_facets : c->n;
    out->facets = need(out->n_facets, c->dim * sizeof *out->facets);
    for (size_t i = 0; c->n_facets == 0 && i < c->n; i++) {
        out->facets[2 * i] = (uint32_t)i;
        out->facets[2 * i + 1] = i + 1 < c->n ? (uint32_t)i + 1 : 0;
    }
    if (c->n_facets > 0)
        memcpy(out->facets, c->facets, c->n_facets * c->dim * sizeof *out->facets);
}

/* Puts the cage's vertices first: vertex order[i] of the mesh becomes vertex i. */
static void arrange(filling *out, const cage *c, size_t n_points, const double *points,
                    const uint32_t *order, size_t n, const uint32_t *corners)
{
    const size_t dim = c->dim;
    uint32_t *place = need(n_points, sizeof *place);
    *out = (filling){.dim = dim, .n_points = n_points, .n = n};
    out->points = need(n_points, dim * sizeof *out->points);
    out->corners = need(n, (dim + 1) * sizeof *out->corners);
    for (size_t i = 0; i < n_points; i++) {
        place[order[i]] = (uint32_t)i;
        memcpy(out->points + dim * i, i < c->n ? c->points + dim * i : points + dim * order[i],
               dim * sizeof *points);
    }
    for (size_t i = 0; i < n * (dim + 1); i++)
        out->corners[i] = place[corners[i]];
    take_facets(out, c);
    free(place);
}

typedef struct entry {
    double x;
    uint32_t vertex;
} entry;

static int by_x(const void *a, const void *b)
{
    const entry *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x)
                        : (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static double diagonal(const cage *c)
{
    double sum = 0;
    for (size_t k = 0; k < c->dim; k++) {
        double low = c->points[k], high = low;
        for (size_t i = 1; i < c->n; i++) {
            low = fmin(low, c->points[c->dim * i + k]);
            high = fmax(high, c->points[c->dim * i + k]);
        }
        sum = hypot(sum, high - low);
    }
    return sum;
}

static double distance(size_t dim, const double *a, const double *b)
{
    double sum = 0;
    for (size_t k = 0; k < dim; k++)
        sum = hypot(sum, a[k] - b[k]);
    return sum;
}

/* Finds a mesh vertex at a place that is not taken yet, or UINT32_MAX. */
static uint32_t find(const mesh_file *m, const entry *sorted, const bool *taken, const double *at,
                     double near)
{
    size_t low = 0, high = m->n_vertices;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (sorted[middle].x < at[0] - near)
            low = middle + 1;
        else
            high = middle;
    }
    uint32_t best = UINT32_MAX;
    for (; low < m->n_vertices && sorted[low].x <= at[0] + near; low++) {
        uint32_t v = sorted[low].vertex;
        double d = distance(m->dim, m->points + m->dim * v, at);
        if (d <= near && !taken[v] && (best == UINT32_MAX || d < near)) {
            best = v;
            near = d;
        }
    }
    return best;
}

/* Fills in `order`. False if a vertex of the cage is missing. */
static bool match(const mesh_file *m, const cage *c, uint32_t *order, problem *wrong)
{
    entry *sorted = need(m->n_vertices, sizeof *sorted);
    bool *taken = need(m->n_vertices, sizeof *taken);
    double near = NEAR * diagonal(c);
    for (size_t v = 0; v < m->n_vertices; v++)
        sorted[v] = (entry){m->points[m->dim * v], (uint32_t)v};
    qsort(sorted, m->n_vertices, sizeof *sorted, by_x);
    size_t i = 0;
    for (; i < c->n; i++) {
        order[i] = find(m, sorted, taken, c->points + c->dim * i, near);
        if (order[i] == UINT32_MAX)
            break;
        taken[order[i]] = true;
    }
    for (size_t v = 0, next = i; i == c->n && v < m->n_vertices; v++)
        if (!taken[v])
            order[next++] = (uint32_t)v;
    free(sorted);
    free(taken);
    return i == c->n || spoilt(wrong, 0, "no vertex of the mesh lies at vertex %zu of the cage", i);
}

bool filling_read(filling *out, const cage *c, const char *text, size_t n, problem *wrong)
{
    mesh_file m;
    *out = (filling){0};
    bool good = mesh_read(&m, c->dim, text, n, wrong);
    size_t n_elements = c->dim == 2 ? m.n_triangles : m.n_tetrahedra;
    if (good && n_elements == 0)
        good = spoilt(wrong, 0, "there are no %s", c->dim == 2 ? "triangles" : "tetrahedra");
    if (good && m.n_vertices < c->n)
        good = spoilt(wrong, 0, "%zu vertices, but the cage alone has %zu", m.n_vertices, c->n);
    if (good) {
        uint32_t *order = need(m.n_vertices, sizeof *order);
        good = match(&m, c, order, wrong);
        if (good)
            arrange(out, c, m.n_vertices, m.points, order, n_elements,
                    c->dim == 2 ? m.triangles : m.tetrahedra);
        if (good && c->dim == 3)
            out->regions = mesh_tetrahedron_regions(&m);
        free(order);
    }
    mesh_free(&m);
    return good;
}
