/* Gives two outlines common vertices, following a pairing. */
#ifndef ICCP_UNION_OUTLINE_H
#define ICCP_UNION_OUTLINE_H

#include "match/outline/elastic.h"

/* A join must not stretch an edge by more than this. */
#define ICCP_MOST_SLOPE 1e3

/* The vertices of both outlines, in order along the source, counter-clockwise. */
typedef struct iccp_union_outline {
    size_t n;
    double *share;      /* n pairs: a share of the source's length and one of the target's */
    uint32_t *vertex;   /* n pairs: vertices of the outlines, or UINT32_MAX if added on an edge */
    size_t n_joined;    /* vertices that come from both outlines */
    double least, most; /* of an edge's length in the target divided by that in the source */
} iccp_union_outline;

/* The knots pass through all landmarks (n_landmarks pairs of shares), which become vertices. Two
 * vertices of the outlines are joined if they are closer than `drop`, as a share of the
 * perimeter. */
icc_status iccp_union_outline_create(iccp_union_outline *common, const iccp_pairing_knots *knots,
                                     const iccp_outline *source, const iccp_outline *target,
                                     size_t n_landmarks, const double *landmarks, double drop,
                                     const iccp_memory *memory);

/* Accepts a struct of zeros. */
void iccp_union_outline_free(iccp_union_outline *common, const iccp_memory *memory);

#endif
