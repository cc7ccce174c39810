/* What it costs to order the vertices of a grid, and what a tree costs to compare. Run by hand on a
 * quiet machine. */
#include <icc/stages.h>

#include "../hard_masks.h"
#include "bench.h"

enum { N_RUNS = 5 };

/* A ball with a deep narrow pit off its middle, entered from the side: growth has to wait. */
static bool bowl(const double *p, int32_t dim, double size)
{
    (void)size;
    double square = 0, side = 0;
    for (int32_t k = 0; k < dim; ++k)
        square += (p[k] - 0.5) * (p[k] - 0.5);
    for (int32_t k = 1; k < dim; ++k)
        side = fmax(side, fabs(p[k] - 0.54));
    return square < 0.25 && !(side < 0.13 && p[0] > 0.15);
}

/* A box where the set may only be built up in a random order. */
static double *random_wish(const mask *m)
{
    uint64_t state = 1;
    double *values = bench_alloc(m->n_vertices, sizeof *values);
    for (size_t v = 0; v < m->n_vertices; ++v) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        values[v] = (double)(state >> 11);
    }
    return values;
}

static void run(const char *name, mask_shape shape, int32_t dim, size_t cells, bool wish)
{
    mask m = mask_draw(shape, dim, cells);
    double *values = wish ? random_wish(&m) : NULL, tree_time = 1e9, grow_time = 1e9;
    uint32_t root, *rank = bench_alloc(m.n_vertices, sizeof *rank);
    icc_grid *grid;
    icc_grow_report report = {.size = sizeof report};
    icc_error err = {.size = sizeof err};
    bench_check(icc_grid_create_mask(&grid, dim, m.shape, m.inside, NULL, &err), &err);
    bench_check(icc_grid_find_maximum(grid, &root, NULL, NULL, &err), &err);
    for (int i = 0; i < N_RUNS; ++i) {
        icc_tree *tree;
        const double begin = bench_seconds();
        bench_check(icc_tree_create(&tree, grid, root, NULL, NULL, &err), &err);
        const double middle = bench_seconds();
        const icc_status status = icc_tree_grow(tree, values, rank, &report, NULL, &err);
        if (status != ICC_ERR_TOPOLOGY)
            bench_check(status, &err);
        tree_time = fmin(tree_time, middle - begin);
        grow_time = fmin(grow_time, bench_seconds() - middle);
        icc_tree_free(tree);
    }
    const double n = (double)report.n_vertices;
    printf("%-22s %9zu %7.0f %7.0f %6.2f %9zu %9zu %9zu\n", name, report.n_vertices,
           1e9 * tree_time / n, 1e9 * grow_time / n, (double)report.n_tests / n, report.n_deferred,
           report.n_unplaced, report.n_remaining);
    icc_grid_free(grid);
    mask_free(&m);
    free(values);
    free(rank);
}

int main(void)
{
    printf("%-22s %9s %7s %7s %6s %9s %9s %9s\n", "ns per vertex", "vertices", "tree", "grow",
           "tests", "postponed", "unplaced", "left");
    run("box 500^2", mask_box, 2, 500, false);
    run("box 64^3", mask_box, 3, 64, false);
    run("ball 64^3", mask_ball, 3, 64, false);
    run("bowl 64^3", bowl, 3, 64, false);
    run("drum 64^3", mask_drum, 3, 64, false);
    run("box 64^3, random wish", mask_box, 3, 64, true);
    run("box 128^3", mask_box, 3, 128, false);
    run("ball 128^3", mask_ball, 3, 128, false);
    run("bowl 128^3", bowl, 3, 128, false);
    run("box 128^3, random wish", mask_box, 3, 128, true);
    run("ball 16^4", mask_ball, 4, 16, false);
    run("box 8^5", mask_box, 5, 8, false);
    return 0;
}
