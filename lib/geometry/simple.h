/* Whether a polygon is simple: in O(n) for most, with no answer for the others. */
#ifndef ICCP_SIMPLE_H
#define ICCP_SIMPLE_H

#include "base/env.h"

#include <stdint.h>

/* Tests of boxes and of pairs of edges, per edge, after which the search gives up. Outlines need up
 * to 2, most spirals up to 10; polygons whose boxes nearly all overlap, such as a diagonal comb, up
 * to n. */
enum { ICCP_SIMPLE_PATIENCE = 48 };

typedef enum iccp_simplicity { ICCP_UNDECIDED, ICCP_SIMPLE, ICCP_NOT_SIMPLE } iccp_simplicity;

typedef struct iccp_simple {
    iccp_simplicity answer;
    size_t n_tests; /* of boxes and pairs of edges */
    size_t first;   /* if not simple: the number under which iccp_defects_list() has its first
                       entry, save that all points lie on one line; n: it is not known */
} iccp_simple;

/* For n + 1 finite points, the last of which is the first again; n >= 3. Exact, if there is an
 * answer: not simple are repeated points, spikes, and edges that meet beyond the point that they
 * share. */
icc_status iccp_simple_find(iccp_simple *result, const double *points, size_t n,
                            const iccp_env *env);

#endif
