/* Positive fluxes along an order of simplices, as near as may be to a reference flux. They decide how the
 * volume is shared out among the leaves: that the leaves are a foliation follows from the order alone. */
#ifndef ICCP_CIRCULATION_H
#define ICCP_CIRCULATION_H

#include "shelling/reference.h"

/* What is being fitted. */
typedef struct iccp_circulation {
    const iccp_simplices *mesh;
    uint32_t centre;
    const uint32_t *rank;     /* see shelling/order.h; complete */
    const double *inflow;     /* through each facet of the domain */
    const double *reference;  /* flux through each side */
    const double *weight;     /* of each side, the same for both sides of a facet: conductances */
} iccp_circulation;

/* The weights: area of the facet over the distance of its simplices' barycentres. */
void iccp_conductances(const iccp_simplices *mesh, double *weight);

/* From the boundary inwards, each simplex sends on what it receives through the facets to simplices of
 * smaller rank, in proportion to the reference flux there, but through each at least a small share. The flux
 * is positive from greater to smaller rank and without divergence. O(n). */
icc_status iccp_circulation_greedy(const iccp_circulation *c, double *flux, const iccp_env *env);

/* Brings the flux nearer to the reference: Gauss-Seidel sweeps over the interior (dim - 2)-faces, each with
 * the circulation round the face that lowers the energy most and leaves all fluxes positive. */
icc_status iccp_circulation_relax(const iccp_circulation *c, size_t n_sweeps, double *flux,
                                  const iccp_env *env);

/* Sum over facets of (flux - reference)^2 / weight. */
double iccp_circulation_energy(const iccp_circulation *c, const double *flux);

/* The largest relative divergence of a simplex outside the star. */
double iccp_circulation_divergence(const iccp_circulation *c, const double *flux);

#endif
