/* Makes the shape of a geometry that is carried, and the images of its vertices. Vertices that
 * neighbours have on its sides are put in, so that both sides of a border stay the same. */
#include "geo/geo_carriage.h"

#include "base/allocate.h"
#include "geo/crossing.h"

#include <math.h>
#include <string.h>

/* Makes room for n vertices of the shape. */
static void make_room(carriage *c, size_t n)
{
    c->origins = grow(c->origins, &c->room_origins, n, sizeof *c->origins);
    c->images = grow(c->images, &c->room_images, 2 * n, sizeof *c->images);
    c->status = grow(c->status, &c->room_status, n, sizeof *c->status);
    c->snapped = grow(c->snapped, &c->room_snapped, n, sizeof *c->snapped);
    c->shape.points = grow(c->shape.points, &c->shape.room_points, 2 * n, sizeof *c->shape.points);
}

/* Adds a node of the layer to the shape. */
static void add_vertex(carriage *c, origin o)
{
    size_t i = c->shape.n++;
    const geo_layer *l = &c->layer;
    make_room(c, i + 1);
    c->origins[i] = o;
    memcpy(c->images + 2 * i, l->images + 2 * (size_t)o.node, 2 * sizeof *c->images);
    memcpy(c->shape.points + 2 * i, l->nodes + 2 * (size_t)o.node, 2 * sizeof *c->images);
    c->status[i] = l->status[o.node];
    c->snapped[i] = l->snapped[o.node];
}

/* Takes the images of the nodes from `first` on. A geometry that has waited comes after later ones.
 * It is mapped by itself, so that their images stay. */
static icc_status take_images(carriage *c, size_t first, size_t n)
{
    geo_layer *l = &c->layer;
    if (first < l->first_mapped)
        return carrier_map(c->cage, n, l->nodes + 2 * first, c->images, c->status, c->snapped);
    icc_status ran = geo_layer_map(l, c->cage, first, n);
    if (ran != ICC_OK)
        return ran;
    size_t at = first - l->first_mapped;
    memcpy(c->images, l->images + 2 * at, 2 * n * sizeof *c->images);
    memcpy(c->status, l->status + at, n * sizeof *c->status);
    memcpy(c->snapped, l->snapped + at, n * sizeof *c->snapped);
    return ICC_OK;
}

/* Makes the shape of the one that has been read, whose positions are nodes of their own. False: see
 * c->wrong. */
static bool take_all(carriage *c)
{
    size_t n = c->read.n, first = c->layer.first[c->object];
    make_room(c, n);
    for (size_t i = 0; i < n; i++)
        c->origins[i] = (origin){.position = true, .from = i, .node = (uint32_t)(first + i)};
    memcpy(c->shape.points, c->layer.nodes + 2 * first, 2 * n * sizeof *c->images);
    if (c->read.n_paths > 0)
        memcpy(c->shape.paths, c->read.paths, c->read.n_paths * sizeof *c->shape.paths);
    c->shape.n = n;
    icc_status ran = take_images(c, first, n);
    return ran == ICC_OK || geo_stop(c, ran);
}

/* Adds the nodes that are put into the side from a position to the next one. */
static void add_nodes_between(carriage *c, origin from, uint32_t to)
{
    const geo_layer *l = &c->layer;
    const layer_side *s = geo_layer_side(l, from.node, to);
    if (s == NULL)
        return;
    const double *a = l->nodes + 2 * (size_t)from.node, *b = l->nodes + 2 * (size_t)to;
    for (size_t k = 0; k < s->n_on; k++) {
        bool forwards = s->a == from.node;
        uint32_t node = l->on[s->first_on + (forwards ? k : s->n_on - 1 - k)];
        double way = point_distance(a, b), off = point_distance(a, l->nodes + 2 * (size_t)node);
        add_vertex(c, (origin){.from = from.from, .along = fmin(off / way, 1), .node = node});
    }
}

bool geo_take_shape(carriage *c)
{
    const geo_shape *read = &c->read;
    geo_shape *s = &c->shape;
    s->n = 0;
    s->type = read->type;
    s->n_parts = read->n_parts;
    s->n_paths = read->n_paths;
    s->paths = grow(s->paths, &s->room_paths, s->n_paths, sizeof *s->paths);
    if (c->layer.node == NULL)
        return take_all(c);
    const uint32_t *node = c->layer.node + c->layer.first[c->object];
    for (size_t p = 0; p < s->n_paths; p++) {
        const geo_path *path = &read->paths[p];
        s->paths[p] = (geo_path){.first = s->n, .part = path->part};
        for (size_t i = path->first; i < path->first + path->n; i++) {
            origin o = {.position = true, .from = i, .node = node[i]};
            add_vertex(c, o);
            if (i + 1 < path->first + path->n)
                add_nodes_between(c, o, node[i + 1]);
        }
        s->paths[p].n = s->n - s->paths[p].first;
    }
    return true;
}
