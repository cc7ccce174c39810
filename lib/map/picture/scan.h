/* Finds the rows of samples inside a triangle whose corners have places in a picture. */
#ifndef ICCP_SCAN_H
#define ICCP_SCAN_H

#include "map/picture/sampler.h"

#include <stdbool.h>

/* A corner: its position (x, y) in the target, and (u, v) in the source, counted from the centre of
 * the first pixel. */
typedef struct iccp_place {
    double x, y, u, v;
} iccp_place;

/* An edge, from its end with the smaller y, and its change per unit of y. */
typedef struct iccp_edge {
    iccp_place start, slope;
} iccp_edge;

typedef struct iccp_scan {
    iccp_edge whole, first, second; /* the first two start at the lowest corner */
    double top;                     /* y of the highest corner */
    bool whole_left;                /* true if `whole` is the left side */
    int32_t columns, rows;          /* samples in a pixel; more than one where the map shrinks
                                       the picture */
} iccp_scan;

/* `places`: the corners, counter-clockwise if y points up. */
void iccp_scan_create(iccp_scan *scan, const iccp_place *const places[3]);

/* Returns the number of samples in a pixel along which the source moves by `distance` pixels. A NaN
 * gives 1. */
enum { ICCP_MOST_SAMPLES = 16 };
int32_t iccp_samples_for(double distance);

/* Neighbouring samples in a row of pixels: the number of the first one, counted from the left edge,
 * and their places in the source. */
typedef struct iccp_run {
    int32_t row;
    size_t begin;
    iccp_line line;
} iccp_run;

/* Lists the samples of a triangle in the rows of pixels [begin, end), row by row. A pixel has
 * columns x rows samples, at ((i + 1/2) / columns, (j + 1/2) / rows) with 0 <= i < columns * width.
 * Samples on the lower boundaries belong to the triangle, so each sample is in one triangle of a
 * mesh. `runs` has room for (end - begin) * rows entries. Returns their number; none is empty. */
size_t iccp_scan_rows(const iccp_scan *scan, int32_t begin, int32_t end, int32_t columns,
                      int32_t rows, int32_t width, iccp_run *runs);

#endif
