/* A polyline in the plane with its arc length, and optionally its derivative by one parameter.
 * Grows as needed; one path serves many curves, so that a loop over points does not allocate. */
#ifndef ICCP_PATH_H
#define ICCP_PATH_H

#include "base/memory.h"
#include "icc/base.h"

#include <stdbool.h>

typedef struct iccp_path_point {
    double x, y; /* lattice coordinates */
    double s;    /* arc length from the start */
} iccp_path_point;

typedef struct iccp_path {
    const iccp_memory *memory;
    size_t n, capacity;
    iccp_path_point *points;
} iccp_path;

/* An empty path that allocates nothing yet. `memory` must outlive it. */
void iccp_path_init(iccp_path *path, const iccp_memory *memory);
void iccp_path_clear(iccp_path *path);
icc_status iccp_path_append(iccp_path *path, double x, double y, double s);

/* The index k of the piece [k, k + 1] that holds arc length s, for a path of at least two points. */
size_t iccp_path_find(const iccp_path *path, double s);

#endif
