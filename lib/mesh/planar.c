/* Based on: the domain meshes of docs/theory.md; the triangulation is mesh/triangulate.c. */
#include "mesh/planar.h"

#include "base/error.h"
#include "domain/locate.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

/* Lattice points closer to the boundary than this, in lattice steps, would make flat triangles. */
static const double CLEARANCE = 0.6;

double iccp_planar_step(const icc_domain *domain, int32_t cells)
{
    return fmax(domain->upper[0] - domain->lower[0], domain->upper[1] - domain->lower[1]) / cells;
}

static double facet_length(const icc_domain *domain, size_t facet)
{
    const double *a = domain->vertices + 2 * (size_t)domain->facets[2 * facet];
    const double *b = domain->vertices + 2 * (size_t)domain->facets[2 * facet + 1];
    return hypot(b[0] - a[0], b[1] - a[1]);
}

static void raise_pieces(uint32_t *pieces, const icc_domain *domain, int32_t cells)
{
    double perimeter = 0;
    for (size_t f = 0; f < domain->n_facets; ++f)
        perimeter += facet_length(domain, f);
    const double step = fmax(iccp_planar_step(domain, cells), perimeter / ((double)cells * cells));
    for (size_t f = 0; f < domain->n_facets; ++f)
        pieces[f] = (uint32_t)fmax(pieces[f], ceil(facet_length(domain, f) / step));
}

void iccp_planar_pieces(uint32_t *pieces, const icc_domain *a, const icc_domain *b,
                        int32_t cells)
{
    for (size_t f = 0; f < a->n_facets; ++f)
        pieces[f] = 1;
    raise_pieces(pieces, a, cells);
    if (b != NULL)
        raise_pieces(pieces, b, cells);
}

/* ---- boundary ---- */

/* Edge k of the ring counter-clockwise, and whether its facet runs that way too. */
static uint32_t ring_facet(const icc_domain *domain, size_t k)
{
    const iccp_ring *ring = &domain->locator->ring;
    return ring->facet[domain->orientation > 0 ? k : ring->n - 1 - k];
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
    const double rest = fmin(fmax(along * n - piece, 0), 1);
    *lambda = domain->orientation > 0 ? rest : 1 - rest;
    return domain->orientation > 0 ? mesh->first[facet] + piece : mesh->first[facet] - piece;
}

/* ---- inside ---- */

static bool is_clear(const icc_domain *domain, const double p[2], double distance)
{
    if (iccp_domain_locate(domain, p, true, NULL, NULL) != ICC_INSIDE)
        return false;
    double t, distance2;
    (void)iccp_boxtree_nearest(&domain->locator->tree, p, &t, &distance2);
    return distance2 > distance * distance;
}

/* Rows of a lattice of equilateral triangles, centred in the bounding box. */
static icc_status place_lattice(iccp_planar *mesh, const icc_domain *domain, double step,
                                size_t capacity, const iccp_env *env)
{
    const double rise = 0.5 * sqrt(3.0) * step;
    const double width = domain->upper[0] - domain->lower[0];
    const double height = domain->upper[1] - domain->lower[1];
    const size_t n_rows = (size_t)(height / rise) + 1, n_columns = (size_t)(width / step) + 2;
    const double y0 = domain->lower[1] + 0.5 * (height - (double)(n_rows - 1) * rise);
    const double x0 = domain->lower[0] + 0.5 * (width - (double)(n_columns - 1) * step);
    for (size_t j = 0; j < n_rows; ++j) {
        const icc_status status = iccp_progress(env, "mesh", (double)j / (double)n_rows);
        if (status != ICC_OK)
            return status;
        for (size_t i = 0; i < n_columns && mesh->n_vertices < capacity; ++i) {
            double *p = mesh->points + 2 * mesh->n_vertices;
            p[0] = x0 + ((double)i + (j % 2 == 0 ? 0.25 : -0.25)) * step;
            p[1] = y0 + (double)j * rise;
            if (is_clear(domain, p, CLEARANCE * step))
                ++mesh->n_vertices;
        }
    }
    return ICC_OK;
}

static size_t lattice_capacity(const icc_domain *domain, double step)
{
    const double width = domain->upper[0] - domain->lower[0];
    const double height = domain->upper[1] - domain->lower[1];
    return ((size_t)(height / (0.5 * sqrt(3.0) * step)) + 1) * ((size_t)(width / step) + 2);
}

/* ---- chords ---- */

static bool turns_left(const iccp_planar *mesh, uint32_t a, uint32_t b, const double *c)
{
    return iccp_orient2d(mesh->points + 2 * (size_t)a, mesh->points + 2 * (size_t)b, c) > 0;
}

static void link_corners(iccp_planar *mesh, uint32_t a, uint32_t b)
{
    mesh->twins[a] = b;
    if (b != ICCP_NO_NEIGHBOUR)
        mesh->twins[b] = a;
}

static void write_triangle(iccp_planar *mesh, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
    mesh->triangles[3 * (size_t)t] = a;
    mesh->triangles[3 * (size_t)t + 1] = b;
    mesh->triangles[3 * (size_t)t + 2] = c;
}

/* Cuts the edge that a corner faces at its middle, and the two triangles beside it in two, unless
 * rounding of the middle would make one of the four not positive. */
static void split_edge(iccp_planar *mesh, uint32_t corner)
{
    const uint32_t twin = mesh->twins[corner];
    const uint32_t after = iccp_corner_after(corner), before = iccp_corner_before(corner);
    const uint32_t twin_after = iccp_corner_after(twin), twin_before = iccp_corner_before(twin);
    const uint32_t a = mesh->triangles[after], b = mesh->triangles[before];
    const uint32_t x = mesh->triangles[corner], y = mesh->triangles[twin];
    const double *pa = mesh->points + 2 * (size_t)a, *pb = mesh->points + 2 * (size_t)b;
    const double middle[2] = {0.5 * pa[0] + 0.5 * pb[0], 0.5 * pa[1] + 0.5 * pb[1]};
    if (!turns_left(mesh, x, a, middle) || !turns_left(mesh, b, x, middle) ||
        !turns_left(mesh, y, b, middle) || !turns_left(mesh, a, y, middle))
        return;
    const uint32_t m = (uint32_t)mesh->n_vertices++;
    memcpy(mesh->points + 2 * (size_t)m, middle, sizeof middle);
    const uint32_t near_new = (uint32_t)mesh->n_triangles++, far_new = (uint32_t)mesh->n_triangles++;
    const uint32_t near_side = mesh->twins[after], far_side = mesh->twins[twin_after];
    write_triangle(mesh, near_new, x, m, b);
    write_triangle(mesh, far_new, y, m, a);
    mesh->triangles[before] = m;
    mesh->triangles[twin_before] = m;
    link_corners(mesh, corner, 3 * far_new);
    link_corners(mesh, twin, 3 * near_new);
    link_corners(mesh, 3 * near_new + 1, near_side);
    link_corners(mesh, 3 * far_new + 1, far_side);
    link_corners(mesh, 3 * near_new + 2, after);
    link_corners(mesh, 3 * far_new + 2, twin_after);
}

/* New triangles come last, so that an edge which a cut hands over to one is still met. */
static void split_chords(iccp_planar *mesh)
{
    const uint32_t n = (uint32_t)mesh->n_boundary;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c)
        if (mesh->twins[c] != ICCP_NO_NEIGHBOUR && mesh->triangles[iccp_corner_after(c)] < n &&
            mesh->triangles[iccp_corner_before(c)] < n)
            split_edge(mesh, c);
}

/* ---- all of it ---- */

static icc_status allocate(iccp_planar *mesh, const icc_domain *domain, size_t capacity)
{
    const size_t n_facets = domain->n_facets, most = capacity + mesh->n_boundary;
    mesh->points = iccp_alloc(&mesh->memory, most, 2 * sizeof(double));
    mesh->triangles = iccp_alloc(&mesh->memory, 2 * most, 3 * sizeof(uint32_t));
    mesh->twins = iccp_alloc(&mesh->memory, 2 * most, 3 * sizeof(uint32_t));
    mesh->facet = iccp_alloc(&mesh->memory, mesh->n_boundary, sizeof(uint32_t));
    mesh->first = iccp_alloc(&mesh->memory, n_facets, sizeof(uint32_t));
    mesh->pieces = iccp_alloc(&mesh->memory, n_facets, sizeof(uint32_t));
    return mesh->points != NULL && mesh->triangles != NULL && mesh->twins != NULL &&
                   mesh->facet != NULL && mesh->first != NULL && mesh->pieces != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

icc_status iccp_planar_create(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                              int32_t cells, const iccp_env *env, icc_error *err)
{
    *mesh = (iccp_planar){.memory = env->memory};
    const double step = iccp_planar_step(domain, cells);
    for (size_t f = 0; f < domain->n_facets; ++f)
        mesh->n_boundary += pieces[f];
    const size_t capacity = mesh->n_boundary + lattice_capacity(domain, step);
    icc_status status = allocate(mesh, domain, capacity);
    if (status != ICC_OK) {
        iccp_planar_free(mesh);
        return iccp_fail_memory(err);
    }
    memcpy(mesh->pieces, pieces, domain->n_facets * sizeof *pieces);
    place_boundary(mesh, domain);
    mesh->n_vertices = mesh->n_boundary;
    status = place_lattice(mesh, domain, step, capacity, env);
    if (status == ICC_OK)
        status = iccp_triangulate_mesh(mesh->n_boundary, mesh->n_vertices, mesh->points,
                                       mesh->triangles, mesh->twins, env, err);
    if (status != ICC_OK) {
        iccp_planar_free(mesh);
        return status;
    }
    mesh->n_triangles = 2 * mesh->n_vertices - mesh->n_boundary - 2;
    split_chords(mesh);
    return ICC_OK;
}

void iccp_planar_free(iccp_planar *mesh)
{
    iccp_free(&mesh->memory, mesh->points);
    iccp_free(&mesh->memory, mesh->triangles);
    iccp_free(&mesh->memory, mesh->twins);
    iccp_free(&mesh->memory, mesh->facet);
    iccp_free(&mesh->memory, mesh->first);
    iccp_free(&mesh->memory, mesh->pieces);
    *mesh = (iccp_planar){.memory = mesh->memory};
}
