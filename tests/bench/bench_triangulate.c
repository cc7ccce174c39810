/* Time per vertex of the constrained Delaunay triangulation. */
#include "mesh/triangulate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double seconds(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

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
        const double angle =
            6.283185307179586 * (i < n_boundary ? share : uniform(&state));
        const double radius = i < n_boundary ? 1.0 + 0.2 * sin(40.0 * angle)
                                             : 0.79 * sqrt(uniform(&state));
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

/* Repeats until a quarter of a second has gone, and prints the best. */
static int measure(const char *name, shape *make, size_t n_boundary, size_t n_points)
{
    const iccp_env env = {.memory = iccp_memory_default, .threads = 1};
    double *points = malloc(2 * n_points * sizeof *points);
    uint32_t *triangles = malloc(6 * n_points * sizeof *triangles);
    icc_status status = ICC_ERR_MEMORY;
    if (points != NULL && triangles != NULL) {
        make(points, n_boundary, n_points);
        double best = HUGE_VAL, total = 0.0;
        do {
            const double start = seconds();
            status = iccp_triangulate(n_boundary, n_points, points, triangles, &env, NULL);
            const double spent = seconds() - start;
            best = spent < best ? spent : best;
            total += spent;
        } while (status == ICC_OK && total < 0.25);
        printf("%-10s %9zu %9zu %10.3f %10.3f\n", name, n_boundary, n_points, 1e3 * best,
               1e6 * best / (double)n_points);
    }
    free(triangles);
    free(points);
    return status == ICC_OK ? 0 : 1;
}

int main(void)
{
    int n_failed = 0;
    printf("%-10s %9s %9s %10s %10s\n", "shape", "boundary", "points", "ms", "us/vertex");
    for (size_t n = 100; n <= 1000000; n *= 10)
        n_failed += measure("random", wave, 50 + n / 100, n);
    n_failed += measure("random", wave, 200, 2000);
    for (size_t n = 1000; n <= 100000; n *= 10)
        n_failed += measure("outline", wave, n, n);
    for (size_t n = 1000; n <= 100000; n *= 10)
        n_failed += measure("lattice", lattice, 4, n);
    for (size_t n = 1000; n <= 100000; n *= 10)
        n_failed += measure("comb", comb, n, n);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
