/* Parts that keep their form: lines (5.6), parallel lines (5.11), rigid parts (5.12 to 5.35). */
#ifndef ICCP_STRUCTURE_H
#define ICCP_STRUCTURE_H

#include "kernel/weights/interpolant.h"
#include "kernel/weights/weights.h"

/* A line: its ends, which may be handles or ends of earlier lines, and the nodes between them in
 * order, `count` from `first` on (not all are there: those too near to a handle or to an earlier
 * line are left out). */
typedef struct iccp_line_nodes {
    size_t from, to, first, count;
} iccp_line_nodes;

/* The weights of the nodes between the ends become linear between those of the ends (5.6). With
 * `parallel` not NULL, those of the end `to` first become those of `from` and the difference of the
 * ends of that line, per length and by direction (5.11). */
void iccp_straighten(const iccp_nodes *nodes, const iccp_line_nodes *line,
                     const iccp_line_nodes *parallel, double *weights);

/* See icc_weights_stiffen(). held[i] for nodes i that keep their weights; `part`: n_part nodes,
 * with the rigidity of each; `positive`: no weight becomes negative where none was; `rigidity`
 * NULL: all 1. Changes the weights of the nodes and the coefficients that belong to them. `energy`
 * is in local coordinates. ICC_ERR_SOLVER when the program is not solved after 10,000 steps. */
icc_status iccp_stiffen(const iccp_nodes *nodes, const iccp_handles *handles,
                        const iccp_collocation *collocation, size_t n_part, const uint32_t *part,
                        const double *rigidity, const bool *held, bool positive, double *weights,
                        double *coefficients, double energy[2], double *residual,
                        const iccp_env *env);

#endif
