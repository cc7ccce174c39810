/* Checks boundaries in dimension 1 and 3 to 6. */
#include "domain/simplicial.h"

#include "base/error.h"
#include "base/minmax.h"
#include "geometry/triangles.h"
#include "math/orient.h"
#include "math/predicates.h"

#include <math.h>
#include <stdio.h>

enum { MAX = ICC_MAX_DIM };

/* A volume below this share of the sum of its terms' absolute values is rounding noise. The error
 * of each term is less than 1e-14 of the product of its edges (math/orient.c). */
static const double NO_VOLUME = 1e-12;

/* ------------------------------------------------------------ coordinates */

static icc_status check_finite(size_t dim, const iccp_complex *c, const double *vertices,
                               icc_error *err)
{
    for (size_t i = 0; i < c->dim * c->n_facets; ++i)
        for (size_t k = 0; k < dim; ++k)
            if (!isfinite(vertices[dim * c->facets[i] + k]))
                return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, c->facets[i],
                                    "vertex %lu is not finite", (unsigned long)c->facets[i]);
    return ICC_OK;
}

static icc_status fail_too_small(icc_error *err, size_t vertex, size_t dim, const double *x)
{
    char text[160];
    int n = 0;
    for (size_t k = 0; k < dim; ++k)
        n += snprintf(text + n, sizeof text - (size_t)n, k == 0 ? "%.9g" : ", %.9g", x[k]);
    return iccp_fail_at(
        err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)vertex,
        "vertex %zu (%s): a coordinate is not 0, but less than 2^-200 of the largest one", vertex,
        text);
}

/* Fits a frame to the vertices that are in use. `local` gathers them. */
static void fit(iccp_frame *frame, double *local, size_t dim, size_t n_vertices,
                const double *vertices, const bool *used)
{
    size_t n = 0;
    for (size_t v = 0; v < n_vertices; ++v)
        if (used[v]) {
            for (size_t k = 0; k < dim; ++k)
                local[dim * n + k] = vertices[dim * v + k];
            ++n;
        }
    iccp_frame_fit(frame, (int32_t)dim, n, local);
}

icc_status iccp_simplicial_localise(iccp_frame *frame, double *local, size_t dim,
                                    const iccp_complex *c, const double *vertices,
                                    const iccp_env *env, icc_error *err)
{
    icc_status status = check_finite(dim, c, vertices, err);
    if (status != ICC_OK)
        return status;
    bool *used = iccp_alloc_zero(&env->memory, c->n_vertices, sizeof *used);
    if (used == NULL)
        return iccp_fail_memory(err);
    for (size_t i = 0; i < c->dim * c->n_facets; ++i)
        used[c->facets[i]] = true;
    fit(frame, local, dim, c->n_vertices, vertices, used);
    for (size_t v = 0; status == ICC_OK && v < c->n_vertices; ++v) {
        const double *x = vertices + dim * (used[v] ? v : c->facets[0]);
        if (!iccp_frame_holds(frame, (int32_t)dim, x))
            status = fail_too_small(err, v, dim, x);
        iccp_frame_in(frame, (int32_t)dim, x, local + dim * v);
    }
    iccp_free(&env->memory, used);
    return status;
}

/* --------------------------------------------------------------- flatness */

/* A facet has an area if one of its shadows along the axes has one. */
bool iccp_simplicial_has_area(const iccp_facet_tree *tree, uint32_t facet)
{
    const size_t dim = tree->dim;
    const double *corners[MAX], *at[MAX];
    double shadow[MAX][MAX];
    iccp_facet_corners(tree, facet, corners);
    for (size_t axis = dim; axis-- > 0;) {
        for (size_t i = 0; i < dim; ++i) {
            for (size_t k = 0; k + 1 < dim; ++k)
                shadow[i][k] = corners[i][k < axis ? k : k + 1];
            at[i] = shadow[i];
        }
        if (iccp_orient(dim - 1, at) != 0)
            return true;
    }
    return false;
}

icc_status iccp_simplicial_check_flat(const iccp_facet_tree *tree, icc_error *err)
{
    const size_t dim = tree->dim;
    const double *points[MAX + 1];
    for (uint32_t f = 0; f < tree->n; ++f)
        if (!iccp_simplicial_has_area(tree, f))
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, f,
                                dim == 3 ? "face %lu has area 0: its corners lie on one line"
                                         : "facet %lu is flat: its corners do not span it",
                                (unsigned long)f);
    iccp_facet_corners(tree, 0, points);
    for (size_t i = 0; i < dim * tree->n; ++i) {
        points[dim] = tree->vertices + dim * tree->facets[i];
        if (iccp_orient(dim, points) != 0)
            return ICC_OK;
    }
    return iccp_fail(err, ICC_ERR_BOUNDARY, "all vertices lie in one %s: the shape has no volume",
                     dim == 3 ? "plane" : "hyperplane");
}

icc_status iccp_simplicial_check_simple(const iccp_facet_tree *tree, size_t n_vertices,
                                        const iccp_frame *frame, const iccp_env *env,
                                        icc_error *err)
{
    uint32_t pair[2];
    double a[6], b[6], middle[3];
    const icc_status status = iccp_triangles_find(tree, n_vertices, pair, env);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    if (pair[0] == pair[1])
        return ICC_OK;
    iccp_facet_box(tree, pair[0], a);
    iccp_facet_box(tree, pair[1], b);
    for (int k = 0; k < 3; ++k)
        middle[k] = 0.5 * (iccp_max(a[k], b[k]) + iccp_min(a[3 + k], b[3 + k]));
    iccp_frame_out(frame, 3, middle, middle);
    return iccp_fail_at(
        err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, pair[0],
        "the surface meets itself: faces %lu and %lu intersect near (%.9g, %.9g, %.9g)",
        (unsigned long)pair[0], (unsigned long)pair[1], middle[0], middle[1], middle[2]);
}

/* ----------------------------------------------------------------- volume */

icc_status iccp_simplicial_measure(const iccp_facet_tree *tree, int32_t *orientation,
                                   double *volume, icc_error *err)
{
    const size_t dim = tree->dim;
    const double *points[MAX + 1] = {tree->vertices + dim * tree->facets[0]};
    double sum = 0, size = 0;
    for (uint32_t f = 0; f < tree->n; ++f) {
        iccp_facet_corners(tree, f, points + 1);
        const double term = iccp_orient_value(dim, points);
        sum += term;
        size += fabs(term);
    }
    *orientation = sum > 0 ? 1 : -1;
    if (dim > 3 && !(fabs(sum) > NO_VOLUME * size))
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "the volume of the shape is too small for double precision");
    *volume = fabs(sum);
    for (size_t k = 2; k <= dim; ++k)
        *volume /= (double)k;
    return ICC_OK;
}
