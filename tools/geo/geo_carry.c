/* Carries one geometry after the other. A geometry that lies in the cage as a whole, including
 * snapped vertices, is mapped in place. The policy decides about the others. Bounding boxes come
 * last, because they may precede the objects that they bound. */
#include "geo/geo_carry.h"

#include "base/allocate.h"
#include "base/degrees.h"
#include "base/foreign.h"
#include "base/orientation.h"
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
    bool whole = o->top != GEO_NOWHERE && (o->top == c->object || c->policy == GEO_NULL);
    geo_span span = whole ? c->index.objects[o->top].all : o->coordinates;
    edits_replace(&c->out->edits, span.begin, span.end);
    edits_put_text(&c->out->edits, whole ? "null" : "[]");
    c->boxes[c->object] = geo_box_empty();
    if (whole)
        c->index.objects[o->top].live = false;
}

bool geo_leave_out(carriage *c, size_t n_without)
{
    geo_note_fault(c, n_without, c->policy == GEO_FAIL ? "refused" : "null");
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
                .position = node->vertex,
                .from = node->from,
                .along = node->along,
                .open = node->in};
    bool mapped = node->vertex && c->status[node->from] == ICC_OK;
    if (mapped)
        memcpy(v.image, c->images + 2 * node->from, sizeof v.image);
    else if (node->place == GEO_ON_CAGE)
        carrier_facet_point(c->cage, 1, node->facet, (double[2]){1 - node->share, node->share},
                            v.image);
    return v;
}

/* Adds the path that was noded last as a line, with all nodes or only with its vertices. */
static void add_noded(carriage *c, bool all)
{
    polyline *line = geo_add_line(c);
    for (size_t i = 0; i < c->noding.n; i++) {
        vertex v = geo_vertex_of(c, &c->noding.nodes[i]);
        v.open = all ? v.open : i + 1 < c->noding.n;
        if (all || v.position)
            polyline_add(line, &v);
    }
    for (size_t i = 0; i < line->n; i++)
        line->vertices[i].open = line->vertices[i].open && i + 1 < line->n &&
                                 !isnan(line->vertices[i].image[0]) &&
                                 !isnan(line->vertices[i + 1].image[0]);
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
    for (size_t p = 0; p < c->shape.n_paths && (whole || c->policy == GEO_KEEP); p++) {
        whole = noding_path(&c->noding, &c->shape, p, c->status, c->snapped) && whole;
        add_noded(c, c->policy == GEO_KEEP);
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

/* True if a polygon whose rings all lie in the cage contains a hole of the cage. */
static bool covers_hole(const carriage *c)
{
    for (size_t k = 0; k < c->cage->n_holes; k++)
        if (is_around(&c->shape, c->cage->in_holes + 2 * k))
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
    return (geo_writer){&c->out->edits, c->text, &c->shape, &c->boxes[c->object]};
}

static bool map_positions(carriage *c, size_t *n_without)
{
    size_t n = c->shape.n;
    c->images = grow(c->images, &c->room_images, 2 * n, sizeof *c->images);
    c->status = grow(c->status, &c->room_status, n, sizeof *c->status);
    c->snapped = grow(c->snapped, &c->room_snapped, n, sizeof *c->snapped);
    icc_status ran = carrier_map(c->cage, n, c->shape.points, c->images, c->status, c->snapped);
    if (ran != ICC_OK)
        return stop(c, ran);
    *n_without = 0;
    for (size_t i = 0; i < n; i++)
        *n_without += c->status[i] != ICC_OK;
    c->out->n_positions += n;
    c->out->n_without += *n_without;
    return true;
}

/* Makes c->lines accurate, or finds that this is impossible. */
static bool refine(carriage *c, bool *whole)
{
    for (size_t l = 0; l < c->n_lines && *whole; l++) {
        if (polyline_densify(&c->lines[l], c->cage, c->tolerance, c->wrong) != DONE)
            return false;
        *whole = c->policy == GEO_KEEP || !geo_has_gap(&c->lines[l]);
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

/* Maps a geometry in place if it lies in the cage as a whole or is to be kept. Otherwise it follows
 * the policy. */
static bool carry_geometry(carriage *c)
{
    const geo_object *o = geo_current(c);
    size_t n_without = 0;
    if (!geo_shape_read(&c->shape, o, c->text, c->wrong))
        return false;
    if (c->shape.n == 0)
        return true;
    if (!map_positions(c, &n_without))
        return false;
    bool points = o->type <= GEO_MULTI_POINT;
    c->out->n_jumps += points ? 0 : count_jumps(&c->shape);
    bool whole = points ? take_points(c) : node_all(c) && n_without == 0;
    if (whole && c->policy == GEO_CLIP && o->type > GEO_MULTI_LINE)
        whole = !covers_hole(c);
    if (c->noding.status != ICC_OK)
        return stop(c, c->noding.status);
    bool writes = whole || c->policy == GEO_KEEP;
    if (writes && !refine(c, &writes))
        return false;
    if (!writes)
        return c->policy == GEO_CLIP ? geo_cut(c, n_without) : geo_leave_out(c, n_without);
    geo_writer w = geo_writer_of(c);
    geo_write_in_place(&w, o->coordinates, c->n_lines, c->lines);
    if (!whole)
        geo_note_fault(c, n_without, "kept");
    return true;
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
    return good && geo_set_boxes(c);
}

bool geo_carry(geo_result *out, const carrier *carries, geo_policy policy, double tolerance,
               const char *text, size_t n, problem *wrong)
{
    carriage c = {.cage = carries,
                  .policy = policy,
                  .tolerance = tolerance,
                  .text = text,
                  .out = out,
                  .wrong = wrong,
                  .line = 1};
    *out = (geo_result){0};
    noding_start(&c.noding, carries);
    bool good = !foreign_told(text, n, wrong) && !foreign_table_told(text, wrong) &&
                geo_index_read(&c.index, text, n, wrong);
    out->sequence = c.index.sequence;
    if (good) {
        c.boxes = need(c.index.n, sizeof *c.boxes);
        good = carry_objects(&c);
    }
    for (size_t l = 0; l < c.room_lines; l++)
        polyline_free(&c.lines[l]);
    free(c.lines);
    free(c.images);
    free(c.status);
    free(c.snapped);
    free(c.boxes);
    geo_shape_free(&c.shape);
    geo_index_free(&c.index);
    noding_free(&c.noding);
    return good;
}

void geo_result_free(geo_result *r)
{
    edits_free(&r->edits);
    free(r->faults);
    *r = (geo_result){0};
}
