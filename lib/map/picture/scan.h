/* Rows of samples in a triangle that carries positions in a picture. */
#ifndef ICCP_SCAN_H
#define ICCP_SCAN_H

#include "map/picture/sampler.h"

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

/* Samples side by side in a row of pixels: the first one's number from the left edge, and where
 * they come from. */
typedef struct iccp_run {
    int32_t row;
    size_t begin;
    iccp_line line;
} iccp_run;

/* The samples of a triangle in the rows of pixels [begin, end), columns x rows in a pixel, row by
 * row: those at ((i + 1/2) / columns, (j + 1/2) / rows) with 0 <= i < columns * width; those on its
 * lower boundaries included, so that each is in one triangle of a mesh. `runs` has room for
 * (end - begin) * rows; returns how many there are, none of them empty. */
size_t iccp_scan_rows(const iccp_scan *scan, int32_t begin, int32_t end, int32_t columns,
                      int32_t rows, int32_t width, iccp_run *runs);

#endif
