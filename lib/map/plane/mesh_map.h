/* A mesh map in the plane: a triangle mesh of the source with an image for each vertex.
 *
 * Words of this folder
 * - start: a one-to-one map from which improvement begins.
 * - overlay: a mesh that refines a triangulation of the source and one of the target.
 * - retarget: to move a map to a target that has moved.
 *
 * Invariants
 * - Every triangle of a finished map is positive before and after the map, by exact signs.
 * - The boundary's vertices have the images that the correspondence of the cages prescribes.
 * - A finished map does not change, except for what is made when it is first needed.
 *
 * Ways
 * - Without features: the mesh of the source's chart, with overlays where it is inverted
 *   (plane_start.h).
 * - With features: the overlay of the domains, cut open along paths (feature_start.h).
 * - To another target: plane_retarget.h. How far it moves at a time: map/energy/continuation.h; how
 *   the mesh gives way: map/compatible/move_targets.h.
 * - To less distortion: plane_improve.h. Points: plane_apply.h. Proof: plane_certificate.h.
 *
 * Begin with plane_kind.c, which lists the operations, and plane_start.c. */
#ifndef ICCP_MESH_MAP_H
#define ICCP_MESH_MAP_H

#include "map/compatible/improve.h"
#include "map/energy/newton.h"
#include "map/isotopy/isotopy.h"
#include "map/kind/kind.h"
#include "mesh/finder.h"

typedef struct iccp_mesh_map {
    iccp_plmap pl;
    double reach[2];       /* of the bands of source and target (geometry/band.h) */
    iccp_finder before;    /* in the source */
    iccp_finder after;     /* in the target */
    iccp_once plan;        /* Newton's, of the mesh or of the part that moved last: made when the
                              map is first followed */
    iccp_isotopy *isotopy; /* with features; NULL where rounding is in the way */
    double work;           /* spent on making it: see map/energy/work.h */
} iccp_mesh_map;

/* Allocates a map and sets `reach`. The rest is 0. Returns NULL without memory. */
iccp_mesh_map *iccp_mesh_map_new(const icc_domain *source, const icc_domain *target,
                                 const iccp_memory *memory);

/* Completes a map that has its `pl`: prepares the finders of points, and fills in the members of
 * `info` about the size of the mesh. */
icc_status iccp_mesh_map_finish(iccp_mesh_map *map, iccp_map_facts *info, const iccp_env *env);

void iccp_mesh_map_free(iccp_mesh_map *map, const iccp_memory *memory);

/* Maps one local point, forward or back. `jacobian`: 4 numbers row by row, or NULL. Returns
 * ICC_ERR_TRACE if no triangle holds the point; an inside point is then within rounding of the
 * boundary. Returns ICC_ERR_MEMORY if this is the first call and the finder cannot be made. */
icc_status iccp_mesh_map_point(const iccp_mesh_map *map, bool inverse, const double *point,
                               double *image, double *jacobian);

/* Makes the finder of points, forward or back. Call it before the next two functions. */
icc_status iccp_mesh_map_ready(const iccp_mesh_map *map, bool inverse);

/* Finds the triangles of at most ICCP_FINDER_MANY local points. */
void iccp_mesh_map_find(const iccp_mesh_map *map, bool inverse, size_t n, const double *points,
                        iccp_found *found);

/* Maps a point that was found. */
void iccp_mesh_map_image(const iccp_mesh_map *map, bool inverse, const iccp_found *found,
                         double *image, double *jacobian);

/* Whether a point that was found is a vertex of the mesh on a line or point inside. Its image is
 * then exactly the image of the vertex. */
bool iccp_mesh_map_is_given(const iccp_mesh_map *map, const iccp_found *found, uint32_t *vertex);

#endif
