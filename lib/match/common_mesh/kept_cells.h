/* The cells of a surface, its vertices, edges and faces, that vertices of a common surface are in,
 * where all of these stay: faces are cut into triangles, and no triangle is a part of two. */
#ifndef ICCP_KEPT_CELLS_H
#define ICCP_KEPT_CELLS_H

#include "match/common_mesh/common_surface.h"

typedef struct iccp_kept_cells {
    const uint32_t *corners; /* borrowed: 3 for each face of the surface, which stay */
    uint32_t (*at)[2]; /* by vertex of the common surface: the faces on both sides of the edge that
                          it is on, twice the same inside one; or ICCP_NO_EDGE and a vertex */
} iccp_kept_cells;

/* Of the first of the two surfaces that `common` was made from: its faces are those with these
 * corners or, where there is a `part_of` by face, parts of these. False if there is no memory; to
 * be freed in any case. */
bool iccp_kept_cells_create(iccp_kept_cells *cells, const iccp_common_surface *common,
                            const uint32_t *corners, const uint32_t *part_of,
                            const iccp_memory *memory);
void iccp_kept_cells_free(iccp_kept_cells *cells, const iccp_memory *memory);

/* Whether the place of vertex v is in the cell of u, or at its border: what is at u may go there,
 * and all faces have the same shape. Never from a vertex that stays. */
bool iccp_kept_cells_may_go(const iccp_kept_cells *cells, uint32_t u, uint32_t v);

/* Whether one face has all of four places. */
bool iccp_kept_cells_share(const iccp_kept_cells *cells, const uint32_t places[4]);

#endif
