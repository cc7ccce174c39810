/* libicc info: describes a chart and what it does not cover. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "job/ties_file.h"
#include "plot/stages.h"
#include "report/info.h"

#include <stdlib.h>

/* Examines the critical vertices of the order in which the tree was grown. In more than 2
 * dimensions also the cost of an order with no critical vertex but the maximum. */
static int examine_order(info *x, const stages *s)
{
    icc_function_report found = {.size = sizeof found};
    icc_error err = {.size = sizeof err, .index = -1};
    x->grid = s->lattice;
    uint32_t *rank = need(s->lattice.n_vertices, sizeof *rank);
    const int32_t *generations = icc_tree_generations(s->tree);
    for (size_t i = 0; i < s->lattice.n_vertices; i++)
        rank[i] = generations[i] < 0 ? UINT32_MAX : (uint32_t)generations[i];
    icc_status status = icc_tree_get_rank_report(s->tree, rank, &found, &x->job.env, &err);
    x->n_order_critical = found.n_maxima + found.n_minima + found.n_saddles - 1;
    if (status == ICC_OK && s->lattice.dim > 2) {
        x->growth.size = sizeof x->growth;
        status = icc_tree_grow(s->tree, s->values, rank, &x->growth, &x->job.env, &err);
        x->grown = status == ICC_OK;
    }
    free(rank);
    return status == ICC_OK || status == ICC_ERR_TOPOLOGY ? DONE : job_failed(&x->job, &err);
}

/* Examines how the function was made, and where the first unwanted critical point lies. */
static int examine_function(info *x, const stages *s)
{
    icc_function_report found = {.size = sizeof found};
    icc_error err = {.size = sizeof err, .index = -1};
    x->field = s->field_info;
    x->solved = s->solved;
    if (s->field == NULL)
        return DONE;
    if (icc_function_get_report(s->field, &found, &x->job.env, &err) != ICC_OK)
        return job_failed(&x->job, &err);
    x->n_inner_expansion = s->n_inner_expansion;
    x->n_holes = s->lattice.dim == 2 ? stages_holes(s) : 0;
    x->has_critical = found.critical != UINT32_MAX;
    if (x->has_critical)
        stages_position(s, found.critical, x->critical);
    return examine_order(x, s);
}

/* Gathers everything before anything is printed, so that a failure leaves no half report. */
static int gather(info *x)
{
    job *j = &x->job;
    int result = job_read_cages(j);
    if (result != DONE)
        return result;
    bool pair = j->args->target != NULL;
    result = pair ? job_make_map(j) : job_make_chart(j);
    if (result != DONE)
        return result;
    const icc_chart *chart = pair ? icc_map_source_chart(j->map) : j->chart;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_domain_get_info(j->domains[0], &x->domain);
    x->chart = chart_facts_of(chart);
    if (chart_has_grid(&x->chart) &&
        icc_chart_get_report(chart, 0, &x->measures, &j->env, &err) != ICC_OK)
        return job_failed(j, &err);
    stages parts;
    result = stages_make(&parts, j, 1);
    if (result == DONE)
        result = examine_function(x, &parts);
    stages_free(&parts);
    if (result == DONE && pair)
        result = info_measure_map(x);
    progress_end(&j->bar);
    return result;
}

int run_info(const args *a)
{
    info x = {.domain = {.size = sizeof x.domain},
              .measures = {.size = sizeof x.measures},
              .map = {.size = sizeof x.map},
              .made = {.size = sizeof x.made}};
    job_start(&x.job, a);
    int result = ties_check(&x.job);
    if (result == DONE)
        result = gather(&x);
    if (result == DONE)
        result = ties_write(&x.job);
    if (result == DONE && a->json)
        result = info_report(&x);
    else if (result == DONE)
        info_print(&x);
    job_end(&x.job);
    return result;
}
