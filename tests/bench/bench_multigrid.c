/* Conjugate gradients with the multigrid preconditioner on masks: a unit load at the middle vertex,
 * from 0 to a relative residual of 1e-10. One thread, processor time of the fastest of three runs,
 * set-up included; the prototype's figures beside ours where it had the mask. Arguments: parts of
 * the names of masks to run. */
#include "bench.h"

#include "gradient/solver/mg_cg.h"

#include "../hard_masks.h"

enum { RUNS = 3 };

typedef struct test_mask {
    const char *name;
    mask_shape shape;
    int32_t dim;
    size_t cells;
    const char *prototype;
} test_mask;

static const test_mask MASKS[] = {
    {"square", mask_box, 2, 50, "0.001 s, 12"},
    {"square", mask_box, 2, 200, "0.008 s, 17"},
    {"square", mask_box, 2, 1000, "0.21 s, 18, 65 B"},
    {"L", mask_l, 2, 1000, ""},
    {"C", mask_c, 2, 1000, ""},
    {"star", mask_star, 2, 1000, "0.11 s, 17"},
    {"serpentine", mask_serpentine, 2, 1000, ""},
    {"rooms", mask_rooms, 2, 1000, ""},
    {"box", mask_box, 3, 32, "0.007 s, 15"},
    {"box", mask_box, 3, 64, "0.065 s, 17"},
    {"box", mask_box, 3, 128, "0.70-0.76 s, 20, 64 B"},
    {"ball", mask_ball, 3, 128, ""},
    {"C tube", mask_c_tube, 3, 128, "0.22 s, 14"},
    {"dumbbell", mask_dumbbell, 3, 128, ""},
    {"tripod", mask_tripod, 3, 128, ""},
    {"drum", mask_drum, 3, 128, ""},
    {"box", mask_box, 4, 32, ""},
    {"ball", mask_ball, 5, 12, ""},
};

typedef struct timing {
    double setup, solve;
    size_t n_iterations, bytes;
} timing;

static size_t level_bytes(const iccp_mg_level *level)
{
    const size_t floats = level->inverse != NULL ? 3 : 2;
    return level->n_entries * floats * sizeof(float) + (level->n_rows + 1) * sizeof *level->row +
           level->row[level->n_rows].run[0] * sizeof *level->run;
}

static size_t count_bytes(const iccp_multigrid *mg)
{
    size_t sum = 4 * ((size_t)mg->level[0].extent[0] + 8) * sizeof(float);
    for (int32_t l = 0; l < mg->n_levels; ++l)
        sum += level_bytes(&mg->level[l]);
    return sum;
}

static timing run(const icc_grid *grid, size_t n, const uint32_t *vertex, const iccp_env *env)
{
    const iccp_mg_goal goal = {.relative = 1e-10, .componentwise = HUGE_VAL, .floor = 1};
    iccp_multigrid mg;
    timing result = {0};
    const double start = bench_processor_seconds();
    uint32_t *position = bench_alloc(n, sizeof *position);
    bench_check(iccp_multigrid_create(&mg, grid, n, vertex, position, env), NULL);
    const double middle = bench_processor_seconds();
    const iccp_mg_level *level = &mg.level[0];
    double *x = bench_alloc(level->n_entries, sizeof *x),
           *r = bench_alloc(level->n_entries, sizeof *r);
    r[position[n / 2]] = 1;
    free(position);
    bench_check(iccp_mg_cg(&mg, x, r, 1, &goal, &result.n_iterations, env), NULL);
    result.setup = middle - start;
    result.solve = bench_processor_seconds() - middle;
    /* x and r in double, the direction in float. */
    result.bytes = count_bytes(&mg) + level->n_entries * (2 * sizeof(double) + sizeof(float));
    free(x);
    free(r);
    iccp_multigrid_free(&mg);
    return result;
}

static void print_mask(const test_mask *test, const iccp_env *env)
{
    mask m = mask_draw(test->shape, test->dim, test->cells);
    icc_grid *grid;
    bench_check(icc_grid_create_mask(&grid, test->dim, m.shape, m.inside, NULL, NULL), NULL);
    uint32_t *vertex = bench_alloc(m.n_inside, sizeof *vertex);
    size_t n = 0;
    for (size_t v = 0; v < m.n_vertices; ++v)
        if (m.inside[v])
            vertex[n++] = (uint32_t)v;
    timing best = {.setup = HUGE_VAL};
    for (int i = 0; i < RUNS; ++i) {
        const timing one = run(grid, n, vertex, env);
        best = one.setup + one.solve < best.setup + best.solve ? one : best;
    }
    printf("%-10s %4zu^%d %9zu %8.4f %8.4f %4zu %7.1f %7.1f   %s\n", test->name, test->cells,
           (int)test->dim, n, best.setup, best.setup + best.solve, best.n_iterations,
           1e9 * best.solve / (double)n / (double)best.n_iterations, (double)best.bytes / (double)n,
           test->prototype);
    fflush(stdout);
    free(vertex);
    icc_grid_free(grid);
    mask_free(&m);
}

static int is_wanted(const char *name, int argc, char **argv)
{
    for (int i = 1; i < argc; ++i)
        if (strstr(name, argv[i]) != NULL)
            return 1;
    return argc < 2;
}

int main(int argc, char **argv)
{
    iccp_env env;
    bench_check(iccp_env_read(&env, NULL, NULL), NULL);
    printf("%-17s %9s %8s %8s %4s %7s %7s   %s\n", "mask", "unknowns", "set-up s", "all s", "its",
           "ns/unk.", "B/unk.", "prototype: all s, its, B/unk.");
    for (size_t i = 0; i < sizeof MASKS / sizeof *MASKS; ++i)
        if (is_wanted(MASKS[i].name, argc, argv))
            print_mask(&MASKS[i], &env);
    return EXIT_SUCCESS;
}
