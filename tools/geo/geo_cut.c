/* Geometries that lie partly in the cage, cut along it and carried. */
#include "geo/clip.h"
#include "geo/geo_carriage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void set_type(carriage *c, const char *type)
{
    geo_span span = geo_current(c)->type_name;
    edits_replace(&c->out->edits, span.begin, span.end);
    edits_put_text(&c->out->edits, type);
}

/* Ends the list being written and returns the fate of the geometry. */
static bool end_cut(carriage *c, size_t n_without, size_t n_written)
{
    if (n_written == 0)
        return geo_leave_out(c, n_without);
    geo_note_fault(c, n_without, "clipped");
    return true;
}

static bool cut_points(carriage *c, size_t n_without)
{
    geo_writer w = geo_writer_of(c);
    polyline kept = {0};
    for (size_t i = 0; i < c->lines[0].n; i++)
        if (!isnan(c->lines[0].vertices[i].image[0]))
            polyline_add(&kept, &c->lines[0].vertices[i]);
    size_t n = kept.n;
    if (n > 0) {
        edits_replace(&c->out->edits, geo_current(c)->coordinates.begin,
                      geo_current(c)->coordinates.end);
        geo_write_list(&w, &kept, 0, n);
    }
    polyline_free(&kept);
    return end_cut(c, n_without, n);
}

/* Adds the parts of a path that lie in the cage as lines. */
static void add_parts(carriage *c)
{
    const noding *x = &c->noding;
    for (size_t i = 0; i + 1 < x->n; i++) {
        if (!x->nodes[i].in)
            continue;
        polyline *line = geo_add_line(c);
        size_t end = i;
        for (; end + 1 < x->n && x->nodes[end].in; end++) {
            vertex v = geo_vertex_of(c, &x->nodes[end]);
            polyline_add(line, &v);
        }
        vertex v = geo_vertex_of(c, &x->nodes[end]);
        v.open = false;
        polyline_add(line, &v);
        i = end - 1;
    }
}

/* Counts the parts of a line between gaps of the map, where its curves do not reach. If `write` is
 * set, adds them to a list. */
static size_t write_parts(geo_writer *w, const polyline *line, bool write, size_t n_before)
{
    size_t n = n_before;
    for (size_t i = 0, end; i < line->n; i = end + 1) {
        for (end = i; end < line->n && !isnan(line->vertices[end].image[0]);)
            end++;
        if (end < i + 2)
            continue;
        if (write && n > 0)
            edits_put_text(w->edits, ", ");
        if (write)
            geo_write_list(w, line, i, end);
        n++;
    }
    return n;
}

/* Cuts lines at the cage and at gaps of the map. */
static bool cut_lines(carriage *c, size_t n_without)
{
    const geo_object *o = geo_current(c);
    size_t n = 0;
    c->n_lines = 0;
    for (size_t p = 0; p < c->shape.n_paths; p++) {
        noding_path(&c->noding, &c->shape, p, c->status, c->snapped);
        add_parts(c);
    }
    for (size_t l = 0; l < c->n_lines; l++) {
        if (!geo_refine_line(c, &c->lines[l]))
            return false;
        n = write_parts(NULL, &c->lines[l], false, n);
    }
    if (n > 0) {
        geo_writer w = geo_writer_of(c);
        bool several = o->type == GEO_MULTI_LINE || n > 1;
        if (several && o->type == GEO_LINE)
            set_type(c, "\"MultiLineString\"");
        edits_replace(&c->out->edits, o->coordinates.begin, o->coordinates.end);
        edits_put_text(&c->out->edits, several ? "[" : "");
        size_t written = 0;
        for (size_t l = 0; l < c->n_lines; l++)
            written = write_parts(&w, &c->lines[l], true, written);
        edits_put_text(&c->out->edits, several ? "]" : "");
    }
    return end_cut(c, n_without, n);
}

/* Adds a ring of a clipped polygon as a line with the orientation of the original. Corners of the
 * cage get their heights from the node before. */
static void add_ring(carriage *c, const clipped *cut, const clip_ring *ring, size_t first_position,
                     bool reversed)
{
    polyline *line = geo_add_line(c);
    size_t from = c->origins[first_position].from;
    double along = 0;
    for (size_t i = 0; i <= ring->n; i++) {
        size_t k = i % ring->n;
        vertex v = geo_vertex_of(c, &cut->nodes[ring->first + (reversed ? ring->n - 1 - k : k)]);
        if (v.from == SIZE_MAX) {
            v.from = from;
            v.along = along;
        }
        from = v.from;
        along = v.along;
        v.open = i < ring->n;
        polyline_add(line, &v);
    }
    /* The first one may have been a corner. */
    line->vertices[0].from = line->vertices[ring->n].from;
    line->vertices[0].along = line->vertices[ring->n].along;
}

static bool is_closed(const geo_shape *s, const geo_path *p)
{
    return p->n > 3 && memcmp(s->points + 2 * p->first, s->points + 2 * (p->first + p->n - 1),
                              2 * sizeof *s->points) == 0;
}

/* The polygons of a geometry while they are cut and written. */
typedef struct cutting {
    size_t n_polygons;
    bool failed; /* one could not be cut */
} cutting;

/* Writes the rings in c->lines as a polygon, unless the map has a gap in one of them. */
static bool write_polygon(carriage *c, cutting *to)
{
    geo_writer w = geo_writer_of(c);
    for (size_t l = 0; l < c->n_lines; l++) {
        if (!geo_refine_line(c, &c->lines[l]))
            return false;
        if (geo_has_gap(&c->lines[l])) {
            to->failed = true;
            return true;
        }
    }
    edits_put_text(&c->out->edits, to->n_polygons++ > 0 ? ", " : "");
    for (size_t l = 0; l < c->n_lines; l++) {
        edits_put_text(&c->out->edits, l > 0 ? ", " : "[");
        geo_write_list(&w, &c->lines[l], 0, c->lines[l].n);
    }
    edits_put_text(&c->out->edits, "]");
    return true;
}

/* Cuts the polygon of the paths first .. end - 1. */
static bool cut_polygon(carriage *c, size_t first, size_t end, cutting *to)
{
    const geo_path *outer = &c->shape.paths[first];
    bool closed = true, good = true;
    for (size_t p = first; p < end; p++)
        closed = closed && (is_closed(&c->shape, &c->shape.paths[p]) || c->shape.paths[p].n == 0);
    clipped cut = {0};
    if (!closed ||
        !clip_polygon(&cut, &c->noding, &c->shape, first, end - first, c->status, c->snapped))
        to->failed = true;
    bool reversed = ring_area(outer->n, c->shape.points + 2 * outer->first, 2) < 0;
    for (size_t r = 0, next; r < cut.n_rings && good && !to->failed; r = next) {
        c->n_lines = 0;
        for (next = r; next < cut.n_rings && cut.rings[next].part == cut.rings[r].part; next++)
            add_ring(c, &cut, &cut.rings[next], outer->first, reversed);
        good = write_polygon(c, to);
    }
    clipped_free(&cut);
    return good;
}

/* Cuts polygons one by one. If one cannot be cut, or nothing is left, the output is taken back. */
static bool cut_polygons(carriage *c, size_t n_without)
{
    const geo_object *o = geo_current(c);
    edits *e = &c->out->edits;
    cutting to = {0};
    size_t type_edit = e->n, paths = c->shape.n_paths;
    geo_box before = c->boxes[c->object];
    set_type(c, "\"MultiPolygon\"");
    edits_replace(e, o->coordinates.begin, o->coordinates.end);
    edits_put_text(e, "[");
    size_t content = e->n_bytes;
    for (size_t p = 0, end; p < paths && !to.failed; p = end) {
        for (end = p; end < paths && (o->type == GEO_POLYGON ||
                                      c->shape.paths[end].part == c->shape.paths[p].part);)
            end++;
        if (!cut_polygon(c, p, end, &to))
            return false;
    }
    if (to.failed || to.n_polygons == 0) {
        e->n = type_edit;
        c->boxes[c->object] = before;
        return geo_leave_out(c, n_without);
    }
    if (to.n_polygons == 1 && o->type == GEO_POLYGON) {
        e->list[type_edit] = e->list[type_edit + 1];
        e->list[type_edit].from = content;
        e->n = type_edit + 1;
    } else
        edits_put_text(e, "]");
    return end_cut(c, n_without, to.n_polygons);
}

bool geo_cut(carriage *c, size_t n_without)
{
    geo_type type = geo_current(c)->type;
    return type <= GEO_MULTI_POINT  ? cut_points(c, n_without)
           : type <= GEO_MULTI_LINE ? cut_lines(c, n_without)
                                    : cut_polygons(c, n_without);
}
