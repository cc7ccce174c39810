#include "domain/frame.h"

#include <math.h>

const iccp_frame iccp_frame_identity = {{0}, {1, 1}, {1, 1}};

/* The coordinate that axis k is shifted by; see the lemma in the header. The doubling overflows to
 * infinity at worst, which compares as it should. */
static double axis_shift(int32_t dim, int32_t k, size_t n, const double *points)
{
    double lowest = points[k], highest = points[k];
    for (size_t i = 1; i < n; ++i) {
        const double x = points[i * (size_t)dim + (size_t)k];
        lowest = x < lowest ? x : lowest;
        highest = x > highest ? x : highest;
    }
    if (lowest > 0 && highest <= 2 * lowest)
        return lowest;
    if (highest < 0 && lowest >= 2 * highest)
        return highest;
    return 0;
}

void iccp_frame_fit(iccp_frame *frame, int32_t dim, size_t n, const double *points)
{
    *frame = iccp_frame_identity;
    for (int32_t k = 0; k < dim; ++k)
        frame->shift[k] = axis_shift(dim, k, n, points);
    double largest = 0;
    for (size_t i = 0; i < n * (size_t)dim; ++i) {
        const double x = fabs(points[i] - frame->shift[i % (size_t)dim]);
        largest = x > largest ? x : largest;
    }
    int exponent = 0;
    (void)frexp(largest, &exponent);
    const int half = exponent / 2;
    frame->in[0] = ldexp(1, -half);
    frame->in[1] = ldexp(1, half - exponent);
    frame->out[0] = ldexp(1, half);
    frame->out[1] = ldexp(1, exponent - half);
}

bool iccp_frame_holds(const iccp_frame *frame, int32_t dim, const double *x)
{
    double local[ICC_MAX_DIM];
    iccp_frame_in(frame, dim, x, local);
    for (int32_t k = 0; k < dim; ++k)
        if (fabs(local[k]) < ICCP_FRAME_SMALLEST && x[k] - frame->shift[k] != 0)
            return false;
    return true;
}
