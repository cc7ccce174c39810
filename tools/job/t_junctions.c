/* Finds vertices on sides of others. The vertices are sorted by x, so each side looks only at those
 * in its range of x. A vertex counts as on a side if it is as near as rounding leaves it. */
#include "job/t_junctions.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "cage/cage_features.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A vertex is on a side if it is not farther from it than this share of the cage's size. */
static const double NEAR = 1e-9;

/* The outer ring (chain 0) or a feature (the others), in both cages. */
typedef struct chain {
    size_t n;
    bool closed;
    double *points[2];
} chain;

typedef struct vertex {
    const double *at; /* in the cage that is searched */
    uint32_t chain, number;
} vertex;

/* A vertex to be added to a side of a chain. */
typedef struct added {
    size_t chain, edge;
    double along; /* the place on the side in the source, 0 to 1 */
    const double *at[2];
} added;

typedef struct tees {
    job *j;
    size_t n_chains, n_vertices, n, room;
    chain *chains;
    vertex *vertices; /* by x in the cage that is searched */
    added *list;
    double near[2];
} tees;

/* ------------------------------------------------------------------ chains */

static double size_of(const tees *t, size_t role)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t k = 0; k < t->n_chains; k++)
        for (size_t i = 0; i < 2 * t->chains[k].n; i++) {
            lower[i % 2] = fmin(lower[i % 2], t->chains[k].points[role][i]);
            upper[i % 2] = fmax(upper[i % 2], t->chains[k].points[role][i]);
        }
    return fmax(upper[0] - lower[0], upper[1] - lower[1]);
}

static void list_chains(tees *t)
{
    const cage *source = &t->j->cages[0], *target = &t->j->cages[1];
    t->n_chains = 1 + source->n_features;
    t->chains = need(t->n_chains, sizeof *t->chains);
    t->chains[0] = (chain){source->n, true, {source->points, target->points}};
    for (size_t i = 0; i < source->n_features; i++) {
        const cage_feature *a = &source->features[i], *b = &target->features[i];
        t->chains[1 + i] = (chain){a->n, feature_is_ring(a), {a->points, b->points}};
    }
    for (size_t k = 0; k < t->n_chains; k++)
        t->n_vertices += t->chains[k].n;
    t->vertices = need(t->n_vertices, sizeof *t->vertices);
    for (size_t side = 0; side < 2; side++)
        t->near[side] = NEAR * size_of(t, side);
}

static int by_x(const void *a, const void *b)
{
    const vertex *p = a, *q = b;
    if (p->at[0] != q->at[0])
        return p->at[0] < q->at[0] ? -1 : 1;
    return p->chain != q->chain ? (p->chain < q->chain ? -1 : 1)
                                : (p->number > q->number) - (p->number < q->number);
}

static void sort_vertices(tees *t, size_t role)
{
    size_t n = 0;
    for (size_t k = 0; k < t->n_chains; k++)
        for (size_t i = 0; i < t->chains[k].n; i++)
            t->vertices[n++] =
                (vertex){t->chains[k].points[role] + 2 * i, (uint32_t)k, (uint32_t)i};
    qsort(t->vertices, n, sizeof *t->vertices, by_x);
}

/* The first vertex whose x is not below a value. */
static size_t first_from(const tees *t, double x)
{
    size_t low = 0, high = t->n_vertices;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (t->vertices[middle].at[0] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* ---------------------------------------------------------------- vertices */

/* True if a point is on a segment, away from its ends. `along` is its place, 0 to 1. */
static bool lies_on(const double a[2], const double b[2], const double p[2], double near,
                    double *along)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
    if (!(length > 2 * near))
        return false;
    double x = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length;
    double off = fabs((p[1] - a[1]) * dx - (p[0] - a[0]) * dy) / length;
    *along = x / length;
    return off <= near && x > near && x < length - near;
}

static const char *name_of(feature_text out, const tees *t, size_t role, size_t k)
{
    if (k == 0)
        snprintf(out, sizeof(feature_text), "the outline");
    else
        feature_name(out, &t->j->cages[role].features[k - 1]);
    return out;
}

/* Notes the first vertex of a cage that is on a side in that cage only. */
static void note_one_sided(tees *t, size_t role, const vertex *v, size_t on)
{
    const cage *c = &t->j->cages[role];
    problem *found = &t->j->one_sided[role];
    feature_text name, other;
    if (found->text[0] != '\0')
        return;
    spoilt(found, v->chain == 0 ? c->lines[v->number] : c->features[v->chain - 1].line,
           "%s, vertex %u, lies on a side of %s at (%.12g, %.12g), but not in the %s; move it, or "
           "put it on that side in both",
           name_of(name, t, role, v->chain), (unsigned)v->number, name_of(other, t, role, on),
           v->at[0], cage_given_y(c, v->at), cage_role_name(role == 0 ? CAGE_TARGET : CAGE_SOURCE));
}

/* Looks for vertices on a side of a chain in one cage. Those that are on it in both are added when
 * the source is searched. */
static void search_side(tees *t, size_t role, size_t k, size_t i)
{
    const chain *c = &t->chains[k];
    size_t next = (i + 1) % c->n;
    const double *a = c->points[role] + 2 * i, *b = c->points[role] + 2 * next;
    const double *other_a = c->points[!role] + 2 * i, *other_b = c->points[!role] + 2 * next;
    double most = fmax(a[0], b[0]) + t->near[role];
    for (size_t m = first_from(t, fmin(a[0], b[0]) - t->near[role]); m < t->n_vertices; m++) {
        const vertex *v = &t->vertices[m];
        if (v->at[0] > most)
            break;
        double along, ignored;
        if (v->chain == k || !lies_on(a, b, v->at, t->near[role], &along))
            continue;
        const double *there = t->chains[v->chain].points[!role] + 2 * (size_t)v->number;
        bool both = lies_on(other_a, other_b, there, t->near[!role], &ignored);
        if (!both && orientation(a, b, v->at) == 0)
            note_one_sided(t, role, v, k);
        if (!both || role == 1)
            continue;
        t->list = grow(t->list, &t->room, t->n + 1, sizeof *t->list);
        t->list[t->n++] = (added){k, i, along, {v->at, there}};
    }
}

static void search(tees *t, size_t role)
{
    sort_vertices(t, role);
    for (size_t k = 0; k < t->n_chains; k++)
        for (size_t i = 0; i + !t->chains[k].closed < t->chains[k].n; i++)
            search_side(t, role, k, i);
}

/* ------------------------------------------------------------------ adding */

static int by_place(const void *a, const void *b)
{
    const added *p = a, *q = b;
    if (p->chain != q->chain)
        return p->chain < q->chain ? -1 : 1;
    if (p->edge != q->edge)
        return p->edge < q->edge ? -1 : 1;
    return (p->along > q->along) - (p->along < q->along);
}

static bool same_place(const double *a, const double *b)
{
    return memcmp(a, b, 2 * sizeof *a) == 0;
}

/* Sorts the vertices to be added, and drops those that are added to the same side already. */
static void sort_list(tees *t)
{
    size_t kept = 0;
    if (t->n > 0)
        qsort(t->list, t->n, sizeof *t->list, by_place);
    for (size_t i = 0; i < t->n; i++) {
        const added *v = &t->list[i], *last = kept > 0 ? &t->list[kept - 1] : NULL;
        if (last == NULL || last->chain != v->chain || last->edge != v->edge ||
            !same_place(last->at[0], v->at[0]) || !same_place(last->at[1], v->at[1]))
            t->list[kept++] = *v;
    }
    t->n = kept;
}

/* The points of a chain with n vertices added. With `lines`, each gets the line of its side. */
static double *with_added(const chain *c, size_t role, size_t n, const added *list, size_t **lines)
{
    double *points = need(c->n + n, 2 * sizeof *points);
    size_t *longer = lines != NULL ? need(c->n + n, sizeof *longer) : NULL, k = 0, used = 0;
    for (size_t i = 0; i < c->n; i++) {
        size_t begin = used;
        memcpy(points + 2 * used++, c->points[role] + 2 * i, 2 * sizeof *points);
        for (; k < n && list[k].edge == i; k++)
            memcpy(points + 2 * used++, list[k].at[role], 2 * sizeof *points);
        for (size_t v = begin; v < used && longer != NULL; v++)
            longer[v] = (*lines)[i];
    }
    if (longer != NULL) {
        free(*lines);
        *lines = longer;
    }
    return points;
}

static void add_to_ring(cage *c, size_t n, double *points)
{
    c->n += n;
    c->points = points;
    c->room_points = 2 * c->n;
    c->room_lines = c->n;
}

/* The old points are freed last, because vertices of other chains may come from them. */
static void add_all(job *j, const tees *t)
{
    double **old = need(2 * t->n_chains, sizeof *old);
    for (size_t i = 0, n; i < t->n; i += n) {
        size_t k = t->list[i].chain;
        const chain *c = &t->chains[k];
        for (n = 1; i + n < t->n && t->list[i + n].chain == k;)
            n++;
        for (size_t side = 0; side < 2; side++) {
            cage *to = &j->cages[side];
            double *points = with_added(c, side, n, &t->list[i], k == 0 ? &to->lines : NULL);
            old[2 * k + side] = c->points[side];
            if (k == 0)
                add_to_ring(to, n, points);
            else {
                to->features[k - 1].n += n;
                to->features[k - 1].points = points;
            }
        }
    }
    for (size_t k = 0; k < 2 * t->n_chains; k++)
        free(old[k]);
    free(old);
}

void t_junctions_add(job *j)
{
    tees t = {.j = j};
    list_chains(&t);
    search(&t, 0);
    search(&t, 1);
    sort_list(&t);
    add_all(j, &t);
    j->n_added = t.n;
    free(t.chains);
    free(t.vertices);
    free(t.list);
}
