/* The nodes, at which weights are stored, and everything that follows from their places alone. */
#ifndef ICCP_NODE_SET_H
#define ICCP_NODE_SET_H

#include "kernel/sampling/sampling.h"
#include "kernel/weights/interpolant.h"
#include "kernel/weights/rigid_parts.h"
#include "kernel/weights/weights.h"

#define ICCP_NO_EDGE UINT32_MAX

/* Data shared by all weights at the same nodes. Nodes 0 to n_handles - 1 are the handles, then come
 * n_line_nodes on lines, then samples. Local coordinates are those of the shape's frame. */
typedef struct iccp_node_set {
    iccp_memory memory;
    atomic_size_t references;
    icc_sampling *sampling;
    size_t dim, n, n_handles, n_edges, n_lines, n_line_nodes;
    double *points, *given; /* n * dim: local, and in the caller's coordinates */
    /* By node: its index in the sampling; UINT32_MAX for handles and nodes on lines */
    uint32_t *sample;
    uint32_t *edge; /* by node: see iccp_nodes */
    double *share;  /* by node: see iccp_nodes */
    /* By node: true for handles, nodes on lines, and nodes on edges if edges are held */
    bool *held;
    uint32_t *edges;        /* n_edges * 2 handles */
    iccp_line_nodes *lines; /* n_lines, in the caller's order */
    int32_t *parallel;      /* by line, see icc_line */
    iccp_handles *handles;
    iccp_collocation *collocation;
    double *initial; /* n * n_handles, from iccp_weights_create() */
} iccp_node_set;

/* Makes the set. Options that may be 0 already have their defaults. */
icc_status iccp_node_set_create(iccp_node_set **out, const icc_sampling *sampling, size_t n_handles,
                                const double *handles, const icc_weights_options *options,
                                const iccp_env *env, icc_error *err);
iccp_node_set *iccp_node_set_retain(const iccp_node_set *set);
void iccp_node_set_release(iccp_node_set *set);

/* Returns the set as the functions of weights.h take it; borrowed. */
iccp_nodes iccp_node_set_view(const iccp_node_set *set);

/* Returns the factor from the caller's lengths to local ones. */
double iccp_node_set_scale(const iccp_node_set *set);

/* Returns the line to which line k stays parallel, or NULL. */
const iccp_line_nodes *iccp_node_set_parallel(const iccp_node_set *set, size_t k);

#endif
