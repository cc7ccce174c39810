/* The parts of `libicc plot`. */
#ifndef PLOT_H
#define PLOT_H

#include "plot/stages.h"
#include "plot/svg.h"

/* Where a shape is drawn: its bounding box, stretched over a box of the drawing. */
typedef struct panel {
    FILE *svg;
    const stages *stages;
    int side;      /* 1 source, 2 target */
    char clip[48]; /* id of the shape's clip path */
    double left, top, width, height, scale;
    bool y_down;
} panel;

/* What the checkerboard and the u v map paint: a colour by place in the source. */
typedef enum pattern { PATTERN_CHECKERBOARD, PATTERN_UV } pattern;

/* A position of the shape in the drawing, and back. */
void panel_place(const panel *p, const double at[2], double out[2]);
void panel_locate(const panel *p, double x, double y, double out[2]);

/* Defines the clip path of the shape. */
void plot_clip(const panel *p, const cage *c);

/* The outline with what is inside, and the map's ties, or else those that were given; drawn last. */
void plot_cage(const panel *p, const job *j);

/* Numbers at places of the outlines that go together, where these were matched. */
void plot_pairs(const panel *p, const job *j);

/* True if the shape is drawn with the map's triangles, because the map has them or the user asks for
 * them. The curves of its charts would not be the ones that such a map carries along. */
bool shows_triangles(const stages *s, const job *j);

/* Function as shades, tree, expansion edges, integral curves, maximum. */
int plot_shape(const panel *p, job *j);

/* The function as a surface, with the outline and the curves on it. */
int plot_surface(const panel *p, job *j);

/* Where in the source the samples of a raster over a panel come from; both patterns need it. */
typedef struct places {
    size_t width, height; /* of the picture, in pixels; each has several samples */
    double *points;       /* NaN: nowhere */
} places;

int places_make(places *out, const panel *p, job *j);
void places_free(places *s);

/* A pattern painted on the source, as the shape of the panel inherits it. */
int plot_pattern(const panel *p, job *j, const places *from, pattern what);

/* The whole command when the figure is a file .vtk: the source for ParaView, in the plane or in
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
