/* Fits an affine map of the plane to pairs of places. */
#ifndef ICCP_PLANE_AFFINE_H
#define ICCP_PLANE_AFFINE_H

#include <stdbool.h>
#include <stddef.h>

/* y = matrix (x - from) + to */
typedef struct iccp_plane_affine {
    double from[2], to[2], matrix[4];
} iccp_plane_affine;

static inline void iccp_plane_affine_move(const iccp_plane_affine *affine, const double *x,
                                          double *y)
{
    const double d[2] = {x[0] - affine->from[0], x[1] - affine->from[1]};
    for (int k = 0; k < 2; ++k)
        y[k] = affine->matrix[2 * k] * d[0] + affine->matrix[2 * k + 1] * d[1] + affine->to[k];
}

/* Sums over pairs with weights. Begin with zeros. */
typedef struct iccp_plane_affine_sums {
    size_t n;
    double origin[4]; /* the first pair, from which the others are measured */
    double weight, sum[4];
    double from[3];  /* products xx, xy, yy of the source */
    double mixed[4]; /* target times source */
    double to;       /* squares of the target */
} iccp_plane_affine_sums;

void iccp_plane_affine_add(iccp_plane_affine_sums *sums, double weight, const double *from,
                           const double *to);

/* Fits by weighted least squares. `size`: of the source and of the target as a whole. If the places
 * lie almost on a line, or would be mirrored, the fit is a similarity. Returns false if the places
 * tell no direction because their spread is small compared with `size`. The map then scales by the
 * ratio of the sizes, and takes the first pair, if there is one, to its partner. */
bool iccp_plane_affine_fit(iccp_plane_affine *affine, const iccp_plane_affine_sums *sums,
                           const double *size);

#endif
