/* Annotations that georeference a picture, as Allmaps writes them. The body is a FeatureCollection
 * whose Points have the pixel in the property resourceCoords, earlier pixelCoords. Pixels count from
 * the upper left corner, and y points down. A page has several annotations in its items.
 * https://iiif.io/api/extension/georef/
 *
 * Allmaps's own form is read too: an object GeoreferencedMap whose list gcps has pairs `resource`
 * and `geo`. */
#include "control/control_readers.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool control_is_annotation(const json_tree *tree)
{
    const json_item *object = json_first(tree->root);
    return json_has_type(object, "Annotation") || json_has_type(object, "AnnotationPage") ||
           json_has_type(object, "GeoreferencedMap");
}

/* Reads a pair of numbers. */
static bool read_pair(const json_item *pair, double out[2])
{
    const json_item *x = json_first(pair), *y = json_next(x);
    if (!json_is(pair, JSON_LIST) || !json_is(x, JSON_NUMBER) || !json_is(y, JSON_NUMBER))
        return false;
    out[0] = x->number;
    out[1] = y->number;
    return isfinite(out[0]) && isfinite(out[1]);
}

static bool read_point(control_points *out, const json_item *point, size_t line, problem *wrong)
{
    const json_item *properties = json_get(point, "properties");
    const json_item *pixel = json_get(properties, "resourceCoords");
    const json_item *place = json_get(json_get(point, "geometry"), "coordinates");
    double from[2], to[2];
    if (pixel == NULL)
        pixel = json_get(properties, "pixelCoords");
    if (pixel == NULL)
        pixel = json_get(point, "resource");
    if (place == NULL)
        place = json_get(point, "geo");
    if (!read_pair(pixel, from))
        return spoilt(wrong, line, "control point %zu has no pixel [x, y] in resourceCoords",
                      out->n);
    if (!read_pair(place, to))
        return spoilt(wrong, line, "control point %zu has no place [longitude, latitude]", out->n);
    control_add(out, from, to, line);
    const char *name = json_string_of(json_get(point, "id"));
    if (name != NULL)
        control_name(out, name, strlen(name));
    return true;
}

/* The list of points of an annotation or a map. */
static const json_item *points_of(const json_item *object)
{
    return json_has_type(object, "GeoreferencedMap")
               ? json_get(object, "gcps")
               : json_get(json_get(object, "body"), "features");
}

bool control_read_annotation(control_points *out, const json_tree *tree, const char *text,
                             problem *wrong)
{
    line_finder at = {text, 1};
    const json_item *object = json_first(tree->root);
    out->format = "a georeference annotation";
    out->rows_down = true;
    if (json_has_type(object, "AnnotationPage")) {
        const json_item *items = json_get(object, "items");
        if (json_size(items) != 1)
            return spoilt(
                wrong, 0,
                "the page has %zu annotations, one for each map; write one of them into a "
                "file ('jq \".items[0]\" FILE > OUT.json')",
                json_size(items));
        object = json_first(items);
    }
    const json_item *points = points_of(object);
    if (json_size(points) == 0)
        return spoilt(wrong, 0, "the annotation has no control points in body.features");
    out->crs = need(sizeof "OGC:CRS84", 1);
    memcpy(out->crs, "OGC:CRS84", sizeof "OGC:CRS84");
    for (const json_item *x = json_first(points); x != NULL; x = json_next(x))
        if (!read_point(out, x, line_finder_at(&at, text + x->begin), wrong))
            return false;
    return true;
}
