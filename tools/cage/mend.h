/* Mends what a scanner leaves behind in a surface: triangles that repeat others, small pieces
 * beside the body, triangles that are turned over, and small holes. Prints what it did, with the
 * numbers of faces. */
#ifndef MEND_H
#define MEND_H

#include "cage/cage.h"

typedef struct mended {
    size_t n_repeated;     /* faces that were left out because others have the same corners */
    size_t n_crumbs;       /* pieces that were left out */
    size_t n_turned;       /* faces that were turned over */
    size_t n_holes;        /* holes that were filled */
    size_t n_filled_faces; /* with this many faces */
} mended;

/* A piece or a hole is small if it has at most this share of the area of the largest piece. */
#define MEND_SMALL 0.05

/* Mends a surface in space whose vertices are joined (weld.h). A piece is connected by sides
 * that two faces share. Small pieces outside the largest one are left out. The faces of a piece
 * are turned like most of them. A small hole is filled with the triangles of least area, without
 * new vertices. Refuses one-sided surfaces and holes that are not small. `file` is for messages. */
int mend_surface(cage *c, const char *file, mended *did);

/* ---- for mend.c ---- */

/* Twice the area of a triangle. */
double mend_area2(const double *a, const double *b, const double *c);

/* Fills the holes of a surface whose faces are turned alike. `area` is that of the largest
 * piece. */
int mend_holes(cage *c, const char *file, double area, mended *did);

#endif
