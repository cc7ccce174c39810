/* What holds for Laplace's and the bi-Laplace function of every mask: the equations, the
 * inequalities and the conditions of optimality, all found anew from the public interface. */
#include "../functions.h"
#include "../infos.h"
#include "../reports.h"
#include "../suite.h"

#include "../faulty.h"
#include "../random.h"
#include "../shapes.h"
#include "../share.h"

#include <check.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double ETA = 1e-6, LEAF = 1e-9; /* the defaults */

static icc_function_options choice(int32_t function, int32_t constraints, int32_t solver)
{
    return (icc_function_options){.size = sizeof(icc_function_options),
                                  .function = function,
                                  .constraints = constraints,
                                  .solver = solver};
}

static icc_function *field_with(const ground *g, const icc_function_options *options)
{
    icc_function *field;
    icc_error err = {.size = sizeof err, .message = "no message"};
    const icc_status status = icc_function_create(&field, g->tree, options, NULL, &err);
    if (status != ICC_OK)
        ck_abort_msg("function %d, constraints %d, solver %d, eta %g, leaf %g, %zu vertices: %s",
                     (int)options->function, (int)options->constraints, (int)options->solver,
                     options->min_fall, options->leaf_min, g->n, err.message);
    return field;
}

static icc_function *field_of(const ground *g, int32_t function, int32_t constraints,
                              int32_t solver)
{
    const icc_function_options options = choice(function, constraints, solver);
    return field_with(g, &options);
}

static icc_function_info info_of(const icc_function *field)
{
    icc_function_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_function_get_info(field, &info), ICC_OK);
    return info;
}

static void check_regular(const icc_function *field)
{
    const icc_function_report report = report_of_function(field);
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima, 0);
    ck_assert_uint_eq(report.n_saddles, 0);
    ck_assert_uint_eq(report.critical, UINT32_MAX);
}

static double *room_for(const ground *g)
{
    double *room = malloc(g->info.n_vertices * sizeof *room);
    ck_assert_ptr_nonnull(room);
    return room;
}

static ground ground_on(mask_shape drawn, int32_t dim, size_t cells)
{
    ground g;
    mask m = mask_draw(drawn, dim, cells);
    ck_assert_ptr_nonnull(m.inside);
    ck_assert_int_eq(ground_create(&g, &m, UINT32_MAX, 0), ICC_OK);
    mask_free(&m);
    return g;
}

/* Any vertices inside, none at the border; the part with the root has at least two. */
static ground random_ground(random_source *r, int32_t dim, int widest)
{
    uint8_t inside[4096];
    for (;;) {
        mask m = {.dim = dim, .n_vertices = 1, .inside = inside};
        const int density = 5 + random_below(r, 6);
        for (int32_t k = 0; k < dim; ++k)
            m.n_vertices *= m.shape[k] = (size_t)(4 + random_below(r, widest - 1));
        for (size_t v = 0; v < m.n_vertices; ++v) {
            inside[v] = random_below(r, 10) < density;
            for (size_t k = 0, rest = v; k < (size_t)dim; rest /= m.shape[k++])
                if (rest % m.shape[k] == 0 || rest % m.shape[k] == m.shape[k] - 1)
                    inside[v] = 0;
        }
        const uint32_t root = (uint32_t)random_below(r, (int)m.n_vertices);
        ground g;
        if (!inside[root])
            continue;
        ck_assert_int_eq(ground_create(&g, &m, root, 1 + random_below(r, 2)), ICC_OK);
        if (g.n > 1)
            return g;
        ground_free(&g);
    }
}

/* Every mask, `cells` wide in the plane and half as wide in space. */
static ground ground_number(int k, size_t cells)
{
    const mask_kind kind = mask_number(k);
    const int32_t dim = kind.dim != 0 ? kind.dim : 2 + k % 2;
    return ground_on(kind.shape, dim, dim == 2 ? cells : cells / 2);
}

/* ----------------------------------------------------------- every function */

/* What lies outside: 0 next to the inside, beyond that minus the highest value two steps back. */
static double value_outside(const ground *g, const double *f, uint32_t v)
{
    double highest = -HUGE_VAL;
    for (int32_t i = 0; i < 2 * g->info.dim; ++i) {
        const uint32_t ring = ground_neighbour(g, v, i);
        if (ring != UINT32_MAX && icc_grid_inside(g->grid)[ring])
            return 0;
        for (int32_t j = 0; ring != UINT32_MAX && j < 2 * g->info.dim; ++j) {
            const uint32_t u = ground_neighbour(g, ring, j);
            if (u != UINT32_MAX && ground_holds(g, u))
                highest = fmax(highest, f[u]);
        }
    }
    return -highest;
}

/* Where there are values, and that logarithms say the same as far as doubles go. */
static void check_values(const ground *g, const icc_function *field, const icc_function_info *info)
{
    const double *f = icc_function_values(field), *u = icc_function_logs(field);
    double least = 0, lowest = 1;
    for (uint32_t v = 0; v < g->info.n_vertices; ++v) {
        ck_assert(isnan(f[v]) == (g->generation[v] < 0));
        ck_assert(u == NULL || isnan(u[v]) == (g->generation[v] < 0));
        if (g->generation[v] < 0)
            continue;
        if (!icc_grid_inside(g->grid)[v]) {
            ck_assert(f[v] == value_outside(g, f, v) && (u == NULL || u[v] == -HUGE_VAL));
            continue;
        }
        /* A bi-Laplace function may be higher than at the root, if nothing keeps it from that. */
        const bool may_exceed = !info->constrained && info->function != ICC_FUNCTION_LAPLACE;
        if (v == g->root ? f[v] != 1 : f[v] >= 1 && !may_exceed)
            ck_abort_msg("function %d, solver %d: %.17g%s", (int)info->function, (int)info->solver,
                         f[v], v == g->root ? " at the root" : "");
        lowest = fmin(lowest, f[v]);
        if (u == NULL)
            continue;
        least = fmin(least, u[v]);
        ck_assert(isfinite(u[v]) && f[v] >= 0 && (f[v] > 0 || u[v] < -700));
        if (f[v] >= DBL_MIN)
            ck_assert_double_le(fabs(u[v] - log(f[v])), 4 * DBL_EPSILON * (1 + fabs(u[v])));
    }
    ck_assert(u != NULL || lowest <= 0);
    ck_assert_double_eq(info->least_log, least);
}

static void check_info(const ground *g, const icc_function_info *info,
                       const icc_solver_report *made, const icc_function_options *options)
{
    ck_assert_int_eq(info->function, options->function);
    ck_assert(info->solver == ICC_SOLVER_DIRECT || info->solver == ICC_SOLVER_ITERATIVE);
    ck_assert_uint_eq(info->n_unknowns, g->n - 1);
    ck_assert(options->constraints != ICC_CONSTRAINTS_ALL || info->constrained == 1);
    ck_assert(options->constraints != ICC_CONSTRAINTS_NONE || info->constrained == 0);
    ck_assert(info->constrained || (info->n_active == 0 && made->n_iterations == 0));
    ck_assert(isfinite(info->residual) && info->residual >= 0 && made->work >= 0);
    ck_assert(isfinite(made->residual_before) && made->residual_before >= 0);
    ck_assert(made->seconds_setup >= 0 && made->seconds_order >= 0 && made->seconds_factor >= 0 &&
              made->seconds_solve >= 0 && made->seconds_verify >= 0);
}

/* Bounds of the bi-Laplace functions, too. */
static void check_inequalities(const ground *g, const icc_function *field, int32_t function)
{
    const double *f = icc_function_values(field);
    ck_assert_uint_eq(ground_violated(g, ETA, f), 0);
    for (size_t i = 1; i < g->n && function != ICC_FUNCTION_LAPLACE; ++i)
        ck_assert_double_ge(f[g->order[i]], LEAF);
    ck_assert_ptr_nonnull(icc_function_logs(field));
}

/* Vertices less edges plus triangles of the inside of a grid in the plane: 1 less the number of
 * holes. */
static long euler_characteristic(const ground *g)
{
    const uint32_t nx = (uint32_t)g->info.shape[0];
    long sum = 0;
    for (uint32_t v = 0; v + nx + 1 < g->info.n_vertices; ++v) {
        const bool here = ground_holds(g, v), right = ground_holds(g, v + 1);
        const bool above = ground_holds(g, v + nx), across = ground_holds(g, v + nx + 1);
        sum += here - (here && right) - (here && above) - (here && across) +
               (here && right && across) + (here && above && across);
    }
    return sum; /* nothing lies in the last row or column */
}

/* No critical points that constraints could remove. */
static void check_not_needed(const ground *g, const icc_function *field)
{
    const icc_function_report report = report_of_function(field);
    const long holes = g->info.dim == 2 ? 1 - euler_characteristic(g) : 0;
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima, 0);
    ck_assert_int_le((long)report.n_saddles, holes);
    ck_assert(holes == 0 || report.n_saddles > 0);
    for (size_t i = 1; i < g->n; ++i)
        ck_assert(icc_function_values(field)[g->order[i]] <= 1);
}

static void check_choice(const ground *g, const icc_function_options *options)
{
    icc_function *field = field_with(g, options);
    const icc_function_info info = info_of(field);
    check_values(g, field, &info);
    const icc_solver_report made = solver_report_of(field);
    check_info(g, &info, &made, options);
    if (info.constrained)
        check_inequalities(g, field, options->function);
    else
        ck_assert(options->function == ICC_FUNCTION_CLAMPED || icc_function_logs(field) != NULL);
    const icc_function_report report = report_of_function(field);
    ck_assert_uint_ge(report.n_maxima, 1);
    if (options->constraints == ICC_CONSTRAINTS_NEEDED && !info.constrained)
        check_not_needed(g, field);
    icc_function_free(field);
}

static void check_all_choices(const ground *g)
{
    for (int32_t function = ICC_FUNCTION_LAPLACE; function <= ICC_FUNCTION_CLAMPED; ++function)
        for (int32_t constraints = 0; constraints <= ICC_CONSTRAINTS_ALL; ++constraints)
            for (int32_t solver = 0; solver <= ICC_SOLVER_ITERATIVE; ++solver) {
                const icc_function_options options = choice(function, constraints, solver);
                check_choice(g, &options);
            }
}

START_TEST(every_choice_on_random_masks)
{
    random_source r = {1};
    for (int round = 0; round < share_of(120); ++round) {
        ground g = random_ground(&r, 1 + round % 4, round % 4 == 3 ? 3 : 8);
        check_all_choices(&g);
        ground_free(&g);
    }
}
END_TEST

START_TEST(every_choice_on_every_shape)
{
    ground g = ground_number(_i, 20);
    check_all_choices(&g);
    ground_free(&g);
}
END_TEST

/* ----------------------------------------------------------------- Laplace */

START_TEST(laplace_is_the_mean_of_its_neighbours)
{
    random_source r = {2};
    for (int round = 0; round < N_MASKS + 60; ++round) {
        ground g = round < N_MASKS ? ground_number(round, 40)
                                   : random_ground(&r, 1 + round % 4, round % 4 == 3 ? 4 : 9);
        icc_function *field =
            field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT);
        const double *f = icc_function_values(field), *u = icc_function_logs(field);
        for (size_t i = 1; i < g.n; ++i)
            ck_assert(u[g.order[i]] < 0 && f[g.order[i]] < 1 && f[g.order[i]] > 0);
        ck_assert_double_le(ground_imbalance(&g, u), 1e-12);
        double residual = 0;
        for (size_t i = 1; i < g.n; ++i)
            residual = fmax(residual, fabs(ground_laplacian(&g, f, g.order[i])));
        const icc_function_info info = info_of(field);
        ck_assert_double_le(fabs(info.residual - residual), 1e-15);
        ck_assert_double_eq(solver_report_of(field).residual_before, info.residual);
        ck_assert_uint_eq(info.n_violated, ground_violated(&g, ETA, f));
        icc_function_free(field);
        ground_free(&g);
    }
}
END_TEST

/* Conjugate gradients, in shells: small values are as good as large ones. */
START_TEST(both_solvers_give_the_same_function)
{
    for (int k = 0; k < N_MASKS; ++k) {
        ground g = ground_number(k, 40);
        icc_function *direct =
            field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT);
        icc_function *iterative =
            field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_ITERATIVE);
        ck_assert_int_eq(info_of(direct).solver, ICC_SOLVER_DIRECT);
        ck_assert_int_eq(info_of(iterative).solver, ICC_SOLVER_ITERATIVE);
        ck_assert_uint_gt(solver_report_of(iterative).n_inner, 0);
        double worst = 0;
        for (size_t i = 0; i < g.n; ++i)
            worst = fmax(worst, fabs(icc_function_logs(direct)[g.order[i]] -
                                     icc_function_logs(iterative)[g.order[i]]));
        if (worst > 1e-6)
            ck_abort_msg("%s: relative difference %g", mask_number(k).name, worst);
        icc_function_free(direct);
        icc_function_free(iterative);
        ground_free(&g);
    }
}
END_TEST

/* ------------------------------------------------------------------ rings */

enum { RING = 400 };

/* A square ring; its root in the middle of one side, so that the other side is 2 RING away. */
static ground ring_of(size_t width)
{
    const size_t side = RING + 2 * MASK_MARGIN, low = MASK_MARGIN + width, high = side - low;
    ground g;
    mask m = mask_draw(mask_box, 2, RING);
    ck_assert_ptr_nonnull(m.inside);
    for (size_t y = low; y < high; ++y)
        memset(m.inside + y * side + low, 0, high - low);
    const uint32_t root = (uint32_t)(side / 2 * side + MASK_MARGIN + width / 2);
    ck_assert_int_eq(ground_create(&g, &m, root, 0), ICC_OK);
    mask_free(&m);
    return g;
}

/* The Laplacian at v, in units of exp(unit). */
static double laplacian_near(const ground *g, const double *logs, uint32_t v, double unit)
{
    double sum = 2 * g->info.dim * exp(logs[v] - unit);
    for (int32_t d = 0; d < 2 * g->info.dim; ++d) {
        const uint32_t u = ground_neighbour(g, v, d);
        if (u != UINT32_MAX && ground_holds(g, u))
            sum -= exp(logs[u] - unit);
    }
    return sum;
}

/* As ground_imbalance(), of the Laplacian of a function. */
static double imbalance_of_laplacian(const ground *g, const double *logs)
{
    double worst = 0;
    for (size_t i = 1; i < g->n; ++i) {
        const uint32_t v = g->order[i];
        double sum = 2 * g->info.dim * laplacian_near(g, logs, v, logs[v]), size = fabs(sum);
        for (int32_t d = 0; d < 2 * g->info.dim; ++d) {
            const uint32_t u = ground_neighbour(g, v, d);
            if (u == UINT32_MAX || !ground_holds(g, u))
                continue;
            const double l = laplacian_near(g, logs, u, logs[v]);
            sum -= l;
            size += fabs(l);
        }
        worst = fmax(worst, fabs(sum) / size);
    }
    return worst;
}

static void count_lines(void *user, const char *message)
{
    ck_assert_uint_gt(strlen(message), 0);
    ++*(int *)user;
}

/* In both ways round, values fall by up to 10^500: no factor may join rows across that. */
static icc_function *ring_field(const ground *g, int32_t function)
{
    const icc_function_options options = choice(function, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT);
    int n_lines = 0;
    const icc_env env = {.size = sizeof env, .user = &n_lines, .log = count_lines};
    icc_function *field;
    ck_assert_int_eq(icc_function_create(&field, g->tree, &options, &env, NULL), ICC_OK);
    ck_assert_int_eq(info_of(field).solver, ICC_SOLVER_DIRECT);
    ck_assert_int_eq(n_lines, 0); /* it would tell of a change of the solver */
    const icc_function_report report = report_of_function(field);
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima, 0);
    ck_assert_uint_eq(report.n_saddles, 1);
    return field;
}

START_TEST(long_thin_rings)
{
    static const size_t WIDTHS[4] = {1, 2, 3, 6};
    for (int k = 0; k < 4; ++k) {
        ground g = ring_of(WIDTHS[k]);
        icc_function *direct = ring_field(&g, ICC_FUNCTION_LAPLACE);
        icc_function *bilaplace = ring_field(&g, ICC_FUNCTION_BILAPLACE);
        icc_function *iterative =
            field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, ICC_SOLVER_ITERATIVE);
        const double *u = icc_function_logs(direct), *v = icc_function_logs(iterative);
        ck_assert_double_lt(info_of(direct).least_log, -300);
        ck_assert_double_le(ground_imbalance(&g, u), 1e-11);
        ck_assert_double_le(imbalance_of_laplacian(&g, icc_function_logs(bilaplace)), 1e-6);
        for (size_t i = 0; i < g.n; ++i)
            ck_assert_double_le(fabs(u[g.order[i]] - v[g.order[i]]), 1e-6);
        icc_function_free(direct);
        icc_function_free(bilaplace);
        icc_function_free(iterative);
        ground_free(&g);
    }
}
END_TEST

/* Two rooms and a corridor between them: 60 wide, 1 wide and 900 long. A separator in its middle
 * would see neither room. */
START_TEST(rooms_far_apart)
{
    enum { ROOM = 60, LENGTH = 900, NX = 2 * ROOM + LENGTH + 4, NY = ROOM + 4 };
    ground g;
    mask m = {.dim = 2, .shape = {NX, NY}, .n_vertices = NX * NY};
    m.inside = calloc(m.n_vertices, 1);
    ck_assert_ptr_nonnull(m.inside);
    for (size_t y = 2; y < NY - 2; ++y)
        for (size_t x = 2; x < NX - 2; ++x)
            m.inside[y * NX + x] = x < ROOM + 2 || x >= NX - ROOM - 2 || y == NY / 2;
    ck_assert_int_eq(ground_create(&g, &m, NX * (NY / 2) + ROOM / 2, 0), ICC_OK);
    mask_free(&m);
    for (int32_t function = ICC_FUNCTION_LAPLACE; function <= ICC_FUNCTION_BILAPLACE; ++function) {
        icc_function *field = field_of(&g, function, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT);
        const double *u = icc_function_logs(field);
        ck_assert_int_eq(info_of(field).solver, ICC_SOLVER_DIRECT);
        ck_assert_double_lt(info_of(field).least_log, -1000);
        check_regular(field);
        if (function == ICC_FUNCTION_LAPLACE)
            ck_assert_double_le(ground_imbalance(&g, u), 1e-11);
        else
            ck_assert_double_le(imbalance_of_laplacian(&g, u), 1e-6);
        icc_function_free(field);
    }
    ground_free(&g);
}
END_TEST

/* -------------------------------------------------------- the serpentine */

/* How fast a discretely harmonic function decays along a corridor w vertices wide: per vertex. */
static double decay_in_corridor(double w)
{
    return acosh(2 - cos(3.14159265358979323846 / (w + 1)));
}

/* 50 corridors, 18 vertices wide and 1000 long, one after the other: from 1 down to 1e-3525. */
START_TEST(nothing_underflows_in_the_serpentine)
{
    enum { CELLS = 1000, SIDE = CELLS + 2 * MASK_MARGIN };
    ground g;
    mask m = mask_draw(mask_serpentine, 2, CELLS);
    ck_assert_int_eq(ground_create(&g, &m, MASK_MARGIN + 8 + SIDE * (MASK_MARGIN + 8), 0), ICC_OK);
    mask_free(&m);
    icc_function *field = field_of(&g, ICC_FUNCTION_LAPLACE, 0, 0);
    const icc_function_info info = info_of(field);
    ck_assert_int_eq(info.solver, ICC_SOLVER_DIRECT);
    ck_assert_int_eq(info.constrained, 0);
    check_values(&g, field, &info);
    check_regular(field);
    const double *u = icc_function_logs(field);
    ck_assert_double_le(ground_imbalance(&g, u), 1e-11); /* logarithms of 8e3 end at 1e-12 */
    /* Far from the turns, along each corridor, it falls at the rate of its slowest mode. */
    for (size_t corridor = 0; corridor < 50; ++corridor) {
        const double *row = u + SIDE * (MASK_MARGIN + 20 * corridor + 9);
        const double rate = (row[302] - row[702]) / (corridor % 2 == 0 ? 400 : -400);
        ck_assert_double_le(fabs(rate / decay_in_corridor(18) - 1), 1e-9);
    }
    ck_assert(info.least_log < -8000 && info.least_log > -8300);
    icc_function_free(field);
    ground_free(&g);
}
END_TEST

START_TEST(inequalities_far_below_the_range_of_doubles)
{
    static const int32_t SOLVERS[2] = {ICC_SOLVER_DIRECT, ICC_SOLVER_ITERATIVE};
    mask m = mask_draw(mask_serpentine, 2, 160);
    ground g;
    ck_assert_int_eq(ground_create(&g, &m, 10 + 164 * 10, 0), ICC_OK);
    mask_free(&m);
    for (int k = 0; k < 2; ++k) {
        icc_function *field = field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL, SOLVERS[k]);
        const icc_function_info info = info_of(field);
        const double *u = icc_function_logs(field);
        ck_assert(info.least_log < -150);
        for (size_t i = 1; i < g.n; ++i) {
            const uint32_t v = g.order[i];
            if (u[g.parent[v]] - u[v] < log1p(ETA) - 4 * DBL_EPSILON * fabs(u[v]))
                ck_abort_msg("solver %d: violated at u = %g", k, u[v]);
        }
        check_regular(field);
        icc_function_free(field);
    }
    ground_free(&g);
}
END_TEST

/* ------------------------------------------------- Laplace, constrained */

/* Optimal by conditions found anew; `tolerance` in units of the maximum. */
static void check_optimal(const ground *g, int32_t solver, double tolerance)
{
    icc_function *field = field_of(g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL, solver);
    icc_function *free_field = field_of(g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, solver);
    const icc_function_info info = info_of(field), free_info = info_of(free_field);
    const double *f = icc_function_values(field), *h = icc_function_values(free_field);
    double *sum = room_for(g);
    ck_assert_uint_eq(ground_violated(g, ETA, f), 0);
    ck_assert_double_le(solver_report_of(field).residual_before, tolerance);
    const double residual = ground_residual(g, ICC_FUNCTION_LAPLACE, ETA, f, sum);
    ck_assert_double_le(residual, tolerance);
    ck_assert_double_le(fabs(residual - info.residual), 1e-13);
    const double energy = ground_energy(g, ICC_FUNCTION_LAPLACE, f);
    const double least = ground_energy(g, ICC_FUNCTION_LAPLACE, h);
    ck_assert_double_ge(energy, least * (1 - 1e-12));
    ck_assert_uint_eq(info.n_violated, free_info.n_violated);
    if (info.n_violated == 0) {
        ck_assert_uint_eq(info.n_active, 0);
        ck_assert_double_le(fabs(energy / least - 1), 1e-12);
    } else {
        ck_assert_uint_gt(info.n_active, 0);
        ck_assert_uint_gt(solver_report_of(field).n_iterations, 0);
    }
    ck_assert_uint_le(solver_report_of(field).n_iterations, 100);
    free(sum);
    icc_function_free(field);
    icc_function_free(free_field);
}

START_TEST(constrained_laplace_is_optimal)
{
    random_source r = {3};
    size_t n_constrained = 0;
    for (int round = 0; round < N_MASKS + 200; ++round) {
        ground g = round < N_MASKS ? ground_number(round, 40)
                                   : random_ground(&r, 2 + round % 2, round % 2 ? 6 : 12);
        check_optimal(&g, ICC_SOLVER_DIRECT, 1e-12);
        icc_function *field = field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, 0);
        n_constrained += info_of(field).n_violated > 0;
        icc_function_free(field);
        ground_free(&g);
    }
    ck_assert_uint_gt(n_constrained, 50);
}
END_TEST

START_TEST(constrained_laplace_by_iteration_is_optimal)
{
    for (int k = 0; k < N_MASKS; ++k) {
        ground g = ground_number(k, 40);
        check_optimal(&g, ICC_SOLVER_ITERATIVE, 1e-9);
        ground_free(&g);
    }
}
END_TEST

/* The plain active set method goes in circles on shapes like this. */
START_TEST(active_sets_do_not_cycle)
{
    ground g = ground_on(mask_c, 2, 200);
    check_optimal(&g, ICC_SOLVER_DIRECT, 1e-12);
    icc_function *field = field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL, 0);
    ck_assert_uint_le(solver_report_of(field).n_iterations, 40);
    check_regular(field);
    icc_function_free(field);
    ground_free(&g);
}
END_TEST

START_TEST(other_etas_are_kept)
{
    static const double ETAS[4] = {1e-12, 1e-4, 1e-3, 1e-2};
    ground g = ground_on(mask_c, 2, 60);
    double energy = 0;
    for (int k = 0; k < 4; ++k)
        for (int32_t function = ICC_FUNCTION_LAPLACE; function <= ICC_FUNCTION_CLAMPED;
             ++function) {
            icc_function_options options = choice(function, ICC_CONSTRAINTS_ALL, 0);
            options.min_fall = ETAS[k];
            options.leaf_min = ETAS[k] * 1e-3;
            icc_function *field = field_with(&g, &options);
            const double *f = icc_function_values(field);
            ck_assert_uint_eq(ground_violated(&g, ETAS[k], f), 0);
            for (size_t i = 1; i < g.n && function != ICC_FUNCTION_LAPLACE; ++i)
                ck_assert_double_ge(f[g.order[i]], options.leaf_min);
            if (function == ICC_FUNCTION_LAPLACE) { /* more is asked for: it costs more */
                const double now = ground_energy(&g, function, f);
                ck_assert_double_ge(now, energy * (1 - 1e-12));
                energy = now;
            }
            icc_function_free(field);
        }
    ground_free(&g);
}
END_TEST

/* ------------------------------------------------------- a slow reference */

enum { MOST_UNKNOWNS = 40, MOST_BOUNDS = 2 * MOST_UNKNOWNS };

/* Minimise x'Hx / 2 + h'x + c subject to A x >= b, densely: x are the values but for the root's. */
typedef struct dense {
    size_t n, m;
    double h[MOST_UNKNOWNS][MOST_UNKNOWNS], linear[MOST_UNKNOWNS], constant;
    double a[MOST_BOUNDS][MOST_UNKNOWNS], b[MOST_BOUNDS];
} dense;

static void fill_energy(dense *q, const ground *g, int32_t function, double *unit)
{
    q->n = g->n - 1;
    memset(unit, 0, g->info.n_vertices * sizeof *unit);
    for (size_t j = 0; j < g->n; ++j) {
        unit[g->order[j]] = 1;
        if (j == 0)
            q->constant = ground_energy(g, function, unit);
        for (size_t i = 1; i < g->n; ++i) {
            const double entry = ground_gradient(g, function, unit, g->order[i]);
            *(j == 0 ? &q->linear[i - 1] : &q->h[i - 1][j - 1]) = entry;
        }
        unit[g->order[j]] = 0;
    }
}

static void fill_inequalities(dense *q, const ground *g, int32_t function, double *index)
{
    q->m = 0;
    memset(q->a, 0, sizeof q->a);
    for (size_t i = 0; i < g->n; ++i)
        index[g->order[i]] = (double)i;
    for (size_t i = 1; i < g->n; ++i) {
        const size_t p = (size_t)index[g->parent[g->order[i]]];
        q->a[q->m][i - 1] = -(1 + ETA);
        if (p > 0)
            q->a[q->m][p - 1] = 1;
        q->b[q->m++] = p > 0 ? 0 : -1;
        if (function == ICC_FUNCTION_LAPLACE || g->has_child[g->order[i]])
            continue;
        q->a[q->m][i - 1] = 1;
        q->b[q->m++] = LEAF;
    }
}

/* Solves H x = y in place by Cholesky's factorisation, kept in h's lower triangle. */
static void factorise(dense *q)
{
    for (size_t j = 0; j < q->n; ++j)
        for (size_t i = j; i < q->n; ++i) {
            double sum = q->h[i][j];
            for (size_t k = 0; k < j; ++k)
                sum -= q->h[i][k] * q->h[j][k];
            if (i == j)
                ck_assert(sum > 0);
            q->h[i][j] = i == j ? sqrt(sum) : sum / q->h[j][j];
        }
}

static void solve(const dense *q, double *x)
{
    for (size_t i = 0; i < q->n; ++i) {
        for (size_t k = 0; k < i; ++k)
            x[i] -= q->h[i][k] * x[k];
        x[i] /= q->h[i][i];
    }
    for (size_t i = q->n; i-- > 0;) {
        for (size_t k = i + 1; k < q->n; ++k)
            x[i] -= q->h[k][i] * x[k];
        x[i] /= q->h[i][i];
    }
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

/* Hildreth's method: one multiplier after the other is set to what is best for the dual problem.
 * Its value is a lower bound of the energy at every step, and is returned. */
static double bound_energy(dense *q)
{
    static double g[MOST_BOUNDS][MOST_BOUNDS], column[MOST_UNKNOWNS];
    double d[MOST_BOUNDS], multiplier[MOST_BOUNDS] = {0}, x[MOST_UNKNOWNS];
    factorise(q);
    for (size_t i = 0; i < q->n; ++i)
        x[i] = -q->linear[i];
    solve(q, x);
    for (size_t j = 0; j < q->m; ++j) {
        memcpy(column, q->a[j], sizeof column);
        solve(q, column);
        for (size_t i = 0; i < q->m; ++i)
            g[i][j] = dot(q->n, q->a[i], column);
        d[j] = q->b[j] - dot(q->n, q->a[j], x);
    }
    for (int round = 0; round < share_of(20000); ++round) {
        double change = 0;
        for (size_t i = 0; i < q->m; ++i) {
            const double slope = d[i] - dot(q->m, g[i], multiplier);
            const double next = fmax(0, multiplier[i] + slope / g[i][i]);
            change = fmax(change, fabs(next - multiplier[i]) * g[i][i]);
            multiplier[i] = next;
        }
        if (change < 1e-15)
            break;
    }
    double value = q->constant + dot(q->n, q->linear, x) / 2;
    for (size_t i = 0; i < q->m; ++i)
        value += multiplier[i] * (d[i] - dot(q->m, g[i], multiplier) / 2);
    return value;
}

START_TEST(no_function_has_less_energy)
{
    static dense q;
    random_source r = {4};
    size_t n_active[ICC_FUNCTION_CLAMPED + 1] = {0};
    for (int round = 0; round < share_of(480); ++round) {
        ground g = random_ground(&r, 2 + round / 3 % 2, round / 3 % 2 ? 4 : 7);
        const int32_t function = ICC_FUNCTION_LAPLACE + round % 3;
        if (g.n <= MOST_UNKNOWNS) {
            icc_function *field = field_of(&g, function, ICC_CONSTRAINTS_ALL, ICC_SOLVER_DIRECT);
            double *room = room_for(&g);
            fill_energy(&q, &g, function, room);
            fill_inequalities(&q, &g, function, room);
            const double energy = ground_energy(&g, function, icc_function_values(field));
            const double bound = bound_energy(&q);
            if (!(fabs(energy - bound) <= 1e-7 * energy))
                ck_abort_msg("round %d, function %d, %zu unknowns: energy %.12g, %.12g will do",
                             round, (int)function, q.n, energy, bound);
            n_active[function] += info_of(field).n_active > 0;
            free(room);
            icc_function_free(field);
        }
        ground_free(&g);
    }
    for (int32_t function = ICC_FUNCTION_LAPLACE; function <= ICC_FUNCTION_CLAMPED; ++function)
        ck_assert_uint_ge(n_active[function], (size_t)share_of(480) / 80);
}
END_TEST

/* ------------------------------------------------------------- the drum */

/* A solid torus and a disc across its hole, two vertices thin: thicker ones have no saddles. */
static bool thin_drum(const double *p, int32_t dim, double cells)
{
    (void)dim;
    const double r = hypot(p[0] - 0.5, p[1] - 0.5), z = p[2] - 0.5;
    return hypot(r - 0.33, z) < 0.14 || (r < 0.33 && fabs(z) * cells < 1);
}

START_TEST(the_drum_has_two_saddles)
{
    ground g = ground_on(thin_drum, 3, 48);
    icc_function *field = field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, 0);
    const icc_function_report report = report_of_function(field);
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima, 0);
    ck_assert_uint_eq(report.n_saddles, 2);
    ck_assert(report.critical != UINT32_MAX && report.critical != g.root);
    const size_t n_violated = info_of(field).n_violated;
    icc_function_free(field);
    field = field_of(&g, ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NEEDED, 0);
    const icc_function_info info = info_of(field);
    ck_assert_int_eq(info.constrained, 1);
    ck_assert_uint_eq(info.n_violated, n_violated);
    ck_assert_uint_gt(info.n_active, 0);
    ck_assert_uint_eq(ground_violated(&g, ETA, icc_function_values(field)), 0);
    icc_function_free(field);
    ground_free(&g);
}
END_TEST

/* --------------------------------------------------------- bi-Laplace */

/* c L^-2 of the root's unit: L f is harmonic but at the root. */
START_TEST(bilaplace_solves_its_equation)
{
    for (int k = 0; k < 2 * N_MASKS; ++k) {
        ground g = ground_number(k % N_MASKS, 40);
        const int32_t function = k < N_MASKS ? ICC_FUNCTION_BILAPLACE : ICC_FUNCTION_CLAMPED;
        icc_function *field = field_of(&g, function, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT);
        const double *f = icc_function_values(field);
        double residual = 0;
        for (size_t i = 1; i < g.n; ++i)
            residual = fmax(residual, fabs(ground_gradient(&g, function, f, g.order[i])));
        /* A row of the square adds numbers of size (4 dim)^2, up to 144. */
        ck_assert_double_le(residual, 1e-11);
        ck_assert_double_le(fabs(residual - info_of(field).residual), 1e-12);
        if (function == ICC_FUNCTION_BILAPLACE)
            ck_assert_ptr_nonnull(icc_function_logs(field));
        icc_function_free(field);
        ground_free(&g);
    }
}
END_TEST

START_TEST(clamped_changes_its_sign)
{
    ground g = ground_on(mask_c, 2, 60);
    icc_function *field = field_of(&g, ICC_FUNCTION_CLAMPED, ICC_CONSTRAINTS_NONE, 0);
    ck_assert_ptr_null(icc_function_logs(field));
    double lowest = 0;
    for (size_t i = 0; i < g.n; ++i)
        lowest = fmin(lowest, icc_function_values(field)[g.order[i]]);
    ck_assert(lowest < 0);
    ck_assert_double_eq(info_of(field).least_log, 0);
    icc_function_free(field);
    field = field_of(&g, ICC_FUNCTION_CLAMPED, ICC_CONSTRAINTS_NEEDED, 0);
    ck_assert_int_eq(info_of(field).constrained, 1);
    icc_function_free(field);
    ground_free(&g);
}
END_TEST

/* g'(h - f) for random feasible h: not negative where f has the least energy. */
static double least_slope(const ground *g, int32_t function, const double *f, random_source *r)
{
    double *h = room_for(g), *gradient = room_for(g), least = 0;
    for (size_t i = 1; i < g->n; ++i)
        gradient[g->order[i]] = ground_gradient(g, function, f, g->order[i]);
    for (int round = 0; round < share_of(200); ++round) {
        const double step = pow(10, -random_between(r, 0, 8));
        double slope = 0, size = 0;
        h[g->root] = 1;
        for (size_t i = 1; i < g->n; ++i) {
            const uint32_t v = g->order[i];
            const double highest = h[g->parent[v]] / (1 + ETA);
            h[v] = f[v] * (1 + step * random_between(r, -1, 1));
            h[v] = fmin(highest, fmax(h[v], LEAF * pow(1 + ETA, 2e4)));
            slope += gradient[v] * (h[v] - f[v]);
            size = fmax(size, fabs(h[v] - f[v]));
        }
        least = fmin(least, slope / fmax(size, DBL_MIN));
    }
    free(h);
    free(gradient);
    return least;
}

START_TEST(constrained_bilaplace_in_the_plane)
{
    static const mask_shape SHAPES[5] = {mask_box, mask_ball, mask_l, mask_c, mask_star};
    random_source r = {5};
    for (int k = 0; k < 10; ++k) {
        const int32_t function = k < 5 ? ICC_FUNCTION_BILAPLACE : ICC_FUNCTION_CLAMPED;
        ground g = ground_on(SHAPES[k % 5], 2, 50);
        icc_function *field = field_of(&g, function, ICC_CONSTRAINTS_ALL, 0);
        icc_function *other = field_of(&g, function, ICC_CONSTRAINTS_NONE, 0);
        const icc_function_info info = info_of(field);
        const double *f = icc_function_values(field);
        check_inequalities(&g, field, function);
        check_regular(field);
        ck_assert_double_le(solver_report_of(field).residual_before, 1e-8);
        ck_assert_double_le(info.residual, 1e-8);
        ck_assert_double_ge(ground_energy(&g, function, f),
                            ground_energy(&g, function, icc_function_values(other)) * (1 - 1e-9));
        ck_assert_uint_le(solver_report_of(field).n_iterations, 200);
        const double slope = least_slope(&g, function, f, &r);
        if (slope < -1e-6)
            ck_abort_msg("shape %d: the energy falls by %g", k, slope);
        icc_function_free(field);
        icc_function_free(other);
        ground_free(&g);
    }
}
END_TEST

/* ---------------------------------------------------------------- failing */

START_TEST(a_lone_vertex_is_too_coarse)
{
    /* Nothing else inside, and nothing else that the tree reaches. */
    uint8_t inside[2][25] = {{0}, {0}};
    inside[0][12] = inside[1][12] = inside[1][24] = 1;
    for (int k = 0; k < 2; ++k)
        for (int32_t function = ICC_FUNCTION_LAPLACE; function <= ICC_FUNCTION_CLAMPED;
             ++function) {
            mask m = {.dim = 2, .shape = {5, 5}, .n_vertices = 25, .inside = inside[k]};
            ground g;
            ck_assert_int_eq(ground_create(&g, &m, 12, 0), ICC_OK);
            const icc_function_options options = choice(function, 0, 0);
            icc_function *field = (icc_function *)&field;
            icc_error err = {.size = sizeof err};
            ck_assert_int_eq(icc_function_create(&field, g.tree, &options, NULL, &err),
                             ICC_ERR_RESOLUTION);
            ck_assert(field == NULL && err.status == ICC_ERR_RESOLUTION);
            ck_assert(strstr(err.message, "coarse") != NULL && err.index == 12);
            ground_free(&g);
        }
}
END_TEST

START_TEST(a_chart_on_too_coarse_a_grid_says_so)
{
    int n_lone = 0;
    for (int k = 0; k < 4 * N_SHAPES; ++k) {
        const shape outline = shape_number(k / 4);
        icc_domain *domain;
        icc_grid *grid;
        icc_grid_info info = {.size = sizeof info};
        const icc_chart_options options = {.size = sizeof options,
                                           .method = ICC_METHOD_GRADIENT,
                                           .function = ICC_FUNCTION_LAPLACE,
                                           .cells = 2 + k % 4};
        ck_assert_int_eq(icc_domain_create(&domain, 2, outline.n, outline.xy, 0, NULL, NULL, NULL),
                         ICC_OK);
        if (icc_grid_create(&grid, domain, options.cells, NULL, NULL) == ICC_OK) {
            ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
            icc_grid_free(grid);
        }
        if (info.n_inside == 1) {
            icc_chart *chart = (icc_chart *)&chart;
            icc_error err = {.size = sizeof err};
            ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, &err),
                             ICC_ERR_RESOLUTION);
            ck_assert(chart == NULL && err.status == ICC_ERR_RESOLUTION);
            ck_assert_ptr_nonnull(strstr(err.message, "coarse"));
            ++n_lone;
        }
        icc_domain_free(domain);
    }
    ck_assert_int_gt(n_lone, 0);
}
END_TEST

/* 600 vertices in a row cannot fall by 1 % each and stay above 1 %. */
START_TEST(falls_and_bounds_may_exclude_each_other)
{
    uint8_t inside[604] = {0};
    memset(inside + 2, 1, 600);
    mask m = {.dim = 1, .shape = {604}, .n_vertices = 604, .inside = inside};
    ground g;
    ck_assert_int_eq(ground_create(&g, &m, 2, 0), ICC_OK);
    for (int32_t function = ICC_FUNCTION_BILAPLACE; function <= ICC_FUNCTION_CLAMPED; ++function) {
        icc_function_options options = choice(function, ICC_CONSTRAINTS_ALL, 0);
        icc_function *field = (icc_function *)&field;
        icc_error err = {.size = sizeof err};
        options.min_fall = options.leaf_min = 0.01;
        const icc_status status = icc_function_create(&field, g.tree, &options, NULL, &err);
        ck_assert(status != ICC_OK && field == NULL);
        ck_assert(err.status == status && err.message[0] != '\0');
    }
    ground_free(&g);
}
END_TEST

typedef struct job {
    const ground *g;
    icc_function_options options;
} job;

static icc_status make(const icc_env *env, icc_error *err, void *argument)
{
    const job *j = argument;
    icc_function *field = (icc_function *)&field;
    const icc_status status = icc_function_create(&field, j->g->tree, &j->options, env, err);
    ck_assert((field == NULL) == (status != ICC_OK));
    icc_function_free(field);
    return status;
}

START_TEST(every_failure_of_every_choice_is_reported)
{
    mask m = mask_draw(mask_c, 2, 12);
    ground g;
    ck_assert_int_eq(ground_create(&g, &m, UINT32_MAX, 0), ICC_OK);
    for (int32_t function = ICC_FUNCTION_LAPLACE; function <= ICC_FUNCTION_CLAMPED; ++function)
        for (int32_t constraints = 1; constraints <= ICC_CONSTRAINTS_ALL; ++constraints)
            for (int32_t solver = 1; solver <= ICC_SOLVER_ITERATIVE; ++solver) {
                job j = {&g, choice(function, constraints, solver)};
                faulty_sweep(make, &j);
            }
    mask_free(&m);
    ground_free(&g);
}
END_TEST

/* Reports, and when to give up. */
typedef struct watcher {
    size_t n_reports, cancel_at;
    double share;
} watcher;

static int32_t watch(void *user, const char *stage, double share)
{
    watcher *w = user;
    ck_assert(share >= w->share && share <= 1);
    ck_assert_str_eq(stage, "solve");
    w->share = share;
    return ++w->n_reports == w->cancel_at;
}

/* What a direct solution goes through reports often, the factorisation every so many
 * multiplications, and all can be cancelled. */
START_TEST(long_stages_can_be_cancelled)
{
    static const double MOST_BETWEEN_REPORTS = 4e7; /* multiplications, some 20 ms */
    ground g = ground_on(mask_box, 2, 350);
    for (int32_t solver = 1; solver <= ICC_SOLVER_ITERATIVE; ++solver) {
        job j = {&g, choice(ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE, solver)};
        watcher w = {0};
        icc_env env = {.size = sizeof env, .user = &w, .progress = watch};
        icc_function *field;
        ck_assert_int_eq(icc_function_create(&field, g.tree, &j.options, &env, NULL), ICC_OK);
        const double work = solver_report_of(field).work;
        const size_t n_reports = w.n_reports;
        icc_function_free(field);
        if (solver == ICC_SOLVER_DIRECT) {
            ck_assert_double_gt(work, 1e7);
            ck_assert_double_ge((double)n_reports, 36 + work / MOST_BETWEEN_REPORTS);
        }
        ck_assert_uint_gt(n_reports, 10);
        for (size_t k = 0; k <= 12; ++k) {
            const size_t at = 1 + k * (n_reports - 1) / 12;
            w = (watcher){.cancel_at = at};
            icc_error err = {.size = sizeof err};
            ck_assert_int_eq(make(&env, &err, &j), ICC_ERR_CANCELLED);
            ck_assert_int_eq(err.status, ICC_ERR_CANCELLED);
            ck_assert_uint_eq(w.n_reports, at);
        }
    }
    ground_free(&g);
}
END_TEST

/* ----------------------------------------------------------------- charts */

static const struct {
    int32_t function, constraints;
} KINDS[] = {{ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE},
             {ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL},
             {ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_NONE},
             {ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_ALL},
             {ICC_FUNCTION_CLAMPED, ICC_CONSTRAINTS_ALL}};
enum { N_KINDS = sizeof KINDS / sizeof *KINDS, N_POINTS = 2000 };

static icc_chart *chart_of(const icc_domain *domain, int kind, int32_t cells, const double *maximum)
{
    const icc_chart_options options = {.size = sizeof options,
                                       .method = ICC_METHOD_GRADIENT,
                                       .function = KINDS[kind].function,
                                       .constraints = KINDS[kind].constraints,
                                       .cells = cells,
                                       .maximum = maximum};
    icc_chart *chart;
    icc_error err = {.size = sizeof err};
    if (icc_chart_create(&chart, domain, &options, NULL, &err) != ICC_OK)
        ck_abort_msg("kind %d, %d cells: %s", kind, (int)cells, err.message);
    return chart;
}

static size_t points_in(const icc_domain *domain, random_source *r, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    size_t n = 0;
    for (int tries = 0; tries < 100 * N_POINTS && n < N_POINTS; ++tries) {
        double *p = points + 2 * n;
        int32_t where;
        for (int k = 0; k < 2; ++k)
            p[k] = random_between(r, info.lower[k], info.upper[k]);
        ck_assert_int_eq(icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL), ICC_OK);
        n += where == ICC_INSIDE;
    }
    return n;
}

/* The share of points that do not come back to within `tolerance`; *failed: that have no
 * coordinates. */
static double share_lost(const icc_chart *chart, size_t n, const double *points, double tolerance,
                         double *failed)
{
    static uint32_t facet[N_POINTS];
    static double bary[2 * N_POINTS], t[N_POINTS], back[2 * N_POINTS];
    static icc_status up[N_POINTS], down[N_POINTS];
    size_t n_lost = 0, n_failed = 0;
    ck_assert_int_eq(icc_chart_encode(chart, n, points, facet, bary, t, up, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_decode(chart, n, facet, bary, t, back, down, NULL, NULL), ICC_OK);
    for (size_t i = 0; i < n; ++i) {
        const bool ok = up[i] == ICC_OK && down[i] == ICC_OK;
        n_failed += up[i] != ICC_OK;
        n_lost += !ok || hypot(back[2 * i] - points[2 * i], back[2 * i + 1] - points[2 * i + 1]) >
                             tolerance;
        ck_assert(up[i] != ICC_OK || (t[i] >= 0 && t[i] <= 1));
    }
    *failed = (double)n_failed / (double)n;
    return (double)n_lost / (double)n;
}

START_TEST(charts_of_every_function_come_back)
{
    static double points[2 * N_POINTS];
    random_source r = {6};
    for (int k = 0; k < N_SHAPES * N_KINDS; ++k) {
        const shape outline = shape_number(k / N_KINDS);
        icc_domain *domain;
        ck_assert_int_eq(icc_domain_create(&domain, 2, outline.n, outline.xy, 0, NULL, NULL, NULL),
                         ICC_OK);
        icc_chart *chart = chart_of(domain, k % N_KINDS, 40, NULL);
        icc_gradient_info info = {.size = sizeof info};
        icc_chart_report m = {.size = sizeof m};
        ck_assert_int_eq(icc_chart_get_gradient_info(chart, &info), ICC_OK);
        ck_assert_int_eq(icc_chart_get_report(chart, 4000, &m, NULL, NULL), ICC_OK);
        ck_assert_int_eq(info.function, KINDS[k % N_KINDS].function);
        if (info.n_maxima != 1 || info.n_minima != 0 || info.n_saddles != 0)
            ck_abort_msg("shape %d, kind %d: %zu maxima, %zu minima, %zu saddles", k / N_KINDS,
                         k % N_KINDS, info.n_maxima, info.n_minima, info.n_saddles);
        const size_t n = points_in(domain, &r, points);
        double failed;
        const double lost = share_lost(chart, n, points, 1e-9, &failed);
        /* As many as the measures say, by another sample: three times its standard error more. */
        const double expected = m.unreachable + m.collapsed;
        if (lost > expected + 3 * sqrt((expected + 0.001) / (double)n) + 0.002)
            ck_abort_msg("shape %d, kind %d: %g of the points are lost, not %g", k / N_KINDS,
                         k % N_KINDS, lost, expected);
        icc_chart_free(chart);
        icc_domain_free(domain);
    }
}
END_TEST

/* Ten cells wide and 3000 long, the maximum at one end: down to 1e-370. Every curve keeps to it. */
START_TEST(curves_run_where_doubles_end)
{
    static const double XY[8] = {0, 0, 300, 0, 300, 1, 0, 1}, MAXIMUM[2] = {0.5, 0.5};
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, XY, 0, NULL, NULL, NULL), ICC_OK);
    for (int kind = 0; kind < 3; ++kind) { /* the others are kept above LEAF */
        icc_chart *chart = chart_of(domain, kind, 3000, MAXIMUM);
        const icc_function *field = icc_chart_function(chart);
        const double *u = icc_function_logs(field);
        ck_assert_ptr_nonnull(u);
        ck_assert_double_lt(info_of(field).least_log, -750);
        check_regular(field);
        for (int i = 1; i < 40; ++i) {
            const double p[2] = {300 * (i / 40.), 0.05 + 0.9 * fmod(0.618 * i, 1)};
            static double curve[2 * 20000];
            size_t n;
            ck_assert_int_eq(icc_chart_trace(chart, p, 20000, curve, &n, NULL, NULL), ICC_OK);
            ck_assert_uint_le(n, 20000);
            /* From the boundary to the point, which is on the line, and then straight to the
             * maximum. */
            double nearest = HUGE_VAL;
            for (size_t j = 0; j < n; ++j)
                nearest = fmin(nearest, hypot(curve[2 * j] - p[0], curve[2 * j + 1] - p[1]));
            ck_assert_double_le(nearest, 0.15);
            ck_assert_double_le(hypot(curve[2 * n - 2] - MAXIMUM[0], curve[2 * n - 1] - MAXIMUM[1]),
                                0.1);
            double rise = 0;
            for (size_t j = n - 1; j > 0 && curve[2 * j] < p[0]; --j)
                rise = fmax(rise, curve[2 * j] - curve[2 * j - 2]);
            ck_assert_double_le(rise, 1e-9); /* never back to where it came from */
        }
        icc_chart_free(chart);
    }
    icc_domain_free(domain);
}
END_TEST

/* Boundary of the cage of a chart whose function is handed out: the same as one made by the
 * stages. */
START_TEST(charts_hand_out_the_function_of_the_stages)
{
    const shape outline = shape_l();
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, outline.n, outline.xy, 0, NULL, NULL, NULL),
                     ICC_OK);
    for (int kind = 0; kind < N_KINDS; ++kind) {
        icc_chart *chart = chart_of(domain, kind, 30, NULL);
        const icc_function *field = icc_chart_function(chart);
        const icc_function_options options =
            choice(KINDS[kind].function, KINDS[kind].constraints, 0);
        icc_function *same;
        icc_grid_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_function_create(&same, icc_function_tree(field), &options, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(icc_grid_get_info(icc_tree_grid(icc_function_tree(field)), &info), ICC_OK);
        const double *f = icc_function_values(field), *h = icc_function_values(same);
        for (size_t v = 0; v < info.n_vertices; ++v)
            ck_assert(isnan(f[v]) ? isnan(h[v]) : f[v] == h[v]);
        ck_assert_int_eq(info_of(field).constrained, info_of(same).constrained);
        icc_function_free(same);
        icc_chart_free(chart);
    }
    icc_domain_free(domain);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("function");
    TCase *tests = tcase_create("function");
    tcase_set_timeout(tests, 240);
    tcase_add_test(tests, every_choice_on_random_masks);
    tcase_add_loop_test(tests, every_choice_on_every_shape, 0, N_MASKS);
    tcase_add_test(tests, laplace_is_the_mean_of_its_neighbours);
    tcase_add_test(tests, both_solvers_give_the_same_function);
    tcase_add_test(tests, long_thin_rings);
    tcase_add_test(tests, rooms_far_apart);
    tcase_add_test(tests, nothing_underflows_in_the_serpentine);
    tcase_add_test(tests, inequalities_far_below_the_range_of_doubles);
    tcase_add_test(tests, constrained_laplace_is_optimal);
    tcase_add_test(tests, constrained_laplace_by_iteration_is_optimal);
    tcase_add_test(tests, active_sets_do_not_cycle);
    tcase_add_test(tests, other_etas_are_kept);
    tcase_add_test(tests, no_function_has_less_energy);
    tcase_add_test(tests, the_drum_has_two_saddles);
    tcase_add_test(tests, bilaplace_solves_its_equation);
    tcase_add_test(tests, clamped_changes_its_sign);
    tcase_add_test(tests, constrained_bilaplace_in_the_plane);
    tcase_add_test(tests, a_lone_vertex_is_too_coarse);
    tcase_add_test(tests, a_chart_on_too_coarse_a_grid_says_so);
    tcase_add_test(tests, falls_and_bounds_may_exclude_each_other);
    tcase_add_test(tests, every_failure_of_every_choice_is_reported);
    tcase_add_test(tests, long_stages_can_be_cancelled);
    tcase_add_test(tests, charts_of_every_function_come_back);
    tcase_add_test(tests, curves_run_where_doubles_end);
    tcase_add_test(tests, charts_hand_out_the_function_of_the_stages);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
