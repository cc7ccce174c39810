/* The parts of `libicc plot`, and the pictures of all commands.
 *
 * Words of this folder
 * - picture: an array of samples (picture.h). style: how it is written to a file.
 * - panel: one shape in a drawing. pattern: the checkerboard or the u v map.
 * - stages: the intermediate results of a chart that are drawn (stages.h).
 * - sheet: the cut through a solid (solid_cut.h).
 *
 * Ways
 * - Figures: plot_shape.c (outline, curves, tree), plot_picture.c (patterns), plot_surface.c
 *   (relief), plot_pairs.c (matches), plot_vtk.c. On svg.h.
 * - Space: plot_solid.c, on solid_cut.h, solid_view.h, cut.h; hidden parts: z_buffer.h.
 * - Pictures: picture_warp.h by a map, picture_sample.h between pixels, coverage.h whether a cage
 *   fits.
 *
 * A format of pictures is a file NAME_io.c, and a line each in picture.h, picture_file.c and
 * job/output_name.c. Begin with plot_shape.c, or with picture_file.h for pictures. */
#ifndef PLOT_H
#define PLOT_H

#include "plot/stages.h"
#include "plot/svg.h"

/* The place of a shape in a drawing: its bounding box is stretched over a box of the drawing. */
typedef struct panel {
    FILE *svg;
    const stages *stages;
    int side;      /* 1 source, 2 target */
    char clip[48]; /* id of the shape's clip path */
    double left, top, width, height, scale;
    bool y_down;
} panel;

/* The checkerboard and the u v map: a colour by place in the source. */
typedef enum pattern { PATTERN_CHECKERBOARD, PATTERN_UV } pattern;

/* Convert a position of the shape to the drawing, and back. */
void panel_place(const panel *p, const double at[2], double out[2]);
void panel_locate(const panel *p, double x, double y, double out[2]);

/* Defines the clip path of the shape. */
void plot_clip(const panel *p, const cage *c);

/* Draws the outline, the features inside, and the ties of the map or else the given ones. Call it
 * last. */
void plot_cage(const panel *p, const job *j);

/* Draws numbers at corresponding places of matched outlines. */
void plot_pairs(const panel *p, const job *j);

/* True if the shape is drawn with the map's triangles, because the map has them or the user asks
 * for them. Such a map does not carry along the curves of its charts. */
bool shows_triangles(const stages *s, const job *j);

/* Draws the function as shades, the tree, expansion edges, integral curves and the maximum. */
int plot_shape(const panel *p, job *j);

/* Draws the function as a surface, with the outline and the curves on it. */
int plot_surface(const panel *p, job *j);

/* The places in the source of the samples of a raster over a panel. Both patterns need them. */
typedef struct places {
    size_t width, height; /* of the picture, in pixels; each pixel has several samples */
    double *points;       /* NaN if there is no place */
} places;

int places_make(places *out, const panel *p, job *j);
void places_free(places *s);

/* Draws a pattern that is painted on the source, as the map carries it to the panel's shape. */
int plot_pattern(const panel *p, job *j, const places *from, pattern what);

/* The whole command for a figure in a file .vtk: the source for ParaView, in the plane or in
 * space. */
int plot_vtk(const args *a);

/* The figure of a map in space: OUT.svg or OUT.png. */
int plot_solid(job *j);

/* Integral curves from points spread evenly along the boundary. */
typedef struct curves {
    size_t n;
    size_t *starts; /* n + 1: curve i has the points starts[i] .. starts[i + 1] */
    double *points;
} curves;

int curves_make(curves *out, const panel *p, job *j);
void curves_free(curves *c);

#endif
