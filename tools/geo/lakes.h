/* The lakes of a cage in the plane: the pieces of the outside that the cage surrounds. A lake is a
 * hole without the islands in it, or a gap between regions that touch. */
#ifndef LAKES_H
#define LAKES_H

#include "geo/carrier.h"

typedef struct lakes {
    size_t n, room;
    double *points; /* one inside each lake, up to rounding */
} lakes;

/* Finds a point in each lake. Free the result. */
void lakes_find(lakes *out, const carrier *cage);
void lakes_free(lakes *l);

#endif
