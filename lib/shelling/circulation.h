/* Positive fluxes along an order of simplices, as near as possible to a reference flux. They
 * decide how the volume is divided among the leaves. That the leaves form a foliation follows
 * from the order alone. Source: see circulation.c. */
#ifndef ICCP_CIRCULATION_H
#define ICCP_CIRCULATION_H

#include "shelling/links.h"
#include "shelling/reference.h"

/* The fitting problem, the same for every order. */
typedef struct iccp_circulation {
    const iccp_simplices *mesh; /* borrowed, like the next two arrays */
    uint32_t centre;
    const double *inflow;    /* through each facet of the domain */
    const double *reference; /* flux through each side */
    iccp_links links;
    double *weight; /* by facet of the links: area over the distance of the barycentres */
    double *least;  /* by facet of the links: the least flux, a share of the flux nearby */
} iccp_circulation;

icc_status iccp_circulation_create(iccp_circulation *circulation, const iccp_simplices *mesh,
                                   uint32_t centre, const double *inflow, const double *reference,
                                   const iccp_env *env);
void iccp_circulation_free(iccp_circulation *circulation);

/* Computes a flux along an order. From the boundary inwards, each simplex sends on what it
 * receives through its facets to simplices of smaller rank. It does so in proportion to the
 * reference flux, but sends at least a small share through each. The flux is positive from
 * greater to smaller rank and has no divergence. `rank`, by simplex, must be complete; see
 * shelling/shelling_order.h. `flux` is by side. O(n). */
icc_status iccp_circulation_greedy(const iccp_circulation *c, const uint32_t *rank, double *flux,
                                   const iccp_env *env);

/* Brings such a flux nearer to the reference by Gauss-Seidel sweeps over the links. Each step
 * adds the circulation round one link that lowers the energy most and leaves all fluxes
 * positive. The energy never rises. O(n) a sweep. */
icc_status iccp_circulation_relax(const iccp_circulation *c, const uint32_t *rank, size_t n_sweeps,
                                  double *flux, const iccp_env *env);

/* Sum over the facets of (flux - reference)^2 / weight. `flux` is by side, here and below. */
double iccp_circulation_energy(const iccp_circulation *c, const double *flux);

/* The largest relative divergence of a simplex outside the star: the sum of its fluxes over the
 * sum of those that leave. */
double iccp_circulation_divergence(const iccp_circulation *c, const double *flux);

#endif
