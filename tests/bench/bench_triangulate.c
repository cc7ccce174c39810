/* Time per vertex of the constrained Delaunay triangulation, the checks of the polygon included. */
#include "bench.h"

#include <icc/stages.h>

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* A wavy outline of n_boundary vertices; the rest at random inside its inner circle. */
static void wave(double *points, size_t n_boundary, size_t n_points)
{
    uint64_t state = 1;
    for (size_t i = 0; i < n_points; ++i) {
        const double share = (double)i / (double)n_boundary;
        const double angle = 6.283185307179586 * (i < n_boundary ? share : uniform(&state));
        const double radius =
            i < n_boundary ? 1.0 + 0.2 * sin(40.0 * angle) : 0.79 * sqrt(uniform(&state));
        points[2 * i] = radius * cos(angle);
        points[2 * i + 1] = radius * sin(angle);
    }
}

/* A square whose inside is a regular lattice: every in-circle test is a tie. */
static void lattice(double *points, size_t n_boundary, size_t n_points)
{
    const size_t side = (size_t)sqrt((double)(n_points - n_boundary)) + 1;
    static const double corners[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
    for (size_t i = 0; i < 8; ++i)
        points[i] = corners[i] * (double)(side + 1);
    for (size_t i = n_boundary; i < n_points; ++i) {
        points[2 * i] = (double)((i - n_boundary) % side);
        points[2 * i + 1] = (double)((i - n_boundary) / side);
    }
}

/* Teeth as long as the comb is wide. */
static void comb(double *points, size_t n_boundary, size_t n_points)
{
    (void)n_points;
    for (size_t i = 0; i < n_boundary - 2; ++i) {
        points[2 * i] = (double)i;
        points[2 * i + 1] = i % 2 == 0 ? 0.0 : (double)n_boundary;
    }
    points[2 * n_boundary - 4] = (double)n_boundary - 3.0;
    points[2 * n_boundary - 3] = -1.0;
    points[2 * n_boundary - 2] = 0.0;
    points[2 * n_boundary - 1] = -1.0;
}

typedef void shape(double *points, size_t n_boundary, size_t n_points);

/* The best of as many calls as fit into a quarter of a second. */
static void measure(const char *name, shape *make, size_t n_boundary, size_t n_points)
{
    double *points = bench_alloc(2 * n_points, sizeof *points);
    uint32_t *triangles = bench_alloc(6 * n_points, sizeof *triangles);
    icc_error error = {.size = sizeof error};
    make(points, n_boundary, n_points);
    double best = HUGE_VAL, total = 0.0;
    while (total < 0.25) {
        const double start = bench_seconds();
        bench_check(icc_triangulate(n_boundary, n_points, points, triangles, NULL, &error), &error);
        const double spent = bench_seconds() - start;
        best = spent < best ? spent : best;
        total += spent;
    }
    printf("%-10s %9zu %9zu %10.3f %10.3f\n", name, n_boundary, n_points, 1e3 * best,
           1e6 * best / (double)n_points);
    free(triangles);
    free(points);
}

int main(void)
{
    printf("%-10s %9s %9s %10s %10s\n", "shape", "boundary", "points", "ms", "us/vertex");
    for (size_t n = 1000; n <= 1000000; n *= 10)
        measure("random", wave, 50 + n / 100, n);
    measure("random", wave, 200, 2000);
    for (size_t n = 1000; n <= 100000; n *= 10)
        measure("outline", wave, n, n);
    for (size_t n = 1000; n <= 100000; n *= 10)
        measure("lattice", lattice, 4, n);
    for (size_t n = 1000; n <= 100000; n *= 10)
        measure("comb", comb, n, n);
    return EXIT_SUCCESS;
}
