/* Writes the results of `libicc info` as JSON. */
#include "report/info.h"
#include "report/reason.h"

#include "base/system.h"
#include "job/option_table.h"

static void report_point(json *j, const char *name, size_t dim, const double *point)
{
    json_open(j, name, '[');
    for (size_t k = 0; k < dim; k++)
        json_number(j, NULL, point[k]);
    json_close(j, ']');
}

static void report_growth(json *j, const info *x)
{
    static const char *const methods_of_growth[] = {"stuck", "as given", "grown", "thinned"};
    const icc_grow_report *g = &x->growth;
    json_count(j, "given_up_vertices", x->grid.n_stray);
    json_count(j, "critical_in_tree_order", x->n_order_critical);
    json_open(j, "order", '{');
    json_text(j, "found", methods_of_growth[x->grown ? g->method : 0]);
    json_count(j, "postponed", g->n_deferred);
    json_count(j, "unplaced", g->n_unplaced);
    json_count(j, "left", g->n_remaining);
    json_count(j, "turned_edges", g->n_reversed);
    json_close(j, '}');
}

/* Writes the contents of print_grid() as JSON. The names of members are part of the command's
 * interface. */
static void report_grid(json *j, const info *x)
{
    const chart_facts *c = &x->chart;
    const grid_facts *g = &c->grid;
    function_report(j, &x->field, &x->solved);
    json_text(j, "tree_form", choice_name(trees, g->tree));
    json_count(j, "grid_vertices", g->n_vertices);
    json_count(j, "inside_vertices", g->n_inside);
    json_count(j, "tree_vertices", g->n_tree);
    json_count(j, "unreachable_vertices", g->n_unreachable);
    json_count(j, "cousin_violations", g->n_cousin_violations);
    json_count(j, "maxima", g->n_maxima);
    json_count(j, "minima", g->n_minima);
    json_count(j, "saddles", g->n_saddles);
    json_count(j, "holes", x->n_holes);
    if (x->has_critical) {
        char reason[240];
        report_point(j, "first_critical", (size_t)x->domain.dim, x->critical);
        json_text(j, "reason", info_reason(reason, x));
    }
    if (x->domain.dim > 2)
        report_growth(j, x);
    if (c->common.method == ICC_METHOD_FIELD) {
        json_count(j, "infeasible_vertices", c->field.n_infeasible);
        json_count(j, "contacts", c->field.n_contacts);
        json_count(j, "contacts_not_inward", c->field.n_not_inward);
    }
    if (x->domain.dim > 2)
        return;
    if (c->common.method == ICC_METHOD_GRADIENT) {
        json_count(j, "edges", c->gradient.n_edges);
        json_count(j, "compression_edges", c->gradient.n_compression);
        json_count(j, "expansion_edges", c->gradient.n_expansion);
    }
    json_count(j, "expansion_edges_inside", x->n_inner_expansion);
}

static void report_order(json *j, const icc_shelling_info *c)
{
    json_open(j, "order", '{');
    json_text(j, "found", c->order_peeled ? "peeled" : "grown");
    json_number(j, "weight", c->order_beta);
    json_count(j, "complete", (size_t)c->n_orders);
    json_count(j, "reversed", c->n_reversed);
    json_number(j, "energy", c->flux_energy);
    json_number(j, "divergence", c->flux_divergence);
    json_close(j, '}');
}

static void report_mesh(json *j, const chart_facts *c)
{
    json_count(j, "mesh_vertices", c->mesh.n_vertices);
    json_count(j, "mesh_boundary", c->mesh.n_boundary);
    json_count(j, "mesh_triangles", c->mesh.n_simplices);
    if (c->common.method != ICC_METHOD_FOLIATION)
        return;
    if (c->is_shelling)
        report_order(j, &c->shelling);
    json_count(j, "ties", c->foliation.n_ties);
    json_number(j, "harmonic_share", c->mesh.harmonic_share);
}

static void report_chart(json *j, const info *x)
{
    char reason[REASON_LENGTH];
    const icc_chart_info *c = &x->chart.common;
    json_text(j, "method", choice_name(methods, c->method));
    json_flag(j, "certified", c->certified != 0);
    if (!c->certified)
        json_text(j, "not_certified_because", reason_of_chart(reason, &x->chart));
    report_point(j, "maximum", (size_t)x->domain.dim, c->maximum);
    if (x->chart.gradient.moved > 0)
        json_number(j, "maximum_moved", x->chart.gradient.moved);
    json_number(j, "spacing", c->spacing);
    if (chart_has_grid(&x->chart))
        report_grid(j, x);
    else
        report_mesh(j, &x->chart);
}

static void report_shares(json *j, const icc_chart_report *m)
{
    json_open(j, "shares", '{');
    json_number(j, "unreachable", m->unreachable);
    json_number(j, "uncovered", m->uncovered);
    json_number(j, "collapsed", m->collapsed);
    json_number(j, "not_inward", m->not_inward);
    json_close(j, '}');
}

static void report_mesh_map(json *j, const icc_map_info *m, const icc_map_report *made)
{
    json_count(j, "triangles", m->n_simplices);
    json_count(j, "vertices", m->n_vertices);
    json_count(j, "repaired", made->n_inverted);
    json_count(j, "steps", made->n_iterations);
    json_count(j, "refinements", (size_t)made->n_levels);
    json_number(j, "energy_before", made->energy_start);
    json_number(j, "energy", m->energy);
    if (m->n_slid > 0)
        json_count(j, "slid", m->n_slid);
    if (m->n_ties > 0) {
        json_count(j, "ties", m->n_ties);
        json_number(j, "detour", m->detour);
        json_flag(j, "class_kept", m->class_kept != 0);
    }
    json_open(j, "seconds", '{');
    json_number(j, "repair", made->seconds_repair);
    json_number(j, "improve", made->seconds_improve);
    json_number(j, "certify", made->seconds_certify);
    json_number(j, "all", made->seconds);
    json_close(j, '}');
}

/* Writes the contents of print_map() as JSON. */
static void report_map(json *j, const info *x)
{
    const icc_map_info *m = &x->map;
    const map_shares *s = &x->shares;
    char reason[REASON_LENGTH];
    json_open(j, "map", '{');
    json_text(j, "kind", choice_name(maps, m->kind));
    json_flag(j, "certified", m->certified != 0);
    if (!m->certified)
        json_text(j, "not_certified_because", reason_of_map(reason, m, &x->made));
    if (x->made.n_samples > 0) {
        json_count(j, "samples_there_and_back", x->made.n_samples);
        json_count(j, "lost", x->made.n_lost);
        json_count(j, "flat", x->made.n_flat);
    }
    json_count(j, "unrepaired", x->made.n_unrepaired);
    if (m->kind == ICC_MAP_MESH)
        report_mesh_map(j, m, &x->made);
    json_count(j, "samples", s->n);
    json_number(j, "collapsed", s->collapsed);
    json_number(j, "inverted", s->inverted);
    json_number(j, "without_image", s->without_image);
    json_open(j, "distortion", '{');
    json_number(j, "mean", s->mean);
    json_number(j, "median", s->median);
    json_number(j, "share_99", s->nearly_all);
    json_close(j, '}');
    json_close(j, '}');
}

static void report_seconds(json *j, const info *x)
{
    const chart_facts *c = &x->chart;
    json_open(j, "seconds", '{');
    json_number(j, "read", x->job.seconds_read);
    if (chart_has_grid(&x->chart)) {
        json_number(j, "grid", c->seconds.grid);
        json_number(j, "tree", c->seconds.tree);
        json_number(j, "function", c->seconds.function);
    } else if (c->common.method != 0) {
        json_number(j, "mesh", c->seconds.mesh);
        json_number(j, "solve", c->seconds.solve);
        if (c->is_shelling)
            json_number(j, "order", c->seconds.order);
        json_number(j, "certify", c->seconds.certify);
    }
    json_number(j, "all", seconds_now() - x->job.started);
    json_close(j, '}');
}

int info_report(const info *x)
{
    report r;
    if (!report_open(&r, &x->job))
        return FAILED;
    if (x->domain.dim == 2)
        json_text(&r.json, "orientation",
                  x->domain.orientation > 0 ? "counter-clockwise" : "clockwise");
    else
        json_text(&r.json, "orientation", x->domain.orientation > 0 ? "outward" : "inward");
    json_number(&r.json, x->domain.dim == 2 ? "area" : "measure", x->domain.measure);
    if (x->chart.common.method != 0)
        report_chart(&r.json, x);
    if (x->chart.common.method != ICC_METHOD_FIELD || x->measures.n_points > 0)
        report_shares(&r.json, &x->measures);
    if (x->shares.n > 0)
        report_map(&r.json, x);
    report_seconds(&r.json, x);
    return report_close(&r) ? DONE : FAILED;
}
