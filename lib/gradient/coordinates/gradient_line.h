/* A gradient line from a point down to the boundary, or up to the maximum: in the plane by
 * gradient/trace/walk2.h, elsewhere by gradient/trace/walkn.h. */
#ifndef ICCP_GRADIENT_LINE_H
#define ICCP_GRADIENT_LINE_H

#include "gradient/coordinates/gradient_state.h"
#include "gradient/trace/walkn.h"

typedef struct iccp_gradient_line {
    double s;       /* arc length, lattice units */
    bool merged;    /* whether others have joined it */
    double alone;   /* up: arc length until they did */
    uint32_t facet; /* down: where it ends */
    double bary[ICC_MAX_DIM];
} iccp_gradient_line;

/* From a point in lattice coordinates to the boundary. `path`, in lattice coordinates, may be NULL;
 * so may `jet`, which holds the derivative of the point and becomes that of the line's end and
 * length. */
icc_status iccp_gradient_down(const iccp_gradient_state *state, const double *from, iccp_path *path,
                              iccp_jetn *jet, iccp_gradient_line *line);

/* Likewise, to the maximum. */
icc_status iccp_gradient_up(const iccp_gradient_state *state, const double *from, iccp_path *path,
                            iccp_jetn *jet, iccp_gradient_line *line);

/* To the maximum from a local point of a facet, into the domain. */
icc_status iccp_gradient_up_from(const icc_chart *chart, uint32_t facet, const double *point,
                                 iccp_path *path, iccp_gradient_line *line);

/* The same line again, with derivatives by the point that it starts from: to the end of the step
 * numbered `piece`, and on to the end of the line, which has n_steps. `jet` holds the derivative of
 * the point. */
typedef struct iccp_gradient_replay {
    iccp_jetn before, after, end; /* the step, and at the end of the line */
} iccp_gradient_replay;
icc_status iccp_gradient_up_again(const icc_chart *chart, uint32_t facet, const double *point,
                                  const iccp_jetn *jet, size_t piece, size_t n_steps,
                                  iccp_gradient_replay *replay);

/* Sign of the derivative of f at a point along a direction, both in lattice coordinates; not
 * exact. */
int iccp_gradient_slope_sign(const iccp_gradient_state *state, const double *at,
                             const double *direction);

#endif
