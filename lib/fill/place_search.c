/* Searches for a better place of a point, as in L. Freitag and C. Ollivier-Gooch, Tetrahedral mesh
 * improvement using swapping and smoothing, 1997, but without derivatives. */
#include "fill/place_search.h"

static void try_place(const iccp_points *points, const iccp_place_measure *by, const double *x,
                      iccp_place *best)
{
    double y[3] = {x[0], x[1], x[2]};
    iccp_points_snap(points, y);
    const double worth = by->worth(by->context, y, best->worth);
    if (worth > best->worth)
        *best = (iccp_place){{y[0], y[1], y[2]}, worth};
}

void iccp_search_place(const iccp_points *points, const iccp_place_measure *by,
                       const double *middle, double nearest, iccp_place *best)
{
    const iccp_place from = *best;
    double x[3];
    for (int half = 0; half < 2; ++half) {
        for (int i = 0; i < 3; ++i)
            x[i] = from.x[i] + (half != 0 ? 0.5 : 1.0) * (middle[i] - from.x[i]);
        try_place(points, by, x, best);
    }
    for (int step = 0; step < 3; ++step) {
        const double length = 0.3 * sqrt(nearest) / (double)(1 << step);
        const iccp_place centre = *best;
        for (int d = 0; d < 14; ++d) {
            for (int i = 0; i < 3; ++i)
                x[i] = centre.x[i] + length * (d < 8 ? 0.577 * ((d >> i & 1) != 0 ? 1.0 : -1.0)
                                               : (d - 8) / 2 == i ? ((d & 1) != 0 ? 1.0 : -1.0)
                                                                  : 0.0);
            try_place(points, by, x, best);
        }
    }
}
