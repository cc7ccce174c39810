/* Draws two surfaces in space on one sphere, and moves the drawings on each other. */
#ifndef ICCP_SPHERE_PAIR_H
#define ICCP_SPHERE_PAIR_H

#include "domain/domain.h"
#include "match/sphere/split_surface.h"

typedef struct iccp_body {
    const icc_domain *domain;
    iccp_half_edges m; /* faces counter-clockwise from outside */
    const double *x;   /* local coordinates; those of `split` if it exists */
    double *directions;
    iccp_split_surface split; /* with landmarks: new vertices follow the given ones */
    uint32_t *landmarks;      /* vertices */
} iccp_body;

/* Makes bodies from two domains of dimension 3 without meshes, which are borrowed. The bodies must
 * be empty. Free them in any case. */
icc_status iccp_sphere_pair_create(iccp_body bodies[2], const icc_domain *source,
                                   const icc_domain *target, const iccp_env *env, icc_error *err);

/* Draws the bodies. Each landmark has 6 numbers (source, target) in the caller's coordinates. Its
 * two points come to the same direction. */
icc_status iccp_sphere_pair_draw(iccp_body bodies[2], size_t n_landmarks, const double *landmarks,
                                 const iccp_env *env, icc_error *err);

void iccp_sphere_pair_free(iccp_body bodies[2], const iccp_memory *memory);

#endif
