/* Argument checks that several functions share. */
#include "api/check.h"

#include "base/error.h"
#include "base/options.h"
#include "domain/domain.h"
#include "gradient/coordinates/chart_parameters.h"

#include <math.h>
#include <stdbool.h>

icc_status iccp_begin(iccp_env *full, const icc_env *env, const char *missing, icc_error *err)
{
    if (missing != NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%s is NULL", missing);
    return iccp_env_read(full, env, err);
}

icc_status iccp_check_counts(size_t n_vertices, const double *vertices, size_t n_facets,
                             const uint32_t *facets, icc_error *err)
{
    if (vertices == NULL && n_vertices > 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "vertices is NULL");
    if (n_vertices > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu vertices are too many; at most %zu",
                         n_vertices, ICCP_MAX_COUNT);
    if (facets != NULL && n_facets > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu facets are too many; at most %zu", n_facets,
                         ICCP_MAX_COUNT);
    return ICC_OK;
}

/* VTK's numbers of cells. */
enum { VTK_TRIANGLE = 5, VTK_QUAD = 9, VTK_TETRA = 10 };

/* VTK's number of the simplex of this dimension; 0 beyond space, where it has none. */
static unsigned vtk_simplex(int32_t dim)
{
    return dim == 2 ? VTK_TRIANGLE : dim == 3 ? VTK_TETRA : 0;
}

/* Whether a cell is a simplex, and begins where it would if all before it were, too. */
static bool is_simplex(const icc_mesh *mesh, size_t cell)
{
    const size_t n_corners = (size_t)mesh->dim + 1;
    if (mesh->types != NULL && mesh->types[cell] != vtk_simplex(mesh->dim))
        return false;
    return mesh->offsets == NULL || (mesh->offsets[cell] == n_corners * cell &&
                                     mesh->offsets[cell + 1] == n_corners * (cell + 1));
}

/* Whether a cell of the plane is a triangle or a quadrilateral, and begins where the one before
 * it ends. */
static bool is_face(const icc_mesh *mesh, size_t cell)
{
    if (mesh->dim != 2 || mesh->offsets == NULL)
        return is_simplex(mesh, cell);
    const size_t begin = mesh->offsets[cell], end = mesh->offsets[cell + 1];
    const bool is_triangle = end == begin + 3, is_quad = end == begin + 4;
    return (cell > 0 || begin == 0) && (is_triangle || is_quad) &&
           (mesh->types == NULL || mesh->types[cell] == (is_quad ? VTK_QUAD : VTK_TRIANGLE));
}

static icc_status read_mesh(icc_mesh *full, const icc_mesh *mesh,
                            bool (*is_taken)(const icc_mesh *, size_t), const char *taken,
                            icc_error *err)
{
    icc_status status = iccp_read_struct(full, sizeof *full, mesh, "icc_mesh", err);
    if (status != ICC_OK)
        return status;
    if (full->dim < 2 || full->dim > ICC_MAX_DIM)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_mesh.dim is %ld; it must lie in 2..%d",
                         (long)full->dim, ICC_MAX_DIM);
    if ((full->vertices == NULL && full->n_vertices > 0) || full->cells == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_mesh.%s is NULL",
                         full->cells == NULL ? "cells" : "vertices");
    if (full->n_cells == 0 || full->n_cells > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu simplices; there must be 1 to %zu",
                         full->n_cells, ICCP_MAX_COUNT);
    for (size_t cell = 0; cell < full->n_cells; ++cell)
        if (!is_taken(full, cell))
            return iccp_fail_at(err, ICC_ERR_UNSUPPORTED, ICC_ITEM_SIMPLEX, (int64_t)cell,
                                "cell %zu is not a %s; other cells are not supported", cell, taken);
    return ICC_OK;
}

static icc_status refuse_regions(icc_status status, const icc_mesh *mesh, icc_error *err)
{
    return status != ICC_OK || mesh->regions == NULL
               ? status
               : iccp_fail(err, ICC_ERR_UNSUPPORTED,
                           "icc_mesh.regions are for icc_domain_create_mesh() in 3-D; here they "
                           "must be NULL");
}

icc_status iccp_read_mesh(icc_mesh *full, const icc_mesh *mesh, icc_error *err)
{
    return refuse_regions(read_mesh(full, mesh, is_simplex, "simplex", err), full, err);
}

icc_status iccp_read_solid_mesh(icc_mesh *full, const icc_mesh *mesh, icc_error *err)
{
    const icc_status status = read_mesh(full, mesh, is_simplex, "simplex", err);
    return status == ICC_OK && full->dim == 3 ? status : refuse_regions(status, full, err);
}

icc_status iccp_read_faces(icc_mesh *full, const icc_mesh *mesh, icc_error *err)
{
    return refuse_regions(read_mesh(full, mesh, is_face, "triangle or quadrilateral", err), full,
                          err);
}

icc_status iccp_size_mesh(double **vertices, uint32_t **cells, icc_mesh *mesh, int32_t dim,
                          size_t n_vertices, size_t n_cells)
{
    icc_mesh full;
    const icc_status status = iccp_read_struct(&full, sizeof full, mesh, "icc_mesh", NULL);
    if (status != ICC_OK)
        return status;
    *vertices = full.vertices;
    *cells = full.cells;
    if ((full.vertices != NULL && full.n_vertices < n_vertices) ||
        (full.cells != NULL && full.n_cells < n_cells))
        return ICC_ERR_ARGUMENT;
    full.dim = dim;
    full.n_vertices = n_vertices;
    full.n_cells = n_cells;
    return iccp_write_struct(mesh, &full, sizeof full, "icc_mesh", NULL);
}

icc_status iccp_check_maximum(const double *maximum, int32_t dim, icc_error *err)
{
    for (int32_t k = 0; maximum != NULL && k < dim; ++k)
        if (!isfinite(maximum[k]))
            return iccp_fail(err, ICC_ERR_ARGUMENT, "the maximum is not finite");
    return ICC_OK;
}

icc_status iccp_check_axis_order(const int32_t *order, int32_t dim, icc_error *err)
{
    if (order == NULL)
        return ICC_OK;
    uint32_t seen = 0;
    for (int32_t k = 0; k < dim; ++k) {
        if (order[k] < 0 || order[k] >= dim || (seen >> order[k] & 1) != 0)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_AXIS, k,
                                "axis_order is not a permutation of 0..%ld: entry %ld is %ld",
                                (long)dim - 1, (long)k, (long)order[k]);
        seen |= (uint32_t)1 << order[k];
    }
    return ICC_OK;
}

static icc_status check_choice(int32_t value, int32_t last, const char *name, const char *member,
                               icc_error *err)
{
    if (value >= 0 && value <= last)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_ARGUMENT, "%s.%s is %ld; it must lie in 0..%ld", name, member,
                     (long)value, (long)last);
}

/* Checks a small relative amount. 0 stands for a default, and NaN is refused. */
static icc_status check_share(double value, const char *name, const char *member, icc_error *err)
{
    if (value >= 0 && value <= ICCP_MAX_SHARE)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_ARGUMENT, "%s.%s is %g; it must lie in (0, %g], or be 0", name,
                     member, value, ICCP_MAX_SHARE);
}

icc_status iccp_check_function(const icc_function_options *options, const char *name,
                               icc_error *err)
{
    icc_status status =
        check_choice(options->function, ICC_FUNCTION_HARMONIC, name, "function", err);
    if (status == ICC_OK)
        status = check_choice(options->constraints, ICC_CONSTRAINTS_ALL, name, "constraints", err);
    if (status == ICC_OK)
        status = check_choice(options->solver, ICC_SOLVER_ITERATIVE, name, "solver", err);
    if (status == ICC_OK)
        status = check_share(options->min_fall, name, "min_fall", err);
    return status == ICC_OK ? check_share(options->leaf_min, name, "leaf_min", err) : status;
}

icc_status iccp_read_chart_options(icc_chart_options *full, const icc_chart_options *options,
                                   int32_t dim, icc_error *err)
{
    const icc_status status =
        iccp_read_struct(full, sizeof *full, options, "icc_chart_options", err);
    if (status != ICC_OK)
        return status;
    const icc_function_options function = {.function = full->function,
                                           .constraints = full->constraints,
                                           .solver = full->solver,
                                           .min_fall = full->min_fall,
                                           .leaf_min = full->leaf_min};
    if (iccp_check_function(&function, "icc_chart_options", err) != ICC_OK)
        return ICC_ERR_ARGUMENT;
    if (full->tree < 0 || full->tree > ICC_TREE_PAPER)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_chart_options.tree is %ld; it must lie in 0..%d", (long)full->tree,
                         (int)ICC_TREE_PAPER);
    if (full->cells != 0 && (full->cells < ICCP_MIN_CELLS || full->cells > ICCP_MAX_CELLS))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_chart_options.cells is %ld; it must lie in %ld..%ld",
                         (long)full->cells, (long)ICCP_MIN_CELLS, (long)ICCP_MAX_CELLS);
    if (full->method == ICC_METHOD_DISC && full->maximum != NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "method disc has its own maximum: icc_chart_options.maximum must be NULL");
    if (iccp_check_axis_order(full->axis_order, dim, err) != ICC_OK)
        return ICC_ERR_ARGUMENT;
    return iccp_check_maximum(full->maximum, dim, err);
}
