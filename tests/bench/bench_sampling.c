/* Samplings beside the thesis': the star's 9,600 samples (section 6.2.1), 1,024 points in a square
 * (3.3.2), grids (3.3.1), and the spectrum of figure 6.10. */
#include "bench.h"
#include "gaussians.h"
#include "kernel/sampling/sampling.h"
#include "kernel/sampling/spectrum.h"

static icc_shape *make_shape(size_t n, icc_domain *const *regions)
{
    icc_shape *shape;
    icc_error error = {.size = sizeof error};
    bench_check(icc_shape_create(&shape, 2, n, (const icc_domain *const *)regions, 0, NULL, 0, NULL,
                                 NULL, &error),
                &error);
    for (size_t i = 0; i < n; ++i)
        icc_domain_free(regions[i]);
    return shape;
}

static icc_domain *square(double half)
{
    const double xy[8] = {-half, -half, half, -half, half, half, -half, half};
    return bench_domain(4, xy);
}

static icc_shape *star_in_square(void)
{
    double xy[10][2];
    for (int i = 0; i < 10; ++i)
        bench_polar(xy[i], i % 2 == 0 ? 1 : 0.4, 90 + 36 * i);
    icc_domain *const regions[2] = {bench_domain(10, xy[0]), square(1.33)};
    return make_shape(2, regions);
}

static icc_sampling *sample(const icc_shape *shape, const icc_sampling_options *options,
                            icc_sampling_info *info, double *seconds)
{
    icc_sampling *sampling;
    icc_error error = {.size = sizeof error};
    const double start = bench_seconds();
    bench_check(icc_sampling_create(&sampling, shape, options, NULL, &error), &error);
    *seconds = bench_seconds() - start;
    info->size = sizeof *info;
    (void)icc_sampling_get_info(sampling, info);
    return sampling;
}

static void row(const char *what, const char *thesis, double ours, const char *demand)
{
    printf("  %-46s %12s %12.4g %12s\n", what, thesis, ours, demand);
}

static void title(const char *what)
{
    printf("%-48s %12s %12s %12s\n", what, "thesis", "ours", "demand");
}

/* The edge samples come first; what belongs to neither side would be nowhere. */
static size_t count_astray(const icc_sampling *sampling, const icc_sampling_info *info)
{
    size_t n = 0;
    for (size_t i = 0; i < info->n_samples; ++i) {
        const iccp_spot spot = iccp_shape_spot(sampling->shape, sampling->points + 2 * i);
        n += spot.region == ICCP_NOWHERE || (spot.wall != ICCP_NOWHERE) != (i < info->n_edge);
    }
    return n;
}

static void bench_star_samples(void)
{
    static const int32_t STEPS[] = {30, 60, 100};
    icc_shape *shape = star_in_square();
    for (int i = 0; i < 3; ++i) {
        icc_sampling_info info;
        double seconds, least = 1e9;
        const icc_sampling_options options = {
            .size = sizeof options, .spacing = 0.0296, .steps = STEPS[i]};
        for (int k = 0; k < 3; ++k) {
            icc_sampling_free(sample(shape, &options, &info, &seconds));
            least = seconds < least ? seconds : least;
        }
        icc_sampling *sampling = sample(shape, &options, &info, &seconds);
        char name[64];
        (void)snprintf(name, sizeof name, "star and square, %d steps", (int)STEPS[i]);
        title(name);
        row("samples", "9600", (double)info.n_samples, "9600");
        row("of them on edges", "600", (double)info.n_edge, "");
        row("seconds (prototype, the thesis' way: 77)", "-", least, "<= 1");
        row("nearest neighbour, T", "0.16", info.nearest, ">= 0.55");
        row("on the wrong side (prototype: 62)", "-", (double)count_astray(sampling, &info), "0");
        row("suggested sigma (thesis: by eye)", "0.02", info.sigma, "");
        icc_sampling_free(sampling);
    }
    icc_shape_free(shape);
}

static void bench_square(void)
{
    icc_domain *const region = square(30);
    icc_shape *shape = make_shape(1, &region);
    for (uint64_t seed = 1; seed <= 3; ++seed) {
        icc_sampling_info info;
        double seconds;
        gaussians g;
        const icc_sampling_options options = {
            .size = sizeof options, .spacing = 2.08, .seed = seed};
        icc_sampling *sampling = sample(shape, &options, &info, &seconds);
        title("blue noise in [-30, 30]^2, sigma 2.5");
        row("points", "1024", (double)info.n_samples, "");
        if (!gaussians_create(&g, info.n_samples, sampling->points, 2.5))
            printf("  not positive definite\n");
        const gaussians_report r = gaussians_measure(&g, 160, 15, HUGE_VAL);
        row("condition", "2.3e5", r.condition, "<= 5e5");
        row("partition of unity", "3.4e-4", r.unity, "<= 4e-4");
        row("reproduction, greatest", "1.1e-2", r.reproduction, "<= 1.2e-2");
        row("reproduction, mean", "0.15e-2", r.reproduction_mean, "");
        row("Lagrange", "5.7e-9", r.lagrange, "<= 1e-8");
        gaussians_free(&g);
        icc_sampling_free(sampling);
    }
    icc_shape_free(shape);
}

static void bench_grid(double spacing)
{
    icc_domain *const region = square(20 * spacing);
    icc_shape *shape = make_shape(1, &region);
    icc_sampling_info info;
    double seconds;
    gaussians g;
    const icc_sampling_options options = {
        .size = sizeof options, .kind = ICC_SAMPLING_GRID, .spacing = spacing};
    icc_sampling *sampling = sample(shape, &options, &info, &seconds);
    title(spacing > 1 ? "grid of 41 x 41, T = 2" : "grid of 41 x 41, T = 0.5");
    row("points", "1681", (double)info.n_samples, "1681");
    if (!gaussians_create(&g, info.n_samples, sampling->points, info.sigma))
        printf("  not positive definite\n");
    const gaussians_report r = gaussians_measure(&g, 201, 10 * spacing, 10 * spacing);
    row("condition", "1e3", r.condition, "");
    row("partition of unity", "2.2e-4", r.unity, "<= 2.3e-4");
    row("reproduction / T, greatest", "3.4e-3", r.reproduction / spacing, "within 5%");
    row("reproduction / T, mean", "0.60e-3", r.reproduction_mean / spacing, "within 5%");
    row("Lagrange", "5.1e-11", r.lagrange, "<= 1e-10");
    gaussians_free(&g);
    icc_sampling_free(sampling);
    icc_shape_free(shape);
}

/* Figure 6.10: the power of the samples, and the Gaussian's spectrum over its value at 0. */
static void bench_spectrum(void)
{
    icc_shape *shape = star_in_square();
    icc_sampling_info info;
    double seconds, power[ICCP_SPECTRUM_BINS];
    iccp_env env;
    const icc_sampling_options options = {.size = sizeof options, .spacing = 0.0296};
    icc_sampling *sampling = sample(shape, &options, &info, &seconds);
    const double step = 1.5 / (info.spacing * ICCP_SPECTRUM_BINS);
    (void)iccp_env_read(&env, NULL, NULL);
    (void)iccp_spectrum(2, info.n_samples - info.n_edge, sampling->points + 2 * info.n_edge, step,
                        power, &env);
    printf("figure 6.10: k T / 2 pi, power of the samples, Gaussian of sigma = %g and of 0.02\n",
           info.sigma);
    for (size_t b = 7; b < ICCP_SPECTRUM_BINS; b += 8) {
        const double k = 6.28318530717958648 * step * (double)(b + 1);
        printf("  %5.3f %10.4f %10.2e %10.2e\n", 1.5 * (double)(b + 1) / ICCP_SPECTRUM_BINS,
               power[b], exp(-0.5 * k * k * info.sigma * info.sigma), exp(-0.5 * k * k * 4e-4));
    }
    icc_sampling_free(sampling);
    icc_shape_free(shape);
}

int main(void)
{
    bench_star_samples();
    bench_square();
    bench_grid(2);
    bench_grid(0.5);
    bench_spectrum();
    return 0;
}
