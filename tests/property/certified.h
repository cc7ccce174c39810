/* What holds for every chart and map that is certified, whatever the method. Each test_METHOD.c
 * names its METHOD and runs these checks on its shapes. */
#ifndef TESTS_PROPERTY_CERTIFIED_H
#define TESTS_PROPERTY_CERTIFIED_H

#include "chart/chart.h"
#include "icc/icc.h"
#include "mesh/planar.h"

#include "../hard_shapes.h"
#include "../shape_domains.h"

#include <check.h>
#include <stdlib.h>

typedef struct subject {
    icc_domain *domain;
    icc_chart *chart;
    icc_domain_info shape;
    icc_chart_info info;
    double width;
} subject;

static inline icc_chart_options method_options(int32_t cells)
{
    return (icc_chart_options){.size = sizeof(icc_chart_options), .method = METHOD, .cells = cells};
}

/* Of the mesh that the chart is on. */
static inline size_t n_triangles(const icc_chart *chart)
{
    icc_foliation_info foliation = {.size = sizeof foliation};
    icc_disc_info disc = {.size = sizeof disc};
    (void)icc_chart_get_foliation_info(chart, &foliation);
    (void)icc_chart_get_disc_info(chart, &disc);
    return foliation.n_mesh_simplices + disc.n_mesh_simplices;
}

static inline subject subject_of(const shape *outline, const icc_chart_options *options)
{
    subject s = {.shape = {.size = sizeof s.shape}, .info = {.size = sizeof s.info}};
    icc_error err = {.size = sizeof err};
    s.domain = domain_of_shape(outline);
    if (icc_chart_create(&s.chart, s.domain, options, NULL, &err) != ICC_OK)
        ck_abort_msg("no chart: %s", err.message);
    (void)icc_domain_get_info(s.domain, &s.shape);
    (void)icc_chart_get_info(s.chart, &s.info);
    s.width = fmax(s.shape.upper[0] - s.shape.lower[0], s.shape.upper[1] - s.shape.lower[1]);
    ck_assert(s.info.method == METHOD && s.info.certified == 1 && n_triangles(s.chart) > 0);
    return s;
}

static inline void subject_clear(subject *s)
{
    icc_chart_free(s->chart);
    icc_domain_free(s->domain);
}

static inline double distance_of(const double a[2], const double b[2])
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

static inline bool is_inside(const icc_domain *domain, const double p[2])
{
    int32_t where;
    ck_assert_int_eq(icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL), ICC_OK);
    return where == ICC_INSIDE;
}

/* A random point inside: of the bounding box, or, for thin shapes, between two boundary points. */
static inline void pick_inside(const subject *s, random_source *r, double p[2])
{
    const icc_domain *d = s->domain;
    for (int tries = 0;; ++tries) {
        double share = random_unit(r);
        const size_t a = (size_t)random_below(r, (int)d->n_vertices);
        const size_t b = (size_t)random_below(r, (int)d->n_vertices);
        double from[2], to[2];
        iccp_domain_given(d, a, from);
        iccp_domain_given(d, b, to);
        for (size_t k = 0; k < 2; ++k)
            p[k] = tries < 50 ? random_between(r, s->shape.lower[k], s->shape.upper[k])
                              : from[k] * (1 - share) + to[k] * share;
        if (is_inside(d, p))
            return;
        ck_assert_int_lt(tries, 100000);
    }
}

typedef struct code {
    uint32_t facet;
    double bary[2], t;
} code;

static inline code encode_point(const icc_chart *chart, const double p[2])
{
    code c;
    icc_status status;
    size_t n_failed;
    ck_assert_int_eq(
        icc_chart_encode(chart, 1, p, &c.facet, c.bary, &c.t, &status, &n_failed, NULL), ICC_OK);
    if (status != ICC_OK || n_failed != 0)
        ck_abort_msg("(%.17g, %.17g) has no coordinates: %d", p[0], p[1], (int)status);
    if (!(c.t >= 0 && c.t <= 1 && c.bary[0] >= 0 && c.bary[1] >= 0 &&
          fabs(c.bary[0] + c.bary[1] - 1) < 1e-15))
        ck_abort_msg("coordinates out of range");
    return c;
}

static inline void decode_point(const icc_chart *chart, const code *c, double p[2])
{
    icc_status status;
    ck_assert_int_eq(icc_chart_decode(chart, 1, &c->facet, c->bary, &c->t, p, &status, NULL, NULL),
                     ICC_OK);
    if (status != ICC_OK)
        ck_abort_msg("facet %u, %.17g, t = %.17g is nowhere: %d", (unsigned)c->facet, c->bary[1],
                     c->t, (int)status);
}

static inline void check_round_trip(const subject *s, const double p[2], double tolerance)
{
    double back[2];
    const code c = encode_point(s->chart, p);
    decode_point(s->chart, &c, back);
    if (!(distance_of(p, back) <= tolerance * s->width))
        ck_abort_msg("(%.17g, %.17g) comes back %g away", p[0], p[1],
                     distance_of(p, back) / s->width);
}

/* The mesh that the chart was made on. */
static inline iccp_planar mesh_of(const subject *s)
{
    uint32_t *pieces = malloc(s->domain->n_facets * sizeof *pieces);
    iccp_env env;
    iccp_planar mesh;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    iccp_planar_pieces(pieces, s->domain, NULL, s->info.cells);
    ck_assert_int_eq(iccp_planar_create(&mesh, s->domain, pieces, s->info.cells, &env, NULL),
                     ICC_OK);
    ck_assert_uint_eq(mesh.n_triangles, n_triangles(s->chart));
    free(pieces);
    return mesh;
}

/* Mesh vertices, middles of edges and of triangles, the maximum and points very near it. */
static inline void check_special_points(const subject *s, double tolerance)
{
    iccp_planar mesh = mesh_of(s);
    static const double BARY[5][3] = {{1, 0, 0},
                                      {0.5, 0.5, 0},
                                      {0, 0.25, 0.75},
                                      {1 / 3.0, 1 / 3.0, 1 / 3.0},
                                      {1 - 2e-9, 1e-9, 1e-9}};
    for (size_t t = 0; t < mesh.n_triangles; t += 1 + mesh.n_triangles / 500)
        for (int k = 0; k < 5; ++k) {
            double local[2] = {0, 0}, p[2];
            for (size_t c = 0; c < 3; ++c)
                for (size_t i = 0; i < 2; ++i)
                    local[i] += BARY[k][c] * mesh.points[2 * mesh.triangles[3 * t + c] + i];
            iccp_frame_out(&s->domain->frame, 2, local, p);
            if (is_inside(s->domain, p))
                check_round_trip(s, p, tolerance);
        }
    iccp_planar_free(&mesh);
    const code top = encode_point(s->chart, s->info.maximum);
    ck_assert(top.facet == 0 && top.t >= 1 && top.bary[0] == 0.5);
    for (int k = 0; k < 64; ++k) {
        const double r = s->width * pow(10, -3 - k % 16);
        const double p[2] = {s->info.maximum[0] + r * cos(k), s->info.maximum[1] + r * sin(k)};
        if (is_inside(s->domain, p))
            check_round_trip(s, p, tolerance);
    }
}

/* Along the curve through a point t rises strictly and the foot stays. */
static inline void check_curve(const subject *s, const double p[2], double slack)
{
    enum { CAPACITY = 20000 };
    static double curve[2 * CAPACITY];
    size_t n;
    const code own = encode_point(s->chart, p);
    code foot = own;
    double start[2], last = -1;
    bool met = false;
    ck_assert_int_eq(icc_chart_trace(s->chart, p, CAPACITY, curve, &n, NULL, NULL), ICC_OK);
    ck_assert(n >= 2 && n <= CAPACITY);
    foot.t = 0;
    decode_point(s->chart, &foot, start);
    ck_assert_double_le(distance_of(start, curve), 1e-12 * s->width);
    ck_assert_mem_eq(curve + 2 * (n - 1), s->info.maximum, 2 * sizeof(double));
    for (size_t k = 0; k + 1 < n; k += 1 + n / 40) {
        const double *q = curve + 2 * k;
        const double step = distance_of(q, q + 2);
        met = met || distance_of(p, q) <= 1e-12 * s->width;
        if (k > 0 && (step < 1e-9 * s->width || !is_inside(s->domain, q)))
            continue;
        const code c = encode_point(s->chart, q);
        if (!(c.t > last))
            ck_abort_msg("t does not rise: %.17g after %.17g", c.t, last);
        last = c.t;
        const code same = {own.facet, {own.bary[0], own.bary[1]}, c.t};
        double back[2];
        decode_point(s->chart, &same, back);
        if (distance_of(back, q) > slack * s->width)
            ck_abort_msg("the curve leaves its foot by %g at t = %g",
                         distance_of(back, q) / s->width, c.t);
    }
}

/* No curve is longer than this, in widths: the longest runs along a spiral. */
enum { MAX_LENGTH = 60 };

/* Boundary points have t = 0 where they are and come back; what has t close to 0 or 1 is close to
 * them or to the maximum. */
static inline void check_boundary(const subject *s, random_source *r)
{
    for (uint32_t f = 0; f < s->domain->n_facets; ++f)
        for (int k = 0; k < 3; ++k) {
            const double along = k == 0 ? 0 : random_unit(r);
            const code c = {f, {1 - along, along}, 0};
            double p[2], back[2];
            decode_point(s->chart, &c, p);
            const code again = encode_point(s->chart, p);
            ck_assert(again.t <= 0);
            decode_point(s->chart, &again, back);
            ck_assert_double_le(distance_of(p, back), 4e-15 * s->width);
            /* The t of a disc is no length. */
            for (int e = 6; e < 320 && METHOD == ICC_METHOD_FOLIATION; e = 5 * e / 4) {
                const double near = pow(10, -e), bound = MAX_LENGTH * near + 4e-15;
                const code low = {f, {1 - along, along}, near},
                           high = {f, {1 - along, along}, 1 - near};
                decode_point(s->chart, &low, back);
                ck_assert_double_le(distance_of(p, back), bound * s->width);
                decode_point(s->chart, &high, back);
                ck_assert_double_le(distance_of(s->info.maximum, back), bound * s->width);
            }
        }
}

/* Coordinates -> point -> coordinates; near the maximum the foot is not well determined. */
static inline void check_decoding(const subject *s, random_source *r, double tolerance,
                                  double slack)
{
    const code c = {.facet = (uint32_t)random_below(r, (int)s->domain->n_facets),
                    .t = 0.01 + 0.9 * random_unit(r)};
    code given = c;
    double p[2], q[2];
    given.bary[1] = random_unit(r);
    given.bary[0] = 1 - given.bary[1];
    decode_point(s->chart, &given, p);
    const code again = encode_point(s->chart, p);
    decode_point(s->chart, &again, q);
    if (again.t <= 0 && slack > 0.1)
        return; /* everything in the corridor is on the boundary */
    if (distance_of(p, q) > tolerance * s->width || fabs(again.t - given.t) > slack)
        ck_abort_msg("t = %.17g comes back as %.17g, %g away", given.t, again.t,
                     distance_of(p, q) / s->width);
}

/* Everything above, with n random points. `tolerance` is for points that go to coordinates and
 * back, `slack` for coordinates: in a corridor as wide as w the rounding of a point moves its
 * coordinates by 1e-16 / w. */
static inline void check_chart(const shape *outline, int32_t cells, int n, double tolerance,
                               double slack)
{
    const icc_chart_options options = method_options(cells);
    subject s = subject_of(outline, &options);
    random_source r = {7 + (uint64_t)n};
    for (int k = 0; k < n; ++k) {
        double p[2];
        pick_inside(&s, &r, p);
        check_round_trip(&s, p, tolerance);
        if (k % 10 == 0)
            check_curve(&s, p, slack);
    }
    for (int k = 0; k < n; ++k)
        check_decoding(&s, &r, tolerance, slack);
    check_boundary(&s, &r);
    check_special_points(&s, tolerance);
    subject_clear(&s);
}

/* Coordinates do not depend on size, and far from zero points come back as well as they are
 * given. */
static inline void check_places(const shape *outline, int32_t cells)
{
    static const double PLACES[5][3] = {
        {0x1p-1000, 0, 0}, {0x1p900, 0, 0}, {1e300, 0, 0}, {1e-300, 0, 0}, {10, 1e9, -1e9}};
    const icc_chart_options options = method_options(cells);
    subject plain = subject_of(outline, &options);
    random_source r = {5};
    for (int k = 0; k < 5; ++k) {
        const double *place = PLACES[k];
        const shape moved = shape_moved(outline, place[0], place[1], place[2]);
        subject s = subject_of(&moved, &options);
        for (int i = 0; i < 100; ++i) {
            double p[2], q[2], back[2];
            pick_inside(&plain, &r, p);
            for (int c = 0; c < 2; ++c)
                q[c] = p[c] * place[0] + place[1 + c];
            if (!is_inside(s.domain, q))
                continue;
            const code a = encode_point(plain.chart, p), b = encode_point(s.chart, q);
            decode_point(s.chart, &b, back);
            /* Rounding the vertices may change the mesh: only scaling by powers of two rounds
             * nothing. */
            if (k < 2)
                ck_assert(a.facet == b.facet && !(fabs(a.t - b.t) > 0) &&
                          !(fabs(a.bary[1] - b.bary[1]) > 0));
            ck_assert_double_le(distance_of(back, q) / s.width, k < 4 ? 1e-12 : 5e-8);
        }
        subject_clear(&s);
    }
    subject_clear(&plain);
}

/* Facets in any order give the same coordinates under other numbers. */
static inline void check_shuffled(const shape *outline, int32_t cells)
{
    const icc_chart_options options = method_options(cells);
    subject plain = subject_of(outline, &options), s = plain;
    uint32_t facets[2 * SHAPE_MAX];
    const size_t n = outline->n;
    random_source r = {6};
    for (size_t f = 0; f < n; ++f) {
        const size_t other = (size_t)random_below(&r, (int)f + 1);
        memcpy(facets + 2 * f, facets + 2 * other, 2 * sizeof *facets);
        facets[2 * other] = (uint32_t)f;
        facets[2 * other + 1] = (uint32_t)((f + 1) % n);
    }
    ck_assert_int_eq(icc_domain_create(&s.domain, 2, n, outline->xy, n, facets, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_chart_create(&s.chart, s.domain, &options, NULL, NULL), ICC_OK);
    for (int i = 0; i < 100; ++i) {
        double p[2];
        pick_inside(&plain, &r, p);
        const code a = encode_point(plain.chart, p), b = encode_point(s.chart, p);
        ck_assert_uint_eq(facets[2 * b.facet], a.facet);
        ck_assert_double_le(fabs(a.t - b.t), 1e-12);
        ck_assert_double_le(fabs(a.bary[1] - b.bary[1]), 1e-9);
        check_round_trip(&s, p, 1e-12);
    }
    check_boundary(&s, &r);
    subject_clear(&s);
    subject_clear(&plain);
}

/* ---- maps ---- */

static inline icc_map *map_of(const icc_domain *source, const icc_domain *target, int32_t cells)
{
    const icc_chart_options chart = method_options(cells);
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    if (icc_map_create(&map, source, target, &options, NULL, &err) != ICC_OK)
        ck_abort_msg("no map: %s", err.message);
    icc_map_info info = {.size = sizeof info};
    (void)icc_map_get_info(map, &info);
    ck_assert(info.certified == 1 && info.kind == ICC_MAP_CURVES);
    return map;
}

static inline void apply(const icc_map *map, bool inverse, const double p[2], double q[2])
{
    icc_status status;
    const icc_status ran = inverse ? icc_map_apply_inverse(map, 1, p, q, &status, NULL, NULL)
                                   : icc_map_apply(map, 1, p, q, &status, NULL, NULL);
    ck_assert_int_eq(ran, ICC_OK);
    if (status != ICC_OK)
        ck_abort_msg("(%.17g, %.17g) has no image: %d", p[0], p[1], (int)status);
}

/* Facets go to facets at the same shares, both ways. */
static inline void check_boundary_map(const icc_map *map, const icc_domain *source,
                                      const icc_domain *target, const double width[2],
                                      random_source *r)
{
    for (uint32_t f = 0; f < source->n_facets; ++f)
        for (int k = 0; k < 3; ++k) {
            const double along = k == 0 ? 0 : random_unit(r), bary[2] = {1 - along, along};
            double p[2], q[2], local[2], image[2];
            iccp_domain_facet_point(source, f, bary, local);
            iccp_frame_out(&source->frame, 2, local, p);
            iccp_domain_facet_point(target, f, bary, local);
            iccp_frame_out(&target->frame, 2, local, q);
            apply(map, false, p, image);
            ck_assert_double_le(distance_of(q, image), 1e-12 * width[1]);
            apply(map, true, q, image);
            ck_assert_double_le(distance_of(p, image), 1e-12 * width[0]);
        }
}

/* Both one-sided differences agree with each other, and then with the derivative. Returns how many
 * columns could be compared. */
static inline int check_jacobian(const icc_map *map, const subject *s, const double p[2],
                                 double target_width)
{
    const double h = 1e-7 * s->width, scale = target_width / s->width;
    double j[4];
    icc_status status;
    int n = 0;
    ck_assert_int_eq(icc_map_jacobian(map, 1, p, j, &status, NULL, NULL), ICC_OK);
    ck_assert_int_eq(status, ICC_OK);
    const double det = (j[0] / scale) * (j[3] / scale) - (j[1] / scale) * (j[2] / scale);
    if (!(det > 0))
        ck_abort_msg("det %g at (%.17g, %.17g)", det, p[0], p[1]);
    for (int axis = 0; axis < 2; ++axis) {
        double q[3][2], image[3][2];
        for (int k = 0; k < 3; ++k) {
            memcpy(q[k], p, sizeof q[k]);
            q[k][axis] += (k - 1) * h;
            if (!is_inside(s->domain, q[k]))
                return n;
            apply(map, false, q[k], image[k]);
        }
        double column[2], gap = 0, size = 0;
        for (int i = 0; i < 2; ++i) {
            const double left = (image[1][i] - image[0][i]) / (q[1][axis] - q[0][axis]);
            const double right = (image[2][i] - image[1][i]) / (q[2][axis] - q[1][axis]);
            column[i] = (left + right) / 2;
            gap = fmax(gap, fabs(left - right));
            size = fmax(size, fabs(left) + fabs(j[2 * i + axis]));
        }
        if (gap > 1e-4 * size)
            continue;
        ++n;
        for (int i = 0; i < 2; ++i)
            if (fabs(column[i] - j[2 * i + axis]) > 1e-3 * size)
                ck_abort_msg("derivative %g instead of %g at (%.17g, %.17g)", j[2 * i + axis],
                             column[i], p[0], p[1]);
    }
    return n;
}

/* The subject of a map's source, borrowed. */
static inline subject source_of(const icc_map *map, const icc_domain *source)
{
    subject s = {.domain = (icc_domain *)source,
                 .chart = (icc_chart *)icc_map_source_chart(map),
                 .shape = {.size = sizeof s.shape},
                 .info = {.size = sizeof s.info}};
    (void)icc_domain_get_info(source, &s.shape);
    (void)icc_chart_get_info(s.chart, &s.info);
    s.width = fmax(s.shape.upper[0] - s.shape.lower[0], s.shape.upper[1] - s.shape.lower[1]);
    return s;
}

static inline void check_map(const shape *from, const shape *to, int32_t cells, int n)
{
    icc_domain *source = domain_of_shape(from), *target = domain_of_shape(to);
    icc_map *map = map_of(source, target, cells);
    const subject s = source_of(map, source), s_target = source_of(map, target);
    const double width[2] = {s.width, s_target.width};
    random_source r = {11 + (uint64_t)n};
    int n_compared = 0;
    for (int k = 0; k < n; ++k) {
        double p[2], q[2], back[2];
        pick_inside(&s, &r, p);
        apply(map, false, p, q);
        ck_assert(is_inside(target, q));
        apply(map, true, q, back);
        if (distance_of(p, back) > 1e-11 * s.width)
            ck_abort_msg("(%.17g, %.17g) comes back %g away", p[0], p[1],
                         distance_of(p, back) / s.width);
        n_compared += check_jacobian(map, &s, p, width[1]);
    }
    ck_assert_int_gt(n_compared, n);
    check_boundary_map(map, source, target, width, &r);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}

/* Pairs of shapes with the same number of vertices. */
enum { N_PAIRS = N_SHAPE_PAIRS + 3 };

static inline void pair_number(int k, shape *source, shape *target)
{
    switch (k) {
    case 5:
        *source = shape_wild(30, 2);
        *target = shape_wild(30, 3);
        break;
    case 6:
        *source = shape_dumbbell(0.05);
        *target = shape_wild(12, 8);
        break;
    case 7:
        *source = shape_spiral(20, 1.5);
        *target = shape_worm(20, 0.3, 0.2);
        break;
    default:
        shape_pair(k, source, target);
    }
}

/* ---- what every method promises ---- */

/* Either way round and at several resolutions. */
START_TEST(every_shape_has_coordinates)
{
    static const int32_t CELLS[] = {2, 5, 20, 50};
    const shape s = shape_number(_i), reversed = shape_reversed(&s);
    for (int k = 0; k < 4; ++k) {
        check_chart(&s, CELLS[k], 100, 1e-12, 1e-9);
        check_chart(&reversed, CELLS[k], 100, 1e-12, 1e-9);
    }
}
END_TEST

START_TEST(places_and_orders_do_not_matter)
{
    const shape s = shape_number(_i), reversed = shape_reversed(&s);
    check_places(&s, 20);
    check_places(&reversed, 11);
    check_shuffled(&s, 20);
    check_shuffled(&reversed, 11);
}
END_TEST

START_TEST(maps_are_one_to_one)
{
    shape source, target;
    pair_number(_i, &source, &target);
    check_map(&source, &target, 30, 300);
    source = shape_reversed(&source);
    target = shape_reversed(&target);
    check_map(&source, &target, 11, 300);
    check_map(&target, &source, 50, 100);
}
END_TEST

static inline void add_certified_tests(TCase *tests)
{
    tcase_add_loop_test(tests, every_shape_has_coordinates, 0, N_SHAPES);
    tcase_add_loop_test(tests, places_and_orders_do_not_matter, 0, N_SHAPES);
    tcase_add_loop_test(tests, maps_are_one_to_one, 0, N_PAIRS);
}

#endif
