/* Does the same as dirichlet.c in the plane, operation by operation, for LANES triangles side by
 * side. A branch there is a blend here.
 *
 * The file that includes this one names the processor (TARGET). It also defines three functions:
 * gather() takes number i of each array, square_root() takes roots, and store() writes four numbers
 * of each triangle. */
#ifndef ICCP_DIRICHLET_LANES_H
#define ICCP_DIRICHLET_LANES_H

#include "map/energy/dirichlet.h"

#include <stdint.h>

/* Lane l of every number belongs to triangle l. */
typedef double reals __attribute__((vector_size(8 * LANES)));
/* each lane has all bits set, or none */
typedef int64_t masks __attribute__((vector_size(8 * LANES)));

typedef struct triangles {
    reals element[ICCP_ELEMENT(2)], j[4];
    reals sigma[2], u[2][2], v[2][2];
    reals gradient[6], hessian[36];
} triangles;

TARGET static ICCP_INLINE void gather(const double *const *array, size_t i, reals *x);
TARGET static ICCP_INLINE void square_root(const reals *x, reals *root);
TARGET static ICCP_INLINE void store(const reals x[4], double *const *to);

/* Chooses a where the mask is set and b elsewhere. */
TARGET static ICCP_INLINE void blend(const masks *where, const reals *a, const reals *b, reals *x)
{
    *x = (reals)((*where & (masks)*a) | (~*where & (masks)*b));
}

TARGET static ICCP_INLINE void take(triangles *t, const iccp_dirichlet_batch *batch, size_t first)
{
    for (size_t i = 0; i < ICCP_ELEMENT(2); ++i)
        gather(batch->element + first, i, &t->element[i]);
    for (size_t r = 0; r < 2; ++r) {
        reals corner[3];
        for (size_t k = 0; k < 3; ++k)
            gather(batch->image[k] + first, r, &corner[k]);
        const reals x = corner[1] - corner[0], y = corner[2] - corner[0];
        for (size_t c = 0; c < 2; ++c)
            t->j[2 * r + c] = x * t->element[3 + c] + y * t->element[5 + c];
    }
}

/* See iccp_singular_find(). */
TARGET static ICCP_INLINE void find_singular(triangles *t)
{
    const reals *j = t->j, one = (reals){0} + 1;
    const reals a = j[0] * j[0] + j[2] * j[2], d = j[1] * j[1] + j[3] * j[3];
    const reals q = j[0] * j[1] + j[2] * j[3], p = 0.5 * (a - d), square = p * p + q * q;
    reals r, large, cosine, sine;
    square_root(&square, &r);
    const reals size = (reals)((masks)p & INT64_MAX), half = 0.5 * (1 + size / r);
    square_root(&half, &large);
    const reals small = 0.5 * q / (r * large), small_size = (reals)((masks)small & INT64_MAX);
    const reals swapped = (reals)((masks)large | ((masks)q & INT64_MIN));
    const masks is_negative = (p < 0), is_turned = (r > 0);
    blend(&is_negative, &small_size, &large, &cosine);
    blend(&is_negative, &swapped, &small, &sine);
    blend(&is_turned, &cosine, &one, &t->v[0][0]);
    t->v[1][1] = t->v[0][0];
    t->v[0][1] = (reals)((masks)sine & is_turned);
    t->v[1][0] = -t->v[0][1];
    const reals x = j[0] * t->v[0][0] + j[1] * t->v[0][1];
    const reals y = j[2] * t->v[0][0] + j[3] * t->v[0][1], length = x * x + y * y;
    square_root(&length, &t->sigma[0]);
    t->sigma[1] = (j[0] * j[3] - j[1] * j[2]) / t->sigma[0];
    t->u[0][0] = t->u[1][1] = x / t->sigma[0];
    t->u[0][1] = y / t->sigma[0];
    t->u[1][0] = -t->u[0][1];
}

/* See iccp_pull_back(). */
TARGET static ICCP_INLINE void pull_back(const triangles *t, const reals by_j[4],
                                         const reals *factor, reals by_corner[6])
{
    for (size_t k = 0; k < 3; ++k)
        for (size_t r = 0; r < 2; ++r)
            by_corner[2 * k + r] = *factor * (by_j[2 * r] * t->element[1 + 2 * k] +
                                              by_j[2 * r + 1] * t->element[2 + 2 * k]);
}

TARGET static ICCP_INLINE void set_gradient(triangles *t)
{
    reals by_j[4] = {{0}};
    for (size_t k = 0; k < 2; ++k) {
        const reals s = t->sigma[k], slope = 2 * (s - 1 / (s * s * s));
        for (size_t i = 0; i < 4; ++i)
            by_j[i] += slope * t->u[k][i / 2] * t->v[k][i % 2];
    }
    pull_back(t, by_j, &t->element[0], t->gradient);
}

/* Does iccp_add_mode() for each mode in turn, entry by entry, so that each sum stays in a
 * register. */
TARGET static ICCP_INLINE void add_modes(triangles *t, reals mode[4][4], const reals weight[4])
{
    const reals one = (reals){0} + 1;
    reals q[4][6];
    for (size_t k = 0; k < 4; ++k)
        pull_back(t, mode[k], &one, q[k]);
    for (size_t r = 0; r < 6; ++r) {
        reals by_row[4];
        for (size_t k = 0; k < 4; ++k)
            by_row[k] = weight[k] * q[k][r];
        for (size_t c = 0; c < 6; ++c)
            for (size_t k = 0; k < 4; ++k)
                t->hessian[6 * r + c] += by_row[k] * q[k][c];
    }
}

/* A twist with negative curvature gets the weight 0. */
TARGET static ICCP_INLINE void add_newton_modes(triangles *t)
{
    const double half = sqrt(0.5);
    const reals a = t->sigma[0], b = t->sigma[1], product = a * b;
    const reals cube = product * product * product;
    const reals flip = 2 + 2 * (a * a + a * b + b * b) / cube;
    reals twist = 2 - 2 * (a * a - a * b + b * b) / cube, modes[4][4];
    twist = (reals)((masks)twist & (twist > 0));
    reals weight[4] = {{0}, {0}, t->element[0] * flip, t->element[0] * twist};
    for (size_t k = 0; k < 2; ++k) {
        const reals sigma2 = t->sigma[k] * t->sigma[k];
        weight[k] = t->element[0] * (2 + 6 / (sigma2 * sigma2));
    }
    for (size_t i = 0; i < 4; ++i) {
        const size_t r = i / 2, c = i % 2;
        const reals there = half * t->u[0][r] * t->v[1][c], back = half * t->u[1][r] * t->v[0][c];
        modes[0][i] = t->u[0][r] * t->v[0][c];
        modes[1][i] = t->u[1][r] * t->v[1][c];
        modes[2][i] = there + back;
        modes[3][i] = there - back;
    }
    add_modes(t, modes, weight);
}

TARGET static ICCP_INLINE void add_majorant(triangles *t)
{
    const reals *g = t->element + 1, twice = 2 * t->element[0];
    reals m[4] = {{0}};
    for (size_t k = 0; k < 2; ++k) {
        const reals i = 1 / t->sigma[k], weight = 1 + i + i * i + i * i * i;
        for (size_t e = 0; e < 4; ++e)
            m[e] += weight * t->u[k][e / 2] * t->u[k][e % 2];
    }
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b) {
            const reals dot = (g[2 * a] * g[2 * b] + g[2 * a + 1] * g[2 * b + 1]) * twice;
            for (size_t e = 0; e < 4; ++e)
                t->hessian[6 * (2 * a + e / 2) + 2 * b + e % 2] += dot * m[e];
        }
}

/* Stores the results. The two middle numbers of the six of a gradient are stored twice. */
TARGET static ICCP_INLINE void give(const triangles *t, iccp_local *local)
{
    double *to[LANES];
    for (size_t i = 0; i <= 2; i += 2) {
        for (size_t l = 0; l < LANES; ++l)
            to[l] = local[l].gradient + i;
        store(t->gradient + i, to);
    }
    for (size_t i = 0; i < 36; i += 4) {
        for (size_t l = 0; l < LANES; ++l)
            to[l] = local[l].hessian + i;
        store(t->hessian + i, to);
    }
}

/* Sets what iccp_dirichlet_local() gives for triangles first, ..., first + LANES - 1 of a batch. */
TARGET static ICCP_INLINE void set_locals(const iccp_dirichlet_batch *batch, size_t first,
                                          bool majorise, iccp_local *local)
{
    triangles t;
    take(&t, batch, first);
    find_singular(&t);
    set_gradient(&t);
    for (size_t i = 0; i < 36; ++i)
        t.hessian[i] = (reals){0};
    if (majorise)
        add_majorant(&t);
    else
        add_newton_modes(&t);
    give(&t, local + first);
}

#endif
