/* The similarity between the caller's coordinates and the library's. See geometry/frame.h. */
#include "geometry/frame.h"

#include "base/compiler.h"
#include "base/minmax.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { STRANDS = 8 }; /* numbers of plane points that are handled at a time */

/* Shapes are not alike if their sizes differ by more than this factor, or if they lie more sizes
 * apart. */
static const double ALIKE = 16;

/* Finds bounds in the plane, in strands that run side by side. */
static void find_bounds_2d(size_t n, const double *points, double *lowest, double *highest)
{
    double low[STRANDS], high[STRANDS];
    size_t i = 0;
    for (size_t j = 0; j < STRANDS; ++j)
        low[j] = high[j] = points[j % 2];
    for (; 2 * i + STRANDS <= 2 * n; i += STRANDS / 2)
        for (size_t j = 0; j < STRANDS; ++j) {
            const double x = points[2 * i + j];
            low[j] = x < low[j] ? x : low[j];
            high[j] = x > high[j] ? x : high[j];
        }
    for (size_t j = 2 * i; j < 2 * n; ++j) {
        low[j % 2] = points[j] < low[j % 2] ? points[j] : low[j % 2];
        high[j % 2] = points[j] > high[j % 2] ? points[j] : high[j % 2];
    }
    for (size_t k = 0; k < 2; ++k) {
        lowest[k] = low[k];
        highest[k] = high[k];
        for (size_t j = k; j < STRANDS; j += 2) {
            lowest[k] = low[j] < lowest[k] ? low[j] : lowest[k];
            highest[k] = high[j] > highest[k] ? high[j] : highest[k];
        }
    }
}

static ICCP_INLINE void find_bounds(size_t dim, size_t n, const double *points, double *lowest,
                                    double *highest)
{
    double low[ICC_MAX_DIM], high[ICC_MAX_DIM];
    for (size_t k = 0; k < dim; ++k)
        low[k] = high[k] = points[k];
    for (size_t i = 1; i < n; ++i)
        for (size_t k = 0; k < dim; ++k) {
            const double x = points[dim * i + k];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    for (size_t k = 0; k < dim; ++k) {
        lowest[k] = low[k];
        highest[k] = high[k];
    }
}

void iccp_frame_bounds(int32_t dim, size_t n, const double *points, double *lowest, double *highest)
{
    if (dim == 2)
        find_bounds_2d(n, points, lowest, highest);
    else
        find_bounds((size_t)dim, n, points, lowest, highest);
}

/* Returns the coordinate that an axis is shifted by; see the lemma in the header. Doubling may
 * overflow to infinity, which compares correctly. */
static double shift_of(double lowest, double highest)
{
    if (lowest > 0 && highest <= 2 * lowest)
        return lowest;
    if (highest < 0 && lowest >= 2 * highest)
        return highest;
    return 0;
}

/* Rounding keeps the order, so the largest local magnitude belongs to a bound. */
void iccp_frame_fit(iccp_frame *frame, int32_t dim, size_t n, const double *points)
{
    double lowest[ICC_MAX_DIM], highest[ICC_MAX_DIM], largest = 0;
    *frame = iccp_frame_identity();
    iccp_frame_bounds(dim, n, points, lowest, highest);
    for (int32_t k = 0; k < dim; ++k) {
        frame->shift[k] = shift_of(lowest[k], highest[k]);
        largest = iccp_max(largest, fabs(lowest[k] - frame->shift[k]));
        largest = iccp_max(largest, fabs(highest[k] - frame->shift[k]));
    }
    int exponent = 0;
    (void)frexp(largest, &exponent);
    const int half = exponent / 2;
    frame->in[0] = ldexp(1, -half);
    frame->in[1] = ldexp(1, half - exponent);
    frame->out[0] = ldexp(1, half);
    frame->out[1] = ldexp(1, exponent - half);
}

/* Converts one coordinate to local. Returns the larger of `lost` and the magnitude that became too
 * small. */
static ICCP_INLINE double take_in(double x, double shift, const double *in, double lost,
                                  double *local)
{
    const double moved = x - shift, scaled = moved * in[0] * in[1];
    const double small = fabs(scaled) < ICCP_FRAME_SMALLEST ? fabs(moved) : 0;
    *local = scaled;
    return small > lost ? small : lost;
}

/* Without branches and in strands, so that the compiler can use vector instructions. */
bool iccp_frame_in_all(const iccp_frame *frame, size_t n, const double *points, double *local)
{
    const double in[2] = {frame->in[0], frame->in[1]};
    const double shift[2] = {frame->shift[0], frame->shift[1]};
    double lost[STRANDS] = {0};
    size_t i = 0;
    for (; i + STRANDS <= 2 * n; i += STRANDS)
        for (size_t j = 0; j < STRANDS; ++j)
            lost[j] = take_in(points[i + j], shift[j % 2], in, lost[j], &local[i + j]);
    for (; i < 2 * n; ++i)
        lost[0] = take_in(points[i], shift[i % 2], in, lost[0], &local[i]);
    for (size_t j = 0; j < STRANDS; ++j)
        if (lost[j] > 0)
            return false;
    return true;
}

/* Compares the boxes that shapes of the two frames lie in. */
static bool are_alike(const iccp_frame *from, const iccp_frame *to, int32_t dim)
{
    const double scale = from->out[0] * to->in[0] * (from->out[1] * to->in[1]);
    double corner[2][ICC_MAX_DIM], own[ICC_MAX_DIM], farthest = 0;
    for (int sign = 0; sign < 2; ++sign) {
        for (int32_t k = 0; k < dim; ++k)
            corner[sign][k] = 2 * sign - 1;
        iccp_frame_out(from, dim, corner[sign], own);
        iccp_frame_in(to, dim, own, corner[sign]);
        for (int32_t k = 0; k < dim; ++k)
            farthest = iccp_max(farthest, fabs(corner[sign][k]));
    }
    return scale >= 1 / ALIKE && farthest <= ALIKE;
}

void iccp_frame_change(const iccp_frame *from, const iccp_frame *to, int32_t dim, size_t n,
                       double *points)
{
    double own[ICC_MAX_DIM];
    if (!are_alike(from, to, dim))
        return;
    for (size_t i = 0; i < n; ++i) {
        double *const point = points + (size_t)dim * i;
        iccp_frame_out(from, dim, point, own);
        iccp_frame_in(to, dim, own, point);
    }
}

/* A number is not finite if all bits of its exponent are set. Adding one then carries into the
 * sign. */
bool iccp_all_finite(size_t n, const double *numbers)
{
    const uint64_t exponent = UINT64_C(0x7ff) << 52, one = UINT64_C(1) << 52;
    uint64_t carry = 0;
    for (size_t i = 0; i < n; ++i) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        carry |= (bits & exponent) + one;
    }
    return carry >> 63 == 0;
}

void iccp_frame_snap(const iccp_frame *frame, int32_t dim, double *local)
{
    double given[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        if (fabs(local[k]) < ICCP_FRAME_SMALLEST)
            local[k] = 0.0;
    iccp_frame_out(frame, dim, local, given);
    iccp_frame_in(frame, dim, given, local);
    for (int32_t k = 0; k < dim; ++k)
        if (fabs(local[k]) < ICCP_FRAME_SMALLEST)
            local[k] = 0.0;
}

void iccp_frame_between(const iccp_frame *frame, const double *a, const double *b, double share,
                        double *place)
{
    for (int k = 0; k < 3; ++k)
        place[k] = share <= 0.5 ? a[k] + share * (b[k] - a[k]) : b[k] + (1 - share) * (a[k] - b[k]);
    iccp_frame_snap(frame, 3, place);
}
