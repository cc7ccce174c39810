/* Carries one geometry after the other. A geometry that lies in the cage as a whole, including
 * snapped vertices, is mapped in place. The policy decides about the others. Bounding boxes come
 * last, because they may precede the objects that they bound. */
#include "geo/geo_carry.h"

#include "base/allocate.h"
#include "base/degrees.h"
#include "base/foreign.h"
#include "base/orientation.h"
#include "geo/crossing.h"
#include "geo/geo_carriage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

geo_object *geo_current(const carriage *c)
{
    return &c->index.objects[c->object];
}

static bool stop(carriage *c, icc_status status)
{
    return spoilt(c->wrong, 0, "%s", icc_status_name(status));
}

/* The feature of a geometry, or the geometry itself. */
static uint32_t unit_of(const carriage *c, uint32_t object)
{
    uint32_t top = c->index.objects[object].top;
    return top != GEO_NOWHERE ? c->index.objects[top].parent : object;
}

void geo_note_fault(carriage *c, size_t n_without, const char *fate)
{
    geo_result *out = c->out;
    uint32_t unit = unit_of(c, c->object);
    const geo_object *o = &c->index.objects[unit];
    if (out->n_faults == 0 || c->fault_of != unit) {
        for (; c->line_at < o->all.begin; c->line_at++)
            c->line += c->text[c->line_at] == '\n';
        out->faults = grow(out->faults, &out->room_faults, out->n_faults + 1, sizeof *out->faults);
        out->faults[out->n_faults++] = (geo_fault){.feature = o->type == GEO_FEATURE,
                                                   .number = o->number,
                                                   .id = o->id,
                                                   .line = c->line,
                                                   .fate = fate};
        c->fault_of = unit;
    }
    geo_fault *fault = &out->faults[out->n_faults - 1];
    fault->n_without += n_without;
    if (strcmp(fate, "null") == 0)
        fault->fate = fate;
}

/* Empties a geometry. A feature's becomes null. One that belongs to no feature, or is one of
 * several, becomes empty, which readers treat as missing. */
static void empty_geometry(carriage *c)
{
    const geo_object *o = geo_current(c);
    bool whole = o->top != GEO_NOWHERE && (o->top == c->object || c->options->policy == GEO_NULL);
    geo_span span = whole ? c->index.objects[o->top].all : o->coordinates;
    edits_replace(&c->out->edits, span.begin, span.end);
    edits_put_text(&c->out->edits, whole ? "null" : "[]");
    c->boxes[c->object] = geo_box_empty();
    if (whole)
        c->index.objects[o->top].live = false;
}

bool geo_leave_out(carriage *c, size_t n_without)
{
    geo_note_fault(c, n_without, c->options->policy == GEO_FAIL ? "refused" : "null");
    empty_geometry(c);
    return true;
}

polyline *geo_add_line(carriage *c)
{
    if (c->n_lines == c->room_lines) {
        size_t before = c->room_lines;
        c->lines = grow(c->lines, &c->room_lines, c->n_lines + 1, sizeof *c->lines);
        memset(c->lines + before, 0, (c->room_lines - before) * sizeof *c->lines);
    }
    c->lines[c->n_lines].n = 0;
    return &c->lines[c->n_lines++];
}

vertex geo_vertex_of(const carriage *c, const geo_node *node)
{
    vertex v = {.point = {node->at[0], node->at[1]},
                .image = {NAN, NAN},
                .from = node->from,
                .on_cage = node->place == GEO_ON_CAGE,
                .open = node->in};
    if (node->from != SIZE_MAX) {
        const origin *o = &c->origins[node->from];
        bool same = node->from + 1 < c->shape.n && o[1].from == o->from;
        v.position = node->vertex && o->position;
        v.from = o->from;
        v.along = o->along + node->along * ((same ? o[1].along : 1) - o->along);
    }
    bool mapped = node->vertex && c->status[node->from] == ICC_OK;
    if (mapped)
        memcpy(v.image, c->images + 2 * node->from, sizeof v.image);
    else if (node->place == GEO_ON_CAGE)
        carrier_facet_point(c->cage, 1, node->facet, (double[2]){1 - node->share, node->share},
                            v.image);
    return v;
}

/* Closes pieces along an edge of the cage, where the map is linear. */
static void close_on_cage(carriage *c, polyline *line)
{
    for (size_t i = 0; i + 1 < line->n; i++) {
        vertex *v = &line->vertices[i];
        double share[2];
        if (v->open && v[0].on_cage && v[1].on_cage)
            v->open = noding_common_edge(&c->noding, v[0].point, v[1].point, &share[0],
                                         &share[1]) == GEO_NOWHERE;
    }
}

bool geo_refine_line(carriage *c, polyline *line)
{
    close_on_cage(c, line);
    if (c->edges == NULL)
        return polylines_densify(1, &line, c->cage, c->options->tolerance, c->wrong) == DONE;
    polyline_cut(line, c->edges, c->options->drop);
    return true;
}

/* Adds the path that was noded last as a line, with all nodes or only with its vertices. */
static void add_noded(carriage *c, bool all)
{
    polyline *line = geo_add_line(c);
    for (size_t i = 0; i < c->noding.n; i++) {
        vertex v = geo_vertex_of(c, &c->noding.nodes[i]);
        v.open = all ? v.open : i + 1 < c->noding.n;
        if (all || c->noding.nodes[i].vertex)
            polyline_add(line, &v);
    }
    for (size_t i = 0; i < line->n; i++)
        line->vertices[i].open = line->vertices[i].open && i + 1 < line->n &&
                                 !isnan(line->vertices[i].image[0]) &&
                                 !isnan(line->vertices[i + 1].image[0]);
}

/* Adds a path that meets no edge of the cage as a line. */
static void add_free(carriage *c, size_t path)
{
    polyline *line = geo_add_line(c);
    const geo_path *p = &c->shape.paths[path];
    line->vertices = grow(line->vertices, &line->room, p->n, sizeof *line->vertices);
    line->n = p->n;
    for (size_t k = 0; k < p->n; k++) {
        size_t i = p->first + k;
        const origin *o = &c->origins[i];
        vertex *v = &line->vertices[k];
        *v = (vertex){
            .position = o->position, .from = o->from, .along = o->along, .open = k + 1 < p->n};
        memcpy(v->point, c->shape.points + 2 * i, sizeof v->point);
        memcpy(v->image, c->images + 2 * i, sizeof v->image);
    }
}

bool geo_has_gap(const polyline *line)
{
    for (size_t i = 0; i < line->n; i++)
        if (isnan(line->vertices[i].image[0]))
            return true;
    return false;
}

/* Nodes all paths of a geometry as lines. Returns true if all of it lies in the cage. */
static bool node_all(carriage *c)
{
    bool whole = true;
    c->n_lines = 0;
    for (size_t p = 0; p < c->shape.n_paths && (whole || c->options->policy == GEO_KEEP); p++) {
        if (noding_is_free(&c->noding, &c->shape, p, c->status, c->snapped)) {
            add_free(c, p);
            continue;
        }
        whole = noding_path(&c->noding, &c->shape, p, c->status, c->snapped) && whole;
        add_noded(c, c->options->policy == GEO_KEEP || c->edges != NULL);
    }
    return whole;
}

/* True if one of the polygons contains a point: a ray to the right of it meets the rings an odd
 * number of times. */
static bool is_around(const geo_shape *s, const double p[2])
{
    bool odd = false;
    for (size_t r = 0; r < s->n_paths; r++) {
        if (r > 0 && s->paths[r].part != s->paths[r - 1].part && odd)
            return true;
        for (size_t i = 1; i < s->paths[r].n; i++) {
            const double *b = s->points + 2 * (s->paths[r].first + i), *a = b - 2;
            if ((a[1] > p[1]) != (b[1] > p[1]))
                odd ^= orientation(a, b, p) * (b[1] > a[1] ? 1 : -1) > 0;
        }
    }
    return odd;
}

/* True if a polygon whose rings all lie in the cage contains a lake. */
static bool covers_lake(const carriage *c)
{
    for (size_t k = 0; k < c->lakes.n; k++)
        if (is_around(&c->shape, c->lakes.points + 2 * k))
            return true;
    return false;
}

/* Points are lines without pieces. */
static bool take_points(carriage *c)
{
    bool whole = true;
    c->n_lines = 0;
    polyline *line = geo_add_line(c);
    for (size_t i = 0; i < c->shape.n; i++) {
        geo_node node = {.at = {c->shape.points[2 * i], c->shape.points[2 * i + 1]},
                         .place = GEO_INSIDE,
                         .vertex = true,
                         .from = i};
        vertex v = geo_vertex_of(c, &node);
        polyline_add(line, &v);
        whole = whole && c->status[i] == ICC_OK;
    }
    return whole;
}

geo_writer geo_writer_of(carriage *c)
{
    return (geo_writer){&c->out->edits, c->text, &c->read, &c->boxes[c->object]};
}

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
    return ran == ICC_OK || stop(c, ran);
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

/* Makes the shape that is carried of the one that has been read. False: see c->wrong. */
static bool put_nodes_in(carriage *c)
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

/* Counts the positions of the text that have no image. */
static size_t count_without(carriage *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->shape.n; i++)
        n += c->origins[i].position && c->status[i] != ICC_OK;
    c->out->n_positions += c->read.n;
    c->out->n_without += n;
    return n;
}

/* Makes c->lines accurate, or finds that this is impossible. */
static bool refine(carriage *c, bool *whole)
{
    for (size_t l = 0; l < c->n_lines && *whole; l++) {
        if (!geo_refine_line(c, &c->lines[l]))
            return false;
        *whole = c->options->policy == GEO_KEEP || !geo_has_gap(&c->lines[l]);
    }
    return true;
}

static size_t count_jumps(const geo_shape *s)
{
    size_t n = 0;
    for (size_t p = 0; p < s->n_paths && are_degrees(s->n, s->points); p++) {
        bool jumps = false;
        for (size_t i = 1; i < s->paths[p].n; i++) {
            const double *at = s->points + 2 * (s->paths[p].first + i);
            jumps = jumps || longitudes_jump(at[-2], at[0]);
        }
        n += jumps;
    }
    return n;
}

/* Ends a geometry whose lines are refined, if it still `writes`, or else cuts it or leaves it out. */
static bool end_geometry(carriage *c, size_t n_without, bool whole, bool writes)
{
    if (!writes)
        return c->options->policy == GEO_CLIP ? geo_cut(c, n_without) : geo_leave_out(c, n_without);
    geo_writer w = geo_writer_of(c);
    geo_write_in_place(&w, geo_current(c)->coordinates, c->n_lines, c->lines);
    if (!whole)
        geo_note_fault(c, n_without, "kept");
    return true;
}

/* Exchanges the current geometry and one that waits. */
static void exchange(carriage *c, waiting *w)
{
    waiting own = {
        .read = c->read, .lines = c->lines, .n_lines = c->n_lines, .room_lines = c->room_lines};
    c->read = w->read;
    c->lines = w->lines;
    c->n_lines = w->n_lines;
    c->room_lines = w->room_lines;
    w->read = own.read;
    w->lines = own.lines;
    w->n_lines = own.n_lines;
    w->room_lines = own.room_lines;
}

/* Refines the lines of all geometries that wait. */
static bool refine_waiting(carriage *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n_waiting; i++)
        n += c->waits[i].n_lines;
    polyline **lines = need(n, sizeof *lines);
    n = 0;
    for (size_t i = 0; i < c->n_waiting; i++)
        for (size_t l = 0; l < c->waits[i].n_lines; l++) {
            lines[n] = &c->waits[i].lines[l];
            close_on_cage(c, lines[n++]);
        }
    bool good = polylines_densify(n, lines, c->cage, c->options->tolerance, c->wrong) == DONE;
    free(lines);
    return good;
}

/* Refines the lines of all geometries that wait, and writes these. */
static bool flush(carriage *c)
{
    uint32_t current = c->object;
    bool good = refine_waiting(c);
    for (size_t i = 0; i < c->n_waiting && good; i++) {
        waiting *w = &c->waits[i];
        bool writes = true;
        exchange(c, w);
        c->object = w->object;
        for (size_t l = 0; l < c->n_lines && c->options->policy != GEO_KEEP; l++)
            writes = writes && !geo_has_gap(&c->lines[l]);
        good = (writes || put_nodes_in(c)) && end_geometry(c, w->n_without, w->whole, writes);
        exchange(c, w);
    }
    c->n_waiting = c->n_vertices = 0;
    c->object = current;
    return good;
}

/* Lets the current geometry wait. */
static bool wait_for_others(carriage *c, size_t n_without, bool whole)
{
    enum { ENOUGH = 8192 }; /* vertices */
    if (c->n_waiting == c->room_waiting) {
        size_t before = c->room_waiting;
        c->waits = grow(c->waits, &c->room_waiting, c->n_waiting + 1, sizeof *c->waits);
        memset(c->waits + before, 0, (c->room_waiting - before) * sizeof *c->waits);
    }
    waiting *w = &c->waits[c->n_waiting++];
    exchange(c, w);
    w->object = c->object;
    w->n_without = n_without;
    w->whole = whole;
    for (size_t l = 0; l < w->n_lines; l++)
        c->n_vertices += w->lines[l].n;
    return c->n_vertices < ENOUGH || flush(c);
}

/* Flushes what waits before the current geometry, which is kept. */
static bool flush_before(carriage *c)
{
    if (c->n_waiting == 0)
        return true;
    return flush(c) && put_nodes_in(c);
}

/* Maps a geometry in place if it lies in the cage as a whole or is to be kept. Otherwise it follows
 * the policy. Lines that are sampled wait for others. Faults are noted in the order of the text. */
static bool carry_geometry(carriage *c)
{
    const geo_object *o = geo_current(c);
    const geo_layer *l = &c->layer;
    const bool is_known = l->node == NULL && l->nodes != NULL;
    const double *known = is_known ? l->nodes + 2 * l->first[c->object] : NULL;
    if (!geo_shape_read(&c->read, o, c->text, known, c->wrong))
        return false;
    if (c->read.n == 0)
        return true;
    if (!put_nodes_in(c))
        return false;
    size_t n_without = count_without(c);
    bool points = o->type <= GEO_MULTI_POINT;
    c->out->n_jumps += points ? 0 : count_jumps(&c->read);
    bool whole = points ? take_points(c) : node_all(c) && n_without == 0;
    if (whole && c->options->policy == GEO_CLIP && o->type > GEO_MULTI_LINE)
        whole = !covers_lake(c);
    if (c->noding.status != ICC_OK)
        return stop(c, c->noding.status);
    bool writes = whole || c->options->policy == GEO_KEEP;
    if (writes && !points && c->edges == NULL)
        return wait_for_others(c, n_without, whole);
    if (!whole && !flush_before(c))
        return false;
    if (writes && !refine(c, &writes))
        return false;
    return end_geometry(c, n_without, whole, writes);
}

static bool carry_objects(carriage *c)
{
    bool good = true;
    for (size_t i = 0; i < c->index.n && good; i++) {
        const geo_object *o = &c->index.objects[i];
        c->object = (uint32_t)i;
        c->boxes[i] = geo_box_empty();
        c->out->n_features += o->live && (o->type == GEO_FEATURE ||
                                          (o->type < GEO_GEOMETRIES && o->top == GEO_NOWHERE));
        if (o->live && o->type < GEO_GEOMETRIES)
            good = carry_geometry(c);
    }
    return good && flush(c) && geo_set_boxes(c);
}

/* Reads the layer as a whole, maps its nodes, and decides how lines are mapped. */
static bool prepare_layer(carriage *c, map_edges *edges)
{
    geo_layer *l = &c->layer;
    bool exact = c->options->exact;
    if (!geo_layer_read(l, &c->index, c->text, c->cage->snap, exact, c->wrong))
        return false;
    if ((exact || l->n_shared > 0) && map_edges_make(edges, &c->noding))
        c->edges = edges;
    else if (exact)
        return spoilt(c->wrong, 0, "exact lines need the triangles of a mesh map");
    c->out->exact = c->edges != NULL;
    c->out->n_shared = l->n_shared;
    c->out->n_put_in = l->n_on;
    icc_status ran = l->node != NULL ? geo_layer_map(l, c->cage, 0, l->n_nodes) : ICC_OK;
    return ran == ICC_OK || stop(c, ran);
}

static void free_carriage(carriage *c)
{
    for (size_t l = 0; l < c->room_lines; l++)
        polyline_free(&c->lines[l]);
    free(c->lines);
    for (size_t i = 0; i < c->room_waiting; i++) {
        waiting *w = &c->waits[i];
        for (size_t l = 0; l < w->room_lines; l++)
            polyline_free(&w->lines[l]);
        free(w->lines);
        geo_shape_free(&w->read);
    }
    free(c->waits);
    free(c->origins);
    free(c->images);
    free(c->status);
    free(c->snapped);
    free(c->boxes);
    geo_shape_free(&c->read);
    geo_shape_free(&c->shape);
    geo_index_free(&c->index);
    geo_layer_free(&c->layer);
    noding_free(&c->noding);
    lakes_free(&c->lakes);
}

bool geo_carry(geo_result *out, const carrier *carries, const geo_options *options,
               const char *text, size_t n, problem *wrong)
{
    carriage c = {
        .cage = carries, .options = options, .text = text, .out = out, .wrong = wrong, .line = 1};
    map_edges edges = {0};
    *out = (geo_result){0};
    noding_start(&c.noding, carries);
    if (options->policy == GEO_CLIP)
        lakes_find(&c.lakes, carries);
    bool good = !foreign_told(text, n, wrong) && !foreign_table_told(text, wrong) &&
                geo_index_read(&c.index, text, n, wrong);
    out->sequence = c.index.sequence;
    if (good && prepare_layer(&c, &edges)) {
        c.boxes = need(c.index.n, sizeof *c.boxes);
        good = carry_objects(&c);
    } else
        good = false;
    map_edges_free(&edges);
    free_carriage(&c);
    return good;
}

void geo_result_free(geo_result *r)
{
    edits_free(&r->edits);
    free(r->faults);
    *r = (geo_result){0};
}
