/* Cages as GeoJSON (RFC 7946): a Polygon, a Feature or a FeatureCollection, or the Features of a
 * collection as a sequence (RFC 8142). Rings after the first are holes.
 *
 * In a FeatureCollection the property `role` tells the cage of a feature. "source" and "target" are
 * Polygons, Points and LineStrings. A whole number as the property `feature` pairs Points,
 * LineStrings, and Polygons that are regions. "source-tie" and "target-tie" are LineStrings with
 * numbers of their own.
 *
 * A ring that is not closed is accepted, as in text. */
#include "cage/cage_readers.h"

#include "base/allocate.h"
#include "base/json_in.h"
#include "base/number.h"
#include "cage/cage_degrees.h"
#include "cage/cage_features.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A file of one text, or of a sequence of Features. */
typedef struct geojson {
    json_tree tree;
    const json_item *object;   /* the text, or NULL */
    const json_item *features; /* the list of features, or NULL */
    bool sequence;
} geojson;

static const char *type_of(const json_item *object)
{
    const char *type = json_string_of(json_get(object, "type"));
    return type != NULL ? type : "";
}

/* The place being read, for messages: "", or a text like " of line 7". */
typedef const char *place;

static bool read_position(cage *out, const json_item *position, size_t number, place of,
                          problem *wrong)
{
    const json_item *x = json_first(position), *y = json_next(x);
    if (!json_is(x, JSON_NUMBER) || !json_is(y, JSON_NUMBER))
        return spoilt(wrong, 0, "vertex %zu%s is not a pair of numbers [x, y]", number, of);
    out->n_heights += json_size(position) > 2;
    if (!isfinite(x->number) || !isfinite(y->number))
        return spoilt(wrong, 0, "vertex %zu%s is not finite", number, of);
    cage_add(out, x->number, y->number, 0);
    return true;
}

static bool read_positions(cage *out, const json_item *list, place of, problem *wrong)
{
    size_t n = 0;
    for (const json_item *x = json_first(list); x != NULL; x = json_next(x))
        if (!read_position(out, x, n++, of, wrong))
            return false;
    return true;
}

/* Reads the outer ring, then the holes. */
static bool read_rings(cage *out, const json_item *rings, problem *wrong)
{
    if (json_size(rings) == 0)
        return spoilt(wrong, 0, "the polygon has no coordinates");
    size_t n = 0;
    for (const json_item *ring = json_first(rings); ring != NULL; ring = json_next(ring)) {
        char of[40] = "";
        if (n > 0)
            snprintf(of, sizeof of, " of hole %zu", n);
        size_t first = out->n;
        if (!read_positions(out, ring, of, wrong) || !cage_end_ring(out, first, wrong))
            return false;
        n++;
    }
    return true;
}

/* Reads a polygon. The first one is the cage, and the others are its further polygons. */
static bool read_polygon(cage *out, const json_item *rings, problem *wrong)
{
    if (out->n == 0)
        return read_rings(out, rings, wrong);
    cage *c = cage_add_polygon(out);
    bool good = read_rings(c, rings, wrong);
    out->n_heights += c->n_heights;
    return good;
}

static bool read_polygons(cage *out, const json_item *polygons, problem *wrong)
{
    bool good = json_size(polygons) > 0 || spoilt(wrong, 0, "the MultiPolygon has no polygons");
    for (const json_item *x = json_first(polygons); x != NULL && good; x = json_next(x))
        good = read_polygon(out, x, wrong);
    return good;
}

/* Reads a ring of a region. */
static bool read_region_ring(cage *out, const json_item *ring, const cage_feature *like,
                             problem *wrong)
{
    feature_text name;
    char of[64];
    size_t first = out->n;
    snprintf(of, sizeof of, " of %s", feature_name(name, like));
    return read_positions(out, ring, of, wrong) && cage_end_region_ring(out, like, first, wrong);
}

/* Reads the rings of a region. Each polygon has an outer ring, then holes. An empty MultiPolygon has
 * none. */
static bool read_region(cage *out, int64_t number, const json_item *geometry, problem *wrong)
{
    const json_item *coordinates = json_get(geometry, "coordinates");
    bool many = strcmp(type_of(geometry), "MultiPolygon") == 0, good = true;
    size_t n_rings = 0, n_outer = 0, n_holes = 0;
    const json_item *polygon = many ? json_first(coordinates) : coordinates;
    for (; polygon != NULL && good; polygon = many ? json_next(polygon) : NULL) {
        const json_item *outer = json_first(polygon);
        for (const json_item *ring = outer; ring != NULL && good; ring = json_next(ring)) {
            bool hole = ring != outer;
            cage_feature like = {.kind = hole ? ICC_FEATURE_HOLE : ICC_FEATURE_REGION,
                                 .number = number,
                                 .ring = n_rings++,
                                 .item = hole ? ++n_holes : ++n_outer};
            good = read_region_ring(out, ring, &like, wrong);
        }
    }
    return good;
}

static bool is_same_position(const json_item *a, const json_item *b)
{
    bool same = json_size(a) == json_size(b);
    for (a = json_first(a), b = json_first(b); same && a != NULL;
         a = json_next(a), b = json_next(b))
        same = json_is(a, JSON_NUMBER) && json_is(b, JSON_NUMBER) && a->number == b->number;
    return same;
}

/* True if a line ends where it begins. Drawings have such outlines. */
static bool is_closed(const json_item *line)
{
    const json_item *first = json_first(line), *last = first;
    for (const json_item *x = first; x != NULL; x = json_next(x))
        last = x;
    return json_size(line) > 3 && is_same_position(first, last);
}

static bool read_geometry(cage *out, const json_item *geometry, problem *wrong)
{
    const char *type = type_of(geometry);
    const json_item *coordinates = json_get(geometry, "coordinates");
    if (strcmp(type, "Polygon") == 0)
        return read_polygon(out, coordinates, wrong);
    if (strcmp(type, "MultiPolygon") == 0)
        return read_polygons(out, coordinates, wrong);
    if (strcmp(type, "LineString") == 0 && is_closed(coordinates))
        return read_positions(out, coordinates, "", wrong) && cage_end_ring(out, 0, wrong);
    char shown[32];
    if (*type == '\0')
        return spoilt(wrong, 0,
                      "this JSON is not GeoJSON: it has no member \"type\"; a cage is a Polygon");
    return spoilt(wrong, 0, "the geometry is a '%s'; a cage is a Polygon, or a closed LineString",
                  quoted(shown, type));
}

/* True if a feature has the role "source" or "target", or, if `behind` is "-tie", the role of a
 * tie. */
static bool has_role(const json_item *feature, cage_role role, const char *behind)
{
    const json_item *properties = json_get(feature, "properties");
    const char *value = json_string_of(json_get(properties, "role")), *name = cage_role_name(role);
    size_t n = strlen(name);
    return value != NULL && strncmp(value, name, n) == 0 && strcmp(value + n, behind) == 0;
}

enum { IS_CAGE = 0, IS_UNKNOWN = -1 };

static const json_item *number_of(const json_item *feature)
{
    return json_get(json_get(feature, "properties"), "feature");
}

/* The kind of a feature with a role: an ICC_FEATURE_*, or the cage. A feature with a number is not
 * the cage. Polygons may have a property of that name that is no number. */
static int32_t kind_of(const json_item *feature)
{
    const char *type = type_of(json_get(feature, "geometry"));
    const json_item *number = number_of(feature);
    bool polygon = strcmp(type, "Polygon") == 0 || strcmp(type, "MultiPolygon") == 0;
    return strcmp(type, "LineString") == 0           ? ICC_FEATURE_LINE
           : strcmp(type, "Point") == 0              ? ICC_FEATURE_POINT
           : polygon && json_is(number, JSON_NUMBER) ? ICC_FEATURE_REGION
           : number != NULL && !polygon              ? IS_UNKNOWN
                                                     : IS_CAGE;
}

/* Reads the radius of a Point, if it has one. */
static bool read_radius(double *out, const json_item *feature, const char *name, problem *wrong)
{
    const json_item *radius = json_get(json_get(feature, "properties"), "radius");
    if (radius == NULL || json_is(radius, JSON_NULL))
        return true;
    *out = radius->number;
    return (json_is(radius, JSON_NUMBER) && *out >= 0 && isfinite(*out)) ||
           spoilt(wrong, 0, "the radius of %s must be a number of at least 0", name);
}

/* Reads a Point, a LineString, a region or a tie, with the number that pairs it. */
static bool read_feature(cage *out, int32_t kind, const json_item *feature, problem *wrong)
{
    const double most = 9007199254740992; /* 2^53 */
    const json_item *number = number_of(feature);
    const json_item *coordinates = json_get(json_get(feature, "geometry"), "coordinates");
    const char *type = type_of(json_get(feature, "geometry"));
    char shown[32], of[64];
    if (!json_is(number, JSON_NUMBER) || !(fabs(number->number) <= most) ||
        floor(number->number) != number->number)
        return spoilt(wrong, 0,
                      "a %s with a role has no whole number as its property \"feature\", which "
                      "pairs it",
                      quoted(shown, type));
    cage_feature named = {.kind = kind, .number = (int64_t)number->number};
    feature_text name;
    size_t first = out->n;
    snprintf(of, sizeof of, " of %s", feature_name(name, &named));
    if (kind == IS_UNKNOWN)
        return spoilt(wrong, 0,
                      "feature %lld is a '%s'; it may be a Point, a LineString or a "
                      "Polygon",
                      (long long)named.number, quoted(shown, type));
    if (kind == ICC_FEATURE_REGION)
        return read_region(out, named.number, json_get(feature, "geometry"), wrong);
    if (kind == CAGE_TIE && strcmp(type, "LineString") != 0)
        return spoilt(wrong, 0, "%s is a '%s'; a tie is a LineString", name, quoted(shown, type));
    if (!(kind == ICC_FEATURE_POINT ? read_position(out, coordinates, 0, of, wrong)
                                    : read_positions(out, coordinates, of, wrong)))
        return false;
    if (kind != ICC_FEATURE_POINT && out->n - first < 2)
        return spoilt(wrong, 0, "%s has %zu %s; a line has at least 2", name, out->n - first,
                      out->n - first == 1 ? "vertex" : "vertices");
    if (kind == ICC_FEATURE_POINT && !read_radius(&named.radius, feature, name, wrong))
        return false;
    cage_add_feature(out, kind, named.number, first);
    out->features[out->n_features - 1].radius = named.radius;
    return true;
}

/* Reads the features of the cage, and the ties. A cage chosen by its name has no regions, because
 * it is one of them itself. */
static bool read_features(cage *out, const cage_choice *choice, const json_item *features,
                          problem *wrong)
{
    for (const json_item *x = json_first(features); x != NULL; x = json_next(x)) {
        bool tie = has_role(x, choice->role, "-tie");
        int32_t kind = tie ? CAGE_TIE : has_role(x, choice->role, "") ? kind_of(x) : IS_CAGE;
        bool counts = kind != IS_CAGE && (kind != ICC_FEATURE_REGION || choice->named == NULL);
        if (counts && !read_feature(out, kind, x, wrong))
            return false;
    }
    return true;
}

/* True if a string equals `wanted`, or a number or a word means it. */
static bool is_value(const json_item *item, const char *wanted)
{
    const char *string = json_string_of(item);
    double number;
    return string != NULL ? strcmp(string, wanted) == 0
           : json_is(item, JSON_NUMBER)
               ? number_parse(wanted, &number) == NUMBER_OK && number == item->number
           : json_is(item, JSON_TRUE)  ? strcmp(wanted, "true") == 0
           : json_is(item, JSON_FALSE) ? strcmp(wanted, "false") == 0
                                       : false;
}

/* True if a feature has the name: a property with the value, or the id. */
static bool has_name(const json_item *feature, const char *named)
{
    size_t n = strcspn(named, "=");
    bool found = false;
    if (named[n] == '\0')
        return is_value(json_get(feature, "id"), named);
    const json_item *x = json_first_member(json_get(feature, "properties"));
    for (; x != NULL && !found; x = json_next(x))
        found =
            strlen(x->name) == n && strncmp(x->name, named, n) == 0 && is_value(x, named + n + 1);
    return found ||
           (n == 2 && strncmp(named, "id", 2) == 0 && is_value(json_get(feature, "id"), named + 3));
}

static const json_item *choose_named(const json_item *features, const char *named, problem *wrong)
{
    const json_item *chosen = NULL;
    size_t n = 0;
    char shown[64];
    for (const json_item *x = json_first(features); x != NULL; x = json_next(x))
        if (has_name(x, named)) {
            chosen = x;
            n++;
        }
    if (n == 1)
        return chosen;
    spoilt(wrong, 0, "%zu of the %zu features have %s; exactly one must", n, json_size(features),
           choice_text(shown, named));
    return NULL;
}

/* True if all features are lines of two points without roles, as georeferencers write them. */
static bool are_links(const json_item *features)
{
    bool are = json_size(features) > 0;
    for (const json_item *x = json_first(features); x != NULL; x = json_next(x)) {
        const json_item *line = json_get(x, "geometry");
        are = are && strcmp(type_of(line), "LineString") == 0 &&
              json_size(json_get(line, "coordinates")) == 2 &&
              json_get(json_get(x, "properties"), "role") == NULL;
    }
    return are;
}

/* Reads the polygons with the role that have no number, or else the only feature. If there are
 * none, the cage is what the regions cover. */
static bool read_outlines(cage *out, const geojson *file, cage_role role, problem *wrong)
{
    size_t n_outlines = 0, n_regions = 0;
    bool good = true;
    for (const json_item *x = json_first(file->features); x != NULL && good; x = json_next(x)) {
        int32_t kind = has_role(x, role, "") ? kind_of(x) : IS_UNKNOWN;
        n_regions += kind == ICC_FEATURE_REGION;
        n_outlines += kind == IS_CAGE;
        if (kind == IS_CAGE)
            good = read_geometry(out, json_get(x, "geometry"), wrong);
    }
    size_t n = json_size(file->features);
    if (!good || n_outlines > 0 || n_regions > 0)
        return good;
    if (n == 1)
        return read_geometry(out, json_get(json_first(file->features), "geometry"), wrong);
    if (are_links(file->features))
        return spoilt(wrong, 0,
                      "these are links from one place to another, not an outline; 'libicc fit "
                      "FILE' makes a map from them alone, and --landmarks takes them beside the "
                      "outlines");
    return spoilt(wrong, 0,
                  "none of the %zu features%s is a Polygon with the property \"role\": \"%s\"", n,
                  file->sequence ? " of the sequence" : "", cage_role_name(role));
}

/* Reads what a name or the role chooses of a collection. */
static bool read_collection(cage *out, const cage_choice *choice, const geojson *file,
                            problem *wrong)
{
    if (choice->named == NULL)
        return read_outlines(out, file, choice->role, wrong);
    const json_item *chosen = choose_named(file->features, choice->named, wrong);
    return chosen != NULL && read_geometry(out, json_get(chosen, "geometry"), wrong);
}

/* Reads the only geometry of a file. */
static bool read_only(cage *out, const cage_choice *choice, const json_item *object, problem *wrong)
{
    char shown[64];
    if (choice->named != NULL)
        return spoilt(wrong, 0, "there is no list of features to look for %s in",
                      choice_text(shown, choice->named));
    if (strcmp(type_of(object), "Feature") == 0)
        object = json_get(object, "geometry");
    return read_geometry(out, object, wrong);
}

static bool read_file(cage *out, const cage_choice *choice, const geojson *file, problem *wrong)
{
    bool many = file->sequence || strcmp(type_of(file->object), "FeatureCollection") == 0;
    if (!(many ? read_collection(out, choice, file, wrong)
               : read_only(out, choice, file->object, wrong)))
        return false;
    if (out->n_more > 0)
        cage_join_outlines(out);
    return !many || read_features(out, choice, file->features, wrong);
}

/* Files from before 2016 name their reference system if their coordinates are not degrees. */
static bool is_in_degrees(const json_item *object)
{
    const json_item *crs = json_get(json_get(json_get(object, "crs"), "properties"), "name");
    const char *name = json_string_of(crs);
    return name == NULL || strstr(name, "CRS84") != NULL || strstr(name, "4326") != NULL;
}

/* Reads the file's one text, or its sequence of Features. */
static bool read_tree(geojson *out, const char *text, size_t n, problem *wrong)
{
    *out = (geojson){.sequence = false};
    if (!json_tree_read_sequence(&out->tree, text, n, wrong))
        return false;
    const json_item *texts = out->tree.root;
    out->sequence = json_size(texts) > 1;
    if (!out->sequence) {
        out->object = json_first(texts);
        out->features = json_get(out->object, "features");
        return true;
    }
    size_t number = 0;
    for (const json_item *item = json_first(texts); item != NULL; item = json_next(item)) {
        char shown[32];
        number++;
        if (strcmp(type_of(item), "Feature") != 0)
            return spoilt(wrong, 0, "text %zu of %zu is a '%s'; in a sequence each is a Feature",
                          number, json_size(texts), quoted(shown, type_of(item)));
    }
    out->features = texts;
    return true;
}

bool cage_geojson_has(cage_role role, const char *text, size_t n)
{
    geojson file;
    problem ignored;
    bool found = false;
    if (read_tree(&file, text, n, &ignored))
        for (const json_item *x = json_first(file.features); x != NULL; x = json_next(x))
            found = found || has_role(x, role, "");
    json_tree_free(&file.tree);
    return found;
}

bool cage_read_geojson(cage *out, const cage_choice *choice, const char *text, size_t n,
                       problem *wrong)
{
    geojson file;
    bool good = read_tree(&file, text, n, wrong) && read_file(out, choice, &file, wrong) &&
                (!is_in_degrees(file.object) || cage_check_degrees(out, wrong));
    json_tree_free(&file.tree);
    return good;
}
