/* The exact orientation of simplices. */
#ifndef ORIENTATION_H
#define ORIENTATION_H

/* +1 if a, b, c turn counter-clockwise (with y upwards), -1 if clockwise, 0 if they are on a line.
 * Exact for coordinates of any size, unless some differ by more than a factor 2^980. All finite. */
int orientation(const double a[2], const double b[2], const double c[2]);

/* The sign of the determinant of b - a, c - a, d - a; 0 if the four are in a plane. Exact unless
 * some coordinates differ by more than a factor 2^600. All finite. */
int orientation_3d(const double a[3], const double b[3], const double c[3], const double d[3]);

#endif
