/* The natural spline of a frame: affine truths, exact points, points left out, bad input, and the
 * same bits on every number of threads. */
#include "base/error.h"
#include "fit/spline/frame_mesh.h"
#include "fit/spline/spline.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../random.h"
#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 400 };

/* Control points in the unit square. */
typedef struct points_set {
    size_t n;
    double points[2 * MOST], targets[2 * MOST], tolerances[MOST];
} points_set;

static void affine(const double p[2], double q[2])
{
    q[0] = 0.3 + 0.9 * p[0] - 0.4 * p[1];
    q[1] = -0.2 + 0.3 * p[0] + 1.1 * p[1];
}

static void wavy(const double p[2], double q[2])
{
    q[0] = p[0] + 0.04 * sin(3 * p[1]) + 0.015 * p[0] * p[0];
    q[1] = 0.97 * p[1] + 0.05 * sin(2.5 * p[0]) - 0.03 * p[0] * p[1];
}

static points_set make_sheet(size_t n, void (*truth)(const double *, double *), random_source *r)
{
    points_set s = {.n = n};
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < 2; ++k)
            s.points[2 * i + k] = random_between(r, 0.04, 0.96);
        truth(s.points + 2 * i, s.targets + 2 * i);
    }
    return s;
}

static iccp_spline_task task_of(const points_set *s)
{
    static const double lower[2] = {0, 0}, upper[2] = {1, 1};
    return (iccp_spline_task){
        .n = s->n, .points = s->points, .targets = s->targets, .lower = lower, .upper = upper};
}

static iccp_spline spline_of(const iccp_spline_task *task)
{
    const iccp_env env = default_env();
    icc_error err = {.size = sizeof err};
    iccp_spline s;
    ck_assert_msg(iccp_spline_create(&s, task, &env, &err) == ICC_OK, "%s", err.message);
    return s;
}

/* Checks that points are vertices, and that exact ones have their targets, bit for bit. */
static void check_points(const iccp_spline *s, const iccp_spline_task *task)
{
    for (size_t i = 0; i < task->n; ++i) {
        const size_t v = s->control.number[i];
        ck_assert_mem_eq(s->map.points + 2 * v, task->points + 2 * i, 2 * sizeof(double));
        if (s->map.fixed[v] == ICCP_ON_POINT)
            ck_assert_mem_eq(s->map.images + 2 * v, task->targets + 2 * i, 2 * sizeof(double));
    }
}

static double most_off(const iccp_spline *s, void (*truth)(const double *, double *))
{
    double most = 0;
    for (size_t v = 0; v < s->map.n_vertices; ++v) {
        double q[2];
        truth(s->map.points + 2 * v, q);
        most = fmax(most,
                    fmax(fabs(q[0] - s->map.images[2 * v]), fabs(q[1] - s->map.images[2 * v + 1])));
    }
    return most;
}

/* Affine maps do not bend, so three points or more give them everywhere. */
START_TEST(affine_truths)
{
    random_source r = {1};
    const size_t counts[] = {3, 4, 10, 100};
    for (size_t k = 0; k < 4; ++k) {
        const points_set sheet = make_sheet(counts[k], affine, &r);
        const iccp_spline_task task = task_of(&sheet);
        iccp_spline s = spline_of(&task);
        check_points(&s, &task);
        ck_assert_double_lt(most_off(&s, affine), 1e-14);
        ck_assert_uint_eq(iccp_plmap_count_inverted(&s.map), 0);
        iccp_spline_free(&s);
    }
}
END_TEST

/* One point gives a shift and two give a similarity, also if there are more on one line. */
START_TEST(few_points)
{
    points_set sheet = {.n = 1, .points = {0.5, 0.25}, .targets = {0.75, 0.5}};
    iccp_spline_task task = task_of(&sheet);
    task.lower = task.upper = NULL;
    iccp_spline s = spline_of(&task);
    for (size_t v = 0; v < s.map.n_vertices; ++v)
        for (size_t k = 0; k < 2; ++k)
            ck_assert_double_eq_tol(s.map.images[2 * v + k], s.map.points[2 * v + k] + 0.25, 1e-15);
    iccp_spline_free(&s);
    for (size_t n = 2; n <= 7; ++n) {
        sheet.n = n;
        for (size_t i = 0; i < n; ++i) {
            double *p = sheet.points + 2 * i, *q = sheet.targets + 2 * i;
            p[0] = p[1] = 0.125 * (double)(i + 1);
            q[0] = -2 * p[1];
            q[1] = 2 * p[0];
        }
        task.n = n;
        s = spline_of(&task);
        for (size_t v = 0; v < s.map.n_vertices; ++v) {
            ck_assert_double_eq_tol(s.map.images[2 * v], -2 * s.map.points[2 * v + 1], 1e-14);
            ck_assert_double_eq_tol(s.map.images[2 * v + 1], 2 * s.map.points[2 * v], 1e-14);
        }
        iccp_spline_free(&s);
    }
}
END_TEST

static double energy_of(const iccp_gram *q, const double *u)
{
    double sum = 0;
    for (size_t i = 0; i < q->matrix.n; ++i) {
        sum += q->diagonal[i] * u[i] * u[i];
        for (size_t p = q->first[i]; p < q->first[i + 1]; ++p)
            sum += q->value[p] * u[i] * u[q->column[p]];
    }
    return sum;
}

/* The energy of affine functions is 0, that of x^2 is four times the area and that of xy twice, and
 * no function has less than 0. */
START_TEST(energy)
{
    random_source r = {2};
    const iccp_env env = default_env();
    const points_set sheet = make_sheet(30, affine, &r);
    iccp_frame_region region;
    iccp_box_mesh mesh;
    iccp_gram q;
    ck_assert(iccp_frame_region_create(&region, 30, sheet.points, NULL, NULL, NULL, &env) ==
              ICC_OK);
    ck_assert(iccp_frame_mesh(&mesh, &region, 0.1, 24, 0, &env) == ICC_OK);
    const iccp_bending_mesh bending = iccp_bending_mesh_of(&mesh);
    ck_assert(iccp_bending_energy(&q, &bending, &env) == ICC_OK);
    const double area = (region.upper[0] - region.lower[0] + 0.2 * region.size) *
                        (region.upper[1] - region.lower[1] + 0.2 * region.size);
    double *u = malloc(mesh.n_vertices * sizeof *u);
    for (int k = 0; k < 5; ++k) {
        for (size_t v = 0; v < mesh.n_vertices; ++v) {
            const double x = mesh.points[2 * v], y = mesh.points[2 * v + 1];
            u[v] = k == 0 ? 1 : k == 1 ? x : k == 2 ? y : k == 3 ? x * x : x * y;
        }
        const double is = energy_of(&q, u), want = k < 3 ? 0 : k == 3 ? 4 * area : 2 * area;
        ck_assert_double_eq_tol(is, want, k < 3 ? 1e-7 : 0.1 * want);
    }
    for (size_t v = 0; v < mesh.n_vertices; ++v)
        u[v] = random_between(&r, -1, 1);
    ck_assert_double_gt(energy_of(&q, u), 0);
    free(u);
    iccp_gram_free(&q);
    iccp_box_mesh_free(&mesh);
    iccp_free(&env.memory, region.spacing);
}
END_TEST

/* Solves again on the same mesh without point i. */
static void leave_out_slowly(const iccp_spline *s, size_t i, double out[2])
{
    const iccp_env env = default_env();
    const size_t n = s->control.n;
    iccp_bending_mesh bending = iccp_bending_mesh_of(&s->base->solved);
    memcpy(bending.metric, s->base->metric, sizeof bending.metric);
    uint32_t told[MOST];
    double weight[MOST], value[2 * MOST];
    for (size_t k = 0, to = 0; k < n; ++k)
        if (k != i) {
            told[to] = (uint32_t)k;
            weight[to] = s->base->system.weight[k];
            memcpy(value + 2 * to++, s->told + 2 * k, 2 * sizeof(double));
        }
    iccp_spline_system system;
    double *u = malloc(2 * s->base->solved.n_vertices * sizeof *u);
    ck_assert(iccp_spline_system_create(&system, &bending, n - 1, told, weight, false, &env) ==
              ICC_OK);
    ck_assert(iccp_spline_system_solve(&system, value, u, &env) == ICC_OK);
    for (size_t k = 0; k < 2; ++k)
        out[k] = u[2 * i + k] - s->told[2 * i + k];
    iccp_spline_system_free(&system);
    free(u);
}

/* Residuals left out are those of fits without the point, for exact and for weighted points. */
START_TEST(left_out)
{
    random_source r = {3};
    for (int weighted = 0; weighted < 2; ++weighted) {
        points_set sheet = make_sheet(9, wavy, &r);
        iccp_spline_task task = task_of(&sheet);
        task.margin = 0.3;
        for (size_t i = 0; i < sheet.n; ++i)
            sheet.tolerances[i] = i % 3 == 0 ? 0 : 0.01 * (double)i;
        if (weighted) {
            task.tolerances = sheet.tolerances;
            task.smoothing = 1e-4;
        }
        iccp_spline s = spline_of(&task);
        check_points(&s, &task);
        for (size_t i = 0; i < sheet.n; ++i) {
            double out[2];
            leave_out_slowly(&s, i, out);
            for (size_t k = 0; k < 2; ++k)
                ck_assert_double_eq_tol(out[k], s.left_out[2 * i + k], 1e-9);
        }
        iccp_spline_free(&s);
    }
}
END_TEST

/* What the others do not determine is not a number. */
START_TEST(not_determined)
{
    const points_set sheet = {.n = 4,
                              .points = {0.1, 0.1, 0.5, 0.5, 0.9, 0.9, 0.9, 0.1},
                              .targets = {0.1, 0.1, 0.5, 0.52, 0.9, 0.9, 0.9, 0.1}};
    const iccp_spline_task task = task_of(&sheet);
    iccp_spline s = spline_of(&task);
    ck_assert(isnan(s.left_out[6]) && isnan(s.left_out[7]));
    ck_assert(isfinite(s.left_out[2]) && isfinite(s.left_out_residual));
    iccp_spline_free(&s);
}
END_TEST

static icc_status try(const iccp_spline_task *task, icc_error *err)
{
    const iccp_env env = default_env();
    iccp_spline s;
    *err = (icc_error){.size = sizeof *err};
    const icc_status status = iccp_spline_create(&s, task, &env, err);
    if (status == ICC_OK)
        iccp_spline_free(&s);
    return status;
}

START_TEST(bad_input)
{
    random_source r = {5};
    icc_error err;
    points_set sheet = make_sheet(12, wavy, &r);
    const iccp_spline_task task = task_of(&sheet);
    memcpy(sheet.points + 14, sheet.points + 4, 2 * sizeof(double));
    ck_assert_int_eq(try(&task, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq((int)err.index, 7);
    ck_assert_ptr_nonnull(strstr(err.message, "2"));
    memcpy(sheet.targets + 14, sheet.targets + 4, 2 * sizeof(double));
    ck_assert_int_eq(try(&task, &err), ICC_OK);
    memcpy(sheet.targets + 10, sheet.targets + 18, 2 * sizeof(double));
    ck_assert_int_eq(try(&task, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq((int)err.index, 9);
    for (size_t i = 0; i < sheet.n; ++i)
        sheet.targets[2 * i] = -sheet.points[2 * i];
    ck_assert_int_eq(try(&task, &err), ICC_ERR_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(err.message, "mirror"));
    for (size_t i = 0; i < sheet.n; ++i)
        sheet.targets[2 * i] = sheet.targets[2 * i + 1] = sheet.points[2 * i];
    memcpy(sheet.targets + 14, sheet.targets + 4, 2 * sizeof(double));
    ck_assert_int_eq(try(&task, &err), ICC_ERR_ARGUMENT);
}
END_TEST

/* Root mean square error in the unit square. */
static double mean_off(const iccp_spline *s, void (*truth)(const double *, double *))
{
    double sum = 0, count = 0;
    for (size_t v = 0; v < s->map.n_vertices; ++v) {
        const double *p = s->map.points + 2 * v;
        double q[2];
        if (p[0] < 0 || p[0] > 1 || p[1] < 0 || p[1] > 1)
            continue;
        truth(p, q);
        sum += iccp_vec_distance2(2, q, s->map.images + 2 * v);
        ++count;
    }
    return sqrt(sum / count);
}

/* A narrow strip does not tell how the map goes on across it. So noise there is no mirror. */
START_TEST(narrow_strip)
{
    random_source r = {10};
    for (int k = 0; k < 20; ++k) {
        points_set sheet = make_sheet(20, affine, &r);
        for (size_t i = 0; i < sheet.n; ++i) {
            sheet.points[2 * i + 1] = 0.5 + 1e-4 * sheet.points[2 * i + 1];
            affine(sheet.points + 2 * i, sheet.targets + 2 * i);
            for (size_t c = 0; c < 2; ++c)
                sheet.targets[2 * i + c] += random_between(&r, -1e-3, 1e-3);
        }
        const iccp_spline_task task = task_of(&sheet);
        iccp_spline s = spline_of(&task);
        check_points(&s, &task);
        iccp_spline_free(&s);
    }
}
END_TEST

/* Root mean square distance of the points' images from their targets. */
static double mean_residual(const iccp_spline *s, size_t n, const double *targets)
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < 2; ++k) {
            const double off =
                s->map.images[2 * (size_t)s->control.number[i] + k] - targets[2 * i + k];
            sum += off * off;
        }
    return sqrt(sum / (double)n);
}

/* Noise is smoothed away, so the truth is closer than with exact points. */
START_TEST(smoothing)
{
    random_source r = {6};
    points_set sheet = make_sheet(75, wavy, &r);
    for (size_t i = 0; i < sheet.n; ++i) {
        sheet.tolerances[i] = 0.01;
        for (size_t k = 0; k < 2; ++k)
            sheet.targets[2 * i + k] += random_between(&r, -0.017, 0.017);
    }
    iccp_spline_task task = task_of(&sheet);
    iccp_spline exact = spline_of(&task);
    task.tolerances = sheet.tolerances;
    iccp_spline smooth = spline_of(&task);
    ck_assert_double_gt(smooth.base->smoothing, 0);
    ck_assert_double_lt(mean_off(&smooth, wavy), 0.7 * mean_off(&exact, wavy));
    ck_assert_double_gt(mean_residual(&smooth, sheet.n, sheet.targets), 0.003);
    ck_assert_double_lt(smooth.left_out_residual, exact.left_out_residual);
    iccp_spline_free(&smooth);
    task.smoothing = -1;
    smooth = spline_of(&task);
    ck_assert_mem_eq(smooth.map.images, exact.map.images,
                     2 * exact.map.n_vertices * sizeof *exact.map.images);
    iccp_spline_free(&smooth);
    iccp_spline_free(&exact);
}
END_TEST

START_TEST(threads)
{
    random_source r = {7};
    const points_set sheet = make_sheet(300, wavy, &r);
    const iccp_spline_task task = task_of(&sheet);
    iccp_spline s[2];
    for (int k = 0; k < 2; ++k) {
        iccp_env env = default_env();
        env.threads = 1 + 3 * k;
        ck_assert(iccp_spline_create(&s[k], &task, &env, NULL) == ICC_OK);
    }
    ck_assert_uint_eq(s[0].map.n_vertices, s[1].map.n_vertices);
    ck_assert_mem_eq(s[0].map.images, s[1].map.images,
                     2 * s[0].map.n_vertices * sizeof *s[0].map.images);
    ck_assert_mem_eq(s[0].left_out, s[1].left_out, 2 * sheet.n * sizeof *s[0].left_out);
    iccp_spline_free(&s[0]);
    iccp_spline_free(&s[1]);
}
END_TEST

/* ---- against thin plates ---- */

static void projective(const double p[2], double q[2])
{
    const double w = 1 + 0.3 * p[0] - 0.2 * p[1];
    q[0] = (p[0] + 0.1 * p[1]) / w;
    q[1] = (0.05 * p[0] + p[1]) / w;
}

static void barrel(const double p[2], double q[2])
{
    const double x = p[0] - 0.5, y = p[1] - 0.5, s = 1 - 0.25 * (x * x + y * y);
    q[0] = 0.5 + s * x;
    q[1] = 0.5 + s * y;
}

static void bump(const double p[2], double q[2])
{
    const double x = p[0] - 0.45, y = p[1] - 0.6, s = exp(-(x * x + y * y) / 0.03);
    q[0] = p[0] + 0.08 * s;
    q[1] = p[1] + 0.05 * s;
}

static void fault(const double p[2], double q[2])
{
    q[0] = p[0] + 0.05 * tanh((p[1] - 0.4) / 0.12);
    q[1] = p[1];
}

static void swirl(const double p[2], double q[2])
{
    const double x = p[0] - 0.5, y = p[1] - 0.5, t = 2 * exp(-8 * (x * x + y * y));
    q[0] = 0.5 + x * cos(t) - y * sin(t);
    q[1] = 0.5 + x * sin(t) + y * cos(t);
}

/* A thin plate through few points, by a dense matrix: n weights, then an affine function. */
typedef struct thin_plate {
    const points_set *sheet;
    double weight[MOST + 3][2];
} thin_plate;

static double kernel(const double *p, const double *q)
{
    const double r2 = iccp_vec_distance2(2, p, q);
    return r2 > 0 ? r2 * log(r2) : 0;
}

/* Gaussian elimination with pivots. Each row of `a` has n coefficients and two right-hand sides. */
static void eliminate(size_t n, double *a, double (*x)[2])
{
    const size_t width = n + 2;
    for (size_t k = 0; k < n; ++k) {
        size_t best = k;
        for (size_t i = k + 1; i < n; ++i)
            if (fabs(a[i * width + k]) > fabs(a[best * width + k]))
                best = i;
        for (size_t j = 0; j < width; ++j) {
            const double t = a[k * width + j];
            a[k * width + j] = a[best * width + j];
            a[best * width + j] = t;
        }
        for (size_t i = k + 1; i < n; ++i) {
            const double factor = a[i * width + k] / a[k * width + k];
            for (size_t j = k; j < width; ++j)
                a[i * width + j] -= factor * a[k * width + j];
        }
    }
    for (size_t k = n; k-- > 0;)
        for (size_t c = 0; c < 2; ++c) {
            double sum = a[k * width + n + c];
            for (size_t j = k + 1; j < n; ++j)
                sum -= a[k * width + j] * x[j][c];
            x[k][c] = sum / a[k * width + k];
        }
}

static void make_plate(thin_plate *plate, const points_set *sheet)
{
    const size_t n = sheet->n, width = n + 5;
    double *a = calloc((n + 3) * width, sizeof *a);
    for (size_t i = 0; i < n; ++i) {
        const double *p = sheet->points + 2 * i, row[3] = {1, p[0], p[1]};
        for (size_t j = 0; j < n; ++j)
            a[i * width + j] = kernel(p, sheet->points + 2 * j);
        for (size_t k = 0; k < 3; ++k)
            a[i * width + n + k] = a[(n + k) * width + i] = row[k];
        for (size_t c = 0; c < 2; ++c)
            a[i * width + n + 3 + c] = sheet->targets[2 * i + c];
    }
    plate->sheet = sheet;
    eliminate(n + 3, a, plate->weight);
    free(a);
}

static void apply_plate(const thin_plate *plate, const double *p, double *q)
{
    const size_t n = plate->sheet->n;
    for (size_t c = 0; c < 2; ++c) {
        q[c] =
            plate->weight[n][c] + plate->weight[n + 1][c] * p[0] + plate->weight[n + 2][c] * p[1];
        for (size_t i = 0; i < n; ++i)
            q[c] += plate->weight[i][c] * kernel(p, plate->sheet->points + 2 * i);
    }
}

/* The error of the spline at its vertices in the unit square, relative to that of a thin plate. */
static double compare(const points_set *sheet, void (*truth)(const double *, double *))
{
    const iccp_spline_task task = task_of(sheet);
    iccp_spline s = spline_of(&task);
    thin_plate plate;
    make_plate(&plate, sheet);
    double own = 0, other = 0;
    for (size_t v = 0; v < s.map.n_vertices; ++v) {
        const double *p = s.map.points + 2 * v;
        double q[2], r[2];
        if (p[0] < 0 || p[0] > 1 || p[1] < 0 || p[1] > 1)
            continue;
        truth(p, q);
        apply_plate(&plate, p, r);
        own += iccp_vec_distance2(2, q, s.map.images + 2 * v);
        other += iccp_vec_distance2(2, q, r);
    }
    iccp_spline_free(&s);
    return sqrt(own / other);
}

/* On an old map's distortions it is at least as good as a thin plate, and from 25 points much
 * better. Over other families it is as good in the mean and never much worse. */
START_TEST(thin_plates)
{
    void (*const truths[])(const double *, double *) = {wavy, projective, barrel,
                                                        bump, fault,      swirl};
    const size_t counts[] = {6, 12, 25, 75, 200};
    random_source r = {11};
    double sum = 0, n = 0;
    for (size_t k = 0; k < 5; ++k)
        for (size_t t = 0; t < 6; ++t) {
            const points_set sheet = make_sheet(counts[k], truths[t], &r);
            const double ratio = compare(&sheet, truths[t]);
            ck_assert_double_lt(ratio, t == 0 && counts[k] >= 25 ? 0.8 : t == 0 ? 1.02 : 1.25);
            sum += log(ratio);
            ++n;
        }
    ck_assert_double_lt(exp(sum / n), 1);
}
END_TEST

static icc_status call_spline(const icc_env *caller, icc_error *err, void *argument)
{
    iccp_env env;
    iccp_spline s;
    icc_status status = iccp_env_read(&env, caller, err);
    if (status == ICC_OK)
        status = iccp_spline_create(&s, argument, &env, err);
    if (status == ICC_OK)
        iccp_spline_free(&s);
    return iccp_explain(err, status);
}

START_TEST(failures)
{
    random_source r = {8};
    points_set sheet = make_sheet(12, wavy, &r);
    iccp_spline_task task = task_of(&sheet);
    faulty_sweep(call_spline, &task);
    task.n_segments = 1;
    task.segments = (const uint32_t[]){0, 1};
    faulty_sweep(call_spline, &task);
    task.n_segments = 0;
    for (size_t i = 0; i < sheet.n; ++i)
        sheet.tolerances[i] = 0.01;
    task.tolerances = sheet.tolerances;
    task.margin = 0.1;
    task.smoothing = 1e-4;
    faulty_sweep(call_spline, &task);
}
END_TEST

static Suite *make_suite(void)
{
    Suite *suite = suite_create("spline");
    TCase *tc = tcase_create("spline");
    tcase_set_timeout(tc, 120);
    tcase_add_test(tc, affine_truths);
    tcase_add_test(tc, few_points);
    tcase_add_test(tc, energy);
    tcase_add_test(tc, left_out);
    tcase_add_test(tc, not_determined);
    tcase_add_test(tc, bad_input);
    tcase_add_test(tc, smoothing);
    tcase_add_test(tc, threads);
    tcase_add_test(tc, narrow_strip);
    tcase_add_test(tc, thin_plates);
    tcase_add_test(tc, failures);
    suite_add_tcase(suite, tc);
    return suite;
}

int main(void)
{
    return suite_run(make_suite());
}
