/* Triangles that a change of the mesh of a piecewise linear map would make. */
#ifndef ICCP_CANDIDATE_H
#define ICCP_CANDIDATE_H

#include "base/minmax.h"
#include "map/plmap.h"
#include "math/vec.h"

/* Twice the area over the square of the longest edge: 0.87 for an equilateral triangle, 0 for a
 * flat one, negative for an inverted one. */
static inline double iccp_roundness(const double *a, const double *b, const double *c)
{
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return twice / iccp_max(iccp_vec_distance2(2, a, b),
                            iccp_max(iccp_vec_distance2(2, b, c), iccp_vec_distance2(2, c, a)));
}

/* Of some triangles; begins as iccp_no_candidate(). */
typedef struct iccp_candidate {
    double energy;    /* the sum of their symmetric Dirichlet energies */
    double area;      /* and of their stretched areas before the map */
    double roundness; /* the least one, before and after the map */
} iccp_candidate;

static inline iccp_candidate iccp_no_candidate(void)
{
    return (iccp_candidate){.roundness = HUGE_VAL};
}

/* Whether the triangle of three vertices of the map is positive before and after it, exactly. */
bool iccp_candidate_is_positive(const iccp_plmap *map, uint32_t a, uint32_t b, uint32_t c);

/* Adds the triangle of three vertices of the map. */
void iccp_candidate_add(iccp_candidate *candidate, const iccp_plmap *map, uint32_t a, uint32_t b,
                        uint32_t c);

#endif
