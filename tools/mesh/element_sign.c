/* Based on: A. Johnen, J.-F. Remacle, C. Geuzaine, Geometrical validity of curvilinear finite
 * elements, Journal of Computational Physics 233, 2013. The Jacobian determinant is put into
 * Bernstein form. The coefficients bound it and include its values at the corners. They are
 * subdivided until the sign is known. Coefficients are intervals: each has a bound of its rounding
 * errors from the start. */
#include "mesh/element_sign.h"

#include "base/orientation.h"
#include "mesh/element_plan.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The nodes in the order of the kind's shape, scaled by a power of two so that none is above 1. */
static void take_nodes(const element_plan *p, const double *points, const uint32_t *nodes,
                       double x[ELEMENT_MOST_NODES][3])
{
    double size = 0;
    int exponent;
    for (size_t i = 0; i < p->n_nodes; i++)
        for (size_t k = 0; k < p->dim; k++) {
            x[i][k] = points[p->dim * nodes[p->kind->order != NULL ? p->kind->order[i] : i] + k];
            size = fmax(size, fabs(x[i][k]));
        }
    frexp(size, &exponent);
    for (size_t i = 0; i < p->n_nodes; i++)
        for (size_t k = 0; k < p->dim; k++)
            x[i][k] = ldexp(x[i][k], -exponent);
}

/* Sums up the nodes with shares that add up to 0, as differences from the first node that has a share.
 * Also sums up the sizes of the parts. */
static void combine(const element_plan *p, const double *row, double x[ELEMENT_MOST_NODES][3],
                    int exponent, double v[3], double size[3])
{
    size_t first = 0;
    while (first + 1 < p->n_nodes && fpclassify(row[first]) == FP_ZERO)
        first++;
    memset(v, 0, 3 * sizeof *v);
    memset(size, 0, 3 * sizeof *size);
    for (size_t i = first + 1; i < p->n_nodes; i++)
        for (size_t k = 0; k < p->dim && fpclassify(row[i]) != FP_ZERO; k++) {
            double part = row[i] * ldexp(x[i][k] - x[first][k], exponent);
            v[k] += part;
            size[k] += fabs(part);
        }
}

static double determinant(size_t dim, const double *a, const double *b, const double *c)
{
    return dim == 2 ? a[0] * b[1] - a[1] * b[0]
                    : a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Does the same with all signs positive. */
static double permanent(size_t dim, const double *a, const double *b, const double *c)
{
    return dim == 2 ? a[0] * b[1] + a[1] * b[0]
                    : a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[2] * c[0] + b[0] * c[2]) +
                          a[2] * (b[0] * c[1] + b[1] * c[0]);
}

/* The exponent by which differences are scaled up, so the largest is about 1. */
static int scale_of(const element_plan *p, double x[ELEMENT_MOST_NODES][3])
{
    double size = 0;
    int exponent;
    for (size_t i = 1; i < p->n_nodes; i++)
        for (size_t k = 0; k < p->dim; k++)
            size = fmax(size, fabs(x[i][k] - x[0][k]));
    frexp(size, &exponent);
    return -exponent;
}

/* Lower and upper bounds of the determinant's coefficients, times `sign`. Errors are counted in units
 * of u, the unit roundoff, times the size. A combination of nodes is off by at most n_nodes + 2,
 * because shares are exact, and differences, products and sums are rounded. A product of three is
 * off by that much for each of them and 8 more, its weight by 30, and a sum of N products by N more.
 * The count is doubled for terms of higher order, and `underflow` is added. */
static void bound(element_plan *p, double x[ELEMENT_MOST_NODES][3], int sign)
{
    const double unit = DBL_EPSILON / 2, underflow = 1e-280;
    double v[3][MOST_ROWS][3], size[3][MOST_ROWS][3];
    size_t n = p->n_coefficients;
    double *lower = p->work, *upper = p->work + n;
    int exponent = scale_of(p, x);
    for (size_t k = 0; k < p->dim; k++)
        for (size_t i = 0; i < p->n_rows[k]; i++)
            combine(p, p->rows[k] + i * p->n_nodes, x, exponent, v[k][i], size[k][i]);
    memset(lower, 0, 2 * n * sizeof *lower);
    for (const term *t = p->terms; t < p->terms + p->n_terms; t++) {
        lower[t->to] += t->weight * determinant(p->dim, v[0][t->a], v[1][t->b], v[2][t->c]);
        upper[t->to] += t->weight * permanent(p->dim, size[0][t->a], size[1][t->b], size[2][t->c]);
    }
    for (size_t i = 0; i < n; i++) {
        double steps = 3 * (double)(p->n_nodes + 2) + 8 + 30 + p->rounding[i];
        double value = sign * lower[i], off = 2 * steps * unit * upper[i] + underflow;
        lower[i] = value - off;
        upper[i] = value + off;
    }
}

/* ---------------------------------------------------------------------- subdivision */

/* The middle of two bounds, rounded down (way -1) or up (1). */
static double middle(double a, double b, double way)
{
    double m = 0.5 * (a + b);
    return m + way * DBL_EPSILON * fabs(m);
}

/* De Casteljau's algorithm at the middle of an edge: `one` keeps its beginning, `other` its end. */
static void bisect(const element_plan *p, size_t pair, double way, const double *from, double *one,
                   double *other)
{
    for (size_t i = 0; i < p->n_lines[pair]; i++) {
        const bernstein_line *line = &p->lines[pair][i];
        double b[MOST_DEGREE + 1];
        for (size_t j = 0; j <= line->n; j++)
            b[j] = from[line->at[j]];
        for (size_t left = line->n;; left--) {
            one[line->at[line->n - left]] = b[0];
            other[line->at[left]] = b[left];
            if (left == 0)
                break;
            for (size_t j = 0; j < left; j++)
                b[j] = middle(b[j], b[j + 1], way);
        }
    }
}

/* Judges a part by its bounds. If all coefficients are at least 0 and those at corners are above 0, the
 * determinant is above 0, because each face of the part has a corner. */
static element_sign judge(const element_plan *p, const double *bounds, bool *stuck)
{
    const double *lower = bounds, *upper = bounds + p->n_coefficients;
    bool positive = true;
    for (size_t c = 0; c < p->n_corners; c++) {
        if (upper[p->corners[c]] <= 0)
            return ELEMENT_INVERTED;
        *stuck = *stuck || !(lower[p->corners[c]] > 0);
    }
    for (size_t i = 0; i < p->n_coefficients; i++)
        positive = positive && lower[i] >= 0;
    return positive && !*stuck ? ELEMENT_POSITIVE : ELEMENT_UNDECIDED;
}

/* Goes through the parts depth first. A part with a corner that rounding leaves open stays open. */
static element_sign subdivide(element_plan *p)
{
    size_t n = p->n_coefficients, depths[DEEPEST + 2] = {0}, n_open = 1;
    bool undecided = false;
    for (size_t n_parts = 0; n_open > 0; n_parts++) {
        double *part = p->work + 2 * n * (n_open - 1), *next = part + 2 * n;
        size_t depth = depths[n_open - 1];
        bool stuck = false;
        element_sign s = judge(p, part, &stuck);
        if (s == ELEMENT_INVERTED)
            return s;
        if (s == ELEMENT_POSITIVE || stuck || depth == DEEPEST) {
            undecided = undecided || s != ELEMENT_POSITIVE;
            n_open--;
            continue;
        }
        if (n_parts == MOST_PARTS)
            return ELEMENT_UNDECIDED;
        bisect(p, depth % p->n_pairs, -1, part, next, part);
        bisect(p, depth % p->n_pairs, 1, part + n, next + n, part + n);
        depths[n_open - 1] = depths[n_open] = depth + 1;
        n_open++;
    }
    return undecided ? ELEMENT_UNDECIDED : ELEMENT_POSITIVE;
}

/* -------------------------------------------------------------------------- signs */

/* The exact sign at a corner of a linear element. */
static int sign_at(const element_plan *p, double x[ELEMENT_MOST_NODES][3], size_t corner)
{
    const unsigned char *at = p->product->around[corner];
    return p->dim == 2 ? orientation(x[at[0]], x[at[1]], x[at[2]])
                       : orientation_3d(x[at[0]], x[at[1]], x[at[2]], x[at[3]]);
}

/* Looks at exact signs at the corners first, because one wrong sign decides. */
static element_sign decide(element_plan *p, double x[ELEMENT_MOST_NODES][3], int sign)
{
    const double least = 0x1p-700; /* what an exact positive sign proves, scaled as in bound() */
    bool linear = p->kind->degree == 1;
    for (size_t c = 0; linear && c < p->product->n_around; c++)
        if (sign_at(p, x, c) != sign)
            return ELEMENT_INVERTED;
    if (element_corners_decide(p->kind))
        return ELEMENT_POSITIVE;
    bound(p, x, sign);
    for (size_t c = 0; linear && c < p->n_corners; c++) {
        double *lower = &p->work[p->corners[c]];
        *lower = fmax(*lower, least);
    }
    return subdivide(p);
}

element_sign element_sign_of(element_plan *p, const double *points, const uint32_t *nodes, int sign)
{
    double x[ELEMENT_MOST_NODES][3];
    if (p->product == NULL)
        return ELEMENT_UNDECIDED;
    take_nodes(p, points, nodes, x);
    return decide(p, x, sign);
}

int element_orientation(element_plan *p, const double *points, const uint32_t *nodes)
{
    return element_sign_of(p, points, nodes, 1) == ELEMENT_POSITIVE    ? 1
           : element_sign_of(p, points, nodes, -1) == ELEMENT_POSITIVE ? -1
                                                                       : 0;
}
