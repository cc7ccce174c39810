/* A mesh of a domain for the elastic model. Points that the caller tells become vertices. */
#ifndef ICCP_PIN_MESH_H
#define ICCP_PIN_MESH_H

#include "domain/domain.h"

/* All coordinates are the domain's local ones. */
typedef struct iccp_pin_mesh_input {
    const icc_domain *domain; /* a polygon, with or without holes */
    size_t n_pins;            /* points inside, all different */
    const double *pins;       /* 2 n_pins */
    /* 2 n_segments: pairs of told vertices, numbered as below, that edges of the mesh must join.
     * None is an edge of the outline */
    size_t n_segments;
    const uint32_t *segments;
    double cell; /* the longest edge, about; 0: as short as for some 1,500 triangles */
    double
        reach; /* how far a pin carries its surroundings, or 0. Triangles at pins are much smaller.
                     Without a cell some edges fit into it, with up to four times the triangles */
} iccp_pin_mesh_input;

/* The vertices of the domain come first, then the pins. These are told. Others follow. */
typedef struct iccp_pin_mesh {
    iccp_memory memory;
    size_t n_told, n_points, n_triangles;
    double *points;      /* 2 n_points */
    uint32_t *triangles; /* 3 n_triangles, counter-clockwise */
    /* For each vertex after the told ones: the told ends of the outline's edge or the segment that
     * it divides, or UINT32_MAX twice; and its place there as a share of the way */
    uint32_t *ends;
    double *share;
} iccp_pin_mesh;

/* Edges of the outline and segments are divided. Near pins that are close to one another, or to
 * the outline, triangles are smaller. Returns ICC_ERR_OUTSIDE if a pin is not inside, with its
 * number in `err`, ICC_ERR_RESOLUTION if there would be too many triangles, and
 * ICC_ERR_CERTIFICATE if segments meet the outline or one another, or if
 * points are so close that rounded ones touch. */
icc_status iccp_pin_mesh_create(iccp_pin_mesh *mesh, const iccp_pin_mesh_input *input,
                                const iccp_env *env, icc_error *err);
void iccp_pin_mesh_free(iccp_pin_mesh *mesh);

#endif
