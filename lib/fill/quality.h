/* Measures the shape of tetrahedra. */
#ifndef ICCP_QUALITY_H
#define ICCP_QUALITY_H

#include "fill/tets.h"

static inline double iccp_square_distance(const double *a, const double *b)
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/* Compares the volume with the edges. Returns 1 for a regular tetrahedron and 0 for a flat one,
 * with the sign of the volume. */
static inline double iccp_tet_quality(const double *a, const double *b, const double *c,
                                      const double *d)
{
    const double volume = iccp_points_volume(a, b, c, d);
    const double edges = iccp_square_distance(a, b) + iccp_square_distance(a, c) +
                         iccp_square_distance(a, d) + iccp_square_distance(b, c) +
                         iccp_square_distance(b, d) + iccp_square_distance(c, d);
    const double cube = edges * edges * edges;
    return cube > 0.0 ? 432.0 * volume * fabs(volume) / cube : 0.0;
}

/* Returns the square of the least sine of a tetrahedron's dihedral angles, or 0 if it is not
 * positive. */
double iccp_square_sine(const double *a, const double *b, const double *c, const double *d);

/* Returns the quality of a tetrahedron in the mesh's metric. */
static inline double iccp_metric_quality(const iccp_tets *m, const uint32_t corner[4])
{
    double x[4][3];
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k)
            x[i][k] = iccp_point(&m->points, corner[i])[k] - iccp_point(&m->points, corner[0])[k];
        iccp_metric_apply(m->metric.in, x[i]);
    }
    return iccp_tet_quality(x[0], x[1], x[2], x[3]);
}

/* Returns the quality of a tetrahedron by the measure of the present stage. */
static inline double iccp_tets_quality(const iccp_tets *m, uint32_t a, uint32_t b, uint32_t c,
                                       uint32_t d)
{
    const iccp_points *const p = &m->points;
    if (m->metric.on)
        return iccp_metric_quality(m, (const uint32_t[4]){a, b, c, d});
    if (m->by_angle)
        return iccp_square_sine(iccp_point(p, a), iccp_point(p, b), iccp_point(p, c),
                                iccp_point(p, d));
    return iccp_tet_quality(iccp_point(p, a), iccp_point(p, b), iccp_point(p, c), iccp_point(p, d));
}

static inline double iccp_quality_of(const iccp_tets *m, uint32_t t)
{
    const uint32_t *const v = m->tet[t].v;
    return iccp_tets_quality(m, v[0], v[1], v[2], v[3]);
}

#endif
