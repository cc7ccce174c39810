/* A start for the mesh map without charts, between any two polygons. */
#include "base/error.h"
#include "map/compatible/overlay_start.h"
#include "map/plane/plane_certificate.h"

#include "../../../domains.h"
#include "../../../faulty.h"
#include "../../../plmaps.h"
#include "../../../suite.h"

/* For odd seeds clockwise, with the facets in another order. */
static icc_domain *domain_of(const shape *given, uint64_t seed)
{
    const shape s = seed % 2 == 1 ? shape_reversed(given) : *given;
    icc_domain *domain;
    uint32_t facets[2 * SHAPE_MAX];
    for (size_t f = 0; f < s.n; ++f) {
        const uint32_t k = (uint32_t)((f + (seed % 2) * s.n / 2) % s.n);
        facets[2 * f] = k;
        facets[2 * f + 1] = (uint32_t)((k + 1) % s.n);
    }
    ck_assert_int_eq(icc_domain_create(&domain, 2, s.n, s.xy, s.n, facets, NULL, NULL), ICC_OK);
    return domain;
}

static domain_pair pair_of(const shape *a, const shape *b, uint64_t seed)
{
    return (domain_pair){domain_of(a, seed), domain_of(b, seed)};
}

/* One-to-one, with each corner of the one cage on that of the other. */
static void check_start(const domain_pair *p, const iccp_plmap *map)
{
    const iccp_env env = default_env();
    size_t n_fixed = 0;
    ck_assert_int_eq(iccp_plmap_certify(map, &env, NULL), ICC_OK);
    check_certified(map);
    for (size_t v = 0; v < map->n_vertices; ++v) {
        const double bary[2] = {1 - map->along[v], map->along[v]};
        double point[2], image[2];
        if (!map->fixed[v])
            continue;
        ++n_fixed;
        iccp_domain_facet_point(p->source, map->facet[v], bary, point);
        iccp_domain_facet_point(p->target, map->facet[v], bary, image);
        ck_assert_mem_eq(point, map->points + 2 * v, sizeof point);
        ck_assert_mem_eq(image, map->images + 2 * v, sizeof image);
    }
    ck_assert_uint_eq(n_fixed, p->source->n_facets);
    ck_assert_double_eq_tol(area_of(map), p->target->measure, 1e-9 * p->target->measure);
}

static double check_shapes(const shape *a, const shape *b, uint64_t seed, double limit)
{
    const iccp_env env = default_env();
    domain_pair p = pair_of(a, b, seed);
    iccp_plmap map, again;
    iccp_work work = {.left = limit}, work_again = work;
    ck_assert_int_eq(iccp_overlay_start(&map, p.source, p.target, HUGE_VAL, &work, &env), ICC_OK);
    check_start(&p, &map);
    ck_assert(work.left == limit - work.spent);
    ck_assert_int_eq(iccp_overlay_start(&again, p.source, p.target, HUGE_VAL, &work_again, &env),
                     ICC_OK);
    ck_assert(is_same(&map, &again));
    iccp_plmap_free(&again);
    /* Crossings cost what they cost; steps are made with what is left. */
    iccp_work crossings = {0};
    ck_assert_int_eq(iccp_overlay_start(&again, p.source, p.target, HUGE_VAL, &crossings, &env),
                     ICC_OK);
    ck_assert_double_le(crossings.spent, 4 * (double)(p.source->n_facets * p.source->n_facets));
    ck_assert_double_ge(work.spent, crossings.spent);
    ck_assert_double_le(work.spent, fmax(limit, crossings.spent));
    iccp_plmap_free(&again);
    iccp_work capped = {.left = limit};
    ck_assert_int_eq(iccp_overlay_start(&again, p.source, p.target, 1000, &capped, &env), ICC_OK);
    ck_assert_double_le(capped.spent, crossings.spent + 1000);
    const double energy = iccp_plmap_energy(&map);
    iccp_plmap_free(&map);
    iccp_plmap_free(&again);
    domain_pair_free(&p);
    return energy;
}

START_TEST(any_two_polygons_have_a_start)
{
    for (uint64_t seed = 0; seed < 30; ++seed) {
        const size_t n = 3 + (size_t)(seed * seed % 100);
        const shape a = shape_wild(n, seed), b = shape_wild(n, seed + 1000);
        (void)check_shapes(&a, &b, seed, 1e5);
    }
}
END_TEST

/* Steps pay; without any, the start is there all the same. */
START_TEST(work_lowers_the_energy)
{
    const shape comb = shape_comb(20), round = shape_wild(82, 4);
    const double plain = check_shapes(&comb, &round, 0, 0);
    const double some = check_shapes(&comb, &round, 0, 1e4);
    const double more = check_shapes(&comb, &round, 0, 1e5);
    ck_assert(isfinite(plain));
    ck_assert_double_lt(some, plain);
    ck_assert_double_lt(more, 0.5 * plain);
}
END_TEST

/* A shape onto itself: one triangulation, nothing to move. */
START_TEST(the_same_shape_is_the_identity)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        ck_assert_double_eq_tol(check_shapes(&s, &s, (uint64_t)k, 1e5), 4, 1e-9);
    }
}
END_TEST

static icc_status start(const icc_env *env, icc_error *err, void *argument)
{
    const domain_pair *p = argument;
    iccp_env full;
    iccp_plmap map;
    iccp_work work = {.left = 2000};
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    const icc_status status =
        iccp_overlay_start(&map, p->source, p->target, HUGE_VAL, &work, &full);
    if (status == ICC_OK)
        check_start(p, &map);
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing)
{
    const shape a = shape_l(), b = shape_wild(6, 3);
    domain_pair p = pair_of(&a, &b, 0);
    faulty_sweep(start, &p);
    domain_pair_free(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("overlay start");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, any_two_polygons_have_a_start);
    tcase_add_test(tests, work_lowers_the_energy);
    tcase_add_test(tests, the_same_shape_is_the_identity);
    tcase_add_test(tests, failures_leave_nothing);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
