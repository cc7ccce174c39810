/* Makes shapes. All walls are in one tree, in the coordinates of one frame. So exact signs decide
 * what lies behind a wall. */
#include "kernel/sampling/shape.h"

#include "base/error.h"
#include "base/minmax.h"
#include "geometry/segment.h"
#include "geometry/triangles.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* In units of the box's longest side: covers rounding of input files, as for domains. */
static const double WALL_TOLERANCE = 1e-14;
/* Share of the largest coordinate by which a point between two vertices may be wrong. For denormal
 * numbers their own gap counts. */
static const double ROUNDING = 4 * DBL_EPSILON;

/* Checks what the types do not guarantee. The n_vertices * dim coordinates are finite, and the
 * n_segments * 2 indices exist. No segment is a point, which would have no direction. */
static icc_status check_curves(size_t dim, size_t n_vertices, const double *vertices,
                               size_t n_segments, const uint32_t *segments, icc_error *err)
{
    for (size_t i = 0; i < n_vertices; ++i)
        for (size_t k = 0; k < dim; ++k)
            if (!isfinite(vertices[dim * i + k]))
                return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_VERTEX, (int64_t)i,
                                    "vertex %zu of the curves is not finite", i);
    for (size_t s = 0; s < n_segments; ++s) {
        const uint32_t *ends = segments + 2 * s;
        for (int i = 0; i < 2; ++i)
            if (ends[i] >= n_vertices)
                return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_SEGMENT, (int64_t)s,
                                    "segment %zu has vertex %lu of %zu", s, (unsigned long)ends[i],
                                    n_vertices);
        bool same = true;
        for (size_t k = 0; k < dim; ++k)
            same &= vertices[dim * ends[0] + k] == vertices[dim * ends[1] + k];
        if (same)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_SEGMENT, (int64_t)s,
                                "segment %zu has no length", s);
    }
    return ICC_OK;
}

static size_t count_vertices(const icc_shape *shape)
{
    size_t n = shape->n_vertices;
    for (size_t r = 0; r < shape->n_regions; ++r)
        n += shape->regions[r]->n_vertices;
    return n;
}

static size_t count_facets(const icc_shape *shape)
{
    size_t n = 0;
    for (size_t r = 0; r < shape->n_regions; ++r)
        n += shape->regions[r]->n_facets;
    return n;
}

static icc_status allocate(icc_shape *shape, size_t n_all, size_t n_facets)
{
    const size_t dim = shape->dim;
    const iccp_memory *memory = &shape->memory;
    shape->vertices = iccp_alloc(memory, shape->n_vertices, dim * sizeof *shape->vertices);
    shape->segments = iccp_alloc(memory, shape->n_segments, 2 * sizeof *shape->segments);
    shape->local = iccp_alloc(memory, n_all, dim * sizeof *shape->local);
    shape->facets = iccp_alloc(memory, n_facets, dim * sizeof *shape->facets);
    shape->owner = iccp_alloc(memory, n_facets, sizeof *shape->owner);
    shape->sticks = iccp_alloc(memory, shape->n_segments, dim * sizeof *shape->sticks);
    return shape->vertices == NULL || shape->segments == NULL || shape->local == NULL ||
                   shape->facets == NULL || shape->owner == NULL || shape->sticks == NULL
               ? ICC_ERR_MEMORY
               : ICC_OK;
}

/* Collects everything in the caller's coordinates. A vertex that belongs to no facet is replaced by
 * one that does. */
static void gather(icc_shape *shape)
{
    const size_t dim = shape->dim;
    size_t n = 0, n_facets = 0;
    for (uint32_t r = 0; r < shape->n_regions; ++r) {
        const icc_domain *d = shape->regions[r];
        for (size_t i = 0; i < dim * d->n_facets; ++i)
            shape->facets[dim * n_facets + i] = (uint32_t)n + d->facets[i];
        for (size_t f = 0; f < d->n_facets; ++f)
            shape->owner[n_facets++] = r;
        for (size_t i = 0; i < d->n_vertices; ++i)
            iccp_frame_out(&d->frame, d->dim, d->vertices + dim * i, shape->local + dim * n++);
    }
    shape->n_walled = n;
    memcpy(shape->local + dim * n, shape->vertices, shape->n_vertices * dim * sizeof *shape->local);
    for (size_t s = 0; s < shape->n_segments; ++s)
        for (size_t i = 0; i < dim; ++i)
            shape->sticks[dim * s + i] = (uint32_t)n + shape->segments[2 * s + (i > 0)];
}

/* Computes the box, the frame, and local coordinates. */
static icc_status localise(icc_shape *shape, size_t n, icc_error *err)
{
    const size_t dim = shape->dim;
    double largest = 0, longest = 0;
    for (size_t k = 0; k < dim; ++k) {
        shape->lower[k] = HUGE_VAL;
        shape->upper[k] = -HUGE_VAL;
        for (size_t i = 0; i < n; ++i) {
            const double x = shape->local[dim * i + k];
            shape->lower[k] = iccp_min(shape->lower[k], x);
            shape->upper[k] = iccp_max(shape->upper[k], x);
            largest = iccp_max(largest, fabs(x));
        }
    }
    iccp_frame_fit(&shape->frame, (int32_t)dim, n, shape->local);
    for (size_t i = 0; i < n; ++i) {
        double *x = shape->local + dim * i;
        if (!iccp_frame_holds(&shape->frame, (int32_t)dim, x))
            return iccp_fail(err, ICC_ERR_BOUNDARY,
                             "a vertex is nearer to an axis than 2^-200 of the shape's size");
        iccp_frame_in(&shape->frame, (int32_t)dim, x, x);
    }
    const double *in = shape->frame.in;
    for (size_t k = 0; k < dim; ++k)
        longest =
            iccp_max(longest, shape->upper[k] * in[0] * in[1] - shape->lower[k] * in[0] * in[1]);
    shape->tolerance =
        WALL_TOLERANCE * longest + iccp_max(ROUNDING * largest, 4 * DBL_TRUE_MIN) * in[0] * in[1];
    return ICC_OK;
}

static bool facets_meet(const icc_shape *shape, uint32_t f, uint32_t g)
{
    const size_t dim = shape->dim;
    const uint32_t *a = shape->facets + dim * f, *b = shape->facets + dim * g;
    const double *x = shape->local;
    if (dim == 3)
        return iccp_triangles_meet(x, a, b);
    return iccp_segments_meet(x + 2 * a[0], x + 2 * a[1], x + 2 * b[0], x + 2 * b[1]) != 0;
}

/* Each boundary by itself is known to be simple. */
static icc_status check_walls(const icc_shape *shape, const iccp_env *env, icc_error *err)
{
    for (size_t place = 0; shape->n_regions > 1 && place < shape->walls.n; ++place) {
        if (place % 1024 == 0) {
            const icc_status status = iccp_explain(
                err, iccp_progress(env, "check", (double)place / (double)shape->walls.n));
            if (status != ICC_OK)
                return status;
        }
        iccp_facet_query query;
        const uint32_t f = shape->walls.order[place];
        uint32_t g;
        iccp_facet_query_start_after(&query, &shape->walls, place);
        while (iccp_facet_query_next(&query, &g)) {
            const uint32_t r = shape->owner[f], s = shape->owner[g];
            if (r != s && facets_meet(shape, f, g))
                return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_REGION, r > s ? r : s,
                                    "the boundaries of regions %lu and %lu meet",
                                    (unsigned long)(r < s ? r : s), (unsigned long)(r < s ? s : r));
        }
    }
    return ICC_OK;
}

static icc_status plant(iccp_facet_tree *tree, const icc_shape *shape, size_t n,
                        const uint32_t *facets)
{
    if (n == 0)
        return ICC_OK;
    iccp_facet_tree_create(tree, shape->dim, shape->local, n, facets, &shape->memory);
    return tree->boxes != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Computes everything that follows from the regions and the curves. */
static icc_status complete(icc_shape *shape, const double *vertices, const uint32_t *segments,
                           const iccp_env *env, icc_error *err)
{
    const size_t n = count_vertices(shape), n_facets = count_facets(shape);
    if (n > UINT32_MAX / 4 || n_facets > UINT32_MAX / 4 || shape->n_segments > UINT32_MAX / 4)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "more than 2^30 vertices or facets");
    icc_status status = allocate(shape, n, n_facets);
    if (status != ICC_OK)
        return iccp_fail_memory(err);
    if (shape->n_vertices > 0)
        memcpy(shape->vertices, vertices, shape->n_vertices * shape->dim * sizeof *vertices);
    if (shape->n_segments > 0)
        memcpy(shape->segments, segments, shape->n_segments * 2 * sizeof *segments);
    gather(shape);
    status = localise(shape, n, err);
    if (status != ICC_OK)
        return status;
    status = plant(&shape->walls, shape, n_facets, shape->facets);
    if (status == ICC_OK)
        status = plant(&shape->curves, shape, shape->n_segments, shape->sticks);
    if (status == ICC_OK)
        status = iccp_segment_graph_create(&shape->graph, shape->dim, shape->n_vertices,
                                           shape->local + shape->dim * shape->n_walled,
                                           shape->n_segments, shape->segments, &shape->memory);
    return status == ICC_OK ? check_walls(shape, env, err) : iccp_explain(err, status);
}

icc_status iccp_shape_create(icc_shape **out, int32_t dim, size_t n_regions,
                             const icc_domain *const *regions, size_t n_vertices,
                             const double *vertices, size_t n_segments, const uint32_t *segments,
                             const iccp_env *env, icc_error *err)
{
    *out = NULL;
    icc_status status = check_curves((size_t)dim, n_vertices, vertices, n_segments, segments, err);
    if (status != ICC_OK)
        return status;
    icc_shape *shape = iccp_alloc_zero(&env->memory, 1, sizeof *shape);
    if (shape == NULL)
        return iccp_fail_memory(err);
    shape->memory = env->memory;
    atomic_init(&shape->references, 1);
    shape->dim = (size_t)dim;
    shape->n_vertices = n_vertices;
    shape->n_segments = n_segments;
    shape->regions = iccp_alloc(&env->memory, n_regions, sizeof(icc_domain *));
    if (shape->regions != NULL) {
        for (; shape->n_regions < n_regions; ++shape->n_regions)
            shape->regions[shape->n_regions] = iccp_domain_retain(regions[shape->n_regions]);
        status = complete(shape, vertices, segments, env, err);
    } else {
        status = iccp_fail_memory(err);
    }
    if (status != ICC_OK) {
        iccp_shape_release(shape);
        return status;
    }
    *out = shape;
    return ICC_OK;
}

icc_shape *iccp_shape_retain(const icc_shape *shape)
{
    icc_shape *shared = (icc_shape *)shape;
    atomic_fetch_add_explicit(&shared->references, 1, memory_order_relaxed);
    return shared;
}

void iccp_shape_release(icc_shape *shape)
{
    if (shape == NULL ||
        atomic_fetch_sub_explicit(&shape->references, 1, memory_order_acq_rel) != 1)
        return;
    const iccp_memory memory = shape->memory;
    for (size_t r = 0; r < shape->n_regions; ++r)
        iccp_domain_release(shape->regions[r]);
    iccp_facet_tree_free(&shape->walls, &memory);
    iccp_facet_tree_free(&shape->curves, &memory);
    iccp_segment_graph_free(&shape->graph);
    iccp_free(&memory, shape->regions);
    iccp_free(&memory, shape->vertices);
    iccp_free(&memory, shape->segments);
    iccp_free(&memory, shape->local);
    iccp_free(&memory, shape->facets);
    iccp_free(&memory, shape->owner);
    iccp_free(&memory, shape->sticks);
    iccp_free(&memory, shape);
}
