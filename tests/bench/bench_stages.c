/* What each stage costs per grid vertex. Run by hand on a quiet machine. */
#define _POSIX_C_SOURCE 200809L

#include "icc/stages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BOUNDARY = 64 };

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void require(icc_status status)
{
    if (status == ICC_OK)
        return;
    (void)fprintf(stderr, "%s\n", icc_status_name(status));
    exit(1);
}

/* Seconds per stage: the best of several runs. */
enum { GRID, MAXIMUM, TREE, VERIFY, FIELD, CRITICAL, N_STAGES };

static void keep_least(double seconds[N_STAGES], int stage, double *since)
{
    const double end = now();
    if (end - *since < seconds[stage])
        seconds[stage] = end - *since;
    *since = now();
}

/* A grid from a domain, or from a mask when there is no domain. */
static icc_grid *make(const icc_domain *domain, int32_t cells, int32_t dim, const size_t *shape,
                      const uint8_t *inside)
{
    icc_grid *grid;
    require(domain != NULL ? icc_grid_create(&grid, domain, cells, NULL, NULL)
                           : icc_grid_create_mask(&grid, dim, shape, inside, NULL, NULL));
    return grid;
}

static void run(const char *name, const icc_domain *domain, int32_t cells, int32_t dim,
                const size_t *shape, const uint8_t *inside)
{
    double seconds[N_STAGES];
    for (int s = 0; s < N_STAGES; ++s)
        seconds[s] = 1e9;
    icc_grid_info info = {.size = sizeof info};
    const double stop = now() + 1.5;
    for (int i = 0; i < 3 || now() < stop; ++i) {
        icc_tree *tree;
        icc_function *field;
        uint32_t root;
        icc_tree_report tree_report = {.size = sizeof tree_report};
        icc_function_report field_report = {.size = sizeof field_report};
        double since = now();
        icc_grid *grid = make(domain, cells, dim, shape, inside);
        keep_least(seconds, GRID, &since);
        require(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL));
        keep_least(seconds, MAXIMUM, &since);
        require(icc_tree_create(&tree, grid, root, NULL, NULL, NULL));
        keep_least(seconds, TREE, &since);
        require(icc_tree_get_report(tree, &tree_report, NULL, NULL));
        keep_least(seconds, VERIFY, &since);
        require(icc_function_create(&field, tree, NULL, NULL, NULL));
        keep_least(seconds, FIELD, &since);
        require(icc_function_get_report(field, &field_report, NULL, NULL));
        keep_least(seconds, CRITICAL, &since);
        require(icc_grid_get_info(grid, &info));
        icc_function_free(field);
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
    (void)printf("%-14s %9zu", name, info.n_vertices);
    for (int s = 0; s < N_STAGES; ++s)
        (void)printf(" %9.1f", 1e9 * seconds[s] / (double)info.n_vertices);
    (void)printf("\n");
}

static void run_polygon(const char *name, int32_t cells)
{
    double points[2 * BOUNDARY];
    for (int k = 0; k < BOUNDARY; ++k) { /* a rounded square with a dent */
        const int side = 4 * k / BOUNDARY;
        const double t = (double)(k % (BOUNDARY / 4)) / (BOUNDARY / 4) * 2 - 1;
        const double out = 1.25 - 0.25 * t * t,
                     at[4][2] = {{t, -out}, {out, t}, {-t, out}, {-0.4, -t}};
        memcpy(points + 2 * k, at[side], sizeof at[side]);
    }
    icc_domain *domain;
    require(icc_domain_create(&domain, 2, BOUNDARY, points, 0, NULL, NULL, NULL));
    run(name, domain, cells, 2, NULL, NULL);
    icc_domain_free(domain);
}

/* A ball of the given radius in a cube, in vertices. */
static void run_ball(const char *name, size_t side)
{
    uint8_t *inside = malloc(side * side * side);
    if (inside == NULL)
        return;
    const double middle = 0.5 * (double)(side - 1), radius = middle - 2;
    for (size_t v = 0; v < side * side * side; ++v) {
        const double x = (double)(v % side) - middle, y = (double)(v / side % side) - middle;
        const double z = (double)(v / side / side) - middle;
        inside[v] = x * x + y * y + z * z < radius * radius;
    }
    run(name, NULL, 0, 3, (size_t[]){side, side, side}, inside);
    free(inside);
}

int main(void)
{
    (void)printf("ns per vertex  %9s %9s %9s %9s %9s %9s %9s\n", "vertices", "grid", "maximum",
                 "tree", "verify", "values", "critical");
    run_polygon("2-D, 50", 50);
    run_polygon("2-D, 1000", 1000);
    run_ball("3-D, 64", 64);
    run_ball("3-D, 128", 128);
    return 0;
}
