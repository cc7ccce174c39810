/* What it costs to walk along integral lines in 2 to 5 dimensions. Run by hand on a quiet machine. */
#include "trace/walk2.h"
#include "trace/walkn.h"

#include "../hard_masks.h"
#include "../random.h"
#include "bench.h"

enum { N_WALKS = 4000 };

typedef struct tally {
    size_t n_steps, n_crossings, n_lines, n_ends;
    double seconds;
} tally;

static void pick(const icc_grid *grid, random_source *r, double *p)
{
    for (int32_t k = 0; k < grid->dim; ++k)
        p[k] = random_between(r, 2, (double)grid->shape[k] - 3);
}

static tally climb(const icc_field *field)
{
    tally t = {0};
    random_source r = {1};
    double p[ICC_MAX_DIM];
    const double begin = bench_seconds();
    for (; t.n_lines < N_WALKS; ++t.n_lines) {
        iccp_walkn walk;
        pick(field->tree->grid, &r, p);
        icc_status status = iccp_walkn_start(&walk, field, ICCP_UPHILL, p, NULL);
        const size_t budget = walk.steps_left;
        status = iccp_walkn_uphill(&walk, NULL, NULL);
        t.n_steps += budget - walk.steps_left;
        t.n_ends += status == ICC_OK;
    }
    t.seconds = bench_seconds() - begin;
    /* Again, to see what the steps are. */
    r = (random_source){1};
    for (size_t i = 0; i < t.n_lines; ++i) {
        iccp_walkn walk;
        pick(field->tree->grid, &r, p);
        if (iccp_walkn_start(&walk, field, ICCP_UPHILL, p, NULL) != ICC_OK)
            continue;
        while (!iccp_walkn_at_root(&walk) && iccp_walkn_step(&walk) == ICC_OK)
            t.n_crossings += walk.ahead;
    }
    return t;
}

static tally climb_plane(const icc_field *field)
{
    tally t = {0};
    random_source r = {1};
    double p[ICC_MAX_DIM];
    const double begin = bench_seconds();
    for (; t.n_lines < N_WALKS; ++t.n_lines) {
        iccp_walk2 walk;
        pick(field->tree->grid, &r, p);
        icc_status status = iccp_walk2_start(&walk, field, ICCP_UPHILL, p[0], p[1], NULL);
        const size_t budget = walk.steps_left;
        status = iccp_trace_uphill(&walk, NULL, NULL);
        t.n_steps += budget - walk.steps_left;
        t.n_ends += status == ICC_OK;
    }
    t.seconds = bench_seconds() - begin;
    return t;
}

static void print(const char *name, const char *function, const tally *t)
{
    printf("%-12s %-9s %7.1f %7.0f %8.1f %7.1f %9zu\n", name, function,
           (double)t->n_steps / (double)t->n_lines, 1e9 * t->seconds / (double)t->n_steps,
           1e6 * t->seconds / (double)t->n_lines, 100 * (double)t->n_crossings / (double)t->n_steps,
           t->n_lines - t->n_ends);
}

static void run(const char *name, mask_shape shape, int32_t dim, size_t cells)
{
    static const struct {
        const char *name;
        int32_t function;
    } FUNCTION[] = {{"distance", ICC_FUNCTION_DISTANCE},
                    {"decay", ICC_FUNCTION_DECAY},
                    {"laplace", ICC_FUNCTION_LAPLACE}};
    mask m = mask_draw(shape, dim, cells);
    uint32_t root;
    icc_grid *grid;
    icc_tree *tree;
    icc_error err = {.size = sizeof err};
    bench_check(icc_grid_create_mask(&grid, dim, m.shape, m.inside, NULL, &err), &err);
    bench_check(icc_grid_maximum(grid, &root, NULL, NULL, &err), &err);
    bench_check(icc_tree_create(&tree, grid, root, NULL, NULL, &err), &err);
    for (int i = 0; i < 3; ++i) {
        icc_field *field;
        const icc_field_options options = {.size = sizeof options,
                                           .function = FUNCTION[i].function,
                                           .constraints = ICC_CONSTRAINTS_NONE};
        bench_check(icc_field_create(&field, tree, &options, NULL, &err), &err);
        const tally t = climb(field);
        print(name, FUNCTION[i].name, &t);
        if (dim == 2) {
            const tally plane = climb_plane(field);
            print("  walk2", FUNCTION[i].name, &plane);
        }
        icc_field_free(field);
    }
    icc_tree_free(tree);
    icc_grid_free(grid);
    mask_free(&m);
}

int main(void)
{
    printf("%-12s %-9s %7s %7s %8s %7s %9s\n", "ascents", "function", "steps", "ns/step", "us each",
           "cross %", "astray");
    run("box 64^2", mask_box, 2, 64);
    run("box 64^3", mask_box, 3, 64);
    run("ball 64^3", mask_ball, 3, 64);
    run("box 16^4", mask_box, 4, 16);
    run("box 8^5", mask_box, 5, 8);
    return EXIT_SUCCESS;
}
