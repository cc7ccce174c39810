/* Tests of longitudes and latitudes in degrees, as GeoJSON has them. */
#ifndef DEGREES_H
#define DEGREES_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static inline bool are_degrees(size_t n, const double *points)
{
    bool good = true;
    for (size_t i = 0; i < n; i++)
        good = good && fabs(points[2 * i]) <= 180 && fabs(points[2 * i + 1]) <= 90;
    return good;
}

/* True if an edge between two longitudes may be meant to cross the antimeridian. An edge from -180
 * to 180, around the whole earth, is not. */
static inline bool longitudes_jump(double x, double y)
{
    return fabs(y - x) > 180 && fabs(y - x) < 360;
}

#endif
