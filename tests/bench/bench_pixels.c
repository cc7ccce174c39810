/* The paper's pictures have 38,850 pixels on average; mapping one on a grid of 50 x 50 took its
 * authors about 30 minutes, 46 ms a pixel (section 7). */
#include "bench.h"

enum { PIXELS = 38850, REPEATS = 7, MOST_THREADS = 2 };

/* The centres of square pixels that lie inside a domain, row by row; PIXELS of them or hardly
 * fewer. */
static size_t list_pixels(const icc_domain *domain, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    icc_error error = {.size = sizeof error};
    bench_check(icc_domain_get_info(domain, &info), &error);
    const double side = sqrt(info.measure / PIXELS);
    size_t n = 0;
    for (double y = info.lower[1] + side / 2; y < info.upper[1]; y += side)
        for (double x = info.lower[0] + side / 2; x < info.upper[0] && n < PIXELS; x += side) {
            const double p[2] = {x, y};
            int32_t where;
            bench_check(icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL), &error);
            if (where == ICC_INSIDE)
                memcpy(points + 2 * n++, p, sizeof p);
        }
    return n;
}

typedef icc_status (*direction)(const icc_map *, size_t, const double *, double *, icc_status *,
                                size_t *, const icc_env *);

static void measure(const char *name, const char *what, const icc_map *map, direction apply,
                    const icc_domain *from)
{
    double *points = bench_alloc(PIXELS, 2 * sizeof *points);
    double *images = bench_alloc(PIXELS, 2 * sizeof *images);
    const size_t n = list_pixels(from, points);
    for (int32_t threads = 1; threads <= MOST_THREADS; ++threads) {
        const icc_env env = {.size = sizeof env, .threads = threads};
        icc_error error = {.size = sizeof error};
        size_t n_failed = 0;
        double best = HUGE_VAL;
        for (int k = 0; k < REPEATS; ++k) {
            const double start = bench_seconds();
            bench_check(apply(map, n, points, images, NULL, &n_failed, &env), &error);
            best = fmin(best, bench_seconds() - start);
        }
        printf("%-6s %-9s %7d %8zu %9.4f %9.2f %8zu\n", name, what, threads, n, best,
               1e6 * best / (double)n, n_failed);
    }
    free(points);
    free(images);
}

int main(void)
{
    printf("published: 38850 pixels in about 1800 s, 46000 us a pixel\n");
    printf("pair   direction threads   pixels         s  us/pixel   failed\n");
    for (int k = 0; k < BENCH_PAIRS; ++k) {
        const bench_pair pair = bench_number(k);
        icc_domain *source = bench_domain(pair.n, pair.source[0]);
        icc_domain *target = bench_domain(pair.n, pair.target[0]);
        const icc_chart_options chart = {
            .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .cells = 50};
        const icc_map_options options = {.size = sizeof options, .chart = &chart};
        icc_map *map;
        icc_error error = {.size = sizeof error};
        bench_check(icc_map_create(&map, source, target, &options, NULL, &error), &error);
        measure(pair.name, "forward", map, icc_map_apply, source);
        measure(pair.name, "inverse", map, icc_map_apply_inverse, target);
        icc_map_free(map);
        icc_domain_free(source);
        icc_domain_free(target);
    }
    return EXIT_SUCCESS;
}
