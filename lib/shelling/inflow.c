/* Computes what flows in through each facet of the boundary.
 *
 * Source: P. Doyle, J. L. Snell, Random Walks and Electric Networks, 1984, section 1.3. The
 * simplices form a network. The star of the centre is one pole, with potential 1, and the boundary
 * is the other, with potential 0. So the small potentials at the ends of limbs keep all their
 * digits.
 *
 * F. Bornemann, P. Deuflhard, The cascadic multigrid method for elliptic problems, Numer. Math.
 * 75, 1996. The much smaller network of the vertices is solved exactly. A few sweeps lead from
 * there to a solution that is near enough. Any positive inflow is admissible, and this one is
 * positive, because it consists of means with positive weights. */
#include "shelling/reference.h"

#include "math/spd.h"
#include "shelling/element.h"
#include "shelling/stiffness.h"

#define NONE UINT32_MAX

/* Simplices between calls of the progress callback. */
enum { SIMPLICES_PER_REPORT = 1 << 14 };

/* Number of sweeps, each forwards and backwards. More sweeps did not lower the distortion of the
 * maps of 8 pairs of bodies. With one sweep the least determinants were smaller by a tenth. */
enum { SWEEPS = 3 };

typedef struct network {
    const iccp_simplices *mesh;
    bool *fixed;       /* of each vertex: it is on the boundary, with potential 0, or in the star,
                          with potential 1 */
    double *vertex;    /* of each vertex: the potential */
    double *wire;      /* of each side: the conductance through it */
    double *potential; /* of each simplex: 1 in the star */
} network;

static void free_network(network *w, const iccp_env *env)
{
    iccp_free(&env->memory, w->fixed);
    iccp_free(&env->memory, w->vertex);
    iccp_free(&env->memory, w->wire);
    iccp_free(&env->memory, w->potential);
}

/* ---- vertices ---- */

static void fix_vertices(network *w, uint32_t centre)
{
    const iccp_simplices *mesh = w->mesh;
    for (size_t v = 0; v < mesh->n_points; ++v) {
        w->fixed[v] = v < mesh->n_boundary;
        w->vertex[v] = 0;
    }
    for (size_t t = 0; t < mesh->n_simplices; ++t)
        for (size_t i = 0; i <= mesh->dim && iccp_element_has(mesh, t, centre); ++i) {
            const uint32_t corner = mesh->corners[(mesh->dim + 1) * t + i];
            w->fixed[corner] = true;
            w->vertex[corner] = corner < mesh->n_boundary ? 0 : 1;
        }
}

/* Lists the equations of the free vertices. The potentials of the fixed vertices go to the right
 * side. */
static icc_status list_rows(const network *w, const iccp_gram *wires, iccp_gram *inner,
                            uint32_t *row, double *value, const iccp_env *env)
{
    uint32_t n = 0;
    for (size_t v = 0; v < w->mesh->n_points; ++v) {
        row[v] = NONE;
        if (w->fixed[v])
            continue;
        value[n] = 0;
        for (size_t p = wires->first[v]; p < wires->first[v + 1]; ++p)
            value[n] -= wires->value[p] * w->vertex[wires->column[p]];
        row[v] = n++;
    }
    return iccp_stiffness_restrict(inner, wires, row, env);
}

/* Solves the equations of the free vertices exactly. */
static icc_status solve_rows(network *w, const iccp_gram *wires, const iccp_env *env)
{
    const size_t n = w->mesh->n_points;
    uint32_t *row = iccp_alloc(&env->memory, n, sizeof *row);
    double *value = iccp_alloc(&env->memory, n, sizeof *value);
    iccp_gram inner = {.memory = env->memory};
    iccp_ldlt solver = {.memory = env->memory};
    icc_status status = ICC_ERR_MEMORY;
    if (row != NULL && value != NULL)
        status = list_rows(w, wires, &inner, row, value, env);
    if (status == ICC_OK)
        status = iccp_spd_create(&solver, &inner.matrix, env);
    if (status == ICC_OK)
        status = iccp_spd_solve(&solver, 1, value, env);
    for (size_t v = 0; v < n && status == ICC_OK; ++v)
        if (row[v] != NONE)
            w->vertex[v] = value[row[v]];
    iccp_ldlt_free(&solver);
    iccp_gram_free(&inner);
    iccp_free(&env->memory, row);
    iccp_free(&env->memory, value);
    return status;
}

static icc_status solve_vertices(network *w, const iccp_env *env)
{
    iccp_gram wires;
    icc_status status = iccp_stiffness_create(&wires, w->mesh, env);
    if (status != ICC_OK)
        return status;
    status = iccp_stiffness_to_network(&wires, env);
    if (status == ICC_OK)
        status = solve_rows(w, &wires, env);
    iccp_gram_free(&wires);
    return status;
}

/* ---- simplices ---- */

/* Starts each simplex with the mean potential of its corners. */
static icc_status connect_simplices(network *w, uint32_t centre, const iccp_env *env)
{
    const iccp_simplices *mesh = w->mesh;
    const size_t n_corners = mesh->dim + 1;
    icc_status status = ICC_OK;
    for (size_t t = 0; t < mesh->n_simplices && status == ICC_OK; ++t) {
        double sum = 0;
        if (t % SIMPLICES_PER_REPORT == 0)
            status = iccp_progress(env, "order", (double)t / (double)mesh->n_simplices);
        for (size_t s = n_corners * t; s < n_corners * (t + 1); ++s) {
            const uint32_t other = mesh->across[s];
            w->wire[s] = other < s ? w->wire[other] : iccp_element_conductance(mesh, s);
            sum += w->vertex[mesh->corners[s]];
        }
        w->potential[t] = iccp_element_has(mesh, t, centre) ? 1 : sum / (double)n_corners;
    }
    return status;
}

/* Sets a simplex to the weighted mean of its neighbours and the boundary. */
static void relax_simplex(network *w, size_t simplex)
{
    const iccp_simplices *mesh = w->mesh;
    const size_t first = (mesh->dim + 1) * simplex;
    double sum = 0, weight = 0;
    for (size_t s = first; s <= first + mesh->dim; ++s) {
        const uint32_t other = mesh->across[s];
        weight += w->wire[s];
        if ((other & ICCP_ON_BOUNDARY) == 0)
            sum += w->wire[s] * w->potential[iccp_simplex_of(mesh, other)];
    }
    w->potential[simplex] = sum / weight;
}

static void relax(network *w, uint32_t centre)
{
    const size_t n = w->mesh->n_simplices;
    for (size_t t = 0; t < n; ++t)
        if (!iccp_element_has(w->mesh, t, centre))
            relax_simplex(w, t);
    for (size_t t = n; t-- > 0;)
        if (!iccp_element_has(w->mesh, t, centre))
            relax_simplex(w, t);
}

/* Mixes the harmonic inflow and the areas, each as a share of its sum. */
static void mix(const network *w, double harmonic, double *inflow)
{
    const iccp_simplices *mesh = w->mesh;
    double sum_area = 0, sum_flux = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (size_t s = 0; s < (mesh->dim + 1) * mesh->n_simplices; ++s) {
            if ((mesh->across[s] & ICCP_ON_BOUNDARY) == 0)
                continue;
            const double area = iccp_element_area(mesh, s);
            const double flux = w->potential[s / (mesh->dim + 1)] * w->wire[s];
            if (pass == 1)
                inflow[mesh->across[s] & ~ICCP_ON_BOUNDARY] =
                    harmonic * (flux / sum_flux) + (1 - harmonic) * (area / sum_area);
            sum_area += pass == 0 ? area : 0;
            sum_flux += pass == 0 ? flux : 0;
        }
}

icc_status iccp_inflow(const iccp_simplices *mesh, uint32_t centre, double harmonic, double *inflow,
                       const iccp_env *env)
{
    const size_t n = mesh->n_simplices;
    network w = {.mesh = mesh};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){2, 1}, env);
    w.fixed = iccp_alloc(&env->memory, mesh->n_points, sizeof *w.fixed);
    w.vertex = iccp_alloc(&env->memory, mesh->n_points, sizeof *w.vertex);
    w.wire = iccp_alloc(&env->memory, (mesh->dim + 1) * n, sizeof *w.wire);
    w.potential = iccp_alloc(&env->memory, n, sizeof *w.potential);
    icc_status status = ICC_ERR_MEMORY;
    if (w.fixed != NULL && w.vertex != NULL && w.wire != NULL && w.potential != NULL) {
        fix_vertices(&w, centre);
        status = solve_vertices(&w, &part[0]);
    }
    if (status == ICC_OK)
        status = connect_simplices(&w, centre, &part[1]);
    if (status == ICC_OK) {
        for (int k = 0; k < SWEEPS; ++k)
            relax(&w, centre);
        mix(&w, harmonic, inflow);
    }
    free_network(&w, env);
    return status;
}
