/* How a body in space is seen: by parallel rays, which come to the eye. */
#ifndef SOLID_VIEW_H
#define SOLID_VIEW_H

#include "plot/cut.h"

typedef struct solid_view {
    double axes[3][3]; /* to the right, up, to the eye: of length 1 and orthogonal */
    double box[4];     /* of what is seen, along the first two: lower, then upper */
    double scale;      /* samples for a unit of length */
} solid_view;

/* A view from a direction, which need not have length 1. Upwards is y; for an eye above or below,
 * it is -z or z. */
solid_view view_make(const double eye[3]);

/* The direction from which a plane is seen by default: nearly from the front. */
void view_default_eye(const double normal[3], double eye[3]);

/* Widens the box to hold corners, of one side. */
void view_widen(solid_view *v, const corners *c, size_t side);

/* A point in samples, `margin` of them around what is seen. */
void view_place(const solid_view *v, double margin, const double at[3], double out[3]);

#endif
