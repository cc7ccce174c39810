/* What five-point and seven-point Laplacians cost to order, analyse, factorise and solve, beside
 * CHOLMOD where it is installed. Arguments: names of shapes to try, all by default; `nd` orders
 * by dissection instead of by degree, `plain` leaves CHOLMOD out. One thread, and seconds of its
 * own: other programs disturb them less. */
#include "bench.h"

#include "gradient/grid/grassfire.h"
#include "gradient/solver/dissection.h"
#include "math/ldlt.h"
#include "math/ordering.h"

#include <stdbool.h>

#ifdef BENCH_WITH_CHOLMOD
#include <cholmod.h>
#endif

#define OUTSIDE UINT32_MAX

/* Unknowns of a grid of size^dim cells: those inside a shape. */
typedef struct grid {
    size_t size, layers, n;
    uint32_t *unknown; /* of each cell, or OUTSIDE */
    uint32_t *cell;    /* of each unknown */
} grid;

typedef bool (*inside)(double x, double y, double z);

static bool is_square(double x, double y, double z)
{
    (void)x;
    (void)y;
    (void)z;
    return true;
}

static bool is_l(double x, double y, double z)
{
    (void)z;
    return x < 0 || y < 0;
}

static bool is_c(double x, double y, double z)
{
    const double radius = hypot(x, y);
    (void)z;
    return radius < 0.96 && radius > 0.5 && !(x > 0 && fabs(y) < 0.25);
}

static bool is_star(double x, double y, double z)
{
    (void)z;
    return hypot(x, y) < 0.65 + 0.3 * cos(5 * atan2(y, x));
}

/* Corridors 36 thousandths of the square wide, to and fro. */
static bool is_snake(double x, double y, double z)
{
    const double lane = (y + 1) * 25;
    const int k = (int)lane;
    (void)z;
    return lane - k < 0.9 || (k % 2 ? x < -0.964 : x > 0.964);
}

static bool is_tube(double x, double y, double z)
{
    const double radius = hypot(x, y);
    return hypot(radius - 0.68, z) < 0.26 && !(x > 0 && fabs(y) < 0.3);
}

static const struct {
    const char *name;
    inside is_inside;
    size_t size, layers;
} SHAPES[] = {
    {"square200", is_square, 200, 1},
    {"l200", is_l, 200, 1},
    {"c200", is_c, 200, 1},
    {"star200", is_star, 200, 1},
    {"square1000", is_square, 1000, 1},
    {"l1000", is_l, 1000, 1},
    {"c1000", is_c, 1000, 1},
    {"star1000", is_star, 1000, 1},
    {"snake1000", is_snake, 1000, 1},
    {"box32", is_square, 32, 32},
    {"tube32", is_tube, 32, 32},
    {"tube64", is_tube, 64, 64},
    {"box64", is_square, 64, 64},
};

static grid make_grid(inside is_inside, size_t size, size_t layers)
{
    const size_t n_cells = size * size * layers;
    grid g = {.size = size,
              .layers = layers,
              .unknown = bench_alloc(n_cells, sizeof *g.unknown),
              .cell = bench_alloc(n_cells, sizeof *g.cell)};
    for (size_t i = 0; i < n_cells; ++i) {
        const double x = (double)(2 * (i % size) + 1) / (double)size - 1;
        const double y = (double)(2 * (i / size % size) + 1) / (double)size - 1;
        const double z = (double)(2 * (i / size / size) + 1) / (double)layers - 1;
        g.unknown[i] = OUTSIDE;
        if (is_inside(x, y, z)) {
            g.cell[g.n] = (uint32_t)i;
            g.unknown[i] = (uint32_t)g.n++;
        }
    }
    return g;
}

/* The neighbour of a cell in direction d, or OUTSIDE. */
static uint32_t neighbour(const grid *g, size_t cell, int d)
{
    const size_t step = d / 2 == 0 ? 1 : d / 2 == 1 ? g->size : g->size * g->size;
    const size_t most = d / 2 == 2 ? g->layers : g->size, at = cell / step % most;
    if (d % 2 == 0)
        return at == 0 ? OUTSIDE : g->unknown[cell - step];
    return at + 1 == most ? OUTSIDE : g->unknown[cell + step];
}

typedef struct equations {
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
} equations;

static equations laplacian(const grid *g)
{
    const int directions = g->layers > 1 ? 6 : 4;
    equations s = {bench_alloc(g->n + 1, sizeof *s.first),
                   bench_alloc((size_t)directions * g->n, sizeof *s.column),
                   bench_alloc((size_t)directions * g->n, sizeof *s.value),
                   bench_alloc(g->n, sizeof *s.diagonal)};
    size_t n_entries = 0;
    for (size_t i = 0; i < g->n; ++i) {
        s.diagonal[i] = directions;
        for (int d = 0; d < directions; ++d) {
            const uint32_t j = neighbour(g, g->cell[i], d);
            if (j == OUTSIDE)
                continue;
            s.column[n_entries] = j;
            s.value[n_entries++] = -1;
        }
        s.first[i + 1] = n_entries;
    }
    return s;
}

/* The same cells as rows of a tree from the grassfire's maximum, and the order for those. */
static double dissect(const grid *g, uint32_t *order, const iccp_env *env)
{
    const size_t shape[3] = {g->size, g->size, g->layers};
    uint8_t *marks = bench_alloc(g->size * g->size * g->layers, 1);
    icc_error error = {.size = sizeof error};
    icc_grid *lattice;
    icc_tree *tree;
    iccp_unknowns unknowns;
    uint32_t root;
    for (size_t i = 0; i < g->size * g->size * g->layers; ++i)
        marks[i] = g->unknown[i] != OUTSIDE;
    bench_check(iccp_grid_create_mask(&lattice, g->layers > 1 ? 3 : 2, shape, marks, env, &error),
                &error);
    bench_check(iccp_grassfire(lattice, &root, NULL, env, &error), &error);
    bench_check(iccp_tree_create(&tree, lattice, root, ICC_TREE_PAPER, NULL, env, &error), &error);
    bench_check(iccp_unknowns_create(&unknowns, tree, env), &error);
    const double start = bench_processor_seconds();
    bench_check(iccp_dissection(&unknowns, order, env), &error);
    const double end = bench_processor_seconds();
    for (size_t k = 0; k < g->n; ++k)
        order[k] = g->unknown[unknowns.vertex[order[k]]];
    iccp_unknowns_free(&unknowns);
    iccp_tree_release(tree);
    iccp_grid_release(lattice);
    free(marks);
    return end - start;
}

#ifdef BENCH_WITH_CHOLMOD

static void time_cholmod(const iccp_symmetric *m)
{
    cholmod_common common;
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    cholmod_sparse *a =
        cholmod_allocate_sparse(m->n, m->n, m->n + m->first[m->n], 0, 1, 1, CHOLMOD_REAL, &common);
    int *start = a->p, *row = a->i, k = 0;
    double *value = a->x;
    for (size_t j = 0; j < m->n; ++j) {
        start[j] = k;
        row[k] = (int)j;
        value[k++] = m->diagonal[j];
        for (size_t p = m->first[j]; p < m->first[j + 1]; ++p)
            if (m->column[p] < j) {
                row[k] = (int)m->column[p];
                value[k++] = m->value[p];
            }
    }
    start[m->n] = k;
    const double t0 = bench_processor_seconds();
    cholmod_factor *factor = cholmod_analyze(a, &common);
    const double t1 = bench_processor_seconds();
    cholmod_factorize(a, factor, &common);
    const double t2 = bench_processor_seconds();
    cholmod_dense *b = cholmod_ones(m->n, 1, CHOLMOD_REAL, &common);
    const double t3 = bench_processor_seconds();
    cholmod_dense *x = cholmod_solve(CHOLMOD_A, factor, b, &common);
    printf("  cholmod    analyse %.3f  factor %.3f  solve %.4f  lnz %.3g  %.0f MB\n", t1 - t0,
           t2 - t1, bench_processor_seconds() - t3, common.lnz, (double)common.memory_usage * 1e-6);
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&b, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&a, &common);
    cholmod_finish(&common);
}

#endif

/* The largest |A x - b| of a row in units of |A| |x| + |b|, x scaled. */
static double residual(const iccp_symmetric *m, const iccp_scaled *x, size_t source)
{
    double worst = 0;
    for (size_t i = 0; i < m->n; ++i) {
        int32_t unit = x->exponent[i];
        for (size_t p = m->first[i]; p < m->first[i + 1]; ++p)
            if (x->exponent[m->column[p]] > unit)
                unit = x->exponent[m->column[p]];
        double sum = m->diagonal[i] * iccp_scaled_get(x, i, unit), size = fabs(sum);
        for (size_t p = m->first[i]; p < m->first[i + 1]; ++p) {
            const double term = m->value[p] * iccp_scaled_get(x, m->column[p], unit);
            sum += term;
            size += fabs(term);
        }
        if (i == source)
            sum -= ldexp(1, -unit);
        worst = fmax(worst, fabs(sum) / size);
    }
    return worst;
}

static void time_solves(const iccp_ldlt *factor, const iccp_symmetric *m, const iccp_env *env)
{
    const size_t n = m->n, source = n / 2;
    double *x = bench_alloc(2 * n, sizeof *x);
    iccp_scaled y = {bench_alloc(n, sizeof(double)), bench_alloc(n, sizeof(int32_t))};
    const iccp_scaled work = {x, bench_alloc(n, sizeof(int32_t))};
    for (size_t i = 0; i < n; ++i)
        iccp_scaled_set(&y, i, i == source, 0);
    x[source] = 1;
    const double t0 = bench_processor_seconds();
    iccp_ldlt_solve(factor, 1, x, x + n);
    const double t1 = bench_processor_seconds();
    bench_check(iccp_ldlt_solve_scaled(factor, &y, &work, env), &(icc_error){.message = "solve"});
    const double t2 = bench_processor_seconds();
    int32_t lowest = 0;
    for (size_t i = 0; i < n; ++i)
        lowest = y.exponent[i] < lowest ? y.exponent[i] : lowest;
    printf("  solve %.4f  scaled %.4f  residual %.1e  lowest 2^%d\n", t1 - t0, t2 - t1,
           residual(m, &y, source), (int)lowest);
    free(x);
    free(y.fraction);
    free(y.exponent);
    free(work.exponent);
}

static void time_ours(const grid *g, const iccp_symmetric *m, bool dissected)
{
    iccp_env env;
    bench_check(iccp_env_read(&env, NULL, NULL), &(icc_error){.size = sizeof(icc_error)});
    uint32_t *order = bench_alloc(m->n, sizeof *order);
    iccp_ldlt factor;
    const icc_error error = {.size = sizeof error};
    const double taken = dissected ? dissect(g, order, &env) : 0,
                 t0 = bench_processor_seconds() - taken;
    if (!dissected)
        bench_check(iccp_ordering(m, order, &env), &error);
    const double t1 = bench_processor_seconds();
    bench_check(iccp_ldlt_analyse_ordered(&factor, m, order, &env), &error);
    const double t2 = bench_processor_seconds();
    bench_check(iccp_ldlt_factorise(&factor, m, &env), &error);
    const double t3 = bench_processor_seconds();
    bench_check(iccp_ldlt_factorise(&factor, m, &env), &error);
    const double t4 = bench_processor_seconds();
    printf("  %s  order %.3f  analyse %.3f  factor %.3f  again %.3f  entries %.3g  work %.3g  %.1f "
           "GF/s"
           "  supernodes %zu  %.0f MB\n",
           dissected ? "dissection" : "degree    ", t1 - t0, t2 - t1, t3 - t2, t4 - t3,
           (double)factor.n_entries, factor.work, 2e-9 * factor.work / (t4 - t3), factor.nodes.n,
           1e-6 * iccp_ldlt_bytes(&factor));
    time_solves(&factor, m, &env);
    iccp_ldlt_free(&factor);
    free(order);
}

int main(int argc, char **argv)
{
    bool all = true, dissected = false, alone = false;
    for (int a = 1; a < argc; ++a) {
        dissected = dissected || strcmp(argv[a], "nd") == 0;
        alone = alone || strcmp(argv[a], "plain") == 0;
        all = all && (strcmp(argv[a], "nd") == 0 || strcmp(argv[a], "plain") == 0);
    }
    for (size_t k = 0; k < sizeof SHAPES / sizeof *SHAPES; ++k) {
        bool wanted = all;
        for (int a = 1; a < argc; ++a)
            wanted = wanted || strcmp(argv[a], SHAPES[k].name) == 0;
        if (!wanted)
            continue;
        grid g = make_grid(SHAPES[k].is_inside, SHAPES[k].size, SHAPES[k].layers);
        equations s = laplacian(&g);
        const iccp_symmetric m = {g.n, s.first, s.column, s.value, s.diagonal};
        printf("%s: %zu unknowns\n", SHAPES[k].name, g.n);
        time_ours(&g, &m, dissected);
#ifdef BENCH_WITH_CHOLMOD
        if (!alone)
            time_cholmod(&m);
#endif
        fflush(stdout);
        free(s.first);
        free(s.column);
        free(s.value);
        free(s.diagonal);
        free(g.unknown);
        free(g.cell);
    }
    return EXIT_SUCCESS;
}
