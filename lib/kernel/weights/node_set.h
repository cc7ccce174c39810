/* Where weights are kept: the nodes, and what follows from their places alone. */
#ifndef ICCP_NODE_SET_H
#define ICCP_NODE_SET_H

#include "kernel/sampling/sampling.h"
#include "kernel/weights/interpolant.h"
#include "kernel/weights/structure.h"
#include "kernel/weights/weights.h"

#define ICCP_NO_EDGE UINT32_MAX

/* What weights at the same nodes share. Nodes 0 to n_handles - 1 are the handles, then come
 * n_line_nodes on lines, then samples. Points in local coordinates are those of the shape's
 * frame. */
typedef struct iccp_node_set {
    iccp_memory memory;
    atomic_size_t references;
    icc_sampling *sampling;
    size_t dim, n, n_handles, n_edges, n_lines, n_line_nodes;
    double *points, *given; /* n * dim: local, and in the caller's coordinates */
    uint32_t *sample;       /* of each node: its index in the sampling, UINT32_MAX for handles and
                               nodes on lines */
    uint32_t *edge;         /* of each node: see iccp_nodes */
    double *share;          /* the same */
    bool *held;      /* of each node: handles, nodes on lines, nodes on edges if those are held */
    uint32_t *edges; /* n_edges * 2 handles */
    iccp_line_nodes *lines; /* n_lines, in the caller's order */
    int32_t *parallel;      /* of each line, see icc_line */
    iccp_handles *handles;
    iccp_collocation *collocation;
    double *initial; /* n * n_handles, from iccp_weights_create() */
} iccp_node_set;

/* Members of `options` that may be 0 have got their defaults. */
icc_status iccp_node_set_create(iccp_node_set **out, const icc_sampling *sampling, size_t n_handles,
                                const double *handles, const icc_weights_options *options,
                                const iccp_env *env, icc_error *err);
iccp_node_set *iccp_node_set_retain(const iccp_node_set *set);
void iccp_node_set_release(iccp_node_set *set);

/* The set as the functions of weights.h take it; borrowed. */
iccp_nodes iccp_node_set_view(const iccp_node_set *set);

/* Local lengths are the caller's times this. */
double iccp_node_set_scale(const iccp_node_set *set);

/* The line that line k stays parallel to, or NULL. */
const iccp_line_nodes *iccp_node_set_parallel(const iccp_node_set *set, size_t k);

#endif
