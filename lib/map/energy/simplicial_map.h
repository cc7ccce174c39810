/* A map that is linear in every simplex of a mesh in the plane or in space: what energies,
 * untangling and improvement see of it. */
#ifndef ICCP_SIMPLICIAL_MAP_H
#define ICCP_SIMPLICIAL_MAP_H

#include "base/env.h"
#include "geometry/simplices.h"
#include "map/energy/jacobian.h"

/* All arrays are borrowed. */
typedef struct iccp_simplicial_map {
    size_t dim; /* 2 or 3 */
    size_t n_points, n_simplices;
    const uint32_t *corners; /* dim + 1 points of each simplex, which is positive before the map */
    const double *points;    /* dim of each */
    double *images;          /* dim of each */
    size_t n_fixed;          /* the images of the first points are fixed, */
    const uint8_t *fixed;    /* and of those with fixed[v] != 0, unless this is NULL */
    const struct iccp_newton_plan *plan; /* for a map of the same mesh (energy/newton.h), or NULL */
    double stretch; /* lengths before the map are multiplied by this for energies, so that the areas
                       or volumes are the same and energies are those of shape alone */
    const double *growth; /* and by the mean of these for the corners of a simplex, unless NULL */
} iccp_simplicial_map;

/* The map of a mesh without a stretch. */
iccp_simplicial_map iccp_simplicial_map_of(const iccp_simplices *mesh, double *images);

static inline bool iccp_simplicial_is_fixed(const iccp_simplicial_map *map, uint32_t point)
{
    return point < map->n_fixed || (map->fixed != NULL && map->fixed[point]);
}

static ICCP_INLINE void iccp_simplicial_images(size_t dim, const iccp_simplicial_map *map,
                                               size_t simplex, const double **image)
{
    for (size_t k = 0; k <= dim; ++k)
        image[k] = map->images + dim * map->corners[(dim + 1) * simplex + k];
}

/* Makes coordinates 0 that are next to nothing beside the largest, which is about 1, so that there
 * is room for exact signs. */
void iccp_simplicial_round(size_t n, double *coordinates);

/* Of a simplex before the map, stretched. */
void iccp_simplicial_element(const iccp_simplicial_map *map, size_t simplex, double *element);

/* Whether the image of a simplex is positive, exactly; and how many are not, or have none: numbers
 * that are not finite. */
bool iccp_simplicial_is_positive(const iccp_simplicial_map *map, size_t simplex);
size_t iccp_simplicial_count_inverted(const iccp_simplicial_map *map);
size_t iccp_simplicial_count_at_once(const iccp_simplicial_map *map, const iccp_env *env);

/* Whether the image of a corner is not fixed. */
bool iccp_simplicial_is_free(const iccp_simplicial_map *map, size_t simplex);

/* Whether the image of a simplex whose corners are all fixed is not positive: no repair can help
 * it. Only the images of fixed points are looked at. */
bool iccp_simplicial_is_hopeless(const iccp_simplicial_map *map);

/* Of one simplex, forward or back; row by row. */
void iccp_simplicial_jacobian(const iccp_simplicial_map *map, bool inverse, size_t simplex,
                              double *jacobian);

/* Mean of the symmetric Dirichlet energy over the stretched area or volume: 2 dim for an isometry,
 * infinite when a simplex is not positive. */
double iccp_simplicial_energy(const iccp_simplicial_map *map);

/* The same on all threads of `env`, and the same bits; so is the count above. */
double iccp_simplicial_energy_at_once(const iccp_simplicial_map *map, const iccp_env *env);

#endif
