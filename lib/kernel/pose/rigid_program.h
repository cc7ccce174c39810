/* The program of a rigid part: see rigid.c. */
#ifndef ICCP_RIGID_PROGRAM_H
#define ICCP_RIGID_PROGRAM_H

#include "kernel/pose/rigid_hessian.h"

/* Weights of the free nodes, m numbers each, and the energy's derivatives by them. */
typedef struct iccp_rigid_state {
    double *weights, *gradient;
} iccp_rigid_state;

typedef struct iccp_rigid {
    iccp_memory memory;
    const iccp_nodes *nodes; /* borrowed, as the next two */
    const iccp_handles *handles;
    const iccp_collocation *collocation;
    size_t n_part, n_places, n_free;
    uint32_t *places; /* the part, then the free nodes that it reaches */
    uint32_t *free;   /* those of the places that are not held */
    bool *signs;      /* of each free node: no weight may become negative */
    double *count;    /* of each place: how much its derivatives count, over `mean` */
    double mean;      /* rigidity of the part's nodes */
    iccp_hessian hessian;
    iccp_rigid_state x, next, best;
    double *before;  /* free weights, as they were */
    double *change;  /* the same: what a step adds */
    double *bent;    /* the Hessian's product with it */
    double *slopes;  /* dim rows of derivatives for each place */
    double *scratch; /* for iccp_optimise(), and for dim rows of derivatives */
} iccp_rigid;

/* The states have room; nothing is in them yet. held[i] for nodes i that keep their weights;
 * `positive`: signs are kept where no weight is negative; `rigidity` NULL: all 1. On failure
 * nothing is left allocated. */
icc_status iccp_rigid_create(iccp_rigid *rigid, const iccp_nodes *nodes,
                             const iccp_handles *handles, const iccp_collocation *collocation,
                             size_t n_part, const uint32_t *part, const double *rigidity,
                             const bool *held, bool positive, const double *weights,
                             const iccp_env *env);
void iccp_rigid_free(iccp_rigid *rigid);

/* Numbers in all rows of weights, and of derivatives. */
static inline size_t iccp_rigid_weights(const iccp_rigid *r)
{
    return r->n_free * r->nodes->n_handles;
}

static inline size_t iccp_rigid_derivatives(const iccp_rigid *r)
{
    return r->n_places * r->nodes->dim * r->nodes->n_handles;
}

/* The derivatives of the weights that coefficients give, at the part; 0 around it. */
void iccp_rigid_slopes(const iccp_rigid *rigid, const double *coefficients, double *slopes);

#endif
