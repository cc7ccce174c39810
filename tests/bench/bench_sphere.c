/* Surfaces drawn on the sphere: usage: bench_sphere FILE.obj ... [-o OUT.obj]. Processor time, the
 * best of three; the energy s^2 + t^2 + 1 / s^2 + 1 / t^2 of the faces (s and t: how much they are
 * stretched, the areas being made the same), 4 for none: mean by area, median and 99 % quantile of
 * the area, the worst. With -o the last drawing is written as an OBJ file. */
#include <icc/icc.h>

#include "../obj.h"
#include "bench.h"
#include "face_stretch.h"
#include "match/sphere/sphere.h"
#include "match/sphere/sphere_certificate.h"
#include "match/surface/half_edges.h"

enum { N_RUNS = 3 };

static void print_energy(const obj *o, const double *y)
{
    face_stretch *face = bench_alloc(o->n_faces, sizeof *face);
    double area[2] = {0, 0}, p[3], q[3], mean = 0, below = 0, quantile[2] = {0, 0};
    for (size_t f = 0; f < o->n_faces; ++f) {
        face_sides(p, o->vertices, o->faces + 3 * f);
        face_sides(q, y, o->faces + 3 * f);
        area[0] += face_area(p);
        area[1] += face_area(q);
    }
    for (size_t f = 0; f < o->n_faces; ++f) {
        face_sides(p, o->vertices, o->faces + 3 * f);
        face_sides(q, y, o->faces + 3 * f);
        const double a = face_area(p) * area[1] / area[0], b = face_area(q);
        const double d = p[0] * q[2] - 2 * p[1] * q[1] + p[2] * q[0];
        face[f] = (face_stretch){d * area[1] / area[0] * (1 / (4 * a * a) + 1 / (4 * b * b)),
                                 {face_area(p) / area[0], b / area[1]}};
        mean += face[f].energy * face[f].area[0];
    }
    qsort(face, o->n_faces, sizeof *face, face_stretch_ascending);
    for (size_t f = 0; f < o->n_faces; ++f) {
        below += face[f].area[0];
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
