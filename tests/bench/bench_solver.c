/* What Laplace's and the bi-Laplace function cost and how good they are, beside the figures to
 * reach and those of general solvers. Arguments: parts of the names of rows to run, "all" also for
 * those that take minutes; none: all others. One thread, the least processor time of up to five
 * runs. */
#include "../reports.h"
#include "bench.h"

#include "gradient/function/function.h"

#include "../functions.h"

enum { RUNS = 5 };

/* Runs go on until they took this long together, in seconds. */
static const double LONG = 2;

typedef struct row {
    const char *name;
    mask_shape shape;
    int32_t dim, function, constraints, solver;
    size_t cells;
    bool slow;                         /* not run unless asked for */
    double seconds, stretch, residual; /* to reach; 0: nothing is asked for */
    size_t n_iterations, bytes;        /* likewise */
    const char *others;
} row;

#define FREE ICC_CONSTRAINTS_NONE
#define TREE ICC_CONSTRAINTS_ALL
#define LAPLACE ICC_FUNCTION_LAPLACE

static const row ROWS[] = {
    {.name = "pcg box 1000^2",
     .shape = mask_box,
     .dim = 2,
     .cells = 1000,
     .function = LAPLACE,
     .constraints = FREE,
     .solver = ICC_SOLVER_ITERATIVE,
     .seconds = 0.25,
     .stretch = 0.08,
     .n_iterations = 20,
     .bytes = 130,
     .others = "CG 17.2 s, MIC(0)-CG 7.9 s, CHOLMOD 2.7 s"},
    {.name = "pcg box 128^3",
     .shape = mask_box,
     .dim = 3,
     .cells = 128,
     .function = LAPLACE,
     .constraints = FREE,
     .solver = ICC_SOLVER_ITERATIVE,
     .seconds = 0.8,
     .stretch = 0.25,
     .n_iterations = 20,
     .bytes = 130,
     .others = "CG 7.6 s, MIC(0)-CG 3.6 s, CHOLMOD: too large"},
    {.name = "direct star 1000^2",
     .shape = mask_star,
     .dim = 2,
     .cells = 1000,
     .function = LAPLACE,
     .constraints = FREE,
     .solver = ICC_SOLVER_DIRECT,
     .seconds = 1.4,
     .residual = 1e-12,
     .others = "CHOLMOD 0.66 s"},
    {.name = "direct C 1000^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 1000,
     .function = LAPLACE,
     .constraints = FREE,
     .solver = ICC_SOLVER_DIRECT,
     .seconds = 1.4,
     .residual = 1e-12,
     .others = "CHOLMOD 1.10 s"},
    {.name = "direct serpentine 1000^2",
     .shape = mask_serpentine,
     .dim = 2,
     .cells = 1000,
     .function = LAPLACE,
     .constraints = FREE,
     .solver = ICC_SOLVER_DIRECT,
     .residual = 1e-12,
     .others = "CHOLMOD: 819,341 zeros of 901,764"},
    {.name = "tree C 50^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 50,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_DIRECT,
     .seconds = 0.005,
     .residual = 1e-12},
    {.name = "tree C 200^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 200,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_DIRECT,
     .seconds = 0.1,
     .residual = 1e-12,
     .others = "Ipopt + MUMPS 5.4 s at 7e-6, NLopt L-BFGS 19 s at 1.7e-5, CLP none in 60 s"},
    {.name = "tree L 1000^2",
     .shape = mask_l,
     .dim = 2,
     .cells = 1000,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_DIRECT,
     .seconds = 10,
     .residual = 1e-12},
    {.name = "tree star 1000^2",
     .shape = mask_star,
     .dim = 2,
     .cells = 1000,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_DIRECT,
     .residual = 1e-12,
     .others = "the prototype: 11 s"},
    {.name = "tree C 1000^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 1000,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_DIRECT,
     .seconds = 50,
     .stretch = 15,
     .residual = 1e-12},
    {.name = "tree C tube 64^3",
     .shape = mask_c_tube,
     .dim = 3,
     .cells = 64,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_DIRECT,
     .seconds = 2,
     .residual = 1e-12,
     .others = "Ipopt + MUMPS 9.1 s at 5e-6"},
    {.name = "tree pcg C tube 128^3",
     .shape = mask_c_tube,
     .dim = 3,
     .cells = 128,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_ITERATIVE,
     .seconds = 3,
     .residual = 1e-9},
    {.name = "tree pcg tripod 128^3",
     .shape = mask_tripod,
     .dim = 3,
     .cells = 128,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_ITERATIVE,
     .seconds = 3,
     .residual = 1e-9},
    {.name = "tree pcg dumbbell 128^3",
     .shape = mask_dumbbell,
     .dim = 3,
     .cells = 128,
     .function = LAPLACE,
     .constraints = TREE,
     .solver = ICC_SOLVER_ITERATIVE,
     .seconds = 3,
     .residual = 1e-9},
    {.name = "bilaplace C 1000^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 1000,
     .function = ICC_FUNCTION_BILAPLACE,
     .constraints = FREE},
    {.name = "tree bilaplace C 200^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 200,
     .function = ICC_FUNCTION_BILAPLACE,
     .constraints = TREE,
     .others = "the prototype: 0.9 to 3.8 s at 1e-10 to 8e-9"},
    {.name = "tree clamped C 200^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 200,
     .function = ICC_FUNCTION_CLAMPED,
     .constraints = TREE},
    {.name = "tree bilaplace C 1000^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 1000,
     .function = ICC_FUNCTION_BILAPLACE,
     .constraints = TREE,
     .seconds = 60,
     .residual = 1e-11,
     .slow = true},
    {.name = "tree clamped C 1000^2",
     .shape = mask_c,
     .dim = 2,
     .cells = 1000,
     .function = ICC_FUNCTION_CLAMPED,
     .constraints = TREE,
     .slow = true},
};
enum { N_ROWS = sizeof ROWS / sizeof *ROWS };

/* Allocations remember their size, and the longest time between two looks at the progress callback
 * is kept. */
typedef struct meter {
    size_t live, most;
    double last, longest;
    char stage[32], worst[32]; /* the stage after the longest gap */
} meter;

enum { HEADER = 16 }; /* keeps what follows aligned for any type */

static void *meter_alloc(void *user, size_t size)
{
    meter *m = user;
    char *memory = malloc(size + HEADER);
    if (memory == NULL)
        return NULL;
    memcpy(memory, &size, sizeof size);
    m->live += size;
    if (m->live > m->most)
        m->most = m->live;
    return memory + HEADER;
}

static void meter_dealloc(void *user, void *memory)
{
    size_t size;
    char *start = (char *)memory - HEADER;
    memcpy(&size, start, sizeof size);
    ((meter *)user)->live -= size;
    free(start);
}

static int32_t meter_progress(void *user, const char *stage, double share)
{
    meter *m = user;
    const double now = bench_seconds();
    (void)share;
    if (now - m->last > m->longest) {
        m->longest = now - m->last;
        (void)snprintf(m->worst, sizeof m->worst, "%s", m->stage);
    }
    (void)snprintf(m->stage, sizeof m->stage, "%s", stage);
    m->last = now;
    return 0;
}

typedef struct figures {
    icc_function_info info;
    icc_solver_report solver;
    icc_function_report report;
    double cpu, wall, imbalance, longest;
    char worst[32];
    size_t n, n_violated, most;
} figures;

static ground ground_of(const row *r)
{
    ground g;
    icc_error error = {.size = sizeof error};
    mask m = mask_draw(r->shape, r->dim, r->cells);
    const size_t side = r->cells + 2 * MASK_MARGIN, at = MASK_MARGIN + 8;
    if (m.inside == NULL)
        bench_check(ICC_ERR_MEMORY, &error);
    /* The serpentine from its end, so that it is as long as it can be. */
    const uint32_t root = r->shape == mask_serpentine ? (uint32_t)(at + side * at) : UINT32_MAX;
    bench_check(ground_create(&g, &m, root, 0), &error);
    mask_free(&m);
    return g;
}

/* As ground_imbalance(), without the rounding of logarithms, which are as large as 8,000. */
static double find_imbalance(const ground *g, const icc_function *field)
{
    double worst = 0;
    for (size_t i = 1; i < g->n; ++i) {
        uint32_t around[1 + 2 * ICC_MAX_DIM] = {g->order[i]};
        double f[1 + 2 * ICC_MAX_DIM], sum = 0;
        size_t n = 1;
        for (int32_t d = 0; d < 2 * g->info.dim; ++d) {
            const uint32_t u = ground_neighbour(g, g->order[i], d);
            if (u != UINT32_MAX && ground_holds(g, u))
                around[n++] = u;
        }
        iccp_function_local(field, n, around, f);
        for (size_t k = 1; k < n; ++k)
            sum += f[k];
        worst = fmax(worst, fabs(sum / (2 * g->info.dim * f[0]) - 1));
    }
    return worst;
}

/* Edges where the logarithms say that the inequality does not hold; it may be tight up to
 * rounding. */
static size_t count_violated(const ground *g, const icc_function *field)
{
    const double *u = icc_function_logs(field);
    size_t n_violated = 0;
    if (u == NULL)
        return ground_violated(g, 1e-6, icc_function_values(field));
    for (size_t i = 1; i < g->n; ++i) {
        const uint32_t v = g->order[i];
        n_violated += u[g->parent[v]] - u[v] < log1p(1e-6) - 1e-15 * (4 - u[v]);
    }
    return n_violated;
}

static icc_function *run(const row *r, const ground *g, figures *out)
{
    const icc_function_options options = {.size = sizeof options,
                                          .function = r->function,
                                          .constraints = r->constraints,
                                          .solver = r->solver};
    static meter m; /* the field gives its memory back to it later */
    m = (meter){.last = bench_seconds()};
    const icc_env env = {.size = sizeof env,
                         .user = &m,
                         .alloc = meter_alloc,
                         .dealloc = meter_dealloc,
                         .progress = meter_progress};
    icc_error error = {.size = sizeof error};
    icc_function *field;
    const double start = bench_seconds();
    const double ticks = bench_processor_seconds();
    const icc_status status = icc_function_create(&field, g->tree, &options, &env, &error);
    const double cpu = bench_processor_seconds() - ticks;
    const double wall = bench_seconds() - start;
    if (status != ICC_OK) {
        printf("%-26s %s: %s\n", r->name, icc_status_name(status), error.message);
        return NULL;
    }
    (void)meter_progress(&m, "", 1);
    if (cpu < out->cpu) {
        out->cpu = cpu;
        out->wall = wall;
        out->longest = m.longest;
        memcpy(out->worst, m.worst, sizeof m.worst);
        (void)icc_function_get_info(field, &out->info);
        out->solver = solver_report_of(field);
    }
    out->most = m.most;
    return field;
}

static bool is_reached(const row *r, const figures *f)
{
    const double residual = r->constraints == TREE ? f->solver.residual_before : f->imbalance;
    return (r->seconds <= 0 || f->cpu <= r->seconds) &&
           (r->residual <= 0 || residual <= r->residual) &&
           (r->n_iterations == 0 || f->solver.n_inner <= r->n_iterations) &&
           (r->bytes == 0 || f->most <= r->bytes * f->n) &&
           (r->constraints == FREE || f->n_violated == 0);
}

static void print(const row *r, const figures *f)
{
    const icc_function_info *i = &f->info;
    printf("%-26s %7zu %8.4f %6.3g %8.4f %7.3f %7.3f %7.3f %7.3f %7.3f %4zu %5zu %5.1f %5.1f %8.1e "
           "%8.1e "
           "%4zu %2zu/%zu/%zu %8.1e %6.0f %6.0f %-10.10s %s\n",
           r->name, f->n, f->cpu, r->seconds, f->wall, f->solver.seconds_setup,
           f->solver.seconds_order, f->solver.seconds_factor, f->solver.seconds_solve,
           f->solver.seconds_verify, f->solver.n_iterations, f->solver.n_inner,
           100 * (double)i->n_violated / (double)f->n, 100 * (double)i->n_active / (double)f->n,
           f->solver.residual_before, i->residual, f->n_violated, f->report.n_maxima,
           f->report.n_minima, f->report.n_saddles, f->imbalance, (double)f->most / (double)f->n,
           1e3 * f->longest, f->worst, is_reached(r, f) ? "" : "MISSED");
    if (r->stretch > 0)
        printf("%26s stretch %.3g s\n", "", r->stretch);
    if (r->others != NULL)
        printf("%26s %s\n", "", r->others);
    fflush(stdout);
}

static void measure(const row *r)
{
    figures f = {.info = {.size = sizeof f.info}, .report = {.size = sizeof f.report}};
    icc_error error = {.size = sizeof error};
    ground g = ground_of(r);
    f.cpu = HUGE_VAL;
    f.n = g.n;
    const double start = bench_seconds();
    icc_function *field = NULL;
    for (int k = 0; k == 0 || (k < RUNS && bench_seconds() - start < LONG); ++k) {
        icc_function_free(field);
        field = run(r, &g, &f);
        if (field == NULL)
            break;
    }
    if (field != NULL) {
        bench_check(icc_function_get_report(field, &f.report, NULL, &error), &error);
        f.imbalance =
            r->function == LAPLACE && !f.info.constrained ? find_imbalance(&g, field) : NAN;
        f.n_violated = f.info.constrained ? count_violated(&g, field) : 0;
        print(r, &f);
    }
    icc_function_free(field);
    ground_free(&g);
}

static bool is_wanted(const row *r, int argc, char **argv)
{
    for (int k = 1; k < argc; ++k)
        if (strcmp(argv[k], "all") == 0 || strstr(r->name, argv[k]) != NULL)
            return true;
    return argc == 1 && !r->slow;
}

int main(int argc, char **argv)
{
    printf("bar: processor seconds to reach; setup to verify: seconds by the clock on the wall; "
           "its: of the "
           "active set or interior\npoint method, inner: of conjugate gradients; viol%%: without "
           "constraints; nat: largest |min(slack, multiplier)|, or row of\nthe equation, before "
           "and after "
           "the sweep; left: violated edges in the end; M/m/s: maxima, minima, saddles; compon.:\n"
           "componentwise residual, found anew; gap: longest time between two progress reports, in "
           "ms, and "
           "its stage\n\n");
    printf(
        "%-26s %7s %8s %6s %8s %7s %7s %7s %7s %7s %4s %5s %5s %5s %8s %8s %4s %6s %8s %6s %6s\n",
        "", "n", "cpu s", "bar", "wall s", "setup", "order", "factor", "solve", "verify", "its",
        "inner", "viol%", "act%", "nat", "after", "left", "M/m/s", "compon.", "B/n", "gap");
    for (int k = 0; k < N_ROWS; ++k)
        if (is_wanted(&ROWS[k], argc, argv))
            measure(&ROWS[k]);
    return EXIT_SUCCESS;
}
