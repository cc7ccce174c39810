/* Unrelated surfaces drawn with unrelated landmarks: usage: bench_landmark_sets TRIALS FILE.obj ...;
 * 50 trials take seconds, 1000 minutes. Each takes two of the files, the same one twice or not,
 * moves their vertices a little, leaves 30 to 99 of them, and takes 4 to 10 of these at random as
 * landmarks of both. How many are drawn in full: certified, with all landmarks in the same places;
 * what the others say; processor time, in all and the longest. */
#include <icc/icc.h>

#include "../obj.h"
#include "../random.h"
#include "bench.h"
#include "match/sphere/decimate.h"
#include "match/sphere/landmark_sphere.h"
#include "match/sphere/sphere.h"

enum { FEWEST = 30, MOST = 99, MOST_LANDMARKS = 10 };

/* Of the size: how far vertices are moved. */
static const double aside = 0.02;

typedef struct body {
    iccp_half_edges m;
    double x[3 * MOST];
    uint32_t landmark[MOST_LANDMARKS];
} body;

static iccp_env env;

static void check(icc_status status)
{
    if (status == ICC_OK)
        return;
    (void)fprintf(stderr, "not a surface\n");
    exit(EXIT_FAILURE);
}

/* The vertices that are left, and their faces. */
static void gather(body *b, const iccp_half_edges *m, const double *x)
{
    uint32_t *const number = bench_alloc(m->n_vertices, sizeof *number);
    uint32_t faces[6 * MOST], n = 0;
    size_t n_faces = 0;
    for (uint32_t v = 0; v < m->n_vertices; ++v)
        if (m->degree[v] > 0) {
            memcpy(b->x + 3 * (size_t)n, x + 3 * (size_t)v, 3 * sizeof *x);
            number[v] = n++;
        }
    for (uint32_t f = 0; f < m->n_faces; ++f) {
        const uint32_t *const v = m->origin + 3 * (size_t)f;
        if (m->degree[v[0]] == 0 || m->degree[v[1]] == 0 || m->degree[v[2]] == 0)
            continue;
        for (int i = 0; i < 3; ++i)
            faces[3 * n_faces + (size_t)i] = number[v[i]];
        ++n_faces;
    }
    check(iccp_half_edges_create(&b->m, n, n_faces, faces, &env, NULL));
    free(number);
}

static void make_body(body *b, const obj *o, size_t n_landmarks, random_source *r)
{
    iccp_half_edges m;
    double size = 0, *const x = bench_alloc(o->n_vertices, 3 * sizeof *x);
    for (size_t k = 0; k < 3 * o->n_vertices; ++k)
        size = fmax(size, fabs(o->vertices[k]));
    for (size_t k = 0; k < 3 * o->n_vertices; ++k)
        x[k] = o->vertices[k] / size + random_between(r, -aside, aside);
    check(iccp_half_edges_create(&m, o->n_vertices, o->n_faces, o->faces, &env, NULL));
    check(iccp_decimate(&m, x, (size_t)(FEWEST + random_below(r, MOST + 1 - FEWEST)), &env));
    gather(b, &m, x);
    for (size_t k = 0; k < n_landmarks; ++k) {
        size_t before = 0;
        b->landmark[k] = (uint32_t)random_below(r, (int)b->m.n_vertices);
        while (before < k && b->landmark[before] != b->landmark[k])
            ++before;
        k -= before < k; /* once more */
    }
    iccp_half_edges_free(&m);
    free(x);
}

/* Whether all is as it should be; what is not is reported. */
static bool draw(const body b[2], size_t n)
{
    double *directions[2] = {NULL, NULL};
    iccp_half_edges m[2] = {{.memory = env.memory}, {.memory = env.memory}};
    iccp_split_surface split[2] = {{.memory = env.memory}, {.memory = env.memory}};
    icc_error err = {.size = sizeof err};
    icc_status status = iccp_landmark_sphere_draw(
        directions, m, split, (const iccp_half_edges *const[]){&b[0].m, &b[1].m},
        (const double *const[]){b[0].x, b[1].x}, n, n,
        (const uint32_t *const[]){b[0].landmark, b[1].landmark}, &env, &err);
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        status = iccp_sphere_check(&m[side], directions[side], &err);
        for (uint32_t v = 0; v < b[side].m.n_vertices; ++v)
            if (status == ICC_OK && m[side].degree[v] == 0)
                status = ICC_ERR_CERTIFICATE; /* it has not come back */
    }
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        if (memcmp(directions[0] + 3 * (size_t)b[0].landmark[k],
                   directions[1] + 3 * (size_t)b[1].landmark[k], 3 * sizeof(double)) != 0)
            status = ICC_ERR_CERTIFICATE;
    if (status != ICC_OK)
        printf("%s: %s\n", icc_status_name(status), err.message);
    for (int side = 0; side < 2; ++side) {
        iccp_half_edges_free(&m[side]);
        iccp_split_surface_free(&split[side]);
        free(directions[side]);
    }
    return status == ICC_OK;
}

int main(int argc, char **argv)
{
    size_t n_good = 0;
    env.memory = iccp_memory_default;
    double sum = 0, longest = 0;
    const size_t n_trials = argc > 2 ? strtoul(argv[1], NULL, 10) : 0;
    const int n_files = argc - 2;
    if (n_trials == 0) {
        (void)fprintf(stderr, "usage: bench_landmark_sets TRIALS FILE.obj ...\n");
        return EXIT_FAILURE;
    }
    obj *const file = bench_alloc((size_t)n_files, sizeof *file);
    for (int i = 0; i < n_files; ++i)
        if (!obj_read(&file[i], argv[2 + i])) {
            (void)fprintf(stderr, "%s cannot be read\n", argv[2 + i]);
            return EXIT_FAILURE;
        }
    for (size_t trial = 0; trial < n_trials; ++trial) {
        static body b[2];
        random_source r = {trial}; /* so that one of them can be looked at alone */
        const size_t n = 4 + (size_t)random_below(&r, MOST_LANDMARKS - 3);
        for (int side = 0; side < 2; ++side)
            make_body(&b[side], &file[random_below(&r, n_files)], n, &r);
        const double start = bench_processor_seconds();
        const bool is_good = draw((const body *)b, n);
        const double seconds = bench_processor_seconds() - start;
        if (!is_good)
            printf("  in trial %zu: %zu and %zu vertices, %zu landmarks\n", trial,
                   b[0].m.n_vertices, b[1].m.n_vertices, n);
        (void)fflush(stdout);
        n_good += is_good;
        sum += seconds;
        longest = fmax(longest, seconds);
        for (int side = 0; side < 2; ++side)
            iccp_half_edges_free(&b[side].m);
    }
    printf("%zu of %zu drawn in full, %.2f s, one at most %.2f s\n", n_good, n_trials, sum,
           longest);
    for (int i = 0; i < n_files; ++i)
        obj_free(&file[i]);
    free(file);
    return n_good == n_trials ? EXIT_SUCCESS : EXIT_FAILURE;
}
