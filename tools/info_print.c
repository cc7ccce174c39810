#include "info.h"

#include "options.h"

#include <math.h>
#include <stdio.h>

static void print_domain(const icc_domain_info *d)
{
    printf("cage        %zu vertices, %s, area %.17g\n", d->n_vertices,
           d->orientation > 0 ? "counter-clockwise" : "clockwise", d->measure);
    printf("box         %.17g %.17g to %.17g %.17g\n", d->lower[0], d->lower[1], d->upper[0],
           d->upper[1]);
}

static void print_solution(const icc_field_info *f)
{
    printf("solution    %zu unknowns, solver %s", f->n_unknowns, choice_name(solvers, f->solver));
    if (f->solver == ICC_SOLVER_ITERATIVE)
        printf(" in %zu steps", f->n_inner);
    if (f->least_log < 0)
        printf(", least value 10^%.1f of the greatest\n", f->least_log / log(10));
    else
        printf(", some values are not positive\n");
    if (f->constrained)
        printf("tree edges  %zu broke the inequality without constraints; %zu hold with equality, "
               "found "
               "in %zu iterations\n",
               f->n_violated, f->n_active, f->n_iterations);
    else
        printf("tree edges  %zu break the inequality, which was not imposed\n", f->n_violated);
    printf("residual    %.2g, and %.2g before the last sweep along the tree\n", f->residual,
           f->residual_before);
}

static void print_critical(const info *x)
{
    const icc_chart_info *c = &x->chart;
    printf("critical    %zu maxima, %zu minima, %zu saddles\n", c->n_maxima, c->n_minima,
           c->n_saddles);
    char reason[240];
    if (x->has_critical)
        printf("            the first besides the maximum lies at %.17g %.17g:\n            %s\n",
               x->critical[0], x->critical[1], info_reason(reason, x));
}

static void print_gradient(const info *x)
{
    const icc_chart_info *c = &x->chart;
    const icc_chart_measures *m = &x->measures;
    char label[48];
    printf("method      gradient, function %s, tree %s, not certifiable\n",
           function_label(label, &x->field), choice_name(trees, c->tree));
    printf("grid        %zu vertices, %zu inside, spacing %.17g\n", c->n_grid, c->n_inside,
           c->spacing);
    printf("maximum     %.17g %.17g\n", c->maximum[0], c->maximum[1]);
    printf("tree        %zu vertices, %zu unreachable, %zu cousin violations\n", c->n_tree,
           c->n_unreachable, c->n_cousin_violations);
    if (function_solves(c->function))
        print_solution(&x->field);
    print_critical(x);
    printf("edges       %zu, of which %zu compression, %zu expansion; %zu of these at triangles "
           "inside\n",
           c->n_edges, c->n_compression, c->n_expansion, x->n_inner_expansion);
    printf(
        "unreachable %6.2f %% of the area: no curve through it reaches both boundary and maximum\n",
        100 * m->unreachable);
    printf("uncovered   %6.2f %% of the area: no curve from the boundary enters it\n",
           100 * m->uncovered);
    printf("collapsed   %6.2f %% of the coordinates: on lines where curves have merged\n",
           100 * m->collapsed);
    printf("not inward  %6.2f %% of the boundary: the gradient does not point inward\n",
           100 * m->not_inward);
}

static void print_certified(const icc_chart_info *c)
{
    printf("method      %s, %s\n", choice_name(methods, c->method),
           c->certified ? "certified" : "not certified");
    printf("mesh        %zu vertices, %zu of them on the boundary, %zu triangles, spacing %.17g\n",
           c->n_mesh_vertices, c->n_mesh_boundary, c->n_mesh_triangles, c->spacing);
    printf("maximum     %.17g %.17g\n", c->maximum[0], c->maximum[1]);
    if (c->method == ICC_METHOD_FOLIATION)
        printf("leaves      %zu ties, flux through the boundary %.4g %% harmonic\n", c->n_ties,
               100 * c->harmonic_share);
}

static void print_mesh_map(const icc_map_info *m)
{
    printf("triangles   %zu, %zu vertices; %zu were not positive and have been repaired\n",
           m->n_triangles, m->n_vertices, m->n_inverted);
    printf("energy      %.4g, improved to %.4g (steps: %zu, refinements: %d)\n", m->energy_start,
           m->energy, m->n_iterations, (int)m->n_levels);
}

static void print_map(const info *x)
{
    const icc_map_info *m = &x->map;
    const map_shares *s = &x->shares;
    printf("map         %s, %s\n", choice_name(maps, m->kind),
           m->certified ? "certified" : "not certified");
    if (m->n_unrepaired > 0)
        printf("            of kind curves because %zu triangles could not be repaired\n",
               m->n_unrepaired);
    if (m->kind == ICC_MAP_MESH)
        print_mesh_map(m);
    printf("area        %6.2f %% collapses, %.2f %% inverts, %.2f %% has no image\n",
           100 * s->collapsed, 100 * s->inverted, 100 * s->without_image);
    printf(
        "distortion  mean %.4g, median %.4g, 99 %% below %.4g%s (symmetric Dirichlet; 4: none)\n",
        s->mean, s->median, s->nearly_all,
        s->collapsed + s->inverted + s->without_image > 0 ? " for the rest" : "");
}

static void print_gradient_seconds(const info *x)
{
    const icc_chart_info *c = &x->chart;
    const icc_field_info *f = &x->field;
    printf("grid %.4f, tree %.4f, function %.4f", c->seconds_grid, c->seconds_tree,
           c->seconds_field);
    if (function_solves(c->function))
        printf(" (set up %.4f, order %.4f, factorise %.4f, solve %.4f, verify %.4f)",
               f->seconds_setup, f->seconds_order, f->seconds_factor, f->seconds_solve,
               f->seconds_verify);
}

void info_print(const info *x)
{
    const icc_chart_info *c = &x->chart;
    print_domain(&x->domain);
    if (c->method == ICC_METHOD_GRADIENT)
        print_gradient(x);
    else
        print_certified(c);
    if (x->shares.n > 0)
        print_map(x);
    printf("seconds     read %.4f, ", x->job.seconds_read);
    if (c->method == ICC_METHOD_GRADIENT)
        print_gradient_seconds(x);
    else
        printf("mesh %.4f, solve %.4f, certify %.4f", c->seconds_mesh, c->seconds_solve,
               c->seconds_certify);
    if (x->map.kind == ICC_MAP_MESH)
        printf(", repair %.4f, improve %.4f, certify %.4f", x->map.seconds_repair,
               x->map.seconds_improve, x->map.seconds_certify);
    printf(", all %.4f\n", seconds_now() - x->job.started);
}
