/* The points of a lattice that lie in a shape. */
#ifndef ICCP_LATTICE_FILTER_H
#define ICCP_LATTICE_FILTER_H

#include "kernel/sampling/point_list.h"
#include "kernel/sampling/shape.h"

/* Most points of a lattice that are looked at: 2^27. */
#define ICCP_MAX_LATTICE ((size_t)1 << 27)

/* Where a point of the lattice is, in the caller's coordinates. */
typedef void (*iccp_lattice_point)(const void *lattice, const size_t *at, double *point);

typedef struct iccp_lattice_filter {
    const icc_shape *shape;
    /* Points along each axis, 1 beyond dim; their product is at most ICCP_MAX_LATTICE. */
    size_t count[3];
    iccp_lattice_point point;
    const void *lattice;
    /* Inside, points nearer than `clearance` to a wall are dropped; outside, those farther than
     * `margin` from one. In local units; a margin of 0 keeps what is on a wall. */
    double clearance, margin;
} iccp_lattice_filter;

/* Adds the points that stay, the first axis fastest. */
icc_status iccp_lattice_filter_add(iccp_point_list *list, const iccp_lattice_filter *filter,
                                   const iccp_env *env);

#endif
