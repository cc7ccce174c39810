/* All walls stand in one tree, in the coordinates of one frame: exact signs decide what is behind one. */
#include "kernel/shape.h"

#include "base/error.h"
#include "domain/inside.h"
#include "domain/segment.h"
#include "domain/simplex.h"
#include "domain/triangles.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* In longest sides of the box: rounding of input files, as for domains. */
static const double WALL_TOLERANCE = 1e-14;
/* Curves have no inside that points could be taken for: what was meant to be on one is. */
static const double CURVE_TOLERANCE = 1e-9;
/* Of the largest coordinate: a point between two vertices is off by so much. */
static const double ROUNDING = 4 * DBL_EPSILON;

/* ------------------------------------------------------------------ making */

static icc_status check_curves(size_t dim, size_t n_vertices, const double *vertices,
                               size_t n_segments, const uint32_t *segments, icc_error *err)
{
    for (size_t i = 0; i < n_vertices; ++i)
        for (size_t k = 0; k < dim; ++k)
            if (!isfinite(vertices[dim * i + k]))
                return iccp_fail(err, ICC_ERR_ARGUMENT, (int64_t)i,
                                 "vertex %zu of the curves is not finite", i);
    for (size_t s = 0; s < n_segments; ++s) {
        const uint32_t *ends = segments + 2 * s;
        for (int i = 0; i < 2; ++i)
            if (ends[i] >= n_vertices)
                return iccp_fail(err, ICC_ERR_ARGUMENT, (int64_t)s,
                                 "segment %zu has vertex %lu of %zu", s, (unsigned long)ends[i],
                                 n_vertices);
        bool same = true;
        for (size_t k = 0; k < dim; ++k)
            same &= vertices[dim * ends[0] + k] == vertices[dim * ends[1] + k];
        if (same)
            return iccp_fail(err, ICC_ERR_ARGUMENT, (int64_t)s, "segment %zu has no length", s);
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

/* Everything in the caller's coordinates, where a vertex that belongs to no facet is one that does. */
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

/* The box, the frame, and local coordinates. */
static icc_status localise(icc_shape *shape, size_t n, icc_error *err)
{
    const size_t dim = shape->dim;
    double largest = 0, longest = 0;
    for (size_t k = 0; k < dim; ++k) {
        shape->lower[k] = HUGE_VAL;
        shape->upper[k] = -HUGE_VAL;
        for (size_t i = 0; i < n; ++i) {
            const double x = shape->local[dim * i + k];
            shape->lower[k] = fmin(shape->lower[k], x);
            shape->upper[k] = fmax(shape->upper[k], x);
            largest = fmax(largest, fabs(x));
        }
    }
    iccp_frame_fit(&shape->frame, (int32_t)dim, n, shape->local);
    for (size_t i = 0; i < n; ++i) {
        double *x = shape->local + dim * i;
        if (!iccp_frame_holds(&shape->frame, (int32_t)dim, x))
            return iccp_fail(err, ICC_ERR_BOUNDARY, -1,
                             "a vertex is nearer to an axis than 2^-200 of the shape's size");
        iccp_frame_in(&shape->frame, (int32_t)dim, x, x);
    }
    const double *in = shape->frame.in;
    for (size_t k = 0; k < dim; ++k)
        longest = fmax(longest, shape->upper[k] * in[0] * in[1] - shape->lower[k] * in[0] * in[1]);
    shape->tolerance = WALL_TOLERANCE * longest + ROUNDING * largest * in[0] * in[1];
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
                err, iccp_progress(env, "check walls", (double)place / (double)shape->walls.n));
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
                return iccp_fail(err, ICC_ERR_BOUNDARY, r > s ? r : s,
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

/* Everything that follows from the regions and the curves. */
static icc_status complete(icc_shape *shape, const double *vertices, const uint32_t *segments,
                           const iccp_env *env, icc_error *err)
{
    const size_t n = count_vertices(shape), n_facets = count_facets(shape);
    if (n > UINT32_MAX / 4 || n_facets > UINT32_MAX / 4 || shape->n_segments > UINT32_MAX / 4)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "more than 2^30 vertices or facets");
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
    return status == ICC_OK ? check_walls(shape, env, err) : iccp_explain(err, status);
}

icc_status iccp_shape_create(icc_shape **out, int32_t dim, size_t n_regions,
                             const icc_domain *const *regions, size_t n_vertices,
                             const double *vertices, size_t n_segments, const uint32_t *segments,
                             const iccp_env *env, icc_error *err)
{
    *out = NULL;
    icc_status status =
        check_curves((size_t)dim, n_vertices, vertices, n_segments, segments, err);
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
    iccp_free(&memory, shape->regions);
    iccp_free(&memory, shape->vertices);
    iccp_free(&memory, shape->segments);
    iccp_free(&memory, shape->local);
    iccp_free(&memory, shape->facets);
    iccp_free(&memory, shape->owner);
    iccp_free(&memory, shape->sticks);
    iccp_free(&memory, shape);
}

/* ------------------------------------------------------------------ points */

/* Of regions around a point that is on no wall, one within another, the smallest. */
static uint32_t innermost(const icc_shape *shape, const double *point)
{
    uint32_t found = ICCP_NOWHERE;
    double least = HUGE_VAL;
    for (uint32_t r = 0; r < shape->n_regions; ++r) {
        const icc_domain *d = shape->regions[r];
        double local[3];
        iccp_frame_in(&d->frame, d->dim, point, local);
        if (iccp_domain_locate(d, local, true, NULL, NULL) == ICC_OUTSIDE)
            continue;
        double size = d->measure;
        for (int32_t k = 0; k < d->dim; ++k)
            size *= d->frame.out[0] * shape->frame.in[0] * (d->frame.out[1] * shape->frame.in[1]);
        if (found == ICCP_NOWHERE || size < least) {
            found = r;
            least = size;
        }
    }
    return found;
}

static double distance(size_t dim, const double *a, const double *b)
{
    double sum = 0;
    for (size_t k = 0; k < dim; ++k)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

iccp_spot iccp_shape_spot(const icc_shape *shape, const double *point)
{
    double local[3], bary[3], distance2;
    iccp_spot spot = {.clearance = HUGE_VAL,
                      .wall = ICCP_NOWHERE,
                      .region = ICCP_NOWHERE,
                      .curve = ICCP_NOWHERE};
    iccp_frame_in(&shape->frame, (int32_t)shape->dim, point, local);
    iccp_inside_reach(shape->dim, local, spot.at);
    if (shape->walls.n > 0) {
        const uint32_t f = iccp_facet_tree_nearest(&shape->walls, spot.at, bary, &distance2);
        spot.clearance = sqrt(distance2);
        spot.wall = spot.clearance <= shape->tolerance ? f : ICCP_NOWHERE;
        spot.region = spot.wall != ICCP_NOWHERE ? shape->owner[f] : innermost(shape, point);
    }
    if (shape->curves.n > 0) {
        const uint32_t s = iccp_facet_tree_nearest(&shape->curves, spot.at, bary, &distance2);
        if (sqrt(distance2) <= CURVE_TOLERANCE + shape->tolerance)
            spot.curve = s;
    }
    return spot;
}

iccp_spot iccp_shape_spot_beside(const icc_shape *shape, const iccp_spot *other, const double *point,
                                 double reach)
{
    iccp_spot spot = *other;
    double local[3];
    iccp_frame_in(&shape->frame, (int32_t)shape->dim, point, local);
    iccp_inside_reach(shape->dim, local, spot.at);
    spot.clearance = other->clearance - distance(shape->dim, spot.at, other->at);
    if (!(spot.clearance > reach + shape->tolerance))
        return iccp_shape_spot(shape, point);
    spot.curve = ICCP_NOWHERE;
    spot.beside = true;
    return spot;
}

uint32_t iccp_shape_region(const icc_shape *shape, const double *point)
{
    return iccp_shape_spot(shape, point).region;
}

bool iccp_shape_holds(const icc_shape *shape, const double *point)
{
    const iccp_spot spot = iccp_shape_spot(shape, point);
    return spot.region != ICCP_NOWHERE || spot.curve != ICCP_NOWHERE;
}

/* ------------------------------------------------------------------- sight */

static bool stands_on(const icc_shape *shape, const iccp_spot *spot, uint32_t wall)
{
    const double *corners[3];
    double bary[3];
    if (spot->wall == ICCP_NOWHERE)
        return false;
    iccp_facet_corners(&shape->walls, wall, corners);
    const double distance2 = iccp_simplex_nearest(shape->dim, shape->dim, corners, spot->at, bary);
    return sqrt(distance2) <= shape->tolerance;
}

/* The plane of a wall that an end stands on is met there and nowhere else, but for rounding. */
static bool blocked(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    const size_t dim = shape->dim;
    double box[6], share;
    iccp_facet_query query;
    uint32_t wall;
    for (size_t k = 0; k < dim; ++k) {
        box[k] = fmin(a->at[k], b->at[k]);
        box[dim + k] = fmax(a->at[k], b->at[k]);
    }
    iccp_facet_query_start(&query, &shape->walls, box);
    query.from = a->at;
    query.to = b->at;
    while (iccp_facet_query_next(&query, &wall))
        if (iccp_segment_meets(&shape->walls, wall, a->at, b->at, &share) &&
            !stands_on(shape, a, wall) && !stands_on(shape, b, wall))
            return true;
    return false;
}

/* The region that a segment runs through which meets no wall between its ends. */
static uint32_t region_between(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    double middle[3], point[3];
    if (a->wall == ICCP_NOWHERE)
        return a->region;
    if (b->wall == ICCP_NOWHERE)
        return b->region;
    for (size_t k = 0; k < shape->dim; ++k)
        middle[k] = 0.5 * (a->at[k] + b->at[k]);
    iccp_frame_out(&shape->frame, (int32_t)shape->dim, middle, point);
    return iccp_shape_region(shape, point);
}

static bool sees_through_region(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    if (a->region == ICCP_NOWHERE)
        return false;
    if (a->wall != ICCP_NOWHERE && a->wall == b->wall)
        return true;
    if (distance(shape->dim, a->at, b->at) < fmax(a->clearance, b->clearance))
        return true;
    return !blocked(shape, a, b) && region_between(shape, a, b) == a->region;
}

static bool sees_along_curve(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    if (a->curve == ICCP_NOWHERE || b->curve == ICCP_NOWHERE)
        return false;
    const uint32_t *s = shape->segments + 2 * (size_t)a->curve;
    const uint32_t *t = shape->segments + 2 * (size_t)b->curve;
    return s[0] == t[0] || s[0] == t[1] || s[1] == t[0] || s[1] == t[1];
}

bool iccp_spot_sees(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    return sees_through_region(shape, a, b) || sees_along_curve(shape, a, b);
}

bool iccp_shape_sees(const icc_shape *shape, const double *a, const double *b)
{
    const iccp_spot from = iccp_shape_spot(shape, a), to = iccp_shape_spot(shape, b);
    return iccp_spot_sees(shape, &from, &to);
}
