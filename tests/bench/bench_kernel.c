/* Kernel coordinates beside what Sakaridis' thesis (2016) reports: table and section numbers are those of the thesis,
 * whose times are MATLAB's on a Core i5 at 3.2 GHz. What is exact or known in advance is a test (tests/unit). */
#include "bench.h"
#include "kernel/kernel.h"

#include <icc/kernel.h>

static const char *const METHODS[] = {"", "QP", "QEC", "l1"};
static const double PI = 3.14159265358979323846;

static void row(const char *what, const char *thesis, const char *demand, const char *format,
                double ours)
{
    char text[40];
    snprintf(text, sizeof text, format, ours);
    printf("%-58s %-16s | %-14s | %s\n", what, thesis, text, demand);
}

/* ---- shapes ---- */

typedef struct scene {
    icc_domain *domains[2];
    icc_shape *shape;
    icc_sampling *sampling;
    icc_sampling_info info;
    size_t n_points; /* in the first region */
    double *points;
} scene;

static void polygon_points(scene *s, size_t side)
{
    icc_domain_info info = {.size = sizeof info};
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL}, *vertices;
    (void)icc_domain_get_info(s->domains[0], &info);
    vertices = bench_alloc(2 * info.n_vertices, sizeof *vertices);
    (void)icc_domain_get_boundary(s->domains[0], vertices, NULL);
    for (size_t i = 0; i < 2 * info.n_vertices; ++i) {
        lower[i % 2] = fmin(lower[i % 2], vertices[i]);
        upper[i % 2] = fmax(upper[i % 2], vertices[i]);
    }
    s->points = bench_alloc(2 * side * side, sizeof *s->points);
    for (size_t i = 0; i < side * side; ++i) {
        const double p[2] = {
            lower[0] + ((double)(i % side) + 0.5) / (double)side * (upper[0] - lower[0]),
            lower[1] + ((double)(i / side) + 0.5) / (double)side * (upper[1] - lower[1])};
        icc_status where;
        (void)icc_domain_locate(s->domains[0], 1, p, &where, NULL, NULL, NULL);
        if (where == ICC_INSIDE)
            memcpy(s->points + 2 * s->n_points++, p, sizeof p);
    }
    free(vertices);
}

/* A polygon, in a square of that half side if it is positive, and curves. */
static scene make_scene(size_t n, const double *polygon, double around, size_t n_vertices,
                        const double *vertices, size_t n_segments, const uint32_t *segments,
                        const icc_sampling_options *options)
{
    scene s = {0};
    icc_error err = {.size = sizeof err};
    const double square[8] = {-around, -around, around, -around, around, around, -around, around};
    s.domains[0] = bench_domain(n, polygon);
    if (around > 0)
        s.domains[1] = bench_domain(4, square);
    bench_check(icc_shape_create(&s.shape, 2, around > 0 ? 2 : 1,
                                 (const icc_domain *const *)s.domains, n_vertices, vertices,
                                 n_segments, segments, NULL, &err),
                &err);
    bench_check(icc_sampling_create(&s.sampling, s.shape, options, NULL, &err), &err);
    s.info.size = sizeof s.info;
    bench_check(icc_sampling_get_info(s.sampling, &s.info), &err);
    polygon_points(&s, 120);
    return s;
}

static void free_scene(scene *s)
{
    icc_sampling_free(s->sampling);
    icc_shape_free(s->shape);
    icc_domain_free(s->domains[0]);
    icc_domain_free(s->domains[1]);
    free(s->points);
}

static void draw_star(double *xy)
{
    for (size_t i = 0; i < 10; ++i)
        bench_polar(xy + 2 * i, i % 2 == 0 ? 1 : 0.4, 90 + 36 * (double)i);
}

/* Four wings and 26 corners. */
static void draw_butterfly(double *xy)
{
    static const double RADII[26] = {0.22, 0.5,  0.85, 1.05, 1,    0.72, 0.3,  0.72, 1,
                                     1.05, 0.85, 0.5,  0.22, 0.3,  0.55, 0.7,  0.85, 0.8,
                                     0.5,  0.25, 0.5,  0.8,  0.85, 0.7,  0.55, 0.3};
    for (size_t i = 0; i < 26; ++i)
        bench_polar(xy + 2 * i, RADII[i], 360.0 * (double)i / 26);
}

static uint32_t *ring(uint32_t n)
{
    uint32_t *edges = bench_alloc(2 * n, sizeof *edges);
    for (uint32_t i = 0; i < n; ++i) {
        edges[2 * i] = i;
        edges[2 * i + 1] = (i + 1) % n;
    }
    return edges;
}

static icc_kernel *make(const icc_sampling *sampling, size_t m, const double *handles,
                        const icc_kernel_options *options)
{
    icc_kernel *kernel;
    icc_error err = {.size = sizeof err};
    bench_check(icc_kernel_create(&kernel, sampling, m, handles, options, NULL, &err), &err);
    return kernel;
}

/* ---- section 3.3.2: blue noise ---- */

/* The greatest absolute eigenvalue of K, or of its inverse, by power iteration. */
static double spectral_radius(const iccp_collocation *c, size_t n, bool inverse)
{
    iccp_env env;
    double *x = bench_alloc(n + 3, sizeof *x), *y = bench_alloc(n + 3, sizeof *y), norm = 0;
    (void)iccp_env_read(&env, NULL, NULL);
    for (size_t i = 0; i < n; ++i)
        x[i] = sin((double)(i * i));
    for (int k = 0; k < 300; ++k) {
        double sum = 0;
        if (inverse)
            (void)iccp_collocation_solve(c, 1, x, y, &env);
        else
            iccp_collocation_multiply(c, 1, x, y);
        for (size_t i = 0; i < n; ++i)
            sum += y[i] * y[i];
        norm = sqrt(sum);
        for (size_t i = 0; i < n; ++i)
            x[i] = y[i] / norm;
    }
    free(x);
    free(y);
    return norm;
}

/* The sum over all nodes of |a_i(x_j) - delta_ij|, the dual functions evaluated at the nodes. */
static double lagrange_sum(const iccp_collocation *c, size_t n)
{
    iccp_env env;
    double *values = bench_alloc(n * n, sizeof *values), *a = bench_alloc((n + 3) * n, sizeof *a),
           sum = 0;
    const iccp_symmetric *k = iccp_collocation_matrix(c);
    (void)iccp_env_read(&env, NULL, NULL);
    for (size_t i = 0; i < n; ++i) {
        values[n * i + i] = k->diagonal[i];
        for (size_t p = k->first[i]; p < k->first[i + 1]; ++p)
            values[n * i + k->column[p]] = k->value[p];
    }
    (void)iccp_collocation_solve(c, n, values, a, &env);
    for (size_t i = 0; i < n * n; ++i)
        sum += fabs(a[i] - (i / n == i % n));
    free(values);
    free(a);
    return sum;
}

static void measure_blue(const iccp_collocation *c, size_t n, const double *points)
{
    iccp_env env;
    double *values = bench_alloc(3 * n, sizeof *values), *a = bench_alloc(3 * (n + 3), sizeof *a);
    double unity = 0, reproduction = 0, mean = 0;
    (void)iccp_env_read(&env, NULL, NULL);
    for (size_t i = 0; i < n; ++i) {
        values[3 * i] = 1;
        memcpy(values + 3 * i + 1, points + 2 * i, 2 * sizeof *values);
    }
    (void)iccp_collocation_solve(c, 3, values, a, &env);
    for (size_t i = 0; i < 160 * 160; ++i) {
        const double x[2] = {-15 + 30.0 * (double)(i % 160) / 159,
                             -15 + 30.0 * (double)(i / 160) / 159};
        double at[3];
        iccp_collocation_evaluate(c, 3, a, x, at, NULL);
        const double off = fmax(fabs(at[1] - x[0]), fabs(at[2] - x[1]));
        unity = fmax(unity, fabs(at[0] - 1));
        reproduction = fmax(reproduction, off);
        mean += off / (160 * 160);
    }
    row("blue noise, sigma 2.5: condition", "2.3e5", "<= 5e5", "%.2g",
        spectral_radius(c, n, false) * spectral_radius(c, n, true));
    row("  partition of unity", "3.4e-4", "<= 4e-4", "%.2g", unity);
    row("  reproduction, greatest", "1.1e-2", "<= 1.2e-2", "%.2g", reproduction);
    row("  reproduction, mean", ".15e-2", "", "%.2g", mean);
    row("  Lagrange, summed", "5.7e-9", "<= 1e-8", "%.2g", lagrange_sum(c, n));
    free(values);
    free(a);
}

static void bench_blue(void)
{
    static const double SQUARE[8] = {-30, -30, 30, -30, 30, 30, -30, 30};
    const icc_sampling_options options = {.size = sizeof options, .spacing = 2.08};
    scene s = make_scene(4, SQUARE, 0, 0, NULL, 0, NULL, &options);
    const size_t n = s.info.n_samples;
    double *points = bench_alloc(2 * n, sizeof *points);
    iccp_collocation *c;
    iccp_env env;
    (void)iccp_env_read(&env, NULL, NULL);
    (void)icc_sampling_get_points(s.sampling, points);
    row("blue noise in [-30, 30]^2: points", "1024", "", "%.0f", (double)n);
    const iccp_radial radial = iccp_radial_make(ICC_KERNEL_GAUSS, 2.5, 8);
    icc_error err = {.size = sizeof err};
    bench_check(iccp_collocation_create(&c, 2, n, points, &radial, false, &env, &err), &err);
    measure_blue(c, n, points);
    iccp_collocation_release(c);
    free(points);
    free_scene(&s);
}

/* ---- table 4.1 ---- */

/* Seconds to optimise the weights of 101 * 101 points once, from inverse squared distances. */
static double optimise_grid(size_t m, const double *handles, int32_t method)
{
    iccp_env env;
    iccp_handles *h;
    (void)iccp_env_read(&env, NULL, NULL);
    bench_check(iccp_handles_create(&h, 2, m, handles, &env, NULL), &(icc_error){0});
    double *work = bench_alloc(iccp_optimise_work(h), sizeof *work), best = HUGE_VAL;
    double *start = bench_alloc(10201 * m, sizeof *start), weights[26];
    for (size_t i = 0; i < 10201 * m; ++i) {
        const double *c = handles + 2 * (i % m);
        const double x = (double)(i / m % 101) * 0.1, y = (double)(i / m / 101) * 0.1;
        start[i] = 1 / (1 + (x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]));
    }
    for (int repeat = 0; repeat < 7; ++repeat) {
        const double begin = bench_seconds();
        for (size_t i = 0; i < 10201; ++i) {
            const double place[2] = {(double)(i % 101) * 0.1, (double)(i / 101) * 0.1};
            memcpy(weights, start + m * i, m * sizeof *weights);
            (void)iccp_optimise(h, method, place, weights, work);
        }
        best = fmin(best, bench_seconds() - begin);
    }
    iccp_handles_free(h);
    free(work);
    free(start);
    return best;
}

static void bench_table41(void)
{
    static const double CORNERS[8] = {0, 0, 10, 0, 10, 10, 0, 10};
    static const char *const THESIS[] = {"", "17.1 s", ".109 s", "7.61 s"};
    double many[52];
    for (size_t j = 0; j < 26; ++j) {
        many[2 * j] = 5 + 7.1 * cos(2 * PI * (double)j / 26);
        many[2 * j + 1] = 5 + 7.1 * sin(2 * PI * (double)j / 26);
    }
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        char what[64];
        const double four = optimise_grid(4, CORNERS, method),
                     lot = optimise_grid(26, many, method);
        snprintf(what, sizeof what, "table 4.1, 101 x 101, 4 handles, %s: ms", METHODS[method]);
        row(what, THESIS[method], "", "%.2f", 1e3 * four);
        row("  us a sample", "", method == ICC_WEIGHTS_QP ? "<= 0.2" : "", "%.3f",
            1e6 * four / 10201);
        row("  us a sample, 26 handles", "", method == ICC_WEIGHTS_QP ? "<= 2" : "", "%.3f",
            1e6 * lot / 10201);
    }
}

/* ---- tables 6.1 to 6.6 ---- */

/* `claims`: the thesis' table, three letters a property (reproduction, unity, Lagrange, linearity, non-negativity). */
static void bench_table(const char *name, const char *claims, scene *s, size_t m,
                        const double *handles, const icc_kernel_options *options)
{
    printf("\n%s: %zu samples, %zu of them on edges, sigma %g%s\n", name, s->info.n_samples,
           s->info.n_edge, options->sigma > 0 ? options->sigma : s->info.sigma,
           options->tail < 0 ? ", the thesis' options" : "");
    printf("  %-4s %-10s %-10s %-10s %-10s %-10s %-10s %s\n", "", "reproduct.", "unity", "Lagrange",
           "linear", "least", "infeasible", "thesis: r u L l n");
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        icc_kernel_options full = *options;
        icc_kernel_report r = {.size = sizeof r};
        icc_kernel *kernel;
        icc_error err = {.size = sizeof err};
        full.method = method;
        if (icc_kernel_create(&kernel, s->sampling, m, handles, &full, NULL, &err) != ICC_OK) {
            printf("  %-4s %s\n", METHODS[method], err.message);
            continue;
        }
        bench_check(icc_kernel_get_report(kernel, s->n_points, s->points, &r, NULL, &err), &err);
        printf("  %-4s %-10.2g %-10.2g %-10.2g %-10.2g %-10.2g %-10zu         ", METHODS[method],
               r.reproduction, r.unity, r.lagrange, r.linearity, r.least_weight, r.n_infeasible);
        for (int k = 0; k < 5; ++k)
            printf("%c ", claims[3 * k + method - 1]);
        printf("\n");
        icc_kernel_free(kernel);
    }
}

static icc_kernel_options thesis_options(double sigma)
{
    return (icc_kernel_options){.size = sizeof(icc_kernel_options),
                                .kernel = ICC_KERNEL_GAUSS,
                                .tail = -1,
                                .visible = -1,
                                .sigma = sigma};
}

static void bench_star_tables(void)
{
    double star[20];
    uint32_t *edges = ring(10);
    const icc_sampling_options grid = {
        .size = sizeof grid, .kind = ICC_SAMPLING_GRID, .spacing = 0.04, .margin = 5};
    const icc_sampling_options coarse = {.size = sizeof coarse, .spacing = 0.09};
    const icc_sampling_options fine = {.size = sizeof fine, .spacing = 0.0268};
    draw_star(star);
    scene scenes[4] = {make_scene(10, star, 0, 0, NULL, 0, NULL, &grid),
                       make_scene(10, star, 0, 0, NULL, 0, NULL, &coarse),
                       make_scene(10, star, 1.43, 0, NULL, 0, NULL, &coarse),
                       make_scene(10, star, 1.22, 0, NULL, 0, NULL, &fine)};
    static const char *const NAMES[] = {"table 6.1, grid", "table 6.2, blue noise inside",
                                        "table 6.3, blue noise inside and around",
                                        "table 6.4, denser"};
    static const char *const CLAIMS[] = {"YYYYYYNNNNNNNNY", "YYYYYYNYNNYNNNY", "YYYYYYYYYNNNNNN",
                                         "YYYYYYYYYNNNNNN"};
    for (int k = 0; k < 4; ++k) {
        icc_kernel_options thesis = thesis_options(k == 3 ? 0.02 : k == 0 ? 0 : 0.09);
        icc_kernel_options ours = {.size = sizeof ours};
        thesis.initial = ours.initial = k < 2 ? ICC_INITIAL_HEAT : ICC_INITIAL_EDGES;
        thesis.n_edges = ours.n_edges = 10;
        thesis.edges = ours.edges = edges;
        bench_table(NAMES[k], CLAIMS[k], &scenes[k], 10, star, &thesis);
        bench_table(NAMES[k], CLAIMS[k], &scenes[k], 10, star, &ours);
        free_scene(&scenes[k]);
    }
    free(edges);
}

/* Head of radius 0.3 with 8 handles; neck, torso, arms and legs. */
static void bench_stick_figure(void)
{
    static const uint32_t STICKS[12] = {6, 8, 8, 9, 8, 10, 8, 11, 9, 12, 9, 13};
    static const double BODY[12] = {0, 0.3, 0, -0.4, -0.6, 0.1, 0.6, 0.1, -0.4, -1, 0.4, -1};
    double handles[28], head[64];
    const icc_sampling_options options = {.size = sizeof options, .spacing = 0.034};
    for (size_t i = 0; i < 32; ++i) {
        head[2 * i] = 0.3 * cos(2 * PI * (double)i / 32);
        head[2 * i + 1] = 0.8 + 0.3 * sin(2 * PI * (double)i / 32);
    }
    for (size_t i = 0; i < 8; ++i)
        memcpy(handles + 2 * i, head + 8 * i, 2 * sizeof *head);
    memcpy(handles + 16, BODY, sizeof BODY);
    scene s = make_scene(32, head, 1.3, 14, handles, 6, STICKS, &options);
    icc_kernel_options thesis = thesis_options(0.06), ours = {.size = sizeof ours};
    thesis.n_edges = ours.n_edges = 6;
    thesis.edges = ours.edges = STICKS;
    bench_table("table 6.6, stick figure", "YYYYYYYYYNNNNNN", &s, 14, handles, &thesis);
    thesis.sigma = 0.034;
    bench_table("table 6.6, stick figure", "YYYYYYYYYNNNNNN", &s, 14, handles, &thesis);
    bench_table("table 6.6, stick figure", "YYYYYYYYYNNNNNN", &s, 14, handles, &ours);
    free_scene(&s);
}

/* ---- times ---- */

/* Milliseconds to paint about 1,000 nodes. */
static double paint_time(const icc_kernel *kernel, double radius, size_t *n_painted)
{
    icc_kernel_info info = {.size = sizeof info};
    const double centre[2] = {0.5, 0.55};
    double best = HUGE_VAL, *points;
    (void)icc_kernel_get_info(kernel, &info);
    points = bench_alloc(2 * info.n_nodes, sizeof *points);
    (void)icc_kernel_get_nodes(kernel, points, NULL, NULL, NULL);
    *n_painted = 0;
    for (size_t i = 0; i < info.n_nodes; ++i)
        *n_painted += hypot(points[2 * i] - centre[0], points[2 * i + 1] - centre[1]) < radius;
    for (int k = 0; k < 15; ++k) {
        icc_kernel *painted;
        icc_error err = {.size = sizeof err};
        const double begin = bench_seconds();
        bench_check(icc_kernel_paint(&painted, kernel, 0, centre, radius, 0.2, NULL, &err), &err);
        best = fmin(best, bench_seconds() - begin);
        icc_kernel_free(painted);
    }
    free(points);
    return 1e3 * best;
}

static double evaluation_time(const icc_kernel *kernel, size_t m, bool gradients)
{
    enum { SIDE = 300 };
    double *points = bench_alloc(2 * SIDE * SIDE, sizeof *points), best = HUGE_VAL;
    double *weights = bench_alloc(SIDE * SIDE * m, sizeof *weights);
    double *slopes = gradients ? bench_alloc(SIDE * SIDE * m, 2 * sizeof *slopes) : NULL;
    for (size_t i = 0; i < SIDE * SIDE; ++i) {
        points[2 * i] = -1 + 2 * (double)(i % SIDE) / SIDE;
        points[2 * i + 1] = -1 + 2 * (double)(i / SIDE) / SIDE;
    }
    for (int k = 0; k < 7; ++k) {
        const double begin = bench_seconds();
        (void)icc_kernel_weights(kernel, SIDE * SIDE, points, weights, slopes, NULL, NULL, NULL);
        best = fmin(best, bench_seconds() - begin);
    }
    free(points);
    free(weights);
    free(slopes);
    return 1e6 * best / (SIDE * SIDE);
}

static void bench_interaction(void)
{
    double star[20], many[52];
    const icc_sampling_options options = {.size = sizeof options, .spacing = 0.0268};
    draw_star(star);
    for (size_t j = 0; j < 26; ++j)
        bench_polar(many + 2 * j, 0.25 + 0.03 * (double)(j % 4), 360.0 * (double)j / 26);
    const double begin = bench_seconds();
    scene s = make_scene(10, star, 1.22, 0, NULL, 0, NULL, &options);
    row("star and surroundings: seconds to sample", "-", "<= 1", "%.2f", bench_seconds() - begin);
    row("  samples", "9600", "", "%.0f", (double)s.info.n_samples);
    row("  nearest neighbour, in spacings", "-", ">= .55", "%.3f", s.info.nearest);
    for (int k = 0; k < 4; ++k) {
        const size_t m = k % 2 ? 26 : 10;
        icc_kernel_options o = {.size = sizeof o,
                                .kernel = k < 2 ? ICC_KERNEL_WENDLAND : ICC_KERNEL_GAUSS};
        icc_kernel *kernel = make(s.sampling, m, k % 2 ? many : star, &o);
        icc_kernel_info info = {.size = sizeof info};
        size_t n_painted;
        (void)icc_kernel_get_info(kernel, &info);
        printf("%zu handles, %s, %.1f entries a row; initial %.1f, weights %.1f, nodes and factor "
               "%.1f ms\n",
               m, k < 2 ? "Wendland" : "Gauss",
               2 * (double)info.n_entries / (double)info.n_nodes - 1, 1e3 * info.seconds_initial,
               1e3 * info.seconds_weights, 1e3 * info.seconds_factor);
        const double milliseconds = paint_time(kernel, 0.48, &n_painted);
        row("  painted nodes", "-", "1000", "%.0f", (double)n_painted);
        row("  ms to paint them and solve", "-", k < 2 ? "<= 30" : "", "%.1f", milliseconds);
        row("  us to evaluate a point", "-",
            k == 0   ? "1.3"
            : k == 2 ? "2.5"
                     : "",
            "%.2f", evaluation_time(kernel, m, false));
        row("  with gradients", "-", "", "%.2f", evaluation_time(kernel, m, true));
        icc_kernel_free(kernel);
    }
    free_scene(&s);
}

/* Everything from the polygon to the weights of 65,536 pixels. */
static void bench_butterfly(void)
{
    double cage[52], *pixels = bench_alloc(2 * 65536, sizeof *pixels);
    uint32_t *edges = ring(26);
    const icc_sampling_options sampling = {.size = sizeof sampling, .spacing = 0.018};
    draw_butterfly(cage);
    for (size_t i = 0; i < 65536; ++i) {
        pixels[2 * i] = -1 + (double)(i % 256) / 128;
        pixels[2 * i + 1] = -1 + (double)(i / 256) / 128;
    }
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; method += 2) {
        icc_kernel_options o = {.size = sizeof o, .method = method, .n_edges = 26, .edges = edges};
        icc_kernel_info info = {.size = sizeof info};
        icc_binding *binding;
        char what[80];
        const double begin = bench_seconds();
        scene s = make_scene(26, cage, 0, 0, NULL, 0, NULL, &sampling);
        const double sampled = bench_seconds();
        icc_kernel *kernel = make(s.sampling, 26, cage, &o);
        const double made = bench_seconds();
        bench_check(icc_binding_create(&binding, kernel, 65536, pixels, 0, NULL, NULL),
                    &(icc_error){0});
        const double end = bench_seconds();
        (void)icc_kernel_get_info(kernel, &info);
        snprintf(what, sizeof what, "butterfly, 26 handles, %zu nodes, %s: seconds", info.n_nodes,
                 METHODS[method]);
        row(what, method == ICC_WEIGHTS_L1 ? "11.3, BBW 29.9" : "-", "<= 1", "%.2f", end - begin);
        printf("  shape and samples %.2f, kernel %.2f (initial %.3f, weights %.3f, nodes and "
               "factor %.3f), "
               "65536 pixels %.2f\n",
               sampled - begin, made - sampled, info.seconds_initial, info.seconds_weights,
               info.seconds_factor, end - made);
        icc_binding_free(binding);
        icc_kernel_free(kernel);
        free_scene(&s);
    }
    free(edges);
    free(pixels);
}

/* ---- structure ---- */

static double crookedness(const icc_kernel *kernel, size_t m, const icc_line *line)
{
    enum { PLACES = 1000 };
    double *points = bench_alloc(2 * (PLACES + 1), sizeof *points), worst = 0;
    double *w = bench_alloc(m * (PLACES + 1), sizeof *w);
    for (size_t i = 0; i < 2 * (PLACES + 1); ++i)
        points[i] =
            line->from[i % 2] + (double)(i / 2) / PLACES * (line->to[i % 2] - line->from[i % 2]);
    (void)icc_kernel_weights(kernel, PLACES + 1, points, w, NULL, NULL, NULL, NULL);
    for (size_t i = 0; i < m * (PLACES + 1); ++i) {
        const double share = (double)(i / m) / PLACES;
        worst = fmax(worst, fabs(w[i] - (1 - share) * w[i % m] - share * w[m * PLACES + i % m]));
    }
    free(points);
    free(w);
    return worst;
}

/* The inner part of the bottom right leg, and lines across the middle, on the star of table 6.4. The places of the
 * lines' nodes are fixed when samples are spread, as in section 5.3.3. */
static void bench_structure(void)
{
    static const icc_line LINES[2] = {
        {.from = {-0.268, 0.1}, .to = {0.268, 0.1}},
        {.from = {0.268, -0.15}, .to = {-0.268, -0.15}, .parallel = 1}};
    double star[20], energy[2], fixed[84];
    uint32_t *edges = ring(10);
    for (size_t i = 0; i < 84; ++i) {
        const icc_line *line = &LINES[i / 42];
        fixed[i] =
            line->from[i % 2] + (double)(i % 42 / 2) / 20 * (line->to[i % 2] - line->from[i % 2]);
    }
    const icc_sampling_options sampling = {
        .size = sizeof sampling, .spacing = 0.0268, .n_fixed = 42, .fixed = fixed};
    draw_star(star);
    scene s = make_scene(10, star, 1.22, 0, NULL, 0, NULL, &sampling);
    icc_kernel_options o = {.size = sizeof o, .n_edges = 10, .edges = edges};
    icc_kernel *plain = make(s.sampling, 10, star, &o), *stiff;
    icc_kernel_info info = {.size = sizeof info};
    (void)icc_kernel_get_info(plain, &info);
    double *points = bench_alloc(2 * info.n_nodes, sizeof *points);
    uint32_t *part = bench_alloc(info.n_nodes, sizeof *part);
    size_t n_part = 0;
    (void)icc_kernel_get_nodes(plain, points, NULL, NULL, NULL);
    for (uint32_t i = 0; i < info.n_nodes; ++i) {
        const double x = 0.58779 * points[2 * i] - 0.80902 * points[2 * i + 1];
        const double y = 0.80902 * points[2 * i] + 0.58779 * points[2 * i + 1];
        if (x > 0.3236 && x < 0.66 && fabs(y) < 0.2351 * (1 - x) / (1 - 0.3236))
            part[n_part++] = i;
    }
    icc_error err = {.size = sizeof err};
    const double begin = bench_seconds();
    bench_check(icc_kernel_stiffen(&stiff, plain, n_part, part, NULL, energy, NULL, &err), &err);
    const double seconds = bench_seconds() - begin;
    row("rigid part of the star: nodes", "141", "", "%.0f", (double)n_part);
    row("  energy before over after", "-", ">= 3", "%.2f", energy[0] / energy[1]);
    row("  seconds", "2", "<= 0.2", "%.3f", seconds);
    o.lines = LINES;
    for (int k = 0; k < 3; ++k) {
        static const char *const WHAT[] = {"line of 21 nodes in the star: greatest bend", "  Gauss",
                                           "two parallel lines: greatest bend"};
        o.n_lines = k < 2 ? 1 : 2;
        o.kernel = k == 1 ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND;
        icc_kernel *straight = make(s.sampling, 10, star, &o);
        row(WHAT[k], "close", k < 2 ? "<= 1e-3" : "", "%.3g",
            crookedness(straight, 10, &LINES[k / 2]));
        icc_kernel_free(straight);
    }
    icc_kernel_free(plain);
    icc_kernel_free(stiff);
    free(points);
    free(part);
    free(edges);
    free_scene(&s);
}

int main(void)
{
    printf("%-58s %-16s | %-14s | %s\n", "", "thesis", "ours", "demand");
    bench_blue();
    bench_table41();
    bench_interaction();
    bench_butterfly();
    bench_structure();
    bench_star_tables();
    bench_stick_figure();
    return EXIT_SUCCESS;
}
