/* Carries one geometry after the other. A geometry that lies in the cage as a whole, including
 * snapped vertices, is mapped in place. The policy decides about the others. Bounding boxes come
 * last, because they may precede the objects that they bound. */
#include "geo/geo_carry.h"

#include "base/allocate.h"
#include "base/degrees.h"
#include "base/foreign.h"
#include "base/orientation.h"
#include "geo/geo_carriage.h"

#include <stdlib.h>
#include <string.h>

geo_object *geo_current(const carriage *c)
{
    return &c->index.objects[c->object];
}

bool geo_stop(carriage *c, icc_status status)
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

geo_writer geo_writer_of(carriage *c)
{
    return (geo_writer){&c->out->edits, c->text, &c->read, &c->boxes[c->object]};
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

bool geo_end(carriage *c, size_t n_without, bool whole, bool writes)
{
    if (!writes)
        return c->options->policy == GEO_CLIP ? geo_cut(c, n_without) : geo_leave_out(c, n_without);
    geo_writer w = geo_writer_of(c);
    geo_write_in_place(&w, geo_current(c)->coordinates, c->n_lines, c->lines);
    if (!whole)
        geo_note_fault(c, n_without, "kept");
    return true;
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
    if (!geo_take_shape(c))
        return false;
    size_t n_without = count_without(c);
    bool points = o->type <= GEO_MULTI_POINT;
    c->out->n_jumps += points ? 0 : count_jumps(&c->read);
    bool whole = points ? geo_take_points(c) : geo_take_paths(c) && n_without == 0;
    if (whole && c->options->policy == GEO_CLIP && o->type > GEO_MULTI_LINE)
        whole = !covers_lake(c);
    if (c->noding.status != ICC_OK)
        return geo_stop(c, c->noding.status);
    bool writes = whole || c->options->policy == GEO_KEEP;
    if (writes && !points && c->edges == NULL)
        return geo_wait(c, n_without, whole);
    if (!whole && !geo_flush_before(c))
        return false;
    if (writes && !refine(c, &writes))
        return false;
    return geo_end(c, n_without, whole, writes);
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
    return good && geo_flush(c) && geo_set_boxes(c);
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
    return ran == ICC_OK || geo_stop(c, ran);
}

static void free_carriage(carriage *c)
{
    for (size_t l = 0; l < c->room_lines; l++)
        polyline_free(&c->lines[l]);
    free(c->lines);
    geo_waits_free(c);
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
