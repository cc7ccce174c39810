/* Charts of method gradient. Based on: L. Huynh, thesis, 2013, section 5.1, Algorithms 6-8 (Huynh
 * and Gingold, section 4). The code is the same in any dimension; gradient_line.h walks along the
 * curves. */
#include "gradient/coordinates/chart_gradient.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/threads.h"
#include "gradient/coordinates/gradient_boundary.h"
#include "gradient/coordinates/gradient_file.h"
#include "gradient/coordinates/gradient_jet.h"
#include "gradient/coordinates/gradient_measure.h"
#include "gradient/coordinates/gradient_stages.h"
#include "gradient/function/critical_points.h"
#include "gradient/function/merging.h"
#include "gradient/tree/verify.h"

#include <math.h>
#include <string.h>

/* ---- Algorithm 6: preprocessing ---- */

/* Checks the cousin rule. */
static icc_status check_tree(icc_chart *chart, const icc_tree *tree, const iccp_env *env)
{
    const double start = iccp_seconds();
    icc_tree_report report = {0};
    const icc_status status = iccp_tree_verify(tree, &report, env);
    chart->own.gradient.n_tree = report.n_inside + report.n_outside;
    chart->own.gradient.n_unreachable = report.n_unreachable;
    chart->own.gradient.n_cousin_violations = report.n_cousin_violations;
    chart->timings.tree += iccp_seconds() - start;
    return status;
}

/* Checks the function for false critical points, and extends it to vertices that no tree
 * reaches. */
static icc_status check_field(icc_chart *chart, icc_function *field, const iccp_env *env)
{
    const double start = iccp_seconds();
    icc_function_report report = {0};
    iccp_facet_count count = {0};
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){2, 1, 1}, env);
    icc_status status = iccp_function_verify(field, &report, &part[0]);
    if (status != ICC_OK)
        return status;
    chart->own.gradient.n_maxima = report.n_maxima;
    chart->own.gradient.n_minima = report.n_minima;
    chart->own.gradient.n_saddles = report.n_saddles;
    status = iccp_gradient_extend(field, &part[1]);
    if (status == ICC_OK)
        status = iccp_function_facets(field, 0, NULL, NULL, &count, &part[2]);
    chart->own.gradient.n_edges = count.n_tested;
    chart->own.gradient.n_compression = count.n_compression;
    chart->own.gradient.n_expansion = count.n_expansion;
    chart->timings.function += iccp_seconds() - start;
    return status;
}

static void place_maximum(iccp_gradient_state *state, icc_chart *chart)
{
    const icc_grid *grid = state->tree->grid;
    double lattice[ICC_MAX_DIM], local[ICC_MAX_DIM], squared = 0;
    for (int32_t k = 0; k < grid->dim; ++k) {
        lattice[k] = iccp_grid_coordinate(grid, state->tree->root, k);
        const double step = lattice[k] - iccp_grid_coordinate(grid, state->chosen, k);
        squared += step * step;
    }
    iccp_gradient_to_local(state, lattice, local);
    iccp_chart_set_maximum(chart, local);
    chart->info.spacing = grid->spacing * chart->domain->frame.out[0] * chart->domain->frame.out[1];
    chart->own.gradient.moved = sqrt(squared) * chart->info.spacing;
}

/* ---- Algorithm 7: Cartesian to ICC ---- */

static icc_status encode(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                         iccp_coords *coords, iccp_encode_jet *jet)
{
    (void)place;
    const iccp_gradient_state *state = chart->state;
    const int32_t dim = chart->domain->dim;
    double p[ICC_MAX_DIM];
    iccp_gradient_to_lattice(state, point, p);
    iccp_jetn jets[2];
    iccp_gradient_line down, up;
    for (int k = 0; k < 2 && jet != NULL; ++k)
        iccp_gradient_identity(dim, &jets[k]);
    icc_status status = iccp_gradient_down(state, p, NULL, jet != NULL ? &jets[0] : NULL, &down);
    if (status == ICC_OK)
        status = iccp_gradient_up(state, p, NULL, jet != NULL ? &jets[1] : NULL, &up);
    if (status != ICC_OK)
        return status;
    coords->facet = down.facet;
    memcpy(coords->bary, down.bary, sizeof coords->bary);
    coords->t = down.s / (down.s + up.s);
    if (jet != NULL)
        iccp_gradient_encode_jet(chart, &down, &jets[0], &up, &jets[1], jet);
    return ICC_OK;
}

/* ---- Algorithm 8: ICC to Cartesian ---- */

/* Algorithm 8: follows the curve uphill from the boundary point, as a path, and takes the point at
 * the share t of its length. A result outside the domain is an error. It can occur near a boundary
 * that the grid does not resolve. */
static icc_status decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path)
{
    const iccp_gradient_state *state = chart->state;
    double boundary[ICC_MAX_DIM], p[ICC_MAX_DIM], share;
    iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, boundary);
    iccp_gradient_line line;
    const icc_status status = iccp_gradient_up_from(state, coords->facet, boundary, path, &line);
    if (status != ICC_OK)
        return status;
    if (path->n < 2)
        return ICC_ERR_TRACE;
    const size_t piece = iccp_path_find(path, coords->t * iccp_path_length(path), &share);
    iccp_path_point(path, piece, share, p);
    iccp_gradient_to_local(state, p, point);
    if (iccp_domain_locate(chart->domain, point, true, NULL, NULL) == ICC_OUTSIDE)
        return ICC_ERR_TRACE;
    if (jet == NULL)
        return ICC_OK;
    return iccp_gradient_decode_jet(chart, coords, boundary, path, piece, share, jet);
}

/* ---- what Algorithms 7 and 8 lose ---- */

static bool merges_down(const icc_chart *chart, const double *point)
{
    double p[ICC_MAX_DIM];
    iccp_gradient_line line;
    iccp_gradient_to_lattice(chart->state, point, p);
    return iccp_gradient_down(chart->state, p, NULL, NULL, &line) == ICC_OK && line.alone < line.s;
}

static bool merges_up(const icc_chart *chart, const iccp_coords *coords)
{
    double boundary[ICC_MAX_DIM];
    iccp_gradient_line line;
    iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, boundary);
    return iccp_gradient_up_from(chart->state, coords->facet, boundary, NULL, &line) == ICC_OK &&
           line.alone < coords->t * line.s;
}

/* ---- the whole curve ---- */

static icc_status emit_point(const iccp_gradient_state *state, const double *lattice,
                             iccp_emit emit, void *argument)
{
    double local[ICC_MAX_DIM];
    iccp_gradient_to_local(state, lattice, local);
    return emit(argument, local);
}

/* Emits the curve from the boundary up to the point, without the point itself. */
static icc_status trace_below(const iccp_gradient_state *state, const double *p, iccp_path *path,
                              iccp_emit emit, void *argument)
{
    iccp_gradient_line line;
    icc_status status = iccp_gradient_down(state, p, path, NULL, &line);
    for (size_t k = path->n; status == ICC_OK && k-- > 1;)
        status = emit_point(state, iccp_path_at(path, k), emit, argument);
    return status;
}

/* Emits both halves of the curve, from the boundary to the maximum. */
static icc_status trace(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                        const iccp_coords *boundary, iccp_path *path, iccp_emit emit,
                        void *argument)
{
    (void)place;
    const iccp_gradient_state *state = chart->state;
    double p[ICC_MAX_DIM];
    iccp_gradient_line line;
    icc_status status;
    if (boundary != NULL) {
        status = iccp_gradient_up_from(state, boundary->facet, point, path, &line);
    } else {
        iccp_gradient_to_lattice(state, point, p);
        status = trace_below(state, p, path, emit, argument);
        if (status == ICC_OK)
            status = iccp_gradient_up(state, p, path, NULL, &line);
    }
    for (size_t k = 0; status == ICC_OK && k < path->n; ++k)
        status = emit_point(state, iccp_path_at(path, k), emit, argument);
    return status;
}

static void free_state(icc_chart *chart)
{
    iccp_gradient_state *state = chart->state;
    iccp_gradient_state_clear(state);
    iccp_free(&chart->memory, state);
}

static void save(const icc_chart *chart, iccp_blob *w)
{
    const iccp_gradient_state *state = chart->state;
    iccp_chart_parameters_write(&state->parameters, chart->domain->dim,
                                iccp_digest_field(state->field), w);
}

static void save_stages(const icc_chart *chart, iccp_blob *w)
{
    const iccp_gradient_state *state = chart->state;
    uint64_t digest = iccp_digest_field(state->field);
    iccp_gradient_write(state->field, state->chosen, w);
    iccp_blob_u64(w, 1, &digest);
}

/* Makes the chart of a function, which it takes over, also if it fails. The function's grid has a
 * domain. */
static icc_status finish(icc_chart **out, icc_function *field, uint32_t chosen,
                         const iccp_chart_ops *ops, const iccp_env *env)
{
    const icc_tree *tree = field->tree;
    const icc_grid *grid = tree->grid;
    icc_status status = iccp_chart_new(out, grid->domain, env);
    icc_chart *chart = *out;
    iccp_gradient_state *state =
        status == ICC_OK ? iccp_alloc_zero(&env->memory, 1, sizeof *state) : NULL;
    if (state == NULL) {
        iccp_function_release(field);
        iccp_chart_release(chart);
        *out = NULL;
        return ICC_ERR_MEMORY;
    }
    *state =
        (iccp_gradient_state){.tree = iccp_tree_retain(tree), .field = field, .chosen = chosen};
    chart->ops = ops;
    chart->state = state;
    chart->info.method = ICC_METHOD_GRADIENT;
    chart->info.reason = ICC_REASON_GRADIENT;
    chart->info.cells = grid->cells;
    chart->own.gradient.function = field->made.function;
    chart->own.gradient.tree = tree->form;
    chart->own.gradient.n_grid = grid->n_vertices;
    chart->own.gradient.n_inside = grid->n_inside;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 3, 2}, env);
    status = check_tree(chart, tree, &part[0]);
    if (status == ICC_OK)
        status = check_field(chart, field, &part[1]);
    if (status == ICC_OK)
        status = iccp_gradient_meet_boundary(state, &part[2]);
    if (status == ICC_OK) {
        place_maximum(state, chart);
        return ICC_OK;
    }
    iccp_chart_release(chart);
    *out = NULL;
    return status;
}

icc_status iccp_gradient_create_function(icc_chart **out, const icc_function *function,
                                         const iccp_env *env)
{
    icc_function *field;
    *out = NULL;
    const icc_status status = iccp_function_copy(&field, function, env);
    return status == ICC_OK ? finish(out, field, field->tree->root, &iccp_gradient_stages_ops, env)
                            : status;
}

/* Returns true if the order of the axes is not the usual one, so that the first format cannot have
 * it. */
static bool has_axis_order(const icc_chart_options *options, int32_t dim)
{
    for (int32_t k = 0; options->axis_order != NULL && k < dim; ++k)
        if (options->axis_order[k] != k)
            return true;
    return false;
}

static icc_status create(icc_chart **out, const icc_domain *domain,
                         const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    icc_function *field;
    uint32_t chosen = 0;
    icc_chart_timings timings = {0};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){7, 3}, env);
    icc_status status =
        iccp_gradient_stages(&field, &chosen, &timings, domain, options, &part[0], err);
    if (status == ICC_OK)
        status = finish(out, field, chosen,
                        has_axis_order(options, domain->dim) ? &iccp_gradient_stages_ops
                                                             : &iccp_gradient_ops,
                        &part[1]);
    if (status != ICC_OK)
        return status;
    icc_chart *chart = *out;
    iccp_gradient_state *state = chart->state;
    chart->timings.grid = timings.grid;
    chart->timings.tree += timings.tree;
    chart->timings.function += timings.function;
    iccp_chart_parameters_set(&state->parameters, options, options->maximum, domain->dim);
    return ICC_OK;
}

typedef struct gradient_job {
    size_t n;
    icc_chart **out;
    const icc_domain *const *domain;
    const icc_chart_options *options;
} gradient_job;

static icc_status create_chart(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    const gradient_job *job = argument;
    const icc_status status =
        iccp_explain(err, create(&job->out[k], job->domain[k], &job->options[k], env, err));
    if (status != ICC_OK)
        job->out[k] = NULL;
    return status == ICC_OK || job->n < 2 ? status : iccp_fail_side(err, status, (int32_t)k + 1);
}

static icc_status create_charts(size_t n, icc_chart **out, const icc_domain *const *domain,
                                const icc_chart_options *options, const iccp_env *env,
                                icc_error *err)
{
    gradient_job job = {n, out, domain, options};
    const icc_status status = iccp_side_by_side(env, n, create_chart, &job, err);
    for (size_t k = 0; status != ICC_OK && k < n; ++k) {
        iccp_chart_release(out[k]);
        out[k] = NULL;
    }
    return status;
}

static icc_status read_chart(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                             const iccp_env *env, icc_error *err)
{
    iccp_chart_parameters parameters;
    uint64_t wanted, digest = 0;
    *out = NULL;
    icc_status status = iccp_chart_parameters_read(&parameters, domain->dim, &wanted, r);
    if (status != ICC_OK)
        return status;
    parameters.options.maximum = iccp_chart_parameters_maximum(&parameters);
    status = create(out, domain, &parameters.options, env, NULL);
    if (status == ICC_OK) {
        const iccp_gradient_state *state = (*out)->state;
        digest = iccp_digest_field(state->field);
    }
    return iccp_chart_check_rebuilt(out, status, wanted, digest, err);
}

static icc_status read_stages(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                              const iccp_env *env, icc_error *err)
{
    icc_function *field;
    uint32_t chosen;
    uint64_t wanted, digest = 0;
    *out = NULL;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){7, 3}, env);
    icc_status status = iccp_gradient_read(&field, &chosen, domain, r, &part[0]);
    iccp_blob_u64(r, 1, &wanted);
    if (status == ICC_OK && r->status != ICC_OK) {
        iccp_function_release(field);
        status = r->status;
    }
    if (status != ICC_OK)
        return status;
    status = finish(out, field, chosen, &iccp_gradient_stages_ops, &part[1]);
    if (status == ICC_OK)
        digest = iccp_digest_field(field);
    return iccp_chart_check_rebuilt(out, status, wanted, digest, err);
}

static const icc_function *function_of(const icc_chart *chart)
{
    const iccp_gradient_state *state = chart->state;
    return state->field;
}

#define OPERATIONS                                                                                 \
    .number = ICC_METHOD_GRADIENT, .create = create_charts, .encode = encode, .decode = decode,    \
    .trace = trace, .function = function_of, .merges_down = merges_down, .merges_up = merges_up,   \
    .measure = iccp_gradient_measure, .free_state = free_state

const iccp_chart_ops iccp_gradient_ops = {OPERATIONS, .format = ICC_METHOD_GRADIENT,
                                          .read = read_chart, .save = save};

enum { BY_STAGES = 6 };

const iccp_chart_ops iccp_gradient_stages_ops = {OPERATIONS, .format = BY_STAGES, .is_later = true,
                                                 .read = read_stages, .save = save_stages};
