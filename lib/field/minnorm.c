/* Finds the point of a convex hull that is nearest to the origin. Source: P. Wolfe, Finding the
 * Nearest Point in a Polytope, Mathematical Programming 11, 1976.
 *
 * A corral is a simplex of the given points. It changes until it holds the nearest point. */
#include "field/minnorm.h"

#include "icc/base.h"
#include "math/vec.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST_CORNERS = ICC_MAX_DIM + 1, MOST_ROUNDS = 1000 };

/* Points and products are about 1, so smaller differences are rounding. */
static const double TOLERANCE = 1e-14;

/* A simplex of the points, with positive weights of its corners that sum to 1. */
typedef struct corral {
    size_t n;
    size_t corner[MOST_CORNERS + 1];
    double weight[MOST_CORNERS + 1];
} corral;

/* Gaussian elimination with pivoting; false when the matrix is singular. */
static bool solve(size_t n, double a[][MOST_CORNERS + 1], double *x)
{
    for (size_t c = 0; c < n; ++c) {
        size_t pivot = c;
        for (size_t r = c + 1; r < n; ++r)
            if (fabs(a[r][c]) > fabs(a[pivot][c]))
                pivot = r;
        if (fabs(a[pivot][c]) < TOLERANCE)
            return false;
        for (size_t k = c; k < n; ++k) {
            const double swap = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        const double swap = x[c];
        x[c] = x[pivot];
        x[pivot] = swap;
        for (size_t r = c + 1; r < n; ++r) {
            const double factor = a[r][c] / a[c][c];
            for (size_t k = c; k < n; ++k)
                a[r][k] -= factor * a[c][k];
            x[r] -= factor * x[c];
        }
    }
    for (size_t c = n; c-- > 0;) {
        for (size_t k = c + 1; k < n; ++k)
            x[c] -= a[c][k] * x[k];
        x[c] /= a[c][c];
    }
    return true;
}

/* The weights of the point nearest to the origin in the plane through the corners. At this point
 * all rows of the Gram matrix give the same product. Adding 1 to all products makes the system
 * positive definite. */
static bool affine_weights(size_t dim, const double *points, const corral *c, double *weight)
{
    double gram[MOST_CORNERS + 1][MOST_CORNERS + 1], sum = 0;
    for (size_t i = 0; i < c->n; ++i) {
        weight[i] = 1;
        for (size_t j = 0; j < c->n; ++j)
            gram[i][j] =
                1 + iccp_vec_dot(dim, points + dim * c->corner[i], points + dim * c->corner[j]);
    }
    if (!solve(c->n, gram, weight))
        return false;
    for (size_t i = 0; i < c->n; ++i)
        sum += weight[i];
    for (size_t i = 0; i < c->n; ++i)
        weight[i] /= sum;
    return true;
}

/* Moves the weights towards the target until a corner loses its weight, and drops that corner. */
static void move_to_face(corral *c, const double *target)
{
    double share = 1;
    size_t lost = 0;
    for (size_t i = 0; i < c->n; ++i)
        if (target[i] <= TOLERANCE && c->weight[i] / (c->weight[i] - target[i]) < share) {
            share = c->weight[i] / (c->weight[i] - target[i]);
            lost = i;
        }
    for (size_t i = 0; i < c->n; ++i)
        c->weight[i] += share * (target[i] - c->weight[i]);
    --c->n;
    c->corner[lost] = c->corner[c->n];
    c->weight[lost] = c->weight[c->n];
}

static bool all_positive(size_t n, const double *weight)
{
    for (size_t i = 0; i < n; ++i)
        if (weight[i] <= TOLERANCE)
            return false;
    return true;
}

static void place(size_t dim, const double *points, const corral *c, double *nearest)
{
    memset(nearest, 0, dim * sizeof *nearest);
    for (size_t i = 0; i < c->n; ++i)
        for (size_t k = 0; k < dim; ++k)
            nearest[k] += c->weight[i] * points[dim * c->corner[i] + k];
}

static size_t lowest(size_t dim, size_t n, const double *points, const double *direction)
{
    size_t best = 0;
    double least = DBL_MAX;
    for (size_t i = 0; i < n; ++i) {
        const double product = iccp_vec_dot(dim, points + dim * i, direction);
        if (product < least) {
            least = product;
            best = i;
        }
    }
    return best;
}

/* Shrinks the corral until its nearest point lies within it. Returns false if its corners depend
 * on each other. */
static bool shrink_corral(size_t dim, const double *points, corral *c)
{
    double weight[MOST_CORNERS + 1];
    while (c->n > 1) {
        if (!affine_weights(dim, points, c, weight))
            return false;
        if (all_positive(c->n, weight)) {
            memcpy(c->weight, weight, c->n * sizeof *weight);
            return true;
        }
        move_to_face(c, weight);
    }
    c->weight[0] = 1;
    return true;
}

double iccp_minnorm(size_t dim, size_t n, const double *points, double *nearest)
{
    corral c = {.n = 1, .weight = {1}};
    size_t low = 0;
    for (int round = 0; round < MOST_ROUNDS; ++round) {
        place(dim, points, &c, nearest);
        low = lowest(dim, n, points, nearest);
        const double least = iccp_vec_dot(dim, points + dim * low, nearest);
        if (least >= iccp_vec_dot(dim, nearest, nearest) - TOLERANCE || c.n > dim)
            break;
        c.corner[c.n] = low;
        c.weight[c.n++] = 0;
        if (!shrink_corral(dim, points, &c))
            break;
    }
    const double length = iccp_vec_norm(dim, nearest);
    return length > TOLERANCE ? iccp_vec_dot(dim, points + dim * low, nearest) / length : 0;
}
