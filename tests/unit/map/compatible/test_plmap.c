/* Piecewise linear maps: refining, untangling and improving them. */
#include "base/error.h"
#include "map/compatible/improve.h"
#include "map/energy/newton.h"
#include "map/plane/plane_certificate.h"

#include "../../../faulty.h"
#include "../../../plmaps.h"

static icc_status improve(iccp_plmap *map, size_t iterations, double tolerance, size_t levels,
                          iccp_improvement *improvement, const iccp_env *env)
{
    const iccp_schedule schedule = {iterations, tolerance, levels, HUGE_VAL, false, false};
    iccp_work work = iccp_work_unlimited();
    return iccp_improve(map, iccp_plmap_energy(map), &schedule, &work, improvement, env);
}

/* The image of a point, through any triangle that holds it. */
static bool image_of(const iccp_plmap *map, const double p[2], double image[2])
{
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; c += 3) {
        const double *a = iccp_plmap_point(map, c), *b = iccp_plmap_point(map, c + 1);
        const double *d = iccp_plmap_point(map, c + 2);
        const double all = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
        const double s = ((p[0] - a[0]) * (d[1] - a[1]) - (p[1] - a[1]) * (d[0] - a[0])) / all;
        const double t = ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / all;
        if (s < 0 || t < 0 || s + t > 1)
            continue;
        for (int i = 0; i < 2; ++i)
            image[i] = (1 - s - t) * iccp_plmap_image(map, c)[i] +
                       s * iccp_plmap_image(map, c + 1)[i] + t * iccp_plmap_image(map, c + 2)[i];
        return true;
    }
    return false;
}

/* ---- cutting ---- */

START_TEST(cuts_change_the_mesh_and_not_the_map)
{
    enum { N = 300 };
    const shape s = shape_l();
    iccp_plmap map = map_of(&s, 8, wave, 0.7);
    random_source r = {1};
    double points[2 * N], before[2 * N];
    const double energy = iccp_plmap_energy(&map), area = area_of(&map);
    for (int i = 0; i < N; ++i)
        do {
            points[2 * i] = random_unit(&r);
            points[2 * i + 1] = random_unit(&r);
        } while (!image_of(&map, points + 2 * i, before + 2 * i));
    for (int k = 0; k < 3000; ++k) {
        bool done;
        const size_t n = map.n_vertices;
        const uint32_t c = (uint32_t)random_below(&r, 3 * (int)map.corners.n_triangles);
        ck_assert_int_eq(iccp_plmap_cut(&map, c, &done), ICC_OK);
        ck_assert_uint_eq(map.n_vertices, n + done);
    }
    check_mesh(&map);
    ck_assert_uint_gt(map.n_vertices, 2500);
    ck_assert_uint_eq(iccp_plmap_count_inverted(&map), 0);
    double worst = 0;
    for (int i = 0; i < N; ++i) {
        double image[2];
        ck_assert(image_of(&map, points + 2 * i, image));
        worst = fmax(worst, hypot(image[0] - before[2 * i], image[1] - before[2 * i + 1]));
    }
    ck_assert_double_le(worst, 1e-13);
    ck_assert_double_eq_tol(iccp_plmap_energy(&map) / energy, 1, 1e-12);
    ck_assert_double_eq_tol(area_of(&map) / area, 1, 1e-12);
    iccp_plmap_free(&map);
}
END_TEST

/* A new map has exactly the room that it needs, and so have cuts that are expected. */
START_TEST(expected_cuts_move_nothing)
{
    const shape s = shape_l();
    iccp_plmap map = map_of(&s, 8, wave, 0.7);
    const size_t n = map.n_vertices, n_triangles = map.corners.n_triangles, n_cuts = n / 3;
    ck_assert_uint_eq(map.vertex_room, n);
    ck_assert_uint_eq(map.triangle_room, n_triangles);
    ck_assert_int_eq(iccp_plmap_expect_cuts(&map, n_cuts), ICC_OK);
    ck_assert_uint_eq(map.vertex_room, n + n_cuts);
    ck_assert_uint_eq(map.triangle_room, n_triangles + 2 * n_cuts);
    const double *points = map.points, *images = map.images;
    const uint32_t *vertex = map.corners.vertex, *twin = map.corners.twin;
    for (uint32_t c = 0; map.n_vertices < n + n_cuts; c += 7) {
        bool done;
        ck_assert_int_eq(iccp_plmap_cut(&map, c % (uint32_t)(3 * n_triangles), &done), ICC_OK);
    }
    ck_assert(map.points == points && map.images == images);
    ck_assert(map.corners.vertex == vertex && map.corners.twin == twin);
    check_mesh(&map);
    iccp_plmap_free(&map);
}
END_TEST

/* The middle of two neighbouring doubles is one of them: no cut, and no change. */
START_TEST(edges_that_rounding_would_spoil_stay)
{
    double points[6] = {0.5, 0, 0.5 + 0x1p-53, 0, 0.75, 1}, images[6] = {0, 0, 1, 0, 0, 1};
    uint32_t triangles[3] = {0, 1, 2};
    uint32_t twins[3] = {ICCP_NO_NEIGHBOUR, ICCP_NO_NEIGHBOUR, ICCP_NO_NEIGHBOUR};
    uint32_t facets[3] = {0, 1, 2}, pieces[3] = {1, 1, 1};
    const iccp_env env = default_env();
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, 3, images, 0, NULL, NULL, NULL), ICC_OK);
    for (int swapped = 0; swapped < 2; ++swapped) {
        const iccp_planar mesh = {.n_vertices = 3,
                                  .n_boundary = 3,
                                  .n_triangles = 1,
                                  .points = swapped ? images : points,
                                  .triangles = triangles,
                                  .twins = twins,
                                  .facet = facets,
                                  .first = facets,
                                  .pieces = pieces};
        iccp_plmap map, copy;
        bool done = true;
        ck_assert_int_eq(
            iccp_plmap_create(&map, &mesh, domain, swapped ? points : images, 1, &env.memory),
            ICC_OK);
        ck_assert_int_eq(iccp_plmap_copy(&copy, &map, &env.memory), ICC_OK);
        ck_assert_int_eq(iccp_plmap_cut(&map, 2, &done), ICC_OK);
        ck_assert(!done && is_same(&map, &copy));
        ck_assert_int_eq(iccp_plmap_cut(&map, 1, &done), ICC_OK);
        ck_assert(done && !is_same(&map, &copy));
        iccp_plmap_free(&map);
        iccp_plmap_free(&copy);
    }
    icc_domain_free(domain);
}
END_TEST

START_TEST(energies_of_simple_maps)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        iccp_plmap map = map_of(&s, 12, identity, 1);
        ck_assert_double_eq_tol(iccp_plmap_energy(&map), 4, 1e-11);
        for (size_t v = 0; v < map.n_vertices; ++v)
            map.images[2 * v] *= 2;
        ck_assert_double_eq_tol(iccp_plmap_energy(&map), 4 + 1 + 1 + 0.25, 1e-11);
        /* A stretch that makes the areas alike: half the squeeze each way. */
        map.stretch = sqrt(2);
        ck_assert_double_eq_tol(iccp_plmap_energy(&map), 2 * (2 + 0.5), 1e-11);
        for (size_t v = 0; v < map.n_vertices; ++v)
            map.images[2 * v] *= -1;
        ck_assert(isinf(iccp_plmap_energy(&map)));
        ck_assert_uint_eq(iccp_plmap_count_inverted(&map), map.corners.n_triangles);
        iccp_plmap_free(&map);
    }
}
END_TEST

/* ---- Newton steps ---- */

/* Energy and slope against differences along the step. */
START_TEST(steps_go_down)
{
    const shape s = shape_star(5, 0.4, 0.1);
    const iccp_env env = default_env();
    for (int kind = ICCP_DIRICHLET; kind <= ICCP_UNTANGLE; ++kind) {
        iccp_plmap map = map_of(&s, 8, wave, 1);
        iccp_newton newton;
        double slope;
        shake(&map, 3, 0.05);
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map);
        ck_assert_int_eq(iccp_newton_create(&newton, &simplicial, NULL, NULL, &env), ICC_OK);
        ck_assert_int_eq(iccp_newton_solve(&newton, (iccp_energy)kind, 0.1, &slope, &env), ICC_OK);
        ck_assert_double_lt(slope, 0);
        double energy[2];
        for (int k = 0; k < 2; ++k) {
            for (size_t i = 0; i < 2 * newton.assembly.n_free; ++i)
                map.images[2 * (size_t)newton.assembly.free_point[i / 2] + i % 2] +=
                    (k == 0 ? -1e-6 : 2e-6) * newton.step[i];
            energy[k] = iccp_newton_energy(&newton, (iccp_energy)kind, 0.1);
        }
        ck_assert_double_eq_tol((energy[1] - energy[0]) / 2e-6 / slope, 1, 1e-4);
        iccp_newton_free(&newton);
        iccp_plmap_free(&map);
    }
}
END_TEST

/* A first Hessian that others make while the order is found is the same, and is not taken for that of
 * another energy. */
START_TEST(steps_begun_ahead_are_the_same)
{
    const shape s = shape_star(5, 0.4, 0.1);
    const iccp_env alone = default_env();
    iccp_env env = alone;
    env.threads = 2;
    for (int kind = ICCP_DIRICHLET; kind <= ICCP_DIRICHLET_MAJORISED; ++kind)
        for (int first = ICCP_DIRICHLET; first <= ICCP_DIRICHLET_MAJORISED; ++first) {
            iccp_plmap map = map_of(&s, 40, wave, 1);
            const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map);
            const iccp_energy ahead = (iccp_energy)first;
            iccp_newton newton[2];
            double slope[2][2];
            ck_assert_int_eq(iccp_newton_create(&newton[0], &simplicial, NULL, NULL, &alone),
                             ICC_OK);
            ck_assert_int_eq(iccp_newton_create(&newton[1], &simplicial, NULL, &ahead, &env),
                             ICC_OK);
            ck_assert(newton[1].is_ahead && !newton[0].is_ahead);
            for (int step = 0; step < 2; ++step)
                for (int k = 0; k < 2; ++k)
                    ck_assert_int_eq(iccp_newton_solve(&newton[k], (iccp_energy)kind, 0,
                                                       &slope[step][k], k == 0 ? &alone : &env),
                                     ICC_OK);
            const size_t n = 2 * newton[0].assembly.n_free;
            ck_assert_mem_eq(newton[0].step, newton[1].step, n * sizeof(double));
            for (int step = 0; step < 2; ++step)
                ck_assert_mem_eq(&slope[step][0], &slope[step][1], sizeof(double));
            for (int k = 0; k < 2; ++k)
                iccp_newton_free(&newton[k]);
            iccp_plmap_free(&map);
        }
}
END_TEST

/* By how many steps the images have moved. */
static double length_of(const iccp_newton *newton)
{
    double along = 0, square = 0;
    for (size_t i = 0; i < 2 * newton->assembly.n_free; ++i) {
        const size_t at = 2 * (size_t)newton->assembly.free_point[i / 2] + i % 2;
        along += newton->step[i] * (newton->map.images[at] - newton->saved[i]);
        square += newton->step[i] * newton->step[i];
    }
    return along / square;
}

/* Every accepted step lowers the energy; Dirichlet's keeps every triangle positive. Some go farther
 * than the model says. Vertices that are not movable stay. */
START_TEST(every_step_is_monotone_and_positive)
{
    const iccp_env env = default_env();
    size_t n_longer = 0;
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        iccp_plmap map = map_of(&s, 10, identity, 1), start;
        shake(&map, 5 + (uint64_t)k, 0.2);
        ck_assert_int_eq(iccp_plmap_copy(&start, &map, &env.memory), ICC_OK);
        uint8_t *movable = calloc(map.n_vertices, 1);
        ck_assert_ptr_nonnull(movable);
        for (size_t v = 0; v < map.n_vertices; ++v)
            movable[v] = v % 5 != 0;
        iccp_newton newton;
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map);
        ck_assert_int_eq(
            iccp_newton_create(&newton, &simplicial, k % 2 ? movable : NULL, NULL, &env), ICC_OK);
        double energy = iccp_newton_energy(&newton, ICCP_DIRICHLET, 0);
        for (int step = 0; step < 25 && newton.assembly.n_free > 0; ++step) {
            const iccp_energy model = step % 3 == 0 ? ICCP_DIRICHLET_MAJORISED : ICCP_DIRICHLET;
            double slope;
            ck_assert_int_eq(iccp_newton_solve(&newton, model, 0, &slope, &env), ICC_OK);
            const double after = iccp_newton_move(&newton, model, 0, energy, slope);
            ck_assert_double_le(after, energy);
            ck_assert_uint_eq(iccp_plmap_count_inverted(&map), 0);
            n_longer += length_of(&newton) > 1.5;
            energy = after;
        }
        size_t n_moved = 0;
        for (size_t v = 0; v < map.n_vertices; ++v)
            n_moved += (map.fixed[v] || (k % 2 && !movable[v])) &&
                       memcmp(map.images + 2 * v, start.images + 2 * v, 2 * sizeof(double)) != 0;
        ck_assert_uint_eq(n_moved, 0);
        if (k % 2 == 0)
            ck_assert_double_eq_tol(iccp_plmap_energy(&map), 4, 1e-6);
        iccp_newton_free(&newton);
        iccp_plmap_free(&map);
        iccp_plmap_free(&start);
        free(movable);
    }
    ck_assert_uint_gt(n_longer, 0);
}
END_TEST

/* One triangle with nearly all of the energy is cut before the first step, here without any; the same
 * with many of them, or a fair map, is left as it is. */
START_TEST(what_locks_all_others_is_cut_first)
{
    const iccp_env env = default_env();
    const shape s = shape_square();
    for (int kind = 0; kind < 3; ++kind) {
        iccp_plmap map = map_of(&s, 30, identity, 1);
        const size_t n = map.n_vertices;
        iccp_improvement improvement;
        iccp_work none = {0};
        const iccp_schedule schedule = {10, 1e-4, 5, HUGE_VAL, false, false};
        size_t n_flat = kind == 0 ? 0 : kind == 1 ? 1 : map.corners.n_triangles;
        for (uint32_t t = 0; t < map.corners.n_triangles && n_flat > 0; ++t) {
            const uint32_t *v = map.corners.vertex + 3 * (size_t)t;
            if (map.fixed[v[0]] || map.fixed[v[1]] || map.fixed[v[2]])
                continue;
            double *a = map.images + 2 * (size_t)v[0];
            const double *b = map.images + 2 * (size_t)v[1], *c = map.images + 2 * (size_t)v[2];
            for (int d = 0; d < 2; ++d)
                a[d] += 0.9999999 * ((b[d] + c[d]) / 2 - a[d]);
            --n_flat;
            t += kind == 2 ? 40 : 0;
        }
        const double before = iccp_plmap_energy(&map);
        ck_assert_uint_eq(iccp_plmap_count_inverted(&map), 0);
        ck_assert_int_eq(
            iccp_improve(&map, iccp_plmap_energy(&map), &schedule, &none, &improvement, &env),
            ICC_OK);
        check_mesh(&map);
        ck_assert_uint_eq(map.n_vertices, n + (kind == 1));
        ck_assert_double_le(iccp_plmap_energy(&map), before * (1 + 1e-9));
        ck_assert(kind == 0 ? before < 20 : before > 20);
        iccp_plmap_free(&map);
    }
}
END_TEST

/* ---- improvement ---- */

START_TEST(more_steps_are_no_worse)
{
    const iccp_env env = default_env();
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        iccp_plmap start = map_of(&s, 8, wave, 1);
        shake(&start, (uint64_t)k, 0.1);
        double last = iccp_plmap_energy(&start);
        for (size_t n = 1; n < 8; ++n) {
            iccp_plmap map;
            iccp_improvement improvement;
            ck_assert_int_eq(iccp_plmap_copy(&map, &start, &env.memory), ICC_OK);
            ck_assert_int_eq(improve(&map, n, 1e-12, 0, &improvement, &env), ICC_OK);
            check_certified(&map);
            ck_assert_uint_le(improvement.n_iterations, n);
            ck_assert_uint_eq(improvement.n_levels, 0);
            ck_assert_uint_eq(map.n_vertices, start.n_vertices);
            ck_assert_double_eq(improvement.energy, iccp_plmap_energy(&map));
            ck_assert_double_le(improvement.energy, last * (1 + 1e-14));
            last = improvement.energy;
            iccp_plmap_free(&map);
        }
        iccp_plmap_free(&start);
    }
}
END_TEST

START_TEST(levels_refine_and_lower_the_energy)
{
    const iccp_env env = default_env();
    const shape s = shape_l();
    iccp_plmap start = map_of(&s, 6, wave, 1);
    shake(&start, 4, 0.1);
    double last = iccp_plmap_energy(&start);
    size_t n_vertices = 0;
    for (size_t levels = 0; levels < 4; ++levels) {
        iccp_plmap map;
        iccp_improvement improvement;
        ck_assert_int_eq(iccp_plmap_copy(&map, &start, &env.memory), ICC_OK);
        ck_assert_int_eq(improve(&map, 60, 1e-6, levels, &improvement, &env), ICC_OK);
        check_certified(&map);
        ck_assert_uint_le(improvement.n_levels, levels);
        ck_assert_uint_ge(map.n_vertices, n_vertices);
        ck_assert(improvement.n_levels == 0 || map.n_vertices > start.n_vertices);
        ck_assert_double_le(improvement.energy, last * (1 + 1e-14));
        last = improvement.energy;
        n_vertices = map.n_vertices;
        iccp_plmap_free(&map);
    }
    ck_assert_uint_gt(n_vertices, start.n_vertices);
    iccp_plmap_free(&start);
}
END_TEST

/* ---- work ---- */

/* Steps end when there is no work left for one, wherever that is. */
START_TEST(work_is_never_exceeded)
{
    const iccp_env env = default_env();
    const shape s = shape_l();
    iccp_plmap start = map_of(&s, 6, wave, 1);
    shake(&start, 4, 0.1);
    const double n = (double)start.corners.n_triangles, energy = iccp_plmap_energy(&start);
    const double limits[] = {0, n - 1, n, 2.5 * n, 10 * n, 100 * n, 1000 * n, HUGE_VAL};
    double last = energy;
    for (size_t k = 0; k < sizeof limits / sizeof *limits; ++k) {
        const iccp_schedule schedule = {60, 1e-6, 16, 4 * n, false, false};
        iccp_work work = {.left = limits[k]};
        iccp_plmap map;
        iccp_improvement improvement;
        ck_assert_int_eq(iccp_plmap_copy(&map, &start, &env.memory), ICC_OK);
        ck_assert_int_eq(
            iccp_improve(&map, iccp_plmap_energy(&map), &schedule, &work, &improvement, &env),
            ICC_OK);
        check_certified(&map);
        ck_assert_double_le(work.spent, limits[k]);
        ck_assert(work.left >= 0 && (isinf(limits[k]) || work.spent + work.left == limits[k]));
        ck_assert((improvement.n_iterations == 0) == (limits[k] < n));
        ck_assert_double_ge(work.spent, n * (double)improvement.n_iterations);
        ck_assert_double_le((double)map.corners.n_triangles, 4 * n);
        ck_assert_double_le(improvement.energy, (k < 4 ? last : energy) * (1 + 1e-14));
        ck_assert(improvement.n_levels == 0 || limits[k] >= 6 * 1.4 * n);
        last = improvement.energy;
        iccp_plmap_free(&map);
    }
    iccp_plmap_free(&start);
}
END_TEST

/* ---- failures ---- */

/* Cancelled or out of memory at any moment: the map is valid and no worse. */
static icc_status improve_copy(const icc_env *env, icc_error *err, void *argument)
{
    const iccp_plmap *start = argument;
    iccp_env full;
    iccp_plmap map;
    iccp_improvement improvement;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    icc_status status = iccp_plmap_copy(&map, start, &full.memory);
    if (status == ICC_OK) {
        status = improve(&map, 4, 1e-6, 2, &improvement, &full);
        check_certified(&map);
        ck_assert_double_le(iccp_plmap_energy(&map), iccp_plmap_energy(start) * (1 + 1e-14));
    }
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

static icc_status cut_often(const icc_env *env, icc_error *err, void *argument)
{
    iccp_env full;
    iccp_plmap map;
    bool done;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    icc_status status = iccp_plmap_copy(&map, argument, &full.memory);
    if (status == ICC_OK)
        status = iccp_progress(&full, "cut", 0);
    for (uint32_t c = 0; status == ICC_OK && c < 3 * map.corners.n_triangles && c < 300; ++c) {
        status = iccp_plmap_cut(&map, c, &done);
        if (status != ICC_OK)
            check_certified(&map);
    }
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_valid_maps)
{
    const shape l = shape_l();
    iccp_plmap start = map_of(&l, 3, wave, 1);
    faulty_sweep(cut_often, &start);
    faulty_sweep(improve_copy, &start);
    iccp_plmap_free(&start);
}
END_TEST

/* A caller's loop that leaves all out but the first task, which it runs over and over. */
static void run_first(void *user, size_t n, icc_task task, void *argument)
{
    (void)user;
    for (size_t i = 0; i < n; ++i)
        task(argument, 0);
}

/* The last vertex lands far away. */
START_TEST(no_loop_of_the_callers_hides_what_is_inverted)
{
    const shape s = shape_l();
    iccp_plmap map = map_of(&s, 40, wave, 0.7);
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map);
    iccp_env env = default_env();
    ck_assert_uint_gt(map.corners.n_triangles, 1500);
    for (int k = 0; k < 2; ++k) {
        env.parallel_for = k == 0 ? NULL : run_first;
        ck_assert_int_eq(iccp_plmap_certify(&map, &env, NULL), ICC_OK);
        ck_assert_uint_eq(iccp_simplicial_count_at_once(&simplicial, &env), 0);
    }
    map.images[2 * (map.n_vertices - 1)] += 10;
    const size_t n = iccp_plmap_count_inverted(&map);
    ck_assert_uint_gt(n, 0);
    for (int k = 0; k < 2; ++k) {
        env.parallel_for = k == 0 ? NULL : run_first;
        ck_assert_int_eq(iccp_plmap_certify(&map, &env, NULL), ICC_ERR_CERTIFICATE);
        ck_assert_uint_eq(iccp_simplicial_count_at_once(&simplicial, &env), n);
    }
    iccp_plmap_free(&map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("plmap");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, cuts_change_the_mesh_and_not_the_map);
    tcase_add_test(tests, expected_cuts_move_nothing);
    tcase_add_test(tests, edges_that_rounding_would_spoil_stay);
    tcase_add_test(tests, energies_of_simple_maps);
    tcase_add_test(tests, steps_go_down);
    tcase_add_test(tests, steps_begun_ahead_are_the_same);
    tcase_add_test(tests, every_step_is_monotone_and_positive);
    tcase_add_test(tests, what_locks_all_others_is_cut_first);
    tcase_add_test(tests, more_steps_are_no_worse);
    tcase_add_test(tests, levels_refine_and_lower_the_energy);
    tcase_add_test(tests, work_is_never_exceeded);
    tcase_add_test(tests, failures_leave_valid_maps);
    tcase_add_test(tests, no_loop_of_the_callers_hides_what_is_inverted);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
