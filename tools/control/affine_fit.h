/* The affine map that misses control points least. */
#ifndef AFFINE_FIT_H
#define AFFINE_FIT_H

#include "control/control_points.h"

/* True if the points turn the other way round in the target, as rows of a picture that run down do
 * on a map. With fewer than three points, or points on a line, the format decides. */
bool affine_mirrors(const control_points *c);

/* Fits an affine map by least squares, and writes the image of each point minus its target: 2 n
 * numbers. Points that do not determine one, because they are fewer than three or lie on a line,
 * get a similarity instead, or with one place a shift. */
void affine_residuals(const control_points *c, double *residuals);

#endif
