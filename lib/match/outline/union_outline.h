/* Two outlines with common vertices, from a pairing of them. */
#ifndef ICCP_UNION_OUTLINE_H
#define ICCP_UNION_OUTLINE_H

#include "match/outline/elastic.h"

/* Edges are not stretched by more for a join. */
#define ICCP_MOST_SLOPE 1e3

/* Vertices that both outlines have, in order along the source, counter-clockwise. */
typedef struct iccp_union_outline {
    size_t n;
    double *share;      /* n pairs: shares of the source's length and of the target's */
    uint32_t *vertex;   /* n pairs: vertices of the outlines, or UINT32_MAX: added on an edge */
    size_t n_joined;    /* with a vertex of each */
    double least, most; /* of the length of an edge in the target by that in the source */
} iccp_union_outline;

/* Knots pass through all landmarks (n_landmarks pairs of shares), which become vertices. `drop`:
 * vertices of the two outlines join where they are so near, in shares of the perimeter. */
icc_status iccp_union_outline_create(iccp_union_outline *common, const iccp_pairing_knots *knots,
                                     const iccp_outline *source, const iccp_outline *target,
                                     size_t n_landmarks, const double *landmarks, double drop,
                                     const iccp_memory *memory);

/* Accepts one that is all zero. */
void iccp_union_outline_free(iccp_union_outline *common, const iccp_memory *memory);

#endif
