/* The exact orientation of a triangle. */
#ifndef ORIENT_H
#define ORIENT_H

/* +1 if a, b, c turn counter-clockwise (with y upwards), -1 if clockwise, 0 if they are on a line.
 * Exact for coordinates of any size, unless some differ by more than a factor 2^980. All finite. */
int orientation(const double a[2], const double b[2], const double c[2]);

#endif
