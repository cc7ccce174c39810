/* The star of one vertex of a drawing on the sphere. Measures how much its triangles are stretched
 * when they are mapped to another surface that is drawn there. */
#ifndef ICCP_COMPOSED_STAR_H
#define ICCP_COMPOSED_STAR_H

#include "match/surface/half_edges.h"

/* A surface and its drawing. Some vertices may have been removed. */
typedef struct iccp_drawn_surface {
    const iccp_half_edges *m;
    const double *x;
    double *directions;
    double scale; /* gives the surface the area of the sphere */
} iccp_drawn_surface;

/* A face as seen from the vertex: coordinates along two axes across the vertex's direction and
 * along it. */
typedef struct iccp_seen_face {
    double corner[3][3];
    double plane[3][3]; /* planes through the centre and the side opposite each corner */
    double sum[3];      /* sum of the planes */
    double gram[3];     /* of the surface: products of the sides from corner 0 to corners 1 and 2 */
    double root;        /* the root of their determinant */
} iccp_seen_face;

/* What two faces have in common, and the metric of the other drawing's surface there. */
typedef struct iccp_star_overlap {
    double area, middle[2];
    double metric[3], root; /* `root` of the metric's determinant */
} iccp_star_overlap;

/* The part of a face of the other drawing that lies inside the star's outer edge. */
typedef struct iccp_star_piece {
    uint32_t sector, face; /* `sector` of the star; `face` is an index into `other` */
    uint32_t n;
    double corner[4][3];
    bool is_known; /* `whole` is known */
    iccp_star_overlap whole;
} iccp_star_piece;

typedef struct iccp_composed_star {
    iccp_memory memory;
    double p[3], axis[2][3]; /* the direction of the vertex, and two axes across */
    size_t n, n_other, n_pieces;
    const double **ring; /* n + 1 directions, counter-clockwise; the last is the first */
    iccp_seen_face *face;
    iccp_seen_face *other; /* faces of the other drawing that the star overlaps */
    iccp_star_piece *piece;
    uint32_t *list; /* n_other: their numbers */
    size_t room, room_other, room_pieces;
    uint32_t *seen, stamp; /* by face of the other drawing: the stamp of the last visit */
    double radius;         /* the smallest distance from the vertex to the ring's edges */
    double farthest;       /* the greatest distance to the ring's corners */
    double weight;         /* sum of the areas; known after an energy below the limit */
    bool is_severe;        /* strong stretch counts more */
} iccp_composed_star;

/* Makes room for stars on surfaces with this many faces. False if there is no memory. Free it in
 * any case. */
bool iccp_composed_star_create(iccp_composed_star *star, size_t most_neighbours, size_t n_faces,
                               const iccp_memory *memory);
void iccp_composed_star_free(iccp_composed_star *star);

/* Gathers the star of a vertex of one drawing, and the faces of the other drawing that it overlaps.
 * The vertex lies in face `start` of the other drawing. ICC_ERR_RESOLUTION if the star is too large
 * to be seen from its vertex, or overlaps too many faces. ICC_ERR_MEMORY. O(the number of
 * overlapping pairs). */
icc_status iccp_composed_star_gather(iccp_composed_star *star, const iccp_drawn_surface *one,
                                     uint32_t vertex, const iccp_drawn_surface *other,
                                     uint32_t start);

/* Computes the coordinates of a direction near the vertex, as seen from it. */
void iccp_composed_star_see(double seen[3], const iccp_composed_star *star, const double q[3]);

/* Returns the energy if the vertex moves to `seen`, a place inside the ring as seen from the
 * present one. Returns HUGE_VAL if the energy is `most` or more.
 *
 * The energy is a sum over the common pieces of triangles: the area on both surfaces times E, or
 * E^1.5 if star->is_severe. E is (s^2 + t^2) (1 + 1 / (s t)^2), where s and t are the singular
 * values of the map from one surface to the other. */
double iccp_composed_star_energy(iccp_composed_star *star, const double seen[3], double most);

#endif
