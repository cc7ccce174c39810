/* Charts of method disc. Source: Tutte's map (foliation/harmonic.h), which takes the domain to a
 * polygon round the origin. A point's curve is the preimage of the ray from the polygon's boundary
 * through its image to the origin.
 *
 * Two words: the image is the mesh in the disc, and the rim is the image's boundary. */
#include "foliation/chart_disc.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/minmax.h"
#include "foliation/certificate.h"
#include "foliation/harmonic_charts.h"
#include "foliation/harmonic_file.h"
#include "math/predicates.h"

#include <math.h>

typedef struct disc_state {
    iccp_planar mesh;
    double *image;      /* 2 n_vertices */
    iccp_finder before; /* in the domain */
    iccp_finder after;  /* in the disc */
} disc_state;

static const double ORIGIN[2] = {0, 0};

static const double *boundary_image(const disc_state *state, uint32_t k)
{
    return state->image + 2 * (size_t)(k < state->mesh.n_boundary ? k : 0);
}

/* Returns true if the ray to z lies counter-clockwise of rim vertex k, by less than half a turn. */
static bool is_past(const disc_state *state, uint32_t k, const double z[2])
{
    return iccp_orient2d(ORIGIN, boundary_image(state, k), z) >= 0;
}

/* Finds the rim edge that the ray from the origin through z meets. Rim vertices come in order of
 * angle, from vertex 0 on, once round. */
static uint32_t find_boundary_edge(const disc_state *state, const double z[2])
{
    const bool first_half = is_past(state, 0, z);
    uint32_t low = 0, high = (uint32_t)state->mesh.n_boundary;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        /* True if the vertex lies in the half turn after vertex 0. */
        const bool middle_first =
            iccp_orient2d(ORIGIN, boundary_image(state, 0), boundary_image(state, middle)) > 0;
        const bool past = middle_first == first_half ? is_past(state, middle, z) : middle_first;
        if (past)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* Solves z = (1 - t) ((1 - lambda) p + lambda q) for the rim edge from p to q. */
static void to_polar(const disc_state *state, const double z[2], uint32_t *edge, double *lambda,
                     double *t)
{
    *edge = find_boundary_edge(state, z);
    const double *p = boundary_image(state, *edge), *q = boundary_image(state, *edge + 1);
    const double alpha = cross(z, q) / cross(p, q), beta = cross(p, z) / cross(p, q);
    *lambda = iccp_min(iccp_max(beta / (alpha + beta), 0), 1);
    *t = iccp_min(iccp_max(1 - (alpha + beta), 0), 1);
}

/* The rows are the derivatives of lambda and of t by z. */
static void polar_jet(const disc_state *state, const double z[2], uint32_t edge, double rows[2][2])
{
    const double *p = boundary_image(state, edge), *q = boundary_image(state, edge + 1);
    const double area = cross(p, q);
    const double alpha = cross(z, q) / area, beta = cross(p, z) / area, sum = alpha + beta;
    const double d_alpha[2] = {q[1] / area, -q[0] / area}, d_beta[2] = {-p[1] / area, p[0] / area};
    for (int c = 0; c < 2; ++c) {
        rows[0][c] = (d_beta[c] * alpha - beta * d_alpha[c]) / (sum * sum);
        rows[1][c] = -(d_alpha[c] + d_beta[c]);
    }
}

/* The matrix of the affine map that takes a triangle's corners `from` to `to`. */
static void triangle_jacobian(const iccp_planar *mesh, uint32_t triangle, const double *from,
                              const double *to, double j[2][2])
{
    const uint32_t *v = mesh->triangles + 3 * (size_t)triangle;
    double a[2][2], b[2][2];
    for (int c = 0; c < 2; ++c)
        for (int i = 0; i < 2; ++i) {
            a[i][c] = from[2 * (size_t)v[c + 1] + (size_t)i] - from[2 * (size_t)v[0] + (size_t)i];
            b[i][c] = to[2 * (size_t)v[c + 1] + (size_t)i] - to[2 * (size_t)v[0] + (size_t)i];
        }
    const double det =
        iccp_area2d(from + 2 * (size_t)v[0], from + 2 * (size_t)v[1], from + 2 * (size_t)v[2]);
    for (int i = 0; i < 2; ++i) {
        j[i][0] = (b[i][0] * a[1][1] - b[i][1] * a[1][0]) / det;
        j[i][1] = (b[i][1] * a[0][0] - b[i][0] * a[0][1]) / det;
    }
}

static void interpolate(const iccp_planar *mesh, uint32_t triangle, const double bary[3],
                        const double *points, double p[2])
{
    const uint32_t *v = mesh->triangles + 3 * (size_t)triangle;
    for (size_t i = 0; i < 2; ++i)
        p[i] = bary[0] * points[2 * (size_t)v[0] + i] + bary[1] * points[2 * (size_t)v[1] + i] +
               bary[2] * points[2 * (size_t)v[2] + i];
}

/* The coordinates of a point of the disc, and the rim edge that its ray meets. */
static iccp_coords coords_of(const icc_chart *chart, const double z[2], uint32_t *edge)
{
    const disc_state *state = chart->state;
    double lambda, t;
    to_polar(state, z, edge, &lambda, &t);
    const double along = iccp_planar_along(&state->mesh, chart->domain, *edge, lambda);
    return (iccp_coords){.facet = state->mesh.facet[*edge], .bary = {1 - along, along}, .t = t};
}

/* The point's triangle takes it to the disc. There the ray from the centre through the point
 * ends on a rim edge, which gives the boundary point. t is 1 minus the point's share of the ray.
 * The jet is the chain rule through both steps. */
static icc_status encode(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                         iccp_coords *coords, iccp_encode_jet *jet)
{
    (void)place;
    const disc_state *state = chart->state;
    uint32_t edge;
    double z[2];
    iccp_found found;
    const icc_status status = iccp_finder_find(&state->before, point, &found);
    if (status != ICC_OK)
        return status;
    interpolate(&state->mesh, found.triangle, found.bary, state->image, z);
    *coords = coords_of(chart, z, &edge);
    if (jet == NULL)
        return ICC_OK;
    double inner[2][2], rows[2][2];
    triangle_jacobian(&state->mesh, found.triangle, state->mesh.points, state->image, inner);
    polar_jet(state, z, edge, rows);
    for (int c = 0; c < 2; ++c) {
        jet->bary[2 + c] = iccp_planar_along_slope(&state->mesh, chart->domain, coords->facet) *
                           (rows[0][0] * inner[0][c] + rows[0][1] * inner[1][c]);
        jet->bary[c] = -jet->bary[2 + c];
        jet->t[c] = rows[1][0] * inner[0][c] + rows[1][1] * inner[1][c];
    }
    return ICC_OK;
}

static void encode_vertex(const icc_chart *chart, size_t v, iccp_coords *coords)
{
    const disc_state *state = chart->state;
    uint32_t edge;
    *coords = coords_of(chart, state->image + 2 * v, &edge);
}

/* The inverse of encode(). The point of the disc lies at the share 1 - t of the ray to the
 * boundary point's image, and its triangle takes it back to the domain. */
static icc_status decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path)
{
    (void)path;
    const disc_state *state = chart->state;
    double lambda, z[2];
    iccp_found found;
    const uint32_t edge =
        iccp_planar_edge(&state->mesh, chart->domain, coords->facet, coords->bary[1], &lambda);
    const double *p = boundary_image(state, edge), *q = boundary_image(state, edge + 1);
    for (int i = 0; i < 2; ++i)
        z[i] = (1 - coords->t) * ((1 - lambda) * p[i] + lambda * q[i]);
    const icc_status status = iccp_finder_find(&state->after, z, &found);
    if (status != ICC_OK)
        return status;
    interpolate(&state->mesh, found.triangle, found.bary, state->mesh.points, point);
    if (jet == NULL)
        return ICC_OK;
    double outer[2][2];
    triangle_jacobian(&state->mesh, found.triangle, state->image, state->mesh.points, outer);
    const double slope = iccp_planar_along_slope(&state->mesh, chart->domain, coords->facet);
    for (int i = 0; i < 2; ++i) {
        jet->t[i] = jet->bary[2 * i] = jet->bary[2 * i + 1] = 0;
        for (int c = 0; c < 2; ++c) {
            jet->bary[2 * i + 1] += outer[i][c] * (1 - coords->t) * (q[c] - p[c]) / slope;
            jet->t[i] -= outer[i][c] * ((1 - lambda) * p[c] + lambda * q[c]);
        }
    }
    return ICC_OK;
}

/* ---- the preimage of a ray ---- */

static bool holds_origin(const disc_state *state, uint32_t triangle)
{
    const uint32_t *v = state->mesh.triangles + 3 * (size_t)triangle;
    for (int k = 0; k < 3; ++k)
        if (iccp_orient2d(state->image + 2 * (size_t)v[k],
                          state->image + 2 * (size_t)v[(k + 1) % 3], ORIGIN) < 0)
            return false;
    return true;
}

/* Emits the point of the domain whose image is a crossing. In the image, the line through the
 * origin and r crosses the edge that a corner faces. */
static icc_status emit_crossing(const disc_state *state, uint32_t corner, const double r[2],
                                iccp_emit emit, void *argument)
{
    const uint32_t u = state->mesh.triangles[iccp_after(corner)];
    const uint32_t v = state->mesh.triangles[iccp_before(corner)];
    const double du = cross(r, state->image + 2 * (size_t)u);
    const double dv = cross(r, state->image + 2 * (size_t)v);
    const double share = fabs(du - dv) > 0 ? iccp_min(iccp_max(du / (du - dv), 0), 1) : 0;
    const double *p = state->mesh.points + 2 * (size_t)u, *q = state->mesh.points + 2 * (size_t)v;
    const double point[2] = {p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])};
    return emit(argument, point);
}

/* The curve is the preimage of a straight ray. It walks through the triangles of the image from
 * the rim edge to the centre, one crossing each, and exact signs decide the way. */
static icc_status trace(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                        const iccp_coords *boundary, iccp_path *path, iccp_emit emit,
                        void *argument)
{
    (void)path;
    const disc_state *state = chart->state;
    iccp_coords coords;
    icc_status status = ICC_OK;
    if (boundary != NULL)
        coords = *boundary;
    else
        status = encode(chart, point, place, &coords, NULL);
    if (status != ICC_OK)
        return status;
    if (coords.t >= 1)
        return emit(argument, point);
    double lambda, start[2], r[2];
    const uint32_t edge =
        iccp_planar_edge(&state->mesh, chart->domain, coords.facet, coords.bary[1], &lambda);
    const double *p = boundary_image(state, edge), *q = boundary_image(state, edge + 1);
    for (int i = 0; i < 2; ++i)
        r[i] = (1 - lambda) * p[i] + lambda * q[i];
    iccp_domain_facet_point(chart->domain, coords.facet, coords.bary, start);
    status = emit(argument, start);
    uint32_t corner = state->mesh.boundary_corner[edge];
    for (size_t left = state->mesh.n_triangles;
         status == ICC_OK && !holds_origin(state, corner / 3); --left) {
        const double *x = state->image + 2 * (size_t)state->mesh.triangles[corner];
        const uint32_t exit =
            iccp_orient2d(r, ORIGIN, x) > 0 ? iccp_after(corner) : iccp_before(corner);
        status = emit_crossing(state, exit, r, emit, argument);
        corner = state->mesh.twins[exit];
        if (corner == ICCP_NO_NEIGHBOUR || left == 0)
            return ICC_ERR_TRACE;
    }
    return status == ICC_OK ? emit(argument, chart->maximum) : status;
}

static void free_state(icc_chart *chart)
{
    disc_state *state = chart->state;
    iccp_finder_free(&state->before);
    iccp_finder_free(&state->after);
    iccp_planar_free(&state->mesh);
    iccp_free(&chart->memory, state->image);
    iccp_free(&chart->memory, state);
}

static icc_status ready(const icc_chart *chart, bool decodes)
{
    const disc_state *state = chart->state;
    return iccp_finder_ready(decodes ? &state->after : &state->before);
}

static void save(const icc_chart *chart, iccp_blob *w)
{
    const disc_state *state = chart->state;
    iccp_harmonic_write(chart->info.cells, &state->mesh, chart->domain, w);
    iccp_blob_f64(w, 2 * state->mesh.n_vertices, state->image);
}

const iccp_chart_ops iccp_disc_ops = {
    .number = ICC_METHOD_DISC,
    .format = ICC_METHOD_DISC,
    .is_planar = true,
    .create = iccp_harmonic_charts_create,
    .read = iccp_chart_disc_read,
    .encode = encode,
    .encode_vertex = encode_vertex,
    .decode = decode,
    .trace = trace,
    .ready = ready,
    .save = save,
    .free_state = free_state,
};

/* Counts the faults of a rim that shall go once round the origin. Every edge must turn left
 * round the origin, and the angles must grow from 0 to one turn. Then the rim is simple, and
 * every ray from the origin meets it once. It need not be convex, because rounding would spoil
 * convexity where boundary edges are very short. */
static size_t count_boundary_faults(const iccp_planar *mesh, const double *image)
{
    const size_t n = mesh->n_boundary;
    size_t n_faults = 0, n_wraps = 0;
    for (size_t k = 0; k < n; ++k) {
        const double *p = image + 2 * k, *q = image + 2 * ((k + 1) % n);
        n_faults += iccp_orient2d(ORIGIN, p, q) <= 0;
        n_wraps += p[1] < 0 && q[1] >= 0;
    }
    return n_faults + (n_wraps != 1);
}

/* Certifies the map to the disc. `domain` counts the faults of the mesh before the map. */
static icc_status certify(const iccp_planar *mesh, const iccp_certificate *domain,
                          const double *image, icc_error *err)
{
    const size_t n_inverted = iccp_count_inverted(mesh, image);
    const size_t n_rim = count_boundary_faults(mesh, image);
    if (iccp_certificate_holds(domain) && n_inverted == 0 && n_rim == 0)
        return ICC_OK;
    return iccp_fail(
        err, ICC_ERR_CERTIFICATE,
        "the map to the disc cannot be certified: %zu triangles inverted in the domain "
        "and %zu in the disc, %zu faults of topology, %zu of the rim",
        domain->n_inverted, n_inverted, domain->n_topology, n_rim);
}

/* Fills in the state. The chart's maximum is the point that goes to the origin. */
static icc_status fill_state(icc_chart *chart, const iccp_planar *mesh, const double *image,
                             const iccp_env *env)
{
    disc_state *state = chart->state;
    double maximum[2];
    iccp_found found;
    iccp_finder_init(&state->before, mesh, mesh->points, 0, ICCP_FEW_POINTS, &env->memory);
    iccp_finder_init(&state->after, mesh, image, 0, ICCP_FEW_POINTS, &env->memory);
    icc_status status = iccp_finder_budget(&state->before, env);
    if (status == ICC_OK)
        status = iccp_finder_budget(&state->after, env);
    if (status != ICC_OK)
        return status;
    if (iccp_finder_find_alone(&state->after, ORIGIN, &found) != ICC_OK)
        return ICC_ERR_CERTIFICATE;
    interpolate(mesh, found.triangle, found.bary, mesh->points, maximum);
    iccp_chart_set_maximum(chart, maximum);
    return ICC_OK;
}

/* Creates the certified chart. `seconds` is the time that the certificate took. */
static icc_status create(icc_chart **out, const icc_domain *domain, iccp_harmonic *base,
                         double **image, double seconds, const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_chart_new(out, domain, env);
    if (status != ICC_OK)
        return status;
    icc_chart *chart = *out;
    chart->ops = &iccp_disc_ops;
    chart->info.method = ICC_METHOD_DISC;
    chart->info.certified = 1;
    iccp_harmonic_describe(base, domain, &chart->info);
    chart->own.disc = (icc_disc_info){.n_mesh_vertices = base->mesh.n_vertices,
                                      .n_mesh_boundary = base->mesh.n_boundary,
                                      .n_mesh_simplices = base->mesh.n_triangles};
    chart->timings = (icc_chart_timings){
        .mesh = base->seconds_mesh, .solve = base->seconds_solve, .certify = seconds};
    disc_state *state = iccp_alloc_zero(&env->memory, 1, sizeof *state);
    chart->state = state;
    status = state != NULL ? fill_state(chart, &base->mesh, *image, env) : ICC_ERR_MEMORY;
    if (status != ICC_OK) {
        iccp_chart_release(chart);
        *out = NULL;
        if (status == ICC_ERR_CERTIFICATE)
            (void)iccp_fail(err, status, "the disc's centre lies in no triangle");
        return status;
    }
    state->mesh = iccp_harmonic_move_mesh(base);
    chart->mesh = &state->mesh;
    state->image = *image;
    *image = NULL;
    return ICC_OK;
}

icc_status iccp_chart_disc_create(icc_chart **out, const icc_domain *domain, iccp_harmonic *base,
                                  double **image, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    iccp_certificate certificate = {0};
    iccp_certify_mesh(&base->mesh, base->mesh.points, &certificate);
    const icc_status status = certify(&base->mesh, &certificate, *image, err);
    return status == ICC_OK ? create(out, domain, base, image, iccp_seconds() - start, env, err)
                            : status;
}

static bool are_in_disc(size_t n, const double *numbers)
{
    for (size_t i = 0; i < n; ++i)
        if (!(fabs(numbers[i]) <= 2))
            return false;
    return true;
}

/* Reads a chart. The mesh is certified while it is read. */
icc_status iccp_chart_disc_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                const iccp_env *env, icc_error *err)
{
    (void)err;
    iccp_harmonic base;
    *out = NULL;
    icc_status status = iccp_harmonic_read(&base, domain, r, env);
    if (status != ICC_OK)
        return status;
    const size_t n = 2 * base.mesh.n_vertices;
    double *image = iccp_alloc(&env->memory, n, sizeof *image);
    status = ICC_ERR_MEMORY;
    if (image != NULL) {
        iccp_blob_f64(r, n, image);
        status = r->status == ICC_OK && are_in_disc(n, image)
                     ? certify(&base.mesh, &(iccp_certificate){0}, image, NULL)
                     : ICC_ERR_FORMAT;
        if (status == ICC_OK)
            status = create(out, domain, &base, &image, 0, env, NULL);
    }
    iccp_free(&env->memory, image);
    iccp_harmonic_free(&base);
    return status;
}
