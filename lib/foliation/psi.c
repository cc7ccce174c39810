/* Computes psi: the boundary flux, the harmonic function inside, and its rounding to integers.
 *
 * Source: S. Gortler, C. Gotsman, D. Thurston, Discrete one-forms on meshes and applications to 3D
 * mesh parameterization, 2006. docs/theory/charts-plane.md has the statement and its limits. */
#include "foliation/psi.h"

#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* Turns from the direction of a to the direction of b, both seen from the centre, in (-1/2,
 * 1/2]. An edge that does not meet the centre spans less than half a turn. */
static double angle_between(const iccp_planar *mesh, uint32_t centre, uint32_t a, uint32_t b)
{
    const double *m = mesh->points + 2 * (size_t)centre;
    const double *p = mesh->points + 2 * (size_t)a, *q = mesh->points + 2 * (size_t)b;
    const double px = p[0] - m[0], py = p[1] - m[1], qx = q[0] - m[0], qy = q[1] - m[1];
    return iccp_atan2_turns(px * qy - py * qx, px * qx + py * qy);
}

static uint32_t boundary_after(const iccp_planar *mesh, uint32_t k)
{
    return k + 1 < mesh->n_boundary ? k + 1 : 0;
}

static double boundary_length(const iccp_planar *mesh, uint32_t k)
{
    const double *p = mesh->points + 2 * (size_t)k;
    const double *q = mesh->points + 2 * (size_t)boundary_after(mesh, k);
    return iccp_hypot(q[0] - p[0], q[1] - p[1]);
}

/* Computes the flux of each boundary edge: its share of the turn. The shares sum to 1. */
static icc_status boundary_flux(double *flux, const iccp_planar *mesh,
                                const iccp_laplacian *laplacian, const iccp_ldlt *solver,
                                uint32_t centre, double harmonic, const iccp_env *env)
{
    const size_t n = laplacian->matrix.n, n_boundary = mesh->n_boundary;
    double *green = iccp_alloc_zero(&env->memory, n, sizeof *green);
    double *inflow = iccp_alloc_zero(&env->memory, n_boundary, sizeof *inflow);
    icc_status status = green != NULL && inflow != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        green[centre - n_boundary] = 1;
        status = iccp_spd_solve(solver, 1, green, env);
    }
    if (status == ICC_OK) {
        double total = 0, perimeter = 0;
        for (size_t i = 0; i < n; ++i)
            for (size_t p = laplacian->boundary_first[i]; p < laplacian->boundary_first[i + 1]; ++p)
                inflow[laplacian->boundary_vertex[p]] += laplacian->boundary_weight[p] * green[i];
        for (uint32_t k = 0; k < n_boundary; ++k) {
            total += inflow[k];
            perimeter += boundary_length(mesh, k);
        }
        for (uint32_t k = 0; k < n_boundary; ++k)
            flux[k] = harmonic * 0.5 * (inflow[k] + inflow[boundary_after(mesh, k)]) / total +
                      (1 - harmonic) * boundary_length(mesh, k) / perimeter;
    }
    iccp_free(&env->memory, green);
    iccp_free(&env->memory, inflow);
    return status;
}

/* Writes psi as the angle about the centre plus phi, in turns, where phi has a single value. The
 * flux determines phi on the boundary, where it starts with 0. */
static void boundary_phi(double *phi, const iccp_planar *mesh, uint32_t centre, const double *flux)
{
    phi[0] = 0;
    for (uint32_t k = 0; k + 1 < mesh->n_boundary; ++k)
        phi[k + 1] = phi[k] + flux[k] - angle_between(mesh, centre, k, k + 1);
}

/* Right side of the equations for phi. Row i: sum over neighbours j of w_ij (phi_j - phi_i +
 * angle from i to j) = 0. The angle from j to i is minus the angle from i to j. */
static void right_side(double *b, const iccp_planar *mesh, const iccp_laplacian *open,
                       uint32_t centre, const double *phi)
{
    const uint32_t n_boundary = (uint32_t)mesh->n_boundary;
    memset(b, 0, open->matrix.n * sizeof *b);
    for (uint32_t i = 0; i < open->matrix.n; ++i) {
        for (size_t p = open->first[i]; p < open->first[i + 1]; ++p) {
            const uint32_t j = open->column[p];
            if (j < i)
                continue;
            const double turn =
                open->value[p] * angle_between(mesh, centre, n_boundary + i, n_boundary + j);
            b[i] -= turn;
            b[j] += turn;
        }
        for (size_t p = open->boundary_first[i]; p < open->boundary_first[i + 1]; ++p) {
            const uint32_t k = open->boundary_vertex[p];
            b[i] += open->boundary_weight[p] *
                    (phi[k] + angle_between(mesh, centre, n_boundary + i, k));
        }
    }
}

/* psi turns once round the centre, so it has no single value. The angle round the centre turns
 * equally often, so their difference phi is an ordinary function. phi is known on the boundary,
 * and its Laplacian inside is minus that of the angle. The equations leave out the centre, where
 * the angle is not defined. */
static icc_status solve_phi(double *phi, const iccp_planar *mesh, uint32_t centre,
                            const iccp_env *env)
{
    iccp_laplacian open;
    iccp_ldlt solver;
    icc_status status = iccp_progress(env, "solve", 0);
    if (status == ICC_OK)
        status = iccp_laplacian_create(&open, mesh, centre, env);
    if (status != ICC_OK)
        return status;
    status = iccp_spd_create(&solver, &open.matrix, env);
    if (status == ICC_OK) {
        right_side(phi + mesh->n_boundary, mesh, &open, centre, phi);
        status = iccp_spd_solve(&solver, 1, phi + mesh->n_boundary, env);
        iccp_ldlt_free(&solver);
    }
    iccp_laplacian_free(&open);
    return status;
}

static int64_t to_units(double turns)
{
    const int64_t units = (int64_t)((turns - floor(turns)) * (double)ICCP_TURN);
    return units < ICCP_TURN ? units : 0;
}

/* The difference of two labels, lifted to the value nearest to `wanted`, the difference of the
 * real values. */
static int64_t lifted(int64_t difference, double wanted)
{
    const double turns = wanted - (double)difference / (double)ICCP_TURN;
    return difference + (int64_t)floor(turns + 0.5) * ICCP_TURN;
}

static void quantise(iccp_psi *psi, const iccp_planar *mesh, const double *phi)
{
    for (uint32_t v = 0; v < mesh->n_vertices; ++v)
        psi->label[v] =
            v == psi->centre ? 0 : to_units(angle_between(mesh, psi->centre, 0, v) + phi[v]);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->triangles[iccp_after(c)];
        const uint32_t b = mesh->triangles[iccp_before(c)];
        psi->rise[c] = 0;
        if (a != psi->centre && b != psi->centre)
            psi->rise[c] = lifted(psi->label[b] - psi->label[a],
                                  phi[b] - phi[a] + angle_between(mesh, psi->centre, a, b));
    }
}

icc_status iccp_psi_create(iccp_psi *psi, const iccp_planar *mesh, const iccp_laplacian *laplacian,
                           const iccp_ldlt *solver, uint32_t centre, double harmonic,
                           const iccp_env *env)
{
    *psi = (iccp_psi){.memory = env->memory, .centre = centre};
    psi->label = iccp_alloc(&env->memory, mesh->n_vertices, sizeof *psi->label);
    psi->rise = iccp_alloc(&env->memory, mesh->n_triangles, 3 * sizeof *psi->rise);
    double *flux = iccp_alloc(&env->memory, mesh->n_boundary, sizeof *flux);
    double *phi = iccp_alloc(&env->memory, mesh->n_vertices, sizeof *phi);
    icc_status status = ICC_ERR_MEMORY;
    if (psi->label != NULL && psi->rise != NULL && flux != NULL && phi != NULL)
        status = boundary_flux(flux, mesh, laplacian, solver, centre, harmonic, env);
    if (status == ICC_OK) {
        boundary_phi(phi, mesh, centre, flux);
        status = solve_phi(phi, mesh, centre, env);
    }
    if (status == ICC_OK)
        quantise(psi, mesh, phi);
    else
        iccp_psi_free(psi);
    iccp_free(&env->memory, flux);
    iccp_free(&env->memory, phi);
    return status;
}

void iccp_psi_free(iccp_psi *psi)
{
    iccp_free(&psi->memory, psi->label);
    iccp_free(&psi->memory, psi->rise);
    *psi = (iccp_psi){.memory = psi->memory};
}
