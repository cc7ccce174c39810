/* Domains of meshes whose cells have region numbers: the surfaces between them, and what is wrong
 * with others. */
#include "../../faulty.h"
#include "../../infos.h"
#include "../../solid_cells.h"
#include "../../suite.h"

#include <stdbool.h>

/* ---------------------------------------------------------------- meshes */

static cell_solid cells;
static int32_t *numbers; /* of each tetrahedron */

/* Gives the cells of a box from one corner to another a part. */
static void fill_box(int part, int x0, int y0, int z0, int x1, int y1, int z1)
{
    for (int x = x0; x < x1; ++x)
        for (int y = y0; y < y1; ++y)
            for (int z = z0; z < z1; ++z)
                cells.label[x][y][z] = part;
}

static void begin(size_t n_parts)
{
    memset(&cells, 0, sizeof cells);
    cells.n_parts = n_parts;
}

/* Makes the mesh. Part k has number of_part[k]. */
static void end(const int32_t *of_part)
{
    cell_solid_mesh(&cells, 0, NULL);
    numbers = malloc(cells.n_tets * sizeof *numbers);
    ck_assert_ptr_nonnull(numbers);
    for (size_t t = 0; t < cells.n_tets; ++t)
        numbers[t] = of_part[cells.part[t]];
}

static void clear(void)
{
    cell_solid_free(&cells);
    free(numbers);
}

static icc_status create(icc_domain **out, const icc_env *env, icc_error *err)
{
    const icc_mesh mesh = {.size = sizeof mesh,
                           .dim = 3,
                           .n_vertices = cells.n_points,
                           .vertices = cells.points,
                           .n_cells = cells.n_tets,
                           .cells = cells.tets,
                           .regions = numbers};
    return icc_domain_create_mesh(out, &mesh, 0, NULL, env, err);
}

static icc_domain *make(void)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(create(&domain, NULL, &err) == ICC_OK, "%s", err.message);
    return domain;
}

/* A block with a handle and a void, and a region (part 2) with another one in it (part 3). */
static void nested(void)
{
    begin(4);
    cells.is_void[1] = 1;
    fill_box(NO_CELL, 1, 5, 0, 2, 7, 8);
    fill_box(1, 1, 1, 1, 3, 2, 3);
    fill_box(2, 4, 1, 1, 7, 4, 6);
    fill_box(3, 5, 2, 2, 6, 3, 4);
}

/* ---------------------------------------------------------------- right ones */

static void check_regions(const icc_domain *domain, const uint32_t *of_part)
{
    uint32_t *regions = malloc(cells.n_tets * sizeof *regions);
    ck_assert_ptr_nonnull(regions);
    ck_assert_int_eq(icc_domain_get_regions(domain, regions), ICC_OK);
    for (size_t t = 0; t < cells.n_tets; ++t)
        ck_assert_uint_eq(regions[t], of_part[cells.part[t]]);
    free(regions);
}

/* The cells have their order and their corners, by place. */
static void check_cells(const icc_domain *domain)
{
    double *points = malloc(3 * cells.n_points * sizeof *points);
    uint32_t *corners = malloc(4 * cells.n_tets * sizeof *corners);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = cells.n_points,
                     .vertices = points,
                     .n_cells = cells.n_tets,
                     .cells = corners};
    ck_assert_int_eq(icc_domain_get_mesh(domain, &mesh), ICC_OK);
    ck_assert_uint_eq(mesh.n_vertices, cells.n_points);
    for (size_t t = 0; t < cells.n_tets; ++t)
        for (size_t k = 0; k < 3; ++k) {
            double sum[2] = {0, 0};
            for (size_t i = 0; i < 4; ++i) {
                sum[0] += points[3 * corners[4 * t + i] + k];
                sum[1] += cells.points[3 * cells.tets[4 * t + i] + k];
            }
            ck_assert_double_eq_tol(sum[0], sum[1], 1e-12);
        }
    free(points);
    free(corners);
}

static icc_feature_info feature_of(const icc_domain *domain, size_t feature)
{
    icc_feature_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_feature(domain, feature, &info), ICC_OK);
    return info;
}

START_TEST(surfaces_are_features)
{
    const int32_t of_part[4] = {7, 0, 30, -2};
    nested();
    end(of_part);
    icc_domain *domain = make();
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert_uint_eq(info.n_features, 2);
    ck_assert_uint_eq(info.n_regions, 2);
    ck_assert_uint_eq(info.n_voids, 1);
    ck_assert_uint_eq(info.genus, 1);
    ck_assert_double_eq_tol(info.measure, 512 - 16 - 4, 1e-9);
    const icc_feature_info inner = feature_of(domain, 0), outer = feature_of(domain, 1);
    ck_assert_uint_eq(inner.n_facets, 20);
    ck_assert_uint_eq(outer.n_facets, 12 * (3 + 5 + 5));
    ck_assert_uint_eq(inner.around, 2);
    ck_assert_uint_eq(outer.around, 0);
    ck_assert_int_eq(inner.orientation, 1);
    ck_assert_int_eq(outer.orientation, 1);
    check_regions(domain, (const uint32_t[4]){0, 0, 2, 1});
    check_cells(domain);
    icc_domain_free(domain);
    clear();
}
END_TEST

START_TEST(maps_keep_regions)
{
    const int32_t of_part[4] = {0, 0, 1, 2};
    nested();
    end(of_part);
    icc_domain *source = make();
    for (size_t i = 0; i < 3 * cells.n_points; ++i)
        cells.points[i] = 2 * cells.points[i] + (double)(i % 3);
    icc_domain *target = make();
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, source, target, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    ck_assert_int_eq(info_of_map(map).certified, 1);
    ck_assert_double_eq_tol(info_of_map(map).energy, 6, 1e-9);
    const size_t n = info_of_map(map).n_simplices;
    uint32_t *regions = malloc(n * sizeof *regions);
    size_t found[3] = {0, 0, 0};
    ck_assert_int_eq(icc_map_get_regions(map, regions, &err), ICC_OK);
    for (size_t t = 0; t < n; ++t) {
        ck_assert_uint_le(regions[t], 2);
        ++found[regions[t]];
    }
    ck_assert(found[0] > 0 && found[1] > 0 && found[2] > 0);
    free(regions);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    clear();
}
END_TEST

/* Each part of a number is a region of its own. Without different numbers there are none. */
START_TEST(parts_of_a_number)
{
    const int32_t of_part[4] = {0, 5, 5, 4};
    begin(4);
    fill_box(1, 1, 1, 1, 2, 2, 2);
    fill_box(2, 4, 4, 4, 6, 6, 6);
    fill_box(3, 1, 4, 1, 2, 5, 2);
    end(of_part);
    icc_domain *domain = make();
    check_regions(domain, (const uint32_t[4]){0, 2, 3, 1});
    icc_domain_free(domain);
    for (size_t t = 0; t < cells.n_tets; ++t)
        numbers[t] = 9;
    domain = make();
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert_uint_eq(info.n_features, 0);
    check_regions(domain, (const uint32_t[4]){0, 0, 0, 0});
    icc_domain_free(domain);
    clear();
}
END_TEST

/* ---------------------------------------------------------------- wrong ones */

static void refuse(const char *text)
{
    const int32_t of_part[3] = {0, 1, 2};
    icc_domain *domain = (icc_domain *)&domain;
    icc_error err = {.size = sizeof err};
    end(of_part);
    ck_assert_int_eq(create(&domain, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert_ptr_null(domain);
    ck_assert_int_eq(err.item, ICC_ITEM_VERTEX);
    ck_assert_msg(strncmp(err.message, text, strlen(text)) == 0, "%s", err.message);
    clear();
}

START_TEST(surfaces_are_apart)
{
    begin(2);
    fill_box(1, 0, 2, 2, 3, 4, 4);
    refuse("a surface between regions touches the boundary at vertex ");
    begin(2);
    fill_box(1, 2, 2, 2, 4, 4, 4);
    cells.label[4][4][4] = 1; /* at a corner: one number, two parts */
    refuse("two surfaces between regions touch at vertex ");
    begin(3);
    fill_box(1, 2, 2, 2, 4, 4, 4);
    fill_box(2, 4, 2, 2, 6, 4, 4);
    refuse("two surfaces between regions touch at vertex ");
    begin(2);
    fill_box(1, 0, 0, 0, 4, 8, 8);
    refuse("a surface between regions touches the boundary at vertex ");
}
END_TEST

/* A ring that closes at an edge is no surface. */
START_TEST(a_surface_may_not_touch_itself)
{
    const int32_t of_part[2] = {0, 1};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    begin(2);
    fill_box(1, 2, 2, 2, 5, 5, 3);
    cells.label[3][3][2] = 0;
    cells.label[2][2][2] = 0;
    end(of_part);
    ck_assert_int_ne(create(&domain, NULL, &err), ICC_OK);
    ck_assert(domain == NULL && err.message[0] != '\0');
    clear();
}
END_TEST

START_TEST(only_in_space)
{
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
    const int32_t two[2] = {0, 1};
    const icc_mesh mesh = {.size = sizeof mesh,
                           .dim = 2,
                           .n_vertices = 4,
                           .vertices = (double *)square,
                           .n_cells = 2,
                           .cells = (uint32_t *)triangles,
                           .regions = two};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create_mesh(&domain, &mesh, 0, NULL, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_nonnull(strstr(err.message, "in 3-D"));
}
END_TEST

static icc_status create_once(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *domain;
    (void)argument;
    const icc_status status = create(&domain, env, err);
    ck_assert((domain != NULL) == (status == ICC_OK));
    icc_domain_free(domain);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    const int32_t of_part[4] = {0, 0, 1, 2};
    nested();
    end(of_part);
    faulty_sweep(create_once, NULL);
    clear();
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("mesh_regions");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 600);
    tcase_add_test(tests, surfaces_are_features);
    tcase_add_test(tests, maps_keep_regions);
    tcase_add_test(tests, parts_of_a_number);
    tcase_add_test(tests, surfaces_are_apart);
    tcase_add_test(tests, a_surface_may_not_touch_itself);
    tcase_add_test(tests, only_in_space);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
