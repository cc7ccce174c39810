/* Changes the mesh of a map in space. Tetrahedra are replaced by others that fill the same space,
 * before and after the map. */
#ifndef ICCP_SOLID_EDIT_H
#define ICCP_SOLID_EDIT_H

#include "domain/domain.h"
#include "map/solid/solid_map.h"
#include "map/solid/solid_marks.h"

/* Edges with more tetrahedra around them are ignored. */
enum { ICCP_MOST_RING = 32 };

/* A pass over the mesh as it was when the pass began. Tetrahedra that were replaced in this pass
 * are gone. Their replacements wait for the next pass. */
typedef struct iccp_solid_edit {
    iccp_solid_map *map; /* it has a mesh of its own */
    size_t n_simplices;  /* at the beginning of the pass */
    uint32_t *first;     /* n_points + 1: each point's first tetrahedron in `star` */
    uint32_t *star;      /* tetrahedra of each point, in rising order */
    uint8_t *is_gone;    /* of each tetrahedron */
    uint8_t *is_new;     /* of each tetrahedron, including the waiting ones: made after the last
                            search for flips */
    size_t point_room, simplex_room;
    iccp_solid_marks marks; /* what edits must keep */
} iccp_solid_edit;

/* The tetrahedra around an inner edge a-b. Number k has the points a, b, point[k] and the next one,
 * in this order, and is positive. */
typedef struct iccp_ring {
    size_t n;
    uint32_t point[ICCP_MOST_RING], simplex[ICCP_MOST_RING];
} iccp_ring;

/* Begins an edit. `map` has a mesh of its own that fills `source`. Both must stay where they are
 * until the edit is freed. */
icc_status iccp_solid_edit_create(iccp_solid_edit *edit, iccp_solid_map *map,
                                  const icc_domain *source);
void iccp_solid_edit_free(iccp_solid_edit *edit);

/* Checks, exactly, that a changed mesh still fills `source`, with its surfaces, lines and points,
 * and every tetrahedron is positive before the map. Finds its neighbours and regions again.
 * ICC_ERR_CERTIFICATE if the check fails. */
icc_status iccp_solid_check(iccp_solid_map *map, const icc_domain *source, const iccp_env *env);

icc_status iccp_solid_edit_begin(iccp_solid_edit *edit);

/* Drops the tetrahedra that are gone. */
void iccp_solid_edit_end(iccp_solid_edit *edit);

/* Finds the ring of an edge. Returns false for an edge of the surface, and if the ring is too
 * long. */
bool iccp_solid_ring(const iccp_solid_edit *edit, uint32_t a, uint32_t b, iccp_ring *ring);
bool iccp_ring_is_there(const iccp_solid_edit *edit, const iccp_ring *ring);

/* Finds the tetrahedron on the other side of face `corner` of simplex t. Returns false for a face
 * of the surface. */
bool iccp_solid_across(const iccp_solid_edit *edit, uint32_t t, size_t corner, uint32_t *other);

/* Returns true if the tetrahedron of four points is positive before and after the map, exactly. */
bool iccp_solid_is_positive(const iccp_solid_edit *edit, const uint32_t *corners);

/* Returns the energy of such a tetrahedron times its volume, and its volume. HUGE_VAL if it is not
 * positive, or too flat for doubles before or after the map. */
double iccp_solid_value(const iccp_solid_edit *edit, const uint32_t *corners, double *volume);

/* Makes room for more points and simplices, which must not be added without it. */
icc_status iccp_solid_reserve(iccp_solid_edit *edit, size_t n_points, size_t n_simplices);
void iccp_solid_add(iccp_solid_edit *edit, const uint32_t *corners);
uint32_t iccp_solid_add_point(iccp_solid_edit *edit, const double *point, const double *image);

#endif
