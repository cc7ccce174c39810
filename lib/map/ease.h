/* Places where a map has far more energy than elsewhere. */
#ifndef ICCP_EASE_H
#define ICCP_EASE_H

#include "map/plmap.h"
#include "map/work.h"

/* Lowers the symmetric Dirichlet energy round the triangles that are tense, all of which are
 * positive and stay so, by moving images of the vertices near by. The mesh stays. On any failure
 * the map is no worse than before. */
icc_status iccp_ease(iccp_plmap *map, iccp_work *work, const iccp_env *env);

#endif
