/* Finds the smallest hole that contains a polygon. */
#include "job/nesting.h"

#include "base/orientation.h"
#include "cage/cage_features.h"
#include "geo/clip_rings.h"

#include <math.h>

const cage *cage_polygon(const cage *c, size_t i)
{
    return i == 0 ? c : &c->more[i - 1];
}

bool ring_holds(size_t n, const double *ring, const double *point)
{
    bool odd = false;
    for (size_t i = 0; i < n; i++) {
        const double *a = ring + 2 * i, *b = ring + 2 * ((i + 1) % n);
        if ((a[1] > point[1]) != (b[1] > point[1]))
            odd ^= orientation(a, b, point) * (b[1] > a[1] ? 1 : -1) > 0;
    }
    return odd;
}

cage_hole nesting_of(const cage *c, size_t i)
{
    cage_hole found = {NO_HOLE, NO_HOLE};
    double smallest = HUGE_VAL;
    for (size_t k = 0; k <= c->n_more; k++) {
        const cage *other = cage_polygon(c, k);
        size_t n_holes = cage_count(other, ICC_FEATURE_HOLE);
        for (size_t h = 0; h < n_holes && k != i; h++) {
            const cage_feature *hole = &other->features[h];
            double area = fabs(ring_area(hole->n, hole->points, 2));
            if (area < smallest && ring_holds(hole->n, hole->points, cage_polygon(c, i)->points)) {
                found = (cage_hole){k, h};
                smallest = area;
            }
        }
    }
    return found;
}
