/* One map, or several of separate domains, in the form that files of points need. A point outside
 * the cage by no more than rounding counts as on it. */
#ifndef CARRIER_H
#define CARRIER_H

#include <icc/icc.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct carried {
    const icc_map *map;
    const icc_domain *from; /* the domain of the points that are read */
    uint32_t first_facet;   /* facet `first_facet` of the carrier and those after it are its own */
    uint32_t n_facets;      /* of `from` that count: its first ones */
    uint32_t *place;        /* NULL if the carrier has them all. Else the place of each: rim.h */
} carried;

typedef struct carrier {
    size_t n_maps, room_maps;
    carried *maps;
    const icc_env *env;
    bool inverse;
    bool flipped[2]; /* for the side of the points, and for the other: the maps' domains have y
                        reversed. The caller sets this before anything is added */
    size_t dim;
    double snap; /* a point this far outside counts as on the cage */
    double size; /* of the cage: the longest side of its box */
    double lower[ICC_MAX_DIM], upper[ICC_MAX_DIM];
    bool matched; /* both sides correspond facet by facet */
    double largest;
    size_t n_vertices, n_facets, room_vertices[2], room_facets[2], room_reversed;
    double *vertices[2]; /* of the cage and of its image */
    uint32_t *facets[2]; /* dim vertices each; facet i of one corresponds to facet i of the other */
    bool *reversed;      /* in the plane: for each facet, true if the inside of the cage is on
                            its right */
} carrier;

/* Begins to carry, backwards if `inverse` is set. Free it in any case. Then add the maps, each
 * between two domains in the order in which points go, and set how far outside still counts as on
 * the cage. Below 0 that is 1e-9 of the cage's size, and never less than the rounding of its
 * coordinates. */
void carrier_start(carrier *out, bool inverse, const icc_env *env);
icc_status carrier_add(carrier *c, const icc_map *map, const icc_domain *from,
                       const icc_domain *to);
void carrier_set_snap(carrier *c, double snap);
void carrier_free(carrier *c);

/* *out becomes true if a point lies in none of the domains. */
icc_status carrier_is_outside(const carrier *c, const double *point, bool *out);

/* Maps n points. `points` must not be `images`. `status` has n entries. `snapped` has n truth
 * values, or is NULL. */
icc_status carrier_map(const carrier *c, size_t n, const double *points, double *images,
                       icc_status *status, bool *snapped);

/* Finds the place on the cage nearest to a point: a facet, `dim` shares of its corners, and the
 * distance. The distance is infinite if rings that bound nothing are nearer. */
icc_status carrier_nearest(const carrier *c, const double *point, uint32_t *facet, double *shares,
                           double *distance);

/* The point of a facet of the cage (side 0) or of its image (side 1) with these shares of its
 * corners. */
void carrier_facet_point(const carrier *c, size_t side, uint32_t facet, const double *shares,
                         double *point);

#endif
