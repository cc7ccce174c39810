/* What a mesh has in the way of an edge that it lacks. */
#ifndef ICCP_WAY_H
#define ICCP_WAY_H

#include "fill/surface.h"

/* How the way from a to b meets a triangle. */
enum { ICCP_MISSES, ICCP_THROUGH, ICCP_AT_EDGE, ICCP_WITHIN };

typedef struct iccp_way {
    iccp_tets *m;
    iccp_surface *s;
    uint32_t a, b;
    iccp_list tets, crossed; /* crossed: sides */
    uint32_t p, q;           /* the edge that is being removed */
    size_t most_points;
    bool may_lose, lost; /* other edges of the surface */
} iccp_way;

typedef enum iccp_recovery { ICCP_PRESENT, ICCP_MISSING, ICCP_STUCK, ICCP_NO_MEMORY } iccp_recovery;

/* How triangle x is met. Where d, on its positive side, is unknown, as ICCP_NO_TET, all that lies
 * in the plane of x is taken to be met. */
int iccp_way_meets(const iccp_way *w, const uint32_t x[3], uint32_t d);

int iccp_way_meets_side(const iccp_way *w, uint32_t side);

/* Lists the faces that are met, each from one side, and the tetrahedra there, beginning with one at
 * a that the way runs into. False if there is no memory. */
bool iccp_way_follow(iccp_way *w, uint32_t first);

/* Puts a point on a segment, which w->a and w->b follow each other on, where the way that has been
 * followed meets something near its middle, or elsewhere if that fails. */
iccp_recovery iccp_way_split(iccp_way *w, iccp_segment *segment);

#endif
