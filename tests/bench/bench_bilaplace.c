/* Bi-Laplace functions on the shapes of tests/hard_masks.h. Arguments: shape, dimension, cells, by
 * threes; without any, small ones. One thread; all in seconds
 * of the processor, its parts by the clock. */
#include "bench.h"

#include "gradient/function/critical_points.h"
#include "gradient/solver/bilaplace.h"

#include "../hard_masks.h"

static const double ETA = 1e-6, LEAF = 1e-9;

typedef struct bench_case {
    const char *shape;
    int32_t dim;
    size_t cells;
} bench_case;

static mask draw(const bench_case *c)
{
    for (int k = 0; k < N_MASKS; ++k)
        if (strcmp(mask_number(k).name, c->shape) == 0)
            return mask_draw(mask_number(k).shape, c->dim, c->cells);
    fprintf(stderr, "no shape %s\n", c->shape);
    exit(EXIT_FAILURE);
}

static icc_tree *grow(const bench_case *c)
{
    icc_error error = {.size = sizeof error};
    icc_grid *grid;
    icc_tree *tree;
    uint32_t root;
    mask m = draw(c);
    bench_check(icc_grid_create_mask(&grid, m.dim, m.shape, m.inside, NULL, &error), &error);
    bench_check(icc_grid_find_maximum(grid, &root, NULL, NULL, &error), &error);
    bench_check(icc_tree_create(&tree, grid, root, NULL, NULL, &error), &error);
    icc_grid_free(grid);
    mask_free(&m);
    return tree;
}

static void print_points(const icc_tree *tree, const iccp_unknowns *unknowns, const iccp_scaled *f,
                         const iccp_env *env)
{
    icc_function *field;
    icc_function_report report = {.size = sizeof report};
    if (iccp_function_new(&field, tree, env) == ICC_OK &&
        iccp_function_assign(field, unknowns, f) == ICC_OK &&
        iccp_function_verify(field, &report, env) == ICC_OK)
        printf(" %4zu %4zu %4zu", report.n_maxima, report.n_minima, report.n_saddles);
    iccp_function_release(field);
}

static void measure(const bench_case *c, int32_t function, bool constrained)
{
    iccp_env env;
    iccp_unknowns unknowns;
    iccp_solution info = {0};
    icc_error error = {.size = sizeof error};
    icc_tree *tree = grow(c);
    bench_check(iccp_env_read(&env, NULL, &error), &error);
    bench_check(iccp_unknowns_create(&unknowns, tree, &env), &error);
    const iccp_scaled f = {bench_alloc(unknowns.n, sizeof *f.fraction),
                           bench_alloc(unknowns.n, sizeof *f.exponent)};
    const double start = bench_processor_seconds();
    const icc_status status =
        constrained ? iccp_bilaplace_constrained(&unknowns, function, ETA, LEAF, &f, &info, &env)
                    : iccp_bilaplace(&unknowns, function, ICC_SOLVER_DIRECT, &f, &info, &env);
    printf("%-10s %d %5zu %8zu %-7s", c->shape, (int)c->dim, c->cells, unknowns.n,
           function == ICC_FUNCTION_CLAMPED ? "clamped" : "Navier");
    printf(" %8.3f %7.3f %8.3f %8.3f %5zu %5.1f", bench_processor_seconds() - start,
           info.seconds_order, info.seconds_factor, info.seconds_solve, info.n_iterations,
           100 * (double)info.n_active / (double)unknowns.n);
    if (status == ICC_OK) {
        printf(" %8.1e %8.1e", info.residual_before, info.residual);
        print_points(tree, &unknowns, &f, &env);
    } else
        printf(" %s", icc_status_name(status));
    printf("\n");
    fflush(stdout);
    free(f.fraction);
    free(f.exponent);
    iccp_unknowns_free(&unknowns);
    icc_tree_free(tree);
}

static void measure_all(const bench_case *c)
{
    for (int constrained = 0; constrained < 2; ++constrained) {
        measure(c, ICC_FUNCTION_BILAPLACE, constrained);
        measure(c, ICC_FUNCTION_CLAMPED, constrained);
    }
}

int main(int argc, char **argv)
{
    static const bench_case SMALL[] = {{"box", 2, 200}, {"C", 2, 200},       {"star", 2, 200},
                                       {"L", 2, 200},   {"dumbbell", 3, 32}, {"tripod", 3, 32},
                                       {"drum", 3, 32}};
    printf(
        "                                           seconds                         steps active "
        "residual\n"
        "shape     dim cells     rows function       all   order   factor    solve         %%   "
        "before    after  max  min sadd\n");
    for (size_t k = 0; argc < 4 && k < sizeof SMALL / sizeof *SMALL; ++k)
        measure_all(&SMALL[k]);
    for (int k = 1; k + 2 < argc; k += 3) {
        const bench_case c = {argv[k], atoi(argv[k + 1]), (size_t)atoi(argv[k + 2])};
        measure_all(&c);
    }
    return EXIT_SUCCESS;
}
