/* A boundary that is mapped affinely has the affine map inside, however the map was made. */
#include "icc/icc.h"

#include "../feature_pairs.h"
#include "../shapes.h"
#include "../suite.h"
#include "../surfaces.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

enum { N_SAMPLES = 200, N_AFFINE = 7 };

/* Of the target's size. */
static const double NEAR = 1e-12;

/* Row by row, then the shift. */
static const double PLANE[N_AFFINE][6] = {
    {1, 0, 0, 1, 0, 0},          {2, 0, 0, 2, 7, -3},     {1, .25, 0, 1, 0, 0},
    {2, 0, 0, 1, 0, 0},          {.8, -.6, .6, .8, 1, 2}, {40, 3, 0, 1, 1e3, 1e4},
    {.9, -.2, .3, 1.1, -1e2, 5},
};
static const double SPACE[N_AFFINE][12] = {
    {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},           {2, 0, 0, 0, 2, 0, 0, 0, 2, 5, -7, 1},
    {1, .3, 0, 0, 1, .2, 0, 0, 1, 0, 0, 0},         {3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
    {.8, -.6, 0, .6, .8, 0, 0, 0, 1, 1, 2, 3},      {20, 1, 0, 0, 1, .5, 0, .3, 1, 1e2, 0, 0},
    {1, .2, -.1, .3, .8, 0, -.2, .1, 1.3, 0, 0, 9},
};

static void carry(int32_t dim, const double *affine, size_t n, const double *x, double *y)
{
    for (size_t i = 0; i < n; ++i)
        for (int32_t r = 0; r < dim; ++r) {
            y[(size_t)dim * i + (size_t)r] = affine[dim * dim + r];
            for (int32_t c = 0; c < dim; ++c)
                y[(size_t)dim * i + (size_t)r] +=
                    affine[dim * r + c] * x[(size_t)dim * i + (size_t)c];
        }
}

/* Points inside go where the affine map takes them, and come back. */
static void expect_affine(const icc_map *map, const icc_domain *source, const double *affine)
{
    icc_domain_info info = {.size = sizeof info};
    double x[3 * N_SAMPLES], y[3 * N_SAMPLES], z[3 * N_SAMPLES], back[3 * N_SAMPLES];
    icc_status status[N_SAMPLES];
    int32_t where[N_SAMPLES];
    random_source random = {1};
    ck_assert_int_eq(icc_domain_get_info(source, &info), ICC_OK);
    const int32_t dim = info.dim;
    double size = 0, source_size = 0;
    for (int k = 0; k < N_SAMPLES * dim; ++k)
        x[k] = info.lower[k % dim] +
               random_unit(&random) * (info.upper[k % dim] - info.lower[k % dim]);
    for (int32_t r = 0; r < dim; ++r) {
        double length = 0;
        for (int32_t c = 0; c < dim; ++c)
            length += fabs(affine[dim * r + c]) * (info.upper[c] - info.lower[c]);
        size = length > size ? length : size;
        const double own = info.upper[r] - info.lower[r];
        source_size = own > source_size ? own : source_size;
    }
    ck_assert_int_eq(icc_domain_locate(source, N_SAMPLES, x, where, NULL, NULL, NULL), ICC_OK);
    carry(dim, affine, N_SAMPLES, x, z);
    ck_assert_int_eq(icc_map_apply(map, N_SAMPLES, x, y, status, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_apply_inverse(map, N_SAMPLES, y, back, NULL, NULL, NULL), ICC_OK);
    int n_inside = 0;
    for (int i = 0; i < N_SAMPLES; ++i) {
        if (where[i] != ICC_INSIDE)
            continue;
        ++n_inside;
        ck_assert_int_eq(status[i], ICC_OK);
        for (int k = dim * i; k < dim * (i + 1); ++k) {
            ck_assert_double_le(fabs(y[k] - z[k]), NEAR * size);
            ck_assert_double_le(fabs(back[k] - x[k]), 1e-9 * source_size);
        }
    }
    ck_assert_int_gt(n_inside, N_SAMPLES / 20);
}

/* Vertices go to their partners bit by bit. */
static void expect_partners(const icc_map *map, size_t n, int32_t dim, const double *from,
                            const double *to)
{
    for (size_t i = 0; i < n; ++i) {
        double y[3];
        ck_assert_int_eq(icc_map_apply(map, 1, from + (size_t)dim * i, y, NULL, NULL, NULL),
                         ICC_OK);
        for (int32_t k = 0; k < dim; ++k)
            ck_assert(y[k] == to[dim * (int32_t)i + k]);
    }
}

static icc_domain *domain_of(const icc_domain *source, const double *affine)
{
    icc_domain_info info = {.size = sizeof info};
    icc_domain *out;
    ck_assert_int_eq(icc_domain_get_info(source, &info), ICC_OK);
    const size_t dim = (size_t)info.dim;
    double *x = calloc(2 * dim * info.n_vertices, sizeof *x), *y = x + dim * info.n_vertices;
    uint32_t *facets = calloc(dim * info.n_facets, sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(source, x, facets), ICC_OK);
    carry(info.dim, affine, info.n_vertices, x, y);
    ck_assert_int_eq(
        icc_domain_create(&out, info.dim, info.n_vertices, y, info.n_facets, facets, NULL, NULL),
        ICC_OK);
    free(x);
    free(facets);
    return out;
}

static icc_map *map_of(const icc_domain *source, const icc_domain *target)
{
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    return map;
}

/* Made, made better, and followed from one affine map to the next and to itself. */
static void try_domain(const icc_domain *source, const double *affine, const double *next)
{
    icc_domain *target = domain_of(source, affine), *other = domain_of(source, next);
    icc_map *map = map_of(source, target), *better, *moved;
    expect_affine(map, source, affine);
    ck_assert_int_eq(icc_map_improve(&better, map, NULL, NULL, NULL, NULL), ICC_OK);
    expect_affine(better, source, affine);
    ck_assert_int_eq(icc_map_retarget(&moved, map, other, NULL, NULL, NULL), ICC_OK);
    expect_affine(moved, source, next);
    icc_map_free(map);
    icc_map_free(better);
    icc_map_free(moved);
    icc_domain_free(target);
    icc_domain_free(other);
}

START_TEST(polygons)
{
    for (int k = 0; k < 8; ++k) {
        const shape s = shape_number(k);
        icc_domain *source;
        ck_assert_int_eq(icc_domain_create(&source, 2, s.n, s.xy, 0, NULL, NULL, NULL), ICC_OK);
        for (int a = 0; a < N_AFFINE; ++a)
            try_domain(source, PLANE[a], PLANE[(a + 1) % N_AFFINE]);
        icc_domain_free(source);
    }
}
END_TEST

/* The sheet of a survey: at an offset of 1e6 sizes, with a rounded target. */
START_TEST(far_away)
{
    const double sheet[8] = {2.6e6,     1.2e6,     2.6e6 + 4, 1.2e6,
                             2.6e6 + 4, 1.2e6 + 3, 2.6e6,     1.2e6 + 3};
    const double x[2] = {2.6e6 + 1.25, 1.2e6 + 2.5};
    double target[8], y[2], z[2];
    for (int a = 0; a < N_AFFINE; ++a) {
        icc_map *map;
        carry(2, PLANE[a], 4, sheet, target);
        carry(2, PLANE[a], 1, x, z);
        ck_assert_int_eq(icc_map_create_polygons(&map, 4, sheet, target, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_apply(map, 1, x, y, NULL, NULL, NULL), ICC_OK);
        for (int k = 0; k < 2; ++k)
            ck_assert_double_le(fabs(y[k] - z[k]), 1e-15 * fabs(z[k]) + 1e-9);
        expect_partners(map, 4, 2, sheet, target);
        icc_map_free(map);
    }
}
END_TEST

START_TEST(bodies)
{
    static surface s;
    random_source random = {4};
    for (int k = 0; k < 3; ++k) {
        icc_domain *source;
        surface_star(&s, k, k == 0 ? 0 : 0.2, &random);
        ck_assert_int_eq(
            icc_domain_create(&source, 3, s.n_vertices, s.vertices, s.n_faces, s.faces, NULL, NULL),
            ICC_OK);
        for (int a = 0; a < N_AFFINE; ++a)
            try_domain(source, SPACE[a], SPACE[(a + 1) % N_AFFINE]);
        icc_domain_free(source);
    }
}
END_TEST

static plan plan_carried(const plan *p, const double *affine)
{
    plan moved = *p;
    carry(2, affine, p->n_vertices, p->xy, moved.xy);
    return moved;
}

START_TEST(features)
{
    plan source = plan_square(10);
    plan_hole(&source, 5, 3, 3, 1, 0.3);
    plan_hole(&source, 7, 7, 6, 1.5, 0.1);
    plan_feature(&source, ICC_FEATURE_LINE, 3, (double[]){1, 8, 3, 7, 4, 9});
    plan_point(&source, 8, 2);
    icc_domain *from = plan_domain(&source);
    for (int a = 0; a < N_AFFINE; ++a) {
        const plan target = plan_carried(&source, PLANE[a]);
        const plan other = plan_carried(&source, PLANE[(a + 1) % N_AFFINE]);
        icc_domain *to = plan_domain(&target), *next = plan_domain(&other);
        icc_map *map = map_of(from, to), *moved;
        expect_affine(map, from, PLANE[a]);
        expect_partners(map, source.n_vertices, 2, source.xy, target.xy);
        if (icc_map_retarget(&moved, map, next, NULL, NULL, NULL) == ICC_OK) {
            expect_affine(moved, from, PLANE[(a + 1) % N_AFFINE]);
            icc_map_free(moved);
        }
        icc_map_free(map);
        icc_domain_free(to);
        icc_domain_free(next);
    }
    icc_domain_free(from);
}
END_TEST

/* A tie that goes once round a hole asks for another class: the affine map, which would have less
 * energy, must not take its place. */
START_TEST(ties_are_kept)
{
    plan p = plan_square(10);
    plan_hole(&p, 6, 5, 5, 1, 3.9269908169872414);
    icc_domain *domain = plan_domain(&p);
    const double bends[] = {8, 2, 8, 8, 2, 8, 2, 5};
    const icc_tie tie = {.size = sizeof tie, .vertex = {0, 4}, .n_target = 4, .target = bends};
    const icc_map_options options = {.size = sizeof options, .n_ties = 1, .ties = &tie};
    icc_map *map, *better;
    ck_assert_int_eq(icc_map_create(&map, domain, domain, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_improve(&better, map, NULL, NULL, NULL, NULL), ICC_OK);
    const icc_map *const maps[2] = {map, better};
    for (int k = 0; k < 2; ++k) {
        icc_map_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_map_get_info(maps[k], &info), ICC_OK);
        ck_assert_int_eq(info.class_kept, 1);
        ck_assert_double_gt(info.energy, 5);
    }
    icc_map_free(map);
    icc_map_free(better);
    icc_domain_free(domain);
}
END_TEST

/* What was bent on purpose, however little, is not taken for rounding. */
START_TEST(nearly_affine)
{
    const double square[8] = {0, 0, 4, 0, 4, 3, 0, 3}, x[2] = {2, 1.5};
    double bent[8], y[2];
    icc_map *map;
    memcpy(bent, square, sizeof bent);
    bent[4] += 1e-3;
    ck_assert_int_eq(icc_map_create_polygons(&map, 4, square, bent, NULL, NULL), ICC_OK);
    expect_partners(map, 4, 2, square, bent);
    ck_assert_int_eq(icc_map_apply(map, 1, x, y, NULL, NULL, NULL), ICC_OK);
    ck_assert_double_gt(y[0], x[0] + 1e-4);
    icc_map_free(map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("affine");
    TCase *tests = tcase_create("affine");
    tcase_set_timeout(tests, 600);
    tcase_add_test(tests, polygons);
    tcase_add_test(tests, far_away);
    tcase_add_test(tests, bodies);
    tcase_add_test(tests, features);
    tcase_add_test(tests, ties_are_kept);
    tcase_add_test(tests, nearly_affine);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
