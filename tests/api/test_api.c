/* Bad arguments, and the rules of structs that begin with their size. */
#include "../flat_mesh.h"
#include "objects.h"

#include "../suite.h"

#include <stdbool.h>
#include <stdio.h>

#define REFUSED(call) ck_assert_int_eq((call), ICC_ERR_ARGUMENT)

/* A refusal that must also be explained. */
#define EXPLAINED(call)                                                                            \
    do {                                                                                           \
        err = (icc_error){.size = sizeof err};                                                     \
        REFUSED(call);                                                                             \
        ck_assert(err.status == ICC_ERR_ARGUMENT && err.message[0] != '\0');                       \
    } while (0)

/* The same, of a creator, which must also reset its out. */
#define NOT_MADE(object, call)                                                                     \
    do {                                                                                           \
        (object) = (void *)&err;                                                                   \
        EXPLAINED(call);                                                                           \
        ck_assert_ptr_null(object);                                                                \
    } while (0)

/* A size of 0 is refused: of any struct by name, and even of the error's own. */
START_TEST(a_struct_without_its_size_is_refused_by_name)
{
    objects o;
    objects_init(&o, 0);
    icc_error err = ICC_INIT(icc_error), unsized = {0};
    ck_assert_uint_eq(err.size, sizeof err);
    const icc_map_options options = {.kind = ICC_MAP_MESH};
    icc_map *m;
    REFUSED(icc_map_create(&m, o.source, o.target, &options, NULL, &err));
    ck_assert_str_eq(err.message, "icc_map_options.size is not set (it is 0)");
    REFUSED(icc_map_create(&m, o.source, o.target, &options, NULL, &unsized));
    ck_assert_str_eq(unsized.message, err.message);
    ck_assert_uint_eq(unsized.size, 0);
    objects_clear(&o);
}
END_TEST

START_TEST(domains_refuse_bad_arguments)
{
    objects o;
    objects_init(&o, 0);
    icc_error err;
    icc_domain *d;
    EXPLAINED(icc_domain_create(NULL, 2, N_CORNERS, SOURCE, 0, NULL, NULL, &err));
    NOT_MADE(d, icc_domain_create(&d, 0, N_CORNERS, SOURCE, 0, NULL, NULL, &err));
    NOT_MADE(d, icc_domain_create(&d, 7, N_CORNERS, SOURCE, 0, NULL, NULL, &err));
    NOT_MADE(d, icc_domain_create(&d, 2, N_CORNERS, NULL, 0, NULL, NULL, &err));
    NOT_MADE(d, icc_domain_create(&d, 2, SIZE_MAX / 2, SOURCE, 0, NULL, NULL, &err));
    NOT_MADE(d, icc_domain_create(&d, 2, N_CORNERS, SOURCE, SIZE_MAX / 2, FACETS, NULL, &err));
    NOT_MADE(d, icc_domain_create(&d, 3, 4, SOURCE, 4, NULL, NULL, &err));
    for (size_t n = 0; n < 3; ++n) {
        err.status = ICC_OK;
        const icc_status status = icc_domain_create(&d, 2, n, SOURCE, 0, NULL, NULL, &err);
        ck_assert(status == ICC_ERR_ARGUMENT || status == ICC_ERR_BOUNDARY);
        ck_assert(err.status == status && d == NULL);
    }
    static const uint32_t WRONG[][2 * N_CORNERS] = {{0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6},
                                                    {0, 1, 1, 2, 2, 3, 3, 4, 5, 4, 5, 0},
                                                    {0, 1, 1, 2, 2, 0, 3, 4, 4, 5, 5, 3},
                                                    {0, 1, 0, 1, 2, 3, 3, 4, 4, 5, 5, 0}};
    for (size_t k = 0; k < sizeof WRONG / sizeof *WRONG; ++k) {
        err.status = ICC_OK;
        const icc_status status =
            icc_domain_create(&d, 2, N_CORNERS, SOURCE, N_CORNERS, WRONG[k], NULL, &err);
        ck_assert(status == ICC_ERR_BOUNDARY || status == ICC_ERR_ARGUMENT);
        ck_assert(err.status == status && err.index >= 0 && d == NULL);
    }
    icc_domain_info info = {.size = sizeof info};
    REFUSED(icc_domain_get_info(NULL, &info));
    REFUSED(icc_domain_get_info(o.source, NULL));
    REFUSED(icc_domain_get_boundary(NULL, o.points, o.facet));
    ck_assert_int_eq(icc_domain_get_boundary(o.source, NULL, NULL), ICC_OK);
    int32_t where[1];
    REFUSED(icc_domain_locate(NULL, 1, SOURCE, where, NULL, NULL, NULL));
    REFUSED(icc_domain_locate(o.source, 1, NULL, where, NULL, NULL, NULL));
    REFUSED(icc_domain_locate(o.source, 1, SOURCE, NULL, NULL, NULL, NULL));
    ck_assert_int_eq(icc_domain_locate(o.source, 0, NULL, NULL, NULL, NULL, NULL), ICC_OK);
    int32_t kinds[4];
    uint32_t items[8];
    size_t n;
    EXPLAINED(icc_boundary_defects(4, BOWTIE, 4, kinds, items, NULL, NULL, &err));
    EXPLAINED(icc_boundary_defects(4, BOWTIE, 4, NULL, items, &n, NULL, &err));
    EXPLAINED(icc_boundary_defects(4, BOWTIE, 4, kinds, NULL, &n, NULL, &err));
    EXPLAINED(icc_boundary_defects(4, NULL, 4, kinds, items, &n, NULL, &err));
    EXPLAINED(icc_boundary_defects(SIZE_MAX / 2, BOWTIE, 4, kinds, items, &n, NULL, &err));
    ck_assert_int_eq(icc_boundary_defects(4, BOWTIE, 0, NULL, NULL, &n, NULL, &err), ICC_OK);
    ck_assert_uint_ge(n, 1);
    objects_clear(&o);
}
END_TEST

START_TEST(fields_refuse_bad_arguments)
{
    objects o;
    objects_init(&o, 0);
    icc_error err;
    double values[32] = {0};
    icc_field_report r = {.size = sizeof r};
    const icc_field good = small_field(values);
    icc_field bad[] = {good, good, good, good, good, good};
    bad[0].dim = 4;
    bad[1].bytes = 2;
    bad[2].outside = 4;
    bad[3].shape[1] = 1;
    bad[4].shape[0] = SIZE_MAX / 2;
    bad[5].values = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        EXPLAINED(icc_field_certify(&bad[i], 0, NULL, NULL, &r, NULL, &err));
        EXPLAINED(icc_map_sample(o.mesh_map, 0, &bad[i], NULL, NULL, &err));
    }
    bad[0] = good;
    bad[0].step[3] = 0; /* both steps along x */
    EXPLAINED(icc_field_certify(&bad[0], 0, NULL, NULL, &r, NULL, &err));
    EXPLAINED(icc_field_certify(&good, 1, NULL, NULL, &r, NULL, &err));
    EXPLAINED(icc_field_certify(&good, 0, NULL, NULL, NULL, NULL, &err));
    EXPLAINED(icc_map_sample(o.mesh_map, 2, &good, NULL, NULL, &err));
    EXPLAINED(icc_map_sample(NULL, 0, &good, NULL, NULL, &err));
    ck_assert_int_eq(icc_field_certify(&good, 0, NULL, NULL, &r, NULL, &err), ICC_OK);
    ck_assert_int_eq(r.one_to_one, 1);
    objects_clear(&o);
}
END_TEST

START_TEST(charts_refuse_bad_arguments)
{
    objects o;
    objects_init(&o, 0);
    icc_error err;
    icc_chart *c;
    EXPLAINED(icc_chart_create(NULL, o.source, NULL, NULL, &err));
    NOT_MADE(c, icc_chart_create(&c, NULL, NULL, NULL, &err));
    static const double NOT_FINITE[2] = {0.5, NAN}, INSIDE[2] = {0.5, 0.5};
    static const int32_t TWICE[2] = {1, 1};
    const icc_chart_options bad[] = {
        {.size = sizeof *bad, .function = 7},
        {.size = sizeof *bad, .function = -1},
        {.size = sizeof *bad, .tree = 3},
        {.size = sizeof *bad, .tree = -1},
        {.size = sizeof *bad, .cells = 1},
        {.size = sizeof *bad, .cells = -50},
        {.size = sizeof *bad, .cells = 16385},
        {.size = sizeof *bad, .maximum = NOT_FINITE},
        {.size = sizeof *bad, .constraints = 4},
        {.size = sizeof *bad, .solver = 3},
        {.size = sizeof *bad, .min_fall = 0.02},
        {.size = sizeof *bad, .min_fall = NAN},
        {.size = sizeof *bad, .leaf_min = -1e-9},
        {.size = sizeof *bad, .method = ICC_METHOD_DISC, .maximum = INSIDE},
        {.size = sizeof *bad, .axis_order = TWICE},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        NOT_MADE(c, icc_chart_create(&c, o.source, &bad[k], NULL, &err));
        icc_map *m;
        const icc_map_options options = {.size = sizeof options, .chart = &bad[k]};
        NOT_MADE(m, icc_map_create(&m, o.source, o.target, &options, NULL, &err));
    }
    const icc_chart_options disc = {.size = sizeof disc, .method = ICC_METHOD_DISC};
    const icc_map_options target = {
        .size = sizeof target, .chart = &disc, .target_maximum = INSIDE};
    icc_map *map;
    NOT_MADE(map, icc_map_create(&map, o.source, o.target, &target, NULL, &err));
    static const int32_t UNKNOWN[] = {-1, 5, 99};
    for (int k = 0; k < 3; ++k) {
        const icc_chart_options options = {.size = sizeof options, .method = UNKNOWN[k]};
        ck_assert_int_eq(icc_chart_create(&c, o.source, &options, NULL, &err), ICC_ERR_UNSUPPORTED);
        ck_assert(c == NULL && err.status == ICC_ERR_UNSUPPORTED);
    }
    icc_chart_info info = {.size = sizeof info};
    REFUSED(icc_chart_get_info(NULL, &info));
    REFUSED(icc_chart_get_info(o.chart, NULL));
    EXPLAINED(icc_chart_create_function(NULL, o.field, NULL, &err));
    NOT_MADE(c, icc_chart_create_function(&c, NULL, NULL, &err));
    ck_assert_int_eq(icc_chart_create_function(&c, o.field, NULL, &err), ICC_ERR_UNSUPPORTED);
    ck_assert(c == NULL && err.status == ICC_ERR_UNSUPPORTED); /* a mask of vertices */
    ck_assert(icc_chart_function(NULL) == NULL && icc_chart_function(o.chart) == NULL); /* a
                                                                                           foliation */
    ck_assert_ptr_null(icc_chart_domain(NULL));
    ck_assert_ptr_eq(icc_chart_domain(o.chart), o.source);
    icc_chart_report m = {.size = sizeof m};
    EXPLAINED(icc_chart_get_report(NULL, 0, &m, NULL, &err));
    EXPLAINED(icc_chart_get_report(o.chart, 0, NULL, NULL, &err));
    EXPLAINED(icc_chart_get_report(o.chart, SIZE_MAX, &m, NULL, &err));
    ck_assert_int_eq(icc_chart_get_report(o.chart, 1, &m, NULL, NULL), ICC_OK);
    uint32_t f;
    double b[2], t, p[2] = {0.5, 0.5};
    REFUSED(icc_chart_encode(NULL, 1, p, &f, b, &t, NULL, NULL, NULL));
    REFUSED(icc_chart_encode(o.chart, 1, NULL, &f, b, &t, NULL, NULL, NULL));
    REFUSED(icc_chart_encode(o.chart, 1, p, NULL, b, &t, NULL, NULL, NULL));
    REFUSED(icc_chart_encode(o.chart, 1, p, &f, NULL, &t, NULL, NULL, NULL));
    REFUSED(icc_chart_encode(o.chart, 1, p, &f, b, NULL, NULL, NULL, NULL));
    size_t n = 7;
    ck_assert_int_eq(icc_chart_encode(o.chart, 0, NULL, NULL, NULL, NULL, NULL, &n, NULL), ICC_OK);
    ck_assert_uint_eq(n, 0);
    REFUSED(icc_chart_decode(NULL, 1, o.facet, o.bary, o.t, p, NULL, NULL, NULL));
    REFUSED(icc_chart_decode(o.chart, 1, NULL, o.bary, o.t, p, NULL, NULL, NULL));
    REFUSED(icc_chart_decode(o.chart, 1, o.facet, NULL, o.t, p, NULL, NULL, NULL));
    REFUSED(icc_chart_decode(o.chart, 1, o.facet, o.bary, NULL, p, NULL, NULL, NULL));
    REFUSED(icc_chart_decode(o.chart, 1, o.facet, o.bary, o.t, NULL, NULL, NULL, NULL));
    ck_assert_int_eq(icc_chart_decode(o.chart, 0, NULL, NULL, NULL, NULL, NULL, &n, NULL), ICC_OK);
    int32_t flags = 0;
    REFUSED(icc_chart_encode_flags(NULL, 1, p, &f, b, &t, NULL, &flags, NULL, NULL));
    REFUSED(icc_chart_encode_flags(o.chart, 1, p, NULL, b, &t, NULL, &flags, NULL, NULL));
    REFUSED(icc_chart_decode_flags(NULL, 1, o.facet, o.bary, o.t, p, NULL, &flags, NULL, NULL));
    REFUSED(
        icc_chart_decode_flags(o.chart, 1, o.facet, o.bary, o.t, NULL, NULL, &flags, NULL, NULL));
    REFUSED(icc_chart_save(NULL, 0, NULL, &n));
    REFUSED(icc_chart_save(o.chart, 0, NULL, NULL));
    REFUSED(icc_chart_save(o.chart, 1, NULL, &n));
    EXPLAINED(icc_chart_load(NULL, 1, p, NULL, &err));
    NOT_MADE(c, icc_chart_load(&c, 1, NULL, NULL, &err));
    EXPLAINED(icc_chart_trace(NULL, p, 0, NULL, &n, NULL, &err));
    EXPLAINED(icc_chart_trace(o.chart, NULL, 0, NULL, &n, NULL, &err));
    EXPLAINED(icc_chart_trace(o.chart, p, 0, NULL, NULL, NULL, &err));
    EXPLAINED(icc_chart_trace(o.chart, p, 1, NULL, &n, NULL, &err));
    EXPLAINED(icc_chart_trace(o.chart, NOT_FINITE, 0, NULL, &n, NULL, &err));
    const double outside[2] = {2, 2};
    ck_assert_int_eq(icc_chart_trace(o.chart, outside, 0, NULL, &n, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.status, ICC_ERR_OUTSIDE);
    objects_clear(&o);
}
END_TEST

START_TEST(maps_refuse_bad_arguments)
{
    objects o;
    objects_init(&o, 0);
    icc_error err;
    icc_map *m;
    EXPLAINED(icc_map_create(NULL, o.source, o.target, NULL, NULL, &err));
    NOT_MADE(m, icc_map_create(&m, NULL, o.target, NULL, NULL, &err));
    NOT_MADE(m, icc_map_create(&m, o.source, NULL, NULL, NULL, &err));
    static const double SQUARE[] = {0, 0, 1, 0, 1, 1, 0, 1}, BOW[] = {0, 0, 1, 0, 0, 1, 1, 1};
    EXPLAINED(icc_map_create_polygons(NULL, 4, SQUARE, SQUARE, NULL, &err));
    NOT_MADE(m, icc_map_create_polygons(&m, 4, NULL, SQUARE, NULL, &err));
    NOT_MADE(m, icc_map_create_polygons(&m, 4, SQUARE, NULL, NULL, &err));
    NOT_MADE(m, icc_map_create_polygons(&m, (size_t)-1, SQUARE, SQUARE, NULL, &err));
    ck_assert_int_eq(icc_map_create_polygons(&m, 2, SQUARE, SQUARE, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert_int_eq(icc_map_create_polygons(&m, 4, BOW, SQUARE, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.side, 1);
    ck_assert_int_eq(strncmp(err.message, "source: edges", 13), 0);
    ck_assert_int_eq(icc_map_create_polygons(&m, 4, SQUARE, BOW, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.side, 2);
    ck_assert_int_eq(strncmp(err.message, "target: edges", 13), 0);
    ck_assert_ptr_null(m);
    EXPLAINED(icc_map_create_from_charts(NULL, o.chart, o.target_chart, NULL, NULL, &err));
    NOT_MADE(m, icc_map_create_from_charts(&m, NULL, o.target_chart, NULL, NULL, &err));
    NOT_MADE(m, icc_map_create_from_charts(&m, o.chart, NULL, NULL, NULL, &err));
    static const double NOT_FINITE[2] = {HUGE_VAL, 0};
    icc_map_options options = {.size = sizeof options, .target_maximum = NOT_FINITE};
    NOT_MADE(m, icc_map_create(&m, o.source, o.target, &options, NULL, &err));
    options = (icc_map_options){.size = sizeof options, .kind = 3};
    ck_assert_int_eq(icc_map_create(&m, o.source, o.target, &options, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    ck_assert(m == NULL && err.status == ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(icc_map_create_from_charts(&m, o.chart, o.target_chart, &options, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    icc_map_info info = {.size = sizeof info};
    REFUSED(icc_map_get_info(NULL, &info));
    REFUSED(icc_map_get_info(o.map, NULL));
    icc_map_report made = {.size = sizeof made};
    REFUSED(icc_map_get_report(NULL, &made));
    REFUSED(icc_map_get_report(o.map, NULL));
    icc_tie_info tie = {.size = sizeof tie};
    uint32_t region;
    EXPLAINED(icc_map_get_regions(NULL, &region, &err));
    EXPLAINED(icc_map_get_regions(o.map, NULL, &err));
    REFUSED(icc_map_get_tie(NULL, 0, &tie, NULL, NULL));
    REFUSED(icc_map_get_tie(o.map, 0, NULL, NULL, NULL));
    REFUSED(icc_map_get_tie(o.map, 0, &tie, NULL, NULL)); /* it has no features */
    ck_assert(icc_map_source_chart(NULL) == NULL && icc_map_target_chart(NULL) == NULL);
    ck_assert(icc_map_source_chart(o.map) == o.chart &&
              icc_map_target_chart(o.map) == o.target_chart);
    double p[2] = {0.5, 0.5}, j[4];
    size_t n = 7;
    REFUSED(icc_map_save(NULL, 0, NULL, &n));
    REFUSED(icc_map_save(o.map, 0, NULL, NULL));
    REFUSED(icc_map_save(o.map, 1, NULL, &n));
    EXPLAINED(icc_map_load(NULL, 1, p, NULL, &err));
    REFUSED(icc_match_save(NULL, 0, NULL, &n));
    EXPLAINED(icc_match_load(NULL, 1, p, NULL, &err));
    NOT_MADE(m, icc_map_load(&m, 1, NULL, NULL, &err));
    REFUSED(icc_map_apply(NULL, 1, p, p, NULL, NULL, NULL));
    REFUSED(icc_map_apply(o.map, 1, NULL, p, NULL, NULL, NULL));
    REFUSED(icc_map_apply(o.map, 1, p, NULL, NULL, NULL, NULL));
    ck_assert_int_eq(icc_map_apply(o.map, 0, NULL, NULL, NULL, &n, NULL), ICC_OK);
    ck_assert_uint_eq(n, 0);
    REFUSED(icc_map_apply_inverse(NULL, 1, p, p, NULL, NULL, NULL));
    REFUSED(icc_map_apply_inverse(o.map, 1, NULL, p, NULL, NULL, NULL));
    REFUSED(icc_map_apply_inverse(o.map, 1, p, NULL, NULL, NULL, NULL));
    REFUSED(icc_map_jacobian(NULL, 1, p, j, NULL, NULL, NULL));
    REFUSED(icc_map_jacobian(o.map, 1, NULL, j, NULL, NULL, NULL));
    REFUSED(icc_map_jacobian(o.map, 1, p, NULL, NULL, NULL, NULL));
    objects_clear(&o);
}
END_TEST

START_TEST(mesh_maps_refuse_bad_arguments)
{
    objects o;
    objects_init(&o, ICC_METHOD_GRADIENT);
    icc_error err;
    icc_map *m;
    const icc_map_options bad = {.size = sizeof bad, .iterations = -2};
    NOT_MADE(m, icc_map_create(&m, o.source, o.target, &bad, NULL, &err));
    NOT_MADE(m, icc_map_create_from_charts(&m, o.chart, o.target_chart, &bad, NULL, &err));
    EXPLAINED(icc_map_improve(NULL, o.mesh_map, NULL, NULL, NULL, &err));
    NOT_MADE(m, icc_map_improve(&m, NULL, NULL, NULL, NULL, &err));
    const icc_improve_options options[] = {{.size = sizeof *options, .iterations = -1},
                                           {.size = sizeof *options, .levels = -2},
                                           {.size = sizeof *options, .tolerance = -1e-9},
                                           {.size = sizeof *options, .tolerance = 1},
                                           {.size = sizeof *options, .tolerance = NAN}};
    static const char *const members[] = {"iterations is -1", "levels is -2", "tolerance is -1e-09",
                                          "tolerance is 1", "tolerance is "};
    for (size_t k = 0; k < sizeof options / sizeof *options; ++k) {
        NOT_MADE(m, icc_map_improve(&m, o.mesh_map, &options[k], NULL, NULL, &err));
        ck_assert_ptr_nonnull(strstr(err.message, members[k]));
    }
    icc_improve_report report = {.size = 0};
    NOT_MADE(m, icc_map_improve(&m, o.mesh_map, NULL, &report, NULL, &err));
    EXPLAINED(icc_map_retarget(NULL, o.mesh_map, o.target, NULL, NULL, &err));
    NOT_MADE(m, icc_map_retarget(&m, NULL, o.target, NULL, NULL, &err));
    NOT_MADE(m, icc_map_retarget(&m, o.mesh_map, NULL, NULL, NULL, &err));
    NOT_MADE(m, icc_map_retarget(
                    &m, o.mesh_map, o.target,
                    &(icc_retarget_options){.size = sizeof(icc_retarget_options), .iterations = -2},
                    NULL, &err));
    REFUSED(flat_get_mesh(NULL, NULL, NULL, NULL));
    objects_clear(&o);
}
END_TEST

/* A map of curves has no mesh. */
START_TEST(only_mesh_maps_can_be_improved)
{
    objects o;
    objects_init(&o, ICC_METHOD_GRADIENT);
    icc_error err = {.size = sizeof err};
    icc_map *m = (icc_map *)&m;
    ck_assert_int_eq(icc_map_improve(&m, o.map, NULL, NULL, NULL, &err), ICC_ERR_UNSUPPORTED);
    ck_assert(m == NULL && err.status == ICC_ERR_UNSUPPORTED && err.message[0] != '\0');
    m = (icc_map *)&m;
    err.status = 0;
    ck_assert_int_eq(icc_map_retarget(&m, o.map, o.target, NULL, NULL, &err), ICC_ERR_UNSUPPORTED);
    ck_assert(m == NULL && err.status == ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(flat_get_mesh(o.map, NULL, NULL, NULL), ICC_ERR_UNSUPPORTED);
    const icc_map_options mesh = {.size = sizeof mesh, .kind = ICC_MAP_MESH};
    ck_assert_int_eq(icc_map_create_from_charts(&m, o.chart, o.target_chart, &mesh, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_null(m);
    objects_clear(&o);
}
END_TEST

typedef icc_status (*mesh_call)(const icc_map *, size_t, const double *, size_t, const uint32_t *,
                                double *, icc_certificate *, const icc_env *, icc_error *);

/* Cells as VTK lists them are taken if they are simplices; what is not supported is refused. */
START_TEST(meshes_are_of_simplices)
{
    objects o;
    objects_init(&o, 0);
    icc_error err = {.size = sizeof err};
    icc_certificate c = {.size = sizeof c};
    size_t offsets[5] = {0, 3, 6, 9, 12};
    uint8_t types[4] = {5, 5, 5, 5};
    const int32_t regions[4] = {0, 0, 1, 1};
    icc_mesh mesh = flat_mesh(2, N_CORNERS, SOURCE, 4, TRIANGLES);
    mesh.offsets = offsets;
    mesh.types = types;
    ck_assert_int_eq(icc_map_certify(o.map, &mesh, NULL, &c, NULL, &err), ICC_OK);
    types[2] = 9; /* a quadrilateral */
    ck_assert_int_eq(icc_map_certify(o.map, &mesh, NULL, &c, NULL, &err), ICC_ERR_UNSUPPORTED);
    ck_assert(err.index == 2 && err.item == ICC_ITEM_SIMPLEX);
    types[2] = 5;
    offsets[3] = 10;
    ck_assert_int_eq(icc_map_repair(o.map, &mesh, o.points, &c, NULL, &err), ICC_ERR_UNSUPPORTED);
    mesh = flat_mesh(2, N_CORNERS, SOURCE, 4, TRIANGLES);
    mesh.regions = regions;
    ck_assert_int_eq(icc_map_certify(o.map, &mesh, NULL, &c, NULL, &err), ICC_ERR_UNSUPPORTED);
    mesh = flat_mesh(3, N_CORNERS / 2, SOURCE, 3, TRIANGLES);
    EXPLAINED(icc_map_certify(o.map, &mesh, NULL, &c, NULL, &err));
    objects_clear(&o);
}
END_TEST

/* A mesh is filled as far as there is room for it, and never beyond. */
START_TEST(meshes_need_room)
{
    objects o;
    objects_init(&o, 0);
    icc_mesh mesh = ICC_INIT(icc_mesh);
    ck_assert_int_eq(icc_map_get_mesh(o.mesh_map, &mesh, NULL), ICC_OK);
    ck_assert(mesh.dim == 2 && mesh.n_vertices >= N_CORNERS && mesh.n_cells >= 4);
    double *const vertices = malloc(2 * mesh.n_vertices * sizeof *vertices);
    const size_t n = mesh.n_vertices--;
    mesh.vertices = vertices;
    REFUSED(icc_map_get_mesh(o.mesh_map, &mesh, NULL));
    mesh.n_vertices = n;
    ck_assert_int_eq(icc_map_get_mesh(o.mesh_map, &mesh, NULL), ICC_OK);
    mesh.size = 0;
    REFUSED(icc_map_get_mesh(o.mesh_map, &mesh, NULL));
    free(vertices);
    objects_clear(&o);
}
END_TEST

START_TEST(certificates_refuse_bad_arguments)
{
    objects o;
    objects_init(&o, 0);
    icc_error err;
    double images[2 * N_CORNERS];
    static const mesh_call CALLED[2] = {flat_certify, flat_repair};
    uint32_t t[12];
    memcpy(t, TRIANGLES, sizeof t);
    for (int k = 0; k < 2; ++k) {
        icc_certificate c = {.size = sizeof c};
        const mesh_call f = CALLED[k];
        EXPLAINED(f(NULL, N_CORNERS, SOURCE, 4, t, images, &c, NULL, &err));
        EXPLAINED(f(o.map, N_CORNERS, NULL, 4, t, images, &c, NULL, &err));
        EXPLAINED(f(o.map, N_CORNERS, SOURCE, 4, NULL, images, &c, NULL, &err));
        EXPLAINED(f(o.map, N_CORNERS, SOURCE, 4, t, images, NULL, NULL, &err));
        EXPLAINED(f(o.map, 2, SOURCE, 4, t, images, &c, NULL, &err));
        EXPLAINED(f(o.map, N_CORNERS, SOURCE, 0, t, images, &c, NULL, &err));
        t[7] = N_CORNERS;
        EXPLAINED(f(o.map, N_CORNERS, SOURCE, 4, t, images, &c, NULL, &err));
        ck_assert_int_eq(err.index, 2);
        ck_assert_int_eq(err.item, ICC_ITEM_SIMPLEX);
        t[7] = TRIANGLES[7];
        c.size = 7;
        EXPLAINED(f(o.map, N_CORNERS, SOURCE, 4, t, images, &c, NULL, &err));
    }
    icc_certificate c = {.size = sizeof c};
    EXPLAINED(flat_repair(o.map, N_CORNERS, SOURCE, 4, t, NULL, &c, NULL, &err));
    ck_assert_int_eq(flat_certify(o.map, N_CORNERS, SOURCE, 4, t, NULL, &c, NULL, NULL), ICC_OK);
    objects_clear(&o);
}
END_TEST

START_TEST(stages_refuse_bad_arguments)
{
    static const size_t SHAPE[2] = {3, 3}, EMPTY[2] = {3, 0};
    static const uint8_t NOTHING[9] = {0};
    objects o;
    objects_init(&o, 0);
    icc_error err;
    icc_grid *g;
    EXPLAINED(icc_grid_create(NULL, o.source, 0, NULL, &err));
    NOT_MADE(g, icc_grid_create(&g, NULL, 0, NULL, &err));
    NOT_MADE(g, icc_grid_create(&g, o.source, 1, NULL, &err));
    NOT_MADE(g, icc_grid_create(&g, o.source, -1, NULL, &err));
    NOT_MADE(g, icc_grid_create(&g, o.source, 16385, NULL, &err));
    EXPLAINED(icc_grid_create_mask(NULL, 2, SHAPE, NOTHING, NULL, &err));
    NOT_MADE(g, icc_grid_create_mask(&g, 0, SHAPE, NOTHING, NULL, &err));
    NOT_MADE(g, icc_grid_create_mask(&g, 7, SHAPE, NOTHING, NULL, &err));
    NOT_MADE(g, icc_grid_create_mask(&g, 2, NULL, NOTHING, NULL, &err));
    NOT_MADE(g, icc_grid_create_mask(&g, 2, SHAPE, NULL, NULL, &err));
    NOT_MADE(g, icc_grid_create_mask(&g, 2, EMPTY, NOTHING, NULL, &err));
    icc_grid_info info = {.size = sizeof info};
    REFUSED(icc_grid_get_info(NULL, &info));
    REFUSED(icc_grid_get_info(o.grid, NULL));
    ck_assert_ptr_null(icc_grid_inside(NULL));
    uint32_t v;
    EXPLAINED(icc_grid_find_maximum(NULL, &v, NULL, NULL, &err));
    EXPLAINED(icc_grid_find_maximum(o.grid, NULL, NULL, NULL, &err));
    const double p[3] = {1, 1, 1}, not_finite[3] = {1, NAN, 1};
    REFUSED(icc_grid_find_nearest(NULL, p, &v));
    REFUSED(icc_grid_find_nearest(o.grid, NULL, &v));
    REFUSED(icc_grid_find_nearest(o.grid, p, NULL));
    REFUSED(icc_grid_find_nearest(o.grid, not_finite, &v));
    ck_assert_int_eq(icc_grid_create_mask(&g, 2, SHAPE, NOTHING, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_nearest(g, p, &v), ICC_ERR_RESOLUTION);
    ck_assert_int_eq(icc_grid_find_maximum(g, &v, NULL, NULL, &err), ICC_ERR_RESOLUTION);
    icc_tree *t;
    NOT_MADE(t, icc_tree_create(&t, g, 4, NULL, NULL, &err));
    icc_grid_free(g);
    EXPLAINED(icc_tree_create(NULL, o.mask, 62, NULL, NULL, &err));
    NOT_MADE(t, icc_tree_create(&t, NULL, 62, NULL, NULL, &err));
    NOT_MADE(t, icc_tree_create(&t, o.mask, 125, NULL, NULL, &err));
    NOT_MADE(t, icc_tree_create(&t, o.mask, UINT32_MAX, NULL, NULL, &err));
    static const int32_t ORDERS[3][3] = {{0, 1, 1}, {0, 1, 3}, {-1, 0, 1}};
    for (int k = 0; k < 5; ++k) {
        const icc_tree_options bad = {.size = sizeof bad,
                                      .form = k == 3   ? 3
                                              : k == 4 ? -1
                                                       : 0,
                                      .axis_order = k < 3 ? ORDERS[k] : NULL};
        NOT_MADE(t, icc_tree_create(&t, o.mask, 62, &bad, NULL, &err));
    }
    ck_assert(icc_tree_parents(NULL) == NULL && icc_tree_generations(NULL) == NULL);
    icc_tree_report tree_report = {.size = sizeof tree_report};
    EXPLAINED(icc_tree_get_report(NULL, &tree_report, NULL, &err));
    EXPLAINED(icc_tree_get_report(o.tree, NULL, NULL, &err));
    icc_function *f;
    EXPLAINED(icc_function_create(NULL, o.tree, NULL, NULL, &err));
    NOT_MADE(f, icc_function_create(&f, NULL, NULL, NULL, &err));
    const icc_function_options bad[] = {
        {.size = sizeof *bad, .function = 7},        {.size = sizeof *bad, .function = -1},
        {.size = sizeof *bad, .constraints = 4},     {.size = sizeof *bad, .constraints = -1},
        {.size = sizeof *bad, .solver = 3},          {.size = sizeof *bad, .solver = -1},
        {.size = sizeof *bad, .min_fall = -1e-6},    {.size = sizeof *bad, .min_fall = 0.0100001},
        {.size = sizeof *bad, .min_fall = NAN},      {.size = sizeof *bad, .leaf_min = -1e-9},
        {.size = sizeof *bad, .leaf_min = HUGE_VAL}, {.size = sizeof *bad, .leaf_min = NAN},
    };
    static const char *const NAMED[] = {"function", "function", "constraints", "constraints",
                                        "solver",   "solver",   "min_fall",    "min_fall",
                                        "min_fall", "leaf_min", "leaf_min",    "leaf_min"};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        NOT_MADE(f, icc_function_create(&f, o.tree, &bad[k], NULL, &err));
        ck_assert_ptr_nonnull(strstr(err.message, NAMED[k]));
    }
    ck_assert_ptr_null(icc_function_values(NULL));
    ck_assert_ptr_null(icc_function_logs(NULL));
    ck_assert_ptr_null(icc_function_logs(o.field)); /* of the decay */
    ck_assert(icc_function_tree(NULL) == NULL && icc_tree_grid(NULL) == NULL);
    ck_assert(icc_function_tree(o.field) == o.tree && icc_tree_grid(o.tree) != NULL);
    ck_assert(icc_tree_root(NULL) == UINT32_MAX && icc_tree_root(o.tree) == 62);
    icc_function_info field_info = {.size = sizeof field_info};
    REFUSED(icc_function_get_info(NULL, &field_info));
    REFUSED(icc_function_get_info(o.field, NULL));
    icc_solver_report solved = {.size = sizeof solved};
    REFUSED(icc_function_get_solver_report(NULL, &solved));
    REFUSED(icc_function_get_solver_report(o.field, NULL));
    icc_function_report report = {.size = sizeof report};
    EXPLAINED(icc_function_get_report(NULL, &report, NULL, &err));
    EXPLAINED(icc_function_get_report(o.field, NULL, NULL, &err));
    size_t n;
    uint32_t edges[2];
    int32_t kinds[1];
    REFUSED(icc_function_get_edges(NULL, 0, NULL, NULL, &n, NULL));
    REFUSED(icc_function_get_edges(o.field, 0, NULL, NULL, NULL, NULL));
    REFUSED(icc_function_get_edges(o.field, 1, NULL, kinds, &n, NULL));
    REFUSED(icc_function_get_edges(o.field, 1, edges, NULL, &n, NULL));
    ck_assert_int_eq(icc_function_get_edges(o.field, 1, edges, kinds, &n, NULL),
                     ICC_ERR_UNSUPPORTED);
    icc_facet_report facets = {.size = sizeof facets};
    EXPLAINED(icc_function_get_facets(NULL, 0, NULL, NULL, &facets, NULL, &err));
    EXPLAINED(icc_function_get_facets(o.field, 0, NULL, NULL, NULL, NULL, &err));
    EXPLAINED(icc_function_get_facets(o.field, 1, NULL, kinds, &facets, NULL, &err));
    EXPLAINED(icc_function_get_facets(o.field, 1, edges, NULL, &facets, NULL, &err));
    const double nowhere[3] = {NAN, 0, 0}, somewhere[3] = {1, 1, 1};
    const double *values = icc_function_values(o.field);
    const uint32_t *parents = icc_tree_parents(o.tree);
    double points[3];
    REFUSED(icc_grid_get_points(NULL, 0, NULL, points));
    REFUSED(icc_grid_get_points(o.mask, 1, NULL, NULL));
    REFUSED(icc_grid_get_points(o.mask, 1, &(uint32_t){UINT32_MAX}, points));
    REFUSED(icc_grid_get_points(o.mask, SIZE_MAX, NULL, points));
    NOT_MADE(t, icc_tree_create_parents(&t, NULL, 62, parents, NULL, NULL, &err));
    NOT_MADE(t, icc_tree_create_parents(&t, o.mask, 62, NULL, NULL, NULL, &err));
    NOT_MADE(t, icc_tree_create_parents(&t, o.mask, UINT32_MAX, parents, NULL, NULL, &err));
    EXPLAINED(icc_tree_create_parents(NULL, o.mask, 62, parents, NULL, NULL, &err));
    NOT_MADE(f, icc_function_create_values(&f, NULL, values, NULL, &err));
    NOT_MADE(f, icc_function_create_values(&f, o.tree, NULL, NULL, &err));
    EXPLAINED(icc_function_create_values(NULL, o.tree, values, NULL, &err));
    NOT_MADE(f, icc_function_create_logs(&f, NULL, values, NULL, &err));
    NOT_MADE(f, icc_function_create_logs(&f, o.tree, NULL, NULL, &err));
    icc_curves *curves;
    NOT_MADE(curves, icc_curves_create(&curves, NULL, 1, somewhere, ICC_WAY_UP, NULL, &err));
    NOT_MADE(curves, icc_curves_create(&curves, o.field, 1, NULL, ICC_WAY_UP, NULL, &err));
    NOT_MADE(curves, icc_curves_create(&curves, o.field, 1, somewhere, 0, NULL, &err));
    NOT_MADE(curves, icc_curves_create(&curves, o.field, 1, nowhere, ICC_WAY_UP, NULL, &err));
    EXPLAINED(icc_curves_create(NULL, o.field, 1, somewhere, ICC_WAY_UP, NULL, &err));
    icc_curves_info found = {.size = sizeof found};
    REFUSED(icc_curves_get_info(NULL, &found));
    REFUSED(icc_curves_get_vertices(NULL, NULL, NULL));
    REFUSED(icc_curves_get_ends(NULL, NULL, NULL, NULL, NULL, NULL));
    ck_assert_int_eq(icc_curves_create(&curves, o.field, 1, somewhere, ICC_WAY_UP, NULL, &err),
                     ICC_OK);
    REFUSED(icc_curves_get_info(curves, NULL));
    ck_assert_int_eq(icc_curves_get_info(curves, &found), ICC_OK);
    ck_assert(found.dim == 3 && found.n_curves == 1 && found.n_vertices > 1);
    icc_curves_free(curves);
    icc_curves_free(NULL);
    static const int32_t ORDER[3] = {2, 0, 1};
    const icc_tree_options good = {.size = sizeof good, .axis_order = ORDER};
    ck_assert_int_eq(icc_tree_create(&t, o.mask, 62, &good, NULL, &err), ICC_OK);
    icc_tree_free(t);
    objects_clear(&o);
}
END_TEST

START_TEST(the_triangulation_refuses_bad_arguments)
{
    icc_error err;
    double points[2 * N_CORNERS + 2];
    uint32_t triangles[3 * (N_CORNERS + 1)];
    memcpy(points, SOURCE, sizeof SOURCE);
    points[2 * N_CORNERS] = 0.5;
    points[2 * N_CORNERS + 1] = 0.5;
    ck_assert_int_eq(icc_triangulate(N_CORNERS, N_CORNERS + 1, points, triangles, NULL, NULL),
                     ICC_OK);
    EXPLAINED(icc_triangulate(N_CORNERS, N_CORNERS + 1, NULL, triangles, NULL, &err));
    EXPLAINED(icc_triangulate(N_CORNERS, N_CORNERS + 1, points, NULL, NULL, &err));
    EXPLAINED(icc_triangulate(2, N_CORNERS, points, triangles, NULL, &err));
    EXPLAINED(icc_triangulate(N_CORNERS + 1, N_CORNERS, points, triangles, NULL, &err));
    EXPLAINED(icc_triangulate(N_CORNERS, SIZE_MAX, points, triangles, NULL, &err));
    points[2 * N_CORNERS] = NAN;
    EXPLAINED(icc_triangulate(N_CORNERS, N_CORNERS + 1, points, triangles, NULL, &err));
    ck_assert_int_eq(err.index, N_CORNERS);
    ck_assert_int_eq(err.item, ICC_ITEM_POINT);
    points[2 * N_CORNERS] = 2.5;
    points[2 * N_CORNERS + 1] = 2.5;
    ck_assert_int_eq(icc_triangulate(N_CORNERS, N_CORNERS + 1, points, triangles, NULL, &err),
                     ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.index, N_CORNERS);
    ck_assert_int_eq(err.item, ICC_ITEM_POINT);
    points[0] = NAN;
    ck_assert_int_eq(icc_triangulate(N_CORNERS, N_CORNERS + 1, points, triangles, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.index, 0);
    ck_assert_int_eq(err.item, ICC_ITEM_VERTEX);
}
END_TEST

/* Far too small beside the polygon, and far outside. */
START_TEST(the_triangulation_names_the_point)
{
    icc_error err = {.size = sizeof err};
    uint32_t triangles[3 * 8];
    const double tiny[12] = {-1, -1, 1, -1, 1, 1, -1, 1, 0.5, 0.5, 1e-70, 0.25};
    ck_assert_int_eq(icc_triangulate(4, 6, tiny, triangles, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(err.index, 5);
    ck_assert_int_eq(err.item, ICC_ITEM_POINT);
    const double far[12] = {-1, -1, 1, -1, 1, 1, -1, 1, 0.5, 0.5, 1e300, 0.25};
    ck_assert_int_eq(icc_triangulate(4, 6, far, triangles, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.index, 5);
    ck_assert_int_eq(err.item, ICC_ITEM_POINT);
}
END_TEST

/* The edges that icc_chart_get_gradient_info() counts, one by one, in as much room as there is. */
START_TEST(edges_are_listed)
{
    icc_domain *domain;
    icc_grid *grid;
    icc_tree *tree;
    icc_function *field;
    uint32_t root, edges[2 * N_POINTS];
    int32_t kinds[N_POINTS];
    size_t n, again, n_tested;
    ck_assert_int_eq(icc_domain_create(&domain, 2, N_CORNERS, SOURCE, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_create(&grid, domain, 12, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create(&field, tree, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_get_edges(field, N_POINTS, edges, kinds, &n, &n_tested), ICC_OK);
    ck_assert(n > 10 && n <= N_POINTS && n < n_tested);
    size_t n_compression = 0;
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
    for (size_t k = 0; k < n; ++k) {
        ck_assert(kinds[k] == ICC_EDGE_COMPRESSION || kinds[k] == ICC_EDGE_EXPANSION);
        n_compression += kinds[k] == ICC_EDGE_COMPRESSION;
        const uint32_t low = edges[2 * k] < edges[2 * k + 1] ? edges[2 * k] : edges[2 * k + 1];
        const uint32_t step = edges[2 * k] + edges[2 * k + 1] - 2 * low;
        ck_assert(step == 1 || step == info.shape[0] || step == info.shape[0] + 1);
    }
    ck_assert_int_eq(icc_function_get_edges(field, 3, edges, kinds, &again, NULL), ICC_OK);
    ck_assert_uint_eq(again, n);
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_GRADIENT, .cells = 12};
    icc_chart *chart;
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    icc_gradient_info counted = {.size = sizeof counted};
    ck_assert_int_eq(icc_chart_get_gradient_info(chart, &counted), ICC_OK);
    ck_assert_uint_eq(counted.n_edges, n_tested);
    ck_assert_uint_eq(counted.n_compression, n_compression);
    ck_assert_uint_eq(counted.n_expansion, n - n_compression);
    icc_chart_free(chart);
    icc_function_free(field);
    icc_tree_free(tree);
    icc_grid_free(grid);
    icc_domain_free(domain);
}
END_TEST

START_TEST(kernels_refuse_bad_arguments)
{
    objects o;
    objects_init(&o, 0);
    icc_weights *kernel;
    icc_binding *binding;
    icc_error err;
    icc_weights_report report = {.size = sizeof report};
    icc_weights_info info = {.size = sizeof info};
    icc_weights_timings timings = {.size = sizeof timings};
    double weights[N_HANDLES], images[2], transforms[6 * N_HANDLES];
    size_t n_bytes;
    EXPLAINED(icc_weights_create(NULL, o.sampling, N_HANDLES, HANDLES, NULL, NULL, &err));
    EXPLAINED(icc_weights_create(&kernel, NULL, N_HANDLES, HANDLES, NULL, NULL, &err));
    EXPLAINED(icc_weights_create(&kernel, o.sampling, N_HANDLES, NULL, NULL, NULL, &err));
    EXPLAINED(icc_weights_create(&kernel, o.sampling, 2, HANDLES, NULL, NULL, &err));
    EXPLAINED(icc_weights_paint(&kernel, NULL, 0, HANDLES, 1, 1, NULL, &err));
    EXPLAINED(icc_weights_paint(&kernel, o.kernel, 0, NULL, 1, 1, NULL, &err));
    EXPLAINED(icc_weights_repaint(&kernel, NULL, 0, NULL, NULL, NULL, &err));
    EXPLAINED(icc_weights_repaint(&kernel, o.kernel, 1, NULL, weights, NULL, &err));
    EXPLAINED(icc_weights_with_method(NULL, o.kernel, ICC_WEIGHTS_QP, NULL, &err));
    EXPLAINED(icc_weights_with_method(&kernel, o.kernel, 0, NULL, &err));
    EXPLAINED(icc_weights_stiffen(&kernel, o.kernel, 1, NULL, NULL, NULL, NULL, &err));
    EXPLAINED(icc_weights_get_dual(NULL, 0, 1, HANDLES, weights, NULL, &err));
    EXPLAINED(icc_weights_get_dual(o.kernel, 1u << 30, 1, HANDLES, weights, NULL, &err));
    EXPLAINED(icc_weights_get_report(o.kernel, 1, NULL, &report, NULL, &err));
    EXPLAINED(icc_weights_get_report(o.kernel, 0, NULL, NULL, NULL, &err));
    REFUSED(icc_weights_get_info(NULL, &info));
    REFUSED(icc_weights_get_info(o.kernel, NULL));
    REFUSED(icc_weights_get_timings(NULL, &timings));
    REFUSED(icc_weights_get_timings(o.kernel, NULL));
    REFUSED(icc_weights_get_nodes(NULL, NULL, NULL, NULL, NULL));
    REFUSED(icc_weights_evaluate(NULL, 1, HANDLES, weights, NULL, NULL, NULL, NULL));
    REFUSED(icc_weights_evaluate(o.kernel, 1, NULL, weights, NULL, NULL, NULL, NULL));
    REFUSED(icc_weights_evaluate(o.kernel, 1, HANDLES, NULL, NULL, NULL, NULL, NULL));
    EXPLAINED(icc_binding_create(&binding, NULL, 1, HANDLES, 0, NULL, &err));
    EXPLAINED(icc_binding_create(&binding, o.kernel, 1, NULL, 0, NULL, &err));
    EXPLAINED(icc_binding_create(&binding, o.kernel, 1, HANDLES, 2, NULL, &err));
    EXPLAINED(icc_binding_load(NULL, 1, HANDLES, NULL, &err));
    EXPLAINED(icc_binding_load(&binding, 1, NULL, NULL, &err));
    REFUSED(icc_binding_get_counts(NULL, NULL, NULL, NULL));
    REFUSED(icc_binding_get_weights(NULL, NULL, NULL));
    REFUSED(icc_binding_pose(NULL, transforms, images, NULL, NULL));
    REFUSED(icc_binding_pose(o.binding, NULL, images, NULL, NULL));
    REFUSED(icc_binding_save(NULL, 0, NULL, &n_bytes));
    REFUSED(icc_binding_save(o.binding, 0, NULL, NULL));
    REFUSED(icc_binding_save(o.binding, 1, NULL, &n_bytes));
    REFUSED(icc_pose_reset(1, N_HANDLES, transforms));
    REFUSED(icc_pose_reset(2, N_HANDLES, NULL));
    REFUSED(icc_pose_move(2, NULL, HANDLES));
    REFUSED(icc_pose_move(4, transforms, HANDLES));
    REFUSED(icc_pose_turn(2, transforms, NULL, NULL, 1));
    REFUSED(icc_pose_turn(3, transforms, HANDLES, NULL, 1));
    REFUSED(icc_pose_turn(2, transforms, HANDLES, NULL, NAN));
    objects_clear(&o);
}
END_TEST

/* That an argument is missing is said in one form, by its name in the header. */
#define MISSING(name, call)                                                                        \
    do {                                                                                           \
        EXPLAINED(call);                                                                           \
        ck_assert_str_eq(err.message, name " is NULL");                                            \
    } while (0)

START_TEST(what_is_missing_is_named)
{
    objects o;
    objects_init(&o, 0);
    icc_error err;
    icc_chart *c;
    icc_map *m;
    icc_match *match;
    icc_weights *w;
    icc_binding *b;
    icc_tree *t;
    size_t n;
    double image[2];
    icc_weights_report report = {.size = sizeof report};
    icc_certificate certificate = {.size = sizeof certificate};
    const icc_picture picture = {.size = sizeof picture};
    MISSING("domain", icc_chart_create(&c, NULL, NULL, NULL, &err));
    MISSING("measures", icc_chart_get_report(o.chart, 1, NULL, NULL, &err));
    MISSING("curve", icc_chart_trace(o.chart, o.points, 1, NULL, &n, NULL, &err));
    MISSING("data", icc_chart_load(&c, 1, NULL, NULL, &err));
    MISSING("target", icc_map_create(&m, o.source, NULL, NULL, NULL, &err));
    MISSING("source", icc_map_create_from_charts(&m, NULL, o.chart, NULL, NULL, &err));
    MISSING("map", icc_map_improve(&m, NULL, NULL, NULL, NULL, &err));
    MISSING("target", icc_map_retarget(&m, o.mesh_map, NULL,
                                       &(icc_retarget_options){.size = sizeof(icc_retarget_options),
                                                               .iterations = 1},
                                       NULL, &err));
    MISSING("icc_mesh.cells",
            flat_certify(o.map, 3, o.points, 1, NULL, NULL, &certificate, NULL, &err));
    MISSING("mesh", icc_map_certify(o.map, NULL, NULL, &certificate, NULL, &err));
    MISSING("images", flat_repair(o.map, 3, o.points, 1, FACETS, NULL, &certificate, NULL, &err));
    MISSING("certificate", flat_repair(o.map, 3, o.points, 1, FACETS, image, NULL, NULL, &err));
    MISSING("data", icc_map_load(&m, 1, NULL, NULL, &err));
    MISSING("data", icc_match_load(&match, 1, NULL, NULL, &err));
    MISSING("target", icc_map_warp(o.map, &picture, NULL, &n, NULL, &err));
    MISSING("out", icc_tree_create(NULL, o.grid, 0, NULL, NULL, &err));
    MISSING("grid", icc_tree_create(&t, NULL, 0, NULL, NULL, &err));
    MISSING("handles", icc_weights_create(&w, o.sampling, 1, NULL, NULL, NULL, &err));
    MISSING("points", icc_weights_get_report(o.kernel, 1, NULL, &report, NULL, &err));
    MISSING("points", icc_weights_get_dual(o.kernel, 0, 1, NULL, image, NULL, &err));
    MISSING("values", icc_weights_get_dual(o.kernel, 0, 1, o.points, NULL, NULL, &err));
    MISSING("centre", icc_weights_paint(&w, o.kernel, 0, NULL, 1, 1, NULL, &err));
    MISSING("values", icc_weights_repaint(&w, o.kernel, 1, FACETS, NULL, NULL, &err));
    MISSING("weights", icc_weights_with_method(&w, NULL, 1, NULL, &err));
    MISSING("nodes", icc_weights_stiffen(&w, o.kernel, 1, NULL, NULL, NULL, NULL, &err));
    MISSING("points", icc_binding_create(&b, o.kernel, 1, NULL, 0, NULL, &err));
    MISSING("data", icc_binding_load(&b, 1, NULL, NULL, &err));
    objects_clear(&o);
}
END_TEST

START_TEST(freeing_nothing_does_nothing)
{
    icc_shape_free(NULL);
    icc_sampling_free(NULL);
    icc_weights_free(NULL);
    icc_binding_free(NULL);
    icc_domain_free(NULL);
    icc_chart_free(NULL);
    icc_map_free(NULL);
    icc_grid_free(NULL);
    icc_tree_free(NULL);
    icc_function_free(NULL);
}
END_TEST

/* ---- env ---- */

static void *some_alloc(void *user, size_t size)
{
    (void)user;
    return malloc(size);
}

/* Every function that takes an env reads it by the same rules. */
START_TEST(every_call_checks_its_env)
{
    static outcome out;
    objects o;
    objects_init(&o, 0);
    struct {
        icc_env env;
        unsigned char tail[16];
    } longer;
    for (int i = 0; i < N_CALLS; ++i) {
        const icc_env bad[] = {{.size = 0},
                               {.size = sizeof(size_t) - 1},
                               {.size = SIZE_MAX},
                               {.size = sizeof *bad, .alloc = some_alloc},
                               {.size = sizeof *bad, .threads = -1},
                               {.size = sizeof *bad, .threads = 1025}};
        for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
            icc_error err = {.size = sizeof err};
            REFUSED(CALLS[i].run(&o, &out, &bad[k], &err));
            if (has_error(&CALLS[i]))
                ck_assert_int_eq(err.status, ICC_ERR_ARGUMENT);
        }
        const icc_env shortest = {.size = sizeof(size_t), .threads = -1};
        ck_assert_int_eq(CALLS[i].run(&o, &out, &shortest, NULL), ICC_OK);
        memset(&longer, 0, sizeof longer);
        longer.env.size = sizeof longer;
        ck_assert_int_eq(CALLS[i].run(&o, &out, &longer.env, NULL), ICC_OK);
        longer.tail[15] = 1;
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(CALLS[i].run(&o, &out, &longer.env, &err), ICC_ERR_VERSION);
        if (has_error(&CALLS[i]))
            ck_assert_int_eq(err.status, ICC_ERR_VERSION);
    }
    objects_clear(&o);
}
END_TEST

/* ---- structs that are read ---- */

typedef icc_status (*reader)(const objects *o, const void *options, icc_error *err);

static icc_status read_chart_options(const objects *o, const void *options, icc_error *err)
{
    icc_chart *chart;
    const icc_status status = icc_chart_create(&chart, o->source, options, NULL, err);
    icc_chart_free(chart);
    return status;
}

static icc_status read_inner_chart_options(const objects *o, const void *options, icc_error *err)
{
    icc_map *map;
    const icc_map_options outer = {.size = sizeof outer, .chart = options};
    const icc_status status = icc_map_create(&map, o->source, o->target, &outer, NULL, err);
    icc_map_free(map);
    return status;
}

static icc_status read_map_options(const objects *o, const void *options, icc_error *err)
{
    icc_map *map;
    const icc_status status = icc_map_create(&map, o->source, o->target, options, NULL, err);
    icc_map_free(map);
    return status;
}

static icc_status read_map_options_too(const objects *o, const void *options, icc_error *err)
{
    icc_map *map;
    const icc_status status =
        icc_map_create_from_charts(&map, o->chart, o->target_chart, options, NULL, err);
    icc_map_free(map);
    return status;
}

static icc_status read_improve_options(const objects *o, const void *options, icc_error *err)
{
    icc_map *map;
    const icc_status status = icc_map_improve(&map, o->mesh_map, options, NULL, NULL, err);
    icc_map_free(map);
    return status;
}

static icc_status read_retarget_options(const objects *o, const void *options, icc_error *err)
{
    icc_map *map;
    const icc_status status = icc_map_retarget(&map, o->mesh_map, o->target, options, NULL, err);
    icc_map_free(map);
    return status;
}

static icc_status read_tree_options(const objects *o, const void *options, icc_error *err)
{
    icc_tree *tree;
    const icc_status status = icc_tree_create(&tree, o->mask, 62, options, NULL, err);
    icc_tree_free(tree);
    return status;
}

static icc_status read_field_options(const objects *o, const void *options, icc_error *err)
{
    icc_function *field;
    const icc_status status = icc_function_create(&field, o->tree, options, NULL, err);
    icc_function_free(field);
    return status;
}

static icc_status read_sampling_options(const objects *o, const void *options, icc_error *err)
{
    icc_sampling *sampling;
    const icc_status status = icc_sampling_create(&sampling, o->shape, options, NULL, err);
    icc_sampling_free(sampling);
    return status;
}

static icc_status read_kernel_options(const objects *o, const void *options, icc_error *err)
{
    icc_weights *kernel;
    const icc_status status =
        icc_weights_create(&kernel, o->sampling, N_HANDLES, HANDLES, options, NULL, err);
    icc_weights_free(kernel);
    return status;
}

START_TEST(options_may_be_older_or_newer)
{
    static const struct {
        reader read;
        size_t size;
    } READERS[] = {{read_chart_options, sizeof(icc_chart_options)},
                   {read_inner_chart_options, sizeof(icc_chart_options)},
                   {read_map_options, sizeof(icc_map_options)},
                   {read_map_options_too, sizeof(icc_map_options)},
                   {read_improve_options, sizeof(icc_improve_options)},
                   {read_retarget_options, sizeof(icc_retarget_options)},
                   {read_tree_options, sizeof(icc_tree_options)},
                   {read_field_options, sizeof(icc_function_options)},
                   {read_sampling_options, sizeof(icc_sampling_options)},
                   {read_kernel_options, sizeof(icc_weights_options)}};
    objects o;
    objects_init(&o, 0);
    for (size_t k = 0; k < sizeof READERS / sizeof *READERS; ++k) {
        union {
            size_t size;
            double alignment;
            unsigned char bytes[256];
        } given;
        icc_error err;
        memset(&given, 0, sizeof given);
        EXPLAINED(READERS[k].read(&o, &given, &err));
        given.size = 7;
        EXPLAINED(READERS[k].read(&o, &given, &err));
        given.size = SIZE_MAX;
        EXPLAINED(READERS[k].read(&o, &given, &err));
        for (size_t size = sizeof(size_t); size <= sizeof given; size += 4) {
            given.size = size;
            ck_assert_int_eq(READERS[k].read(&o, &given, &err), ICC_OK);
        }
        given.bytes[READERS[k].size] = 1;
        given.size = READERS[k].size;
        ck_assert_int_eq(READERS[k].read(&o, &given, &err), ICC_OK);
        given.size = READERS[k].size + 1;
        ck_assert_int_eq(READERS[k].read(&o, &given, &err), ICC_ERR_VERSION);
        ck_assert(err.status == ICC_ERR_VERSION && err.message[0] != '\0');
        /* A struct that ends before a member does not set it. */
        memset(given.bytes + sizeof(size_t), 0xff, sizeof given - sizeof(size_t));
        given.size = sizeof(size_t);
        ck_assert_int_eq(READERS[k].read(&o, &given, &err), ICC_OK);
        ck_assert_int_eq(READERS[k].read(&o, NULL, &err), ICC_OK);
    }
    objects_clear(&o);
}
END_TEST

/* ---- structs that are filled ---- */

typedef icc_status (*writer)(const objects *o, void *info);

static icc_status write_domain_info(const objects *o, void *info)
{
    return icc_domain_get_info(o->source, info);
}

static icc_status write_feature_info(const objects *o, void *info)
{
    icc_domain *domain;
    (void)o;
    ck_assert_int_eq(
        icc_domain_create_features(&domain, N_CORNERS, SOURCE, 3, FEATURES, NULL, NULL), ICC_OK);
    const icc_status status = icc_domain_get_feature(domain, 0, info);
    icc_domain_free(domain);
    return status;
}

static icc_status write_tie_info(const objects *o, void *info)
{
    icc_domain *domain;
    icc_map *map;
    (void)o;
    ck_assert_int_eq(
        icc_domain_create_features(&domain, N_CORNERS, SOURCE, 3, FEATURES, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, domain, domain, NULL, NULL, NULL), ICC_OK);
    const icc_status status = icc_map_get_tie(map, 0, info, NULL, NULL);
    icc_map_free(map);
    icc_domain_free(domain);
    return status;
}

static icc_status write_chart_info(const objects *o, void *info)
{
    return icc_chart_get_info(o->chart, info);
}

static icc_status write_chart_timings(const objects *o, void *timings)
{
    return icc_chart_get_timings(o->chart, timings);
}

static icc_status write_gradient_info(const objects *o, void *info)
{
    return icc_chart_get_gradient_info(o->chart, info);
}

static icc_status write_field_chart_info(const objects *o, void *info)
{
    return icc_chart_get_field_info(o->chart, info);
}

static icc_status write_foliation_info(const objects *o, void *info)
{
    return icc_chart_get_foliation_info(o->chart, info);
}

static icc_status write_shelling_info(const objects *o, void *info)
{
    return icc_chart_get_shelling_info(o->chart, info);
}

static icc_status write_disc_info(const objects *o, void *info)
{
    return icc_chart_get_disc_info(o->chart, info);
}

static icc_status write_measures(const objects *o, void *info)
{
    return icc_chart_get_report(o->chart, 10, info, NULL, NULL);
}

static icc_status write_map_report(const objects *o, void *report)
{
    return icc_map_get_report(o->map, report);
}

static icc_status write_map_info(const objects *o, void *info)
{
    return icc_map_get_info(o->map, info);
}

static icc_status write_improve_report(const objects *o, void *info)
{
    const icc_improve_options few = {.size = sizeof few, .iterations = 1, .levels = -1};
    icc_map *map;
    const icc_status status = icc_map_improve(&map, o->mesh_map, &few, info, NULL, NULL);
    icc_map_free(map);
    return status;
}

static icc_status write_certificate(const objects *o, void *info)
{
    return flat_certify(o->mesh_map, N_CORNERS, SOURCE, 4, TRIANGLES, NULL, info, NULL, NULL);
}

static icc_status write_grid_info(const objects *o, void *info)
{
    return icc_grid_get_info(o->grid, info);
}

static icc_status write_tree_report(const objects *o, void *info)
{
    return icc_tree_get_report(o->tree, info, NULL, NULL);
}

static icc_status write_solver_report(const objects *o, void *report)
{
    return icc_function_get_solver_report(o->field, report);
}

static icc_status write_field_info(const objects *o, void *info)
{
    return icc_function_get_info(o->field, info);
}

static icc_status write_field_report(const objects *o, void *info)
{
    return icc_function_get_report(o->field, info, NULL, NULL);
}

static icc_status write_sampling_info(const objects *o, void *info)
{
    return icc_sampling_get_info(o->sampling, info);
}

static icc_status write_kernel_info(const objects *o, void *info)
{
    return icc_weights_get_info(o->kernel, info);
}

static icc_status write_weights_timings(const objects *o, void *timings)
{
    return icc_weights_get_timings(o->kernel, timings);
}

static icc_status write_kernel_report(const objects *o, void *info)
{
    return icc_weights_get_report(o->kernel, 9, o->points, info, NULL, NULL);
}

enum { ROOM = 512 };

/* A struct with `known` bytes is filled as far as the caller has room, and with zeros beyond. */
static void check_writer(const objects *o, writer write, size_t known)
{
    union {
        size_t size;
        double alignment;
        unsigned char bytes[ROOM];
    } full, part;
    memset(&full, 0xaa, sizeof full);
    full.size = 0;
    REFUSED(write(o, &full));
    full.size = SIZE_MAX;
    REFUSED(write(o, &full));
    full.size = known;
    ck_assert_int_eq(write(o, &full), ICC_OK);
    ck_assert_uint_eq(full.size, known);
    for (size_t size = sizeof(size_t); size <= ROOM; ++size) {
        memset(&part, 0xaa, sizeof part);
        part.size = size;
        ck_assert_int_eq(write(o, &part), ICC_OK);
        bool same = part.size == size;
        for (size_t b = sizeof(size_t); b < ROOM; ++b) {
            const unsigned char expected = b >= size ? 0xaa : b >= known ? 0 : full.bytes[b];
            same = same && part.bytes[b] == expected;
        }
        if (!same)
            ck_abort_msg("a struct of %zu bytes with room for %zu is filled wrongly", known, size);
    }
}

START_TEST(infos_may_be_older_or_newer)
{
    static const struct {
        writer write;
        size_t size;
    } WRITERS[] = {{write_domain_info, sizeof(icc_domain_info)},
                   {write_feature_info, sizeof(icc_feature_info)},
                   {write_tie_info, sizeof(icc_tie_info)},
                   {write_chart_info, sizeof(icc_chart_info)},
                   {write_chart_timings, sizeof(icc_chart_timings)},
                   {write_measures, sizeof(icc_chart_report)},
                   {write_map_info, sizeof(icc_map_info)},
                   {write_map_report, sizeof(icc_map_report)},
                   {write_improve_report, sizeof(icc_improve_report)},
                   {write_certificate, sizeof(icc_certificate)},
                   {write_grid_info, sizeof(icc_grid_info)},
                   {write_tree_report, sizeof(icc_tree_report)},
                   {write_field_info, sizeof(icc_function_info)},
                   {write_solver_report, sizeof(icc_solver_report)},
                   {write_field_report, sizeof(icc_function_report)},
                   {write_sampling_info, sizeof(icc_sampling_info)},
                   {write_kernel_info, sizeof(icc_weights_info)},
                   {write_weights_timings, sizeof(icc_weights_timings)},
                   {write_kernel_report, sizeof(icc_weights_report)}};
    objects o;
    objects_init(&o, 0);
    for (size_t k = 0; k < sizeof WRITERS / sizeof *WRITERS; ++k)
        check_writer(&o, WRITERS[k].write, WRITERS[k].size);
    objects_clear(&o);
}
END_TEST

/* ---- what only one method has ---- */

enum { N_OWN = 5 };

static const struct {
    int32_t method;
    writer write;
    size_t size;
} OWN[N_OWN] = {{ICC_METHOD_GRADIENT, write_gradient_info, sizeof(icc_gradient_info)},
                {ICC_METHOD_FIELD, write_field_chart_info, sizeof(icc_field_info)},
                {ICC_METHOD_FOLIATION, write_foliation_info, sizeof(icc_foliation_info)},
                {ICC_METHOD_FOLIATION, write_shelling_info, sizeof(icc_shelling_info)},
                {ICC_METHOD_DISC, write_disc_info, sizeof(icc_disc_info)}};

/* Of a square: on the domain's mesh, four triangles round a vertex, for the shelling. */
static icc_chart *square_chart(int k)
{
    static const double CORNERS[10] = {0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0.5};
    static const uint32_t FOUR[12] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    const icc_chart_options options = {.size = sizeof options, .method = OWN[k].method};
    icc_domain *domain;
    icc_chart *chart;
    ck_assert_int_eq(OWN[k].write == write_shelling_info
                         ? flat_create_mesh(&domain, 2, 5, CORNERS, 4, FOUR, 0, NULL, NULL, NULL)
                         : icc_domain_create(&domain, 2, 4, CORNERS, 0, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    icc_domain_free(domain);
    return chart;
}

START_TEST(infos_of_methods_are_theirs_alone)
{
    for (int made = 0; made < N_OWN; ++made) {
        const objects o = {.chart = square_chart(made)};
        for (int asked = 0; asked < N_OWN; ++asked) {
            union {
                size_t size;
                unsigned char bytes[ROOM];
            } info, before;
            memset(&info, 0xaa, sizeof info);
            info.size = OWN[asked].size;
            before = info;
            REFUSED(OWN[asked].write(&(objects){.chart = NULL}, &info));
            REFUSED(OWN[asked].write(&o, NULL));
            const icc_status status = OWN[asked].write(&o, &info);
            ck_assert_int_eq(status, asked == made ? ICC_OK : ICC_ERR_UNSUPPORTED);
            ck_assert_int_eq(memcmp(&info, &before, sizeof info) == 0, asked != made);
        }
        check_writer(&o, OWN[made].write, OWN[made].size);
        icc_chart_free(o.chart);
    }
}
END_TEST

/* Against what the chart's grid and tree say, and Euler's formula. */
START_TEST(infos_of_methods_count)
{
    icc_chart *charts[N_OWN];
    for (int k = 0; k < N_OWN; ++k)
        charts[k] = square_chart(k);
    icc_gradient_info gradient = {.size = sizeof gradient};
    icc_field_info field = {.size = sizeof field};
    icc_foliation_info foliation = {.size = sizeof foliation};
    icc_shelling_info shelling = {.size = sizeof shelling};
    icc_disc_info disc = {.size = sizeof disc};
    ck_assert_int_eq(icc_chart_get_gradient_info(charts[0], &gradient), ICC_OK);
    ck_assert_int_eq(icc_chart_get_field_info(charts[1], &field), ICC_OK);
    ck_assert_int_eq(icc_chart_get_foliation_info(charts[2], &foliation), ICC_OK);
    ck_assert_int_eq(icc_chart_get_shelling_info(charts[3], &shelling), ICC_OK);
    ck_assert_int_eq(icc_chart_get_disc_info(charts[4], &disc), ICC_OK);
    ck_assert(gradient.function == ICC_FUNCTION_DECAY && gradient.tree == ICC_TREE_THESIS);
    const size_t counts[2][6] = {{gradient.n_grid, gradient.n_inside, gradient.n_tree,
                                  gradient.n_maxima, gradient.n_minima, gradient.n_saddles},
                                 {field.n_grid, field.n_inside, field.n_tree, field.n_maxima,
                                  field.n_minima, field.n_saddles}};
    for (int k = 0; k < 2; ++k) {
        const icc_function *function = icc_chart_function(charts[k]);
        const icc_tree *tree = icc_function_tree(function);
        icc_grid_info grid = {.size = sizeof grid};
        icc_tree_report grown = {.size = sizeof grown};
        icc_function_report found = {.size = sizeof found};
        ck_assert_int_eq(icc_grid_get_info(icc_tree_grid(tree), &grid), ICC_OK);
        ck_assert_int_eq(icc_tree_get_report(tree, &grown, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_function_get_report(function, &found, NULL, NULL), ICC_OK);
        ck_assert_uint_eq(counts[k][0], grid.n_vertices);
        ck_assert_uint_eq(counts[k][1], grid.n_inside);
        ck_assert_uint_eq(counts[k][2], grown.n_inside + grown.n_outside);
        ck_assert_uint_eq(counts[k][3], found.n_maxima);
        ck_assert_uint_eq(counts[k][4], found.n_minima);
        ck_assert_uint_eq(counts[k][5], found.n_saddles);
    }
    ck_assert(field.n_contacts > 0 && field.n_infeasible == 0 && field.n_not_inward == 0);
    const size_t meshes[3][3] = {
        {foliation.n_mesh_vertices, foliation.n_mesh_boundary, foliation.n_mesh_simplices},
        {disc.n_mesh_vertices, disc.n_mesh_boundary, disc.n_mesh_simplices},
        {shelling.n_mesh_vertices, shelling.n_mesh_boundary, shelling.n_mesh_simplices}};
    for (int k = 0; k < 3; ++k)
        ck_assert_uint_eq(meshes[k][2], 2 * meshes[k][0] - meshes[k][1] - 2);
    ck_assert(meshes[0][0] > 100 && meshes[2][0] == 5 && meshes[2][2] == 4);
    ck_assert(foliation.harmonic_share >= 0.5 && shelling.harmonic_share > 0);
    ck_assert(shelling.n_orders > 0 && shelling.flux_divergence < 1e-12);
    for (int k = 0; k < N_OWN; ++k)
        icc_chart_free(charts[k]);
}
END_TEST

START_TEST(errors_may_be_older_or_newer)
{
    union {
        icc_error err;
        unsigned char bytes[sizeof(icc_error) + 32];
    } given;
    icc_chart *chart;
    for (size_t size = 0; size <= sizeof given; ++size) {
        memset(&given, 0xaa, sizeof given);
        given.err.size = size;
        REFUSED(icc_chart_create(&chart, NULL, NULL, NULL, &given.err));
        ck_assert_uint_eq(given.err.size, size);
        const size_t known = size == 0 ? sizeof(icc_error) : size; /* 0: that of version 0.1 */
        for (size_t b = known > sizeof(size_t) ? known : sizeof(size_t); b < sizeof given; ++b)
            if (given.bytes[b] != 0xaa)
                ck_abort_msg("byte %zu of %zu is written", b, size);
        if (size == 0)
            ck_assert_str_eq(given.err.message, "domain is NULL");
        if (size >= 12)
            ck_assert_int_eq(given.err.status, ICC_ERR_ARGUMENT);
        if (size > offsetof(icc_error, message))
            ck_assert_ptr_nonnull(
                memchr(given.err.message, '\0', size - offsetof(icc_error, message)));
    }
    /* What succeeds leaves the error alone. */
    memset(&given, 0xaa, sizeof given);
    given.err.size = sizeof(icc_error);
    objects o;
    objects_init(&o, 0);
    ck_assert_int_eq(icc_chart_create(&chart, o.source, NULL, NULL, &given.err), ICC_OK);
    icc_chart_free(chart);
    for (size_t b = sizeof(size_t); b < sizeof given; ++b)
        ck_assert_int_eq(given.bytes[b], 0xaa);
    objects_clear(&o);
}
END_TEST

START_TEST(everything_has_a_name)
{
    static const char *const NAMES[] = {"ICC_OK",
                                        "ICC_ERR_ARGUMENT",
                                        "ICC_ERR_MEMORY",
                                        "ICC_ERR_VERSION",
                                        "ICC_ERR_BOUNDARY",
                                        "ICC_ERR_RESOLUTION",
                                        "ICC_ERR_TOPOLOGY",
                                        "ICC_ERR_OUTSIDE",
                                        "ICC_ERR_SOLVER",
                                        "ICC_ERR_TRACE",
                                        "ICC_ERR_CERTIFICATE",
                                        "ICC_ERR_CANCELLED",
                                        "ICC_ERR_UNSUPPORTED",
                                        "ICC_ERR_FORMAT",
                                        "ICC_ERR_AMBIGUOUS"};
    for (int32_t k = 0; k < 15; ++k)
        ck_assert_str_eq(icc_status_name(k), NAMES[k]);
    static const int32_t UNKNOWN[] = {-1, 15, INT32_MAX, INT32_MIN};
    for (int k = 0; k < 4; ++k)
        ck_assert_str_eq(icc_status_name(UNKNOWN[k]), "unknown status");
    char version[32];
    const int32_t number = icc_version_number();
    (void)snprintf(version, sizeof version, "%d.%d.%d", (int)(number / 10000),
                   (int)(number / 100 % 100), (int)(number % 100));
    ck_assert_str_eq(icc_version(), version);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("api");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, a_struct_without_its_size_is_refused_by_name);
    tcase_add_test(tests, domains_refuse_bad_arguments);
    tcase_add_test(tests, fields_refuse_bad_arguments);
    tcase_add_test(tests, charts_refuse_bad_arguments);
    tcase_add_test(tests, maps_refuse_bad_arguments);
    tcase_add_test(tests, mesh_maps_refuse_bad_arguments);
    tcase_add_test(tests, only_mesh_maps_can_be_improved);
    tcase_add_test(tests, meshes_are_of_simplices);
    tcase_add_test(tests, meshes_need_room);
    tcase_add_test(tests, certificates_refuse_bad_arguments);
    tcase_add_test(tests, stages_refuse_bad_arguments);
    tcase_add_test(tests, the_triangulation_refuses_bad_arguments);
    tcase_add_test(tests, the_triangulation_names_the_point);
    tcase_add_test(tests, edges_are_listed);
    tcase_add_test(tests, kernels_refuse_bad_arguments);
    tcase_add_test(tests, what_is_missing_is_named);
    tcase_add_test(tests, freeing_nothing_does_nothing);
    tcase_add_test(tests, every_call_checks_its_env);
    tcase_add_test(tests, options_may_be_older_or_newer);
    tcase_add_test(tests, infos_may_be_older_or_newer);
    tcase_add_test(tests, infos_of_methods_are_theirs_alone);
    tcase_add_test(tests, infos_of_methods_count);
    tcase_add_test(tests, errors_may_be_older_or_newer);
    tcase_add_test(tests, everything_has_a_name);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
