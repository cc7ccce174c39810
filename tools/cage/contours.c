/* Finds which contours of a path lie inside which others. The nearest edge to the left of a
 * contour's leftmost vertex belongs to the contour around it, or to a contour beside it that has
 * the same one around it.
 *
 * The leftmost vertices, by rising y, are the leaves of a segment tree. Each edge is stored at the
 * few nodes whose ranges together are the vertices between its ends. Edges that do not cross are in
 * order from left to right at a node, so a binary search finds the nearest. The tree is built and
 * searched level by level. Exact for contours that do not cross. Takes n log^2 n for n edges. */
#include "cage/contours.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "cage/cage_features.h"

#include <stdlib.h>
#include <string.h>

#define NO_CONTOUR SIZE_MAX

typedef struct contour {
    const double *points; /* 2 n */
    const size_t *lines;
    size_t n;
    const double *left; /* the lowest of its leftmost vertices */
    bool turns_left;    /* counter-clockwise, with y upwards */
    size_t parent;      /* the contour around it, or NO_CONTOUR */
    bool hole;
    size_t polygon; /* the number of an outline's polygon */
} contour;

/* An edge from its lower to its upper end, whichever way its contour runs. */
typedef struct edge {
    const double *low, *high;
    size_t of;         /* its contour */
    bool down;         /* its contour runs from the upper end to the lower */
    size_t begin, end; /* the nodes of the present level where it may have to be stored */
} edge;

/* An edge at a node. */
typedef struct item {
    size_t node;
    const edge *edge;
} item;

typedef struct nest {
    size_t n;
    contour *contours;
    contour **by_height; /* by the y of their leftmost vertices */
    const edge **near;   /* of each of by_height: the nearest edge to its left until now, or NULL */
    size_t n_edges, n_items;
    edge *edges;
    item *items; /* 2 n_edges */
} nest;

/* ------------------------------------------------------------------ order */

static int by_height(const void *a, const void *b)
{
    const contour *p = *(contour *const *)a, *q = *(contour *const *)b;
    return (p->left[1] > q->left[1]) - (p->left[1] < q->left[1]);
}

/* Returns -1 if e is to the left of f, 1 if to the right, at a height that both reach. */
static int side_of(const edge *e, const edge *f)
{
    bool later = e->low[1] >= f->low[1], sooner = e->high[1] <= f->high[1];
    int s = later ? -orientation(f->low, f->high, e->low) : orientation(e->low, e->high, f->low);
    if (s == 0)
        s = sooner ? -orientation(f->low, f->high, e->high) : orientation(e->low, e->high, f->high);
    return s;
}

static int by_node(const void *a, const void *b)
{
    const item *p = a, *q = b;
    if (p->node != q->node)
        return p->node < q->node ? -1 : 1;
    int s = side_of(p->edge, q->edge);
    return s != 0 ? s : (p->edge > q->edge) - (p->edge < q->edge);
}

/* How many leftmost vertices are below a height. */
static size_t count_below(const nest *t, double y)
{
    size_t low = 0, high = t->n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (t->by_height[middle]->left[1] < y)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The rightmost edge at a node that is left of a point, or NULL. */
static const edge *find_left(const nest *t, size_t node, const double *point)
{
    size_t low = 0, high = t->n_items;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const item *i = &t->items[middle];
        if (i->node < node ||
            (i->node == node && orientation(i->edge->low, i->edge->high, point) < 0))
            low = middle + 1;
        else
            high = middle;
    }
    return low > 0 && t->items[low - 1].node == node ? t->items[low - 1].edge : NULL;
}

/* ------------------------------------------------------------------ nesting */

/* The leftmost vertex of a contour turns the way the contour does. */
static void find_leftmost(contour *c)
{
    const double *p = c->points;
    size_t k = 0, n = c->n;
    for (size_t i = 1; i < n; i++)
        if (p[2 * i] < p[2 * k] || (p[2 * i] == p[2 * k] && p[2 * i + 1] < p[2 * k + 1]))
            k = i;
    c->left = p + 2 * k;
    c->turns_left = orientation(p + 2 * ((k + n - 1) % n), c->left, p + 2 * ((k + 1) % n)) > 0;
}

/* Lists the edges of all contours, each with the leaves at its height. Horizontal edges have
 * none. */
static void list_edges(nest *t, size_t n_leaves)
{
    for (size_t k = 0; k < t->n; k++)
        for (size_t i = 0; i < t->contours[k].n; i++) {
            const contour *c = &t->contours[k];
            const double *a = c->points + 2 * i, *b = c->points + 2 * ((i + 1) % c->n);
            bool down = b[1] < a[1];
            edge *e = &t->edges[t->n_edges++];
            *e = (edge){.low = down ? b : a, .high = down ? a : b, .of = k, .down = down};
            e->begin = n_leaves + count_below(t, e->low[1]);
            e->end = n_leaves + count_below(t, e->high[1]);
        }
}

/* Lists the edges at those nodes of this level whose parents' ranges exceed the edge's range. */
static void list_items(nest *t)
{
    t->n_items = 0;
    for (edge *e = t->edges; e < t->edges + t->n_edges; e++) {
        if (e->begin < e->end && e->begin % 2 == 1)
            t->items[t->n_items++] = (item){e->begin++, e};
        if (e->begin < e->end && e->end % 2 == 1)
            t->items[t->n_items++] = (item){--e->end, e};
        e->begin /= 2;
        e->end /= 2;
    }
    qsort(t->items, t->n_items, sizeof *t->items, by_node);
}

static void find_near(nest *t)
{
    size_t n_leaves = 1;
    while (n_leaves < t->n)
        n_leaves *= 2;
    list_edges(t, n_leaves);
    for (size_t level = 0; n_leaves >> level > 0; level++) {
        list_items(t);
        for (size_t i = 0; i < t->n; i++) {
            const edge *e = find_left(t, (n_leaves + i) >> level, t->by_height[i]->left);
            if (e != NULL && (t->near[i] == NULL || side_of(e, t->near[i]) > 0))
                t->near[i] = e;
        }
    }
}

/* A contour, and the nearest edge to its left. */
typedef struct step {
    contour *of;
    const edge *near;
} step;

static int by_left(const void *a, const void *b)
{
    const double *p = ((const step *)a)->of->left, *q = ((const step *)b)->of->left;
    return (p[0] > q[0]) - (p[0] < q[0]);
}

/* Goes from left to right, so the contour of the nearest edge has its parent already. */
static void find_parents(nest *t)
{
    step *steps = need(t->n, sizeof *steps);
    for (size_t i = 0; i < t->n; i++)
        steps[i] = (step){t->by_height[i], t->near[i]};
    qsort(steps, t->n, sizeof *steps, by_left);
    for (size_t i = 0; i < t->n; i++) {
        contour *c = steps[i].of;
        const edge *e = steps[i].near;
        if (e == NULL)
            continue;
        const contour *other = &t->contours[e->of];
        c->parent = other->turns_left == e->down ? e->of : other->parent;
        c->hole = c->parent != NO_CONTOUR && !t->contours[c->parent].hole;
    }
    free(steps);
}

static void nest_contours(size_t n, contour *contours, size_t n_vertices)
{
    nest t = {.n = n,
              .contours = contours,
              .by_height = need(n, sizeof(contour *)),
              .near = need(n, sizeof(edge *)),
              .edges = need(n_vertices, sizeof(edge)),
              .items = need(2 * n_vertices, sizeof(item))};
    for (size_t k = 0; k < n; k++) {
        find_leftmost(&contours[k]);
        t.by_height[k] = &contours[k];
    }
    qsort(t.by_height, n, sizeof *t.by_height, by_height);
    find_near(&t);
    find_parents(&t);
    free(t.by_height);
    free(t.near);
    free(t.edges);
    free(t.items);
}

/* ----------------------------------------------------------------- polygons */

static cage *polygon_of(cage *out, const contour *outline)
{
    return outline->polygon == 0 ? out : &out->more[outline->polygon - 1];
}

static void add_vertices(cage *out, const contour *c)
{
    for (size_t i = 0; i < c->n; i++)
        cage_add(out, c->points[2 * i], c->points[2 * i + 1], c->lines[i]);
}

/* Makes outlines first, because holes may come before their outline. */
static void make_polygons(cage *out, size_t n, contour *contours)
{
    size_t n_polygons = 0;
    for (size_t k = 0; k < n; k++)
        if (!contours[k].hole)
            contours[k].polygon = n_polygons++;
    out->n_more = n_polygons - 1;
    out->more = need(out->n_more, sizeof *out->more);
    for (size_t k = 0; k < n; k++)
        if (!contours[k].hole) {
            polygon_of(out, &contours[k])->dim = 2;
            add_vertices(polygon_of(out, &contours[k]), &contours[k]);
        }
    for (size_t k = 0; k < n; k++)
        if (contours[k].hole) {
            cage *polygon = polygon_of(out, &contours[contours[k].parent]);
            size_t first = polygon->n;
            add_vertices(polygon, &contours[k]);
            cage_add_feature(polygon, ICC_FEATURE_HOLE, (int64_t)polygon->n_features + 1, first);
        }
}

void cage_take_contours(cage *out, size_t n, const size_t *firsts)
{
    if (n < 2)
        return;
    double *points = out->points;
    size_t *lines = out->lines, n_vertices = out->n;
    contour *contours = need(n, sizeof *contours);
    for (size_t k = 0; k < n; k++)
        contours[k] = (contour){.points = points + 2 * firsts[k],
                                .lines = lines + firsts[k],
                                .n = (k + 1 < n ? firsts[k + 1] : n_vertices) - firsts[k],
                                .parent = NO_CONTOUR};
    nest_contours(n, contours, n_vertices);
    out->points = NULL;
    out->lines = NULL;
    out->n = out->room_points = out->room_lines = 0;
    make_polygons(out, n, contours);
    free(contours);
    free(points);
    free(lines);
}
