/* What the harmonic charts are made from: a mesh of the domain, its Laplacian, and a solver for
 * it. */
#ifndef ICCP_HARMONIC_H
#define ICCP_HARMONIC_H

#include "math/spd.h"
#include "mesh/finder.h"
#include "mesh/laplacian.h"

typedef struct iccp_harmonic {
    iccp_planar mesh;
    iccp_laplacian laplacian;
    iccp_ldlt solver;
    int32_t cells;
    double seconds_mesh, seconds_solve;
} iccp_harmonic;

/* See iccp_planar_create(). */
icc_status iccp_harmonic_create(iccp_harmonic *base, const icc_domain *domain,
                                const uint32_t *pieces, int32_t cells, const iccp_env *env,
                                icc_error *err);

/* Accepts a base that is all zero. The mesh is left alone when it has been taken over (see
 * there). */
void iccp_harmonic_free(iccp_harmonic *base);

/* The cells and spacing of its base in a chart's info. */
void iccp_harmonic_describe(const iccp_harmonic *base, const icc_domain *domain,
                            icc_chart_info *info);

/* Moves the mesh out of the base. */
iccp_planar iccp_harmonic_move_mesh(iccp_harmonic *base);

/* Where the vertices go in the harmonic map to the unit disc that takes boundary vertex k to the
 * angle `turns[k]`, in turns. `image`: 2 n_vertices. */
icc_status iccp_harmonic_disc(const iccp_harmonic *base, const double *turns, double *image,
                              const iccp_env *env);

/* Adds `weight` times the share of the boundary's length that lies before boundary vertex k to
 * turns[k]. */
void iccp_add_arc_length(const iccp_planar *mesh, double weight, double *turns);

/* The inner vertex farthest from the boundary, the first of several; ICCP_NO_NEIGHBOUR without
 * inner vertices. */
uint32_t iccp_deepest_vertex(const iccp_planar *mesh, const icc_domain *domain);

/* The inner vertex nearest to a local point, likewise. */
uint32_t iccp_nearest_vertex(const iccp_planar *mesh, const double *points, const double p[2]);

#endif
