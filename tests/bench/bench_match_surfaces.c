/* Two surfaces with different triangles made one with the other: usage: bench_match_surfaces [keep]
 * N_LANDMARKS TOLERANCE SHARE SOURCE.obj TARGET.obj [OUT]; keep: the source's mesh. The files have vertices that correspond;
 * of the target's that share is left, landmarks are farthest points among these (0: none).
 * Processor time; the energy s^2 + t^2 + 1 / s^2 + 1 / t^2 of the common triangles, 4 for none, the
 * areas being made the same: mean by area of the source, median and 99 % quantile of that area, the
 * share of the area on either side above 1000; beside them the mean of the correspondence that the
 * files have, on the target's triangles; what is left beside what both had together, and the angle
 * that one in a hundred triangles' least angles are below, on either side. A tolerance below 0
 * leaves the bare overlay. With OUT both surfaces are written, to OUT.src.obj and OUT.tgt.obj. */
#include <icc/icc.h>

#include "../obj.h"
#include "bench.h"
#include "face_stretch.h"
#include "match/sphere/decimate.h"
#include "match/surface/corner_angle.h"
#include "match/surface/half_edges.h"

static _Noreturn void fail(const char *what)
{
    (void)fprintf(stderr, "%s\n", what);
    exit(EXIT_FAILURE);
}

/* By energy; areas sum up to 1 on either side. */
static face_stretch *measure(const double *x, const double *y, size_t n, const uint32_t *faces)
{
    face_stretch *const face = bench_alloc(n, sizeof *face);
    double area[2] = {0, 0}, p[3], q[3];
    for (size_t f = 0; f < n; ++f) {
        face_sides(p, x, faces + 3 * f);
        face_sides(q, y, faces + 3 * f);
        area[0] += face_area(p);
        area[1] += face_area(q);
    }
    for (size_t f = 0; f < n; ++f) {
        face_sides(p, x, faces + 3 * f);
        face_sides(q, y, faces + 3 * f);
        const double a = face_area(p) / area[0], b = face_area(q) / area[1];
        const double d = (p[0] * q[2] - 2 * p[1] * q[1] + p[2] * q[0]) / (area[0] * area[1]);
        face[f] = (face_stretch){d * (1 / (4 * a * a) + 1 / (4 * b * b)), {a, b}};
        if (!(face[f].energy > 0 && face[f].energy < 1e8))
            face[f].energy = 1e8;
    }
    qsort(face, n, sizeof *face, face_stretch_ascending);
    return face;
}

static double mean_of(const face_stretch *face, size_t n)
{
    double mean = 0;
    for (size_t f = 0; f < n; ++f)
        mean += face[f].energy * face[f].area[0];
    return mean;
}

static void print_energy(const face_stretch *face, size_t n)
{
    double below = 0, quantile[2] = {0, 0}, above[2] = {0, 0};
    for (size_t f = 0; f < n; ++f) {
        below += face[f].area[0];
        for (int k = 0; k < 2; ++k) {
            if (quantile[k] == 0 && below >= (k == 0 ? 0.5 : 0.99))
                quantile[k] = face[f].energy;
            if (face[f].energy > 1e3)
                above[k] += face[f].area[k];
        }
    }
    printf("energy %7.4g (%6.4g, %7.4g), above 1000 %.1e / %.1e", mean_of(face, n), quantile[0],
           quantile[1], above[0], above[1]);
}

/* Leaves a share of the vertices; the others have no faces then. */
static void thin(obj *o, double share)
{
    iccp_env env;
    iccp_half_edges m;
    double size = 0;
    for (size_t k = 0; k < 3 * o->n_vertices; ++k)
        size = fmax(size, fabs(o->vertices[k]));
    double *const x = bench_alloc(o->n_vertices, 3 * sizeof *x);
    for (size_t k = 0; k < 3 * o->n_vertices; ++k)
        x[k] = o->vertices[k] / size;
    if (iccp_env_read(&env, NULL, NULL) != ICC_OK ||
        iccp_half_edges_create(&m, o->n_vertices, o->n_faces, o->faces, &env, NULL) != ICC_OK ||
        iccp_decimate(&m, x, (size_t)(share * (double)m.n_left), &env) != ICC_OK)
        fail("not a surface");
    o->n_faces = 0;
    for (uint32_t v = 0; v < m.n_vertices; ++v) {
        uint32_t h = m.out[v];
        for (uint32_t k = 0; k < m.degree[v]; ++k, h = iccp_edge_turn(&m, h)) {
            const uint32_t a = iccp_edge_end(&m, h), b = m.origin[iccp_before(h)];
            if (a > v && b > v) {
                uint32_t *const f = o->faces + 3 * o->n_faces++;
                f[0] = v;
                f[1] = a;
                f[2] = b;
            }
        }
    }
    iccp_half_edges_free(&m);
    free(x);
}

/* Vertices that faces have, each the farthest from those before it. */
static void find_landmarks(double *pairs, size_t n, const obj *source, const obj *target)
{
    double *const distance = bench_alloc(target->n_vertices, sizeof *distance);
    for (size_t v = 0; v < target->n_vertices; ++v)
        distance[v] = -1;
    for (size_t c = 0; c < 3 * target->n_faces; ++c)
        distance[target->faces[c]] = HUGE_VAL;
    size_t v = target->faces[0];
    for (size_t k = 0; k < n; ++k) {
        size_t far = 0;
        for (size_t i = 0; i < 3; ++i) {
            pairs[6 * k + i] = source->vertices[3 * v + i];
            pairs[6 * k + 3 + i] = target->vertices[3 * v + i];
        }
        for (size_t w = 0; w < target->n_vertices; ++w) {
            double d = 0;
            for (size_t i = 0; i < 3; ++i)
                d += pow(target->vertices[3 * w + i] - target->vertices[3 * v + i], 2);
            distance[w] = fmin(distance[w], d);
            if (distance[w] > distance[far])
                far = w;
        }
        v = far;
    }
    free(distance);
}

static icc_domain *domain_of(const obj *o)
{
    uint32_t *const number = bench_alloc(o->n_vertices, sizeof *number);
    uint32_t *const faces = bench_alloc(o->n_faces, 3 * sizeof *faces);
    double *const x = bench_alloc(o->n_vertices, 3 * sizeof *x);
    size_t n = 0;
    for (size_t v = 0; v < o->n_vertices; ++v)
        number[v] = UINT32_MAX;
    for (size_t c = 0; c < 3 * o->n_faces; ++c) {
        const uint32_t v = o->faces[c];
        if (number[v] == UINT32_MAX) {
            for (size_t i = 0; i < 3; ++i)
                x[3 * n + i] = o->vertices[3 * v + i];
            number[v] = (uint32_t)n++;
        }
        faces[c] = number[v];
    }
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    if (icc_domain_create(&domain, 3, n, x, o->n_faces, faces, NULL, &err) != ICC_OK)
        fail(err.message);
    free(number);
    free(faces);
    free(x);
    return domain;
}

static void write(const char *name, const char *side, size_t n, const double *x, size_t n_faces,
                  const uint32_t *faces)
{
    char path[1024];
    (void)snprintf(path, sizeof path, "%s.%s.obj", name, side);
    FILE *const file = fopen(path, "w");
    if (file == NULL)
        fail(path);
    for (size_t v = 0; v < n; ++v)
        (void)fprintf(file, "v %.17g %.17g %.17g\n", x[3 * v], x[3 * v + 1], x[3 * v + 2]);
    for (size_t f = 0; f < n_faces; ++f)
        (void)fprintf(file, "f %u %u %u\n", faces[3 * f] + 1, faces[3 * f + 1] + 1,
                      faces[3 * f + 2] + 1);
    (void)fclose(file);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* One in a hundred of the triangles' least angles are below it; degrees. */
static double thin_angle(const double *x, size_t n, const uint32_t *faces)
{
    double *const angle = bench_alloc(n, sizeof *angle);
    for (size_t f = 0; f < n; ++f) {
        const uint32_t *const v = faces + 3 * f;
        angle[f] = asin(fmin(
            1, iccp_least_sine(x + 3 * (size_t)v[0], x + 3 * (size_t)v[1], x + 3 * (size_t)v[2])));
    }
    qsort(angle, n, sizeof *angle, ascending);
    const double least = angle[n / 100] * 180 / acos(-1);
    free(angle);
    return least;
}

static void report(const icc_match *match, const char *name, size_t n_given)
{
    icc_match_info info = {.size = sizeof info};
    icc_domain_info size = {.size = sizeof size};
    const icc_domain *const domain[2] = {icc_match_source(match), icc_match_target(match)};
    (void)icc_match_get_info(match, &info);
    (void)icc_domain_get_info(domain[0], &size);
    double *x[2];
    uint32_t *const faces = bench_alloc(size.n_facets, 3 * sizeof *faces);
    for (int s = 0; s < 2; ++s) {
        x[s] = bench_alloc(size.n_vertices, 3 * sizeof *x[s]);
        (void)icc_domain_get_boundary(domain[s], x[s], faces);
        if (name != NULL)
            write(name, s == 0 ? "src" : "tgt", size.n_vertices, x[s], size.n_facets, faces);
    }
    face_stretch *const face = measure(x[0], x[1], size.n_facets, faces);
    print_energy(face, size.n_facets);
    printf(", overlay %zu, left %zu of %zu, off %.1e, angle %.2g, 1 %% %.2g / %.2g", info.n_overlay,
           size.n_vertices, n_given, info.off, info.least_angle,
           thin_angle(x[0], size.n_facets, faces), thin_angle(x[1], size.n_facets, faces));
    free(face);
    free(x[0]);
    free(x[1]);
    free(faces);
}

static size_t n_vertices_of(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    (void)icc_domain_get_info(domain, &info);
    return info.n_vertices;
}

int main(int argc, char **argv)
{
    obj source, target;
    const bool keep = argc > 1 && strcmp(argv[1], "keep") == 0;
    argc -= keep;
    argv += keep;
    if (argc < 6 || !obj_read(&source, argv[4]) || !obj_read(&target, argv[5]))
        fail("usage: bench_match_surfaces [keep] N_LANDMARKS TOLERANCE SHARE SOURCE.obj TARGET.obj "
             "[OUT]");
    const size_t n = strtoul(argv[1], NULL, 10);
    const char *const slash = strrchr(argv[4], '/');
    const icc_match_options options = {
        .size = sizeof options, .tolerance = strtod(argv[2], NULL), .keep_source = keep};
    if (strtod(argv[3], NULL) < 1)
        thin(&target, strtod(argv[3], NULL));
    double *const pairs = bench_alloc(n + 1, 6 * sizeof *pairs);
    find_landmarks(pairs, n, &source, &target);
    icc_domain *domain[2] = {domain_of(&source), domain_of(&target)};
    face_stretch *const given =
        measure(source.vertices, target.vertices, target.n_faces, target.faces);
    icc_match *match;
    icc_error err = {.size = sizeof err};
    printf("%-3.3s %3zu: ", slash == NULL ? argv[4] : slash + 1, n);
    (void)fflush(stdout);
    const double start = bench_processor_seconds();
    const icc_status status = icc_match_create(&match, domain[0], domain[1], n,
                                               n > 0 ? pairs : NULL, &options, NULL, &err);
    const double seconds = bench_processor_seconds() - start;
    if (status == ICC_OK)
        report(match, argc > 6 ? argv[6] : NULL,
               n_vertices_of(domain[0]) + n_vertices_of(domain[1]));
    else
        printf("%s", err.message);
    printf("; given %.4g; %.2f s\n", mean_of(given, target.n_faces), seconds);
    icc_match_free(match);
    for (int s = 0; s < 2; ++s)
        icc_domain_free(domain[s]);
    free(given);
    free(pairs);
    obj_free(&source);
    obj_free(&target);
    return status == ICC_OK ? 0 : 1;
}
