/* libicc info: what a chart is made of, and what it misses. */
#include "commands.h"

#include "job.h"
#include "memory.h"
#include "sample.h"

#include <math.h>
#include <stdlib.h>

enum { N_SAMPLES = 4096 };

/* What happens to the area under the map, by the sign of its derivative at evenly spread points. */
typedef struct map_shares {
    size_t n;
    double without_image, collapsed, inverted;
} map_shares;

typedef struct info {
    job job;
    icc_domain_info domain;
    icc_chart_info chart;
    icc_chart_measures measures;
    map_shares shares;
} info;

static const char *method_name(int32_t method)
{
    return method == ICC_METHOD_GRADIENT ? "gradient" : "unknown";
}

static const char *function_name(int32_t function)
{
    return function == ICC_FUNCTION_DISTANCE ? "distance" : "decay";
}

static const char *tree_name(int32_t tree)
{
    return tree == ICC_TREE_PAPER ? "paper" : "thesis";
}

/* Collapsed: less than a billionth of the mean change of area is left. */
static void add_sign(map_shares *s, const double *jacobian, double mean)
{
    const double collapse = 1e-9;
    double det = jacobian[0] * jacobian[3] - jacobian[1] * jacobian[2];
    double one = 1.0 / (double)s->n;
    if (isnan(det))
        s->without_image += one;
    else if (fabs(det) < collapse * mean)
        s->collapsed += one;
    else if (det < 0)
        s->inverted += one;
}

static int measure_map(info *x)
{
    job *j = &x->job;
    icc_domain_info target = {.size = sizeof target};
    icc_domain_get_info(j->domains[1], &target);
    double *points = need(N_SAMPLES, 2 * sizeof *points),
           *jacobians = need(N_SAMPLES, 4 * sizeof *jacobians);
    x->shares.n = sample_inside(j->domains[0], N_SAMPLES, points, &j->env);
    icc_status ran = icc_map_jacobian(j->map, x->shares.n, points, jacobians, NULL, NULL, &j->env);
    for (size_t i = 0; i < x->shares.n && ran == ICC_OK; i++)
        add_sign(&x->shares, jacobians + 4 * i, fabs(target.measure / x->domain.measure));
    free(points);
    free(jacobians);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
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
    result = pair ? measure_map(x) : DONE;
    progress_end(&j->bar);
    return result;
}

static void print_domain(const info *x)
{
    const icc_domain_info *d = &x->domain;
    printf("cage        %zu vertices, %s, area %.17g\n", d->n_vertices,
           d->orientation > 0 ? "counter-clockwise" : "clockwise", d->measure);
    printf("box         %.17g %.17g to %.17g %.17g\n", d->lower[0], d->lower[1], d->upper[0],
           d->upper[1]);
}

static void print_chart(const icc_chart_info *c)
{
    printf("method      %s, function %s, tree %s\n", method_name(c->method),
           function_name(c->function), tree_name(c->tree));
    printf("grid        %zu vertices, %zu inside, spacing %.17g\n", c->n_grid, c->n_inside,
           c->spacing);
    printf("maximum     %.17g %.17g\n", c->maximum[0], c->maximum[1]);
    printf("tree        %zu vertices, %zu unreachable, %zu cousin violations\n", c->n_tree,
           c->n_unreachable, c->n_cousin_violations);
    printf("critical    %zu maxima, %zu minima, %zu saddles\n", c->n_maxima, c->n_minima,
           c->n_saddles);
    printf("edges       %zu, of which %zu compression, %zu expansion\n", c->n_edges,
           c->n_compression, c->n_expansion);
}

static void print_shares(const info *x)
{
    const icc_chart_measures *m = &x->measures;
    printf(
        "unreachable %6.2f %% of the area: no curve through it reaches both boundary and maximum\n",
        100 * m->unreachable);
    printf("uncovered   %6.2f %% of the area: no curve from the boundary enters it\n",
           100 * m->uncovered);
    printf("collapsed   %6.2f %% of the coordinates: on lines where curves have merged\n",
           100 * m->collapsed);
    printf("not inward  %6.2f %% of the boundary: the gradient does not point inward\n",
           100 * m->not_inward);
    if (x->shares.n == 0)
        return;
    printf("map         %6.2f %% of the area collapses, %.2f %% inverts, %.2f %% has no image\n",
           100 * x->shares.collapsed, 100 * x->shares.inverted, 100 * x->shares.without_image);
}

static void report_chart(json *j, const icc_chart_info *c)
{
    json_text(j, "method", method_name(c->method));
    json_text(j, "function", function_name(c->function));
    json_text(j, "tree_form", tree_name(c->tree));
    json_open(j, "maximum", '[');
    json_number(j, NULL, c->maximum[0]);
    json_number(j, NULL, c->maximum[1]);
    json_close(j, ']');
    json_number(j, "spacing", c->spacing);
    json_count(j, "grid_vertices", c->n_grid);
    json_count(j, "inside_vertices", c->n_inside);
    json_count(j, "tree_vertices", c->n_tree);
    json_count(j, "unreachable_vertices", c->n_unreachable);
    json_count(j, "cousin_violations", c->n_cousin_violations);
    json_count(j, "maxima", c->n_maxima);
    json_count(j, "minima", c->n_minima);
    json_count(j, "saddles", c->n_saddles);
    json_count(j, "edges", c->n_edges);
    json_count(j, "compression_edges", c->n_compression);
    json_count(j, "expansion_edges", c->n_expansion);
}

static void report_shares(json *j, const info *x)
{
    json_open(j, "shares", '{');
    json_number(j, "unreachable", x->measures.unreachable);
    json_number(j, "uncovered", x->measures.uncovered);
    json_number(j, "collapsed", x->measures.collapsed);
    json_number(j, "not_inward", x->measures.not_inward);
    json_close(j, '}');
    if (x->shares.n == 0)
        return;
    json_open(j, "map", '{');
    json_count(j, "samples", x->shares.n);
    json_number(j, "collapsed", x->shares.collapsed);
    json_number(j, "inverted", x->shares.inverted);
    json_number(j, "without_image", x->shares.without_image);
    json_close(j, '}');
}

static int write_report(const info *x)
{
    report r;
    if (!report_open(&r, &x->job))
        return FAILED;
    json_text(&r.json, "orientation",
              x->domain.orientation > 0 ? "counter-clockwise" : "clockwise");
    json_number(&r.json, "area", x->domain.measure);
    report_chart(&r.json, &x->chart);
    report_shares(&r.json, x);
    json_open(&r.json, "seconds", '{');
    json_number(&r.json, "read", x->job.seconds_read);
    json_number(&r.json, "grid", x->chart.seconds_grid);
    json_number(&r.json, "tree", x->chart.seconds_tree);
    json_number(&r.json, "function", x->chart.seconds_field);
    json_number(&r.json, "all", seconds_now() - x->job.started);
    json_close(&r.json, '}');
    return report_close(&r) ? DONE : FAILED;
}

static int print(const info *x)
{
    if (x->job.args->json)
        return write_report(x);
    print_domain(x);
    print_chart(&x->chart);
    print_shares(x);
    printf("seconds     read %.4f, grid %.4f, tree %.4f, function %.4f, all %.4f\n",
           x->job.seconds_read, x->chart.seconds_grid, x->chart.seconds_tree,
           x->chart.seconds_field, seconds_now() - x->job.started);
    return DONE;
}

int run_info(const args *a)
{
    info x = {.domain = {.size = sizeof x.domain},
              .chart = {.size = sizeof x.chart},
              .measures = {.size = sizeof x.measures}};
    job_start(&x.job, a);
    int result = gather(&x);
    if (result == DONE)
        result = print(&x);
    job_end(&x.job);
    return result;
}
