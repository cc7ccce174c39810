/* The coordinates of a geometry: the places of its positions in the text, and the lines and rings
 * that they form. */
#ifndef GEO_SHAPE_H
#define GEO_SHAPE_H

#include "geo/geo_index.h"

/* A sequence of positions: a line, a ring, the points of a MultiPoint, or one point. */
typedef struct geo_path {
    size_t first, n;
    size_t part; /* the polygon of a MultiPolygon */
} geo_path;

typedef struct geo_shape {
    geo_type type;
    size_t n, n_paths, n_parts;
    geo_span *spans; /* n: each with its brackets */
    double *points;  /* 2 n */
    geo_path *paths;
    size_t room_spans, room_points, room_paths;
} geo_shape;

/* Reads the coordinates of a geometry, which have been checked to be JSON. If its points are known
 * from an earlier reading, they are copied. The shape may have been used before, or must be zeros.
 * False: see `wrong`. */
bool geo_shape_read(geo_shape *out, const geo_object *object, const char *text, const double *known,
                    problem *wrong);
void geo_shape_free(geo_shape *shape);

/* Finds the next number after p in checked JSON, and its end. NULL before a closing bracket. */
const char *geo_next_number(const char *p, const char **end);

#endif
