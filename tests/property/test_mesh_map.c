/* What holds for the mesh map between every two shapes. */
#include "../flat_mesh.h"
#include "../reports.h"
#include "map/map.h"
#include "map/plane/plane_kind.h"
#include "math/predicates.h"

#include "../hard_shapes.h"
#include "../share.h"

#include <check.h>
#include <stdbool.h>
#include <stdlib.h>

enum { N_PAIRS = 17 };

static shape shape_c(size_t pieces)
{
    shape s = {.n = 2 * (pieces + 1)};
    for (size_t k = 0; k <= pieces; ++k) {
        const double a = -1.9 + 3.8 * (double)k / (double)pieces;
        const double outer[2] = {1.3 * cos(a), 1.3 * sin(a)},
                     inner[2] = {0.8 * cos(a), 0.8 * sin(a)};
        memcpy(s.xy + 2 * k, outer, sizeof outer);
        memcpy(s.xy + 2 * (s.n - 1 - k), inner, sizeof inner);
    }
    return s;
}

static shape shape_regular(size_t n)
{
    shape s = {.n = n};
    for (size_t k = 0; k < n; ++k) {
        const double a = 6.28318530717958647692 * (double)k / (double)n;
        s.xy[2 * k] = cos(a);
        s.xy[2 * k + 1] = sin(a);
    }
    return s;
}

/* Pairs with the same number of vertices. */
static void pair_number(int k, shape *source, shape *target)
{
    switch (k) {
    case 0:
        *source = shape_square();
        *target = shape_dart();
        break;
    case 1:
        *source = shape_l();
        *target = shape_of(6, (double[]){0, 0, 3, 0, 3, 1, 3, 3, 1, 3, 0, 3});
        break;
    case 2:
        *source = shape_star(5, 0.4, 0.1);
        *target = shape_star(5, 0.4, 0.7);
        break;
    case 3:
        *source = shape_worm(12, 0.5, 0.6);
        *target = shape_c(12);
        break;
    case 4:
        *source = shape_comb(4);
        *target = shape_star(9, 0.6, 0.1);
        break;
    case 5:
        *source = shape_needle();
        *target = shape_of(3, (double[]){0, 0, 1, 0, 0, 1});
        break;
    case 6: /* clockwise */
        *source = shape_e();
        *source = shape_reversed(source);
        *target = shape_star(6, 0.6, 0.3);
        *target = shape_reversed(target);
        break;
    case 7:
        *source = shape_l();
        *source = shape_moved(source, 10, 1e9, -1e9);
        *target = shape_star(3, 0.5, 0.2);
        break;
    case 8:
        *source = shape_l();
        *source = shape_moved(source, 1e300, 0, 0);
        *target = shape_star(3, 0.5, 0.2);
        *target = shape_moved(target, 1e-300, 0, 0);
        break;
    case 9: /* collinear vertices become corners, and back */
        *source = shape_of(8, (double[]){0, 0, .5, 0, 1, 0, 1, .5, 1, 1, .5, 1, 0, 1, 0, .5});
        *target = shape_star(4, 0.5, 0.4);
        break;
    case 10:
        *source = shape_star(4, 0.5, 0.4);
        *target = shape_of(8, (double[]){0, 0, .5, 0, 1, 0, 1, .5, 1, 1, .5, 1, 0, 1, 0, .5});
        break;
    case 11:
        *source = shape_regular(128);
        *target = shape_wild(128, 3);
        break;
    case 12:
        *source = shape_wild(16, 5);
        *target = shape_wild(16, 6);
        break;
    case 13:
        *source = shape_spiral(20, 1.5);
        *target = shape_worm(20, 0.5, 0.3);
        break;
    case 14:
        *source = shape_dumbbell(0.1);
        *target = shape_e();
        break;
    case 15: /* the same, clockwise and shuffled elsewhere */
        *source = shape_star(7, 0.7, 0.0);
        *target = shape_star(7, 0.3, 0.0);
        break;
    default:
        *source = shape_channel(30);
        *target = shape_square();
    }
}

/* For odd pairs the facets come in another order, which is the same for both shapes. */
static icc_domain *domain_of(const shape *s, bool shuffled)
{
    icc_domain *domain;
    uint32_t facets[2 * SHAPE_MAX];
    for (size_t f = 0; f < s->n; ++f) {
        const uint32_t k = (uint32_t)((f * 7 + 3) % s->n);
        facets[2 * f] = k;
        facets[2 * f + 1] = (uint32_t)((k + 1) % s->n);
    }
    shuffled = shuffled && s->n % 7 != 0;
    ck_assert_int_eq(icc_domain_create(&domain, 2, s->n, s->xy, shuffled ? s->n : 0,
                                       shuffled ? facets : NULL, NULL, NULL),
                     ICC_OK);
    return domain;
}

static icc_map *map_between(const shape *source, const shape *target, bool shuffled,
                            int32_t iterations, const icc_env *env)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_domain *a = domain_of(source, shuffled), *b = domain_of(target, shuffled);
    icc_map *map;
    icc_error err = {.size = sizeof err};
    if (icc_map_create(&map, a, b, &options, env, &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    icc_domain_free(a);
    icc_domain_free(b);
    return map;
}

static icc_map *map_number(int k, int32_t iterations, const icc_env *env)
{
    shape source, target;
    pair_number(k, &source, &target);
    return map_between(&source, &target, k % 2 == 1, iterations, env);
}

static icc_map_info info_of(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    return info;
}

static double width(const icc_domain *domain)
{
    icc_domain_info d = {.size = sizeof d};
    ck_assert_int_eq(icc_domain_get_info(domain, &d), ICC_OK);
    return fmax(d.upper[0] - d.lower[0], d.upper[1] - d.lower[1]);
}

/* Of the width: what the caller's coordinates can tell, far from the origin for one pair. */
static double rounding(int k)
{
    return k == 7 ? 1e-7 : 1e-12;
}

static double distance(const double a[2], const double b[2])
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

/* ---- the certificate ---- */

static double check_triangles(const icc_map *map, const double *points)
{
    const iccp_plmap *pl = &iccp_plane_of(map)->pl;
    long double twice = 0;
    size_t n_faults = 0;
    for (size_t t = 0; t < pl->corners.n_triangles; ++t) {
        const uint32_t *v = pl->corners.vertex + 3 * t;
        const double *a = points + 2 * v[0], *b = points + 2 * v[1], *c = points + 2 * v[2];
        n_faults += iccp_orient2d(a, b, c) <= 0;
        twice += ((long double)b[0] - a[0]) * ((long double)c[1] - a[1]) -
                 ((long double)b[1] - a[1]) * ((long double)c[0] - a[0]);
    }
    ck_assert_uint_eq(n_faults, 0);
    return (double)(twice / 2);
}

START_TEST(every_triangle_is_positive_and_they_cover_both_shapes)
{
    for (int k = 0; k < N_PAIRS; ++k)
        for (int32_t iterations = -1; iterations <= 3; iterations += 2) {
            icc_map *map = map_number(k, iterations, NULL);
            const icc_map_info info = info_of(map);
            if (info.kind != ICC_MAP_MESH)
                ck_abort_msg("pair %d has no mesh map", k);
            ck_assert_int_eq(info.certified, 1);
            ck_assert_uint_eq(report_of(map).n_unrepaired, 0);
            const double before = check_triangles(map, iccp_plane_of(map)->pl.points);
            const double after = check_triangles(map, iccp_plane_of(map)->pl.images);
            ck_assert_double_eq_tol(before / map->source_domain->measure, 1, 1e-12);
            ck_assert_double_eq_tol(after / map->target_domain->measure, 1, 1e-12);
            ck_assert_double_le(info.energy, report_of(map).energy_start * (1 + 1e-14));
            ck_assert_double_ge(info.energy, 4 - 1e-9);
            ck_assert(iterations >= 0 ||
                      (report_of(map).n_iterations == 0 && report_of(map).n_levels == 0));
            icc_map_free(map);
        }
}
END_TEST

/* The mesh in the caller's coordinates is the map. */
START_TEST(the_mesh_is_the_map)
{
    for (int k = 0; k < N_PAIRS; ++k) {
        icc_map *map = map_number(k, 0, NULL);
        const icc_map_info info = info_of(map);
        const size_t n = info.n_vertices;
        double *vertices = malloc(6 * n * sizeof *vertices);
        uint32_t *triangles = malloc(3 * info.n_simplices * sizeof *triangles);
        ck_assert(vertices != NULL && triangles != NULL);
        double *images = vertices + 2 * n, *mapped = vertices + 4 * n;
        ck_assert_int_eq(flat_get_mesh(map, vertices, images, triangles), ICC_OK);
        ck_assert_int_eq(flat_get_mesh(map, NULL, NULL, NULL), ICC_OK);
        size_t n_failed;
        for (int inverse = 0; inverse < 2; ++inverse) {
            const double *from = inverse ? images : vertices, *to = inverse ? vertices : images;
            const icc_domain *domain = inverse ? map->source_domain : map->target_domain;
            ck_assert_int_eq((inverse ? icc_map_apply_inverse
                                      : icc_map_apply)(map, n, from, mapped, NULL, &n_failed, NULL),
                             ICC_OK);
            ck_assert_uint_eq(n_failed, 0);
            double worst = 0;
            for (size_t v = 0; v < n; ++v)
                worst = fmax(worst, distance(mapped + 2 * v, to + 2 * v));
            if (!(worst <= rounding(k) * width(domain)))
                ck_abort_msg("pair %d, inverse %d: a vertex is %g off", k, inverse,
                             worst / width(domain));
        }
        for (size_t c = 0; c < 3 * info.n_simplices; ++c)
            if (triangles[c] >= n)
                ck_abort_msg("pair %d: no such vertex", k);
        free(vertices);
        free(triangles);
        icc_map_free(map);
    }
}
END_TEST

/* ---- points ---- */

static void pick_inside(const icc_domain *domain, random_source *r, double p[2])
{
    icc_domain_info d = {.size = sizeof d};
    (void)icc_domain_get_info(domain, &d);
    int32_t where = ICC_OUTSIDE;
    while (where != ICC_INSIDE) {
        for (int k = 0; k < 2; ++k)
            p[k] = random_between(r, d.lower[k], d.upper[k]);
        (void)icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL);
    }
}

/* A point in a triangle of the mesh: inside, on an edge, or a corner. */
static void pick_in_mesh(const icc_map *map, random_source *r, double p[2])
{
    const iccp_plmap *pl = &iccp_plane_of(map)->pl;
    const uint32_t *v =
        pl->corners.vertex + 3 * (size_t)random_below(r, (int)pl->corners.n_triangles);
    double w[3] = {random_unit(r), random_below(r, 2) * random_unit(r),
                   random_below(r, 2) * random_unit(r)};
    double q[2] = {0, 0};
    for (int k = 0; k < 3; ++k)
        for (int d = 0; d < 2; ++d)
            q[d] += w[k] / (w[0] + w[1] + w[2]) * pl->points[2 * v[k] + (size_t)d];
    iccp_frame_out(&map->source_domain->frame, 2, q, p);
}

/* How far the inverse takes apart what rounding has done to a point. */
static double stretch_of_inverse(const icc_map *map, const double p[2])
{
    double j[4];
    icc_status status;
    ck_assert_int_eq(icc_map_jacobian(map, 1, p, j, &status, NULL, NULL), ICC_OK);
    if (status != ICC_OK)
        return 1;
    const double det = j[0] * j[3] - j[1] * j[2];
    const double norm = sqrt(j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3]) / det;
    return fmax(1, norm * width(map->target_domain) / width(map->source_domain));
}

START_TEST(points_come_back)
{
    for (int k = 0; k < N_PAIRS; ++k) {
        if (k == 8)
            continue; /* its Jacobians overflow */
        icc_map *map = map_number(k, 0, NULL);
        random_source r = {(uint64_t)k};
        double worst = 0;
        for (int i = 0; i < share_of(2000); ++i) {
            double p[2], q[2], back[2];
            icc_status status[2];
            if (i % 2)
                pick_inside(map->source_domain, &r, p);
            else
                pick_in_mesh(map, &r, p);
            (void)icc_map_apply(map, 1, p, q, &status[0], NULL, NULL);
            (void)icc_map_apply_inverse(map, 1, q, back, &status[1], NULL, NULL);
            if (status[0] != ICC_OK || status[1] != ICC_OK)
                ck_abort_msg("pair %d: point (%.17g, %.17g): status %d %d", k, p[0], p[1],
                             (int)status[0], (int)status[1]);
            worst = fmax(worst, distance(p, back) / width(map->source_domain) /
                                    stretch_of_inverse(map, p));
        }
        if (!(worst <= rounding(k)))
            ck_abort_msg("pair %d: a point is %g off", k, worst);
        icc_map_free(map);
    }
}
END_TEST

/* On facets the map is the correspondence of the cages. */
START_TEST(boundaries_correspond)
{
    for (int k = 0; k < N_PAIRS; ++k) {
        icc_map *map = map_number(k, 2, NULL);
        const icc_domain *a = map->source_domain, *b = map->target_domain;
        random_source r = {(uint64_t)k};
        double worst[2] = {0, 0};
        for (uint32_t f = 0; f < a->n_facets; ++f)
            for (int i = 0; i < 20; ++i) {
                const double t = i == 0 ? 0 : random_unit(&r);
                double p[2], q[2], image[2], ends[4][2];
                for (size_t j = 0; j < 2; ++j) {
                    iccp_domain_given(a, a->facets[2 * f + j], ends[j]);
                    iccp_domain_given(b, b->facets[2 * f + j], ends[2 + j]);
                }
                for (size_t d = 0; d < 2; ++d) {
                    p[d] = (1 - t) * ends[0][d] + t * ends[1][d];
                    q[d] = (1 - t) * ends[2][d] + t * ends[3][d];
                }
                icc_status status;
                (void)icc_map_apply(map, 1, p, image, &status, NULL, NULL);
                ck_assert_int_eq(status, ICC_OK);
                worst[0] = fmax(worst[0], distance(image, q));
                (void)icc_map_apply_inverse(map, 1, q, image, &status, NULL, NULL);
                ck_assert_int_eq(status, ICC_OK);
                worst[1] = fmax(worst[1], distance(image, p));
            }
        if (!(worst[0] <= rounding(k) * width(b)) || !(worst[1] <= rounding(k) * width(a)))
            ck_abort_msg("pair %d: %g and %g off", k, worst[0] / width(b), worst[1] / width(a));
        icc_map_free(map);
    }
}
END_TEST

/* At the middles of triangles: positive, and what differences say. */
START_TEST(jacobians_are_those_of_the_triangles)
{
    for (int k = 0; k < N_PAIRS; ++k) {
        if (k == 8)
            continue;
        icc_map *map = map_number(k, 0, NULL);
        const iccp_plmap *pl = &iccp_plane_of(map)->pl;
        double worst = 0;
        for (size_t t = 0; t < pl->corners.n_triangles; t += 7) {
            const uint32_t *v = pl->corners.vertex + 3 * t;
            double local[2], c[2], p[4], q[4], j[4];
            icc_status status;
            for (size_t d = 0; d < 2; ++d)
                local[d] = (pl->points[2 * v[0] + d] + pl->points[2 * v[1] + d] +
                            pl->points[2 * v[2] + d]) /
                           3;
            iccp_frame_out(&map->source_domain->frame, 2, local, c);
            ck_assert_int_eq(icc_map_jacobian(map, 1, c, j, &status, NULL, NULL), ICC_OK);
            ck_assert_int_eq(status, ICC_OK);
            if (!(j[0] * j[3] - j[1] * j[2] > 0))
                ck_abort_msg("pair %d: determinant %g", k, j[0] * j[3] - j[1] * j[2]);
            /* Half the way to two corners, so that the differences are not lost in rounding. */
            for (size_t i = 0; i < 2; ++i)
                for (size_t d = 0; d < 2; ++d)
                    local[d] = pl->points[2 * v[i] + d] * 0.5 +
                               ((pl->points[2 * v[0] + d] + pl->points[2 * v[1] + d] +
                                 pl->points[2 * v[2] + d]) /
                                3) *
                                   0.5,
                    p[2 * i + d] = local[d] * map->source_domain->frame.out[0] *
                                       map->source_domain->frame.out[1] +
                                   map->source_domain->frame.shift[d];
            double image[2];
            (void)icc_map_apply(map, 2, p, q, NULL, NULL, NULL);
            (void)icc_map_apply(map, 1, c, image, NULL, NULL, NULL);
            for (size_t i = 0; i < 2; ++i)
                for (size_t d = 0; d < 2; ++d) {
                    const double x = p[2 * i] - c[0], y = p[2 * i + 1] - c[1];
                    const double linear = j[2 * d] * x + j[2 * d + 1] * y;
                    worst = fmax(worst, fabs(linear - (q[2 * i + d] - image[d])) /
                                            width(map->target_domain) / stretch_of_inverse(map, c));
                }
        }
        if (!(worst <= rounding(k)))
            ck_abort_msg("pair %d: %g", k, worst);
        icc_map_free(map);
    }
}
END_TEST

START_TEST(points_that_have_no_image)
{
    icc_map *map = map_number(0, 0, NULL);
    const double points[8] = {2, 2, NAN, 0, HUGE_VAL, 0, 0.5, 0};
    double images[8], j[16];
    icc_status status[4];
    size_t n_failed;
    ck_assert_int_eq(icc_map_apply(map, 4, points, images, status, &n_failed, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 3);
    ck_assert(status[0] == ICC_ERR_OUTSIDE && status[1] == ICC_ERR_ARGUMENT &&
              status[2] == ICC_ERR_ARGUMENT && status[3] == ICC_OK);
    for (int i = 0; i < 6; ++i)
        ck_assert(isnan(images[i]));
    ck_assert_int_eq(icc_map_jacobian(map, 4, points, j, status, &n_failed, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 4);
    ck_assert(status[3] == ICC_ERR_TRACE && isnan(j[15]));
    icc_map_free(map);
}
END_TEST

/* Stars with spikes of very different lengths. */
START_TEST(wild_shapes_have_a_mesh_too)
{
    for (uint64_t seed = 5; seed < 8; ++seed) {
        const shape source = shape_wild(40, seed), target = shape_wild(40, seed + 1);
        icc_map *map = map_between(&source, &target, false, -1, NULL);
        const icc_map_info info = info_of(map);
        if (info.kind != ICC_MAP_MESH)
            ck_abort_msg("seed %d has no mesh map", (int)seed);
        const double before = check_triangles(map, iccp_plane_of(map)->pl.points);
        const double after = check_triangles(map, iccp_plane_of(map)->pl.images);
        ck_assert_double_eq_tol(before / map->source_domain->measure, 1, 1e-12);
        ck_assert_double_eq_tol(after / map->target_domain->measure, 1, 1e-12);
        icc_map_free(map);
    }
}
END_TEST

/* ---- fairness ---- */

START_TEST(a_shape_maps_to_itself)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        icc_map *map = map_between(&s, &s, k % 2, 0, NULL);
        ck_assert_double_eq_tol(info_of(map).energy, 4, 1e-9);
        random_source r = {(uint64_t)k};
        double worst = 0;
        for (int i = 0; i < share_of(500); ++i) {
            double p[2], q[2];
            pick_inside(map->source_domain, &r, p);
            (void)icc_map_apply(map, 1, p, q, NULL, NULL, NULL);
            worst = fmax(worst, distance(p, q));
        }
        ck_assert_double_le(worst, 1e-12 * width(map->source_domain));
        icc_map_free(map);
    }
}
END_TEST

static icc_map *improve(const icc_map *map, const icc_improve_options *options,
                        icc_improve_report *report, const icc_env *env)
{
    icc_map *better;
    *report = (icc_improve_report){.size = sizeof *report};
    ck_assert_int_eq(icc_map_improve(&better, map, options, report, env, NULL), ICC_OK);
    ck_assert_double_le(report->energy, report->energy_start * (1 + 1e-14));
    ck_assert_double_eq(report->energy, info_of(better).energy);
    ck_assert_uint_eq(report->n_simplices, info_of(better).n_simplices);
    (void)check_triangles(better, iccp_plane_of(better)->pl.points);
    (void)check_triangles(better, iccp_plane_of(better)->pl.images);
    return better;
}

/* In one go or afterwards; the map that is given stays. */
START_TEST(maps_can_be_improved_later)
{
    for (int k = 0; k < N_PAIRS; ++k) {
        icc_map *plain = map_number(k, -1, NULL), *fair = map_number(k, 0, NULL);
        const size_t n = info_of(plain).n_vertices;
        double *images = malloc(4 * n * sizeof *images);
        ck_assert_ptr_nonnull(images);
        (void)flat_get_mesh(plain, NULL, images, NULL);
        icc_improve_report report;
        icc_map *better = improve(plain, NULL, &report, NULL);
        (void)flat_get_mesh(plain, NULL, images + 2 * n, NULL);
        ck_assert_mem_eq(images, images + 2 * n, 2 * n * sizeof *images);
        ck_assert_double_eq(report.energy_start, info_of(plain).energy);
        ck_assert_double_eq_tol(report.energy / info_of(fair).energy, 1, 1e-9);
        const icc_improve_options few = {.size = sizeof few, .iterations = 1, .levels = -1};
        icc_map *slightly = improve(plain, &few, &report, NULL);
        ck_assert_uint_le(report.n_iterations, 1);
        ck_assert_int_eq(report.n_levels, 0);
        ck_assert_uint_eq(info_of(slightly).n_vertices, n);
        icc_map_free(slightly);
        icc_map_free(better);
        icc_map_free(plain);
        icc_map_free(fair);
        free(images);
    }
}
END_TEST

/* Cancelled at the k-th report. */
static int32_t stop_at(void *user, const char *stage, double share)
{
    int *left = user;
    (void)stage;
    (void)share;
    return --*left <= 0;
}

START_TEST(cancelled_improvement_is_certified)
{
    icc_map *plain = map_number(1, -1, NULL);
    double last = info_of(plain).energy;
    bool cancelled = true;
    for (int k = 1; cancelled; ++k) {
        int left = k;
        const icc_env env = {.size = sizeof env, .user = &left, .progress = stop_at};
        icc_improve_report report;
        icc_map *better = improve(plain, NULL, &report, &env);
        cancelled = report.cancelled;
        ck_assert_double_le(report.energy, last * (1 + 1e-12));
        last = report.energy;
        icc_map_free(better);
    }
    ck_assert_double_lt(last, 0.95 * info_of(plain).energy);
    icc_map_free(plain);
}
END_TEST

/* ---- work ---- */

static double allowed(size_t n_facets)
{
    return 3e5 + 300 * (double)n_facets;
}

/* Improvement may take as much as is allowed, and relaxing an overlay half of that. Both of them,
 * with the overlay's crossings, take no more than a budget. */
START_TEST(work_is_bounded)
{
    for (int k = 0; k < N_PAIRS + 3; ++k) {
        const uint64_t seed = (uint64_t)(k + 5 - N_PAIRS);
        const shape source = shape_wild(40, seed), target = shape_wild(40, seed + 1);
        icc_map *map =
            k < N_PAIRS ? map_number(k, 0, NULL) : map_between(&source, &target, false, 0, NULL);
        const double most = allowed(map->source_domain->n_facets);
        ck_assert(iccp_plane_of(map)->work > 0 || report_of(map).n_iterations == 0);
        const double n = (double)map->source_domain->n_facets;
        ck_assert_double_le(iccp_plane_of(map)->work,
                            fmin(1.5 * most + 4 * n * n, 1.6e6 + 225 * n));
        icc_improve_report report;
        icc_map *better = improve(map, NULL, &report, NULL);
        ck_assert_double_le(iccp_plane_of(better)->work, most);
        ck_assert_uint_le(report.n_simplices, 4 * info_of(map).n_simplices + 32000);
        icc_map_free(better);
        icc_map_free(map);
    }
}
END_TEST

typedef struct log_counts {
    int n_overlays, n_crossings;
} log_counts;

static void listen(void *user, const char *message)
{
    log_counts *t = user;
    t->n_overlays += strstr(message, "making an overlay") != NULL;
    t->n_crossings += strstr(message, "cross too often") != NULL;
}

/* A band and the same band with its vertices moved on by a quarter of the outline: all diagonals
 * cross. The overlay is tried once, the log says why it is given up, and curves are the best that
 * can be had. */
START_TEST(what_crosses_too_often_is_of_kind_curves)
{
    enum { N = 1200 };
    static double xy[2][2 * N];
    icc_domain *domains[2];
    icc_map *map;
    log_counts t = {0, 0};
    const icc_env env = {.size = sizeof env, .user = &t, .log = listen};
    for (size_t k = 0; k < N; ++k) {
        const bool below = k < N / 2;
        xy[0][2 * k] = (double)(below ? k : N - 1 - k);
        xy[0][2 * k + 1] = below ? 0 : 1;
    }
    for (size_t k = 0; k < N; ++k)
        memcpy(xy[1] + 2 * k, xy[0] + 2 * ((k + N / 4) % N), 2 * sizeof(double));
    for (int k = 0; k < 2; ++k)
        ck_assert_int_eq(icc_domain_create(&domains[k], 2, N, xy[k], 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, domains[0], domains[1], NULL, &env, NULL), ICC_OK);
    ck_assert_int_eq(info_of(map).kind, ICC_MAP_CURVES);
    ck_assert_int_eq(info_of(map).certified, 1);
    ck_assert_int_eq(t.n_overlays, 1);
    ck_assert_int_eq(t.n_crossings, 1);
    icc_map_free(map);
    const icc_map_options mesh = {.size = sizeof mesh, .kind = ICC_MAP_MESH};
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_map_create(&map, domains[0], domains[1], &mesh, NULL, &err),
                     ICC_ERR_CERTIFICATE);
    ck_assert_ptr_null(map);
    ck_assert_ptr_nonnull(strstr(err.message, "kind 0"));
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
}
END_TEST

/* ---- the same bits ---- */

static void run_backwards(void *user, size_t n_tasks, icc_task task, void *argument)
{
    (void)user;
    for (size_t i = n_tasks; i-- > 0;)
        task(argument, i);
}

static bool is_same(const icc_map *a, const icc_map *b)
{
    const iccp_plmap *p = &iccp_plane_of(a)->pl, *q = &iccp_plane_of(b)->pl;
    return p->n_vertices == q->n_vertices && p->corners.n_triangles == q->corners.n_triangles &&
           memcmp(p->points, q->points, 2 * p->n_vertices * sizeof *p->points) == 0 &&
           memcmp(p->images, q->images, 2 * p->n_vertices * sizeof *p->images) == 0 &&
           memcmp(p->corners.vertex, q->corners.vertex,
                  3 * p->corners.n_triangles * sizeof *p->corners.vertex) == 0;
}

START_TEST(the_same_bits_every_time)
{
    for (int k = 0; k < N_PAIRS; k += 4) {
        icc_map *first = map_number(k, 0, NULL);
        for (int32_t threads = 1; threads <= 9; threads += 2) {
            const icc_env env = {.size = sizeof env,
                                 .threads = threads < 9 ? threads : 0,
                                 .parallel_for = threads < 9 ? NULL : run_backwards};
            icc_map *again = map_number(k, 0, &env);
            ck_assert(is_same(first, again));
            icc_improve_report report;
            icc_map *better = improve(first, NULL, &report, NULL);
            icc_map *better_again = improve(again, NULL, &report, &env);
            ck_assert(is_same(better, better_again));
            icc_map_free(better);
            icc_map_free(better_again);
            icc_map_free(again);
        }
        icc_map_free(first);
    }
}
END_TEST

/* ---- overlays in patches ---- */

enum { FLOWER = 1000 };

/* An outline with petals of the given depth. */
static icc_domain *create_flower(double petals, double depth, double phase)
{
    static double xy[2 * FLOWER];
    icc_domain *domain;
    for (size_t k = 0; k < FLOWER; ++k) {
        const double angle = 6.28318530717958647692 * (double)k / FLOWER;
        const double radius = 1 + depth * cos(petals * angle + phase);
        xy[2 * k] = radius * cos(angle);
        xy[2 * k + 1] = radius * sin(angle);
    }
    ck_assert_int_eq(icc_domain_create(&domain, 2, FLOWER, xy, 0, NULL, NULL, NULL), ICC_OK);
    return domain;
}

static icc_map *create_flower_map(const icc_domain *source, const icc_domain *target,
                                  int32_t iterations)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, target, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of(map).kind, ICC_MAP_MESH);
    ck_assert_int_eq(info_of(map).certified, 1);
    return map;
}

/* Some triangles of the chart's mesh are inverted, but most of its inner vertices are vertices of
 * the map. An overlay of the whole has none of them. */
static void check_patched(const icc_map *map)
{
    const iccp_planar *mesh = map->source->mesh;
    const iccp_plmap *pl = &iccp_plane_of(map)->pl;
    const size_t n_inner = mesh->n_vertices - mesh->n_boundary;
    size_t n_kept = 0;
    for (size_t v = mesh->n_boundary; v < mesh->n_vertices; ++v)
        for (size_t w = mesh->n_boundary; w < pl->n_vertices; ++w)
            if (memcmp(mesh->points + 2 * v, pl->points + 2 * w, 2 * sizeof(double)) == 0) {
                ++n_kept;
                break;
            }
    ck_assert_uint_gt(report_of(map).n_inverted, 0);
    ck_assert_uint_gt(n_kept, n_inner / 2);
    ck_assert_uint_lt(n_kept, n_inner);
}

static icc_map *load_again(const icc_map *map)
{
    size_t n;
    icc_map *loaded;
    ck_assert_int_eq(icc_map_save(map, 0, NULL, &n), ICC_OK);
    void *data = malloc(n);
    ck_assert_int_eq(icc_map_save(map, n, data, &n), ICC_OK);
    ck_assert_int_eq(icc_map_load(&loaded, n, data, NULL, NULL), ICC_OK);
    free(data);
    return loaded;
}

/* The map's own mesh, certified by the map. */
static icc_certificate certificate_of(const icc_map *map)
{
    const icc_map_info info = info_of(map);
    icc_certificate certificate = {.size = sizeof certificate};
    double *points = calloc(info.n_vertices, 2 * sizeof *points);
    double *images = calloc(info.n_vertices, 2 * sizeof *images);
    uint32_t *corners = calloc(info.n_simplices, 3 * sizeof *corners);
    ck_assert_int_eq(flat_get_mesh(map, points, NULL, corners), ICC_OK);
    ck_assert_int_eq(flat_certify(map, info.n_vertices, points, info.n_simplices, corners, images,
                                  &certificate, NULL, NULL),
                     ICC_OK);
    free(points);
    free(images);
    free(corners);
    return certificate;
}

static void check_same_map(const icc_map *a, const icc_map *b)
{
    const icc_map_info i = info_of(a), j = info_of(b);
    const icc_certificate c = certificate_of(a), d = certificate_of(b);
    ck_assert(is_same(a, b));
    ck_assert_int_eq(i.kind, ICC_MAP_MESH);
    ck_assert_int_eq(i.certified, 1);
    ck_assert_int_eq(j.certified, 1);
    ck_assert_double_eq(i.energy, j.energy);
    ck_assert_int_eq(c.certified, d.certified);
    ck_assert_uint_eq(c.n_inverted, d.n_inverted);
    ck_assert_uint_eq(c.n_no_image, d.n_no_image);
}

static icc_map *retarget(const icc_map *map, const icc_domain *target)
{
    icc_map *next;
    ck_assert_int_eq(icc_map_retarget(&next, map, target, NULL, NULL, NULL), ICC_OK);
    return next;
}

/* The start, and the map that is made of it. */
START_TEST(overlays_in_patches_are_maps_like_others)
{
    icc_domain *source = create_flower(5, 0.4, 0), *target = create_flower(4, 0.4, 1);
    icc_domain *moved = create_flower(4, 0.38, 1.05);
    icc_map *start = create_flower_map(source, target, -1);
    check_patched(start);
    icc_map_free(start);
    icc_map *map = create_flower_map(source, target, 0), *loaded = load_again(map);
    check_same_map(map, loaded);
    icc_map *next[2] = {retarget(map, moved), retarget(loaded, moved)};
    check_same_map(next[0], next[1]);
    icc_improve_report report[2];
    icc_map *better[2] = {improve(map, NULL, &report[0], NULL),
                          improve(loaded, NULL, &report[1], NULL)};
    check_same_map(better[0], better[1]);
    ck_assert_double_eq(report[0].energy, report[1].energy);
    ck_assert_uint_eq(report[0].n_iterations, report[1].n_iterations);
    for (int k = 0; k < 2; ++k) {
        icc_map_free(next[k]);
        icc_map_free(better[k]);
    }
    icc_map_free(map);
    icc_map_free(loaded);
    icc_domain_free(source);
    icc_domain_free(target);
    icc_domain_free(moved);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("mesh map");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, every_triangle_is_positive_and_they_cover_both_shapes);
    tcase_add_test(tests, the_mesh_is_the_map);
    tcase_add_test(tests, points_come_back);
    tcase_add_test(tests, boundaries_correspond);
    tcase_add_test(tests, jacobians_are_those_of_the_triangles);
    tcase_add_test(tests, points_that_have_no_image);
    tcase_add_test(tests, wild_shapes_have_a_mesh_too);
    tcase_add_test(tests, a_shape_maps_to_itself);
    tcase_add_test(tests, maps_can_be_improved_later);
    tcase_add_test(tests, cancelled_improvement_is_certified);
    tcase_add_test(tests, work_is_bounded);
    tcase_add_test(tests, what_crosses_too_often_is_of_kind_curves);
    tcase_add_test(tests, the_same_bits_every_time);
    tcase_add_test(tests, overlays_in_patches_are_maps_like_others);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
