/* Goes over the text once, with a stack of its own. It records an object where a member `geometry`,
 * `features` or `geometries` leads to it. `type` may be the last member, so only a second pass over
 * the objects shows which of these members have their usual meaning. */
#include "geo/geo_index.h"

#include "base/allocate.h"
#include "base/json_scan.h"

#include <stdio.h>
#include <stdlib.h>

const char *const geo_type_names[] = {
    "Point",        "MultiPoint",         "LineString", "MultiLineString",  "Polygon",
    "MultiPolygon", "GeometryCollection", "Feature",    "FeatureCollection"};

enum { TYPE, COORDINATES, BBOX, ID, GEOMETRY, GEOMETRIES, FEATURES, N_MEMBERS };
static const char *const member_names[] = {"type",     "coordinates", "bbox",    "id",
                                           "geometry", "geometries",  "features"};

/* An object or one of its lists while it is open. */
typedef struct level {
    uint32_t object, n_items;
    geo_route route; /* GEO_ROOT for the object itself, else the list */
} level;

typedef struct indexer {
    geo_index *out;
    json_scan scan;
    level *levels;
    size_t depth, room;
} indexer;

static void push(indexer *x, uint32_t object, geo_route route)
{
    x->levels = grow(x->levels, &x->room, x->depth + 1, sizeof *x->levels);
    x->levels[x->depth++] = (level){object, 0, route};
}

/* Opens an object, after the scanner has read its bracket. */
static void open_object(indexer *x, uint32_t parent, geo_route route, uint32_t number)
{
    geo_index *out = x->out;
    out->objects = grow(out->objects, &out->room, out->n + 1, sizeof *out->objects);
    out->objects[out->n] = (geo_object){.all = {x->scan.begin, x->scan.begin},
                                        .parent = parent,
                                        .top = GEO_NOWHERE,
                                        .number = number,
                                        .type = GEO_UNKNOWN,
                                        .route = route};
    push(x, (uint32_t)out->n++, GEO_ROOT);
}

static int find_member(const json_scan *s)
{
    int member = 0;
    while (member < N_MEMBERS &&
           !json_string_is(s->text + s->begin, s->text + s->end, member_names[member]))
        member++;
    return member;
}

static geo_type find_type(const json_scan *s)
{
    int type = 0;
    while (type < GEO_UNKNOWN &&
           !json_string_is(s->text + s->begin, s->text + s->end, geo_type_names[type]))
        type++;
    return (geo_type)type;
}

/* Opens the contents of a member that leads to objects. False if the member has another value. */
static bool follow_member(indexer *x, uint32_t object, int member, json_kind kind)
{
    if (member == GEOMETRY && kind == JSON_OBJECT)
        open_object(x, object, GEO_IN_GEOMETRY, 0);
    else if (member == FEATURES && kind == JSON_LIST)
        push(x, object, GEO_IN_FEATURES);
    else if (member == GEOMETRIES && kind == JSON_LIST)
        push(x, object, GEO_IN_GEOMETRIES);
    else
        return false;
    return true;
}

/* Reads the value of a member whose name was read last. */
static json_kind read_member(indexer *x, uint32_t object)
{
    json_scan *s = &x->scan;
    int member = find_member(s);
    json_kind kind = json_scan_next(s);
    size_t begin = s->begin;
    geo_object *o = &x->out->objects[object];
    if (member < N_MEMBERS) {
        o->repeated |= o->members & 1U << member;
        o->members |= 1U << member;
    }
    if (kind == JSON_BAD || follow_member(x, object, member, kind))
        return kind;
    if (member == TYPE && kind == JSON_STRING)
        o->type = find_type(s);
    if (member >= GEOMETRY && member < N_MEMBERS && !(member == GEOMETRY && s->text[begin] == 'n'))
        o->odd[member - GEOMETRY] = begin;
    kind = json_scan_skip(s, kind);
    geo_span *place = member == TYPE          ? &o->type_name
                      : member == COORDINATES ? &o->coordinates
                      : member == BBOX        ? &o->bbox
                      : member == ID          ? &o->id
                                              : NULL;
    if (place != NULL)
        *place = (geo_span){begin, s->end};
    return kind;
}

/* Reads a piece of the innermost object or list that is open. */
static json_kind read_piece(indexer *x)
{
    level *top = &x->levels[x->depth - 1];
    json_scan *s = &x->scan;
    json_kind kind = json_scan_next(s);
    geo_object *o = &x->out->objects[top->object];
    if (kind == JSON_BAD)
        return kind;
    if (kind == JSON_CLOSE) {
        x->depth--;
        if (top->route == GEO_ROOT)
            o->all.end = s->end;
        return kind;
    }
    if (top->route == GEO_ROOT)
        return read_member(x, top->object);
    uint32_t number = top->n_items++;
    if (kind == JSON_OBJECT) {
        open_object(x, top->object, top->route, number);
        return kind;
    }
    size_t *odd = &o->odd[(top->route == GEO_IN_FEATURES ? FEATURES : GEOMETRIES) - GEOMETRY];
    *odd = *odd > 0 ? *odd : s->begin;
    return json_scan_skip(s, kind);
}

static bool is_held(const geo_object *o, const geo_object *parent)
{
    return (o->route == GEO_IN_GEOMETRY && parent->type == GEO_FEATURE) ||
           (o->route == GEO_IN_GEOMETRIES && parent->type == GEO_GEOMETRIES) ||
           (o->route == GEO_IN_FEATURES && parent->type == GEO_FEATURES);
}

/* The members that are required besides the type. */
static unsigned needed(geo_type type)
{
    return type < GEO_GEOMETRIES    ? 1U << COORDINATES
           : type == GEO_GEOMETRIES ? 1U << GEOMETRIES
           : type == GEO_FEATURES   ? 1U << FEATURES
                                    : 0;
}

static bool misses(const geo_object *o, const char *text, size_t at, const char *format,
                   const char *name, problem *wrong)
{
    return spoilt(wrong, line_of(text, text + at), format, geo_type_names[o->type], name);
}

/* Checks that required members exist once, and are lists or objects where these are expected. */
static bool check_members(const geo_object *o, const char *text, problem *wrong)
{
    unsigned need = needed(o->type), feature = o->type == GEO_FEATURE ? 1U << GEOMETRY : 0;
    unsigned once = need | feature | 1U << TYPE | 1U << BBOX;
    for (int m = 0; m < N_MEMBERS; m++) {
        unsigned bit = 1U << m;
        if (o->repeated & once & bit)
            return misses(o, text, o->all.begin, "this %s has more than one member '%s'",
                          member_names[m], wrong);
        if (need & ~o->members & bit)
            return misses(o, text, o->all.begin, "a '%s' has no %s", member_names[m], wrong);
        if (m >= GEOMETRY && (need | feature) & bit && o->odd[m - GEOMETRY] > 0)
            return misses(o, text, o->odd[m - GEOMETRY],
                          "in this %s something else stands where '%s' should be", member_names[m],
                          wrong);
    }
    return true;
}

static bool check_type(const geo_object *o, const char *text, problem *wrong)
{
    bool geometry = o->route == GEO_IN_GEOMETRY || o->route == GEO_IN_GEOMETRIES;
    if (o->type != GEO_UNKNOWN && !(geometry && o->type >= GEO_FEATURE))
        return true;
    size_t line = line_of(text, text + o->all.begin);
    if (!geo_has(o->type_name))
        return spoilt(wrong, line, "this is not GeoJSON: a type is missing");
    char shown[32], word[32];
    size_t n = o->type_name.end - o->type_name.begin - 2;
    snprintf(word, sizeof word, "%.*s", (int)(n < 31 ? n : 31), text + o->type_name.begin + 1);
    return spoilt(wrong, line, "'%s' is no type of %s", quoted(shown, word),
                  geometry ? "geometry" : "GeoJSON");
}

/* Decides which objects are live, from the root down, and checks these. */
static bool settle(geo_index *out, const char *text, problem *wrong)
{
    for (size_t i = 0; i < out->n; i++) {
        geo_object *o = &out->objects[i];
        const geo_object *parent = o->parent != GEO_NOWHERE ? &out->objects[o->parent] : NULL;
        o->live = parent == NULL || (parent->live && is_held(o, parent));
        if (!o->live)
            continue;
        if (!check_type(o, text, wrong) || !check_members(o, text, wrong))
            return false;
        o->top = o->route == GEO_IN_GEOMETRY ? (uint32_t)i
                 : parent != NULL            ? parent->top
                                             : GEO_NOWHERE;
    }
    return true;
}

/* Reads one text with all its contents. *object becomes true if it is an object. */
static json_kind read_text(indexer *x, uint32_t number, bool *object)
{
    json_kind kind = json_scan_next(&x->scan);
    *object = kind == JSON_OBJECT;
    if (*object)
        open_object(x, GEO_NOWHERE, GEO_ROOT, number);
    else if (kind != JSON_BAD)
        kind = json_scan_skip(&x->scan, kind);
    while (kind != JSON_BAD && x->depth > 0 && x->out->n < GEO_NOWHERE)
        kind = read_piece(x);
    return kind;
}

bool geo_index_read(geo_index *out, const char *text, size_t n, problem *wrong)
{
    *out = (geo_index){0};
    indexer x = {.out = out};
    bool object = true;
    uint32_t number = 0;
    json_scan_start(&x.scan, text, n);
    out->sequence = json_scan_more(&x.scan) && text[x.scan.at - 1] == '\x1e';
    json_kind kind = read_text(&x, number, &object);
    while (kind != JSON_BAD && object && x.depth == 0 && json_scan_more(&x.scan)) {
        out->sequence = true;
        kind = read_text(&x, ++number, &object);
    }
    if (kind != JSON_BAD && x.depth == 0)
        kind = json_scan_next(&x.scan);
    bool good = kind == JSON_END;
    if (kind == JSON_BAD)
        json_fault(text, x.scan.begin, x.scan.why, wrong);
    else if (!good)
        spoilt(wrong, 0, "this GeoJSON has too many objects");
    else if (!object)
        good = spoilt(wrong, 1, "this is not GeoJSON: a type is missing");
    json_scan_end(&x.scan);
    free(x.levels);
    return good && settle(out, text, wrong);
}

void geo_index_free(geo_index *index)
{
    free(index->objects);
    *index = (geo_index){0};
}
