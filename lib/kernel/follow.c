/* Nodes beside a line follow it: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 5.3.3,
 * which asks for it without saying how. Weights on a line are not those that would have been
 * optimised there. This change keeps sums and reproduction, so any multiple of it may be added to
 * the weights of a node near by: all of it on the line, nothing at some distance, and no more than
 * keeps weights from becoming negative. */
#include "kernel/handle_weights.h"

#include <math.h>
#include <string.h>

/* In sigma: how far a line changes its surroundings. */
static const double REACH = 5;

typedef struct change {
    const iccp_layout *layout;
    const iccp_line_nodes *line;
    size_t n;       /* count + 2: the nodes of the line from end to end */
    double *share;  /* how far along it they are */
    double *change; /* n * n_handles */
} change;

static size_t node_of(const iccp_line_nodes *line, size_t k)
{
    return k == 0 ? line->from : k <= line->count ? line->first + k - 1 : line->to;
}

/* The nearest point of the segment between the ends: its share, and the squared distance. */
static double nearest(const iccp_layout *l, const iccp_line_nodes *line, const double *x,
                      double *share)
{
    const double *a = l->points + l->dim * line->from, *b = l->points + l->dim * line->to;
    double along = 0, length2 = 0, distance2 = 0;
    for (size_t d = 0; d < l->dim; ++d) {
        along += (x[d] - a[d]) * (b[d] - a[d]);
        length2 += (b[d] - a[d]) * (b[d] - a[d]);
    }
    *share = fmin(1, fmax(0, along / length2));
    for (size_t d = 0; d < l->dim; ++d) {
        const double away = x[d] - a[d] - *share * (b[d] - a[d]);
        distance2 += away * away;
    }
    return distance2;
}

/* What the line changes, node by node: what its weights are minus what they would be without it. */
static void find_change(const icc_weights *weights, const change *c, double *work)
{
    const iccp_layout *l = c->layout;
    const size_t m = l->n_handles;
    for (size_t k = 0; k < c->n; ++k) {
        const size_t i = node_of(c->line, k);
        const double *values = weights->values + m * i, *place = l->points + l->dim * i;
        double *without = c->change + m * k;
        (void)nearest(l, c->line, place, &c->share[k]);
        memcpy(without, i < m ? values : l->initial + m * i, m * sizeof *without);
        if (i >= m)
            (void)iccp_optimise(l->handles, weights->info.method, place, without, work);
        for (size_t j = 0; j < m; ++j)
            without[j] = values[j] - without[j];
    }
}

/* Adds the change at a share of the line, times `strength`, or less. */
static void add_change(const change *c, double share, double strength, double *weights, double *row)
{
    const size_t m = c->layout->n_handles;
    size_t k = 1;
    while (k + 1 < c->n && c->share[k] < share)
        ++k;
    const double *before = c->change + m * (k - 1), *after = before + m;
    const double part = (share - c->share[k - 1]) / (c->share[k] - c->share[k - 1]);
    for (size_t j = 0; j < m; ++j) {
        row[j] = before[j] + part * (after[j] - before[j]);
        if (row[j] < 0)
            strength = fmin(strength, fmax(0, weights[j]) / -row[j]);
    }
    for (size_t j = 0; j < m; ++j)
        weights[j] += strength * row[j];
}

static void bend(icc_weights *weights, const change *c, double *row)
{
    const iccp_layout *l = c->layout;
    const double reach = REACH * weights->info.sigma * iccp_layout_scale(l);
    for (size_t i = l->n_handles + l->n_line_nodes; i < l->n; ++i) {
        double share;
        if (l->held[i])
            continue;
        const double t = nearest(l, c->line, l->points + l->dim * i, &share) / (reach * reach);
        if (t < 1)
            add_change(c, share, (1 - t) * (1 - t), weights->values + l->n_handles * i, row);
    }
}

icc_status iccp_weights_follow(icc_weights *weights, size_t k, const iccp_env *env)
{
    const iccp_layout *l = weights->layout;
    const iccp_memory *memory = &env->memory;
    change c = {.layout = l, .line = &l->lines[k], .n = l->lines[k].count + 2};
    c.share = iccp_alloc(memory, c.n, sizeof *c.share);
    c.change = iccp_alloc(memory, c.n, l->n_handles * sizeof *c.change);
    double *work = iccp_alloc(memory, iccp_optimise_work(l->handles) + l->n_handles, sizeof *work);
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
