/* Map kind mesh in space: a piecewise linear map on the source's conforming mesh, started from the
 * charts. */
#ifndef ICCP_SOLID_MAP_H
#define ICCP_SOLID_MAP_H

#include "map/kind/kind.h"

/* Immutable once made. */
typedef struct iccp_solid_map {
    iccp_memory memory;
    const iccp_simplices *mesh; /* the source's, which its domain keeps, or: */
    iccp_simplices *own;        /* one with more points, or NULL */
    double *images;             /* of its points, local in the target */
    double stretch;             /* as in iccp_simplicial_map */
    iccp_facet_tree before, after;
} iccp_solid_map;

static inline iccp_simplicial_map iccp_solid_simplicial(const iccp_solid_map *map)
{
    iccp_simplicial_map simplicial = iccp_simplicial_map_of(map->mesh, map->images);
    simplicial.stretch = map->stretch;
    return simplicial;
}

/* The images of the source's mesh by two charts on meshes in space, repaired until every
 * tetrahedron is positive, which is checked exactly; where that fails, of a mesh without chords.
 * Then made fairer by so many steps; 0: 8; -1: none. Fills in the mesh's members of `info`. When
 * the repair fails, too, info->n_unrepaired is not 0 and *out is NULL, with ICC_OK. */
icc_status iccp_solid_map_create(iccp_solid_map **out, const icc_chart *source,
                                 const icc_chart *target, int32_t iterations, icc_map_info *info,
                                 const iccp_env *env);

/* ---- a map piece by piece ---- */

/* A copy for domains that may be others; it shares a mesh that is the source's, and does not find
 * points yet. *out is NULL on failure. */
icc_status iccp_solid_map_copy(iccp_solid_map **out, const iccp_solid_map *map,
                               const icc_domain *source, const icc_domain *target,
                               const iccp_memory *memory);

/* Steps that lower the energy on one mesh, as many as icc_map_options says. */
icc_status iccp_solid_map_relax(iccp_solid_map *map, const icc_domain *source,
                                const icc_improve_options *options, icc_map_info *info,
                                const iccp_env *env);

/* The rest of a map that is there: what finds points. Fills in what `info` says of the size. */
icc_status iccp_solid_map_finish(iccp_solid_map *map, icc_map_info *info, const iccp_env *env);

/* Makes images findable again after they have changed. */
icc_status iccp_solid_map_replant(iccp_solid_map *map, const iccp_env *env);

/* ---- all of it ---- */

/* A better one from a copy; see icc_map_improve(). */
icc_status iccp_solid_map_improve(iccp_solid_map **out, const iccp_solid_map *map,
                                  const icc_domain *source, const icc_domain *target,
                                  const icc_improve_options *options, icc_improve_report *report,
                                  const iccp_env *env);

/* As part of the bytes of a map (docs/formats.md). What is read is certified anew: ICC_ERR_FORMAT
 * if that fails. Writing takes no info and no env. */
icc_status iccp_solid_map_visit(iccp_blob *b, iccp_solid_map **map, const icc_domain *source,
                                const icc_domain *target, icc_map_info *info, const iccp_env *env);
void iccp_solid_map_free(iccp_solid_map *map);

/* One local point, forward or back. `jacobian`: 9 numbers row by row, or NULL. ICC_ERR_TRACE when
 * no tetrahedron holds the point, which can only be within rounding of the boundary. */
icc_status iccp_solid_map_point(const iccp_solid_map *map, bool inverse, const double *point,
                                double *image, double *jacobian);

#endif
