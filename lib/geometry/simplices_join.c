/* Makes a conforming mesh of simplices: checks, orientation and neighbours. */
#include "base/error.h"
#include "geometry/simplices.h"
#include "geometry/tuples.h"
#include "icc/icc.h"
#include "math/orient.h"

#include <stdio.h>
#include <string.h>

enum { MAX = ICC_MAX_DIM };

/* ---- single simplices ---- */

icc_status iccp_simplices_check_corners(const iccp_simplices *mesh, icc_error *err)
{
    const char *name = iccp_simplices_name(mesh->dim);
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const uint32_t *v = mesh->corners + (mesh->dim + 1) * s;
        for (size_t i = 0; i <= mesh->dim; ++i) {
            if (v[i] >= mesh->n_points)
                return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)s,
                                    "%s %zu names vertex %lu, but there are only %zu vertices",
                                    name, s, (unsigned long)v[i], mesh->n_points);
            for (size_t j = 0; j < i; ++j)
                if (v[j] == v[i])
                    return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)s,
                                        "%s %zu names vertex %lu twice", name, s,
                                        (unsigned long)v[i]);
        }
    }
    return ICC_OK;
}

icc_status iccp_simplices_orient(iccp_simplices *mesh, icc_error *err)
{
    const size_t n = mesh->dim + 1;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const double *points[MAX + 1];
        uint32_t *v = mesh->corners + n * s;
        for (size_t i = 0; i < n; ++i)
            points[i] = iccp_corner_point(mesh, n * s + i);
        const int sign = iccp_orient(mesh->dim, points);
        if (sign == 0)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)s,
                                "%s %zu is flat", iccp_simplices_name(mesh->dim), s);
        if (sign < 0) {
            const uint32_t swap = v[n - 2];
            v[n - 2] = v[n - 1];
            v[n - 1] = swap;
        }
    }
    return ICC_OK;
}

/* ---- sides with the same facet ---- */

/* Tuples up to n_sides are the sides of the mesh. The rest are the caller's facets. */
typedef struct side_list {
    iccp_simplices *mesh;
    iccp_tuples tuples;
    size_t n_sides;
    uint32_t n_boundary; /* boundary facets found */
} side_list;

static bool is_odd(const iccp_simplices *mesh, size_t side)
{
    uint32_t points[MAX];
    iccp_simplices_side(mesh, side, points);
    return iccp_sort_vertices(mesh->dim, points);
}

/* Writes a text such as "face (3, 7, 9)". */
static void describe(const side_list *list, size_t tuple, char *text, size_t size)
{
    const size_t width = list->tuples.width;
    int n = snprintf(text, size, "%s (", iccp_simplices_facet(width));
    for (size_t k = 0; k < width; ++k)
        n += snprintf(text + n, size - (size_t)n, k == 0 ? "%lu" : ", %lu",
                      (unsigned long)list->tuples.vertices[width * tuple + k]);
    (void)snprintf(text + n, size - (size_t)n, ")");
}

/* Reports that the facets at at[0], at[1], .. have sides that no mesh can have. */
static icc_status fail_sides(const side_list *list, const uint32_t *at, size_t n_sides,
                             icc_error *err)
{
    const size_t dim = list->mesh->dim;
    const size_t s = at[0] / (dim + 1), t = at[1] / (dim + 1);
    char facet[96];
    describe(list, at[0], facet, sizeof facet);
    if (n_sides > 2)
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)(at[2] / (dim + 1)),
                            "%s belongs to %zu simplices, among them %zu, %zu and %zu", facet,
                            n_sides, s, t, (size_t)(at[2] / (dim + 1)));
    return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)t,
                        "simplices %zu and %zu lie on the same side of %s, so they overlap", s, t,
                        facet);
}

/* Reports an error of the caller's facets at at[0], .. and tells how many sides they have. */
static icc_status fail_facets(const side_list *list, const uint32_t *at, size_t n_sides,
                              size_t n_facets, icc_error *err)
{
    const char *name = iccp_simplices_facet(list->mesh->dim);
    if (n_facets == 0) {
        char facet[96];
        describe(list, at[0], facet, sizeof facet);
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX,
                            (int64_t)(at[0] / (list->mesh->dim + 1)),
                            "%s of simplex %zu is on the boundary, but not among the facets given",
                            facet, (size_t)at[0] / (list->mesh->dim + 1));
    }
    const size_t f = at[n_sides] - list->n_sides;
    if (n_facets > 1)
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)f,
                            "%ss %zu and %zu are the same", name, f,
                            (size_t)at[n_sides + 1] - list->n_sides);
    return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)f,
                        n_sides == 0 ? "%s %zu is not one of the mesh"
                                     : "%s %zu is not on the boundary of the mesh",
                        name, f);
}

/* Sides come before facets, smaller ones first. */
static icc_status join_facet(side_list *list, size_t begin, size_t end, bool given, icc_error *err)
{
    iccp_simplices *mesh = list->mesh;
    const uint32_t *at = list->tuples.order + begin;
    size_t n_sides = 0;
    while (n_sides < end - begin && at[n_sides] < list->n_sides)
        ++n_sides;
    const size_t n_facets = end - begin - n_sides;
    if (n_sides > 2 || (n_sides == 2 && is_odd(mesh, at[0]) == is_odd(mesh, at[1])))
        return fail_sides(list, at, n_sides, err);
    if (given && n_facets != (n_sides == 1))
        return fail_facets(list, at, n_sides, n_facets, err);
    if (n_sides == 2) {
        mesh->across[at[0]] = at[1];
        mesh->across[at[1]] = at[0];
        return ICC_OK;
    }
    mesh->across[at[0]] =
        ICCP_ON_BOUNDARY | (given ? at[1] - (uint32_t)list->n_sides : list->n_boundary);
    ++list->n_boundary;
    return ICC_OK;
}

static icc_status check_facets(const iccp_simplices *mesh, size_t n_facets, const uint32_t *facets,
                               icc_error *err)
{
    const char *name = iccp_simplices_facet(mesh->dim);
    for (size_t i = 0; i < mesh->dim * n_facets; ++i)
        if (facets[i] >= mesh->n_points)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)(i / mesh->dim),
                                "%s %zu names vertex %lu, but there are only %zu vertices", name,
                                i / mesh->dim, (unsigned long)facets[i], mesh->n_points);
    return ICC_OK;
}

/* Writes all tuples, each ascending. */
static void list_sides(side_list *list, const uint32_t *facets)
{
    const size_t dim = list->mesh->dim;
    uint32_t *at = list->tuples.vertices;
    for (size_t i = 0; i < list->tuples.n; ++i, at += dim) {
        if (i < list->n_sides)
            iccp_simplices_side(list->mesh, i, at);
        else
            memcpy(at, facets + dim * (i - list->n_sides), dim * sizeof *at);
        (void)iccp_sort_vertices(dim, at);
    }
}

icc_status iccp_simplices_join(iccp_simplices *mesh, size_t n_facets, const uint32_t *facets,
                               icc_error *err)
{
    side_list list = {.mesh = mesh, .n_sides = (mesh->dim + 1) * mesh->n_simplices};
    const size_t n_given = facets != NULL ? n_facets : 0;
    icc_status status = check_facets(mesh, n_given, facets, err);
    if (status != ICC_OK)
        return status;
    mesh->across = iccp_alloc(&mesh->memory, list.n_sides, sizeof *mesh->across);
    if (mesh->across == NULL || iccp_tuples_create(&list.tuples, list.n_sides + n_given, mesh->dim,
                                                   mesh->n_points, &mesh->memory) != ICC_OK)
        return iccp_fail_memory(err);
    list_sides(&list, facets);
    iccp_tuples_sort(&list.tuples);
    for (size_t k = 0, end; k < list.tuples.n && status == ICC_OK; k = end) {
        end = iccp_tuples_end(&list.tuples, k);
        status = join_facet(&list, k, end, facets != NULL, err);
    }
    mesh->n_facets = list.n_boundary;
    iccp_tuples_free(&list.tuples);
    return status;
}
