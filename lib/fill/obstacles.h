/* Finds the obstacles of a missing edge: the parts of the mesh that the segment between its ends
 * meets. */
#ifndef ICCP_OBSTACLES_H
#define ICCP_OBSTACLES_H

#include "fill/constraints.h"

/* How segment ab meets a triangle. */
enum { ICCP_MISSES, ICCP_THROUGH, ICCP_AT_EDGE, ICCP_WITHIN };

typedef struct iccp_obstacles {
    iccp_tets *m;
    iccp_constraints *s;
    uint32_t a, b;
    iccp_list tets, crossed; /* tetrahedra and sides on the segment */
    uint32_t p, q;           /* the edge that is being removed */
    size_t most_points;
    bool rounded; /* the segment is of a line, so its points may be beside it, as doubles are */
    bool may_lose, lost; /* other edges of the surface may be lost; one was */
} iccp_obstacles;

typedef enum iccp_recovery { ICCP_PRESENT, ICCP_MISSING, ICCP_STUCK, ICCP_NO_MEMORY } iccp_recovery;

/* Tells how segment ab meets triangle x. d is a point on its positive side. If d is unknown
 * (ICCP_NO_TET), segments in the plane of x count as meeting it. */
int iccp_obstacles_meet(const iccp_obstacles *o, const uint32_t x[3], uint32_t d);

int iccp_obstacles_meet_side(const iccp_obstacles *o, uint32_t side);

/* Lists the faces that the segment meets, each from one side, and the tetrahedra there. `first` is
 * the tetrahedron at a that the segment enters. Returns false if there is no memory. */
bool iccp_obstacles_find(iccp_obstacles *o, uint32_t first);

/* Puts a point on a surface segment whose neighbouring points are o->a and o->b. Prefers a place
 * near the middle where ab meets an obstacle, and else tries other places. Call it after
 * iccp_obstacles_find(). */
iccp_recovery iccp_obstacles_split(iccp_obstacles *o, iccp_segment *segment);

#endif
