/* Energies of one triangle: their values, gradients and Hessians. */
#include "map/distortion.h"

#include "../../random.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct sample {
    iccp_element element;
    double image[6];
} sample;

static void corners_of(const double image[6], const double *corner[3])
{
    for (int k = 0; k < 3; ++k)
        corner[k] = image + 2 * k;
}

/* A triangle that is not too flat; its image has the wanted sign: +1, -1, or 0 for any. */
static sample random_sample(random_source *r, int sign)
{
    sample s;
    double p[6], twice = 0;
    while (twice < 0.1) {
        for (int i = 0; i < 6; ++i)
            p[i] = random_between(r, -1, 1);
        twice = (p[2] - p[0]) * (p[5] - p[1]) - (p[3] - p[1]) * (p[4] - p[0]);
    }
    iccp_element_create(&s.element, p, p + 2, p + 4);
    ck_assert_double_eq_tol(s.element.area, twice / 2, 1e-15);
    do {
        for (int i = 0; i < 6; ++i)
            s.image[i] = random_between(r, -1, 1);
        twice = (s.image[2] - s.image[0]) * (s.image[5] - s.image[1]) -
                (s.image[3] - s.image[1]) * (s.image[4] - s.image[0]);
    } while (sign != 0 && !(sign * twice > 0.05));
    return s;
}

typedef double energy_function(const iccp_element *e, const double *const image[3], double epsilon);

static double dirichlet(const iccp_element *e, const double *const image[3], double epsilon)
{
    (void)epsilon;
    return iccp_dirichlet_energy(e, image);
}

static double energy_at(energy_function *f, const sample *s, const double image[6], double epsilon)
{
    const double *corner[3];
    corners_of(image, corner);
    return f(&s->element, corner, epsilon);
}

/* Central differences of the energy. */
static void check_gradient(energy_function *f, const sample *s, double epsilon, const iccp_local *local,
                           double tolerance)
{
    double scale = 1, worst = 0;
    for (int i = 0; i < 6; ++i)
        scale = fmax(scale, fabs(local->gradient[i]));
    for (int i = 0; i < 6; ++i) {
        const double h = 1e-6;
        double up[6], down[6];
        memcpy(up, s->image, sizeof up);
        memcpy(down, s->image, sizeof down);
        up[i] += h;
        down[i] -= h;
        const double slope = (energy_at(f, s, up, epsilon) - energy_at(f, s, down, epsilon)) / (2 * h);
        worst = fmax(worst, fabs(local->gradient[i] - slope));
    }
    ck_assert_double_le(worst, tolerance * scale);
}

static double quadratic(const iccp_local *local, const double d[6])
{
    double sum = 0;
    for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c)
            sum += d[r] * local->hessian[r][c] * d[c];
    return sum;
}

static double second_difference(energy_function *f, const sample *s, const double d[6], double epsilon)
{
    const double h = 1e-4;
    double up[6], down[6];
    for (int i = 0; i < 6; ++i) {
        up[i] = s->image[i] + h * d[i];
        down[i] = s->image[i] - h * d[i];
    }
    return (energy_at(f, s, up, epsilon) - 2 * energy_at(f, s, s->image, epsilon) +
            energy_at(f, s, down, epsilon)) / (h * h);
}

/* The Hessian is symmetric, does not see translations, is not negative in any direction and at least
 * the energy's curvature. */
static void check_hessian(energy_function *f, const sample *s, double epsilon, const iccp_local *local,
                          random_source *r)
{
    double scale = 0, skew = 0, rigid = 0, least = 0, excess = 0;
    for (int i = 0; i < 6; ++i)
        scale += local->hessian[i][i];
    for (int i = 0; i < 6; ++i) {
        const double *row = local->hessian[i];
        for (int k = 0; k < 6; ++k)
            skew = fmax(skew, fabs(row[k] - local->hessian[k][i]));
        for (int axis = 0; axis < 2; ++axis)
            rigid = fmax(rigid, fabs(row[axis] + row[2 + axis] + row[4 + axis]));
    }
    for (int k = 0; k < 12; ++k) {
        double d[6];
        for (int i = 0; i < 6; ++i)
            d[i] = random_between(r, -1, 1);
        const double bound = quadratic(local, d);
        least = fmin(least, bound);
        excess = fmax(excess, second_difference(f, s, d, epsilon) - bound);
    }
    ck_assert_double_le(skew, 1e-12 * scale);
    ck_assert_double_le(rigid, 1e-12 * scale);
    ck_assert_double_ge(least, -1e-12 * scale);
    ck_assert_double_le(excess, 1e-3 * scale);
}

START_TEST(gradients_and_hessians_of_the_dirichlet_energy)
{
    random_source r = {1};
    for (int k = 0; k < 4000; ++k) {
        const sample s = random_sample(&r, 1);
        const double *corner[3];
        iccp_local newton, slim;
        corners_of(s.image, corner);
        iccp_dirichlet_local(&s.element, corner, false, &newton);
        iccp_dirichlet_local(&s.element, corner, true, &slim);
        check_gradient(dirichlet, &s, 1, &newton, 1e-6);
        check_hessian(dirichlet, &s, 1, &newton, &r);
        ck_assert_mem_eq(newton.gradient, slim.gradient, sizeof newton.gradient);
        double d[6], scale = 0;
        for (int i = 0; i < 6; ++i) {
            d[i] = random_between(&r, -1, 1);
            scale += slim.hessian[i][i];
        }
        ck_assert_double_ge(quadratic(&slim, d), -1e-12 * scale);
    }
}
END_TEST

/* Where no curvature is negative, which near an isometry is so, the Hessian is the energy's own. */
START_TEST(the_hessian_is_exact_near_an_isometry)
{
    random_source r = {2};
    for (int k = 0; k < 1000; ++k) {
        sample s = random_sample(&r, 1);
        const double angle = random_between(&r, 0, 6.28), c = cos(angle), t = sin(angle);
        double p[6], d[6];
        /* The triangle itself, from its gradients: corner 0 at the origin. */
        const double *g = s.element.gradient[1], *h = s.element.gradient[2];
        const double det = g[0] * h[1] - g[1] * h[0];
        const double q[6] = {0, 0, h[1] / det, -h[0] / det, -g[1] / det, g[0] / det};
        for (int i = 0; i < 3; ++i) {
            p[2 * i] = c * q[2 * i] - t * q[2 * i + 1] + 0.3;
            p[2 * i + 1] = t * q[2 * i] + c * q[2 * i + 1] - 0.7;
        }
        memcpy(s.image, p, sizeof p);
        const double *corner[3];
        iccp_local local;
        corners_of(s.image, corner);
        ck_assert_double_eq_tol(iccp_dirichlet_energy(&s.element, corner), 4 * s.element.area,
                                1e-11 * s.element.area);
        iccp_dirichlet_local(&s.element, corner, false, &local);
        double scale = 0;
        for (int i = 0; i < 6; ++i) {
            ck_assert_double_eq_tol(local.gradient[i], 0, 1e-11);
            d[i] = random_between(&r, -1, 1);
            scale += local.hessian[i][i];
        }
        ck_assert_double_eq_tol(second_difference(dirichlet, &s, d, 1), quadratic(&local, d),
                                1e-4 * scale);
    }
}
END_TEST

/* Values that can be told by hand: J = diag(a, b). */
START_TEST(energies_of_stretches)
{
    const double p[6] = {0, 0, 2, 0, 0, 3};
    iccp_element e;
    iccp_element_create(&e, p, p + 2, p + 4);
    for (double a = 1e-3; a < 2e3; a *= 3)
        for (double b = 1e-3; b < 2e3; b *= 3) {
            const double image[6] = {5, 7, 5 + 2 * a, 7, 5, 7 + 3 * b};
            const double *corner[3];
            double j[4];
            corners_of(image, corner);
            iccp_element_jacobian(&e, corner, j);
            ck_assert_double_eq_tol(j[0], a, 1e-15 * 10);
            ck_assert_double_eq_tol(j[3], b, 1e-12);
            ck_assert_double_eq_tol(fabs(j[1]) + fabs(j[2]), 0, 1e-14 * (a + b));
            const double wanted = 3 * (a * a + b * b + 1 / (a * a) + 1 / (b * b));
            ck_assert_double_eq_tol(iccp_dirichlet_energy(&e, corner) / wanted, 1, 1e-9);
        }
    const double flipped[6] = {0, 0, 2, 0, 0, -3}, flat[6] = {0, 0, 2, 0, 4, 0};
    const double *corner[3];
    corners_of(flipped, corner);
    ck_assert(isinf(iccp_dirichlet_energy(&e, corner)));
    corners_of(flat, corner);
    ck_assert(isinf(iccp_dirichlet_energy(&e, corner)));
}
END_TEST

/* Energies do not change when the image is turned and moved. */
START_TEST(energies_are_those_of_shape)
{
    random_source r = {3};
    for (int k = 0; k < 1000; ++k) {
        const sample s = random_sample(&r, 0);
        const double a = random_between(&r, 0, 6.28), x = random_between(&r, -2, 2);
        double turned[6];
        for (int i = 0; i < 3; ++i) {
            turned[2 * i] = cos(a) * s.image[2 * i] - sin(a) * s.image[2 * i + 1] + x;
            turned[2 * i + 1] = sin(a) * s.image[2 * i] + cos(a) * s.image[2 * i + 1] - x;
        }
        const double u = energy_at(iccp_untangle_energy, &s, s.image, 0.1);
        ck_assert_double_eq_tol(energy_at(iccp_untangle_energy, &s, turned, 0.1) / u, 1, 1e-11);
        const double d = energy_at(dirichlet, &s, s.image, 0);
        if (d < 1e3)
            ck_assert_double_eq_tol(energy_at(dirichlet, &s, turned, 0) / d, 1, 1e-10);
    }
}
END_TEST

START_TEST(untangling_is_smooth_for_inverted_triangles_too)
{
    random_source r = {4};
    for (int k = 0; k < 6000; ++k) {
        const sample s = random_sample(&r, k % 3 - 1);
        const double epsilon = k % 2 ? 1 : 0.2;
        const double *corner[3];
        iccp_local local;
        corners_of(s.image, corner);
        ck_assert(isfinite(iccp_untangle_energy(&s.element, corner, epsilon)));
        iccp_untangle_local(&s.element, corner, epsilon, &local);
        check_gradient(iccp_untangle_energy, &s, epsilon, &local, 1e-6);
        double scale = 0;
        for (int i = 0; i < 6; ++i)
            scale += local.hessian[i][i];
        ck_assert(isfinite(scale) && scale >= 0);
        if (epsilon >= 1)
            check_hessian(iccp_untangle_energy, &s, epsilon, &local, &r);
    }
}
END_TEST

/* Finite however small epsilon is, and with all corners in one point. */
START_TEST(untangling_is_finite)
{
    const double p[6] = {0, 0, 2, 0, 0, 3};
    const double images[][6] = {{0, 0, 2, 0, 0, 3}, {0, 0, 2, 0, 0, -3}, {0, 0, 1, 1, 2, 2},
                                {1, 1, 1, 1, 1, 1}, {0, 0, 1e3, 0, 0, -1e3}};
    iccp_element e;
    iccp_element_create(&e, p, p + 2, p + 4);
    for (size_t k = 0; k < sizeof images / sizeof *images; ++k)
        for (double epsilon = 1; epsilon > 1e-11; epsilon /= 10) {
            const double *corner[3];
            iccp_local local;
            corners_of(images[k], corner);
            ck_assert(isfinite(iccp_untangle_energy(&e, corner, epsilon)));
            iccp_untangle_local(&e, corner, epsilon, &local);
            bool fault = false;
            for (int i = 0; i < 6; ++i) {
                fault |= !isfinite(local.gradient[i]) || !(local.hessian[i][i] >= 0);
                for (int j = 0; j < 6; ++j)
                    fault |= !isfinite(local.hessian[i][j]);
            }
            ck_assert(!fault);
        }
}
END_TEST

/* chi is positive, rises, tends to det and to 0, and its two forms meet: chi(d) chi(-d) = eps^2 / 4. */
START_TEST(chi_stands_for_the_determinant)
{
    for (double epsilon = 1; epsilon > 1e-11; epsilon /= 10) {
        double last = 0;
        for (double d = -1e3; d < 1e3; d += 0.7) {
            const double chi = iccp_untangle_chi(epsilon, d);
            ck_assert_double_gt(chi, last);
            ck_assert_double_ge(chi, d);
            ck_assert_double_eq_tol(chi * iccp_untangle_chi(epsilon, -d) / (epsilon * epsilon / 4), 1,
                                    1e-12);
            last = chi;
        }
        ck_assert_double_eq_tol(iccp_untangle_chi(epsilon, 0), epsilon / 2, 1e-15);
        ck_assert_double_eq_tol(iccp_untangle_chi(epsilon, 1e6), 1e6, 1e-6);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("distortion");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, gradients_and_hessians_of_the_dirichlet_energy);
    tcase_add_test(tests, the_hessian_is_exact_near_an_isometry);
    tcase_add_test(tests, energies_of_stretches);
    tcase_add_test(tests, energies_are_those_of_shape);
    tcase_add_test(tests, untangling_is_smooth_for_inverted_triangles_too);
    tcase_add_test(tests, untangling_is_finite);
    tcase_add_test(tests, chi_stands_for_the_determinant);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
