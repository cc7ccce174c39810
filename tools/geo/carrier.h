/* A map as files of points need it: what lies outside the cage by no more than rounding is taken to
 * be on it. */
#ifndef CARRIER_H
#define CARRIER_H

#include <icc/icc.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct carrier {
    const icc_map *map;
    const icc_domain *from; /* the side that points are read on */
    const icc_env *env;
    bool inverse;
    size_t dim;
    double snap; /* how far outside counts as on the cage */
    double size; /* of the cage: the longest side of its box */
    double lower[ICC_MAX_DIM], upper[ICC_MAX_DIM];
    size_t n_vertices, n_facets;
    double *vertices[2]; /* of the cage and of its image */
    uint32_t *facets[2]; /* dim vertices each; facet i of one corresponds to facet i of the other */
    bool *reversed;      /* in the plane: which facets of the cage have its inside on their right */
    size_t n_holes;
    double *in_holes; /* a point in each */
} carrier;

/* Begins to carry between two domains, from the first; back if `inverse` says that the map goes
 * from the second. snap < 0: 1e-9 of the cage's size, and no less than what rounding does to its
 * coordinates. To be freed in any case. */
icc_status carrier_start(carrier *out, const icc_map *map, const icc_domain *from,
                         const icc_domain *to, bool inverse, double snap, const icc_env *env);
void carrier_free(carrier *c);

/* Maps n points, which may not be the images. Status: n of them. Snapped: n truth values, or
 * NULL. */
icc_status carrier_map(const carrier *c, size_t n, const double *points, double *images,
                       icc_status *status, bool *snapped);

/* The place on the cage nearest to a point: a facet, `dim` shares of its corners, and how far
 * off. */
icc_status carrier_nearest(const carrier *c, const double *point, uint32_t *facet, double *shares,
                           double *distance);

/* The point of a facet of the cage (side 0) or of its image (side 1) with these shares of its
 * corners. */
void carrier_facet_point(const carrier *c, size_t side, uint32_t facet, const double *shares,
                         double *point);

#endif
