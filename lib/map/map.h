/* The map object: two charts whose boundaries correspond, and the mesh where there is one. */
#ifndef ICCP_MAP_H
#define ICCP_MAP_H

#include "map/isotopy/isotopy.h"
#include "map/plane/mesh_map.h"
#include "map/solid/solid_map.h"

struct icc_map {
    iccp_memory memory;
    icc_domain *source_domain, *target_domain;
    icc_chart *source, *target; /* both NULL for a retargeted map */
    iccp_mesh_map *mesh;        /* kind mesh in the plane, or NULL */
    iccp_solid_map *solid;      /* kind mesh in space, or NULL */
    iccp_isotopy *isotopy;      /* with features; NULL where rounding is in the way */
    icc_map_info info;
};

/* The mesh of a map that has one. */
static inline iccp_simplicial_map iccp_map_simplicial(const icc_map *map)
{
    return map->mesh != NULL ? iccp_plmap_simplicial(&map->mesh->pl)
                             : iccp_solid_simplicial(map->solid);
}

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

/* ---- a map piece by piece ---- */

/* Kind 0 becomes the best that the charts allow; ICC_ERR_UNSUPPORTED for others than they do. */
icc_status iccp_map_choose_kind(int32_t *kind, const icc_chart *source, const icc_chart *target,
                                icc_error *err);

/* A map of kind curves, without charts yet. ICC_ERR_BOUNDARY unless the boundaries correspond. */
icc_status iccp_map_begin(icc_map **out, const icc_domain *source, const icc_domain *target,
                          const iccp_env *env, icc_error *err);
void iccp_map_add_charts(icc_map *map, const icc_chart *source, const icc_chart *target);

/* Once the mesh of a map is there: between domains with features, its isotopy and what the info
 * says of features, but for class_kept. */
icc_status iccp_map_tell_features(icc_map *map, const iccp_env *env);

/* Takes the certificate away from a map that its charts do not warrant: of method field. */
icc_status iccp_map_check_digits(icc_map *map, const iccp_env *env);

#endif
