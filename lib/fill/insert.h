/* Inserts points into a mesh of tetrahedra. */
#ifndef ICCP_INSERT_H
#define ICCP_INSERT_H

#include "fill/tets.h"

typedef enum iccp_inserted { ICCP_INSERTED, ICCP_NOT_INSERTED, ICCP_INSERT_MEMORY } iccp_inserted;

/* Returns a tetrahedron that contains a point, by walking from another one. Returns ICCP_NO_TET if
 * the walk reaches the surface or is too long. */
uint32_t iccp_tets_locate(iccp_tets *m, uint32_t point, uint32_t from);

/* Collects the tetrahedra that contain the point in m->cavity. `tet` is one of them; there are
 * several if the point lies on a face or an edge. */
bool iccp_tets_holders(iccp_tets *m, uint32_t point, uint32_t tet);

/* Joins a point to the rim of m->cavity. The point must see all of the rim; for that, tetrahedra
 * after the first n_base may be left out. With `grow`, the cavity first grows by adjacent
 * tetrahedra whose circumsphere contains the point. If the result is ICCP_INSERTED, m->fresh has
 * the new tetrahedra. Otherwise nothing has changed. */
iccp_inserted iccp_tets_insert(iccp_tets *m, uint32_t point, size_t n_base, bool grow);

/* Extends m->cavity beyond sides that a point does not see. Stops when the point sees all sides
 * except walls, or when there are more than `most` tetrahedra. */
bool iccp_tets_extend(iccp_tets *m, uint32_t point, size_t most);

/* Inserts the points below n_given into a mesh that contains them all, nearly Delaunay, in the
 * given order. */
icc_status iccp_tets_insert_all(iccp_tets *m, size_t n, const uint32_t *order, const iccp_env *env,
                                icc_error *err);

#endif
