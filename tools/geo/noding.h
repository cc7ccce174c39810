/* Cuts lines and rings where they meet the cage. */
#ifndef NODING_H
#define NODING_H

#include "geo/cage_grid.h"
#include "geo/geo_shape.h"

typedef enum geo_place { GEO_OUTSIDE, GEO_ON_CAGE, GEO_INSIDE } geo_place;

/* A vertex of a line, or a place between two vertices where it meets the cage. */
typedef struct geo_node {
    double at[2];
    geo_place place;
    uint32_t facet; /* on the cage: its edge, and the place on it from its first end, 0 to 1 */
    double share;
    bool vertex;  /* it is the position `from` of the shape itself */
    size_t from;  /* the position after which it comes; SIZE_MAX if there is none */
    double along; /* the place on the way to the next position, 0 to 1 */
    bool in;      /* the piece up to the next node lies in the cage, apart from parts that may be
                     snapped */
} geo_node;

typedef struct noding {
    const carrier *cage;
    cage_grid grid;
    geo_node *nodes;
    size_t n, room;
    icc_status status; /* of the library, if it failed */
} noding;

void noding_start(noding *out, const carrier *cage);
void noding_free(noding *x);

/* Finds the nodes of one path of a shape. `status` and `snapped` are those of all positions.
 * Returns true if all of the path lies in the cage. */
bool noding_path(noding *x, const geo_shape *shape, size_t path, const icc_status *status,
                 const bool *snapped);

/* True if all of a path lies in the cage and away from its edges. Its nodes are its vertices then. */
bool noding_is_free(noding *x, const geo_shape *shape, size_t path, const icc_status *status,
                    const bool *snapped);

/* True if a point lies outside the cage by more than `slack`. */
bool noding_is_outside(noding *x, const double point[2], double slack);

/* Finds the edge of the cage on which two points lie, and their places on it. GEO_NOWHERE if there
 * is none. */
uint32_t noding_common_edge(noding *x, const double a[2], const double b[2], double *share_a,
                            double *share_b);

#endif
