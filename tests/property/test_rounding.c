/* Points of a boundary, as doubles hold them, have their images there and back, wherever the shape
 * lies. */
#include "../flat_mesh.h"
#include "../meshes.h"
#include "../random.h"
#include "../shapes.h"
#include "../suite.h"
#include "../surfaces.h"

#include <check.h>
#include <icc/icc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N_SAMPLES = 300, MOST = 3 };

/* By how many units in the last place of the largest coordinate an image may be off. */
static const double ALLOWED = 64;

/* A shape of size `scale` at a place: near, far along one axis and both, as metres of a UTM zone,
 * as degrees. */
typedef struct placement {
    double scale, at[MOST];
} placement;

static const placement PLACES[] = {
    {1, {0}},
    {1, {0.7, -0.2, 100}},
    {1, {100, -50, 3}},
    {1, {1e3, 1e3, 1e3}},
    {25, {439124.5, 5812345.75, 312.25}},
    {1e-4, {13.4094, 52.5208, 0}},
    {1e-3, {-179.99, 0.001, 10}},
    {1, {-1e6, 1e-3, 1e6}},
    {3, {1e9, 0, 7}},
    {1, {-1e9, 1e9, 1e9}},
    {1e3, {1e12, -1e12, 1e12}},
    {1e-9, {1e-4, 1, 1}},
    {0x1p-1060, {0}},
};
enum { N_PLACES = sizeof PLACES / sizeof *PLACES };

/* A boundary before and after. */
typedef struct pair {
    const char *name;
    int32_t dim;
    size_t n_vertices, n_facets, n_simplices;
    double *vertices[2];
    const uint32_t *facets, *simplices; /* simplices: of both domains' meshes, or NULL */
} pair;

/* The target is stretched and moved a little. */
static pair placed(const char *name, const test_mesh *m, size_t n_facets, const uint32_t *facets,
                   const placement *p)
{
    static const double STRETCH[MOST] = {1.5, 1, 0.8};
    const size_t dim = (size_t)m->dim, n = m->n_vertices;
    pair result = {.name = name,
                   .dim = m->dim,
                   .n_vertices = n,
                   .n_facets = n_facets,
                   .facets = facets,
                   .n_simplices = m->n_simplices,
                   .simplices = m->n_simplices > 0 ? m->simplices : NULL};
    for (size_t side = 0; side < 2; ++side) {
        result.vertices[side] = malloc(n * dim * sizeof(double));
        for (size_t k = 0; k < n * dim; ++k)
            result.vertices[side][k] =
                m->vertices[k] * p->scale * (side == 0 ? 1 : STRETCH[k % dim]) + p->at[k % dim];
    }
    return result;
}

static icc_domain *domain_of(const pair *p, int side)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    const icc_status status =
        p->simplices != NULL
            ? flat_create_mesh(&domain, p->dim, p->n_vertices, p->vertices[side], p->n_simplices,
                               p->simplices, p->n_facets, p->facets, NULL, &err)
            : icc_domain_create(&domain, p->dim, p->n_vertices, p->vertices[side], p->n_facets,
                                p->facets, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s: %s", p->name, err.message);
    return domain;
}

/* Means of a facet's vertices by three formulas that differ by rounding. */
static void mean(size_t dim, const double *const *v, const double *weight, int formula,
                 double *point)
{
    for (size_t k = 0; k < dim; ++k) {
        double x = formula == 0 ? v[0][k] : 0;
        for (size_t i = 0; i < dim; ++i)
            if (formula == 0)
                x += i > 0 ? weight[i] * (v[i][k] - v[0][k]) : 0;
            else if (formula == 1)
                x += weight[i] * v[i][k];
            else
                x = x + weight[dim - 1 - i] * v[dim - 1 - i][k];
        point[k] = x;
    }
}

/* Corresponding samples of both boundaries. */
static void sample(const pair *p, random_source *r, double *before, double *after)
{
    const size_t dim = (size_t)p->dim;
    for (size_t i = 0; i < N_SAMPLES; ++i) {
        const size_t facet = (size_t)random_below(r, (int)p->n_facets);
        const double *v[2][MOST];
        double weight[MOST], left = 1;
        for (size_t k = dim; k-- > 1;) {
            weight[k] = left * random_unit(r);
            left -= weight[k];
        }
        weight[0] = 1;
        for (size_t k = 1; k < dim; ++k)
            weight[0] -= weight[k];
        weight[0] = weight[0] > 0 ? weight[0] : 0;
        for (int side = 0; side < 2; ++side)
            for (size_t k = 0; k < dim; ++k)
                v[side][k] = p->vertices[side] + dim * p->facets[dim * facet + k];
        mean(dim, v[0], weight, (int)(i % 3), before + dim * i);
        mean(dim, v[1], weight, (int)(i % 3), after + dim * i);
    }
}

static double unit_of(const pair *p)
{
    double largest = 0;
    for (int side = 0; side < 2; ++side)
        for (size_t k = 0; k < p->n_vertices * (size_t)p->dim; ++k)
            largest = fmax(largest, fabs(p->vertices[side][k]));
    return nextafter(largest, HUGE_VAL) - largest;
}

static void check_way(const pair *p, const char *what, const icc_map *map, bool inverse,
                      const double *points, const double *wanted)
{
    const size_t dim = (size_t)p->dim;
    double images[N_SAMPLES * MOST], worst = 0;
    icc_status status[N_SAMPLES];
    size_t n_failed;
    ck_assert_int_eq((inverse ? icc_map_apply_inverse : icc_map_apply)(
                         map, N_SAMPLES, points, images, status, &n_failed, NULL),
                     ICC_OK);
    ck_assert_msg(n_failed == 0, "%s, %s%s: %zu of %d have no image", p->name, what,
                  inverse ? ", back" : "", n_failed, (int)N_SAMPLES);
    for (size_t k = 0; k < dim * N_SAMPLES; ++k)
        worst = fmax(worst, fabs(images[k] - wanted[k]) / unit_of(p));
    ck_assert_msg(worst <= ALLOWED, "%s, %s%s: off by %g units in the last place", p->name, what,
                  inverse ? ", back" : "", worst);
}

static void check_pair(const pair *p, int32_t method, int32_t kind, const char *what)
{
    icc_domain *source = domain_of(p, 0), *target = domain_of(p, 1);
    const icc_chart_options chart = {
        .size = sizeof chart, .method = method, .cells = p->dim == 2 ? 16 : 8};
    const icc_map_options options = {
        .size = sizeof options, .kind = kind, .iterations = 2, .chart = &chart};
    double before[N_SAMPLES * MOST], after[N_SAMPLES * MOST];
    int32_t where[N_SAMPLES];
    random_source r = {7};
    icc_map *map;
    icc_error err = {.size = sizeof err};
    sample(p, &r, before, after);
    for (int side = 0; side < 2; ++side) {
        ck_assert_int_eq(icc_domain_locate(side == 0 ? source : target, N_SAMPLES,
                                           side == 0 ? before : after, where, NULL, NULL, NULL),
                         ICC_OK);
        for (size_t i = 0; i < N_SAMPLES; ++i)
            ck_assert_msg(where[i] == ICC_BOUNDARY, "%s: sample %zu is %d", p->name, i,
                          (int)where[i]);
    }
    const icc_status status = icc_map_create(&map, source, target, &options, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s, %s: %s", p->name, what, err.message);
    check_way(p, what, map, false, before, after);
    check_way(p, what, map, true, after, before);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}

static void pair_free(pair *p)
{
    free(p->vertices[0]);
    free(p->vertices[1]);
}

/* ---- the plane ---- */

static void check_polygon(const shape *s, const char *name)
{
    uint32_t facets[2 * SHAPE_MAX];
    test_mesh m = {.dim = 2, .n_vertices = s->n, .vertices = (double *)s->xy};
    for (uint32_t i = 0; i < s->n; ++i) {
        facets[2 * i] = i;
        facets[2 * i + 1] = (i + 1) % (uint32_t)s->n;
    }
    for (int k = 0; k < N_PLACES; ++k) {
        char what[100];
        (void)snprintf(what, sizeof what, "%s at place %d", name, k);
        pair p = placed(what, &m, s->n, facets, &PLACES[k]);
        check_pair(&p, 0, ICC_MAP_MESH, "mesh");
        check_pair(&p, ICC_METHOD_DISC, ICC_MAP_CURVES, "disc");
        check_pair(&p, ICC_METHOD_FOLIATION, ICC_MAP_CURVES, "foliation");
        check_pair(&p, ICC_METHOD_GRADIENT, 0, "gradient");
        check_pair(&p, ICC_METHOD_FIELD, 0, "field");
        pair_free(&p);
    }
}

START_TEST(sides_of_polygons)
{
    random_source r = {3};
    const shape l = shape_l(), star = shape_star(7, 0.4, 0.3);
    check_polygon(&l, "L");
    check_polygon(&star, "star");
    for (int round = 0; round < 4; ++round) {
        shape s = {.n = 4};
        for (size_t i = 0; i < s.n; ++i) {
            const double a = 1.5707963267948966 * ((double)i + 0.8 * random_unit(&r));
            const double radius = random_between(&r, 0.5, 1.5);
            s.xy[2 * i] = radius * cos(a);
            s.xy[2 * i + 1] = radius * sin(a);
        }
        check_polygon(&s, "quadrilateral");
    }
}
END_TEST

/* Far away along one axis, and thin along the other: rounding along the first does not blur the
 * second. */
START_TEST(thin_and_far)
{
    const double xy[8] = {1e9, 0, 1e9 + 64, 0, 1e9 + 64, 1e-9, 1e9, 1e-9};
    const double inside[2] = {1e9 + 32, 5e-10}, above[2] = {1e9 + 32, 1.01e-9};
    icc_domain *domain;
    int32_t where;
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_locate(domain, 1, inside, &where, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(where, ICC_INSIDE);
    ck_assert_int_eq(icc_domain_locate(domain, 1, above, &where, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(where, ICC_OUTSIDE);
    icc_domain_free(domain);
}
END_TEST

/* ---- space, and meshes ---- */

static void check_mesh(const test_mesh *m, const char *name, size_t n_facets,
                       const uint32_t *facets)
{
    for (int k = 0; k < N_PLACES; ++k) {
        char what[100];
        (void)snprintf(what, sizeof what, "%s at place %d", name, k);
        pair p = placed(what, m, n_facets, facets, &PLACES[k]);
        if (p.simplices != NULL) {
            check_pair(&p, ICC_METHOD_FOLIATION, ICC_MAP_CURVES, "foliation");
            check_pair(&p, ICC_METHOD_FOLIATION, p.dim == 3 ? ICC_MAP_MESH : 0, "default kind");
        } else if (p.dim == 3 && k % 2 == 0)
            check_pair(&p, ICC_METHOD_GRADIENT, 0, "gradient");
        check_pair(&p, ICC_METHOD_FIELD, 0, "field");
        pair_free(&p);
    }
}

START_TEST(faces_of_surfaces)
{
    random_source r = {5};
    surface s;
    surface_star(&s, 1, 0.2, &r);
    const test_mesh m = {.dim = 3, .n_vertices = s.n_vertices, .vertices = s.vertices};
    check_mesh(&m, "surface", s.n_faces, s.faces);
}
END_TEST

/* Facets of a mesh: those of its domain, by the vertices of the mesh. */
START_TEST(facets_of_meshes)
{
    static const uint32_t SIDES[8] = {0, 1, 1, 2, 2, 3, 3, 0};
    static const uint32_t FACES[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    static uint32_t fan[12] = {4, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0};
    static uint32_t cells[24] = {0, 1, 3, 7, 0, 3, 2, 7, 0, 2, 6, 7,
                                 0, 6, 4, 7, 0, 4, 5, 7, 0, 5, 1, 7};
    double square[10] = {0, 0, 1.1, 0.2, 1, 1.3, -0.1, 0.9, 0.4, 0.6};
    double cube[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const test_mesh plane = {
        .dim = 2, .n_vertices = 5, .vertices = square, .n_simplices = 4, .simplices = fan};
    const test_mesh space = {
        .dim = 3, .n_vertices = 8, .vertices = cube, .n_simplices = 6, .simplices = cells};
    check_mesh(&plane, "triangles", 4, SIDES);
    check_mesh(&space, "tetrahedra", 12, FACES);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("rounding");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, sides_of_polygons);
    tcase_add_test(tests, thin_and_far);
    tcase_add_test(tests, faces_of_surfaces);
    tcase_add_test(tests, facets_of_meshes);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
