/* Every operation on every kind of map and chart, however it came about: it works, or it says by
 * name and with a message why not. */
#include "../flat_mesh.h"
#include "../suite.h"

#include <check.h>
#include <icc/stages.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 6, N_POINTS = 7, N_MANY = 1500 };

/* ---- domains ---- */

enum {
    POLYGON,
    RING,
    TRIANGLES,
    PIXELS,
    SURFACE,
    TETRAHEDRA,
    VOXELS,
    PENTATOPE,
    INTERVAL,
    HOLLOW,
    ORGANS,
    FILLED,
    N_SHAPES
};

static const char *const SHAPES[] = {"polygon",
                                     "polygon with facets",
                                     "triangles",
                                     "pixels",
                                     "surface",
                                     "tetrahedra",
                                     "voxels",
                                     "pentatope",
                                     "interval",
                                     "surface with a void",
                                     "solid with features",
                                     "filled solid"};

static const double SQUARE[10] = {0, 0, 8, 0, 8, 8, 4, 8, 0, 8};
static const uint32_t SIDES[10] = {3, 4, 4, 0, 0, 1, 1, 2, 2, 3};
static const uint32_t FAN[9] = {0, 1, 2, 0, 2, 3, 0, 3, 4};
static const double CUBE[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
static const uint32_t FACES[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
static const uint32_t CELLS[24] = {0, 1, 3, 7, 0, 3, 2, 7, 0, 2, 6, 7,
                                   0, 6, 4, 7, 0, 4, 5, 7, 0, 5, 1, 7};
static const double CORNERS[20] = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
/* Facet i faces corner i; every other one is turned round. */
static const uint32_t FACETS[20] = {1, 2, 3, 4, 2, 0, 3, 4, 0, 1, 3, 4, 1, 0, 2, 4, 0, 1, 2, 3};
static const double ENDS[2] = {0, 1};
static const uint32_t END_FACETS[2] = {0, 1};

/* A tetrahedron seen from outside: a void if its faces are turned over. */
static const double TETRAHEDRON[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const uint32_t SEEN[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
static const uint32_t TURNED[12] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};

/* Numbers times a factor, and a little aslant. */
static void bend(double *to, int32_t dim, size_t n, const double *from, double factor)
{
    for (size_t i = 0; i < n; ++i)
        for (int32_t k = 0; k < dim; ++k)
            to[i * (size_t)dim + (size_t)k] =
                factor *
                (from[i * (size_t)dim + (size_t)k] +
                 (factor == 1 ? 0 : 0.1 * from[i * (size_t)dim + (size_t)((k + 1) % dim)]));
}

/* A tetrahedron of a fifth of the cube's size. */
static void place_tetrahedron(double *to, double x, double factor)
{
    double at[12];
    for (int i = 0; i < 12; ++i)
        at[i] = 0.2 * TETRAHEDRON[i] + (i % 3 == 0 ? x : 0.4);
    bend(to, 3, 4, at, factor);
}

static icc_status make_hollow(icc_domain **out, double factor)
{
    double v[36];
    uint32_t faces[48];
    bend(v, 3, 8, CUBE, factor);
    place_tetrahedron(v + 24, 0.4, factor);
    memcpy(faces, FACES, sizeof FACES);
    for (int i = 0; i < 12; ++i)
        faces[36 + i] = 8 + TURNED[i];
    return icc_domain_create(out, 3, 12, v, 16, faces, NULL, NULL);
}

/* A void, a region, a line and a point. */
static icc_status make_organs(icc_domain **out, double factor)
{
    static const double LINE[6] = {0.1, 0.1, 0.1, 0.9, 0.1, 0.2}, POINT[3] = {0.5, 0.9, 0.9};
    double outer[24], hollow[12], organ[12], line[6], point[3];
    bend(outer, 3, 8, CUBE, factor);
    place_tetrahedron(hollow, 0.2, factor);
    place_tetrahedron(organ, 0.6, factor);
    bend(line, 3, 2, LINE, factor);
    bend(point, 3, 1, POINT, factor);
    const size_t size = sizeof(icc_feature);
    const icc_feature features[4] = {{size, ICC_FEATURE_HOLE, 4, hollow, 0, 4, SEEN},
                                     {size, ICC_FEATURE_REGION, 4, organ, 0, 4, TURNED},
                                     {size, ICC_FEATURE_LINE, 2, line, 0, 0, NULL},
                                     {size, ICC_FEATURE_POINT, 1, point, 0, 0, NULL}};
    return icc_domain_create_solid(out, 8, outer, 12, FACES, 4, features, NULL, NULL);
}

/* The shape as it is for factor 1, else what may become of it. */
static icc_domain *make_domain(int shape, double factor)
{
    static const size_t CUBED[3] = {3, 3, 3};
    uint8_t ones[27];
    double v[24];
    icc_domain *d = NULL;
    icc_status status = ICC_OK;
    memset(ones, 1, sizeof ones);
    switch (shape) {
    case POLYGON:
        bend(v, 2, 5, SQUARE, factor);
        status = icc_domain_create(&d, 2, 5, v, 0, NULL, NULL, NULL);
        break;
    case RING:
        bend(v, 2, 5, SQUARE, factor);
        status = icc_domain_create(&d, 2, 5, v, 5, SIDES, NULL, NULL);
        break;
    case TRIANGLES:
        bend(v, 2, 5, SQUARE, factor);
        status = flat_create_mesh(&d, 2, 5, v, 3, FAN, 0, NULL, NULL, NULL);
        break;
    case SURFACE:
        bend(v, 3, 8, CUBE, factor);
        status = icc_domain_create(&d, 3, 8, v, 12, FACES, NULL, NULL);
        break;
    case TETRAHEDRA:
        bend(v, 3, 8, CUBE, factor);
        status = flat_create_mesh(&d, 3, 8, v, 6, CELLS, 0, NULL, NULL, NULL);
        break;
    case PENTATOPE:
        bend(v, 4, 5, CORNERS, factor);
        status = icc_domain_create(&d, 4, 5, v, 5, FACETS, NULL, NULL);
        break;
    case HOLLOW:
        status = make_hollow(&d, factor);
        break;
    case ORGANS:
        status = make_organs(&d, factor);
        break;
    case FILLED: {
        icc_domain *surface;
        ck_assert_int_eq(make_organs(&surface, factor), ICC_OK);
        status = icc_domain_fill(&d, surface, NULL, NULL, NULL);
        icc_domain_free(surface);
        break;
    }
    case INTERVAL:
        bend(v, 1, 2, ENDS, factor);
        status = icc_domain_create(&d, 1, 2, v, 2, END_FACETS, NULL, NULL);
        break;
    default:
        status = icc_domain_create_mask(&d, shape == PIXELS ? 2 : 3, CUBED, ones, NULL, NULL);
    }
    ck_assert_int_eq(status, ICC_OK);
    return d;
}

/* Points spread over the middle of a domain's box. */
static void spread(const icc_domain *domain, size_t n, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    const double low = info.dim < 4 ? 0.2 : 0.1, width = info.dim < 4 ? 0.6 : 0.05;
    for (size_t i = 0; i < n; ++i)
        for (int32_t k = 0; k < info.dim; ++k)
            points[i * (size_t)info.dim + (size_t)k] =
                info.lower[k] + (info.upper[k] - info.lower[k]) *
                                    (low + width * fmod(0.5 + 0.7548776662466927 * (double)i +
                                                            0.3819660112501051 * k,
                                                        1));
}

/* ---- what came about ---- */

/* What a map or chart is and how it was made, for messages. */
typedef struct subject {
    char name[200];
    icc_map *map;     /* or NULL */
    icc_chart *chart; /* or NULL */
    int shape;
    int32_t dim;
} subject;

static size_t n_pairs;

/* OK, or an error that has a name and a message; returns whether it is OK. */
static bool sound(const subject *s, const char *operation, icc_status status, const icc_error *err)
{
    ++n_pairs;
    if (status == ICC_OK)
        return true;
    ck_assert_msg(strcmp(icc_status_name(status), "unknown status") != 0, "%s / %s: status %d",
                  s->name, operation, (int)status);
    ck_assert_msg(err->status == status && err->message[0] != '\0', "%s / %s: %s without a message",
                  s->name, operation, icc_status_name(status));
    ck_assert_msg(status != ICC_ERR_MEMORY && status != ICC_ERR_VERSION &&
                      status != ICC_ERR_CANCELLED,
                  "%s / %s: %s", s->name, operation, err->message);
    return false;
}

static icc_error fresh(void)
{
    return (icc_error){.size = sizeof(icc_error)};
}

/* Of statuses of points and their number: as many as failed, and no number where there is none. */
static void check_points(const subject *s, const char *operation, icc_status called, size_t n,
                         const icc_status *status, size_t n_failed, size_t width,
                         const double *numbers)
{
    size_t n_bad = 0;
    ++n_pairs;
    ck_assert_msg(called == ICC_OK, "%s / %s: %s", s->name, operation, icc_status_name(called));
    for (size_t i = 0; i < n; ++i) {
        n_bad += status[i] != ICC_OK;
        for (size_t k = 0; k < width; ++k)
            ck_assert_msg(isfinite(numbers[i * width + k]) == (status[i] == ICC_OK),
                          "%s / %s: point %zu is %g with status %s", s->name, operation, i,
                          numbers[i * width + k], icc_status_name(status[i]));
    }
    ck_assert_msg(n_bad == n_failed, "%s / %s: %zu of %zu failures reported", s->name, operation,
                  n_failed, n_bad);
}

/* ---- operations on maps ---- */

typedef icc_status point_call(const icc_map *, size_t, const double *, double *, icc_status *,
                              size_t *, const icc_env *);

static void ask_points(const subject *s, const char *name, point_call *call, const double *points,
                       size_t width)
{
    double numbers[N_POINTS * MOST * MOST];
    icc_status status[N_POINTS];
    size_t n_failed = SIZE_MAX;
    icc_status called = call(s->map, N_POINTS, points, numbers, status, &n_failed, NULL);
    check_points(s, name, called, N_POINTS, status, n_failed, width, numbers);
    n_failed = SIZE_MAX;
    called = call(s->map, 0, NULL, NULL, NULL, &n_failed, NULL);
    check_points(s, name, called, 0, status, n_failed, width, numbers);
}

/* In every way that carries points: inside, on a vertex, outside, far away and not finite. */
static void map_points(const subject *s, const icc_domain *source, const icc_domain *target)
{
    static const double ODD[] = {1e300, -1e300, NAN, HUGE_VAL, 0, 1e-300};
    const size_t dim = (size_t)s->dim;
    double points[N_POINTS * MOST];
    for (int inverse = 0; inverse < 2; ++inverse) {
        point_call *const call = inverse ? icc_map_apply_inverse : icc_map_apply;
        const char *name = inverse ? "inverse" : "apply";
        spread(inverse ? target : source, N_POINTS, points);
        ask_points(s, name, call, points, dim);
        if (!inverse)
            ask_points(s, "jacobian", icc_map_jacobian, points, dim * dim);
        for (size_t o = 0; o < sizeof ODD / sizeof *ODD; ++o) {
            for (size_t k = 0; k < N_POINTS * dim; ++k)
                points[k] = k % dim == o % dim ? ODD[o] : 0;
            ask_points(s, name, call, points, dim);
            if (!inverse)
                ask_points(s, "jacobian", icc_map_jacobian, points, dim * dim);
        }
    }
}

static void map_threads(const subject *s, const icc_domain *source)
{
    static double points[N_MANY * MOST], one[N_MANY * MOST], four[N_MANY * MOST];
    const icc_env env = {.size = sizeof env, .threads = 4};
    const size_t n = s->dim < 3 ? N_MANY : 10;
    spread(source, n, points);
    ++n_pairs;
    ck_assert_int_eq(icc_map_apply(s->map, n, points, one, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_apply(s->map, n, points, four, NULL, NULL, &env), ICC_OK);
    ck_assert_msg(memcmp(one, four, n * (size_t)s->dim * sizeof *one) == 0, "%s / threads",
                  s->name);
}

static void map_info(const subject *s)
{
    icc_map_info info = {.size = sizeof info};
    ++n_pairs;
    ck_assert_int_eq(icc_map_get_info(s->map, &info), ICC_OK);
    ck_assert_int_eq(info.dim, s->dim);
    const icc_chart *charts[2] = {icc_map_source_chart(s->map), icc_map_target_chart(s->map)};
    ck_assert_int_eq(charts[0] == NULL, charts[1] == NULL);
    for (int k = 0; k < 2; ++k) {
        icc_chart_info own = {.size = sizeof own};
        ck_assert_int_eq(icc_chart_get_info(charts[k], &own),
                         charts[k] != NULL ? ICC_OK : ICC_ERR_ARGUMENT);
        ck_assert_int_eq(icc_chart_domain(charts[k]) == NULL, charts[k] == NULL);
    }
    double *vertices = malloc((info.n_vertices + 1) * MOST * sizeof *vertices);
    double *images = malloc((info.n_vertices + 1) * MOST * sizeof *images);
    uint32_t *corners = malloc((info.n_simplices + 1) * (MOST + 1) * sizeof *corners);
    const icc_status status = flat_get_mesh(s->map, vertices, images, corners);
    ck_assert_msg(status == (info.kind == ICC_MAP_MESH ? ICC_OK : ICC_ERR_UNSUPPORTED), "%s / mesh",
                  s->name);
    for (size_t k = 0; status == ICC_OK && k < info.n_simplices * (size_t)(s->dim + 1); ++k)
        ck_assert_uint_lt(corners[k], info.n_vertices);
    ck_assert_int_eq(flat_get_mesh(s->map, NULL, NULL, NULL), status);
    free(vertices);
    free(images);
    free(corners);
}

/* A simplex in the middle. */
static void map_certify(const subject *s, const icc_domain *source)
{
    static const uint32_t SIMPLEX[MOST + 1] = {0, 1, 2, 3, 4, 5, 6};
    double vertices[(MOST + 1) * MOST], images[(MOST + 1) * MOST];
    icc_error err = fresh();
    icc_certificate c = {.size = sizeof c};
    const size_t n = (size_t)s->dim + 1;
    spread(source, n, vertices);
    icc_status status = flat_certify(s->map, n, vertices, 1, SIMPLEX, images, &c, NULL, &err);
    ck_assert_msg(sound(s, "certify", status, &err) == (s->dim == 2 || s->dim == 3), "%s / certify",
                  s->name);
    err = fresh();
    status = flat_repair(s->map, n, vertices, 1, SIMPLEX, images, &c, NULL, &err);
    ck_assert_msg(sound(s, "repair", status, &err) == (s->dim == 2 || s->dim == 3), "%s / repair",
                  s->name);
}

static void map_warp(const subject *s)
{
    uint8_t from[64 * 3], to[64 * 3];
    uint16_t deep[2] = {7, 7};
    size_t n_failed;
    icc_error err = fresh();
    for (size_t k = 0; k < sizeof from; ++k)
        from[k] = (uint8_t)(k * 37);
    memset(to, 0, sizeof to);
    icc_picture a = {.size = sizeof a,
                     .width = 8,
                     .height = 8,
                     .channels = 3,
                     .bytes = 1,
                     .stride = 24,
                     .pixels = from};
    icc_picture b = a;
    b.pixels = to;
    icc_status status = icc_map_warp(s->map, &a, &b, &n_failed, NULL, &err);
    ck_assert_msg(sound(s, "warp", status, &err) == (s->dim == 2), "%s / warp", s->name);
    a = (icc_picture){.size = sizeof a,
                      .width = 1,
                      .height = 1,
                      .channels = 1,
                      .bytes = 2,
                      .stride = 2,
                      .pixels = deep};
    b = a;
    b.pixels = deep + 1;
    err = fresh();
    status = icc_map_warp(s->map, &a, &b, NULL, NULL, &err);
    ck_assert_msg(sound(s, "warp a pixel", status, &err) == (s->dim == 2), "%s / warp", s->name);
}

static icc_map *reloaded(const subject *s, const icc_map *map)
{
    size_t n = 0;
    icc_map *again;
    icc_error err = fresh();
    ck_assert_int_eq(icc_map_save(map, 0, NULL, &n), ICC_OK);
    void *data = malloc(n);
    ck_assert_int_eq(icc_map_save(map, n, data, &n), ICC_OK);
    const icc_status status = icc_map_load(&again, n, data, NULL, &err);
    free(data);
    ck_assert_msg(sound(s, "load", status, &err), "%s / load: %s", s->name, err.message);
    return again;
}

static void map_save(const subject *s, const icc_domain *source)
{
    double points[N_POINTS * MOST], one[N_POINTS * MOST], two[N_POINTS * MOST];
    icc_map *again = reloaded(s, s->map);
    spread(source, N_POINTS, points);
    ck_assert_int_eq(icc_map_apply(s->map, N_POINTS, points, one, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_apply(again, N_POINTS, points, two, NULL, NULL, NULL), ICC_OK);
    ck_assert_msg(memcmp(one, two, N_POINTS * (size_t)s->dim * sizeof *one) == 0, "%s / save",
                  s->name);
    icc_map_free(again);
}

/* What makes a map of a map; NULL where that is refused. */
static icc_map *derived(const subject *s, char how, const icc_domain *target)
{
    icc_error err = fresh();
    icc_map *map = NULL;
    if (how == 's')
        return reloaded(s, s->map);
    if (how == 'f') {
        (void)sound(s, "retarget",
                    icc_map_retarget(&map, s->map, target,
                                     &(icc_retarget_options){.size = sizeof(icc_retarget_options),
                                                             .iterations = 2},
                                     NULL, &err),
                    &err);
        return map;
    }
    const icc_improve_options options = {.size = sizeof options, .iterations = 2, .levels = 1};
    icc_improve_report report = {.size = sizeof report};
    (void)sound(s, "improve", icc_map_improve(&map, s->map, &options, &report, NULL, &err), &err);
    return map;
}

static void ask_map(const subject *s)
{
    icc_domain *source = make_domain(s->shape, 1), *target = make_domain(s->shape, 0.9);
    map_info(s);
    map_points(s, source, target);
    map_threads(s, source);
    map_certify(s, source);
    map_warp(s);
    map_save(s, source);
    icc_map_free(derived(s, 'i', target));
    icc_map_free(derived(s, 'f', target));
    icc_domain_free(source);
    icc_domain_free(target);
}

/* The map, and what follows from it step by step: i improved, f retargeted, s saved and loaded.
 * Only meshes have more than the first two; ask_map() sees the others refuse. */
static void ask_family(const subject *first)
{
    static const char *const WAYS[] = {"", "s", "i", "f", "ff", "fi", "fs", "si", "sf", "fsif"};
    icc_domain *target = make_domain(first->shape, 0.85);
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(first->map, &info), ICC_OK);
    const size_t n = info.kind == ICC_MAP_MESH ? sizeof WAYS / sizeof *WAYS : 2;
    for (size_t w = 0; w < n; ++w) {
        subject s = *first;
        for (const char *how = WAYS[w]; *how != '\0' && s.map != NULL; ++how) {
            icc_map *next = derived(&s, *how, target);
            if (s.map != first->map)
                icc_map_free(s.map);
            s.map = next;
            (void)snprintf(s.name, sizeof s.name, "%.150s, then %.*s", first->name,
                           (int)(how - WAYS[w]) + 1, WAYS[w]);
        }
        if (s.map != NULL)
            ask_map(&s);
        if (s.map != first->map)
            icc_map_free(s.map);
    }
    icc_domain_free(target);
}

/* ---- operations on charts ---- */

static void chart_function(const subject *s)
{
    const icc_function *field = icc_chart_function(s->chart);
    icc_error err = fresh();
    icc_function_info info = {.size = sizeof info};
    icc_function_report report = {.size = sizeof report};
    size_t n_edges = 0;
    icc_chart_info chart = {.size = sizeof chart};
    ++n_pairs;
    /* Charts of the two methods that follow a function have it, others none. */
    ck_assert_int_eq(icc_chart_get_info(s->chart, &chart), ICC_OK);
    ck_assert_int_eq(field != NULL,
                     chart.method == ICC_METHOD_GRADIENT || chart.method == ICC_METHOD_FIELD);
    ck_assert_int_eq(icc_function_get_info(field, &info),
                     field != NULL ? ICC_OK : ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_values(field) == NULL, field == NULL);
    ck_assert_int_eq(icc_function_tree(field) == NULL, field == NULL);
    ck_assert_int_eq(icc_tree_grid(icc_function_tree(field)) == NULL, field == NULL);
    ck_assert_int_eq(icc_tree_root(icc_function_tree(field)) == UINT32_MAX, field == NULL);
    (void)icc_function_logs(field);
    ck_assert_int_eq(sound(s, "verify", icc_function_get_report(field, &report, NULL, &err), &err),
                     field != NULL);
    const icc_status status = icc_function_get_edges(field, 0, NULL, NULL, &n_edges, NULL);
    ck_assert_int_eq(status, field == NULL ? ICC_ERR_ARGUMENT
                             : s->dim == 2 ? ICC_OK
                                           : ICC_ERR_UNSUPPORTED);
    icc_facet_report facets = {.size = sizeof facets};
    ck_assert_int_eq(sound(s, "facets",
                           icc_function_get_facets(field, 0, NULL, NULL, &facets, NULL, &err),
                           &err),
                     field != NULL);
    ck_assert(status != ICC_OK || facets.n_compression + facets.n_expansion == n_edges);
}

static void chart_points(const subject *s, const icc_domain *domain)
{
    const size_t dim = (size_t)s->dim;
    double points[N_POINTS * MOST], bary[N_POINTS * MOST], t[N_POINTS], back[N_POINTS * MOST];
    uint32_t facet[N_POINTS];
    icc_status status[N_POINTS];
    for (int odd = 0; odd < 3; ++odd) {
        size_t n_failed = SIZE_MAX, n_curve = SIZE_MAX;
        icc_error err = fresh();
        spread(domain, N_POINTS, points);
        for (size_t k = 0; odd > 0 && k < N_POINTS * dim; k += dim)
            points[k] = odd == 1 ? NAN : 1e300;
        icc_status called =
            icc_chart_encode(s->chart, N_POINTS, points, facet, bary, t, status, &n_failed, NULL);
        check_points(s, "encode", called, N_POINTS, status, n_failed, dim, bary);
        called =
            icc_chart_decode(s->chart, N_POINTS, facet, bary, t, back, status, &n_failed, NULL);
        check_points(s, "decode", called, N_POINTS, status, n_failed, dim, back);
        (void)sound(s, "trace", icc_chart_trace(s->chart, points, 0, NULL, &n_curve, NULL, &err),
                    &err);
    }
    for (size_t i = 0; i < N_POINTS; ++i) {
        facet[i] = i == 6 ? 1u << 30 : 0;
        t[i] = i < 3 ? 0.5 * (double)i : i == 3 ? NAN : i == 4 ? 2 : 0.3;
        for (size_t k = 0; k < dim; ++k)
            bary[i * dim + k] = i == 5 ? -1 : 1.0 / (double)dim;
    }
    size_t n_failed = SIZE_MAX;
    const icc_status called =
        icc_chart_decode(s->chart, N_POINTS, facet, bary, t, back, status, &n_failed, NULL);
    check_points(s, "decode odd numbers", called, N_POINTS, status, n_failed, dim, back);
    ck_assert_int_eq(status[0], ICC_OK);
    ck_assert_int_eq(status[2], ICC_OK);
    for (size_t i = 3; i < N_POINTS; ++i)
        ck_assert_int_eq(status[i], ICC_ERR_ARGUMENT);
}

/* Each chart has what its method has, and nothing else. */
static void chart_infos(const subject *s, const icc_chart_info *info)
{
    icc_gradient_info gradient = {.size = sizeof gradient};
    icc_field_info field = {.size = sizeof field};
    icc_foliation_info foliation = {.size = sizeof foliation};
    icc_shelling_info shelling = {.size = sizeof shelling};
    icc_disc_info disc = {.size = sizeof disc};
    const struct {
        icc_status status;
        int32_t method;
    } found[] = {{icc_chart_get_gradient_info(s->chart, &gradient), ICC_METHOD_GRADIENT},
                 {icc_chart_get_field_info(s->chart, &field), ICC_METHOD_FIELD},
                 {icc_chart_get_foliation_info(s->chart, &foliation), ICC_METHOD_FOLIATION},
                 {icc_chart_get_shelling_info(s->chart, &shelling), ICC_METHOD_FOLIATION},
                 {icc_chart_get_disc_info(s->chart, &disc), ICC_METHOD_DISC}};
    int n = 0;
    for (size_t k = 0; k < sizeof found / sizeof *found; ++k) {
        ++n_pairs;
        ck_assert(found[k].status == ICC_OK || found[k].status == ICC_ERR_UNSUPPORTED);
        ck_assert(found[k].status != ICC_OK || found[k].method == info->method);
        n += found[k].status == ICC_OK;
    }
    ck_assert_int_eq(n, 1);
    ck_assert(s->dim == 2 || foliation.n_mesh_vertices == 0);
}

static void ask_chart(const subject *s)
{
    icc_domain *domain = make_domain(s->shape, 1);
    icc_chart_info info = {.size = sizeof info};
    icc_chart_report measures = {.size = sizeof measures};
    icc_error err = fresh();
    ++n_pairs;
    ck_assert_int_eq(icc_chart_get_info(s->chart, &info), ICC_OK);
    ck_assert_int_eq(info.dim, s->dim);
    chart_infos(s, &info);
    ck_assert_ptr_nonnull(icc_chart_domain(s->chart));
    ck_assert(sound(s, "measure", icc_chart_get_report(s->chart, 50, &measures, NULL, &err), &err));
    chart_function(s);
    chart_points(s, domain);
    icc_domain_free(domain);
}

static icc_chart *reloaded_chart(const subject *s)
{
    size_t n = 0;
    icc_chart *again;
    icc_error err = fresh();
    ck_assert_int_eq(icc_chart_save(s->chart, 0, NULL, &n), ICC_OK);
    void *data = malloc(n);
    ck_assert_int_eq(icc_chart_save(s->chart, n, data, &n), ICC_OK);
    const icc_status status = icc_chart_load(&again, n, data, NULL, &err);
    free(data);
    ck_assert_msg(sound(s, "load", status, &err), "%s / load: %s", s->name, err.message);
    return again;
}

/* ---- makers ---- */

/* Only options of the method's own are set, so that a refusal is about the method and the shape. */
static icc_chart_options chart_options(int32_t method, int32_t dim, const double *maximum)
{
    return (icc_chart_options){.size = sizeof(icc_chart_options),
                               .method = method,
                               .cells = dim < 3   ? 8
                                        : dim < 4 ? 6
                                                  : 4,
                               .maximum = maximum};
}

static int32_t dimension(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    return info.dim;
}

static void maps_of(int shape, int32_t method, int32_t kind, bool given)
{
    icc_domain *source = make_domain(shape, 1), *target = make_domain(shape, 0.95);
    subject s = {.shape = shape, .dim = dimension(source)};
    double maxima[2][MOST];
    icc_error err = fresh();
    spread(source, 1, maxima[0]);
    spread(target, 1, maxima[1]);
    const icc_chart_options chart = chart_options(method, s.dim, given ? maxima[0] : NULL);
    const icc_map_options options = {.size = sizeof options,
                                     .kind = kind,
                                     .iterations = 2,
                                     .chart = &chart,
                                     .target_maximum = given ? maxima[1] : NULL};
    (void)snprintf(s.name, sizeof s.name, "%s, method %d, kind %d%s", SHAPES[shape], (int)method,
                   (int)kind, given ? ", maxima given" : "");
    const icc_status status = icc_map_create(&s.map, source, target, &options, NULL, &err);
    icc_domain_free(source);
    icc_domain_free(target);
    if (sound(&s, "create", status, &err))
        ask_family(&s);
    icc_map_free(s.map);
}

/* From charts that were made alone; saved and loaded ones are as good. */
static void maps_of_charts(const subject *source, const icc_chart *target)
{
    for (int32_t kind = 0; kind <= ICC_MAP_MESH; ++kind) {
        const icc_map_options options = {.size = sizeof options, .kind = kind, .iterations = 2};
        icc_error err = fresh();
        subject s = *source;
        s.chart = NULL;
        (void)snprintf(s.name, sizeof s.name, "map kind %d from charts: %.150s", (int)kind,
                       source->name);
        if (sound(&s, "create",
                  icc_map_create_from_charts(&s.map, source->chart, target, &options, NULL, &err),
                  &err))
            ask_map(&s);
        icc_map_free(s.map);
    }
}

static void charts_of(int shape, int32_t method, bool given)
{
    icc_domain *domains[2] = {make_domain(shape, 1), make_domain(shape, 0.9)};
    subject s = {.shape = shape, .dim = dimension(domains[0])};
    icc_chart *charts[2] = {NULL, NULL};
    (void)snprintf(s.name, sizeof s.name, "chart of %s, method %d%s", SHAPES[shape], (int)method,
                   given ? ", maximum given" : "");
    for (int k = 0; k < 2; ++k) {
        double maximum[MOST];
        icc_error err = fresh();
        spread(domains[k], 1, maximum);
        const icc_chart_options options = chart_options(method, s.dim, given ? maximum : NULL);
        (void)sound(&s, "create", icc_chart_create(&charts[k], domains[k], &options, NULL, &err),
                    &err);
        icc_domain_free(domains[k]);
    }
    ck_assert_int_eq(charts[0] == NULL, charts[1] == NULL);
    if (charts[0] != NULL) {
        s.chart = charts[0];
        ask_chart(&s);
        maps_of_charts(&s, charts[1]);
        s.chart = reloaded_chart(&s);
        (void)strcat(s.name, ", loaded");
        ask_chart(&s);
        maps_of_charts(&s, s.chart);
        icc_chart_free(s.chart);
    }
    icc_chart_free(charts[0]);
    icc_chart_free(charts[1]);
}

START_TEST(every_operation_on_every_map)
{
    for (int32_t method = 0; method <= ICC_METHOD_DISC; ++method)
        for (int32_t kind = 0; kind <= ICC_MAP_MESH; ++kind)
            for (int given = 0; given < (_i == PENTATOPE ? 1 : 2); ++given)
                maps_of(_i, method, kind, given);
    ck_assert_uint_gt(n_pairs, 20);
}
END_TEST

/* A map follows its target to any size, whatever it comes from. */
START_TEST(retargeted_to_every_size)
{
    static const double SIZES[] = {1, 1e-200, 1e200, 1e200, 1, 3e14, 3e16, 3e-16, 1e280, 1e-280};
    subject s = {.shape = _i};
    icc_domain *source = make_domain(_i, 1);
    icc_map *before = NULL;
    s.dim = dimension(source);
    for (size_t k = 0; k < sizeof SIZES / sizeof *SIZES; ++k) {
        icc_domain *target = make_domain(_i, SIZES[k]);
        icc_map_info info = {.size = sizeof info};
        icc_error err = fresh();
        const icc_status status =
            k == 0 ? icc_map_create(&s.map, source, target, NULL, NULL, &err)
                   : icc_map_retarget(&s.map, before, target,
                                      &(icc_retarget_options){.size = sizeof(icc_retarget_options),
                                                              .iterations = 2},
                                      NULL, &err);
        (void)snprintf(s.name, sizeof s.name, "%s retargeted to size %g", SHAPES[_i], SIZES[k]);
        ck_assert_msg(status == ICC_OK, "%s: %s", s.name, err.message);
        ck_assert_int_eq(icc_map_get_info(s.map, &info), ICC_OK);
        ck_assert_msg(info.certified == 1, "%s: not certified", s.name);
        map_points(&s, source, target);
        icc_map_free(before);
        icc_domain_free(target);
        before = s.map;
    }
    icc_map_free(before);
    icc_domain_free(source);
}
END_TEST

START_TEST(every_operation_on_every_chart)
{
    for (int32_t method = 0; method <= ICC_METHOD_DISC; ++method)
        for (int given = 0; given < (_i == PENTATOPE ? 1 : 2); ++given)
            charts_of(_i, method, given);
    ck_assert_uint_ge(n_pairs, 20);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("matrix");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_loop_test(tests, every_operation_on_every_map, 0, N_SHAPES);
    tcase_add_loop_test(tests, retargeted_to_every_size, POLYGON, RING + 1);
    tcase_add_loop_test(tests, retargeted_to_every_size, SURFACE, TETRAHEDRA + 1);
    tcase_add_loop_test(tests, every_operation_on_every_chart, 0, N_SHAPES);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
