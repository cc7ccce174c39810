/* The kernel object: weights at nodes, and their interpolant. */
#ifndef ICCP_KERNEL_H
#define ICCP_KERNEL_H

#include "kernel/interpolant.h"
#include "kernel/sampling.h"
#include "kernel/structure.h"
#include "kernel/weights.h"

/* What kernels on the same nodes share. */
typedef struct iccp_layout {
    iccp_memory memory;
    atomic_size_t references;
    icc_sampling *sampling;
    size_t dim, n, n_handles, n_edges, n_lines;
    iccp_frame frame;          /* between the caller's coordinates and local ones */
    double *points, *given;    /* local and the caller's */
    uint32_t *edge;            /* see iccp_nodes */
    double *share;
    uint32_t *edges;           /* n_edges * 2 handles */
    iccp_line_nodes *lines;
    int32_t *parallel;         /* of each line, see icc_line */
    bool *held;                /* of each node: its weights are not optimised: handles, nodes on lines, nodes
                                  on edges where these are held */
    iccp_handles *handles;
    iccp_collocation *collocation;
    double *initial;           /* n * n_handles */
} iccp_layout;

struct icc_kernel {
    iccp_memory memory;
    atomic_size_t references;
    iccp_layout *layout;
    double *weights;      /* n * n_handles */
    icc_status *status;   /* of each node */
    double *coefficients; /* of the interpolant */
    icc_kernel_info info; /* but for `size` */
};

icc_kernel *iccp_kernel_retain(const icc_kernel *kernel);
void iccp_kernel_release(icc_kernel *kernel);

#endif
