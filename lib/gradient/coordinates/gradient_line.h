/* A gradient line from a point down to the boundary, or up to the maximum. gradient/trace/walk2.h
 * follows it in the plane, and gradient/trace/walkn.h in other dimensions. */
#ifndef ICCP_GRADIENT_LINE_H
#define ICCP_GRADIENT_LINE_H

#include "gradient/coordinates/gradient_state.h"
#include "gradient/trace/walkn.h"

typedef struct iccp_gradient_line {
    double s;       /* arc length in lattice units */
    bool merged;    /* other lines have joined it */
    double alone;   /* arc length until others joined it */
    uint32_t facet; /* downhill: the facet where it ends */
    double bary[ICC_MAX_DIM];
} iccp_gradient_line;

/* Follows the line from a point in lattice coordinates to the boundary. `path`, in lattice
 * coordinates, may be NULL. `jet` may be NULL, too; it holds the derivative of the point and
 * becomes that of the line's end and length. Returns ICC_ERR_TRACE for a line that does not reach
 * the boundary; `line` and `path` then hold the part up to where it ends. */
icc_status iccp_gradient_down(const iccp_gradient_state *state, const double *from, iccp_path *path,
                              iccp_jetn *jet, iccp_gradient_line *line);

/* Follows the line to the maximum, with the same arguments. */
icc_status iccp_gradient_up(const iccp_gradient_state *state, const double *from, iccp_path *path,
                            iccp_jetn *jet, iccp_gradient_line *line);

/* In the plane, starts uphill at a local point of a facet, into the domain. `jet` may be NULL. */
icc_status iccp_gradient_depart(const iccp_gradient_state *state, uint32_t facet,
                                const double point[2], iccp_walk2 *walk, iccp_jet2 *jet);

/* Follows the line to the maximum from a local point of a facet, into the domain. */
icc_status iccp_gradient_up_from(const iccp_gradient_state *state, uint32_t facet,
                                 const double *point, iccp_path *path, iccp_gradient_line *line);

/* Repeats a line with derivatives with respect to the point where it starts. Goes to the end of the
 * step numbered `piece`, and on to the end of the line, which has n_steps. `jet` holds the
 * derivative of the point. */
typedef struct iccp_gradient_replay {
    iccp_jetn before, after, end; /* before and after that step, and at the end of the line */
} iccp_gradient_replay;
icc_status iccp_gradient_up_again(const iccp_gradient_state *state, uint32_t facet,
                                  const double *point, const iccp_jetn *jet, size_t piece,
                                  size_t n_steps, iccp_gradient_replay *replay);

/* Returns the sign of the derivative of f at a point along a direction, both in lattice
 * coordinates. Not exact. */
int iccp_gradient_slope_sign(const iccp_gradient_state *state, const double *at,
                             const double *direction);

#endif
