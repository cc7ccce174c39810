/* Computes the reference flux by nonconforming finite elements.
 *
 * Source: M. Crouzeix, P.-A. Raviart, Conforming and nonconforming finite element methods for
 * solving the stationary Stokes equations I, RAIRO 7, 1973. The functions are linear in each
 * simplex and agree in the middles of the facets. The gradient is a constant vector in each
 * simplex, and no flux arises on the facets between them. */
#include "shelling/reference.h"

#include "shelling/element.h"
#include "shelling/solve.h"

#include <string.h>

#define NONE UINT32_MAX

/* Simplices between calls of the progress callback. */
enum { SIMPLICES_PER_REPORT = 1 << 14 };

/* The unknowns are the values in the middles of the facets outside the star of the centre. On
 * the star's hull the values are 0. */
typedef struct equations {
    const iccp_simplices *mesh;
    uint32_t centre;
    uint32_t *row; /* of each side, or NONE */
    size_t n;
    size_t *first; /* iccp_symmetric */
    uint32_t *column;
    double *value, *diagonal;
    double *unknown;
} equations;

/* A matrix of (dim + 1)^2 numbers: what a simplex adds for its facets. */
typedef double element[(ICC_MAX_DIM + 1) * (ICC_MAX_DIM + 1)];

/* Computes dim^2 times the stiffness matrix of linear functions. A facet's function is 1 in the
 * middle of the facet opposite corner i, and 0 in the middles of the others. So it is 1 - dim *
 * (barycentric coordinate i). */
static void find_element(const iccp_simplices *mesh, size_t simplex, element a)
{
    const size_t dim = mesh->dim;
    double gradient[(ICC_MAX_DIM + 1) * ICC_MAX_DIM];
    const double volume = iccp_element_gradients(mesh, simplex, gradient);
    for (size_t i = 0; i <= dim; ++i)
        for (size_t j = 0; j <= dim; ++j) {
            double dot = 0;
            for (size_t k = 0; k < dim; ++k)
                dot += gradient[dim * i + k] * gradient[dim * j + k];
            a[(dim + 1) * i + j] = (double)(dim * dim) * volume * dot;
        }
}

/* Numbers the rows. A facet outside the star has one row, which both its sides know. Sides in
 * the star or on its hull have none. */
static void number_rows(equations *e)
{
    const iccp_simplices *mesh = e->mesh;
    const size_t n_corners = mesh->dim + 1;
    for (size_t s = 0; s < n_corners * mesh->n_simplices; ++s)
        e->row[s] = NONE;
    for (size_t t = 0; t < mesh->n_simplices; ++t)
        for (size_t s = n_corners * t; s < n_corners * (t + 1); ++s) {
            const uint32_t other = mesh->across[s];
            if (iccp_element_has(mesh, t, e->centre))
                break;
            if ((other & ICCP_ON_BOUNDARY) != 0)
                e->row[s] = (uint32_t)e->n++;
            else if (other > s && !iccp_element_has(mesh, iccp_simplex_of(mesh, other), e->centre))
                e->row[s] = e->row[other] = (uint32_t)e->n++;
        }
}

/* Sets `first` to the ends of the rows. Filling the rows moves it to their beginnings. */
static void count_entries(equations *e)
{
    const size_t n_corners = e->mesh->dim + 1;
    for (size_t t = 0; t < e->mesh->n_simplices; ++t) {
        const uint32_t *row = e->row + n_corners * t;
        size_t n_rows = 0;
        for (size_t i = 0; i < n_corners; ++i)
            n_rows += row[i] != NONE;
        for (size_t i = 0; i < n_corners; ++i)
            if (row[i] != NONE)
                e->first[row[i]] += n_rows - 1;
    }
    for (size_t r = 1; r <= e->n; ++r)
        e->first[r] += e->first[r - 1];
}

/* Adds a simplex to the rows of its facets. This moves `first` from the ends of the rows to
 * their beginnings. */
static void add_element(equations *e, size_t simplex)
{
    const size_t n_corners = e->mesh->dim + 1;
    const uint32_t *row = e->row + n_corners * simplex;
    element a;
    find_element(e->mesh, simplex, a);
    for (size_t i = 0; i < n_corners; ++i) {
        if (row[i] == NONE)
            continue;
        e->diagonal[row[i]] += a[n_corners * i + i];
        for (size_t j = 0; j < n_corners; ++j)
            if (j != i && row[j] != NONE) {
                const size_t p = --e->first[row[i]];
                e->column[p] = row[j];
                e->value[p] = a[n_corners * i + j];
            }
    }
}

static icc_status add_elements(equations *e, const iccp_env *env)
{
    const iccp_simplices *mesh = e->mesh;
    icc_status status = ICC_OK;
    for (size_t t = 0; t < mesh->n_simplices && status == ICC_OK; ++t) {
        if (t % SIMPLICES_PER_REPORT == 0)
            status = iccp_progress(env, "order", (double)t / (double)mesh->n_simplices);
        if (!iccp_element_has(mesh, t, e->centre))
            add_element(e, t);
    }
    return status;
}

static void free_equations(equations *e, const iccp_env *env)
{
    iccp_free(&env->memory, e->row);
    iccp_free(&env->memory, e->first);
    iccp_free(&env->memory, e->column);
    iccp_free(&env->memory, e->value);
    iccp_free(&env->memory, e->diagonal);
    iccp_free(&env->memory, e->unknown);
}

/* Counts the rows before it fills them, so that the matrix is allocated once. */
static icc_status create_equations(equations *e, const iccp_simplices *mesh, uint32_t centre,
                                   const iccp_env *env)
{
    *e = (equations){.mesh = mesh, .centre = centre};
    e->row = iccp_alloc(&env->memory, (mesh->dim + 1) * mesh->n_simplices, sizeof *e->row);
    if (e->row == NULL)
        return ICC_ERR_MEMORY;
    number_rows(e);
    e->first = iccp_alloc_zero(&env->memory, e->n + 1, sizeof *e->first);
    e->diagonal = iccp_alloc_zero(&env->memory, e->n, sizeof *e->diagonal);
    e->unknown = iccp_alloc_zero(&env->memory, e->n, sizeof *e->unknown);
    if (e->first == NULL || e->diagonal == NULL || e->unknown == NULL)
        return ICC_ERR_MEMORY;
    count_entries(e);
    e->column = iccp_alloc(&env->memory, e->first[e->n], sizeof *e->column);
    e->value = iccp_alloc(&env->memory, e->first[e->n], sizeof *e->value);
    if (e->column == NULL || e->value == NULL)
        return ICC_ERR_MEMORY;
    return add_elements(e, env);
}

/* Lists the points of each facet. The facet's value is the mean of a linear function over its
 * corners. */
static void list_points(const equations *e, uint32_t *point, bool *fixed)
{
    const iccp_simplices *mesh = e->mesh;
    const size_t n_corners = mesh->dim + 1;
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        const bool in_star = iccp_element_has(mesh, t, e->centre);
        for (size_t i = 0; i < n_corners; ++i) {
            const uint32_t row = e->row[n_corners * t + i];
            if (in_star)
                fixed[mesh->corners[n_corners * t + i]] = true;
            for (size_t k = 0; k < mesh->dim && row != NONE; ++k)
                point[mesh->dim * row + k] = mesh->corners[n_corners * t + k + (k >= i)];
        }
    }
}

/* Solves the equations. The loads are the inflow, because a facet's function is on average 1 on
 * the facet and 0 on the others. */
static icc_status solve(equations *e, const double *inflow, const iccp_env *env)
{
    const iccp_simplices *mesh = e->mesh;
    const iccp_symmetric matrix = {e->n, e->first, e->column, e->value, e->diagonal};
    uint32_t *point = iccp_alloc(&env->memory, mesh->dim * e->n, sizeof *point);
    bool *fixed = iccp_alloc_zero(&env->memory, mesh->n_points, sizeof *fixed);
    icc_status status = ICC_ERR_MEMORY;
    for (size_t s = 0; s < (mesh->dim + 1) * mesh->n_simplices; ++s)
        if (e->row[s] != NONE && (mesh->across[s] & ICCP_ON_BOUNDARY) != 0)
            e->unknown[e->row[s]] = inflow[mesh->across[s] & ~ICCP_ON_BOUNDARY];
    if (point != NULL && fixed != NULL) {
        const iccp_unknowns unknowns = {mesh, fixed, mesh->dim, point};
        list_points(e, point, fixed);
        status = iccp_shelling_solve(&matrix, &unknowns, e->unknown, env);
    }
    iccp_free(&env->memory, point);
    iccp_free(&env->memory, fixed);
    return status;
}

/* The flux out of a simplex through its sides. The gradient of a side's function is its outer
 * normal times its area over the volume. */
static void find_flux(const equations *e, size_t simplex, double *flux, double *potential)
{
    const size_t n_corners = e->mesh->dim + 1;
    const uint32_t *row = e->row + n_corners * simplex;
    element a;
    find_element(e->mesh, simplex, a);
    *potential = 0;
    for (size_t i = 0; i < n_corners; ++i) {
        const double value = row[i] != NONE ? e->unknown[row[i]] : 0;
        *potential += value / (double)n_corners;
        for (size_t j = 0; j < n_corners; ++j)
            flux[j] -= a[n_corners * j + i] * value;
    }
}

/* Makes the two sides of each facet exactly opposite. They get their mean, or the computed one
 * if the other simplex lies in the star. Facets of the domain get the prescribed inflow. */
static void match_sides(const equations *e, const double *inflow, double *flux)
{
    const iccp_simplices *mesh = e->mesh;
    for (uint32_t s = 0; s < (mesh->dim + 1) * mesh->n_simplices; ++s) {
        const uint32_t other = mesh->across[s];
        if ((other & ICCP_ON_BOUNDARY) != 0) {
            flux[s] = -inflow[other & ~ICCP_ON_BOUNDARY];
        } else if (other > s) {
            const bool has_two = e->row[s] != NONE;
            flux[s] = has_two ? 0.5 * (flux[s] - flux[other]) : flux[s] - flux[other];
            flux[other] = -flux[s];
        }
    }
}

/* Solves for the values in the middles of the facets. Their gradients give the flux through
 * every side. */
icc_status iccp_reference_flux(const iccp_simplices *mesh, uint32_t centre, const double *inflow,
                               double *flux, double *potential, const iccp_env *env)
{
    const size_t n_corners = mesh->dim + 1;
    equations e;
    icc_status status = create_equations(&e, mesh, centre, env);
    if (status == ICC_OK && e.n > 0)
        status = solve(&e, inflow, env);
    if (status == ICC_OK) {
        for (size_t t = 0; t < mesh->n_simplices; ++t) {
            memset(flux + n_corners * t, 0, n_corners * sizeof *flux);
            potential[t] = 0;
            if (!iccp_element_has(mesh, t, centre))
                find_flux(&e, t, flux + n_corners * t, potential + t);
        }
        match_sides(&e, inflow, flux);
    }
    free_equations(&e, env);
    return status;
}
