/* A map as files of points need it, or several of domains that lie apart: what lies outside the cage
 * by no more than rounding is taken to be on it. */
#ifndef CARRIER_H
#define CARRIER_H

#include <icc/icc.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct carried {
    const icc_map *map;
    const icc_domain *from; /* the side that points are read on */
    uint32_t first_facet;   /* its first n_facets facets are these of the carrier and the next */
    uint32_t n_facets;
} carried;

typedef struct carrier {
    size_t n_maps, room_maps;
    carried *maps;
    const icc_env *env;
    bool inverse;
    bool flipped[2]; /* for the side of the points, and for the other: the maps' domains have y
                     * reversed; set by the caller before anything is added */
    size_t dim;
    double snap; /* how far outside counts as on the cage */
    double size; /* of the cage: the longest side of its box */
    double lower[ICC_MAX_DIM], upper[ICC_MAX_DIM];
    bool matched; /* facet by facet */
    double largest;
    size_t n_vertices, n_facets, room_vertices[2], room_facets[2], room_reversed, room_holes;
    double *vertices[2]; /* of the cage and of its image */
    uint32_t *facets[2]; /* dim vertices each; facet i of one corresponds to facet i of the other */
    bool *reversed;      /* in the plane: which facets of the cage have its inside on their right */
    size_t n_holes;
    double *in_holes; /* a point in each */
} carrier;

/* Which rings of a domain bound what can be carried: all, not its holes, or none, since others fill
 * them or surround it. */
enum { CARRIER_ALL = 1, CARRIER_OUTER, CARRIER_NONE };

/* Begins to carry; back if `inverse` says so. To be freed in any case. Then come the maps between
 * two domains, which are given in the order in which points go, and how far outside still counts:
 * below 0 1e-9 of the cage's size, and no less than what rounding does to its coordinates. */
void carrier_start(carrier *out, bool inverse, const icc_env *env);
icc_status carrier_add(carrier *c, const icc_map *map, const icc_domain *from, const icc_domain *to,
                       int32_t rings);
void carrier_set_snap(carrier *c, double snap);
void carrier_free(carrier *c);

/* Whether a point lies in none of the domains. */
icc_status carrier_is_outside(const carrier *c, const double *point, bool *out);

/* Maps n points, which may not be the images. Status: n of them. Snapped: n truth values, or
 * NULL. */
icc_status carrier_map(const carrier *c, size_t n, const double *points, double *images,
                       icc_status *status, bool *snapped);

/* The place on the cage nearest to a point: a facet, `dim` shares of its corners, and how far
 * off. Infinitely far where rings that bound nothing are nearer. */
icc_status carrier_nearest(const carrier *c, const double *point, uint32_t *facet, double *shares,
                           double *distance);

/* The point of a facet of the cage (side 0) or of its image (side 1) with these shares of its
 * corners. */
void carrier_facet_point(const carrier *c, size_t side, uint32_t facet, const double *shares,
                         double *point);

#endif
