/* Checks polygons that the caller gives, and describes their defects. */
#include "geometry/polygon_check.h"

#include "base/compiler.h"
#include "base/error.h"
#include "base/simd.h"
#include "geometry/defects.h"
#include "geometry/segment.h"
#include "geometry/simple.h"
#include "geometry/sweep.h"
#include "math/expansion.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

enum { AREA_BLOCK = 64 };

static bool finite_point(const double *p)
{
    return isfinite(p[0]) && isfinite(p[1]);
}

static icc_status fail_not_finite(icc_error *err, size_t vertex)
{
    return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)vertex,
                        "vertex %zu is not finite", vertex);
}

static icc_status fail_too_small(icc_error *err, size_t vertex, const double *x)
{
    return iccp_fail_at(
        err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)vertex,
        "vertex %zu (%.17g, %.17g): a coordinate is not 0, but less than 2^-200 of the "
        "largest one",
        vertex, x[0], x[1]);
}

icc_status iccp_polygon_check_counts(size_t n_vertices, size_t n_facets, const uint32_t *facets,
                                     icc_error *err)
{
    if (n_vertices < 3)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "a polygon needs at least 3 vertices, not %zu",
                         n_vertices);
    if (facets != NULL && n_facets != n_vertices)
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "a closed ring through %zu vertices has as many facets, not %zu",
                         n_vertices, n_facets);
    return ICC_OK;
}

icc_status iccp_polygon_check_finite(size_t n, const double *vertices, icc_error *err)
{
    if (!iccp_all_finite(2 * n, vertices))
        for (size_t i = 0; i < n; ++i)
            if (!finite_point(vertices + 2 * i))
                return fail_not_finite(err, i);
    return ICC_OK;
}

icc_status iccp_polygon_bring_in(const iccp_frame *frame, double *local, size_t n,
                                 const double *vertices, icc_error *err)
{
    if (!iccp_frame_in_all(frame, n, vertices, local))
        for (size_t i = 0; i < n; ++i)
            if (!iccp_frame_holds(frame, 2, vertices + 2 * i))
                return fail_too_small(err, i, vertices + 2 * i);
    return ICC_OK;
}

icc_status iccp_polygon_localise(iccp_frame *frame, double *local, size_t n, const double *vertices,
                                 icc_error *err)
{
    const icc_status status = iccp_polygon_check_finite(n, vertices, err);
    if (status != ICC_OK)
        return status;
    iccp_frame_fit(frame, 2, n, vertices);
    return iccp_polygon_bring_in(frame, local, n, vertices, err);
}

/* Writes "cross near (x, y)" with the caller's numbers of vertices or edges. */
static icc_status fail_pair(icc_error *err, const iccp_defect *defect, const iccp_polygon *polygon,
                            const iccp_frame *frame)
{
    const double *a = polygon->points + 2 * (size_t)defect->a,
                 *b = polygon->points + 2 * (size_t)defect->b;
    double at[2];
    iccp_segments_point(a, a + 2, b, b + 2, at);
    iccp_frame_out(frame, 2, at, at);
    const uint32_t e = iccp_polygon_facet(polygon, defect->a),
                   f = iccp_polygon_facet(polygon, defect->b);
    return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, e < f ? e : f,
                        "edges %lu and %lu %s near (%.9g, %.9g)", (unsigned long)(e < f ? e : f),
                        (unsigned long)(e < f ? f : e),
                        defect->kind == ICC_DEFECT_CROSSING ? "cross" : "touch", at[0], at[1]);
}

static icc_status fail_defect(icc_error *err, const iccp_defect *defect,
                              const iccp_polygon *polygon, const iccp_frame *frame)
{
    const uint32_t v = iccp_polygon_vertex(polygon, defect->a),
                   w = iccp_polygon_vertex(polygon, defect->b);
    switch (defect->kind) {
    case ICC_DEFECT_REPEATED:
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, v > w ? v : w,
                            "vertex %lu repeats vertex %lu", (unsigned long)(v > w ? v : w),
                            (unsigned long)(v > w ? w : v));
    case ICC_DEFECT_SPIKE:
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, v,
                            "at vertex %lu the boundary runs back over itself", (unsigned long)v);
    case ICC_DEFECT_FLAT:
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "all vertices lie on one line: the shape has no area");
    default:
        return fail_pair(err, defect, polygon, frame);
    }
}

/* Finds the first defect of the list, or none if that takes too long. */
static icc_status find_first(iccp_defect *first, const iccp_polygon *polygon, size_t number,
                             const iccp_env *env)
{
    if (number < polygon->n) {
        *first = iccp_defects_at(polygon, (uint32_t)number);
        return ICC_OK;
    }
    iccp_boxtree tree;
    iccp_boxtree_create(&tree, polygon->points, polygon->n, &env->memory);
    if (tree.boxes == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_defects_first(first, polygon, &tree, env);
    iccp_boxtree_free(&tree, &env->memory);
    return status;
}

/* The quick test decides for most polygons, and the sweep for the others. The message names the
 * first defect of the list. If finding that takes too long, it names what the sweep finds. */
icc_status iccp_polygon_check(const iccp_polygon *polygon, const iccp_frame *frame,
                              const iccp_env *env, icc_error *err)
{
    iccp_defect any = {0}, first = {0};
    iccp_simple quick;
    icc_status status = iccp_simple_find(&quick, polygon->points, polygon->n, env);
    if (status == ICC_OK && quick.answer == ICCP_UNDECIDED)
        status = iccp_sweep(&any, polygon, env);
    if (status == ICC_OK && quick.answer != ICCP_NOT_SIMPLE && any.kind == 0)
        return ICC_OK;
    if (status == ICC_OK)
        status = find_first(&first, polygon, quick.first, env);
    if (status == ICC_OK && first.kind == 0 && any.kind == 0)
        status = iccp_sweep(&any, polygon, env);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    return fail_defect(err, first.kind != 0 ? &first : &any, polygon, frame);
}

icc_status iccp_polygon_check_points(size_t n, const double *points, const uint32_t *polygon,
                                     const iccp_frame *frame, const iccp_env *env, icc_error *err)
{
    if (n < 3)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "a polygon needs at least 3 vertices, not %zu", n);
    iccp_polygon copy = {.n = n};
    copy.points = copy.own = iccp_alloc(&env->memory, n + 1, 2 * sizeof *copy.own);
    if (copy.own == NULL)
        return iccp_fail_memory(err);
    for (uint32_t k = 0; k < n; ++k) {
        const size_t from = polygon != NULL ? polygon[k] : k;
        memcpy(copy.own + 2 * (size_t)k, points + 2 * from, 2 * sizeof *points);
    }
    memcpy(copy.own + 2 * n, copy.own, 2 * sizeof *points);
    const icc_status status = iccp_polygon_check(&copy, frame, env, err);
    iccp_polygon_free(&copy, &env->memory);
    return status;
}

int iccp_polygon_orientation(const iccp_polygon *polygon)
{
    uint32_t v = 0;
    for (uint32_t k = 1; k < polygon->n; ++k)
        if (iccp_point_less(polygon->points + 2 * (size_t)k, polygon->points + 2 * (size_t)v))
            v = k;
    const double *p = polygon->points + 2 * (size_t)v;
    return iccp_orient2d(polygon->points + 2 * (size_t)iccp_polygon_before(polygon, v), p, p + 2);
}

/* Points of a polygon relative to the first one, and the upper and lower halves of their
 * coordinates, whose products are exact. Also what the two products of each side add to their
 * sums. */
typedef struct area_block {
    double at[2][AREA_BLOCK + 1], high[2][AREA_BLOCK + 1], low[2][AREA_BLOCK + 1];
    double product[AREA_BLOCK][2], error[AREA_BLOCK][2];
} area_block;

/* Does what iccp_two_product() does, for coordinate k of point i and coordinate l of the next
 * point. */
static ICCP_INLINE void multiply(area_block *block, size_t i, size_t k, size_t l)
{
    const double a_high = block->high[k][i], a_low = block->low[k][i];
    const double b_high = block->high[l][i + 1], b_low = block->low[l][i + 1];
    const double product = block->at[k][i] * block->at[l][i + 1];
    block->product[i][k] = product;
    block->error[i][k] =
        a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/* Multiplies the sides from `points` on; no step waits for another. Beyond n sides, the first point
 * is repeated. */
static ICCP_INLINE void multiply_sides(area_block *block, size_t n, const double *points,
                                       const double *origin)
{
    for (size_t i = 0; i <= n; ++i) {
        block->at[0][i] = points[2 * i] - origin[0];
        block->at[1][i] = points[2 * i + 1] - origin[1];
    }
    for (size_t i = n + 1; i <= AREA_BLOCK; ++i)
        block->at[0][i] = block->at[1][i] = 0;
    for (size_t k = 0; k < 2; ++k)
        for (size_t i = 0; i <= AREA_BLOCK; ++i) {
            block->high[k][i] = iccp_upper_half(block->at[k][i]);
            block->low[k][i] = block->at[k][i] - block->high[k][i];
        }
    for (size_t i = 0; i < AREA_BLOCK; ++i) {
        multiply(block, i, 0, 1);
        multiply(block, i, 1, 0);
    }
}

/* Half the sum of the cross products of the sides, relative to vertex 0. Each product and each sum
 * carries its rounding error: T. Ogita, S. M. Rump, S. Oishi, Accurate sum and dot product, 2005,
 * algorithm 5.3. The two products of a cross product have separate sums, so neither waits for the
 * other. */
static ICCP_INLINE double area_of(const iccp_polygon *polygon)
{
    area_block block;
    double sum[2] = {0, 0}, error[2] = {0, 0}, tail;
    for (size_t k = 1; k + 1 < polygon->n; k += AREA_BLOCK) {
        const size_t left = polygon->n - 1 - k, n = left < AREA_BLOCK ? left : AREA_BLOCK;
        multiply_sides(&block, n, polygon->points + 2 * k, polygon->points);
        for (size_t i = 0; i < n; ++i)
            for (int l = 0; l < 2; ++l) {
                double lost;
                sum[l] = iccp_two_sum(sum[l], block.product[i][l], &lost);
                error[l] += block.error[i][l] + lost;
            }
    }
    const double total = iccp_two_sum(sum[0], -sum[1], &tail);
    return 0.5 * fabs(total + (tail + (error[0] - error[1])));
}

#ifdef ICCP_HAS_SIMD
ICCP_AVX2 static double area_avx2(const iccp_polygon *polygon)
{
    return area_of(polygon);
}
#endif

double iccp_polygon_area(const iccp_polygon *polygon)
{
#ifdef ICCP_HAS_SIMD
    if (iccp_simd() >= ICCP_SIMD_AVX2)
        return area_avx2(polygon);
#endif
    return area_of(polygon);
}

/* Local coordinates for the list of defects. A vertex that is not finite becomes NaN. The frame
 * fits the finite vertices, which `scratch` gathers. */
static icc_status localise_finite(double *local, double *scratch, size_t n, const double *vertices,
                                  icc_error *err)
{
    size_t n_finite = 0;
    for (size_t i = 0; i < n; ++i)
        if (finite_point(vertices + 2 * i)) {
            scratch[2 * n_finite] = vertices[2 * i];
            scratch[2 * n_finite + 1] = vertices[2 * i + 1];
            ++n_finite;
        }
    iccp_frame frame = iccp_frame_identity();
    if (n_finite > 0)
        iccp_frame_fit(&frame, 2, n_finite, scratch);
    for (size_t i = 0; i < n; ++i) {
        if (!finite_point(vertices + 2 * i)) {
            local[2 * i] = local[2 * i + 1] = NAN;
            continue;
        }
        if (!iccp_frame_holds(&frame, 2, vertices + 2 * i))
            return fail_too_small(err, i, vertices + 2 * i);
        iccp_frame_in(&frame, 2, vertices + 2 * i, local + 2 * i);
    }
    return ICC_OK;
}

icc_status iccp_boundary_defects(size_t n, const double *vertices, size_t capacity, int32_t *kinds,
                                 uint32_t *items, size_t *n_defects, const iccp_env *env,
                                 icc_error *err)
{
    const iccp_memory *memory = &env->memory;
    iccp_defect_list list = {.capacity = capacity, .kinds = kinds, .items = items};
    double *points = iccp_alloc(memory, n + 1, 2 * sizeof *points);
    const iccp_polygon polygon = {.n = n, .points = points};
    iccp_boxtree tree = {0};
    double *scratch = iccp_alloc(memory, n, 2 * sizeof(double));
    icc_status status = ICC_ERR_MEMORY;
    if (points != NULL && scratch != NULL)
        status = localise_finite(points, scratch, n, vertices, err);
    iccp_free(memory, scratch);
    if (status == ICC_OK && n > 0) {
        points[2 * n] = points[0];
        points[2 * n + 1] = points[1];
    }
    if (status == ICC_OK) {
        iccp_boxtree_create(&tree, points, n, memory);
        status =
            tree.boxes != NULL ? iccp_defects_list(&list, &polygon, &tree, env) : ICC_ERR_MEMORY;
    }
    iccp_boxtree_free(&tree, memory);
    iccp_free(memory, points);
    *n_defects = list.n;
    return iccp_explain(err, status);
}
