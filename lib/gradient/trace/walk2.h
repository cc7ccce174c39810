/* Walking along an integral line of a piecewise linear function on the triangulated 2-D grid.
 *
 * Every grid cell is cut by the diagonal from (i, j) to (i + 1, j + 1). Which edge comes next is
 * decided by exact signs (topology); where on it the line passes is computed in doubles (geometry).
 * Lattice coordinates: vertex (i, j) is at x = i, y = j. */
#ifndef ICCP_WALK2_H
#define ICCP_WALK2_H

#include "gradient/function/function.h"
#include "gradient/trace/boundary_cells2.h"
#include "gradient/trace/path.h"

/* Derivatives by two parameters of what a walk computes, one column each. */
typedef struct iccp_jet2 {
    double x[2], y[2]; /* of the position */
    double s[2];       /* of the arc length so far */
} iccp_jet2;

/* Which way to go. */
enum { ICCP_UPHILL = 1, ICCP_DOWNHILL = -1 };

typedef struct iccp_walk2 {
    const icc_function *function;
    size_t nx, ny;  /* vertices along the axes */
    uint32_t root;  /* the maximum */
    int direction;  /* ICCP_UPHILL or ICCP_DOWNHILL */
    bool at_vertex; /* at vertex (i, j); else in or on a triangle of cell (i, j) */
    bool merged;    /* the walk has followed an edge or met a vertex: other lines are on
                       it */
    int upper;      /* the triangle above (1) or below (0) the diagonal */
    int edge;       /* the edge of the triangle that the walk stands on, or -1: anywhere */
    size_t i, j;
    double u, v;           /* position within the cell, in [0,1] */
    double s;              /* arc length walked */
    size_t cell[2];        /* the cell that the last step lay in */
    double from[2], to[2]; /* the last step */
    size_t steps_left;     /* far more than a line can need; ICC_ERR_TRACE when used up */
    iccp_jet2 *jet;        /* NULL when derivatives are not wanted */
} iccp_walk2;

/* Stands at a point in lattice coordinates. When `jet` is not NULL it holds the derivative of the
 * point and is carried along. ICC_ERR_TRACE when the point is not in a cell with values. */
icc_status iccp_walk2_start(iccp_walk2 *walk, const icc_function *function, int direction, double x,
                            double y, iccp_jet2 *jet);

/* Called after a start that lies on an edge, has it go into the triangle on the side to which
 * `ahead` points, if that has values; does nothing after any other start. */
void iccp_walk2_face(iccp_walk2 *walk, const double ahead[2]);

/* Goes on to the next edge or vertex (Algorithm 3). ICC_ERR_TRACE when there is no way on. */
icc_status iccp_walk2_step(iccp_walk2 *walk);

/* Whether the walk stands on the maximum. */
bool iccp_walk2_at_root(const iccp_walk2 *walk);

/* Position in lattice coordinates. */
void iccp_walk2_position(const iccp_walk2 *walk, double p[2]);

/* Algorithm 4: to the maximum. Appends every point, the first included, to `path` (cleared first)
 * when it is not NULL. On success walk->s is the length. `merge` receives the arc length at which
 * the line first merges with others (walk->s if never); may be NULL. */
icc_status iccp_trace_uphill(iccp_walk2 *walk, iccp_path *path, double *merge);

/* Algorithm 5: to the boundary. The walk must have started inside. The last step ends on the
 * boundary; walk->s and the jet include it. */
icc_status iccp_trace_downhill(iccp_walk2 *walk, const iccp_boundary_cells2 *cells, iccp_path *path,
                               iccp_boundary_hit2 *hit);

/* Sign of the derivative of f at a point along a direction, by the triangle that holds it: -1, 0,
 * +1, or 0 where there are no values. For judging transversality; not exact. */
int iccp_slope_sign(const icc_function *function, const double p[2], const double direction[2]);

#endif
