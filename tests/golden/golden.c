/* Prints a line for every case: its name, and a hash of all that it gives. The lines are the same
 * on every machine, with every compiler. The folder's objects.txt and results.txt have them;
 * check.sh compares.
 *
 * golden objects [FOLDER]   charts, maps, samplings and bindings: a hash of their answers, and one
 *                           of the bytes that they are saved as, which are written to that folder
 * golden load FOLDER        the same of the objects in it, wherever they were written
 * golden results            everything else */
#include "../flat_mesh.h"
#include "../reports.h"
#include "outcomes.h"

#include <icc/stages.h>
#include <stdbool.h>

static void show(const char *name, const digest *d)
{
    (void)printf("%-24s %016llx", name, (unsigned long long)d->state);
}

/* ---- objects ---- */

/* One of these. */
typedef struct object {
    icc_chart *chart;
    icc_map *map;
    icc_sampling *sampling;
    icc_binding *binding;
} object;

typedef icc_domain *(*make_domain)(int side);

typedef struct chart_case {
    const char *name;
    make_domain domain;
    int32_t method, cells, function, tree, constraints, solver;
} chart_case;

static const chart_case CHARTS[] = {
    {"chart-decay", domain_ring, ICC_METHOD_GRADIENT, 30, ICC_FUNCTION_DECAY, 0, 0, 0},
    {"chart-distance", domain_ring, ICC_METHOD_GRADIENT, 30, ICC_FUNCTION_DISTANCE, ICC_TREE_PAPER,
     0, 0},
    {"chart-laplace", domain_comb, ICC_METHOD_GRADIENT, 30, ICC_FUNCTION_LAPLACE, 0, 0, 0},
    {"chart-bilaplace", domain_comb, ICC_METHOD_GRADIENT, 30, ICC_FUNCTION_BILAPLACE, 0,
     ICC_CONSTRAINTS_NONE, 0},
    {"chart-clamped", domain_l, ICC_METHOD_GRADIENT, 20, ICC_FUNCTION_CLAMPED, 0,
     ICC_CONSTRAINTS_ALL, 0},
    {"chart-harmonic", domain_comb, ICC_METHOD_GRADIENT, 30, ICC_FUNCTION_HARMONIC, 0, 0, 0},
    {"chart-laplace3", domain_star, ICC_METHOD_GRADIENT, 12, ICC_FUNCTION_LAPLACE, 0, 0,
     ICC_SOLVER_ITERATIVE},
    {"chart-cells2", domain_cells2, ICC_METHOD_FIELD, 0, 0, 0, 0, 0},
    {"chart-cells4", domain_cells4, ICC_METHOD_GRADIENT, 0, 0, 0, 0, 0},
    {"chart-field4", domain_ball_mesh4, ICC_METHOD_FIELD, 6, 0, 0, 0, 0},
    {"chart-shelling2", domain_disc_mesh, ICC_METHOD_FOLIATION, 0, 0, 0, 0, 0},
    {"chart-shelling4", domain_ball_mesh4, ICC_METHOD_FOLIATION, 0, 0, 0, 0, 0}};
enum { N_CHARTS = sizeof CHARTS / sizeof *CHARTS };

static object make_chart(size_t which)
{
    const chart_case *c = &CHARTS[which];
    const icc_chart_options options = {.size = sizeof options,
                                       .method = c->method,
                                       .function = c->function,
                                       .tree = c->tree,
                                       .cells = c->cells,
                                       .constraints = c->constraints,
                                       .solver = c->solver};
    icc_error err = {.size = sizeof err};
    icc_domain *domain = c->domain(0);
    object o = {0};
    must(icc_chart_create(&o.chart, domain, &options, NULL, &err), c->name, &err);
    icc_domain_free(domain);
    return o;
}

typedef struct map_case {
    const char *name;
    make_domain domain;
    int32_t method, kind, cells, iterations;
} map_case;

static const map_case MAPS[] = {
    {"map-l", domain_l, 0, 0, 0, 0},
    {"map-ring", domain_ring, 0, 0, 0, 0},
    {"map-comb", domain_comb, 0, 0, 0, 0},
    {"map-far", domain_far, 0, 0, 0, 0},
    {"map-start", domain_ring, 0, ICC_MAP_MESH, 0, -1},
    {"map-foliation-mesh", domain_ring, ICC_METHOD_FOLIATION, ICC_MAP_MESH, 0, 0},
    {"map-disc", domain_comb, ICC_METHOD_DISC, ICC_MAP_CURVES, 0, 0},
    {"map-foliation", domain_comb, ICC_METHOD_FOLIATION, ICC_MAP_CURVES, 0, 0},
    {"map-gradient", domain_ring, ICC_METHOD_GRADIENT, ICC_MAP_CURVES, 30, 0},
    {"map-field", domain_ring, ICC_METHOD_FIELD, ICC_MAP_CURVES, 30, 0},
    {"map-field3", domain_star, ICC_METHOD_FIELD, ICC_MAP_CURVES, 12, 0},
    {"map-gradient3", domain_star, ICC_METHOD_GRADIENT, ICC_MAP_CURVES, 12, 0},
    {"map-cells3", domain_cells3, ICC_METHOD_FIELD, ICC_MAP_CURVES, 12, 0},
    {"map-solid", domain_ball_mesh, 0, 0, 0, 0},
    {"map-shelling3", domain_ball_mesh, ICC_METHOD_FOLIATION, ICC_MAP_CURVES, 0, 0},
    {"map-shelling4", domain_ball_mesh4, ICC_METHOD_FOLIATION, ICC_MAP_CURVES, 0, 0}};
enum { N_MAPS = sizeof MAPS / sizeof *MAPS };

static object make_map(size_t which)
{
    const map_case *c = &MAPS[which];
    const icc_chart_options chart = {.size = sizeof chart, .method = c->method, .cells = c->cells};
    const icc_map_options options = {
        .size = sizeof options, .kind = c->kind, .iterations = c->iterations, .chart = &chart};
    icc_error err = {.size = sizeof err};
    icc_domain *source = c->domain(0), *target = c->domain(1);
    object o = {0};
    must(icc_map_create(&o.map, source, target, &options, NULL, &err), c->name, &err);
    icc_domain_free(source);
    icc_domain_free(target);
    return o;
}

/* A map that follows its target, then is improved. */
static object make_retargeted(size_t which)
{
    (void)which;
    const object first = make_map(0);
    icc_domain *target = domain_l(2);
    icc_error err = {.size = sizeof err};
    icc_map *map;
    object o = {0};
    must(icc_map_retarget(&map, first.map, target, NULL, NULL, &err), "icc_map_retarget", &err);
    const icc_improve_options options = {.size = sizeof options, .levels = 1};
    must(icc_map_improve(&o.map, map, &options, NULL, NULL, &err), "icc_map_improve", &err);
    icc_map_free(map);
    icc_map_free(first.map);
    icc_domain_free(target);
    return o;
}

/* One in space, refined. */
static object make_refined_solid(size_t which)
{
    const icc_improve_options options = {.size = sizeof options, .levels = 1};
    icc_error err = {.size = sizeof err};
    object first, o = {0};
    while (strcmp(MAPS[which].name, "map-solid") != 0)
        ++which;
    first = make_map(which);
    must(icc_map_improve(&o.map, first.map, &options, NULL, NULL, &err), "icc_map_improve", &err);
    icc_map_free(first.map);
    return o;
}

/* And one that follows its target from there to where the source is. */
static object make_retargeted_solid(size_t which)
{
    const object first = make_refined_solid(which);
    icc_domain *target = domain_ball_mesh(0);
    icc_error err = {.size = sizeof err};
    object o = {0};
    must(icc_map_retarget(&o.map, first.map, target, NULL, NULL, &err), "icc_map_retarget", &err);
    icc_map_free(first.map);
    icc_domain_free(target);
    return o;
}

/* One between surfaces that have been filled. */
static object make_filled(size_t which)
{
    icc_domain *filled[2];
    icc_error err = {.size = sizeof err};
    object o = {0};
    (void)which;
    for (int side = 0; side < 2; ++side) {
        icc_domain *hull = domain_star(side);
        must(icc_domain_fill(&filled[side], hull, NULL, NULL, &err), "icc_domain_fill", &err);
        icc_domain_free(hull);
    }
    must(icc_map_create(&o.map, filled[0], filled[1], NULL, NULL, &err), "icc_map_create", &err);
    icc_domain_free(filled[0]);
    icc_domain_free(filled[1]);
    return o;
}

/* In pixels of a picture of 60 by 50. */
static object make_picture_map(size_t which)
{
    (void)which;
    icc_domain *domains[2];
    icc_error err = {.size = sizeof err};
    object o = {0};
    for (uint64_t side = 0; side < 2; ++side) {
        double xy[2 * 20];
        ring_outline(20, .6, 101 + side, xy);
        for (size_t i = 0; i < sizeof xy / sizeof *xy; ++i)
            xy[i] = 24 * xy[i] + (i % 2 == 0 ? 30 : 25);
        domains[side] = domain_of(2, 20, xy, 0, NULL);
    }
    must(icc_map_create(&o.map, domains[0], domains[1], NULL, NULL, &err), "icc_map_create", &err);
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
    return o;
}

/* A ring within a square, and a curve; in space, a star. All lie in the box of -1 and 1. */
static icc_shape *make_shape(int32_t dim)
{
    static const double SQUARE[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
    static const double CURVE[6] = {-.75, .75, 0, .875, .75, .75};
    static const uint32_t SEGMENTS[4] = {0, 1, 1, 2};
    icc_domain *regions[2] = {dim == 2 ? domain_ring(1) : domain_star(0), NULL};
    if (dim == 2)
        regions[1] = domain_of(2, 4, SQUARE, 0, NULL);
    icc_error err = {.size = sizeof err};
    icc_shape *shape;
    must(icc_shape_create(&shape, dim, dim == 2 ? 2 : 1, (const icc_domain *const *)regions,
                          dim == 2 ? 3 : 0, CURVE, dim == 2 ? 2 : 0, SEGMENTS, NULL, &err),
         "icc_shape_create", &err);
    icc_domain_free(regions[0]);
    icc_domain_free(regions[1]);
    return shape;
}

typedef struct sampling_case {
    const char *name;
    int32_t dim, kind;
    double spacing;
} sampling_case;

static const sampling_case SAMPLINGS[] = {{"sampling-blue2", 2, ICC_SAMPLING_BLUE, .125},
                                          {"sampling-grid2", 2, ICC_SAMPLING_GRID, .125},
                                          {"sampling-blue3", 3, ICC_SAMPLING_BLUE, .25},
                                          {"sampling-grid3", 3, ICC_SAMPLING_GRID, .25}};
enum { N_SAMPLINGS = sizeof SAMPLINGS / sizeof *SAMPLINGS };

static object make_sampling(size_t which)
{
    const sampling_case *c = &SAMPLINGS[which];
    const icc_sampling_options options = {
        .size = sizeof options, .kind = c->kind, .steps = 10, .spacing = c->spacing};
    icc_error err = {.size = sizeof err};
    icc_shape *shape = make_shape(c->dim);
    object o = {0};
    must(icc_sampling_create(&o.sampling, shape, &options, NULL, &err), c->name, &err);
    icc_shape_free(shape);
    return o;
}

/* Weights of five handles, or of six in space. */
static icc_weights *make_weights(size_t sampling, icc_weights_options options)
{
    static const double HANDLES[10] = {-.5, -.125, .5, -.125, .125, .5, -.125, -.5, 0, .125};
    static const double HANDLES3[18] = {.5, 0,   0, -.5, 0, 0,  0, .5, 0,
                                        0,  -.5, 0, 0,   0, .5, 0, 0,  -.5};
    const object o = make_sampling(sampling);
    const int32_t dim = SAMPLINGS[sampling].dim;
    icc_error err = {.size = sizeof err};
    icc_weights *weights;
    options.size = sizeof options;
    must(icc_weights_create(&weights, o.sampling, dim == 2 ? 5 : 6, dim == 2 ? HANDLES : HANDLES3,
                            &options, NULL, &err),
         "icc_weights_create", &err);
    icc_sampling_free(o.sampling);
    return weights;
}

static object make_binding(size_t which)
{
    const int32_t dim = SAMPLINGS[which].dim;
    static const double LOWER[3] = {-1, -1, -1}, UPPER[3] = {1, 1, 1};
    icc_weights *weights = make_weights(which, (icc_weights_options){0});
    double points[N_COORDINATES];
    object o = {0};
    points_of_box(dim, LOWER, UPPER, points);
    must(icc_binding_create(&o.binding, weights, N_ASKED, points, 1, NULL, NULL), "a binding",
         NULL);
    icc_weights_free(weights);
    return o;
}

/* What no table has. */
static const struct {
    const char *name;
    object (*make)(size_t which);
    size_t which;
} OTHERS[] = {
    {"map-retargeted", make_retargeted, 0}, {"map-solid-refined", make_refined_solid, 0},
    {"map-solid-filled", make_filled, 0},   {"map-solid-retargeted", make_retargeted_solid, 0},
    {"map-picture", make_picture_map, 0},   {"binding-blue2", make_binding, 0},
    {"binding-grid3", make_binding, 3}};
enum { N_OTHERS = sizeof OTHERS / sizeof *OTHERS };

static void free_object(object *o)
{
    icc_chart_free(o->chart);
    icc_map_free(o->map);
    icc_sampling_free(o->sampling);
    icc_binding_free(o->binding);
}

static icc_status save(const object *o, size_t capacity, void *data, size_t *n)
{
    return o->chart != NULL      ? icc_chart_save(o->chart, capacity, data, n)
           : o->map != NULL      ? icc_map_save(o->map, capacity, data, n)
           : o->sampling != NULL ? icc_sampling_save(o->sampling, capacity, data, n)
                                 : icc_binding_save(o->binding, capacity, data, n);
}

/* The bytes tell the kind, as docs/reference/formats.md has it. */
static object load(size_t n, const unsigned char *data, const char *name)
{
    icc_error err = {.size = sizeof err};
    object o = {0};
    const char *kind = n > 8 ? (const char *)data + 4 : "";
    const icc_status status =
        memcmp(kind, "CHRT", 4) == 0   ? icc_chart_load(&o.chart, n, data, NULL, &err)
        : memcmp(kind, "MAP_", 4) == 0 ? icc_map_load(&o.map, n, data, NULL, &err)
        : memcmp(kind, "SMPL", 4) == 0 ? icc_sampling_load(&o.sampling, n, data, NULL, &err)
                                       : icc_binding_load(&o.binding, n, data, NULL, &err);
    must(status, name, &err);
    return o;
}

static FILE *open_file(const char *folder, const char *name, const char *mode)
{
    char path[1024];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = length > 0 && (size_t)length < sizeof path ? fopen(path, mode) : NULL;
    if (file == NULL) {
        (void)fprintf(stderr, "%s cannot be opened\n", path);
        exit(EXIT_FAILURE);
    }
    return file;
}

static object read_object(const char *folder, const char *name)
{
    enum { MOST = 1 << 24 };
    FILE *file = open_file(folder, name, "rb");
    unsigned char *data = mesh_alloc(MOST, 1);
    const size_t n = fread(data, 1, MOST, file);
    (void)fclose(file);
    object o = load(n, data, name);
    free(data);
    return o;
}

static void write_bytes(const char *folder, const char *name, size_t n, const unsigned char *data)
{
    FILE *file = open_file(folder, name, "wb");
    if (fwrite(data, 1, n, file) != n || fclose(file) != 0) {
        (void)fprintf(stderr, "%s cannot be written\n", name);
        exit(EXIT_FAILURE);
    }
}

/* What it answers, and its bytes. */
static void show_object(const char *name, const object *o, const char *folder)
{
    digest answers = digest_of_nothing(), bytes = digest_of_nothing();
    size_t n = 0;
    if (o->chart != NULL)
        digest_chart(&answers, o->chart);
    else if (o->map != NULL)
        digest_map(&answers, o->map);
    else if (o->sampling != NULL)
        digest_sampling(&answers, o->sampling);
    else
        digest_binding(&answers, o->binding);
    show(name, &answers);
    must(save(o, 0, NULL, &n), name, NULL);
    unsigned char *data = mesh_alloc(n, 1);
    must(save(o, n, data, &n), name, NULL);
    digest_bytes(&bytes, n, data);
    (void)printf(" %016llx\n", (unsigned long long)bytes.state);
    if (folder != NULL)
        write_bytes(folder, name, n, data);
    free(data);
}

static void treat(const char *name, object (*make)(size_t which), size_t which, const char *from,
                  const char *to)
{
    object o = from != NULL ? read_object(from, name) : make(which);
    show_object(name, &o, to);
    free_object(&o);
}

static void treat_objects(const char *from, const char *to)
{
    for (size_t k = 0; k < N_CHARTS; ++k)
        treat(CHARTS[k].name, make_chart, k, from, to);
    for (size_t k = 0; k < N_MAPS; ++k)
        treat(MAPS[k].name, make_map, k, from, to);
    for (size_t k = 0; k < N_SAMPLINGS; ++k)
        treat(SAMPLINGS[k].name, make_sampling, k, from, to);
    for (size_t k = 0; k < N_OTHERS; ++k)
        treat(OTHERS[k].name, OTHERS[k].make, OTHERS[k].which, from, to);
}

/* ---- everything else ---- */

/* A tree on a C of a grid, or on a cube but for an edge. */
static icc_tree *make_tree(int32_t dim)
{
    enum { SIDE2 = 21, SIDE3 = 9 };
    const size_t side = dim == 2 ? SIDE2 : SIDE3, n = mesh_power(side, dim);
    const size_t shape[3] = {side, side, side}, third = side / 3;
    uint8_t inside[SIDE3 * SIDE3 * SIDE3 > SIDE2 * SIDE2 ? SIDE3 * SIDE3 * SIDE3 : SIDE2 * SIDE2];
    icc_grid *grid;
    icc_tree *tree;
    uint32_t root;
    for (size_t v = 0; v < n; ++v) {
        size_t at[ICC_MAX_DIM] = {0};
        mesh_digits(v, side, dim, at);
        inside[v] = at[0] < third || at[1] < third || (dim == 2 && at[1] >= side - third);
        for (int32_t k = 0; k < dim; ++k)
            inside[v] = (uint8_t)(inside[v] && at[k] > 1 && at[k] + 2 < side);
    }
    must(icc_grid_create_mask(&grid, dim, shape, inside, NULL, NULL), "a grid", NULL);
    must(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), "a maximum", NULL);
    must(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), "a tree", NULL);
    icc_grid_free(grid);
    return tree;
}

typedef struct function_case {
    const char *name;
    int32_t dim, function, constraints, solver;
} function_case;

static const function_case FUNCTIONS[] = {
    {"function-decay", 2, ICC_FUNCTION_DECAY, 0, 0},
    {"function-laplace", 2, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT},
    {"function-multigrid", 2, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_ITERATIVE},
    {"function-constrained", 2, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL, 0},
    {"function-bilaplace", 2, ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT},
    {"function-plate", 2, ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_ALL, 0},
    {"function-clamped", 2, ICC_FUNCTION_CLAMPED, ICC_CONSTRAINTS_ALL, 0},
    {"function-laplace3", 3, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT},
    {"function-multigrid3", 3, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL, ICC_SOLVER_ITERATIVE}};
enum { N_FUNCTIONS = sizeof FUNCTIONS / sizeof *FUNCTIONS };

static void digest_function_info(digest *d, const icc_function *function)
{
    icc_function_info info = {.size = sizeof info};
    icc_function_report report = {.size = sizeof report};
    (void)icc_function_get_info(function, &info);
    must(icc_function_get_report(function, &report, NULL, NULL), "a report", NULL);
    const icc_solver_report made = solver_report_of(function);
    const size_t counts[] = {info.n_unknowns, info.n_violated, info.n_active,   made.n_iterations,
                             made.n_inner,    report.n_maxima, report.n_minima, report.n_saddles};
    const double numbers[] = {made.residual_before, info.residual, info.least_log, info.excess};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        digest_size(d, counts[k]);
    digest_f64(d, sizeof numbers / sizeof *numbers, numbers);
}

/* The function and the order of growth that it gives. */
static void try_function(digest *d, size_t which)
{
    const function_case *c = &FUNCTIONS[which];
    const icc_function_options options = {.size = sizeof options,
                                          .function = c->function,
                                          .constraints = c->constraints,
                                          .solver = c->solver};
    icc_tree *tree = make_tree(c->dim);
    icc_grid_info grid = {.size = sizeof grid};
    icc_error err = {.size = sizeof err};
    icc_function *function;
    must(icc_function_create(&function, tree, &options, NULL, &err), c->name, &err);
    (void)icc_grid_get_info(icc_tree_grid(tree), &grid);
    uint32_t *rank = mesh_alloc(grid.n_vertices, sizeof *rank);
    must(icc_tree_grow(tree, icc_function_values(function), rank, NULL, NULL, NULL), "growth",
         NULL);
    digest_function_info(d, function);
    digest_u32(d, grid.n_vertices, icc_tree_parents(tree));
    digest_u32(d, grid.n_vertices, rank);
    digest_f64(d, grid.n_vertices, icc_function_values(function));
    if (icc_function_logs(function) != NULL)
        digest_f64(d, grid.n_vertices, icc_function_logs(function));
    free(rank);
    icc_function_free(function);
    icc_tree_free(tree);
}

static const uint32_t HANDLE_EDGES[4] = {0, 1, 1, 2};
static const icc_line HANDLE_LINES[1] = {{.from = {-.25, -.25}, .to = {.25, -.25}}};

static const struct {
    const char *name;
    size_t sampling;
    icc_weights_options options;
} WEIGHTS[] = {{"weights-qp", 0, {0}},
               {"weights-equality", 0, {.method = ICC_WEIGHTS_EQUALITY}},
               {"weights-l1", 0, {.method = ICC_WEIGHTS_L1}},
               {"weights-gauss", 0, {.kernel = ICC_KERNEL_GAUSS}},
               {"weights-inverse", 1, {.initial = ICC_INITIAL_INVERSE}},
               {"weights-edges", 1, {.n_edges = 2, .edges = HANDLE_EDGES}},
               {"weights-lines", 0, {.n_lines = 1, .lines = HANDLE_LINES}},
               {"weights-blue3", 2, {0}}};
enum { N_WEIGHTS = sizeof WEIGHTS / sizeof *WEIGHTS };

static void try_weights(digest *d, size_t which)
{
    icc_weights *weights = make_weights(WEIGHTS[which].sampling, WEIGHTS[which].options);
    digest_weights(d, weights);
    icc_weights_free(weights);
}

/* Painted, then stiffened. */
static void try_edits(digest *d, size_t which)
{
    (void)which;
    static const double CENTRE[2] = {.25, .125};
    static const uint32_t NODES[6] = {20, 21, 22, 23, 24, 25};
    double energy[2];
    icc_weights *weights = make_weights(0, (icc_weights_options){0}), *painted, *stiff;
    must(icc_weights_paint(&painted, weights, 2, CENTRE, .25, .5, NULL, NULL), "paint", NULL);
    must(icc_weights_stiffen(&stiff, painted, 6, NODES, NULL, energy, NULL, NULL), "stiffen", NULL);
    digest_weights(d, painted);
    digest_weights(d, stiff);
    digest_f64(d, 2, energy);
    icc_weights_free(weights);
    icc_weights_free(painted);
    icc_weights_free(stiff);
}

/* A picture of noise, in samples of one or two bytes. */
static void try_picture(digest *d, size_t which)
{
    enum { WIDTH = 60, HEIGHT = 50, CHANNELS = 4, N = WIDTH * HEIGHT * CHANNELS };
    static uint8_t bytes[2][N];
    static uint16_t words[2][N];
    const bool wide = which == 1;
    icc_picture pictures[2];
    random_source r = {61};
    for (size_t i = 0; i < N; ++i) {
        words[0][i] = (uint16_t)random_below(&r, 65536);
        bytes[0][i] = (uint8_t)(words[0][i] >> 8);
    }
    for (size_t side = 0; side < 2; ++side)
        pictures[side] =
            (icc_picture){.size = sizeof *pictures,
                          .width = WIDTH,
                          .height = HEIGHT,
                          .channels = CHANNELS,
                          .bytes = wide ? 2 : 1,
                          .alpha = 1,
                          .stride = (wide ? sizeof **words : sizeof **bytes) * WIDTH * CHANNELS,
                          .pixels = wide ? (void *)words[side] : (void *)bytes[side]};
    const object o = make_picture_map(0);
    must(icc_map_warp(o.map, &pictures[0], &pictures[1], NULL, NULL, NULL), "warp", NULL);
    for (size_t i = 0; i < N; ++i)
        digest_u64(d, wide ? words[1][i] : bytes[1][i]);
    icc_map_free(o.map);
}

static void try_interval(digest *d, size_t which)
{
    icc_domain *domain = domain_interval((int)which);
    digest_domain(d, domain);
    icc_domain_free(domain);
}

/* A star that crosses itself. */
static void try_defects(digest *d, size_t which)
{
    (void)which;
    enum { N = 15, MOST = 200 };
    double xy[2 * N], turned[2 * N];
    int32_t kinds[MOST];
    uint32_t items[2 * MOST];
    size_t n;
    ring_outline(N, .5, 71, xy);
    for (size_t k = 0; k < N; ++k)
        memcpy(turned + 2 * k, xy + 2 * (4 * k % N), 2 * sizeof *xy);
    must(icc_boundary_defects(N, turned, MOST, kinds, items, &n, NULL, NULL), "defects", NULL);
    digest_size(d, n);
    digest_i32(d, n < MOST ? n : MOST, kinds);
    digest_u32(d, n < MOST ? 2 * n : 2 * MOST, items);
}

/* A rough outline and the same one bent, without every third vertex and from another one on: by
 * shape, and by two landmarks. */
static void try_match(digest *d, size_t which)
{
    enum { N = 300, M = N / 3 * 2 };
    double a[2 * N], b[2 * M];
    ring_outline(N, .6, 17, a);
    for (size_t k = 0; k < N; ++k)
        a[2 * k] *= a[2 * k] > 0 ? 2.5 : 1;
    for (size_t k = 0; k < M; ++k) {
        const double *const p = a + 2 * ((k / 2 * 3 + k % 2 + 60) % N);
        b[2 * k] = p[0] + .1 * p[1] * p[1];
        b[2 * k + 1] = p[1] - .1 * p[0] * p[1];
    }
    const double pairs[] = {a[120], a[121], b[0], b[1], a[360], a[361], b[160], b[161]};
    icc_domain *source = domain_of(2, N, a, 0, NULL), *target = domain_of(2, M, b, 0, NULL);
    icc_match *match;
    icc_error err = {.size = sizeof err};
    must(icc_match_create(&match, source, target, 2 * which, pairs, NULL, NULL, &err),
         "icc_match_create", &err);
    icc_match_info info = {.size = sizeof info};
    (void)icc_match_get_info(match, &info);
    const double numbers[] = {info.cost, info.second,      info.sure,
                              info.turn, info.least_slope, info.most_slope};
    digest_f64(d, sizeof numbers / sizeof *numbers, numbers);
    digest_size(d, info.n_joined);
    digest_domain(d, icc_match_source(match));
    digest_domain(d, icc_match_target(match));
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
}

/* Two surfaces, which are cut by one another and made coarse together. */
static void try_match_surfaces(digest *d, size_t which)
{
    icc_domain *source = domain_star(0), *target = domain_star(1);
    icc_match *match;
    icc_error err = {.size = sizeof err};
    (void)which;
    must(icc_match_create(&match, source, target, 0, NULL, NULL, NULL, &err), "icc_match_create",
         &err);
    digest_domain(d, icc_match_source(match));
    digest_domain(d, icc_match_target(match));
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
}

/* A square with random points, a third of them on a lattice, where four and more lie on a
 * circle. */
static void try_triangulation(digest *d, size_t which)
{
    (void)which;
    enum { N = 200 };
    double points[2 * (4 + N)] = {0, 0, 1, 0, 1, 1, 0, 1};
    uint32_t triangles[3 * (2 * (4 + N) - 4 - 2)];
    random_source r = {81};
    for (size_t i = 8; i < 2 * (4 + N); ++i)
        points[i] = random_between(&r, .01, .99);
    for (size_t i = 0; i < 64; ++i) {
        points[8 + 2 * i] = (double)(1 + i % 8) / 9;
        points[9 + 2 * i] = (double)(1 + i / 8) / 9;
    }
    must(icc_triangulate(4, 4 + N, points, triangles, NULL, NULL), "a triangulation", NULL);
    digest_u32(d, sizeof triangles / sizeof *triangles, triangles);
}

static void try_mask_repair(digest *d, size_t which)
{
    (void)which;
    static const size_t SHAPE[3] = {8, 8, 8};
    uint8_t cells[512];
    size_t n_filled;
    random_source r = {91};
    for (size_t c = 0; c < sizeof cells; ++c)
        cells[c] = random_below(&r, 3) == 0;
    must(icc_mask_repair(3, SHAPE, cells, &n_filled, NULL, NULL), "a mask", NULL);
    digest_size(d, n_filled);
    digest_bytes(d, sizeof cells, cells);
}

/* A caller's mesh of the source of a map, in the plane or in space. */
static void try_mesh(digest *d, size_t which)
{
    const int32_t dim = which == 0 ? 2 : 3;
    random_source r = {41};
    test_mesh m = mesh_ball(dim, dim == 2 ? 8 : 4, .1, &r);
    icc_domain *source = domain_of_mesh(&m), *target = domain_bent(source);
    const icc_chart_options chart = {.size = sizeof chart, .method = ICC_METHOD_FIELD, .cells = 12};
    const icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_certificate c = {.size = sizeof c};
    double *images = mesh_alloc(m.n_vertices * (size_t)dim, sizeof *images);
    icc_error err = {.size = sizeof err};
    icc_map *map;
    must(icc_map_create(&map, source, target, &options, NULL, &err), "icc_map_create", &err);
    must(flat_repair(map, m.n_vertices, m.vertices, m.n_simplices, m.simplices, images, &c, NULL,
                     &err),
         "icc_map_repair", &err);
    digest_f64(d, m.n_vertices * (size_t)dim, images);
    digest_i32(d, 1, &c.certified);
    digest_size(d, c.n_inverted);
    digest_size(d, c.n_no_image);
    free(images);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    mesh_free(&m);
}

static const struct {
    const char *name;
    void (*run)(digest *d, size_t which);
    size_t which;
} RESULTS[] = {{"weights-edited", try_edits, 0},    {"interval", try_interval, 0},
               {"picture-bytes", try_picture, 0},   {"picture-words", try_picture, 1},
               {"defects", try_defects, 0},         {"triangulation", try_triangulation, 0},
               {"mask-repair", try_mask_repair, 0}, {"mesh-repair2", try_mesh, 0},
               {"mesh-repair3", try_mesh, 1},       {"match", try_match, 0},
               {"match-landmarks", try_match, 1},   {"match-surfaces", try_match_surfaces, 0}};
enum { N_RESULTS = sizeof RESULTS / sizeof *RESULTS };

static void show_result(const char *name, void (*run)(digest *d, size_t which), size_t which)
{
    digest d = digest_of_nothing();
    run(&d, which);
    show(name, &d);
    (void)printf("\n");
}

static void show_results(void)
{
    for (size_t k = 0; k < N_FUNCTIONS; ++k)
        show_result(FUNCTIONS[k].name, try_function, k);
    for (size_t k = 0; k < N_WEIGHTS; ++k)
        show_result(WEIGHTS[k].name, try_weights, k);
    for (size_t k = 0; k < N_RESULTS; ++k)
        show_result(RESULTS[k].name, RESULTS[k].run, RESULTS[k].which);
}

int main(int argc, char **argv)
{
    const char *mode = argc > 1 ? argv[1] : "", *folder = argc > 2 ? argv[2] : NULL;
    if (strcmp(mode, "objects") == 0)
        treat_objects(NULL, folder);
    else if (strcmp(mode, "load") == 0 && folder != NULL)
        treat_objects(folder, NULL);
    else if (strcmp(mode, "results") == 0)
        show_results();
    else {
        (void)fprintf(stderr, "usage: golden objects [FOLDER] | load FOLDER | results\n");
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
