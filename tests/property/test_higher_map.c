/* What holds for mesh maps beyond three dimensions: they are certified, and from the boundary
 * alone. */
#include "map/higher/kernel_point.h"

#include "../determinant.h"
#include "../faulty.h"
#include "../flat_mesh.h"
#include "../saved.h"
#include "../suite.h"

#include "../default_env.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX = ICC_MAX_DIM, MOST_VERTICES = 4000, MOST_FACETS = 16000, N_POINTS = 40 };

/* A boundary, and how it was made. */
typedef struct shape {
    int32_t dim;
    size_t n_vertices, n_facets;
    double vertices[MOST_VERTICES * 6];
    uint32_t facets[MOST_FACETS * 6];
    size_t cells[MAX]; /* shape of the mask, or 0 */
    uint8_t mask[81];
} shape;

/* ---- shapes ---- */

static double sign_of_facet(const shape *s, const uint32_t *facet, const double *inner)
{
    double matrix[MAX * MAX];
    const size_t dim = (size_t)s->dim;
    for (size_t i = 0; i < dim; ++i)
        for (size_t k = 0; k < dim; ++k)
            matrix[dim * i + k] = s->vertices[dim * facet[i] + k] - inner[k];
    return determinant(s->dim, matrix);
}

/* Adds a facet of a convex shape, as seen from outside. */
static void add_facet(shape *s, const uint32_t *facet, const double *inner)
{
    const size_t dim = (size_t)s->dim;
    uint32_t *to = s->facets + dim * s->n_facets++;
    ck_assert_uint_le(s->n_facets, MOST_FACETS);
    memcpy(to, facet, dim * sizeof *to);
    if (sign_of_facet(s, to, inner) < 0) {
        to[0] = facet[1];
        to[1] = facet[0];
    }
}

/* The simplex of the origin and the unit vectors. */
static void make_simplex(shape *s, int32_t dim)
{
    const uint32_t n = (uint32_t)dim + 1;
    double inner[MAX];
    s->dim = dim;
    s->n_vertices = n;
    for (int32_t k = 0; k < dim; ++k) {
        s->vertices[(k + 1) * dim + k] = 1;
        inner[k] = 1.0 / (n + 1);
    }
    for (uint32_t left_out = 0; left_out < n; ++left_out) {
        uint32_t facet[MAX];
        for (uint32_t i = 0; i < n - 1; ++i)
            facet[i] = i < left_out ? i : i + 1;
        add_facet(s, facet, inner);
    }
}

static void make_cross_polytope(shape *s, int32_t dim)
{
    const double inner[MAX] = {0};
    s->dim = dim;
    s->n_vertices = 2 * (size_t)dim;
    for (int32_t k = 0; k < 2 * dim; ++k)
        s->vertices[k * dim + k / 2] = k % 2 == 0 ? 1 : -1;
    for (uint32_t signs = 0; signs < 1u << dim; ++signs) {
        uint32_t facet[MAX];
        for (uint32_t k = 0; k < (uint32_t)dim; ++k)
            facet[k] = 2 * k + (signs >> k & 1);
        add_facet(s, facet, inner);
    }
}

/* All monotone ways through the cube's facet `axis` = `end`, from vertex `at` on. */
static void add_ways(shape *s, uint32_t *facet, int32_t n, uint32_t at, uint32_t left,
                     const double *inner)
{
    facet[n] = at;
    if (left == 0)
        add_facet(s, facet, inner);
    for (int32_t k = 0; k < s->dim; ++k)
        if (left >> k & 1)
            add_ways(s, facet, n + 1, at | 1u << k, left & ~(1u << k), inner);
}

static void make_cube(shape *s, int32_t dim)
{
    double inner[MAX];
    s->dim = dim;
    s->n_vertices = (size_t)1 << dim;
    for (size_t v = 0; v < s->n_vertices; ++v)
        for (int32_t k = 0; k < dim; ++k)
            s->vertices[v * (size_t)dim + (size_t)k] = (double)(v >> k & 1);
    for (int32_t k = 0; k < dim; ++k)
        inner[k] = 0.5;
    for (int32_t axis = 0; axis < dim; ++axis)
        for (uint32_t end = 0; end < 2; ++end) {
            uint32_t facet[MAX];
            add_ways(s, facet, 0, end << axis, ((1u << dim) - 1) & ~(1u << axis), inner);
        }
}

/* A tetrahedron times a segment. */
static void make_prism(shape *s)
{
    const double inner[4] = {0.2, 0.2, 0.2, 0.5};
    s->dim = 4;
    s->n_vertices = 8;
    for (size_t v = 0; v < 8; ++v) {
        for (size_t k = 0; k < 3; ++k)
            s->vertices[4 * v + k] = v % 4 == k + 1;
        s->vertices[4 * v + 3] = (double)(v / 4);
    }
    for (uint32_t left_out = 0; left_out < 4; ++left_out)
        for (uint32_t turn = 0; turn < 3; ++turn) {
            uint32_t face[3], facet[4];
            for (uint32_t i = 0; i < 3; ++i)
                face[i] = i < left_out ? i : i + 1;
            for (uint32_t i = 0; i < 4; ++i)
                facet[i] = i <= turn ? face[i] : 4 + face[i - 1];
            add_facet(s, facet, inner);
        }
    add_facet(s, (uint32_t[4]){0, 1, 2, 3}, inner);
    add_facet(s, (uint32_t[4]){4, 5, 6, 7}, inner);
}

static void take_boundary(shape *s, const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert_uint_le(info.n_vertices, MOST_VERTICES);
    ck_assert_uint_le(info.n_facets, MOST_FACETS);
    s->dim = info.dim;
    s->n_vertices = info.n_vertices;
    s->n_facets = info.n_facets;
    ck_assert_int_eq(icc_domain_get_boundary(domain, s->vertices, s->facets), ICC_OK);
}

/* Cells of a mask in 4-D or 5-D; `has` tells which cells of the box are inside. */
static void make_mask(shape *s, int32_t dim, const size_t *cells, bool (*has)(const size_t *at))
{
    size_t n = 1;
    icc_domain *domain;
    for (int32_t k = 0; k < dim; ++k) {
        s->cells[k] = cells[k];
        n *= cells[k];
    }
    for (size_t i = 0; i < n; ++i) {
        size_t at[MAX], rest = i;
        for (int32_t k = 0; k < dim; ++k, rest /= cells[k - 1])
            at[k] = rest % cells[k];
        s->mask[i] = has == NULL || has(at);
    }
    ck_assert_int_eq(icc_domain_create_mask(&domain, dim, s->cells, s->mask, NULL, NULL), ICC_OK);
    take_boundary(s, domain);
    icc_domain_free(domain);
}

static bool is_in_l(const size_t *at)
{
    return at[0] == 0 || at[1] == 0;
}

/* No point sees all of it. */
static bool is_in_u(const size_t *at)
{
    return at[0] != 1 || at[1] == 0;
}

/* A path of cells along three axes. */
static bool is_in_path(const size_t *at)
{
    return (at[0] == 0 && at[1] == 0) || (at[1] == 0 && at[2] == 2) || (at[0] == 2 && at[2] == 2);
}

enum {
    SIMPLEX,
    CROSS,
    CUBE,
    PRISM,
    SIMPLEX_6,
    CUBE_5,
    STARS, /* from here on masks */
    BOX_1 = STARS,
    BOX_2,
    BOX_3,
    BOX_4,
    BOX_5,
    L,
    U,
    PATH,
    N_SHAPES
};

static void make_shape(shape *s, int number)
{
    static const size_t BOXES[5][5] = {
        {2, 1, 1, 1}, {2, 2, 1, 1}, {3, 2, 2, 1}, {2, 2, 2, 2}, {2, 1, 1, 1, 1}};
    memset(s, 0, sizeof *s);
    switch (number) {
    case SIMPLEX:
        make_simplex(s, 4);
        break;
    case CROSS:
        make_cross_polytope(s, 4);
        break;
    case CUBE:
        make_cube(s, 4);
        break;
    case PRISM:
        make_prism(s);
        break;
    case SIMPLEX_6:
        make_simplex(s, 6);
        break;
    case CUBE_5:
        make_cube(s, 5);
        break;
    case L:
        make_mask(s, 4, (size_t[4]){3, 3, 1, 1}, is_in_l);
        break;
    case U:
        make_mask(s, 4, (size_t[4]){3, 3, 2, 1}, is_in_u);
        break;
    case PATH:
        make_mask(s, 4, (size_t[4]){3, 3, 3, 1}, is_in_path);
        break;
    default:
        make_mask(s, number == BOX_5 ? 5 : 4, BOXES[number - BOX_1], NULL);
    }
}

/* The source: the mask if there is one. */
static icc_domain *source_of(const shape *s)
{
    icc_domain *domain = NULL;
    const icc_status status =
        s->cells[0] > 0 ? icc_domain_create_mask(&domain, s->dim, s->cells, s->mask, NULL, NULL)
                        : icc_domain_create(&domain, s->dim, s->n_vertices, s->vertices,
                                            s->n_facets, s->facets, NULL, NULL);
    ck_assert_int_eq(status, ICC_OK);
    return domain;
}

/* ---- targets ---- */

enum { ITSELF, SHEARED, BENT_LITTLE, BENT, BENT_MUCH, N_TARGETS };

static void move_point(const shape *s, int target, const double *x, double *y)
{
    static const double BENDS[N_TARGETS] = {0, 0, 0.02, 0.1, 0.3};
    for (int32_t k = 0; k < s->dim; ++k) {
        const double next = x[(k + 1) % s->dim];
        y[k] = target == SHEARED ? x[k] + (k + 1 < s->dim ? 0.3 * next : 0) + 1
                                 : x[k] + BENDS[target] * sin(next);
    }
}

static icc_domain *target_of(const shape *s, int target)
{
    icc_domain *domain = NULL;
    const size_t dim = (size_t)s->dim;
    double *moved = saved_alloc(dim * s->n_vertices * sizeof *moved);
    for (size_t v = 0; v < s->n_vertices; ++v)
        move_point(s, target, s->vertices + dim * v, moved + dim * v);
    ck_assert_int_eq(icc_domain_create(&domain, s->dim, s->n_vertices, moved, s->n_facets,
                                       s->facets, NULL, NULL),
                     ICC_OK);
    free(moved);
    return domain;
}

/* Points inside the source: means of vertices of the map's simplices. */
static void spread(const icc_map *map, double *points)
{
    const icc_map_info info = info_of_map(map);
    const size_t dim = (size_t)info.dim;
    double *vertices = saved_alloc(dim * info.n_vertices * sizeof *vertices);
    uint32_t *corners = saved_alloc((dim + 1) * info.n_simplices * sizeof *corners);
    ck_assert_int_eq(flat_get_mesh(map, vertices, NULL, corners), ICC_OK);
    memset(points, 0, N_POINTS * dim * sizeof *points);
    for (size_t i = 0; i < N_POINTS; ++i) {
        const uint32_t *v = corners + (dim + 1) * (i * 7919 % info.n_simplices);
        double sum = 0;
        for (size_t k = 0; k <= dim; ++k)
            sum += (double)(1 + (i + k) % 5);
        for (size_t k = 0; k <= dim; ++k)
            for (size_t c = 0; c < dim; ++c)
                points[dim * i + c] += (double)(1 + (i + k) % 5) / sum * vertices[dim * v[k] + c];
    }
    free(vertices);
    free(corners);
}

/* ---- checks ---- */

/* The mesh: all simplices positive on both sides, by other arithmetic, and its volume. */
static void check_mesh(const icc_map *map, const icc_domain *source)
{
    const icc_map_info info = info_of_map(map);
    const size_t dim = (size_t)info.dim;
    icc_domain_info about = {.size = sizeof about};
    double *side[2], volume[2] = {0}, factorial = 1;
    uint32_t *corners = saved_alloc((dim + 1) * info.n_simplices * sizeof *corners);
    for (int k = 0; k < 2; ++k)
        side[k] = saved_alloc(dim * info.n_vertices * sizeof **side);
    ck_assert_int_eq(flat_get_mesh(map, side[0], side[1], corners), ICC_OK);
    for (size_t s = 0; s < info.n_simplices; ++s)
        for (int k = 0; k < 2; ++k) {
            double edges[MAX * MAX];
            const uint32_t *v = corners + (dim + 1) * s;
            for (size_t i = 0; i < dim; ++i)
                for (size_t c = 0; c < dim; ++c)
                    edges[dim * i + c] = side[k][dim * v[i + 1] + c] - side[k][dim * v[0] + c];
            const double det = determinant(info.dim, edges);
            ck_assert_double_gt(det, 0);
            volume[k] += det;
        }
    for (size_t k = 2; k <= dim; ++k)
        factorial *= (double)k;
    ck_assert_int_eq(icc_domain_get_info(source, &about), ICC_OK);
    ck_assert_double_eq_tol(volume[0] / factorial, about.measure, 1e-12 * about.measure);
    for (int k = 0; k < 2; ++k)
        free(side[k]);
    free(corners);
}

/* Points go there and back. The derivative is that of nearby points, and keeps orientation. */
static void check_points(const icc_map *map)
{
    const icc_map_info info = info_of_map(map);
    const size_t dim = (size_t)info.dim;
    double points[N_POINTS * MAX], mapped[N_POINTS * MAX], back[N_POINTS * MAX];
    double jacobians[N_POINTS * MAX * MAX], near[N_POINTS * MAX];
    size_t n_failed;
    spread(map, points);
    ck_assert_int_eq(icc_map_apply(map, N_POINTS, points, mapped, NULL, &n_failed, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 0);
    ck_assert_int_eq(icc_map_apply_inverse(map, N_POINTS, mapped, back, NULL, &n_failed, NULL),
                     ICC_OK);
    ck_assert_uint_eq(n_failed, 0);
    ck_assert_int_eq(icc_map_jacobian(map, N_POINTS, points, jacobians, NULL, &n_failed, NULL),
                     ICC_OK);
    ck_assert_uint_eq(n_failed, 0);
    for (size_t i = 0; i < dim * N_POINTS; ++i) {
        ck_assert_double_eq_tol(back[i], points[i], 1e-12);
        near[i] = points[i] + (i % dim == 0 ? 1e-6 : 0);
    }
    ck_assert_int_eq(icc_map_apply(map, N_POINTS, near, back, NULL, &n_failed, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 0);
    for (size_t i = 0; i < N_POINTS; ++i) {
        ck_assert_double_gt(determinant(info.dim, jacobians + dim * dim * i), 0);
        for (size_t k = 0; k < dim; ++k)
            ck_assert_double_eq_tol((back[dim * i + k] - mapped[dim * i + k]) / 1e-6,
                                    jacobians[dim * dim * i + dim * k], 1e-7);
    }
}

/* Points of a facet go to the same place of the target's. */
static void check_boundary(const icc_map *map, const shape *s, const icc_domain *target)
{
    const size_t dim = (size_t)s->dim;
    double *vertices = saved_alloc(dim * s->n_vertices * sizeof *vertices);
    ck_assert_int_eq(icc_domain_get_boundary(target, vertices, NULL), ICC_OK);
    for (size_t f = 0; f < s->n_facets; f += 1 + s->n_facets / 10) {
        double point[MAX] = {0}, image[MAX], expected[MAX] = {0};
        for (size_t i = 0; i < dim; ++i)
            for (size_t k = 0; k < dim; ++k) {
                const uint32_t v = s->facets[dim * f + i];
                point[k] += s->vertices[dim * v + k] / (double)dim;
                expected[k] += vertices[dim * v + k] / (double)dim;
            }
        ck_assert_int_eq(icc_map_apply(map, 1, point, image, NULL, NULL, NULL), ICC_OK);
        for (size_t k = 0; k < dim; ++k)
            ck_assert_double_eq_tol(image[k], expected[k], 1e-12);
    }
    free(vertices);
}

/* The work is that of a few sweeps over a few simplices for each facet. */
static void check_work(const icc_map *map, const shape *s)
{
    const icc_map_info info = info_of_map(map);
    const icc_map_report report = report_of(map);
    ck_assert_uint_le(info.n_simplices, 4 * s->n_facets);
    ck_assert_uint_le(report.n_iterations, 60);
    ck_assert_uint_eq(report.n_unrepaired, 0);
}

START_TEST(certified_from_the_boundary_alone)
{
    static shape s;
    make_shape(&s, _i / N_TARGETS);
    const int to = _i % N_TARGETS;
    icc_domain *source = source_of(&s), *target = target_of(&s, to);
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, source, target, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    const icc_map_info info = info_of_map(map);
    ck_assert_int_eq(info.kind, ICC_MAP_MESH);
    ck_assert_int_eq(info.certified, 1);
    ck_assert_int_eq(info.reason, ICC_REASON_NONE);
    ck_assert_double_ge(info.energy, 2 * s.dim - 1e-12);
    ck_assert(to != ITSELF || info.energy < 2 * s.dim + 1e-9);
    ck_assert_ptr_null(icc_map_source_chart(map));
    check_mesh(map, source);
    check_points(map);
    check_boundary(map, &s, target);
    check_work(map, &s);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* An affine boundary moves the inside affinely. */
START_TEST(affine_inside)
{
    static shape s;
    make_shape(&s, _i);
    icc_domain *source = source_of(&s), *target = target_of(&s, SHEARED);
    icc_map *map;
    double points[N_POINTS * MAX], mapped[N_POINTS * MAX], expected[MAX];
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    spread(map, points);
    ck_assert_int_eq(icc_map_apply(map, N_POINTS, points, mapped, NULL, NULL, NULL), ICC_OK);
    for (size_t i = 0; i < N_POINTS; ++i) {
        move_point(&s, SHEARED, points + (size_t)s.dim * i, expected);
        for (size_t k = 0; k < (size_t)s.dim; ++k)
            ck_assert_double_eq_tol(mapped[(size_t)s.dim * i + k], expected[k], 1e-12);
    }
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* The inverse of a mask's map needs no mask in the source. */
START_TEST(mask_as_the_target)
{
    static shape s;
    make_shape(&s, _i);
    icc_domain *mask = source_of(&s), *bent = target_of(&s, BENT);
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, bent, mask, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_MESH);
    ck_assert_int_eq(info_of_map(map).certified, 1);
    check_mesh(map, bent);
    check_points(map);
    icc_map_free(map);
    icc_domain_free(mask);
    icc_domain_free(bent);
}
END_TEST

/* Turned so far that no point sees all of it, even though the source is a cube. Neither the cells of
 * the mask nor a cone have room, but a cone with a collar does. */
START_TEST(collars)
{
    static shape s;
    memset(&s, 0, sizeof s);
    make_mask(&s, 4, (size_t[4]){1, 1, 1, 1}, NULL);
    icc_domain *source = source_of(&s), *target;
    static shape turned;
    turned = s;
    for (size_t v = 0; v < s.n_vertices; ++v) {
        double *x = turned.vertices + 4 * v;
        const double c = cos(1.6 * x[2]), d = sin(1.6 * x[2]), a = x[0] - 0.5, b = x[1] - 0.5;
        x[0] = c * a - d * b;
        x[1] = d * a + c * b;
    }
    ck_assert_int_eq(icc_domain_create(&target, 4, turned.n_vertices, turned.vertices,
                                       turned.n_facets, turned.facets, NULL, NULL),
                     ICC_OK);
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, source, target, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    const icc_map_info info = info_of_map(map);
    ck_assert_int_eq(info.kind, ICC_MAP_MESH);
    ck_assert_int_eq(info.certified, 1);
    ck_assert_uint_eq(info.n_simplices, 5 * s.n_facets);
    ck_assert_uint_eq(info.n_vertices, 2 * s.n_vertices + 1);
    check_mesh(map, source);
    check_points(map);
    check_boundary(map, &s, target);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* Improving never raises the energy, and lowers it where little was done before. */
START_TEST(improved)
{
    static shape s;
    make_shape(&s, _i);
    icc_domain *source = source_of(&s), *target = target_of(&s, BENT_MUCH);
    const icc_map_options none = {.size = sizeof none, .iterations = -1};
    icc_improve_report report = {.size = sizeof report};
    icc_map *map, *better;
    ck_assert_int_eq(icc_map_create(&map, source, target, &none, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_improve(&better, map, NULL, &report, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(better).certified, 1);
    ck_assert_double_lt(report.energy, report.energy_start);
    ck_assert_double_eq(report.energy_start, info_of_map(map).energy);
    ck_assert_double_eq(report.energy, info_of_map(better).energy);
    ck_assert_int_eq(report.n_levels, 0);
    check_mesh(better, source);
    check_points(better);
    icc_map_free(map);
    icc_map_free(better);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

START_TEST(retargeted_saved_and_loaded)
{
    static shape s;
    make_shape(&s, _i);
    icc_domain *source = source_of(&s), *target = target_of(&s, BENT),
               *next = target_of(&s, BENT_MUCH);
    icc_map *map, *moved, *loaded;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_retarget(&moved, map, next, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(moved).certified, 1);
    check_points(moved);
    check_boundary(moved, &s, next);
    bytes first = map_bytes(moved);
    ck_assert_int_eq(icc_map_load(&loaded, first.n, first.data, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(loaded).certified, 1);
    bytes again = map_bytes(loaded);
    ck_assert_uint_eq(first.n, again.n);
    ck_assert_mem_eq(first.data, again.data, first.n);
    check_points(loaded);
    free(first.data);
    free(again.data);
    icc_map_free(map);
    icc_map_free(moved);
    icc_map_free(loaded);
    icc_domain_free(source);
    icc_domain_free(target);
    icc_domain_free(next);
}
END_TEST

/* ---- without a mesh map ---- */

/* The U without its mask: no point sees all of it. Kind 0 gives a curve map, kind mesh an error. */
START_TEST(none_is_found)
{
    static shape s;
    memset(&s, 0, sizeof s);
    make_mask(&s, 4, (size_t[4]){3, 2, 1, 1}, is_in_u);
    s.cells[0] = 0;
    icc_domain *source = source_of(&s);
    icc_map_options options = {.size = sizeof options, .kind = ICC_MAP_MESH};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, source, &options, NULL, &err),
                     ICC_ERR_CERTIFICATE);
    ck_assert_ptr_nonnull(strstr(err.message, "simplices stay inverted"));
    const icc_chart_options coarse = {.size = sizeof coarse, .cells = 4};
    options.kind = 0;
    options.chart = &coarse;
    ck_assert_int_eq(icc_map_create(&map, source, source, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_CURVES);
    ck_assert_uint_gt(report_of(map).n_unrepaired, 0);
    icc_map_free(map);
    icc_domain_free(source);
}
END_TEST

/* A method is a wish for charts, and so for a curve map. */
START_TEST(charts_on_request)
{
    static shape s;
    make_shape(&s, BOX_1);
    icc_domain *source = source_of(&s);
    const icc_chart_options field = {.size = sizeof field, .method = ICC_METHOD_FIELD};
    icc_map_options options = {.size = sizeof options, .chart = &field};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, source, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_CURVES);
    ck_assert_ptr_nonnull(icc_map_source_chart(map));
    icc_map_free(map);
    options.kind = ICC_MAP_MESH;
    ck_assert_int_eq(icc_map_create(&map, source, source, &options, NULL, NULL),
                     ICC_ERR_UNSUPPORTED);
    options.chart = NULL;
    options.kind = ICC_MAP_CURVES;
    ck_assert_int_eq(icc_map_create(&map, source, source, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_CURVES);
    icc_map_free(map);
    icc_domain_free(source);
}
END_TEST

/* ---- the kernel ---- */

/* The point of the kernel sees all facets of the simplex, whose insphere it finds nearly: with
 * distances from its walls of at least half the inradius. */
START_TEST(kernel_of_a_simplex)
{
    static shape s;
    make_shape(&s, SIMPLEX);
    icc_domain *domain = source_of(&s);
    const double inradius = 1 / (4 + sqrt(4));
    const iccp_env env = default_env();
    double local[4], point[4], sum = 0;
    ck_assert_int_eq(iccp_kernel_point(domain, local, &env), ICC_OK);
    iccp_frame_out(&domain->frame, 4, local, point);
    for (int k = 0; k < 4; ++k) {
        ck_assert_double_gt(point[k], inradius / 2);
        sum += point[k];
    }
    ck_assert_double_gt((1 - sum) / 2, inradius / 2);
    icc_domain_free(domain);
}
END_TEST

/* ---- failures ---- */

typedef struct pair {
    icc_domain *source, *target;
} pair;

static icc_status create_and_improve(const icc_env *env, icc_error *err, void *argument)
{
    const pair *p = argument;
    icc_map *map, *better = NULL;
    icc_status status = icc_map_create(&map, p->source, p->target, NULL, env, err);
    if (status != ICC_OK)
        return status;
    status = icc_map_retarget(&better, map, p->source, NULL, env, err);
    icc_map_free(better);
    icc_map_free(map);
    return status;
}

START_TEST(every_allocation_may_fail)
{
    static const int SOME[] = {SIMPLEX, BOX_1};
    static shape s;
    make_shape(&s, SOME[_i]);
    pair p = {source_of(&s), target_of(&s, BENT)};
    faulty_sweep(create_and_improve, &p);
    icc_domain_free(p.source);
    icc_domain_free(p.target);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("maps beyond three dimensions");
    TCase *tests = tcase_create("all");
    tcase_add_loop_test(tests, certified_from_the_boundary_alone, 0, N_SHAPES * N_TARGETS);
    tcase_add_loop_test(tests, affine_inside, 0, N_SHAPES);
    tcase_add_loop_test(tests, mask_as_the_target, BOX_1, N_SHAPES);
    tcase_add_test(tests, collars);
    tcase_add_loop_test(tests, improved, BOX_1, N_SHAPES);
    tcase_add_loop_test(tests, retargeted_saved_and_loaded, 0, N_SHAPES);
    tcase_add_test(tests, none_is_found);
    tcase_add_test(tests, charts_on_request);
    tcase_add_test(tests, kernel_of_a_simplex);
    tcase_add_loop_test(tests, every_allocation_may_fail, 0, 2);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
