/* libicc info: what a chart is made of, and what it misses. */
#include "commands.h"

#include "info.h"
#include "memory.h"
#include "sample.h"
#include "stages.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N_SAMPLES = 4096 };

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void summarise(map_shares *s, size_t n, double *energies)
{
    if (n == 0)
        return;
    for (size_t i = 0; i < n; i++)
        s->mean += energies[i] / (double)n;
    qsort(energies, n, sizeof *energies, compare_numbers);
    s->median = energies[n / 2];
    s->nearly_all = energies[(n - 1) * 99 / 100];
}

/* `growth` is the mean change of area. */
static void share_out(map_shares *s, const double *jacobians, double growth)
{
    const double collapse = 1e-9; /* less of the mean change of area is left than that */
    const double one = 1.0 / (double)s->n;
    double *energies = need(s->n, sizeof *energies);
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) {
        const double *j = jacobians + 4 * i;
        double det = (j[0] * j[3] - j[1] * j[2]) / growth;
        double square = (j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3]) / growth;
        if (isnan(det))
            s->without_image += one;
        else if (fabs(det) < collapse)
            s->collapsed += one;
        else if (det < 0)
            s->inverted += one;
        else
            energies[n++] = square + square / (det * det);
    }
    summarise(s, n, energies);
    free(energies);
}

static int measure_map(info *x)
{
    job *j = &x->job;
    icc_domain_info target = {.size = sizeof target};
    icc_map_get_info(j->map, &x->map);
    icc_domain_get_info(j->domains[1], &target);
    double *points = need(N_SAMPLES, 2 * sizeof *points),
           *jacobians = need(N_SAMPLES, 4 * sizeof *jacobians);
    x->shares.n = sample_inside(j->domains[0], N_SAMPLES, points, &j->env);
    icc_status ran = icc_map_jacobian(j->map, x->shares.n, points, jacobians, NULL, NULL, &j->env);
    if (ran == ICC_OK && x->shares.n > 0)
        share_out(&x->shares, jacobians, fabs(target.measure / x->domain.measure));
    free(points);
    free(jacobians);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}

/* How the function was made, and where the first critical point lies that should not be there. */
static int examine_function(info *x, const stages *s)
{
    icc_field_report found = {.size = sizeof found};
    icc_error err = {.size = sizeof err, .index = -1};
    x->field = s->field_info;
    if (s->field == NULL)
        return DONE;
    if (icc_field_verify(s->field, &found, &x->job.env, &err) != ICC_OK)
        return job_failed(&x->job, &err);
    x->n_inner_expansion = s->n_inner_expansion;
    x->n_holes = stages_holes(s);
    x->has_critical = found.critical != UINT32_MAX;
    if (x->has_critical)
        stages_position(s, found.critical, x->critical);
    return DONE;
}

/* Euler's formula: a hole brings a saddle, whatever the function; further critical points are its own. */
static const char *own_reason(const info *x)
{
    if (x->chart.n_maxima == 1 && x->chart.n_minima == 0 && x->chart.n_saddles <= x->n_holes)
        return NULL;
    if (function_solves(x->field.function) && !x->field.constrained)
        return "the inequalities that keep such points away were not imposed";
    if (x->chart.n_cousin_violations > 0)
        return "the tree breaks the cousin rule, so falling along it does not exclude them";
    return "the function keeps to the inequalities only up to its residual";
}

const char *info_reason(char text[240], const info *x)
{
    const char *own = own_reason(x);
    text[0] = '\0';
    if (x->n_holes > 0)
        snprintf(
            text, 240,
            "gaps narrower than a cell make %zu hole%s in the shape, each with a saddle, until "
            "--cells resolves them%s",
            x->n_holes, x->n_holes == 1 ? "" : "s", own != NULL ? "; and " : "");
    size_t used = strlen(text);
    snprintf(text + used, 240 - used, "%s", own != NULL ? own : "");
    return text;
}

static int gather(info *x)
{
    job *j = &x->job;
    bool pair = j->args->target != NULL;
    int result = pair ? job_make_map(j) : job_make_chart(j);
    if (result != DONE)
        return result;
    const icc_chart *chart = pair ? icc_map_source_chart(j->map) : j->chart;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_domain_get_info(j->domains[0], &x->domain);
    icc_chart_get_info(chart, &x->chart);
    if (icc_chart_measure(chart, 0, &x->measures, &j->env, &err) != ICC_OK)
        return job_failed(j, &err);
    stages parts;
    result = stages_make(&parts, j, 1);
    if (result == DONE)
        result = examine_function(x, &parts);
    stages_free(&parts);
    if (result == DONE && pair)
        result = measure_map(x);
    progress_end(&j->bar);
    return result;
}

int run_info(const args *a)
{
    info x = {.domain = {.size = sizeof x.domain},
              .chart = {.size = sizeof x.chart},
              .measures = {.size = sizeof x.measures},
              .map = {.size = sizeof x.map}};
    job_start(&x.job, a);
    int result = gather(&x);
    if (result == DONE && a->json)
        result = info_report(&x);
    else if (result == DONE)
        info_print(&x);
    job_end(&x.job);
    return result;
}
