/* The mesh of a map as it is handed out, in doubles, far from the origin. */
#include "../../flat_mesh.h"
#include "../../meshes.h"
#include "../../reports.h"
#include "../../suite.h"

#include "math/orient.h"

#include <check.h>
#include <icc/icc.h>
#include <stdbool.h>

/* The offsets are exact: powers of two from about 1e3 to 1e9. */
static const double OFFSETS[] = {0x1p10, 0x1p17, 0x1p23, 0x1p27, 0x1p30};
enum { N_OFFSETS = sizeof OFFSETS / sizeof *OFFSETS, N_SIDES = 24 };

/* Simplices that are not positive on both sides, by the numbers that the caller gets. */
static size_t count_faults(const icc_map *map, const icc_map_info *info)
{
    const size_t dim = (size_t)info->dim;
    double *points[2];
    uint32_t *corners = mesh_alloc((dim + 1) * info->n_simplices, sizeof *corners);
    for (int side = 0; side < 2; ++side)
        points[side] = mesh_alloc(dim * info->n_vertices, sizeof(double));
    ck_assert_int_eq(flat_get_mesh(map, points[0], points[1], corners), ICC_OK);
    size_t n = 0;
    for (size_t s = 0; s < info->n_simplices; ++s) {
        bool good = true;
        for (int side = 0; side < 2; ++side) {
            const double *at[4];
            for (size_t k = 0; k <= dim; ++k)
                at[k] = points[side] + dim * corners[(dim + 1) * s + k];
            good &= iccp_orient(dim, at) > 0;
        }
        n += !good;
    }
    free(points[0]);
    free(points[1]);
    free(corners);
    return n;
}

/* Makes the map, has its mesh judged, and returns how much of it is spoilt. Takes both domains. */
static size_t spoilt(icc_domain *source, icc_domain *target)
{
    icc_map *map;
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert(info.kind == ICC_MAP_MESH && info.certified == 1);
    const size_t n_spoilt = report_of(map).n_spoilt;
    ck_assert_uint_eq(n_spoilt, count_faults(map, &info));
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    return n_spoilt;
}

static icc_domain *polygon_at(size_t n, const double *xy, double offset)
{
    double moved[2 * N_SIDES];
    icc_domain *domain;
    for (size_t i = 0; i < 2 * n; ++i)
        moved[i] = xy[i] + offset;
    ck_assert_int_eq(icc_domain_create(&domain, 2, n, moved, 0, NULL, NULL, NULL), ICC_OK);
    return domain;
}

START_TEST(stars_keep_their_triangles)
{
    random_source r = {5};
    for (int k = 0; k < N_OFFSETS; ++k)
        for (int i = 0; i < 3; ++i) {
            double star[2][2 * N_SIDES];
            for (size_t v = 0; v < 2 * N_SIDES; ++v) {
                const double turn = 6.283185307179586 * (double)(v % N_SIDES) / N_SIDES;
                const double radius = random_between(&r, 0.4, 1);
                star[v / N_SIDES][2 * (v % N_SIDES)] = radius * cos(turn);
                star[v / N_SIDES][2 * (v % N_SIDES) + 1] = radius * sin(turn);
            }
            icc_domain *source = polygon_at(N_SIDES, star[0], i == 1 ? 0 : OFFSETS[k]);
            ck_assert_uint_eq(
                spoilt(source, polygon_at(N_SIDES, star[1], i == 2 ? 0 : -OFFSETS[k])), 0);
        }
}
END_TEST

/* A dumb-bell, whose bar is a few units in the last place wide in the target. */
START_TEST(what_rounding_spoils_is_counted)
{
    size_t n_spoilt = 0;
    for (int k = 0; k < N_OFFSETS; ++k) {
        double bell[2][24];
        for (int side = 0; side < 2; ++side) {
            const double w = side == 0 ? 0.25 : OFFSETS[k] * 0x1p-51;
            const double xy[24] = {0, 0, 1, 0, 1, 0.5,     3, 0.5,     4, 0, 5, 0,
                                   5, 1, 4, 1, 3, 0.5 + w, 1, 0.5 + w, 1, 1, 0, 1};
            memcpy(bell[side], xy, sizeof xy);
        }
        ck_assert_uint_eq(spoilt(polygon_at(12, bell[0], 0), polygon_at(12, bell[0], OFFSETS[k])),
                          0);
        n_spoilt += spoilt(polygon_at(12, bell[0], 0), polygon_at(12, bell[1], OFFSETS[k])) > 0;
    }
    ck_assert_uint_gt(n_spoilt, 0);
}
END_TEST

static icc_domain *solid_at(const test_mesh *m, double bend, double offset)
{
    test_mesh moved = mesh_copy(m);
    icc_domain *domain;
    for (size_t v = 0; v < m->n_vertices; ++v) {
        double *x = moved.vertices + 3 * v;
        x[0] += bend * x[2] * x[2];
        for (int i = 0; i < 3; ++i)
            x[i] += offset;
    }
    ck_assert_int_eq(mesh_domain(&domain, &moved, NULL, NULL), ICC_OK);
    mesh_free(&moved);
    return domain;
}

START_TEST(tetrahedra_too)
{
    random_source r = {6};
    for (int k = 0; k < N_OFFSETS; ++k) {
        test_mesh m = mesh_ball(3, 4, 0.1, &r);
        ck_assert_uint_eq(spoilt(solid_at(&m, 0, OFFSETS[k]), solid_at(&m, 0.3, -OFFSETS[k])), 0);
        mesh_free(&m);
    }
}
END_TEST

/* The images of a caller's mesh are judged as they are handed out. */
START_TEST(certificates_are_about_what_is_handed_out)
{
    random_source r = {7};
    size_t n_certified = 0;
    for (int k = 0; k < N_OFFSETS; ++k)
        for (int repair = 0; repair < 2; ++repair) {
            const double square[8] = {0, 0, 8, 0, 8, 8, 0, 8},
                         dart[8] = {0, 0, 8, 0, 4.5, 4.5, 0, 8};
            icc_domain *source = polygon_at(4, square, OFFSETS[k]);
            icc_domain *target = polygon_at(4, dart, -OFFSETS[k]);
            test_mesh m = mesh_cube(2, 8, 0.1, &r);
            for (size_t i = 0; i < 2 * m.n_vertices; ++i)
                m.vertices[i] += OFFSETS[k];
            icc_map *map;
            icc_certificate c = {.size = sizeof c};
            double *images = mesh_alloc(2 * m.n_vertices, sizeof *images);
            ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
            ck_assert_int_eq((repair ? flat_repair : flat_certify)(map, m.n_vertices, m.vertices,
                                                                   m.n_simplices, m.simplices,
                                                                   images, &c, NULL, NULL),
                             ICC_OK);
            size_t n = 0;
            for (size_t t = 0; t < m.n_simplices; ++t) {
                const double *at[2][3];
                for (size_t i = 0; i < 3; ++i) {
                    at[0][i] = m.vertices + 2 * m.simplices[3 * t + i];
                    at[1][i] = images + 2 * m.simplices[3 * t + i];
                }
                n += iccp_orient(2, at[0]) * iccp_orient(2, at[1]) <= 0;
            }
            ck_assert_uint_eq(c.n_inverted + c.n_flat, n);
            n_certified += (size_t)c.certified;
            free(images);
            icc_map_free(map);
            icc_domain_free(source);
            icc_domain_free(target);
            mesh_free(&m);
        }
    ck_assert_uint_gt(n_certified, 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("rounded");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, stars_keep_their_triangles);
    tcase_add_test(tests, what_rounding_spoils_is_counted);
    tcase_add_test(tests, tetrahedra_too);
    tcase_add_test(tests, certificates_are_about_what_is_handed_out);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
