/* The similarity between the caller's coordinates and the library's local ones, which have a size
 * of about 1.
 *
 * Every operation on the vertices is exact. An axis is shifted only if all its coordinates have one
 * sign and lie within a factor of two of each other. Then their differences to the one nearest to
 * zero are exact (Sterbenz' lemma). The scale is a power of two, split into two factors so that
 * neither overflows for denormal shapes. So the local shape equals the caller's exactly, and each
 * is simple if and only if the other is. */
#ifndef ICCP_FRAME_H
#define ICCP_FRAME_H

#include "icc/icc.h"

#include <math.h>
#include <stdbool.h>

/* 2^-200, the smallest non-zero local magnitude for which the predicates are exact. */
#define ICCP_FRAME_SMALLEST 6.22301527786114170714e-61

typedef struct iccp_frame {
    double shift[ICC_MAX_DIM]; /* coordinate of the caller that becomes 0 */
    double in[2];              /* local = (x - shift) * in[0] * in[1] */
    double out[2];             /* x = local * out[0] * out[1] + shift; powers of two, 1 / in */
} iccp_frame;

/* Shift 0 and scale 1. */
static inline iccp_frame iccp_frame_identity(void)
{
    return (iccp_frame){.in = {1, 1}, .out = {1, 1}};
}

/* Computes the frame of n >= 1 finite points with dim coordinates each. The largest local magnitude
 * lies in [1/2, 1], unless all are 0. */
void iccp_frame_fit(iccp_frame *frame, int32_t dim, size_t n, const double *points);

/* Computes the bounding box of n >= 1 points. */
void iccp_frame_bounds(int32_t dim, size_t n, const double *points, double *lowest,
                       double *highest);

static inline void iccp_frame_in(const iccp_frame *frame, int32_t dim, const double *x,
                                 double *local)
{
    for (int32_t k = 0; k < dim; ++k)
        local[k] = (x[k] - frame->shift[k]) * frame->in[0] * frame->in[1];
}

/* Returns true if the local coordinates of a vertex are 0 or at least ICCP_FRAME_SMALLEST. If this
 * holds for all vertices, scaling loses no bit of them. */
static inline bool iccp_frame_holds(const iccp_frame *frame, int32_t dim, const double *x)
{
    for (int32_t k = 0; k < dim; ++k) {
        const double moved = x[k] - frame->shift[k];
        if (fabs(moved * frame->in[0] * frame->in[1]) < ICCP_FRAME_SMALLEST && moved != 0)
            return false;
    }
    return true;
}

/* Converts n points of the plane to local coordinates. Returns true if iccp_frame_holds() is true
 * for all. */
bool iccp_frame_in_all(const iccp_frame *frame, size_t n, const double *points, double *local);

/* Returns true if n numbers are finite. */
bool iccp_all_finite(size_t n, const double *numbers);

static inline void iccp_frame_out(const iccp_frame *frame, int32_t dim, const double *local,
                                  double *x)
{
    for (int32_t k = 0; k < dim; ++k)
        x[k] = local[k] * frame->out[0] * frame->out[1] + frame->shift[k];
}

/* Moves a local point to the nearest one that is the same after conversion to the caller's
 * coordinates and back, and that the predicates are exact for. */
void iccp_frame_snap(const iccp_frame *frame, int32_t dim, double *local);

/* Computes the place between two local points in space, at a share of the way from a to b. It is
 * exact at both ends. Between, it is snapped as iccp_frame_snap() does. */
void iccp_frame_between(const iccp_frame *frame, const double *a, const double *b, double share,
                        double *place);

/* Converts n points from the local coordinates of `from` to those of `to`. If shapes of the two
 * differ by a factor of 16 in size or lie 16 sizes apart, the difference counts as a motion of its
 * own: the points keep their local coordinates. */
void iccp_frame_change(const iccp_frame *from, const iccp_frame *to, int32_t dim, size_t n,
                       double *points);

/* Converts a vertex back, bit for bit. The conversion alone would lose only the sign of a zero. */
static inline void iccp_frame_restore(const iccp_frame *frame, int32_t dim, const double *local,
                                      double *x)
{
    iccp_frame_out(frame, dim, local, x);
    for (int32_t k = 0; k < dim; ++k)
        if (x[k] == 0)
            x[k] = copysign(0, local[k]);
}

#endif
