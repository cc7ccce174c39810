/* Cages: boundaries of shapes, read from files.
 *
 * In the plane a ring of vertices (text, GeoJSON, WKT, SVG), in space a closed surface (OBJ, OFF,
 * PLY, STL, glTF); in both the boundary of a mesh (Medit, VTK, and the formats of surfaces); in 1 to 6 dimensions the mask of a solid (.npy). Nothing is re-wound or sorted, because
 * source and target correspond by index. In a ring a last vertex that repeats the first closes it
 * and is dropped. Holes, lines and points inside a ring are kept apart from it. */
#ifndef CAGE_H
#define CAGE_H

#include "base/say.h"

#include <icc/icc.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum cage_role { CAGE_SOURCE = 1, CAGE_TARGET = 2 } cage_role;

/* How many edges a curve becomes: a power of two, so that no edge is farther from it than `length`, and
 * not fewer than curve k of another cage has. */
typedef struct flattening {
    double length; /* 0: as many for each, whatever its size */
    size_t n_least;
    const uint32_t *least;
} flattening;

/* Which shape of a file: that with the role, or the one that is named. A name is `KEY=VALUE`: in
 * GeoJSON the feature with that property or id, in SVG the element with that attribute; or an id, in
 * SVG also the inkscape:label, by itself. */
typedef struct cage_choice {
    cage_role role;
    const char *named; /* NULL: by its role */
    flattening flat;
    const struct cage *like; /* NULL, or the boundary of a mesh: the same mesh, moved, gets vertices
                                and faces in the same order */
} cage_choice;

/* Something inside a cage in the plane. Kinds are those of icc_feature, and a tie. */
enum { CAGE_TIE = 100 };

typedef struct cage_feature {
    int32_t kind;
    int64_t number; /* a hole's among the holes, from 1; else what the file says */
    size_t n;
    double *points; /* 2 n */
    double radius;  /* of a point; 0: none */
    size_t line;    /* of its first vertex, or 0 */
} cage_feature;

typedef struct cage {
    size_t dim;      /* coordinates of a vertex; 0: nothing has been read */
    size_t n;        /* vertices; of a mask none, until its domain gives it some */
    double *points;  /* n * dim */
    size_t *lines;   /* line of each vertex in its file, or 0 where the format has none */
    size_t n_facets; /* dim vertices each; 0: the ring through the vertices */
    uint32_t *facets;
    size_t *facet_lines;       /* as `lines` */
    uint8_t *cells;            /* of a mask: one byte each, the first axis fastest; else NULL */
    size_t shape[ICC_MAX_DIM]; /* of a mask: cells along each axis */
    bool cut;                  /* at the antimeridian, into several polygons */
    bool flipped;              /* y is reversed: it has the opposite sign in the file */
    size_t n_heights;          /* vertices of a polygon whose further coordinates were left out */
    size_t n_features;         /* inside a polygon; in this order the domain's, but for circles */
    cage_feature *features;
    size_t n_ties;
    cage_feature *ties; /* polylines from a vertex to a vertex */
    size_t n_more;
    struct cage *more; /* of several polygons those behind the first */
    size_t n_curves;   /* of SVG, arcs among them, in their order */
    uint32_t *curve_edges;
    size_t room_points, room_lines, room_facets, room_facet_lines, room_features, room_curves;
    uint32_t fan[3]; /* of the face that is being read */
    /* For the boundary of a mesh: the mesh, and the mesh's number of each vertex of the cage, then of
     * each vertex of the holes. Empty for other cages. */
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

/* Adds a vertex of c->dim coordinates; in the plane of x and y. */
void cage_add_point(cage *c, const double *at, size_t line);
void cage_add(cage *c, double x, double y, size_t line);

/* Adds corner `k` (from 0) of a face; from the third on each ends a triangle of its fan. */
void cage_add_corner(cage *c, size_t k, uint32_t vertex, size_t line);

/* What is named, for messages: `name "Kent"`, `the id "Kent"`. Returns `out`. */
const char *choice_text(char out[64], const char *named);

/* The name of a role: "source" or "target". */
const char *cage_role_name(cage_role role);

#endif
