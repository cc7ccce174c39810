/* Method foliation on tetrahedra: usage: bench_tets NAME.src.obj ..., with NAME.tgt.obj beside each
 * and the program tetgen installed. What it costs, and how good the maps are: round trip, inverted
 * Jacobians, determinants relative to the volumes, symmetric Dirichlet energy (6 for an isometry),
 * beside a prototype's figures for some pairs. Run by hand on a quiet machine. */
#include <icc/icc.h>

#include "../meshes.h"
#include "bench.h"
#include "quality.h"

enum { N_POINTS = 20000, N_BUILDS = 3 };

/* Quantiles of 1, 50 and 99 % of the determinants, of energies the median, the mean and that of 99
 * %. */
typedef struct figures {
    const char *name;
    double build, micros;
    double det[3], energy[3];
} figures;

static const figures PROTOTYPE[] = {
    {"t01", 0.89, 6.0, {0.28, 0.99, 2.3}, {7.4, 20.6, 135}},
    {"t02", 20, 20, {0.35, 0.97, 1.9}, {7.7, 56, 656}},
    {"t03", 19, 30, {0.27, 0.99, 2.2}, {17, 2900, 6200}},
    {"t04", 18, 40, {0.52, 0.96, 1.5}, {8.3, 61, 679}},
    {"t05", 2.39, 5.0, {0.3, 0.94, 2.3}, {9.7, 20.1, 144}},
    {"t06", 0.46, 2.3, {0.1, 0.99, 2.5}, {7.4, 9.47, 29.9}},
    {"t07", 2.10, 3.4, {0.052, 0.28, 11}, {13.9, 27.9, 337}},
    {"t08", 0.05, 2.0, {0.37, 0.99, 2.2}, {7.8, 35, 305}},
};

static void print_figures(const char *name, const figures *f)
{
    printf("  %-9s build %5.2f s, %5.2f us a point, det %.2g %.2g %.2g, energy %.1f %.1f %.0f\n",
           name, f->build, f->micros, f->det[0], f->det[1], f->det[2], f->energy[0], f->energy[1],
           f->energy[2]);
}

static void mesh_surface(test_mesh *m, const char *path, const char *tag)
{
    obj o;
    if (!obj_read(&o, path)) {
        fprintf(stderr, "cannot read %s\n", path);
        exit(EXIT_FAILURE);
    }
    if (!mesh_tetgen(m, o.n_vertices, o.vertices, o.n_faces, o.faces, tag))
        exit(EXIT_FAILURE);
    obj_free(&o);
}

static void print_chart(const char *name, const icc_chart *chart)
{
    icc_chart_info common = {.size = sizeof common};
    icc_shelling_info i = {.size = sizeof i};
    icc_chart_timings took = {.size = sizeof took};
    bench_check(icc_chart_get_info(chart, &common), NULL);
    bench_check(icc_chart_get_shelling_info(chart, &i), NULL);
    bench_check(icc_chart_get_timings(chart, &took), NULL);
    const double sum = took.centre + took.solve + took.order + took.mesh + took.certify;
    printf(
        "  %s: %zu tetrahedra, %zu vertices; %s beta %g of %ld, %zu reversed, energy %.1e, "
        "divergence "
        "%.0e%s\n    ms: centre %.0f flux %.0f order %.0f certificate %.1f (%.1f %%) leaves %.0f\n",
        name, i.n_mesh_simplices, i.n_mesh_vertices, i.order_peeled ? "peeled" : "grown",
        i.order_beta, (long)i.n_orders, i.n_reversed, i.flux_energy, i.flux_divergence,
        common.certified ? ", certified" : "", 1e3 * took.centre, 1e3 * took.solve,
        1e3 * took.order, 1e3 * took.certify, 100 * took.certify / sum, 1e3 * took.mesh);
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

/* There and back: the largest error relative to the diagonal, and the time of the way there. */
static double round_trip(const icc_map *map, const icc_domain_info *info, double *micros)
{
    const icc_env env = {.size = sizeof env, .threads = 1};
    size_t n_failed = 0, n_back = 0;
    double largest = 0, diagonal = 0;
    *micros = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        const double start = bench_processor_seconds();
        bench_check(icc_map_apply(map, N_POINTS, points, images, NULL, &n_failed, &env), NULL);
        *micros = fmin(*micros, 1e6 * (bench_processor_seconds() - start) / N_POINTS);
    }
    bench_check(icc_map_apply_inverse(map, N_POINTS, images, back, NULL, &n_back, &env), NULL);
    for (size_t i = 0; i < 3 * N_POINTS; ++i)
        largest = fmax(largest, fabs(points[i] - back[i]));
    for (int k = 0; k < 3; ++k)
        diagonal += (info->upper[k] - info->lower[k]) * (info->upper[k] - info->lower[k]);
    printf("  lost %zu and %zu of %d, round trip at most %.1e\n", n_failed, n_back, (int)N_POINTS,
           largest / sqrt(diagonal));
    return largest;
}

static void measure_quality(const icc_map *map, double scale, figures *f)
{
    static icc_status status[N_POINTS];
    static double det[N_POINTS], energy[N_POINTS];
    size_t n = 0, n_inverted = 0, n_collapsed = 0;
    double sum = 0;
    bench_check(icc_map_jacobian(map, N_POINTS, points, jacobians, status, NULL, NULL), NULL);
    for (size_t i = 0; i < N_POINTS; ++i) {
        const double *j = jacobians + 9 * i;
        if (status[i] != ICC_OK)
            continue;
        det[n] = determinant(j) / (scale * scale * scale);
        energy[n] = energy_of(j, scale);
        n_inverted += !(det[n] > 0);
        n_collapsed += fabs(det[n]) < 1e-9;
        sum += energy[n++];
    }
    qsort(det, n, sizeof *det, ascending);
    qsort(energy, n, sizeof *energy, ascending);
    f->det[0] = det[n / 100];
    f->det[1] = det[n / 2];
    f->det[2] = det[n - 1 - n / 100];
    f->energy[0] = energy[n / 2];
    f->energy[1] = sum / (double)n;
    f->energy[2] = energy[n - 1 - n / 100];
    printf("  Jacobians: %zu, %zu inverted, %zu collapsed\n", n, n_inverted, n_collapsed);
}

static icc_domain *make_domain(const char *path, const char *tag)
{
    test_mesh m;
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    mesh_surface(&m, path, tag);
    const double start = bench_processor_seconds();
    bench_check(mesh_domain(&domain, &m, NULL, &err), &err);
    printf("  domain: %.0f ms\n", 1e3 * (bench_processor_seconds() - start));
    mesh_free(&m);
    return domain;
}

static void run_pair(const char *source_path)
{
    char target_path[1024];
    icc_error err = {.size = sizeof err};
    icc_domain_info info[2] = {{.size = sizeof info[0]}, {.size = sizeof info[1]}};
    figures f = {0};
    const size_t stem = strlen(source_path) - strlen(".src.obj");
    const char *slash = strrchr(source_path, '/');
    const char *name = slash != NULL ? slash + 1 : source_path;
    (void)snprintf(target_path, sizeof target_path, "%.*s.tgt.obj", (int)stem, source_path);
    printf("%s\n", name);
    icc_domain *source = make_domain(source_path, "bench_source");
    icc_domain *target = make_domain(target_path, "bench_target");
    bench_check(icc_domain_get_info(source, &info[0]), NULL);
    bench_check(icc_domain_get_info(target, &info[1]), NULL);
    icc_map *map = NULL;
    const icc_map_options options = {.size = sizeof options, .kind = ICC_MAP_CURVES};
    f.build = HUGE_VAL;
    for (int k = 0; k < N_BUILDS; ++k) {
        icc_map_free(map);
        const double start = bench_processor_seconds();
        bench_check(icc_map_create(&map, source, target, &options, NULL, &err), &err);
        f.build = fmin(f.build, bench_processor_seconds() - start);
    }
    print_chart("source", icc_map_source_chart(map));
    print_chart("target", icc_map_target_chart(map));
    fill_points(source, &info[0]);
    (void)round_trip(map, &info[0], &f.micros);
    measure_quality(map, cbrt(info[1].measure / info[0].measure), &f);
    print_figures("now", &f);
    for (size_t k = 0; k < sizeof PROTOTYPE / sizeof *PROTOTYPE; ++k)
        if (strncmp(name, PROTOTYPE[k].name, 3) == 0)
            print_figures("prototype", &PROTOTYPE[k]);
    (void)fflush(stdout);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}

int main(int argc, char **argv)
{
    for (int k = 1; k < argc; ++k)
        run_pair(argv[k]);
    return EXIT_SUCCESS;
}
