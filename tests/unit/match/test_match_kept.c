/* Surfaces that are matched while the source keeps its vertices and edges. */
#include <icc/icc.h>

#include "../../faulty.h"
#include "../../suite.h"
#include "../../surface_domains.h"
#include "../../surfaces.h"

#include <check.h>
#include <stdbool.h>

/* Distances that are nothing but rounding. */
static const double rounding = 1e-14;

static surface one, two;

/* Landmarks: vertices k of both. */
static icc_status match_both(icc_match **match, double tolerance, size_t n_landmarks,
                             const icc_env *env, icc_error *err)
{
    icc_domain *source = domain_of_surface(&one), *target = domain_of_surface(&two);
    const icc_match_options options = {
        .size = sizeof options, .tolerance = tolerance, .keep_source = 1};
    double landmarks[6 * 12];
    for (size_t k = 0; k < n_landmarks; ++k) {
        memcpy(landmarks + 6 * k, one.vertices + 3 * k, 3 * sizeof *landmarks);
        memcpy(landmarks + 6 * k + 3, two.vertices + 3 * k, 3 * sizeof *landmarks);
    }
    const icc_status status =
        icc_match_create(match, source, target, n_landmarks, landmarks, &options, env, err);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

/* The boundary of one side. */
static surface *common_of(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    surface *const s = malloc(sizeof *s);
    ck_assert_ptr_nonnull(s);
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert(info.n_vertices <= SURFACE_VERTICES && info.n_facets <= SURFACE_FACES);
    s->n_vertices = info.n_vertices;
    s->n_faces = info.n_facets;
    ck_assert_int_eq(icc_domain_get_boundary(domain, s->vertices, s->faces), ICC_OK);
    return s;
}

/* A neighbour of v on the way from there straight to b; or v. */
static uint32_t step(const surface *s, uint32_t v, uint32_t b)
{
    const double *const p = s->vertices + 3 * (size_t)v, *const q = s->vertices + 3 * (size_t)b;
    uint32_t next = v;
    for (size_t h = 0; h < 3 * s->n_faces; ++h) {
        const uint32_t w = s->faces[h % 3 == 2 ? h - 2 : h + 1];
        double along = 0, off = 0, length = 0;
        if (s->faces[h] != v)
            continue;
        for (size_t k = 0; k < 3; ++k) {
            along += (s->vertices[3 * (size_t)w + k] - p[k]) * (q[k] - p[k]);
            length += (q[k] - p[k]) * (q[k] - p[k]);
        }
        for (size_t k = 0; k < 3; ++k)
            off += pow(p[k] + along / length * (q[k] - p[k]) - s->vertices[3 * (size_t)w + k], 2);
        if (along > 0 && along <= length * (1 + rounding) && sqrt(off) < rounding)
            next = w;
    }
    return next;
}

/* The source's vertices come first, bit by bit, and a way along common edges is on each of its. */
static void check_source(const icc_match *match)
{
    surface *const s = common_of(icc_match_source(match));
    uint32_t *const origin = malloc(s->n_vertices * sizeof *origin);
    ck_assert_ptr_nonnull(origin);
    ck_assert_int_eq(icc_match_get_origins(match, origin, NULL), ICC_OK);
    ck_assert_mem_eq(s->vertices, one.vertices, 3 * one.n_vertices * sizeof *s->vertices);
    for (uint32_t v = 0; v < s->n_vertices; ++v)
        ck_assert_uint_eq(origin[v], v < one.n_vertices ? v : UINT32_MAX);
    for (size_t h = 0; h < 3 * one.n_faces; ++h) {
        const uint32_t end = one.faces[h % 3 == 2 ? h - 2 : h + 1];
        uint32_t v = one.faces[h];
        for (uint32_t before = UINT32_MAX; v != end && v != before;) {
            before = v;
            v = step(s, v, end);
        }
        ck_assert_msg(v == end, "the edge from %u to %u is not there", one.faces[h], end);
    }
    free(origin);
    free(s);
}

/* Points of one surface are at most so far from the other; places by both: vertices and middles. */
static void check_off(const surface *from, const surface *to, double most)
{
    const size_t n = from->n_vertices, n_all = n + from->n_faces;
    icc_domain *const domain = domain_of_surface(to);
    double *const p = malloc(3 * n_all * sizeof *p), *const weight = malloc(3 * n_all * sizeof *p);
    uint32_t *const facet = malloc(n_all * sizeof *facet);
    int32_t *const where = malloc(n_all * sizeof *where);
    ck_assert(p != NULL && weight != NULL && facet != NULL && where != NULL);
    memcpy(p, from->vertices, 3 * n * sizeof *p);
    for (size_t f = 0; f < from->n_faces; ++f)
        for (size_t k = 0; k < 3; ++k) {
            p[3 * (n + f) + k] = 0;
            for (size_t i = 0; i < 3; ++i)
                p[3 * (n + f) + k] += from->vertices[3 * (size_t)from->faces[3 * f + i] + k] / 3;
        }
    ck_assert_int_eq(icc_domain_locate(domain, n_all, p, where, facet, weight, NULL), ICC_OK);
    for (size_t i = 0; i < n_all; ++i) {
        double off = 0;
        for (size_t k = 0; k < 3; ++k) {
            double at = -p[3 * i + k];
            for (size_t j = 0; j < 3; ++j)
                at += weight[3 * i + j] *
                      to->vertices[3 * (size_t)to->faces[3 * (size_t)facet[i] + j] + k];
            off += at * at;
        }
        ck_assert_double_le(sqrt(off), most);
    }
    free(p);
    free(weight);
    free(facet);
    free(where);
    icc_domain_free(domain);
}

static double diagonal_of(const surface *s)
{
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (size_t v = 0; v < s->n_vertices; ++v) {
            low = fmin(low, s->vertices[3 * v + k]);
            high = fmax(high, s->vertices[3 * v + k]);
        }
        sum += (high - low) * (high - low);
    }
    return sqrt(sum);
}

static icc_match_info check_match(double tolerance, size_t n_landmarks)
{
    icc_match *match = NULL;
    icc_match_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    ck_assert_msg(match_both(&match, tolerance, n_landmarks, NULL, &err) == ICC_OK, "%s",
                  err.message);
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    ck_assert_double_le(info.off, tolerance > 0 ? tolerance : tolerance < 0 ? 0 : 1e-3);
    check_source(match);
    surface *const source = common_of(icc_match_source(match));
    surface *const target = common_of(icc_match_target(match));
    const double most = info.off * diagonal_of(&two) * (1 + 1e-9) + rounding;
    check_off(source, &one, rounding);
    check_off(&one, source, rounding);
    check_off(target, &two, most);
    check_off(&two, target, most);
    for (size_t k = 0; k < n_landmarks; ++k)
        ck_assert_mem_eq(target->vertices + 3 * k, two.vertices + 3 * k, 3 * sizeof(double));
    free(source);
    free(target);
    icc_match_free(match);
    return info;
}

static void ellipsoid(surface *s, int splits, const double axis[3], double turn)
{
    surface_octahedron(s);
    for (int i = 0; i < splits; ++i)
        surface_split(s);
    for (size_t v = 0; v < s->n_vertices; ++v) {
        double *const p = s->vertices + 3 * v;
        const double r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), x = p[0], y = p[1];
        p[0] = axis[0] * (cos(turn) * x - sin(turn) * y) / r;
        p[1] = axis[1] * (sin(turn) * x + cos(turn) * y) / r;
        p[2] *= axis[2] / r;
    }
}

START_TEST(vertices_are_added_where_the_target_needs_them)
{
    static const double axes[3] = {1, .7, .5}, others[3] = {2.1, 1.5, 1.2};
    size_t before = 0;
    ellipsoid(&one, 3, axes, 0);
    ellipsoid(&two, 3, others, .4);
    for (int k = 0; k < 4; ++k) {
        static const double tolerance[] = {.05, 0, 1e-5, -1};
        const icc_match_info info = check_match(tolerance[k], 0);
        ck_assert_uint_gt(info.n_vertices, before);
        ck_assert_double_lt(info.energy, 4.2);
        if (k == 0)
            ck_assert_uint_eq(info.n_vertices, one.n_vertices);
        if (k == 3)
            ck_assert_uint_eq(info.n_vertices, info.n_overlay);
        before = info.n_vertices;
    }
}
END_TEST

/* Edges of the target that are creases pass close to vertices of the source. */
START_TEST(creases_do_not_take_thin_triangles)
{
    for (int splits = 1; splits < 4; ++splits) {
        surface_octahedron(&one);
        for (int i = 0; i < splits; ++i)
            surface_split(&one);
        surface_octahedron(&two);
        for (size_t v = 0; v < two.n_vertices; ++v) {
            double *const p = two.vertices + 3 * v, x = p[0], y = p[1];
            p[0] = 1.2 * (cos(.3) * x - sin(.3) * y);
            p[1] = sin(.3) * x + cos(.3) * y;
        }
        const icc_match_info info = check_match(0, 0);
        ck_assert_double_gt(info.least_angle, .3);
        ck_assert_uint_lt(2 * info.n_vertices, 3 * one.n_vertices);
    }
}
END_TEST

START_TEST(landmarks_stay)
{
    random_source r = {5};
    for (int trial = 0; trial < share_of(3); ++trial) {
        const size_t n = 1 + (size_t)random_below(&r, 12);
        surface_star(&one, 2, .2, &r);
        surface_star(&two, 2 + trial % 2, .2, &r);
        ck_assert_uint_eq(check_match(0, n).n_landmarks, n);
    }
}
END_TEST

START_TEST(equal_surfaces_stay)
{
    random_source r = {3};
    for (int trial = 0; trial < 4; ++trial) {
        surface_star(&one, 2, .5, &r);
        two = one;
        const icc_match_info info = check_match(0, trial % 2 == 0 ? 0 : 4);
        ck_assert_uint_eq(info.n_vertices, one.n_vertices);
        ck_assert_double_lt(info.energy, 4.01);
    }
}
END_TEST

/* It is not of the plane, where it is always so. */
START_TEST(only_0_and_1_are_options)
{
    static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1},
                        more[] = {0, 0, 2, 0, 3, 1, 0, 3, 0, 1};
    icc_match_options options = {.size = sizeof options, .keep_source = 2};
    icc_domain *domain[2] = {NULL, NULL};
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create(&domain[0], 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&domain[1], 2, 5, more, 0, NULL, NULL, NULL), ICC_OK);
    for (int k = 0; k < 2; ++k) {
        ck_assert_int_eq(
            icc_match_create(&match, domain[0], domain[1], 0, NULL, &options, NULL, &err),
            ICC_ERR_ARGUMENT);
        ck_assert_ptr_nonnull(strstr(err.message, "keep_source"));
        options.keep_source = -1;
    }
    options.keep_source = 1;
    options.least_sure = 1;
    ck_assert_int_eq(icc_match_create(&match, domain[0], domain[1], 0, NULL, &options, NULL, &err),
                     ICC_OK);
    icc_match_free(match);
    icc_domain_free(domain[0]);
    icc_domain_free(domain[1]);
}
END_TEST

static icc_status match_once(const icc_env *env, icc_error *err, void *argument)
{
    icc_match *match = NULL;
    const icc_status status = match_both(&match, 0, *(const size_t *)argument, env, err);
    ck_assert((status == ICC_OK) == (match != NULL));
    icc_match_free(match);
    return status;
}

START_TEST(fails_cleanly)
{
    static const double axes[3] = {1, .7, .5};
    ellipsoid(&one, 0, axes, 0);
    ellipsoid(&two, 1, axes, .4);
    faulty_sweep(match_once, &(size_t){0});
    ellipsoid(&two, 0, axes, .4);
    faulty_sweep(match_once, &(size_t){2});
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("match_kept");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 600);
    tcase_add_test(tests, vertices_are_added_where_the_target_needs_them);
    tcase_add_test(tests, creases_do_not_take_thin_triangles);
    tcase_add_test(tests, landmarks_stay);
    tcase_add_test(tests, equal_surfaces_stay);
    tcase_add_test(tests, only_0_and_1_are_options);
    tcase_add_test(tests, fails_cleanly);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
