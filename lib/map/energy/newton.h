/* Newton's method for the images of some points of a simplicial map. */
#ifndef ICCP_NEWTON_H
#define ICCP_NEWTON_H

#include "map/energy/assembly.h"
#include "math/ldlt.h"

typedef enum iccp_energy {
    ICCP_DIRICHLET,           /* symmetric Dirichlet, its own Hessian */
    ICCP_DIRICHLET_MAJORISED, /* the same with SLIM's */
    ICCP_UNTANGLE
} iccp_energy;

typedef struct iccp_newton {
    iccp_simplicial_map map;
    iccp_assembly assembly;
    double *element;      /* ICCP_ELEMENT(dim) for each of the assembly's */
    double *step, *saved; /* dim for each free point; `saved`: images to come back to */
    double *work;
    double *term;      /* of each element: its energy; NULL in the plane without threads */
    iccp_local *local; /* of some elements, in space with threads */
    iccp_env threads;  /* for loops over the elements, which report nothing */
    iccp_ldlt factor;  /* in the plane */
    bool is_ahead;     /* the first Hessian is there already, */
    iccp_energy ahead; /* of this energy */
} iccp_newton;

/* What depends on the mesh and its fixed points alone, not on the images: where the entries of the
 * Hessian are, and in which order they are eliminated. Immutable; maps of one mesh share it. */
typedef struct iccp_newton_plan iccp_newton_plan;

/* In the plane. */
icc_status iccp_newton_plan_create(iccp_newton_plan **out, const iccp_simplicial_map *map,
                                   const iccp_env *env);
iccp_newton_plan *iccp_newton_plan_retain(iccp_newton_plan *plan);
void iccp_newton_plan_release(iccp_newton_plan *plan);

/* Whether a plan is for that mesh and those fixed points. O(n). */
bool iccp_newton_plan_fits(const iccp_newton_plan *plan, const iccp_simplicial_map *map);

/* For the points with movable[v] != 0 that are not fixed; all of them when `movable` is NULL, and
 * then by map->plan if that fits, which must live longer. `first`: the energy whose step will be
 * solved for first, from the images as they are now, where that is known; not ICCP_UNTANGLE; or
 * NULL. */
icc_status iccp_newton_create(iccp_newton *newton, const iccp_simplicial_map *map,
                              const uint8_t *movable, const iccp_energy *first,
                              const iccp_env *env);
void iccp_newton_free(iccp_newton *newton);

double iccp_newton_energy(const iccp_newton *newton, iccp_energy energy, double epsilon);

/* The smallest determinant of a Jacobian, and how many are not positive. */
double iccp_newton_least(const iccp_newton *newton, size_t *n_bad);

/* Computes the step and the energy's slope along it. ICC_ERR_SOLVER when there is none. */
icc_status iccp_newton_solve(iccp_newton *newton, iccp_energy energy, double epsilon, double *slope,
                             const iccp_env *env);

/* Moves along the step as far as the energy falls enough; where the energy is Dirichlet's no
 * simplex loses its positive image, exactly, and in space images that are next to nothing are made
 * 0, as they are kept (iccp_simplicial_round()). Returns the new energy; `before` when nothing
 * could be done. */
double iccp_newton_move(iccp_newton *newton, iccp_energy energy, double epsilon, double before,
                        double slope);

/* Fills in how free points answer a motion of fixed ones, dim n_points displacements of which those
 * of free ones are 0, by a quadratic model of the symmetric Dirichlet energy. In the plane `rest`
 * are as many: the step to where that is least when nothing else moves. In space the answer is both
 * in one, and `rest` is not used. ICC_ERR_SOLVER when there is none. */
icc_status iccp_newton_answer(iccp_newton *newton, double *motion, double *rest,
                              const iccp_env *env);

/* Which share of a motion of all points there is before the first simplex's image loses its area or
 * volume. In the plane HUGE_VAL when none ever does; in space it is at most 2, and may be
 * less than it could. */
double iccp_newton_limit(const iccp_simplicial_map *map, const double *motion);

#endif
