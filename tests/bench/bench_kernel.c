/* What takes time while one works on weights: a kernel on samples that there are, as after adding a
 * handle; paint; weights at points; poses. On the star of the thesis' table 6.4 and its
 * surroundings, beside the demands on one thread. What the weights are worth is in bench_stars.
 * usage: bench_kernel */
#include "bench.h"

#include <icc/kernel.h>
#include <stdbool.h>

enum { SIDE = 256, PIXELS = SIDE * SIDE, MANY = 26, TIPS = 10, REPEATS = 15 };

/* About 1,000 nodes of 9,600. */
static const double CENTRE[2] = {0.5, 0.55}, RADIUS = 0.44;

static void row(const char *what, double ours, const char *demand)
{
    printf("    %-44s %8.2f   %s\n", what, ours, demand);
}

static void draw_star(double *xy)
{
    for (size_t i = 0; i < TIPS; ++i)
        bench_polar(xy + 2 * i, i % 2 == 0 ? 1 : 0.4, 90 + 36 * (double)i);
}

static icc_sampling *sample_star(const double *star)
{
    static const double SQUARE[8] = {-1.22, -1.22, 1.22, -1.22, 1.22, 1.22, -1.22, 1.22};
    const icc_sampling_options options = {.size = sizeof options, .spacing = 0.0268};
    icc_domain *domains[2] = {bench_domain(TIPS, star), bench_domain(4, SQUARE)};
    icc_shape *shape;
    icc_sampling *sampling;
    icc_error err = {.size = sizeof err};
    bench_check(icc_shape_create(&shape, 2, 2, (const icc_domain *const *)domains, 0, NULL, 0, NULL,
                                 NULL, &err),
                &err);
    bench_check(icc_sampling_create(&sampling, shape, &options, NULL, &err), &err);
    icc_shape_free(shape);
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
    return sampling;
}

static size_t count_painted(const icc_weights *kernel, size_t n)
{
    double *points = bench_alloc(2 * n, sizeof *points);
    size_t n_painted = 0;
    (void)icc_weights_get_nodes(kernel, points, NULL, NULL, NULL);
    for (size_t i = 0; i < n; ++i)
        n_painted += hypot(points[2 * i] - CENTRE[0], points[2 * i + 1] - CENTRE[1]) < RADIUS;
    free(points);
    return n_painted;
}

static void time_paint(const icc_weights *kernel, size_t n_nodes)
{
    double best = HUGE_VAL;
    for (int k = 0; k < REPEATS; ++k) {
        icc_weights *painted;
        icc_error err = {.size = sizeof err};
        const double begin = bench_seconds();
        bench_check(icc_weights_paint(&painted, kernel, 0, CENTRE, RADIUS, 0.2, NULL, &err), &err);
        best = fmin(best, bench_seconds() - begin);
        icc_weights_free(painted);
    }
    char what[60];
    snprintf(what, sizeof what, "paint %zu nodes of %zu: ms", count_painted(kernel, n_nodes),
             n_nodes);
    row(what, 1e3 * best, "<= 30 with the default kernel");
}

static void time_points(const icc_weights *kernel, size_t m)
{
    double *points = bench_alloc(2 * PIXELS, sizeof *points), best[2] = {HUGE_VAL, HUGE_VAL};
    double *weights = bench_alloc(PIXELS * m, sizeof *weights);
    double *gradients = bench_alloc(PIXELS * m, 2 * sizeof *gradients);
    for (size_t i = 0; i < PIXELS; ++i) {
        points[2 * i] = -1 + 2 * (double)(i % SIDE) / SIDE;
        points[2 * i + 1] = -1 + 2 * (double)(i / SIDE) / SIDE;
    }
    for (int k = 0; k < 2 * REPEATS; ++k) {
        const double begin = bench_seconds();
        (void)icc_weights_evaluate(kernel, PIXELS, points, weights, k % 2 ? gradients : NULL, NULL,
                                   NULL, NULL);
        best[k % 2] = fmin(best[k % 2], bench_seconds() - begin);
    }
    row("weights at a point: us", 1e6 * best[0] / PIXELS, m == TIPS ? "1.3 (Gauss: 2.5)" : "");
    row("with derivatives: us", 1e6 * best[1] / PIXELS, "");
    free(points);
    free(weights);
    free(gradients);
}

static void time_poses(const icc_weights *kernel, size_t m)
{
    double *points = bench_alloc(2 * PIXELS, sizeof *points), best[2] = {HUGE_VAL, HUGE_VAL};
    double *jacobians = bench_alloc(4 * PIXELS, sizeof *jacobians), transforms[6 * MANY];
    double *images = bench_alloc(2 * PIXELS, sizeof *images);
    icc_binding *binding;
    icc_error err = {.size = sizeof err};
    for (size_t i = 0; i < 2 * PIXELS; ++i)
        points[i] = sin((double)i);
    bench_check(icc_binding_create(&binding, kernel, PIXELS, points, 1, NULL, &err), &err);
    (void)icc_pose_reset(2, m, transforms);
    (void)icc_pose_move(2, transforms, CENTRE);
    for (int k = 0; k < 2 * REPEATS; ++k) {
        const double begin = bench_seconds();
        (void)icc_binding_pose(binding, transforms, images, k % 2 ? jacobians : NULL, NULL);
        best[k % 2] = fmin(best[k % 2], bench_seconds() - begin);
    }
    row("pose 256 x 256 points: ms", 1e3 * best[0], "");
    row("with Jacobians: ms", 1e3 * best[1], "");
    icc_binding_free(binding);
    free(points);
    free(images);
    free(jacobians);
}

static void time_all(const icc_sampling *sampling, size_t m, const double *handles, int32_t kind)
{
    const icc_weights_options options = {.size = sizeof options, .kernel = kind};
    icc_weights *kernel;
    icc_weights_info info = {.size = sizeof info};
    icc_weights_timings took = {.size = sizeof took};
    icc_error err = {.size = sizeof err};
    const double begin = bench_seconds();
    bench_check(icc_weights_create(&kernel, sampling, m, handles, &options, NULL, &err), &err);
    const double seconds = bench_seconds() - begin;
    (void)icc_weights_get_info(kernel, &info);
    (void)icc_weights_get_timings(kernel, &took);
    printf("%zu handles, %s, %.1f kernel values a row\n", m,
           kind == ICC_KERNEL_GAUSS ? "Gauss" : "Wendland",
           2 * (double)info.n_entries / (double)info.n_nodes - 1);
    row("kernel on samples that there are: ms", 1e3 * seconds, "");
    row("  initial weights", 1e3 * took.initial, "");
    row("  weights", 1e3 * took.optimise, "");
    row("  nodes and factor", 1e3 * took.factor, "");
    time_paint(kernel, info.n_nodes);
    time_points(kernel, m);
    time_poses(kernel, m);
    icc_weights_free(kernel);
}

int main(void)
{
    double star[2 * TIPS], many[2 * MANY];
    draw_star(star);
    for (size_t j = 0; j < MANY; ++j)
        bench_polar(many + 2 * j, 0.25 + 0.03 * (double)(j % 4), 360.0 * (double)j / MANY);
    icc_sampling *sampling = sample_star(star);
    for (int32_t kind = ICC_KERNEL_WENDLAND; kind <= ICC_KERNEL_GAUSS; ++kind) {
        time_all(sampling, TIPS, star, kind);
        time_all(sampling, MANY, many, kind);
    }
    icc_sampling_free(sampling);
    return EXIT_SUCCESS;
}
