/* Maps between two domains whose boundaries correspond, whatever their kind.
 *
 * Words of this folder
 * - kind: how a map is stored and applied (map/kind/kind.h): curves, or a mesh map in the plane or
 *   in space.
 * - state: what only the kind knows of a map. charts: the coordinates of both domains that the
 *   kinds begin with; maps of domains with features have none.
 * - correspond: two boundaries with the same facets (correspondence.h), so vertex i goes to vertex
 *   i.
 * - certificate: the proof that the map is one-to-one.
 * - certify, repair: to check a mesh of the caller's under the map, and to mend its images.
 * - retarget: to make the map to a target that has moved from the map to the target before.
 * - spoilt: a simplex that rounding to the caller's coordinates inverts or flattens (rounded.h).
 *
 * Ways: map.c makes, improves and retargets maps, apply.c applies them, certify.c checks the
 * caller's meshes, map_file.c saves and reads maps. Begin with map.c. */
#ifndef ICCP_MAP_H
#define ICCP_MAP_H

#include "map/kind/kind.h"

/* See icc_map_create(). `options` gives kind and iterations; the charts' options are separate. */
icc_status iccp_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                           const icc_map_options *options, const icc_chart_options chart_options[2],
                           const iccp_env *env, icc_error *err);

/* See icc_map_create_from_charts(). */
icc_status iccp_map_create_from_charts(icc_map **out, const icc_chart *source,
                                       const icc_chart *target, const icc_map_options *options,
                                       const iccp_env *env, icc_error *err);

/* See icc_map_improve(). */
icc_status iccp_map_improve(icc_map **out, const icc_map *map, const icc_improve_options *options,
                            icc_improve_report *report, const iccp_env *env, icc_error *err);

/* See icc_map_retarget(). */
icc_status iccp_map_retarget(icc_map **out, const icc_map *map, const icc_domain *target,
                             int32_t iterations, const iccp_env *env, icc_error *err);
void iccp_map_release(icc_map *map);

/* See icc_map_get_tie() and icc_map_get_mesh(). */
icc_status iccp_map_get_tie(const icc_map *map, size_t tie, icc_tie_info *info, double *target);
icc_status iccp_map_get_mesh(const icc_map *map, double *vertices, double *images,
                             uint32_t *corners);

/* ---- a map piece by piece ---- */

/* The kind with this number for domains like this one, or NULL. */
const iccp_map_kind *iccp_map_kind_of(int32_t number, const icc_domain *source);

/* The kind with this number that two charts allow, or the best of all for number 0.
 * ICC_ERR_UNSUPPORTED if there is none. */
icc_status iccp_map_choose_kind(const iccp_map_kind **kind, int32_t number, const icc_chart *source,
                                const icc_chart *target, icc_error *err);

/* A map of kind curves, without charts yet. ICC_ERR_BOUNDARY unless the boundaries correspond. */
icc_status iccp_map_begin(icc_map **out, const icc_domain *source, const icc_domain *target,
                          const iccp_env *env, icc_error *err);
void iccp_map_add_charts(icc_map *map, const icc_chart *source, const icc_chart *target);

/* Once the state of a map is there: certifies it, ICC_ERR_CERTIFICATE for a mesh map that is not
 * one-to-one, and describes it. */
icc_status iccp_map_conclude(icc_map *map, const iccp_env *env, icc_error *err);

#endif
