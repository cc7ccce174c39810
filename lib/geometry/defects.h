/* Everything that is wrong with a polygon, sorted. */
#ifndef ICCP_DEFECTS_H
#define ICCP_DEFECTS_H

#include "geometry/boxtree.h"
#include "geometry/defect.h"
#include "geometry/polygon.h"

/* Where a list goes; see icc_boundary_defects(). */
typedef struct iccp_defect_list {
    size_t capacity;
    int32_t *kinds;  /* capacity: ICC_DEFECT_* */
    uint32_t *items; /* 2 * capacity: positions in the polygon */
    size_t n;        /* also beyond capacity */
} iccp_defect_list;

/* `tree` is the polygon's. Points whose coordinates are NaN are listed as not finite. */
icc_status iccp_defects_list(iccp_defect_list *list, const iccp_polygon *polygon,
                             const iccp_boxtree *tree, const iccp_env *env);

/* The first entry of that list under a number, for finite points, of which no two that follow one
 * another are equal, if no smaller number has one; kind 0 if there is none. O(n). */
iccp_defect iccp_defects_at(const iccp_polygon *polygon, uint32_t number);

/* The first of that list, or kind 0 if there is none or it takes long to find: only a number of
 * pairs of edges proportional to n is looked at. */
icc_status iccp_defects_first(iccp_defect *first, const iccp_polygon *polygon,
                              const iccp_boxtree *tree, const iccp_env *env);

#endif
