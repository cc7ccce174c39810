/* Pictures of values: floats, many channels, other interpolations, missing samples. */
#include <icc/icc.h>

#include "../../../pictures.h"
#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { WIDE = 30, HIGH = 20, MOST = 64 };

static const double frame[8] = {0, 0, WIDE, 0, WIDE, HIGH, 0, HIGH};

static icc_picture make(int32_t channels, int32_t bytes)
{
    return make_picture(WIDE, HIGH, channels, bytes);
}

static double get(const icc_picture *p, int32_t i, int32_t j, int32_t c)
{
    uint16_t two;
    float four;
    double eight;
    const void *sample = sample_at(p, i, j, c);
    memcpy(&two, sample, p->bytes == 1 ? 1 : 2);
    if (p->bytes <= 2)
        return p->bytes == 1 ? *(const uint8_t *)sample : two;
    memcpy(&four, sample, 4);
    if (p->bytes == 4)
        return (double)four;
    memcpy(&eight, sample, 8);
    return eight;
}

static void set(const icc_picture *p, int32_t i, int32_t j, int32_t c, double value)
{
    const uint8_t one = (uint8_t)(p->bytes == 1 ? value : 0);
    const uint16_t two = (uint16_t)(p->bytes == 2 ? value : 0);
    const float four = (float)value;
    const void *from = p->bytes == 1   ? (const void *)&one
                       : p->bytes == 2 ? (const void *)&two
                       : p->bytes == 4 ? (const void *)&four
                                       : (const void *)&value;
    memcpy(sample_at(p, i, j, c), from, (size_t)p->bytes);
}

typedef double (*function)(double x, double y);

static void fill(const icc_picture *p, function f)
{
    for (int32_t j = 0; j < HIGH; ++j)
        for (int32_t i = 0; i < WIDE; ++i)
            for (int32_t c = 0; c < p->channels; ++c)
                set(p, i, j, c, f(i + 0.5 + c, j + 0.5));
}

static double linear(double x, double y)
{
    return 3 + x + 2 * y;
}

static double quadratic(double x, double y)
{
    return 0.25 * x * x - 0.5 * x * y + y * y;
}

static double checks(double x, double y)
{
    return fmod(floor(x) + floor(y), 2) > 0 ? 200 : 10;
}

START_TEST(test_identity)
{
    static const int32_t sizes[4] = {1, 2, 4, 8};
    mapped m = make_map(4, frame, frame, ICC_MAP_MESH);
    for (int32_t k = 0; k < 48; ++k) {
        icc_picture from = make(k % 4 == 0 ? MOST : k % 4, sizes[k / 4 % 4]);
        icc_picture to = make(from.channels, from.bytes);
        from.interpolation = k / 16 + 1;
        fill(&from, checks);
        warp(&m, &from, &to);
        ck_assert(same(&from, &to));
        free(from.pixels);
        free(to.pixels);
    }
    unmake(&m);
}
END_TEST

/* Where the map makes larger, and no means are taken, a function that is interpolated exactly gives its
 * own values, but for the rounding of places. */
static void require_values(function f, int32_t interpolation, int32_t kind, double limit)
{
    static const double part[8] = {8, 6, 22, 6, 22, 14, 8, 14};
    static const double turned[8] = {29, 1, 28, 19, 1, 18, 2, 1};
    mapped m = make_map(4, part, turned, kind);
    icc_picture from = make(2, 8), to = make(2, 8);
    size_t n_seen = 0;
    from.interpolation = interpolation;
    fill(&from, f);
    warp(&m, &from, &to);
    for (int32_t j = 0; j < HIGH; ++j)
        for (int32_t i = 0; i < WIDE; ++i) {
            double place[2] = {i + 0.5, j + 0.5};
            icc_status status;
            ck_assert_int_eq(icc_map_apply_inverse(m.map, 1, place, place, &status, NULL, NULL),
                             ICC_OK);
            n_seen += status == ICC_OK;
            for (int32_t c = 0; c < 2 && status == ICC_OK; ++c)
                ck_assert_double_eq_tol(get(&to, i, j, c), f(place[0] + c, place[1]), limit);
        }
    ck_assert_uint_gt(n_seen, 300);
    free(from.pixels);
    free(to.pixels);
    unmake(&m);
}

START_TEST(test_functions)
{
    for (int32_t kind = ICC_MAP_CURVES; kind <= ICC_MAP_MESH; ++kind) {
        require_values(linear, 0, kind, 1e-5);
        require_values(linear, ICC_INTERPOLATION_CUBIC, kind, 1e-5);
        require_values(quadratic, ICC_INTERPOLATION_CUBIC, kind, 1e-4);
    }
}
END_TEST

/* A shift by a part of a pixel: no means, and places are known exactly. */
START_TEST(test_shift)
{
    const double shifted[8] = {0.25,        0.5,        WIDE + 0.25, 0.5,
                               WIDE + 0.25, HIGH + 0.5, 0.25,        HIGH + 0.5};
    mapped m = make_map(4, frame, shifted, ICC_MAP_MESH);
    for (int32_t k = 0; k < 3; ++k) {
        icc_picture from = make(1, 8), to = make(1, 8);
        from.interpolation = k + 1;
        fill(&from, quadratic);
        warp(&m, &from, &to);
        double worst = 0;
        for (int32_t j = 3; j < HIGH - 3; ++j)
            for (int32_t i = 3; i < WIDE - 3; ++i)
                worst = fmax(worst, fabs(get(&to, i, j, 0) - quadratic(i + 0.25, j)));
        /* Linear is off by the second derivatives: (0.5 * 3/16 + 2 / 4) / 2 at most. */
        ck_assert(k == 0 ? worst > 1 : k == 1 ? worst > 0.2 && worst < 0.3 : worst < 1e-9);
        free(from.pixels);
        free(to.pixels);
    }
    unmake(&m);
}
END_TEST

/* Nearest makes no new values, also where the map shrinks; and each channel is by itself. */
START_TEST(test_channels)
{
    const double small[8] = {2, 3, 14, 2, 15, 12, 3, 11};
    mapped m = make_map(4, frame, small, ICC_MAP_MESH);
    for (int32_t k = 0; k < 3; ++k) {
        icc_picture from = make(MOST, 2), to = make(MOST, 2);
        from.interpolation = k + 1;
        fill(&from, checks);
        set(&from, 3, 3, 40, 12345);
        warp(&m, &from, &to);
        for (int32_t c = 0; c < MOST; c += 13) {
            icc_picture one = make(1, 2), alone = make(1, 2);
            one.interpolation = k + 1;
            one.has_nodata = 1; /* so that it is not taken as a colour */
            one.nodata = -1;
            for (int32_t j = 0; j < HIGH; ++j)
                for (int32_t i = 0; i < WIDE; ++i)
                    set(&one, i, j, 0, get(&from, i, j, c));
            warp(&m, &one, &alone);
            for (int32_t j = 0; j < HIGH; ++j)
                for (int32_t i = 0; i < WIDE; ++i) {
                    const double value = get(&to, i, j, c);
                    ck_assert_double_eq(get(&alone, i, j, 0), value);
                    ck_assert(k > 0 || value == 0 || value == 10 || value == 200 || value == 12345);
                }
            free(one.pixels);
            free(alone.pixels);
        }
        free(from.pixels);
        free(to.pixels);
    }
    unmake(&m);
}
END_TEST

/* What is missing stays missing, and spoils nothing beside it. */
START_TEST(test_nodata)
{
    const double shifted[8] = {0.25,        0.25,        WIDE + 0.25, 0.25,
                               WIDE + 0.25, HIGH + 0.25, 0.25,        HIGH + 0.25};
    mapped m = make_map(4, frame, shifted, ICC_MAP_MESH);
    for (int32_t k = 0; k < 12; ++k) {
        const int32_t bytes = k % 2 == 0 ? 4 : 8;
        icc_picture from = make(2, bytes), to = make(2, bytes);
        from.interpolation = k / 4 + 1;
        from.has_nodata = 1;
        from.nodata = k / 2 % 2 == 0 ? -9999 : (double)NAN;
        for (int32_t j = 0; j < HIGH; ++j)
            for (int32_t i = 0; i < WIDE; ++i) {
                set(&from, i, j, 0, i < 10 ? 7 : from.nodata);
                set(&from, i, j, 1, 5);
            }
        warp(&m, &from, &to);
        for (int32_t j = 1; j < HIGH; ++j)
            for (int32_t i = 1; i < WIDE; ++i) {
                const double value = get(&to, i, j, 0);
                const bool missing = isnan(from.nodata) ? isnan(value) != 0 : value == -9999;
                ck_assert_int_eq(missing, i >= 10);
                if (!missing)
                    ck_assert_double_eq_tol(value, 7, 1e-6);
                ck_assert_double_eq_tol(get(&to, i, j, 1), 5, 1e-6);
            }
        free(from.pixels);
        free(to.pixels);
    }
    unmake(&m);
}
END_TEST

START_TEST(test_threads)
{
    const double bent[8] = {2, 1, 29, 3, 26, 19, 4, 16};
    mapped m = make_map(4, frame, bent, ICC_MAP_CURVES);
    icc_picture from = make(5, 4), first = make(5, 4);
    fill(&from, quadratic);
    warp(&m, &from, &first);
    for (int32_t threads = 2; threads <= 4; ++threads) {
        icc_picture to = make(5, 4);
        const icc_env env = {.size = sizeof env, .threads = threads};
        ck_assert_int_eq(icc_map_warp(m.map, &from, &to, NULL, &env, NULL), ICC_OK);
        ck_assert(same(&first, &to));
        free(to.pixels);
    }
    free(from.pixels);
    free(first.pixels);
    unmake(&m);
}
END_TEST

/* A struct of before has none of this; explicit linear is what is done anyway. */
START_TEST(test_colours_as_before)
{
    const double bent[8] = {2, 1, 29, 3, 26, 19, 4, 16};
    mapped m = make_map(4, frame, bent, ICC_MAP_MESH);
    icc_picture from = make(4, 1), first = make(4, 1);
    from.alpha = first.alpha = 1;
    fill(&from, checks);
    warp(&m, &from, &first);
    for (int k = 0; k < 2; ++k) {
        icc_picture given = from, to = make(4, 1);
        to.alpha = 1;
        given.interpolation = k == 0 ? ICC_INTERPOLATION_LINEAR : 77;
        given.size = k == 0 ? sizeof given : offsetof(icc_picture, interpolation);
        warp(&m, &given, &to);
        ck_assert(same(&first, &to));
        free(to.pixels);
    }
    free(from.pixels);
    free(first.pixels);
    unmake(&m);
}
END_TEST

START_TEST(test_arguments)
{
    mapped m = make_map(4, frame, frame, ICC_MAP_MESH);
    icc_picture from = make(4, 8), to = make(4, 8);
    for (int k = 0; k < 7; ++k) {
        icc_picture bad = from, target = to;
        icc_error err = {.size = sizeof err};
        bad.interpolation = k == 0 ? 4 : k == 1 ? -1 : k == 2 ? ICC_INTERPOLATION_CUBIC : 0;
        bad.has_nodata = k == 3 ? 2 : k == 4 ? 1 : 0;
        bad.alpha = target.alpha = k == 2 || k == 4 || k == 5;
        bad.channels = target.channels = k == 6 ? 65 : 4;
        bad.bytes = target.bytes = k == 2 || k == 4 || k == 6 ? 1 : 8;
        ck_assert_msg(icc_map_warp(m.map, &bad, &target, NULL, NULL, &err) == ICC_ERR_ARGUMENT,
                      "case %d", k);
        ck_assert_int_ne(err.message[0], '\0');
    }
    free(from.pixels);
    free(to.pixels);
    unmake(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("warp_values");
    TCase *tcase = tcase_create("warp_values");
    tcase_add_test(tcase, test_identity);
    tcase_add_test(tcase, test_functions);
    tcase_add_test(tcase, test_shift);
    tcase_add_test(tcase, test_channels);
    tcase_add_test(tcase, test_nodata);
    tcase_add_test(tcase, test_threads);
    tcase_add_test(tcase, test_colours_as_before);
    tcase_add_test(tcase, test_arguments);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
