/* The triangles round one vertex of a drawing on the sphere, and how much they are stretched on
 * their way through the sphere onto another surface that is drawn there. */
#ifndef ICCP_COMPOSED_STAR_H
#define ICCP_COMPOSED_STAR_H

#include "match/surface/half_edges.h"

/* A surface and its drawing; some of its vertices may have been taken away. */
typedef struct iccp_drawn_surface {
    const iccp_half_edges *m;
    const double *x;
    double *directions;
    double scale; /* gives the surface the area of the sphere */
} iccp_drawn_surface;

/* A face as seen from the vertex: coordinates along two axes across and along its direction. */
typedef struct iccp_seen_face {
    double corner[3][3];
    double plane[3][3]; /* through the centre and the side opposite each corner */
    double sum[3];      /* of the planes */
    double gram[3];     /* of the surface: products of the sides from corner 0 to 1 and 2 */
    double root;        /* of their determinant */
} iccp_seen_face;

/* A face of the other drawing as far as it is on the inner side of the star's outer edge. */
typedef struct iccp_star_piece {
    uint32_t sector, face; /* of the star; in `other` */
    uint32_t n;
    double corner[4][3];
} iccp_star_piece;

typedef struct iccp_composed_star {
    iccp_memory memory;
    double p[3], axis[2][3]; /* the direction of the vertex, and two across */
    size_t n, n_other, n_pieces;
    const double **ring; /* n + 1 directions, counter-clockwise; the last is the first */
    iccp_seen_face *face;
    iccp_seen_face *other; /* faces of the other drawing that the star overlaps */
    iccp_star_piece *piece;
    uint32_t *list; /* n_other: their numbers */
    size_t room, room_other, room_pieces;
    uint32_t *seen, stamp; /* by face of the other drawing: when it was looked at last */
    double radius;         /* the least distance from the vertex to the ring's edges */
    double farthest;       /* the greatest one to its corners */
    double weight;         /* the areas, once there is an energy */
    bool is_severe;        /* what is stretched most counts more */
} iccp_composed_star;

/* For stars on surfaces of so many faces. False if there is no memory; to be freed in any case. */
bool iccp_composed_star_create(iccp_composed_star *star, size_t most_neighbours, size_t n_faces,
                               const iccp_memory *memory);
void iccp_composed_star_free(iccp_composed_star *star);

/* The star of a vertex of one drawing and what it overlaps of the other, whose face `start` has the
 * vertex. ICC_ERR_RESOLUTION where the star is too large to be seen from its vertex, or overlaps
 * too many faces; ICC_ERR_MEMORY. O(the number of overlapping pairs). */
icc_status iccp_composed_star_gather(iccp_composed_star *star, const iccp_drawn_surface *one,
                                     uint32_t vertex, const iccp_drawn_surface *other,
                                     uint32_t start);

/* How a direction near the vertex is seen from it. */
void iccp_composed_star_see(double seen[3], const iccp_composed_star *star, const double q[3]);

/* The sum, over what triangles of both have in common, of the area on both surfaces times E, or
 * E^1.5 if star->is_severe, where E = (s^2 + t^2)(1 + 1 / (s t)^2) for the singular values s and t
 * of the map from one to the other there, the vertex being at `seen`: as seen from where it is,
 * within the ring. */
double iccp_composed_star_energy(iccp_composed_star *star, const double seen[3]);

#endif
