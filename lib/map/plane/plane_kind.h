/* Mesh maps in the plane as a kind of map: the table of their operations. */
#ifndef ICCP_PLANE_KIND_H
#define ICCP_PLANE_KIND_H

#include "map/plane/mesh_map.h"

extern const iccp_map_kind iccp_plane_kind;

/* Returns the mesh map of a map, or NULL if the map is of another kind. */
static inline iccp_mesh_map *iccp_plane_of(const icc_map *map)
{
    return map->kind == &iccp_plane_kind ? map->state : NULL;
}

#endif
