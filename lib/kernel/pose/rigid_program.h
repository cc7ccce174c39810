/* The program of a rigid part; see rigid.c. */
#ifndef ICCP_RIGID_PROGRAM_H
#define ICCP_RIGID_PROGRAM_H

#include "kernel/pose/rigid_hessian.h"

/* Weights of the free nodes, m numbers each, and the derivatives of the energy with respect to
 * them. */
typedef struct iccp_rigid_state {
    double *weights, *gradient;
} iccp_rigid_state;

typedef struct iccp_rigid {
    iccp_memory memory;
    const iccp_nodes *nodes; /* borrowed, like the next two */
    const iccp_handles *handles;
    const iccp_collocation *collocation;
    size_t n_part, n_places, n_free;
    uint32_t *places; /* nodes of the part, then the free nodes that it reaches */
    uint32_t *free;   /* those of the places that are not held */
    bool *signs;      /* by free node: no weight may become negative */
    double *count;    /* by place: weight of its derivatives, divided by `mean` */
    double mean;      /* mean rigidity of the part's nodes */
    iccp_hessian hessian;
    iccp_rigid_state x, next, best;
    double *before;  /* free weights before the change */
    double *change;  /* what a step adds to them */
    double *bent;    /* the Hessian's product with `change` */
    double *slopes;  /* dim rows of derivatives per place */
    double *scratch; /* workspace for iccp_optimise(), and for dim rows of derivatives */
} iccp_rigid;

/* Allocates the states, which are empty. held[i] is true if node i keeps its weights. With
 * `positive`, signs are kept where no weight is negative. If `rigidity` is NULL, it is 1
 * everywhere. On failure nothing stays allocated. */
icc_status iccp_rigid_create(iccp_rigid *rigid, const iccp_nodes *nodes,
                             const iccp_handles *handles, const iccp_collocation *collocation,
                             size_t n_part, const uint32_t *part, const double *rigidity,
                             const bool *held, bool positive, const double *weights,
                             const iccp_env *env);
void iccp_rigid_free(iccp_rigid *rigid);

/* The number of entries in all rows of weights, and of derivatives. */
static inline size_t iccp_rigid_weights(const iccp_rigid *r)
{
    return r->n_free * r->nodes->n_handles;
}

static inline size_t iccp_rigid_derivatives(const iccp_rigid *r)
{
    return r->n_places * r->nodes->dim * r->nodes->n_handles;
}

/* Computes the derivatives of the weights that coefficients give, at the part. Around it they are
 * 0. */
void iccp_rigid_slopes(const iccp_rigid *rigid, const double *coefficients, double *slopes);

#endif
