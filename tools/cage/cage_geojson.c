/* Cages as GeoJSON (RFC 7946): a Polygon, a Feature or a FeatureCollection, or the Features of a
 * collection as a sequence (RFC 8142). Rings after the first are holes.
 *
 * In a FeatureCollection the property `role` tells the cage of a feature. "source" and "target" are
 * Polygons, Points and LineStrings. An integer property `feature` pairs the latter two.
 * "source-tie" and "target-tie" are LineStrings with numbers of their own.
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

static const char *type_of(const cJSON *object)
{
    const char *type = cJSON_GetStringValue(json_get(object, "type"));
    return type != NULL ? type : "";
}

/* The place being read, for messages: "", or a text like " of line 7". */
typedef const char *place;

static bool read_position(cage *out, const cJSON *position, size_t number, place of, problem *wrong)
{
    const cJSON *x = cJSON_GetArrayItem(position, 0), *y = cJSON_GetArrayItem(position, 1);
    if (!cJSON_IsArray(position) || !cJSON_IsNumber(x) || !cJSON_IsNumber(y))
        return spoilt(wrong, 0, "vertex %zu%s is not a pair of numbers [x, y]", number, of);
    out->n_heights += cJSON_GetArraySize(position) > 2;
    if (!isfinite(x->valuedouble) || !isfinite(y->valuedouble))
        return spoilt(wrong, 0, "vertex %zu%s is not finite", number, of);
    cage_add(out, x->valuedouble, y->valuedouble, 0);
    return true;
}

static bool read_positions(cage *out, const cJSON *list, place of, problem *wrong)
{
    const cJSON *position;
    size_t n = 0;
    cJSON_ArrayForEach(position, list)
    {
        if (!read_position(out, position, n++, of, wrong))
            return false;
    }
    return true;
}

/* Reads the outer ring, then the holes. */
static bool read_rings(cage *out, const cJSON *rings, problem *wrong)
{
    if (!cJSON_IsArray(rings) || cJSON_GetArraySize(rings) == 0)
        return spoilt(wrong, 0, "the polygon has no coordinates");
    const cJSON *ring;
    size_t n = 0;
    cJSON_ArrayForEach(ring, rings)
    {
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

/* Reads polygons. The first one is the cage, and the others are its further polygons. */
static bool read_polygons(cage *out, const cJSON *polygons, problem *wrong)
{
    int n = cJSON_GetArraySize(polygons);
    if (n == 0)
        return spoilt(wrong, 0, "the MultiPolygon has no polygons");
    out->more = need((size_t)n, sizeof *out->more);
    for (const cJSON *polygon = polygons->child->next; polygon != NULL; polygon = polygon->next) {
        cage *c = &out->more[out->n_more++];
        c->dim = 2;
        if (!read_rings(c, polygon, wrong))
            return false;
        out->n_heights += c->n_heights;
    }
    return read_rings(out, polygons->child, wrong);
}

/* True if a line ends where it begins. Drawings have such outlines. */
static bool is_closed(const cJSON *line)
{
    int n = cJSON_GetArraySize(line);
    return n > 3 && cJSON_Compare(cJSON_GetArrayItem(line, 0), cJSON_GetArrayItem(line, n - 1), 1);
}

static bool read_geometry(cage *out, const cJSON *geometry, problem *wrong)
{
    const char *type = type_of(geometry);
    const cJSON *coordinates = json_get(geometry, "coordinates");
    if (strcmp(type, "Polygon") == 0)
        return read_rings(out, coordinates, wrong);
    if (strcmp(type, "MultiPolygon") == 0)
        return read_polygons(out, coordinates, wrong);
    if (strcmp(type, "LineString") == 0 && is_closed(coordinates))
        return read_positions(out, coordinates, "", wrong) && cage_end_ring(out, 0, wrong);
    char shown[32];
    if (*type == '\0')
        return spoilt(wrong, 0,
                      "this JSON is no GeoJSON: it has no member \"type\"; a cage is a Polygon");
    return spoilt(wrong, 0, "the geometry is a '%s'; a cage is a Polygon, or a closed LineString",
                  quoted(shown, type));
}

/* True if a feature has the role "source" or "target", or, if `behind` is "-tie", the role of a
 * tie. */
static bool has_role(const cJSON *feature, cage_role role, const char *behind)
{
    const cJSON *properties = json_get(feature, "properties");
    const char *value = cJSON_GetStringValue(json_get(properties, "role")),
               *name = cage_role_name(role);
    size_t n = strlen(name);
    return value != NULL && strncmp(value, name, n) == 0 && strcmp(value + n, behind) == 0;
}

enum { IS_CAGE = 0, IS_UNKNOWN = -1 };

static const cJSON *number_of(const cJSON *feature)
{
    return json_get(json_get(feature, "properties"), "feature");
}

/* The kind of a feature with a role: an ICC_FEATURE_*, or the cage. A feature with a number is not
 * the cage. */
static int32_t kind_of(const cJSON *feature)
{
    const char *type = type_of(json_get(feature, "geometry"));
    bool numbered = number_of(feature) != NULL && strstr(type, "Polygon") == NULL;
    return strcmp(type, "LineString") == 0 ? ICC_FEATURE_LINE
           : strcmp(type, "Point") == 0    ? ICC_FEATURE_POINT
           : numbered                      ? IS_UNKNOWN
                                           : IS_CAGE;
}

/* Reads the radius of a Point, if it has one. */
static bool read_radius(double *out, const cJSON *feature, const char *name, problem *wrong)
{
    const cJSON *radius = json_get(json_get(feature, "properties"), "radius");
    if (radius == NULL || cJSON_IsNull(radius))
        return true;
    *out = radius->valuedouble;
    return (cJSON_IsNumber(radius) && *out >= 0 && isfinite(*out)) ||
           spoilt(wrong, 0, "the radius of %s is no number from 0 up", name);
}

/* Reads a Point, a LineString or a tie, with the number that pairs it. */
static bool read_feature(cage *out, int32_t kind, const cJSON *feature, problem *wrong)
{
    const double most = 9007199254740992; /* 2^53 */
    const cJSON *number = number_of(feature);
    const cJSON *coordinates = json_get(json_get(feature, "geometry"), "coordinates");
    const char *type = type_of(json_get(feature, "geometry"));
    char shown[32], of[64];
    if (!cJSON_IsNumber(number) || !(fabs(number->valuedouble) <= most) ||
        floor(number->valuedouble) != number->valuedouble)
        return spoilt(wrong, 0,
                      "a %s with a role has no whole number as its property \"feature\", which "
                      "pairs it",
                      quoted(shown, type));
    cage_feature named = {.kind = kind, .number = (int64_t)number->valuedouble};
    feature_text name;
    size_t first = out->n;
    snprintf(of, sizeof of, " of %s", feature_name(name, &named));
    if (kind == IS_UNKNOWN)
        return spoilt(wrong, 0, "feature %lld is a '%s'; it may be a Point or a LineString",
                      (long long)named.number, quoted(shown, type));
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

/* Reads the features inside the cage, and the ties. */
static bool read_features(cage *out, cage_role role, const cJSON *collection, problem *wrong)
{
    const cJSON *feature;
    cJSON_ArrayForEach(feature, json_get(collection, "features"))
    {
        bool tie = has_role(feature, role, "-tie");
        int32_t kind = tie ? CAGE_TIE : has_role(feature, role, "") ? kind_of(feature) : IS_CAGE;
        if (kind != IS_CAGE && !read_feature(out, kind, feature, wrong))
            return false;
    }
    return true;
}

/* True if a string equals `wanted`, or a number or a word means it. */
static bool is_value(const cJSON *item, const char *wanted)
{
    const char *string = cJSON_GetStringValue(item);
    double number;
    return string != NULL ? strcmp(string, wanted) == 0
           : cJSON_IsNumber(item)
               ? number_parse(wanted, &number) == NUMBER_OK && number == item->valuedouble
           : cJSON_IsBool(item) ? strcmp(wanted, cJSON_IsTrue(item) ? "true" : "false") == 0
                                : false;
}

/* True if a feature has the name: a property with the value, or the id. */
static bool has_name(const cJSON *feature, const char *named)
{
    size_t n = strcspn(named, "=");
    const cJSON *property;
    bool found = false;
    if (named[n] == '\0')
        return is_value(json_get(feature, "id"), named);
    cJSON_ArrayForEach(property, json_get(feature, "properties")) found =
        found || (strlen(property->string) == n && strncmp(property->string, named, n) == 0 &&
                  is_value(property, named + n + 1));
    return found ||
           (n == 2 && strncmp(named, "id", 2) == 0 && is_value(json_get(feature, "id"), named + 3));
}

static const cJSON *choose_named(const cJSON *collection, const char *named, problem *wrong)
{
    const cJSON *feature, *chosen = NULL;
    int n = 0;
    char shown[64];
    cJSON_ArrayForEach(feature, json_get(collection, "features"))
    {
        if (has_name(feature, named)) {
            chosen = feature;
            n++;
        }
    }
    if (n == 1)
        return chosen;
    spoilt(wrong, 0, "%d of the %d features have %s; exactly one must", n,
           cJSON_GetArraySize(json_get(collection, "features")), choice_text(shown, named));
    return NULL;
}

/* True if all features are lines of two points without roles, as georeferencers write them. */
static bool are_links(const cJSON *features)
{
    const cJSON *feature;
    bool are = cJSON_GetArraySize(features) > 0;
    cJSON_ArrayForEach(feature, features)
    {
        const cJSON *line = json_get(feature, "geometry");
        are = are && strcmp(type_of(line), "LineString") == 0 &&
              cJSON_GetArraySize(json_get(line, "coordinates")) == 2 &&
              json_get(json_get(feature, "properties"), "role") == NULL;
    }
    return are;
}

/* Chooses the feature that is the cage. It is the feature with the role that is no line or point,
 * or else the only feature. */
static const cJSON *choose_feature(const cJSON *collection, cage_role role, problem *wrong)
{
    const cJSON *features = json_get(collection, "features");
    const cJSON *feature, *chosen = NULL;
    int n_chosen = 0;
    cJSON_ArrayForEach(feature, features)
    {
        if (has_role(feature, role, "") && kind_of(feature) == IS_CAGE) {
            chosen = feature;
            n_chosen++;
        }
    }
    if (n_chosen == 0 && cJSON_GetArraySize(features) == 1)
        return cJSON_GetArrayItem(features, 0);
    if (n_chosen == 0 && are_links(features)) {
        spoilt(
            wrong, 0,
            "these are links from one place to another, no outline; 'jq -r "
            "\".features[].geometry.coordinates | flatten | @csv\" FILE > OUT.csv' makes pairs of "
            "points of them, which --landmarks takes beside the outlines");
        return NULL;
    }
    if (n_chosen != 1) {
        spoilt(
            wrong, 0,
            "%s of the %d features%s is a Polygon with the property \"role\": \"%s\"; exactly one "
            "must be",
            n_chosen == 0 ? "none" : "more than one", cJSON_GetArraySize(features),
            json_get(collection, "sequence") != NULL ? " of the sequence" : "",
            cage_role_name(role));
        return NULL;
    }
    return chosen;
}

static bool read_object(cage *out, const cage_choice *choice, const cJSON *object, problem *wrong)
{
    const cJSON *collection = NULL;
    if (strcmp(type_of(object), "FeatureCollection") == 0) {
        collection = object;
        object = choice->named != NULL ? choose_named(collection, choice->named, wrong)
                                       : choose_feature(collection, choice->role, wrong);
        if (object == NULL)
            return false;
    } else if (choice->named != NULL) {
        char shown[64];
        return spoilt(wrong, 0, "there is no list of features in which to look for %s",
                      choice_text(shown, choice->named));
    }
    if (strcmp(type_of(object), "Feature") == 0)
        object = json_get(object, "geometry");
    return read_geometry(out, object, wrong) && read_features(out, choice->role, collection, wrong);
}

/* Files from before 2016 name their reference system if their coordinates are not degrees. */
static bool is_in_degrees(const cJSON *object)
{
    const cJSON *crs = json_get(json_get(json_get(object, "crs"), "properties"), "name");
    const char *name = cJSON_GetStringValue(crs);
    return name == NULL || strstr(name, "CRS84") != NULL || strstr(name, "4326") != NULL;
}

/* Parses the file's one text, or its sequence of Features, which becomes a collection. */
static cJSON *parse(const char *text, size_t n, problem *wrong)
{
    cJSON *texts = json_parse_sequence(text, n, wrong), *all = NULL;
    int n_texts = cJSON_GetArraySize(texts);
    if (texts == NULL)
        return NULL;
    if (n_texts == 1) {
        all = cJSON_DetachItemFromArray(texts, 0);
        cJSON_Delete(texts);
        return all;
    }
    const cJSON *item;
    int number = 0;
    cJSON_ArrayForEach(item, texts)
    {
        char shown[32];
        number++;
        if (strcmp(type_of(item), "Feature") == 0)
            continue;
        spoilt(wrong, 0, "text %d of %d is a '%s'; in a sequence each is a Feature", number,
               n_texts, quoted(shown, type_of(item)));
        cJSON_Delete(texts);
        return NULL;
    }
    all = cJSON_CreateObject();
    cJSON_AddStringToObject(all, "type", "FeatureCollection");
    cJSON_AddTrueToObject(all, "sequence");
    cJSON_AddItemToObject(all, "features", texts);
    return all;
}

bool cage_geojson_has(cage_role role, const char *text, size_t n)
{
    problem ignored;
    cJSON *object = parse(text, n, &ignored);
    const cJSON *feature;
    bool found = false;
    cJSON_ArrayForEach(feature, json_get(object, "features")) found =
        found || has_role(feature, role, "");
    cJSON_Delete(object);
    return found;
}

bool cage_read_geojson(cage *out, const cage_choice *choice, const char *text, size_t n,
                       problem *wrong)
{
    cJSON *object = parse(text, n, wrong);
    if (object == NULL)
        return false;
    bool good = read_object(out, choice, object, wrong) &&
                (!is_in_degrees(object) || cage_check_degrees(out, wrong));
    cJSON_Delete(object);
    return good;
}
