/* Moves along a step by a line search that stops before a simplex flips: J. Smith, S. Schaefer,
 * Bijective parameterization with free boundaries, 2015; J. Nocedal, S. Wright, Numerical
 * Optimization, section 3.1. */
#include "base/minmax.h"
#include "map/energy/newton_parts.h"

#include <math.h>
#include <string.h>

/* Longest step, as a share of the way to the first flip. */
static const double SHARE_OF_FLIP = 0.9;

/* DECREASE: sufficient decrease (Armijo). SHORTER: factor by which a step is shortened, at most
 * MAX_CUTS times. Steps in space are shortened less, because the way to the first flip is not known
 * there. */
static const double DECREASE = 1e-4, SHORTER = 0.5, SHORTER_IN_SPACE = 0.7;
enum { MAX_CUTS = 40, MAX_CUTS_IN_SPACE = 60 };

/* In space: the share of a motion that is tried first, and the factor by which it is shortened. */
static const double FARTHEST = 2, CLOSER = 0.9;

/* A longer step is tried if the first one lowers the energy a lot. In space that is this share of
 * the energy. In the plane it is this multiple of the fall that the model predicts for a step of 1.
 * The model is too stiff where negative curvature is left out. */
static const double LARGE_FALL = 0.3, BETTER = 1.5;

/* The smallest positive root of det(t) = a + b t + c t^2, where a > 0, or `least` if that is
 * smaller. No root is computed if the changes up to `least` are at most half of a. Then the roots
 * are larger by far, whatever rounding does. */
static double first_root(double a, double b, double c, double least)
{
    if (a > 2 * least * (fabs(b) + fabs(c) * least))
        return least;
    if (fabs(c) <= 1e-300)
        return iccp_min(least, b < 0 ? -a / b : HUGE_VAL);
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return least;
    const double q = -0.5 * (b + copysign(sqrt(discriminant), b));
    const double r0 = q / c, r1 = fabs(q) > 0 ? a / q : HUGE_VAL;
    const double low = iccp_min(r0, r1), high = iccp_max(r0, r1);
    return iccp_min(least, low > 0 ? low : high > 0 ? high : HUGE_VAL);
}

/* How far corners can move along d before their triangle loses its area, or `least` if that is
 * smaller. */
static double flip_along(const double *const p[3], const double d[3][2], double least)
{
    const double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1];
    const double vx = p[2][0] - p[0][0], vy = p[2][1] - p[0][1];
    const double dux = d[1][0] - d[0][0], duy = d[1][1] - d[0][1];
    const double dvx = d[2][0] - d[0][0], dvy = d[2][1] - d[0][1];
    return first_root(ux * vy - uy * vx, ux * dvy + dux * vy - uy * dvx - duy * vx,
                      dux * dvy - duy * dvx, least);
}

static double flip_of(const iccp_newton *s, size_t e, double least)
{
    const uint32_t *v = s->map.corners + 3 * (size_t)s->assembly.simplex[e];
    const double *p[3];
    double d[3][2] = {{0}};
    (void)iccp_newton_images(2, s, e, p);
    for (size_t k = 0; k < 3; ++k)
        if (s->assembly.slot[v[k]] != UINT32_MAX)
            memcpy(d[k], s->step + 2 * (size_t)s->assembly.slot[v[k]], sizeof d[k]);
    return flip_along(p, (const double(*)[2])d, least);
}

/* Returns true if a tetrahedron p that moves along d keeps a positive volume up to the share t of
 * the way. The volume is a cubic in t. It is positive if its Bernstein coefficients are. */
static bool keeps_volume(const double *const p[4], const double *const d[4], double t)
{
    double edge[2][9], cofactor[2][9], b[4] = {0};
    for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < 3; ++k) {
            edge[0][3 * i + k] = p[i + 1][k] - p[0][k];
            edge[1][3 * i + k] = t * (d[i + 1][k] - d[0][k]);
        }
    iccp_cofactors(3, edge[0], cofactor[0]);
    iccp_cofactors(3, edge[1], cofactor[1]);
    for (size_t i = 0; i < 9; ++i) {
        b[0] += edge[0][i] * cofactor[0][i] / 3;
        b[1] += edge[1][i] * cofactor[0][i];
        b[2] += edge[0][i] * cofactor[1][i];
        b[3] += edge[1][i] * cofactor[1][i] / 3;
    }
    return b[0] + b[1] / 3 > 0 && b[0] + (2 * b[1] + b[2]) / 3 > 0 && b[0] + b[1] + b[2] + b[3] > 0;
}

static double limit_in_space(const iccp_simplicial_map *map, const double *motion)
{
    double limit = FARTHEST;
    for (size_t t = 0; t < map->n_simplices; ++t) {
        const double *p[4], *d[4];
        iccp_simplicial_images(3, map, t, p);
        for (size_t k = 0; k < 4; ++k)
            d[k] = motion + 3 * (size_t)map->corners[4 * t + k];
        for (int k = 0; k < MAX_CUTS && !keeps_volume(p, d, limit); ++k)
            limit *= CLOSER;
    }
    return limit;
}

double iccp_newton_limit(const iccp_simplicial_map *map, const double *motion)
{
    double least = HUGE_VAL;
    if (map->dim == 3)
        return limit_in_space(map, motion);
    for (size_t t = 0; t < map->n_simplices; ++t) {
        const double *p[3];
        double d[3][2];
        iccp_simplicial_images(2, map, t, p);
        for (size_t k = 0; k < 3; ++k)
            memcpy(d[k], motion + 2 * (size_t)map->corners[3 * t + k], sizeof d[k]);
        least = flip_along(p, (const double(*)[2])d, least);
    }
    return least;
}

typedef struct limit {
    const iccp_newton *s;
    _Atomic double least;
} limit;

static icc_status find_flips(void *argument, size_t begin, size_t end)
{
    limit *l = argument;
    double least = atomic_load(&l->least), own = least;
    for (size_t e = begin; e < end; ++e)
        own = flip_of(l->s, e, own);
    while (own < least && !atomic_compare_exchange_weak(&l->least, &least, own))
        continue;
    return ICC_OK;
}

/* How far the step can go before the first triangle loses its area. The area is quadratic along the
 * step. */
static double flip_limit(const iccp_newton *s)
{
    limit l = {s, HUGE_VAL};
    iccp_newton_run(s, s->assembly.n_elements, ICCP_NEWTON_GRAIN, find_flips, &l);
    return atomic_load(&l.least);
}

static void set_images(iccp_newton *s, double length, bool rounded)
{
    const size_t dim = s->map.dim;
    for (size_t i = 0; i < s->assembly.n_free; ++i) {
        double *image = s->map.images + dim * s->assembly.free_point[i];
        for (size_t d = 0; d < dim; ++d)
            image[d] = s->saved[dim * i + d] + length * s->step[dim * i + d];
        if (rounded)
            iccp_simplicial_round(dim, image);
    }
}

typedef struct verdict {
    const iccp_newton *s;
    atomic_bool is_positive;
} verdict;

static icc_status find_signs(void *argument, size_t begin, size_t end)
{
    verdict *v = argument;
    for (size_t e = begin; e < end && atomic_load(&v->is_positive); ++e)
        if (!iccp_simplicial_is_positive(&v->s->map, v->s->assembly.simplex[e]))
            atomic_store(&v->is_positive, false);
    return ICC_OK;
}

static bool all_positive(const iccp_newton *s)
{
    verdict v = {s, true};
    iccp_newton_run(s, s->assembly.n_elements, ICCP_NEWTON_GRAIN, find_signs, &v);
    return atomic_load(&v.is_positive);
}

/* Doubles the length, up to `most`, as long as the energy falls. In space a nearly flat simplex
 * has an energy of about 1 / sigma^2. There a single Newton step increases sigma only by about a
 * third. */
static double go_on(iccp_newton *s, iccp_energy energy, double before, double length, double most)
{
    const bool in_space = s->map.dim == 3;
    double after = before;
    do {
        before = after;
        length *= 2;
        set_images(s, length, in_space);
        after = length < most ? iccp_newton_energy(s, energy, 0) : HUGE_VAL;
    } while (after < before && all_positive(s));
    set_images(s, length / 2, in_space);
    return before;
}

/* In space the first step of 1 is not limited beforehand. Only the energy prevents flips there,
 * because it is infinite for inverted simplices. */
double iccp_newton_move(iccp_newton *newton, iccp_energy energy, double epsilon, double before,
                        double slope)
{
    iccp_newton *s = newton;
    const size_t dim = s->map.dim;
    const bool guarded = energy != ICCP_UNTANGLE, in_space = guarded && dim == 3;
    const double shorter = in_space ? SHORTER_IN_SPACE : SHORTER;
    const int n_tries = in_space ? MAX_CUTS_IN_SPACE : MAX_CUTS;
    const double most = guarded && dim == 2 ? SHARE_OF_FLIP * flip_limit(s) : HUGE_VAL;
    const double low = in_space ? (1 - LARGE_FALL) * before : before + 0.5 * BETTER * slope;
    double length = iccp_min(1, most);
    for (size_t i = 0; i < s->assembly.n_free; ++i)
        memcpy(s->saved + dim * i, s->map.images + dim * s->assembly.free_point[i],
               dim * sizeof *s->saved);
    for (int k = 0; k < n_tries; ++k, length *= shorter) {
        set_images(s, length, in_space);
        const double after = iccp_newton_energy(s, energy, epsilon);
        if (after <= before + DECREASE * length * slope && (!guarded || all_positive(s)))
            return guarded && k == 0 && after < low ? go_on(s, energy, after, length, most) : after;
    }
    set_images(s, 0, false);
    return before;
}
