/* Tests whether a polygon is simple. Takes O(n) for most polygons and gives no answer for the
 * others. */
#ifndef ICCP_SIMPLE_H
#define ICCP_SIMPLE_H

#include "base/env.h"

#include <stdint.h>

/* Tests of boxes and of pairs of edges, per edge, before the search gives up. Outlines need up to 2
 * and most spirals up to 10. Polygons whose boxes nearly all overlap, such as a diagonal comb, need
 * up to n. */
enum { ICCP_SIMPLE_PATIENCE = 48 };

typedef enum iccp_simplicity { ICCP_UNDECIDED, ICCP_SIMPLE, ICCP_NOT_SIMPLE } iccp_simplicity;

typedef struct iccp_simple {
    iccp_simplicity answer;
    size_t n_tests; /* tests of boxes and pairs of edges */
    /* For a polygon that is not simple: the number under which iccp_defects_list() has its first
     * entry, unless all points lie on one line. n: unknown. */
    size_t first;
} iccp_simple;

/* Tests n + 1 finite points, n >= 3, of which the last repeats the first. An answer is exact. A
 * polygon is not simple if it has repeated points, spikes, or edges that meet beyond their common
 * point. */
icc_status iccp_simple_find(iccp_simple *result, const double *points, size_t n,
                            const iccp_env *env);

#endif
