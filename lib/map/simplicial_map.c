#include "map/simplicial_map.h"

#include "map/dirichlet.h"
#include "math/predicates.h"

iccp_simplicial_map iccp_simplicial_map_of(const iccp_simplices *mesh, double *images)
{
    return (iccp_simplicial_map){.dim = mesh->dim,
                                 .n_points = mesh->n_points,
                                 .n_simplices = mesh->n_simplices,
                                 .corners = mesh->corners,
                                 .points = mesh->points,
                                 .images = images,
                                 .n_rim = mesh->n_boundary,
                                 .stretch = 1};
}

void iccp_simplicial_element(const iccp_simplicial_map *map, size_t simplex, double *element)
{
    const size_t dim = map->dim;
    const uint32_t *v = map->corners + (dim + 1) * simplex;
    double stretched[4][3];
    const double *corner[4];
    for (size_t k = 0; k <= dim; ++k) {
        for (size_t d = 0; d < dim; ++d)
            stretched[k][d] = map->stretch * map->points[dim * v[k] + d];
        corner[k] = stretched[k];
    }
    iccp_element_create(dim, corner, element);
}

bool iccp_simplicial_is_positive(const iccp_simplicial_map *map, size_t simplex)
{
    const double *p[4];
    if (map->dim == 2) {
        iccp_simplicial_images(2, map, simplex, p);
        return iccp_orient2d(p[0], p[1], p[2]) > 0;
    }
    iccp_simplicial_images(3, map, simplex, p);
    return iccp_orient3d(p[0], p[1], p[2], p[3]) > 0;
}

static bool has_image(const iccp_simplicial_map *map, size_t simplex)
{
    const double *p[4];
    bool is_finite = true;
    iccp_simplicial_images(map->dim, map, simplex, p);
    for (size_t k = 0; k <= map->dim; ++k)
        for (size_t d = 0; d < map->dim; ++d)
            is_finite = is_finite && isfinite(p[k][d]);
    return is_finite;
}

size_t iccp_simplicial_count_inverted(const iccp_simplicial_map *map)
{
    size_t n = 0;
    for (size_t s = 0; s < map->n_simplices; ++s)
        n += !has_image(map, s) || !iccp_simplicial_is_positive(map, s);
    return n;
}

bool iccp_simplicial_is_free(const iccp_simplicial_map *map, size_t simplex)
{
    for (size_t k = 0; k <= map->dim; ++k)
        if (!iccp_simplicial_is_fixed(map, map->corners[(map->dim + 1) * simplex + k]))
            return true;
    return false;
}

void iccp_simplicial_jacobian(const iccp_simplicial_map *map, bool inverse, size_t simplex,
                              double *jacobian)
{
    const double *points = inverse ? map->images : map->points;
    const double *images = inverse ? map->points : map->images;
    const uint32_t *v = map->corners + (map->dim + 1) * simplex;
    const double *from[4], *to[4];
    double element[ICCP_MAX_ELEMENT];
    for (size_t k = 0; k <= map->dim; ++k) {
        from[k] = points + map->dim * v[k];
        to[k] = images + map->dim * v[k];
    }
    iccp_element_create(map->dim, from, element);
    (void)iccp_element_jacobian(map->dim, element, to, jacobian);
}

double iccp_simplicial_energy(const iccp_simplicial_map *map)
{
    double sum = 0, measure = 0;
    for (size_t s = 0; s < map->n_simplices; ++s) {
        const double *image[4];
        double element[ICCP_MAX_ELEMENT];
        iccp_simplicial_images(map->dim, map, s, image);
        iccp_simplicial_element(map, s, element);
        sum += iccp_dirichlet_energy(map->dim, element, image);
        measure += element[0];
    }
    return sum / measure;
}
