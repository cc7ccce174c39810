/* Walking along an integral line of a piecewise linear function on the Kuhn triangulation of a grid
 * of any dimension: gradient/trace/walk2.h is the same for the plane, and twice as fast there.
 *
 * Which simplex or face comes next is decided by exact signs of what f does there. Where the line
 * meets it is computed in doubles, and so is which of a simplex' facets is met first: facets that
 * are met at the same time up to rounding count as met together, in the face that they share.
 *
 * Lattice coordinates: vertex (i_0, i_1, ..) is at these coordinates. */
#ifndef ICCP_WALKN_H
#define ICCP_WALKN_H

#include "gradient/trace/boundary_cellsn.h"
#include "gradient/trace/path.h"
#include "gradient/trace/walkn_motion.h"

typedef struct iccp_walkn {
    iccp_slope slope;
    iccp_place place;
    bool ahead;    /* try the simplex of the place before others */
    bool merged;   /* the walk has followed a lower face or met one: other lines are on it */
    double s;      /* arc length walked */
    uint32_t cell; /* the lowest corner of the cell that the last step lay in */
    double from[ICC_MAX_DIM], to[ICC_MAX_DIM]; /* the last step */
    size_t steps_left; /* far more than a line can need; ICC_ERR_TRACE when used up */
    iccp_jetn *jet;    /* NULL when derivatives are not wanted */
} iccp_walkn;

/* Stands at a point in lattice coordinates; `direction` as in gradient/trace/walk2.h. From a point
 * that lies on a face, the walk goes into the simplex to which `ahead` points, if the gradient
 * there does not lead out of it again; NULL: the steepest way. When `jet` is not NULL it holds the
 * derivative of the point and is carried along. ICC_ERR_TRACE when the point is not in a simplex
 * with values. */
icc_status iccp_walkn_start(iccp_walkn *walk, const icc_function *function, int direction,
                            const double *x, const double *ahead, iccp_jetn *jet);

/* Goes on to the next face (Algorithm 3). ICC_ERR_TRACE when there is no way on. */
icc_status iccp_walkn_step(iccp_walkn *walk);

/* Whether the walk stands on the maximum. */
bool iccp_walkn_at_root(const iccp_walkn *walk);

/* Algorithm 4: to the maximum. Appends every point, the first included, to `path` (started anew)
 * when it is not NULL. On success walk->s is the length. `merge` receives the arc length at which
 * the line first merges with others (walk->s if never); may be NULL. */
icc_status iccp_walkn_uphill(iccp_walkn *walk, iccp_path *path, double *merge);

/* Algorithm 5: to the boundary. The walk must have started inside. The last step ends on the
 * boundary, and walk->s and the jet include it. */
icc_status iccp_walkn_downhill(iccp_walkn *walk, const iccp_boundary_cellsn *cells, iccp_path *path,
                               iccp_boundary_hitn *hit);

/* Sign of the derivative of f at a point along a direction, by the simplex that lies there: -1, 0,
 * +1, or 0 where there are no values. For judging transversality; not exact. */
int iccp_walkn_slope_sign(const icc_function *function, const double *x, const double *direction);

#endif
