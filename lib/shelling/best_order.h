/* The best of several orders of a mesh. Source: see best_order.c. */
#ifndef ICCP_BEST_ORDER_H
#define ICCP_BEST_ORDER_H

#include "shelling/circulation.h"
#include "shelling/shelling_order.h"

typedef struct iccp_best_order_info {
    int32_t peeled;    /* 1 if the order that won was peeled, 0 if it was grown */
    double beta;       /* its weight of reversed flux */
    double energy;     /* its flux, see iccp_circulation_energy() */
    double divergence; /* see iccp_circulation_divergence() */
    size_t n_reversed; /* facets that the reference flux crosses the other way */
    size_t n_orders;   /* number of orders that were tried */
    size_t n_finished; /* number of those that were complete */
} iccp_best_order_info;

/* Grows and peels with one weight after the other until an order is complete. Reverses facets, and
 * sends the flux along every complete order. Then fits the flux of the order with the least energy.
 *
 * `inflow` is by facet of the domain, `reference` and `flux` by side, `potential` and `rank` by
 * simplex. If no order is complete, two are repeated with a bias for the simplices that were
 * left. Fails with ICC_ERR_TOPOLOGY if that does not help, as with some meshes of Bing's house
 * with two rooms. The result is the same for every number of threads. O(n log n). */
icc_status iccp_best_order(const iccp_simplices *mesh, uint32_t centre, const double *inflow,
                           const double *reference, const double *potential, uint32_t *rank,
                           double *flux, iccp_best_order_info *info, const iccp_env *env,
                           icc_error *err);

#endif
