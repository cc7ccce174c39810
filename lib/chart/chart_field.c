/* Based on: Huynh and Gingold, Bijective Deformations in R^n via Integral Curve Coordinates, for grid, tree
 * and function; the curves follow the field of docs/theory.md, fields on grids, instead of the
 * function's gradient, whose curves merge. */
#include "chart/chart_field.h"

#include "base/clock.h"
#include "base/error.h"
#include "chart/field_measure.h"
#include "chart/recipe.h"
#include "field/cones.h"
#include "field/create.h"
#include "field/critical.h"
#include "grid/grassfire.h"
#include "grid/rasterise.h"
#include "trace/flow_follow.h"
#include "trace/flow_jet.h"
#include "tree/settle.h"
#include "tree/verify.h"

#include <math.h>
#include <string.h>

enum { SWEEPS = 2 };

/* Share of the vertices inside that may be given up so that the others form a ball. */
static const double MOST_LOST = 0.05;

/* Vertices that a grid of half the spacing may have: 1 GB or so in 3-D. */
static const size_t MOST_REFINED = (size_t)1 << 24;

typedef struct field_state {
    iccp_recipe recipe;
    icc_tree *tree;
    icc_field *field;
    iccp_cover cover;
    iccp_cones cones;
    iccp_flow flow;
    double root[ICC_MAX_DIM]; /* local */
} field_state;

/* ---- making it ---- */

/* Vertices inside, about, and in all at most, where the caller leaves the number of cells open: thin shapes get
 * smaller cells. Enough for real surfaces (bench_field); 0.2 s and 40 MB in 3-D. */
static const double PLANE_BUDGET = 16384, INSIDE_BUDGET = 65536, BUDGET = 4194304;

static int32_t choose_cells(const icc_domain *domain, int32_t cells)
{
    enum { FEWEST = 8, MOST = 16384 };
    if (cells > 0 || domain->mask != NULL)
        return cells;
    double longest = 0, box = 1;
    for (int32_t k = 0; k < domain->dim; ++k)
        longest = fmax(longest, domain->upper[k] - domain->lower[k]);
    for (int32_t k = 0; k < domain->dim; ++k)
        box *= (domain->upper[k] - domain->lower[k]) / longest;
    const double share = fabs(domain->measure) / pow(longest, domain->dim);
    const double inside = domain->dim == 2 ? PLANE_BUDGET : INSIDE_BUDGET;
    const double n = fmin(pow(inside / share, 1.0 / domain->dim),
                          pow(BUDGET / box, 1.0 / domain->dim));
    return (int32_t)fmin(fmax(ceil(n), FEWEST), MOST);
}

static icc_status choose_root(const icc_grid *grid, const double *maximum, uint32_t *root,
                              const iccp_env *env, icc_error *err)
{
    if (maximum == NULL)
        return iccp_grassfire(grid, root, NULL, env, err);
    *root = iccp_grid_nearest(grid, maximum);
    return ICC_OK;
}

static icc_status make_tree_on(field_state *state, icc_chart *chart, int32_t cells,
                               const double *maximum, const iccp_env *env, icc_error *err)
{
    icc_grid *grid;
    uint32_t root = 0;
    icc_grow_report grown = {0};
    icc_tree_report report = {0};
    double start = iccp_seconds();
    icc_status status = iccp_grid_create(&grid, chart->domain, cells, env, err);
    if (status != ICC_OK)
        return status;
    chart->info.n_grid = grid->n_vertices;
    chart->info.cells = grid->cells;
    status = choose_root(grid, maximum, &root, env, err);
    chart->info.seconds_grid += iccp_seconds() - start;
    start = iccp_seconds();
    uint32_t *rank = iccp_alloc(&env->memory, grid->n_vertices, sizeof *rank);
    if (status == ICC_OK && rank == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_tree_settle(&state->tree, grid, root, ICC_TREE_THESIS, NULL, MOST_LOST, rank,
                                  &grown, env, err);
    if (status == ICC_OK)
        status = iccp_tree_verify(state->tree, &report, env);
    iccp_free(&env->memory, rank);
    iccp_grid_release(grid);
    chart->info.seconds_tree += iccp_seconds() - start;
    chart->info.n_tree = report.n_inside + report.n_outside;
    chart->info.n_unreachable = report.n_unreachable;
    chart->info.n_cousin_violations = report.n_cousin_violations;
    return status;
}

/* Where the vertices inside are no ball, mostly because gaps are thinner than the grid, it is refined once. */
static icc_status make_tree(field_state *state, icc_chart *chart, const icc_chart_options *options,
                            const double *maximum, const iccp_env *env, icc_error *err)
{
    const icc_chart_info *info = &chart->info;
    const int32_t cells = choose_cells(chart->domain, options->cells);
    const icc_status status = make_tree_on(state, chart, cells, maximum, env, err);
    if (status != ICC_ERR_TOPOLOGY || info->n_grid > MOST_REFINED >> chart->domain->dim)
        return status;
    iccp_log(env, "field: no order of the vertices of %d cells has one critical vertex; %d are tried",
             (int)info->cells, (int)(2 * info->cells));
    return make_tree_on(state, chart, 2 * info->cells, maximum, env, err);
}

static icc_status make_field(field_state *state, icc_chart *chart, const icc_chart_options *options,
                             const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    icc_field_report report = {0};
    const icc_field_options function = {.function = ICC_FUNCTION_LAPLACE,
                                        .constraints = ICC_CONSTRAINTS_NONE,
                                        .solver = options->solver};
    icc_status status = iccp_field_create(&state->field, state->tree, &function, env, err);
    if (status == ICC_OK)
        status = iccp_field_verify(state->field, &report, env);
    chart->info.n_maxima = report.n_maxima;
    chart->info.n_minima = report.n_minima;
    chart->info.n_saddles = report.n_saddles;
    chart->info.seconds_field = iccp_seconds() - start;
    return status;
}

static icc_status make_vectors(field_state *state, icc_chart *chart, const iccp_env *env)
{
    const double start = iccp_seconds();
    iccp_smooth smooth = {.memory = env->memory};
    icc_status status =
        iccp_cover_create(&state->cover, chart->domain, state->tree->grid, env);
    if (status == ICC_OK)
        status = iccp_smooth_create(&smooth, state->field, &state->cover, SWEEPS, env);
    if (status == ICC_OK)
        status = iccp_cones_create(&state->cones, &smooth, &state->cover, env);
    iccp_smooth_free(&smooth);
    chart->info.seconds_solve = iccp_seconds() - start;
    return status;
}

static void finish(field_state *state, icc_chart *chart)
{
    const icc_grid *grid = state->tree->grid;
    const int32_t dim = grid->dim;
    icc_chart_info *info = &chart->info;
    size_t steps = 1000;
    for (int32_t k = 0; k < dim; ++k) {
        state->root[k] = grid->origin[k] +
                         grid->spacing * iccp_grid_coordinate(grid, state->tree->root, k);
        steps += 200 * grid->shape[k];
    }
    state->flow = (iccp_flow){.grid = grid,
                              .domain = chart->domain,
                              .cover = &state->cover,
                              .cones = &state->cones,
                              .root = state->tree->root,
                              .most_steps = steps};
    iccp_frame_out(&chart->domain->frame, dim, state->root, info->maximum);
    info->spacing = grid->spacing * chart->domain->frame.out[0] * chart->domain->frame.out[1];
    info->n_inside = grid->n_inside;
    info->n_infeasible = state->cones.n_infeasible;
    info->n_contacts = state->cones.n_contacts;
    info->n_not_inward = state->cones.n_not_inward;
    info->n_stray = grid->n_stray;
    info->certified =
        info->n_infeasible == 0 && info->n_not_inward == 0 && info->n_stray == 0;
}

/* ---- places ---- */

static void to_lattice(const field_state *state, const double *local, double *x)
{
    const icc_grid *grid = state->tree->grid;
    for (int32_t k = 0; k < grid->dim; ++k)
        x[k] = (local[k] - grid->origin[k]) / grid->spacing;
}

static void to_local(const field_state *state, const iccp_flow_place *place, const double *at,
                     double *local)
{
    const icc_grid *grid = state->tree->grid;
    iccp_flow_position(&state->flow, place, at, local);
    for (int32_t k = 0; k < grid->dim; ++k)
        local[k] = grid->origin[k] + grid->spacing * local[k];
}

static bool at_maximum(const icc_chart *chart, const double *point)
{
    const field_state *state = chart->state;
    for (int32_t k = 0; k < chart->domain->dim; ++k)
        if (fabs(point[k] - state->root[k]) > chart->domain->tolerance)
            return false;
    return true;
}

/* A local point of the boundary, in the simplex that the curve enters from there. */
static icc_status find_entry(const icc_chart *chart, const double *point, iccp_flow_place *place)
{
    const field_state *state = chart->state;
    double x[ICC_MAX_DIM], ahead[ICC_MAX_DIM];
    to_lattice(state, point, x);
    if (!iccp_flow_find(&state->flow, x, NULL, place))
        return ICC_ERR_TRACE;
    iccp_flow_vector(&state->flow, place, ahead);
    return iccp_flow_find(&state->flow, x, ahead, place) ? ICC_OK : ICC_ERR_TRACE;
}

/* ---- Cartesian to coordinates ---- */

/* ICC_INSIDE and so on. A simplex that no facet runs through is inside with its vertices. */
static int32_t locate(const icc_chart *chart, const double *point, iccp_flow_place *place,
                      iccp_coords *coords)
{
    const field_state *state = chart->state;
    double x[ICC_MAX_DIM];
    to_lattice(state, point, x);
    if (!iccp_flow_find(&state->flow, x, NULL, place))
        return ICC_OUTSIDE;
    const uint32_t lowest = place->simplex.corner[0];
    if (state->cover.bits[lowest] == 0 && state->tree->grid->inside[lowest])
        return ICC_INSIDE;
    return iccp_domain_locate(chart->domain, point, true, &coords->facet, coords->bary);
}

/* `jet` may be NULL; else it starts as the derivative of the place by the point, and ends at the boundary. */
static icc_status walk_down(const field_state *state, const iccp_flow_place *place,
                            iccp_coords *coords, double *length, iccp_flow_jet *jet)
{
    const size_t dim = (size_t)state->tree->grid->dim;
    iccp_flow_walk walk;
    icc_status status = iccp_flow_start(&walk, &state->flow, -1, place);
    double s;
    while (status == ICC_OK && !iccp_flow_leaves(&walk, &s, &coords->facet, coords->bary)) {
        if (jet != NULL && !iccp_flow_jet_pass(&walk, jet))
            return ICC_ERR_TRACE;
        status = iccp_flow_next(&walk);
    }
    if (status != ICC_OK)
        return status;
    *length = walk.length + iccp_flow_length(&walk, s);
    if (jet == NULL)
        return ICC_OK;
    iccp_flow_jet_within(&walk, s, jet);
    const double *normal = state->cover.normal + dim * coords->facet;
    return iccp_flow_jet_onto(&walk, s, normal, jet) ? ICC_OK : ICC_ERR_TRACE;
}

static icc_status walk_up(const field_state *state, const iccp_flow_place *place, double *length,
                          iccp_flow_jet *jet)
{
    iccp_flow_walk walk;
    icc_status status = iccp_flow_start(&walk, &state->flow, +1, place);
    while (status == ICC_OK && !walk.ends) {
        if (jet != NULL && !iccp_flow_jet_pass(&walk, jet))
            return ICC_ERR_TRACE;
        status = iccp_flow_next(&walk);
    }
    if (status == ICC_OK && jet != NULL)
        (void)iccp_flow_jet_pass(&walk, jet);
    if (status == ICC_OK)
        *length = walk.length + walk.end_length;
    return status;
}

/* Each parameter moves the point along an axis. */
static void unit_jet(iccp_flow_jet *jet, int32_t dim)
{
    *jet = (iccp_flow_jet){.n = dim};
    for (int32_t k = 0; k < dim; ++k)
        jet->place[k][k] = 1;
}

/* From movements of a point on a facet to its barycentric coordinates: by the normal equations of the
 * facet's edges, which are independent. */
static void facet_slopes(const icc_domain *domain, uint32_t facet, const double *movement,
                         double *slope)
{
    const int32_t dim = domain->dim, n = dim - 1;
    const double *corner[ICC_MAX_DIM];
    double gram[ICC_MAX_DIM][ICC_MAX_DIM] = {{0}}, right[ICC_MAX_DIM] = {0};
    iccp_facet_corners(&domain->tree, facet, corner);
    for (int32_t i = 0; i < n; ++i)
        for (int32_t k = 0; k < dim; ++k) {
            const double edge = corner[i + 1][k] - corner[0][k];
            right[i] += edge * movement[k];
            for (int32_t j = 0; j < n; ++j)
                gram[i][j] += edge * (corner[j + 1][k] - corner[0][k]);
        }
    for (int32_t c = 0; c < n; ++c)
        for (int32_t r = 0; r < n; ++r) {
            const double factor = r != c ? gram[r][c] / gram[c][c] : 0;
            for (int32_t k = c; k < n; ++k)
                gram[r][k] -= factor * gram[c][k];
            right[r] -= factor * right[c];
        }
    slope[0] = 0;
    for (int32_t i = 0; i < n; ++i) {
        slope[i + 1] = right[i] / gram[i][i];
        slope[0] -= slope[i + 1];
    }
}

static void fill_encode_jet(const icc_chart *chart, uint32_t facet, const iccp_flow_jet *down,
                            double s_down, const iccp_flow_jet *up, double s_up,
                            iccp_encode_jet *jet)
{
    const field_state *state = chart->state;
    const int32_t dim = chart->domain->dim;
    const double h = state->tree->grid->spacing, length = s_down + s_up;
    for (int32_t j = 0; j < dim; ++j) {
        double slope[ICC_MAX_DIM];
        facet_slopes(chart->domain, facet, down->place[j], slope);
        for (int32_t i = 0; i < dim; ++i)
            jet->bary[i * dim + j] = slope[i];
        jet->t[j] = (down->length[j] * s_up - s_down * up->length[j]) / (length * length * h);
    }
}

/* Whether the coordinates are known without a curve, or the point has none: then *status says which. Else
 * the place is where the curve starts. */
static bool is_settled(const icc_chart *chart, const double *point, iccp_flow_place *place,
                       iccp_coords *coords, icc_status *status)
{
    const int32_t where = locate(chart, point, place, coords);
    coords->t = 0;
    *status = where == ICC_OUTSIDE ? ICC_ERR_OUTSIDE : ICC_OK;
    if (where != ICC_INSIDE)
        return true;
    if (!at_maximum(chart, point))
        return false;
    iccp_coords_of_maximum(chart->domain->dim, coords);
    return true;
}

static icc_status encode(const icc_chart *chart, const double *point, iccp_coords *coords,
                         iccp_encode_jet *jet, iccp_path *path)
{
    (void)path;
    const field_state *state = chart->state;
    iccp_flow_place place;
    icc_status status;
    if (is_settled(chart, point, &place, coords, &status))
        return status == ICC_OK && jet != NULL ? ICC_ERR_TRACE : status;
    double s_down = 0, s_up = 0;
    iccp_flow_jet down, up;
    if (jet != NULL) {
        unit_jet(&down, chart->domain->dim);
        unit_jet(&up, chart->domain->dim);
    }
    status = walk_down(state, &place, coords, &s_down, jet != NULL ? &down : NULL);
    if (status == ICC_OK)
        status = walk_up(state, &place, &s_up, jet != NULL ? &up : NULL);
    if (status != ICC_OK)
        return status;
    coords->t = s_down / (s_down + s_up);
    if (jet != NULL)
        fill_encode_jet(chart, coords->facet, &down, s_down, &up, s_up, jet);
    return ICC_OK;
}

/* The curves of points that need some, and whose they are. */
typedef struct many {
    iccp_flow_curve *curves;
    size_t n, point[ICCP_CHART_MANY];
} many;

static bool begin_many(many *m, size_t n_curves, const iccp_path *path)
{
    m->n = 0;
    m->curves = iccp_alloc(path->memory, n_curves, sizeof *m->curves);
    return m->curves != NULL;
}

/* Two curves for each point, the one downhill first. */
static icc_status encode_many(const icc_chart *chart, size_t n, const double *points,
                              iccp_coords *coords, icc_status *status, iccp_path *path)
{
    const field_state *state = chart->state;
    const size_t dim = (size_t)chart->domain->dim;
    many m;
    if (!begin_many(&m, 2 * n, path))
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i) {
        iccp_flow_curve *down = m.curves + 2 * m.n, *up = down + 1;
        if (status[i] != ICC_OK ||
            is_settled(chart, points + dim * i, &down->start, &coords[i], &status[i]))
            continue;
        *up = (iccp_flow_curve){.start = down->start, .sign = +1};
        down->sign = -1;
        down->share = 0;
        m.point[m.n++] = i;
    }
    const icc_status all = iccp_flow_follow(&state->flow, 2 * m.n, m.curves, path->memory);
    for (size_t j = 0; all == ICC_OK && j < m.n; ++j) {
        const iccp_flow_curve *down = m.curves + 2 * j, *up = down + 1;
        iccp_coords *own = coords + m.point[j];
        own->facet = down->facet;
        memcpy(own->bary, down->bary, dim * sizeof *own->bary);
        own->t = down->length / (down->length + up->length);
        status[m.point[j]] = down->status != ICC_OK ? down->status : up->status;
    }
    iccp_free(path->memory, m.curves);
    return all;
}

/* ---- and back ---- */

/* The whole curve from a boundary point, its pieces noted. */
static icc_status climb(const icc_chart *chart, const double *point, iccp_flow_walk *walk,
                        iccp_path *path)
{
    const field_state *state = chart->state;
    iccp_flow_place place;
    path->n_marks = 0;
    icc_status status = find_entry(chart, point, &place);
    if (status == ICC_OK)
        status = iccp_flow_start(walk, &state->flow, +1, &place);
    if (status == ICC_OK)
        status = iccp_flow_note(walk, path);
    while (status == ICC_OK && !walk->ends) {
        status = iccp_flow_next(walk);
        if (status == ICC_OK)
            status = iccp_flow_note(walk, path);
    }
    return status;
}

/* By the barycentric coordinates but the first: the walk once more with derivatives, those at the start of
 * the piece that holds the point kept. */
static icc_status fill_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                                  const iccp_path *path, const iccp_flow_walk *end, double s,
                                  double total, iccp_decode_jet *jet)
{
    const field_state *state = chart->state;
    const int32_t dim = chart->domain->dim;
    const double h = state->tree->grid->spacing;
    const double *corner[ICC_MAX_DIM];
    iccp_flow_jet whole = {.n = dim - 1}, part = {0};
    iccp_flow_walk walk;
    iccp_facet_corners(&chart->domain->tree, coords->facet, corner);
    for (int32_t c = 0; c + 1 < dim; ++c)
        for (int32_t k = 0; k < dim; ++k)
            whole.place[c][k] = (corner[c + 1][k] - corner[0][k]) / h;
    icc_status status = iccp_flow_start(&walk, &state->flow, +1, &path->marks[0].place);
    for (bool more = true; status == ICC_OK && more;) {
        if (walk.length <= end->length)
            part = whole;
        more = !walk.ends;
        if (!iccp_flow_jet_pass(&walk, &whole) && more)
            return ICC_ERR_TRACE;
        if (more)
            status = iccp_flow_next(&walk);
    }
    if (status != ICC_OK)
        return status;
    double ahead[ICC_MAX_DIM];
    iccp_flow_jet_within(end, s, &part);
    for (int32_t c = 0; c + 1 < dim; ++c)
        ahead[c] = coords->t * whole.length[c] - part.length[c];
    iccp_flow_jet_advance(end, s, ahead, &part);
    for (int32_t i = 0; i < dim; ++i) {
        jet->bary[i * dim] = 0;
        for (int32_t c = 0; c + 1 < dim; ++c)
            jet->bary[i * dim + c + 1] = h * part.place[c][i];
    }
    /* By t: along the curve. */
    part = (iccp_flow_jet){.n = 1};
    iccp_flow_jet_advance(end, s, &total, &part);
    for (int32_t i = 0; i < dim; ++i)
        jet->t[i] = h * part.place[0][i];
    return ICC_OK;
}

/* The point where its curve starts, or the point itself; then returns true. */
static bool is_at_end(const icc_chart *chart, const iccp_coords *coords, double *point)
{
    const field_state *state = chart->state;
    if (coords->t >= 1)
        memcpy(point, state->root, (size_t)chart->domain->dim * sizeof *point);
    else
        iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, point);
    return coords->t <= 0 || coords->t >= 1;
}

static icc_status decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path)
{
    const field_state *state = chart->state;
    iccp_flow_walk walk;
    double at[ICC_MAX_DIM];
    if (is_at_end(chart, coords, point))
        return jet == NULL ? ICC_OK : ICC_ERR_TRACE;
    icc_status status = climb(chart, point, &walk, path);
    if (status != ICC_OK)
        return status;
    const double total = walk.length + walk.end_length, length = coords->t * total;
    status = iccp_flow_rewind(&walk, path, length);
    if (status != ICC_OK)
        return status;
    const double s = iccp_flow_at_length(&walk, length - walk.length);
    iccp_flow_at(&walk, s, at);
    to_local(state, &walk.place, at, point);
    return jet == NULL ? ICC_OK
                       : fill_decode_jet(chart, coords, path, &walk, s, total, jet);
}

static icc_status decode_many(const icc_chart *chart, size_t n, const iccp_coords *coords,
                              double *points, icc_status *status, iccp_path *path)
{
    const field_state *state = chart->state;
    const size_t dim = (size_t)chart->domain->dim;
    many m;
    if (!begin_many(&m, n, path))
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i) {
        double *point = points + dim * i;
        if (status[i] != ICC_OK || is_at_end(chart, &coords[i], point))
            continue;
        m.curves[m.n] = (iccp_flow_curve){.sign = +1, .share = coords[i].t};
        status[i] = find_entry(chart, point, &m.curves[m.n].start);
        m.point[m.n] = i;
        m.n += status[i] == ICC_OK;
    }
    const icc_status all = iccp_flow_follow(&state->flow, m.n, m.curves, path->memory);
    for (size_t j = 0; all == ICC_OK && j < m.n; ++j) {
        const iccp_flow_place *place = &m.curves[j].place;
        to_local(state, place, place->at, points + dim * m.point[j]);
        status[m.point[j]] = m.curves[j].status;
    }
    iccp_free(path->memory, m.curves);
    return all;
}

/* ---- the whole curve ---- */

static icc_status emit_marks(const field_state *state, const iccp_path *path, bool reversed,
                             iccp_emit emit, void *argument)
{
    icc_status status = ICC_OK;
    for (size_t i = 0; status == ICC_OK && i < path->n_marks; ++i) {
        const iccp_flow_mark *mark = path->marks + (reversed ? path->n_marks - 1 - i : i);
        double local[ICC_MAX_DIM];
        to_local(state, &mark->place, mark->place.at, local);
        status = emit(argument, local);
    }
    return status;
}

/* From the boundary up to the point, which is the last mark and left out. */
static icc_status trace_below(const icc_chart *chart, const iccp_flow_place *place, iccp_path *path,
                              iccp_emit emit, void *argument)
{
    const field_state *state = chart->state;
    iccp_flow_walk walk;
    iccp_coords coords;
    double s, local[ICC_MAX_DIM];
    path->n_marks = 0;
    icc_status status = iccp_flow_start(&walk, &state->flow, -1, place);
    while (status == ICC_OK && !iccp_flow_leaves(&walk, &s, &coords.facet, coords.bary)) {
        status = iccp_flow_next(&walk);
        if (status == ICC_OK)
            status = iccp_flow_note(&walk, path);
    }
    if (status != ICC_OK)
        return status;
    iccp_domain_facet_point(chart->domain, coords.facet, coords.bary, local);
    status = emit(argument, local);
    return status == ICC_OK ? emit_marks(state, path, true, emit, argument) : status;
}

static icc_status trace(const icc_chart *chart, const double *point, iccp_path *path, iccp_emit emit,
                        void *argument)
{
    const field_state *state = chart->state;
    iccp_flow_place place;
    iccp_flow_walk walk;
    iccp_coords coords;
    const int32_t where = locate(chart, point, &place, &coords);
    icc_status status = ICC_OK;
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (at_maximum(chart, point))
        return emit(argument, point);
    if (where == ICC_INSIDE)
        status = trace_below(chart, &place, path, emit, argument);
    else
        status = find_entry(chart, point, &place);
    path->n_marks = 0;
    if (status == ICC_OK)
        status = iccp_flow_start(&walk, &state->flow, +1, &place);
    for (bool more = true; status == ICC_OK && more;) {
        status = iccp_flow_note(&walk, path);
        more = !walk.ends;
        if (status == ICC_OK && more)
            status = iccp_flow_next(&walk);
    }
    if (status == ICC_OK)
        status = emit_marks(state, path, false, emit, argument);
    return status == ICC_OK ? emit(argument, state->root) : status;
}

static void free_state(icc_chart *chart)
{
    field_state *state = chart->state;
    iccp_cones_free(&state->cones);
    iccp_cover_free(&state->cover);
    iccp_field_release(state->field);
    iccp_tree_release(state->tree);
    iccp_free(&chart->memory, state);
}

static icc_status measure(const icc_chart *chart, size_t n_points, icc_chart_measures *measures,
                          const iccp_env *env)
{
    const field_state *state = chart->state;
    if (chart->info.certified)
        return ICC_OK;
    return iccp_field_measure(chart, &state->flow, n_points, measures, env);
}

/* The vectors, and the function that they come from. */
static uint64_t digest_of(const icc_chart *chart)
{
    const field_state *state = chart->state;
    const iccp_sides *sides = &state->cones.sides;
    const size_t dim = (size_t)chart->domain->dim, n = state->tree->grid->n_vertices;
    uint64_t digest = iccp_digest_field(state->field);
    digest = iccp_digest_f32(digest, dim * n, state->cones.vector);
    digest = iccp_digest_u32(digest, sides->n, sides->vertex);
    return iccp_digest_f32(digest, dim * sides->n_vectors, sides->vector);
}

static void save(const icc_chart *chart, iccp_blob_writer *w)
{
    const field_state *state = chart->state;
    iccp_recipe_write(&state->recipe, chart->domain->dim, digest_of(chart), w);
}

static const iccp_chart_ops OPS = {
    .encode = encode,
    .decode = decode,
    .encode_many = encode_many,
    .decode_many = decode_many,
    .trace = trace,
    .measure = measure,
    .save = save,
    .free_state = free_state,
};

const icc_field *iccp_chart_field_function(const icc_chart *chart)
{
    const field_state *state = chart->state;
    return state->field;
}

icc_status iccp_chart_field_create(icc_chart **out, const icc_domain *domain,
                                   const icc_chart_options *options, const double *maximum,
                                   const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_chart_new(out, domain, env);
    if (status != ICC_OK)
        return status;
    icc_chart *chart = *out;
    chart->ops = &OPS;
    chart->info.method = ICC_METHOD_FIELD;
    chart->info.function = ICC_FUNCTION_LAPLACE;
    chart->info.tree = ICC_TREE_THESIS;
    field_state *state = iccp_alloc_zero(&env->memory, 1, sizeof *state);
    chart->state = state;
    status = ICC_ERR_MEMORY;
    if (state != NULL) {
        state->cover.memory = state->cones.memory = state->cones.sides.memory = env->memory;
        status = make_tree(state, chart, options, maximum, env, err);
    }
    if (status == ICC_OK)
        status = make_field(state, chart, options, env, err);
    if (status == ICC_OK)
        status = make_vectors(state, chart, env);
    if (status == ICC_OK) {
        finish(state, chart);
        iccp_recipe_keep(&state->recipe, options, maximum, domain->dim);
        return ICC_OK;
    }
    iccp_chart_release(chart);
    *out = NULL;
    return status;
}

icc_status iccp_chart_field_read(icc_chart **out, const icc_domain *domain, iccp_blob_reader *r,
                                 const iccp_env *env, icc_error *err)
{
    iccp_recipe recipe;
    uint64_t wanted;
    *out = NULL;
    icc_status status = iccp_recipe_read(&recipe, domain->dim, &wanted, r);
    if (status != ICC_OK)
        return status;
    status = iccp_chart_field_create(out, domain, &recipe.options, iccp_recipe_maximum(&recipe), env,
                                     NULL);
    return iccp_recipe_judge(out, status, wanted, status == ICC_OK ? digest_of(*out) : 0, err);
}
