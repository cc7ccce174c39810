/* The cells of a surface that must be kept: its vertices, edges and faces. Each vertex of the
 * common surface lies in one cell. Faces are cut into triangles, and no triangle belongs to two
 * faces. */
#ifndef ICCP_KEPT_CELLS_H
#define ICCP_KEPT_CELLS_H

#include "match/common_mesh/common_surface.h"

typedef struct iccp_kept_cells {
    const uint32_t *corners; /* borrowed: 3 for each face of the surface; they are kept */
    uint32_t (*at)[2]; /* by vertex of the common surface: the two faces beside its edge, or its
                          face twice; or ICCP_NO_EDGE and its vertex */
} iccp_kept_cells;

/* Finds the cells of the first of the two surfaces that `common` was made from. Its faces have
 * these corners. If `part_of` is given, by face, they are parts of the faces with these corners.
 * False if there is no memory. Free it in any case. */
bool iccp_kept_cells_create(iccp_kept_cells *cells, const iccp_common_surface *common,
                            const uint32_t *corners, const uint32_t *part_of,
                            const iccp_memory *memory);
void iccp_kept_cells_free(iccp_kept_cells *cells, const iccp_memory *memory);

/* Returns true if the place of vertex v is in the cell of u or on its border. Then vertex u may go
 * there, and all faces keep their shape. A vertex that is kept never moves. */
bool iccp_kept_cells_may_go(const iccp_kept_cells *cells, uint32_t u, uint32_t v);

/* Returns true if one face contains all four places. */
bool iccp_kept_cells_share(const iccp_kept_cells *cells, const uint32_t places[4]);

#endif
