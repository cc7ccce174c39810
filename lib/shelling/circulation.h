/* Positive fluxes along an order of simplices, as near as may be to a reference flux. They decide
 * how the volume is shared out among the leaves: that the leaves are a foliation follows from the
 * order alone. */
#ifndef ICCP_CIRCULATION_H
#define ICCP_CIRCULATION_H

#include "shelling/links.h"
#include "shelling/reference.h"

/* What is being fitted, whatever the order. */
typedef struct iccp_circulation {
    const iccp_simplices *mesh; /* borrowed, as the next two arrays */
    uint32_t centre;
    const double *inflow;    /* through each facet of the domain */
    const double *reference; /* flux through each side */
    iccp_links links;
    double *weight; /* of each facet of the links: area over the distance of the barycentres */
    double *least;  /* likewise: flux that it should have at least, a share of what flows nearby */
} iccp_circulation;

icc_status iccp_circulation_create(iccp_circulation *circulation, const iccp_simplices *mesh,
                                   uint32_t centre, const double *inflow, const double *reference,
                                   const iccp_env *env);
void iccp_circulation_free(iccp_circulation *circulation);

/* From the boundary inwards, each simplex sends on what it receives through the facets to simplices
 * of smaller rank, in proportion to the reference flux there, but through each at least a small
 * share. The flux is positive from greater to smaller rank and without divergence. `rank`, of each
 * simplex, is complete, see shelling/shelling_order.h; `flux` is of each side. O(n). */
icc_status iccp_circulation_greedy(const iccp_circulation *c, const uint32_t *rank, double *flux,
                                   const iccp_env *env);

/* Brings such a flux nearer to the reference: Gauss-Seidel sweeps over the links, each time with
 * the circulation round the link that lowers the energy most and leaves all fluxes positive. The
 * energy never rises. O(n) a sweep. */
icc_status iccp_circulation_relax(const iccp_circulation *c, const uint32_t *rank, size_t n_sweeps,
                                  double *flux, const iccp_env *env);

/* Sum over the facets of (flux - reference)^2 / weight. `flux`: of each side, here and below. */
double iccp_circulation_energy(const iccp_circulation *c, const double *flux);

/* The largest relative divergence of a simplex outside the star: the sum of its fluxes over the sum
 * of what leaves. */
double iccp_circulation_divergence(const iccp_circulation *c, const double *flux);

#endif
