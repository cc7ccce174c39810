/* Lists all defects of a polygon, sorted. */
#ifndef ICCP_DEFECTS_H
#define ICCP_DEFECTS_H

#include "geometry/boxtree.h"
#include "geometry/defect.h"
#include "geometry/polygon.h"

/* Output arrays; see icc_boundary_defects(). */
typedef struct iccp_defect_list {
    size_t capacity;
    int32_t *kinds;  /* capacity: ICC_DEFECT_* */
    uint32_t *items; /* 2 * capacity: positions in the polygon */
    size_t n;        /* number of defects, also if it exceeds capacity */
} iccp_defect_list;

/* Lists all defects. `tree` belongs to the polygon. Points with NaN coordinates are listed as not
 * finite. */
icc_status iccp_defects_list(iccp_defect_list *list, const iccp_polygon *polygon,
                             const iccp_boxtree *tree, const iccp_env *env);

/* Returns the first entry of that list under a number, or kind 0 if there is none. Points must be
 * finite, with no two consecutive ones equal, and no smaller number may have an entry. O(n). */
iccp_defect iccp_defects_at(const iccp_polygon *polygon, uint32_t number);

/* Finds the first entry of that list. Returns kind 0 if there is none or if finding it takes too
 * long: it looks at only O(n) pairs of edges. */
icc_status iccp_defects_first(iccp_defect *first, const iccp_polygon *polygon,
                              const iccp_boxtree *tree, const iccp_env *env);

#endif
