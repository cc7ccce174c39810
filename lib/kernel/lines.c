/* Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), sections 5.3.1 and 5.3.2. Weights that
 * are linear along a line keep it straight under translations of the handles. Two lines stay
 * parallel when their weights change by the same vector per length. Both kinds of weights sum to 1
 * and reproduce their points when those of the ends do. */
#include "kernel/structure.h"

#include <math.h>

/* How far along from -> to the node lies, as a share of that. */
static double share_of(const iccp_nodes *nodes, size_t from, size_t to, size_t node)
{
    double along = 0, length2 = 0;
    for (size_t k = 0; k < nodes->dim; ++k) {
        const double *x = nodes->points + k;
        const double step = x[nodes->dim * to] - x[nodes->dim * from];
        along += step * (x[nodes->dim * node] - x[nodes->dim * from]);
        length2 += step * step;
    }
    return along / length2;
}

/* The length of one line over that of another, negative when they point in opposite directions. */
static double ratio_of(const iccp_nodes *nodes, const iccp_line_nodes *line,
                       const iccp_line_nodes *other)
{
    double along = 0, length2 = 0, other2 = 0;
    for (size_t k = 0; k < nodes->dim; ++k) {
        const double *x = nodes->points + k;
        const double step = x[nodes->dim * line->to] - x[nodes->dim * line->from];
        const double other_step = x[nodes->dim * other->to] - x[nodes->dim * other->from];
        along += step * other_step;
        length2 += step * step;
        other2 += other_step * other_step;
    }
    return copysign(sqrt(length2 / other2), along);
}

void iccp_straighten(const iccp_nodes *nodes, const iccp_line_nodes *line,
                     const iccp_line_nodes *parallel, double *weights)
{
    const size_t m = nodes->n_handles;
    const double *from = weights + m * line->from;
    double *to = weights + m * line->to;
    if (parallel != NULL) {
        const double ratio = ratio_of(nodes, line, parallel);
        for (size_t j = 0; j < m; ++j)
            to[j] =
                from[j] + ratio * (weights[m * parallel->to + j] - weights[m * parallel->from + j]);
    }
    for (size_t i = line->first; i < line->first + line->count; ++i) {
        const double share = share_of(nodes, line->from, line->to, i);
        for (size_t j = 0; j < m; ++j)
            weights[m * i + j] = (1 - share) * from[j] + share * to[j];
    }
}
