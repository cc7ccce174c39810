/* Parts that keep their form: lines (5.6), parallel lines (5.11), rigid parts (5.12 to 5.35). */
#ifndef ICCP_STRUCTURE_H
#define ICCP_STRUCTURE_H

#include "kernel/interpolant.h"
#include "kernel/weights.h"

/* The weights of the `count` nodes from `first` on, which lie on a line one after the other, become linear between
 * those of its two ends. With `parallel` not NULL, the difference of the ends is that of the line given there,
 * per length and by direction, instead: first, count of that line. */
typedef struct iccp_line_nodes {
    size_t first, count;
} iccp_line_nodes;
void iccp_straighten(const iccp_nodes *nodes, const iccp_line_nodes *line,
                     const iccp_line_nodes *parallel, double *weights);

/* See icc_kernel_stiffen(). `held[i]` for nodes that keep their weights. */
icc_status iccp_stiffen(const iccp_nodes *nodes, const iccp_collocation *collocation, size_t n_part,
                        const uint32_t *part, const double *rigidity, const bool *held, double *weights,
                        double energy[2], const iccp_env *env);

#endif
