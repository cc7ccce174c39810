/* Initial weights: the inverse of the squared distance (Sakaridis, Kernel Coordinates, ETH Zurich
 * 2016, equation 4.10), or diffusion (section 4.6).
 *
 * In the thesis, a diffusion step multiplies the weights by K over a constant. Where the density of
 * samples differs from the mean, weights then grow or fade with every step. Here the rows of the
 * matrix sum to 1, so a step takes means. Weights stay between the held ones, and still sum to 1
 * where all of them do. The thesis' kernel also reaches across gaps; see iccp_spot_sees(). */
#include "base/minmax.h"
#include "base/threads.h"
#include "kernel/weights/weights.h"

#include <math.h>

/* ---- inverse distance ---- */

/* p, as a share of the longest side of the handles' box. In the thesis' example (section 4.7), p =
 * 1 and the side is 10. */
static const double REACH = 0.1;

/* Returns the longest side of the handles' box. */
static double longest_side(const iccp_nodes *nodes)
{
    double longest = 0;
    for (size_t k = 0; k < nodes->dim; ++k) {
        double low = nodes->points[k], high = low;
        for (size_t j = 1; j < nodes->n_handles; ++j) {
            low = iccp_min(low, nodes->points[nodes->dim * j + k]);
            high = iccp_max(high, nodes->points[nodes->dim * j + k]);
        }
        longest = iccp_max(longest, high - low);
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

/* ---- diffusion ---- */

typedef struct diffusion {
    const iccp_nodes *nodes;
    const iccp_symmetric *matrix;
    bool edges;
    double *share;    /* share of each entry of the matrix in the mean of its row; 0: not seen */
    double *own;      /* the node's own share */
    iccp_spot *spots; /* NULL: all nodes see each other */
    const double *from;
    double *to;
} diffusion;

static bool is_held(const diffusion *d, size_t i)
{
    return i < d->nodes->n_handles || (d->edges && d->nodes->edge[i] != UINT32_MAX);
}

static icc_status find_spots(void *argument, size_t begin, size_t end)
{
    const diffusion *d = argument;
    for (size_t i = begin; i < end; ++i)
        d->spots[i] = iccp_shape_spot(d->nodes->shape, d->nodes->given + d->nodes->dim * i);
    return ICC_OK;
}

/* Finds the shares of the neighbours in the mean of their node. Seeing is as in iccp_spot_sees(),
 * which is not symmetric. So rows of `share` have the pattern of the matrix, but are not
 * symmetric. */
static icc_status find_shares(void *argument, size_t begin, size_t end)
{
    const diffusion *d = argument;
    const iccp_symmetric *k = d->matrix;
    for (size_t i = begin; i < end; ++i) {
        double sum = k->diagonal[i];
        if (is_held(d, i))
            continue;
        for (size_t e = k->first[i]; e < k->first[i + 1]; ++e) {
            const bool seen = d->spots == NULL || iccp_spot_sees(d->nodes->shape, &d->spots[i],
                                                                 &d->spots[k->column[e]]);
            d->share[e] = seen ? k->value[e] : 0;
            sum += d->share[e];
        }
        d->own[i] = k->diagonal[i] / sum;
        for (size_t e = k->first[i]; e < k->first[i + 1]; ++e)
            d->share[e] /= sum;
    }
    return ICC_OK;
}

/* Makes one step for nodes [begin, end). A held node keeps its row. Any other node takes the mean
 * of its neighbours' rows of m weights by their shares. */
static icc_status take_means(void *argument, size_t begin, size_t end)
{
    const diffusion *d = argument;
    const iccp_symmetric *k = d->matrix;
    const size_t m = d->nodes->n_handles;
    for (size_t i = begin; i < end; ++i) {
        const bool held = is_held(d, i);
        double *to = d->to + m * i;
        for (size_t j = 0; j < m; ++j)
            to[j] = (held ? 1 : d->own[i]) * d->from[m * i + j];
        for (size_t e = k->first[i]; !held && e < k->first[i + 1]; ++e) {
            const double share = d->share[e], *from = d->from + m * k->column[e];
            for (size_t j = 0; j < m; ++j)
                to[j] += share * from[j];
        }
    }
    return ICC_OK;
}

/* Makes Jacobi steps between two arrays of n * n_handles weights, so that the result does not
 * depend on the order of the tasks. Shares are found once, because visibility does not change. */
static icc_status take_steps(diffusion *d, int32_t steps, double *weights, double *other,
                             const iccp_env *env)
{
    const size_t n = d->nodes->n, m = d->nodes->n_handles;
    icc_status status = ICC_OK;
    if (d->spots != NULL)
        status = iccp_for_chunks(env, "weights", n, ICCP_NODES_A_TASK, find_spots, d);
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "weights", n, ICCP_NODES_A_TASK, find_shares, d);
    d->from = weights;
    d->to = other;
    for (int32_t s = 0; status == ICC_OK && s < steps; ++s) {
        status = iccp_for_chunks(env, "weights", n, ICCP_NODES_A_TASK, take_means, d);
        const double *from = d->from;
        d->from = d->to;
        d->to = from == weights ? weights : other;
    }
    if (status == ICC_OK && d->from != weights)
        for (size_t k = 0; k < n * m; ++k)
            weights[k] = other[k];
    return status;
}

icc_status iccp_diffuse(const iccp_nodes *nodes, const iccp_symmetric *matrix, int32_t steps,
                        bool edges, bool visible, double *weights, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = nodes->n;
    diffusion d = {.nodes = nodes, .matrix = matrix, .edges = edges};
    double *other = iccp_alloc(memory, n * nodes->n_handles, sizeof *other);
    d.share = iccp_alloc(memory, matrix->first[n], sizeof *d.share);
    d.own = iccp_alloc(memory, n, sizeof *d.own);
    if (visible)
        d.spots = iccp_alloc(memory, n, sizeof *d.spots);
    icc_status status = ICC_ERR_MEMORY;
    if (other != NULL && d.share != NULL && d.own != NULL && (!visible || d.spots != NULL))
        status = take_steps(&d, steps, weights, other, env);
    iccp_free(memory, other);
    iccp_free(memory, d.share);
    iccp_free(memory, d.own);
    iccp_free(memory, d.spots);
    return status;
}
