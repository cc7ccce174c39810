/* Polygons out of bytes, most of them valid, for fuzzers that need domains. */
#ifndef TESTS_FUZZ_OUTLINES_H
#define TESTS_FUZZ_OUTLINES_H

#include "icc/icc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VERTICES = 64 };

static inline void require(int condition)
{
    if (!condition)
        abort();
}

/* One byte a vertex: its distance from the middle, so that the polygon is star-shaped; with `snap`
 * on an integer grid, where vertices repeat and edges touch. With `pairs` two bytes, its
 * coordinates. */
static inline size_t read_outline(const uint8_t *data, size_t size, int snap, int pairs, double *xy)
{
    size_t n = pairs ? size / 2 : size;
    n = n < MAX_VERTICES ? n : MAX_VERTICES;
    for (size_t i = 0; i < n; ++i) {
        const double a = 6.28318530717958647692 * (double)i / (double)n;
        const double r = pairs ? 0 : (double)(data[i] + 1) / 16;
        xy[2 * i] = pairs ? (data[2 * i] & 15) : snap ? floor(r * cos(a)) : r * cos(a);
        xy[2 * i + 1] = pairs ? (data[2 * i + 1] & 15) : snap ? floor(r * sin(a)) : r * sin(a);
    }
    return n;
}

/* Sizes and positions that users have. */
static inline void place_outline(size_t n, double *xy, int choice)
{
    static const double SCALES[4] = {1, 1e300, 1e-300, 1000};
    static const double OFFSETS[4] = {0, 0, 0, 1e9};
    for (size_t i = 0; i < 2 * n; ++i)
        xy[i] = xy[i] * SCALES[choice & 3] + OFFSETS[choice & 3];
}

/* Vertices, middles of edges and of diagonals, and whatever the bytes are as doubles. */
static inline size_t pick_points(size_t n, const double *xy, const uint8_t *data, size_t size,
                                 double *points)
{
    size_t count = 0;
    for (size_t i = 0; i < n; ++i) {
        const size_t next = (i + 1) % n, far = (i + n / 2) % n;
        for (size_t k = 0; k < 2; ++k) {
            points[2 * count + k] = xy[2 * i + k];
            points[2 * count + 2 + k] = xy[2 * i + k] / 2 + xy[2 * next + k] / 2;
            points[2 * count + 4 + k] = xy[2 * i + k] / 4 + xy[2 * far + k] * 0.75;
        }
        count += 3;
    }
    size_t n_raw = size / (2 * sizeof(double));
    n_raw = n_raw < MAX_VERTICES ? n_raw : MAX_VERTICES;
    if (n_raw > 0)
        memcpy(points + 2 * count, data, n_raw * 2 * sizeof(double));
    return count + n_raw;
}
enum { MAX_POINTS = 4 * MAX_VERTICES };

static inline int32_t pick_method(int choice)
{
    static const int32_t METHODS[4] = {ICC_METHOD_GRADIENT, ICC_METHOD_FOLIATION, ICC_METHOD_DISC,
                                       0};
    return METHODS[choice & 3];
}

static inline int is_point_status(icc_status status)
{
    return status == ICC_OK || status == ICC_ERR_OUTSIDE || status == ICC_ERR_TRACE ||
           status == ICC_ERR_ARGUMENT;
}

/* A result is there when the status says so, and only then. */
static inline void check_results(size_t n, const icc_status *status, const double *results,
                                 size_t width, size_t n_failed)
{
    for (size_t i = 0; i < n; ++i) {
        require(is_point_status(status[i]));
        n_failed -= status[i] != ICC_OK;
        for (size_t k = 0; k < width; ++k)
            require(status[i] == ICC_OK ? isfinite(results[width * i + k])
                                        : isnan(results[width * i + k]));
    }
    require(n_failed == 0);
}

#endif
