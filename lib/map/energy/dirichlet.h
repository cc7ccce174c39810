/* The symmetric Dirichlet energy of the linear map of one simplex in the plane or in space. */
#ifndef ICCP_DIRICHLET_H
#define ICCP_DIRICHLET_H

#include "base/simd.h"
#include "map/energy/jacobian.h"

#include <math.h>
#include <stdbool.h>

/* |J|^2 + |J^-1|^2 times the element's area or volume: 2 dim times it for an isometry, infinite
 * when the image is not positive. */
double iccp_dirichlet_energy(size_t dim, const double *element, const double *const *image);

/* In the plane, where |J^-1| = |J| / det. */
static ICCP_INLINE double iccp_dirichlet_energy2(const double *element, const double *const *image)
{
    double j[4];
    const double det = iccp_element_jacobian(2, element, image, j);
    return det > 0 ? element[0] * iccp_squared_norm(2, j) * (1 + 1 / (det * det)) : HUGE_VAL;
}

/* With `majorise`, the Hessian is that of SLIM's quadratic model, which copes with a bad start;
 * otherwise the energy's own. The image must be positive. */
void iccp_dirichlet_local(size_t dim, const double *element, const double *const *image,
                          bool majorise, iccp_local *local);

/* Triangles that are looked at side by side, some of which may be one: their elements, and the
 * images of corner k of each. */
enum { ICCP_DIRICHLET_LANES = 4 };
typedef struct iccp_dirichlet_batch {
    const double *element[ICCP_DIRICHLET_LANES], *image[3][ICCP_DIRICHLET_LANES];
} iccp_dirichlet_batch;

/* What iccp_dirichlet_local() gives for each triangle of a batch, and the same bits, with the
 * instructions of that level; with those of AVX2; and with WebAssembly's vectors. */
void iccp_dirichlet_locals(iccp_simd_level level, const iccp_dirichlet_batch *batch, bool majorise,
                           iccp_local *local);
void iccp_dirichlet_locals_avx2(const iccp_dirichlet_batch *batch, bool majorise,
                                iccp_local *local);
void iccp_dirichlet_locals_wasm(const iccp_dirichlet_batch *batch, bool majorise,
                                iccp_local *local);

#endif
