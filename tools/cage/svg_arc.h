/* Arcs of ellipses between two points, as SVG describes them, and turns by degrees. */
#ifndef SVG_ARC_H
#define SVG_ARC_H

#include <stdbool.h>

/* Number of edges of an arc, unless a tolerance is given. For a whole ellipse an edge is off by at
 * most 0.005 of the radius, for a quarter by 0.0003. */
enum { ARC_EDGES = 32 };

/* The parameters of an arc in SVG, in its order. */
typedef struct arc {
    double radii[2], turn; /* of the first axis, in degrees */
    bool large, positive;  /* positive: from x towards y */
    double to[2];
} arc;

/* The cosine and the sine of an angle in degrees, exact for multiples of 90. */
void turn_by(double degrees, double *cosine, double *sine);

/* Computes the vertices between both ends, at equal steps of the angle. Returns their number:
 * n_edges - 1, or none if the arc is a line. `n_edges` is a power of two, and `out` has room for 2
 * (n_edges + 1). */
int arc_inner(double *out, int n_edges, const double from[2], const arc *a);

/* Returns the number of edges, a power of two, such that none is farther from the arc than
 * `tolerance`. It is at most `most` or the next power of two. */
int arc_edges(const double from[2], const arc *a, double tolerance, int most);

#endif
