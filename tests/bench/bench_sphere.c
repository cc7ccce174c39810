/* Surfaces drawn on the sphere: usage: bench_sphere FILE.obj ... [-o OUT.obj]. Processor time, the
 * best of three; the energy s^2 + t^2 + 1 / s^2 + 1 / t^2 of the faces (s and t: how much they are
 * stretched, the areas being made the same), 4 for none: mean by area, median and 99 % quantile of
 * the area, the worst. With -o the last drawing is written as an OBJ file. */
#include <icc/icc.h>

#include "../obj.h"
#include "bench.h"
#include "surface/half_edges.h"
#include "surface/sphere.h"
#include "surface/sphere_certificate.h"

enum { N_RUNS = 3 };

typedef struct stretched {
    double energy, area;
} stretched;

static int ascending(const void *a, const void *b)
{
    const double x = ((const stretched *)a)->energy, y = ((const stretched *)b)->energy;
    return (x > y) - (x < y);
}

/* The products of two sides of a face. */
static void sides(double product[3], const double *x, const uint32_t *v)
{
    product[0] = product[1] = product[2] = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double o = x[3 * v[0] + k], a = x[3 * v[1] + k] - o, b = x[3 * v[2] + k] - o;
        product[0] += a * a;
        product[1] += a * b;
        product[2] += b * b;
    }
}

static double area_of(const double p[3])
{
    return 0.5 * sqrt(fmax(p[0] * p[2] - p[1] * p[1], 0));
}

static void print_energy(const obj *o, const double *y)
{
    stretched *face = bench_alloc(o->n_faces, sizeof *face);
    double area[2] = {0, 0}, p[3], q[3], mean = 0, below = 0, quantile[2] = {0, 0};
    for (size_t f = 0; f < o->n_faces; ++f) {
        sides(p, o->vertices, o->faces + 3 * f);
        sides(q, y, o->faces + 3 * f);
        area[0] += area_of(p);
        area[1] += area_of(q);
    }
    for (size_t f = 0; f < o->n_faces; ++f) {
        sides(p, o->vertices, o->faces + 3 * f);
        sides(q, y, o->faces + 3 * f);
        const double a = area_of(p) * area[1] / area[0], b = area_of(q);
        const double d = p[0] * q[2] - 2 * p[1] * q[1] + p[2] * q[0];
        face[f] = (stretched){d * area[1] / area[0] * (1 / (4 * a * a) + 1 / (4 * b * b)),
                              area_of(p) / area[0]};
        mean += face[f].energy * face[f].area;
    }
    qsort(face, o->n_faces, sizeof *face, ascending);
    for (size_t f = 0; f < o->n_faces; ++f) {
        below += face[f].area;
        for (int k = 0; k < 2; ++k)
            if (quantile[k] == 0 && below >= (k == 0 ? 0.5 : 0.99))
                quantile[k] = face[f].energy;
    }
    printf("energy mean %8.4g, median %7.4g, 99 %% %8.4g, worst %8.3g", mean, quantile[0],
           quantile[1], face[o->n_faces - 1].energy);
    free(face);
}

static void write_obj(const char *path, const obj *o, const double *y)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return;
    for (size_t i = 0; i < o->n_vertices; ++i)
        fprintf(file, "v %.17g %.17g %.17g\n", y[3 * i], y[3 * i + 1], y[3 * i + 2]);
    for (size_t f = 0; f < o->n_faces; ++f)
        fprintf(file, "f %lu %lu %lu\n", (unsigned long)o->faces[3 * f] + 1,
                (unsigned long)o->faces[3 * f + 1] + 1, (unsigned long)o->faces[3 * f + 2] + 1);
    (void)fclose(file);
}

int main(int argc, char **argv)
{
    const char *out = argc > 2 && strcmp(argv[argc - 2], "-o") == 0 ? argv[argc - 1] : NULL;
    const iccp_env env = {.memory = iccp_memory_default};
    for (int i = 1; i < argc - (out != NULL ? 2 : 0); ++i) {
        const char *slash = strrchr(argv[i], '/');
        obj o;
        icc_error err = {.size = sizeof err};
        icc_status status = ICC_OK;
        double best = HUGE_VAL;
        if (!obj_read(&o, argv[i]))
            return EXIT_FAILURE;
        double *y = bench_alloc(o.n_vertices, 3 * sizeof *y);
        for (int run = 0; run < N_RUNS; ++run) {
            const double start = bench_processor_seconds();
            status = iccp_sphere_draw(y, o.n_vertices, o.vertices, o.n_faces, o.faces, &env, &err);
            best = fmin(best, bench_processor_seconds() - start);
        }
        printf("%-24s %6zu vertices %7.3f s, ", slash != NULL ? slash + 1 : argv[i], o.n_vertices,
               best);
        if (status == ICC_OK)
            print_energy(&o, y);
        else
            printf("%s: %s", icc_status_name(status), err.message);
        printf("\n");
        (void)fflush(stdout);
        if (out != NULL)
            write_obj(out, &o, y);
        obj_free(&o);
        free(y);
    }
    return EXIT_SUCCESS;
}
