/* Based on: T. Banchoff, Critical Points and Curvature for Embedded Polyhedra, Journal of Differential
 * Geometry 1, 1967: what a piecewise linear function does at a vertex can be read off the neighbours
 * that are higher and those that are lower. */
#include "field/critical.h"

#include "base/threads.h"
#include "grid/kuhn.h"

#include <math.h>

static const size_t GRAIN = 1 << 12; /* vertices per chunk: at most 0.4 s, in 6-D */

typedef struct work {
    const icc_field *field;
    iccp_kuhn kuhn;
    ptrdiff_t offset[ICCP_LINK_SIZE]; /* to each neighbour's index */
    icc_field_report *partial;        /* what each chunk found */
} work;

/* Whether neighbour i of a vertex lies in the grid. */
static bool in_grid(const work *w, uint32_t v, int i)
{
    const icc_grid *grid = w->field->tree->grid;
    for (int32_t k = 0; k < grid->dim; ++k) {
        const int step = w->kuhn.step[i][k];
        if (step != 0 && iccp_grid_neighbour(grid, v, k, step) == ICCP_NONE)
            return false;
    }
    return true;
}

static bool at_border(const icc_grid *grid, uint32_t v)
{
    for (int32_t k = 0; k < grid->dim; ++k)
        if (iccp_grid_neighbour(grid, v, k, -1) == ICCP_NONE ||
            iccp_grid_neighbour(grid, v, k, +1) == ICCP_NONE)
            return true;
    return false;
}

static iccp_link_set higher_neighbours(const work *w, uint32_t v)
{
    const icc_grid *grid = w->field->tree->grid;
    const bool border = at_border(grid, v);
    iccp_link_set higher = {{0, 0}};
    for (int i = 0; i < w->kuhn.n_neighbours; ++i) {
        if (border && !in_grid(w, v, i))
            continue;
        const size_t u = (size_t)((ptrdiff_t)v + w->offset[i]);
        if (!grid->inside[u] || isnan(w->field->values[u]))
            continue;
        const int order = iccp_field_compare(w->field, (uint32_t)u, v);
        if (order > 0 || (order == 0 && u > v))
            iccp_link_add(&higher, i);
    }
    return higher;
}

static void judge(const work *w, uint32_t v, icc_field_report *report)
{
    const iccp_link_set higher = higher_neighbours(w, v);
    const iccp_link_set lower = iccp_link_rest(&w->kuhn, &higher);
    if (iccp_link_is_empty(&higher))
        ++report->n_maxima;
    else if (iccp_link_is_empty(&lower))
        ++report->n_minima;
    else if (!iccp_kuhn_regular(&w->kuhn, &higher))
        ++report->n_saddles;
    else
        return;
    if (report->critical == ICCP_NONE && v != w->field->tree->root)
        report->critical = v;
}

static icc_status judge_chunk(void *argument, size_t begin, size_t end)
{
    const work *w = argument;
    icc_field_report report = {.critical = ICCP_NONE};
    for (uint32_t v = (uint32_t)begin; v < end; ++v)
        if (w->field->tree->grid->inside[v] && !isnan(w->field->values[v]))
            judge(w, v, &report);
    w->partial[begin / GRAIN] = report;
    return ICC_OK;
}

static void set_offsets(work *w)
{
    const icc_grid *grid = w->field->tree->grid;
    for (int i = 0; i < w->kuhn.n_neighbours; ++i) {
        w->offset[i] = 0;
        for (int32_t k = 0; k < grid->dim; ++k)
            w->offset[i] += w->kuhn.step[i][k] * (ptrdiff_t)grid->stride[k];
    }
}

icc_status iccp_field_verify(const icc_field *field, icc_field_report *report, const iccp_env *env)
{
    const icc_grid *grid = field->tree->grid;
    const size_t n_chunks = (grid->n_vertices + GRAIN - 1) / GRAIN;
    work w = {.field = field};
    w.partial = iccp_alloc(&env->memory, n_chunks, sizeof *w.partial);
    if (w.partial == NULL)
        return ICC_ERR_MEMORY;
    iccp_kuhn_init(&w.kuhn, grid->dim);
    if (grid->dim <= 3 && field->tree->n_inside >> w.kuhn.n_neighbours > 0)
        iccp_kuhn_tabulate(&w.kuhn);
    set_offsets(&w);
    const icc_status status =
        iccp_for_chunks(env, "critical points", grid->n_vertices, GRAIN, judge_chunk, &w);
    if (status == ICC_OK) {
        report->n_maxima = report->n_minima = report->n_saddles = 0;
        report->critical = ICCP_NONE;
        report->reserved = 0;
        for (size_t c = n_chunks; c-- > 0;) {
            report->n_maxima += w.partial[c].n_maxima;
            report->n_minima += w.partial[c].n_minima;
            report->n_saddles += w.partial[c].n_saddles;
            if (w.partial[c].critical != ICCP_NONE)
                report->critical = w.partial[c].critical;
        }
    }
    iccp_free(&env->memory, w.partial);
    return status;
}
