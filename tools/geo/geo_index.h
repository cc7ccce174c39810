/* Finds the objects of a GeoJSON text (RFC 7946) and the places of their members. */
#ifndef GEO_INDEX_H
#define GEO_INDEX_H

#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The index of no object, and of no edge. */
#define GEO_NOWHERE UINT32_MAX

/* Geometries with coordinates come first. */
typedef enum geo_type {
    GEO_POINT,
    GEO_MULTI_POINT,
    GEO_LINE,
    GEO_MULTI_LINE,
    GEO_POLYGON,
    GEO_MULTI_POLYGON,
    GEO_GEOMETRIES,
    GEO_FEATURE,
    GEO_FEATURES,
    GEO_UNKNOWN
} geo_type;

extern const char *const geo_type_names[];

/* How one object is held by another. */
typedef enum geo_route { GEO_ROOT, GEO_IN_GEOMETRY, GEO_IN_GEOMETRIES, GEO_IN_FEATURES } geo_route;

/* A piece of the text. If begin == end, it is absent. */
typedef struct geo_span {
    size_t begin, end;
} geo_span;

typedef struct geo_object {
    geo_span all, type_name, coordinates, bbox, id;
    uint32_t parent; /* its parent, which comes before it; GEO_NOWHERE if there is none */
    uint32_t top;    /* the geometry of a feature to which this geometry belongs, or GEO_NOWHERE */
    uint32_t number; /* place in the list that holds it, from 0 */
    geo_type type;
    geo_route route;
    unsigned members, repeated; /* bits: which members are present, and which are repeated */
    size_t odd[3]; /* where geometry, geometries, features or an item has a wrong type, or 0 */
    bool live;     /* false if it is part of a foreign member, which is left alone */
} geo_object;

typedef struct geo_index {
    geo_object *objects;
    size_t n, room;
    bool sequence; /* of several texts, or with separators (RFC 8142) */
} geo_index;

/* Checks text[0..n), with text[n] == '\0', and finds its objects. False: see `wrong`. Free the
 * result in either case. */
bool geo_index_read(geo_index *out, const char *text, size_t n, problem *wrong);
void geo_index_free(geo_index *index);

static inline bool geo_has(geo_span span)
{
    return span.end > span.begin;
}

#endif
