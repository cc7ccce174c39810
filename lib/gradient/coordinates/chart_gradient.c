/* Charts of method gradient. Based on: L. Huynh, thesis, 2013, section 5.1, Algorithms 6-8 (Huynh
 * and Gingold, section 4). The code is the same in any dimension; gradient_line.h walks along the
 * curves. */
#include "gradient/coordinates/chart_gradient.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/threads.h"
#include "gradient/coordinates/gradient_boundary.h"
#include "gradient/coordinates/gradient_jet.h"
#include "gradient/coordinates/gradient_measure.h"
#include "gradient/function/critical_points.h"
#include "gradient/function/make_function.h"
#include "gradient/function/merging.h"
#include "gradient/function/move_maximum.h"
#include "gradient/grid/grassfire.h"
#include "gradient/grid/rasterise.h"
#include "gradient/tree/verify.h"

#include <math.h>
#include <string.h>

/* ---- Algorithm 6: preprocessing ---- */

static icc_status choose_root(const icc_grid *grid, const icc_domain *domain, const double *maximum,
                              uint32_t *root, const iccp_env *env, icc_error *err)
{
    if (maximum == NULL)
        return iccp_grassfire(grid, root, NULL, env, err);
    double local[ICC_MAX_DIM];
    iccp_frame_in(&domain->frame, domain->dim, maximum, local);
    if (iccp_domain_locate(domain, local, true, NULL, NULL) != ICC_INSIDE)
        return iccp_fail(err, ICC_ERR_OUTSIDE, "the maximum is not inside the domain");
    *root = iccp_grid_nearest(grid, local);
    return ICC_OK;
}

enum { PAPERS_CELLS = 50 };

/* Masks determine the number of cells themselves. */
static int32_t choose_cells(const icc_domain *domain, int32_t cells)
{
    return cells > 0 || domain->mask != NULL ? cells : PAPERS_CELLS;
}

/* Grows a tree, which replaces the present one, if any. */
static icc_status grow_tree(iccp_gradient_state *state, icc_chart *chart, const icc_grid *grid,
                            uint32_t root, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    icc_tree_report report = {0};
    icc_tree *tree = NULL;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){4, 1}, env);
    icc_status status =
        iccp_tree_create(&tree, grid, root, chart->own.gradient.tree, NULL, &part[0], err);
    if (status != ICC_OK)
        return status;
    iccp_tree_release(state->tree);
    state->tree = tree;
    status = iccp_tree_verify(tree, &report, &part[1]);
    chart->timings.tree += iccp_seconds() - start;
    chart->own.gradient.n_tree = report.n_inside + report.n_outside;
    chart->own.gradient.n_unreachable = report.n_unreachable;
    chart->own.gradient.n_cousin_violations = report.n_cousin_violations;
    return status;
}

/* Algorithms 1 and 2: makes the grid, finds the grassfire's maximum unless the caller gave one, and
 * grows the tree. */
static icc_status make_tree(iccp_gradient_state *state, icc_chart *chart,
                            const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    icc_grid *grid = NULL;
    const double start = iccp_seconds();
    const int32_t cells = choose_cells(chart->domain, options->cells);
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){3, 1, 5}, env);
    icc_status status = iccp_grid_create(&grid, chart->domain, cells, &part[0], err);
    if (status != ICC_OK)
        return status;
    status = choose_root(grid, chart->domain, options->maximum, &state->chosen, &part[1], err);
    chart->timings.grid = iccp_seconds() - start;
    if (status == ICC_OK)
        status = grow_tree(state, chart, grid, state->chosen, &part[2], err);
    chart->info.cells = grid->cells;
    chart->own.gradient.n_grid = grid->n_vertices;
    chart->own.gradient.n_inside = grid->n_inside;
    iccp_grid_release(grid);
    return status;
}

/* Makes a function without inequalities on a tree with another root. */
static icc_status move_root(iccp_gradient_state *state, icc_chart *chart, uint32_t root,
                            const icc_function_options *function, const iccp_env *env,
                            icc_error *err)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    const icc_status status = grow_tree(state, chart, state->tree->grid, root, &part[0], err);
    iccp_function_release(state->field);
    state->field = NULL;
    return status == ICC_OK
               ? iccp_function_create(&state->field, state->tree, function, &part[1], err)
               : status;
}

/* Makes a plate (bi-Laplace) function. A plate is highest beside a load that is not in its middle,
 * and curves would end there instead of at the root. Without inequalities, the root moves to where
 * it is the maximum. If the function then still has false critical points, inequalities are imposed
 * at the root that the caller asked for. */
static icc_status make_plate(iccp_gradient_state *state, icc_chart *chart,
                             const icc_function_options *options, const iccp_env *env,
                             icc_error *err)
{
    icc_function_options function = *options;
    bool enough = options->constraints == ICC_CONSTRAINTS_NONE;
    function.constraints = ICC_CONSTRAINTS_NONE;
    iccp_env part[5];
    iccp_split(part, 5, (const double[]){4, 4, 3, 1, enough ? 0 : 8}, env);
    icc_status status = iccp_function_create(&state->field, state->tree, &function, &part[0], err);
    if (status == ICC_OK && state->field->info.beside) {
        uint32_t maximum = 0;
        status = iccp_function_move_maximum(state->field, &maximum, &part[1]);
        if (status == ICC_OK)
            status = move_root(state, chart, maximum, &function, &part[2], err);
    }
    if (status == ICC_OK && !enough)
        status = iccp_function_is_regular(state->field, &enough, &part[3]);
    if (status != ICC_OK || enough)
        return status;
    function.constraints = ICC_CONSTRAINTS_ALL;
    return move_root(state, chart, state->chosen, &function, &part[4], err);
}

/* Section 5.2: makes the function on the tree with the given options; plates are a special case.
 * Then checks it for false critical points, and extends it to vertices that no tree reaches. */
static icc_status make_field(iccp_gradient_state *state, icc_chart *chart,
                             const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds(), grown = chart->timings.tree;
    icc_function_report report = {0};
    iccp_facet_count count = {0};
    const icc_function_options function = {.function = options->function,
                                           .constraints = options->constraints,
                                           .solver = options->solver,
                                           .min_fall = options->min_fall,
                                           .leaf_min = options->leaf_min};
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){8, 2, 1, 1}, env);
    const bool is_plate =
        options->function == ICC_FUNCTION_BILAPLACE || options->function == ICC_FUNCTION_CLAMPED;
    icc_status status =
        is_plate && options->constraints != ICC_CONSTRAINTS_ALL
            ? make_plate(state, chart, &function, &part[0], err)
            : iccp_function_create(&state->field, state->tree, &function, &part[0], err);
    if (status == ICC_OK)
        status = iccp_function_verify(state->field, &report, &part[1]);
    if (status != ICC_OK)
        return status;
    chart->own.gradient.n_maxima = report.n_maxima;
    chart->own.gradient.n_minima = report.n_minima;
    chart->own.gradient.n_saddles = report.n_saddles;
    status = iccp_gradient_extend(state->field, &part[2]);
    if (status == ICC_OK)
        status = iccp_function_facets(state->field, 0, NULL, NULL, &count, &part[3]);
    chart->own.gradient.n_edges = count.n_tested;
    chart->own.gradient.n_compression = count.n_compression;
    chart->own.gradient.n_expansion = count.n_expansion;
    chart->timings.function = iccp_seconds() - start - (chart->timings.tree - grown);
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

static icc_status create(icc_chart **out, const icc_domain *domain,
                         const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_chart_new(out, domain, env);
    if (status != ICC_OK)
        return status;
    icc_chart *chart = *out;
    chart->ops = &iccp_gradient_ops;
    chart->info.method = ICC_METHOD_GRADIENT;
    chart->info.reason = ICC_REASON_GRADIENT;
    chart->own.gradient.function = options->function;
    chart->own.gradient.tree = options->tree;
    iccp_gradient_state *state = iccp_alloc_zero(&env->memory, 1, sizeof *state);
    chart->state = state;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){2, 2, 1}, env);
    status = state != NULL ? make_tree(state, chart, options, &part[0], err) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = make_field(state, chart, options, &part[1], err);
    if (status == ICC_OK)
        status = iccp_gradient_meet_boundary(state, &part[2]);
    if (status == ICC_OK) {
        place_maximum(state, chart);
        iccp_chart_parameters_set(&state->parameters, options, options->maximum, domain->dim);
        return ICC_OK;
    }
    iccp_chart_release(chart);
    *out = NULL;
    return status;
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

static const icc_function *function_of(const icc_chart *chart)
{
    const iccp_gradient_state *state = chart->state;
    return state->field;
}

const iccp_chart_ops iccp_gradient_ops = {
    .number = ICC_METHOD_GRADIENT,
    .format = ICC_METHOD_GRADIENT,
    .create = create_charts,
    .read = read_chart,
    .encode = encode,
    .decode = decode,
    .trace = trace,
    .function = function_of,
    .merges_down = merges_down,
    .merges_up = merges_up,
    .measure = iccp_gradient_measure,
    .save = save,
    .free_state = free_state,
};
