/* Helpers of mesh maps for one point in the caller's coordinates. */
#ifndef ICCP_CALLER_POINT_H
#define ICCP_CALLER_POINT_H

#include "base/compiler.h"
#include "map/kind/kind.h"

#include <math.h>

/* Maps a boundary point to the other cage's boundary. There is no Jacobian there. */
static inline icc_status iccp_image_on_boundary(const icc_domain *to, uint32_t facet,
                                                const double *bary, double *image,
                                                const double *jacobian)
{
    if (jacobian != NULL)
        return ICC_ERR_TRACE;
    iccp_domain_facet_point(to, facet, bary, image);
    return ICC_OK;
}

/* Converts a local image and Jacobian to the caller's coordinates. */
static ICCP_INLINE void iccp_image_out(const icc_domain *from, const icc_domain *to, int32_t dim,
                                       const double *local, double *image, double *jacobian)
{
    iccp_frame_out(&to->frame, dim, local, image);
    for (int32_t k = 0; jacobian != NULL && k < dim * dim; ++k)
        jacobian[k] *=
            (from->frame.in[0] * to->frame.out[0]) * (from->frame.in[1] * to->frame.out[1]);
}

static ICCP_INLINE void iccp_image_none(size_t dim, double *image, double *jacobian)
{
    for (size_t k = 0; k < dim; ++k)
        image[k] = NAN;
    for (size_t k = 0; jacobian != NULL && k < dim * dim; ++k)
        jacobian[k] = NAN;
}

static inline bool iccp_point_is_finite(size_t dim, const double *point)
{
    bool finite = true;
    for (size_t k = 0; k < dim; ++k)
        finite &= isfinite(point[k]) != 0;
    return finite;
}

#endif
