/* Pictures carried along by maps. */
#include "map/picture/warp.h"
#include "map/picture/warp_points.h"

#include "../../../pictures.h"
#include "../../../suite.h"

#include <check.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- pictures ---- */

static icc_picture make(int32_t width, int32_t height, int32_t channels, int32_t bytes,
                        int32_t alpha)
{
    icc_picture p = make_picture(width, height, channels, bytes);
    p.alpha = alpha;
    return p;
}

static unsigned get(const icc_picture *p, int32_t i, int32_t j, int32_t c)
{
    const uint8_t *at = sample_at(p, i, j, c);
    uint16_t two;
    memcpy(&two, at, p->bytes == 2 ? 2 : 1);
    return p->bytes == 2 ? two : *at;
}

static void set(const icc_picture *p, int32_t i, int32_t j, int32_t c, unsigned value)
{
    uint8_t *at = sample_at(p, i, j, c);
    const uint16_t two = (uint16_t)value;
    if (p->bytes == 2)
        memcpy(at, &two, 2);
    else
        *at = (uint8_t)value;
}

static void fill_noise(const icc_picture *p, uint32_t seed)
{
    for (size_t k = 0; k < p->stride * (size_t)p->height; ++k) {
        seed = seed * 1664525 + 1013904223;
        ((uint8_t *)p->pixels)[k] = (uint8_t)(seed >> 24);
    }
}

/* Gentle enough that a quarter of a pixel is less than a level of one byte. */
static void fill_waves(const icc_picture *p)
{
    for (int32_t j = 0; j < p->height; ++j)
        for (int32_t i = 0; i < p->width; ++i)
            for (int32_t c = 0; c < p->channels; ++c)
                set(p, i, j, c,
                    (unsigned)((p->bytes == 2 ? 257 : 1) *
                               (127.5 + 120 * sin(0.02 * (i + c * 9) + 0.013 * j))));
}

/* ---- maps ---- */

static int32_t map_kind(const mapped *m)
{
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(m->map, &info), ICC_OK);
    return info.kind;
}

static bool inside(const mapped *m, int32_t i, int32_t j)
{
    const double centre[2] = {i + 0.5, j + 0.5};
    int32_t where;
    ck_assert_int_eq(icc_domain_locate(m->target, 1, centre, &where, NULL, NULL, NULL), ICC_OK);
    return where != ICC_OUTSIDE;
}

static const double whole[8] = {0, 0, 40, 0, 40, 40, 0, 40};
static const double star[20] = {20, 2,    24, 15,   38.5, 16, 27,  23, 31, 37.5,
                                20, 28.5, 9,  37.5, 13,   23, 1.5, 16, 16, 15};
static const double bent[20] = {22,   3,  25, 13, 38,   19.5, 26,  24, 28, 38.5,
                                18.5, 27, 6,  35, 12.5, 21,   2.5, 13, 17, 14};

/* ---- exact cases ---- */

static void check_identity(const mapped *m, int32_t channels, int32_t bytes, int32_t alpha)
{
    icc_picture from = make(40, 40, channels, bytes, alpha);
    icc_picture to = make(40, 40, channels, bytes, alpha);
    icc_picture before = make(40, 40, channels, bytes, alpha);
    fill_noise(&from, 1);
    fill_noise(&to, 99);
    fill_noise(&before, 99);
    warp(m, &from, &to);
    for (int32_t j = 0; j < 40; ++j)
        for (int32_t i = 0; i < 40; ++i) {
            const icc_picture *kept = inside(m, i, j) ? &from : &before;
            for (int32_t c = 0; c < channels; ++c)
                ck_assert_uint_eq(get(&to, i, j, c), get(kept, i, j, c));
        }
    free(from.pixels);
    free(to.pixels);
    free(before.pixels);
}

START_TEST(test_identity)
{
    const double *const cages[2] = {whole, star};
    const size_t sizes[2] = {4, 10};
    for (int k = 0; k < 4; ++k) {
        mapped m = make_map(sizes[k % 2], cages[k % 2], cages[k % 2],
                            k < 2 ? ICC_MAP_CURVES : ICC_MAP_MESH);
        for (int32_t channels = 1; channels <= 4; ++channels)
            for (int32_t bytes = 1; bytes <= 2; ++bytes)
                for (int32_t alpha = 0; alpha <= (channels > 1); ++alpha)
                    check_identity(&m, channels, bytes, alpha);
        unmake(&m);
    }
}
END_TEST

/* Pixels outside keep every bit, those inside are all written: two backgrounds tell which is
 * which. */
static void check_extent(const mapped *m)
{
    icc_picture from = make(40, 40, 1, 1, 0), to = make(40, 40, 1, 1, 0);
    memset(from.pixels, 100, from.stride * 40);
    for (unsigned background = 0; background <= 50; background += 50) {
        memset(to.pixels, (int)background, to.stride * 40);
        warp(m, &from, &to);
        for (int32_t j = 0; j < 40; ++j)
            for (int32_t i = 0; i < 40; ++i)
                ck_assert_msg(get(&to, i, j, 0) == (inside(m, i, j) ? 100 : background),
                              "pixel %d %d: %u", (int)i, (int)j, get(&to, i, j, 0));
    }
    free(from.pixels);
    free(to.pixels);
}

START_TEST(test_extent)
{
    const double halves[8] = {4.5, 4.5, 30.5, 4.5, 30.5, 33.5, 4.5, 33.5};
    const double slanted[6] = {0.5, 0.5, 39.5, 0.5, 0.5, 39.5};
    const double large[8] = {-30, -20.5, 90, -25, 77.5, 60.5, -9.5, 71};
    const double *const cages[4] = {halves, slanted, large, star};
    const size_t sizes[4] = {4, 3, 4, 10};
    for (int k = 0; k < 4; ++k) {
        mapped m = make_map(sizes[k], cages[k], cages[k], ICC_MAP_MESH);
        check_extent(&m);
        unmake(&m);
    }
}
END_TEST

/* Jagged targets with all vertices on centres, so that many centres lie on edges, from sources that
 * shrink into them more and more. */
START_TEST(test_centres_on_edges)
{
    uint32_t random = 7;
    int n_maps = 0;
    for (int k = 0; k < 40; ++k) {
        double from[24], to[24];
        for (size_t i = 0; i < 12; ++i) {
            const double angle = 6.28318530717958647692 * (double)i / 12;
            random = random * 1664525 + 1013904223;
            const double radius = 6 + (double)(random >> 24) / 16;
            to[2 * i] = floor(20 + radius * cos(angle)) + 0.5;
            to[2 * i + 1] = floor(20 + radius * sin(angle)) + 0.5;
            from[2 * i] = 20 + (1 + k / 3) * 12 * cos(angle);
            from[2 * i + 1] = 20 + (1 + k / 3) * 12 * sin(angle);
        }
        mapped m = make_map(12, from, to, ICC_MAP_MESH);
        n_maps += map_kind(&m) == ICC_MAP_MESH;
        check_extent(&m);
        unmake(&m);
    }
    ck_assert_int_ge(n_maps, 36);
}
END_TEST

START_TEST(test_quarter_turn)
{
    const double turned[8] = {40, 0, 40, 40, 0, 40, 0, 0};
    mapped m = make_map(4, whole, turned, ICC_MAP_MESH);
    for (int32_t bytes = 1; bytes <= 2; ++bytes) {
        icc_picture from = make(40, 40, 3, bytes, 0), to = make(40, 40, 3, bytes, 0);
        fill_noise(&from, 5);
        warp(&m, &from, &to);
        for (int32_t j = 0; j < 40; ++j)
            for (int32_t i = 0; i < 40; ++i)
                for (int32_t c = 0; c < 3; ++c)
                    ck_assert_uint_eq(get(&to, 39 - j, i, c), get(&from, i, j, c));
        free(from.pixels);
        free(to.pixels);
    }
    unmake(&m);
}
END_TEST

/* ---- against point by point ---- */

/* Every pixel against the bilinear colour at the origin of its centre, in plain doubles. A mean of
 * samples differs from it, on these waves, by less than a level; positions are rounded to 1/8192
 * pixel. */
static double expected(const icc_picture *p, const double at[2], int32_t c)
{
    const double u = fmin(fmax(at[0] - 0.5, 0), p->width - 1);
    const double v = fmin(fmax(at[1] - 0.5, 0), p->height - 1);
    const int32_t i = (int32_t)u, j = (int32_t)v;
    const int32_t i1 = i + 1 < p->width ? i + 1 : i, j1 = j + 1 < p->height ? j + 1 : j;
    const double f = u - i, g = v - j;
    return (1 - g) * ((1 - f) * get(p, i, j, c) + f * get(p, i1, j, c)) +
           g * ((1 - f) * get(p, i, j1, c) + f * get(p, i1, j1, c));
}

static void compare(const mapped *m, int32_t bytes, double tolerance)
{
    icc_picture from = make(200, 180, 3, bytes, 0), to = make(210, 200, 3, bytes, 0);
    fill_waves(&from);
    warp(m, &from, &to);
    for (int32_t j = 0; j < to.height; ++j)
        for (int32_t i = 0; i < to.width; ++i) {
            const double centre[2] = {i + 0.5, j + 0.5};
            double at[2];
            icc_status status;
            ck_assert_int_eq(icc_map_apply_inverse(m->map, 1, centre, at, &status, NULL, NULL),
                             ICC_OK);
            for (int32_t c = 0; c < 3; ++c) {
                const double value = status == ICC_OK ? expected(&from, at, c) : 0;
                ck_assert_msg(fabs(get(&to, i, j, c) - value) <= tolerance,
                              "pixel %d %d is %u, not %g", (int)i, (int)j, get(&to, i, j, c),
                              value);
            }
        }
    free(from.pixels);
    free(to.pixels);
}

START_TEST(test_every_pixel)
{
    double from[20], to[20];
    for (int k = 0; k < 20; ++k) {
        from[k] = 5 * star[k] - (k % 2) * 10;
        to[k] = 5 * bent[k] + 3;
    }
    for (int32_t kind = ICC_MAP_CURVES; kind <= ICC_MAP_MESH; ++kind) {
        mapped m = make_map(10, from, to, kind);
        /* Means are over two pixels of the target: 2 levels at the largest stretch of the star. */
        compare(&m, 1, kind == ICC_MAP_MESH ? 2 : 4);
        compare(&m, 2, kind == ICC_MAP_MESH ? 400 : 900);
        unmake(&m);
    }
}
END_TEST

static bool deep_inside(const mapped *m, int32_t i, int32_t j)
{
    return inside(m, i, j) && inside(m, i - 1, j) && inside(m, i + 1, j) && inside(m, i, j - 1) &&
           inside(m, i, j + 1);
}

/* A star and the same at another size and place: the meshes of the charts agree, so that both kinds
 * are the same similarity, and even noise comes out the same. The samples of a pixel are the same
 * too, summed up in another order, where kind curves has neighbours to tell how many it takes. */
START_TEST(test_kinds_agree)
{
    const double factors[3] = {0.5, 1.7, 0.22};
    for (int k = 0; k < 3; ++k) {
        double to[20];
        for (int i = 0; i < 20; ++i)
            to[i] = factors[k] * star[i] + 7.1;
        mapped mesh = make_map(10, star, to, ICC_MAP_MESH);
        mapped curves = make_map(10, star, to, ICC_MAP_CURVES);
        icc_picture from = make(40, 40, 4, 1, 1);
        icc_picture a = make(80, 80, 4, 1, 1), b = make(80, 80, 4, 1, 1);
        fill_noise(&from, 3);
        warp(&mesh, &from, &a);
        warp(&curves, &from, &b);
        for (int32_t j = 0; j < 80; ++j)
            for (int32_t i = 0; i < 80 * 4; ++i)
                if (deep_inside(&mesh, i / 4, j))
                    ck_assert_int_le(
                        abs((int)get(&a, i / 4, j, i % 4) - (int)get(&b, i / 4, j, i % 4)), 1);
        free(from.pixels);
        free(a.pixels);
        free(b.pixels);
        unmake(&mesh);
        unmake(&curves);
    }
}
END_TEST

/* ---- filtering ---- */

static mapped scaled(double factor, double size)
{
    const double from[8] = {0, 0, size, 0, size, size, 0, size};
    double to[8];
    for (int k = 0; k < 8; ++k)
        to[k] = factor * from[k];
    return make_map(4, from, to, ICC_MAP_MESH);
}

/* Smaller by any factor, a checkerboard of single pixels is an even grey, 0..255 becomes 128
 * +- 32. */
START_TEST(test_no_alias)
{
    for (int step = 2; step <= 16; ++step) {
        mapped m = scaled(1 / (0.7 * step), 160);
        for (int32_t bytes = 1; bytes <= 2; ++bytes) {
            icc_picture from = make(160, 160, 1, bytes, 0), to = make(160, 160, 1, bytes, 0);
            const unsigned largest = bytes == 2 ? 65535 : 255;
            for (int32_t j = 0; j < 160; ++j)
                for (int32_t i = 0; i < 160; ++i)
                    set(&from, i, j, 0, (i + j) % 2 != 0 ? largest : 0);
            warp(&m, &from, &to);
            const int32_t side = (int32_t)(160 / (0.7 * step));
            for (int32_t j = 1; j + 1 < side; ++j)
                for (int32_t i = 1; i + 1 < side; ++i)
                    ck_assert_msg(fabs(get(&to, i, j, 0) / (double)largest - 0.5) < 0.125,
                                  "1:%g makes %u of %u", 0.7 * step, get(&to, i, j, 0), largest);
            free(from.pixels);
            free(to.pixels);
        }
        unmake(&m);
    }
}
END_TEST

/* A red disc, opaque, on transparent green: however it is scaled, what can be seen is red. */
START_TEST(test_no_bleeding)
{
    const double factors[4] = {0.13, 0.5, 1.0 / 1.1, 2.7};
    for (int k = 0; k < 8; ++k) {
        const int32_t bytes = k / 4 + 1;
        const unsigned largest = bytes == 2 ? 65535 : 255;
        mapped m = scaled(factors[k % 4], 64);
        icc_picture from = make(64, 64, 4, bytes, 1), to = make(180, 180, 4, bytes, 1);
        for (int32_t j = 0; j < 64; ++j)
            for (int32_t i = 0; i < 64; ++i) {
                const bool red = hypot(i - 31.5, j - 31.5) < 20;
                set(&from, i, j, red ? 0 : 1, largest);
                set(&from, i, j, 3, red ? largest : 0);
            }
        warp(&m, &from, &to);
        size_t n_soft = 0;
        for (int32_t j = 0; j < 180; ++j)
            for (int32_t i = 0; i < 180; ++i) {
                const unsigned alpha = get(&to, i, j, 3);
                n_soft += alpha > 0 && alpha < largest;
                if (alpha > largest / 64)
                    ck_assert_uint_lt(get(&to, i, j, 1), largest / 64);
            }
        ck_assert_uint_gt(n_soft, 0);
        free(from.pixels);
        free(to.pixels);
        unmake(&m);
    }
}
END_TEST

/* ---- behaviour ---- */

static void reversed(void *user, size_t n, icc_task task, void *argument)
{
    (void)user;
    while (n > 0)
        task(argument, --n);
}

START_TEST(test_threads)
{
    double small[20];
    for (int k = 0; k < 20; ++k)
        small[k] = 0.4 * bent[k] + 10;
    const double *const targets[2] = {bent, small};
    for (int k = 0; k < 4; ++k) {
        mapped m = make_map(10, star, targets[k % 2], k < 2 ? ICC_MAP_MESH : ICC_MAP_CURVES);
        icc_picture from = make(40, 40, 4, 1, 1), first = make(40, 40, 4, 1, 1);
        fill_noise(&from, 1);
        warp(&m, &from, &first);
        for (int32_t threads = 2; threads <= 9; ++threads) {
            icc_picture to = make(40, 40, 4, 1, 1);
            const icc_env env = {.size = sizeof env,
                                 .threads = threads,
                                 .parallel_for = threads == 9 ? reversed : NULL};
            ck_assert_int_eq(icc_map_warp(m.map, &from, &to, NULL, &env, NULL), ICC_OK);
            ck_assert(same(&first, &to));
            free(to.pixels);
        }
        free(from.pixels);
        free(first.pixels);
        unmake(&m);
    }
}
END_TEST

typedef struct budget {
    long left;
    long live;
} budget;

static void *budget_alloc(void *user, size_t size)
{
    budget *b = user;
    if (b->left == 0)
        return NULL;
    --b->left;
    ++b->live;
    return malloc(size);
}

static void budget_free(void *user, void *memory)
{
    --((budget *)user)->live;
    free(memory);
}

START_TEST(test_no_memory)
{
    const double halves[8] = {4.5, 4.5, 24.5, 4.5, 24.5, 24.5, 4.5, 24.5};
    for (int32_t kind = ICC_MAP_CURVES; kind <= ICC_MAP_MESH; ++kind) {
        mapped m = make_map(4, whole, halves, kind);
        icc_picture from = make(40, 40, 1, 1, 0), to = make(40, 40, 1, 1, 0);
        icc_status status = ICC_ERR_MEMORY;
        for (long n = 0; status != ICC_OK; ++n) {
            budget b = {n, 0};
            const icc_env env = {
                .size = sizeof env, .user = &b, .alloc = budget_alloc, .dealloc = budget_free};
            icc_error err = {.size = sizeof err};
            status = icc_map_warp(m.map, &from, &to, NULL, &env, &err);
            ck_assert_int_eq(b.live, 0);
            if (status != ICC_OK)
                ck_assert_int_eq(status, ICC_ERR_MEMORY);
            ck_assert_int_eq(err.status, status);
            ck_assert_int_ge(n, status == ICC_OK ? 2 : 0);
        }
        free(from.pixels);
        free(to.pixels);
        unmake(&m);
    }
}
END_TEST

/* Pixels away from the boundary need no search for points, which would take memory of the map's
 * own, not even those in triangles too thin for a sample. */
START_TEST(test_no_search)
{
    const double before[8] = {0, 0, 40, 0, 40, 40, 0, 40};
    const double after[8] = {1.1, 2.3, 38.7, 0.2, 37.8, 39.9, 3.3, 36.9};
    budget b = {LONG_MAX, 0};
    const icc_env env = {
        .size = sizeof env, .user = &b, .alloc = budget_alloc, .dealloc = budget_free};
    icc_map *map;
    ck_assert_int_eq(icc_map_create_polygons(&map, 4, before, after, &env, NULL), ICC_OK);
    icc_picture from = make(40, 40, 4, 1, 1), to = make(40, 40, 4, 1, 1);
    b.left = 0;
    ck_assert_int_eq(icc_map_warp(map, &from, &to, NULL, NULL, NULL), ICC_OK);
    icc_map_free(map);
    ck_assert_int_eq(b.live, 0);
    free(from.pixels);
    free(to.pixels);
}
END_TEST

static int32_t stop(void *user, const char *stage, double share)
{
    (void)share;
    ck_assert_str_eq(stage, "warp");
    return --*(int *)user < 0;
}

START_TEST(test_cancel)
{
    for (int32_t kind = ICC_MAP_CURVES; kind <= ICC_MAP_MESH; ++kind) {
        mapped m = make_map(10, star, bent, kind);
        icc_picture from = make(40, 40, 1, 1, 0), to = make(40, 40, 1, 1, 0);
        int n = 1;
        const icc_env env = {.size = sizeof env, .user = &n, .progress = stop};
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(icc_map_warp(m.map, &from, &to, NULL, &env, &err), ICC_ERR_CANCELLED);
        ck_assert_int_eq(err.status, ICC_ERR_CANCELLED);
        free(from.pixels);
        free(to.pixels);
        unmake(&m);
    }
}
END_TEST

START_TEST(test_sizes)
{
    const double far[8] = {1e6, 1e6, 1.1e6, 1e6, 1.1e6, 1.1e6, 1e6, 1.1e6};
    const double huge[8] = {-1e300, -1e300, 1e300, -1e300, 1e300, 1e300, -1e300, 1e300};
    const double *const cages[3] = {whole, far, huge};
    const int32_t sizes[5][2] = {{1, 1}, {1, 9}, {7, 1}, {2, 2}, {90, 70}};
    for (int a = 0; a < 9; ++a) {
        mapped m = make_map(4, cages[a / 3], cages[a % 3], ICC_MAP_MESH);
        for (int b = 0; b < 25; ++b) {
            icc_picture from = make(sizes[b / 5][0], sizes[b / 5][1], 2, 1, 1);
            icc_picture to = make(sizes[b % 5][0], sizes[b % 5][1], 2, 1, 1);
            memset(from.pixels, 200, from.stride * (size_t)from.height);
            warp(&m, &from, &to);
            for (int32_t j = 0; j < to.height; ++j)
                for (int32_t i = 0; i < to.width; ++i)
                    ck_assert_uint_eq(get(&to, i, j, 0), inside(&m, i, j) ? 200 : 0);
            free(from.pixels);
            free(to.pixels);
        }
        unmake(&m);
    }
}
END_TEST

START_TEST(test_arguments)
{
    mapped m = make_map(4, whole, whole, ICC_MAP_MESH);
    icc_picture good = make(40, 40, 2, 1, 0), to = make(40, 40, 2, 1, 0);
    ck_assert_int_eq(icc_map_warp(NULL, &good, &to, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_map_warp(m.map, NULL, &to, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_map_warp(m.map, &good, NULL, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_map_warp(m.map, &good, &to, NULL, NULL, NULL), ICC_OK);
    for (int k = 0; k < 13; ++k) {
        icc_picture bad = good;
        bad.size = k == 0 ? 0 : bad.size;
        bad.width = k == 1 ? 0 : k == 2 ? 42 : bad.width;
        bad.height = k == 3 ? 0 : k == 4 ? -1 : bad.height;
        bad.channels = k == 5 ? 0 : k == 6 ? 65 : bad.channels;
        bad.bytes = k == 7 ? 0 : k == 8 ? 3 : bad.bytes;
        bad.alpha = k == 9 ? 2 : k == 10 ? 1 : bad.alpha;
        bad.stride = k == 11 ? SIZE_MAX / 8 : bad.stride;
        bad.pixels = k == 12 ? NULL : bad.pixels;
        icc_error err = {.size = sizeof err};
        ck_assert_msg(icc_map_warp(m.map, &bad, &to, NULL, NULL, &err) == ICC_ERR_ARGUMENT,
                      "case %d", k);
        ck_assert_int_ne(err.message[0], '\0');
        ck_assert_int_eq(icc_map_warp(m.map, &good, &bad, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    }
    free(good.pixels);
    free(to.pixels);
    unmake(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("warp");
    TCase *tcase = tcase_create("warp");
    tcase_add_test(tcase, test_identity);
    tcase_add_test(tcase, test_extent);
    tcase_add_test(tcase, test_centres_on_edges);
    tcase_add_test(tcase, test_quarter_turn);
    tcase_add_test(tcase, test_every_pixel);
    tcase_add_test(tcase, test_kinds_agree);
    tcase_add_test(tcase, test_no_alias);
    tcase_add_test(tcase, test_no_bleeding);
    tcase_add_test(tcase, test_threads);
    tcase_add_test(tcase, test_no_memory);
    tcase_add_test(tcase, test_no_search);
    tcase_add_test(tcase, test_cancel);
    tcase_add_test(tcase, test_sizes);
    tcase_add_test(tcase, test_arguments);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
