/* Finds the points of a set that come close to its segments. */
#ifndef NEAR_SIDES_H
#define NEAR_SIDES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A segment between two points, or only a point if both are the same. */
typedef struct near_item {
    uint32_t a, b;
} near_item;

/* Takes a point and an item. False ends the search. */
typedef bool near_report(void *context, uint32_t point, size_t item);

/* Reports every point that is `a` of an item and at most `near` away from the segment of an item, of
 * which it is no end. Each such pair is reported once, in any order, and some that are up to twice as
 * far apart. */
void near_sides(size_t n, const near_item *items, size_t n_points, const double *points,
                double near, near_report *report, void *context);

/* The same distance, and more than the rounding of distances between points of this size. */
double near_rounded(double near, double largest);

#endif
