/* Newton's method for the images of some points of a simplicial map.
 *
 * Words of this folder
 * - simplicial map: a mesh, and an image for each of its points (simplicial_map.h).
 * - element: a simplex before the map, prepared for energies (jacobian.h).
 * - positive: a simplex whose image has the orientation of the simplex itself. Others are inverted.
 * - fixed, free: a fixed point keeps its image; a free point may move.
 * - mode: an eigenvector of an energy's Hessian. A flip and a twist are modes of two singular
 *   values.
 * - step: one solution of Newton's equations, and a motion along it.
 * - work: the cost of a map, in steps times simplices (work.h).
 *
 * Invariants
 * - A step on the symmetric Dirichlet energy never inverts a simplex; exact predicates decide.
 * - Sums have one order for all numbers of threads, so results have the same bits.
 * - Hessians are positive semidefinite, because negative curvature is left out.
 *
 * Ways
 * - In the plane: a sparse factorisation of the Hessian. In space: truncated conjugate gradients.
 * - Positive maps are improved by the symmetric Dirichlet energy (dirichlet.h).
 * - A model attracts the map in these steps, if the simplicial map has one (model.h).
 * - Inverted ones are repaired by the untangling energy (untangling.h, untangle.h, mesh_repair.h).
 * - One step: newton.c solves (truncated_cg.h in space), newton_sums.c adds up, assembly.h
 *   assembles, newton_move.c goes along it. newton_plan.c keeps the plan.
 * - Many: descent.h on one mesh, for points that movable.h chooses; refinement.h on finer ones, as
 *   far as schedule.h says.
 * - After a target that moves: continuation.h. An affine boundary, or the part of a motion that is
 *   affine: affine.h.
 * - Hessians of one simplex: dirichlet.h, untangling.h, in space on modes.h and singular.h.
 *   flat_simplex.h serves where doubles find no area or volume.
 *   Untangling moves patches (patches.h).
 *
 * Begin with simplicial_map.h and this file. */
#ifndef ICCP_NEWTON_H
#define ICCP_NEWTON_H

#include "map/energy/assembly.h"
#include "math/ldlt.h"

typedef enum iccp_energy {
    ICCP_DIRICHLET,           /* symmetric Dirichlet, with its own Hessian */
    ICCP_DIRICHLET_MAJORISED, /* the same, with SLIM's Hessian */
    ICCP_UNTANGLE,
    ICCP_MODEL /* the distance from the model alone. If the model is 0, the minimum is harmonic */
} iccp_energy;

typedef struct iccp_newton {
    iccp_simplicial_map map;
    iccp_assembly assembly;
    double *element;      /* ICCP_ELEMENT(dim) for each element of the assembly */
    double *step, *saved; /* dim for each free point; `saved`: the images before the step */
    double *work;
    double *term;      /* of each element: its energy; NULL in the plane without threads */
    iccp_local *local; /* of some elements, in space with threads */
    iccp_env threads;  /* for loops over the elements; reports no progress */
    iccp_ldlt factor;  /* used in the plane */
    bool is_ahead;     /* the first Hessian is computed already, */
    iccp_energy ahead; /* of this energy */
} iccp_newton;

/* A plan: the places of the Hessian's entries and the order of elimination. It depends on the mesh
 * and its fixed points, but not on the images. It never changes, and maps of one mesh share it. */
typedef struct iccp_newton_plan iccp_newton_plan;

/* Plans exist only in the plane. */
icc_status iccp_newton_plan_create(iccp_newton_plan **out, const iccp_simplicial_map *map,
                                   const iccp_env *env);
iccp_newton_plan *iccp_newton_plan_retain(iccp_newton_plan *plan);
void iccp_newton_plan_release(iccp_newton_plan *plan);

/* Returns true if a plan belongs to this mesh and these fixed points. O(n). */
bool iccp_newton_plan_fits(const iccp_newton_plan *plan, const iccp_simplicial_map *map);

/* Prepares the points with movable[v] != 0 that are not fixed. If `movable` is NULL, it takes all
 * points that are not fixed and uses map->plan if that fits. The plan must live longer. `first` is
 * the energy of the first step, if the caller knows it, or NULL. That step must start from the
 * present images. It must not be ICCP_UNTANGLE. */
icc_status iccp_newton_create(iccp_newton *newton, const iccp_simplicial_map *map,
                              const uint8_t *movable, const iccp_energy *first,
                              const iccp_env *env);

/* Calls iccp_newton_create(), unless `newton` was made for this mesh and these movable points. An
 * empty one was freed or has nothing but assembly.memory. */
icc_status iccp_newton_prepare(iccp_newton *newton, const iccp_simplicial_map *map,
                               const uint8_t *movable, const iccp_energy *first,
                               const iccp_env *env);
void iccp_newton_free(iccp_newton *newton);

double iccp_newton_energy(const iccp_newton *newton, iccp_energy energy, double epsilon);

/* Returns the smallest determinant of a Jacobian. *n_bad counts the determinants that are not
 * positive. */
double iccp_newton_least(const iccp_newton *newton, size_t *n_bad);

/* Computes the step and the energy's slope along it. ICC_ERR_SOLVER if there is no step. */
icc_status iccp_newton_solve(iccp_newton *newton, iccp_energy energy, double epsilon, double *slope,
                             const iccp_env *env);

/* Moves along the step until the energy has fallen enough. Returns the new energy, or `before`
 * if no move lowers it. With the Dirichlet energy no simplex becomes inverted, by exact
 * predicates. In space tiny coordinates of images are then set to 0 (iccp_simplicial_round()),
 * as they are stored. */
double iccp_newton_move(iccp_newton *newton, iccp_energy energy, double epsilon, double before,
                        double slope);

/* Fills in how free points answer a motion of fixed points, by a quadratic model of the symmetric
 * Dirichlet energy. `motion` has dim displacements for each point; those of free points are 0 at
 * first.
 *
 * In the plane `rest` has the same length and becomes the step that minimises the model if nothing
 * else moves. In space the answer contains that step, and `rest` is not used. ICC_ERR_SOLVER if
 * there is no answer. */
icc_status iccp_newton_answer(iccp_newton *newton, double *motion, double *rest,
                              const iccp_env *env);

/* Returns the share of a motion of all points at which the first image of a simplex loses its area
 * or volume. In the plane this is HUGE_VAL if that never happens. In space it is at most 2 and may
 * be too small, but never too large. */
double iccp_newton_limit(const iccp_simplicial_map *map, const double *motion);

#endif
