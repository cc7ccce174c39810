/* Based on: P. Doyle, J. L. Snell, Random Walks and Electric Networks, 1984, section 1.3: a network
 * of the simplices, with the star of the centre at one pole and the boundary at the other. The
 * potential is that of the star here, so that small ones, at the ends of limbs, keep all their
 * digits. */
#include "shelling/reference.h"

#include "base/minmax.h"
#include "shelling/element.h"
#include "shelling/solve.h"

#include <math.h>

#define NONE UINT32_MAX

/* Simplices between looks at the progress callback. */
enum { SIMPLICES_PER_REPORT = 1 << 14 };

/* The unknowns are the potentials of the simplices outside the star. */
typedef struct network {
    const iccp_simplices *mesh;
    uint32_t *row; /* of each simplex; NONE: in the star, where the potential is 1 */
    size_t n;
    size_t *first; /* an iccp_symmetric */
    uint32_t *column;
    double *value, *diagonal;
    double *potential;
} network;

static void free_network(network *w, const iccp_env *env)
{
    iccp_free(&env->memory, w->row);
    iccp_free(&env->memory, w->first);
    iccp_free(&env->memory, w->column);
    iccp_free(&env->memory, w->value);
    iccp_free(&env->memory, w->diagonal);
    iccp_free(&env->memory, w->potential);
}

/* The wires of one simplex become its row. */
static void add_row(network *w, size_t simplex)
{
    const iccp_simplices *mesh = w->mesh;
    const uint32_t row = w->row[simplex];
    size_t end = w->first[row];
    for (size_t i = 0; i <= mesh->dim; ++i) {
        const size_t side = (mesh->dim + 1) * simplex + i;
        const uint32_t other = mesh->across[side];
        /* Bit for bit the same from either side. */
        const double wire = iccp_element_conductance(mesh, other < side ? other : side);
        w->diagonal[row] += wire;
        if ((other & ICCP_ON_BOUNDARY) != 0)
            continue;
        const uint32_t column = w->row[iccp_simplex_of(mesh, other)];
        if (column == NONE) {
            w->potential[row] += wire;
        } else {
            w->column[end] = column;
            w->value[end++] = -wire;
        }
    }
    w->first[row + 1] = end;
}

/* Numbers the simplices outside the star, and gives each a row: its conductances to its
 * neighbours, with those to the star, of potential 1, on the right side. */
static icc_status create_network(network *w, const iccp_simplices *mesh, uint32_t centre,
                                 const iccp_env *env)
{
    *w = (network){.mesh = mesh};
    w->row = iccp_alloc(&env->memory, mesh->n_simplices, sizeof *w->row);
    if (w->row == NULL)
        return ICC_ERR_MEMORY;
    for (size_t t = 0; t < mesh->n_simplices; ++t)
        w->row[t] = iccp_element_has(mesh, t, centre) ? NONE : (uint32_t)w->n++;
    w->first = iccp_alloc_zero(&env->memory, w->n + 1, sizeof *w->first);
    w->column = iccp_alloc(&env->memory, (mesh->dim + 1) * w->n, sizeof *w->column);
    w->value = iccp_alloc(&env->memory, (mesh->dim + 1) * w->n, sizeof *w->value);
    w->diagonal = iccp_alloc_zero(&env->memory, w->n, sizeof *w->diagonal);
    w->potential = iccp_alloc_zero(&env->memory, w->n, sizeof *w->potential);
    if (w->first == NULL || w->column == NULL || w->value == NULL || w->diagonal == NULL ||
        w->potential == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_OK;
    for (size_t t = 0; t < mesh->n_simplices && status == ICC_OK; ++t) {
        if (t % SIMPLICES_PER_REPORT == 0)
            status = iccp_progress(env, "order", (double)t / (double)mesh->n_simplices);
        if (w->row[t] != NONE)
            add_row(w, t);
    }
    return status;
}

/* A simplex is like the mean over its corners; the boundary and the star are as given. */
static void list_points(const network *w, uint32_t *point, bool *fixed)
{
    const iccp_simplices *mesh = w->mesh;
    const size_t n_corners = mesh->dim + 1;
    for (size_t v = 0; v < mesh->n_points; ++v)
        fixed[v] = v < mesh->n_boundary;
    for (size_t t = 0; t < mesh->n_simplices; ++t)
        for (size_t i = 0; i < n_corners; ++i) {
            const uint32_t corner = mesh->corners[n_corners * t + i];
            if (w->row[t] != NONE)
                point[n_corners * w->row[t] + i] = corner;
            else
                fixed[corner] = true;
        }
}

static icc_status solve(network *w, const iccp_env *env)
{
    const iccp_simplices *mesh = w->mesh;
    const iccp_symmetric matrix = {w->n, w->first, w->column, w->value, w->diagonal};
    uint32_t *point = iccp_alloc(&env->memory, (mesh->dim + 1) * w->n, sizeof *point);
    bool *fixed = iccp_alloc(&env->memory, mesh->n_points, sizeof *fixed);
    icc_status status = ICC_ERR_MEMORY;
    if (point != NULL && fixed != NULL) {
        const iccp_unknowns unknowns = {mesh, fixed, mesh->dim + 1, point};
        list_points(w, point, fixed);
        status = iccp_shelling_solve(&matrix, &unknowns, w->potential, env);
    }
    iccp_free(&env->memory, point);
    iccp_free(&env->memory, fixed);
    return status;
}

/* The harmonic inflow and the areas, each as shares of their sums. */
static void mix(const network *w, double harmonic, double *inflow)
{
    const iccp_simplices *mesh = w->mesh;
    double sum_area = 0, sum_flux = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (size_t s = 0; s < (mesh->dim + 1) * mesh->n_simplices; ++s) {
            if ((mesh->across[s] & ICCP_ON_BOUNDARY) == 0)
                continue;
            const uint32_t row = w->row[s / (mesh->dim + 1)];
            const double potential = row != NONE ? iccp_max(w->potential[row], 0) : 1;
            const double area = iccp_element_area(mesh, s);
            const double flux = potential * iccp_element_conductance(mesh, s);
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
    network w;
    icc_status status = create_network(&w, mesh, centre, env);
    if (status == ICC_OK && w.n > 0)
        status = solve(&w, env);
    if (status == ICC_OK)
        mix(&w, harmonic, inflow);
    free_network(&w, env);
    return status;
}
