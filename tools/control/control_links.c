/* Control points as GeoJSON. A line without a role is a link: its first vertex goes to its last.
 * Points with the property `role` "source" or "target" are paired by the property `feature`, else
 * by `id` or `name`. Other geometries are ignored, so an outline may stand beside them.
 *
 * Further properties: `tolerance`, a number, and `enabled`, which leaves a link out if it is
 * false. */
#include "control/control_readers.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A Point with a role that waits for its partner. */
typedef struct lone_point {
    const json_item *feature, *key;
    double at[2];
    size_t line;
    bool is_target, is_paired;
} lone_point;

typedef struct links {
    control_points *out;
    const char *text;
    line_finder at;
    size_t n, room;
    lone_point *points;
} links;

static const json_item *property(const json_item *feature, const char *name)
{
    return json_get(json_get(feature, "properties"), name);
}

static bool read_position(const json_item *position, double out[2], size_t line, problem *wrong)
{
    const json_item *x = json_first(position), *y = json_next(x);
    if (!json_is(x, JSON_NUMBER) || !json_is(y, JSON_NUMBER) || !isfinite(x->number) ||
        !isfinite(y->number))
        return spoilt(wrong, line, "a position is not a pair of finite numbers [x, y]");
    out[0] = x->number;
    out[1] = y->number;
    return true;
}

/* What names a feature: a property, or the feature's own id; or NULL. */
static const json_item *key_of(const json_item *feature)
{
    static const char *const names[] = {"feature", "id", "name"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const json_item *key = property(feature, names[i]);
        if (json_is(key, JSON_STRING) || json_is(key, JSON_NUMBER))
            return key;
    }
    const json_item *id = json_get(feature, "id");
    return json_is(id, JSON_STRING) || json_is(id, JSON_NUMBER) ? id : NULL;
}

/* Takes the name and the tolerance of the last point. */
static bool take_properties(links *l, const json_item *feature, size_t line, problem *wrong)
{
    const json_item *key = key_of(feature), *tolerance = property(feature, "tolerance");
    const char *string = json_string_of(key);
    if (string != NULL)
        control_name(l->out, string, strlen(string));
    else if (key != NULL)
        control_name(l->out, l->text + key->begin, key->end - key->begin);
    if (tolerance == NULL || json_is(tolerance, JSON_NULL))
        return true;
    if (!json_is(tolerance, JSON_NUMBER) || !(tolerance->number >= 0) ||
        !isfinite(tolerance->number))
        return spoilt(wrong, line, "the tolerance is not a number of at least 0");
    control_tolerance(l->out, tolerance->number);
    return true;
}

/* The line of a feature's coordinates, or of the feature if they are missing. */
static size_t line_at(links *l, const json_item *feature, const json_item *coordinates)
{
    return line_finder_at(&l->at, l->text + (coordinates != NULL ? coordinates : feature)->begin);
}

static bool read_link(links *l, const json_item *feature, const json_item *line_string,
                      problem *wrong)
{
    double from[2], to[2];
    size_t line = line_at(l, feature, line_string);
    const json_item *first = json_first(line_string), *last = first;
    if (json_is(property(feature, "enabled"), JSON_FALSE)) {
        l->out->n_disabled++;
        return true;
    }
    for (const json_item *x = first; x != NULL; x = json_next(x))
        last = x;
    if (json_size(line_string) < 2)
        return spoilt(wrong, line, "a link has at least 2 vertices: from where, and to where");
    if (!read_position(first, from, line, wrong) || !read_position(last, to, line, wrong))
        return false;
    control_add(l->out, from, to, line);
    return take_properties(l, feature, line, wrong);
}

static bool keep_point(links *l, const json_item *feature, const json_item *position,
                       problem *wrong)
{
    const char *role = json_string_of(property(feature, "role"));
    bool is_target = role != NULL && strcmp(role, "target") == 0;
    if (!is_target && (role == NULL || strcmp(role, "source") != 0))
        return true;
    lone_point p = {.feature = feature, .key = key_of(feature), .is_target = is_target};
    p.line = line_at(l, feature, position);
    if (p.key == NULL)
        return spoilt(wrong, p.line,
                      "a Point with a role has no property \"feature\" or \"id\", which pairs it");
    if (!read_position(position, p.at, p.line, wrong))
        return false;
    l->points = grow(l->points, &l->room, l->n + 1, sizeof *l->points);
    l->points[l->n++] = p;
    return true;
}

/* Reads a Feature, or a geometry without one. */
static bool read_feature(links *l, const json_item *feature, problem *wrong)
{
    const json_item *geometry =
        json_has_type(feature, "Feature") ? json_get(feature, "geometry") : feature;
    const json_item *coordinates = json_get(geometry, "coordinates");
    bool has_role = property(feature, "role") != NULL;
    if (json_has_type(geometry, "Point"))
        return keep_point(l, feature, coordinates, wrong);
    if (json_has_type(geometry, "LineString") && !has_role)
        return read_link(l, feature, coordinates, wrong);
    bool good = true;
    if (json_has_type(geometry, "MultiLineString") && !has_role)
        for (const json_item *x = json_first(coordinates); x != NULL && good; x = json_next(x))
            good = read_link(l, feature, x, wrong);
    return good;
}

static int order_items(const json_item *a, const json_item *b)
{
    const char *s = json_string_of(a), *t = json_string_of(b);
    if ((s == NULL) != (t == NULL))
        return s == NULL ? -1 : 1;
    return s != NULL ? strcmp(s, t) : (a->number > b->number) - (a->number < b->number);
}

/* Sorts by key, the source before the target, then by line. */
static int order_points(const void *a, const void *b)
{
    const lone_point *p = a, *q = b;
    int order = order_items(p->key, q->key);
    return order != 0                     ? order
           : p->is_target != q->is_target ? (p->is_target ? 1 : -1)
                                          : (p->line > q->line) - (p->line < q->line);
}

static int order_lines(const void *a, const void *b)
{
    const lone_point *p = a, *q = b;
    return (p->feature > q->feature) - (p->feature < q->feature);
}

/* Finds the partner of each Point, and names the first that has none or several. */
static bool check_pairs(const links *l, problem *wrong)
{
    for (size_t i = 0; i < l->n; i += 2) {
        const lone_point *p = &l->points[i], *q = i + 1 < l->n ? p + 1 : NULL;
        bool pairs = q != NULL && order_items(p->key, q->key) == 0;
        if (!pairs)
            return spoilt(wrong, p->line, "this %s Point has no partner in the %s",
                          p->is_target ? "target" : "source", p->is_target ? "source" : "target");
        if (p->is_target == q->is_target || (i + 2 < l->n && order_items(p->key, p[2].key) == 0))
            return spoilt(wrong, q->line,
                          "this Point has the same name as another one of its side (line %zu)",
                          p->is_target == q->is_target ? p->line : p[2].line);
    }
    return true;
}

/* Adds the pairs in the order in which the file has the points of the source. */
static bool add_pairs(links *l, problem *wrong)
{
    if (l->n == 0)
        return true;
    qsort(l->points, l->n, sizeof *l->points, order_points);
    if (!check_pairs(l, wrong))
        return false;
    lone_point *sources = need(l->n / 2, sizeof *sources);
    for (size_t i = 0; i < l->n / 2; i++)
        sources[i] = l->points[2 * i];
    qsort(sources, l->n / 2, sizeof *sources, order_lines);
    bool good = true;
    for (size_t i = 0; i < l->n / 2 && good; i++) {
        const lone_point *p =
            bsearch(&sources[i], l->points, l->n, sizeof *l->points, order_points);
        control_add(l->out, p->at, p[1].at, p->line);
        good = take_properties(l, p->feature, p->line, wrong);
    }
    free(sources);
    return good;
}

bool control_read_links(control_points *out, const json_tree *tree, const char *text,
                        problem *wrong)
{
    links l = {.out = out, .text = text, .at = {text, 1}};
    const json_item *texts = tree->root, *object = json_first(texts);
    const json_item *features = json_get(object, "features");
    bool good = true;
    out->format = "links or pairs of Points";
    for (const json_item *x = features != NULL ? json_first(features) : json_first(texts);
         x != NULL && good; x = json_next(x))
        good = read_feature(&l, x, wrong);
    good = good && add_pairs(&l, wrong);
    free(l.points);
    return good && (out->n + out->n_disabled > 0 ||
                    spoilt(wrong, 0,
                           "no control points: GeoJSON has them as lines from one place to the "
                           "other, or as Points with the property \"role\": \"source\" or "
                           "\"target\" and one \"id\" for a pair"));
}
