/* Meshes a polygonal domain. Based on the domain meshes of docs/theory/charts-plane.md; the
 * triangulation is mesh/triangulate.c. */
#include "mesh/planar.h"

#include "base/error.h"
#include "base/minmax.h"
#include "geometry/locate.h"
#include "math/elementary.h"
#include "math/predicates.h"
#include "mesh/corners.h"
#include "mesh/grading.h"

#include <math.h>
#include <string.h>

double iccp_planar_step(const icc_domain *domain, int32_t cells)
{
    return iccp_max(domain->upper[0] - domain->lower[0], domain->upper[1] - domain->lower[1]) /
           cells;
}

static double facet_length(const icc_domain *domain, size_t facet)
{
    const double *a = domain->vertices + 2 * (size_t)domain->facets[2 * facet];
    const double *b = domain->vertices + 2 * (size_t)domain->facets[2 * facet + 1];
    return iccp_hypot(b[0] - a[0], b[1] - a[1]);
}

/* Avoids the square root for most facets that are shorter. */
static bool is_shorter(const icc_domain *domain, size_t facet, double step)
{
    const double *a = domain->vertices + 2 * (size_t)domain->facets[2 * facet];
    const double *b = domain->vertices + 2 * (size_t)domain->facets[2 * facet + 1];
    return fabs(b[0] - a[0]) + fabs(b[1] - a[1]) < 0.99 * step;
}

static void raise_pieces(uint32_t *pieces, const icc_domain *domain, int32_t cells)
{
    double perimeter = 0;
    for (size_t f = 0; f < domain->n_facets; ++f)
        perimeter += facet_length(domain, f);
    const double step =
        iccp_max(iccp_planar_step(domain, cells), perimeter / ((double)cells * cells));
    for (size_t f = 0; f < domain->n_facets; ++f)
        if (!is_shorter(domain, f, step))
            pieces[f] = (uint32_t)iccp_max(pieces[f], ceil(facet_length(domain, f) / step));
}

void iccp_planar_pieces(uint32_t *pieces, const icc_domain *a, const icc_domain *b, int32_t cells)
{
    for (size_t f = 0; f < a->n_facets; ++f)
        pieces[f] = 1;
    raise_pieces(pieces, a, cells);
    if (b != NULL)
        raise_pieces(pieces, b, cells);
}

/* ---- boundary ---- */

/* Returns the facet of edge k of the polygon, counter-clockwise, and whether the facet has the same
 * direction. */
static uint32_t ring_facet(const icc_domain *domain, size_t k)
{
    const iccp_polygon *polygon = &domain->locator->polygon;
    return iccp_polygon_facet(polygon,
                              (uint32_t)(domain->orientation > 0 ? k : polygon->n - 1 - k));
}

static void place_boundary(iccp_planar *mesh, const icc_domain *domain)
{
    uint32_t next = 0;
    for (size_t k = 0; k < domain->n_facets; ++k) {
        const uint32_t facet = ring_facet(domain, k), n = mesh->pieces[facet];
        mesh->first[facet] = domain->orientation > 0 ? next : next + n - 1;
        for (uint32_t j = 0; j < n; ++j) {
            const double share = (double)j / n;
            const double along = domain->orientation > 0 ? share : 1 - share;
            const double bary[2] = {1 - along, along};
            iccp_domain_facet_point(domain, facet, bary, mesh->points + 2 * (size_t)next);
            mesh->facet[next++] = facet;
        }
    }
}

double iccp_planar_along(const iccp_planar *mesh, const icc_domain *domain, uint32_t k,
                         double lambda)
{
    const uint32_t facet = mesh->facet[k], first = mesh->first[facet], n = mesh->pieces[facet];
    if (domain->orientation > 0)
        return (k - first + lambda) / n;
    return (first - k + (1 - lambda)) / n;
}

uint32_t iccp_planar_edge(const iccp_planar *mesh, const icc_domain *domain, uint32_t facet,
                          double along, double *lambda)
{
    const uint32_t n = mesh->pieces[facet];
    uint32_t piece = (uint32_t)(along * n);
    if (piece >= n)
        piece = n - 1;
    const double rest = iccp_min(iccp_max(along * n - piece, 0), 1);
    *lambda = domain->orientation > 0 ? rest : 1 - rest;
    return domain->orientation > 0 ? mesh->first[facet] + piece : mesh->first[facet] - piece;
}

double iccp_planar_along_slope(const iccp_planar *mesh, const icc_domain *domain, uint32_t facet)
{
    return (double)domain->orientation / mesh->pieces[facet];
}

/* ---- inside ---- */

/* Writes the length of the longer of the two edges at each boundary vertex. */
static void edge_lengths(const iccp_planar *mesh, double *length)
{
    const size_t n = mesh->n_boundary;
    double before = 0;
    for (size_t k = n; k-- > 0;) {
        const double *p = mesh->points + 2 * k, *q = mesh->points + 2 * ((k + 1) % n);
        length[k] = iccp_hypot(q[0] - p[0], q[1] - p[1]);
    }
    const double last = length[n - 1];
    for (size_t k = 0; k < n; ++k) {
        const double own = length[k];
        length[k] = iccp_max(own, k > 0 ? before : last);
        before = own;
    }
}

static icc_status inner_points(const iccp_planar *mesh, const icc_domain *domain, double step,
                               double **points, size_t *n_points, const iccp_env *env)
{
    double *length = iccp_alloc(&env->memory, mesh->n_boundary, sizeof *length);
    if (length == NULL)
        return ICC_ERR_MEMORY;
    edge_lengths(mesh, length);
    const iccp_samples samples = {mesh->n_boundary, mesh->points, length};
    const icc_status status = iccp_graded_points(domain, &samples, step, points, n_points, env);
    iccp_free(&env->memory, length);
    return status;
}

/* ---- chords ---- */

static bool turns_left(const iccp_planar *mesh, uint32_t a, uint32_t b, const double *c)
{
    return iccp_orient2d(mesh->points + 2 * (size_t)a, mesh->points + 2 * (size_t)b, c) > 0;
}

/* Cuts the edge that a corner faces at its middle, unless rounding would make one of the four new
 * triangles not positive. */
static void split_edge(iccp_planar *mesh, iccp_corners *corners, uint32_t corner)
{
    const uint32_t twin = mesh->twins[corner];
    const uint32_t a = mesh->triangles[iccp_after(corner)],
                   b = mesh->triangles[iccp_before(corner)];
    const uint32_t x = mesh->triangles[corner], y = mesh->triangles[twin];
    const double *pa = mesh->points + 2 * (size_t)a, *pb = mesh->points + 2 * (size_t)b;
    const double middle[2] = {0.5 * pa[0] + 0.5 * pb[0], 0.5 * pa[1] + 0.5 * pb[1]};
    if (!turns_left(mesh, x, a, middle) || !turns_left(mesh, b, x, middle) ||
        !turns_left(mesh, y, b, middle) || !turns_left(mesh, a, y, middle))
        return;
    memcpy(mesh->points + 2 * mesh->n_vertices, middle, sizeof middle);
    iccp_cut_edge(corners, corner, (uint32_t)mesh->n_vertices++);
}

/* Whether a corner faces an inner edge between two boundary vertices. */
static bool faces_chord(const iccp_planar *mesh, uint32_t corner)
{
    return mesh->twins[corner] != ICCP_NO_NEIGHBOUR &&
           mesh->triangles[iccp_after(corner)] < mesh->n_boundary &&
           mesh->triangles[iccp_before(corner)] < mesh->n_boundary;
}

/* Each cut adds a vertex and two triangles. */
static icc_status make_room_for_cuts(iccp_planar *mesh)
{
    const iccp_memory *memory = &mesh->memory;
    const size_t n_vertices = mesh->n_vertices, n_triangles = mesh->n_triangles;
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * n_triangles; ++c)
        n += faces_chord(mesh, c) && c < mesh->twins[c];
    if (n == 0)
        return ICC_OK;
    const size_t size = 3 * sizeof *mesh->triangles, room = n_triangles + 2 * n;
    return iccp_enlarge(memory, &mesh->points, n_vertices, n_vertices + n,
                        2 * sizeof *mesh->points) &&
                   iccp_enlarge(memory, &mesh->triangles, n_triangles, room, size) &&
                   iccp_enlarge(memory, &mesh->twins, n_triangles, room, size)
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* New triangles are added at the end, so the loop also visits an edge that a cut moves to a new
 * triangle. */
static icc_status split_chords(iccp_planar *mesh)
{
    const icc_status status = make_room_for_cuts(mesh);
    if (status != ICC_OK)
        return status;
    iccp_corners corners = {mesh->triangles, mesh->twins, mesh->n_triangles};
    for (uint32_t c = 0; c < 3 * corners.n_triangles; ++c)
        if (faces_chord(mesh, c))
            split_edge(mesh, &corners, c);
    mesh->n_triangles = corners.n_triangles;
    return ICC_OK;
}

void iccp_planar_list_boundary(iccp_planar *mesh)
{
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c)
        if (mesh->twins[c] == ICCP_NO_NEIGHBOUR)
            mesh->boundary_corner[mesh->triangles[iccp_after(c)]] = c;
}

/* ---- the whole mesh ---- */

static icc_status allocate_boundary(iccp_planar *mesh, const icc_domain *domain)
{
    const size_t n_facets = domain->n_facets;
    mesh->points = iccp_alloc(&mesh->memory, mesh->n_boundary, 2 * sizeof(double));
    mesh->facet = iccp_alloc(&mesh->memory, mesh->n_boundary, sizeof(uint32_t));
    mesh->boundary_corner = iccp_alloc(&mesh->memory, mesh->n_boundary, sizeof(uint32_t));
    mesh->first = iccp_alloc(&mesh->memory, n_facets, sizeof(uint32_t));
    mesh->pieces = iccp_alloc(&mesh->memory, n_facets, sizeof(uint32_t));
    return mesh->points != NULL && mesh->facet != NULL && mesh->boundary_corner != NULL &&
                   mesh->first != NULL && mesh->pieces != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static icc_status begin_boundary(iccp_planar *mesh, const icc_domain *domain,
                                 const uint32_t *pieces)
{
    for (size_t f = 0; f < domain->n_facets; ++f)
        mesh->n_boundary += pieces[f];
    const icc_status status = allocate_boundary(mesh, domain);
    if (status != ICC_OK)
        return status;
    memcpy(mesh->pieces, pieces, domain->n_facets * sizeof *pieces);
    place_boundary(mesh, domain);
    return ICC_OK;
}

/* Allocates points after those of the boundary, and triangles. */
static icc_status allocate_rest(iccp_planar *mesh, size_t n_inner, size_t n_triangles)
{
    const size_t n = mesh->n_boundary;
    double *points =
        iccp_grow(&mesh->memory, mesh->points, 2 * n, 2 * (n + n_inner), sizeof *points);
    if (points == NULL)
        return ICC_ERR_MEMORY;
    mesh->points = points;
    mesh->triangles = iccp_alloc(&mesh->memory, n_triangles, 3 * sizeof(uint32_t));
    mesh->twins = iccp_alloc(&mesh->memory, n_triangles, 3 * sizeof(uint32_t));
    return mesh->triangles != NULL && mesh->twins != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Appends the inner points and makes room for the triangles between all points. */
static icc_status allocate_inside(iccp_planar *mesh, const double *inner, size_t n_inner)
{
    mesh->n_vertices = mesh->n_boundary + n_inner;
    mesh->n_triangles = 2 * mesh->n_vertices - mesh->n_boundary - 2;
    const icc_status status = allocate_rest(mesh, n_inner, mesh->n_triangles);
    if (status == ICC_OK && n_inner > 0)
        memcpy(mesh->points + 2 * mesh->n_boundary, inner, 2 * n_inner * sizeof *inner);
    return status;
}

static icc_status fill_mesh(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                            double step, const iccp_env *env, icc_error *err)
{
    double *inner = NULL;
    size_t n_inner = 0;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 3}, env);
    icc_status status = begin_boundary(mesh, domain, pieces);
    if (status == ICC_OK)
        status = inner_points(mesh, domain, step, &inner, &n_inner, &part[0]);
    if (status == ICC_OK)
        status = allocate_inside(mesh, inner, n_inner);
    iccp_free(&mesh->memory, inner);
    if (status == ICC_OK)
        status = iccp_triangulate_mesh(mesh->n_boundary, mesh->n_vertices, mesh->points,
                                       mesh->triangles, mesh->twins, &part[1], err);
    /* The domain is simple, but points along its facets are rounded, so they can touch. */
    if (status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE)
        status = iccp_fail(err, ICC_ERR_CERTIFICATE,
                           "the domain cannot be meshed: two of its sides are closer than rounding "
                           "errors of points on them");
    if (status == ICC_OK)
        status = split_chords(mesh);
    if (status == ICC_OK)
        iccp_planar_list_boundary(mesh);
    return status;
}

icc_status iccp_planar_create(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                              int32_t cells, const iccp_env *env, icc_error *err)
{
    *mesh = (iccp_planar){.memory = env->memory};
    const icc_status status =
        fill_mesh(mesh, domain, pieces, iccp_planar_step(domain, cells), env, err);
    if (status != ICC_OK)
        iccp_planar_free(mesh);
    return status;
}

icc_status iccp_planar_begin(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                             size_t n_inner, size_t n_triangles, const iccp_env *env)
{
    *mesh = (iccp_planar){.memory = env->memory};
    icc_status status = begin_boundary(mesh, domain, pieces);
    if (status == ICC_OK)
        status = allocate_rest(mesh, n_inner, n_triangles);
    mesh->n_vertices = mesh->n_boundary + n_inner;
    mesh->n_triangles = n_triangles;
    if (status != ICC_OK)
        iccp_planar_free(mesh);
    return status;
}

void iccp_planar_free(iccp_planar *mesh)
{
    iccp_free(&mesh->memory, mesh->points);
    iccp_free(&mesh->memory, mesh->triangles);
    iccp_free(&mesh->memory, mesh->twins);
    iccp_free(&mesh->memory, mesh->facet);
    iccp_free(&mesh->memory, mesh->boundary_corner);
    iccp_free(&mesh->memory, mesh->first);
    iccp_free(&mesh->memory, mesh->pieces);
    *mesh = (iccp_planar){.memory = mesh->memory};
}
