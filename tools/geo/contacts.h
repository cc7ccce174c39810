/* Tells whether two polygons of a layer may share a side. A layer in which none do needs no nodes,
 * and this takes a small part of the time that nodes take. */
#ifndef CONTACTS_H
#define CONTACTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The polygon of a line. */
#define NO_POLYGON UINT32_MAX

/* A line or ring of a layer: consecutive positions, and the polygon that it bounds. */
typedef struct layer_path {
    size_t first, n;
    uint32_t polygon;
} layer_path;

/* False only if no two polygons share a side after vertices within `length` of each other have been
 * welded, and vertices within `length` of a side put into it. Paths are in the order of their
 * positions. */
bool contacts_may_share(size_t n, const double *points, size_t n_paths, const layer_path *paths,
                        double length);

#endif
