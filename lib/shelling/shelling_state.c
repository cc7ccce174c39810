/* The operations of a chart of method foliation on a mesh.
 *
 * Source: Huynh and Gingold, Bijective Deformations in R^n via Integral Curve Coordinates, section
 * 4. The curves are the leaves of docs/theory/charts-space.md, "foliations of simplices". */
#include "shelling/shelling_state.h"

#include "base/minmax.h"
#include "domain/domain_file.h"
#include "shelling/chart_shelling.h"
#include "shelling/shelling_file.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static const uint32_t *facet_of(const icc_chart *chart, uint32_t facet)
{
    return chart->domain->facets + (size_t)chart->domain->dim * facet;
}

static_assert(sizeof(iccp_leafn_place) <= sizeof(iccp_chart_place), "there is room for a place");

static iccp_leafn_place own_place(const iccp_chart_place *place)
{
    iccp_leafn_place own;
    memcpy(&own, place->bytes, sizeof own);
    return own;
}

/* Returns ICC_INSIDE and so on. The domain is asked only if the simplex cannot decide. */
static int32_t locate(const icc_chart *chart, const double *point, iccp_chart_place *place,
                      iccp_coords *coords)
{
    const iccp_shelling_state *state = chart->state;
    iccp_leafn_place own;
    bool inner;
    const bool found =
        iccp_leafn_find(&state->leaves, point, chart->domain->band.reach, &own, &inner);
    if (found)
        memcpy(place->bytes, &own, sizeof own);
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
    iccp_leafn_jet down_jet, up_jet;
} parts;

static void fill_encode_jet(const icc_chart *chart, const iccp_leafn_place *end, uint32_t facet,
                            const parts *p, iccp_encode_jet *jet)
{
    const iccp_shelling_state *state = chart->state;
    const size_t dim = state->leaves.dim;
    const double length = p->down + p->up;
    for (size_t j = 0; j < dim; ++j) {
        iccp_leafn_place slope = {.simplex = end->simplex};
        double bary[ICC_MAX_DIM];
        for (size_t i = 0; i <= dim; ++i)
            slope.bary[i] = p->down_jet.bary[i][j];
        iccp_leafn_facet(&state->leaves, &slope, facet_of(chart, facet), bary);
        for (size_t i = 0; i < dim; ++i)
            jet->bary[i * dim + j] = bary[i];
        jet->t[j] =
            (p->down_jet.length[j] * p->up - p->down * p->up_jet.length[j]) / (length * length);
    }
}

static void end_on_facet(const icc_chart *chart, const iccp_leafn_place *end, iccp_coords *coords)
{
    const iccp_shelling_state *state = chart->state;
    const size_t dim = state->leaves.dim;
    double sum = 0;
    iccp_leafn_facet(&state->leaves, end, facet_of(chart, coords->facet), coords->bary);
    for (size_t k = 0; k < dim; ++k)
        sum += coords->bary[k];
    for (size_t k = 0; k < dim; ++k)
        coords->bary[k] /= sum;
}

/* Follows the leaf down to the boundary and up to the centre. t is the share of the length below
 * the point. With a jet, the same two walks carry derivatives by the point's coordinates. */
static icc_status encode(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                         iccp_coords *coords, iccp_encode_jet *jet)
{
    (void)point;
    const iccp_shelling_state *state = chart->state;
    iccp_leafn_place low = own_place(place), high = low;
    parts p;
    if (jet == NULL) {
        p.down = iccp_leafn_fall(&state->leaves, &low, &coords->facet);
        p.up = iccp_leafn_rise(&state->leaves, &high);
    } else {
        iccp_leafn_gradient(&state->leaves, low.simplex, &p.down_jet);
        p.up_jet = p.down_jet;
        p.down = iccp_leafn_fall_jet(&state->leaves, &low, &coords->facet, &p.down_jet);
        p.up = iccp_leafn_rise_jet(&state->leaves, &high, &p.up_jet, UINT32_MAX, NULL);
        fill_encode_jet(chart, &low, coords->facet, &p, jet);
    }
    end_on_facet(chart, &low, coords);
    coords->t = p.down / (p.down + p.up);
    return ICC_OK;
}

/* ---- coordinates to Cartesian ---- */

/* The place of a point on its leaf: a note before it, and lengths. */
typedef struct spot {
    iccp_leafn_place from; /* where the leaf enters the simplex */
    double before;         /* the leaf's length up to `from` */
    double piece;          /* the leaf's length within the simplex */
    double ahead;          /* the length from `from` to the point */
    double total;
} spot;

static spot find_spot(const iccp_path *path, double t)
{
    double share;
    spot s = {.total = iccp_path_length(path)};
    const size_t k = iccp_path_find(path, t * s.total, &share);
    iccp_leafn_noted(path, k, &s.from);
    s.before = iccp_path_length_at(path, k);
    s.piece = iccp_path_length_at(path, k + 1) - s.before;
    s.ahead = iccp_min(iccp_max(t * s.total - s.before, 0), s.piece);
    return s;
}

/* The parameters are t and the barycentric coordinates except the first, which compensates for
 * the others. */
static void fill_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                            const iccp_leafn_place *place, const spot *s, iccp_decode_jet *jet)
{
    const iccp_shelling_state *state = chart->state;
    const iccp_leaves *leaves = &state->leaves;
    const size_t dim = leaves->dim;
    const uint32_t *vertices = facet_of(chart, coords->facet);
    iccp_leafn_place start;
    iccp_leafn_jet whole = {.n = dim - 1}, part;
    double d_ahead[ICC_MAX_DIM], d_piece[ICC_MAX_DIM], movement[ICC_MAX_DIM][ICC_MAX_DIM];
    for (size_t c = 1; c < dim; ++c) {
        double bary[ICC_MAX_DIM] = {-1};
        bary[c] = 1;
        iccp_leafn_enter(leaves, coords->facet, vertices, bary, &start);
        for (size_t i = 0; i <= dim; ++i)
            whole.bary[i][c - 1] = start.bary[i];
    }
    iccp_leafn_enter(leaves, coords->facet, vertices, coords->bary, &start);
    part = whole;
    (void)iccp_leafn_rise_jet(leaves, &start, &whole, s->from.simplex, &part);
    for (size_t c = 0; c + 1 < dim; ++c) {
        d_ahead[c] = coords->t * whole.length[c] - part.length[c];
        d_piece[c] = whole.length[c] - part.length[c];
    }
    part.n = dim;
    d_ahead[dim - 1] = s->total;
    d_piece[dim - 1] = 0;
    for (size_t i = 0; i <= dim; ++i)
        part.bary[i][dim - 1] = 0;
    iccp_leafn_ahead_jet(leaves, &s->from, s->ahead, s->piece, d_ahead, d_piece, &part);
    iccp_leafn_movement(leaves, place, &part, movement);
    for (size_t i = 0; i < dim; ++i) {
        jet->bary[i * dim] = 0;
        for (size_t c = 1; c < dim; ++c)
            jet->bary[i * dim + c] = movement[i][c - 1];
        jet->t[i] = movement[i][dim - 1];
    }
}

/* Notes the whole leaf from the boundary, because t is a share of its length. Then moves ahead
 * from the note below the point. */
static icc_status decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path)
{
    const iccp_shelling_state *state = chart->state;
    iccp_leafn_place place;
    iccp_leafn_enter(&state->leaves, coords->facet, facet_of(chart, coords->facet), coords->bary,
                     &place);
    const icc_status status = iccp_leafn_note_rise(&state->leaves, &place, path);
    if (status != ICC_OK)
        return status;
    const spot s = find_spot(path, coords->t);
    place = s.from;
    iccp_leafn_ahead(&state->leaves, s.ahead, s.piece, &place);
    iccp_leafn_point(&state->leaves, &place, point);
    if (jet != NULL)
        fill_decode_jet(chart, coords, &place, &s, jet);
    return ICC_OK;
}

/* ---- the whole curve ---- */

/* Emits the point of a note. Steps of length 0, which a leaf makes where it meets a face, are
 * left out. */
static icc_status emit_note(const iccp_shelling_state *state, const iccp_path *path, size_t k,
                            iccp_emit emit, void *argument)
{
    iccp_leafn_place place;
    double point[ICC_MAX_DIM];
    if (k > 0 && !(iccp_path_length_at(path, k) > iccp_path_length_at(path, k - 1)))
        return ICC_OK;
    iccp_leafn_noted(path, k, &place);
    iccp_leafn_point(&state->leaves, &place, point);
    return emit(argument, point);
}

/* Emits the notes of both parts of the leaf, those downhill in reverse order. */
static icc_status trace(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                        const iccp_coords *boundary, iccp_path *path, iccp_emit emit,
                        void *argument)
{
    (void)point;
    const iccp_shelling_state *state = chart->state;
    iccp_leafn_place start;
    icc_status status = ICC_OK;
    if (boundary != NULL) {
        iccp_leafn_enter(&state->leaves, boundary->facet, facet_of(chart, boundary->facet),
                         boundary->bary, &start);
    } else {
        start = own_place(place);
        status = iccp_leafn_note_fall(&state->leaves, &start, path);
        for (size_t k = path->n; status == ICC_OK && k-- > 1;)
            status = emit_note(state, path, k, emit, argument);
    }
    if (status == ICC_OK)
        status = iccp_leafn_note_rise(&state->leaves, &start, path);
    for (size_t k = 0; status == ICC_OK && k < path->n; ++k)
        status = emit_note(state, path, k, emit, argument);
    return status;
}

static void free_state(icc_chart *chart)
{
    iccp_shelling_state *state = chart->state;
    iccp_leafn_free(&state->leaves);
    iccp_simplices_free(state->mesh);
    iccp_free(&chart->memory, state);
}

icc_status iccp_shelling_visit_head(iccp_blob *b, icc_shelling_info *facts, iccp_simplices **own,
                                    uint64_t *centre, const icc_domain *domain)
{
    iccp_blob_i32(b, ICCP_U64, 0, 1, &facts->order_peeled);
    iccp_blob_i32(b, ICCP_U64, 0, INT32_MAX, &facts->n_orders);
    iccp_blob_size(b, &facts->n_reversed);
    iccp_blob_require(b, facts->n_reversed <= UINT32_MAX);
    iccp_blob_f64(b, 1, &facts->harmonic_share);
    iccp_blob_f64(b, 1, &facts->order_beta);
    iccp_blob_f64(b, 1, &facts->flux_energy);
    iccp_blob_f64(b, 1, &facts->flux_divergence);
    const icc_status status = iccp_filling_visit(b, own, domain);
    iccp_blob_u64(b, 1, centre);
    return status == ICC_OK ? b->status : status;
}

/* The order of the simplices is not saved, because the directions determine it. */
static void save(const icc_chart *chart, iccp_blob *b)
{
    const iccp_shelling_state *state = chart->state;
    iccp_simplices *own = state->mesh;
    const iccp_simplices *mesh = own != NULL ? own : chart->domain->mesh;
    icc_shelling_info facts = chart->own.shelling;
    uint64_t centre = state->leaves.centre;
    (void)iccp_shelling_visit_head(b, &facts, &own, &centre, chart->domain);
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        double direction[ICCP_LEAFN_CORNERS];
        iccp_leafn_direction(&state->leaves, mesh, s, direction);
        iccp_blob_f64(b, mesh->dim + 1, direction);
    }
}

/* The number of this method in the format, where ICC_METHOD_FOLIATION means method foliation
 * without a mesh. */
enum { ON_MESH = 5 };

const iccp_chart_ops iccp_shelling_ops = {
    .number = ICC_METHOD_FOLIATION,
    .format = ON_MESH,
    .needs_mesh = true,
    .create = iccp_chart_shelling_create,
    .read = iccp_chart_shelling_read,
    .locate = locate,
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
    (*out)->own.shelling = (icc_shelling_info){.n_mesh_vertices = mesh->n_points,
                                               .n_mesh_boundary = mesh->n_boundary,
                                               .n_mesh_simplices = mesh->n_simplices};
    state->mesh = own;
    state->leaves.memory = env->memory;
    iccp_chart_set_maximum(*out, mesh->points + mesh->dim * centre);
    return ICC_OK;
}
