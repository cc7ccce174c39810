/* Interpolates between two cages with the same vertices. */
#include "cage/cage_between.h"

#include "base/allocate.h"

/* n numbers, each at a share of its way; free() them. */
static double *between(size_t n, const double *a, const double *b, double share)
{
    double *result = need(n, sizeof *result);
    for (size_t i = 0; i < n; i++)
        result[i] = a[i] + share * (b[i] - a[i]);
    return result;
}

cage cage_between(const cage *a, const cage *b, double share)
{
    cage c = {.dim = a->dim, .n = a->n, .n_features = a->n_features};
    c.points = between(a->n * a->dim, a->points, b->points, share);
    c.features = need(a->n_features, sizeof *c.features);
    for (size_t i = 0; i < a->n_features; i++) {
        const cage_feature *from = &a->features[i], *to = &b->features[i];
        c.features[i] = *from;
        c.features[i].radius = from->radius + share * (to->radius - from->radius);
        c.features[i].points = between(2 * from->n, from->points, to->points, share);
    }
    return c;
}
