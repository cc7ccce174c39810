/* How fair maps of meshes in space become: usage: bench_fair NAME.src.obj ..., with NAME.tgt.obj
 * beside each and the program tetgen installed. Symmetric Dirichlet energies (6: an isometry), their
 * mean and the most of a tetrahedron, after the repair, after steps down to gains of 1e-3 and of
 * 1e-4, after those that icc_map_create() takes, and after one level of refinement; with the time
 * that steps take beside making the map, of the processor with one thread; and the most memory for
 * each tetrahedron while the map is improved. Run by hand on a quiet machine. */
#include "../flat_mesh.h"
#include "../reports.h"
#include <icc/icc.h>

#include "../meshes.h"
#include "bench.h"
#include "quality.h"

/* ---- memory ---- */

typedef union block {
    size_t size;
    long double align;
} block;

static size_t n_bytes, most_bytes;

static void *count_alloc(void *user, size_t size)
{
    block *b = malloc(sizeof *b + size);
    (void)user;
    if (b == NULL)
        return NULL;
    b->size = size;
    n_bytes += size;
    most_bytes = n_bytes > most_bytes ? n_bytes : most_bytes;
    return b + 1;
}

static void count_free(void *user, void *memory)
{
    block *b = memory;
    (void)user;
    if (b == NULL)
        return;
    n_bytes -= b[-1].size;
    free(b - 1);
}

/* ---- maps ---- */

static icc_domain *make_domain(const char *path)
{
    test_mesh m;
    obj o;
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    if (!obj_read(&o, path) ||
        !mesh_tetgen(&m, o.n_vertices, o.vertices, o.n_faces, o.faces, "bench_fair")) {
        fprintf(stderr, "%s cannot be used\n", path);
        exit(EXIT_FAILURE);
    }
    bench_check(mesh_domain(&domain, &m, NULL, &err), &err);
    obj_free(&o);
    mesh_free(&m);
    return domain;
}

static double most_energy(const icc_map *map, double scale)
{
    icc_map_info info = {.size = sizeof info};
    bench_check(icc_map_get_info(map, &info), NULL);
    double *before = bench_alloc(info.n_vertices, 3 * sizeof *before);
    double *after = bench_alloc(info.n_vertices, 3 * sizeof *after);
    uint32_t *corners = bench_alloc(info.n_simplices, 4 * sizeof *corners);
    double most = 0;
    bench_check(flat_get_mesh(map, before, after, corners), NULL);
    for (size_t t = 0; t < info.n_simplices; ++t) {
        const uint32_t *v = corners + 4 * t;
        double x[9], y[9], j[9] = {0}, det;
        for (int i = 0; i < 9; ++i) {
            const size_t a = 3 * (size_t)v[i % 3 + 1] + (size_t)(i / 3),
                         o = 3 * (size_t)v[0] + (size_t)(i / 3);
            x[i] = before[a] - before[o];
            y[i] = after[a] - after[o];
        }
        det = determinant(x);
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                for (int k = 0; k < 3; ++k) {
                    const int p = (k + 1) % 3, q = (k + 2) % 3, s = (c + 1) % 3, u = (c + 2) % 3;
                    j[3 * r + c] += y[3 * r + k] / det *
                                    (x[3 * s + p] * x[3 * u + q] - x[3 * s + q] * x[3 * u + p]);
                }
        most = fmax(most, energy_of(j, scale));
    }
    free(before);
    free(after);
    free(corners);
    return most;
}

/* One row of the table; returns the better map. */
static void improve(const char *how, const icc_map *map, int32_t levels, double tolerance,
                    double making, double scale, const icc_env *env)
{
    const icc_improve_options options = {
        .size = sizeof options, .levels = levels, .tolerance = tolerance};
    icc_improve_report report = {.size = sizeof report};
    icc_error err = {.size = sizeof err};
    icc_map *better;
    const size_t before = n_bytes;
    most_bytes = n_bytes;
    const double start = bench_processor_seconds();
    bench_check(icc_map_improve(&better, map, &options, &report, env, &err), &err);
    const double spent = bench_processor_seconds() - start;
    printf("  %-10s energy %9.5f -> %8.5f, most %9.4g; %2zu steps, %6.3f s = %.2f of making it, "
           "%zu tetrahedra, %.0f bytes each\n",
           how, report.energy_start, report.energy, most_energy(better, scale), report.n_iterations,
           spent, spent / making, report.n_simplices,
           (double)(most_bytes - before) / (double)report.n_simplices);
    icc_map_free(better);
}

static void run_pair(const char *source_path)
{
    char target_path[1024];
    icc_error err = {.size = sizeof err};
    icc_domain_info info[2] = {{.size = sizeof info[0]}, {.size = sizeof info[1]}};
    const icc_env env = {
        .size = sizeof env, .threads = 1, .alloc = count_alloc, .dealloc = count_free};
    const size_t stem = strlen(source_path) - strlen(".src.obj");
    const char *slash = strrchr(source_path, '/');
    (void)snprintf(target_path, sizeof target_path, "%.*s.tgt.obj", (int)stem, source_path);
    icc_domain *source = make_domain(source_path), *target = make_domain(target_path);
    bench_check(icc_domain_get_info(source, &info[0]), NULL);
    bench_check(icc_domain_get_info(target, &info[1]), NULL);
    const double scale = cbrt(info[1].measure / info[0].measure);
    icc_map_options options = {.size = sizeof options, .iterations = -1};
    icc_map_info made = {.size = sizeof made};
    icc_map *map;
    double start = bench_processor_seconds();
    bench_check(icc_map_create(&map, source, target, &options, &env, &err), &err);
    const double making = bench_processor_seconds() - start;
    bench_check(icc_map_get_info(map, &made), NULL);
    printf("%s: %zu tetrahedra, %s, made in %.3f s; most %.4g\n",
           slash != NULL ? slash + 1 : source_path, made.n_simplices,
           made.kind == ICC_MAP_MESH ? "mesh" : "curves", making, most_energy(map, scale));
    improve("to 1e-3", map, -1, 1e-3, making, scale, &env);
    improve("to 1e-4", map, -1, 0, making, scale, &env);
    improve("one level", map, 1, 0, making, scale, &env);
    icc_map_free(map);
    options.iterations = 0;
    start = bench_processor_seconds();
    bench_check(icc_map_create(&map, source, target, &options, &env, &err), &err);
    bench_check(icc_map_get_info(map, &made), NULL);
    printf("  by itself  energy %9.5f -> %8.5f, most %9.4g; %2zu steps, %6.3f s with making it\n",
           report_of(map).energy_start, made.energy, most_energy(map, scale),
           report_of(map).n_iterations, bench_processor_seconds() - start);
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
