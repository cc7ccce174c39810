/* Charts as bytes: what is loaded is what was saved, and nothing else is loaded. */
#include "../../faulty.h"
#include "../../hard_shapes.h"
#include "../../meshes.h"
#include "../../saved.h"
#include "../../shape_domains.h"
#include "../../suite.h"
#include "../../surfaces.h"

static const int32_t METHODS[] = {ICC_METHOD_FOLIATION, ICC_METHOD_DISC, ICC_METHOD_GRADIENT,
                                  ICC_METHOD_FIELD};
enum { N_METHODS = 4 };

static icc_chart *chart_of(const icc_domain *domain, const icc_chart_options *options)
{
    icc_chart *chart;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_chart_create(&chart, domain, options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return chart;
}

/* Takes over the domain. */
static icc_chart *chart_with(icc_domain *domain, int32_t method, int32_t cells)
{
    const icc_chart_options options = {.size = sizeof options, .method = method, .cells = cells};
    icc_chart *chart = chart_of(domain, &options);
    icc_domain_free(domain);
    return chart;
}

/* Takes over the chart. */
static void check_chart(icc_chart *chart)
{
    icc_chart *loaded;
    icc_error err = {.size = sizeof err};
    const icc_env threads = {.size = sizeof threads, .threads = 3};
    bytes b = chart_bytes(chart);
    ck_assert_msg(icc_chart_load(&loaded, b.n, b.data, &threads, &err) == ICC_OK, "%s",
                  err.message);
    same_chart(chart, loaded);
    bytes again = chart_bytes(loaded);
    ck_assert_uint_eq(again.n, b.n);
    ck_assert_same(again.data, b.data, b.n, "what is saved again");
    free(b.data);
    free(again.data);
    icc_chart_free(loaded);
    icc_chart_free(chart);
}

/* ---- every method in every dimension ---- */

START_TEST(polygons)
{
    for (int k = 0; k < N_SHAPES; ++k)
        for (int m = 0; m < N_METHODS; ++m) {
            const shape s = shape_number(k), r = shape_reversed(&s),
                        far = shape_moved(&s, 10, 1e9, -1e9);
            check_chart(chart_with(domain_of_shape(&s), METHODS[m], 24));
            check_chart(chart_with(domain_of_shape(&r), METHODS[m], 17));
            check_chart(chart_with(domain_of_shape(&far), METHODS[m], 20));
        }
}
END_TEST

START_TEST(hard_polygons)
{
    int n = 0;
    for (int k = 0; k < N_HARD_SHAPES; ++k)
        for (int m = 0; m < 2; ++m) {
            const shape s = shape_hard(k);
            const icc_chart_options options = {.size = sizeof options, .method = METHODS[m]};
            icc_domain *domain = domain_of_shape(&s);
            icc_chart *chart;
            if (icc_chart_create(&chart, domain, &options, NULL, NULL) == ICC_OK) {
                check_chart(chart);
                ++n;
            }
            icc_domain_free(domain);
        }
    ck_assert_int_gt(n, N_HARD_SHAPES);
}
END_TEST

/* Facets in any order and direction of the ring. */
START_TEST(facets_as_given)
{
    static const uint32_t FACETS[12] = {3, 4, 0, 1, 5, 0, 2, 3, 1, 2, 4, 5};
    const shape s = shape_l();
    for (int turn = 0; turn < 2; ++turn)
        for (int m = 0; m < N_METHODS; ++m) {
            uint32_t facets[12];
            icc_domain *domain;
            for (int i = 0; i < 12; ++i)
                facets[i] = FACETS[turn == 0 ? i : i ^ 1];
            ck_assert_int_eq(icc_domain_create(&domain, 2, 6, s.xy, 6, facets, NULL, NULL), ICC_OK);
            check_chart(chart_with(domain, METHODS[m], 30));
        }
}
END_TEST

START_TEST(all_options)
{
    static const double MAXIMUM[2] = {0.6, 2.2};
    const shape s = shape_l();
    icc_domain *domain = domain_of_shape(&s);
    for (int32_t function = 1; function <= ICC_FUNCTION_HARMONIC; ++function)
        for (int32_t tree = 1; tree <= ICC_TREE_PAPER; ++tree) {
            const icc_chart_options o = {.size = sizeof o,
                                         .method = ICC_METHOD_GRADIENT,
                                         .function = function,
                                         .tree = tree,
                                         .cells = 12,
                                         .maximum = tree == 1 ? MAXIMUM : NULL,
                                         .constraints = function % 4,
                                         .solver = ICC_SOLVER_DIRECT,
                                         .min_fall = 1e-5,
                                         .leaf_min = 1e-8};
            check_chart(chart_of(domain, &o));
        }
    for (int m = 0; m < N_METHODS; ++m) {
        const icc_chart_options o = {.size = sizeof o,
                                     .method = METHODS[m],
                                     .maximum = METHODS[m] == ICC_METHOD_DISC ? NULL : MAXIMUM};
        check_chart(chart_of(domain, &o));
    }
    icc_domain_free(domain);
}
END_TEST

START_TEST(masks)
{
    static const size_t PLANE[2] = {9, 8}, SPACE[3] = {5, 4, 7};
    uint8_t cells[140];
    icc_domain *domain;
    for (int i = 0; i < 72; ++i)
        cells[i] = (uint8_t)(i % 9 < 4 || i / 9 < 3 ? 1 + i % 3 : 0);
    for (int m = 0; m < N_METHODS; ++m) {
        ck_assert_int_eq(icc_domain_create_mask(&domain, 2, PLANE, cells, NULL, NULL), ICC_OK);
        check_chart(
            chart_with(domain, METHODS[m], METHODS[m] == ICC_METHOD_FIELD ? 0 : 4 * (m % 3)));
    }
    for (int i = 0; i < 140; ++i)
        cells[i] = i % 5 < 3 || i / 20 < 3;
    for (int m = 2; m < N_METHODS; ++m) {
        ck_assert_int_eq(icc_domain_create_mask(&domain, 3, SPACE, cells, NULL, NULL), ICC_OK);
        check_chart(chart_with(domain, METHODS[m], 0));
    }
}
END_TEST

START_TEST(surfaces)
{
    static surface s;
    random_source r = {3};
    icc_domain *domain;
    for (int m = 2; m < N_METHODS; ++m) {
        surface_octahedron(&s);
        surface_star(&s, 2, 0.3, &r);
        ck_assert_int_eq(
            icc_domain_create(&domain, 3, s.n_vertices, s.vertices, s.n_faces, s.faces, NULL, NULL),
            ICC_OK);
        check_chart(chart_with(domain, METHODS[m], 12));
    }
}
END_TEST

/* Takes over the mesh. */
static icc_domain *filled(test_mesh m)
{
    icc_domain *domain;
    ck_assert_int_eq(mesh_domain(&domain, &m, NULL, NULL), ICC_OK);
    mesh_free(&m);
    return domain;
}

START_TEST(meshes)
{
    random_source r = {4};
    for (int32_t dim = 2; dim <= 4; ++dim) {
        check_chart(chart_with(filled(mesh_cube(dim, 3, 0.1, &r)), 0, 0));
        check_chart(chart_with(filled(mesh_ball(dim, 4 - (size_t)dim / 4, 0.1, &r)), 0, 0));
        /* No vertex inside: the chart has a mesh of its own. */
        check_chart(chart_with(filled(mesh_cells(dim, 1, NULL)), 0, 0));
        check_chart(chart_with(filled(mesh_cells(dim, 1, NULL)), ICC_METHOD_FIELD, 8));
    }
    const shape s = shape_e();
    check_chart(chart_with(filled(mesh_polygon(s.n, s.xy, 0.3)), ICC_METHOD_FOLIATION, 0));
    check_chart(chart_with(filled(mesh_polygon(s.n, s.xy, 0.3)), ICC_METHOD_DISC, 0));
}
END_TEST

/* Of a vertex inside, not even the sign of a zero is lost on the way to local coordinates and
 * back. */
START_TEST(signs_of_zeros)
{
    test_mesh m = mesh_cells(2, 2, NULL);
    for (int i = 0; i < 18; ++i)
        m.vertices[i] -= 1;
    m.vertices[8] = -0.0; /* the vertex in the middle, the last one in the bytes */
    icc_chart *chart = chart_with(filled(m), 0, 0), *loaded;
    bytes b = chart_bytes(chart);
    const size_t at = 24 + 8 + 24 + 16 * 8;
    ck_assert_int_eq(b.data[at + 7], 0x80);
    ck_assert_int_eq(b.data[at + 15], 0);
    ck_assert_int_eq(icc_chart_load(&loaded, b.n, b.data, NULL, NULL), ICC_OK);
    bytes again = chart_bytes(loaded);
    ck_assert_same(b.data, again.data, b.n, "what is saved again");
    free(b.data);
    free(again.data);
    icc_chart_free(loaded);
    icc_chart_free(chart);
}
END_TEST

/* A foliation of the library's own mesh, although the domain has one of the caller's: the other of
 * the pair has none. */
START_TEST(mesh_beside_polygon)
{
    const shape s = shape_l();
    const icc_chart_options foliation = {.size = sizeof foliation, .method = ICC_METHOD_FOLIATION};
    const icc_map_options options = {
        .size = sizeof options, .chart = &foliation, .kind = ICC_MAP_CURVES};
    icc_domain *source = filled(mesh_polygon(s.n, s.xy, 0.3)), *target;
    uint32_t facets[12];
    icc_map *map;
    icc_chart *loaded;
    ck_assert_int_eq(icc_domain_get_boundary(source, NULL, facets), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&target, 2, s.n, s.xy, 6, facets, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, source, target, &options, NULL, NULL), ICC_OK);
    bytes b = chart_bytes(icc_map_source_chart(map));
    ck_assert_int_eq(icc_chart_load(&loaded, b.n, b.data, NULL, NULL), ICC_OK);
    same_chart(icc_map_source_chart(map), loaded);
    free(b.data);
    icc_chart_free(loaded);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* ---- bytes that are not those of a chart ---- */

enum { N_SMALL = 6 };

/* One of each way to be a chart. */
static icc_chart *small_chart(int k)
{
    static const size_t SHAPE[2] = {3, 2};
    static const uint8_t CELLS[6] = {1, 1, 1, 1, 0, 0};
    random_source r = {5};
    const shape s = shape_l();
    icc_domain *domain;
    switch (k) {
    case 0:
        return chart_with(domain_of_shape(&s), ICC_METHOD_FOLIATION, 4);
    case 1:
        return chart_with(domain_of_shape(&s), ICC_METHOD_DISC, 4);
    case 2:
        return chart_with(domain_of_shape(&s), ICC_METHOD_GRADIENT, 6);
    case 3:
        ck_assert_int_eq(icc_domain_create_mask(&domain, 2, SHAPE, CELLS, NULL, NULL), ICC_OK);
        return chart_with(domain, ICC_METHOD_FIELD, 8);
    case 4:
        return chart_with(filled(mesh_cube(3, 2, 0.1, &r)), 0, 0);
    default:
        return chart_with(filled(mesh_cells(3, 1, NULL)), 0, 0);
    }
}

static icc_status load_chart(const bytes *b, icc_error *err)
{
    icc_chart *loaded;
    const icc_status status = icc_chart_load(&loaded, b->n, b->data, NULL, err);
    ck_assert((loaded != NULL) == (status == ICC_OK));
    icc_chart_free(loaded);
    return status;
}

START_TEST(damage_is_noticed)
{
    for (int k = 0; k < N_SMALL; ++k) {
        icc_chart *chart = small_chart(k);
        bytes b = chart_bytes(chart);
        check_damage(&b, load_chart);
        free(b.data);
        icc_chart_free(chart);
    }
}
END_TEST

START_TEST(capacity)
{
    icc_chart *chart = small_chart(0);
    bytes b = chart_bytes(chart);
    unsigned char *part = saved_alloc(b.n);
    size_t n;
    memset(part, 0x5a, b.n);
    ck_assert_int_eq(icc_chart_save(chart, b.n - 1, part, &n), ICC_OK);
    ck_assert_uint_eq(n, b.n);
    ck_assert_int_eq(part[b.n - 1], 0x5a);
    free(part);
    free(b.data);
    icc_chart_free(chart);
}
END_TEST

START_TEST(later_versions)
{
    icc_chart *chart = small_chart(0), *loaded;
    bytes b = chart_bytes(chart);
    iccp_blob w;
    size_t n;
    /* Version 2 has formats of its own, and version 3 does not exist. */
    for (uint32_t version = 2; version <= 3; ++version) {
        iccp_blob_begin(&w, b.data, b.n, "CHRT", version);
        w.at = b.n;
        iccp_blob_end(&w, &n);
        ck_assert_int_eq(icc_chart_load(&loaded, b.n, b.data, NULL, NULL),
                         version == 2 ? ICC_ERR_FORMAT : ICC_ERR_VERSION);
    }
    repair_bytes(&b, "MAP_");
    ck_assert_int_eq(icc_chart_load(&loaded, b.n, b.data, NULL, NULL), ICC_ERR_FORMAT);
    free(b.data);
    icc_chart_free(chart);
}
END_TEST

/* Whatever is loaded answers, and is saved as those bytes. */
static void check_harmless(const bytes *b)
{
    static coordinates c;
    double points[SAVED_POINTS * ICC_MAX_DIM];
    icc_chart *loaded;
    const icc_status status = icc_chart_load(&loaded, b->n, b->data, NULL, NULL);
    ck_assert(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION);
    ck_assert((loaded != NULL) == (status == ICC_OK));
    if (loaded == NULL)
        return;
    saved_points(icc_chart_domain(loaded), 5, points);
    find_coordinates(loaded, points, &c);
    bytes again = chart_bytes(loaded);
    ck_assert_uint_eq(again.n, b->n);
    ck_assert_same(again.data, b->data, b->n, "what is saved again");
    free(again.data);
    icc_chart_free(loaded);
}

/* Content that has been made up, with the checksum put right. */
START_TEST(content_is_checked)
{
    random_source r = {6};
    for (int k = 0; k < N_SMALL; ++k) {
        icc_chart *chart = small_chart(k);
        bytes b = chart_bytes(chart), changed = {b.n, saved_alloc(b.n)};
        const int n = k == 2 || k == 3 ? 300 : 3000;
        for (int i = 0; i < n; ++i) {
            make_up_content(&changed, &b, "CHRT", &r);
            check_harmless(&changed);
        }
        free(b.data);
        free(changed.data);
        icc_chart_free(chart);
    }
}
END_TEST

/* Of the first chart: head, domain, method, cells, counts and pieces come before the points. */
enum {
    N_CORNERS = 6,
    DOMAIN = 24 + 8,
    COUNTS = DOMAIN + 16 + 24 * N_CORNERS + 8 + 8,
    PIECES = COUNTS + 16
};

static uint64_t get64(const bytes *b, size_t at)
{
    uint64_t value = 0;
    for (size_t i = 8; i-- > 0;)
        value = value << 8 | b->data[at + i];
    return value;
}

/* Triangles turned over, or moved, and rises changed so that they still fit together along
 * edges. */
START_TEST(false_foliations_are_refused)
{
    icc_chart *chart = small_chart(0), *loaded;
    bytes b = chart_bytes(chart), changed = {b.n, saved_alloc(b.n)};
    const size_t n_inner = (size_t)get64(&b, COUNTS);
    const size_t n_triangles = (size_t)get64(&b, COUNTS + 8);
    const size_t points = PIECES + 4 * N_CORNERS, triangles = points + 16 * n_inner;
    const size_t centre = triangles + 12 * n_triangles + 8;
    ck_assert_uint_eq(n_triangles, facts_of(chart).n_mesh_simplices);
    for (size_t t = 0; t < n_triangles; ++t) {
        memcpy(changed.data, b.data, b.n);
        memcpy(changed.data + triangles + 12 * t, b.data + triangles + 12 * t + 4, 4);
        memcpy(changed.data + triangles + 12 * t + 4, b.data + triangles + 12 * t, 4);
        repair_bytes(&changed, "CHRT");
        ck_assert_int_eq(icc_chart_load(&loaded, b.n, changed.data, NULL, NULL), ICC_ERR_FORMAT);
    }
    for (size_t at = centre + 4; at < b.n; at += 8) {
        memcpy(changed.data, b.data, b.n);
        changed.data[at] ^= 1;
        repair_bytes(&changed, "CHRT");
        ck_assert_int_eq(icc_chart_load(&loaded, b.n, changed.data, NULL, NULL), ICC_ERR_FORMAT);
    }
    /* Another centre has other triangles around it. */
    memcpy(changed.data, b.data, b.n);
    changed.data[centre] ^= 1;
    repair_bytes(&changed, "CHRT");
    ck_assert_int_eq(icc_chart_load(&loaded, b.n, changed.data, NULL, NULL), ICC_ERR_FORMAT);
    free(changed.data);
    free(b.data);
    icc_chart_free(chart);
}
END_TEST

/* The image of each vertex inside is moved out of the disc. */
START_TEST(false_discs_are_refused)
{
    icc_chart *chart = small_chart(1), *loaded;
    bytes b = chart_bytes(chart);
    const size_t n = facts_of(chart).n_mesh_vertices;
    for (size_t v = facts_of(chart).n_mesh_boundary; v < n; ++v) {
        unsigned char *image = b.data + b.n - 16 * (n - v), old[16];
        memcpy(old, image, 16);
        memset(image, 0, 16);
        image[7] = image[15] = 0x40;
        repair_bytes(&b, "CHRT");
        ck_assert_int_eq(icc_chart_load(&loaded, b.n, b.data, NULL, NULL), ICC_ERR_FORMAT);
        memcpy(image, old, 16);
    }
    free(b.data);
    icc_chart_free(chart);
}
END_TEST

/* Leaves go back through one simplex, or leave it through fewer sides than they could. */
START_TEST(false_directions_are_refused)
{
    for (int k = 4; k < N_SMALL; ++k) {
        icc_chart *chart = small_chart(k), *loaded;
        bytes b = chart_bytes(chart), changed = {b.n, saved_alloc(b.n)};
        const size_t n = facts_of(chart).n_mesh_simplices;
        for (size_t side = 0; side < 4 * n; ++side) {
            const size_t at = b.n - 8 * (4 * n - side);
            memcpy(changed.data, b.data, b.n);
            for (size_t i = 0; i < 4 && side % 4 == 0; ++i)
                changed.data[at + 8 * i + 7] ^= 0x80;
            if (side % 4 != 0)
                memset(changed.data + at, 0, 8);
            repair_bytes(&changed, "CHRT");
            ck_assert_int_eq(icc_chart_load(&loaded, b.n, changed.data, NULL, NULL),
                             ICC_ERR_FORMAT);
        }
        free(changed.data);
        free(b.data);
        icc_chart_free(chart);
    }
}
END_TEST

static double get_number(const bytes *b, size_t at)
{
    const uint64_t bits = get64(b, at);
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static void put_number(bytes *b, size_t at, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    put64(b, at, bits);
}

/* Where leaves go out through two sides, they go out through one: nothing goes round, but what
 * enters the simplex behind the other one comes from nowhere. */
START_TEST(leaves_from_nowhere_are_refused)
{
    random_source r = {8};
    icc_chart *chart = chart_with(filled(mesh_cube(3, 3, 0.1, &r)), 0, 0), *loaded;
    bytes b = chart_bytes(chart), changed = {b.n, saved_alloc(b.n)};
    const size_t n = facts_of(chart).n_mesh_simplices;
    int n_tried = 0;
    for (size_t s = 0; s < n; ++s) {
        const size_t at = b.n - 32 * (n - s);
        size_t out[4], n_out = 0;
        for (size_t i = 0; i < 4; ++i)
            if (get_number(&b, at + 8 * i) < 0)
                out[n_out++] = at + 8 * i;
        if (n_out != 2)
            continue;
        memcpy(changed.data, b.data, b.n);
        for (size_t i = 0; i < 4; ++i)
            put_number(&changed, at + 8 * i, 0.5 * get_number(&b, at + 8 * i));
        put_number(&changed, out[0], -1);
        put_number(&changed, out[1], 0.5);
        repair_bytes(&changed, "CHRT");
        ck_assert_int_eq(icc_chart_load(&loaded, b.n, changed.data, NULL, NULL), ICC_ERR_FORMAT);
        ++n_tried;
    }
    ck_assert_int_gt(n_tried, 0);
    free(changed.data);
    free(b.data);
    icc_chart_free(chart);
}
END_TEST

/* The chart's own mesh, of a domain without vertices inside: each simplex with two corners
 * exchanged, or one corner of another. */
START_TEST(false_fillings_are_refused)
{
    icc_chart *chart = small_chart(5), *loaded;
    bytes b = chart_bytes(chart), changed = {b.n, saved_alloc(b.n)};
    const size_t n = facts_of(chart).n_mesh_simplices, corners = b.n - 8 - (32 + 16) * n;
    for (size_t s = 0; s < n; ++s)
        for (int other = 0; other < 2; ++other) {
            const size_t at = corners + 16 * s;
            memcpy(changed.data, b.data, b.n);
            memcpy(changed.data + at, b.data + (other ? corners + 16 * ((s + 1) % n) : at + 4), 4);
            if (!other)
                memcpy(changed.data + at + 4, b.data + at, 4);
            if (memcmp(changed.data, b.data, b.n) == 0)
                continue;
            repair_bytes(&changed, "CHRT");
            ck_assert_int_eq(icc_chart_load(&loaded, b.n, changed.data, NULL, NULL),
                             ICC_ERR_FORMAT);
        }
    free(changed.data);
    free(b.data);
    icc_chart_free(chart);
}
END_TEST

/* A chart on a grid that comes out otherwise is not passed off as the first one. */
START_TEST(another_digest_is_another_version)
{
    icc_error err = {.size = sizeof err};
    for (int k = 2; k < 4; ++k) {
        icc_chart *chart = small_chart(k), *loaded;
        bytes b = chart_bytes(chart);
        b.data[b.n - 1] ^= 1;
        repair_bytes(&b, "CHRT");
        ck_assert_int_eq(icc_chart_load(&loaded, b.n, b.data, NULL, &err), ICC_ERR_VERSION);
        ck_assert_ptr_null(loaded);
        ck_assert_ptr_nonnull(strstr(err.message, "differs"));
        free(b.data);
        icc_chart_free(chart);
    }
}
END_TEST

/* ---- failures ---- */

static icc_status load_bytes(const icc_env *env, icc_error *err, void *argument)
{
    const bytes *b = argument;
    icc_chart *chart;
    const icc_status status = icc_chart_load(&chart, b->n, b->data, env, err);
    ck_assert((chart != NULL) == (status == ICC_OK));
    icc_chart_free(chart);
    return status;
}

START_TEST(no_memory_and_no_patience)
{
    for (int k = 0; k < N_SMALL; ++k) {
        icc_chart *chart = small_chart(k);
        bytes b = chart_bytes(chart);
        faulty_sweep(load_bytes, &b);
        free(b.data);
        icc_chart_free(chart);
    }
}
END_TEST

START_TEST(arguments)
{
    icc_chart *chart = small_chart(0), *loaded = chart;
    bytes b = chart_bytes(chart);
    size_t n;
    ck_assert_int_eq(icc_chart_save(NULL, 0, NULL, &n), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_chart_save(chart, 0, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_chart_save(chart, 1, NULL, &n), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_chart_load(NULL, b.n, b.data, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_chart_load(&loaded, b.n, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(loaded);
    free(b.data);
    icc_chart_free(chart);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("chart file");
    TCase *c = tcase_create("chart file");
    tcase_add_test(c, polygons);
    tcase_add_test(c, hard_polygons);
    tcase_add_test(c, facets_as_given);
    tcase_add_test(c, all_options);
    tcase_add_test(c, masks);
    tcase_add_test(c, surfaces);
    tcase_add_test(c, meshes);
    tcase_add_test(c, signs_of_zeros);
    tcase_add_test(c, mesh_beside_polygon);
    tcase_add_test(c, damage_is_noticed);
    tcase_add_test(c, capacity);
    tcase_add_test(c, later_versions);
    tcase_add_test(c, content_is_checked);
    tcase_add_test(c, false_foliations_are_refused);
    tcase_add_test(c, false_discs_are_refused);
    tcase_add_test(c, false_directions_are_refused);
    tcase_add_test(c, leaves_from_nowhere_are_refused);
    tcase_add_test(c, false_fillings_are_refused);
    tcase_add_test(c, another_digest_is_another_version);
    tcase_add_test(c, no_memory_and_no_patience);
    tcase_add_test(c, arguments);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
