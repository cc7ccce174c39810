/* Samplings: grids, blue noise, the caller's points, bytes. */
#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../gaussians.h"
#include "../../../random.h"
#include "../../../regions.h"
#include "../../../suite.h"
#include "base/blob.h"
#include "kernel/sampling/point_list.h"
#include "kernel/sampling/sampling.h"
#include "kernel/sampling/spectrum.h"

#include <stdlib.h>
#include <string.h>

static icc_sampling *sample(const icc_shape *shape, const icc_sampling_options *options)
{
    icc_sampling *sampling;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_sampling_create(&sampling, shape, options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return sampling;
}

static icc_sampling_info info_of(const icc_sampling *sampling)
{
    icc_sampling_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_sampling_get_info(sampling, &info), ICC_OK);
    return info;
}

static double *points_of(const icc_sampling *sampling)
{
    const icc_sampling_info info = info_of(sampling);
    double *points = malloc(info.n_samples * (size_t)info.dim * sizeof *points);
    ck_assert_ptr_nonnull(points);
    ck_assert_int_eq(icc_sampling_get_points(sampling, points), ICC_OK);
    return points;
}

static icc_sampling_options blue(double spacing, uint64_t seed)
{
    return (icc_sampling_options){
        .size = sizeof(icc_sampling_options), .spacing = spacing, .seed = seed};
}

static bool same_samples(const icc_sampling *a, const icc_sampling *b)
{
    const icc_sampling_info x = info_of(a), y = info_of(b);
    return x.n_samples == y.n_samples && memcmp(&x, &y, sizeof x) == 0 &&
           memcmp(a->points, b->points, x.n_samples * (size_t)x.dim * sizeof(double)) == 0;
}

/* -------------------------------------------------------------------- grid */

/* Sections 3.3.1: 41 x 41 samples, T = 2 and 0.5; table 4.1: 101 x 101, T = 0.1. */
START_TEST(grids_of_the_thesis_are_exact)
{
    static const double SPACING[] = {2, 0.5, 0.1}, COUNT[] = {41, 41, 101};
    for (int i = 0; i < 3; ++i) {
        const double spacing = SPACING[i], half = 0.5 * (COUNT[i] - 1) * spacing;
        const size_t n = (size_t)COUNT[i];
        icc_shape *shape = square_shape(half);
        const icc_sampling_options options = {
            .size = sizeof options, .kind = ICC_SAMPLING_GRID, .spacing = spacing};
        icc_sampling *sampling = sample(shape, &options);
        const icc_sampling_info info = info_of(sampling);
        ck_assert_uint_eq(info.n_samples, n * n);
        ck_assert_uint_eq(info.n_edge, 4 * (n - 1));
        ck_assert(fabs(info.nearest - 1) < 1e-12);
        ck_assert(fabs(info.sigma - 3 * spacing / 3.14159265358979324) < 1e-12 * spacing);
        double *points = points_of(sampling);
        for (size_t k = 0; k < n * n; ++k) {
            ck_assert(points[2 * k] == -half + (double)(k % n) * spacing);
            ck_assert(points[2 * k + 1] == -half + (double)(k / n) * spacing);
        }
        free(points);
        icc_sampling_free(sampling);
        icc_shape_free(shape);
    }
}
END_TEST

/* All points of the lattice within the margin of the regions, and no others. */
START_TEST(grids_go_as_far_as_their_margin)
{
    for (int m = 0; m <= 3; ++m) {
        icc_shape *shape = square_shape(1);
        const icc_sampling_options options = {
            .size = sizeof options, .kind = ICC_SAMPLING_GRID, .spacing = 0.125, .margin = m};
        icc_sampling *sampling = sample(shape, &options);
        size_t expected = 0;
        for (int i = -8 - m; i <= 8 + m; ++i)
            for (int j = -8 - m; j <= 8 + m; ++j) {
                const int x = abs(i) > 8 ? abs(i) - 8 : 0, y = abs(j) > 8 ? abs(j) - 8 : 0;
                expected += x * x + y * y <= m * m;
            }
        ck_assert_uint_eq(info_of(sampling).n_samples, expected);
        icc_sampling_free(sampling);
        icc_shape_free(shape);
    }
}
END_TEST

/* Looking at every point of the lattice by itself finds the same. */
START_TEST(grids_fill_shapes_of_any_form)
{
    icc_shape *shape = star_shape();
    double star[20];
    star_outline(star);
    icc_domain *const region = polygon_of(10, star);
    icc_shape *lone = shape_of(2, 1, &region);
    for (int k = 0; k < 4; ++k) {
        const double spacing = 0.011 + 0.013 * k;
        const icc_sampling_options options = {
            .size = sizeof options, .kind = ICC_SAMPLING_GRID, .spacing = spacing};
        icc_sampling *sampling = sample(lone, &options);
        size_t expected = 0;
        for (double y = lone->lower[1]; y <= lone->upper[1]; y += spacing)
            for (double x = lone->lower[0]; x <= lone->upper[0]; x += spacing) {
                const double p[2] = {x, y};
                expected += iccp_shape_region(shape, p) == 0;
            }
        const size_t n = info_of(sampling).n_samples;
        ck_assert_msg(n <= expected + 3 && expected <= n + 3, "%zu, not %zu", n, expected);
        icc_sampling_free(sampling);
    }
    icc_shape_free(lone);
    icc_shape_free(shape);
}
END_TEST

/* -------------------------------------------------------------- blue noise */

/* How far a place in the star or the square can be from all samples. */
static double largest_hole(const icc_sampling *sampling)
{
    const iccp_env env = default_env();
    const icc_sampling_info info = info_of(sampling);
    iccp_cells cells;
    uint32_t near[64];
    double largest = 0;
    ck_assert_int_eq(
        iccp_cells_create(&cells, 2, info.n_samples, sampling->points, info.spacing, &env), ICC_OK);
    for (int i = 0; i < 300; ++i)
        for (int j = 0; j < 300; ++j) {
            const double p[2] = {1.33 * (i - 149.5) / 150, 1.33 * (j - 149.5) / 150};
            size_t n = 0;
            double radius = 0.5;
            while ((n = iccp_cells_near(&cells, p, radius * info.spacing, 64, near)) == 0)
                radius += 0.02;
            largest = fmax(largest, radius);
        }
    iccp_cells_free(&cells);
    return largest;
}

/* The thesis' star: 9,600 samples. */
START_TEST(blue_noise_is_evenly_spaced_and_keeps_to_its_side)
{
    icc_shape *shape = star_shape();
    for (uint64_t seed = 0; seed < 4; ++seed) {
        const icc_sampling_options options = blue(0.0296, seed);
        icc_sampling *sampling = sample(shape, &options);
        const icc_sampling_info info = info_of(sampling);
        size_t n_star = 0;
        ck_assert_msg(info.n_samples > 9000 && info.n_samples < 10000, "%zu", info.n_samples);
        ck_assert_msg(info.nearest >= 0.55, "nearest: %g T", info.nearest);
        ck_assert_msg(largest_hole(sampling) <= 0.9, "a hole");
        for (size_t i = 0; i < info.n_samples; ++i) {
            const iccp_spot spot = iccp_shape_spot(shape, sampling->points + 2 * i);
            ck_assert_uint_ne(spot.region, ICCP_NOWHERE);
            ck_assert_int_eq(spot.wall != ICCP_NOWHERE, i < info.n_edge);
            n_star += spot.region == 0;
        }
        /* As dense inside as outside: 1.1756 of 7.0756, and the edge belongs to the inside. */
        const double share = ((double)n_star - 120) / (double)info.n_samples;
        ck_assert_msg(fabs(share - 0.166) < 0.02, "%g of the samples in the star", share);
        ck_assert_msg(info.sigma > 0.82 * info.spacing && info.sigma < 1 * info.spacing, "%g",
                      info.sigma / info.spacing);
        icc_sampling_free(sampling);
    }
    icc_shape_free(shape);
}
END_TEST

START_TEST(no_steps_and_many_steps_keep_to_their_side)
{
    static const int32_t STEPS[] = {-1, 1, 500};
    icc_shape *shape = u_shape(0.2, 1);
    for (int i = 0; i < 3; ++i) {
        icc_sampling_options options = blue(0.1, 7);
        options.steps = STEPS[i];
        icc_sampling *sampling = sample(shape, &options);
        const icc_sampling_info info = info_of(sampling);
        ck_assert(info.nearest >= 0.55);
        ck_assert_msg(info.sigma > 0.75 * info.spacing && info.sigma < 1.4 * info.spacing, "%g",
                      info.sigma / info.spacing);
        for (size_t k = 0; k < info.n_samples; ++k) {
            const iccp_spot spot = iccp_shape_spot(shape, sampling->points + 2 * k);
            ck_assert_uint_ne(spot.region, ICCP_NOWHERE);
            ck_assert(k < info.n_edge ||
                      spot.clearance >= 0.399 * 0.1 * shape->frame.in[0] * shape->frame.in[1]);
        }
        icc_sampling_free(sampling);
    }
    icc_shape_free(shape);
}
END_TEST

/* Random points have next to no power below the ring; a relaxed sampling has, and its ring is no
 * lattice's. */
START_TEST(blue_noise_has_its_spectrum)
{
    enum { N = 3000 };
    const iccp_env env = default_env();
    icc_shape *shape = square_shape(1);
    const icc_sampling_options options = blue(0.04, 3);
    icc_sampling *sampling = sample(shape, &options);
    const icc_sampling_info info = info_of(sampling);
    double power[ICCP_SPECTRUM_BINS], random_power = 0, blue_power = 0, high = 0;
    static double random_points[2 * N];
    random_source r = {2};
    const double step = 1.5 / (0.04 * ICCP_SPECTRUM_BINS);
    for (int i = 0; i < 2 * N; ++i)
        random_points[i] = random_between(&r, -1, 1);
    ck_assert_int_eq(iccp_spectrum(2, N, random_points, step, power, &env), ICC_OK);
    for (int b = 26; b < 45; ++b)
        random_power += power[b] / 19;
    ck_assert_int_eq(iccp_spectrum(2, info.n_samples - info.n_edge,
                                   sampling->points + 2 * info.n_edge, step, power, &env),
                     ICC_OK);
    for (int b = 26; b < 45; ++b)
        blue_power += power[b] / 19;
    for (int b = 50; b < ICCP_SPECTRUM_BINS; ++b)
        high = fmax(high, power[b]);
    ck_assert_msg(random_power > 0.7 && random_power < 1.4, "random: %g", random_power);
    ck_assert_msg(blue_power < 0.2, "blue noise: %g", blue_power);
    ck_assert_msg(high > 1, "no ring: %g", high);
    icc_sampling_free(sampling);
    icc_shape_free(shape);
}
END_TEST

/* Section 3.3.2: 1024 points in [-30, 30]^2, sigma = 2.5. There it was 2.3e5, 3.4e-4, 1.1e-2,
 * 5.7e-9. */
START_TEST(gaussians_on_blue_noise_do_as_well_as_in_the_thesis)
{
    icc_shape *shape = square_shape(30);
    const icc_sampling_options options = blue(2.08, 1);
    icc_sampling *sampling = sample(shape, &options);
    const icc_sampling_info info = info_of(sampling);
    gaussians g;
    ck_assert_msg(info.n_samples > 1004 && info.n_samples < 1044, "%zu", info.n_samples);
    ck_assert(gaussians_create(&g, info.n_samples, sampling->points, 2.5));
    const gaussians_report r = gaussians_measure(&g, 81, 15, 15);
    ck_assert_msg(r.condition <= 5e5, "condition: %g", r.condition);
    ck_assert_msg(r.unity <= 4e-4, "unity: %g", r.unity);
    ck_assert_msg(r.reproduction <= 1.2e-2, "reproduction: %g", r.reproduction);
    ck_assert_msg(r.lagrange <= 1e-8, "Lagrange: %g", r.lagrange);
    gaussians_free(&g);
    icc_sampling_free(sampling);
    icc_shape_free(shape);
}
END_TEST

START_TEST(equal_seeds_give_equal_samplings)
{
    icc_shape *shape = star_shape();
    icc_sampling_options options = blue(0.06, 42);
    icc_sampling *first = sample(shape, &options), *again = sample(shape, &options), *threads;
    const icc_env env = {.size = sizeof env, .threads = 4};
    ck_assert_int_eq(icc_sampling_create(&threads, shape, &options, &env, NULL), ICC_OK);
    ck_assert(same_samples(first, again));
    ck_assert(same_samples(first, threads));
    icc_sampling_free(again);
    icc_sampling_free(threads);
    options.seed = 43;
    again = sample(shape, &options);
    ck_assert(!same_samples(first, again));
    icc_sampling_free(again);
    icc_sampling_free(first);
    icc_shape_free(shape);
}
END_TEST

START_TEST(fixed_points_are_samples)
{
    enum { N = 40 };
    double fixed[2 * N];
    icc_shape *shape = star_shape();
    random_source r = {9};
    star_outline(fixed);
    for (size_t i = 10; i < N; ++i)
        do
            for (int k = 0; k < 2; ++k)
                fixed[2 * i + (size_t)k] = random_between(&r, -1, 1);
        while (iccp_shape_region(shape, fixed + 2 * i) != 0);
    icc_sampling_options options = blue(0.05, 1);
    options.n_fixed = N;
    options.fixed = fixed;
    icc_sampling *sampling = sample(shape, &options);
    const icc_sampling_info info = info_of(sampling);
    for (size_t i = 0; i < N; ++i) {
        size_t n_same = 0, n_near = 0;
        for (size_t k = 0; k < info.n_samples; ++k) {
            const double *p = sampling->points + 2 * k;
            const double d = hypot(p[0] - fixed[2 * i], p[1] - fixed[2 * i + 1]);
            n_same += p[0] == fixed[2 * i] && p[1] == fixed[2 * i + 1];
            n_near += d < 0.54 * 0.05;
        }
        ck_assert_uint_eq(n_same, 1);
        ck_assert_uint_le(n_near, 3); /* itself, and other fixed points */
    }
    icc_sampling_free(sampling);
    const double outside[4] = {0, 0, 5, 5}, twice[4] = {0, 0, 0, 0}, nan[2] = {0, NAN};
    icc_error err = {.size = sizeof err};
    options.n_fixed = 2;
    options.fixed = outside;
    ck_assert_int_eq(icc_sampling_create(&sampling, shape, &options, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.index, 1);
    options.fixed = twice;
    ck_assert_int_eq(icc_sampling_create(&sampling, shape, &options, NULL, &err), ICC_ERR_ARGUMENT);
    options.n_fixed = 1;
    options.fixed = nan;
    ck_assert_int_eq(icc_sampling_create(&sampling, shape, &options, NULL, &err), ICC_ERR_ARGUMENT);
    options.fixed = NULL;
    ck_assert_int_eq(icc_sampling_create(&sampling, shape, &options, NULL, &err), ICC_ERR_ARGUMENT);
    icc_shape_free(shape);
}
END_TEST

/* A stick figure in a square: samples evenly along the sticks, and around them. */
START_TEST(curves_are_sampled_along)
{
    static const double STICKS[10] = {0, 0.5, 0, -0.4, -0.4, -0.9, 0.4, -0.9, 0.3, 0.2};
    static const uint32_t SEGMENTS[8] = {0, 1, 1, 2, 1, 3, 0, 4};
    double xy[8];
    square_outline(1, xy);
    for (int surrounded = 0; surrounded < 2; ++surrounded) {
        icc_domain *square = polygon_of(4, xy);
        const icc_domain *regions[1] = {square};
        icc_shape *shape;
        ck_assert_int_eq(icc_shape_create(&shape, 2, (size_t)surrounded, regions, 5, STICKS, 4,
                                          SEGMENTS, NULL, NULL),
                         ICC_OK);
        icc_domain_free(square);
        const icc_sampling_options options = blue(0.05, 1);
        icc_sampling *sampling = sample(shape, &options);
        const icc_sampling_info info = info_of(sampling);
        size_t n_stick = 0;
        for (size_t i = 0; i < info.n_samples; ++i)
            n_stick += iccp_shape_spot(shape, sampling->points + 2 * i).curve != ICCP_NOWHERE;
        /* 0.9 + 2 * 0.640 + 0.424 long. */
        ck_assert_msg(n_stick >= 50 && n_stick <= 55, "%zu", n_stick);
        ck_assert_int_eq(info.n_samples > n_stick, surrounded);
        ck_assert(info.nearest >= 0.55);
        icc_sampling_free(sampling);
        icc_shape_free(shape);
    }
}
END_TEST

START_TEST(space_is_sampled)
{
    icc_domain *const regions[2] = {cube_of(0.5), cube_of(1)};
    icc_shape *shape = shape_of(3, 2, regions);
    const icc_sampling_options options = blue(0.125, 1);
    icc_sampling *sampling = sample(shape, &options);
    const icc_sampling_info info = info_of(sampling);
    size_t n_inner = 0;
    ck_assert_msg(info.nearest >= 0.55, "nearest: %g T", info.nearest);
    for (size_t i = 0; i < info.n_samples; ++i) {
        const iccp_spot spot = iccp_shape_spot(shape, sampling->points + 3 * i);
        ck_assert_uint_ne(spot.region, ICCP_NOWHERE);
        ck_assert_int_eq(spot.wall != ICCP_NOWHERE, i < info.n_edge);
        n_inner += i >= info.n_edge && spot.region == 0;
    }
    /* sqrt(2) / T^3 a volume: 724 in the inner cube, less what is near its walls. */
    ck_assert_msg(n_inner > 350 && n_inner < 724, "%zu", n_inner);
    /* About one a square of the spacing, 1920 of which cover both cubes. */
    ck_assert_msg(info.n_edge > 1700 && info.n_edge < 2200, "%zu", info.n_edge);
    icc_sampling_free(sampling);
    icc_shape_free(shape);
}
END_TEST

/* Wherever a shape lies and whatever its size, the same samples come out, up to rounding. */
START_TEST(place_and_size_do_not_matter)
{
    static const double SHIFT[] = {0, 0, 0, 1e6, -3e3, 0};
    static const double SCALE[] = {1, 1e-150, 1e150, 1, 1e-3, 1e-310};
    size_t n[6];
    for (int i = 0; i < 6; ++i) {
        double xy[20];
        star_outline(xy);
        for (int k = 0; k < 20; ++k)
            xy[k] = SHIFT[i] + SCALE[i] * xy[k];
        icc_domain *const region = polygon_of(10, xy);
        icc_shape *shape = shape_of(2, 1, &region);
        const icc_sampling_options options = blue(0.05 * SCALE[i], 5);
        icc_sampling *sampling = sample(shape, &options);
        const icc_sampling_info info = info_of(sampling);
        n[i] = info.n_samples;
        ck_assert_msg(10 * n[i] > 9 * n[0] && 10 * n[i] < 11 * n[0], "%zu, not %zu", n[i], n[0]);
        ck_assert(info.nearest >= 0.55 && info.sigma > 0.7 * info.spacing &&
                  info.sigma < 1.3 * info.spacing);
        icc_sampling_free(sampling);
        icc_shape_free(shape);
    }
}
END_TEST

/* Outlines with far more corners than samples, and sharp ones. */
START_TEST(outlines_finer_than_the_spacing_are_followed)
{
    enum { N = 3000 };
    static double xy[2 * N];
    for (int i = 0; i < N; ++i) {
        const double angle = 6.28318530717958648 * i / N;
        const double radius = 1 + 0.3 * cos(5 * angle) + (i % 2 == 0 ? 0.002 : 0);
        xy[2 * i] = radius * cos(angle);
        xy[2 * i + 1] = radius * sin(angle);
    }
    icc_domain *const region = polygon_of(N, xy);
    icc_shape *shape = shape_of(2, 1, &region);
    const icc_sampling_options options = blue(0.1, 5);
    icc_sampling *sampling = sample(shape, &options);
    const icc_sampling_info info = info_of(sampling);
    ck_assert_msg(info.n_edge > 60 && info.n_edge < 130, "%zu", info.n_edge);
    ck_assert(info.nearest >= 0.55);
    icc_sampling_free(sampling);
    icc_shape_free(shape);
}
END_TEST

/* ------------------------------------------------------------------ errors */

static icc_status try_options(const icc_shape *shape, icc_sampling_options options, icc_error *err)
{
    icc_sampling *sampling = (icc_sampling *)&sampling;
    options.size = sizeof options;
    const icc_status status = icc_sampling_create(&sampling, shape, &options, NULL, err);
    ck_assert((sampling == NULL) == (status != ICC_OK));
    icc_sampling_free(sampling);
    return status;
}

START_TEST(what_cannot_be_sampled_is_named)
{
    static const double STICK[4] = {0, 0, 1, 0};
    static const uint32_t SEGMENT[2] = {0, 1};
    icc_error err = {.size = sizeof err};
    icc_shape *shape = star_shape(), *stick;
    ck_assert_int_eq(icc_shape_create(&stick, 2, 0, NULL, 2, STICK, 1, SEGMENT, NULL, NULL),
                     ICC_OK);
    for (int32_t kind = ICC_SAMPLING_GRID; kind <= ICC_SAMPLING_BLUE; ++kind) {
        ck_assert_int_eq(
            try_options(shape, (icc_sampling_options){.kind = kind, .spacing = 1e-5}, &err),
            ICC_ERR_RESOLUTION);
        ck_assert_ptr_nonnull(strstr(err.message, "2^24"));
        ck_assert_int_eq(
            try_options(shape, (icc_sampling_options){.kind = kind, .spacing = 1e-300}, &err),
            ICC_ERR_RESOLUTION);
        ck_assert_int_eq(
            try_options(shape, (icc_sampling_options){.kind = kind, .spacing = 3}, &err),
            ICC_ERR_RESOLUTION);
        ck_assert_int_eq(err.index, 0);
        ck_assert_ptr_nonnull(strstr(err.message, "region 0"));
        ck_assert_int_eq(
            try_options(shape, (icc_sampling_options){.kind = kind, .spacing = -1}, &err),
            ICC_ERR_ARGUMENT);
        ck_assert_int_eq(
            try_options(shape, (icc_sampling_options){.kind = kind, .spacing = NAN}, &err),
            ICC_ERR_ARGUMENT);
        ck_assert_int_eq(
            try_options(shape, (icc_sampling_options){.kind = kind, .margin = HUGE_VAL}, &err),
            ICC_ERR_ARGUMENT);
    }
    ck_assert_int_eq(try_options(shape, (icc_sampling_options){.kind = 3}, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(try_options(shape, (icc_sampling_options){.kind = -1}, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(try_options(shape, (icc_sampling_options){.steps = -2}, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(try_options(stick, (icc_sampling_options){.kind = ICC_SAMPLING_GRID}, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(try_options(stick, (icc_sampling_options){.spacing = 1e-9}, &err),
                     ICC_ERR_RESOLUTION);
    ck_assert_int_eq(try_options(stick, (icc_sampling_options){.spacing = 9}, &err), ICC_OK);
    icc_shape_free(stick);
    icc_shape_free(shape);
    /* Coordinates near 1e15 are multiples of 1/8. */
    const double far[8] = {1e15, 0, 1e15 + 10, 0, 1e15 + 10, 10, 1e15, 10};
    icc_domain *const region = polygon_of(4, far);
    shape = shape_of(2, 1, &region);
    ck_assert_int_eq(try_options(shape, (icc_sampling_options){.spacing = 0.5}, &err),
                     ICC_ERR_RESOLUTION);
    ck_assert_ptr_nonnull(strstr(err.message, "rounding"));
    icc_shape_free(shape);
}
END_TEST

START_TEST(the_callers_points_keep_their_order)
{
    static const double POINTS[8] = {0, 0, 1, 0, 0.25, 0.5, 0, -0.9};
    static const double OUTSIDE[4] = {0, 0, 3, 0}, TWICE[6] = {0, 0, 0.5, 0.5, 0, 0};
    static const double INFINITE[2] = {0, HUGE_VAL};
    icc_shape *shape = square_shape(1);
    icc_sampling *sampling;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, 4, POINTS, NULL, &err),
                     ICC_OK);
    const icc_sampling_info info = info_of(sampling);
    ck_assert_int_eq(info.kind, ICC_SAMPLING_POINTS);
    ck_assert_uint_eq(info.n_samples, 4);
    ck_assert_uint_eq(info.n_edge, 1);
    const double near = hypot(0.25, 0.5), mean = 0.25 * (near + hypot(0.75, 0.5) + near + 0.9);
    ck_assert(fabs(info.spacing - mean) < 1e-14);
    ck_assert(fabs(info.nearest - near / mean) < 1e-14);
    ck_assert_int_eq(memcmp(sampling->points, POINTS, sizeof POINTS), 0);
    icc_sampling_free(sampling);
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, 1, POINTS, NULL, &err),
                     ICC_OK);
    icc_sampling_free(sampling);
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, 2, OUTSIDE, NULL, &err),
                     ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.index, 1);
    ck_assert_ptr_null(sampling);
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, 3, TWICE, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, 1, INFINITE, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, 0, POINTS, NULL, &err),
                     ICC_ERR_ARGUMENT);
    icc_shape_free(shape);
}
END_TEST

/* ------------------------------------------------------------------- bytes */

/* A sampling with everything: regions, curves, all in a few samples. */
static icc_sampling *small_sampling(void)
{
    static const double STICK[6] = {-0.5, 0, 0.5, 0, 0.5, 3};
    static const uint32_t SEGMENTS[4] = {0, 1, 1, 2};
    double xy[8];
    square_outline(1, xy);
    icc_domain *square = polygon_of(4, xy);
    const icc_domain *regions[1] = {square};
    icc_shape *shape;
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, regions, 3, STICK, 2, SEGMENTS, NULL, NULL),
                     ICC_OK);
    icc_domain_free(square);
    const icc_sampling_options options = blue(0.5, 1);
    icc_sampling *sampling = sample(shape, &options);
    icc_shape_free(shape);
    return sampling;
}

static unsigned char *save(const icc_sampling *sampling, size_t *n)
{
    ck_assert_int_eq(icc_sampling_save(sampling, 0, NULL, n), ICC_OK);
    unsigned char *data = malloc(*n);
    size_t again;
    ck_assert_ptr_nonnull(data);
    ck_assert_int_eq(icc_sampling_save(sampling, *n, data, &again), ICC_OK);
    ck_assert_uint_eq(again, *n);
    return data;
}

static void check_round_trip(const icc_sampling *sampling)
{
    size_t n, n_again;
    icc_sampling *loaded;
    unsigned char *data = save(sampling, &n);
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_sampling_load(&loaded, n, data, NULL, &err) == ICC_OK, "%s", err.message);
    ck_assert(same_samples(sampling, loaded));
    unsigned char *again = save(loaded, &n_again);
    ck_assert_uint_eq(n_again, n);
    ck_assert_int_eq(memcmp(data, again, n), 0);
    free(again);
    free(data);
    icc_sampling_free(loaded);
}

START_TEST(samplings_are_read_back_bit_for_bit)
{
    icc_sampling *sampling = small_sampling();
    check_round_trip(sampling);
    icc_sampling_free(sampling);
    icc_domain *const cube = cube_of(1);
    icc_shape *shape = shape_of(3, 1, &cube);
    const icc_sampling_options options = blue(0.5, 1);
    sampling = sample(shape, &options);
    icc_shape_free(shape);
    check_round_trip(sampling);
    icc_sampling_free(sampling);
}
END_TEST

START_TEST(other_bytes_are_refused)
{
    icc_sampling *sampling = small_sampling(), *loaded;
    size_t n;
    unsigned char *data = save(sampling, &n);
    for (size_t size = 0; size < n; ++size)
        ck_assert_int_eq(icc_sampling_load(&loaded, size, data, NULL, NULL), ICC_ERR_FORMAT);
    for (size_t bit = 0; bit < 8 * n; ++bit) {
        data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        ck_assert_int_eq(icc_sampling_load(&loaded, n, data, NULL, NULL), ICC_ERR_FORMAT);
        ck_assert_ptr_null(loaded);
        data[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    ck_assert_int_eq(icc_sampling_load(&loaded, n, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_sampling_load(NULL, n, data, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_sampling_save(sampling, 1, NULL, &n), ICC_ERR_ARGUMENT);
    free(data);
    icc_sampling_free(sampling);
}
END_TEST

/* With the checksum put right, so that the content is looked at. */
START_TEST(hostile_content_is_safe)
{
    icc_sampling *sampling = small_sampling(), *loaded;
    size_t n, n_good = 0;
    unsigned char *data = save(sampling, &n), *changed = malloc(n);
    random_source r = {77};
    ck_assert_ptr_nonnull(changed);
    for (int round = 0; round < 20000; ++round) {
        iccp_blob w;
        size_t size;
        memcpy(changed, data, n);
        for (int k = random_below(&r, 3); k >= 0; --k) {
            const size_t at = 24 + (size_t)(random_bits(&r) % (round % 2 == 0 ? 120 : n - 24));
            const int bit = 1 << random_below(&r, 8), any = random_below(&r, 256);
            changed[at] = (unsigned char)(random_below(&r, 4) == 0 ? any : changed[at] ^ bit);
        }
        iccp_blob_begin(&w, changed, n, "SMPL", 1);
        w.at = n;
        iccp_blob_end(&w, &size);
        const icc_status status = icc_sampling_load(&loaded, n, changed, NULL, NULL);
        ck_assert(status == ICC_OK || status == ICC_ERR_FORMAT);
        ck_assert_int_eq(loaded != NULL, status == ICC_OK);
        n_good += status == ICC_OK;
        icc_sampling_free(loaded);
    }
    ck_assert_uint_gt(n_good, 100); /* a moved point does no harm */
    ck_assert_uint_lt(n_good, 19000);
    free(changed);
    free(data);
    icc_sampling_free(sampling);
}
END_TEST

/* ------------------------------------------------------------------ faults */

static icc_status make_blue(const icc_env *env, icc_error *err, void *argument)
{
    icc_sampling *sampling;
    icc_sampling_options options = blue(0.25, 1);
    static const double FIXED[4] = {0, 0, 0.1, 0.5};
    options.n_fixed = ((const icc_shape *)argument)->dim == 2 ? 2 : 0;
    options.fixed = FIXED;
    options.steps = 3;
    const icc_status status = icc_sampling_create(&sampling, argument, &options, env, err);
    ck_assert((sampling == NULL) == (status != ICC_OK));
    icc_sampling_free(sampling);
    return status;
}

static icc_status make_grid(const icc_env *env, icc_error *err, void *argument)
{
    icc_sampling *sampling;
    const icc_sampling_options options = {
        .size = sizeof options, .kind = ICC_SAMPLING_GRID, .spacing = 0.25, .margin = 1};
    const icc_status status = icc_sampling_create(&sampling, argument, &options, env, err);
    icc_sampling_free(sampling);
    return status;
}

typedef struct bytes {
    unsigned char *data;
    size_t n;
} bytes;

static icc_status load_bytes(const icc_env *env, icc_error *err, void *argument)
{
    const bytes *b = argument;
    icc_sampling *sampling;
    const icc_status status = icc_sampling_load(&sampling, b->n, b->data, env, err);
    ck_assert((sampling == NULL) == (status != ICC_OK));
    icc_sampling_free(sampling);
    return status;
}

START_TEST(every_allocation_and_report_may_fail)
{
    icc_shape *shape = star_shape();
    icc_domain *const cube = cube_of(1);
    icc_shape *box = shape_of(3, 1, &cube);
    faulty_sweep(make_blue, shape);
    faulty_sweep(make_grid, shape);
    faulty_sweep(make_blue, box);
    icc_shape_free(box);
    icc_shape_free(shape);
    icc_sampling *sampling = small_sampling();
    bytes b;
    b.data = save(sampling, &b.n);
    faulty_sweep(load_bytes, &b);
    free(b.data);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sampling");
    TCase *c = tcase_create("sampling");
    tcase_add_test(c, grids_of_the_thesis_are_exact);
    tcase_add_test(c, grids_go_as_far_as_their_margin);
    tcase_add_test(c, grids_fill_shapes_of_any_form);
    tcase_add_test(c, blue_noise_is_evenly_spaced_and_keeps_to_its_side);
    tcase_add_test(c, no_steps_and_many_steps_keep_to_their_side);
    tcase_add_test(c, blue_noise_has_its_spectrum);
    tcase_add_test(c, gaussians_on_blue_noise_do_as_well_as_in_the_thesis);
    tcase_add_test(c, equal_seeds_give_equal_samplings);
    tcase_add_test(c, fixed_points_are_samples);
    tcase_add_test(c, curves_are_sampled_along);
    tcase_add_test(c, space_is_sampled);
    tcase_add_test(c, place_and_size_do_not_matter);
    tcase_add_test(c, outlines_finer_than_the_spacing_are_followed);
    tcase_add_test(c, what_cannot_be_sampled_is_named);
    tcase_add_test(c, the_callers_points_keep_their_order);
    tcase_add_test(c, samplings_are_read_back_bit_for_bit);
    tcase_add_test(c, other_bytes_are_refused);
    tcase_add_test(c, hostile_content_is_safe);
    tcase_add_test(c, every_allocation_and_report_may_fail);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
