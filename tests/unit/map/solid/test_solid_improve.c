/* Maps of meshes in space made fair: affine ones are found, spoilt ones recover, every mesh on the
 * way is that of a one-to-one map, and results neither depend on threads nor get lost. */
#include "../../../domains.h"
#include "../../../faulty.h"
#include "../../../flat_mesh.h"
#include "../../../infos.h"
#include "../../../meshes.h"
#include "../../../reports.h"
#include "../../../saved.h"
#include "../../../share.h"
#include "../../../suite.h"
#include "domain/domain.h"
#include "map/solid/solid_improve.h"

static const double AFFINE[3][3] = {{1.5, 0.25, 0}, {-0.5, 1, 0.375}, {0.125, 0, 0.75}};

static void shear(int32_t dim, const double *x, double *y)
{
    (void)dim;
    for (int i = 0; i < 3; ++i)
        y[i] = AFFINE[i][0] * x[0] + AFFINE[i][1] * x[1] + AFFINE[i][2] * x[2];
}

/* Two domains with different insides, each with its mesh. */
static domain_pair pair_of(size_t n, void (*move)(int32_t dim, const double *x, double *y))
{
    random_source r = {1};
    domain_pair p;
    test_mesh before = mesh_cube(3, n, 0.1, &r), other = mesh_cube(3, n, 0.1, &r);
    test_mesh after = mesh_moved(&other, move);
    ck_assert_int_eq(mesh_domain(&p.source, &before, NULL, NULL), ICC_OK);
    ck_assert_int_eq(mesh_domain(&p.target, &after, NULL, NULL), ICC_OK);
    mesh_free(&before);
    mesh_free(&other);
    mesh_free(&after);
    return p;
}

static icc_map *map_of(const domain_pair *p, int32_t iterations)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, p->source, p->target, &options, NULL, NULL), ICC_OK);
    return map;
}

static icc_map *improve(const icc_map *map, int32_t levels, double tolerance,
                        icc_improve_report *report, const icc_env *env)
{
    const icc_improve_options options = {
        .size = sizeof options, .levels = levels, .tolerance = tolerance};
    icc_map *better;
    *report = (icc_improve_report){.size = sizeof *report};
    ck_assert_int_eq(icc_map_improve(&better, map, &options, report, env, NULL), ICC_OK);
    const icc_map_info info = info_of_map(better);
    ck_assert_int_eq(info.certified, 1);
    ck_assert_int_eq(info.kind, ICC_MAP_MESH);
    ck_assert_uint_eq(info.n_simplices, report->n_simplices);
    ck_assert_double_eq(info.energy, report->energy);
    ck_assert_double_eq(report->energy_start, info_of_map(map).energy);
    ck_assert_double_le(report->energy, report->energy_start);
    return better;
}

/* Each side of the map's mesh is accepted as a mesh of that domain, with its surface. */
static void check_mesh(const icc_map *map, const domain_pair *p)
{
    const icc_map_info info = info_of_map(map);
    icc_domain_info surface = {.size = sizeof surface};
    ck_assert_int_eq(icc_domain_get_info(p->source, &surface), ICC_OK);
    uint32_t *corners = mesh_alloc(info.n_simplices, 4 * sizeof *corners);
    uint32_t *facets = mesh_alloc(surface.n_facets, 3 * sizeof *facets);
    double *points[2], *vertices = mesh_alloc(surface.n_vertices, 3 * sizeof *vertices);
    for (int side = 0; side < 2; ++side)
        points[side] = mesh_alloc(info.n_vertices, 3 * sizeof *points[side]);
    ck_assert_int_eq(flat_get_mesh(map, points[0], points[1], corners), ICC_OK);
    for (int side = 0; side < 2; ++side) {
        icc_domain *domain;
        icc_error err = {.size = sizeof err};
        const icc_domain *given = side == 0 ? p->source : p->target;
        ck_assert_int_eq(icc_domain_get_boundary(given, vertices, facets), ICC_OK);
        ck_assert_mem_eq(vertices, points[side], 3 * surface.n_vertices * sizeof *vertices);
        ck_assert_msg(flat_create_mesh(&domain, 3, info.n_vertices, points[side], info.n_simplices,
                                       corners, surface.n_facets, facets, NULL, &err) == ICC_OK,
                      "%s", err.message);
        icc_domain_free(domain);
        free(points[side]);
    }
    free(vertices);
    free(facets);
    free(corners);
}

/* ---- what comes out ---- */

START_TEST(affine_maps_are_found)
{
    const double *a = AFFINE[0], *b = AFFINE[1], *c = AFFINE[2];
    const double det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
    double sum = 0, minors = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const double *d = AFFINE[(i + 1) % 3], *e = AFFINE[(i + 2) % 3];
            const double minor = d[(k + 1) % 3] * e[(k + 2) % 3] - d[(k + 2) % 3] * e[(k + 1) % 3];
            sum += AFFINE[i][k] * AFFINE[i][k];
            minors += minor * minor;
        }
    const double wanted = sum / pow(det, 2.0 / 3) + minors / pow(det, 4.0 / 3);
    domain_pair p = pair_of(4, shear);
    icc_map *map = map_of(&p, 0);
    for (int32_t levels = -1; levels <= 2; levels += 3) {
        icc_improve_report report;
        icc_map *better = improve(map, levels, 1e-15, &report, NULL);
        ck_assert_double_eq_tol(report.energy, wanted, 1e-10);
        random_source r = {3};
        for (int i = 0; i < 200; ++i) {
            double x[3], y[3], z[3];
            icc_status status;
            for (int k = 0; k < 3; ++k)
                x[k] = random_between(&r, 0, 4);
            shear(3, x, z);
            ck_assert_int_eq(icc_map_apply(better, 1, x, y, &status, NULL, NULL), ICC_OK);
            for (int k = 0; k < 3; ++k)
                ck_assert_double_eq_tol(y[k], z[k], 1e-5);
        }
        icc_map_free(better);
    }
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

START_TEST(new_maps_take_a_few_steps)
{
    domain_pair p = pair_of(4, mesh_bend);
    icc_map *plain = map_of(&p, -1), *some = map_of(&p, 1), *map = map_of(&p, 0);
    const icc_map_info info = info_of_map(map);
    ck_assert_uint_eq(report_of(plain).n_iterations, 0);
    ck_assert_double_eq(info_of_map(plain).energy, report_of(plain).energy_start);
    ck_assert_uint_eq(report_of(some).n_iterations, 1);
    ck_assert(report_of(map).n_iterations >= 2 && report_of(map).n_iterations <= 20);
    ck_assert_double_eq(report_of(map).energy_start, info_of_map(plain).energy);
    ck_assert_double_lt(info_of_map(some).energy, report_of(map).energy_start);
    ck_assert_double_lt(info.energy, info_of_map(some).energy);
    check_mesh(map, &p);
    icc_map_free(plain);
    icc_map_free(some);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

START_TEST(level_by_level)
{
    domain_pair p = pair_of(4, mesh_bend);
    icc_map *map = map_of(&p, -1);
    double last = info_of_map(map).energy;
    for (int32_t n = -1; n <= 2; ++n) {
        icc_improve_report report;
        icc_map *better = improve(map, n, 1e-6, &report, NULL);
        ck_assert_int_le(report.n_levels, n < 0 ? 0 : n == 0 ? 16 : n);
        ck_assert(n <= 0 || report.n_levels > 0);
        if (n != 0) {
            ck_assert(report.energy < last || (n == 2 && report.n_levels == 1));
            last = report.energy;
        }
        ck_assert(n == -1 ? report.n_simplices == info_of_map(map).n_simplices
                          : report.n_simplices > info_of_map(map).n_simplices);
        check_mesh(better, &p);
        icc_map_free(better);
    }
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

/* One that was improved is improved from there, and the first one stays as it is. */
START_TEST(again_and_again)
{
    domain_pair p = pair_of(4, mesh_bend);
    icc_map *map = map_of(&p, 0);
    bytes before = map_bytes(map);
    icc_improve_report report;
    icc_map *once = improve(map, 1, 0, &report, NULL), *twice = improve(once, 1, 0, &report, NULL);
    bytes after = map_bytes(map);
    ck_assert_uint_eq(after.n, before.n);
    ck_assert_same(after.data, before.data, before.n, "a map that was improved");
    ck_assert_int_eq(report_of(twice).n_levels, 2);
    check_mesh(twice, &p);
    free(before.data);
    free(after.data);
    icc_map_free(map);
    icc_map_free(once);
    icc_map_free(twice);
    domain_pair_free(&p);
}
END_TEST

/* ---- a hard start ---- */

static double least_volume(const iccp_simplicial_map *map)
{
    double least = HUGE_VAL;
    for (size_t t = 0; t < map->n_simplices; ++t) {
        const double *image[4];
        double element[ICCP_ELEMENT(3)], j[9];
        iccp_simplicial_images(3, map, t, image);
        iccp_simplicial_element(map, t, element);
        least = fmin(least, iccp_element_jacobian(3, element, image, j));
    }
    return least;
}

/* Moves corner 0 of a tetrahedron so near to the face opposite that 1e-9 of its volume is left;
 * false where that is not inside the star of the point, or not possible. */
static bool squeeze(const iccp_solid_map *map, size_t t)
{
    const iccp_simplices *mesh = map->mesh;
    const uint32_t *v = mesh->corners + 4 * t;
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    if (v[0] < mesh->n_boundary)
        return false;
    memcpy(map->images, mesh->points, 3 * mesh->n_points * sizeof *map->images);
    for (size_t k = 0; k < 3; ++k) {
        double *y = map->images + k;
        const double middle = (y[3 * v[1]] + y[3 * v[2]] + y[3 * v[3]]) / 3;
        y[3 * v[0]] = middle + 1e-9 * (y[3 * v[0]] - middle);
    }
    return iccp_simplicial_count_inverted(&simplicial) == 0;
}

/* Such a tetrahedron has nearly all of the energy: it recovers, as do the others. */
START_TEST(squeezed_tetrahedra_recover)
{
    random_source r = {5};
    test_mesh m = mesh_cube(3, 4, 0.1, &r);
    icc_domain *domain;
    iccp_env env;
    size_t n = 0;
    ck_assert_int_eq(mesh_domain(&domain, &m, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    const iccp_simplices *mesh = domain->mesh;
    for (size_t t = 0; t < mesh->n_simplices && n < 20; ++t) {
        iccp_solid_map map = {.memory = env.memory, .mesh = mesh, .stretch = 1};
        map.images = iccp_alloc(&env.memory, 3 * mesh->n_points, sizeof *map.images);
        const iccp_simplicial_map before = iccp_solid_simplicial(&map);
        const iccp_schedule schedule = {
            .iterations = 60, .tolerance = 1e-12, .levels = n % 2, .most = HUGE_VAL};
        iccp_work work = iccp_work_unlimited();
        iccp_improvement improvement;
        if (squeeze(&map, t)) {
            ck_assert_double_lt(least_volume(&before), 2e-9);
            ck_assert_int_eq(iccp_solid_improve(&map, domain, &schedule, &work, &improvement, &env),
                             ICC_OK);
            const iccp_simplicial_map after = iccp_solid_simplicial(&map);
            ck_assert_double_eq_tol(improvement.energy, 6, 1e-8);
            ck_assert_uint_eq(iccp_simplicial_count_inverted(&after), 0);
            ck_assert_double_gt(least_volume(&after), 0.99);
            ++n;
        }
        iccp_simplices_free(map.own);
        iccp_free(&env.memory, map.images);
    }
    ck_assert_uint_gt(n, 10);
    mesh_free(&m);
    icc_domain_free(domain);
}
END_TEST

/* ---- saving, threads, failures ---- */

START_TEST(saved_maps_load)
{
    domain_pair p = pair_of(4, mesh_bend);
    icc_map *map = map_of(&p, 0), *loaded;
    for (int32_t n = -1; n <= 2; ++n) {
        icc_improve_report report;
        icc_map *better = improve(map, n, 0, &report, NULL);
        bytes b = map_bytes(better);
        ck_assert_int_eq(icc_map_load(&loaded, b.n, b.data, NULL, NULL), ICC_OK);
        same_map(better, loaded, p.source);
        bytes again = map_bytes(loaded);
        ck_assert_uint_eq(again.n, b.n);
        ck_assert_same(again.data, b.data, b.n, "what is saved again");
        ck_assert_double_eq(info_of_map(loaded).energy, report.energy);
        icc_map *still_better = improve(loaded, 1, 0, &report, NULL);
        check_mesh(still_better, &p);
        icc_map_free(still_better);
        icc_map_free(loaded);
        icc_map_free(better);
        free(b.data);
        free(again.data);
    }
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

START_TEST(threads_change_nothing)
{
    domain_pair p = pair_of(9, mesh_bend);
    icc_map *map = map_of(&p, -1);
    for (int32_t levels = -1; levels <= 1; levels += 2) {
        icc_improve_report first, report;
        icc_map *better = improve(map, levels, 0, &first, NULL);
        bytes b = map_bytes(better);
        for (int32_t n = 2; n <= 4; ++n) {
            const icc_env env = {.size = sizeof env, .threads = n};
            icc_map *same = improve(map, levels, 0, &report, &env);
            bytes other = map_bytes(same);
            ck_assert_uint_eq(other.n, b.n);
            ck_assert_same(other.data, b.data, b.n, "with threads");
            ck_assert_mem_eq(&report, &first, sizeof report);
            free(other.data);
            icc_map_free(same);
        }
        free(b.data);
        icc_map_free(better);
    }
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
    domain_pair p = pair_of(2, mesh_bend);
    icc_map *map = map_of(&p, -1), *better;
    for (int32_t threads = 1; threads <= 2; ++threads)
        for (size_t k = 1;; k = share_next(k)) {
            faulty f = {.fail_at = k};
            icc_env env = faulty_env(&f);
            env.threads = threads;
            const icc_improve_options options = {.size = sizeof options, .levels = 1};
            const icc_status status = icc_map_improve(&better, map, &options, NULL, &env, NULL);
            if (status == ICC_OK) {
                ck_assert_uint_lt(f.n_allocs, k);
                icc_map_free(better);
                ck_assert_uint_eq(f.n_live, 0);
                ck_assert_uint_gt(k, 20);
                break;
            }
            ck_assert_int_eq(status, ICC_ERR_MEMORY);
            ck_assert_ptr_null(better);
            ck_assert_uint_eq(f.n_live, 0);
        }
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

/* The map so far, which is no worse than that of an earlier end. */
START_TEST(cancelled_improvement_keeps_the_map)
{
    domain_pair p = pair_of(4, mesh_bend);
    icc_map *map = map_of(&p, -1);
    double last = info_of_map(map).energy;
    int32_t cancelled = 1;
    for (size_t k = 1; cancelled; k = share_next(k)) {
        faulty f = {.cancel_at = k};
        const icc_env env = faulty_env(&f);
        icc_improve_report report;
        icc_map *better = improve(map, 2, 0, &report, &env);
        cancelled = report.cancelled;
        ck_assert_double_le(report.energy, last * (1 + 1e-12));
        last = report.energy;
        check_mesh(better, &p);
        icc_map_free(better);
    }
    ck_assert_double_lt(last, info_of_map(map).energy);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fair maps of meshes in space");
    TCase *tcase = tcase_create("all");
    tcase_set_timeout(tcase, 300);
    tcase_add_test(tcase, affine_maps_are_found);
    tcase_add_test(tcase, new_maps_take_a_few_steps);
    tcase_add_test(tcase, level_by_level);
    tcase_add_test(tcase, again_and_again);
    tcase_add_test(tcase, squeezed_tetrahedra_recover);
    tcase_add_test(tcase, saved_maps_load);
    tcase_add_test(tcase, threads_change_nothing);
    tcase_add_test(tcase, every_allocation_may_fail);
    tcase_add_test(tcase, cancelled_improvement_keeps_the_map);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
