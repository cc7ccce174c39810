/* What it costs to make a domain, to list the defects of its boundary, and to locate a point: for
 * outlines of 10 to 23,000 vertices, ordinary and unpleasant ones, and for surfaces, where points
 * near the boundary are timed too.
 * usage: bench_domain [FILE...]   (each FILE: one "x y" per line, or NAME.obj, a surface) */

#include "bench.h"
#include "obj.h"
#include "surfaces.h"

enum { MAX_VERTICES = 1 << 18, N_QUERIES = 1 << 20 };

static double vertices[2 * MAX_VERTICES], queries[2 * N_QUERIES], bary[2 * N_QUERIES];
static int32_t where[N_QUERIES];
static uint32_t facet[N_QUERIES];

static double uniform(void)
{
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) * 0x1p-53;
}

static void put(size_t i, double x, double y)
{
    vertices[2 * i] = x;
    vertices[2 * i + 1] = y;
}

static void make_circle(size_t n)
{
    for (size_t i = 0; i < n; ++i)
        put(i, cos(6.283185307179586 * (double)i / (double)n),
            sin(6.283185307179586 * (double)i / (double)n));
}

/* A star with smooth lobes and rough edges. */
static void make_coast(size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * (double)i / (double)n;
        const double radius =
            1 + 0.5 * sin(7 * angle) + 0.2 * sin(31 * angle) + 20 * uniform() / (double)n;
        put(i, radius * cos(angle), radius * sin(angle));
    }
}

/* Long thin teeth along (dx, dy); along a diagonal all their boxes overlap. */
static void make_comb(size_t n, double dx, double dy)
{
    const double width = 1.0 / (double)n;
    for (size_t i = 0; i + 2 < n; ++i) {
        const double u = i % 2 == 0 ? 0 : 1, v = width * (double)i;
        put(i, dx * u - dy * v, dy * u + dx * v);
    }
    put(n - 2, -0.01 * dx - dy, -0.01 * dy + dx);
    put(n - 1, -0.01 * dx, -0.01 * dy);
}

static void make_spiral(size_t n)
{
    const size_t half = n / 2;
    for (size_t i = 0; i < half; ++i) {
        const double turns = half < 1000 ? 0.06 * (double)half : 60;
        const double angle = turns * 6.283185307179586 * (double)i / (double)half;
        put(i, (1 + angle) * cos(angle), (1 + angle) * sin(angle));
        put(2 * half - 1 - i, (3 + angle) * cos(angle), (3 + angle) * sin(angle));
    }
}

static size_t read_file(const char *path)
{
    FILE *file = fopen(path, "r");
    size_t n = 0;
    if (file == NULL)
        return 0;
    while (n < MAX_VERTICES && fscanf(file, "%lf%lf", &vertices[2 * n], &vertices[2 * n + 1]) == 2)
        ++n;
    (void)fclose(file);
    return n;
}

static double time_create(size_t n, icc_domain **domain)
{
    double best = HUGE_VAL;
    icc_error err = {.size = sizeof err};
    for (int i = 0; i < 5; ++i) {
        if (i > 0)
            icc_domain_free(*domain);
        const double start = bench_processor_seconds();
        if (icc_domain_create(domain, 2, n, vertices, 0, NULL, NULL, &err) != ICC_OK) {
            (void)printf("%s\n", err.message);
            return HUGE_VAL;
        }
        best = fmin(best, bench_processor_seconds() - start);
    }
    return best;
}

static void measure(const char *name, size_t n)
{
    icc_domain *domain;
    icc_domain_info info = {.size = sizeof info};
    size_t n_defects;
    const double create = time_create(n, &domain);
    if (domain == NULL)
        return;
    const double start = bench_processor_seconds();
    (void)icc_boundary_defects(n, vertices, 0, NULL, NULL, &n_defects, NULL, NULL);
    const double listed = bench_processor_seconds();
    (void)icc_domain_get_info(domain, &info);
    for (size_t i = 0; i < 2 * (size_t)N_QUERIES; ++i)
        queries[i] = info.lower[i % 2] + uniform() * (info.upper[i % 2] - info.lower[i % 2]);
    const double begin = bench_processor_seconds();
    (void)icc_domain_locate(domain, N_QUERIES, queries, where, NULL, NULL, NULL);
    const double located = bench_processor_seconds();
    (void)icc_domain_locate(domain, N_QUERIES / 16, queries, where, facet, bary, NULL);
    const double found = bench_processor_seconds();
    (void)printf("%-34.34s %6zu %10.3f %10.3f %9.1f %9.1f\n", name, n, 1e3 * create,
                 1e3 * (listed - start), 1e9 * (located - begin) / N_QUERIES,
                 16e9 * (found - located) / N_QUERIES);
    icc_domain_free(domain);
}

/* ---------------------------------------------------------------- surfaces */

enum { N_SPACE = 1 << 17 };

static double place[3 * N_SPACE], share[3 * N_SPACE];

static double time_locate(const icc_domain *domain, int nearest)
{
    const double start = bench_processor_seconds();
    (void)icc_domain_locate(domain, N_SPACE, place, where, nearest ? facet : NULL,
                            nearest ? share : NULL, NULL);
    return 1e9 * (bench_processor_seconds() - start) / N_SPACE;
}

/* Points of the bounding box, then points within 1 % of its size of vertices. */
static void measure_surface(const char *name, size_t n, const double *points, size_t n_faces,
                            const uint32_t *faces)
{
    icc_domain *domain = NULL;
    icc_domain_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    double create = HUGE_VAL, size = 0;
    for (int i = 0; i < 5; ++i) {
        icc_domain_free(domain);
        const double start = bench_processor_seconds();
        if (icc_domain_create(&domain, 3, n, points, n_faces, faces, NULL, &err) != ICC_OK) {
            (void)printf("%-34.34s %s\n", name, err.message);
            return;
        }
        create = fmin(create, bench_processor_seconds() - start);
    }
    (void)icc_domain_get_info(domain, &info);
    for (size_t i = 0; i < 3 * (size_t)N_SPACE; ++i)
        place[i] = info.lower[i % 3] + uniform() * (info.upper[i % 3] - info.lower[i % 3]);
    const double locate = time_locate(domain, 0), nearest = time_locate(domain, 1);
    for (int k = 0; k < 3; ++k)
        size = fmax(size, info.upper[k] - info.lower[k]);
    for (size_t i = 0; i < 3 * (size_t)N_SPACE; ++i)
        place[i] = points[3 * (i / 3 * 7919 % n) + i % 3] + 0.02 * size * (uniform() - 0.5);
    (void)printf("%-34.34s %6zu %10.3f %9.1f %9.1f %9.1f %9.1f\n", name, n_faces, 1e3 * create,
                 locate, nearest, time_locate(domain, 0), time_locate(domain, 1));
    icc_domain_free(domain);
}

static int any_cell(int x, int y, int z)
{
    (void)(x + y + z);
    return 1;
}

static void measure_surfaces(int argc, char **argv)
{
    static surface s;
    random_source r = {1};
    (void)printf("%-34s %6s %10s %9s %9s %9s %9s\n", "", "faces", "create ms", "locate ns",
                 "nearest ns", "near ns", "near ns");
    for (int i = 1; i < argc; ++i) {
        const char *slash = strrchr(argv[i], '/');
        obj o;
        if (strstr(argv[i], ".obj") == NULL || !obj_read(&o, argv[i]))
            continue;
        measure_surface(slash != NULL ? slash + 1 : argv[i], o.n_vertices, o.vertices, o.n_faces,
                        o.faces);
        obj_free(&o);
    }
    for (int splits = 1; splits <= 5; splits += 2) {
        surface_star(&s, splits, 0.1, &r);
        measure_surface("rough ball", s.n_vertices, s.vertices, s.n_faces, s.faces);
        surface_star(&s, splits, 0.9, &r);
        measure_surface("spikes", s.n_vertices, s.vertices, s.n_faces, s.faces);
    }
    surface_cells(&s, 30, any_cell);
    measure_surface("cells of a cube", s.n_vertices, s.vertices, s.n_faces, s.faces);
}

int main(int argc, char **argv)
{
    measure_surfaces(argc, argv);
    (void)printf("%-34s %6s %10s %10s %9s %9s\n", "", "n", "create ms", "list ms", "locate ns",
                 "nearest ns");
    for (int i = 1; i < argc; ++i) {
        const char *slash = strrchr(argv[i], '/');
        if (strstr(argv[i], ".obj") == NULL)
            measure(slash != NULL ? slash + 1 : argv[i], read_file(argv[i]));
    }
    for (size_t n = 10; n <= 23000; n = n < 10000 ? 10 * n : n + 13000) {
        make_circle(n);
        measure("circle", n);
        make_coast(n);
        measure("coast", n);
        make_comb(n, 1, 0);
        measure("comb", n);
        make_comb(n, 1, 1);
        measure("diagonal comb", n);
        make_spiral(n);
        measure("spiral", n);
    }
    return 0;
}
