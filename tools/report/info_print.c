/* Prints the results of `libicc info` in words. */
#include "report/info.h"
#include "report/reason.h"

#include "base/system.h"
#include "cage/cage_features.h"
#include "job/option_table.h"

#include <math.h>
#include <stdio.h>

static void print_point(const info *x, const char *before, const double *at, const char *behind)
{
    fputs(before, stdout);
    for (int32_t k = 0; k < x->domain.dim; k++)
        printf("%s%.12g", k > 0 ? " " : "", at[k]);
    fputs(behind, stdout);
}

static void print_domain(const info *x)
{
    const icc_domain_info *d = &x->domain;
    const char *const measures[] = {"measure", "length", "area", "volume"};
    const char *const turns[] = {"facing inward", "facing outward", "clockwise",
                                 "counter-clockwise"};
    const cage *c = &x->job.cages[0];
    char rings[80], inside[120];
    if (d->dim != 2)
        printf("cage        %zu vertices, %zu facets, ", d->n_vertices, d->n_facets);
    else
        printf("cage        %s, ", cage_rings_text(rings, c));
    if (d->dim != 2 || c->n > 0)
        printf("%s, ", turns[(d->dim == 2 ? 2 : 0) + (d->orientation > 0)]);
    printf("%s %.12g%s\n", measures[d->dim > 3 ? 0 : d->dim], d->measure,
           cage_inside_text(inside, c));
    print_point(x, "box         ", d->lower, " to ");
    print_point(x, "", d->upper, "\n");
}

static void print_solution(const icc_function_info *f, const icc_solver_report *made)
{
    printf("solution    %zu unknowns, solver %s", f->n_unknowns, choice_name(solvers, f->solver));
    if (f->solver == ICC_SOLVER_ITERATIVE)
        printf(" in %zu steps", made->n_inner);
    if (f->least_log < 0)
        printf(", least value 10^%.1f of the greatest\n", f->least_log / log(10));
    else
        printf(", some values are not positive\n");
    if (f->constrained)
        printf("tree edges  %zu broke the inequality without constraints; %zu hold with equality, "
               "found "
               "in %zu iterations\n",
               f->n_violated, f->n_active, made->n_iterations);
    else
        printf("tree edges  %zu break the inequality, which was not imposed\n", f->n_violated);
    printf("residual    %.2g, and %.2g before the last sweep along the tree\n", f->residual,
           made->residual_before);
}

static void print_critical(const info *x)
{
    const grid_facts *g = &x->chart.grid;
    printf("critical    %zu maxima, %zu minima, %zu saddles\n", g->n_maxima, g->n_minima,
           g->n_saddles);
    char reason[240];
    if (!x->has_critical)
        return;
    print_point(x, "            the first besides the maximum lies at ", x->critical, ":\n");
    printf("            %s\n", info_reason(reason, x));
}

/* Prints the results of methods on grids. The maximum is where the function is greatest, which may
 * not be where the caller asked for it. */
static void print_grid(const info *x)
{
    const icc_chart_info *c = &x->chart.common;
    const grid_facts *g = &x->chart.grid;
    const double moved = x->chart.gradient.moved;
    char text[160];
    printf("grid        %zu vertices, %zu inside, ", g->n_vertices, g->n_inside);
    if (x->domain.dim > 2)
        printf("%zu given up, ", x->grid.n_stray);
    printf("spacing %.12g\n", c->spacing);
    print_point(x, "maximum     ", c->maximum, "\n");
    if (moved > 0)
        printf("            %.4g from the place chosen: the function is greatest here\n", moved);
    printf("tree        %zu vertices, %zu unreachable, %zu cousin violations", g->n_tree,
           g->n_unreachable, g->n_cousin_violations);
    if (x->domain.dim > 2)
        printf(", %zu critical vertices in its order\norder       %s", x->n_order_critical,
               info_growth(text, x));
    putchar('\n');
    if (function_solves(x->field.function))
        print_solution(&x->field, &x->solved);
    print_critical(x);
}

/* How much of the domain the chart does not cover one-to-one, as icc_chart_get_report() measures
 * it. */
static void print_shares(const info *x)
{
    const icc_gradient_info *c = &x->chart.gradient;
    const icc_chart_report *m = &x->measures;
    const char *measure = x->domain.dim == 2 ? "area" : "volume";
    if (c->n_edges > 0)
        printf(
            "edges       %zu, of which %zu compression, %zu expansion; %zu of these at triangles "
            "inside\n",
            c->n_edges, c->n_compression, c->n_expansion, x->n_inner_expansion);
    if (m->n_points == 0)
        return;
    printf(
        "unreachable %6.2f %% of the %s: no curve through it reaches both boundary and maximum\n",
        100 * m->unreachable, measure);
    printf("uncovered   %6.2f %% of the %s: no curve from the boundary enters it\n",
           100 * m->uncovered, measure);
    printf("collapsed   %6.2f %% of the coordinates: on lines where curves have merged\n",
           100 * m->collapsed);
    printf("not inward  %6.2f %% of the boundary: the gradient does not point inward\n",
           100 * m->not_inward);
}

static void print_gradient(const info *x)
{
    char label[48];
    printf("method      gradient, function %s, tree %s, not certifiable\n",
           function_label(label, &x->field), choice_name(trees, x->chart.grid.tree));
    print_grid(x);
    print_shares(x);
}

static void print_field(const info *x)
{
    const icc_chart_info *c = &x->chart.common;
    const icc_field_info *f = &x->chart.field;
    char label[48], reason[REASON_LENGTH];
    printf("method      field, function %s, %s\n", function_label(label, &x->field),
           c->certified ? "certified" : "not certified");
    print_grid(x);
    printf("vectors     %zu of %zu vertices have none that points uphill all round\n",
           f->n_infeasible, f->n_inside);
    if (!c->certified)
        printf("reason      %s\n", reason_of_chart(reason, &x->chart));
    printf(
        "contacts    %6.2f %% (%zu of %zu with the boundary) are such that curves do not enter\n",
        f->n_contacts > 0 ? 100 * (double)f->n_not_inward / (double)f->n_contacts : 0,
        f->n_not_inward, f->n_contacts);
    print_shares(x);
}

static void print_order(const icc_shelling_info *c)
{
    printf("order       %s, weight %.4g; %d complete ones to choose from\n",
           c->order_peeled ? "peeled from the boundary" : "grown from the maximum", c->order_beta,
           (int)c->n_orders);
    printf("flux        %zu facets reversed, %.3g away from the harmonic flux\n", c->n_reversed,
           c->flux_energy);
}

static void print_certified(const info *x)
{
    const icc_chart_info *c = &x->chart.common;
    const mesh_facts *m = &x->chart.mesh;
    printf("method      %s, %s\n", choice_name(methods, c->method),
           c->certified ? "certified" : "not certified");
    printf("mesh        %zu vertices, %zu of them on the boundary, %zu %s", m->n_vertices,
           m->n_boundary, m->n_simplices, elements_name(c->dim));
    if (c->spacing > 0)
        printf(", spacing %.12g", c->spacing);
    putchar('\n');
    print_point(x, "maximum     ", c->maximum, "\n");
    if (x->chart.is_shelling)
        print_order(&x->chart.shelling);
    else if (c->method == ICC_METHOD_FOLIATION)
        printf("leaves      %zu ties, flux through the boundary %.4g %% harmonic\n",
               x->chart.foliation.n_ties, 100 * m->harmonic_share);
}

static void print_mesh_map(const icc_map_info *m, const icc_map_report *made)
{
    printf("%-11s %zu, %zu vertices; %zu were not positive and have been repaired\n",
           elements_name(m->dim), m->n_simplices, m->n_vertices, made->n_inverted);
    printf("energy      %.4g, improved to %.4g (steps: %zu, refinements: %d)\n", made->energy_start,
           m->energy, made->n_iterations, (int)made->n_levels);
    if (m->n_slid > 0)
        printf("slid        %zu places of vertices\n", m->n_slid);
    if (m->n_ties > 0)
        printf("ties        %zu, %.4g times as long as straight lines%s\n", m->n_ties, m->detour,
               m->class_kept
                   ? ""
                   : "; they may pass features on another side than those that it began with");
}

/* The map, its certificate or why there is none, and how it distorts the source. */
static void print_map(const info *x)
{
    const icc_map_info *m = &x->map;
    const map_shares *s = &x->shares;
    char reason[REASON_LENGTH];
    printf("map         %s, %s\n", choice_name(maps, m->kind),
           m->certified ? "certified" : "not certified");
    if (!m->certified)
        printf("            because %s\n", reason_of_map(reason, m, &x->made));
    if (x->made.n_unrepaired > 0)
        printf("            a curve map, because %zu %s stay inverted\n", x->made.n_unrepaired,
               elements_name(m->dim));
    if (m->kind == ICC_MAP_MESH)
        print_mesh_map(m, &x->made);
    printf("%-11s %6.2f %% collapses, %.2f %% inverts, %.2f %% has no image\n",
           x->domain.dim == 2 ? "area" : "volume", 100 * s->collapsed, 100 * s->inverted,
           100 * s->without_image);
    printf(
        "distortion  mean %.4g, median %.4g, 99 %% below %.4g%s (symmetric Dirichlet; %d: none)\n",
        s->mean, s->median, s->nearly_all,
        s->collapsed + s->inverted + s->without_image > 0 ? " for the rest" : "",
        2 * (int)x->domain.dim);
}

static void print_grid_seconds(const info *x)
{
    const icc_chart_timings *c = &x->chart.seconds;
    const icc_solver_report *f = &x->solved;
    printf("grid %.4f, tree %.4f, function %.4f", c->grid, c->tree, c->function);
    if (function_solves(x->field.function))
        printf(" (set up %.4f, order %.4f, factorise %.4f, solve %.4f, verify %.4f)",
               f->seconds_setup, f->seconds_order, f->seconds_factor, f->seconds_solve,
               f->seconds_verify);
    if (x->chart.common.method == ICC_METHOD_FIELD)
        printf(", vectors %.4f", x->chart.seconds.solve);
}

static void print_mesh_seconds(const chart_facts *c)
{
    printf("mesh %.4f, solve %.4f, ", c->seconds.mesh, c->seconds.solve);
    if (c->is_shelling)
        printf("order %.4f, ", c->seconds.order);
    printf("certify %.4f", c->seconds.certify);
}

void info_print(const info *x)
{
    const chart_facts *c = &x->chart;
    print_domain(x);
    if (c->common.method == ICC_METHOD_GRADIENT)
        print_gradient(x);
    else if (c->common.method == ICC_METHOD_FIELD)
        print_field(x);
    else if (c->common.method != 0)
        print_certified(x);
    if (x->shares.n > 0)
        print_map(x);
    printf("seconds     read %.4f, ", x->job.seconds_read);
    if (chart_has_grid(c))
        print_grid_seconds(x);
    else if (c->common.method != 0)
        print_mesh_seconds(c);
    if (x->map.kind == ICC_MAP_MESH)
        printf("%srepair %.4f, improve %.4f, certify %.4f", c->common.method != 0 ? ", " : "",
               x->made.seconds_repair, x->made.seconds_improve, x->made.seconds_certify);
    printf(", all %.4f\n", seconds_now() - x->job.started);
}
