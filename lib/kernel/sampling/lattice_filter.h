/* Finds the points of a lattice that lie in a shape. */
#ifndef ICCP_LATTICE_FILTER_H
#define ICCP_LATTICE_FILTER_H

#include "kernel/sampling/point_list.h"
#include "kernel/sampling/shape.h"

/* Most points of a lattice: 2^27. */
#define ICCP_MAX_LATTICE ((size_t)1 << 27)

/* Computes a point of the lattice, in the caller's coordinates. */
typedef void (*iccp_lattice_point)(const void *lattice, const size_t *at, double *point);

typedef struct iccp_lattice_filter {
    const icc_shape *shape;
    /* Points along each axis, 1 beyond dim. Their product is at most ICCP_MAX_LATTICE. */
    size_t count[3];
    iccp_lattice_point point;
    const void *lattice;
    /* Inside, points nearer than `clearance` to a wall are dropped. Outside, points farther than
     * `margin` from a wall are dropped. Both are in local units. A margin of 0 keeps points on a
     * wall. */
    double clearance, margin;
} iccp_lattice_filter;

/* Adds the remaining points, first axis fastest. */
icc_status iccp_lattice_filter_add(iccp_point_list *list, const iccp_lattice_filter *filter,
                                   const iccp_env *env);

#endif
