/* Map kind mesh in space: a piecewise linear map on the source's conforming mesh. It needs no
 * charts.
 *
 * Words of this folder
 * - inverted: a tetrahedron whose image is not positive. stuck: one that a repair has left
 *   inverted.
 * - chord: an inner edge that joins two fixed points. neck: an inner face between three of them.
 * - pocket: a stuck tetrahedron with some rings of neighbours (a cavity).
 *
 * Invariants
 * - Every tetrahedron of a finished map is positive before and after the map, by exact predicates.
 * - The surface of the mesh never changes; only the inside may get points.
 *
 * Ways to a first map (the table in solid_start.c, in this order)
 * - solid_ways.h: harmonic images, repaired.
 * - solid_pockets.h: pockets are mapped anew.
 * - solid_chain.h, for solids with features: the features shrink, move (feature_motion.h) and grow.
 * - Later: solid_improve.h lowers the energy, and solid_follow.h follows a moving target.
 *
 * Files that these use
 * - Before all: fill/filled_pair.h fills both surfaces (map/map.c calls it).
 * - solid_marks.h says what is fixed. The mesh is changed by solid_edit.h: solid_chords.h cuts what
 *   has only fixed corners, solid_cuts.h other edges, solid_flips.h flips. solid_certificate.h
 *   proves, solid_kind.h has the operations.
 *
 * Begin with solid_map.c and solid_start.c. */
#ifndef ICCP_SOLID_MAP_H
#define ICCP_SOLID_MAP_H

#include "map/kind/kind.h"

/* The strategy that found a first map (solid_start.c). */
typedef enum iccp_solid_way {
    ICCP_SOLID_DIRECTLY = 1,
    ICCP_SOLID_BY_POCKETS,
    ICCP_SOLID_BY_CHAIN
} iccp_solid_way;

/* Immutable once made. */
typedef struct iccp_solid_map {
    iccp_memory memory;
    const iccp_simplices *mesh; /* the source domain's mesh, or: */
    iccp_simplices *own;        /* a mesh with more points, or NULL */
    double *images;             /* of the mesh's points, local in the target */
    double stretch;             /* as in iccp_simplicial_map */
    iccp_solid_way way;         /* 0 for a map that was read from a file */
    iccp_facet_tree before, after;
} iccp_solid_map;

/* Returns true if the points on lines follow the vertices of the domain, in the order of on_line[].
 * That is so in the mesh of a map. */
bool iccp_solid_is_ordered(const iccp_simplices *mesh);

/* Returns a view of a map. The points on lines are fixed, too. */
static inline iccp_simplicial_map iccp_solid_simplicial(const iccp_solid_map *map)
{
    iccp_simplicial_map simplicial = iccp_simplicial_map_of(map->mesh, map->images);
    simplicial.n_fixed += map->mesh->n_on_lines;
    simplicial.stretch = map->stretch;
    return simplicial;
}

/* Writes the images of the fixed points of a mesh: the target's vertices, and the same shares of
 * its lines. */
void iccp_solid_place_fixed(const iccp_simplices *mesh, const icc_domain *target, double *images);

/* Makes a map from a source with a mesh: harmonic images, repaired until every tetrahedron is
 * positive, exactly. If this fails, it uses a mesh without chords, the target's mesh and further
 * strategies (solid_start.h). Then the given number of steps lowers the energy. -1 means none. 0
 * means up to 20, and refinements of a map whose energy stays high. Fills in the mesh's members of
 * `info`. If all repairs fail, *out is NULL, with
 * ICC_OK, and info->n_unrepaired is not 0. */
icc_status iccp_solid_map_create(iccp_solid_map **out, const icc_domain *source,
                                 const icc_domain *target, int32_t iterations, iccp_map_facts *info,
                                 const iccp_env *env);

/* ---- making a map piece by piece ---- */

/* Copies a map for domains that may be different. The copy shares a mesh that is the source's. It
 * cannot find points yet. *out is NULL on failure. */
icc_status iccp_solid_map_copy(iccp_solid_map **out, const iccp_solid_map *map,
                               const icc_domain *source, const icc_domain *target,
                               const iccp_memory *memory);

/* Takes steps that lower the energy on one mesh, as many as icc_map_options says. */
icc_status iccp_solid_map_relax(iccp_solid_map *map, const icc_domain *source,
                                const icc_improve_options *options, iccp_map_facts *info,
                                const iccp_env *env);

/* Finishes a map: makes its points findable and fills in the sizes in `info`. */
icc_status iccp_solid_map_finish(iccp_solid_map *map, iccp_map_facts *info, const iccp_env *env);

/* Makes points findable again after images have changed. */
icc_status iccp_solid_map_replant(iccp_solid_map *map, const iccp_env *env);

/* ---- whole maps ---- */

/* Makes a better map from a copy; see icc_map_improve(). */
icc_status iccp_solid_map_improve(iccp_solid_map **out, const iccp_solid_map *map,
                                  const icc_domain *source, const icc_domain *target,
                                  const icc_improve_options *options, icc_improve_report *report,
                                  const iccp_env *env);

/* Reads or writes a map as part of its bytes (docs/reference/formats.md). A map that is read still
 * needs its certificate. Writing takes no info and no env. */
icc_status iccp_solid_map_visit(iccp_blob *b, iccp_solid_map **map, const icc_domain *source,
                                const icc_domain *target, iccp_map_facts *info,
                                const iccp_env *env);
void iccp_solid_map_free(iccp_solid_map *map);

/* Maps one local point, forward or back. `jacobian`: 9 numbers row by row, or NULL. ICC_ERR_TRACE
 * if no tetrahedron contains the point, which can only happen within rounding of the boundary. */
icc_status iccp_solid_map_point(const iccp_solid_map *map, bool inverse, const double *point,
                                double *image, double *jacobian);

#endif
