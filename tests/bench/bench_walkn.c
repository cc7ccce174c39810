/* What it costs to walk along integral lines in 2 to 6 dimensions. Run by hand on a quiet
 * machine. */
#include "gradient/trace/walk2.h"
#include "gradient/trace/walkn.h"

#include "../hard_masks.h"
#include "../random.h"
#include "../surfaces.h"
#include "bench.h"

enum { N_WALKS = 4000 };

typedef struct tally {
    size_t n_steps, n_crossings, n_lines, n_ends;
    double seconds;
} tally;

static const struct {
    const char *name;
    int32_t function;
} FUNCTION[] = {{"distance", ICC_FUNCTION_DISTANCE},
                {"decay", ICC_FUNCTION_DECAY},
                {"laplace", ICC_FUNCTION_LAPLACE}};

/* A point of the grid in a cell whose nearest corner is inside. */
static void pick(const icc_grid *grid, random_source *r, double *p)
{
    size_t nearest;
    do {
        nearest = 0;
        for (int32_t k = 0; k < grid->dim; ++k) {
            p[k] = random_between(r, 2, (double)grid->shape[k] - 3);
            nearest += (size_t)(p[k] + 0.5) * grid->stride[k];
        }
    } while (!grid->inside[nearest]);
}

static tally climb(const icc_function *field)
{
    tally t = {0};
    random_source r = {1};
    double p[ICC_MAX_DIM];
    const double begin = bench_processor_seconds();
    for (; t.n_lines < N_WALKS; ++t.n_lines) {
        iccp_walkn walk;
        pick(field->tree->grid, &r, p);
        icc_status status = iccp_walkn_start(&walk, field, ICCP_UPHILL, p, NULL, NULL);
        const size_t budget = walk.steps_left;
        status = iccp_walkn_uphill(&walk, NULL);
        t.n_steps += budget - walk.steps_left;
        t.n_ends += status == ICC_OK;
    }
    t.seconds = bench_processor_seconds() - begin;
    /* Again, to see what the steps are. */
    r = (random_source){1};
    for (size_t i = 0; i < t.n_lines; ++i) {
        iccp_walkn walk;
        pick(field->tree->grid, &r, p);
        if (iccp_walkn_start(&walk, field, ICCP_UPHILL, p, NULL, NULL) != ICC_OK)
            continue;
        while (!iccp_walkn_at_root(&walk) && iccp_walkn_step(&walk) == ICC_OK)
            t.n_crossings += walk.ahead;
    }
    return t;
}

static tally climb_plane(const icc_function *field)
{
    tally t = {0};
    random_source r = {1};
    double p[ICC_MAX_DIM];
    const double begin = bench_processor_seconds();
    for (; t.n_lines < N_WALKS; ++t.n_lines) {
        iccp_walk2 walk;
        pick(field->tree->grid, &r, p);
        icc_status status = iccp_walk2_start(&walk, field, ICCP_UPHILL, p[0], p[1], NULL);
        const size_t budget = walk.steps_left;
        status = iccp_trace_uphill(&walk, NULL);
        t.n_steps += budget - walk.steps_left;
        t.n_ends += status == ICC_OK;
    }
    t.seconds = bench_processor_seconds() - begin;
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
    mask m = mask_draw(shape, dim, cells);
    uint32_t root;
    icc_grid *grid;
    icc_tree *tree;
    icc_error err = {.size = sizeof err};
    bench_check(icc_grid_create_mask(&grid, dim, m.shape, m.inside, NULL, &err), &err);
    bench_check(icc_grid_find_maximum(grid, &root, NULL, NULL, &err), &err);
    bench_check(icc_tree_create(&tree, grid, root, NULL, NULL, &err), &err);
    for (int i = 0; i < 3; ++i) {
        icc_function *field;
        const icc_function_options options = {.size = sizeof options,
                                              .function = FUNCTION[i].function,
                                              .constraints = ICC_CONSTRAINTS_NONE};
        bench_check(icc_function_create(&field, tree, &options, NULL, &err), &err);
        const tally t = climb(field);
        print(name, FUNCTION[i].name, &t);
        if (dim == 2) {
            const tally plane = climb_plane(field);
            print("  walk2", FUNCTION[i].name, &plane);
        }
        icc_function_free(field);
    }
    icc_tree_free(tree);
    icc_grid_free(grid);
    mask_free(&m);
}

/* Coordinates of points in a ball, from the boundary up and from the points both ways. */
static void run_chart(int32_t cells)
{
    static surface ball;
    static double points[3 * N_WALKS], bary[3 * N_WALKS], t[N_WALKS];
    static uint32_t facet[N_WALKS];
    random_source r = {1};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    surface_star(&ball, 4, 0, &r);
    bench_check(icc_domain_create(&domain, 3, ball.n_vertices, ball.vertices, ball.n_faces,
                                  ball.faces, NULL, &err),
                &err);
    for (int i = 0; i < 3; ++i) {
        icc_chart *chart;
        icc_gradient_info info = {.size = sizeof info};
        const icc_chart_options options = {.size = sizeof options,
                                           .method = ICC_METHOD_GRADIENT,
                                           .function = FUNCTION[i].function,
                                           .constraints = ICC_CONSTRAINTS_NONE,
                                           .cells = cells};
        const double begin = bench_processor_seconds();
        bench_check(icc_chart_create(&chart, domain, &options, NULL, &err), &err);
        const double made = bench_processor_seconds();
        for (int k = 0; k < 3 * N_WALKS; ++k)
            points[k] = random_between(&r, -0.57, 0.57);
        size_t down, up;
        const double ready = bench_processor_seconds();
        bench_check(icc_chart_encode(chart, N_WALKS, points, facet, bary, t, NULL, &down, NULL),
                    &err);
        const double there = bench_processor_seconds();
        bench_check(icc_chart_decode(chart, N_WALKS, facet, bary, t, points, NULL, &up, NULL),
                    &err);
        const double back = bench_processor_seconds();
        (void)icc_chart_get_gradient_info(chart, &info);
        icc_chart_timings took = {.size = sizeof took};
        (void)icc_chart_get_timings(chart, &took);
        printf("ball, %3ld cells %-9s %8zu inside %7.2f s, of these %5.2f for f %7.1f us there "
               "%7.1f us "
               "back %5zu %5zu astray\n",
               (long)cells, FUNCTION[i].name, info.n_inside, made - begin, took.function,
               1e6 * (there - ready) / N_WALKS, 1e6 * (back - there) / N_WALKS, down, up);
        icc_chart_free(chart);
    }
    icc_domain_free(domain);
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
    run("box 5^6", mask_box, 6, 5);
    run_chart(32);
    run_chart(64);
    return EXIT_SUCCESS;
}
