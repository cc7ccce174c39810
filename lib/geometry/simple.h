/* Tests whether a polygon is simple. Takes O(n) for most polygons and gives no answer for the
 * others. */
#ifndef ICCP_SIMPLE_H
#define ICCP_SIMPLE_H

#include "base/env.h"

#include <stdint.h>

/* Tests of boxes, and pairs of edges whose boxes meet, per edge, before the search gives up.
 * Together they take about as long as the sweep, which decides then. Outlines need up to 10 tests
 * and less than 1 pair. Spirals need up to 60 tests if their turns have hundreds of edges. Polygons
 * whose edges' boxes nearly all overlap, such as a diagonal comb, have up to n / 2 pairs. */
enum { ICCP_SIMPLE_TESTS = 64, ICCP_SIMPLE_PAIRS = 3 };

typedef enum iccp_simplicity { ICCP_UNDECIDED, ICCP_SIMPLE, ICCP_NOT_SIMPLE } iccp_simplicity;

typedef struct iccp_simple {
    iccp_simplicity answer;
    size_t n_tests, n_pairs; /* as the limits count them */
    /* For a polygon that is not simple: the number under which iccp_defects_list() has its first
     * entry, unless all points lie on one line. n: unknown, because an edge has no length. */
    size_t first;
} iccp_simple;

/* Tests n + 1 finite points, n >= 3, of which the last repeats the first. An answer is exact. A
 * polygon is not simple if it has repeated points, spikes, or edges that meet beyond their common
 * point. */
icc_status iccp_simple_find(iccp_simple *result, const double *points, size_t n,
                            const iccp_env *env);

#endif
