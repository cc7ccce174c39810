/* The view of a solid in space: by parallel rays that come to the eye. */
#ifndef SOLID_VIEW_H
#define SOLID_VIEW_H

#include "plot/cut.h"

typedef struct solid_view {
    double axes[3][3]; /* to the right, up, and to the eye: orthogonal unit vectors */
    double box[4];     /* of the visible part, along the first two axes: lower, then upper */
    double scale;      /* samples in a unit of length */
} solid_view;

/* A view from a direction, which need not have length 1. Up is y, or -z or z for an eye above or
 * below. */
solid_view view_make(const double eye[3]);

/* The default direction from which a plane is seen: almost from the front. */
void view_default_eye(const double normal[3], double eye[3]);

/* Widens the box to contain corners of one side. */
void view_widen(solid_view *v, const corners *c, size_t side);

/* A point in samples, with `margin` samples around the visible part. */
void view_place(const solid_view *v, double margin, const double at[3], double out[3]);

#endif
