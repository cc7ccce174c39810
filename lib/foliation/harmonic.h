/* The base of both planar methods: a mesh of the domain, its Laplacian, and a solver for it.
 * Source: the harmonic map of Tutte and Floater; see harmonic.c. */
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

/* Makes the mesh. See iccp_planar_create(). */
icc_status iccp_harmonic_create(iccp_harmonic *base, const icc_domain *domain,
                                const uint32_t *pieces, int32_t cells, const iccp_env *env,
                                icc_error *err);

/* Makes the Laplacian of the mesh and its factor. On failure the base can only be freed. */
icc_status iccp_harmonic_factorise(iccp_harmonic *base, const iccp_env *env, icc_error *err);

/* Frees the Laplacian and its factor. */
void iccp_harmonic_drop_factor(iccp_harmonic *base);

/* Frees the base, which may be all zero, but not a mesh that iccp_harmonic_move_mesh() has taken
 * out. */
void iccp_harmonic_free(iccp_harmonic *base);

/* Writes the base's number of cells and its spacing to a chart's info. */
void iccp_harmonic_describe(const iccp_harmonic *base, const icc_domain *domain,
                            icc_chart_info *info);

/* Takes the mesh out of the base. The caller frees it. */
iccp_planar iccp_harmonic_move_mesh(iccp_harmonic *base);

/* Computes the images of the vertices in the harmonic map to the unit disc. Boundary vertex k
 * goes to the angle `turns[k]`, in turns. `image` has 2 n_vertices numbers. */
icc_status iccp_harmonic_disc(const iccp_harmonic *base, const double *turns, double *image,
                              const iccp_env *env);

/* Adds `weight` times the share of the boundary's length that lies before boundary vertex k to
 * turns[k]. */
void iccp_add_arc_length(const iccp_planar *mesh, double weight, double *turns);

/* Returns the inner vertex farthest from the boundary; the first one of several; ICCP_NO_NEIGHBOUR
 * if there are no inner vertices. */
uint32_t iccp_deepest_vertex(const iccp_planar *mesh, const icc_domain *domain);

/* Returns the inner vertex nearest to a local point; the first one of several; ICCP_NO_NEIGHBOUR if
 * there are no inner vertices. */
uint32_t iccp_nearest_vertex(const iccp_planar *mesh, const double *points, const double p[2]);

#endif
