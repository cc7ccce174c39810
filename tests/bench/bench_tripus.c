/* The thesis' table 6.1: how long a tripus takes, 54 boundary points and 11 inside, at three
 * resolutions. The thesis shows its shape only as a picture; this one is drawn to the same
 * numbers. */
#include "bench.h"

#include <icc/stages.h>

enum { N_BOUNDARY = 54, N_INSIDE = 11, N = N_BOUNDARY + N_INSIDE, MOST_CELLS = 400, REPEATS = 20 };
enum { N_TRIANGLES = 2 * N - N_BOUNDARY - 2 };

/* Seconds. Gradient holds the function, its edges and the integral lines. */
typedef struct times {
    double maxima, bfs, gradient, other;
} times;

/* The printed total of the first row is smaller than its parts. */
typedef struct row {
    size_t grid_points;
    times published;
    double published_total;
} row;

static const row TABLE[] = {
    {673, {0.00, 0.02, 0.24, 0.09}, 0.14},
    {2306, {0.01, 0.12, 0.74, 0.24}, 1.1},
    {11584, {0.00, 2.53, 3.85, 1.5}, 7.88},
};

/* Three legs, straight or bent; a point at `share` of the way from the centre to the outline. */
static void tripus_point(double bend, double degrees, double share, double xy[2])
{
    const double radius = share * (1 - 0.5 * sin(3 * degrees * 3.14159265358979323846 / 180));
    bench_polar(xy, radius, degrees + bend * radius);
}

static void draw_tripus(double bend, double points[N][2])
{
    for (int i = 0; i < N_BOUNDARY; ++i)
        tripus_point(bend, 360.0 * i / N_BOUNDARY, 1, points[i]);
    for (int i = 0; i < N_INSIDE - 2; ++i)
        tripus_point(bend, 90 + 120 * (i / 3), 0.25 * (1 + i % 3), points[N_BOUNDARY + i]);
    tripus_point(bend, 0, 0, points[N - 2]);
    tripus_point(bend, 30, 0.5, points[N - 1]);
}

/* Adds the seconds since `*since` to `*sum` and starts anew. */
static void lap(double *sum, double *since)
{
    const double now = bench_seconds();
    *sum += now - *since;
    *since = now;
}

/* Algorithm 6 for one shape, stage by stage. */
static void run_stages(const icc_domain *domain, int32_t cells, times *t)
{
    icc_grid *grid;
    icc_tree *tree;
    icc_function *field;
    uint32_t maximum;
    size_t n_edges;
    icc_error error = {.size = sizeof error};
    double since = bench_seconds();
    bench_check(icc_grid_create(&grid, domain, cells, NULL, &error), &error);
    lap(&t->other, &since);
    bench_check(icc_grid_find_maximum(grid, &maximum, NULL, NULL, &error), &error);
    lap(&t->maxima, &since);
    bench_check(icc_tree_create(&tree, grid, maximum, NULL, NULL, &error), &error);
    lap(&t->bfs, &since);
    bench_check(icc_function_create(&field, tree, NULL, NULL, &error), &error);
    bench_check(icc_function_get_edges(field, 0, NULL, NULL, &n_edges, NULL), &error);
    lap(&t->gradient, &since);
    icc_function_free(field);
    icc_tree_free(tree);
    icc_grid_free(grid);
}

/* The whole job once: both shapes' stages, the 11 points through the map, the triangulation. */
static times run_once(double source[N][2], double target[N][2], int32_t cells)
{
    times t = {0};
    icc_error error = {.size = sizeof error};
    double since = bench_seconds();
    icc_domain *from = bench_domain(N_BOUNDARY, source[0]);
    icc_domain *to = bench_domain(N_BOUNDARY, target[0]);
    lap(&t.other, &since);
    run_stages(from, cells, &t);
    run_stages(to, cells, &t);

    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .cells = cells};
    const icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_map *map;
    double images[N_INSIDE][2];
    bench_check(icc_map_create(&map, from, to, &options, NULL, &error), &error);
    since = bench_seconds();
    bench_check(icc_map_apply(map, N_INSIDE, source[N_BOUNDARY], images[0], NULL, NULL, NULL),
                &error);
    lap(&t.gradient, &since);
    uint32_t triangles[N_TRIANGLES][3];
    bench_check(icc_triangulate(N_BOUNDARY, N, source[0], triangles[0], NULL, &error), &error);
    lap(&t.other, &since);
    icc_map_free(map);
    icc_domain_free(from);
    icc_domain_free(to);
    return t;
}

/* The resolution whose tree is nearest in size to the published one. */
static int32_t find_cells(double xy[N][2], size_t wanted, size_t *n_tree)
{
    icc_domain *domain = bench_domain(N_BOUNDARY, xy[0]);
    int32_t best = 0;
    for (int32_t cells = 10; cells <= MOST_CELLS; ++cells) {
        const icc_chart_options options = {
            .size = sizeof options, .method = ICC_METHOD_GRADIENT, .cells = cells};
        icc_chart *chart;
        icc_gradient_info info = {.size = sizeof info};
        icc_error error = {.size = sizeof error};
        bench_check(icc_chart_create(&chart, domain, &options, NULL, &error), &error);
        bench_check(icc_chart_get_gradient_info(chart, &info), &error);
        icc_chart_free(chart);
        const double off = fabs((double)info.n_tree - (double)wanted);
        if (best == 0 || off < fabs((double)*n_tree - (double)wanted)) {
            best = cells;
            *n_tree = info.n_tree;
        }
    }
    icc_domain_free(domain);
    return best;
}

static void print(const char *stage, double published, double here)
{
    printf("  %-9s %9.2f %12.6f\n", stage, published, here);
}

int main(void)
{
    double source[N][2], target[N][2];
    draw_tripus(0, source);
    draw_tripus(25, target);
    printf("seconds     published      here\n");
    for (size_t k = 0; k < sizeof TABLE / sizeof *TABLE; ++k) {
        size_t n_tree = 0;
        const int32_t cells = find_cells(source, TABLE[k].grid_points, &n_tree);
        times best = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
        for (int i = 0; i < REPEATS; ++i) {
            const times t = run_once(source, target, cells);
            best.maxima = fmin(best.maxima, t.maxima);
            best.bfs = fmin(best.bfs, t.bfs);
            best.gradient = fmin(best.gradient, t.gradient);
            best.other = fmin(best.other, t.other);
        }
        const times *published = &TABLE[k].published;
        printf("%zu grid points published, %zu here (%d cells)\n", TABLE[k].grid_points, n_tree,
               cells);
        print("Maxima", published->maxima, best.maxima);
        print("BFS", published->bfs, best.bfs);
        print("Gradient", published->gradient, best.gradient);
        print("Other", published->other, best.other);
        print("Total", TABLE[k].published_total,
              best.maxima + best.bfs + best.gradient + best.other);
    }
    return EXIT_SUCCESS;
}
