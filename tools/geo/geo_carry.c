/* Geometry by geometry: one that is in the cage as a whole, snapped vertices included, is mapped in place; what
 * becomes of the others is the policy's business. Bounding boxes come last, since they may stand before what
 * they bound. */
#include "geo/geo_carry.h"

#include "base/allocate.h"
#include "cage/cage.h"
#include "geo/clip.h"
#include "geo/geo_write.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct carriage {
    const carrier *cage;
    noding noding;
    geo_policy policy;
    double tolerance;
    const char *text;
    geo_index index;
    geo_box *boxes; /* one per object: of what is in it */
    geo_result *out;
    problem *wrong;
    size_t line, line_at; /* the line of a place in the text, for the next one behind it */
    uint32_t fault_of;    /* the object of the last fault */
    /* of the geometry at hand */
    uint32_t object;
    geo_shape shape;
    double *images;
    icc_status *status;
    bool *snapped;
    size_t room_images, room_status, room_snapped;
    polyline *lines;
    size_t n_lines, room_lines;
} carriage;

static geo_object *current(const carriage *c)
{
    return &c->index.objects[c->object];
}

static bool stop(carriage *c, icc_status status)
{
    return spoilt(c->wrong, 0, "%s", icc_status_name(status));
}

/* ---- what is not carried ---- */

/* The feature of a geometry, or the geometry itself. */
static uint32_t unit_of(const carriage *c, uint32_t object)
{
    uint32_t top = c->index.objects[object].top;
    return top != GEO_NOWHERE ? c->index.objects[top].parent : object;
}

/* A feature has one entry; of two fates that its geometries have the worse is told. */
static void note_fault(carriage *c, size_t n_without, const char *fate)
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

/* Leaves nothing of a geometry: a feature's becomes null, that of no feature or one among others becomes
 * empty, which readers take for none. */
static void empty_geometry(carriage *c)
{
    const geo_object *o = current(c);
    bool whole = o->top != GEO_NOWHERE && (o->top == c->object || c->policy == GEO_NULL);
    geo_span span = whole ? c->index.objects[o->top].all : o->coordinates;
    edits_replace(&c->out->edits, span.begin, span.end);
    edits_put_text(&c->out->edits, whole ? "null" : "[]");
    c->boxes[c->object] = geo_box_empty();
    if (whole)
        c->index.objects[o->top].live = false;
}

static bool leave_out(carriage *c, size_t n_without)
{
    note_fault(c, n_without, c->policy == GEO_FAIL ? "refused" : "null");
    empty_geometry(c);
    return true;
}

/* ---- lines ---- */

static polyline *add_line(carriage *c)
{
    if (c->n_lines == c->room_lines) {
        size_t before = c->room_lines;
        c->lines = grow(c->lines, &c->room_lines, c->n_lines + 1, sizeof *c->lines);
        memset(c->lines + before, 0, (c->room_lines - before) * sizeof *c->lines);
    }
    c->lines[c->n_lines].n = 0;
    return &c->lines[c->n_lines++];
}

/* A node with its image: on the cage that of its place there, elsewhere that of its position, if it has one. */
static vertex vertex_of(const carriage *c, const geo_node *node)
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

/* The path that has just been noded as a line; with all its nodes, or with its vertices alone. */
static void add_noded(carriage *c, bool all)
{
    polyline *line = add_line(c);
    for (size_t i = 0; i < c->noding.n; i++) {
        vertex v = vertex_of(c, &c->noding.nodes[i]);
        v.open = all ? v.open : i + 1 < c->noding.n;
        if (all || v.position)
            polyline_add(line, &v);
    }
    for (size_t i = 0; i < line->n; i++)
        line->vertices[i].open = line->vertices[i].open && i + 1 < line->n &&
                                 !isnan(line->vertices[i].image[0]) &&
                                 !isnan(line->vertices[i + 1].image[0]);
}

static bool has_gap(const polyline *line)
{
    for (size_t i = 0; i < line->n; i++)
        if (isnan(line->vertices[i].image[0]))
            return true;
    return false;
}

/* Notes all paths of a geometry as lines. Returns whether all of it lies in the cage. */
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

/* Points are lines without pieces. */
static bool take_points(carriage *c)
{
    bool whole = true;
    c->n_lines = 0;
    polyline *line = add_line(c);
    for (size_t i = 0; i < c->shape.n; i++) {
        geo_node node = {.at = {c->shape.points[2 * i], c->shape.points[2 * i + 1]},
                         .place = GEO_INSIDE,
                         .vertex = true,
                         .from = i};
        vertex v = vertex_of(c, &node);
        polyline_add(line, &v);
        whole = whole && c->status[i] == ICC_OK;
    }
    return whole;
}

static geo_writer writer(carriage *c)
{
    return (geo_writer){&c->out->edits, c->text, &c->shape, &c->boxes[c->object]};
}

/* ---- what is cut ---- */

static void set_type(carriage *c, const char *type)
{
    geo_span span = current(c)->type_name;
    edits_replace(&c->out->edits, span.begin, span.end);
    edits_put_text(&c->out->edits, type);
}

/* Ends the list that has been written and tells what has come of the geometry. */
static bool end_cut(carriage *c, size_t n_without, size_t n_written)
{
    if (n_written == 0)
        return leave_out(c, n_without);
    note_fault(c, n_without, "clipped");
    return true;
}

static bool cut_points(carriage *c, size_t n_without)
{
    geo_writer w = writer(c);
    polyline kept = {0};
    for (size_t i = 0; i < c->lines[0].n; i++)
        if (!isnan(c->lines[0].vertices[i].image[0]))
            polyline_add(&kept, &c->lines[0].vertices[i]);
    size_t n = kept.n;
    if (n > 0) {
        edits_replace(&c->out->edits, current(c)->coordinates.begin, current(c)->coordinates.end);
        geo_write_list(&w, &kept, 0, n);
    }
    polyline_free(&kept);
    return end_cut(c, n_without, n);
}

/* The parts of a path that lie in the cage, as lines. */
static void add_parts(carriage *c)
{
    const noding *x = &c->noding;
    for (size_t i = 0; i + 1 < x->n; i++) {
        if (!x->nodes[i].in)
            continue;
        polyline *line = add_line(c);
        size_t end = i;
        for (; end + 1 < x->n && x->nodes[end].in; end++) {
            vertex v = vertex_of(c, &x->nodes[end]);
            polyline_add(line, &v);
        }
        vertex v = vertex_of(c, &x->nodes[end]);
        v.open = false;
        polyline_add(line, &v);
        i = end - 1;
    }
}

/* The parts of a line between gaps of the map, where its curves do not reach; counts them, and if `write` adds them
 * to a list. */
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

static bool cut_lines(carriage *c, size_t n_without)
{
    const geo_object *o = current(c);
    size_t n = 0;
    c->n_lines = 0;
    for (size_t p = 0; p < c->shape.n_paths; p++) {
        noding_path(&c->noding, &c->shape, p, c->status, c->snapped);
        add_parts(c);
    }
    for (size_t l = 0; l < c->n_lines; l++) {
        if (polyline_densify(&c->lines[l], c->cage, c->tolerance, c->wrong) != DONE)
            return false;
        n = write_parts(NULL, &c->lines[l], false, n);
    }
    if (n > 0) {
        geo_writer w = writer(c);
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

/* A ring of a clipped polygon as a line, in the sense of the old one. Corners of the cage get their heights from
 * the node before. */
static void add_ring(carriage *c, const clipped *cut, const clip_ring *ring, size_t first_position,
                     bool reversed)
{
    polyline *line = add_line(c);
    size_t from = first_position;
    double along = 0;
    for (size_t i = 0; i <= ring->n; i++) {
        size_t k = i % ring->n;
        vertex v = vertex_of(c, &cut->nodes[ring->first + (reversed ? ring->n - 1 - k : k)]);
        if (v.from == SIZE_MAX) {
            v.from = from;
            v.along = along;
        }
        from = v.from;
        along = v.along;
        v.open = i < ring->n;
        polyline_add(line, &v);
    }
    /* The first may have been a corner. */
    line->vertices[0].from = line->vertices[ring->n].from;
    line->vertices[0].along = line->vertices[ring->n].along;
}

static bool is_closed(const geo_shape *s, const geo_path *p)
{
    return p->n > 3 && memcmp(s->points + 2 * p->first, s->points + 2 * (p->first + p->n - 1),
                              2 * sizeof *s->points) == 0;
}

/* The polygons of a geometry, cut, are being written. */
typedef struct cutting {
    size_t n_polygons;
    bool failed; /* one could not be cut */
} cutting;

/* Writes the rings that are in c->lines as a polygon, unless the map has a gap in one. */
static bool write_polygon(carriage *c, cutting *to)
{
    geo_writer w = writer(c);
    for (size_t l = 0; l < c->n_lines; l++) {
        if (polyline_densify(&c->lines[l], c->cage, c->tolerance, c->wrong) != DONE)
            return false;
        if (has_gap(&c->lines[l])) {
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

static bool cut_polygons(carriage *c, size_t n_without)
{
    const geo_object *o = current(c);
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
        return leave_out(c, n_without);
    }
    if (to.n_polygons == 1 && o->type == GEO_POLYGON) {
        e->list[type_edit] = e->list[type_edit + 1];
        e->list[type_edit].from = content;
        e->n = type_edit + 1;
    } else
        edits_put_text(e, "]");
    return end_cut(c, n_without, to.n_polygons);
}

static bool cut_geometry(carriage *c, size_t n_without)
{
    geo_type type = current(c)->type;
    return type <= GEO_MULTI_POINT  ? cut_points(c, n_without)
           : type <= GEO_MULTI_LINE ? cut_lines(c, n_without)
                                    : cut_polygons(c, n_without);
}

/* ---- geometries ---- */

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

/* Makes c->lines lines that are true, or finds that they cannot be. */
static bool refine(carriage *c, bool *whole)
{
    for (size_t l = 0; l < c->n_lines && *whole; l++) {
        if (polyline_densify(&c->lines[l], c->cage, c->tolerance, c->wrong) != DONE)
            return false;
        *whole = c->policy == GEO_KEEP || !has_gap(&c->lines[l]);
    }
    return true;
}

static bool carry_geometry(carriage *c)
{
    const geo_object *o = current(c);
    size_t n_without = 0;
    if (!geo_shape_read(&c->shape, o, c->text, c->wrong))
        return false;
    if (c->shape.n == 0)
        return true;
    if (!map_positions(c, &n_without))
        return false;
    bool points = o->type <= GEO_MULTI_POINT;
    bool whole = points ? take_points(c) : node_all(c) && n_without == 0;
    if (c->noding.status != ICC_OK)
        return stop(c, c->noding.status);
    bool writes = whole || c->policy == GEO_KEEP;
    if (writes && !refine(c, &writes))
        return false;
    if (!writes)
        return c->policy == GEO_CLIP ? cut_geometry(c, n_without) : leave_out(c, n_without);
    geo_writer w = writer(c);
    geo_write_in_place(&w, o->coordinates, c->n_lines, c->lines);
    if (!whole)
        note_fault(c, n_without, "kept");
    return true;
}

/* ---- bounding boxes ---- */

/* Takes a member away, with the comma that it leaves over. */
static void drop_member(carriage *c, geo_span value)
{
    const char *text = c->text, *blanks = " \t\r\n";
    size_t begin = value.begin, end = value.end;
    while (text[begin - 1] != '"')
        begin--;
    for (begin--; text[begin - 1] != '"';)
        begin--;
    begin--;
    end += strspn(text + end, blanks);
    if (text[end] == ',') {
        end++;
        end += strspn(text + end, blanks);
    } else {
        end = value.end;
        while (text[begin] != ',')
            begin--;
    }
    edits_replace(&c->out->edits, begin, end);
}

/* Replaces the first two numbers of each half of a bounding box; heights stay. */
static bool set_box(carriage *c, geo_span span, const geo_box *box)
{
    const char *p = c->text + span.begin, *number, *end = p;
    size_t n = 0, k = 0;
    for (const char *q = p; *q == '[' || *q == ','; n++) {
        number = geo_next_number(q, &end);
        if (number == NULL)
            break;
        q = end + strspn(end, " \t\r\n");
    }
    const char *last = n > 0 ? end + strspn(end, " \t\r\n") : p;
    if (*last != ']' || n < 4 || n % 2 != 0)
        return spoilt(c->wrong, cage_line(c->text, p),
                      "this bbox is not a list of 4 numbers, or 6");
    if (box->lower[0] > box->upper[0]) {
        drop_member(c, span);
        return true;
    }
    edits_replace(&c->out->edits, span.begin, span.end);
    for (; (number = geo_next_number(p, &end)) != NULL; k++, p = end) {
        size_t axis = k % (n / 2);
        edits_put(&c->out->edits, (size_t)(number - p), p);
        if (axis < 2)
            edits_put_number(&c->out->edits, (k < n / 2 ? box->lower : box->upper)[axis]);
        else
            edits_put(&c->out->edits, (size_t)(end - number), number);
    }
    edits_put(&c->out->edits, (size_t)(c->text + span.end - p), p);
    return true;
}

/* From the last object to the first, so that what an object holds is known before it. */
static bool set_boxes(carriage *c)
{
    for (size_t i = c->index.n; i-- > 0;) {
        const geo_object *o = &c->index.objects[i];
        const geo_box *box = &c->boxes[i];
        if (!o->live)
            continue;
        if (o->parent != GEO_NOWHERE)
            geo_box_add(&c->boxes[o->parent], box->lower, box->upper);
        if (geo_has(o->bbox) && c->text[o->bbox.begin] != 'n' && !set_box(c, o->bbox, box))
            return false;
    }
    return true;
}

/* ---- the whole text ---- */

static bool carry_objects(carriage *c)
{
    bool good = true;
    for (size_t i = 0; i < c->index.n && good; i++) {
        const geo_object *o = &c->index.objects[i];
        c->object = (uint32_t)i;
        c->boxes[i] = geo_box_empty();
        c->out->n_features += o->live && (o->type == GEO_FEATURE || o->route == GEO_IN_FEATURES ||
                                          (i == 0 && o->type < GEO_FEATURE));
        if (o->live && o->type < GEO_GEOMETRIES)
            good = carry_geometry(c);
    }
    return good && set_boxes(c);
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
    bool good = geo_index_read(&c.index, text, n, wrong);
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
