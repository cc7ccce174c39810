/* A grid of cells over a polygon that answers "inside, outside or on the edge" without a search. A
 * cell without edges nearby knows the answer. Any other cell knows the edges near it and one of its
 * points with a known answer. */
#ifndef ICCP_BUCKETS_H
#define ICCP_BUCKETS_H

#include "geometry/band.h"
#include "geometry/polygon.h"
#include "icc/icc.h"

typedef struct iccp_bucket {
    uint32_t first; /* edges of the cell: edges[first] up to the next cell's first */
    uint32_t state; /* 2 * number of the cell's known point + (1 if that is inside) */
} iccp_bucket;

typedef struct iccp_buckets {
    const double *points;      /* points of the polygon, borrowed */
    size_t n;                  /* number of edges */
    double lower[2], upper[2]; /* everything outside this box is outside the polygon */
    double origin[2];
    double step[2], rate[2]; /* size of a cell, and 1 / size */
    uint32_t size[2];        /* number of cells along x and y */
    iccp_band band;
    iccp_bucket *cells; /* one more than the number of cells; NULL: none yet */
    uint32_t *edges;    /* positions in the polygon, cell by cell */
} iccp_buckets;

/* Where a point lies. */
typedef struct iccp_location {
    int32_t where; /* ICC_INSIDE, ICC_BOUNDARY, ICC_OUTSIDE */
    uint32_t edge; /* for ICC_BOUNDARY: the nearest edge, */
    double t;      /* and the position along it, as a share */
} iccp_location;

/* Prepares a simple polygon in a box. Points in the band count as on it. There are no cells yet. */
void iccp_buckets_start(iccp_buckets *buckets, const iccp_polygon *polygon, const double *lower,
                        const double *upper, const iccp_band *band);
/* Makes the cells. Returns ICC_ERR_MEMORY if there is no memory, and keeps none. */
icc_status iccp_buckets_fill(iccp_buckets *buckets, const iccp_memory *memory);
void iccp_buckets_free(iccp_buckets *buckets, const iccp_memory *memory);

/* Finds where p lies. Exact except for the band. A point that is not finite is outside. Without
 * cells it looks at all edges, with the same result. */
iccp_location iccp_buckets_find(const iccp_buckets *buckets, const double *p);

#endif
