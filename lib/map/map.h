/* Maps between two domains whose boundaries correspond, whatever their kind.
 *
 * Words of this folder
 * - kind: how a map is stored and applied: curves, or a mesh map in the plane or in space
 *   (map/kind/kind.h).
 * - state: the data that only the kind of a map reads.
 * - charts: coordinates of both domains, from which a map begins. Maps with features have none.
 * - correspond: two boundaries correspond if a map can take vertex i to vertex i
 *   (correspondence.h).
 * - certificate: the proof that the map is one-to-one.
 * - retarget: to make the map to a moved target from the map to the target before.
 * - spoilt: a simplex that rounding to the caller's coordinates inverts or flattens (rounded.h).
 *
 * Ways
 * - map.c makes, improves and retargets maps. apply.c applies them, map_file.c saves and reads
 *   them.
 * - certify.c checks and repairs the images of meshes of the caller's. It proves nothing about the
 *   map itself; the *_certificate.c files of the kinds do that.
 *
 * Begin with map.c. */
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

/* See icc_map_get_tie(), icc_map_get_mesh() and icc_map_get_regions(). */
icc_status iccp_map_get_tie(const icc_map *map, size_t tie, icc_tie_info *info, double *target);
icc_status iccp_map_get_mesh(const icc_map *map, double *vertices, double *images,
                             uint32_t *corners);
icc_status iccp_map_get_regions(const icc_map *map, uint32_t *regions);

/* ---- a map piece by piece ---- */

/* Returns the kind with this number for domains like this one, or NULL. */
const iccp_map_kind *iccp_map_kind_of(int32_t number, const icc_domain *source);

/* Finds the kind with this number that two charts allow; for number 0 the best of all kinds.
 * Returns ICC_ERR_UNSUPPORTED if there is none. */
icc_status iccp_map_choose_kind(const iccp_map_kind **kind, int32_t number, const icc_chart *source,
                                const icc_chart *target, icc_error *err);

/* Begins a map. It has kind curves and no charts yet. Returns ICC_ERR_BOUNDARY unless the
 * boundaries correspond. */
icc_status iccp_map_begin(icc_map **out, const icc_domain *source, const icc_domain *target,
                          const iccp_env *env, icc_error *err);
void iccp_map_add_charts(icc_map *map, const icc_chart *source, const icc_chart *target);

/* Certifies and describes a map that has its state. Returns ICC_ERR_CERTIFICATE for a mesh map that
 * is not one-to-one. */
icc_status iccp_map_conclude(icc_map *map, const iccp_env *env, icc_error *err);

#endif
