/* Arcs of ellipses between two points, as SVG has them, and turns by degrees. */
#ifndef SVG_ARC_H
#define SVG_ARC_H

#include <stdbool.h>

/* Edges of an arc unless more or fewer are asked for. An edge of a whole ellipse is off by .005 of its
 * radius at most, one of a quarter by .0003. */
enum { ARC_EDGES = 32 };

/* What SVG says of an arc, in its order. */
typedef struct arc {
    double radii[2], turn; /* of the first axis, in degrees */
    bool large, positive;  /* positive: from x towards y */
    double to[2];
} arc;

/* The cosine and the sine of an angle in degrees; of multiples of 90 exactly. */
void turn_by(double degrees, double *cosine, double *sine);

/* Its vertices between both ends, at equal steps of the angle, and how many there are: n_edges - 1, or
 * none of an arc that is a line. `n_edges` is a power of two, and `out` has room for 2 (n_edges + 1). */
int arc_inner(double *out, int n_edges, const double from[2], const arc *a);

/* The power of two of edges, up to `most` or the next, of which none is farther from it than `tolerance`. */
int arc_edges(const double from[2], const arc *a, double tolerance, int most);

#endif
