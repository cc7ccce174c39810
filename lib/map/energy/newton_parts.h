/* Declarations shared by the files that implement map/energy/newton.h. */
#ifndef ICCP_NEWTON_PARTS_H
#define ICCP_NEWTON_PARTS_H

#include "base/compiler.h"
#include "base/threads.h"
#include "map/energy/newton.h"

#include <math.h>
#include <stdatomic.h>

struct iccp_newton_plan {
    iccp_memory memory;
    atomic_size_t references;
    iccp_assembly assembly; /* without sums */
    iccp_ldlt factor;       /* without numbers */
    size_t n_points, n_simplices;
    uint32_t *corners; /* the mesh that the plan is for */
};

/* Elements that a thread takes at once. */
enum { ICCP_NEWTON_GRAIN = 512 };

/* In space with threads: the number of elements whose gradients and Hessians are computed before
 * they are summed. */
enum { ICCP_NEWTON_WAITING = 1024 };

/* Runs a loop on all threads. Its chunks cannot fail, and without progress it cannot be
 * cancelled. */
static inline void iccp_newton_run(const iccp_newton *s, size_t n, size_t grain, iccp_chunk chunk,
                                   void *argument)
{
    (void)iccp_for_chunks(&s->threads, "improve", n, grain, chunk, argument);
}

static ICCP_INLINE const double *iccp_newton_images(size_t dim, const iccp_newton *s, size_t e,
                                                    const double **image)
{
    iccp_simplicial_images(dim, &s->map, s->assembly.simplex[e], image);
    return s->element + ICCP_ELEMENT(dim) * e;
}

/* Returns the rail of a point of a map that has rails, or NULL if the point moves freely. */
static inline const double *iccp_newton_rail(const iccp_simplicial_map *map, uint32_t point)
{
    const double *rail = map->rail + 2 * (size_t)point;
    return fabs(rail[0]) + fabs(rail[1]) > 0 ? rail : NULL;
}

/* Find the order of elimination, then the parts in which the matrix is summed. */
icc_status iccp_newton_order(const iccp_assembly *assembly, iccp_ldlt *factor, const iccp_env *env);
icc_status iccp_newton_divide(iccp_assembly *assembly, const iccp_ldlt *factor,
                              const iccp_env *env);

/* Sums the gradient and the Hessian at the present images, unless they have been summed ahead.
 * iccp_newton_sum_ahead() uses this thread alone and needs no parts. */
void iccp_newton_sum(iccp_newton *newton, iccp_energy energy, double epsilon);
void iccp_newton_sum_ahead(iccp_newton *newton, iccp_energy energy);

/* Returns true if one simplex has more than half of the Dirichlet energy. Sets the terms. */
bool iccp_newton_has_worst(const iccp_newton *newton);

#endif
