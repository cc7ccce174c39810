#include "domain/frame.h"

#include "base/compiler.h"
#include "base/minmax.h"

#include <math.h>

const iccp_frame iccp_frame_identity = {{0}, {1, 1}, {1, 1}};

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
        find_bounds(2, n, points, lowest, highest);
    else
        find_bounds((size_t)dim, n, points, lowest, highest);
}

/* The coordinate that an axis is shifted by; see the lemma in the header. The doubling overflows to
 * infinity at worst, which compares as it should. */
static double shift_of(double lowest, double highest)
{
    if (lowest > 0 && highest <= 2 * lowest)
        return lowest;
    if (highest < 0 && lowest >= 2 * highest)
        return highest;
    return 0;
}

/* Rounding keeps the order, so the largest magnitude is that of a bound. */
void iccp_frame_fit(iccp_frame *frame, int32_t dim, size_t n, const double *points)
{
    double lowest[ICC_MAX_DIM], highest[ICC_MAX_DIM], largest = 0;
    *frame = iccp_frame_identity;
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
