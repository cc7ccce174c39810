/* Walks along an integral line of a piecewise linear function on the Kuhn triangulation of a grid
 * of any dimension. gradient/trace/walk2.h does the same in the plane, twice as fast.
 *
 * Exact signs of the behaviour of f decide which simplex or face comes next. Doubles give the place
 * where the line meets it, and also which facet of a simplex is met first. Facets that are met at
 * the same time up to rounding count as met together, in their common face.
 *
 * In lattice coordinates, vertex (i_0, i_1, ..) is at these coordinates. */
#ifndef ICCP_WALKN_H
#define ICCP_WALKN_H

#include "geometry/path.h"
#include "gradient/trace/boundary_cellsn.h"
#include "gradient/trace/walkn_motion.h"

typedef struct iccp_walkn {
    iccp_slope slope;
    iccp_place place;
    bool ahead;    /* try the simplex of the place before others */
    bool merged;   /* the walk has followed or met a lower face, so other lines join it */
    double s;      /* arc length so far */
    double alone;  /* arc length until other lines joined the walk */
    uint32_t cell; /* lowest corner of the cell of the last step */
    double from[ICC_MAX_DIM], to[ICC_MAX_DIM]; /* the last step */
    size_t steps_left; /* far more than a line can need; then ICC_ERR_TRACE */
    iccp_jetn *jet;    /* NULL: no derivatives */
} iccp_walkn;

/* Starts a walk at a point in lattice coordinates; `direction` is as in gradient/trace/walk2.h.
 * From a point on a face, the walk enters the simplex to which `ahead` points, unless the gradient
 * leads out of it again. If `ahead` is NULL, it takes the steepest way. If `jet` is not NULL, it
 * holds the derivative of the point, and the walk updates it. Returns ICC_ERR_TRACE if the point is
 * not in a simplex with values. */
icc_status iccp_walkn_start(iccp_walkn *walk, const icc_function *function, int direction,
                            const double *x, const double *ahead, iccp_jetn *jet);

/* Goes on to the next face (Algorithm 3). Returns ICC_ERR_TRACE if there is none. */
icc_status iccp_walkn_step(iccp_walkn *walk);

/* Returns true if the walk stands on the maximum. */
bool iccp_walkn_at_root(const iccp_walkn *walk);

/* Algorithm 4: walks to the maximum. Restarts `path`, unless NULL, and appends every point
 * including the first. On success walk->s is the length. */
icc_status iccp_walkn_uphill(iccp_walkn *walk, iccp_path *path);

/* Algorithm 5: walks to the boundary. The walk must have started inside. The last step ends on the
 * boundary, and walk->s and the jet include it. If `cells` is NULL, there is no boundary, and the
 * walk ends with ICC_ERR_TRACE where there are no values. */
icc_status iccp_walkn_downhill(iccp_walkn *walk, const iccp_boundary_cellsn *cells, iccp_path *path,
                               iccp_boundary_hitn *hit);

/* Returns the sign of the derivative of f at a point along a direction, in the simplex there: -1, 0
 * or +1, and 0 where there are no values. Serves to judge transversality; not exact. */
int iccp_walkn_slope_sign(const icc_function *function, const double *x, const double *direction);

#endif
