/* Map kind mesh beyond space: a piecewise linear map on a mesh that fills both domains.
 *
 * In the plane and in space a mesh is made in the source alone. Beyond, one mesh is placed twice:
 * its boundary is given on both sides, and its inner vertices get a place on each where all
 * simplices are positive. So it is enough that a mesh is known on either side, or that its places
 * can be found.
 *
 * Words of this folder
 * - star: the simplices at an inner vertex (stars.h).
 * - kernel: the points that see the whole boundary (kernel_point.h).
 * - cone: the mesh that joins one inner vertex, the apex, to all facets.
 * - collar: a layer of simplices between a boundary and a copy of it further inside.
 *
 * Ways: higher_map.c tries meshes in turn, which fill_higher.h makes. relocate.h moves vertices, by
 * the energies in star_energy.h. higher_kind.h has the operations.
 *
 * Invariant: every simplex of a finished map is positive before and after the map (math/orient.h).
 *
 * Begin with higher_map.c. */
#ifndef ICCP_HIGHER_MAP_H
#define ICCP_HIGHER_MAP_H

#include "map/kind/kind.h"

/* Immutable once made. */
typedef struct iccp_higher_map {
    iccp_memory memory;
    iccp_simplices *mesh; /* its first points are the source's vertices */
    double *images;       /* of the mesh's points, local in the target */
    double stretch;       /* as in iccp_simplicial_map */
    iccp_facet_tree before, after;
} iccp_higher_map;

static inline iccp_simplicial_map iccp_higher_simplicial(const iccp_higher_map *map)
{
    iccp_simplicial_map simplicial = iccp_simplicial_map_of(map->mesh, map->images);
    simplicial.stretch = map->stretch;
    return simplicial;
}

/* Makes a map. Takes at most the given number of improvement sweeps; 0 means as many as pay off,
 * and -1 none. Fills in the mesh's members of `info`. If no mesh can be placed on both sides,
 * info->n_unrepaired is not 0 and *out is NULL, with ICC_OK. */
icc_status iccp_higher_map_create(iccp_higher_map **out, const icc_domain *source,
                                  const icc_domain *target, int32_t iterations,
                                  iccp_map_facts *info, const iccp_env *env);

/* Makes a better map from a copy; see icc_map_improve(). There are no refinements. */
icc_status iccp_higher_map_improve(iccp_higher_map **out, const iccp_higher_map *map,
                                   const icc_domain *source, const icc_domain *target,
                                   const icc_improve_options *options, icc_improve_report *report,
                                   const iccp_env *env);

/* Makes a map to another target; see icc_map_retarget(). *out is NULL, with ICC_OK, if simplices
 * stay inverted. */
icc_status iccp_higher_map_follow(iccp_higher_map **out, const iccp_higher_map *map,
                                  const icc_domain *source, const icc_domain *old_target,
                                  const icc_domain *target, int32_t iterations,
                                  iccp_map_facts *info, const iccp_env *env);

/* Makes points findable again after images have changed. */
icc_status iccp_higher_map_replant(iccp_higher_map *map, const iccp_env *env);

/* Reads or writes a map as part of its bytes (docs/reference/formats.md). A map that is read still
 * needs its certificate. Writing takes no info and no env. */
icc_status iccp_higher_map_visit(iccp_blob *b, iccp_higher_map **map, const icc_domain *source,
                                 const icc_domain *target, iccp_map_facts *info,
                                 const iccp_env *env);
void iccp_higher_map_free(iccp_higher_map *map);

/* Maps one local point, forward or back. `jacobian`: dim * dim numbers row by row, or NULL.
 * ICC_ERR_TRACE if no simplex contains the point, which can only happen within rounding of the
 * boundary. */
icc_status iccp_higher_map_point(const iccp_higher_map *map, bool inverse, const double *point,
                                 double *image, double *jacobian);

#endif
