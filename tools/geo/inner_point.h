/* Finds a point inside a polygon. */
#ifndef INNER_POINT_H
#define INNER_POINT_H

#include <stddef.h>

/* A point inside a simple polygon of n vertices, up to rounding. */
void inner_point(size_t n, const double *ring, double out[2]);

#endif
