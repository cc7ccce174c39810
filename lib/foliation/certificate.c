/* Certifies meshes and foliations in the plane, with integers and exact signs.
 *
 * Source: index counting for discrete one-forms. T. Banchoff, Critical points and curvature for
 * embedded polyhedral surfaces, 1970. S. Gortler, C. Gotsman, D. Thurston, Discrete one-forms on
 * meshes and applications to 3D mesh parameterization, 2006. */
#include "foliation/certificate.h"

#include "math/predicates.h"

bool iccp_certificate_holds(const iccp_certificate *c)
{
    return c->n_inverted == 0 && c->n_topology == 0 && c->n_open == 0 && c->n_flat == 0 &&
           c->n_irregular == 0;
}

/* Returns true if the half-edge that a corner faces has the right partner: a twin that runs the
 * other way, or edge k of the boundary. */
static bool is_linked(const iccp_planar *mesh, uint32_t corner)
{
    const uint32_t a = mesh->triangles[iccp_after(corner)];
    const uint32_t b = mesh->triangles[iccp_before(corner)];
    const uint32_t twin = mesh->twins[corner];
    if (twin == ICCP_NO_NEIGHBOUR)
        return a < mesh->n_boundary && b == (a + 1 < mesh->n_boundary ? a + 1 : 0);
    return mesh->twins[twin] == corner && mesh->triangles[iccp_after(twin)] == b &&
           mesh->triangles[iccp_before(twin)] == a;
}

size_t iccp_count_inverted(const iccp_planar *mesh, const double *points)
{
    size_t n = 0;
    for (size_t t = 0; t < mesh->n_triangles; ++t) {
        const uint32_t *v = mesh->triangles + 3 * t;
        n += iccp_orient2d(points + 2 * (size_t)v[0], points + 2 * (size_t)v[1],
                           points + 2 * (size_t)v[2]) <= 0;
    }
    return n;
}

void iccp_certify_mesh(const iccp_planar *mesh, const double *points, iccp_certificate *certificate)
{
    size_t n_boundary = 0;
    certificate->n_topology = 0;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        n_boundary += mesh->twins[c] == ICCP_NO_NEIGHBOUR;
        certificate->n_topology += !is_linked(mesh, c);
    }
    certificate->n_inverted = iccp_count_inverted(mesh, points);
    /* vertices - edges + triangles = 1, where 2 edges = 3 triangles + boundary edges */
    const bool is_disc = n_boundary == mesh->n_boundary &&
                         2 * mesh->n_vertices == mesh->n_triangles + n_boundary + 2;
    certificate->n_topology += !is_disc;
}

/* The sign of the rise from a to b. Ties are broken by index. */
static int rise_sign(int64_t rise, uint32_t a, uint32_t b)
{
    return rise > 0 ? 1 : rise < 0 ? -1 : b > a ? 1 : -1;
}

/* The number of the centre's corner in a triangle, or -1. */
static int centre_corner(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle)
{
    for (int k = 0; k < 3; ++k)
        if (mesh->triangles[3 * triangle + (uint32_t)k] == psi->centre)
            return k;
    return -1;
}

/* Adds the triangle's sign change, which happens at the vertex whose label is the middle one. */
static void check_triangle(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle,
                           uint32_t *n_changes, iccp_certificate *certificate)
{
    const uint32_t *v = mesh->triangles + 3 * (size_t)triangle;
    const int64_t *rise = psi->rise + 3 * (size_t)triangle;
    certificate->n_open += rise[0] + rise[1] + rise[2] != 0;
    certificate->n_flat += rise[0] == 0 && rise[1] == 0 && rise[2] == 0;
    for (int k = 0; k < 3; ++k) {
        const int after = (k + 1) % 3, before = (k + 2) % 3;
        const uint32_t corner = 3 * triangle + (uint32_t)k, twin = mesh->twins[corner];
        certificate->n_open += twin != ICCP_NO_NEIGHBOUR && psi->rise[twin] != -rise[k];
        certificate->n_ties += rise[k] == 0 && twin > corner;
        /* Corner `before` faces the half-edge from k to `after`. Corner `after` faces the one
         * from `before` to k. */
        const int to_after = rise_sign(rise[before], v[k], v[after]);
        const int to_before = -rise_sign(rise[after], v[before], v[k]);
        n_changes[v[k]] += to_after != to_before;
    }
}

static void check_rims(const iccp_planar *mesh, const iccp_psi *psi, iccp_certificate *certificate)
{
    int64_t winding = 0;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const bool on_boundary = mesh->twins[c] == ICCP_NO_NEIGHBOUR;
        if (on_boundary)
            winding += psi->rise[c];
        if (on_boundary || mesh->triangles[c] == psi->centre)
            certificate->n_flat += psi->rise[c] <= 0;
    }
    certificate->n_irregular += winding != ICCP_TURN;
}

icc_status iccp_certify_psi(const iccp_planar *mesh, const iccp_psi *psi,
                            iccp_certificate *certificate, const iccp_memory *memory)
{
    certificate->n_open = certificate->n_flat = 0;
    certificate->n_irregular = certificate->n_ties = 0;
    uint32_t *n_changes = iccp_alloc_zero(memory, mesh->n_vertices, sizeof *n_changes);
    uint8_t *at_rim = iccp_alloc_zero(memory, mesh->n_vertices, 1);
    const bool ready = n_changes != NULL && at_rim != NULL;
    for (uint32_t t = 0; ready && t < mesh->n_triangles; ++t) {
        const int k = centre_corner(mesh, psi, t);
        if (k < 0)
            check_triangle(mesh, psi, t, n_changes, certificate);
        else
            at_rim[mesh->triangles[3 * t + (uint32_t)(k + 1) % 3]] = 1;
    }
    /* Count the changes along the link of each vertex, in the mesh without the centre. An inner
     * vertex has a circle with two runs, so two changes. A vertex at one rim has a path with one
     * change. A vertex at both rims has two paths, one higher and one lower. */
    for (uint32_t v = 0; ready && v < mesh->n_vertices; ++v)
        if (v != psi->centre)
            certificate->n_irregular += n_changes[v] + (v < mesh->n_boundary) + at_rim[v] != 2;
    if (ready)
        check_rims(mesh, psi, certificate);
    iccp_free(memory, n_changes);
    iccp_free(memory, at_rim);
    return ready ? ICC_OK : ICC_ERR_MEMORY;
}
