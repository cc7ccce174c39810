/* One object of each kind, and calls of every function that may fail, for tests that put all of
 * them through the same treatment. */
#ifndef TESTS_API_OBJECTS_H
#define TESTS_API_OBJECTS_H

#include "../flat_mesh.h"
#include <check.h>
#include <icc/fit.h>
#include <icc/kernel.h>
#include <icc/stages.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N_CORNERS = 6, N_POINTS = 400 };

/* An L and what it becomes. */
static const double SOURCE[2 * N_CORNERS] = {0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3};
static const double TARGET[2 * N_CORNERS] = {0, 0, 4, 0.5, 3.5, 2, 2, 2, 1.5, 3, -0.5, 3.5};
/* A ring that crosses itself. */
static const double BOWTIE[8] = {0, 0, 2, 2, 2, 0, 0, 1};
static const uint32_t FACETS[2 * N_CORNERS] = {0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 0};

/* In the L. */
enum { N_HANDLES = 4 };
static const double HANDLES[2 * N_HANDLES] = {0.1, 0.1, 2.9, 0.2, 2.9, 0.9, 0.2, 2.9};

static const int32_t METHODS[] = {ICC_METHOD_GRADIENT, ICC_METHOD_FOLIATION, ICC_METHOD_FIELD,
                                  ICC_METHOD_DISC};
enum { N_METHODS = sizeof METHODS / sizeof *METHODS };

typedef struct objects {
    icc_chart_options options;
    icc_domain *source, *target;
    icc_chart *chart, *target_chart;
    icc_map *map;
    icc_map *mesh_map; /* of kind mesh, whatever the method, coarse and not yet improved */
    icc_grid *grid, *mask;
    icc_tree *tree;
    icc_tree *bent; /* on an L, where the inequalities of functions matter */
    icc_tree *cut;  /* in a grid whose edges the source's boundary cuts */
    icc_function *field;
    icc_shape *shape; /* the source, and a curve */
    icc_sampling *sampling;
    icc_weights *kernel;
    icc_binding *binding;        /* of half the points, with derivatives */
    double points[2 * N_POINTS]; /* in the source */
    uint32_t facet[N_POINTS];
    double bary[2 * N_POINTS], t[N_POINTS];
} objects;

static inline icc_map *make_mesh_map(const objects *o)
{
    const icc_chart_options chart = {.size = sizeof chart, .cells = 6};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_MESH, .iterations = -1, .chart = &chart};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, o->source, o->target, &options, NULL, NULL), ICC_OK);
    return map;
}

static inline icc_tree *make_bent_tree(void)
{
    static const size_t SHAPE[2] = {17, 17};
    uint8_t inside[17 * 17];
    icc_grid *grid;
    icc_tree *tree;
    uint32_t root;
    for (size_t v = 0; v < sizeof inside; ++v)
        inside[v] =
            v % 17 > 1 && v % 17 < 15 && v / 17 > 1 && v / 17 < 15 && (v % 17 < 7 || v / 17 < 7);
    ck_assert_int_eq(icc_grid_create_mask(&grid, 2, SHAPE, inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
    return tree;
}

static inline icc_tree *make_cut_tree(const icc_domain *source)
{
    icc_grid *grid;
    icc_tree *tree;
    uint32_t root;
    ck_assert_int_eq(icc_grid_create(&grid, source, 11, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
    return tree;
}

static inline icc_status make_shape(const objects *o, icc_shape **shape, const icc_env *env,
                                    icc_error *err)
{
    static const double VERTICES[6] = {0.5, 0.5, 4, 0.5, 4, 2};
    static const uint32_t SEGMENTS[4] = {0, 1, 1, 2};
    const icc_domain *regions[1] = {o->source};
    return icc_shape_create(shape, 2, 1, regions, 3, VERTICES, 2, SEGMENTS, env, err);
}

static inline icc_status make_sampling(const objects *o, icc_sampling **sampling,
                                       const icc_env *env, icc_error *err)
{
    const icc_sampling_options options = {.size = sizeof options, .spacing = 0.25, .steps = 5};
    return icc_sampling_create(sampling, o->shape, &options, env, err);
}

static inline icc_status make_kernel(const objects *o, icc_weights **kernel, const icc_env *env,
                                     icc_error *err)
{
    static const uint32_t EDGES[4] = {0, 1, 1, 2};
    const icc_line line = {.from = {0.3, 0.4}, .to = {1.5, 0.4}};
    const icc_weights_options options = {
        .size = sizeof options, .n_edges = 2, .edges = EDGES, .n_lines = 1, .lines = &line};
    return icc_weights_create(kernel, o->sampling, N_HANDLES, HANDLES, &options, env, err);
}

/* After the points. */
static inline void make_coordinates(objects *o)
{
    ck_assert_int_eq(make_shape(o, &o->shape, NULL, NULL), ICC_OK);
    ck_assert_int_eq(make_sampling(o, &o->sampling, NULL, NULL), ICC_OK);
    ck_assert_int_eq(make_kernel(o, &o->kernel, NULL, NULL), ICC_OK);
    ck_assert_int_eq(
        icc_binding_create(&o->binding, o->kernel, N_POINTS / 2, o->points, 1, NULL, NULL), ICC_OK);
}

/* With charts of the given method; 0: the default. */
static inline void objects_init(objects *o, int32_t method)
{
    o->options = (icc_chart_options){.size = sizeof o->options, .method = method};
    static const size_t SHAPE[3] = {5, 5, 5};
    uint8_t inside[125];
    memset(inside, 1, sizeof inside);
    ck_assert_int_eq(icc_domain_create(&o->source, 2, N_CORNERS, SOURCE, 0, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_domain_create(&o->target, 2, N_CORNERS, TARGET, 0, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_chart_create(&o->chart, o->source, &o->options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_create(&o->target_chart, o->target, &o->options, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(
        icc_map_create_from_charts(&o->map, o->chart, o->target_chart, NULL, NULL, NULL), ICC_OK);
    o->mesh_map = make_mesh_map(o);
    ck_assert_int_eq(icc_grid_create(&o->grid, o->source, 0, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_create_mask(&o->mask, 3, SHAPE, inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&o->tree, o->mask, 62, NULL, NULL, NULL), ICC_OK);
    o->bent = make_bent_tree();
    o->cut = make_cut_tree(o->source);
    ck_assert_int_eq(icc_function_create(&o->field, o->tree, NULL, NULL, NULL), ICC_OK);
    for (size_t i = 0; i < N_POINTS; ++i) {
        const double a = fmod(0.5 + 0.7548776662466927 * (double)i, 1);
        const double b = fmod(0.5 + 0.5698402909980532 * (double)i, 1);
        o->points[2 * i] = i % 2 ? 3 * a : a;
        o->points[2 * i + 1] = i % 2 ? b : 3 * b;
    }
    ck_assert_int_eq(
        icc_chart_encode(o->chart, N_POINTS, o->points, o->facet, o->bary, o->t, NULL, NULL, NULL),
        ICC_OK);
    make_coordinates(o);
}

static inline void objects_clear(objects *o)
{
    icc_binding_free(o->binding);
    icc_weights_free(o->kernel);
    icc_sampling_free(o->sampling);
    icc_shape_free(o->shape);
    icc_function_free(o->field);
    icc_tree_free(o->tree);
    icc_tree_free(o->bent);
    icc_tree_free(o->cut);
    icc_grid_free(o->mask);
    icc_grid_free(o->grid);
    icc_map_free(o->map);
    icc_map_free(o->mesh_map);
    icc_chart_free(o->chart);
    icc_chart_free(o->target_chart);
    icc_domain_free(o->source);
    icc_domain_free(o->target);
}

/* What a call computed, as bytes to compare. */
typedef struct outcome {
    double numbers[4 * N_POINTS];
    uint32_t indices[3 * N_POINTS];
    icc_status status[N_POINTS];
    size_t count;
} outcome;

/* A call on the objects. A creator frees what it made and writes what tells it apart. */
typedef struct call {
    const char *name;
    icc_status (*run)(const objects *o, outcome *out, const icc_env *env, icc_error *err);
} call;

/* Checks that a creator hands over an object if and only if it succeeds. */
#define HANDED_OVER(status, object) ck_assert_int_eq((status) == ICC_OK, (object) != NULL)

static inline icc_status call_domain_create(const objects *o, outcome *out, const icc_env *env,
                                            icc_error *err)
{
    (void)o;
    icc_domain *domain = (icc_domain *)&domain;
    const icc_status status =
        icc_domain_create(&domain, 2, N_CORNERS, SOURCE, N_CORNERS, FACETS, env, err);
    HANDED_OVER(status, domain);
    if (status == ICC_OK)
        (void)icc_domain_get_boundary(domain, out->numbers, out->indices);
    icc_domain_free(domain);
    return status;
}

static inline icc_status call_domain_locate(const objects *o, outcome *out, const icc_env *env,
                                            icc_error *err)
{
    (void)err;
    return icc_domain_locate(o->source, N_POINTS, o->points, out->status, out->indices,
                             out->numbers, env);
}

static inline icc_status call_boundary_defects(const objects *o, outcome *out, const icc_env *env,
                                               icc_error *err)
{
    (void)o;
    return icc_boundary_defects(4, BOWTIE, N_POINTS, out->status, out->indices, &out->count, env,
                                err);
}

/* What a chart says of itself; NULL says nothing. */
static inline void note_chart(outcome *out, const icc_chart *chart)
{
    icc_chart_info info = {.size = sizeof info};
    icc_gradient_info gradient = {.size = sizeof gradient};
    icc_foliation_info foliation = {.size = sizeof foliation};
    (void)icc_chart_get_info(chart, &info);
    (void)icc_chart_get_gradient_info(chart, &gradient);
    (void)icc_chart_get_foliation_info(chart, &foliation);
    out->count = gradient.n_tree + foliation.n_mesh_simplices;
    memcpy(out->numbers, info.maximum, sizeof info.maximum);
}

static inline icc_status call_chart_create(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    icc_chart *chart = (icc_chart *)&chart;
    const icc_status status = icc_chart_create(&chart, o->source, &o->options, env, err);
    HANDED_OVER(status, chart);
    note_chart(out, chart);
    icc_chart_free(chart);
    return status;
}

static inline icc_status call_chart_create_function(const objects *o, outcome *out,
                                                    const icc_env *env, icc_error *err)
{
    icc_chart *chart = (icc_chart *)&chart;
    icc_function *function;
    ck_assert_int_eq(icc_function_create(&function, o->cut, NULL, NULL, NULL), ICC_OK);
    const icc_status status = icc_chart_create_function(&chart, function, env, err);
    HANDED_OVER(status, chart);
    icc_function_free(function);
    note_chart(out, chart);
    icc_chart_free(chart);
    return status;
}

static inline icc_status call_chart_measure(const objects *o, outcome *out, const icc_env *env,
                                            icc_error *err)
{
    icc_chart_report m = {.size = sizeof m};
    const icc_status status = icc_chart_get_report(o->chart, 3000, &m, env, err);
    memcpy(out->numbers, &m, sizeof m);
    return status;
}

static inline icc_status call_chart_encode(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    (void)err;
    return icc_chart_encode(o->chart, N_POINTS, o->points, out->indices, out->numbers,
                            out->numbers + 2 * N_POINTS, out->status, &out->count, env);
}

static inline icc_status call_chart_decode(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    (void)err;
    return icc_chart_decode(o->chart, N_POINTS, o->facet, o->bary, o->t, out->numbers, out->status,
                            &out->count, env);
}

static inline icc_status call_chart_encode_flags(const objects *o, outcome *out, const icc_env *env,
                                                 icc_error *err)
{
    (void)err;
    int32_t flags[N_POINTS];
    const icc_status status =
        icc_chart_encode_flags(o->chart, N_POINTS, o->points, out->indices, out->numbers,
                               out->numbers + 2 * N_POINTS, out->status, flags, &out->count, env);
    for (size_t i = 0; status == ICC_OK && i < N_POINTS; ++i)
        out->indices[i] += (uint32_t)flags[i];
    return status;
}

static inline icc_status call_chart_decode_flags(const objects *o, outcome *out, const icc_env *env,
                                                 icc_error *err)
{
    (void)err;
    int32_t flags[N_POINTS];
    const icc_status status =
        icc_chart_decode_flags(o->chart, N_POINTS, o->facet, o->bary, o->t, out->numbers,
                               out->status, flags, &out->count, env);
    for (size_t i = 0; status == ICC_OK && i < N_POINTS; ++i)
        out->indices[i] = (uint32_t)flags[i];
    return status;
}

static inline icc_status call_chart_trace(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    return icc_chart_trace(o->chart, o->points, N_POINTS, out->numbers, &out->count, env, err);
}

/* Some memory is allocated for the object only when it is first used. What that call reports counts
 * for the one that made the object. */
static inline icc_status note_later(icc_status status, icc_error *err)
{
    if (status != ICC_OK && err != NULL) {
        err->status = status;
        strcpy(err->message, "when it was used");
    }
    return status;
}

static inline icc_status use_map(const objects *o, const icc_map *map, outcome *out, icc_error *err)
{
    return note_later(
        icc_map_apply(map, N_POINTS, o->points, out->numbers, out->status, &out->count, NULL), err);
}

static inline icc_status call_map_create(const objects *o, outcome *out, const icc_env *env,
                                         icc_error *err)
{
    icc_map *map = (icc_map *)&map;
    const icc_map_options options = {.size = sizeof options, .chart = &o->options};
    icc_status status = icc_map_create(&map, o->source, o->target, &options, env, err);
    HANDED_OVER(status, map);
    if (status == ICC_OK)
        status = use_map(o, map, out, err);
    icc_map_free(map);
    return status;
}

static inline icc_status call_map_create_polygons(const objects *o, outcome *out,
                                                  const icc_env *env, icc_error *err)
{
    static const double BEFORE[] = {0, 0, 4, 0, 4, 4, 0, 4}, AFTER[] = {0, 0, 4, 0, 6, 3, 0, 4};
    icc_map *map = (icc_map *)&map;
    icc_status status = icc_map_create_polygons(&map, 4, BEFORE, AFTER, env, err);
    HANDED_OVER(status, map);
    if (status == ICC_OK)
        status = use_map(o, map, out, err);
    icc_map_free(map);
    return status;
}

static inline icc_status call_map_create_from_charts(const objects *o, outcome *out,
                                                     const icc_env *env, icc_error *err)
{
    icc_map *map = (icc_map *)&map;
    icc_status status = icc_map_create_from_charts(&map, o->chart, o->target_chart, NULL, env, err);
    HANDED_OVER(status, map);
    if (status == ICC_OK)
        status = use_map(o, map, out, err);
    icc_map_free(map);
    return status;
}

static inline icc_status call_map_apply(const objects *o, outcome *out, const icc_env *env,
                                        icc_error *err)
{
    (void)err;
    return icc_map_apply(o->map, N_POINTS, o->points, out->numbers, out->status, &out->count, env);
}

static inline icc_status call_map_apply_inverse(const objects *o, outcome *out, const icc_env *env,
                                                icc_error *err)
{
    (void)err;
    return icc_map_apply_inverse(o->map, N_POINTS, o->points, out->numbers, out->status,
                                 &out->count, env);
}

static inline icc_status call_map_jacobian(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    (void)err;
    return icc_map_jacobian(o->map, N_POINTS, o->points, out->numbers, out->status, &out->count,
                            env);
}

/* Cancelled, it succeeds with what it has; the tests are given what those of other calls are. */
static inline icc_status call_map_improve(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    icc_map *map = (icc_map *)&map;
    const icc_improve_options options = {.size = sizeof options, .iterations = 2, .levels = 1};
    icc_improve_report report = {.size = sizeof report};
    icc_status status = icc_map_improve(&map, o->mesh_map, &options, &report, env, err);
    HANDED_OVER(status, map);
    ck_assert(report.energy <= report.energy_start);
    if (status == ICC_OK)
        status = use_map(o, map, out, err);
    icc_map_free(map);
    if (!report.cancelled)
        return status;
    if (err != NULL)
        *err = (icc_error){.size = sizeof *err, .status = ICC_ERR_CANCELLED, .message = "stopped"};
    return ICC_ERR_CANCELLED;
}

static inline icc_status call_map_follow(const objects *o, outcome *out, const icc_env *env,
                                         icc_error *err)
{
    double moved[2 * N_CORNERS];
    icc_domain *target;
    memcpy(moved, TARGET, sizeof moved);
    moved[2] += 0.25;
    ck_assert_int_eq(icc_domain_create(&target, 2, N_CORNERS, moved, 0, NULL, NULL, NULL), ICC_OK);
    icc_map *map = (icc_map *)&map;
    icc_status status = icc_map_retarget(
        &map, o->mesh_map, target,
        &(icc_retarget_options){.size = sizeof(icc_retarget_options), .iterations = 2}, env, err);
    HANDED_OVER(status, map);
    icc_domain_free(target);
    if (status == ICC_OK)
        status = use_map(o, map, out, err);
    icc_map_free(map);
    return status;
}

/* The source in four triangles. */
static const uint32_t TRIANGLES[12] = {0, 1, 3, 1, 2, 3, 0, 3, 5, 3, 4, 5};

static inline icc_status call_map_certify(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    icc_certificate c = {.size = sizeof c};
    const icc_status status =
        flat_certify(o->mesh_map, N_CORNERS, SOURCE, 4, TRIANGLES, out->numbers, &c, env, err);
    memcpy(out->indices, &c, sizeof c);
    return status;
}

/* A field of doubles on a grid around the source's corner (0, 0). */
static inline icc_field small_field(double *values)
{
    return (icc_field){.size = sizeof(icc_field),
                       .dim = 2,
                       .bytes = (int32_t)sizeof *values,
                       .displacement = 1,
                       .outside = ICC_OUTSIDE_NEAREST,
                       .shape = {4, 4},
                       .origin = {-0.1, -0.1},
                       .step = {0.25, 0, 0, 0.25},
                       .values = values};
}

static inline icc_status call_map_sample(const objects *o, outcome *out, const icc_env *env,
                                         icc_error *err)
{
    const icc_field field = small_field(out->numbers);
    return icc_map_sample(o->mesh_map, 0, &field, &out->count, env, err);
}

/* One cell is exactly flat, and one has a corner without a value. */
static inline icc_status call_field_certify(const objects *o, outcome *out, const icc_env *env,
                                            icc_error *err)
{
    double values[2 * 16] = {0.25};
    const icc_field field = small_field(values);
    icc_field_report r = {.size = sizeof r};
    (void)o;
    values[30] = NAN;
    const icc_status status = icc_field_certify(&field, 4, out->indices, out->status, &r, env, err);
    out->count = r.n_folded + 16 * r.n_missing;
    return status;
}

/* One vertex inside, close to the boundary. */
static inline icc_status call_map_repair(const objects *o, outcome *out, const icc_env *env,
                                         icc_error *err)
{
    static const uint32_t FAN[15] = {6, 1, 2, 6, 2, 3, 6, 3, 0, 6, 0, 1, 0, 3, 5};
    double vertices[2 * (N_CORNERS + 1)];
    icc_certificate c = {.size = sizeof c};
    memcpy(vertices, SOURCE, sizeof SOURCE);
    vertices[2 * N_CORNERS] = 0.9999;
    vertices[2 * N_CORNERS + 1] = 0.999;
    const icc_status status =
        flat_repair(o->mesh_map, N_CORNERS + 1, vertices, 5, FAN, out->numbers, &c, env, err);
    memcpy(out->indices, &c, sizeof c);
    return status;
}

static inline icc_status call_grid_create(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    icc_grid *grid = (icc_grid *)&grid;
    const icc_status status = icc_grid_create(&grid, o->source, 0, env, err);
    HANDED_OVER(status, grid);
    icc_grid_info info = {.size = sizeof info};
    if (status == ICC_OK)
        (void)icc_grid_get_info(grid, &info);
    out->count = info.n_inside;
    icc_grid_free(grid);
    return status;
}

static inline icc_status call_grid_create_mask(const objects *o, outcome *out, const icc_env *env,
                                               icc_error *err)
{
    static const size_t SHAPE[3] = {5, 5, 5};
    icc_grid *grid = (icc_grid *)&grid;
    const icc_status status =
        icc_grid_create_mask(&grid, 3, SHAPE, icc_grid_inside(o->mask), env, err);
    HANDED_OVER(status, grid);
    if (status == ICC_OK)
        out->count = icc_grid_inside(grid)[31];
    icc_grid_free(grid);
    return status;
}

static inline icc_status call_grid_maximum(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    return icc_grid_find_maximum(o->grid, out->indices, out->indices + 1, env, err);
}

static inline icc_status call_tree_create(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    icc_tree *tree = (icc_tree *)&tree;
    const icc_status status = icc_tree_create(&tree, o->mask, 62, NULL, env, err);
    HANDED_OVER(status, tree);
    if (status == ICC_OK)
        memcpy(out->indices, icc_tree_parents(tree), 125 * sizeof *out->indices);
    icc_tree_free(tree);
    return status;
}

static inline icc_status call_tree_verify(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    icc_tree_report report = {.size = sizeof report};
    const icc_status status = icc_tree_get_report(o->tree, &report, env, err);
    memcpy(out->indices, &report, sizeof report);
    return status;
}

static inline icc_status call_field_create(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    icc_function *field = (icc_function *)&field;
    const icc_status status = icc_function_create(&field, o->tree, NULL, env, err);
    HANDED_OVER(status, field);
    if (status == ICC_OK)
        memcpy(out->numbers, icc_function_values(field), 125 * sizeof *out->numbers);
    icc_function_free(field);
    return status;
}

/* Everything that is known about a field but the seconds, which differ. */
static inline icc_status make_function(const icc_tree *tree, int32_t function, int32_t constraints,
                                       int32_t solver, outcome *out, const icc_env *env,
                                       icc_error *err)
{
    icc_function *field = (icc_function *)&field;
    const icc_function_options options = {
        .size = sizeof options, .function = function, .constraints = constraints, .solver = solver};
    const icc_status status = icc_function_create(&field, tree, &options, env, err);
    HANDED_OVER(status, field);
    icc_function_info info = {.size = sizeof info};
    if (status == ICC_OK) {
        icc_grid_info grid = {.size = sizeof grid};
        ck_assert_int_eq(icc_function_get_info(field, &info), ICC_OK);
        ck_assert_int_eq(icc_grid_get_info(icc_tree_grid(tree), &grid), ICC_OK);
        ck_assert_uint_le(2 * grid.n_vertices, 4 * N_POINTS);
        memcpy(out->numbers, icc_function_values(field), grid.n_vertices * sizeof *out->numbers);
        if (icc_function_logs(field) != NULL)
            memcpy(out->numbers + grid.n_vertices, icc_function_logs(field),
                   grid.n_vertices * sizeof *out->numbers);
    }
    memcpy(out->indices, &info, sizeof info);
    icc_function_free(field);
    return status;
}

static inline icc_status call_laplace(const objects *o, outcome *out, const icc_env *env,
                                      icc_error *err)
{
    return make_function(o->bent, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NEEDED, ICC_SOLVER_DIRECT,
                         out, env, err);
}

static inline icc_status call_laplace_constrained(const objects *o, outcome *out,
                                                  const icc_env *env, icc_error *err)
{
    return make_function(o->bent, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL, ICC_SOLVER_DIRECT, out,
                         env, err);
}

static inline icc_status call_laplace_iterative(const objects *o, outcome *out, const icc_env *env,
                                                icc_error *err)
{
    return make_function(o->bent, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL, ICC_SOLVER_ITERATIVE,
                         out, env, err);
}

static inline icc_status call_bilaplace(const objects *o, outcome *out, const icc_env *env,
                                        icc_error *err)
{
    return make_function(o->bent, ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_ALL, ICC_SOLVER_DIRECT,
                         out, env, err);
}

static inline icc_status call_clamped(const objects *o, outcome *out, const icc_env *env,
                                      icc_error *err)
{
    return make_function(o->bent, ICC_FUNCTION_CLAMPED, ICC_CONSTRAINTS_ALL, ICC_SOLVER_DIRECT, out,
                         env, err);
}

static inline icc_status call_harmonic(const objects *o, outcome *out, const icc_env *env,
                                       icc_error *err)
{
    return make_function(o->cut, ICC_FUNCTION_HARMONIC, ICC_CONSTRAINTS_NEEDED, ICC_SOLVER_DIRECT,
                         out, env, err);
}

static inline icc_status call_harmonic_constrained(const objects *o, outcome *out,
                                                   const icc_env *env, icc_error *err)
{
    return make_function(o->cut, ICC_FUNCTION_HARMONIC, ICC_CONSTRAINTS_ALL, ICC_SOLVER_DIRECT, out,
                         env, err);
}

static inline icc_status call_field_verify(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    icc_function_report report = {.size = sizeof report};
    const icc_status status = icc_function_get_report(o->field, &report, env, err);
    memcpy(out->indices, &report, sizeof report);
    return status;
}

static inline icc_status call_domain_create_mask(const objects *o, outcome *out, const icc_env *env,
                                                 icc_error *err)
{
    static const size_t SHAPE[3] = {5, 5, 5};
    icc_domain *domain = (icc_domain *)&domain;
    const icc_status status =
        icc_domain_create_mask(&domain, 3, SHAPE, icc_grid_inside(o->mask), env, err);
    HANDED_OVER(status, domain);
    icc_domain_info info = {.size = sizeof info};
    if (status == ICC_OK && icc_domain_get_info(domain, &info) == ICC_OK)
        out->count = info.n_facets;
    icc_domain_free(domain);
    return status;
}

/* In the L: a hole, a line and a point. */
static const icc_feature FEATURES[3] = {
    {sizeof(icc_feature), ICC_FEATURE_HOLE, 3, (const double[]){0.2, 0.2, 0.2, 0.8, 0.8, 0.2}, 0, 0,
     NULL},
    {sizeof(icc_feature), ICC_FEATURE_LINE, 2, (const double[]){1.5, 0.5, 2.5, 0.5}, 0, 0, NULL},
    {sizeof(icc_feature), ICC_FEATURE_POINT, 1, (const double[]){0.5, 2}, 0, 0, NULL}};

static inline icc_status call_domain_create_features(const objects *o, outcome *out,
                                                     const icc_env *env, icc_error *err)
{
    (void)o;
    icc_domain *domain = (icc_domain *)&domain;
    const icc_status status =
        icc_domain_create_features(&domain, N_CORNERS, SOURCE, 3, FEATURES, env, err);
    HANDED_OVER(status, domain);
    if (status == ICC_OK)
        (void)icc_domain_get_boundary(domain, out->numbers, out->indices);
    icc_domain_free(domain);
    return status;
}

static inline icc_status call_domain_create_mesh(const objects *o, outcome *out, const icc_env *env,
                                                 icc_error *err)
{
    static const double POINTS[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, .3, .3, .3};
    static const uint32_t SIMPLICES[20] = {5, 0, 1, 2, 5, 0, 1, 3, 5, 0,
                                           2, 3, 5, 1, 2, 3, 4, 1, 2, 3};
    (void)o;
    icc_domain *domain = (icc_domain *)&domain;
    const icc_status status =
        flat_create_mesh(&domain, 3, 6, POINTS, 5, SIMPLICES, 0, NULL, env, err);
    HANDED_OVER(status, domain);
    icc_domain_info info = {.size = sizeof info};
    if (status == ICC_OK && icc_domain_get_info(domain, &info) == ICC_OK)
        out->count = info.n_facets;
    icc_domain_free(domain);
    return status;
}

static inline icc_status call_grid_refine(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    icc_grid *grid = (icc_grid *)&grid;
    const icc_status status = icc_grid_refine(&grid, o->mask, env, err);
    HANDED_OVER(status, grid);
    if (status == ICC_OK)
        memcpy(out->indices, icc_grid_inside(grid), 729);
    icc_grid_free(grid);
    return status;
}

static inline icc_status call_grid_restrict(const objects *o, outcome *out, const icc_env *env,
                                            icc_error *err)
{
    icc_grid *grid = (icc_grid *)&grid;
    const icc_status status = icc_grid_restrict(&grid, o->mask, icc_grid_inside(o->mask), env, err);
    HANDED_OVER(status, grid);
    if (status == ICC_OK)
        memcpy(out->indices, icc_grid_inside(grid), 125);
    icc_grid_free(grid);
    return status;
}

static inline icc_status call_tree_grow(const objects *o, outcome *out, const icc_env *env,
                                        icc_error *err)
{
    return icc_tree_grow(o->tree, NULL, out->indices, NULL, env, err);
}

static inline icc_status call_tree_verify_ranks(const objects *o, outcome *out, const icc_env *env,
                                                icc_error *err)
{
    icc_function_report report = {.size = sizeof report};
    const icc_status status =
        icc_tree_get_rank_report(o->tree, icc_tree_parents(o->tree), &report, env, err);
    memcpy(out->indices, &report, sizeof report);
    return status;
}

static inline icc_status call_triangulate(const objects *o, outcome *out, const icc_env *env,
                                          icc_error *err)
{
    double points[2 * (N_CORNERS + 100)];
    memcpy(points, SOURCE, sizeof SOURCE);
    memcpy(points + 2 * N_CORNERS, o->points, 200 * sizeof *points);
    return icc_triangulate(N_CORNERS, N_CORNERS + 100, points, out->indices, env, err);
}

static inline icc_status call_shape_create(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    (void)out;
    icc_shape *shape = (icc_shape *)&shape;
    const icc_status status = make_shape(o, &shape, env, err);
    HANDED_OVER(status, shape);
    icc_shape_free(shape);
    return status;
}

static inline icc_status call_sampling_create(const objects *o, outcome *out, const icc_env *env,
                                              icc_error *err)
{
    icc_sampling *sampling = (icc_sampling *)&sampling;
    const icc_status status = make_sampling(o, &sampling, env, err);
    HANDED_OVER(status, sampling);
    icc_sampling_info info = {.size = sizeof info};
    if (status == ICC_OK) {
        (void)icc_sampling_get_info(sampling, &info);
        ck_assert_uint_le(info.n_samples, 2 * N_POINTS);
        (void)icc_sampling_get_points(sampling, out->numbers);
    }
    out->count = info.n_samples;
    icc_sampling_free(sampling);
    return status;
}

/* Writes the weights at the points, and frees the kernel. */
static inline icc_status tell_weights(icc_status status, const objects *o, icc_weights *kernel,
                                      outcome *out)
{
    HANDED_OVER(status, kernel);
    if (status == ICC_OK)
        (void)icc_weights_evaluate(kernel, N_POINTS, o->points, out->numbers, NULL, out->status,
                                   &out->count, NULL);
    icc_weights_free(kernel);
    return status;
}

static inline icc_status call_kernel_create(const objects *o, outcome *out, const icc_env *env,
                                            icc_error *err)
{
    icc_weights *kernel = (icc_weights *)&kernel;
    const icc_status status = make_kernel(o, &kernel, env, err);
    return tell_weights(status, o, kernel, out);
}

static inline icc_status call_kernel_paint(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    static const double CENTRE[2] = {0.5, 0.6};
    icc_weights *kernel = (icc_weights *)&kernel;
    const icc_status status = icc_weights_paint(&kernel, o->kernel, 3, CENTRE, 0.7, 0.5, env, err);
    return tell_weights(status, o, kernel, out);
}

static inline icc_status call_kernel_repaint(const objects *o, outcome *out, const icc_env *env,
                                             icc_error *err)
{
    static const uint32_t NODES[2] = {30, 40};
    static const double WISHES[2 * N_HANDLES] = {1, 0, 0, 0, 0, 0, 1, 1};
    icc_weights *kernel = (icc_weights *)&kernel;
    const icc_status status = icc_weights_repaint(&kernel, o->kernel, 2, NODES, WISHES, env, err);
    return tell_weights(status, o, kernel, out);
}

static inline icc_status call_kernel_set_method(const objects *o, outcome *out, const icc_env *env,
                                                icc_error *err)
{
    icc_weights *kernel = (icc_weights *)&kernel;
    const icc_status status = icc_weights_with_method(&kernel, o->kernel, ICC_WEIGHTS_L1, env, err);
    return tell_weights(status, o, kernel, out);
}

static inline icc_status call_kernel_stiffen(const objects *o, outcome *out, const icc_env *env,
                                             icc_error *err)
{
    static const uint32_t NODES[3] = {60, 61, 62};
    icc_weights *kernel = (icc_weights *)&kernel;
    const icc_status status =
        icc_weights_stiffen(&kernel, o->kernel, 3, NODES, NULL, NULL, env, err);
    return tell_weights(status, o, kernel, out);
}

static inline icc_status call_kernel_weights(const objects *o, outcome *out, const icc_env *env,
                                             icc_error *err)
{
    (void)err;
    return icc_weights_evaluate(o->kernel, N_POINTS, o->points, out->numbers, NULL, out->status,
                                &out->count, env);
}

static inline icc_status call_kernel_get_dual(const objects *o, outcome *out, const icc_env *env,
                                              icc_error *err)
{
    return icc_weights_get_dual(o->kernel, 7, N_POINTS, o->points, out->numbers, env, err);
}

static inline icc_status call_kernel_get_report(const objects *o, outcome *out, const icc_env *env,
                                                icc_error *err)
{
    icc_weights_report report = {.size = sizeof report};
    const icc_status status =
        icc_weights_get_report(o->kernel, N_POINTS, o->points, &report, env, err);
    memcpy(out->numbers, &report, sizeof report);
    return status;
}

static inline icc_status call_binding_create(const objects *o, outcome *out, const icc_env *env,
                                             icc_error *err)
{
    icc_binding *binding = (icc_binding *)&binding;
    const icc_status status =
        icc_binding_create(&binding, o->kernel, N_POINTS, o->points, 1, env, err);
    HANDED_OVER(status, binding);
    if (status == ICC_OK)
        (void)icc_binding_get_weights(binding, NULL, out->numbers);
    icc_binding_free(binding);
    return status;
}

static inline icc_status call_binding_pose(const objects *o, outcome *out, const icc_env *env,
                                           icc_error *err)
{
    (void)err;
    double transforms[6 * N_HANDLES];
    for (int k = 0; k < 6 * N_HANDLES; ++k)
        transforms[k] = sin((double)k);
    return icc_binding_pose(o->binding, transforms, out->numbers, out->numbers + N_POINTS, env);
}

static inline icc_status call_chart_load(const objects *o, outcome *out, const icc_env *env,
                                         icc_error *err)
{
    size_t n;
    ck_assert_int_eq(icc_chart_save(o->chart, 0, NULL, &n), ICC_OK);
    void *data = malloc(n);
    ck_assert_int_eq(icc_chart_save(o->chart, n, data, &n), ICC_OK);
    icc_chart *chart = (icc_chart *)&chart;
    icc_status status = icc_chart_load(&chart, n, data, env, err);
    HANDED_OVER(status, chart);
    if (status == ICC_OK)
        status = note_later(icc_chart_encode(chart, N_POINTS, o->points, out->indices, out->numbers,
                                             out->numbers + 2 * N_POINTS, out->status, &out->count,
                                             NULL),
                            err);
    icc_chart_free(chart);
    free(data);
    return status;
}

static inline icc_status call_map_load(const objects *o, outcome *out, const icc_env *env,
                                       icc_error *err)
{
    size_t n;
    ck_assert_int_eq(icc_map_save(o->mesh_map, 0, NULL, &n), ICC_OK);
    void *data = malloc(n);
    ck_assert_int_eq(icc_map_save(o->mesh_map, n, data, &n), ICC_OK);
    icc_map *map = (icc_map *)&map;
    icc_status status = icc_map_load(&map, n, data, env, err);
    HANDED_OVER(status, map);
    if (status == ICC_OK)
        status = use_map(o, map, out, err);
    icc_map_free(map);
    free(data);
    return status;
}

/* The numbers that two fits have in common. */
static inline icc_status use_fit(const objects *o, const icc_fit *fit, outcome *out, icc_error *err)
{
    icc_fit_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_fit_get_info(fit, &info), ICC_OK);
    out->indices[0] = (uint32_t)info.n_iterations;
    ck_assert_int_eq(icc_fit_get_residuals(fit, out->numbers + 2 * N_POINTS, NULL), ICC_OK);
    return use_map(o, icc_fit_map(fit), out, err);
}

/* The two points in the middle change places, so that the spline folds. */
static const double PINS[12] = {0.2, 0.2, 2.8, 0.3, 0.3, 2.8, 0.5, 0.5, 0.9, 0.6, 0.6, 1.2};
static const double PINNED[12] = {0.2, 0.2, 2.8, 0.3, 0.3, 2.8, 0.9, 0.6, 0.5, 0.5, 0.6, 1.2};

static inline icc_status call_fit_create(const objects *o, outcome *out, const icc_env *env,
                                         icc_error *err)
{
    icc_fit *fit = (icc_fit *)&fit;
    const icc_constraint pins = {.size = sizeof pins,
                                 .kind = ICC_CONSTRAINT_POINTS,
                                 .n = 6,
                                 .source = PINS,
                                 .target = PINNED};
    const icc_fit_options options = {.size = sizeof options, .margin = 0.1};
    icc_status status = icc_fit_create(&fit, NULL, NULL, 1, &pins, &options, env, err);
    HANDED_OVER(status, fit);
    if (status == ICC_OK)
        status = use_fit(o, fit, out, err);
    icc_fit_free(fit);
    return status;
}

/* An L that bends by its ends. */
static inline icc_status bend(icc_fit **fit, const objects *o, const icc_env *env, icc_error *err)
{
    static const double BENT[6] = {0.2, 0.2, 2.6, 0.9, 0.5, 2.9};
    const icc_constraint pins = {
        .size = sizeof pins, .kind = ICC_CONSTRAINT_POINTS, .n = 3, .source = PINS, .target = BENT};
    const icc_fit_options options = {.size = sizeof options, .cell = 0.5};
    return icc_fit_create(fit, o->source, NULL, 1, &pins, &options, env, err);
}

static inline icc_status call_fit_create_figure(const objects *o, outcome *out, const icc_env *env,
                                                icc_error *err)
{
    icc_fit *fit = (icc_fit *)&fit;
    icc_status status = bend(&fit, o, env, err);
    HANDED_OVER(status, fit);
    if (status == ICC_OK)
        status = use_fit(o, fit, out, err);
    icc_fit_free(fit);
    return status;
}

static inline icc_status call_fit_move(const objects *o, outcome *out, const icc_env *env,
                                       icc_error *err)
{
    static const double BENT[6] = {0.2, 0.2, 2.5, 1.1, 0.6, 2.9};
    icc_fit *fit, *next = (icc_fit *)&next;
    ck_assert_int_eq(bend(&fit, o, NULL, NULL), ICC_OK);
    icc_status status = icc_fit_move(&next, fit, BENT, env, err);
    HANDED_OVER(status, next);
    icc_fit_free(fit);
    if (status == ICC_OK)
        status = use_fit(o, next, out, err);
    icc_fit_free(next);
    return status;
}

/* A square of four by four cells, with two inner vertices that change places. */
static inline icc_status call_map_create_nearest(const objects *o, outcome *out, const icc_env *env,
                                                 icc_error *err)
{
    enum { N = 5 };
    double points[2 * N * N], images[2 * N * N], swap[2];
    uint32_t cells[6 * (N - 1) * (N - 1)], n = 0;
    for (uint32_t v = 0; v < N * N; ++v) {
        points[2 * v] = 0.25 * (v % N);
        points[2 * v + 1] = 0.25 * (v / N);
        for (uint32_t k = 0; v % N + 1 < N && v / N + 1 < N && k < 6; ++k)
            cells[n++] = v + (uint32_t[]){0, 1, N + 1, 0, N + 1, N}[k];
    }
    memcpy(images, points, sizeof points);
    memcpy(swap, images + 2 * 7, sizeof swap);
    memcpy(images + 2 * 7, images + 2 * 12, sizeof swap);
    memcpy(images + 2 * 12, swap, sizeof swap);
    const icc_mesh mesh = {.size = sizeof mesh,
                           .dim = 2,
                           .n_vertices = N * N,
                           .vertices = points,
                           .n_cells = n / 3,
                           .cells = cells};
    icc_nearest_report report = {.size = sizeof report};
    icc_map *map = (icc_map *)&map;
    icc_status status = icc_map_create_nearest(&map, &mesh, images, NULL, &report, env, err);
    HANDED_OVER(status, map);
    out->indices[0] = (uint32_t)report.n_folded;
    if (status == ICC_OK)
        status = use_map(o, map, out, err);
    icc_map_free(map);
    return status;
}

static const call CALLS[] = {
    {"icc_shape_create", call_shape_create},
    {"icc_sampling_create", call_sampling_create},
    {"icc_weights_create", call_kernel_create},
    {"icc_weights_paint", call_kernel_paint},
    {"icc_weights_repaint", call_kernel_repaint},
    {"icc_weights_with_method", call_kernel_set_method},
    {"icc_weights_stiffen", call_kernel_stiffen},
    {"icc_weights_evaluate", call_kernel_weights},
    {"icc_weights_get_dual", call_kernel_get_dual},
    {"icc_weights_get_report", call_kernel_get_report},
    {"icc_binding_create", call_binding_create},
    {"icc_binding_pose", call_binding_pose},
    {"icc_domain_create", call_domain_create},
    {"icc_domain_create_mask", call_domain_create_mask},
    {"icc_domain_create_mesh", call_domain_create_mesh},
    {"icc_domain_create_features", call_domain_create_features},
    {"icc_domain_locate", call_domain_locate},
    {"icc_boundary_defects", call_boundary_defects},
    {"icc_chart_create", call_chart_create},
    {"icc_chart_create_function", call_chart_create_function},
    {"icc_chart_get_report", call_chart_measure},
    {"icc_chart_encode", call_chart_encode},
    {"icc_chart_decode", call_chart_decode},
    {"icc_chart_encode_flags", call_chart_encode_flags},
    {"icc_chart_decode_flags", call_chart_decode_flags},
    {"icc_chart_trace", call_chart_trace},
    {"icc_chart_load", call_chart_load},
    {"icc_map_create", call_map_create},
    {"icc_map_create_polygons", call_map_create_polygons},
    {"icc_map_create_from_charts", call_map_create_from_charts},
    {"icc_map_apply", call_map_apply},
    {"icc_map_apply_inverse", call_map_apply_inverse},
    {"icc_map_jacobian", call_map_jacobian},
    {"icc_map_improve", call_map_improve},
    {"icc_map_retarget", call_map_follow},
    {"icc_map_certify", call_map_certify},
    {"icc_map_repair", call_map_repair},
    {"icc_map_sample", call_map_sample},
    {"icc_field_certify", call_field_certify},
    {"icc_map_load", call_map_load},
    {"icc_map_create_nearest", call_map_create_nearest},
    {"icc_fit_create: points", call_fit_create},
    {"icc_fit_create: a figure", call_fit_create_figure},
    {"icc_fit_move", call_fit_move},
    {"icc_grid_create", call_grid_create},
    {"icc_grid_create_mask", call_grid_create_mask},
    {"icc_grid_refine", call_grid_refine},
    {"icc_grid_restrict", call_grid_restrict},
    {"icc_grid_find_maximum", call_grid_maximum},
    {"icc_tree_create", call_tree_create},
    {"icc_tree_get_report", call_tree_verify},
    {"icc_tree_grow", call_tree_grow},
    {"icc_tree_get_rank_report", call_tree_verify_ranks},
    {"icc_function_create", call_field_create},
    {"icc_function_create: Laplace", call_laplace},
    {"icc_function_create: Laplace, constrained", call_laplace_constrained},
    {"icc_function_create: Laplace, iterative", call_laplace_iterative},
    {"icc_function_create: bi-Laplace", call_bilaplace},
    {"icc_function_create: clamped", call_clamped},
    {"icc_function_create: harmonic", call_harmonic},
    {"icc_function_create: harmonic, constrained", call_harmonic_constrained},
    {"icc_function_get_report", call_field_verify},
    {"icc_triangulate", call_triangulate},
};
enum { N_CALLS = sizeof CALLS / sizeof *CALLS };

/* Whether the call has nothing to do with charts, and takes long: once is enough, whatever the
 * methods. */
static inline int is_once(const call *c)
{
    static const char *const BEGINNINGS[] = {
        "icc_function_create:", "icc_shape_", "icc_sampling_",         "icc_kernel_",
        "icc_binding_",         "icc_fit_",   "icc_map_create_nearest"};
    for (size_t i = 0; i < sizeof BEGINNINGS / sizeof *BEGINNINGS; ++i)
        if (strncmp(c->name, BEGINNINGS[i], strlen(BEGINNINGS[i])) == 0)
            return 1;
    return 0;
}

/* Whether the call takes an icc_error, which must then tell what the status tells. */
static inline int has_error(const call *c)
{
    static const char *const WITHOUT[] = {"icc_domain_locate",      "icc_chart_encode",
                                          "icc_chart_decode",       "icc_chart_encode_flags",
                                          "icc_chart_decode_flags", "icc_map_apply",
                                          "icc_map_apply_inverse",  "icc_map_jacobian",
                                          "icc_weights_evaluate",   "icc_binding_pose"};
    for (size_t i = 0; i < sizeof WITHOUT / sizeof *WITHOUT; ++i)
        if (strcmp(c->name, WITHOUT[i]) == 0)
            return 0;
    return 1;
}

#endif
