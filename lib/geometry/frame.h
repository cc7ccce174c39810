/* The similarity between the caller's coordinates and the library's, which are of size about 1.
 *
 * Every operation on the vertices is exact. An axis is shifted only when all its coordinates have
 * one sign and lie within a factor of two of each other: the differences to the one nearest to zero
 * are then exact (Sterbenz' lemma). The scale is a power of two, as two factors so that neither
 * overflows when the shape is denormal. So the local shape is the caller's, exactly, and what is
 * exactly simple here is exactly simple there. */
#ifndef ICCP_FRAME_H
#define ICCP_FRAME_H

#include "icc/icc.h"

#include <math.h>
#include <stdbool.h>

/* 2^-200, the smallest local magnitude but zero that the exact predicates promise to work with. */
#define ICCP_FRAME_SMALLEST 6.22301527786114170714e-61

typedef struct iccp_frame {
    double shift[ICC_MAX_DIM]; /* caller's coordinate that becomes 0 */
    double in[2];              /* local = (x - shift) * in[0] * in[1] */
    double out[2];             /* x = local * out[0] * out[1] + shift; powers of two, 1 / in */
} iccp_frame;

/* Shift 0, scale 1. */
extern const iccp_frame iccp_frame_identity;

/* The frame of finite points: n of them, dim coordinates each; n >= 1. The largest local magnitude
 * lies in [1/2, 1], or all are 0. */
void iccp_frame_fit(iccp_frame *frame, int32_t dim, size_t n, const double *points);

/* The bounding box of n points; n >= 1. */
void iccp_frame_bounds(int32_t dim, size_t n, const double *points, double *lowest,
                       double *highest);

static inline void iccp_frame_in(const iccp_frame *frame, int32_t dim, const double *x,
                                 double *local)
{
    for (int32_t k = 0; k < dim; ++k)
        local[k] = (x[k] - frame->shift[k]) * frame->in[0] * frame->in[1];
}

/* Whether the local coordinates of a vertex are 0 or at least ICCP_FRAME_SMALLEST. If so for all
 * vertices, the scaling loses no bit of them. */
static inline bool iccp_frame_holds(const iccp_frame *frame, int32_t dim, const double *x)
{
    for (int32_t k = 0; k < dim; ++k) {
        const double moved = x[k] - frame->shift[k];
        if (fabs(moved * frame->in[0] * frame->in[1]) < ICCP_FRAME_SMALLEST && moved != 0)
            return false;
    }
    return true;
}

/* Both for n points of the plane; whether all are so. */
bool iccp_frame_in_all(const iccp_frame *frame, size_t n, const double *points, double *local);

/* Whether n numbers are finite. */
bool iccp_all_finite(size_t n, const double *numbers);

static inline void iccp_frame_out(const iccp_frame *frame, int32_t dim, const double *local,
                                  double *x)
{
    for (int32_t k = 0; k < dim; ++k)
        x[k] = local[k] * frame->out[0] * frame->out[1] + frame->shift[k];
}

/* n points in the local coordinates of `from` become those in `to`. Where shapes of the two are not
 * alike in size and place (16 times as large or small, or 16 sizes away), what they have in common
 * is taken for a motion of its own: the points keep their local coordinates. */
void iccp_frame_change(const iccp_frame *from, const iccp_frame *to, int32_t dim, size_t n,
                       double *points);

/* The same bit for bit, for a vertex: what the way out loses is the sign of a zero. */
static inline void iccp_frame_restore(const iccp_frame *frame, int32_t dim, const double *local,
                                      double *x)
{
    iccp_frame_out(frame, dim, local, x);
    for (int32_t k = 0; k < dim; ++k)
        if (x[k] == 0)
            x[k] = copysign(0, local[k]);
}

#endif
