/* Based on: Huynh and Gingold, Bijective Deformations in R^n via Integral Curve Coordinates,
 * section 4; the curves are the leaves of docs/theory.md, foliations of simplices. */
#include "chart/shelling_state.h"

#include "domain/domain_file.h"

#include <math.h>
#include <string.h>

static const uint32_t *facet_of(const icc_chart *chart, uint32_t facet)
{
    return chart->domain->facets + (size_t)chart->domain->dim * facet;
}

static bool at_maximum(const icc_chart *chart, const double *point)
{
    const iccp_shelling_state *state = chart->state;
    for (int32_t k = 0; k < chart->domain->dim; ++k)
        if (!(fabs(point[k] - state->centre[k]) <= chart->domain->band.tolerance))
            return false;
    return true;
}

/* ICC_INSIDE and so on. The domain is asked only where the simplex cannot tell. */
static int32_t locate(const icc_chart *chart, const double *point, iccp_fibre_place *place,
                      iccp_coords *coords)
{
    const iccp_shelling_state *state = chart->state;
    bool inner;
    const bool found =
        iccp_fibres_find(&state->fibres, point, chart->domain->band.reach, place, &inner);
    if (found && inner)
        return ICC_INSIDE;
    const int32_t where =
        iccp_domain_locate(chart->domain, point, true, &coords->facet, coords->bary);
    return where == ICC_INSIDE && !found ? ICC_OUTSIDE : where;
}

/* ---- Cartesian to coordinates ---- */

/* Lengths and derivatives of the two parts of a leaf. */
typedef struct parts {
    double down, up;
    iccp_fibre_jet down_jet, up_jet;
} parts;

static void fill_encode_jet(const icc_chart *chart, const iccp_fibre_place *end, uint32_t facet,
                            const parts *p, iccp_encode_jet *jet)
{
    const iccp_shelling_state *state = chart->state;
    const size_t dim = state->fibres.dim;
    const double length = p->down + p->up;
    for (size_t j = 0; j < dim; ++j) {
        iccp_fibre_place slope = {.simplex = end->simplex};
        double bary[ICC_MAX_DIM];
        for (size_t i = 0; i <= dim; ++i)
            slope.bary[i] = p->down_jet.bary[i][j];
        iccp_fibres_facet(&state->fibres, &slope, facet_of(chart, facet), bary);
        for (size_t i = 0; i < dim; ++i)
            jet->bary[i * dim + j] = bary[i];
        jet->t[j] =
            (p->down_jet.length[j] * p->up - p->down * p->up_jet.length[j]) / (length * length);
    }
}

static void end_on_facet(const icc_chart *chart, const iccp_fibre_place *end, iccp_coords *coords)
{
    const iccp_shelling_state *state = chart->state;
    const size_t dim = state->fibres.dim;
    double sum = 0;
    iccp_fibres_facet(&state->fibres, end, facet_of(chart, coords->facet), coords->bary);
    for (size_t k = 0; k < dim; ++k)
        sum += coords->bary[k];
    for (size_t k = 0; k < dim; ++k)
        coords->bary[k] /= sum;
}

static void encode_inside(const icc_chart *chart, const iccp_fibre_place *place,
                          iccp_coords *coords, iccp_encode_jet *jet)
{
    const iccp_shelling_state *state = chart->state;
    iccp_fibre_place low = *place, high = *place;
    parts p;
    if (jet == NULL) {
        p.down = iccp_fibres_fall(&state->fibres, &low, &coords->facet);
        p.up = iccp_fibres_rise(&state->fibres, &high);
    } else {
        iccp_fibres_gradient(&state->fibres, place->simplex, &p.down_jet);
        p.up_jet = p.down_jet;
        p.down = iccp_fibres_fall_jet(&state->fibres, &low, &coords->facet, &p.down_jet);
        p.up = iccp_fibres_rise_jet(&state->fibres, &high, &p.up_jet, UINT32_MAX, NULL);
        fill_encode_jet(chart, &low, coords->facet, &p, jet);
    }
    end_on_facet(chart, &low, coords);
    coords->t = p.down / (p.down + p.up);
}

static icc_status encode(const icc_chart *chart, const double *point, iccp_coords *coords,
                         iccp_encode_jet *jet, iccp_path *path)
{
    (void)path;
    iccp_fibre_place place;
    const int32_t where = locate(chart, point, &place, coords);
    coords->t = 0;
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (where == ICC_BOUNDARY)
        return jet == NULL ? ICC_OK : ICC_ERR_TRACE;
    if (at_maximum(chart, point)) {
        iccp_coords_of_maximum(chart->domain->dim, coords);
        return jet == NULL ? ICC_OK : ICC_ERR_TRACE;
    }
    encode_inside(chart, &place, coords, jet);
    return ICC_OK;
}

/* ---- and back ---- */

/* Where a point is on its leaf: a note before it, and lengths. */
typedef struct spot {
    iccp_fibre_place from; /* where the leaf enters the simplex */
    double before;         /* the leaf's length up to there */
    double piece;          /* and within the simplex */
    double ahead;          /* from there to the point */
    double total;
} spot;

static spot find_spot(const iccp_path *path, double t)
{
    double share;
    spot s = {.total = iccp_path_length(path)};
    const size_t k = iccp_path_find(path, t * s.total, &share);
    iccp_fibres_noted(path, k, &s.from);
    s.before = iccp_path_length_at(path, k);
    s.piece = iccp_path_length_at(path, k + 1) - s.before;
    s.ahead = fmin(fmax(t * s.total - s.before, 0), s.piece);
    return s;
}

/* Parameters are the barycentric coordinates but the first, which gives way, and t. */
static void fill_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                            const iccp_fibre_place *place, const spot *s, iccp_decode_jet *jet)
{
    const iccp_shelling_state *state = chart->state;
    const iccp_fibres *fibres = &state->fibres;
    const size_t dim = fibres->dim;
    const uint32_t *vertices = facet_of(chart, coords->facet);
    iccp_fibre_place start;
    iccp_fibre_jet whole = {.n = dim - 1}, part;
    double d_ahead[ICC_MAX_DIM], d_piece[ICC_MAX_DIM], movement[ICC_MAX_DIM][ICC_MAX_DIM];
    for (size_t c = 1; c < dim; ++c) {
        double bary[ICC_MAX_DIM] = {-1};
        bary[c] = 1;
        iccp_fibres_enter(fibres, coords->facet, vertices, bary, &start);
        for (size_t i = 0; i <= dim; ++i)
            whole.bary[i][c - 1] = start.bary[i];
    }
    iccp_fibres_enter(fibres, coords->facet, vertices, coords->bary, &start);
    part = whole;
    (void)iccp_fibres_rise_jet(fibres, &start, &whole, s->from.simplex, &part);
    for (size_t c = 0; c + 1 < dim; ++c) {
        d_ahead[c] = coords->t * whole.length[c] - part.length[c];
        d_piece[c] = whole.length[c] - part.length[c];
    }
    part.n = dim;
    d_ahead[dim - 1] = s->total;
    d_piece[dim - 1] = 0;
    for (size_t i = 0; i <= dim; ++i)
        part.bary[i][dim - 1] = 0;
    iccp_fibres_ahead_jet(fibres, &s->from, s->ahead, s->piece, d_ahead, d_piece, &part);
    iccp_fibres_movement(fibres, place, &part, movement);
    for (size_t i = 0; i < dim; ++i) {
        jet->bary[i * dim] = 0;
        for (size_t c = 1; c < dim; ++c)
            jet->bary[i * dim + c] = movement[i][c - 1];
        jet->t[i] = movement[i][dim - 1];
    }
}

static icc_status decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path)
{
    const iccp_shelling_state *state = chart->state;
    const size_t dim = state->fibres.dim;
    iccp_fibre_place place;
    if (jet != NULL && (coords->t <= 0 || coords->t >= 1))
        return ICC_ERR_TRACE;
    if (coords->t >= 1) {
        memcpy(point, state->centre, dim * sizeof *point);
        return ICC_OK;
    }
    if (coords->t <= 0) {
        iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, point);
        return ICC_OK;
    }
    iccp_fibres_enter(&state->fibres, coords->facet, facet_of(chart, coords->facet), coords->bary,
                      &place);
    const icc_status status = iccp_fibres_note_rise(&state->fibres, &place, path);
    if (status != ICC_OK)
        return status;
    const spot s = find_spot(path, coords->t);
    place = s.from;
    iccp_fibres_ahead(&state->fibres, s.ahead, s.piece, &place);
    iccp_fibres_point(&state->fibres, &place, point);
    if (jet != NULL)
        fill_decode_jet(chart, coords, &place, &s, jet);
    return ICC_OK;
}

/* ---- the whole curve ---- */

/* Steps of length 0, at faces that a leaf meets, are left out. */
static icc_status emit_note(const iccp_shelling_state *state, const iccp_path *path, size_t k,
                            iccp_emit emit, void *argument)
{
    iccp_fibre_place place;
    double point[ICC_MAX_DIM];
    if (k > 0 && !(iccp_path_length_at(path, k) > iccp_path_length_at(path, k - 1)))
        return ICC_OK;
    iccp_fibres_noted(path, k, &place);
    iccp_fibres_point(&state->fibres, &place, point);
    return emit(argument, point);
}

static icc_status trace(const icc_chart *chart, const double *point, iccp_path *path,
                        iccp_emit emit, void *argument)
{
    const iccp_shelling_state *state = chart->state;
    iccp_fibre_place place;
    iccp_coords coords;
    icc_status status = ICC_OK;
    const int32_t where = locate(chart, point, &place, &coords);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (at_maximum(chart, point))
        return emit(argument, point);
    if (where == ICC_BOUNDARY) {
        iccp_fibres_enter(&state->fibres, coords.facet, facet_of(chart, coords.facet), coords.bary,
                          &place);
    } else {
        status = iccp_fibres_note_fall(&state->fibres, &place, path);
        for (size_t k = path->n; status == ICC_OK && k-- > 1;)
            status = emit_note(state, path, k, emit, argument);
    }
    if (status == ICC_OK)
        status = iccp_fibres_note_rise(&state->fibres, &place, path);
    for (size_t k = 0; status == ICC_OK && k < path->n; ++k)
        status = emit_note(state, path, k, emit, argument);
    return status;
}

static void free_state(icc_chart *chart)
{
    iccp_shelling_state *state = chart->state;
    iccp_fibres_free(&state->fibres);
    iccp_simplices_free(state->mesh);
    iccp_free(&chart->memory, state);
}

/* The order of the simplices follows from the directions. */
static void save(const icc_chart *chart, iccp_blob_writer *w)
{
    const iccp_shelling_state *state = chart->state;
    const iccp_simplices *mesh = state->mesh != NULL ? state->mesh : chart->domain->mesh;
    const icc_chart_info *info = &chart->info;
    const double measures[] = {info->harmonic_share, info->order_beta, info->flux_energy,
                               info->flux_divergence};
    iccp_blob_u64(w, (uint64_t)info->order_peeled);
    iccp_blob_u64(w, (uint64_t)info->n_orders);
    iccp_blob_u64(w, info->n_reversed);
    iccp_blob_f64(w, 4, measures);
    iccp_blob_u64(w, state->mesh != NULL);
    if (state->mesh != NULL)
        iccp_filling_write(state->mesh, w);
    iccp_blob_u64(w, state->fibres.centre);
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        double direction[ICCP_FIBRE_CORNERS];
        iccp_fibres_direction(&state->fibres, mesh, s, direction);
        iccp_blob_f64(w, mesh->dim + 1, direction);
    }
}

const iccp_chart_ops iccp_shelling_ops = {
    .encode = encode,
    .decode = decode,
    .trace = trace,
    .save = save,
    .free_state = free_state,
};

icc_status iccp_shelling_begin(icc_chart **out, const icc_domain *domain, iccp_simplices *own,
                               uint32_t centre, const iccp_env *env)
{
    const iccp_simplices *mesh = own != NULL ? own : domain->mesh;
    iccp_shelling_state *state = NULL;
    icc_status status = iccp_chart_new(out, domain, env);
    if (status == ICC_OK) {
        (*out)->ops = &iccp_shelling_ops;
        state = (*out)->state = iccp_alloc_zero(&env->memory, 1, sizeof *state);
    }
    if (state == NULL) {
        iccp_simplices_free(own);
        return ICC_ERR_MEMORY;
    }
    icc_chart_info *info = &(*out)->info;
    info->method = ICC_METHOD_FOLIATION;
    info->n_mesh_vertices = mesh->n_points;
    info->n_mesh_boundary = mesh->n_boundary;
    info->n_mesh_simplices = mesh->n_simplices;
    state->mesh = own;
    state->fibres.memory = env->memory;
    memcpy(state->centre, mesh->points + mesh->dim * centre, mesh->dim * sizeof *state->centre);
    iccp_frame_out(&domain->frame, domain->dim, state->centre, info->maximum);
    return ICC_OK;
}
