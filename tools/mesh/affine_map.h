/* Affine maps of space as 12 numbers: the rows of (A | b). */
#ifndef AFFINE_MAP_H
#define AFFINE_MAP_H

#include <stdbool.h>

void affine_none(double out[12]);
bool affine_is_none(const double a[12]);

/* First b, then a; `out` is neither. */
void affine_compose(double out[12], const double a[12], const double b[12]);

/* False: the map is singular, or so nearly that floats cannot tell it from one that is. */
bool affine_invert(double out[12], const double a[12]);

double affine_determinant(const double a[12]);

void affine_apply(double out[3], const double a[12], const double point[3]);

/* What A makes of a direction, and what its transpose does. */
void affine_turn(double out[3], const double a[12], const double v[3]);
void affine_turn_back(double out[3], const double a[12], const double v[3]);

/* What a normal becomes where the derivative of a map is A: by its inverse transpose, with the length that
 * it had. False: there is none. */
bool affine_turn_normal(double out[3], const double a[12], const double normal[3]);

/* Gives a vector another length. False: it has none. */
bool affine_set_length(double v[3], double length);
double affine_length(const double v[3]);

#endif
