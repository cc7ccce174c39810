/* Reads, welds and nodes a layer. Everything goes by sorting and by trees of boxes, so n positions
 * take about n log n steps. */
#include "geo/geo_layer.h"

#include "base/allocate.h"
#include "base/extremes.h"
#include "base/orientation.h"
#include "base/radix_sort.h"
#include "geo/contacts.h"
#include "geo/crossing.h"
#include "geo/geo_shape.h"
#include "geo/near_sides.h"
#include "geo/segment_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A side as it is given: positions, later nodes, and the polygon that it bounds. */
typedef struct given_side {
    uint32_t a, b, polygon;
} given_side;

/* A node that lies on a side. */
typedef struct touch {
    size_t side;
    double share;
    uint32_t node;
} touch;

typedef struct layer_reader {
    geo_layer *out;
    double length;
    double *points;
    size_t room_points;
    layer_path *paths;
    size_t n_paths, room_paths;
    given_side *given;
    size_t n_given, room_given;
    uint32_t *lead; /* of each node: the one to which it is welded, or itself */
    touch *touches;
    size_t n_touches, room_touches;
} layer_reader;

/* ---- reading ---- */

static void add_given(layer_reader *r, uint32_t a, uint32_t b, uint32_t polygon)
{
    r->given = grow(r->given, &r->room_given, r->n_given + 1, sizeof *r->given);
    r->given[r->n_given++] = (given_side){a, b, polygon};
}

/* Adds the positions and paths of a geometry. Zeros lose their sign, so that equal positions have
 * equal bits. */
static void add_shape(layer_reader *r, const geo_shape *s, uint32_t *n_polygons)
{
    size_t base = r->out->n;
    r->points = grow(r->points, &r->room_points, 2 * (base + s->n), sizeof *r->points);
    for (size_t i = 0; i < 2 * s->n; i++)
        r->points[2 * base + i] = s->points[i] + 0.0;
    for (size_t p = 0; p < s->n_paths && s->type > GEO_MULTI_POINT; p++) {
        bool polygon = s->type > GEO_MULTI_LINE;
        if (polygon && (p == 0 || s->paths[p].part != s->paths[p - 1].part))
            ++*n_polygons;
        r->paths = grow(r->paths, &r->room_paths, r->n_paths + 1, sizeof *r->paths);
        r->paths[r->n_paths++] = (layer_path){base + s->paths[p].first, s->paths[p].n,
                                              polygon ? *n_polygons : NO_POLYGON};
    }
    r->out->n += s->n;
}

static bool read_all(layer_reader *r, const geo_index *index, const char *text, problem *wrong)
{
    geo_shape shape = {0};
    uint32_t n_polygons = 0;
    bool good = true;
    for (size_t i = 0; i < index->n && good; i++) {
        const geo_object *o = &index->objects[i];
        r->out->first[i] = r->out->n;
        if (!o->live || o->type >= GEO_GEOMETRIES)
            continue;
        good = geo_shape_read(&shape, o, text, NULL, wrong);
        if (good && shape.n >= UINT32_MAX - r->out->n)
            good = spoilt(wrong, 0, "this GeoJSON has too many positions");
        if (good)
            add_shape(r, &shape, &n_polygons);
    }
    geo_shape_free(&shape);
    return good;
}

/* ---- nodes ---- */

/* Sorts positions by x, then by y. */
static keyed *sort_positions(size_t n, const double *points)
{
    keyed *list = need(n, sizeof *list);
    for (size_t i = 0; i < n; i++)
        list[i] = (keyed){radix_key(points[2 * i + 1]), (uint32_t)i};
    radix_sort(n, list);
    for (size_t i = 0; i < n; i++)
        list[i].key = radix_key(points[2 * (size_t)list[i].item]);
    radix_sort(n, list);
    return list;
}

/* Lists the sides of all paths as pairs of nodes. */
static void list_given(layer_reader *r)
{
    const uint32_t *node = r->out->node;
    for (size_t p = 0; p < r->n_paths; p++) {
        const layer_path *path = &r->paths[p];
        for (size_t i = path->first + 1; i < path->first + path->n; i++)
            add_given(r, node[i - 1], node[i], path->polygon);
    }
}

static void find_nodes(layer_reader *r)
{
    geo_layer *out = r->out;
    keyed *list = sort_positions(out->n, r->points);
    out->node = need(out->n, sizeof *out->node);
    out->nodes = need(out->n, 2 * sizeof *out->nodes);
    for (size_t i = 0; i < out->n; i++) {
        const double *point = r->points + 2 * (size_t)list[i].item;
        if (i == 0 || point_before(out->nodes + 2 * (out->n_nodes - 1), point))
            memcpy(out->nodes + 2 * out->n_nodes++, point, 2 * sizeof *point);
        out->node[list[i].item] = (uint32_t)out->n_nodes - 1;
    }
    free(list);
    list_given(r);
}

/* Nodes at ends of sides while they are welded. The tree is made if it is needed. */
typedef struct welding {
    layer_reader *reader;
    bool *ends;
    double *dots;
    segment_tree tree;
} welding;

static bool is_close(const welding *w, uint32_t i, uint32_t j)
{
    const double *p = w->reader->out->nodes + 2 * (size_t)i;
    const double *q = w->reader->out->nodes + 2 * (size_t)j;
    return fabs(p[1] - q[1]) <= w->reader->length && point_distance(p, q) <= w->reader->length;
}

/* Welds a later node to node i if it is close. */
static void weld(welding *w, uint32_t i, uint32_t j)
{
    if (j > i && w->ends[j] && w->reader->lead[j] == j && is_close(w, i, j))
        w->reader->lead[j] = i;
}

/* Welds nodes that the tree finds. */
static void weld_by_tree(welding *w, uint32_t i)
{
    const geo_layer *l = w->reader->out;
    if (w->dots == NULL) {
        w->dots = need(l->n_nodes, 4 * sizeof *w->dots);
        for (size_t k = 0; k < 4 * l->n_nodes; k++)
            w->dots[k] = l->nodes[2 * (k / 4) + k % 2];
        segment_tree_make(&w->tree, l->n_nodes, w->dots, w->reader->length);
    }
    segment_tree_ask_box(&w->tree, w->dots + 4 * (size_t)i);
    for (size_t k = 0; k < w->tree.n_found; k++)
        weld(w, i, w->tree.found[k]);
}

/* Welds later nodes to node i. Nodes are sorted by x, so those that are close follow it, and they
 * are usually few. */
static void weld_to(welding *w, uint32_t i)
{
    enum { FEW = 16 };
    const geo_layer *l = w->reader->out;
    double reach = l->nodes[2 * (size_t)i] + w->reader->length;
    uint32_t n = (uint32_t)l->n_nodes, end = i + 1;
    while (end < n && end - i <= FEW && l->nodes[2 * (size_t)end] <= reach)
        end++;
    if (end - i > FEW)
        weld_by_tree(w, i);
    else
        for (uint32_t j = i + 1; j < end; j++)
            weld(w, i, j);
}

/* Welds nodes at ends of sides to the first one within the length that is not welded itself. So
 * nothing moves farther than that. */
static void weld_nodes(layer_reader *r)
{
    size_t n = r->out->n_nodes;
    r->lead = need(n, sizeof *r->lead);
    for (uint32_t i = 0; i < n; i++)
        r->lead[i] = i;
    if (r->n_given == 0 || !(r->length > 0))
        return;
    welding w = {.reader = r, .ends = need(n, sizeof *w.ends)};
    for (size_t i = 0; i < r->n_given; i++)
        w.ends[r->given[i].a] = w.ends[r->given[i].b] = true;
    for (uint32_t i = 0; i < n; i++)
        if (r->lead[i] == i && w.ends[i])
            weld_to(&w, i);
    segment_tree_free(&w.tree);
    free(w.dots);
    free(w.ends);
}

/* ---- sides ---- */

/* Sorts sides by their ends, then by their polygons. */
static void sort_given(size_t n, given_side *sides)
{
    keyed *list = need(n, sizeof *list);
    given_side *copy = need(n, sizeof *copy);
    if (n > 0)
        memcpy(copy, sides, n * sizeof *copy);
    for (size_t i = 0; i < n; i++)
        list[i] = (keyed){sides[i].polygon, (uint32_t)i};
    radix_sort(n, list);
    for (size_t i = 0; i < n; i++) {
        const given_side *s = &copy[list[i].item];
        list[i].key = (uint64_t)s->a << 32 | s->b;
    }
    radix_sort(n, list);
    for (size_t i = 0; i < n; i++)
        sides[i] = copy[list[i].item];
    free(copy);
    free(list);
}

/* Orders the ends of sides, drops those without length, and sorts. */
static void sort_sides(given_side *sides, size_t *n_sides, const uint32_t *lead)
{
    size_t n = 0;
    for (size_t i = 0; i < *n_sides; i++) {
        uint32_t a = lead[sides[i].a], b = lead[sides[i].b];
        if (a != b)
            sides[n++] = (given_side){a < b ? a : b, a < b ? b : a, sides[i].polygon};
    }
    sort_given(n, sides);
    *n_sides = n;
}

static bool same_ends(const given_side *x, const given_side *y)
{
    return x->a == y->a && x->b == y->b;
}

static void list_sides(layer_reader *r)
{
    geo_layer *out = r->out;
    sort_sides(r->given, &r->n_given, r->lead);
    out->sides = need(r->n_given, sizeof *out->sides);
    for (size_t i = 0; i < r->n_given; i++)
        if (i == 0 || !same_ends(&r->given[i - 1], &r->given[i]))
            out->sides[out->n_sides++] = (layer_side){.a = r->given[i].a, .b = r->given[i].b};
}

/* ---- vertices on sides ---- */

static const double *node_at(const geo_layer *l, uint32_t node)
{
    return l->nodes + 2 * (size_t)node;
}

/* True if p is within `length` of the segment a b, between its ends. */
static bool lies_on(const double a[2], const double b[2], const double p[2], double length,
                    double *share)
{
    double way = point_distance(a, b), dx = (b[0] - a[0]) / way, dy = (b[1] - a[1]) / way;
    double along = (p[0] - a[0]) * dx + (p[1] - a[1]) * dy;
    *share = along / way;
    if (!(*share > 0 && *share < 1))
        return false;
    return fabs((p[0] - a[0]) * dy - (p[1] - a[1]) * dx) <= length || orientation(a, b, p) == 0;
}

/* True if a point is in the box of a side, wider by `length`. */
static bool is_near_box(const double a[2], const double b[2], const double p[2], double length)
{
    for (size_t k = 0; k < 2; k++)
        if (p[k] < lesser(a[k], b[k]) - length || p[k] > greater(a[k], b[k]) + length)
            return false;
    return true;
}

/* Notes a node that lies on a side. */
static bool note_touch(void *context, uint32_t node, size_t side)
{
    layer_reader *r = context;
    const geo_layer *l = r->out;
    const double *p = node_at(l, node), *a = node_at(l, l->sides[side].a),
                 *b = node_at(l, l->sides[side].b);
    double share;
    if (!is_near_box(a, b, p, r->length) || !lies_on(a, b, p, r->length, &share))
        return true;
    r->touches = grow(r->touches, &r->room_touches, r->n_touches + 1, sizeof *r->touches);
    r->touches[r->n_touches++] = (touch){side, share, node};
    return true;
}

/* Finds the sides on which their nodes lie. Each node is to be the first one of an item, so those
 * at larger ends are added. */
static void find_touches(layer_reader *r)
{
    const geo_layer *l = r->out;
    near_item *items = need(l->n_sides, 2 * sizeof *items);
    double largest = 0;
    for (size_t i = 0; i < l->n_sides; i++) {
        items[i] = (near_item){l->sides[i].a, l->sides[i].b};
        items[l->n_sides + i] = (near_item){l->sides[i].b, l->sides[i].b};
    }
    for (size_t i = 0; i < 2 * l->n_nodes; i++)
        largest = greater(largest, fabs(l->nodes[i]));
    near_sides(2 * l->n_sides, items, l->n_nodes, l->nodes, near_rounded(r->length, largest),
               note_touch, r);
    free(items);
}

static int by_side(const void *a, const void *b)
{
    const touch *x = a, *y = b;
    if (x->side != y->side)
        return x->side < y->side ? -1 : 1;
    if (x->share < y->share || y->share < x->share)
        return x->share < y->share ? -1 : 1;
    return (x->node > y->node) - (x->node < y->node);
}

/* Puts nodes into the sides on which they lie. */
static void put_into_sides(layer_reader *r)
{
    geo_layer *out = r->out;
    find_touches(r);
    if (r->n_touches > 1)
        qsort(r->touches, r->n_touches, sizeof *r->touches, by_side);
    out->on = need(r->n_touches, sizeof *out->on);
    out->n_on = r->n_touches;
    for (size_t i = 0; i < r->n_touches; i++) {
        layer_side *s = &out->sides[r->touches[i].side];
        s->first_on = s->n_on++ == 0 ? i : s->first_on;
        out->on[i] = r->touches[i].node;
    }
}

/* Counts the sides between all nodes that bound at least two polygons. */
static size_t count_shared(layer_reader *r)
{
    const geo_layer *l = r->out;
    size_t n = r->n_given, n_shared = 0;
    const layer_side *s = l->sides;
    for (size_t i = 0; i < n && r->n_touches > 0; i++) {
        given_side g = r->given[i];
        s += s->a != g.a || s->b != g.b; /* both lists have the same order */
        for (size_t k = 0; k < s->n_on; k++) {
            add_given(r, g.a, l->on[s->first_on + k], g.polygon);
            g.a = l->on[s->first_on + k];
        }
        r->given[i] = g;
    }
    if (r->n_given > n)
        sort_sides(r->given, &r->n_given, r->lead);
    for (size_t i = 0, end; i < r->n_given; i = end) {
        bool shared = false;
        for (end = i + 1; end < r->n_given && same_ends(&r->given[i], &r->given[end]); end++)
            shared = shared || (r->given[end].polygon != r->given[i].polygon &&
                                r->given[end].polygon != NO_POLYGON);
        n_shared += shared;
    }
    return n_shared;
}

static void weld_positions(layer_reader *r)
{
    geo_layer *l = r->out;
    for (size_t i = 0; i < l->n; i++) {
        l->n_welded += r->lead[l->node[i]] != l->node[i];
        l->node[i] = r->lead[l->node[i]];
    }
}

/* Finds nodes and sides. False if no polygons share sides, so that they are of no use. */
static bool join_sides(layer_reader *r, bool joined)
{
    if (!joined && !contacts_may_share(r->out->n, r->points, r->n_paths, r->paths, r->length))
        return false;
    find_nodes(r);
    weld_nodes(r);
    list_sides(r);
    put_into_sides(r);
    r->out->n_shared = count_shared(r);
    return joined || r->out->n_shared > 0;
}

/* Makes each position a node of its own. */
static void leave_apart(layer_reader *r)
{
    geo_layer *l = r->out;
    free(l->node);
    free(l->nodes);
    free(l->sides);
    free(l->on);
    *l = (geo_layer){.first = l->first, .n = l->n, .n_nodes = l->n, .nodes = r->points};
    r->points = NULL;
}

bool geo_layer_read(geo_layer *out, const geo_index *index, const char *text, double length,
                    bool joined, problem *wrong)
{
    *out = (geo_layer){.first = need(index->n, sizeof *out->first)};
    layer_reader r = {.out = out, .length = length};
    bool good = read_all(&r, index, text, wrong);
    if (good) {
        if (join_sides(&r, joined))
            weld_positions(&r);
        else
            leave_apart(&r);
    }
    free(r.points);
    free(r.paths);
    free(r.given);
    free(r.lead);
    free(r.touches);
    return good;
}

void geo_layer_free(geo_layer *layer)
{
    free(layer->first);
    free(layer->node);
    free(layer->nodes);
    free(layer->images);
    free(layer->status);
    free(layer->snapped);
    free(layer->sides);
    free(layer->on);
    *layer = (geo_layer){0};
}

icc_status geo_layer_map(geo_layer *l, const carrier *c, size_t first, size_t n)
{
    enum { AT_ONCE = 65536 };
    if (first >= l->first_mapped && first + n <= l->first_mapped + l->n_mapped)
        return ICC_OK;
    size_t rest = l->n_nodes - first, wanted = n > AT_ONCE ? n : AT_ONCE;
    l->first_mapped = first;
    l->n_mapped = n = wanted < rest ? wanted : rest;
    l->images = grow(l->images, &l->room_images, 2 * n, sizeof *l->images);
    l->status = grow(l->status, &l->room_status, n, sizeof *l->status);
    l->snapped = grow(l->snapped, &l->room_snapped, n, sizeof *l->snapped);
    return carrier_map(c, n, l->nodes + 2 * first, l->images, l->status, l->snapped);
}

const layer_side *geo_layer_side(const geo_layer *layer, uint32_t a, uint32_t b)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t first = 0, end = layer->n_sides;
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        const layer_side *s = &layer->sides[middle];
        if (s->a < low || (s->a == low && s->b < high))
            first = middle + 1;
        else
            end = middle;
    }
    bool found =
        first < layer->n_sides && layer->sides[first].a == low && layer->sides[first].b == high;
    return found ? &layer->sides[first] : NULL;
}
