/* The star of one vertex of a drawing on the sphere, and how much its triangles are stretched. */
#ifndef ICCP_DRAWN_STAR_H
#define ICCP_DRAWN_STAR_H

#include "base/memory.h"
#include "match/surface/half_edges.h"

/* A face of the surface: the products of its two sides at the vertex, and values that follow from
 * them. */
typedef struct iccp_drawn_star_face {
    double aa, ab, bb; /* a goes from the vertex to ring[i], b to ring[i + 1] */
    double inverse;    /* 1 / (aa bb - ab^2) */
    double weight;     /* twice the area */
} iccp_drawn_star_face;

typedef struct iccp_drawn_star {
    size_t n;
    const double **ring;        /* n + 1 directions, counter-clockwise; the last is the first */
    iccp_drawn_star_face *face; /* n */
    double weight;              /* the sum of the faces' weights */
} iccp_drawn_star;

/* The energy of a star as a function of its vertex's place. The derivatives are by two coordinates
 * in the plane that touches the sphere there. */
typedef struct iccp_drawn_star_jet {
    double value, gradient[2], hessian[3]; /* 00, 01, 11 */
    double axis[2][3];                     /* directions of the coordinates */
} iccp_drawn_star_jet;

/* Makes room for stars of up to n faces. False if there is no memory. Free it in any case. */
bool iccp_drawn_star_create(iccp_drawn_star *star, size_t n, const iccp_memory *memory);
void iccp_drawn_star_free(iccp_drawn_star *star, const iccp_memory *memory);

/* Gathers the star of a vertex. Its ring begins with the end of m->out. x has the coordinates by
 * vertex, of a surface whose area times `scale` squared is that of the sphere. `directions` is by
 * vertex. */
void iccp_drawn_star_gather(iccp_drawn_star *star, const iccp_half_edges *m, uint32_t vertex,
                            const double *x, double scale, const double *directions);

/* Returns true if the vertex may take a direction: all faces are then positive. Exact. */
bool iccp_drawn_star_holds(const iccp_drawn_star *star, const double p[3]);

/* Returns the sum over the faces of their area times E^1.5. E = (s^2 + t^2)(1 + 1 / (s t)^2) is the
 * symmetric Dirichlet energy of a face with the singular values s and t, and at least 4. The power
 * makes the worst faces count more. Faces near the centre of the sphere count more still. The star
 * must hold the direction p. */
double iccp_drawn_star_energy(const iccp_drawn_star *star, const double p[3]);
void iccp_drawn_star_expand(iccp_drawn_star_jet *jet, const iccp_drawn_star *star,
                            const double p[3]);

#endif
