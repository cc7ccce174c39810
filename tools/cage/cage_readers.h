/* The readers of cages, one for each format. */
#ifndef CAGE_READERS_H
#define CAGE_READERS_H

#include "cage/cage.h"

bool cage_read_text(cage *out, size_t dim, bool may_slide, const char *text, size_t n,
                    problem *wrong);
bool cage_read_geojson(cage *out, const cage_choice *choice, const char *text, size_t n,
                       problem *wrong);
bool cage_read_wkt(cage *out, const char *text, size_t n, problem *wrong);
bool cage_read_svg(cage *out, const cage_choice *choice, const char *text, size_t n,
                   problem *wrong);

/* True if some part of the file has the role. */
bool cage_geojson_has(cage_role role, const char *text, size_t n);
bool cage_svg_has(cage_role role, const char *text);

/* Reads the outline of what is opaque in a picture, within `choice->flat.length` pixels. */
bool cage_read_picture(cage *out, const cage_choice *choice, const char *text, size_t n,
                       problem *wrong);

/* Takes the outlines of what is opaque in a picture, within `distance` pixels (0: one pixel), and
 * then moves them outwards by up to `growth`. Several outlines are several polygons. */
struct picture;
bool cage_take_alpha(cage *out, const struct picture *p, double distance, double growth,
                     problem *wrong);
bool cage_read_npy(cage *out, const char *text, size_t n, problem *wrong);

/* Reads OBJ, OFF, PLY, STL, glTF, Medit and VTK. The result is a surface in space, whose larger
 * faces become fans of triangles, or the boundary of tetrahedra, or the boundary of faces in the
 * plane. For a target, `dim` is the dimension of the source. */
bool cage_read_surface(cage *out, const cage_choice *choice, size_t dim, const char *text, size_t n,
                       problem *wrong);

/* Takes the boundary of a mesh. `like`: see cage_choice. */
struct mesh_file;
bool cage_take_mesh(cage *out, const struct mesh_file *m, const cage *like, problem *wrong);

/* Reads the data of an SVG path, which is on line `line` of its file and ends at `end` or '\0'. */
bool cage_read_path(cage *out, const char *data, const char *end, size_t line,
                    const flattening *flat, problem *wrong);

#endif
