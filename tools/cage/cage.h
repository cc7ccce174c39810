/* Cages: boundaries of shapes, read from files.
 *
 * In the plane a cage is a ring of vertices (text, GeoJSON, WKT, SVG). In space it is a closed
 * surface (OBJ, OFF, PLY, STL, glTF). In both it may be the boundary of a mesh (Medit, VTK, and the
 * formats of surfaces). In 1 to 6 dimensions it may be the mask of a solid (.npy).
 *
 * Nothing is reversed or sorted, because source and target correspond by index. A ring's last
 * vertex is dropped if it repeats the first. Holes, regions, lines and points are kept apart from
 * the outer ring. Without an outer ring, the domain is what the regions cover.
 *
 * Words of this folder
 * - role: source or target. choice: the shape of a file that is read.
 * - feature: a hole, a region, a line or a point of a cage. tie: a path that says on which side a
 *   map passes features.
 * - region: a polygon whose sides are lines. Its inside belongs to the domain.
 * - flattening: replacing curves by edges. welding: joining vertices at one place.
 * - filling: a mesh of the inside, whose boundary is the cage.
 *
 * Ways
 * - SVG: cage_svg.c, its tags xml_tags.h, transforms svg_transform.h, path data cage_path.c, arcs
 *   svg_arc.h, outlines and holes contours.h.
 * - Pictures: cage_picture.c, alpha_contours.h finds outlines, thin_polygons.h thins them.
 * - Features: cage_features.h, ties cage_ties.h. Degrees: cage_degrees.h. Defects: cage_defects.h.
 * - Surfaces: cage_surface.c reads, weld.h joins vertices, mend.h mends scans (sides.h finds which
 *   triangles meet), surface_write.h writes, filling.h reads their insides. Frames of an animation: cage_between.h.
 *
 * A format is a file cage_NAME.c with one reader (cage_readers.h). Begin with cage_read.c. */
#ifndef CAGE_H
#define CAGE_H

#include "base/say.h"

#include <icc/icc.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum cage_role { CAGE_SOURCE = 1, CAGE_TARGET = 2 } cage_role;

/* The number of edges of a curve. It is a power of two, such that no edge is farther from the curve
 * than `length`. It is not smaller than that of curve k of another cage. */
typedef struct flattening {
    double length; /* 0: the same number for each curve, whatever its size */
    size_t n_least;
    const uint32_t *least;
} flattening;

/* Chooses a shape of a file: by its role, or by a name. A name is `KEY=VALUE`. In GeoJSON it means
 * the feature with that property or id, in SVG the element with that attribute. A name may also be
 * an id alone, in SVG also an inkscape:label. */
typedef struct cage_choice {
    cage_role role;
    const char *named; /* NULL to choose by role */
    flattening flat;
    bool may_slide;          /* vertices may slide along a wall */
    const struct cage *like; /* NULL, or the boundary of a mesh. If the file has the same mesh,
                                moved, it gets vertices and faces in the same order */
} cage_choice;

/* A feature of a cage. The kinds are those of icc_feature, and ties. In space a hole is a void, and a
 * region is a surface with the domain on both sides. */
enum { CAGE_TIE = 100 };

typedef struct cage_feature {
    int32_t kind;
    int64_t number;  /* of a hole of the outer ring: from 1. For the rings of one of several
                        outlines: the number of their polygon, from 1. Else the number in the
                        file */
    bool of_outline; /* a ring of one of several outlines */
    bool filled;     /* a line around the inside of a hole */
    size_t ring;     /* of a region or outline, which may have several: its number, from 0 */
    size_t item;     /* of such a ring: its number among the holes, or the others, from 1. Else 0 */
    size_t n;
    double *points;   /* n vertices */
    double radius;    /* of a point; 0 if it has none */
    size_t line;      /* of its first vertex, or 0 */
    char *label;      /* in space: its name in the file, or NULL */
    size_t n_facets;  /* of a surface in space */
    uint32_t *facets; /* 3 n_facets of its own vertices */
} cage_feature;

typedef struct cage {
    size_t dim;      /* coordinates of a vertex; 0 if nothing has been read */
    size_t n;        /* vertices; a mask has none until its domain is made, and a cage of regions
                        has none */
    double *points;  /* n * dim */
    size_t *lines;   /* line of each vertex in its file, or 0 if the format has no lines */
    size_t n_facets; /* dim vertices each; 0 means the ring through the vertices */
    uint32_t *facets;
    size_t *facet_lines;       /* as `lines` */
    uint8_t *cells;            /* of a mask: one byte for each cell, the first axis fastest; else
                                  NULL */
    size_t shape[ICC_MAX_DIM]; /* of a mask: cells along each axis */
    bool cut;                  /* it was cut at the antimeridian into several polygons */
    bool of_picture;           /* the outline of what is opaque in a picture */
    bool flipped;              /* y is reversed: the file has the opposite sign */
    size_t n_sliding;          /* vertices of a text whose row says that they may slide along a
                                  wall; their coordinates are nan */
    size_t n_heights;          /* vertices of a polygon that had further coordinates, which were
                                  ignored */
    size_t n_features;         /* of a polygon or coverage; in the domain's order, except
                                  circles */
    cage_feature *features;
    size_t n_ties;
    cage_feature *ties; /* polylines from a vertex to a vertex */
    size_t n_more;
    struct cage *more; /* the further ones of several polygons */
    size_t n_curves;   /* of SVG, including arcs, in their order */
    uint32_t *curve_edges;
    size_t room_points, room_lines, room_facets, room_facet_lines, room_features, room_curves;
    size_t room_more;
    uint32_t fan[3]; /* of the face being read */
    /* For the boundary of a mesh: the mesh, and the mesh's numbers of the cage's vertices, then of
     * the holes' vertices. Empty for other cages. */
    size_t n_mesh_vertices, n_simplices, n_mesh, room_mesh;
    uint32_t *simplices, *mesh_vertices;
} cage;

void cage_free(cage *c);

/* Reverses y of n points of the plane; 0 stays 0. */
void points_flip_y(size_t n, double *points);

/* Reverses y in a cage in the plane. A second call restores it. */
void cage_flip_y(cage *c);

/* The y of a point as the cage's file has it. */
double cage_given_y(const cage *c, const double *point);

/* ---- for the readers ---- */

/* Adds a vertex of c->dim coordinates. */
void cage_add_point(cage *c, const double *at, size_t line);
void cage_add(cage *c, double x, double y, size_t line);

/* Adds corner `k` (from 0) of a face. From the third one on, each corner ends a triangle of its
 * fan. */
void cage_add_corner(cage *c, size_t k, uint32_t vertex, size_t line);

/* A named shape for messages: `name "Kent"`, `the id "Kent"`. Returns `out`. */
const char *choice_text(char out[64], const char *named);

/* The name of a role: "source" or "target". */
const char *cage_role_name(cage_role role);

#endif
