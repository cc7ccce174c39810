/* How good the triangles are that a change of a plane map's mesh would make. */
#ifndef ICCP_TRIANGLE_QUALITY_H
#define ICCP_TRIANGLE_QUALITY_H

#include "base/minmax.h"
#include "map/compatible/plmap.h"
#include "map/energy/dirichlet.h"
#include "math/predicates.h"
#include "math/vec.h"

/* Twice the area over the square of the longest edge: 0.87 for an equilateral triangle, 0 for a
 * flat one, negative for an inverted one. */
static inline double iccp_roundness(const double *a, const double *b, const double *c)
{
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return twice / iccp_max(iccp_vec_distance2(2, a, b),
                            iccp_max(iccp_vec_distance2(2, b, c), iccp_vec_distance2(2, c, a)));
}

/* Sums over some triangles. Begin with iccp_no_quality(). */
typedef struct iccp_quality {
    double energy;    /* the sum of their symmetric Dirichlet energies */
    double area;      /* the sum of their stretched areas before the map */
    double roundness; /* the least one, before and after the map */
} iccp_quality;

static inline iccp_quality iccp_no_quality(void)
{
    return (iccp_quality){.roundness = HUGE_VAL};
}

/* Whether the triangle of three vertices of the map is positive before and after it, exactly. */
static inline bool iccp_quality_is_positive(const iccp_plmap *map, uint32_t a, uint32_t b,
                                            uint32_t c)
{
    const double *p = map->points, *q = map->images;
    const size_t i = 2 * (size_t)a, j = 2 * (size_t)b, k = 2 * (size_t)c;
    return iccp_orient2d(p + i, p + j, p + k) > 0 && iccp_orient2d(q + i, q + j, q + k) > 0;
}

/* Adds the triangle of three vertices of the map. */
static inline void iccp_quality_add(iccp_quality *quality, const iccp_plmap *map, uint32_t a,
                                    uint32_t b, uint32_t c)
{
    const uint32_t vertices[3] = {a, b, c};
    const double *point[3], *image[3], *stretched[3];
    double room[3][2], element[ICCP_ELEMENT(2)];
    for (size_t k = 0; k < 3; ++k) {
        point[k] = map->points + 2 * (size_t)vertices[k];
        image[k] = map->images + 2 * (size_t)vertices[k];
        for (size_t d = 0; d < 2; ++d)
            room[k][d] = map->stretch * point[k][d];
        stretched[k] = room[k];
    }
    iccp_element_fill(2, stretched, element);
    quality->energy += iccp_dirichlet_energy2(element, image);
    quality->area += element[0];
    quality->roundness =
        iccp_min(quality->roundness, iccp_min(iccp_roundness(point[0], point[1], point[2]),
                                              iccp_roundness(image[0], image[1], image[2])));
}

/* Whether doubles find area and a finite energy in a triangle of three vertices, for the map and
 * for its inverse. */
static inline bool iccp_quality_is_sound(const iccp_plmap *map, uint32_t a, uint32_t b, uint32_t c)
{
    iccp_plmap inverse = *map;
    iccp_quality there = iccp_no_quality(), back = there;
    iccp_plmap_swap(&inverse);
    iccp_quality_add(&there, map, a, b, c);
    iccp_quality_add(&back, &inverse, a, b, c);
    return there.area > 0 && there.energy < HUGE_VAL && back.area > 0 && back.energy < HUGE_VAL;
}

#endif
