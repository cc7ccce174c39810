/* Maps a GeoJSON text: coordinates and bounding boxes change, and nothing else.
 *
 * Words of this folder
 * - carry: to map geometries and write them in place of the old ones.
 * - object, span: a GeoJSON object, and its place in the text (geo_index.h).
 * - shape, path: the coordinates of a geometry; a line or ring of it (geo_shape.h).
 * - node: a vertex, or a place where a line meets the cage (noding.h).
 * - height: a third number of a position. It is copied, or interpolated where a vertex is new
 *   (geo_write.c).
 * - policy, fate: the choice for geometries that leave the cage, and its result.
 * - layer, side: all lines and rings of a file, and a straight piece between two of its nodes
 *   (geo_layer.h).
 * - edge, cut: an edge of the map's triangles, and a place where a side crosses it (map_edges.h).
 *
 * Ways
 * - A geometry inside the cage is mapped in place, with more vertices where the map bends it
 *   (densify.h, geo_write.c). Others follow the policy: kept, emptied or clipped (geo_cut.c,
 *   clip.h, clip_rings.h).
 * - Polygons that share sides keep sharing them: contacts.h tells whether there may be any,
 *   geo_layer.h finds the sides, and map_edges.h cuts them. They ask near_sides.h and
 *   segment_tree.h.
 * - Bounding boxes: geo_bounds.c, last. Edges near a segment: cage_grid.h. The map or maps:
 *   carrier.h.
 *
 * Begin with geo_carry.c. */
#ifndef GEO_CARRY_H
#define GEO_CARRY_H

#include "base/edits.h"
#include "geo/geo_index.h"
#include "geo/noding.h"

/* What to do with geometries that are not wholly inside the cage. */
typedef enum geo_policy { GEO_KEEP, GEO_NULL, GEO_CLIP, GEO_FAIL } geo_policy;

/* How lines and rings are mapped. */
typedef struct geo_options {
    geo_policy policy;
    double tolerance; /* of lines that are sampled */
    /* Makes the images of all lines exact. All maps must then be mesh maps. Without it, mesh maps
     * do that for layers whose polygons share sides. */
    bool exact;
    double drop; /* exact lines lose vertices, except nodes, as long as they stay that close; 0:
                    none */
} geo_options;

/* A feature, or a geometry outside any feature, that was not carried unchanged. */
typedef struct geo_fault {
    bool feature;
    uint32_t number;  /* of the feature in its list, from 0 */
    geo_span id;      /* of the feature, in the text */
    size_t line;      /* where it begins */
    size_t n_without; /* positions without image */
    const char *fate; /* "kept", "null", "clipped", "refused" */
} geo_fault;

typedef struct geo_result {
    edits edits;
    size_t n_features;             /* including geometries outside any feature */
    size_t n_positions, n_without; /* positions, and how many of them have no image */
    size_t n_jumps; /* lines and rings whose longitudes jump, as at the antimeridian */
    size_t n_faults, room_faults;
    geo_fault *faults;
    bool exact;      /* the images of lines are exact, up to `drop` */
    size_t n_shared; /* sides of at least two polygons */
    size_t n_put_in; /* vertices on sides of their neighbours, which have got them */
    bool sequence;   /* of texts (GeoJSONSeq) */
} geo_result;

/* Carries text[0..n), with text[n] == '\0'. False: see `wrong`. Free the result in either case. */
bool geo_carry(geo_result *out, const carrier *carries, const geo_options *options,
               const char *text, size_t n, problem *wrong);
void geo_result_free(geo_result *r);

#endif
