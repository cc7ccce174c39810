/* Progress is one share for a whole call: it lies in [0, 1], never falls and is 1 at the end; its
 * stages have names that icc/base.h lists. */
#include "objects.h"

#include "../suite.h"

#include <stdbool.h>

static const char *const STAGES[] = {"check",  "repair",  "mesh",  "grid",    "tree",
                                     "order",  "solve",   "trace", "improve", "warp",
                                     "sample", "weights", "load"};

typedef struct watcher {
    const char *call;
    size_t n;
    double last;
    bool named[sizeof STAGES / sizeof *STAGES];
} watcher;

static int32_t watch(void *user, const char *stage, double share)
{
    watcher *w = user;
    size_t s = 0;
    while (s < sizeof STAGES / sizeof *STAGES && strcmp(stage, STAGES[s]) != 0)
        ++s;
    if (s == sizeof STAGES / sizeof *STAGES)
        ck_abort_msg("%s: stage \"%s\" is not documented", w->call, stage);
    if (!(share >= 0 && share <= 1))
        ck_abort_msg("%s: the share of \"%s\" is %g", w->call, stage, share);
    if (share < w->last)
        ck_abort_msg("%s: the share falls from %g to %g in \"%s\"", w->call, w->last, share, stage);
    w->last = share;
    w->named[s] = true;
    ++w->n;
    return 0;
}

static bool names(const watcher *w, const char *stage)
{
    for (size_t s = 0; s < sizeof STAGES / sizeof *STAGES; ++s)
        if (strcmp(STAGES[s], stage) == 0)
            return w->named[s];
    return false;
}

static icc_env env_of(watcher *w, int32_t threads)
{
    return (icc_env){.size = sizeof(icc_env), .user = w, .progress = watch, .threads = threads};
}

static void check_end(const watcher *w, size_t least)
{
    if (w->n < least)
        ck_abort_msg("%s: %zu reports", w->call, w->n);
    if (w->n > 0 && !(w->last >= 1))
        ck_abort_msg("%s: the last share is %g", w->call, w->last);
}

START_TEST(every_call_goes_forward_to_1)
{
    static outcome out;
    objects o;
    objects_init(&o, METHODS[_i]);
    for (int i = 0; i < N_CALLS; ++i)
        for (int32_t threads = 1; threads <= 3; threads += 2) {
            if (_i > 0 && is_once(&CALLS[i]))
                continue;
            watcher w = {.call = CALLS[i].name};
            const icc_env env = env_of(&w, threads);
            ck_assert_int_eq(CALLS[i].run(&o, &out, &env, NULL), ICC_OK);
            check_end(&w, 0);
        }
    objects_clear(&o);
}
END_TEST

static icc_domain *wavy(size_t n, double phase)
{
    double *vertices = calloc(n, 2 * sizeof *vertices);
    icc_domain *domain;
    ck_assert_ptr_nonnull(vertices);
    for (size_t i = 0; i < n; ++i) {
        const double t = 6.283185307179586 * (double)i / (double)n;
        const double r = 1 + 0.2 * cos(3 * t + phase) + 0.05 * cos(17 * t);
        vertices[2 * i] = r * cos(t);
        vertices[2 * i + 1] = r * sin(t);
    }
    ck_assert_int_eq(icc_domain_create(&domain, 2, n, vertices, 0, NULL, NULL, NULL), ICC_OK);
    free(vertices);
    return domain;
}

static void load_again(const icc_map *map)
{
    size_t n;
    ck_assert_int_eq(icc_map_save(map, 0, NULL, &n), ICC_OK);
    void *bytes = malloc(n);
    icc_map *loaded;
    ck_assert_ptr_nonnull(bytes);
    ck_assert_int_eq(icc_map_save(map, n, bytes, &n), ICC_OK);
    watcher w = {.call = "icc_map_load"};
    const icc_env env = env_of(&w, 1);
    ck_assert_int_eq(icc_map_load(&loaded, n, bytes, &env, NULL), ICC_OK);
    check_end(&w, 2);
    ck_assert(names(&w, "load") && !names(&w, "check") && !names(&w, "solve"));
    icc_map_free(loaded);
    free(bytes);
}

/* The greatest step between two reports. */
typedef struct steps {
    watcher watcher;
    double greatest;
} steps;

static int32_t watch_steps(void *user, const char *stage, double share)
{
    steps *s = user;
    const double step = share - s->watcher.last;
    s->greatest = step > s->greatest ? step : s->greatest;
    return watch(&s->watcher, stage, share);
}

/* Long work moves on bit by bit. */
START_TEST(a_long_call_tells_how_far_it_is)
{
    icc_domain *source = wavy(2000, 0), *target = wavy(2000, 1);
    icc_map *map;
    steps s = {.watcher = {.call = "icc_map_create"}};
    const icc_env env = {.size = sizeof env, .user = &s, .progress = watch_steps};
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, &env, NULL), ICC_OK);
    check_end(&s.watcher, 30);
    ck_assert_double_le(s.greatest, 0.5);
    ck_assert(names(&s.watcher, "mesh") && names(&s.watcher, "solve") &&
              names(&s.watcher, "improve") && names(&s.watcher, "check"));
    load_again(map);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

START_TEST(pictures_are_warped_bit_by_bit)
{
    enum { WIDTH = 64, HEIGHT = 640 };
    static uint8_t pixels[2][WIDTH * HEIGHT];
    objects o;
    objects_init(&o, ICC_METHOD_DISC);
    icc_picture picture[2];
    for (int k = 0; k < 2; ++k)
        picture[k] = (icc_picture){.size = sizeof picture[k],
                                   .pixels = pixels[k],
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .channels = 1,
                                   .bytes = 1,
                                   .stride = WIDTH};
    watcher w = {.call = "icc_map_warp"};
    const icc_env env = env_of(&w, 2);
    ck_assert_int_eq(icc_map_warp(o.mesh_map, &picture[0], &picture[1], NULL, &env, NULL), ICC_OK);
    check_end(&w, 2);
    ck_assert(names(&w, "warp"));
    objects_clear(&o);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("progress");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 240);
    tcase_add_loop_test(tests, every_call_goes_forward_to_1, 0, N_METHODS);
    tcase_add_test(tests, a_long_call_tells_how_far_it_is);
    tcase_add_test(tests, pictures_are_warped_bit_by_bit);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
