/* Laplace's function under the tree's inequalities, beside the figures of a prototype on the same
 * masks: A with CHOLMOD, B with conjugate gradients and multigrid. Processor time of one thread. */
#include "gradient/grid/grassfire.h"
#include "gradient/solver/active_set.h"
#include "gradient/solver/inequalities.h"

#include "../hard_masks.h"
#include "bench.h"

typedef struct one {
    const char *name;
    mask_shape shape;
    int32_t dim;
    size_t cells;
    bool iterative;
    const char *figures; /* of the prototype: seconds; iterations; residual */
} one;

static void print_result(const one *c, const iccp_unknowns *unknowns, const iccp_scaled *f,
                         const iccp_solution *info, const double seconds[2])
{
    printf("%-10s %4zu^%d %8zu %7.3f %8.3f %4zu %5zu %6.1f %% %9.1e %9.1e %5zu   %s\n", c->name,
           c->cells, (int)c->dim, unknowns->n, seconds[0], seconds[1], info->n_iterations,
           info->n_inner, 100 * (double)info->n_active / (double)unknowns->n, info->residual_before,
           info->residual, iccp_inequalities_violated(unknowns, 1e-6, f), c->figures);
    printf("%43s matrices %.3f, orders %.3f, factors %.3f, solves %.3f, checks %.3f s\n", "",
           info->seconds_setup, info->seconds_order, info->seconds_factor, info->seconds_solve,
           info->seconds_verify);
    fflush(stdout);
}

static void measure(const one *c, const iccp_unknowns *unknowns, const iccp_env *env)
{
    const iccp_scaled f = {bench_alloc(unknowns->n, sizeof(double)),
                           bench_alloc(unknowns->n, sizeof(int32_t))};
    uint32_t *top = bench_alloc(unknowns->n, sizeof *top);
    double *share = bench_alloc(unknowns->n, sizeof *share);
    for (uint32_t k = 0; k < unknowns->n; ++k) {
        top[k] = k;
        share[k] = 1;
        iccp_scaled_set(&f, k, 1, 0);
    }
    uint32_t *order = bench_alloc(unknowns->n, sizeof *order);
    order[0] = ICCP_NONE;
    const iccp_ties ties = {top, share, order};
    const iccp_tied_solver solve = c->iterative ? iccp_tied_iterative : iccp_tied_direct;
    iccp_solution info = {0};
    const icc_error error = {.message = "no result"};
    double seconds[2], start = bench_processor_seconds();
    bench_check(solve(unknowns, &ties, &f, &info, env), &error);
    seconds[0] = bench_processor_seconds() - start;
    info = (iccp_solution){0};
    start = bench_processor_seconds();
    const icc_status status = iccp_active_set_laplace(unknowns, 1e-6, solve, order, &f, &info, env);
    seconds[1] = bench_processor_seconds() - start;
    print_result(c, unknowns, &f, &info, seconds);
    if (status != ICC_OK)
        printf("%43s %s\n", "", icc_status_name(status));
    free(f.fraction);
    free(f.exponent);
    free(top);
    free(share);
    free(order);
}

static void run(const one *c)
{
    mask m = mask_draw(c->shape, c->dim, c->cells);
    iccp_env env;
    icc_error error = {.size = sizeof error};
    icc_grid *grid;
    icc_tree *tree;
    iccp_unknowns unknowns;
    uint32_t root;
    bench_check(iccp_env_read(&env, NULL, &error), &error);
    bench_check(iccp_grid_create_mask(&grid, m.dim, m.shape, m.inside, &env, &error), &error);
    mask_free(&m);
    bench_check(iccp_grassfire(grid, &root, NULL, &env, &error), &error);
    bench_check(iccp_tree_create(&tree, grid, root, ICC_TREE_THESIS, NULL, &env, &error), &error);
    iccp_grid_release(grid);
    bench_check(iccp_unknowns_create(&unknowns, tree, &env), &error);
    measure(c, &unknowns, &env);
    iccp_unknowns_free(&unknowns);
    iccp_tree_release(tree);
}

int main(int n_arguments, char **arguments)
{
    static const one all[] = {
        {"C", mask_c, 2, 50, false, "A 0.003; 4; 1e-15"},
        {"C", mask_c, 2, 200, false, "A 0.091; 9; 8e-15"},
        {"L", mask_l, 2, 1000, false, "A 9.7; 5; 4e-13"},
        {"star", mask_star, 2, 1000, false, "A 11; 17; 7e-14"},
        {"C", mask_c, 2, 1000, false, "A 46; 45; 1e-13"},
        {"serpentine", mask_serpentine, 2, 1000, false, "-"},
        {"C tube", mask_c_tube, 3, 64, false, "A 1.8; 10; 2e-15"},
        {"C", mask_c, 2, 200, true, "B 0.08; 14; 1e-10"},
        {"C tube", mask_c_tube, 3, 64, true, "B 0.11; 11; 3e-10"},
        {"C tube", mask_c_tube, 3, 128, true, "B 1.1; 12; 6e-11..5e-10"},
        {"tripod", mask_tripod, 3, 128, true, "B 2.6; 26; 6e-11..5e-10"},
        {"dumbbell", mask_dumbbell, 3, 128, true, "B 0.96; 17; 6e-11..5e-10"},
    };
    const int n_all = (int)(sizeof all / sizeof *all);
    printf("mask          grid     rows    free  constr. its. inner  active    before     after  "
           "bad   "
           "prototype\n");
    for (int i = 0; i < n_all; ++i)
        if (n_arguments < 2 || atoi(arguments[1]) == i)
            run(&all[i]);
    return 0;
}
