/* Two nodes of a side that polygons share are on both polygons. So it is enough to find the
 * vertices that lie on a polygon's side or at its end, and to look for a side with two of them.
 *
 * Welding moves a vertex by the length, and so the sides at it. A vertex that is put into a side may
 * be the length away from it. So vertices are looked for within four times the length. */
#include "geo/contacts.h"

#include "base/allocate.h"
#include "base/extremes.h"
#include "geo/near_sides.h"

#include <math.h>
#include <stdlib.h>

typedef struct contacts {
    const double *points;
    size_t n_paths;
    const layer_path *paths;
    double near;
    size_t n_items, room_items;
    near_item *items;
    bool *is_met;      /* of each position: another polygon has a vertex there, or a side */
    unsigned char *on; /* of the side that begins at a position: vertices on it, at most 2 */
    bool may_share;
} contacts;

static const double *point_of(const contacts *c, size_t position)
{
    return c->points + 2 * position;
}

static bool same_point(const double p[2], const double q[2])
{
    return !(p[0] < q[0] || p[0] > q[0] || p[1] < q[1] || p[1] > q[1]);
}

static bool is_closed(const contacts *c, const layer_path *p)
{
    return p->n > 1 && same_point(point_of(c, p->first), point_of(c, p->first + p->n - 1));
}

static void add_item(contacts *c, size_t a, size_t b)
{
    c->items = grow(c->items, &c->room_items, c->n_items + 1, sizeof *c->items);
    c->items[c->n_items++] = (near_item){(uint32_t)a, (uint32_t)b};
}

/* Adds the sides of a polygon's ring, and only the vertices of a line. The last position of a ring
 * is its first one. */
static void add_path(contacts *c, const layer_path *p)
{
    for (size_t i = p->first; i < p->first + p->n; i++) {
        bool is_last = i + 1 == p->first + p->n;
        if (!is_last || !is_closed(c, p))
            add_item(c, i, is_last || p->polygon == NO_POLYGON ? i : i + 1);
    }
}

static const layer_path *path_of(const contacts *c, size_t position)
{
    size_t first = 0, end = c->n_paths;
    while (end - first > 1) {
        size_t middle = first + (end - first) / 2;
        if (c->paths[middle].first <= position)
            first = middle;
        else
            end = middle;
    }
    return &c->paths[first];
}

static bool is_near_point(const contacts *c, const double p[2], const double q[2])
{
    return fabs(p[0] - q[0]) <= c->near && fabs(p[1] - q[1]) <= c->near;
}

/* Counts the vertices on a side. */
static void count_on(contacts *c, size_t side)
{
    if (c->is_met[side] + c->is_met[side + 1] + c->on[side] > 1)
        c->may_share = true;
}

/* Notes that another polygon has a vertex or a side at a polygon's vertex. */
static void meet(contacts *c, const layer_path *p, size_t vertex)
{
    size_t last = p->first + p->n - 1;
    c->is_met[vertex] = true;
    if (vertex > p->first)
        count_on(c, vertex - 1);
    if (vertex < last)
        count_on(c, vertex);
    if (vertex == p->first && is_closed(c, p))
        meet(c, p, last);
}

/* Notes that a vertex is at a side of a polygon or at its end. Ends the search when the answer is
 * known. */
static bool note_contact(void *context, uint32_t vertex, size_t item)
{
    contacts *c = context;
    size_t side = c->items[item].a;
    const layer_path *own = path_of(c, vertex);
    const double *p = point_of(c, vertex), *a = point_of(c, side), *b = a + 2;
    bool is_end = same_point(p, a) || same_point(p, b);
    if (!is_end && (is_near_point(c, p, a) || is_near_point(c, p, b)))
        c->may_share = true;
    if (!is_end && c->on[side]++ == 0)
        count_on(c, side);
    else if (!is_end)
        c->may_share = true;
    if (own->polygon != NO_POLYGON && (!is_end || own->polygon != path_of(c, side)->polygon))
        meet(c, own, vertex);
    return !c->may_share;
}

bool contacts_may_share(size_t n, const double *points, size_t n_paths, const layer_path *paths,
                        double length)
{
    contacts c = {.points = points, .n_paths = n_paths, .paths = paths};
    bool has_polygons = false;
    double largest = 0;
    for (size_t p = 0; p < n_paths; p++)
        has_polygons = has_polygons || paths[p].polygon != NO_POLYGON;
    if (!has_polygons)
        return false;
    for (size_t i = 0; i < 2 * n; i++)
        largest = greater(largest, fabs(points[i]));
    c.near = near_rounded(4 * length, largest);
    c.is_met = need(n, sizeof *c.is_met);
    c.on = need(n, sizeof *c.on);
    for (size_t p = 0; p < n_paths; p++)
        add_path(&c, &paths[p]);
    near_sides(c.n_items, c.items, n, points, c.near, note_contact, &c);
    free(c.items);
    free(c.is_met);
    free(c.on);
    return c.may_share;
}
