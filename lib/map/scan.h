/* Rows of samples in a triangle that carries positions in a picture. */
#ifndef ICCP_SCAN_H
#define ICCP_SCAN_H

#include "map/sampler.h"

#include <stdbool.h>

/* A corner: its place in the target, and in the source from the centre of the first pixel. */
typedef struct iccp_place {
    double x, y, u, v;
} iccp_place;

/* From the end with the smaller y, and change per unit of y. */
typedef struct iccp_edge {
    iccp_place start, slope;
} iccp_edge;

typedef struct iccp_scan {
    iccp_edge whole, first, second; /* the first two start at the lowest corner */
    double top;                     /* y of the last corner */
    bool whole_left;                /* whether `whole` bounds rows from below in x */
    int32_t columns, rows;          /* samples in a pixel: more than one where the map shrinks */
} iccp_scan;

/* `places`: the corners, counter-clockwise when y points up. */
void iccp_scan_create(iccp_scan *scan, const iccp_place *const places[3]);

/* Samples in a pixel along which the source moves by `distance` pixels. Not a number asks for
 * one. */
enum { ICCP_MOST_SAMPLES = 16 };
int32_t iccp_samples_for(double distance);

/* The first k with (k + 1/2) / n >= x, in [0, end]. */
int64_t iccp_first_sample(double x, int32_t n, int64_t end);

/* The samples at ((k + 1/2) / n, y) in the triangle: begin <= k < end, of 0 <= k < n * width; those
 * on its lower boundaries included, so that each is in one triangle of a mesh. `line` holds where
 * they come from, and has n = 0 when there are none. */
int64_t iccp_scan_row(const iccp_scan *scan, double y, int32_t n, int32_t width, iccp_line *line);

#endif
