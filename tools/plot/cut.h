/* A solid cut by a plane, before and after a map. The part behind the plane stays. */
#ifndef CUT_H
#define CUT_H

#include <stddef.h>
#include <stdint.h>

typedef struct plane {
    double at[3], normal[3]; /* a unit vector that points into the half to be removed */
} plane;

/* A solid of tetrahedra inside a surface of triangles, each with its places before and after the
 * map. */
typedef struct body {
    size_t n_points, n_tets, n_vertices, n_faces;
    double *points[2];
    uint32_t *tets;
    const double *vertices[2]; /* of the surface */
    const uint32_t *faces;
} body;

typedef struct cut_corner {
    double at[2][3], normal[2][3]; /* before and after the map; normals on the surface only */
} cut_corner;

typedef struct corners {
    size_t n, room;
    cut_corner *all;
} corners;

/* Adds n corners. */
void corners_add(corners *c, size_t n, const cut_corner *more);

/* The distance of a point from the plane, positive in front of it. */
double plane_distance(const plane *p, const double at[3]);

/* Adds the triangles, three corners each, that the plane cuts from the tetrahedra. */
void cut_sheet(corners *out, const body *b, const plane *p);

/* Adds the triangles of the surface behind the plane, and the segments, two corners each, where it
 * meets the plane. */
void cut_shell(corners *shell, corners *rim, const body *b, const plane *p);

/* The area of triangles before the map. */
double corners_area(const corners *c);

#endif
