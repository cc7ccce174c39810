#include "map/candidate.h"

#include "map/dirichlet.h"
#include "math/predicates.h"

bool iccp_candidate_is_positive(const iccp_plmap *map, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = map->points, *q = map->images;
    const size_t i = 2 * (size_t)a, j = 2 * (size_t)b, k = 2 * (size_t)c;
    return iccp_orient2d(p + i, p + j, p + k) > 0 && iccp_orient2d(q + i, q + j, q + k) > 0;
}

void iccp_candidate_add(iccp_candidate *candidate, const iccp_plmap *map, uint32_t a, uint32_t b,
                        uint32_t c)
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
    iccp_element_create(2, stretched, element);
    candidate->energy += iccp_dirichlet_energy(2, element, image);
    candidate->area += element[0];
    candidate->roundness =
        iccp_min(candidate->roundness, iccp_min(iccp_roundness(point[0], point[1], point[2]),
                                                iccp_roundness(image[0], image[1], image[2])));
}
