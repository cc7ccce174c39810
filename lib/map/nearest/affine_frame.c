/* The affine map that is nearest to a plane map, for its boundary. */
#include "map/nearest/affine_frame.h"

#include "geometry/frame.h"

#include <string.h>

/* Sums over triangles. */
typedef struct sums {
    double area, j[4];
    double middle[2][2]; /* area times the centroid, before and after the map */
} sums;

static sums add_up(const iccp_plmap *map, bool positive_only)
{
    iccp_simplicial_map s = iccp_plmap_simplicial(map);
    sums sum = {0};
    s.stretch = 1;
    for (size_t t = 0; t < s.n_simplices; ++t) {
        double element[ICCP_ELEMENT(2)], j[4];
        const double *image[3];
        iccp_simplicial_element(&s, t, element);
        iccp_simplicial_images(2, &s, t, image);
        if (!(iccp_element_jacobian(2, element, image, j) > 0) && positive_only)
            continue;
        sum.area += element[0];
        for (int i = 0; i < 4; ++i)
            sum.j[i] += element[0] * j[i];
        for (size_t k = 0; k < 3; ++k)
            for (size_t d = 0; d < 2; ++d) {
                const double *point = s.points + 2 * (size_t)s.corners[3 * t + k];
                sum.middle[0][d] += element[0] * point[d] / 3;
                sum.middle[1][d] += element[0] * image[k][d] / 3;
            }
    }
    return sum;
}

iccp_affine_frame iccp_affine_frame_find(const iccp_plmap *map)
{
    iccp_affine_frame frame = {{1, 0, 0, 1}, {0, 0}};
    sums s = add_up(map, false);
    if (!(s.j[0] * s.j[3] - s.j[1] * s.j[2] > 0))
        s = add_up(map, true);
    if (!(s.j[0] * s.j[3] - s.j[1] * s.j[2] > 0))
        return frame;
    for (int i = 0; i < 4; ++i)
        frame.j[i] = s.j[i] / s.area;
    for (int d = 0; d < 2; ++d)
        frame.shift[d] = (s.middle[1][d] - frame.j[2 * d] * s.middle[0][0] -
                          frame.j[2 * d + 1] * s.middle[0][1]) /
                         s.area;
    return frame;
}

void iccp_affine_frame_set(const iccp_affine_frame *frame, double scale, iccp_plmap *map)
{
    double low[2], high[2], middle[2];
    iccp_frame_bounds(2, map->n_vertices, map->points, low, high);
    for (int d = 0; d < 2; ++d)
        middle[d] = 0.5 * low[d] + 0.5 * high[d];
    for (size_t v = 0; v < map->n_vertices; ++v) {
        const double *p = map->points + 2 * v, x = middle[0] + scale * (p[0] - middle[0]),
                     y = middle[1] + scale * (p[1] - middle[1]);
        if (map->fixed[v] == ICCP_FREE || map->fixed[v] == ICCP_ON_POINT)
            continue;
        for (size_t d = 0; d < 2; ++d)
            map->images[2 * v + d] =
                frame->j[2 * d] * x + frame->j[2 * d + 1] * y + frame->shift[d];
    }
}
