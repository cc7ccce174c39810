/* Maps as bytes: what is loaded is what was saved, goes on as that would, and nothing else is
 * loaded. */
#include "../../domains.h"
#include "../../faulty.h"
#include "../../feature_pairs.h"
#include "../../flat_mesh.h"
#include "../../hard_shapes.h"
#include "../../meshes.h"
#include "../../saved.h"
#include "../../shape_domains.h"
#include "../../share.h"
#include "../../suite.h"
#include "../../surfaces.h"

static const int32_t METHODS[] = {ICC_METHOD_FOLIATION, ICC_METHOD_DISC, ICC_METHOD_GRADIENT,
                                  ICC_METHOD_FIELD};
enum { N_METHODS = 4 };

/* Somewhat bent, by an amount. */
static void bend(shape *s, double amount)
{
    for (size_t k = 0; k < s->n; ++k) {
        double *p = s->xy + 2 * k;
        const double x = p[0], y = p[1];
        p[0] = x + amount * sin(y);
        p[1] = 0.8 * y - amount * x * x / 4;
    }
}

static domain_pair bent_pair(const shape *s)
{
    shape moved = *s;
    bend(&moved, 0.2);
    return (domain_pair){domain_of_shape(s), domain_of_shape(&moved)};
}

static icc_map *map_of(const domain_pair *p, int32_t kind, int32_t method, int32_t cells,
                       int32_t iterations)
{
    const icc_chart_options chart = {.size = sizeof chart, .method = method, .cells = cells};
    const icc_map_options options = {
        .size = sizeof options, .kind = kind, .iterations = iterations, .chart = &chart};
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, p->source, p->target, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return map;
}

static icc_map *load(const bytes *b)
{
    icc_map *loaded;
    icc_error err = {.size = sizeof err};
    const icc_env threads = {.size = sizeof threads, .threads = 3};
    ck_assert_msg(icc_map_load(&loaded, b->n, b->data, &threads, &err) == ICC_OK, "%s",
                  err.message);
    return loaded;
}

static void check_map(const icc_map *map, const icc_domain *source)
{
    bytes b = map_bytes(map);
    icc_map *loaded = load(&b);
    same_map(map, loaded, source);
    bytes again = map_bytes(loaded);
    ck_assert_uint_eq(again.n, b.n);
    ck_assert_same(again.data, b.data, b.n, "what is saved again");
    free(b.data);
    free(again.data);
    icc_map_free(loaded);
}

/* ---- every kind ---- */

START_TEST(curves)
{
    for (int turn = 0; turn < 2; ++turn)
        for (int m = 0; m < N_METHODS; ++m) {
            const shape l = shape_l(), other = shape_reversed(&l);
            domain_pair p = bent_pair(turn == 0 ? &l : &other);
            icc_map *map = map_of(&p, ICC_MAP_CURVES, METHODS[m], 14, 0);
            ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_CURVES);
            check_map(map, p.source);
            icc_map_free(map);
            domain_pair_free(&p);
        }
}
END_TEST

START_TEST(plane_meshes)
{
    for (int k = 0; k < N_SHAPES - 1; ++k)
        for (int m = 0; m < 2; ++m) {
            const shape s = shape_number(k), r = shape_reversed(&s);
            domain_pair p = bent_pair(k % 2 == 0 ? &s : &r);
            icc_map *map = map_of(&p, ICC_MAP_MESH, METHODS[m], 0, k % 3 == 0 ? -1 : 3);
            check_map(map, p.source);
            icc_map_free(map);
            domain_pair_free(&p);
        }
}
END_TEST

/* Where boundaries are so near each other that places on them can hardly be distinguished. */
START_TEST(hard_meshes)
{
    int n = 0;
    for (int k = 0; k < N_HARD_SHAPES; ++k) {
        const shape s = shape_hard(k);
        const icc_map_options options = {
            .size = sizeof options, .kind = ICC_MAP_MESH, .iterations = 2};
        domain_pair p = {domain_of_shape(&s), NULL};
        icc_map *map = NULL;
        shape moved = shape_moved(&s, 3, 1, 2);
        if (k % 2 == 1)
            bend(&moved, 0.02);
        if (icc_domain_create(&p.target, 2, moved.n, moved.xy, 0, NULL, NULL, NULL) == ICC_OK &&
            icc_map_create(&map, p.source, p.target, &options, NULL, NULL) == ICC_OK) {
            check_map(map, p.source);
            n += info_of_map(map).kind == ICC_MAP_MESH;
            icc_map_free(map);
        }
        domain_pair_free(&p);
    }
    ck_assert_int_gt(n, 8);
}
END_TEST

/* Shapes so different that only compatible triangulations are a start. */
START_TEST(far_meshes)
{
    const shape s = shape_spiral(40, 2.5);
    shape round = s;
    for (size_t k = 0; k < s.n; ++k) {
        round.xy[2 * k] = cos(6.283185307179586 * (double)k / (double)s.n);
        round.xy[2 * k + 1] = sin(6.283185307179586 * (double)k / (double)s.n);
    }
    domain_pair p = {domain_of_shape(&s), domain_of_shape(&round)};
    icc_map *map = map_of(&p, ICC_MAP_MESH, 0, 0, 2);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_MESH);
    check_map(map, p.source);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

static domain_pair feature_pair(int k)
{
    plan source, target;
    plans_number(k, &source, &target);
    return (domain_pair){plan_domain(&source), plan_domain(&target)};
}

static icc_map *feature_map(const domain_pair *p, int32_t iterations)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, p->source, p->target, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return map;
}

/* Holes, lines and points inside, there and back. */
START_TEST(features)
{
    for (int k = 0; k < N_PLANS; ++k)
        for (int turn = 0; turn < 2; ++turn) {
            domain_pair p = feature_pair(k);
            const domain_pair used = turn == 0 ? p : (domain_pair){p.target, p.source};
            icc_map *map = feature_map(&used, k % 2 == 0 ? 0 : -1);
            check_map(map, used.source);
            icc_map_free(map);
            domain_pair_free(&p);
        }
}
END_TEST

/* Loaded maps are improved and follow as the first ones do. */
START_TEST(features_go_on)
{
    for (int k = 0; k < N_PLANS; ++k) {
        plan source, target;
        plans_number(k, &source, &target);
        domain_pair p = {plan_domain(&source), plan_domain(&target)};
        icc_map *map = feature_map(&p, 0), *better[2], *next[2];
        bytes b = map_bytes(map);
        icc_map *loaded = load(&b);
        const icc_improve_options options = {.size = sizeof options, .iterations = 3, .levels = 2};
        ck_assert_int_eq(icc_map_improve(&better[0], map, &options, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_improve(&better[1], loaded, &options, NULL, NULL, NULL), ICC_OK);
        same_map(better[0], better[1], p.source);
        check_map(better[0], p.source);
        target.xy[2 * target.n_outer] += 0.01 * (target.xy[2] - target.xy[0]);
        icc_domain *further = plan_domain(&target);
        ck_assert_int_eq(icc_map_retarget(&next[0], map, further, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_retarget(&next[1], loaded, further, NULL, NULL, NULL), ICC_OK);
        same_map(next[0], next[1], p.source);
        check_map(next[0], p.source);
        for (int i = 0; i < 2; ++i) {
            icc_map_free(better[i]);
            icc_map_free(next[i]);
        }
        free(b.data);
        icc_map_free(loaded);
        icc_map_free(map);
        icc_domain_free(further);
        domain_pair_free(&p);
    }
}
END_TEST

/* A loaded map is improved, follows and derives as the first one does. */
START_TEST(it_goes_on)
{
    for (int turn = 0; turn < 2; ++turn) {
        const shape e = shape_e(), back = shape_reversed(&e);
        shape further = turn == 0 ? e : back;
        domain_pair p = bent_pair(&further);
        bend(&further, 0.23);
        icc_domain *target = domain_of_shape(&further);
        icc_map *map = map_of(&p, ICC_MAP_MESH, 0, 8, -1), *next[2], *better[2];
        bytes b = map_bytes(map);
        icc_map *loaded = load(&b);
        const icc_improve_options options = {.size = sizeof options, .iterations = 3, .levels = 2};
        ck_assert_int_eq(icc_map_improve(&better[0], map, &options, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_improve(&better[1], loaded, &options, NULL, NULL, NULL), ICC_OK);
        ck_assert(info_of_map(better[0]).n_vertices > info_of_map(map).n_vertices);
        same_map(better[0], better[1], p.source);
        check_map(better[0], p.source);
        for (int k = 0; k < 2; ++k)
            ck_assert_int_eq(
                icc_map_retarget(
                    &next[k], better[k], target,
                    &(icc_retarget_options){.size = sizeof(icc_retarget_options), .iterations = 2},
                    NULL, NULL),
                ICC_OK);
        same_map(next[0], next[1], p.source);
        ck_assert_ptr_null(icc_map_source_chart(next[0]));
        check_map(next[0], p.source);
        for (int k = 0; k < 2; ++k) {
            icc_map_free(next[k]);
            icc_map_free(better[k]);
        }
        free(b.data);
        icc_map_free(loaded);
        icc_map_free(map);
        icc_domain_free(target);
        domain_pair_free(&p);
    }
}
END_TEST

/* ---- space ---- */

static void twist(int32_t dim, const double *x, double *y)
{
    y[0] = x[0] + 0.3 * sin(x[1]);
    y[1] = x[1] + 0.2 * x[0];
    for (int32_t k = 2; k < dim; ++k)
        y[k] = 1.5 * x[k] - 0.07 * x[0] * x[1];
}

static domain_pair filled_pair(int32_t dim, size_t n)
{
    random_source r = {1};
    test_mesh before = mesh_cube(dim, n, 0.1, &r), other = mesh_cube(dim, n, 0.1, &r);
    test_mesh after = mesh_moved(&other, twist);
    domain_pair p;
    ck_assert_int_eq(mesh_domain(&p.source, &before, NULL, NULL), ICC_OK);
    ck_assert_int_eq(mesh_domain(&p.target, &after, NULL, NULL), ICC_OK);
    mesh_free(&before);
    mesh_free(&other);
    mesh_free(&after);
    return p;
}

START_TEST(filled)
{
    for (int32_t dim = 2; dim <= 4; ++dim) {
        domain_pair p = filled_pair(dim, 3);
        icc_map *map = map_of(&p, 0, 0, 0, 0);
        ck_assert_int_eq(info_of_map(map).kind, dim == 2 ? ICC_MAP_CURVES : ICC_MAP_MESH);
        check_map(map, p.source);
        icc_map_free(map);
        map = map_of(&p, ICC_MAP_CURVES, 0, 0, 0);
        ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_CURVES);
        check_map(map, p.source);
        icc_map_free(map);
        domain_pair_free(&p);
    }
}
END_TEST

/* A corner of the cube pressed in beyond the diagonal that all tetrahedra of the source share: its
 * map has a mesh of its own. The target is filled from one point inside. */
static icc_domain *dented_cube(const icc_domain *cube)
{
    static const double VERTICES[27] = {0.28, 0.26, -0.18, 0.56,  0.42, 0.48, 0.11, 1.17, -0.09,
                                        0.74, 0.80, -0.17, -0.02, 0.21, 1.19, 1.30, 0.09, 0.86,
                                        0.14, 0.76, 0.99,  0.95,  1.21, 1.23, 0.37, 0.40, 0.69};
    uint32_t facets[36], simplices[48];
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_get_boundary(cube, NULL, facets), ICC_OK);
    for (size_t f = 0; f < 12; ++f) {
        memcpy(simplices + 4 * f, facets + 3 * f, 3 * sizeof *facets);
        simplices[4 * f + 3] = 8;
    }
    ck_assert_int_eq(
        flat_create_mesh(&domain, 3, 9, VERTICES, 12, simplices, 12, facets, NULL, NULL), ICC_OK);
    return domain;
}

START_TEST(cut_chords)
{
    test_mesh cube = mesh_cells(3, 1, NULL);
    domain_pair p;
    ck_assert_int_eq(mesh_domain(&p.source, &cube, NULL, NULL), ICC_OK);
    p.target = dented_cube(p.source);
    icc_map *map = map_of(&p, ICC_MAP_MESH, 0, 0, 0);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_MESH);
    ck_assert_uint_gt(info_of_map(map).n_simplices, cube.n_simplices);
    check_map(map, p.source);
    /* A point of that mesh outside of the source, its image where it was: bytes end with points,
     * corners and images. */
    const icc_map_info info = info_of_map(map);
    const size_t n_inner = info.n_vertices - 8;
    bytes b = map_bytes(map);
    icc_map *loaded;
    unsigned char *point = b.data + b.n - 48 * n_inner - 16 * info.n_simplices;
    memset(point, 0, 8);
    point[7] = 0x40;
    repair_bytes(&b, "MAP_");
    ck_assert_int_eq(icc_map_load(&loaded, b.n, b.data, NULL, NULL), ICC_ERR_FORMAT);
    free(b.data);
    icc_map_free(map);
    domain_pair_free(&p);
    mesh_free(&cube);
}
END_TEST

START_TEST(surfaces)
{
    static surface s;
    random_source r = {3};
    domain_pair p;
    surface_octahedron(&s);
    surface_star(&s, 1, 0.2, &r);
    for (int m = 2; m < N_METHODS; ++m) {
        ck_assert_int_eq(icc_domain_create(&p.source, 3, s.n_vertices, s.vertices, s.n_faces,
                                           s.faces, NULL, NULL),
                         ICC_OK);
        for (size_t v = 0; v < s.n_vertices; ++v)
            s.vertices[3 * v] *= 1.25;
        ck_assert_int_eq(icc_domain_create(&p.target, 3, s.n_vertices, s.vertices, s.n_faces,
                                           s.faces, NULL, NULL),
                         ICC_OK);
        icc_map *map = map_of(&p, 0, METHODS[m], 10, 0);
        check_map(map, p.source);
        icc_map_free(map);
        domain_pair_free(&p);
    }
}
END_TEST

/* ---- bytes that are not those of a map ---- */

enum { N_SMALL = 6 };

/* A line leads from the outer ring to a hole, and another one from there to a joint. */
static domain_pair network_pair(void)
{
    plan source = plan_square(4);
    plan_feature(&source, ICC_FEATURE_HOLE, 3, (const double[]){1, 1, 2, 1, 1, 2});
    plan_feature(&source, ICC_FEATURE_LINE, 2, (const double[]){0, 0, 1, 1});
    plan_feature(&source, ICC_FEATURE_LINE, 3, (const double[]){2, 1, 3, 2, 4, 4});
    plan_feature(&source, ICC_FEATURE_LINE, 2, (const double[]){3, 2, 2, 3});
    plan target = source;
    target.xy[2 * 10] += 0.3;
    target.xy[2 * 12] += 0.3;
    return (domain_pair){plan_domain(&source), plan_domain(&target)};
}

static icc_map *small_map(int k, domain_pair *p)
{
    const shape s = shape_dart();
    if (k == 3) {
        *p = filled_pair(3, 2);
        return map_of(p, ICC_MAP_MESH, 0, 0, 0);
    }
    if (k == 4) {
        *p = feature_pair(1);
        return feature_map(p, -1);
    }
    if (k == 5) {
        *p = network_pair();
        return feature_map(p, -1);
    }
    *p = bent_pair(&s);
    if (k == 0)
        return map_of(p, ICC_MAP_MESH, ICC_METHOD_DISC, 4, -1);
    if (k == 1)
        return map_of(p, ICC_MAP_CURVES, ICC_METHOD_FIELD, 6, 0);
    icc_map *map = map_of(p, ICC_MAP_MESH, 0, 4, -1), *next;
    ck_assert_int_eq(icc_map_retarget(&next, map, p->target,
                                      &(icc_retarget_options){.size = sizeof(icc_retarget_options),
                                                              .iterations = -1},
                                      NULL, NULL),
                     ICC_OK);
    icc_map_free(map);
    return next;
}

static icc_status load_map(const bytes *b, icc_error *err)
{
    icc_map *loaded;
    const icc_status status = icc_map_load(&loaded, b->n, b->data, NULL, err);
    ck_assert((loaded != NULL) == (status == ICC_OK));
    icc_map_free(loaded);
    return status;
}

START_TEST(damage_is_noticed)
{
    for (int k = 0; k < N_SMALL; ++k) {
        domain_pair p;
        icc_map *map = small_map(k, &p);
        bytes b = map_bytes(map);
        check_damage(&b, load_map);
        free(b.data);
        icc_map_free(map);
        domain_pair_free(&p);
    }
}
END_TEST

/* Bytes of maps without features are of version 1, those of others that do not slide of version 4,
 * and of no other.
 * Version 3 is for charts of functions: property/test_chart_function. */
START_TEST(versions)
{
    for (int k = 0; k < N_SMALL; ++k) {
        domain_pair p;
        icc_map *map = small_map(k, &p), *again;
        bytes b = map_bytes(map);
        for (uint32_t version = 0; version < 7; ++version) {
            iccp_blob w;
            size_t n;
            iccp_blob_begin(&w, b.data, b.n, "MAP_", version);
            w.at = b.n;
            iccp_blob_end(&w, &n);
            const icc_status expected = version == (k >= 4 ? 4 : 1) ? ICC_OK
                                        : version == 6              ? ICC_ERR_VERSION
                                                                    : ICC_ERR_FORMAT;
            ck_assert_int_eq(icc_map_load(&again, b.n, b.data, NULL, NULL), expected);
            icc_map_free(again);
        }
        free(b.data);
        icc_map_free(map);
        domain_pair_free(&p);
    }
}
END_TEST

/* A map of version 2: a triangle with a line and a point, onto itself. */
static const char APART[] =
    "4c4943434d41505f020000001fb07f43c803000000000000020000000000000002000000040000000300"
    "000000000000020000000000000002000000020000000300000001000000000000000000000000000000"
    "000000000000000000001040000000000000000000000000000000000000000000001040000000000000"
    "f03f000000000000f03f0000000000000040000000000000f03f000000000000f03f0000000000000040"
    "020000000400000003000000000000000200000000000000020000000200000003000000010000000000"
    "000000000000000000000000000000000000000010400000000000000000000000000000000000000000"
    "00001040000000000000f03f000000000000f03f0000000000000040000000000000f03f000000000000"
    "f03f00000000000000400000000000000000000000000000000000000000000000000100000000000000"
    "0000000000001040000000000000104001000000010000000a000000000000000f000000000000000000"
    "0000000000000000000000000000000000000000e03f0000000000000000000000000000000000000000"
    "0000e03f000000000000c03f000000000000c03f000000000000c03f000000000000d03f000000000000"
    "d03f000000000000c03f000000000000d83f000000000000b03f000000000000c83f000000000000c83f"
    "000000000000b03f000000000000c03f000000000000b03f000000000000d83f00000000000000000000"
    "000000000000000000000000e03f00000000000000000000000000000000000000000000e03f00000000"
    "0000c03f000000000000c03f000000000000c03f000000000000d03f000000000000d03f000000000000"
    "c03f000000000000d83f000000000000b03f000000000000c83f000000000000c83f000000000000b03f"
    "000000000000c03f000000000000b03f000000000000d83f030000000800000006000000070000000300"
    "000005000000020000000700000006000000080000000200000000000000020000000900000007000000"
    "030000000600000005000000010000000600000000000000060000000800000000000000020000000600"
    "000001000000080000000700000004000000090000000800000004000000060000000700000005000000"
    "070000000900000004000000080000000900000002000000070000000800000003000000000000000000"
    "000000000000010000000000000000000000020000000000000000000000030000000000000003000000"
    "030000000000000000000000040000000400000000000000000000000500000003000000000000000000"
    "f03f";

/* Features did not touch then. Saved again, such a map has version 4. */
START_TEST(maps_of_features_apart)
{
    static const double points[] = {1, 1, 2, 1, 1, 2, 0.5, 0.5, 4, 0};
    bytes b = {sizeof APART / 2, saved_alloc(sizeof APART)};
    double found[10];
    for (size_t i = 0; i < b.n; ++i) {
        const char byte[] = {APART[2 * i], APART[2 * i + 1], 0};
        b.data[i] = (unsigned char)strtoul(byte, NULL, 16);
    }
    ck_assert_int_eq(b.data[8], 2);
    icc_map *map = load(&b), *again;
    ck_assert_int_eq(info_of_map(map).certified, 1);
    ck_assert_uint_eq(info_of_map(map).n_ties, 2);
    ck_assert_int_eq(icc_map_apply(map, 5, points, found, NULL, NULL, NULL), ICC_OK);
    for (int i = 0; i < 10; ++i)
        ck_assert_double_eq_tol(found[i], points[i], 1e-14);
    bytes later = map_bytes(map);
    ck_assert_int_eq(later.data[8], 4);
    again = load(&later);
    icc_map_free(again);
    icc_map_free(map);
    /* The last vertex that is held lies elsewhere on its line, then on another facet. */
    for (size_t back = 1; back < 16; back += 8) {
        b.data[b.n - back] ^= 1;
        repair_bytes(&b, "MAP_");
        ck_assert_int_eq(icc_map_load(&map, b.n, b.data, NULL, NULL), ICC_ERR_FORMAT);
        b.data[b.n - back] ^= 1;
    }
    free(later.data);
    free(b.data);
}
END_TEST

static void check_harmless(const bytes *b, const icc_domain *source)
{
    static images found;
    double points[SAVED_POINTS * ICC_MAX_DIM];
    icc_map *loaded;
    const icc_status status = icc_map_load(&loaded, b->n, b->data, NULL, NULL);
    ck_assert(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION);
    ck_assert((loaded != NULL) == (status == ICC_OK));
    if (loaded == NULL)
        return;
    saved_points(source, 5, points);
    find_images(loaded, points, &found);
    bytes again = map_bytes(loaded);
    ck_assert_uint_eq(again.n, b->n);
    ck_assert_same(again.data, b->data, b->n, "what is saved again");
    free(again.data);
    icc_map_free(loaded);
}

START_TEST(content_is_checked)
{
    random_source r = {6};
    for (int k = 0; k < N_SMALL; ++k) {
        domain_pair p;
        icc_map *map = small_map(k, &p);
        bytes b = map_bytes(map), changed = {b.n, saved_alloc(b.n)};
        for (int i = 0; i < share_of(k == 1 ? 200 : 3000); ++i) {
            make_up_content(&changed, &b, "MAP_", &r);
            check_harmless(&changed, p.source);
        }
        free(b.data);
        free(changed.data);
        icc_map_free(map);
        domain_pair_free(&p);
    }
}
END_TEST

/* The last bytes of a map of kind mesh say where its boundary vertices lie; before them are the
 * triangles. */
START_TEST(false_meshes_are_refused)
{
    domain_pair p;
    icc_map *map = small_map(0, &p), *loaded;
    const icc_map_info info = info_of_map(map);
    const size_t n_boundary = 2 * info.n_vertices - info.n_simplices - 2;
    bytes b = map_bytes(map), changed = {b.n, saved_alloc(b.n)};
    const size_t boundary = b.n - 12 * n_boundary, triangles = boundary - 12 * info.n_simplices;
    const size_t image = triangles - 16 * info.n_vertices;
    for (size_t at = boundary; at < b.n; ++at) {
        memcpy(changed.data, b.data, b.n);
        changed.data[at] ^= (at - boundary) % 12 < 4 ? 1 : 0x40;
        repair_bytes(&changed, "MAP_");
        const icc_status status = icc_map_load(&loaded, b.n, changed.data, NULL, NULL);
        /* The lowest bits of where on its facet a vertex lies are lost in the tolerance. */
        if ((at - boundary) % 12 < 4 || (at - boundary) % 12 > 5)
            ck_assert_int_eq(status, ICC_ERR_FORMAT);
        icc_map_free(loaded);
    }
    for (size_t t = triangles; t < boundary; t += 12) {
        memcpy(changed.data, b.data, b.n);
        memcpy(changed.data + t, b.data + t + 4, 4);
        memcpy(changed.data + t + 4, b.data + t, 4);
        repair_bytes(&changed, "MAP_");
        ck_assert_int_eq(icc_map_load(&loaded, b.n, changed.data, NULL, NULL), ICC_ERR_FORMAT);
    }
    /* Vertex 0 is on the boundary. */
    memcpy(changed.data, b.data, b.n);
    changed.data[image + 5] ^= 0x10;
    repair_bytes(&changed, "MAP_");
    ck_assert_int_eq(icc_map_load(&loaded, b.n, changed.data, NULL, NULL), ICC_ERR_FORMAT);
    free(changed.data);
    free(b.data);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

/* The last image is moved out of the target: tetrahedra are inverted. */
START_TEST(false_images_in_space_are_refused)
{
    domain_pair p;
    icc_map *map = small_map(3, &p), *loaded;
    bytes b = map_bytes(map);
    for (size_t i = 0; i < 3; ++i) {
        unsigned char *x = b.data + b.n - 8 * (i + 1), old[8];
        memcpy(old, x, 8);
        memset(x, 0, 7);
        x[7] = 0x40;
        repair_bytes(&b, "MAP_");
        ck_assert_int_eq(icc_map_load(&loaded, b.n, b.data, NULL, NULL), ICC_ERR_FORMAT);
        memcpy(x, old, 8);
    }
    repair_bytes(&b, "MAP_");
    ck_assert_int_eq(icc_map_load(&loaded, b.n, b.data, NULL, NULL), ICC_OK);
    icc_map_free(loaded);
    free(b.data);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

/* ---- failures ---- */

static icc_status load_bytes(const icc_env *env, icc_error *err, void *argument)
{
    const bytes *b = argument;
    icc_map *map;
    const icc_status status = icc_map_load(&map, b->n, b->data, env, err);
    ck_assert((map != NULL) == (status == ICC_OK));
    icc_map_free(map);
    return status;
}

START_TEST(no_memory_and_no_patience)
{
    for (int k = 0; k < N_SMALL; ++k) {
        domain_pair p;
        icc_map *map = small_map(k, &p);
        bytes b = map_bytes(map);
        faulty_sweep(load_bytes, &b);
        free(b.data);
        icc_map_free(map);
        domain_pair_free(&p);
    }
}
END_TEST

START_TEST(arguments)
{
    domain_pair p;
    icc_map *map = small_map(0, &p), *loaded = map;
    bytes b = map_bytes(map);
    size_t n;
    ck_assert_int_eq(icc_map_save(NULL, 0, NULL, &n), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_map_save(map, 0, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_map_save(map, 1, NULL, &n), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_map_save(map, b.n - 1, b.data, &n), ICC_OK);
    ck_assert_uint_eq(n, b.n);
    ck_assert_int_eq(icc_map_load(NULL, b.n, b.data, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_map_load(&loaded, b.n, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(loaded);
    free(b.data);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("map file");
    TCase *c = tcase_create("map file");
    tcase_add_test(c, curves);
    tcase_add_test(c, plane_meshes);
    tcase_add_test(c, hard_meshes);
    tcase_add_test(c, far_meshes);
    tcase_add_test(c, features);
    tcase_add_test(c, features_go_on);
    tcase_add_test(c, it_goes_on);
    tcase_add_test(c, filled);
    tcase_add_test(c, cut_chords);
    tcase_add_test(c, surfaces);
    tcase_add_test(c, damage_is_noticed);
    tcase_add_test(c, versions);
    tcase_add_test(c, maps_of_features_apart);
    tcase_add_test(c, content_is_checked);
    tcase_add_test(c, false_meshes_are_refused);
    tcase_add_test(c, false_images_in_space_are_refused);
    tcase_add_test(c, no_memory_and_no_patience);
    tcase_add_test(c, arguments);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
