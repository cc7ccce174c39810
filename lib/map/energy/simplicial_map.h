/* A map that is linear in every simplex of a mesh. Energies, untangling and improvement work on
 * this view of a map. The functions of this file work in any dimension, unless they say otherwise;
 * the other files of this folder do in the plane and in space (map/higher continues). */
#ifndef ICCP_SIMPLICIAL_MAP_H
#define ICCP_SIMPLICIAL_MAP_H

#include "base/env.h"
#include "geometry/simplices.h"
#include "map/energy/jacobian.h"

/* All arrays are borrowed. */
typedef struct iccp_simplicial_map {
    size_t dim;
    size_t n_points, n_simplices;
    const uint32_t *corners; /* dim + 1 points of each simplex, which is positive before the map */
    const double *points;    /* dim of each */
    double *images;          /* dim of each */
    size_t n_fixed;          /* the images of the first n_fixed points are fixed, */
    const uint8_t *fixed;    /* and those with fixed[v] != 0, unless `fixed` is NULL */
    const struct iccp_newton_plan *plan; /* for a map of the same mesh (energy/newton.h), or NULL */
    double stretch;       /* factor for lengths before the map in energies. It makes both areas or
                       volumes equal, so that energies measure shape alone */
    const double *growth; /* a further factor for each simplex: the mean of this over its
                             corners, unless NULL */
    const double *model;  /* dim of each point: the images of a model that the map shall stay near,
                            or NULL */
    double pull;          /* how strongly the model attracts the map in Newton's steps (model.h) */
    const double *rail; /* in the plane, 2 of each point: the unit vector along which Newton's steps
                             move its image, or 0 0 if they move it freely; NULL: all are free */
} iccp_simplicial_map;

/* Returns the map of a mesh, with a stretch of 1. */
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

/* Sets coordinates to 0 that are tiny beside the largest one, which is about 1. Exact signs can
 * then be computed. */
void iccp_simplicial_round(size_t n, double *coordinates);

/* Computes the element of a simplex before the map, stretched. Up to 3-D. */
void iccp_simplicial_element(const iccp_simplicial_map *map, size_t simplex, double *element);

/* Returns true if the image of a simplex is positive, exactly. The second function counts the
 * simplices whose image is not positive or not finite. */
bool iccp_simplicial_is_positive(const iccp_simplicial_map *map, size_t simplex);
size_t iccp_simplicial_count_inverted(const iccp_simplicial_map *map);
size_t iccp_simplicial_count_at_once(const iccp_simplicial_map *map, const iccp_env *env);

/* Returns true if some corner of the simplex has a free image. */
bool iccp_simplicial_is_free(const iccp_simplicial_map *map, size_t simplex);

/* Returns true if a simplex with only fixed corners has an image that is not positive, which no
 * repair can mend. Only the images of fixed points are read. */
bool iccp_simplicial_is_hopeless(const iccp_simplicial_map *map);

/* The Jacobian of one simplex or of its inverse, row by row. */
void iccp_simplicial_jacobian(const iccp_simplicial_map *map, bool inverse, size_t simplex,
                              double *jacobian);

/* The mean of the symmetric Dirichlet energy over the stretched area or volume. It is 2 dim for an
 * isometry, and infinite if a simplex is not positive. */
double iccp_simplicial_energy(const iccp_simplicial_map *map);

/* Computes the energy on all threads of `env`, with the same bits. */
double iccp_simplicial_energy_at_once(const iccp_simplicial_map *map, const iccp_env *env);

#endif
