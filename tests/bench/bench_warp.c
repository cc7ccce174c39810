/* Pictures carried along, from pixels to pixels, with everything built anew: domains, map, warp.
 * usage: bench_warp [SOURCE.txt TARGET.txt WIDTH HEIGHT]...
 * with cages of one vertex "x y" on a line. Decoding and encoding of pictures is not part of it.
 *
 * Beside OpenCV: bench_warp.py.
 *
 * Bars: 512 x 512 in 30 ms on 2 threads; a million pixels in 16 ms when only the target moves
 * (cages of at most 66 vertices). */
#include "bench.h"

enum { REPEATS = 9, MOST_VERTICES = 1 << 16, MOST_THREADS = 2 };

typedef struct cages {
    size_t n;
    double *source, *target;
} cages;

static size_t read_cage(const char *name, double *points)
{
    FILE *file = fopen(name, "r");
    size_t n = 0;
    if (file == NULL) {
        perror(name);
        exit(EXIT_FAILURE);
    }
    while (n < MOST_VERTICES && fscanf(file, "%lf %lf", &points[2 * n], &points[2 * n + 1]) == 2)
        ++n;
    fclose(file);
    return n;
}

/* A round cage with six waves that turns into one with five, turned a little. */
static void draw_cages(cages *c, double size)
{
    c->n = 66;
    for (size_t i = 0; i < c->n; ++i) {
        const double angle = 6.28318530717958647692 * (double)i / (double)c->n;
        const double before = 0.42 * size * (1 + 0.12 * cos(6 * angle));
        const double after = 0.41 * size * (1 + 0.16 * cos(5 * angle + 1));
        c->source[2 * i] = 0.5 * size + before * cos(angle);
        c->source[2 * i + 1] = 0.5 * size + before * sin(angle);
        c->target[2 * i] = 0.5 * size + after * cos(angle + 0.3);
        c->target[2 * i + 1] = 0.5 * size + after * sin(angle + 0.3);
    }
}

static icc_picture make_picture(int32_t width, int32_t height, int32_t channels, int32_t bytes,
                                int32_t alpha)
{
    icc_picture p = {.size = sizeof p,
                     .width = width,
                     .height = height,
                     .channels = channels,
                     .bytes = bytes,
                     .alpha = alpha,
                     .stride = (size_t)width * (size_t)(channels * bytes)};
    p.pixels = bench_alloc(p.stride, (size_t)height);
    uint32_t random = 1;
    for (size_t k = 0; k < p.stride * (size_t)height; ++k) {
        random = random * 1664525 + 1013904223;
        ((uint8_t *)p.pixels)[k] = (uint8_t)(random >> 24);
    }
    return p;
}

typedef struct stages {
    double domains, map, warp, all, processor; /* the last: of the warp, all threads together */
    size_t n_triangles;
} stages;

static stages once(const cages *c, const icc_picture *from, const icc_picture *to,
                   int32_t iterations, int32_t threads)
{
    const icc_env env = {.size = sizeof env, .threads = threads};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_MESH, .iterations = iterations};
    icc_error error = {.size = sizeof error};
    icc_domain *source, *target;
    icc_map *map;
    icc_map_info info = {.size = sizeof info};
    const double begin = bench_seconds();
    bench_check(icc_domain_create(&source, 2, c->n, c->source, 0, NULL, &env, &error), &error);
    bench_check(icc_domain_create(&target, 2, c->n, c->target, 0, NULL, &env, &error), &error);
    const double made = bench_seconds();
    bench_check(icc_map_create(&map, source, target, &options, &env, &error), &error);
    const double mapped = bench_seconds();
    const double started = bench_processor_seconds();
    bench_check(icc_map_warp(map, from, to, NULL, &env, &error), &error);
    const double processor = bench_processor_seconds() - started;
    const double end = bench_seconds();
    icc_map_get_info(map, &info);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    return (stages){made - begin, mapped - made, end - mapped,
                    end - begin,  processor,     info.n_simplices};
}

static void measure(const char *name, const cages *c, const icc_picture *from,
                    const icc_picture *to)
{
    for (int32_t threads = 1; threads <= MOST_THREADS; ++threads)
        for (int32_t iterations = -1; iterations <= 0; ++iterations) {
            stages best = {.all = HUGE_VAL};
            for (int k = 0; k < REPEATS; ++k) {
                const stages s = once(c, from, to, iterations, threads);
                best = s.all < best.all ? s : best;
            }
            printf("%-18s %4ldx%-4ld %ldx%ld%c %7ld %-4s %9zu %8.2f %8.2f %8.2f %8.2f %9.2f\n",
                   name, (long)from->width, (long)from->height, (long)from->channels,
                   (long)from->bytes, from->alpha ? 'a' : ' ', (long)threads,
                   iterations < 0 ? "no" : "yes", best.n_triangles, 1e3 * best.domains,
                   1e3 * best.map, 1e3 * best.warp, 1e3 * best.all, 1e3 * best.processor);
        }
}

static void measure_formats(const char *name, const cages *c, int32_t width, int32_t height,
                            int n_formats)
{
    static const int32_t formats[5][3] = {{3, 1, 0}, {4, 1, 1}, {1, 1, 0}, {3, 2, 0}, {4, 2, 1}};
    for (int k = 0; k < n_formats; ++k) {
        const int32_t *f = formats[k];
        icc_picture from = make_picture(width, height, f[0], f[1], f[2]);
        icc_picture to = make_picture(width, height, f[0], f[1], f[2]);
        measure(name, c, &from, &to);
        free(from.pixels);
        free(to.pixels);
    }
}

int main(int n_arguments, char **arguments)
{
    cages c = {0, bench_alloc(MOST_VERTICES, 2 * sizeof(double)),
               bench_alloc(MOST_VERTICES, 2 * sizeof(double))};
    printf("ms; picture: channels x bytes, a: opacity\n");
    printf("%-18s %-9s %-4s %7s %-4s %9s %8s %8s %8s %8s %9s\n", "cages", "size", "kind", "threads",
           "fair", "triangles", "domains", "map", "warp", "all", "warp, cpu");
    for (int k = 1; k + 3 < n_arguments; k += 4) {
        c.n = read_cage(arguments[k], c.source);
        if (read_cage(arguments[k + 1], c.target) != c.n) {
            fprintf(stderr, "%s: not as many vertices as the source\n", arguments[k + 1]);
            return EXIT_FAILURE;
        }
        const char *name = strrchr(arguments[k], '/');
        measure_formats(name != NULL ? name + 1 : arguments[k], &c, atoi(arguments[k + 2]),
                        atoi(arguments[k + 3]), 1);
    }
    for (int32_t size = 512; n_arguments == 1 && size <= 1024; size *= 2) {
        draw_cages(&c, size);
        measure_formats("66 vertices", &c, size, size, 5);
    }
    free(c.source);
    free(c.target);
    return EXIT_SUCCESS;
}
