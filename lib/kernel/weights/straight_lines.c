/* Lines that stay straight: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 5.3. If
 * weights are linear along a line, the line stays straight when the handles are translated (5.3.1).
 * Two lines stay parallel if their weights change by the same vector per length (5.3.2). Both kinds
 * of weights sum to 1 and reproduce their points if those of the ends do.
 *
 * Nodes beside a line follow it. Section 5.3.3 asks for this without a method. Weights on a line
 * differ from those that would have been optimised there. This change keeps sums and reproduction,
 * so any multiple of it may be added to the weights of a nearby node. The code adds all of it on
 * the line, nothing at some distance, and never so much that a weight becomes negative. */
#include "kernel/weights/handle_weights.h"

#include "base/minmax.h"

#include <math.h>
#include <string.h>

/* Returns the position of the node between `from` and `to`, as a share. */
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

/* Returns the length of one line over that of another. It is negative if they point in opposite
 * directions. */
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

/* ---- nodes beside a line ---- */

/* In sigma: the distance up to which a line changes its surroundings. */
static const double REACH = 5;

typedef struct change {
    const iccp_node_set *nodes;
    const iccp_line_nodes *line;
    size_t n;       /* count + 2: the nodes of the line from end to end */
    double *share;  /* their positions along the line */
    double *change; /* n * n_handles */
} change;

static size_t node_of(const iccp_line_nodes *line, size_t k)
{
    return k == 0 ? line->from : k <= line->count ? line->first + k - 1 : line->to;
}

/* Finds the nearest point of the segment between the ends. Returns the squared distance, and the
 * position as a share. */
static double nearest(const iccp_node_set *set, const iccp_line_nodes *line, const double *x,
                      double *share)
{
    const double *a = set->points + set->dim * line->from, *b = set->points + set->dim * line->to;
    double along = 0, length2 = 0, distance2 = 0;
    for (size_t d = 0; d < set->dim; ++d) {
        along += (x[d] - a[d]) * (b[d] - a[d]);
        length2 += (b[d] - a[d]) * (b[d] - a[d]);
    }
    *share = iccp_min(1, iccp_max(0, along / length2));
    for (size_t d = 0; d < set->dim; ++d) {
        const double away = x[d] - a[d] - *share * (b[d] - a[d]);
        distance2 += away * away;
    }
    return distance2;
}

/* Computes the change at each node of the line: its weights minus those that it would have without
 * the line. */
static void find_change(const icc_weights *weights, const change *c, double *work)
{
    const iccp_node_set *set = c->nodes;
    const size_t m = set->n_handles;
    for (size_t k = 0; k < c->n; ++k) {
        const size_t i = node_of(c->line, k);
        const double *values = weights->values + m * i, *place = set->points + set->dim * i;
        double *without = c->change + m * k;
        (void)nearest(set, c->line, place, &c->share[k]);
        memcpy(without, i < m ? values : set->initial + m * i, m * sizeof *without);
        if (i >= m)
            (void)iccp_optimise(set->handles, weights->info.method, place, without, work);
        for (size_t j = 0; j < m; ++j)
            without[j] = values[j] - without[j];
    }
}

/* Adds the change at a share of the line, times `strength` or less. */
static void add_change(const change *c, double share, double strength, double *weights, double *row)
{
    const size_t m = c->nodes->n_handles;
    size_t k = 1;
    while (k + 1 < c->n && c->share[k] < share)
        ++k;
    const double *before = c->change + m * (k - 1), *after = before + m;
    const double part = (share - c->share[k - 1]) / (c->share[k] - c->share[k - 1]);
    for (size_t j = 0; j < m; ++j) {
        row[j] = before[j] + part * (after[j] - before[j]);
        if (row[j] < 0)
            strength = iccp_min(strength, iccp_max(0, weights[j]) / -row[j]);
    }
    for (size_t j = 0; j < m; ++j)
        weights[j] += strength * row[j];
}

/* Changes every free sample within reach of the line by a factor that falls smoothly from 1 on the
 * line to 0 at the reach. Nodes on lines come before samples and keep their weights. */
static void bend(icc_weights *weights, const change *c, double *row)
{
    const iccp_node_set *set = c->nodes;
    const double reach = REACH * weights->info.sigma * iccp_node_set_scale(set);
    for (size_t i = set->n_handles + set->n_line_nodes; i < set->n; ++i) {
        double share;
        if (set->held[i])
            continue;
        const double t =
            nearest(set, c->line, set->points + set->dim * i, &share) / (reach * reach);
        if (t < 1)
            add_change(c, share, (1 - t) * (1 - t), weights->values + set->n_handles * i, row);
    }
}

icc_status iccp_weights_follow_line(icc_weights *weights, size_t k, const iccp_env *env)
{
    const iccp_node_set *set = weights->nodes;
    const iccp_memory *memory = &env->memory;
    change c = {.nodes = set, .line = &set->lines[k], .n = set->lines[k].count + 2};
    c.share = iccp_alloc(memory, c.n, sizeof *c.share);
    c.change = iccp_alloc(memory, c.n, set->n_handles * sizeof *c.change);
    double *work =
        iccp_alloc(memory, iccp_optimise_work(set->handles) + set->n_handles, sizeof *work);
    const bool complete = c.share != NULL && c.change != NULL && work != NULL;
    if (complete) {
        find_change(weights, &c, work);
        bend(weights, &c, work);
    }
    iccp_free(memory, c.share);
    iccp_free(memory, c.change);
    iccp_free(memory, work);
    return complete ? ICC_OK : ICC_ERR_MEMORY;
}
