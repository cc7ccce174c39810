/* Charts of method foliation in 2-D: Integral Curve Coordinates along leaves that never meet.
 *
 * Source: docs/theory/charts-plane.md, "method foliation". M. Campen, C. Silva, D. Zorin,
 * Bijective Maps from Simplicial Foliations, 2016, have the idea of simplicial foliations. */
#include "foliation/chart_foliation.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/minmax.h"
#include "foliation/certificate.h"
#include "foliation/harmonic_charts.h"
#include "foliation/harmonic_file.h"
#include "foliation/leaf2.h"
#include "foliation/psi_file.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

typedef struct foliation_state {
    iccp_planar mesh;
    iccp_psi psi;
    iccp_finder finder;
} foliation_state;

static const double STILL[2] = {0, 0};

static const double *centre_of(const foliation_state *state)
{
    return state->mesh.points + 2 * (size_t)state->psi.centre;
}

/* The length of a part of a leaf that starts at a point, with its derivatives. */
typedef struct leaf_length {
    double length;
    double by_label;    /* derivative by the leaf's label for a fixed point */
    double by_point[2]; /* derivative by the point for a fixed label */
} leaf_length;

/* Adds the piece from p to q. The label moves p by dp and q by dq. */
static void add_piece(leaf_length *l, const double p[2], const double dp[2], const double q[2],
                      const double dq[2])
{
    const double length = iccp_vec_distance(2, p, q);
    l->length += length;
    if (length > 0)
        l->by_label += ((q[0] - p[0]) * (dq[0] - dp[0]) + (q[1] - p[1]) * (dq[1] - dp[1])) / length;
}

/* The first piece, from the point to q, where the leaf leaves its triangle. It is part of the
 * straight piece from p to q. Labels are rounded, so a leaf along an edge may leave the triangle
 * slightly on the wrong side of the point. The length is then negative, and the rest of the leaf
 * is longer by as much. */
static leaf_length start_leaf(const double point[2], const double p[2], const double q[2],
                              const double dq[2])
{
    leaf_length l = {0};
    const double length = iccp_vec_distance(2, p, q);
    if (length > 0) {
        const double ahead[2] = {(q[0] - p[0]) / length, (q[1] - p[1]) / length};
        l.length = (q[0] - point[0]) * ahead[0] + (q[1] - point[1]) * ahead[1];
        l.by_label = ahead[0] * dq[0] + ahead[1] * dq[1];
        l.by_point[0] = -ahead[0];
        l.by_point[1] = -ahead[1];
    }
    return l;
}

typedef bool (*leaf_step)(const iccp_planar *mesh, const iccp_psi *psi, iccp_crossing *crossing);

/* Adds the rest of a leaf from a crossing on. `next` steps to the next crossing, and the last
 * one stays in `crossing`. With `to_centre`, the piece from there to the centre is added too. */
static inline void walk_deriving(const foliation_state *state, leaf_length *l,
                                 iccp_crossing *crossing, bool to_centre, leaf_step next)
{
    double p[2], dp[2], q[2], dq[2];
    iccp_crossing_point(&state->mesh, crossing, p);
    iccp_crossing_slope(&state->mesh, crossing, dp);
    while (next(&state->mesh, &state->psi, crossing)) {
        iccp_crossing_point(&state->mesh, crossing, q);
        iccp_crossing_slope(&state->mesh, crossing, dq);
        add_piece(l, p, dp, q, dq);
        memcpy(p, q, sizeof p);
        memcpy(dp, dq, sizeof dp);
    }
    if (to_centre)
        add_piece(l, p, dp, centre_of(state), STILL);
}

/* Like walk_deriving(), without derivatives. A mapped point spends most of its time here. */
static inline void walk(const foliation_state *state, leaf_length *l, iccp_crossing *crossing,
                        bool to_centre, leaf_step next)
{
    double p[2], q[2];
    iccp_crossing_point(&state->mesh, crossing, p);
    while (next(&state->mesh, &state->psi, crossing)) {
        iccp_crossing_point(&state->mesh, crossing, q);
        l->length += iccp_vec_distance(2, p, q);
        memcpy(p, q, sizeof p);
    }
    if (to_centre)
        l->length += iccp_vec_distance(2, p, centre_of(state));
}

/* Measures the two parts of the leaf through a point. `end` becomes the leaf's crossing with the
 * boundary. */
static void measure_leaf(const foliation_state *state, const iccp_leaf2 *leaf,
                         const double point[2], bool derive, leaf_length *up, leaf_length *down,
                         iccp_crossing *end)
{
    double low[2], d_low[2], high[2], d_high[2] = {0, 0};
    iccp_crossing crossing = leaf->up;
    *end = leaf->down;
    iccp_crossing_point(&state->mesh, end, low);
    iccp_crossing_slope(&state->mesh, end, d_low);
    if (leaf->in_star) {
        memcpy(high, centre_of(state), sizeof high);
    } else {
        iccp_crossing_point(&state->mesh, &crossing, high);
        iccp_crossing_slope(&state->mesh, &crossing, d_high);
    }
    *up = start_leaf(point, low, high, d_high);
    *down = start_leaf(point, high, low, d_low);
    if (!leaf->in_star && derive)
        walk_deriving(state, up, &crossing, true, iccp_leaf2_rise);
    else if (!leaf->in_star)
        walk(state, up, &crossing, true, iccp_leaf2_rise);
    if (derive)
        walk_deriving(state, down, end, false, iccp_leaf2_fall);
    else
        walk(state, down, end, false, iccp_leaf2_fall);
}

/* The label determines the leaf. So each derivative contains the derivative by the label times
 * the label's gradient. The lengths also depend on the point's place along the leaf. */
static void fill_encode_jet(const icc_chart *chart, uint32_t triangle, const double bary[3],
                            const iccp_crossing *end, uint32_t facet, const leaf_length *up,
                            const leaf_length *down, iccp_encode_jet *jet)
{
    const foliation_state *state = chart->state;
    double gradient[2];
    iccp_label_gradient(&state->mesh, &state->psi, triangle, bary, gradient);
    const double rise = (double)end->below + (double)end->above;
    const double total = up->length + down->length;
    for (int c = 0; c < 2; ++c) {
        const double along =
            iccp_planar_along_slope(&state->mesh, chart->domain, facet) * gradient[c] / rise;
        const double d_up = up->by_label * gradient[c] + up->by_point[c];
        const double d_down = down->by_label * gradient[c] + down->by_point[c];
        jet->bary[c] = -along;
        jet->bary[2 + c] = along;
        jet->t[c] = (d_down * up->length - down->length * d_up) / (total * total);
    }
}

static icc_status find_leaf(const foliation_state *state, const double *point, iccp_found *found,
                            iccp_leaf2 *leaf)
{
    const icc_status status = iccp_finder_find(&state->finder, point, found);
    return status == ICC_OK
               ? iccp_leaf2_through(&state->mesh, &state->psi, found->triangle, found->bary, leaf)
               : status;
}

/* Finds the leaf exactly, by its label, and follows it both ways. t is the share of its length
 * below the point. */
static icc_status encode(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                         iccp_coords *coords, iccp_encode_jet *jet)
{
    (void)place;
    const foliation_state *state = chart->state;
    iccp_found found;
    iccp_leaf2 leaf;
    const icc_status status = find_leaf(state, point, &found, &leaf);
    if (status != ICC_OK)
        return status;
    leaf_length up, down;
    iccp_crossing end;
    measure_leaf(state, &leaf, point, jet != NULL, &up, &down, &end);
    const uint32_t edge = state->mesh.triangles[iccp_after(end.corner)];
    const double along =
        iccp_planar_along(&state->mesh, chart->domain, edge, iccp_crossing_share(&end));
    *coords = (iccp_coords){.facet = state->mesh.facet[edge], .bary = {1 - along, along}};
    coords->t = iccp_min(iccp_max(down.length / (down.length + up.length), 0), 1);
    if (jet != NULL)
        fill_encode_jet(chart, found.triangle, found.bary, &end, coords->facet, &up, &down, jet);
    return ICC_OK;
}

static iccp_crossing boundary_crossing(const icc_chart *chart, const iccp_coords *coords)
{
    const foliation_state *state = chart->state;
    double lambda;
    const uint32_t edge =
        iccp_planar_edge(&state->mesh, chart->domain, coords->facet, coords->bary[1], &lambda);
    return iccp_leaf2_from_boundary(&state->psi, state->mesh.boundary_corner[edge], lambda);
}

/* Follows the leaf from a boundary point to the maximum, and notes its arc length. */
static icc_status follow(const icc_chart *chart, const iccp_coords *coords, iccp_path *path)
{
    const foliation_state *state = chart->state;
    double p[2], q[2], length = 0;
    iccp_crossing crossing = boundary_crossing(chart, coords);
    iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, p);
    iccp_path_start(path, 2);
    icc_status status = iccp_path_append(path, p, 0);
    while (status == ICC_OK && iccp_leaf2_rise(&state->mesh, &state->psi, &crossing)) {
        iccp_crossing_point(&state->mesh, &crossing, q);
        length += iccp_vec_distance(2, p, q);
        status = iccp_path_append(path, q, length);
        memcpy(p, q, sizeof p);
    }
    if (status != ICC_OK)
        return status;
    const double *m = centre_of(state);
    return iccp_path_append(path, m, length + iccp_vec_distance(2, p, m));
}

/* Walks the leaf again, for the derivatives by the label of the piece's ends and of the lengths. */
static void fill_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                            const iccp_path *path, size_t piece, double share, iccp_decode_jet *jet)
{
    const foliation_state *state = chart->state;
    iccp_crossing crossing = boundary_crossing(chart, coords);
    const double rise = (double)crossing.below + (double)crossing.above;
    leaf_length l = {0};
    double ends[2][2] = {{0}}, before[2] = {0}, slope[2], previous[2];
    iccp_crossing_slope(&state->mesh, &crossing, previous);
    for (size_t k = 0; k + 1 < path->n; ++k) {
        const double *p = iccp_path_at(path, k), *q = iccp_path_at(path, k + 1);
        slope[0] = slope[1] = 0;
        if (iccp_leaf2_rise(&state->mesh, &state->psi, &crossing))
            iccp_crossing_slope(&state->mesh, &crossing, slope);
        if (k == piece) {
            memcpy(ends[0], previous, sizeof previous);
            memcpy(ends[1], slope, sizeof slope);
            before[0] = l.by_label;
        }
        add_piece(&l, p, previous, q, slope);
        if (k == piece)
            before[1] = l.by_label;
        memcpy(previous, slope, sizeof slope);
    }
    const double *a = iccp_path_at(path, piece), *b = iccp_path_at(path, piece + 1);
    const double length = b[2] - a[2], total = iccp_path_length(path);
    const double direction[2] = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
    const double slide = coords->t * l.by_label - before[0] - share * (before[1] - before[0]);
    for (int i = 0; i < 2; ++i) {
        const double by_label =
            ends[0][i] + share * (ends[1][i] - ends[0][i]) + slide * direction[i];
        jet->t[i] = total * direction[i];
        jet->bary[2 * i] = 0;
        jet->bary[2 * i + 1] =
            by_label * rise / iccp_planar_along_slope(&state->mesh, chart->domain, coords->facet);
    }
}

/* Walks the leaf from the boundary once and keeps its corners. It then goes the share t of the
 * length along them, because the length is known only at the end. */
static icc_status decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path)
{
    const icc_status status = follow(chart, coords, path);
    if (status != ICC_OK)
        return status;
    double share;
    const size_t piece = iccp_path_find(path, coords->t * iccp_path_length(path), &share);
    iccp_path_point(path, piece, share, point);
    if (jet != NULL)
        fill_decode_jet(chart, coords, path, piece, share, jet);
    return ICC_OK;
}

static icc_status emit_down(const foliation_state *state, const iccp_leaf2 *leaf, iccp_path *path,
                            iccp_emit emit, void *argument)
{
    iccp_crossing crossing = leaf->down;
    icc_status status = ICC_OK;
    iccp_path_start(path, 2);
    do {
        double p[2];
        iccp_crossing_point(&state->mesh, &crossing, p);
        status = iccp_path_append(path, p, 0);
    } while (status == ICC_OK && iccp_leaf2_fall(&state->mesh, &state->psi, &crossing));
    for (size_t k = path->n; status == ICC_OK && k-- > 0;)
        status = emit(argument, iccp_path_at(path, k));
    return status;
}

static icc_status emit_up(const foliation_state *state, const iccp_leaf2 *leaf, iccp_emit emit,
                          void *argument)
{
    icc_status status = ICC_OK;
    iccp_crossing crossing = leaf->up;
    if (!leaf->in_star)
        do {
            double p[2];
            iccp_crossing_point(&state->mesh, &crossing, p);
            status = emit(argument, p);
        } while (status == ICC_OK && iccp_leaf2_rise(&state->mesh, &state->psi, &crossing));
    return status == ICC_OK ? emit(argument, centre_of(state)) : status;
}

/* Emits the polyline of a leaf: the whole leaf of a boundary point, or the two parts of the leaf
 * through an inside point. */
static icc_status trace(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                        const iccp_coords *boundary, iccp_path *path, iccp_emit emit,
                        void *argument)
{
    (void)place;
    const foliation_state *state = chart->state;
    if (boundary != NULL) {
        icc_status status = follow(chart, boundary, path);
        for (size_t k = 0; status == ICC_OK && k < path->n; ++k)
            status = emit(argument, iccp_path_at(path, k));
        return status;
    }
    iccp_found found;
    iccp_leaf2 leaf;
    icc_status status = find_leaf(state, point, &found, &leaf);
    if (status == ICC_OK)
        status = emit_down(state, &leaf, path, emit, argument);
    if (status == ICC_OK)
        status = emit(argument, point);
    return status == ICC_OK ? emit_up(state, &leaf, emit, argument) : status;
}

static void free_state(icc_chart *chart)
{
    foliation_state *state = chart->state;
    iccp_finder_free(&state->finder);
    iccp_psi_free(&state->psi);
    iccp_planar_free(&state->mesh);
    iccp_free(&chart->memory, state);
}

static icc_status ready(const icc_chart *chart, bool decodes)
{
    const foliation_state *state = chart->state;
    return decodes ? ICC_OK : iccp_finder_ready(&state->finder);
}

static void save(const icc_chart *chart, iccp_blob *w)
{
    const foliation_state *state = chart->state;
    double share = chart->own.foliation.harmonic_share;
    iccp_harmonic_write(chart->info.cells, &state->mesh, chart->domain, w);
    iccp_blob_f64(w, 1, &share);
    iccp_psi_write(&state->psi, &state->mesh, w);
}

const iccp_chart_ops iccp_foliation_ops = {
    .number = ICC_METHOD_FOLIATION,
    .format = ICC_METHOD_FOLIATION,
    .is_planar = true,
    .create = iccp_harmonic_charts_create,
    .read = iccp_chart_foliation_read,
    .encode = encode,
    .decode = decode,
    .trace = trace,
    .ready = ready,
    .save = save,
    .free_state = free_state,
};

/* ---- creating ---- */

/* Shares of harmonic flux, tried in this order. 0.5 gives the least distortion, and smaller
 * shares cope with sharper corners. */
static const double HARMONIC_SHARES[] = {0.5, 0.25, 0.0};

/* Tries shares of harmonic flux until the exact certificate accepts the foliation. All shares
 * use the same factor. */
static icc_status make_psi(icc_chart *chart, const iccp_harmonic *base, uint32_t centre,
                           const iccp_env *env, icc_error *err)
{
    foliation_state *state = chart->state;
    icc_foliation_info *info = &chart->own.foliation;
    iccp_certificate certificate = {0};
    const double start = iccp_seconds();
    iccp_certify_mesh(&base->mesh, base->mesh.points, &certificate);
    for (size_t k = 0; k < sizeof HARMONIC_SHARES / sizeof *HARMONIC_SHARES; ++k) {
        icc_status status = iccp_psi_create(&state->psi, &base->mesh, &base->laplacian,
                                            &base->solver, centre, HARMONIC_SHARES[k], env);
        const double solved = iccp_seconds();
        if (status != ICC_OK)
            (void)iccp_fail(err, status, "the foliation's equations cannot be factorised");
        if (status == ICC_OK)
            status = iccp_certify_psi(&base->mesh, &state->psi, &certificate, &env->memory);
        if (status != ICC_OK)
            return status;
        if (iccp_certificate_holds(&certificate)) {
            chart->info.certified = 1;
            info->n_ties = certificate.n_ties;
            info->harmonic_share = HARMONIC_SHARES[k];
            chart->timings.solve += solved - start;
            chart->timings.certify = iccp_seconds() - solved;
            return ICC_OK;
        }
        iccp_psi_free(&state->psi);
    }
    return iccp_fail(err, ICC_ERR_CERTIFICATE,
                     "the foliation cannot be certified: %zu inverted triangles, %zu faults of "
                     "topology, %zu open and %zu flat triangles, %zu irregular vertices",
                     certificate.n_inverted, certificate.n_topology, certificate.n_open,
                     certificate.n_flat, certificate.n_irregular);
}

static icc_status begin(icc_chart **out, const icc_domain *domain, const iccp_harmonic *base,
                        const iccp_env *env)
{
    const icc_status status = iccp_chart_new(out, domain, env);
    if (status != ICC_OK)
        return status;
    icc_chart *chart = *out;
    chart->ops = &iccp_foliation_ops;
    chart->info.method = ICC_METHOD_FOLIATION;
    iccp_harmonic_describe(base, domain, &chart->info);
    chart->own.foliation = (icc_foliation_info){.n_mesh_vertices = base->mesh.n_vertices,
                                                .n_mesh_boundary = base->mesh.n_boundary,
                                                .n_mesh_simplices = base->mesh.n_triangles};
    chart->timings.mesh = base->seconds_mesh;
    chart->timings.solve = base->seconds_solve;
    chart->state = iccp_alloc_zero(&env->memory, 1, sizeof(foliation_state));
    return chart->state != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Finishes a chart with a certified psi, or cleans up after a failure. */
static icc_status finish(icc_chart **out, iccp_harmonic *base, icc_status status,
                         const iccp_env *env)
{
    icc_chart *chart = *out;
    foliation_state *state = chart != NULL ? chart->state : NULL;
    if (status == ICC_OK) {
        iccp_finder_init(&state->finder, &base->mesh, base->mesh.points, 0, ICCP_FEW_POINTS,
                         &env->memory);
        status = iccp_finder_budget(&state->finder, env);
    }
    if (status != ICC_OK) {
        iccp_chart_release(chart);
        *out = NULL;
        return status;
    }
    state->mesh = iccp_harmonic_move_mesh(base);
    chart->mesh = &state->mesh;
    iccp_chart_set_maximum(chart, centre_of(state));
    return ICC_OK;
}

icc_status iccp_chart_foliation_create(icc_chart **out, const icc_domain *domain,
                                       iccp_harmonic *base, uint32_t centre, const iccp_env *env,
                                       icc_error *err)
{
    icc_status status = begin(out, domain, base, env);
    if (status == ICC_OK)
        status = make_psi(*out, base, centre, env, err);
    return finish(out, base, status, env);
}

/* ---- reading ---- */

static icc_status read_psi(icc_chart *chart, const iccp_planar *mesh, iccp_blob *r,
                           const iccp_env *env)
{
    foliation_state *state = chart->state;
    iccp_certificate certificate = {0};
    icc_status status = iccp_psi_read(&state->psi, mesh, r, env);
    if (status == ICC_OK)
        status = iccp_certify_psi(mesh, &state->psi, &certificate, &env->memory);
    if (status != ICC_OK)
        return status;
    chart->info.certified = iccp_certificate_holds(&certificate);
    chart->own.foliation.n_ties = certificate.n_ties;
    return chart->info.certified ? ICC_OK : ICC_ERR_FORMAT;
}

icc_status iccp_chart_foliation_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                     const iccp_env *env, icc_error *err)
{
    (void)err;
    iccp_harmonic base;
    double share;
    *out = NULL;
    icc_status status = iccp_harmonic_read(&base, domain, r, env);
    if (status != ICC_OK)
        return status;
    iccp_blob_f64(r, 1, &share);
    status = share >= 0 && share < 1 ? begin(out, domain, &base, env) : ICC_ERR_FORMAT;
    if (status == ICC_OK) {
        (*out)->own.foliation.harmonic_share = share;
        status = read_psi(*out, &base.mesh, r, env);
    }
    status = finish(out, &base, status, env);
    iccp_harmonic_free(&base);
    return status;
}
