/* Based on: L. Huynh, thesis, 2013, section 5.1, Algorithms 6-8 (Huynh and Gingold, section 4). */
#include "chart/chart_gradient.h"

#include "base/clock.h"
#include "base/error.h"
#include "chart/gradient_measure.h"
#include "field/create.h"
#include "field/critical.h"
#include "field/edges.h"
#include "grid/grassfire.h"
#include "grid/rasterise.h"
#include "tree/verify.h"

#include <math.h>
#include <string.h>

/* ---- Algorithm 6: preprocessing ---- */

static icc_status choose_root(const icc_grid *grid, const icc_domain *domain, const double *maximum,
                              uint32_t *root, const iccp_env *env, icc_error *err)
{
    if (maximum == NULL)
        return iccp_grassfire(grid, root, NULL, env, err);
    double local[2];
    iccp_frame_in(&domain->frame, 2, maximum, local);
    if (iccp_domain_locate(domain, local, true, NULL, NULL) != ICC_INSIDE)
        return iccp_fail(err, ICC_ERR_OUTSIDE, -1, "the maximum (%g, %g) is not inside the domain",
                         maximum[0], maximum[1]);
    *root = iccp_grid_nearest(grid, local);
    return ICC_OK;
}

static icc_status make_tree(iccp_gradient_state *state, icc_chart *chart,
                            const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    icc_grid *grid = NULL;
    const double start = iccp_seconds();
    icc_status status = iccp_grid_create(&grid, chart->domain, options->cells, env, err);
    if (status != ICC_OK)
        return status;
    uint32_t root;
    status = choose_root(grid, chart->domain, options->maximum, &root, env, err);
    const double middle = iccp_seconds();
    chart->info.seconds_grid = middle - start;
    icc_tree_report report = {0};
    if (status == ICC_OK)
        status = iccp_tree_create(&state->tree, grid, root, options->tree, NULL, env, err);
    if (status == ICC_OK)
        status = iccp_tree_verify(state->tree, &report, env);
    chart->info.seconds_tree = iccp_seconds() - middle;
    chart->info.n_grid = grid->n_vertices;
    chart->info.n_inside = grid->n_inside;
    chart->info.n_tree = report.n_inside + report.n_outside;
    chart->info.n_unreachable = report.n_unreachable;
    chart->info.n_cousin_violations = report.n_cousin_violations;
    iccp_grid_release(grid);
    return status;
}

static icc_status make_field(iccp_gradient_state *state, icc_chart *chart,
                             const icc_chart_options *options, const iccp_env *env,
                             icc_error *err)
{
    const double start = iccp_seconds();
    icc_field_report report = {0};
    const icc_field_options function = {.function = options->function,
                                        .constraints = options->constraints,
                                        .solver = options->solver,
                                        .eta = options->eta,
                                        .leaf = options->leaf};
    icc_status status = iccp_field_create(&state->field, state->tree, &function, env, err);
    if (status == ICC_OK)
        status = iccp_field_verify(state->field, &report, env);
    if (status != ICC_OK)
        return status;
    chart->info.n_maxima = report.n_maxima;
    chart->info.n_minima = report.n_minima;
    chart->info.n_saddles = report.n_saddles;
    iccp_field_count_edges(state->field, &chart->info.n_edges, &chart->info.n_compression,
                           &chart->info.n_expansion);
    chart->info.seconds_field = iccp_seconds() - start;
    return ICC_OK;
}

static void place_maximum(iccp_gradient_state *state, icc_chart *chart)
{
    const icc_grid *grid = state->tree->grid;
    const size_t i = state->tree->root % grid->shape[0], j = state->tree->root / grid->shape[0];
    state->root[0] = (double)i;
    state->root[1] = (double)j;
    state->root_reach = chart->domain->tolerance / grid->spacing;
    double local[2];
    iccp_gradient_to_local(state, state->root, local);
    iccp_frame_out(&chart->domain->frame, 2, local, chart->info.maximum);
    chart->info.spacing = grid->spacing * chart->domain->frame.out[0] * chart->domain->frame.out[1];
}

/* ---- Algorithm 7: Cartesian to ICC ---- */

static void coords_of_maximum(iccp_coords *coords)
{
    *coords = (iccp_coords){.facet = 0, .bary = {0.5, 0.5}, .t = 1};
}

static bool at_maximum(const iccp_gradient_state *state, const double p[2])
{
    return fabs(p[0] - state->root[0]) <= state->root_reach &&
           fabs(p[1] - state->root[1]) <= state->root_reach;
}

/* d t = (d down * up - down * d up) / length^2, and d along = dq . (b - a) / |b - a|^2. */
static void fill_encode_jet(const iccp_gradient_state *state, const iccp_fence_hit *hit,
                            const iccp_jet2 *down, double s_down, const iccp_jet2 *up, double s_up,
                            iccp_encode_jet *jet)
{
    const iccp_fence *fence = &state->fence;
    const double *a = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)hit->facet];
    const double *b = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)hit->facet + 1];
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double length = s_down + s_up, scale = 1 / state->tree->grid->spacing;
    for (int c = 0; c < 2; ++c) {
        const double along = (down->x[c] * dx + down->y[c] * dy) / (dx * dx + dy * dy) * scale;
        jet->bary[c] = -along;
        jet->bary[2 + c] = along;
        jet->t[c] = (down->s[c] * s_up - s_down * up->s[c]) / (length * length) * scale;
    }
}

static icc_status encode(const icc_chart *chart, const double *point, iccp_coords *coords,
                         iccp_encode_jet *jet, iccp_path *path)
{
    (void)path;
    const iccp_gradient_state *state = chart->state;
    const int32_t where =
        iccp_domain_locate(chart->domain, point, true, &coords->facet, coords->bary);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    coords->t = 0;
    if (where == ICC_BOUNDARY)
        return jet == NULL ? ICC_OK : ICC_ERR_TRACE;
    double p[2];
    iccp_gradient_to_lattice(state, point, p);
    if (at_maximum(state, p)) {
        coords_of_maximum(coords);
        return jet == NULL ? ICC_OK : ICC_ERR_TRACE;
    }
    static const iccp_jet2 identity = {{1, 0}, {0, 1}, {0, 0}};
    iccp_jet2 jets[2] = {identity, identity};
    iccp_walk2 down, up;
    iccp_fence_hit hit;
    icc_status status = iccp_walk2_start(&down, state->field, ICCP_DOWNHILL, p[0], p[1],
                                         jet != NULL ? &jets[0] : NULL);
    if (status == ICC_OK)
        status = iccp_trace_downhill(&down, &state->fence, NULL, &hit);
    if (status == ICC_OK)
        status = iccp_walk2_start(&up, state->field, ICCP_UPHILL, p[0], p[1],
                                  jet != NULL ? &jets[1] : NULL);
    if (status == ICC_OK)
        status = iccp_trace_uphill(&up, NULL, NULL);
    if (status != ICC_OK)
        return status;
    *coords = (iccp_coords){.facet = hit.facet, .bary = {1 - hit.along, hit.along}};
    coords->t = down.s / (down.s + up.s);
    if (jet != NULL)
        fill_encode_jet(state, &hit, &jets[0], down.s, &jets[1], up.s, jet);
    return ICC_OK;
}

/* ---- Algorithm 8: ICC to Cartesian ---- */

/* The derivative by the boundary parameter needs the walk up to the piece that holds the point, and the
 * whole length's: walk again with a jet. The path tells how far. */
static icc_status fill_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                                  const double boundary[2], const iccp_path *path, size_t piece,
                                  double share, iccp_decode_jet *jet)
{
    const iccp_gradient_state *state = chart->state;
    const uint32_t *ends = chart->domain->facets + 2 * (size_t)coords->facet;
    const double *from = state->fence.vertices + 2 * (size_t)ends[0];
    const double *to = state->fence.vertices + 2 * (size_t)ends[1];
    iccp_jet2 moving = {{to[0] - from[0], 0}, {to[1] - from[1], 0}, {0, 0}};
    iccp_jet2 before = moving, after = moving;
    iccp_walk2 walk;
    icc_status status = iccp_gradient_depart(chart, coords->facet, boundary, &walk, &moving);
    for (size_t k = 0; status == ICC_OK && k + 1 < path->n; ++k) {
        if (k == piece)
            before = moving;
        status = iccp_walk2_step(&walk);
        if (k == piece)
            after = moving;
    }
    if (status != ICC_OK)
        return status;
    const double *a = iccp_path_at(path, piece), *b = iccp_path_at(path, piece + 1);
    const double length = b[2] - a[2], total = iccp_path_length(path);
    const double ds = coords->t * moving.s[0] - before.s[0] - share * (after.s[0] - before.s[0]);
    const double ux = (b[0] - a[0]) / length, uy = (b[1] - a[1]) / length;
    const double h = state->tree->grid->spacing;
    *jet = (iccp_decode_jet){.t = {h * total * ux, h * total * uy}};
    jet->bary[1] = h * (before.x[0] + share * (after.x[0] - before.x[0]) + ds * ux);
    jet->bary[3] = h * (before.y[0] + share * (after.y[0] - before.y[0]) + ds * uy);
    return ICC_OK;
}

static icc_status decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path)
{
    const iccp_gradient_state *state = chart->state;
    double boundary[2];
    iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, boundary);
    if (jet != NULL && (coords->t <= 0 || coords->t >= 1))
        return ICC_ERR_TRACE;
    if (coords->t >= 1) {
        iccp_gradient_to_local(state, state->root, point);
        return ICC_OK;
    }
    memcpy(point, boundary, sizeof boundary);
    if (coords->t <= 0)
        return ICC_OK;
    iccp_walk2 walk;
    icc_status status = iccp_gradient_depart(chart, coords->facet, boundary, &walk, NULL);
    if (status == ICC_OK)
        status = iccp_trace_uphill(&walk, path, NULL);
    if (status != ICC_OK)
        return status;
    if (path->n < 2)
        return ICC_ERR_TRACE;
    double share, p[2];
    const size_t piece = iccp_path_find(path, coords->t * iccp_path_length(path), &share);
    iccp_path_point(path, piece, share, p);
    iccp_gradient_to_local(state, p, point);
    if (iccp_domain_locate(chart->domain, point, true, NULL, NULL) == ICC_OUTSIDE)
        return ICC_ERR_TRACE;
    if (jet == NULL)
        return ICC_OK;
    return fill_decode_jet(chart, coords, boundary, path, piece, share, jet);
}

/* ---- the whole curve ---- */

static icc_status emit_point(const iccp_gradient_state *state, const double *lattice,
                             iccp_emit emit, void *argument)
{
    double local[2];
    iccp_gradient_to_local(state, lattice, local);
    return emit(argument, local);
}

/* From the boundary up to the point, the point itself left out. */
static icc_status trace_below(const icc_chart *chart, const double p[2], iccp_path *path,
                              iccp_emit emit, void *argument)
{
    const iccp_gradient_state *state = chart->state;
    iccp_walk2 walk;
    iccp_fence_hit hit;
    icc_status status = iccp_walk2_start(&walk, state->field, ICCP_DOWNHILL, p[0], p[1], NULL);
    if (status == ICC_OK)
        status = iccp_trace_downhill(&walk, &state->fence, path, &hit);
    for (size_t k = path->n; status == ICC_OK && k-- > 1;)
        status = emit_point(state, iccp_path_at(path, k), emit, argument);
    return status;
}

static icc_status trace(const icc_chart *chart, const double *point, iccp_path *path,
                        iccp_emit emit, void *argument)
{
    const iccp_gradient_state *state = chart->state;
    uint32_t facet;
    double bary[2];
    const int32_t where = iccp_domain_locate(chart->domain, point, true, &facet, bary);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    double p[2];
    iccp_gradient_to_lattice(state, point, p);
    if (at_maximum(state, p))
        return emit(argument, point);
    iccp_walk2 walk;
    icc_status status = ICC_OK;
    if (where == ICC_BOUNDARY)
        status = iccp_gradient_depart(chart, facet, point, &walk, NULL);
    else
        status = trace_below(chart, p, path, emit, argument);
    if (status == ICC_OK && where == ICC_INSIDE)
        status = iccp_walk2_start(&walk, state->field, ICCP_UPHILL, p[0], p[1], NULL);
    if (status == ICC_OK)
        status = iccp_trace_uphill(&walk, path, NULL);
    for (size_t k = 0; status == ICC_OK && k < path->n; ++k)
        status = emit_point(state, iccp_path_at(path, k), emit, argument);
    return status;
}

static void free_state(icc_chart *chart)
{
    iccp_gradient_state *state = chart->state;
    iccp_fence_free(&state->fence);
    iccp_field_release(state->field);
    iccp_tree_release(state->tree);
    iccp_free(&chart->memory, state);
}

static const iccp_chart_ops OPS = {encode, decode, trace, iccp_gradient_measure, free_state};

icc_status iccp_chart_gradient_create(icc_chart **out, const icc_domain *domain,
                                      const icc_chart_options *options, const iccp_env *env,
                                      icc_error *err)
{
    icc_status status = iccp_chart_new(out, domain, env);
    if (status != ICC_OK)
        return status;
    icc_chart *chart = *out;
    chart->ops = &OPS;
    chart->info.method = ICC_METHOD_GRADIENT;
    chart->info.function = options->function;
    chart->info.tree = options->tree;
    iccp_gradient_state *state = iccp_alloc_zero(&env->memory, 1, sizeof *state);
    chart->state = state;
    status = state != NULL ? make_tree(state, chart, options, env, err) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = make_field(state, chart, options, env, err);
    if (status == ICC_OK)
        status = iccp_fence_create(&state->fence, domain, state->tree->grid, env);
    if (status == ICC_OK) {
        place_maximum(state, chart);
        return ICC_OK;
    }
    iccp_chart_release(chart);
    *out = NULL;
    return status;
}
