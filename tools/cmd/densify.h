/* Lines that stay true when they are mapped: with more vertices where the map bends them. */
#ifndef DENSIFY_H
#define DENSIFY_H

#include "job/job.h"

typedef struct polyline {
    size_t n;
    double *points; /* 3 n: x, y, and z or NaN */
    double *images; /* 2 n; NaN: no image */
    size_t room;
} polyline;

/* Adds a vertex. */
void polyline_add(polyline *line, const double point[3]);
void polyline_free(polyline *line);

/* Maps the vertices. */
int polyline_map(polyline *line, job *j);

/* Maps the line, and inserts vertices until no piece's image is farther than `tolerance` from a straight
 * line, as seen at three points of the piece; at most 4096 pieces between two vertices. Where the line
 * leaves the cage and comes back there is a vertex without image. */
int polyline_densify(polyline *line, job *j, double tolerance);

#endif
