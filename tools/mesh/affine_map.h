/* Affine maps of space as 12 numbers: the rows of (A | b). */
#ifndef AFFINE_MAP_H
#define AFFINE_MAP_H

#include <stdbool.h>

/* The identity. */
void affine_identity(double out[12]);
bool affine_is_identity(const double a[12]);

/* The map that applies b first, then a. `out` must be neither of them. */
void affine_compose(double out[12], const double a[12], const double b[12]);

/* False if the map is singular, or cannot be distinguished from a singular map in floats. */
bool affine_invert(double out[12], const double a[12]);

double affine_determinant(const double a[12]);

void affine_apply(double out[3], const double a[12], const double point[3]);

/* Applies A to a direction, and its transpose. */
void affine_turn(double out[3], const double a[12], const double v[3]);
void affine_turn_back(double out[3], const double a[12], const double v[3]);

/* The image of a normal under a map with derivative A: by the inverse transpose, with the same
 * length. False if there is none. */
bool affine_turn_normal(double out[3], const double a[12], const double normal[3]);

/* The rotation of a map's polar decomposition, or the reflection of one that reverses: the orthogonal
 * matrix nearest to A. False if A is singular. */
bool affine_rotation(double out[12], const double a[12]);

/* Scales a vector to a length. False if it is zero or not finite. */
bool affine_set_length(double v[3], double length);
double affine_length(const double v[3]);

#endif
