/* A grid of cells over a polygon that answers "inside, outside or on the edge" without a search:
 * cells that no edge comes near know the answer, the others know a point of theirs for which it
 * is known and the edges that can lie between. */
#ifndef ICCP_BUCKETS_H
#define ICCP_BUCKETS_H

#include "geometry/band.h"
#include "geometry/polygon.h"
#include "icc/icc.h"

typedef struct iccp_bucket {
    uint32_t first; /* the cell's edges are edges[first] up to the next cell's first */
    uint32_t state; /* 2 * number of the cell's known point + whether that lies inside */
} iccp_bucket;

typedef struct iccp_buckets {
    const double *points;      /* the polygon's, borrowed */
    size_t n;                  /* its edges */
    double lower[2], upper[2]; /* beyond this box everything is outside */
    double origin[2];
    double step[2], rate[2]; /* size of a cell, and 1 / size */
    uint32_t size[2];        /* cells along x and y */
    iccp_band band;
    iccp_bucket *cells; /* one more than there are cells; NULL: none yet */
    uint32_t *edges;    /* positions in the polygon, cell by cell */
} iccp_buckets;

/* What is known about a point. */
typedef struct iccp_location {
    int32_t where; /* ICC_INSIDE, ICC_BOUNDARY, ICC_OUTSIDE */
    uint32_t edge; /* for ICC_BOUNDARY: the nearest edge, */
    double t;      /* and the share of the way along it */
} iccp_location;

/* For a simple polygon in a box; points in the band count as on it. There are no cells yet. */
void iccp_buckets_start(iccp_buckets *buckets, const iccp_polygon *polygon, const double *lower,
                        const double *upper, const iccp_band *band);
/* Makes the cells. ICC_ERR_MEMORY, and nothing is left of them, if there is no memory. */
icc_status iccp_buckets_fill(iccp_buckets *buckets, const iccp_memory *memory);
void iccp_buckets_free(iccp_buckets *buckets, const iccp_memory *memory);

/* Exact but for the band. A point that is not finite is outside. Where there are no cells all edges
 * are looked at, with the same result. */
iccp_location iccp_buckets_find(const iccp_buckets *buckets, const double *p);

#endif
