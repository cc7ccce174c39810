/* Changing the mesh of a map in space: tetrahedra are replaced by others that fill the same space,
 * before and after the map. */
#ifndef ICCP_SOLID_EDIT_H
#define ICCP_SOLID_EDIT_H

#include "domain/domain.h"
#include "map/solid/solid_map.h"

/* The most tetrahedra round an edge that is looked at. */
enum { ICCP_MOST_RING = 32 };

/* A pass over the mesh as it is when it begins. Tetrahedra that were replaced in this pass are
 * gone, and what has come instead waits for the next one. */
typedef struct iccp_solid_edit {
    iccp_solid_map *map; /* whose mesh is its own */
    size_t n_simplices;  /* when the pass began: */
    uint32_t *first;     /* n_points + 1: where the tetrahedra of each point begin in `star`, */
    uint32_t *star;      /* rising */
    uint8_t *is_gone;    /* of each */
    uint8_t *is_new;     /* of each, those that wait included: made since flips were looked for */
    size_t point_room, simplex_room;
} iccp_solid_edit;

/* Tetrahedra round an edge a-b inside: number k has the points a, b, point[k] and the next one, in
 * this order, and is positive. */
typedef struct iccp_ring {
    size_t n;
    uint32_t point[ICCP_MOST_RING], simplex[ICCP_MOST_RING];
} iccp_ring;

/* `map` stays where it is, with a mesh of its own, until the edit is freed. */
icc_status iccp_solid_edit_create(iccp_solid_edit *edit, iccp_solid_map *map);
void iccp_solid_edit_free(iccp_solid_edit *edit);

/* Whether a mesh that was changed is what it was: the ball that fills `source`, with its surface,
 * every tetrahedron positive before the map, exactly. It knows its neighbours again. Else
 * ICC_ERR_CERTIFICATE. */
icc_status iccp_solid_check(iccp_solid_map *map, const icc_domain *source, const iccp_env *env);

icc_status iccp_solid_edit_begin(iccp_solid_edit *edit);

/* Drops what is gone. */
void iccp_solid_edit_end(iccp_solid_edit *edit);

/* False for an edge of the surface, and where the ring is too long. */
bool iccp_solid_ring(const iccp_solid_edit *edit, uint32_t a, uint32_t b, iccp_ring *ring);
bool iccp_ring_is_there(const iccp_solid_edit *edit, const iccp_ring *ring);

/* The tetrahedron on the other side of face `corner` of simplex t; false for a face of the
 * surface. */
bool iccp_solid_across(const iccp_solid_edit *edit, uint32_t t, size_t corner, uint32_t *other);

/* Whether the tetrahedron of four points is positive before and after, exactly; and before. */
bool iccp_solid_is_positive(const iccp_solid_edit *edit, const uint32_t *corners);
bool iccp_solid_is_positive_before(const iccp_solid_edit *edit, const uint32_t *corners);

/* Energy times volume of such a tetrahedron, and its volume; HUGE_VAL where it is not positive or
 * so flat, before or after, that doubles know little about it. */
double iccp_solid_value(const iccp_solid_edit *edit, const uint32_t *corners, double *volume);

/* Room for so many more, without which they must not be added. */
icc_status iccp_solid_reserve(iccp_solid_edit *edit, size_t n_points, size_t n_simplices);
void iccp_solid_add(iccp_solid_edit *edit, const uint32_t *corners);
uint32_t iccp_solid_add_point(iccp_solid_edit *edit, const double *point, const double *image);

#endif
