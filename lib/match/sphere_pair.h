/* Two surfaces in space, drawn on one sphere and moved on one another. */
#ifndef ICCP_SPHERE_PAIR_H
#define ICCP_SPHERE_PAIR_H

#include "domain/domain.h"
#include "match/sphere/split_surface.h"

typedef struct iccp_body {
    const icc_domain *domain;
    iccp_half_edges m; /* faces counter-clockwise from outside */
    const double *x;   /* local coordinates, of `split` if that is there */
    double *directions;
    iccp_split_surface split; /* with landmarks: behind the given vertices there are others */
    uint32_t *landmarks;      /* vertices */
} iccp_body;

/* Bodies, which are empty before, of two domains of dimension 3 without meshes, which are borrowed.
 * In any case they are to be freed. */
icc_status iccp_sphere_pair_create(iccp_body bodies[2], const icc_domain *source,
                                   const icc_domain *target, const iccp_env *env, icc_error *err);

/* Draws them; landmarks, 6 numbers each (source, target) in the caller's coordinates, come to the
 * same places. */
icc_status iccp_sphere_pair_draw(iccp_body bodies[2], size_t n_landmarks, const double *landmarks,
                                 const iccp_env *env, icc_error *err);

void iccp_sphere_pair_free(iccp_body bodies[2], const iccp_memory *memory);

#endif
