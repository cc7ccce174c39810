/* Recognises outlines whose vertices correspond already, for example those of an earlier match.
 * Then the order of the vertices replaces the pairing by shape. d01 to d03 with their own
 * vertices need this, because the pairing by shape joins only most of them. */
#include "match/outline/one_to_one.h"

#include <math.h>

#define NONE UINT32_MAX

/* Finds the shift of vertex numbers that more than half of the joins have, if there is one (R.
 * Boyer and J. Moore, MJRTY - a fast majority vote algorithm, 1991). */
static uint32_t majority(const iccp_union_outline *common, uint32_t n)
{
    uint32_t shift = 0;
    size_t votes = 0;
    for (size_t k = 0; k < common->n; ++k) {
        const uint32_t i = common->vertex[2 * k], j = common->vertex[2 * k + 1];
        if (i == NONE || j == NONE)
            continue;
        const uint32_t here = (j + n - i) % n;
        shift = votes == 0 ? here : shift;
        votes = here == shift ? votes + 1 : votes - 1;
    }
    return shift;
}

/* Returns true if half of the vertices are joined and three quarters of these joins have the
 * shift. */
static bool is_common(const iccp_union_outline *common, uint32_t n, uint32_t shift)
{
    size_t n_alike = 0;
    for (size_t k = 0; k < common->n; ++k) {
        const uint32_t i = common->vertex[2 * k], j = common->vertex[2 * k + 1];
        n_alike += i != NONE && j != NONE && (j + n - i) % n == shift;
    }
    return 2 * common->n_joined >= n && 4 * n_alike >= 3 * common->n_joined;
}

/* Returns true if all vertices joined by a landmark have this shift, so that landmarks are kept. */
static bool has_landmarks(const iccp_outline *source, const iccp_outline *target, uint32_t shift,
                          size_t n_landmarks, const double *landmarks)
{
    const iccp_outline *const outlines[2] = {source, target};
    const size_t n = source->n;
    for (size_t k = 0; k < n_landmarks; ++k) {
        size_t vertex[2];
        for (int e = 0; e < 2; ++e) {
            double along;
            const size_t edge =
                iccp_outline_edge(outlines[e], landmarks[2 * k + (size_t)e], &along);
            if (along > 1e-9 && along < 1 - 1e-9)
                return false;
            vertex[e] = along < 0.5 ? edge : (edge + 1) % n;
        }
        if ((vertex[0] + shift) % n != vertex[1])
            return false;
    }
    return true;
}

void iccp_one_to_one(iccp_union_outline *common, const iccp_outline *source,
                     const iccp_outline *target, size_t n_landmarks, const double *landmarks)
{
    const uint32_t n = (uint32_t)source->n;
    if (source->n != target->n)
        return;
    const uint32_t shift = majority(common, n);
    if (!is_common(common, n, shift) ||
        !has_landmarks(source, target, shift, n_landmarks, landmarks))
        return;
    double least = HUGE_VAL, most = 0;
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t j = (i + shift) % n;
        const double slope =
            (target->share[j + 1] - target->share[j]) / (source->share[i + 1] - source->share[i]);
        least = slope < least ? slope : least;
        most = slope > most ? slope : most;
    }
    if (least < 1 / ICCP_MOST_SLOPE || most > ICCP_MOST_SLOPE)
        return;
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t j = (i + shift) % n;
        common->vertex[2 * i] = i;
        common->vertex[2 * i + 1] = j;
        common->share[2 * i] = source->share[i];
        common->share[2 * i + 1] = target->share[j] + (j < shift ? 1 : 0);
    }
    common->n = common->n_joined = n;
    common->least = least;
    common->most = most;
}
