/* Creates charts of method field: grid, tree, function, vectors, certificate.
 *
 * Source of grid, tree and function: Huynh and Gingold, Bijective Deformations in R^n via Integral
 * Curve Coordinates. Their curves follow the function's gradient and merge. Here the curves follow
 * the field of docs/theory/charts-space.md, "fields on grids", instead. */
#include "field/chart_field.h"

#include "base/budget.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/minmax.h"
#include "field/field_certificate.h"
#include "field/field_charts.h"
#include "field/field_measure.h"
#include "field/field_state.h"
#include "gradient/function/critical_points.h"
#include "gradient/function/make_function.h"
#include "gradient/grid/grassfire.h"
#include "gradient/grid/rasterise.h"
#include "gradient/tree/grow.h"
#include "gradient/tree/verify.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

enum { SWEEPS = 2 };

/* The largest share of the inside vertices that may be given up so that the others form a ball. */
static const double MOST_LOST = 0.05;

/* The most vertices of a grid with half the spacing. It takes about 1 GB in 3-D. */
static const size_t MOST_REFINED = (size_t)1 << 24;

/* Sizes of the grid if the caller leaves the number of cells open. About PLANE_BUDGET vertices
 * lie inside in 2-D, or INSIDE_BUDGET in other dimensions, and at most BUDGET in all. So thin
 * shapes get smaller cells. This is enough for real surfaces (bench_field), and takes 0.2 s and
 * 40 MB in 3-D. */
static const double PLANE_BUDGET = 16384, INSIDE_BUDGET = 65536, BUDGET = 4194304;

/* Another grid is tried if at most one contact in FEW_CONTACTS is not inward. On the real
 * surfaces that can be certified at all, the default grid had at most one such contact in 2,800. */
enum { FEW_CONTACTS = 1000 };

static int32_t choose_cells(const icc_domain *domain, int32_t cells)
{
    enum { FEWEST = 8 };
    if (cells > 0 || domain->mask != NULL)
        return cells;
    double longest = 0, box = 1;
    for (int32_t k = 0; k < domain->dim; ++k)
        longest = iccp_max(longest, domain->upper[k] - domain->lower[k]);
    for (int32_t k = 0; k < domain->dim; ++k)
        box *= (domain->upper[k] - domain->lower[k]) / longest;
    const double share = fabs(domain->measure) / iccp_power(longest, (size_t)domain->dim);
    const double inside = domain->dim == 2 ? PLANE_BUDGET : INSIDE_BUDGET;
    const double n = iccp_min(iccp_pow(inside / share, 1.0 / domain->dim),
                              iccp_pow(BUDGET / box, 1.0 / domain->dim));
    return (int32_t)iccp_min(iccp_max(ceil(n), FEWEST), ICCP_MAX_CELLS);
}

static icc_status choose_root(const icc_grid *grid, const double *maximum, uint32_t *root,
                              const iccp_env *env, icc_error *err)
{
    if (maximum == NULL)
        return iccp_grassfire(grid, root, NULL, env, err);
    *root = iccp_grid_nearest(grid, maximum);
    return ICC_OK;
}

/* The order of the tree makes the vertices that it reaches a ball. iccp_tree_create_ranked() may
 * give up a few vertices for that. Fails with ICC_ERR_TOPOLOGY if too many would be lost. */
static icc_status make_tree_on(iccp_field_state *state, icc_chart *chart, int32_t cells,
                               const double *maximum, const iccp_env *env, icc_error *err)
{
    icc_grid *grid;
    uint32_t root = 0;
    icc_grow_report grown = {0};
    icc_tree_report report = {0};
    double start = iccp_seconds();
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){2, 1, 4, 1}, env);
    icc_status status = iccp_grid_create(&grid, chart->domain, cells, &part[0], err);
    if (status != ICC_OK)
        return status;
    chart->own.field.n_grid = grid->n_vertices;
    chart->info.cells = grid->cells;
    status = choose_root(grid, maximum, &root, &part[1], err);
    chart->timings.grid += iccp_seconds() - start;
    start = iccp_seconds();
    uint32_t *rank = iccp_alloc(&env->memory, grid->n_vertices, sizeof *rank);
    if (status == ICC_OK && rank == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_tree_create_ranked(&state->tree, grid, root, ICC_TREE_THESIS, NULL, MOST_LOST,
                                         rank, &grown, &part[2], err);
    if (status == ICC_OK)
        status = iccp_tree_verify(state->tree, &report, &part[3]);
    iccp_free(&env->memory, rank);
    iccp_grid_release(grid);
    chart->timings.tree += iccp_seconds() - start;
    chart->own.field.n_tree = report.n_inside + report.n_outside;
    chart->own.field.n_unreachable = report.n_unreachable;
    chart->own.field.n_cousin_violations = report.n_cousin_violations;
    return status;
}

/* If the inside vertices do not form a ball, the grid is refined once. The usual cause is a gap
 * that is thinner than the grid. */
static icc_status make_tree(iccp_field_state *state, icc_chart *chart,
                            const icc_chart_options *options, const double *maximum,
                            const iccp_env *env, icc_error *err)
{
    const int32_t cells = choose_cells(chart->domain, options->cells);
    const iccp_env first = iccp_part(env, NULL, 0, 0.8), again = iccp_part(env, NULL, 0.8, 1);
    const icc_status status = make_tree_on(state, chart, cells, maximum, &first, err);
    if (status != ICC_ERR_TOPOLOGY || chart->own.field.n_grid > MOST_REFINED >> chart->domain->dim)
        return status;
    iccp_log(env,
             "field: no order of the vertices of %d cells has one critical vertex; %d are tried",
             (int)chart->info.cells, (int)(2 * chart->info.cells));
    return make_tree_on(state, chart, 2 * chart->info.cells, maximum, &again, err);
}

/* Solves Laplace's equation on the tree, without inequalities. They are not needed, because the
 * vectors are made to rise along any function. */
static icc_status make_field(iccp_field_state *state, icc_chart *chart,
                             const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    icc_function_report report = {0};
    const icc_function_options function = {.function = ICC_FUNCTION_LAPLACE,
                                           .constraints = ICC_CONSTRAINTS_NONE,
                                           .solver = options->solver};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){5, 1}, env);
    icc_status status = iccp_function_create(&state->field, state->tree, &function, &part[0], err);
    if (status == ICC_OK)
        status = iccp_function_verify(state->field, &report, &part[1]);
    chart->own.field.n_maxima = report.n_maxima;
    chart->own.field.n_minima = report.n_minima;
    chart->own.field.n_saddles = report.n_saddles;
    chart->timings.function = iccp_seconds() - start;
    return status;
}

/* Approximate number of multiplications for each simplex at a vertex. */
static const double VECTOR_WORK = 20;

/* Makes the vectors from the function in three steps. It finds the simplices that meet the
 * domain. It extends the values to all their vertices. Then it chooses at each vertex a vector
 * along which these values rise. */
static icc_status make_vectors(iccp_field_state *state, icc_chart *chart, const iccp_env *env,
                               icc_error *err)
{
    const double start = iccp_seconds();
    iccp_extension extension = {.memory = env->memory};
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 2, 4}, env);
    icc_status status =
        iccp_incidence_create(&state->incidence, chart->domain, state->tree->grid, &part[0]);
    if (status == ICC_ERR_RESOLUTION)
        (void)iccp_fail(err, status, "the facets meet too many cells of the grid: use fewer");
    if (status == ICC_OK)
        status =
            iccp_extension_create(&extension, state->field, &state->incidence, SWEEPS, &part[1]);
    if (status == ICC_OK)
        status = iccp_vectors_create(&state->vectors, &extension, &state->incidence, &part[2]);
    iccp_incidence_trim(&state->incidence);
    iccp_extension_free(&extension);
    chart->timings.solve = iccp_seconds() - start;
    return status;
}

/* Finishes a chart that has its vectors: sets the root's place and the bound on the steps of a
 * curve, and certifies the chart. */
static void finish(iccp_field_state *state, icc_chart *chart)
{
    const icc_grid *grid = state->tree->grid;
    const int32_t dim = grid->dim;
    double root[ICC_MAX_DIM];
    size_t steps = 1000;
    for (int32_t k = 0; k < dim; ++k) {
        root[k] =
            grid->origin[k] + grid->spacing * iccp_grid_coordinate(grid, state->tree->root, k);
        steps += 200 * grid->shape[k];
    }
    state->flow = (iccp_flow){.grid = grid,
                              .domain = chart->domain,
                              .incidence = &state->incidence,
                              .vectors = &state->vectors,
                              .root = state->tree->root,
                              .most_steps = steps};
    iccp_chart_set_maximum(chart, root);
    chart->info.spacing = grid->spacing * chart->domain->frame.out[0] * chart->domain->frame.out[1];
    chart->own.field.n_inside = grid->n_inside;
    iccp_field_certify(state, chart);
}

static void free_state(icc_chart *chart)
{
    iccp_field_state *state = chart->state;
    iccp_vectors_free(&state->vectors);
    iccp_incidence_free(&state->incidence);
    iccp_function_release(state->field);
    iccp_tree_release(state->tree);
    iccp_free(&chart->memory, state);
}

static icc_status measure(const icc_chart *chart, size_t n_points, icc_chart_report *measures,
                          const iccp_env *env)
{
    const iccp_field_state *state = chart->state;
    if (chart->info.certified)
        return ICC_OK;
    return iccp_field_measure(chart, &state->flow, n_points, measures, env);
}

/* Digest of the vectors and of the function that they were made from. */
static uint64_t digest_of(const icc_chart *chart)
{
    const iccp_field_state *state = chart->state;
    const iccp_sectors *sectors = &state->vectors.sectors;
    const size_t dim = (size_t)chart->domain->dim, n = state->tree->grid->n_vertices;
    uint64_t digest = iccp_digest_field(state->field);
    digest = iccp_digest_f32(digest, dim * n, state->vectors.vector);
    digest = iccp_digest_u32(digest, sectors->n, sectors->vertex);
    return iccp_digest_f32(digest, dim * sectors->n_vectors, sectors->vector);
}

static void save(const icc_chart *chart, iccp_blob *w)
{
    const iccp_field_state *state = chart->state;
    iccp_chart_parameters_write(&state->parameters, chart->domain->dim, digest_of(chart), w);
}

static const icc_function *function_of(const icc_chart *chart)
{
    const iccp_field_state *state = chart->state;
    return state->field;
}

const iccp_chart_ops iccp_field_ops = {
    .number = ICC_METHOD_FIELD,
    .format = ICC_METHOD_FIELD,
    .create = iccp_field_charts_create,
    .read = iccp_chart_field_read,
    .locate = iccp_field_locate,
    .encode = iccp_field_encode,
    .decode = iccp_field_decode,
    .encode_many = iccp_field_encode_many,
    .decode_many = iccp_field_decode_many,
    .trace = iccp_field_trace,
    .function = function_of,
    .measure = measure,
    .save = save,
    .free_state = free_state,
};

icc_status iccp_chart_field_create(icc_chart **out, const icc_domain *domain,
                                   const icc_chart_options *options, const double *maximum,
                                   const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_chart_new(out, domain, env);
    if (status != ICC_OK)
        return status;
    icc_chart *chart = *out;
    chart->ops = &iccp_field_ops;
    chart->info.method = ICC_METHOD_FIELD;
    iccp_field_state *state = iccp_alloc_zero(&env->memory, 1, sizeof *state);
    chart->state = state;
    status = ICC_ERR_MEMORY;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){2, 3, 3}, env);
    if (state != NULL) {
        state->incidence.memory = state->vectors.memory = state->vectors.sectors.memory =
            env->memory;
        status = make_tree(state, chart, options, maximum, &part[0], err);
    }
    if (status == ICC_OK)
        status = make_field(state, chart, options, &part[1], err);
    if (status == ICC_OK)
        status = iccp_budget_work(env, VECTOR_WORK * (double)chart->own.field.n_grid *
                                           iccp_simplices_at_vertex(domain->dim));
    if (status == ICC_OK)
        status = make_vectors(state, chart, &part[2], err);
    if (status == ICC_OK) {
        finish(state, chart);
        iccp_chart_parameters_set(&state->parameters, options, maximum, domain->dim);
        return ICC_OK;
    }
    iccp_chart_release(chart);
    *out = NULL;
    return status;
}

bool iccp_chart_field_is_unlucky(const icc_chart *chart)
{
    const icc_field_info *own = &chart->own.field;
    const bool few = own->n_not_inward <= own->n_contacts / FEW_CONTACTS;
    return (chart->info.reason == ICC_REASON_STRAY ||
            (chart->info.reason == ICC_REASON_NOT_INWARD && few)) &&
           chart->domain->mask == NULL && chart->info.cells < ICCP_MAX_CELLS / 2;
}

/* Makes a chart with another number of cells. `*out` is NULL if it is not certified. */
static icc_status try_cells(icc_chart **out, const icc_chart *chart, int32_t cells,
                            const iccp_env *env)
{
    const iccp_field_state *state = chart->state;
    icc_chart_options options = state->parameters.options;
    options.cells = cells;
    iccp_log(env,
             "field: %zu vertices were given up, %zu contacts are not inward at %ld cells; %ld "
             "are tried",
             chart->own.field.n_stray, chart->own.field.n_not_inward, (long)chart->info.cells,
             (long)cells);
    const icc_status status = iccp_chart_field_create(
        out, chart->domain, &options, iccp_chart_parameters_maximum(&state->parameters), env, NULL);
    if (*out != NULL && !(*out)->info.certified) {
        iccp_chart_release(*out);
        *out = NULL;
    }
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ? status : ICC_OK;
}

/* A number of cells that the caller chose changes only by one. An open number grows by up to a
 * half, which is less than four times as many vertices in space. */
icc_status iccp_chart_field_shift(icc_chart **out, const icc_chart *chart, const iccp_env *env)
{
    const iccp_field_state *state = chart->state;
    const int32_t cells = chart->info.cells;
    const int32_t tried[] = {cells + 1, cells + cells / 4, cells + cells / 2,
                             cells + cells / 2 + 1};
    const bool is_open =
        state->parameters.options.cells == 0 && chart->own.field.n_grid <= MOST_REFINED / 4;
    const size_t n = is_open ? sizeof tried / sizeof *tried : 1;
    icc_status status = ICC_OK;
    *out = NULL;
    for (size_t i = 0; i < n && status == ICC_OK && *out == NULL; ++i)
        status = try_cells(out, chart, tried[i], env);
    return status;
}

icc_status iccp_chart_field_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                 const iccp_env *env, icc_error *err)
{
    iccp_chart_parameters parameters;
    uint64_t wanted;
    *out = NULL;
    icc_status status = iccp_chart_parameters_read(&parameters, domain->dim, &wanted, r);
    if (status != ICC_OK)
        return status;
    status = iccp_chart_field_create(out, domain, &parameters.options,
                                     iccp_chart_parameters_maximum(&parameters), env, NULL);
    return iccp_chart_check_rebuilt(out, status, wanted, status == ICC_OK ? digest_of(*out) : 0,
                                    err);
}
