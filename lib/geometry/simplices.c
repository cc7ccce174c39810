/* The object of a conforming mesh of simplices. */
#include "geometry/simplices.h"

#include <string.h>

const char *iccp_simplices_name(size_t dim)
{
    return dim == 2 ? "triangle" : dim == 3 ? "tetrahedron" : "simplex";
}

const char *iccp_simplices_facet(size_t dim)
{
    return dim == 2 ? "edge" : dim == 3 ? "face" : "facet";
}

void iccp_simplices_free(iccp_simplices *mesh)
{
    if (mesh == NULL)
        return;
    const iccp_memory memory = mesh->memory;
    iccp_free(&memory, mesh->points);
    iccp_free(&memory, mesh->given);
    iccp_free(&memory, mesh->corners);
    iccp_free(&memory, mesh->across);
    iccp_free(&memory, mesh->region);
    iccp_free(&memory, mesh->on_line);
    iccp_free(&memory, mesh);
}

/* Returns false if there is no memory. */
static bool copy_features(iccp_simplices *copy, const iccp_simplices *mesh)
{
    if (mesh->region != NULL) {
        copy->region = iccp_alloc(&copy->memory, mesh->n_simplices, sizeof *copy->region);
        if (copy->region == NULL)
            return false;
        memcpy(copy->region, mesh->region, mesh->n_simplices * sizeof *copy->region);
    }
    if (mesh->on_line != NULL) {
        copy->on_line = iccp_alloc(&copy->memory, mesh->n_on_lines, sizeof *copy->on_line);
        if (copy->on_line == NULL)
            return false;
        memcpy(copy->on_line, mesh->on_line, mesh->n_on_lines * sizeof *copy->on_line);
        copy->n_on_lines = mesh->n_on_lines;
    }
    return true;
}

icc_status iccp_simplices_copy(iccp_simplices **out, const iccp_simplices *mesh,
                               const iccp_memory *memory)
{
    const size_t n_sides = (mesh->dim + 1) * mesh->n_simplices, n = mesh->dim * mesh->n_points;
    iccp_simplices *copy = *out = iccp_alloc_zero(memory, 1, sizeof *copy);
    if (copy == NULL)
        return ICC_ERR_MEMORY;
    *copy = *mesh;
    copy->memory = *memory;
    copy->given = NULL;
    copy->region = NULL;
    copy->on_line = NULL;
    copy->n_on_lines = 0;
    copy->points = iccp_alloc(memory, n, sizeof *copy->points);
    copy->corners = iccp_alloc(memory, n_sides, sizeof *copy->corners);
    copy->across = iccp_alloc(memory, n_sides, sizeof *copy->across);
    if (copy->points == NULL || copy->corners == NULL || copy->across == NULL ||
        !copy_features(copy, mesh)) {
        iccp_simplices_free(copy);
        *out = NULL;
        return ICC_ERR_MEMORY;
    }
    memcpy(copy->points, mesh->points, n * sizeof *copy->points);
    memcpy(copy->corners, mesh->corners, n_sides * sizeof *copy->corners);
    memcpy(copy->across, mesh->across, n_sides * sizeof *copy->across);
    return ICC_OK;
}

void iccp_simplices_side(const iccp_simplices *mesh, size_t side, uint32_t *points)
{
    const size_t n = mesh->dim + 1, i = side % n;
    const uint32_t *v = mesh->corners + (side - i);
    for (size_t j = 0; j < mesh->dim; ++j)
        points[j] = v[j < i ? j : j + 1];
    if (i % 2 != 0) {
        const uint32_t swap = points[n - 3];
        points[n - 3] = points[n - 2];
        points[n - 2] = swap;
    }
}
