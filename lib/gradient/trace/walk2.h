/* Walks along an integral line of a piecewise linear function on the triangulated 2-D grid.
 *
 * Every grid cell is cut by the diagonal from (i, j) to (i + 1, j + 1). Exact signs decide which
 * edge comes next (topology). Doubles give the place where the line crosses it (geometry). In
 * lattice coordinates, vertex (i, j) is at x = i, y = j.
 *
 * Words of this folder, stage 4 of the papers. This header has the plane;
 * walkn.h is the same in any dimension.
 * - line: an integral line of the function's gradient. A walk follows it uphill to the maximum or
 *   downhill to the boundary.
 * - step: the part of a line within one simplex or face.
 * - cell: a cube of the grid, which the Kuhn triangulation cuts into simplices.
 * - merged: a walk that has met a vertex or followed an edge, which other lines share.
 * - jet: derivatives of the walk's position and arc length with respect to its start.
 * - hit: where a step meets the boundary (boundary_cells2.h, boundary_cellsn.h).
 * - place, motion, slope: where a walk stands, how it moves on a face, and the values that it
 *   climbs (walkn_star.h, walkn_motion.h).
 *
 * Invariants: exact signs decide which simplex or face comes next, and doubles give the place where
 * the line meets it. f rises strictly along a walk (equal values by vertex index), so no walk
 * loops. Positions are in lattice coordinates. */
#ifndef ICCP_WALK2_H
#define ICCP_WALK2_H

#include "geometry/path.h"
#include "gradient/function/function.h"
#include "gradient/trace/boundary_cells2.h"

/* Derivatives of a walk with respect to two parameters, one column each. */
typedef struct iccp_jet2 {
    double x[2], y[2]; /* derivatives of the position */
    double s[2];       /* derivatives of the arc length so far */
} iccp_jet2;

/* Direction of a walk. */
enum { ICCP_UPHILL = 1, ICCP_DOWNHILL = -1 };

typedef struct iccp_walk2 {
    const icc_function *function;
    size_t nx, ny; /* number of vertices along the axes */
    uint32_t root; /* vertex of the maximum */
    int direction; /* ICCP_UPHILL or ICCP_DOWNHILL */
    /* The walk is at vertex (i, j); else it is in or on a triangle of cell (i, j) */
    bool at_vertex;
    bool merged; /* the walk has followed an edge or met a vertex, so other lines join it */
    int upper;   /* the triangle above (1) or below (0) the diagonal */
    int edge;    /* edge of the triangle on which the walk stands; -1: anywhere */
    size_t i, j;
    double u, v;           /* position within the cell, in [0, 1] */
    double s;              /* arc length so far */
    double alone;          /* arc length until other lines joined the walk */
    size_t cell[2];        /* cell of the last step */
    double from[2], to[2]; /* the last step */
    size_t steps_left;     /* far more than a line can need; then ICC_ERR_TRACE */
    iccp_jet2 *jet;        /* NULL: no derivatives */
} iccp_walk2;

/* Starts a walk at a point in lattice coordinates. If `jet` is not NULL, it holds the derivative of
 * the point, and the walk updates it. Returns ICC_ERR_TRACE if the point is not in a cell with
 * values. */
icc_status iccp_walk2_start(iccp_walk2 *walk, const icc_function *function, int direction, double x,
                            double y, iccp_jet2 *jet);

/* Call it after a start on an edge. The walk then goes into the triangle on the side to which
 * `ahead` points, if that has values. Does nothing after any other start. */
void iccp_walk2_face(iccp_walk2 *walk, const double ahead[2]);

/* Goes on to the next edge or vertex (Algorithm 3). Returns ICC_ERR_TRACE if there is none. */
icc_status iccp_walk2_step(iccp_walk2 *walk);

/* Returns true if the walk stands on the maximum. */
bool iccp_walk2_at_root(const iccp_walk2 *walk);

/* Computes the position in lattice coordinates. */
void iccp_walk2_position(const iccp_walk2 *walk, double p[2]);

/* Algorithm 4: walks to the maximum. Clears `path`, unless NULL, and appends every point including
 * the first. On success walk->s is the length. */
icc_status iccp_trace_uphill(iccp_walk2 *walk, iccp_path *path);

/* Algorithm 5: walks to the boundary. The walk must have started inside. The last step ends on the
 * boundary, and walk->s and the jet include it. If `cells` is NULL, there is no boundary, and the
 * walk ends with ICC_ERR_TRACE where there are no values. */
icc_status iccp_trace_downhill(iccp_walk2 *walk, const iccp_boundary_cells2 *cells, iccp_path *path,
                               iccp_boundary_hit2 *hit);

/* Returns the sign of the derivative of f at a point along a direction, in the triangle that
 * contains it: -1, 0 or +1, and 0 where there are no values. Serves to judge transversality; not
 * exact. */
int iccp_slope_sign(const icc_function *function, const double p[2], const double direction[2]);

#endif
