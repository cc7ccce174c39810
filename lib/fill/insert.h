/* Inserting points into tetrahedra. */
#ifndef ICCP_INSERT_H
#define ICCP_INSERT_H

#include "fill/tets.h"

typedef enum iccp_inserted { ICCP_INSERTED, ICCP_NOT_INSERTED, ICCP_INSERT_MEMORY } iccp_inserted;

/* A tetrahedron that holds a point, found by walking from another; ICCP_NO_TET if the way leads
 * through the surface, or is too long. */
uint32_t iccp_tets_locate(iccp_tets *m, uint32_t point, uint32_t from);

/* m->cavity: the tetrahedra that hold the point, of which `tet` is one: several if it lies on a
 * face or an edge. */
bool iccp_tets_holders(iccp_tets *m, uint32_t point, uint32_t tet);

/* Joins a point to the sides of the space of m->cavity, all of which it must see; what comes after
 * the first n_base may be left out for that. With `grow`, the cavity takes in tetrahedra next to it
 * in whose circumsphere the point is. Nothing has changed unless ICCP_INSERTED; then m->fresh has
 * the new ones. */
iccp_inserted iccp_tets_insert(iccp_tets *m, uint32_t point, size_t n_base, bool grow);

/* Takes into m->cavity what lies beyond sides that a point does not see, until it sees all but
 * walls or there are more than `most`. */
bool iccp_tets_extend(iccp_tets *m, uint32_t point, size_t most);

/* Inserts points up to n_given near Delaunay into what holds them all, in the given order. */
icc_status iccp_tets_insert_all(iccp_tets *m, size_t n, const uint32_t *order, const iccp_env *env,
                                icc_error *err);

#endif
