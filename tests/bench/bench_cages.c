/* Default maps of large cages: bench_cages [MOST], or bench_cages SOURCE TARGET [PIECES]. Processor
 * time of one and of two threads, time on one and on two, the least of runs in turn, with how many
 * times the one the other is, and the memory that is in use at most. Without files the cages are
 * outlines with waves, of 100 vertices up to MOST (100000); of the files' cages each edge is cut
 * into PIECES. */
#include "bench.h"
#include "cages.h"

#include <stdatomic.h>
#include <stdbool.h>

enum { RUNS = 20, MOST_SECONDS = 60 };

/* ---- memory in use, and the most that ever was ---- */

typedef struct usage {
    atomic_size_t now, most;
} usage;

/* What an allocation begins with: its size, and room so that the rest is aligned. */
enum { HEAD = 16 };

static void *count_alloc(void *user, size_t size)
{
    usage *u = user;
    char *block = malloc(size + HEAD);
    if (block == NULL)
        return NULL;
    memcpy(block, &size, sizeof size);
    const size_t now = atomic_fetch_add(&u->now, size) + size;
    size_t most = atomic_load(&u->most);
    while (now > most && !atomic_compare_exchange_weak(&u->most, &most, now))
        continue;
    return block + HEAD;
}

static void count_dealloc(void *user, void *memory)
{
    usage *u = user;
    char *block = (char *)memory - HEAD;
    size_t size;
    memcpy(&size, block, sizeof size);
    atomic_fetch_sub(&u->now, size);
    free(block);
}

/* ---- cages ---- */

static void wave(double *xy, size_t n, bool is_target)
{
    for (size_t i = 0; i < n; ++i) {
        const double angle = 6.28318530717958647692 * (double)i / (double)n;
        const double radius = is_target ? 1 + 0.16 * cos(5 * angle + 1) : 1 + 0.12 * cos(6 * angle);
        const double turn = is_target ? 0.3 : 0;
        xy[2 * i] = radius * cos(angle + turn);
        xy[2 * i + 1] = radius * sin(angle + turn);
    }
}

static size_t read_cage(const char *path, size_t pieces, double **xy)
{
    double *corner = bench_alloc(CAGE_MOST + 1, 2 * sizeof *corner);
    FILE *file = fopen(path, "r");
    size_t n = 0;
    while (file != NULL && n < CAGE_MOST &&
           fscanf(file, "%lf %lf", &corner[2 * n], &corner[2 * n + 1]) == 2)
        ++n;
    if (file == NULL || n < 3) {
        fprintf(stderr, "%s: no cage\n", path);
        exit(EXIT_FAILURE);
    }
    fclose(file);
    memcpy(corner + 2 * n, corner, 2 * sizeof *corner);
    *xy = bench_alloc(n * pieces, 2 * sizeof **xy);
    for (size_t i = 0; i < n * pieces; ++i)
        for (size_t k = 0; k < 2; ++k) {
            const double *a = corner + 2 * (i / pieces) + k;
            (*xy)[2 * i + k] = a[0] + (a[2] - a[0]) * (double)(i % pieces) / (double)pieces;
        }
    free(corner);
    return n * pieces;
}

/* ---- measuring ---- */

static icc_map_info make_map(const icc_domain *source, const icc_domain *target, const icc_env *env)
{
    icc_map *map;
    icc_map_info info = {.size = sizeof info};
    icc_error error = {.size = sizeof error};
    bench_check(icc_map_create(&map, source, target, NULL, env, &error), &error);
    bench_check(icc_map_get_info(map, &info), &error);
    icc_map_free(map);
    return info;
}

static void measure(const char *name, size_t n, const double *before, const double *after)
{
    icc_domain *source = bench_domain(n, before), *target = bench_domain(n, after);
    usage used = {0, 0};
    const icc_env counting = {
        .size = sizeof counting, .user = &used, .alloc = count_alloc, .dealloc = count_dealloc};
    const icc_map_info info = make_map(source, target, &counting);
    double processor[2] = {HUGE_VAL, HUGE_VAL}, wall[2] = {HUGE_VAL, HUGE_VAL};
    const double begin = bench_seconds();
    for (int run = 0; run < RUNS && bench_seconds() - begin < MOST_SECONDS; ++run)
        for (int32_t threads = 1; threads <= 2; ++threads) {
            const icc_env env = {.size = sizeof env, .threads = threads};
            const double start = bench_seconds(), spent = bench_processor_seconds();
            (void)make_map(source, target, &env);
            processor[threads - 1] =
                fmin(processor[threads - 1], bench_processor_seconds() - spent);
            wall[threads - 1] = fmin(wall[threads - 1], bench_seconds() - start);
        }
    printf("%-20s %8zu %10zu %7.3f %10.2f %10.2f %10.2f %10.2f %6.2f %9.0f\n", name, n,
           info.n_simplices, info.energy, 1e3 * processor[0], 1e3 * processor[1], 1e3 * wall[0],
           1e3 * wall[1], wall[1] / wall[0], (double)atomic_load(&used.most) / (double)n);
    fflush(stdout);
    icc_domain_free(source);
    icc_domain_free(target);
}

int main(int argc, char **argv)
{
    const size_t most = argc == 2 ? strtoul(argv[1], NULL, 10) : 100000;
    printf("%-20s %8s %10s %7s %10s %10s %10s %10s %6s %9s\n", "cage", "n", "triangles", "energy",
           "CPU ms", "of 2", "1 thread", "2 threads", "ratio", "B/vertex");
    if (argc >= 3) {
        const size_t pieces = argc > 3 ? strtoul(argv[3], NULL, 10) : 1;
        double *xy[2];
        const size_t n = read_cage(argv[1], pieces, &xy[0]);
        if (read_cage(argv[2], pieces, &xy[1]) != n) {
            fprintf(stderr, "the cages have different numbers of vertices\n");
            return EXIT_FAILURE;
        }
        measure(cage_name(argv[1]), n, xy[0], xy[1]);
        free(xy[0]);
        free(xy[1]);
        return EXIT_SUCCESS;
    }
    for (size_t n = 100; n <= most; n *= 10) {
        double *before = bench_alloc(n, 2 * sizeof *before);
        double *after = bench_alloc(n, 2 * sizeof *after);
        wave(before, n, false);
        wave(after, n, true);
        measure("wave", n, before, after);
        free(before);
        free(after);
    }
    return EXIT_SUCCESS;
}
