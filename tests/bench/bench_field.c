/* Charts of method field on surfaces: usage: bench_field CELLS NAME.src.obj ..., with NAME.tgt.obj
 * beside each; CELLS 0 is the default. What is amiss, what it costs, and how good the maps are: no
 * image, round trip, inverted Jacobians, symmetric Dirichlet energy (6 for an isometry). Run by
 * hand on a quiet machine. */
#include <icc/icc.h>

#include "../obj.h"
#include "../random.h"
#include "bench.h"
#include "quality.h"

enum { N_POINTS = 2000, REPEATS = 7 };

static icc_domain *read_domain(const char *path)
{
    obj o;
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    if (!obj_read(&o, path)) {
        fprintf(stderr, "cannot read %s\n", path);
        exit(EXIT_FAILURE);
    }
    bench_check(
        icc_domain_create(&domain, 3, o.n_vertices, o.vertices, o.n_faces, o.faces, NULL, &err),
        &err);
    obj_free(&o);
    return domain;
}

static void print_chart(const char *name, const icc_chart *chart)
{
    icc_chart_info common = {.size = sizeof common};
    icc_field_info i = {.size = sizeof i};
    icc_chart_timings took = {.size = sizeof took};
    bench_check(icc_chart_get_info(chart, &common), NULL);
    bench_check(icc_chart_get_field_info(chart, &i), NULL);
    bench_check(icc_chart_get_timings(chart, &took), NULL);
    printf("  %s: %ld cells, %zu of %zu vertices inside, %zu given up; critical %zu/%zu/%zu, "
           "infeasible %zu, not inward %zu of %zu%s; s: grid %.2f tree %.2f function %.2f vectors "
           "%.2f\n",
           name, (long)common.cells, i.n_inside, i.n_grid, i.n_stray, i.n_maxima, i.n_minima,
           i.n_saddles, i.n_infeasible, i.n_not_inward, i.n_contacts,
           common.certified ? ", certified" : "", took.grid, took.tree, took.function, took.solve);
}

static double points[3 * N_POINTS], images[3 * N_POINTS], back[3 * N_POINTS],
    jacobians[9 * N_POINTS];

static void fill_points(const icc_domain *domain, const icc_domain_info *info)
{
    random_source r = {1};
    for (size_t n = 0; n < N_POINTS;) {
        int32_t where;
        for (int k = 0; k < 3; ++k)
            points[3 * n + (size_t)k] = random_between(&r, info->lower[k], info->upper[k]);
        bench_check(icc_domain_locate(domain, 1, points + 3 * n, &where, NULL, NULL, NULL), NULL);
        n += where == ICC_INSIDE;
    }
}

static void measure(const icc_domain *source, const icc_domain *target, const icc_map *map)
{
    icc_domain_info from = {.size = sizeof from}, to = {.size = sizeof to};
    double energies[N_POINTS], errors[N_POINTS], size = 0;
    size_t lost = 0, inverted = 0;
    bench_check(icc_domain_get_info(source, &from), NULL);
    bench_check(icc_domain_get_info(target, &to), NULL);
    fill_points(source, &from);
    double apply = HUGE_VAL;
    for (int k = 0; k < REPEATS; ++k) {
        const double begin = bench_processor_seconds();
        bench_check(icc_map_apply(map, N_POINTS, points, images, NULL, &lost, NULL), NULL);
        apply = fmin(apply, bench_processor_seconds() - begin);
    }
    bench_check(icc_map_apply_inverse(map, N_POINTS, images, back, NULL, NULL, NULL), NULL);
    const double before = bench_seconds();
    bench_check(icc_map_jacobian(map, N_POINTS, points, jacobians, NULL, NULL, NULL), NULL);
    const double end = bench_seconds();
    for (int k = 0; k < 3; ++k)
        size = fmax(size, from.upper[k] - from.lower[k]);
    for (size_t i = 0; i < N_POINTS; ++i) {
        double worst = 0;
        for (size_t k = 0; k < 3; ++k)
            worst = fmax(worst, fabs(back[3 * i + k] - points[3 * i + k]) / size);
        errors[i] = isfinite(back[3 * i]) ? worst : HUGE_VAL;
        inverted += determinant(jacobians + 9 * i) <= 0;
        energies[i] = isfinite(jacobians[9 * i])
                          ? energy_of(jacobians + 9 * i, cbrt(to.measure / from.measure))
                          : HUGE_VAL;
    }
    qsort(energies, N_POINTS, sizeof *energies, ascending);
    qsort(errors, N_POINTS, sizeof *errors, ascending);
    printf("  %.1f us a point (at 32 cells: <= 12), %.1f with derivative; no image %zu of %d; "
           "round trip median %.1e, "
           "99 %% "
           "%.1e, worst %.1e; inverted %zu; energy median %.1f, 99 %% %.1f\n",
           1e6 * apply / N_POINTS, 1e6 * (end - before) / N_POINTS, lost, N_POINTS,
           errors[N_POINTS / 2], errors[N_POINTS * 99 / 100], errors[N_POINTS - 1], inverted,
           energies[N_POINTS / 2], energies[N_POINTS * 99 / 100]);
}

static void run(const char *path, int32_t cells)
{
    char other[1024];
    const char *end = strstr(path, ".src.obj");
    if (end == NULL)
        return;
    (void)snprintf(other, sizeof other, "%.*s.tgt.obj", (int)(end - path), path);
    icc_domain *source = read_domain(path), *target = read_domain(other);
    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_FIELD, .cells = cells};
    const icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    const double begin = bench_seconds();
    bench_check(icc_map_create(&map, source, target, &options, NULL, &err), &err);
    printf("%s: both charts in %.2f s\n", path, bench_seconds() - begin);
    print_chart("source", icc_map_source_chart(map));
    print_chart("target", icc_map_target_chart(map));
    measure(source, target, map);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}

int main(int argc, char **argv)
{
    for (int k = 2; k < argc; ++k)
        run(argv[k], (int32_t)atoi(argv[1]));
    return EXIT_SUCCESS;
}
