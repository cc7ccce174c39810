/* Derivatives of a flow's curves by several parameters of their start at once. Source: the
 * variational equation; see flow_jet.c. */
#ifndef ICCP_FLOW_JET_H
#define ICCP_FLOW_JET_H

#include "field/flow.h"

typedef struct iccp_flow_jet {
    int32_t n;                              /* parameters */
    double place[ICC_MAX_DIM][ICC_MAX_DIM]; /* derivative of the place by each parameter: lattice
                                               units */
    double length[ICC_MAX_DIM];             /* derivative of the length up to the place by each
                                               parameter */
} iccp_flow_jet;

/* Carries the jet from the start of the walk's piece to a fixed parameter s. */
void iccp_flow_jet_within(const iccp_flow_walk *walk, double s, iccp_flow_jet *jet);

/* Like iccp_flow_jet_within(), but the end of the piece then moves along the curve. It moves so
 * that it stays on a plane (onto), or by given lengths (advance). iccp_flow_jet_onto() returns
 * false if the curve runs along the plane. */
bool iccp_flow_jet_onto(const iccp_flow_walk *walk, double s, const double *normal,
                        iccp_flow_jet *jet);
void iccp_flow_jet_advance(const iccp_flow_walk *walk, double s, const double *lengths,
                           iccp_flow_jet *jet);

/* Carries the jet from the start of the walk's piece to its end, which is the start of the next
 * piece or the root. */
bool iccp_flow_jet_pass(const iccp_flow_walk *walk, iccp_flow_jet *jet);

#endif
