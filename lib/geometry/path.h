/* A polyline with its arc length, which grows as needed. One path serves many curves, so a loop
 * over points does not allocate. */
#ifndef ICCP_PATH_H
#define ICCP_PATH_H

#include "base/memory.h"
#include "icc/base.h"

#include <stdbool.h>

typedef struct iccp_path {
    const iccp_memory *memory;
    size_t dim;
    size_t n;        /* number of points */
    size_t capacity; /* in doubles */
    double *points;  /* dim + 1 numbers each: the position, and the arc length from the start */
    struct iccp_flow_mark *marks; /* used by walks along a vector field: see field/flow.h */
    size_t n_marks, mark_capacity;
} iccp_path;

/* Makes an empty path, which allocates nothing yet. `memory` must outlive it. */
void iccp_path_init(iccp_path *path, const iccp_memory *memory);
void iccp_path_clear(iccp_path *path);

/* Begins a new curve, which replaces the last one. */
static inline void iccp_path_start(iccp_path *path, size_t dim)
{
    path->dim = dim;
    path->n = 0;
}

icc_status iccp_path_append(iccp_path *path, const double *point, double s);

/* Makes room for more points. Returns false if there is no memory. */
bool iccp_path_grow(iccp_path *path);

/* Appends a point of dim + 1 numbers, which the caller fills in. Returns NULL if there is no
 * memory. */
static inline double *iccp_path_extend(iccp_path *path)
{
    const size_t at = (path->dim + 1) * path->n;
    if (at + path->dim + 1 > path->capacity && !iccp_path_grow(path))
        return NULL;
    ++path->n;
    return path->points + at;
}

/* Returns the position of point k, followed by its arc length. */
static inline const double *iccp_path_at(const iccp_path *path, size_t k)
{
    return path->points + (path->dim + 1) * k;
}

static inline double iccp_path_length_at(const iccp_path *path, size_t k)
{
    return iccp_path_at(path, k)[path->dim];
}

/* The length of a path, which must not be empty. */
static inline double iccp_path_length(const iccp_path *path)
{
    return iccp_path_length_at(path, path->n - 1);
}

/* Returns the index k of the piece [k, k + 1] that contains arc length s, and the position in the
 * piece as a share. The path has at least two points. */
size_t iccp_path_find(const iccp_path *path, double s, double *share);

/* Computes the point at a share of a piece. */
void iccp_path_point(const iccp_path *path, size_t piece, double share, double *point);

#endif
