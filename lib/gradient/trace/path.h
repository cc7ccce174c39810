/* A polyline with its arc length. Grows as needed; one path serves many curves, so that a loop over
 * points does not allocate. */
#ifndef ICCP_PATH_H
#define ICCP_PATH_H

#include "base/memory.h"
#include "icc/base.h"

#include <stdbool.h>

typedef struct iccp_path {
    const iccp_memory *memory;
    size_t dim;
    size_t n;        /* points */
    size_t capacity; /* doubles */
    double *points;  /* dim + 1 each: the position, and the arc length from the start */
    struct iccp_flow_mark *marks; /* for walks along a vector field: see field/flow.h */
    size_t n_marks, mark_capacity;
} iccp_path;

/* An empty path that allocates nothing yet. `memory` must outlive it. */
void iccp_path_init(iccp_path *path, const iccp_memory *memory);
void iccp_path_clear(iccp_path *path);

/* Begins a curve in place of the last one. */
static inline void iccp_path_start(iccp_path *path, size_t dim)
{
    path->dim = dim;
    path->n = 0;
}

icc_status iccp_path_append(iccp_path *path, const double *point, double s);

/* Makes room for more points; false if there is no memory. */
bool iccp_path_grow(iccp_path *path);

/* Appends a point that the caller fills in, dim + 1 numbers; NULL if there is no memory. */
static inline double *iccp_path_extend(iccp_path *path)
{
    const size_t at = (path->dim + 1) * path->n;
    if (at + path->dim + 1 > path->capacity && !iccp_path_grow(path))
        return NULL;
    ++path->n;
    return path->points + at;
}

/* The position of point k; its arc length stands behind. */
static inline const double *iccp_path_at(const iccp_path *path, size_t k)
{
    return path->points + (path->dim + 1) * k;
}

static inline double iccp_path_length_at(const iccp_path *path, size_t k)
{
    return iccp_path_at(path, k)[path->dim];
}

/* Of a path that is not empty. */
static inline double iccp_path_length(const iccp_path *path)
{
    return iccp_path_length_at(path, path->n - 1);
}

/* The index k of the piece [k, k + 1] that holds arc length s, and how far along it that is, for a
 * path of at least two points. */
size_t iccp_path_find(const iccp_path *path, double s, double *share);

/* The position that far along a piece. */
void iccp_path_point(const iccp_path *path, size_t piece, double share, double *point);

#endif
