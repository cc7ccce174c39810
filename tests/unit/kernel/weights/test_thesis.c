/* Where Sakaridis' thesis is wrong or silent, and what happens here instead: one test for each
 * point, with the thesis' own behaviour beside it where that can be asked for. */
#include "icc/kernel.h"
#include "kernel/sampling/sampling.h"
#include "kernel/weights/interpolant.h"

#include "../../../suite.h"

#include <check.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef __FAST_MATH__
#error "the library must not be built with -ffast-math"
#endif

enum { TIPS = 10, SIDES = 26 };

static void *allocate(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    ck_assert_ptr_nonnull(memory);
    return memory;
}

static void draw_star(double *xy)
{
    for (size_t i = 0; i < TIPS; ++i) {
        const double radius = i % 2 == 0 ? 1 : 0.4, angle = 0.62831853071795865 * ((double)i + 2.5);
        xy[2 * i] = radius * cos(angle);
        xy[2 * i + 1] = radius * sin(angle);
    }
}

/* Two legs, the gap between them two spacings wide. */
static const double GAP = 0.1;
static const double U[16] = {-0.55, -1.2, 0.55,  -1.2, 0.55,  1.2, 0.05,  1.2,
                             0.05,  -0.7, -0.05, -0.7, -0.05, 1.2, -0.55, 1.2};

static void draw_ring(uint32_t *edges, uint32_t n)
{
    for (uint32_t i = 0; i < n; ++i) {
        edges[2 * i] = i;
        edges[2 * i + 1] = (i + 1) % n;
    }
}

static icc_shape *make_shape(size_t n, const double *polygon, double around)
{
    const double square[8] = {-around, -around, around, -around, around, around, -around, around};
    icc_domain *domains[2];
    icc_shape *shape;
    const size_t n_regions = around > 0 ? 2 : 1;
    ck_assert_int_eq(icc_domain_create(&domains[0], 2, n, polygon, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&domains[1], 2, 4, square, 0, NULL, NULL, NULL),
                     around > 0 ? ICC_OK : ICC_ERR_BOUNDARY);
    ck_assert_int_eq(icc_shape_create(&shape, 2, n_regions, (const icc_domain *const *)domains, 0,
                                      NULL, 0, NULL, NULL, NULL),
                     ICC_OK);
    for (size_t k = 0; k < n_regions; ++k)
        icc_domain_free(domains[k]);
    return shape;
}

static icc_sampling *make_samples(size_t n, const double *polygon, double around, int32_t kind,
                                  double spacing)
{
    icc_shape *shape = make_shape(n, polygon, around);
    icc_sampling *sampling;
    icc_error err = {.size = sizeof err};
    const icc_sampling_options options = {
        .size = sizeof options, .kind = kind, .spacing = spacing, .margin = 0};
    if (icc_sampling_create(&sampling, shape, &options, NULL, &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    icc_shape_free(shape);
    return sampling;
}

/* A kernel with its nodes. */
typedef struct made {
    icc_weights *weights;
    icc_weights_info info;
    double *points, *initial, *values;
    icc_status *status;
} made;

static made take(icc_weights *weights)
{
    made m = {.weights = weights, .info = {.size = sizeof(icc_weights_info)}};
    ck_assert_int_eq(icc_weights_get_info(weights, &m.info), ICC_OK);
    m.points = allocate(m.info.n_nodes, 2 * sizeof(double));
    m.initial = allocate(m.info.n_nodes, m.info.n_handles * sizeof(double));
    m.values = allocate(m.info.n_nodes, m.info.n_handles * sizeof(double));
    m.status = allocate(m.info.n_nodes, sizeof *m.status);
    ck_assert_int_eq(icc_weights_get_nodes(weights, m.points, m.initial, m.values, m.status),
                     ICC_OK);
    return m;
}

static made make(const icc_sampling *sampling, size_t n, const double *handles,
                 const icc_weights_options *options)
{
    icc_weights *weights;
    icc_error err = {.size = sizeof err};
    if (icc_weights_create(&weights, sampling, n, handles, options, NULL, &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    return take(weights);
}

static void clear(made *m)
{
    icc_weights_free(m->weights);
    free(m->points);
    free(m->initial);
    free(m->values);
    free(m->status);
}

/* How far the weights of node i are from summing to 1 and reproducing it. */
static double error_at(const made *m, const double *handles, size_t i)
{
    double sum = -1, x = -m->points[2 * i], y = -m->points[2 * i + 1];
    for (size_t j = 0; j < m->info.n_handles; ++j) {
        const double w = m->values[m->info.n_handles * i + j];
        sum += w;
        x += w * handles[2 * j];
        y += w * handles[2 * j + 1];
    }
    return fmax(fabs(sum), hypot(x, y));
}

/* ---- 1: rigid parts ---- */

/* Nodes in the leg below on the right, but not on its edges. */
static size_t find_leg(const made *m, const double *star, uint32_t *part)
{
    const double *a = star + 2 * 5, *tip = star + 2 * 6, *b = star + 2 * 7;
    const double corners[3][2] = {{a[0], a[1]}, {tip[0], tip[1]}, {b[0], b[1]}};
    size_t n = 0;
    for (uint32_t i = 0; i < m->info.n_nodes; ++i) {
        bool inside = true;
        for (size_t k = 0; k < 3; ++k) {
            const double *p = corners[k], *q = corners[(k + 1) % 3];
            const double area = (q[0] - p[0]) * (m->points[2 * i + 1] - p[1]) -
                                (q[1] - p[1]) * (m->points[2 * i] - p[0]);
            inside &= area > 0.02 * hypot(q[0] - p[0], q[1] - p[1]);
        }
        if (inside)
            part[n++] = i;
    }
    return n;
}

/* Half the squared derivatives of all weights at some nodes. */
static double energy_of(const made *m, size_t n, const uint32_t *part, const double *rigidity)
{
    const size_t k = 2 * m->info.n_handles;
    double *points = allocate(n, 2 * sizeof *points),
           *gradients = allocate(n, k * sizeof *gradients);
    double *weights = allocate(n, k * sizeof *weights), energy = 0;
    for (size_t i = 0; i < n; ++i)
        memcpy(points + 2 * i, m->points + 2 * (size_t)part[i], 2 * sizeof *points);
    ck_assert_int_eq(
        icc_weights_evaluate(m->weights, n, points, weights, gradients, NULL, NULL, NULL), ICC_OK);
    for (size_t i = 0; i < n * k; ++i)
        energy += 0.5 * (rigidity != NULL ? rigidity[i / k] : 1) * gradients[i] * gradients[i];
    free(points);
    free(gradients);
    free(weights);
    return energy;
}

static made stiffen(const made *m, size_t n, const uint32_t *part, const double *rigidity,
                    double energy[2])
{
    icc_weights *stiff;
    ck_assert_int_eq(icc_weights_stiffen(&stiff, m->weights, n, part, rigidity, energy, NULL, NULL),
                     ICC_OK);
    return take(stiff);
}

/* Whether a node is a handle or lies on an edge between two tips. */
static bool is_held(const made *m, const double *star, size_t i)
{
    bool held = i < TIPS;
    for (size_t e = 0; e < TIPS; ++e) {
        const double *p = star + 2 * e, *q = star + 2 * ((e + 1) % TIPS), *x = m->points + 2 * i;
        const double length = hypot(q[0] - p[0], q[1] - p[1]);
        const double t = ((x[0] - p[0]) * (q[0] - p[0]) + (x[1] - p[1]) * (q[1] - p[1])) / length;
        held |= fabs((q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])) < 1e-9 &&
                t > 0 && t < length;
    }
    return held;
}

/* With the printed sign the energy rises; without holding them, edge samples move by up to 0.73. */
START_TEST(rigid_parts_lose_energy_and_edges_stay)
{
    double star[2 * TIPS], energy[2];
    uint32_t edges[2 * TIPS];
    draw_star(star);
    draw_ring(edges, TIPS);
    icc_sampling *sampling = make_samples(TIPS, star, 1.2, ICC_SAMPLING_BLUE, 0.035);
    for (int32_t kind = ICC_KERNEL_WENDLAND; kind <= ICC_KERNEL_GAUSS; ++kind) {
        const icc_weights_options options = {
            .size = sizeof options, .kernel = kind, .n_edges = TIPS, .edges = edges};
        made before = make(sampling, TIPS, star, &options);
        uint32_t *part = allocate(before.info.n_nodes, sizeof *part);
        const size_t n = find_leg(&before, star, part);
        ck_assert_uint_gt(n, 40);
        made after = stiffen(&before, n, part, NULL, energy);
        ck_assert_double_le(energy[1], energy[0] / 3);
        ck_assert_double_le(fabs(energy[0] - energy_of(&before, n, part, NULL)), 1e-9 * energy[0]);
        ck_assert_double_le(fabs(energy[1] - energy_of(&after, n, part, NULL)), 1e-9 * energy[0]);
        for (size_t i = 0; i < before.info.n_nodes; ++i) {
            ck_assert_double_le(error_at(&after, star, i), 1e-10);
            for (size_t j = 0; after.status[i] == ICC_OK && j < TIPS; ++j)
                ck_assert_double_ge(after.values[TIPS * i + j], 0);
            if (is_held(&before, star, i))
                ck_assert_mem_eq(after.values + TIPS * i, before.values + TIPS * i,
                                 TIPS * sizeof(double));
        }
        free(part);
        clear(&before);
        clear(&after);
    }
    icc_sampling_free(sampling);
}
END_TEST

/* The derivatives of all weights at some nodes. */
static double *slopes_of(const made *m, size_t n, const uint32_t *nodes)
{
    double *points = allocate(n, 2 * sizeof *points);
    double *slopes = allocate(n, 2 * TIPS * sizeof *slopes);
    double *weights = allocate(n, TIPS * sizeof *weights);
    for (size_t i = 0; i < n; ++i)
        memcpy(points + 2 * i, m->points + 2 * (size_t)nodes[i], 2 * sizeof *points);
    ck_assert_int_eq(icc_weights_evaluate(m->weights, n, points, weights, slopes, NULL, NULL, NULL),
                     ICC_OK);
    free(points);
    free(weights);
    return slopes;
}

/* The least mean of numbers at the handles under weights that are not negative, sum to 1 and
 * reproduce a point: at a vertex of what is allowed, where three of them count. */
static double least_mean(const double *star, const double *x, const double *number)
{
    double least = HUGE_VAL;
    for (size_t a = 0; a < TIPS; ++a)
        for (size_t b = a + 1; b < TIPS; ++b)
            for (size_t c = b + 1; c < TIPS; ++c) {
                const double *p = star + 2 * a, *q = star + 2 * b, *r = star + 2 * c;
                const double u[2] = {q[0] - p[0], q[1] - p[1]}, v[2] = {r[0] - p[0], r[1] - p[1]};
                const double d[2] = {x[0] - p[0], x[1] - p[1]}, area = u[0] * v[1] - u[1] * v[0];
                if (fabs(area) < 1e-9)
                    continue;
                const double s = (d[0] * v[1] - d[1] * v[0]) / area;
                const double t = (u[0] * d[1] - u[1] * d[0]) / area;
                if (s >= -1e-12 && t >= -1e-12 && s + t <= 1 + 1e-12)
                    least = fmin(least, (1 - s - t) * number[a] + s * number[b] + t * number[c]);
            }
    return least;
}

/* A part of the star: its nodes, then the free ones within the kernel's reach of them. */
typedef struct leg {
    uint32_t *places;
    size_t n_part, n_places;
    iccp_collocation *collocation; /* on all nodes */
} leg;

/* The energy of stiff weights: derivatives count at the part, and a tenth of those of their change
 * around it. `slopes` gets what counts. */
static double program_energy(const leg *l, const made *before, const made *after, double *slopes)
{
    double *old = slopes_of(before, l->n_places, l->places);
    double *now = slopes_of(after, l->n_places, l->places), energy = 0;
    for (size_t k = 0; k < 2 * TIPS * l->n_places; ++k) {
        const bool inside = k < 2 * TIPS * l->n_part;
        slopes[k] = inside ? now[k] : 0.1 * (now[k] - old[k]);
        energy += 0.5 * slopes[k] * (inside ? now[k] : now[k] - old[k]);
    }
    free(old);
    free(now);
    return energy;
}

/* How far stiff weights can be above the optimum of their program, over what they have. The energy
 * q is convex, so that q(v) >= q(w) + g'(v - w) for all weights v, g being its gradient at w; and
 * the least right side is a sum of least means, one for each free node. The gradient comes from
 * functions that are 1 at one node and 0 at all others. */
static double relative_gap(const leg *l, const made *before, const made *after, const double *star)
{
    const size_t n = before->info.n_nodes;
    double *slopes = allocate(l->n_places, 2 * TIPS * sizeof *slopes), gap = 0;
    double *unit = allocate(n, sizeof *unit), *coefficients = allocate(n + 3, sizeof *unit);
    const double energy = program_energy(l, before, after, slopes);
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (size_t f = 0; f < l->n_places; ++f) {
        const size_t node = l->places[f];
        double gradient[TIPS] = {0}, mean = 0;
        unit[node] = 1;
        ck_assert_int_eq(iccp_collocation_solve(l->collocation, 1, unit, coefficients, &env),
                         ICC_OK);
        unit[node] = 0;
        for (size_t k = 0; k < l->n_places; ++k) {
            double value, slope[2];
            iccp_collocation_evaluate(l->collocation, 1, coefficients,
                                      before->points + 2 * (size_t)l->places[k], &value, slope);
            for (size_t j = 0; j < 2 * TIPS; ++j)
                gradient[j / 2] += slope[j % 2] * slopes[2 * TIPS * k + j];
        }
        for (size_t j = 0; j < TIPS; ++j)
            mean += gradient[j] * after->values[TIPS * node + j];
        gap += mean - least_mean(star, before->points + 2 * node, gradient);
    }
    free(slopes);
    free(unit);
    free(coefficients);
    return gap / energy;
}

static leg make_leg(const made *m, const double *star, const iccp_radial *radial, bool tail)
{
    const size_t n = m->info.n_nodes;
    leg l = {.places = allocate(n, sizeof *l.places)};
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(
        iccp_collocation_create(&l.collocation, 2, n, m->points, radial, tail, &env, NULL), ICC_OK);
    l.n_places = l.n_part = find_leg(m, star, l.places);
    for (uint32_t i = 0; i < n; ++i) {
        double nearest = HUGE_VAL;
        for (size_t k = 0; k < l.n_part; ++k) {
            const double *p = m->points + 2 * (size_t)l.places[k];
            nearest = fmin(nearest, hypot(m->points[2 * (size_t)i] - p[0],
                                          m->points[2 * (size_t)i + 1] - p[1]));
        }
        if (nearest > 0 && nearest < radial->reach && !is_held(m, star, i))
            l.places[l.n_places++] = i;
    }
    ck_assert_uint_gt(l.n_places, l.n_part + 10);
    return l;
}

/* With signs restored node by node the energy is 0.57 above its least. */
START_TEST(rigid_parts_are_at_the_optimum)
{
    const bool gauss = _i > 0;
    double star[2 * TIPS], energy[2];
    uint32_t edges[2 * TIPS];
    draw_star(star);
    draw_ring(edges, TIPS);
    icc_sampling *sampling = make_samples(TIPS, star, 0, ICC_SAMPLING_BLUE, _i == 2 ? 0.11 : 0.08);
    const icc_weights_options options = {.size = sizeof options,
                                         .kernel = gauss ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND,
                                         .affine_tail = gauss ? -1 : 1,
                                         .n_edges = TIPS,
                                         .edges = edges};
    made before = make(sampling, TIPS, star, &options);
    const iccp_radial radial = iccp_radial_make(options.kernel, before.info.sigma, 5);
    leg l = make_leg(&before, star, &radial, !gauss);
    made after = stiffen(&before, l.n_part, l.places, NULL, energy);
    ck_assert_double_gt(relative_gap(&l, &before, &before, star), 0.1);
    const double gap = relative_gap(&l, &before, &after, star);
    ck_assert_msg(gap < 1e-6, "the energy can be %g above its least", gap);
    ck_assert_double_le(after.info.residual, 1e-8);
    ck_assert_double_gt(after.info.residual, 0);
    ck_assert_double_le(before.info.residual, 0);
    for (size_t k = 0; k < TIPS * before.info.n_nodes; ++k)
        ck_assert_double_ge(after.values[k], fmin(before.values[k], 0));
    free(l.places);
    iccp_collocation_free(l.collocation);
    clear(&before);
    clear(&after);
    icc_sampling_free(sampling);
}
END_TEST

/* By either kernel. The energy at the end is that of the interpolant, whose coefficients threads find
 * side by side. */
START_TEST(rigid_parts_do_not_depend_on_threads)
{
    double star[2 * TIPS], energy[2], again[2];
    draw_star(star);
    icc_sampling *sampling = make_samples(TIPS, star, 1.2, ICC_SAMPLING_BLUE, 0.035);
    const icc_weights_options options = {
        .size = sizeof options, .kernel = _i == 0 ? ICC_KERNEL_WENDLAND : ICC_KERNEL_GAUSS};
    made before = make(sampling, TIPS, star, &options);
    uint32_t *part = allocate(before.info.n_nodes, sizeof *part);
    const size_t n = find_leg(&before, star, part);
    made alone = stiffen(&before, n, part, NULL, energy);
    const double measured = energy_of(&alone, n, part, NULL);
    ck_assert_double_lt(energy[1], 0.6 * energy[0]);
    for (int32_t threads = 1; threads <= 4; threads *= 2) {
        const icc_env env = {.size = sizeof env, .threads = threads};
        icc_weights *stiff;
        ck_assert_int_eq(
            icc_weights_stiffen(&stiff, before.weights, n, part, NULL, again, &env, NULL), ICC_OK);
        made shared = take(stiff);
        const double here = energy_of(&shared, n, part, NULL);
        ck_assert_mem_eq(&here, &measured, sizeof here);
        ck_assert_mem_eq(again, energy, sizeof energy);
        ck_assert_mem_eq(&shared.info.residual, &alone.info.residual, sizeof(double));
        ck_assert_mem_eq(shared.values, alone.values,
                         TIPS * before.info.n_nodes * sizeof *alone.values);
        clear(&shared);
    }
    free(part);
    clear(&before);
    clear(&alone);
    icc_sampling_free(sampling);
}
END_TEST

/* A rigidity that varies is no obstacle: it counts where it is large, and only its proportions
 * do. */
START_TEST(rigidity_may_vary)
{
    double star[2 * TIPS], energy[2];
    draw_star(star);
    icc_sampling *sampling = make_samples(TIPS, star, 1.2, ICC_SAMPLING_BLUE, 0.05);
    made before = make(sampling, TIPS, star, NULL);
    uint32_t *part = allocate(before.info.n_nodes, sizeof *part);
    const size_t n = find_leg(&before, star, part), half = n / 2;
    double *rigidity = allocate(n, sizeof *rigidity);
    made even = stiffen(&before, n, part, NULL, energy);
    for (size_t i = 0; i < n; ++i)
        rigidity[i] = 1e-4;
    made scaled = stiffen(&before, n, part, rigidity, energy);
    for (size_t i = 0; i < TIPS * before.info.n_nodes; ++i)
        ck_assert_double_le(fabs(scaled.values[i] - even.values[i]), 1e-6);
    for (size_t i = 0; i < n; ++i)
        rigidity[i] = i < half ? 100 : 1;
    made uneven = stiffen(&before, n, part, rigidity, energy);
    ck_assert_double_lt(energy_of(&uneven, half, part, NULL), energy_of(&even, half, part, NULL));
    ck_assert_double_lt(energy_of(&uneven, n, part, rigidity), energy_of(&even, n, part, rigidity));
    free(part);
    free(rigidity);
    clear(&before);
    clear(&even);
    clear(&scaled);
    clear(&uneven);
    icc_sampling_free(sampling);
}
END_TEST

/* ---- 2 and 3: diffusion ---- */

/* The printed step, on the same nodes: the greatest value that an impulse at a handle grows to. */
static double grow_raw(const made *m, int steps)
{
    const size_t n = m->info.n_nodes;
    iccp_env env;
    iccp_cells cells;
    iccp_kernel_matrix k;
    const iccp_radial radial = iccp_radial_make(ICC_KERNEL_GAUSS, m->info.sigma, 5);
    double *w = allocate(n, sizeof *w), *next = allocate(n, sizeof *next), most = 0;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_cells_create(&cells, 2, n, m->points, radial.reach, &env), ICC_OK);
    ck_assert_int_eq(iccp_kernel_matrix_create(&k, &cells, &radial, &env, NULL), ICC_OK);
    w[0] = 1;
    for (int s = 0; s < steps; ++s) {
        for (size_t i = 0; i < n; ++i) {
            next[i] = i < m->info.n_handles ? w[i] : w[i] * k.diagonal[i];
            for (size_t p = k.first[i]; i >= m->info.n_handles && p < k.first[i + 1]; ++p)
                next[i] += k.value[p] * w[k.column[p]];
        }
        memcpy(w, next, n * sizeof *w);
    }
    for (size_t i = 0; i < n; ++i)
        most = fmax(most, w[i]);
    iccp_kernel_matrix_free(&k);
    iccp_cells_free(&cells);
    free(w);
    free(next);
    return most;
}

/* With rows that sum to 1, weights stay between those of the handles, which are held; raw, they
 * grow without end. */
START_TEST(diffusion_does_not_grow_and_handles_are_held)
{
    double star[2 * TIPS];
    draw_star(star);
    icc_sampling *sampling = make_samples(TIPS, star, 1.2, ICC_SAMPLING_BLUE, 0.05);
    for (int32_t steps = 1; steps <= 100; steps = steps < 5 ? 5 : 20 * steps)
        for (int32_t visible = -1; visible <= 1; visible += 2) {
            const icc_weights_options options = {.size = sizeof options,
                                                 .kernel = ICC_KERNEL_GAUSS,
                                                 .steps = steps,
                                                 .within_shape = visible};
            made m = make(sampling, TIPS, star, &options);
            for (size_t i = 0; i < m.info.n_nodes; ++i) {
                double sum = 0;
                for (size_t j = 0; j < TIPS; ++j) {
                    const double w = m.initial[TIPS * i + j];
                    sum += w;
                    ck_assert_double_ge(w, 0);
                    if (i < TIPS)
                        ck_assert_double_eq(w, i == j ? 1 : 0);
                }
                ck_assert_double_le(sum, 1 + 1e-12);
            }
            if (steps >= 100)
                ck_assert_double_gt(grow_raw(&m, steps), 1e3);
            clear(&m);
        }
    icc_sampling_free(sampling);
}
END_TEST

/* A step is a mean: where all that is held sums to 1 and all else did, it goes on doing so. Here
 * every node is given a sum of 1 by many steps: the handles' hull fills up. */
START_TEST(diffusion_fills_up_to_one)
{
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    icc_sampling *sampling = make_samples(4, square, 0, ICC_SAMPLING_BLUE, 0.1);
    const icc_weights_options options = {.size = sizeof options, .steps = 20000};
    made m = make(sampling, 4, square, &options);
    for (size_t i = 0; i < m.info.n_nodes; ++i) {
        const double *w = m.initial + 4 * i;
        ck_assert_double_le(fabs(w[0] + w[1] + w[2] + w[3] - 1), 1e-9);
    }
    clear(&m);
    icc_sampling_free(sampling);
}
END_TEST

/* Because handles are held, Lagrange's property holds with every method and start (tables 6.1 and
 * 6.2 say no). */
START_TEST(handles_keep_their_weights)
{
    double star[2 * TIPS];
    draw_star(star);
    icc_sampling *sampling = make_samples(TIPS, star, 1.2, ICC_SAMPLING_BLUE, 0.05);
    for (int32_t initial = ICC_INITIAL_HEAT; initial <= ICC_INITIAL_INVERSE; initial += 2)
        for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
            const icc_weights_options options = {
                .size = sizeof options, .initial = initial, .method = method};
            double weights[TIPS * TIPS];
            made m = make(sampling, TIPS, star, &options);
            ck_assert_int_eq(
                icc_weights_evaluate(m.weights, TIPS, star, weights, NULL, NULL, NULL, NULL),
                ICC_OK);
            for (size_t k = 0; k < TIPS * TIPS; ++k)
                ck_assert_double_le(fabs(weights[k] - (k / TIPS == k % TIPS ? 1 : 0)), 1e-11);
            clear(&m);
        }
    icc_sampling_free(sampling);
}
END_TEST

/* ---- 4: l1 ---- */

/* On nine nodes of ten any weights that are not less than the initial ones are as good: we take
 * those with the least squares. Had the solution been unique, at most three weights would have
 * changed. */
START_TEST(l1_ties_are_broken_by_squares)
{
    double star[2 * TIPS];
    draw_star(star);
    icc_sampling *sampling = make_samples(TIPS, star, 0, ICC_SAMPLING_BLUE, 0.05);
    const icc_weights_options l1 = {.size = sizeof l1, .method = ICC_WEIGHTS_L1};
    made m = make(sampling, TIPS, star, &l1);
    size_t tied = 0, inner = 0;
    for (size_t i = TIPS; i < m.info.n_nodes; ++i) {
        size_t changed = 0;
        ck_assert_double_le(error_at(&m, star, i), 1e-11);
        for (size_t j = 0; j < TIPS; ++j)
            changed += fabs(m.values[TIPS * i + j] - m.initial[TIPS * i + j]) > 1e-9;
        tied += changed > 3;
        ++inner;
    }
    ck_assert_double_gt((double)tied, 0.8 * (double)inner);
    clear(&m);
    icc_sampling_free(sampling);
}
END_TEST

/* ---- 5: outside the handles' hull ---- */

START_TEST(infeasible_nodes_are_counted_and_still_reproduce)
{
    double star[2 * TIPS];
    size_t outside = 0, n_bad = 0;
    draw_star(star);
    icc_sampling *sampling = make_samples(TIPS, star, 1.4, ICC_SAMPLING_BLUE, 0.05);
    made m = make(sampling, TIPS, star, NULL);
    for (size_t i = 0; i < m.info.n_nodes; ++i) {
        double least = 0, farthest = -1;
        /* The hull is the pentagon of the tips. */
        for (size_t e = 0; e < TIPS; e += 2) {
            const double *p = star + 2 * e, *q = star + 2 * ((e + 2) % TIPS), *x = m.points + 2 * i;
            const double area = (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]);
            farthest = fmax(farthest, -area);
        }
        for (size_t j = 0; j < TIPS; ++j)
            least = fmin(least, m.values[TIPS * i + j]);
        ck_assert_double_le(error_at(&m, star, i), 1e-12);
        if (fabs(farthest) > 1e-9)
            ck_assert_int_eq(m.status[i], farthest > 0 ? ICC_ERR_SOLVER : ICC_OK);
        if (m.status[i] == ICC_OK)
            ck_assert_double_ge(least, 0);
        outside += farthest > 1e-9;
        n_bad += m.status[i] != ICC_OK;
    }
    ck_assert_uint_eq(m.info.n_infeasible, n_bad);
    ck_assert_uint_ge(n_bad, outside);
    ck_assert_uint_gt(3 * outside, m.info.n_nodes);
    clear(&m);
    icc_sampling_free(sampling);
}
END_TEST

/* ---- 6: the kernel's reach ---- */

/* The greatest second difference of a weight on the way across a shape, in steps so small that
 * those of a smooth function vanish: a jump. */
static double greatest_jump(const made *m)
{
    enum { STEPS = 20000 };
    double *points = allocate(STEPS, 2 * sizeof *points);
    double *weights = allocate(STEPS, 4 * sizeof *weights), jump = 0;
    for (size_t k = 0; k < STEPS; ++k) {
        points[2 * k] = 0.2 + 0.6 * (double)k / STEPS;
        points[2 * k + 1] = 0.47;
    }
    ck_assert_int_eq(
        icc_weights_evaluate(m->weights, STEPS, points, weights, NULL, NULL, NULL, NULL), ICC_OK);
    for (size_t k = 4; k + 4 < 4 * (size_t)STEPS; ++k)
        jump = fmax(jump, fabs(weights[k + 4] - 2 * weights[k] + weights[k - 4]));
    free(points);
    free(weights);
    return jump;
}

/* The Gaussian, cut off, jumps and may be indefinite; Wendland's function neither. */
START_TEST(the_default_kernel_is_smooth_and_definite)
{
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1}, spacing = 0.05;
    icc_sampling *sampling = make_samples(4, square, 0, ICC_SAMPLING_GRID, spacing);
    icc_weights_options options = {.size = sizeof options, .sigma = 3 * spacing / 3.14159265358979};
    double jump[3];
    for (int32_t kind = ICC_KERNEL_WENDLAND; kind <= ICC_KERNEL_GAUSS; ++kind) {
        options.kernel = kind;
        options.cutoff = kind == ICC_KERNEL_GAUSS ? 3 : 0;
        made m = make(sampling, 4, square, &options);
        jump[kind] = greatest_jump(&m);
        clear(&m);
    }
    ck_assert_double_lt(jump[ICC_KERNEL_WENDLAND], 1e-5);
    ck_assert_double_gt(jump[ICC_KERNEL_GAUSS], 1e-4);
    for (double width = 1.6; width < 7; width *= 2) {
        icc_weights *weights;
        icc_error err = {.size = sizeof err};
        options = (icc_weights_options){
            .size = sizeof options, .kernel = ICC_KERNEL_GAUSS, .sigma = width * spacing};
        ck_assert_int_eq(icc_weights_create(&weights, sampling, 4, square, &options, NULL, &err),
                         ICC_ERR_SOLVER);
        ck_assert_ptr_null(weights);
        ck_assert_ptr_nonnull(strstr(err.message, "sigma"));
        options.kernel = ICC_KERNEL_WENDLAND;
        made m = make(sampling, 4, square, &options);
        ck_assert_double_gt(m.info.definiteness, 0);
        clear(&m);
    }
    icc_sampling_free(sampling);
}
END_TEST

/* ---- 7: leaks ---- */

/* The greatest weight in the upper half of the right leg of a handle at the top of the left one. */
static double leak(const icc_sampling *sampling, int32_t visible, int32_t steps)
{
    const double handles[8] = {-0.05, 1.1, -0.5, -1.1, 0.5, -1.1, 0.5, 1.1};
    const icc_weights_options options = {.size = sizeof options,
                                         .kernel = ICC_KERNEL_GAUSS,
                                         .initial = ICC_INITIAL_HEAT,
                                         .within_shape = visible,
                                         .steps = steps};
    double most = 0;
    made m = make(sampling, 4, handles, &options);
    for (size_t i = 4; i < m.info.n_nodes; ++i) {
        const double *x = m.points + 2 * i;
        if (x[0] > 0.05 && x[0] < 0.55 && x[1] > 0 && x[1] < 1.2)
            most = fmax(most, m.initial[4 * i]);
    }
    clear(&m);
    return most;
}

/* Alone, and with samples around it, which the thesis recommends. */
START_TEST(weights_do_not_leak_across_gaps)
{
    for (int around = 0; around < 2; ++around) {
        icc_sampling *sampling =
            make_samples(8, U, around > 0 ? 1.4 : 0, ICC_SAMPLING_BLUE, GAP / 2);
        ck_assert_double_le(leak(sampling, 0, 5), 4e-9);
        ck_assert_double_le(leak(sampling, 1, 100), 4e-9);
        ck_assert_double_ge(leak(sampling, -1, 5), around > 0 ? 0.03 : 0.01);
        ck_assert_double_ge(leak(sampling, -1, 100), 0.1);
        icc_sampling_free(sampling);
    }
}
END_TEST

/* ---- 8: containment ---- */

/* No sample but those on the boundaries is on a wall, none is outside, and each region has its
 * share. */
START_TEST(samples_stay_on_their_side)
{
    double star[2 * TIPS];
    draw_star(star);
    icc_sampling *sampling = make_samples(TIPS, star, 1.2, ICC_SAMPLING_BLUE, 0.03);
    icc_sampling_info info = {.size = sizeof info};
    size_t in_star = 0;
    ck_assert_int_eq(icc_sampling_get_info(sampling, &info), ICC_OK);
    ck_assert_double_ge(info.nearest, 0.55);
    for (size_t i = info.n_edge; i < info.n_samples; ++i) {
        const uint32_t region = iccp_shape_region(sampling->shape, sampling->points + 2 * i);
        ck_assert_uint_ne(region, ICCP_NOWHERE);
        in_star += region == 0;
    }
    /* The star is 1.1756 of 5.76; along boundaries there is a rim without inner samples. */
    const double share = (double)in_star / (double)(info.n_samples - info.n_edge);
    ck_assert_double_le(fabs(share - 1.1756 / 5.76), 0.03);
    icc_sampling_free(sampling);
}
END_TEST

/* ---- 9: quadratic programs on the hull ---- */

/* A polygon with all its edges on the hull: Newton's method without damping fails there. */
START_TEST(hull_edges_are_solved)
{
    double polygon[2 * SIDES];
    size_t on_hull = 0;
    for (size_t i = 0; i < SIDES; ++i) {
        polygon[2 * i] = cos(6.283185307179586 * (double)i / SIDES);
        polygon[2 * i + 1] = sin(6.283185307179586 * (double)i / SIDES);
    }
    icc_sampling *sampling = make_samples(SIDES, polygon, 0, ICC_SAMPLING_BLUE, 0.02);
    for (int32_t initial = ICC_INITIAL_HEAT; initial <= ICC_INITIAL_INVERSE; initial += 2) {
        const icc_weights_options options = {.size = sizeof options, .initial = initial};
        made m = make(sampling, SIDES, polygon, &options);
        ck_assert_uint_eq(m.info.n_infeasible, 0);
        for (size_t i = 0; i < m.info.n_nodes; ++i) {
            size_t used = 0;
            ck_assert_double_le(error_at(&m, polygon, i), 1e-12);
            for (size_t j = 0; j < SIDES; ++j)
                used += m.values[SIDES * i + j] > 1e-9;
            on_hull += used <= 2;
        }
        clear(&m);
    }
    ck_assert_uint_gt(on_hull, 500);
    icc_sampling_free(sampling);
}
END_TEST

/* ---- 10: arithmetic ---- */

/* What -ffast-math would break, also in programs that only link the library: small numbers become
 * 0, NaN is not noticed. */
START_TEST(arithmetic_is_strict)
{
    volatile double small = DBL_MIN;
    small /= 4;
    ck_assert_double_gt(small, 0);
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1}, points[4] = {0.5, NAN, 0.5, 0.5};
    double weights[8];
    icc_status status[2];
    size_t n_failed;
    icc_sampling *sampling = make_samples(4, square, 0, ICC_SAMPLING_BLUE, 0.1);
    made m = make(sampling, 4, square, NULL);
    ck_assert_int_eq(
        icc_weights_evaluate(m.weights, 2, points, weights, NULL, status, &n_failed, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 1);
    ck_assert_int_eq(status[0], ICC_ERR_ARGUMENT);
    ck_assert_int_eq(status[1], ICC_OK);
    ck_assert(isnan(weights[0]));
    ck_assert_double_le(fabs(weights[4] + weights[5] + weights[6] + weights[7] - 1), 1e-11);
    clear(&m);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("thesis");
    TCase *defects = tcase_create("defects");
    tcase_add_test(defects, rigid_parts_lose_energy_and_edges_stay);
    tcase_add_loop_test(defects, rigid_parts_are_at_the_optimum, 0, 3);
    tcase_add_loop_test(defects, rigid_parts_do_not_depend_on_threads, 0, 2);
    tcase_add_test(defects, rigidity_may_vary);
    tcase_add_test(defects, diffusion_does_not_grow_and_handles_are_held);
    tcase_add_test(defects, diffusion_fills_up_to_one);
    tcase_add_test(defects, handles_keep_their_weights);
    tcase_add_test(defects, l1_ties_are_broken_by_squares);
    tcase_add_test(defects, infeasible_nodes_are_counted_and_still_reproduce);
    tcase_add_test(defects, the_default_kernel_is_smooth_and_definite);
    tcase_add_test(defects, weights_do_not_leak_across_gaps);
    tcase_add_test(defects, samples_stay_on_their_side);
    tcase_add_test(defects, hull_edges_are_solved);
    tcase_add_test(defects, arithmetic_is_strict);
    suite_add_tcase(suite, defects);
    return suite_run(suite);
}
