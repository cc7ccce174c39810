/* Weights at single points, diffusion, lines and rigid parts: what the thesis printed, what we get,
 * what is asked for. usage: bench_weights */
#include "bench.h"

#include "../random.h"
#include "base/env.h"
#include "kernel/weights/weights.h"

enum { SIDE = 101, POINTS = SIDE * SIDE, CORNERS = 4, MANY = 26, REPEATS = 25 };

static void row(const char *item, const char *thesis, double ours, const char *demand)
{
    printf("%-58s | %-20s | %-12.4g | %s\n", item, thesis, ours, demand);
}

static const char *const METHOD[4] = {"", "QP", "QEC", "l1"};

/* ---- table 4.1 ---- */

/* The grid, its corners first, and the weights (4.10). */
typedef struct grid {
    double points[2 * POINTS], initial[CORNERS * POINTS], weights[CORNERS * POINTS];
    double seconds;
} grid;

static void fill_grid(grid *g)
{
    const double corners[2 * CORNERS] = {0, 0, 10, 0, 10, 10, 0, 10};
    const iccp_nodes nodes = {
        .dim = 2, .n = CORNERS + POINTS, .n_handles = CORNERS, .points = NULL};
    double *points = bench_alloc(nodes.n, 2 * sizeof *points);
    double *initial = bench_alloc(nodes.n, CORNERS * sizeof *initial);
    iccp_nodes all = nodes;
    all.points = points;
    memcpy(points, corners, sizeof corners);
    for (size_t i = 0; i < POINTS; ++i) {
        g->points[2 * i] = points[2 * (CORNERS + i)] = 0.1 * (double)(i % SIDE);
        g->points[2 * i + 1] = points[2 * (CORNERS + i) + 1] = 0.1 * (double)(i / SIDE);
    }
    iccp_initial_inverse(&all, initial);
    memcpy(g->initial, initial + CORNERS * CORNERS, sizeof g->initial);
    free(points);
    free(initial);
}

static void optimise_grid(grid *g, const iccp_handles *handles, int32_t method)
{
    double *work = bench_alloc(iccp_optimise_work(handles), sizeof *work);
    g->seconds = HUGE_VAL;
    for (int k = 0; k < REPEATS; ++k) {
        memcpy(g->weights, g->initial, sizeof g->initial);
        const double start = bench_seconds();
        for (size_t i = 0; i < POINTS; ++i)
            (void)iccp_optimise(handles, method, g->points + 2 * i, g->weights + CORNERS * i, work);
        g->seconds = fmin(g->seconds, bench_seconds() - start);
    }
    free(work);
}

/* Of the first corner's weight along the diagonal from it: the greatest rise. */
static double rise_on_diagonal(const grid *g)
{
    double rise = 0;
    for (size_t k = 1; k < SIDE; ++k)
        rise = fmax(rise, g->weights[CORNERS * (k * SIDE + k)] -
                              g->weights[CORNERS * ((k - 1) * SIDE + k - 1)]);
    return rise;
}

static void table_4_1(const iccp_env *env)
{
    static grid g;
    static const char *const seconds[4] = {"", "17.1", "0.109", "7.61"};
    static const char *const least[4] = {"", ">= 0", "negative", "almost >= 0"};
    static const char *const rises[4] = {"", "effectively none", "not monotone",
                                         "effectively none"};
    const double corners[2 * CORNERS] = {0, 0, 10, 0, 10, 10, 0, 10};
    iccp_handles *handles;
    bench_check(iccp_handles_create(&handles, 2, CORNERS, corners, env, NULL), NULL);
    fill_grid(&g);
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        char item[80];
        double least_weight = 0;
        optimise_grid(&g, handles, method);
        for (size_t k = 0; k < CORNERS * POINTS; ++k)
            least_weight = fmin(least_weight, g.weights[k]);
        snprintf(item, sizeof item, "table 4.1, %s: s", METHOD[method]);
        row(item, seconds[method], g.seconds, "-");
        snprintf(item, sizeof item, "  us a sample, 4 handles");
        row(item, "-", 1e6 * g.seconds / POINTS, method == ICC_WEIGHTS_QP ? "<= 0.1" : "-");
        row("  least weight", least[method], least_weight, method == ICC_WEIGHTS_QP ? ">= 0" : "-");
        row("  greatest rise on the diagonal", rises[method], rise_on_diagonal(&g),
            method == ICC_WEIGHTS_QP ? "<= 2e-3" : "-");
    }
    iccp_handles_free(handles);
}

/* ---- many handles ---- */

/* Weights that fall with the distance, on a flower with 26 handles. */
static void many_handles(const iccp_env *env)
{
    double handles_at[2 * MANY], initial[MANY], weights[MANY];
    enum { N = 4000 };
    static double points[2 * N];
    random_source r = {1};
    iccp_handles *handles;
    for (size_t j = 0; j < MANY; ++j)
        bench_polar(handles_at + 2 * j, 1 + 0.25 * cos(0.9666 * (double)j),
                    360.0 * (double)j / MANY);
    for (size_t i = 0; i < N; ++i)
        bench_polar(points + 2 * i, 0.7 * sqrt(random_unit(&r)), 360 * random_unit(&r));
    bench_check(iccp_handles_create(&handles, 2, MANY, handles_at, env, NULL), NULL);
    double *work = bench_alloc(iccp_optimise_work(handles), sizeof *work);
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        char item[80];
        double best = HUGE_VAL;
        for (int k = 0; k < REPEATS; ++k) {
            const double start = bench_seconds();
            for (size_t i = 0; i < N; ++i) {
                for (size_t j = 0; j < MANY; ++j) {
                    const double x = points[2 * i] - handles_at[2 * j];
                    const double y = points[2 * i + 1] - handles_at[2 * j + 1];
                    initial[j] = 1 / (1 + 25 * (x * x + y * y));
                }
                memcpy(weights, initial, sizeof weights);
                (void)iccp_optimise(handles, method, points + 2 * i, weights, work);
            }
            best = fmin(best, bench_seconds() - start);
        }
        snprintf(item, sizeof item, "%s, 26 handles: us a sample", METHOD[method]);
        row(item, method == ICC_WEIGHTS_QP ? "1700 (4 handles)" : "-", 1e6 * best / N,
            method == ICC_WEIGHTS_QP ? "<= 0.4" : "-");
    }
    free(work);
    iccp_handles_free(handles);
}

/* ---- failures ---- */

static void failures(const iccp_env *env)
{
    enum { RANDOM = 200000, EDGES = 5005 };
    random_source r = {14};
    double at[2 * MANY], w[MANY];
    size_t failed = 0;
    double error = 0;
    for (size_t n = 0; n < RANDOM + EDGES;) {
        iccp_handles *handles;
        const bool edges = n >= RANDOM;
        for (size_t j = 0; j < MANY; ++j)
            if (edges)
                bench_polar(at + 2 * j, 1, 360.0 * (double)j / MANY);
            else
                at[2 * j] = random_between(&r, -1, 1), at[2 * j + 1] = random_between(&r, -1, 1);
        bench_check(iccp_handles_create(&handles, 2, MANY, at, env, NULL), NULL);
        double *work = bench_alloc(iccp_optimise_work(handles), sizeof *work);
        for (size_t k = 0; k < (edges ? (size_t)EDGES : 1000); ++k, ++n) {
            const size_t a = k % MANY, b = edges ? (k + 1) % MANY : (k * 7 + 3) % MANY;
            const double t = random_unit(&r), s = edges ? 0 : 0.3 * random_unit(&r);
            double x[2], found[3] = {0};
            for (size_t c = 0; c < 2; ++c)
                x[c] = (1 - s) * ((1 - t) * at[2 * a + c] + t * at[2 * b + c]) +
                       s * at[2 * ((k * 5) % MANY) + c];
            for (size_t j = 0; j < MANY; ++j)
                w[j] = pow(random_unit(&r), 4);
            failed += iccp_optimise(handles, ICC_WEIGHTS_QP, x, w, work) != ICC_OK;
            for (size_t j = 0; j < MANY; ++j) {
                found[0] += w[j] * at[2 * j];
                found[1] += w[j] * at[2 * j + 1];
                found[2] += w[j];
            }
            error = fmax(error, fmax(fabs(found[2] - 1), hypot(found[0] - x[0], found[1] - x[1])));
        }
        free(work);
        iccp_handles_free(handles);
    }
    row("QP: failures in 205,005 problems, 5,005 on hull edges", "-", (double)failed, "0");
    row("  greatest error of sums and reproduction", "-", error, "<= 1e-12");
}

int main(void)
{
    iccp_env env;
    bench_check(iccp_env_read(&env, NULL, NULL), NULL);
    printf("%-58s | %-20s | %-12s | %s\n", "item", "thesis", "ours", "demand");
    table_4_1(&env);
    many_handles(&env);
    failures(&env);
    return EXIT_SUCCESS;
}
