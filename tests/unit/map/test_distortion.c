/* Energies of one triangle and one tetrahedron: their values, gradients and Hessians. */
#include "map/energy/dirichlet.h"
#include "map/energy/simplicial_map.h"
#include "map/energy/singular.h"
#include "map/energy/untangling.h"

#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct sample {
    size_t dim, n; /* n = dim (dim + 1) */
    double point[12], image[12];
    double element[ICCP_MAX_ELEMENT];
} sample;

static void corners_of(size_t dim, const double *points, const double *corner[4])
{
    for (size_t k = 0; k <= dim; ++k)
        corner[k] = points + dim * k;
}

static double measure_of(size_t dim, const double *p)
{
    double e[3][3];
    for (size_t i = 0; i < dim; ++i)
        for (size_t k = 0; k < dim; ++k)
            e[i][k] = p[dim * (i + 1) + k] - p[k];
    if (dim == 2)
        return (e[0][0] * e[1][1] - e[0][1] * e[1][0]) / 2;
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6;
}

static void set_element(sample *s)
{
    const double *corner[4];
    corners_of(s->dim, s->point, corner);
    iccp_element_create(s->dim, corner, s->element);
}

/* A simplex that is not too flat; its image has the wanted sign: +1, -1, or 0 for any. */
static sample random_sample(random_source *r, size_t dim, int sign)
{
    sample s = {.dim = dim, .n = dim * (dim + 1)};
    do {
        for (size_t i = 0; i < s.n; ++i)
            s.point[i] = random_between(r, -1, 1);
    } while (!(measure_of(dim, s.point) > 0.05));
    set_element(&s);
    ck_assert_double_eq_tol(s.element[0], measure_of(dim, s.point), 1e-15);
    do {
        for (size_t i = 0; i < s.n; ++i)
            s.image[i] = random_between(r, -1, 1);
    } while (sign != 0 && !(sign * measure_of(dim, s.image) > 0.025));
    return s;
}

typedef double energy_function(size_t dim, const double *element, const double *const *image,
                               double epsilon);

static double dirichlet(size_t dim, const double *element, const double *const *image,
                        double epsilon)
{
    (void)epsilon;
    return iccp_dirichlet_energy(dim, element, image);
}

static double energy_at(energy_function *f, const sample *s, const double *image, double epsilon)
{
    const double *corner[4];
    corners_of(s->dim, image, corner);
    return f(s->dim, s->element, corner, epsilon);
}

static iccp_local dirichlet_at(const sample *s, bool majorise)
{
    const double *corner[4];
    iccp_local local;
    corners_of(s->dim, s->image, corner);
    iccp_dirichlet_local(s->dim, s->element, corner, majorise, &local);
    return local;
}

static iccp_local untangling_at(const sample *s, double epsilon)
{
    const double *corner[4];
    iccp_local local;
    corners_of(s->dim, s->image, corner);
    iccp_untangling_local(s->dim, s->element, corner, epsilon, &local);
    return local;
}

/* Central differences of the energy. */
static void check_gradient(energy_function *f, const sample *s, double epsilon,
                           const iccp_local *local)
{
    double scale = 1, worst = 0;
    for (size_t i = 0; i < s->n; ++i)
        scale = fmax(scale, fabs(local->gradient[i]));
    for (size_t i = 0; i < s->n; ++i) {
        const double h = 1e-6;
        double up[12], down[12];
        memcpy(up, s->image, sizeof up);
        memcpy(down, s->image, sizeof down);
        up[i] += h;
        down[i] -= h;
        const double slope =
            (energy_at(f, s, up, epsilon) - energy_at(f, s, down, epsilon)) / (2 * h);
        worst = fmax(worst, fabs(local->gradient[i] - slope));
    }
    ck_assert_double_le(worst, (s->dim == 2 ? 1e-6 : 1e-5) * scale);
}

static double quadratic(const sample *s, const iccp_local *local, const double *d)
{
    double sum = 0;
    for (size_t r = 0; r < s->n; ++r)
        for (size_t c = 0; c < s->n; ++c)
            sum += d[r] * local->hessian[s->n * r + c] * d[c];
    return sum;
}

static double second_difference(energy_function *f, const sample *s, const double *d,
                                double epsilon)
{
    const double h = 1e-4;
    double up[12], down[12];
    for (size_t i = 0; i < s->n; ++i) {
        up[i] = s->image[i] + h * d[i];
        down[i] = s->image[i] - h * d[i];
    }
    return (energy_at(f, s, up, epsilon) - 2 * energy_at(f, s, s->image, epsilon) +
            energy_at(f, s, down, epsilon)) /
           (h * h);
}

static double trace_of(const sample *s, const iccp_local *local)
{
    double sum = 0;
    for (size_t i = 0; i < s->n; ++i)
        sum += local->hessian[s->n * i + i];
    return sum;
}

/* Symmetric, blind to translations and not negative in any direction. */
static void check_shape(const sample *s, const iccp_local *local, random_source *r)
{
    const double scale = trace_of(s, local);
    double skew = 0, rigid = 0, least = 0;
    ck_assert(isfinite(scale) && scale >= 0);
    for (size_t i = 0; i < s->n; ++i) {
        const double *row = local->hessian + s->n * i;
        for (size_t k = 0; k < s->n; ++k)
            skew = fmax(skew, fabs(row[k] - local->hessian[s->n * k + i]));
        for (size_t axis = 0; axis < s->dim; ++axis) {
            double sum = 0;
            for (size_t k = axis; k < s->n; k += s->dim)
                sum += row[k];
            rigid = fmax(rigid, fabs(sum));
        }
    }
    for (int k = 0; k < 12; ++k) {
        double d[12];
        for (size_t i = 0; i < s->n; ++i)
            d[i] = random_between(r, -1, 1);
        least = fmin(least, quadratic(s, local, d));
    }
    ck_assert_double_le(skew, 1e-12 * scale);
    ck_assert_double_le(rigid, 1e-12 * scale);
    ck_assert_double_ge(least, -1e-12 * scale);
}

/* At least the energy's curvature; the same as that where `exact`. */
static void check_hessian(energy_function *f, const sample *s, double epsilon,
                          const iccp_local *local, bool exact, random_source *r)
{
    const double scale = trace_of(s, local);
    check_shape(s, local, r);
    for (int k = 0; k < 12; ++k) {
        double d[12];
        for (size_t i = 0; i < s->n; ++i)
            d[i] = random_between(r, -1, 1);
        const double bound = quadratic(s, local, d),
                     curvature = second_difference(f, s, d, epsilon);
        ck_assert_double_le(curvature - bound, (s->dim == 2 ? 1e-3 : 2e-3) * scale);
        ck_assert(!exact || fabs(curvature - bound) <= 1e-4 * scale);
    }
}

START_TEST(gradients_and_hessians_of_the_dirichlet_energy)
{
    random_source r = {1};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 4000; ++k) {
            const sample s = random_sample(&r, dim, 1);
            const iccp_local newton = dirichlet_at(&s, false), slim = dirichlet_at(&s, true);
            check_gradient(dirichlet, &s, 1, &newton);
            check_hessian(dirichlet, &s, 1, &newton, false, &r);
            check_shape(&s, &slim, &r);
            ck_assert_mem_eq(newton.gradient, slim.gradient, s.n * sizeof *newton.gradient);
        }
}
END_TEST

/* Images that leave a triangle as it is, stretch it along an axis, turn it by a right angle, and any
 * others. */
static sample batch_sample(random_source *r, size_t kind)
{
    sample s = random_sample(r, 2, 1);
    const double *p = s.point, factor = random_between(r, 0.1, 10);
    for (size_t k = 0; k < 3 && kind < 4; ++k) {
        s.image[2 * k] = kind == 3 ? -p[2 * k + 1] : p[2 * k] * (kind == 1 ? factor : 1);
        s.image[2 * k + 1] = kind == 3 ? p[2 * k] : p[2 * k + 1] * (kind == 2 ? factor : 1);
    }
    return s;
}

START_TEST(triangles_side_by_side_have_the_bits_that_they_have_alone)
{
    enum { KINDS = 6 };
    random_source random = {23};
    for (int repeat = 0; repeat < 3000; ++repeat) {
        sample s[ICCP_DIRICHLET_LANES];
        iccp_dirichlet_batch batch;
        for (size_t l = 0; l < ICCP_DIRICHLET_LANES; ++l) {
            s[l] = batch_sample(&random, (size_t)random_between(&random, 0, KINDS));
            batch.element[l] = s[l].element;
            for (size_t k = 0; k < 3; ++k)
                batch.image[k][l] = s[l].image + 2 * k;
        }
        for (iccp_simd_level level = ICCP_SIMD_NONE; level <= iccp_simd(); ++level)
            for (int majorise = 0; majorise < 2; ++majorise) {
                iccp_local local[ICCP_DIRICHLET_LANES];
                iccp_dirichlet_locals(level, &batch, majorise, local);
                for (size_t l = 0; l < ICCP_DIRICHLET_LANES; ++l) {
                    const iccp_local alone = dirichlet_at(&s[l], majorise);
                    ck_assert_mem_eq(local[l].gradient, alone.gradient, 6 * sizeof(double));
                    ck_assert_mem_eq(local[l].hessian, alone.hessian, 36 * sizeof(double));
                }
            }
    }
}
END_TEST

START_TEST(gradients_and_hessians_of_the_untangling_energy)
{
    random_source r = {4};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 6000; ++k) {
            const sample s = random_sample(&r, dim, k % 3 - 1);
            const double epsilon = k % 2 ? 1 : dim == 2 ? 0.2 : 0.3;
            ck_assert(isfinite(energy_at(iccp_untangling_energy, &s, s.image, epsilon)));
            const iccp_local local = untangling_at(&s, epsilon);
            check_gradient(iccp_untangling_energy, &s, epsilon, &local);
            check_hessian(iccp_untangling_energy, &s, epsilon, &local, false, &r);
        }
}
END_TEST

/* The simplex itself, turned by an angle round one axis after its coordinates have been swapped
 * round, and moved. */
static void move_rigidly(sample *s, const double *from, double angle)
{
    const double c = cos(angle), w = sin(angle);
    for (size_t i = 0; i <= s->dim; ++i) {
        const double *p = from + s->dim * i;
        const double x = p[s->dim - 2], y = p[s->dim - 1];
        double *to = s->image + s->dim * i;
        to[0] = c * x - w * y + 1;
        to[1] = w * x + c * y - 2;
        if (s->dim == 3)
            to[2] = p[0];
    }
}

/* There no curvature is negative, and the Hessians are the energies' own. */
START_TEST(isometries)
{
    random_source r = {2};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 1000; ++k) {
            sample s = random_sample(&r, dim, 0);
            move_rigidly(&s, s.point, random_between(&r, 0, 6.28));
            const iccp_local newton = dirichlet_at(&s, false), slim = dirichlet_at(&s, true);
            const iccp_local untangling = untangling_at(&s, 1e-9);
            const double measure = s.element[0], energy = 2 * (double)dim * measure;
            ck_assert_double_eq_tol(energy_at(dirichlet, &s, s.image, 1), energy, 1e-11 * energy);
            ck_assert_double_eq_tol(energy_at(iccp_untangling_energy, &s, s.image, 1e-9), measure,
                                    1e-12);
            for (size_t i = 0; i < s.n; ++i)
                ck_assert(fabs(newton.gradient[i]) < 1e-10 && fabs(slim.gradient[i]) < 1e-10 &&
                          fabs(untangling.gradient[i]) < 1e-10);
            check_hessian(dirichlet, &s, 1, &newton, true, &r);
            check_hessian(iccp_untangling_energy, &s, 1e-9, &untangling, true, &r);
        }
}
END_TEST

/* Of the tetrahedron with the corners 0 and the unit vectors, whose image's last three corners are
 * turned by the identity or any rotation: a motion of these is J's, row by row. */
static double curvature_along(const sample *s, const iccp_local *local, const double *by_j)
{
    double d[12] = {0}, size = 0;
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) {
            d[3 * (c + 1) + r] = by_j[3 * r + c];
            size += by_j[3 * r + c] * by_j[3 * r + c];
        }
    return quadratic(s, local, d) / (s->element[0] * size);
}

/* At a rotation R, the curvature is 8 along R S with S symmetric, and 0 along R S with S skew. At
 * R diag(a, b, c), it is 2 + 6 / a^4 along R diag(1, 0, 0), and what flips and twists have along
 * two others. */
START_TEST(eigenvalues)
{
    random_source r = {8};
    sample s = {.dim = 3, .n = 12};
    for (size_t k = 0; k < 3; ++k)
        s.point[3 * (k + 1) + k] = 1;
    set_element(&s);
    for (int k = 0; k < 300; ++k) {
        sample turned = s;
        double rotation[9], stretch[3], along[9];
        move_rigidly(&turned, s.point, random_between(&r, 0, 6.28));
        for (size_t i = 0; i < 9; ++i) /* the images of the unit vectors are its columns */
            rotation[i] = turned.image[3 * (i % 3 + 1) + i / 3] - turned.image[i / 3];
        for (size_t i = 0; i < 3; ++i)
            stretch[i] = k < 100 ? 1 : random_between(&r, 0.2, 3);
        for (size_t i = 0; i < 12; ++i)
            s.image[i] = i < 3 ? 0 : stretch[i / 3 - 1] * rotation[3 * (i % 3) + i / 3 - 1];
        const iccp_local local = dirichlet_at(&s, false);
        for (size_t i = 0; i < 3; ++i)
            for (size_t j = 0; j <= i; ++j)
                for (int sign = -1; sign <= 1; sign += 2) {
                    if (i == j && sign < 0)
                        continue;
                    for (size_t row = 0; row < 3; ++row)
                        for (size_t c = 0; c < 3; ++c)
                            along[3 * row + c] =
                                (c == j ? rotation[3 * row + i] : 0) +
                                (c == i && i != j ? sign * rotation[3 * row + j] : 0);
                    const double a = stretch[i], b = stretch[j], p = a * b;
                    const double wanted =
                        i == j ? 2 + 6 / (a * a * a * a)
                               : 2 + 2 * sign * (a * a + sign * p + b * b) / (p * p * p);
                    ck_assert_double_eq_tol(curvature_along(&s, &local, along), fmax(wanted, 0),
                                            1e-9 * (1 + fabs(wanted)));
                }
    }
}
END_TEST

/* Values that can be found by hand: J = diag(a, b, c). */
START_TEST(energies_of_stretches)
{
    for (size_t dim = 2; dim <= 3; ++dim) {
        sample s = {.dim = dim, .n = dim * (dim + 1)};
        for (size_t k = 0; k < dim; ++k)
            s.point[dim * (k + 1) + k] = (double)k + 2;
        set_element(&s);
        ck_assert_double_eq(s.element[0], dim == 2 ? 3 : 4);
        for (double a = 1e-3; a < 2e3; a *= 3)
            for (double b = 1e-3; b < 2e3; b *= 3) {
                const double factor[3] = {a, b, 0.5};
                const double *corner[4];
                double j[9], wanted = 0, worst = 0;
                for (size_t i = 0; i < s.n; ++i)
                    s.image[i] = 5 + factor[i % dim] * s.point[i];
                corners_of(dim, s.image, corner);
                const double det = iccp_element_jacobian(dim, s.element, corner, j);
                ck_assert_double_eq_tol(det / (a * b * (dim == 2 ? 1 : 0.5)), 1, 1e-11);
                for (size_t i = 0; i < dim * dim; ++i)
                    worst = fmax(worst, fabs(j[i] - (i % (dim + 1) == 0 ? factor[i / dim] : 0)));
                ck_assert_double_le(worst, 1e-14 * (5 + a + b));
                for (size_t k = 0; k < dim; ++k)
                    wanted += s.element[0] * (factor[k] * factor[k] + 1 / (factor[k] * factor[k]));
                ck_assert_double_eq_tol(energy_at(dirichlet, &s, s.image, 0) / wanted, 1, 1e-9);
            }
        s.image[s.n - 1] = 0; /* turned over, then flat */
        ck_assert(isinf(energy_at(dirichlet, &s, s.image, 0)));
        s.image[s.n - 1] = 5;
        ck_assert(isinf(energy_at(dirichlet, &s, s.image, 0)));
    }
}
END_TEST

/* Energies do not change when the image is turned and moved. */
START_TEST(energies_are_those_of_shape)
{
    random_source r = {3};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 1000; ++k) {
            const sample s = random_sample(&r, dim, 0);
            sample turned = s;
            move_rigidly(&turned, s.image, random_between(&r, 0, 6.28));
            const double u = energy_at(iccp_untangling_energy, &s, s.image, 0.1);
            ck_assert_double_eq_tol(energy_at(iccp_untangling_energy, &s, turned.image, 0.1) / u, 1,
                                    1e-11);
            const double d = energy_at(dirichlet, &s, s.image, 0);
            if (d < 1e3)
                ck_assert_double_eq_tol(energy_at(dirichlet, &s, turned.image, 0) / d, 1, 1e-10);
        }
}
END_TEST

/* A simplex that is exactly positive, and in which doubles find no area or volume: its last corner is
 * rounded from a point of the line or plane through the others. */
static void set_flat_sample(sample *s, random_source *r)
{
    const iccp_simplicial_map map = {.dim = s->dim,
                                     .corners = (const uint32_t[4]){0, 1, 2, 3},
                                     .points = s->point,
                                     .images = s->point};
    const size_t dim = s->dim;
    do {
        double share[3], rest = 1;
        for (size_t k = 1; k < dim; rest -= share[k++])
            share[k] = random_between(r, 0.1, 0.4);
        for (size_t i = 0; i < dim * dim; ++i)
            s->point[i] = random_between(r, -1, 1);
        for (size_t d = 0; d < dim; ++d) {
            double sum = rest * s->point[d];
            for (size_t k = 1; k < dim; ++k)
                sum += share[k] * s->point[dim * k + d];
            s->point[dim * dim + d] = sum;
        }
        set_element(s);
    } while (!iccp_simplicial_is_positive(&map, 0) || s->element[0] > 0);
}

/* Of powers of two along the axes, which round nothing; flat simplices before and after the map, and
 * as good ones after it. */
START_TEST(flat_simplices_have_accurate_energies)
{
    static const double FACTOR[3] = {2, 0.5, 4};
    random_source r = {7};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 300; ++k) {
            sample s = {.dim = dim, .n = dim * (dim + 1)};
            double wanted = 0, j[9];
            set_flat_sample(&s, &r);
            for (size_t i = 0; i < s.n; ++i)
                s.image[i] = FACTOR[i % dim] * s.point[i];
            for (size_t d = 0; d < dim; ++d)
                wanted += FACTOR[d] * FACTOR[d] + 1 / (FACTOR[d] * FACTOR[d]);
            iccp_simplicial_map map = {.dim = dim,
                                       .n_points = dim + 1,
                                       .n_simplices = 1,
                                       .corners = (const uint32_t[4]){0, 1, 2, 3},
                                       .points = s.point,
                                       .images = s.image,
                                       .stretch = 1};
            ck_assert_double_eq_tol(iccp_simplicial_energy(&map) / wanted, 1, 1e-14);
            for (int inverse = 0; inverse < 2; ++inverse) {
                iccp_simplicial_jacobian(&map, inverse, 0, j);
                for (size_t i = 0; i < dim * dim; ++i) {
                    const double f = inverse ? 1 / FACTOR[i / dim] : FACTOR[i / dim];
                    ck_assert_double_eq_tol(j[i], i % (dim + 1) == 0 ? f : 0, 1e-14);
                }
            }
            map.images = s.point;
            map.stretch = random_between(&r, 0.5, 2);
            wanted = (double)dim * (map.stretch * map.stretch + 1 / (map.stretch * map.stretch));
            ck_assert_double_eq_tol(iccp_simplicial_energy(&map) / wanted, 1, 1e-13);
            iccp_simplicial_element(&map, 0, s.element);
            ck_assert(s.element[0] > 0);
            sample good = random_sample(&r, dim, 1);
            map.images = good.image;
            const double there = iccp_simplicial_energy(&map);
            ck_assert(there > 1e24 && there < HUGE_VAL);
        }
}
END_TEST

/* Images on a hyperplane, on a line, in a point; turned over; and as good as these. */
START_TEST(degenerate_images)
{
    random_source r = {3};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 400; ++k) {
            sample s = random_sample(&r, dim, 0);
            const double flat[] = {0, 1e-8, 1e-16}, thin = flat[k % 3];
            for (size_t i = 0; i < s.n; ++i)
                if (i % dim < (size_t)(k / 3) % (dim + 1))
                    s.image[i] = 0.3 + thin * s.image[i];
            const iccp_local local = untangling_at(&s, 0.1);
            check_gradient(iccp_untangling_energy, &s, 0.1, &local);
            check_hessian(iccp_untangling_energy, &s, 0.1, &local, false, &r);
        }
}
END_TEST

/* Finite however small epsilon is, and with all corners in one point. */
START_TEST(untangling_is_finite)
{
    for (size_t dim = 2; dim <= 3; ++dim) {
        sample s = {.dim = dim, .n = dim * (dim + 1)};
        for (size_t k = 0; k < dim; ++k)
            s.point[dim * (k + 1) + k] = (double)k + 2;
        set_element(&s);
        for (int kind = 0; kind < 5; ++kind)
            for (double epsilon = 1; epsilon > 1e-11; epsilon /= 10) {
                for (size_t i = 0; i < s.n; ++i) {
                    const double p = s.point[i], last = i + 1 == s.n ? -1 : 1;
                    s.image[i] = kind == 0   ? p
                                 : kind == 1 ? last * p
                                 : kind == 2 ? (double)(i / dim)
                                 : kind == 3 ? 1
                                             : 500 * last * p;
                }
                const iccp_local local = untangling_at(&s, epsilon);
                bool fault = !isfinite(energy_at(iccp_untangling_energy, &s, s.image, epsilon));
                for (size_t i = 0; i < s.n; ++i)
                    fault |= !isfinite(local.gradient[i]) || !(local.hessian[(s.n + 1) * i] >= 0);
                for (size_t i = 0; i < s.n * s.n; ++i)
                    fault |= !isfinite(local.hessian[i]);
                ck_assert(!fault);
            }
    }
}
END_TEST

/* Rotations u and v, and J again. */
START_TEST(singular_values_and_vectors)
{
    random_source r = {6};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 4000; ++k) {
            const sample s = random_sample(&r, dim, dim == 2 ? 1 : 0);
            const double *corner[4];
            double j[9], worst = 0, size = 0;
            iccp_singular parts;
            corners_of(dim, s.image, corner);
            (void)iccp_element_jacobian(dim, s.element, corner, j);
            iccp_singular_find(dim, j, &parts);
            for (size_t a = 0; a < dim; ++a)
                for (size_t b = 0; b < dim; ++b) {
                    double sum = 0, uu = 0, vv = 0;
                    for (size_t i = 0; i < dim; ++i) {
                        sum += parts.sigma[i] * parts.u[i][a] * parts.v[i][b];
                        uu += parts.u[a][i] * parts.u[b][i];
                        vv += parts.v[a][i] * parts.v[b][i];
                    }
                    size = fmax(size, fabs(j[dim * a + b]));
                    worst = fmax(worst, fabs(sum - j[dim * a + b]));
                    ck_assert(fabs(uu - (a == b)) < 1e-12 && fabs(vv - (a == b)) < 1e-12);
                }
            ck_assert_double_le(worst, 1e-11 * size);
            for (size_t a = 0; a + 1 < dim; ++a)
                ck_assert_double_ge(parts.sigma[a] * (1 + 1e-9), fabs(parts.sigma[a + 1]));
        }
}
END_TEST

/* chi is positive, rises, tends to det and to 0, and its two forms meet: chi(d) chi(-d) = eps^2
 * / 4. */
START_TEST(chi_stands_for_the_determinant)
{
    for (double epsilon = 1; epsilon > 1e-11; epsilon /= 10) {
        double last = 0;
        for (double d = -1e3; d < 1e3; d += 0.7) {
            const double chi = iccp_untangling_chi(epsilon, d);
            ck_assert_double_gt(chi, last);
            ck_assert_double_ge(chi, d);
            ck_assert_double_eq_tol(
                chi * iccp_untangling_chi(epsilon, -d) / (epsilon * epsilon / 4), 1, 1e-12);
            last = chi;
        }
        ck_assert_double_eq_tol(iccp_untangling_chi(epsilon, 0), epsilon / 2, 1e-15);
        ck_assert_double_eq_tol(iccp_untangling_chi(epsilon, 1e6), 1e6, 1e-6);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("distortion");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, gradients_and_hessians_of_the_dirichlet_energy);
    tcase_add_test(tests, triangles_side_by_side_have_the_bits_that_they_have_alone);
    tcase_add_test(tests, gradients_and_hessians_of_the_untangling_energy);
    tcase_add_test(tests, isometries);
    tcase_add_test(tests, eigenvalues);
    tcase_add_test(tests, energies_of_stretches);
    tcase_add_test(tests, energies_are_those_of_shape);
    tcase_add_test(tests, flat_simplices_have_accurate_energies);
    tcase_add_test(tests, degenerate_images);
    tcase_add_test(tests, untangling_is_finite);
    tcase_add_test(tests, singular_values_and_vectors);
    tcase_add_test(tests, chi_stands_for_the_determinant);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
