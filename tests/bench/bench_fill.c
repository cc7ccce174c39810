/* Filling surfaces: usage: bench_fill FILE.obj ... Processor time of icc_domain_fill() beside that
 * of the command tetgen -pYq1.4 for the same surface, where it is installed, the best of three each,
 * taken in turns; tetrahedra of both; quantiles of the dihedral angles. */
#include "../flat_mesh.h"
#include <icc/icc.h>

#include "../meshes.h"
#include "bench.h"

#include <sys/resource.h>

enum { N_RUNS = 3 };

static double seconds(int who)
{
    struct rusage use;
    getrusage(who, &use);
    return (double)(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
           1e-6 * (double)(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

static void cross(double out[3], const double *o, const double *a, const double *b)
{
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        out[k] = (a[u] - o[u]) * (b[v] - o[v]) - (a[v] - o[v]) * (b[u] - o[u]);
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Six angles of each tetrahedron, in degrees, sorted. */
static double *angles_of(const double *vertices, size_t n, const uint32_t *tets)
{
    static const int edge[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                   {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
    double *angle = bench_alloc(6 * n, sizeof *angle);
    for (size_t i = 0; i < 6 * n; ++i) {
        const uint32_t *t = tets + 4 * (i / 6);
        const double *p[4];
        double u[3], v[3], uv = 0, uu = 0, vv = 0;
        for (int k = 0; k < 4; ++k)
            p[k] = vertices + 3 * (size_t)t[edge[i % 6][k]];
        cross(u, p[0], p[1], p[2]);
        cross(v, p[0], p[1], p[3]);
        for (int k = 0; k < 3; ++k) {
            uv += u[k] * v[k];
            uu += u[k] * u[k];
            vv += v[k] * v[k];
        }
        angle[i] = acos(fmax(-1, fmin(1, uv / sqrt(uu * vv)))) * 180 / 3.14159265358979323846;
    }
    qsort(angle, 6 * n, sizeof *angle, ascending);
    return angle;
}

typedef struct filling {
    double seconds;
    size_t n_tets;
    double one, least; /* quantile of 1 %, and the smallest */
} filling;

static bool fill(filling *f, const obj *o)
{
    icc_domain *surface, *filled;
    icc_error err = {.size = sizeof err};
    const icc_env env = {.size = sizeof env, .threads = 1};
    bench_check(icc_domain_create(&surface, 3, o->n_vertices, o->vertices, o->n_faces, o->faces,
                                  &env, &err),
                &err);
    const double start = seconds(RUSAGE_SELF);
    const icc_status status = icc_domain_fill(&filled, surface, NULL, &env, &err);
    f->seconds = seconds(RUSAGE_SELF) - start;
    icc_domain_free(surface);
    if (status != ICC_OK) {
        printf("%s: %s\n", icc_status_name(status), err.message);
        return false;
    }
    icc_domain_info info = {.size = sizeof info};
    bench_check(icc_domain_get_info(filled, &info), NULL);
    double *x = bench_alloc(3 * info.n_mesh_vertices, sizeof *x);
    uint32_t *t = bench_alloc(4 * info.n_mesh_simplices, sizeof *t);
    bench_check(flat_domain_mesh(filled, x, t), NULL);
    double *angle = angles_of(x, info.n_mesh_simplices, t);
    f->n_tets = info.n_mesh_simplices;
    f->least = angle[0];
    f->one = angle[6 * f->n_tets / 100];
    free(angle);
    free(x);
    free(t);
    icc_domain_free(filled);
    return true;
}

static bool tetgen(filling *f, const obj *o)
{
    test_mesh m;
    mesh_write_surface("bench_fill.tetgen.smesh", o->n_vertices, o->vertices, o->n_faces, o->faces);
    const double start = seconds(RUSAGE_CHILDREN);
    const int status = system("tetgen -pYq1.4zQ bench_fill.tetgen.smesh >/dev/null 2>&1");
    f->seconds = seconds(RUSAGE_CHILDREN) - start;
    const bool made = status == 0 && mesh_read_tetgen(&m, "bench_fill.tetgen");
    mesh_remove_files("bench_fill.tetgen");
    if (!made)
        return false;
    double *angle = angles_of(m.vertices, m.n_simplices, m.simplices);
    f->n_tets = m.n_simplices;
    f->least = angle[0];
    f->one = angle[6 * f->n_tets / 100];
    free(angle);
    mesh_free(&m);
    return true;
}

int main(int argc, char **argv)
{
    double *ratio = bench_alloc((size_t)argc, sizeof *ratio);
    size_t n = 0;
    const bool has_tetgen = mesh_has_tetgen();
    for (int i = 1; i < argc; ++i) {
        const char *slash = strrchr(argv[i], '/');
        filling ours = {.seconds = HUGE_VAL}, theirs = {.seconds = HUGE_VAL};
        obj o;
        if (!obj_read(&o, argv[i]))
            return EXIT_FAILURE;
        bool filled = true, beside = has_tetgen;
        for (int run = 0; run < N_RUNS && filled; ++run) {
            filling again;
            filled = fill(&again, &o);
            again.seconds = fmin(again.seconds, ours.seconds);
            ours = again;
            if (beside && (beside = tetgen(&again, &o))) {
                again.seconds = fmin(again.seconds, theirs.seconds);
                theirs = again;
            }
        }
        obj_free(&o);
        printf("%-24s", slash != NULL ? slash + 1 : argv[i]);
        if (filled)
            printf(" %6zu tets %6.3f s, 1 %% %5.2f, least %6.3f", ours.n_tets, ours.seconds,
                   ours.one, ours.least);
        if (filled && beside) {
            ratio[n++] = ours.seconds / theirs.seconds;
            printf("; tetgen %6zu tets %6.3f s, 1 %% %5.2f, least %6.3f; time %.2f, tets %.2f",
                   theirs.n_tets, theirs.seconds, theirs.one, theirs.least, ratio[n - 1],
                   (double)ours.n_tets / (double)theirs.n_tets);
        }
        printf("\n");
        (void)fflush(stdout);
    }
    qsort(ratio, n, sizeof *ratio, ascending);
    if (n > 0)
        printf("time beside tetgen's: median %.2f, most %.2f\n",
               0.5 * (ratio[(n - 1) / 2] + ratio[n / 2]), ratio[n - 1]);
    free(ratio);
    return EXIT_SUCCESS;
}
