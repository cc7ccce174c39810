/* The thesis' shapes: the star of tables 6.1 to 6.5, the stick figure of table 6.6 and a cage like
 * the butterfly of table 6.7; rigid parts and lines on the star. Beside each property's yes or no
 * of the thesis stands how far it fails here, with the thesis' options (Gaussian kernel, no affine
 * function) and with ours. usage: bench_stars */
#include "bench.h"

#include <icc/kernel.h>
#include <stdbool.h>

enum { TIPS = 10, CAGE = 26, MEN = 14, HEAD = 8, LINE = 21 };

static const char *const METHOD[5] = {"", "QP", "QEC", "l1", "biharmonic"};

/* A shape, its samples, and points at which weights are judged: those of a grid that are in the
 * first region or, for the stick figure, in its head. */
typedef struct stage {
    icc_sampling *sampling;
    icc_sampling_info info;
    double seconds;
    size_t n_handles, n_points;
    double handles[2 * CAGE];
    uint32_t edges[2 * CAGE];
    size_t n_edges;
    double *points;
} stage;

static void draw_star(double *xy)
{
    for (size_t i = 0; i < TIPS; ++i)
        bench_polar(xy + 2 * i, i % 2 == 0 ? 1 : 0.4, 90 + 36 * (double)i);
}

static icc_domain *square(double half)
{
    return bench_domain(4, (double[]){-half, -half, half, -half, half, half, -half, half});
}

static icc_shape *shape_of(size_t n, icc_domain **regions, size_t n_vertices,
                           const double *vertices, size_t n_segments, const uint32_t *segments)
{
    icc_shape *shape;
    icc_error error = {.size = sizeof error};
    bench_check(icc_shape_create(&shape, 2, n, (const icc_domain *const *)regions, n_vertices,
                                 vertices, n_segments, segments, NULL, &error),
                &error);
    for (size_t k = 0; k < n; ++k)
        icc_domain_free(regions[k]);
    return shape;
}

/* Spreads samples over the shape, which it takes over. */
static void sample(stage *s, icc_shape *shape, icc_sampling_options options)
{
    icc_error error = {.size = sizeof error};
    const double start = bench_seconds();
    bench_check(icc_sampling_create(&s->sampling, shape, &options, NULL, &error), &error);
    s->seconds = bench_seconds() - start;
    s->info.size = sizeof s->info;
    bench_check(icc_sampling_get_info(s->sampling, &s->info), &error);
    icc_shape_free(shape);
}

static bool is_inside(size_t n, const double *polygon, double x, double y)
{
    bool inside = false;
    for (size_t i = 0, j = n - 1; i < n; j = i++) {
        const double *p = polygon + 2 * i, *q = polygon + 2 * j;
        if ((p[1] > y) != (q[1] > y) && x < p[0] + (q[0] - p[0]) * (y - p[1]) / (q[1] - p[1]))
            inside = !inside;
    }
    return inside;
}

/* Points of a 200 x 200 grid in a polygon. */
static void judge_at(stage *s, size_t n, const double *polygon)
{
    enum { SIDE = 200 };
    s->points = bench_alloc((size_t)SIDE * SIDE, 2 * sizeof *s->points);
    s->n_points = 0;
    for (size_t k = 0; k < (size_t)SIDE * SIDE; ++k) {
        const double x = -1.3 + 2.6 * ((double)(k % SIDE) + 0.5) / SIDE;
        const double y = -1.3 + 2.6 * ((double)(k / SIDE) + 0.5) / SIDE;
        if (is_inside(n, polygon, x, y)) {
            s->points[2 * s->n_points] = x;
            s->points[2 * s->n_points++ + 1] = y;
        }
    }
}

static void close_ring(stage *s, uint32_t n)
{
    s->n_edges = s->n_handles = n;
    for (uint32_t i = 0; i < n; ++i) {
        s->edges[2 * i] = i;
        s->edges[2 * i + 1] = (i + 1) % n;
    }
}

static void clear(stage *s)
{
    icc_sampling_free(s->sampling);
    free(s->points);
}

static icc_weights *kernel_of(const stage *s, icc_weights_options options, double *seconds)
{
    icc_weights *kernel;
    icc_error error = {.size = sizeof error};
    const double start = bench_seconds();
    if (icc_weights_create(&kernel, s->sampling, s->n_handles, s->handles, &options, NULL,
                           &error) != ICC_OK) {
        printf("  %s: %s\n", icc_status_name(error.status), error.message);
        return NULL;
    }
    *seconds = bench_seconds() - start;
    return kernel;
}

/* What the thesis' table says: five properties for QP, QEC and l1. */
typedef struct table {
    const char *name;
    const char *said[4];
} table;

static void print_line(const char *kind, const icc_weights *kernel, const stage *s, double seconds)
{
    icc_error error = {.size = sizeof error};
    icc_weights_report r = {.size = sizeof r};
    icc_weights_timings took = {.size = sizeof took};
    bench_check(icc_weights_get_report(kernel, s->n_points, s->points, &r, NULL, &error), &error);
    bench_check(icc_weights_get_timings(kernel, &took), &error);
    printf("  %-22s | %8.1e | %8.1e | %8.1e | %8.1e | %9.2e | %6zu | %.3f (%.4f)\n", kind,
           r.reproduction, r.unity, r.lagrange, r.linearity, r.least_weight, r.n_infeasible,
           seconds, took.optimise);
}

static void judge(const stage *s, const table *t, icc_weights_options options)
{
    printf("%s: %zu samples, %zu on edges, T %.4g, sampled in %.2f s\n", t->name, s->info.n_samples,
           s->info.n_edge, s->info.spacing, s->seconds);
    printf("  %-22s | %-8s | %-8s | %-8s | %-8s | %-9s | %-6s | %s\n", "", "reprod.", "sum - 1",
           "Lagrange", "linear", "least", "infeas", "s (weights)");
    options.size = sizeof options;
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        icc_weights_options theirs = options, ours = options;
        double seconds;
        char kind[40];
        printf("  %-22s | %s\n", METHOD[method], t->said[method]);
        theirs.method = ours.method = method;
        theirs.kernel = ICC_KERNEL_GAUSS;
        theirs.affine_tail = theirs.within_shape = -1;
        ours.sigma = 0;
        icc_weights *kernel = kernel_of(s, theirs, &seconds);
        snprintf(kind, sizeof kind, "  thesis' options");
        if (kernel != NULL)
            print_line(kind, kernel, s, seconds);
        icc_weights_free(kernel);
        kernel = kernel_of(s, ours, &seconds);
        if (kernel != NULL)
            print_line("  ours", kernel, s, seconds);
        icc_weights_free(kernel);
    }
}

/* ---- the star ---- */

static stage star_of(double around, icc_sampling_options options)
{
    stage s = {0};
    icc_domain *regions[2];
    draw_star(s.handles);
    close_ring(&s, TIPS);
    regions[0] = bench_domain(TIPS, s.handles);
    if (around > 0)
        regions[1] = square(around);
    options.size = sizeof options;
    sample(&s, shape_of(around > 0 ? 2 : 1, regions, 0, NULL, 0, NULL), options);
    judge_at(&s, TIPS, s.handles);
    return s;
}

/* The weights alone, from the best of some runs: they are short. */
static void gain_by_threads(const stage *s)
{
    enum { RUNS = 5 };
    icc_error error = {.size = sizeof error};
    double best[2] = {HUGE_VAL, HUGE_VAL};
    const icc_weights_options options = {
        .size = sizeof options, .n_edges = s->n_edges, .edges = s->edges};
    for (int32_t run = 0; run < 2 * RUNS; ++run) {
        const icc_env env = {.size = sizeof env, .threads = 1 + run % 2};
        icc_weights_timings took = {.size = sizeof took};
        icc_weights *kernel;
        bench_check(icc_weights_create(&kernel, s->sampling, s->n_handles, s->handles, &options,
                                       &env, &error),
                    &error);
        bench_check(icc_weights_get_timings(kernel, &took), &error);
        best[run % 2] = fmin(best[run % 2], took.optimise);
        icc_weights_free(kernel);
    }
    printf("table 6.5, QP: s alone and side by side | 28.5, 8.28 | %.4f, %.4f with 2 threads | -\n",
           best[0], best[1]);
}

static void stars(void)
{
    static const table tables[4] = {{"table 6.1, grid",
                                     {"", "yes      | yes      | no       | no       | ~ -1e-3",
                                      "yes      | yes      | no       | no       | no",
                                      "yes      | yes      | no       | no       | yes"}},
                                    {"table 6.2, blue noise inside",
                                     {"", "yes      | yes      | no       | no       | ~ -1e-2",
                                      "yes      | yes      | yes      | yes      | no",
                                      "yes      | yes      | no       | no       | yes"}},
                                    {"table 6.3, and around it",
                                     {"", "yes      | yes      | yes      | no       | ~ -1e-2",
                                      "yes      | yes      | yes      | no       | no",
                                      "yes      | yes      | yes      | no       | ~ -1e-2"}},
                                    {"table 6.4, dense",
                                     {"", "yes      | yes      | yes      | no       | ~ -1e-3",
                                      "yes      | yes      | yes      | no       | no",
                                      "yes      | yes      | yes      | no       | ~ -1e-3"}}};
    stage s = star_of(
        0, (icc_sampling_options){.kind = ICC_SAMPLING_GRID, .spacing = 0.0286, .margin = 4});
    judge(&s, &tables[0],
          (icc_weights_options){.initial = ICC_INITIAL_HEAT,
                                .n_edges = s.n_edges,
                                .edges = s.edges,
                                .sigma = 3 * 0.0286 / 3.14159265});
    clear(&s);
    s = star_of(0, (icc_sampling_options){.spacing = 0.0897});
    judge(&s, &tables[1],
          (icc_weights_options){
              .initial = ICC_INITIAL_HEAT, .n_edges = s.n_edges, .edges = s.edges, .sigma = 0.09});
    clear(&s);
    s = star_of(1.43, (icc_sampling_options){.spacing = 0.0897});
    judge(&s, &tables[2],
          (icc_weights_options){.n_edges = s.n_edges, .edges = s.edges, .sigma = 0.09});
    clear(&s);
    s = star_of(1.22, (icc_sampling_options){.spacing = 0.0265});
    judge(&s, &tables[3],
          (icc_weights_options){.n_edges = s.n_edges, .edges = s.edges, .sigma = 0.025});
    gain_by_threads(&s);
    clear(&s);
}

/* ---- rigid parts, lines, painting ---- */

static size_t find_leg(const double *star, size_t n, const double *points, uint32_t *part)
{
    const double *a = star + 10, *tip = star + 12, *b = star + 14;
    double leg[6], middle[2] = {(a[0] + tip[0] + b[0]) / 3, (a[1] + tip[1] + b[1]) / 3};
    size_t found = 0;
    for (size_t k = 0; k < 2; ++k) {
        leg[k] = middle[k] + 0.75 * (a[k] - middle[k]);
        leg[2 + k] = middle[k] + 0.75 * (tip[k] - middle[k]);
        leg[4 + k] = middle[k] + 0.75 * (b[k] - middle[k]);
    }
    for (uint32_t i = 0; i < n; ++i)
        if (is_inside(3, leg, points[2 * i], points[2 * i + 1]))
            part[found++] = i;
    return found;
}

static void stiffen(const icc_weights *kernel, const stage *s, const char *kind)
{
    icc_error error = {.size = sizeof error};
    icc_weights_info info = {.size = sizeof info};
    icc_weights *stiff;
    double energy[2], least = 0;
    bench_check(icc_weights_get_info(kernel, &info), &error);
    double *points = bench_alloc(info.n_nodes, 2 * sizeof *points);
    double *weights = bench_alloc(info.n_nodes, TIPS * sizeof *weights);
    uint32_t *part = bench_alloc(info.n_nodes, sizeof *part);
    bench_check(icc_weights_get_nodes(kernel, points, NULL, NULL, NULL), &error);
    const size_t n = find_leg(s->handles, info.n_nodes, points, part);
    const double start = bench_processor_seconds();
    bench_check(icc_weights_stiffen(&stiff, kernel, n, part, NULL, energy, NULL, &error), &error);
    const double seconds = bench_processor_seconds() - start;
    bench_check(icc_weights_get_nodes(stiff, NULL, NULL, weights, NULL), &error);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < TIPS; ++j)
            least = fmin(least, weights[TIPS * part[i] + j]);
    printf("rigid leg, %s | thesis q 141, ~2 s | q %zu: energy / %.2f, %.3f s, least weight there "
           "%.1e | energy / >= 3, <= 2 s\n",
           kind, n, energy[0] / energy[1], seconds, least);
    icc_weights_free(stiff);
    free(points);
    free(weights);
    free(part);
}

/* How far from linear weights are along a line of 21 samples. */
static double bend_of(const stage *s, int32_t kind, const icc_line *line)
{
    enum { STEPS = 1000 };
    static double points[2 * (STEPS + 1)], weights[TIPS * (STEPS + 1)];
    const icc_weights_options options = {.size = sizeof options,
                                         .kernel = kind,
                                         .n_edges = s->n_edges,
                                         .edges = s->edges,
                                         .n_lines = 1,
                                         .lines = line};
    double seconds, off = 0;
    icc_weights *kernel = kernel_of(s, options, &seconds);
    for (size_t i = 0; i <= STEPS; ++i)
        for (size_t k = 0; k < 2; ++k)
            points[2 * i + k] = line->from[k] + (double)i / STEPS * (line->to[k] - line->from[k]);
    bench_check(icc_weights_evaluate(kernel, STEPS + 1, points, weights, NULL, NULL, NULL, NULL),
                NULL);
    for (size_t i = 0; i <= STEPS; ++i)
        for (size_t j = 0; j < TIPS; ++j) {
            const double t = (double)i / STEPS;
            off = fmax(off, fabs(weights[TIPS * i + j] - (1 - t) * weights[j] -
                                 t * weights[TIPS * STEPS + j]));
        }
    icc_weights_free(kernel);
    return off;
}

/* The sine of the angle between the images of two parallel lines, under translations of the
 * handles. */
static double turn_of(const stage *s)
{
    const icc_line lines[2] = {{.from = {-0.25, -0.1}, .to = {0.25, 0.2}},
                               {.from = {0.2, -0.1}, .to = {-0.2, -0.34}, .parallel = 1}};
    const icc_weights_options options = {.size = sizeof options, .n_lines = 2, .lines = lines};
    double weights[4 * TIPS], points[8], seconds, turn = 0;
    icc_weights *kernel = kernel_of(s, options, &seconds);
    for (size_t k = 0; k < 2; ++k) {
        memcpy(points + 4 * k, lines[k].from, 2 * sizeof *points);
        memcpy(points + 4 * k + 2, lines[k].to, 2 * sizeof *points);
    }
    bench_check(icc_weights_evaluate(kernel, 4, points, weights, NULL, NULL, NULL, NULL), NULL);
    for (size_t k = 0; k < 100; ++k) {
        double a[2] = {0}, b[2] = {0};
        for (size_t j = 0; j < TIPS; ++j)
            for (size_t c = 0; c < 2; ++c) {
                const double x = s->handles[2 * j + c] + cos((double)(7 * k + 3 * j + 5 * c));
                a[c] += x * (weights[TIPS + j] - weights[j]);
                b[c] += x * (weights[3 * TIPS + j] - weights[2 * TIPS + j]);
            }
        turn =
            fmax(turn, fabs(a[0] * b[1] - a[1] * b[0]) / (hypot(a[0], a[1]) * hypot(b[0], b[1])));
    }
    icc_weights_free(kernel);
    return turn;
}

static void keep_lines(const stage *s)
{
    const icc_line line = {.from = {-0.265, 0}, .to = {0.265, 0}};
    const icc_line others[3] = {{.from = {-0.25, -0.02}, .to = {0.25, 0.05}},
                                {.from = {-0.1, -0.24}, .to = {-0.1, 0.28}},
                                {.from = {-0.2, -0.1}, .to = {0.2, 0.1}}};
    for (int32_t kind = ICC_KERNEL_GAUSS; kind >= ICC_KERNEL_WENDLAND; --kind) {
        double worst = 0;
        for (size_t k = 0; k < 3; ++k)
            worst = fmax(worst, bend_of(s, kind, &others[k]));
        printf("line of 21 samples, %s | close | %.1e from linear; worst of three others %.1e | "
               "<= 1e-3\n",
               kind == ICC_KERNEL_GAUSS ? "Gaussian" : "Wendland", bend_of(s, kind, &line), worst);
    }
    printf("parallel lines | exact | sine %.1e | <= 1e-14\n", turn_of(s));
}

static void structure(void)
{
    stage s = star_of(1.22, (icc_sampling_options){.spacing = 0.0265});
    icc_weights_options options = {.size = sizeof options, .n_edges = s.n_edges, .edges = s.edges};
    double seconds;
    for (int32_t kind = ICC_KERNEL_WENDLAND; kind <= ICC_KERNEL_GAUSS; ++kind) {
        options.kernel = kind;
        icc_weights *kernel = kernel_of(&s, options, &seconds);
        stiffen(kernel, &s, kind == ICC_KERNEL_GAUSS ? "Gaussian" : "Wendland");
        icc_weights_free(kernel);
    }
    keep_lines(&s);
    clear(&s);
}

/* ---- a gap ---- */

/* Two legs, two spacings apart: the greatest initial weight, in the upper half of one, of a handle
 * on the other. */
static double leak(const stage *s, int32_t visible, int32_t steps)
{
    icc_weights_info info = {.size = sizeof info};
    double seconds, most = 0;
    icc_weights *kernel = kernel_of(s,
                                    (icc_weights_options){.size = sizeof(icc_weights_options),
                                                          .kernel = ICC_KERNEL_GAUSS,
                                                          .within_shape = visible,
                                                          .steps = steps},
                                    &seconds);
    bench_check(icc_weights_get_info(kernel, &info), NULL);
    double *points = bench_alloc(info.n_nodes, 2 * sizeof *points);
    double *weights = bench_alloc(info.n_nodes, info.n_handles * sizeof *weights);
    bench_check(icc_weights_get_nodes(kernel, points, weights, NULL, NULL), NULL);
    for (size_t i = 0; i < info.n_nodes; ++i)
        if (points[2 * i] > 0.05 && points[2 * i] < 0.55 && points[2 * i + 1] > 0 &&
            points[2 * i + 1] < 1.2)
            most = fmax(most, weights[info.n_handles * i]);
    icc_weights_free(kernel);
    free(points);
    free(weights);
    return most;
}

static void leaks(void)
{
    const double u[16] = {-0.55, -1.2, 0.55,  -1.2, 0.55,  1.2, 0.05,  1.2,
                          0.05,  -0.7, -0.05, -0.7, -0.05, 1.2, -0.55, 1.2};
    stage s = {.n_handles = 4, .handles = {-0.05, 1.1, -0.5, -1.1, 0.5, -1.1, 0.5, 1.1}};
    icc_domain *regions[2] = {bench_domain(8, u), square(1.4)};
    sample(&s, shape_of(2, regions, 0, NULL, 0, NULL),
           (icc_sampling_options){.size = sizeof(icc_sampling_options), .spacing = 0.05});
    printf("leak across a gap of two spacings, 5 and 100 steps | unnoticed | through walls %.2f, "
           "%.2f; "
           "visible %.1e, %.1e | <= 4e-9\n",
           leak(&s, -1, 5), leak(&s, -1, 100), leak(&s, 1, 5), leak(&s, 1, 100));
    clear(&s);
}

/* ---- the stick figure ---- */

/* Head, limbs and what is around them: handles round the head, at the ends of the limbs and where
 * they meet. */
static void stick_figure(void)
{
    static const table t = {"table 6.6, stick figure",
                            {"", "yes      | yes      | yes      | no       | ~ -1e-3",
                             "yes      | yes      | yes      | no       | no",
                             "yes      | yes      | yes      | no       | ~ -1e-3"}};
    enum { CORNERS = 48 };
    double head[2 * CORNERS];
    stage s = {0};
    for (size_t i = 0; i < CORNERS; ++i) {
        bench_polar(head + 2 * i, 0.25, -90 + 360.0 * (double)i / CORNERS);
        head[2 * i + 1] += 0.75;
    }
    for (size_t i = 0; i < HEAD; ++i)
        memcpy(s.handles + 2 * i, head + 2 * i * (CORNERS / HEAD), 2 * sizeof(double));
    /* Shoulders, hips, hands, feet. */
    memcpy(s.handles + 2 * HEAD,
           (double[]){0, 0.3, 0, -0.35, 0.7, 0.1, -0.7, 0.1, 0.45, -1.1, -0.45, -1.1},
           12 * sizeof(double));
    const uint32_t limbs[12] = {0, 8, 8, 10, 8, 11, 8, 9, 9, 12, 9, 13};
    memcpy(s.edges, limbs, sizeof limbs);
    s.n_handles = MEN;
    s.n_edges = 6;
    icc_domain *regions[2] = {bench_domain(CORNERS, head), square(1.3)};
    sample(&s, shape_of(2, regions, MEN, s.handles, 6, limbs),
           (icc_sampling_options){.size = sizeof(icc_sampling_options), .spacing = 0.0345});
    judge_at(&s, CORNERS, head);
    judge(&s, &t, (icc_weights_options){.n_edges = s.n_edges, .edges = s.edges, .sigma = 0.035});
    clear(&s);
}

/* ---- the butterfly ---- */

static void butterfly(void)
{
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_BIHARMONIC; ++method) {
        stage s = {0};
        icc_binding *binding;
        icc_error error = {.size = sizeof error};
        double seconds;
        const double start = bench_seconds();
        for (size_t i = 0; i < CAGE; ++i) {
            const double angle = 360.0 * ((double)i + 0.5) / CAGE,
                         turn = angle * 0.017453292519943295;
            bench_polar(s.handles + 2 * i,
                        0.3 + 0.7 * fabs(sin(turn) * cos(turn)) * (2 - 0.5 * sin(turn)), angle);
        }
        close_ring(&s, CAGE);
        icc_domain *regions[2] = {bench_domain(CAGE, s.handles), square(1.25)};
        sample(&s, shape_of(2, regions, 0, NULL, 0, NULL),
               (icc_sampling_options){.size = sizeof(icc_sampling_options), .spacing = 0.041});
        icc_weights *kernel = kernel_of(&s,
                                        (icc_weights_options){.size = sizeof(icc_weights_options),
                                                              .n_edges = CAGE,
                                                              .edges = s.edges,
                                                              .method = method},
                                        &seconds);
        judge_at(&s, CAGE, s.handles);
        bench_check(icc_binding_create(&binding, kernel, s.n_points, s.points, 0, NULL, &error),
                    &error);
        const double all = bench_seconds() - start;
        icc_weights_info info = {.size = sizeof info};
        icc_weights_timings took = {.size = sizeof took};
        bench_check(icc_weights_get_info(kernel, &info), &error);
        bench_check(icc_weights_get_timings(kernel, &took), &error);
        printf(
            "butterfly, 26 handles, %s: all steps, s | thesis 11.3 (l1), bounded biharmonic "
            "weights "
            "29.9 | %.3f (%zu nodes: samples %.3f, kernel %.3f, of which weights %.4f; %zu points "
            "bound) | %s\n",
            METHOD[method], all, info.n_nodes, s.seconds, seconds, took.optimise, s.n_points,
            method == ICC_WEIGHTS_BIHARMONIC ? "for comparison" : "<= 1");
        icc_binding_free(binding);
        icc_weights_free(kernel);
        clear(&s);
    }
}

int main(void)
{
    stars();
    structure();
    leaks();
    stick_figure();
    butterfly();
    return EXIT_SUCCESS;
}
