/* Map kind mesh: an internal piecewise linear map, certified and made fair. */
#ifndef ICCP_MESH_MAP_H
#define ICCP_MESH_MAP_H

#include "map/compatible/improve.h"
#include "map/energy/newton.h"
#include "map/isotopy/isotopy.h"
#include "map/kind/kind.h"
#include "mesh/finder.h"

/* Immutable once made, but for what is made when it is first needed. */
typedef struct iccp_mesh_map {
    iccp_plmap pl;
    double reach[2];       /* of the bands of source and target (geometry/band.h) */
    iccp_finder before;    /* in the source */
    iccp_finder after;     /* in the target */
    iccp_once plan;        /* Newton's, of the mesh: made when the map is first followed */
    iccp_isotopy *isotopy; /* with features; NULL where rounding is in the way */
    double work;           /* that it took to make: see map/energy/work.h */
} iccp_mesh_map;

/* All but `reach` is still to be filled in; NULL without memory. */
iccp_mesh_map *iccp_mesh_map_new(const icc_domain *source, const icc_domain *target,
                                 const iccp_memory *memory);

/* Starts from two charts that were made together: from their images of the source chart's mesh if
 * no triangle is inverted, otherwise from the overlay of two triangulations of the domains
 * (map/compatible/overlay_start.h). Fills in the mesh's members of `info`. If the overlay would be
 * too large, *out is NULL, with ICC_OK, and info->n_unrepaired counts the charts' inverted
 * triangles. `iterations` as in icc_map_options. */
icc_status iccp_mesh_map_create(iccp_mesh_map **out, const icc_chart *source,
                                const icc_chart *target, int32_t iterations, icc_map_info *info,
                                const iccp_env *env, icc_error *err);

/* Between two domains with features that correspond, without charts. ICC_ERR_RESOLUTION when
 * features are too close for doubles. Otherwise as above. */
icc_status iccp_mesh_map_create_features(iccp_mesh_map **out, const icc_domain *source,
                                         const icc_domain *target, const icc_map_options *options,
                                         icc_map_info *info, const iccp_env *env, icc_error *err);

/* A better one from a copy, between domains of n_facets; see icc_map_improve(). */
icc_status iccp_mesh_map_improve(iccp_mesh_map **out, const iccp_mesh_map *map, size_t n_facets,
                                 const icc_improve_options *options, icc_improve_report *report,
                                 const iccp_env *env);

/* The rest of a map whose `pl` is there: prepares what finds points, and fills in the members of
 * `info` about the mesh's size. */
icc_status iccp_mesh_map_finish(iccp_mesh_map *map, icc_map_info *info, const iccp_env *env);

/* Improves what is in map->pl, which is one-to-one, and finishes the map. */
icc_status iccp_mesh_map_complete(iccp_mesh_map *map, const icc_improve_options *options,
                                  const iccp_schedule *how, iccp_work *work, icc_map_info *info,
                                  const iccp_env *env);

/* Passes the plan on to a map whose mesh has not changed. */
void iccp_mesh_map_keep_plan(iccp_mesh_map *map, iccp_newton_plan *plan);

void iccp_mesh_map_free(iccp_mesh_map *map, const iccp_memory *memory);

/* One local point, forward or back. `jacobian`: 4 numbers row by row, or NULL. ICC_ERR_TRACE when
 * no triangle holds the point, which can only be within rounding of the boundary; ICC_ERR_MEMORY
 * when nothing of the kind has been asked before, and what that takes cannot be allocated. */
icc_status iccp_mesh_map_point(const iccp_mesh_map *map, bool inverse, const double *point,
                               double *image, double *jacobian);

/* Makes what points forward or back need; and for at most ICCP_FINDER_MANY of them, 2 local
 * coordinates each, the triangles that hold them, and the image of one that was found. */
icc_status iccp_mesh_map_ready(const iccp_mesh_map *map, bool inverse);
void iccp_mesh_map_find(const iccp_mesh_map *map, bool inverse, size_t n, const double *points,
                        iccp_found *found);
void iccp_mesh_map_image(const iccp_mesh_map *map, bool inverse, const iccp_found *found,
                         double *image, double *jacobian);

/* Whether what was found is a vertex of the mesh on a line or point inside, whose image is that of
 * the vertex bit for bit. */
bool iccp_mesh_map_is_given(const iccp_mesh_map *map, const iccp_found *found, uint32_t *vertex);

#endif
