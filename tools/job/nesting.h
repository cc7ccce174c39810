/* Finds which polygon lies in which hole of which other. */
#ifndef NESTING_H
#define NESTING_H

#include "cage/cage.h"

/* A hole of a polygon among the polygons of a cage, or none. */
typedef struct cage_hole {
    size_t polygon, hole;
} cage_hole;

#define NO_HOLE SIZE_MAX

/* The polygons of a cage by their numbers, from 0. */
const cage *cage_polygon(const cage *c, size_t i);

/* True if a point is inside a ring. A point on it may count as inside. Exact. */
bool ring_holds(size_t n, const double *ring, const double *point);

/* The smallest hole that contains a vertex of polygon i. */
cage_hole nesting_of(const cage *c, size_t i);

#endif
