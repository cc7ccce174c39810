/* The linear system of a spline: of all functions on a mesh that have told values at some vertices,
 * the one that bends the least. */
#ifndef ICCP_SPLINE_SYSTEM_H
#define ICCP_SPLINE_SYSTEM_H

#include "fit/spline/bending.h"
#include "math/ldlt.h"

/* Minimises u'Qu + sum_i w_i (u_i - q_i)^2 over both coordinates of u, where u = q at vertices that
 * are told exactly. */
typedef struct iccp_spline_system {
    iccp_memory memory;
    iccp_gram energy; /* Q */
    size_t n_told, n_free;
    uint32_t *told;   /* n_told: different vertices */
    double *weight;   /* n_told: 0: exact */
    uint32_t *slot;   /* of each vertex: its row among the free ones, or UINT32_MAX */
    uint32_t *turn;   /* the told vertices in an order in which neighbours are close */
    size_t *first;    /* rows of Q for the free vertices, without the weights, as in */
    uint32_t *column; /* iccp_symmetric */
    double *value;
    double *diagonal;
    iccp_ldlt factor;
    bool is_loose; /* the told vertices lie on one line: weak springs hold the rest */
} iccp_spline_system;

/* Makes and factorises the system for vertices that are told. `weight`: one for each of them, or 0
 * if it is exact; NULL: all are exact. `is_loose` says that they all lie on one line. On failure
 * nothing stays allocated. */
icc_status iccp_spline_system_create(iccp_spline_system *system, const iccp_bending_mesh *mesh,
                                     size_t n_told, const uint32_t *told, const double *weight,
                                     bool is_loose, const iccp_env *env);
void iccp_spline_system_free(iccp_spline_system *system);

/* Factorises again for other weights above 0 of the vertices that had some. */
icc_status iccp_spline_system_weigh(iccp_spline_system *system, const double *weight,
                                    const iccp_env *env);

/* Computes the values u of all vertices, two coordinates each, from those told. */
icc_status iccp_spline_system_solve(const iccp_spline_system *system, const double *told, double *u,
                                    const iccp_env *env);

/* Computes for each told vertex the value that the others alone would give it, minus its told
 * value. NaN if the others do not determine it. `u` is the solution for `told`.
 *
 * No system is solved again. If K is the energy's matrix for the told values alone, leaving out an
 * exact one changes its value by (K q)_i / K_ii. A weighted one changes by (q_i - u_i) / (1 - h_i),
 * where h_i is how far u_i follows q_i. Source: P. Craven, G. Wahba, Smoothing noisy data with
 * spline functions, Numer. Math. 31, 1979. O(n_told) short solves on the paths of the factor. */
icc_status iccp_spline_system_leave_out(const iccp_spline_system *system, const double *told,
                                        const double *u, double *left_out, const iccp_env *env);

#endif
