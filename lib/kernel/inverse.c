/* Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), equation 4.10. */
#include "kernel/weights.h"

#include <math.h>

/* p, of the longest side of the handles' box: in the thesis' example (section 4.7) p = 1 and the
 * side is 10. */
static const double REACH = 0.1;

static double longest_side(const iccp_nodes *nodes)
{
    double longest = 0;
    for (size_t k = 0; k < nodes->dim; ++k) {
        double low = nodes->points[k], high = low;
        for (size_t j = 1; j < nodes->n_handles; ++j) {
            low = fmin(low, nodes->points[nodes->dim * j + k]);
            high = fmax(high, nodes->points[nodes->dim * j + k]);
        }
        longest = fmax(longest, high - low);
    }
    return longest;
}

void iccp_initial_inverse(const iccp_nodes *nodes, double *weights)
{
    const size_t dim = nodes->dim, m = nodes->n_handles;
    const double p = REACH * longest_side(nodes);
    for (size_t i = 0; i < nodes->n; ++i)
        for (size_t j = 0; j < m; ++j) {
            double distance2 = 0;
            for (size_t k = 0; k < dim; ++k) {
                const double d = nodes->points[dim * i + k] - nodes->points[dim * j + k];
                distance2 += d * d;
            }
            weights[m * i + j] = i >= m ? 1 / (1 + distance2 / (p * p)) : i == j ? 1 : 0;
        }
}
