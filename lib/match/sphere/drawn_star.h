/* The triangles round one vertex of a drawing on the sphere, and how much they are stretched. */
#ifndef ICCP_DRAWN_STAR_H
#define ICCP_DRAWN_STAR_H

#include "base/memory.h"
#include "match/surface/half_edges.h"

/* Of the surface: a corner's two sides, their products, and what follows from these. */
typedef struct iccp_drawn_star_face {
    double aa, ab, bb; /* a from the vertex to ring[i], b to ring[i + 1] */
    double inverse;    /* 1 / (aa bb - ab^2) */
    double weight;     /* twice the area */
} iccp_drawn_star_face;

typedef struct iccp_drawn_star {
    size_t n;
    const double **ring;        /* n + 1 directions, counter-clockwise; the last is the first */
    iccp_drawn_star_face *face; /* n */
    double weight;              /* the sum of theirs */
} iccp_drawn_star;

/* The energy of a star as a function of where its vertex is, with derivatives by two coordinates in
 * the plane that touches the sphere there. */
typedef struct iccp_drawn_star_jet {
    double value, gradient[2], hessian[3]; /* 00, 01, 11 */
    double axis[2][3];                     /* of the coordinates */
} iccp_drawn_star_jet;

/* Room for stars of up to n faces. False if there is no memory, to be freed all the same. */
bool iccp_drawn_star_create(iccp_drawn_star *star, size_t n, const iccp_memory *memory);
void iccp_drawn_star_free(iccp_drawn_star *star, const iccp_memory *memory);

/* The star of a vertex, its ring beginning with the end of m->out. x: coordinates by vertex, of a
 * surface whose area, times `scale` squared, is that of the sphere; directions by vertex. */
void iccp_drawn_star_gather(iccp_drawn_star *star, const iccp_half_edges *m, uint32_t vertex,
                            const double *x, double scale, const double *directions);

/* Whether a direction may be the vertex's: all faces are positive. Exact. */
bool iccp_drawn_star_holds(const iccp_drawn_star *star, const double p[3]);

/* The sum over the faces, by area, of E^1.5, where E = (s^2 + t^2)(1 + 1 / (s t)^2) is the
 * symmetric Dirichlet energy of a face with the singular values s and t, at least 4: the power, so
 * that the worst faces count more. Faces near the centre of the sphere count more still. p is a
 * direction that the star holds. */
double iccp_drawn_star_energy(const iccp_drawn_star *star, const double p[3]);
void iccp_drawn_star_expand(iccp_drawn_star_jet *jet, const iccp_drawn_star *star,
                            const double p[3]);

#endif
