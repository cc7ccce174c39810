/* What maps of domains with features cost by size: a rough coast with lakes, rivers and towns, drawn
 * again by another hand. Milliseconds of the processor, the least of some runs: the start alone;
 * the whole map; the map of the same outlines without features; and the second as a multiple of
 * the third. */

#include "bench.h"
#include "random.h"

static const double TURN = 6.28318530717958647692;

enum { MOST_FEATURES = 100, MOST_PLACES = 20, RUNS = 5 };

typedef struct scene {
    size_t n_outer, n_features;
    int32_t kind[MOST_FEATURES];
    size_t size[MOST_FEATURES];
    double *vertices[2]; /* the coast's, then the features' */
    icc_domain *domain[2], *bare[2];
} scene;

static void draw_coast(double *xy, size_t n, random_source *r)
{
    for (size_t k = 0; k < n; ++k) {
        const double a = TURN * (double)k / (double)n;
        const double radius =
            1 + 0.3 * sin(3 * a) + 0.1 * sin(11 * a) + 2 * random_unit(r) / (double)n;
        xy[2 * k] = radius * cos(a);
        xy[2 * k + 1] = radius * sin(a);
    }
}

/* On a grid of 10 by 10, so that none meets another. */
static void draw_feature(double *xy, size_t n, size_t cell, random_source *r)
{
    const double x = 0.1 * (double)(cell % 10) - 0.45, y = 0.1 * (double)(cell / 10 % 10) - 0.45;
    for (size_t k = 0; k < n; ++k) {
        const double a = TURN * ((double)k + 0.5 * random_unit(r)) / (double)n;
        xy[2 * k] = x + 0.04 * cos(a);
        xy[2 * k + 1] = y + 0.04 * sin(a);
    }
}

/* The same place on the other drawing: somewhat off, and bent. */
static void bend(double *to, const double *from, const double shift[2])
{
    to[0] = from[0] + 0.1 * sin(2 * from[1]) + shift[0];
    to[1] = from[1] + 0.1 * sin(2 * from[0]) + shift[1];
}

static void draw(scene *s, size_t n_outer, const int counts[3], random_source *r)
{
    const size_t room = n_outer + (size_t)MOST_FEATURES * MOST_PLACES;
    *s = (scene){.n_outer = n_outer};
    for (int side = 0; side < 2; ++side)
        s->vertices[side] = bench_alloc(room, 2 * sizeof(double));
    draw_coast(s->vertices[0], n_outer, r);
    for (size_t k = 0; k < n_outer; ++k)
        bend(s->vertices[1] + 2 * k, s->vertices[0] + 2 * k, (double[]){0, 0});
    size_t first = n_outer;
    for (int32_t kind = ICC_FEATURE_HOLE; kind <= ICC_FEATURE_POINT; ++kind)
        for (int k = 0; k < counts[kind - 1]; ++k) {
            const size_t f = s->n_features++;
            const double shift[2] = {random_between(r, -0.01, 0.01),
                                     random_between(r, -0.01, 0.01)};
            s->kind[f] = kind;
            s->size[f] = kind == ICC_FEATURE_POINT ? 1 : MOST_PLACES;
            draw_feature(s->vertices[0] + 2 * first, s->size[f], 37 * f + 5, r);
            for (size_t i = first; i < first + s->size[f]; ++i)
                bend(s->vertices[1] + 2 * i, s->vertices[0] + 2 * i, shift);
            first += s->size[f];
        }
}

static void make_domains(scene *s)
{
    icc_error error = {.size = sizeof error};
    for (int side = 0; side < 2; ++side) {
        icc_feature features[MOST_FEATURES] = {{0}};
        const double *own = s->vertices[side] + 2 * s->n_outer;
        for (size_t f = 0; f < s->n_features; own += 2 * s->size[f++])
            features[f] = (icc_feature){.size = sizeof *features,
                                        .kind = s->kind[f],
                                        .n_vertices = s->size[f],
                                        .vertices = own};
        bench_check(icc_domain_create_features(&s->domain[side], s->n_outer, s->vertices[side],
                                               s->n_features, features, NULL, &error),
                    &error);
        s->bare[side] = bench_domain(s->n_outer, s->vertices[side]);
    }
}

static double cost(icc_domain *const domain[2], int32_t iterations, icc_map_info *info)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    double least = HUGE_VAL;
    for (int k = 0; k < RUNS; ++k) {
        icc_error error = {.size = sizeof error};
        icc_map *map;
        const double begin = bench_processor_seconds();
        bench_check(icc_map_create(&map, domain[0], domain[1], &options, NULL, &error), &error);
        least = fmin(least, 1e3 * (bench_processor_seconds() - begin));
        *info = (icc_map_info){.size = sizeof *info};
        (void)icc_map_get_info(map, info);
        icc_map_free(map);
    }
    return least;
}

int main(void)
{
    static const struct {
        size_t n;
        int counts[3]; /* lakes, rivers, towns */
    } rows[] = {{20, {0, 0, 20}}, {100, {4, 4, 12}}, {632, {6, 3, 12}}, {3568, {3, 3, 12}}};
    printf("outline lakes rivers towns    start    whole   energy triangles   bare  multiple\n");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        random_source r = {k};
        icc_map_info info, bare;
        scene s;
        draw(&s, rows[k].n, rows[k].counts, &r);
        make_domains(&s);
        const double start = cost(s.domain, -1, &info), whole = cost(s.domain, 0, &info);
        const double without = cost(s.bare, 0, &bare);
        printf("%7zu %5d %6d %5d %8.2f %8.2f %8.3f %9zu %6.2f %9.2f\n", rows[k].n,
               rows[k].counts[0], rows[k].counts[1], rows[k].counts[2], start, whole, info.energy,
               info.n_simplices, without, whole / without);
        for (int side = 0; side < 2; ++side) {
            icc_domain_free(s.domain[side]);
            icc_domain_free(s.bare[side]);
            free(s.vertices[side]);
        }
    }
    return EXIT_SUCCESS;
}
