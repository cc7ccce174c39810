/* Parts that keep their form: lines (5.6), parallel lines (5.11), rigid parts (5.12 to 5.35). */
#ifndef ICCP_RIGID_PARTS_H
#define ICCP_RIGID_PARTS_H

#include "kernel/weights/interpolant.h"
#include "kernel/weights/weights.h"

/* A line: its ends, and the nodes between them in order, `count` from `first` on. The ends may be
 * handles or ends of earlier lines. Nodes too near to a handle or to an earlier line are left
 * out. */
typedef struct iccp_line_nodes {
    size_t from, to, first, count;
} iccp_line_nodes;

/* Makes the weights of the nodes between the ends linear (5.6). If `parallel` is not NULL, first
 * sets the weights of the end `to`: those of `from` plus the difference of the ends of that line,
 * per length and by direction (5.11). */
void iccp_straighten(const iccp_nodes *nodes, const iccp_line_nodes *line,
                     const iccp_line_nodes *parallel, double *weights);

/* See icc_weights_stiffen(). held[i] is true if node i keeps its weights. `part` has n_part nodes,
 * and `rigidity` one number for each; NULL means 1. With `positive`, no weight becomes negative
 * where none was. Changes the weights of the nodes and their coefficients. `energy` is in local
 * coordinates. Returns ICC_ERR_SOLVER if the program is not solved after 10,000 steps. */
icc_status iccp_stiffen(const iccp_nodes *nodes, const iccp_handles *handles,
                        const iccp_collocation *collocation, size_t n_part, const uint32_t *part,
                        const double *rigidity, const bool *held, bool positive, double *weights,
                        double *coefficients, double energy[2], double *residual,
                        const iccp_env *env);

#endif
