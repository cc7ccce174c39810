/* Method of centres: P. Huard, Resolution of mathematical programming with nonlinear constraints by
 * the method of centres, 1967; steps of Newton's method damped as in Y. Nesterov, A. Nemirovskii,
 * Interior-Point Polynomial Algorithms in Convex Programming, 1994, which never leave the
 * half-spaces. */
#include "map/halfspaces.h"

#include "base/minmax.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* In units of the decrement: where Newton's method counts as at the centre, and on the way to
 * others. */
static const double AT_CENTRE = 0.1, NEAR_CENTRE = 0.3;

/* Of the way to the nearest violated half-space that these move on from a centre; where that is
 * less than LEAST of how far they are moved back, there is nothing in common. */
static const double SHARE = 0.7, LEAST = 0.02;

enum { MOST_CENTRES = 30, LAST_STEPS = 3 };

void iccp_halfspaces_free(iccp_halfspaces *h)
{
    iccp_free(&h->memory, h->item);
    h->item = NULL;
}

bool iccp_halfspaces_reserve(iccp_halfspaces *h, size_t room)
{
    if (room <= h->room)
        return true;
    const size_t n = room > 2 * h->room ? room : 2 * h->room;
    if (!iccp_enlarge(&h->memory, &h->item, h->n, n, sizeof *h->item))
        return false;
    h->room = n;
    return true;
}

bool iccp_halfspaces_add(iccp_halfspaces *h, const double *a, const double *b, const double *c)
{
    iccp_halfspace *half = &h->item[h->n];
    double u[3], v[3];
    for (size_t k = 0; k < 3; ++k) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    iccp_vec_cross(u, v, half->normal);
    const double length = iccp_vec_norm(3, half->normal);
    if (!(length > 0))
        return false;
    for (size_t k = 0; k < 3; ++k)
        half->normal[k] /= length;
    half->offset = iccp_vec_dot(3, half->normal, a);
    half->violated = false;
    ++h->n;
    return true;
}

static double distance(const iccp_halfspace *half, const double *x)
{
    return iccp_vec_dot(3, half->normal, x) - half->offset;
}

/* s = g / h for a symmetric matrix; false if it is not positive. */
static bool solve(double h[3][3], const double *g, double *s)
{
    double row[3][3];
    for (size_t k = 0; k < 3; ++k)
        iccp_vec_cross(h[(k + 1) % 3], h[(k + 2) % 3], row[k]);
    const double det = iccp_vec_dot(3, h[0], row[0]);
    for (size_t k = 0; k < 3; ++k)
        s[k] = iccp_vec_dot(3, row[k], g) / det;
    return det > 0;
}

/* One step towards the greatest product of distances, where those that are violated begin so much
 * lower. `decrement`: how far from there it was. False when there is none. */
static bool step(const iccp_halfspaces *h, double lower, double *x, double *decrement)
{
    double g[3] = {0}, hessian[3][3] = {{0}}, s[3];
    for (size_t i = 0; i < h->n; ++i) {
        const iccp_halfspace *half = &h->item[i];
        const double d = distance(half, x) + (half->violated ? lower : 0);
        if (!(d > 0))
            return false;
        for (size_t k = 0; k < 3; ++k) {
            g[k] += half->normal[k] / d;
            for (size_t l = 0; l < 3; ++l)
                hessian[k][l] += half->normal[k] * half->normal[l] / (d * d);
        }
    }
    if (!solve(hessian, g, s))
        return false;
    const double square = iccp_vec_dot(3, g, s);
    if (!(square >= 0 && square < HUGE_VAL))
        return false;
    *decrement = sqrt(square);
    for (size_t k = 0; k < 3; ++k)
        x[k] += s[k] / (1 + *decrement);
    return true;
}

void iccp_halfspaces_centre(const iccp_halfspaces *h, size_t steps, double x[3])
{
    double decrement = 1;
    for (size_t k = 0; k < steps && decrement >= AT_CENTRE && step(h, 0, x, &decrement); ++k)
        continue;
}

/* The smallest distance from one that was violated. */
static double worst(const iccp_halfspaces *h, const double *x)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < h->n; ++i)
        if (h->item[i].violated)
            least = iccp_min(least, distance(&h->item[i], x));
    return least;
}

/* From centre to centre, with violated half-spaces that come ever nearer to where they are. */
bool iccp_halfspaces_enter(iccp_halfspaces *h, size_t steps, double x[3])
{
    bool any = false;
    for (size_t i = 0; i < h->n; ++i) {
        h->item[i].violated = !(distance(&h->item[i], x) > 0);
        any |= h->item[i].violated;
    }
    if (!any)
        return true;
    double least = worst(h, x), lower = -1.5 * least, decrement;
    for (size_t k = 0; k < MOST_CENTRES && least <= 0 && lower > 0; ++k) {
        decrement = 1;
        for (size_t i = 0; i < steps && decrement >= NEAR_CENTRE; ++i)
            if (!step(h, lower, x, &decrement))
                return false;
        least = worst(h, x);
        const double gain = SHARE * (least + lower);
        if (least <= 0 && gain < LEAST * lower)
            return false;
        lower -= gain;
    }
    if (least > 0)
        iccp_halfspaces_centre(h, LAST_STEPS, x);
    return least > 0;
}
