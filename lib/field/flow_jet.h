/* How curves of a flow change with where they start: derivatives by several parameters at once. */
#ifndef ICCP_FLOW_JET_H
#define ICCP_FLOW_JET_H

#include "field/flow.h"

typedef struct iccp_flow_jet {
    int32_t n;                              /* parameters */
    double place[ICC_MAX_DIM][ICC_MAX_DIM]; /* derivative of the place by each: lattice units */
    double length[ICC_MAX_DIM];             /* and of the length of the way so far */
} iccp_flow_jet;

/* From the start of the walk's piece to parameter s of it, which stays. */
void iccp_flow_jet_within(const iccp_flow_walk *walk, double s, iccp_flow_jet *jet);

/* At parameter s, moving along the curve so that the place stays on a plane, or by given lengths.
 * False when the curve runs along the plane. */
bool iccp_flow_jet_onto(const iccp_flow_walk *walk, double s, const double *normal,
                        iccp_flow_jet *jet);
void iccp_flow_jet_advance(const iccp_flow_walk *walk, double s, const double *lengths,
                           iccp_flow_jet *jet);

/* From the start of the walk's piece to its end: to the start of the next, or to the root. */
bool iccp_flow_jet_pass(const iccp_flow_walk *walk, iccp_flow_jet *jet);

#endif
