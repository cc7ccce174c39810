/* Two searches. To come inside: the place whose least distance is greatest, by gradient projection
 * (J. Rosen, The gradient projection method for nonlinear programming, part I, 1960). To come to
 * the middle: Newton's method for the product of distances, damped as in Y. Nesterov, A.
 * Nemirovskii, Interior-Point Polynomial Algorithms in Convex Programming, 1994, whose steps never
 * leave the half-spaces. */
#include "map/solid/halfspaces.h"

#include "base/minmax.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Newton's method has reached the centre if the decrement is below this. */
static const double AT_CENTRE = 0.1;

/* If this or less is left of a unit vector, it depends on the others up to rounding. */
static const double DEPENDENT = 1e-13;

enum { MOST_TURNS = 100, LAST_STEPS = 3 };

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
    ++h->n;
    return true;
}

static double distance(const iccp_halfspace *half, const double *x)
{
    return iccp_vec_dot(3, half->normal, x) - half->offset;
}

/* Solves h s = g for a symmetric matrix. Returns false if it is not positive. */
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

/* Does one step towards the greatest product of distances. `decrement` tells how far away that was.
 * Returns false if there is no step. */
static bool step(const iccp_halfspaces *h, double *x, double *decrement)
{
    double g[3] = {0}, hessian[3][3] = {{0}}, s[3];
    for (size_t i = 0; i < h->n; ++i) {
        const iccp_halfspace *half = &h->item[i];
        const double d = distance(half, x);
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
    for (size_t k = 0; k < steps && decrement >= AT_CENTRE && step(h, x, &decrement); ++k)
        continue;
}

/* ---- coming inside: a linear program for the place and its least distance t, four numbers z, with
 * normal . x - t >= offset ---- */

/* The half-spaces that are as close as the closest one, and an orthonormal basis of the span of
 * their rows (normal, -1). */
typedef struct active_set {
    size_t n, index[4];
    double basis[4][4], product[4][4]; /* of the basis and the rows: row j is the sum of
                                          product[i][j] basis[i] over i <= j */
} active_set;

static void row_of(const iccp_halfspace *half, double *row)
{
    memcpy(row, half->normal, sizeof half->normal);
    row[3] = -1;
}

/* Removes from a vector its part in the span of the basis. Does it twice, so that only rounding
 * errors are left. */
static double reduce(const active_set *set, size_t n, double *v, double *product)
{
    for (size_t k = 0; k < n; ++k)
        product[k] = 0;
    for (int again = 0; again < 2; ++again)
        for (size_t k = 0; k < n; ++k) {
            const double dot = iccp_vec_dot(4, set->basis[k], v);
            product[k] += dot;
            for (size_t i = 0; i < 4; ++i)
                v[i] -= dot * set->basis[k][i];
        }
    return iccp_vec_norm(4, v);
}

/* Adds row j, which belongs to set->index[j]. The rows before it must be present. */
static bool add_row(active_set *set, const iccp_halfspaces *h, size_t j)
{
    double product[4], *b = set->basis[j];
    row_of(&h->item[set->index[j]], b);
    const double length = reduce(set, j, b, product);
    for (size_t i = 0; i < j; ++i)
        set->product[i][j] = product[i];
    set->product[j][j] = length;
    for (size_t i = 0; i < 4; ++i)
        b[i] /= length;
    return length > DEPENDENT;
}

/* Removes the half-space that keeps t from growing. Returns false if none does. `up`: products of
 * the basis with the direction in which t grows. */
static bool drop_row(active_set *set, const iccp_halfspaces *h, const double *up)
{
    double share[4];
    size_t most = 0;
    for (size_t j = set->n; j-- > 0;) {
        share[j] = up[j];
        for (size_t k = j + 1; k < set->n; ++k)
            share[j] -= set->product[j][k] * share[k];
        share[j] /= set->product[j][j];
        most = j + 1 == set->n || share[j] > share[most] ? j : most;
    }
    if (set->n == 0 || !(share[most] > 0))
        return false;
    --set->n;
    for (size_t j = most; j < set->n; ++j) {
        set->index[j] = set->index[j + 1];
        (void)add_row(set, h, j);
    }
    return true;
}

/* Goes as far as the half-spaces allow, and adds the one that ends the step. Returns false if none
 * does. */
static bool advance(active_set *set, const iccp_halfspaces *h, const double *way, double *z)
{
    double least = HUGE_VAL;
    size_t next = h->n;
    for (size_t i = 0; i < h->n; ++i) {
        const double rate = iccp_vec_dot(3, h->item[i].normal, way) - way[3];
        const double room = iccp_max(0, distance(&h->item[i], z) - z[3]);
        if (rate < -DEPENDENT && room < least * -rate) {
            least = room / -rate;
            next = i;
        }
    }
    if (next == h->n)
        return false;
    for (size_t i = 0; i < 4; ++i)
        z[i] += least * way[i];
    set->index[set->n++] = next;
    return add_row(set, h, set->n - 1);
}

/* Goes up in the directions that the active half-spaces leave free, until another one ends the
 * step. If they leave none, it removes the one that keeps t from growing. If there is no such
 * half-space, t is greatest. */
bool iccp_halfspaces_enter(const iccp_halfspaces *h, double x[3])
{
    double z[4] = {x[0], x[1], x[2], HUGE_VAL};
    active_set set = {0};
    for (size_t i = 0; i < h->n; ++i)
        z[3] = iccp_min(z[3], distance(&h->item[i], x));
    if (z[3] > 0)
        return true;
    for (size_t k = 0; k < MOST_TURNS; ++k) {
        double way[4] = {0, 0, 0, 1}, product[4];
        const double length = reduce(&set, set.n, way, product);
        if (length > DEPENDENT) {
            for (size_t i = 0; i < 4; ++i)
                way[i] /= length;
            if (!advance(&set, h, way, z))
                break;
        } else if (!drop_row(&set, h, product)) {
            break;
        }
    }
    memcpy(x, z, 3 * sizeof *x);
    if (z[3] > 0)
        iccp_halfspaces_centre(h, LAST_STEPS, x);
    return z[3] > 0;
}
