/* What the files of Newton's method share: map/energy/newton.h. */
#ifndef ICCP_NEWTON_PARTS_H
#define ICCP_NEWTON_PARTS_H

#include "base/compiler.h"
#include "base/threads.h"
#include "map/energy/newton.h"

#include <stdatomic.h>

struct iccp_newton_plan {
    iccp_memory memory;
    atomic_size_t references;
    iccp_assembly assembly; /* without sums */
    iccp_ldlt factor;       /* without numbers */
    size_t n_points, n_simplices;
    uint32_t *corners; /* the mesh that it is for */
};

/* Elements that a thread takes at once. */
enum { ICCP_NEWTON_GRAIN = 512 };

/* In space with threads, elements whose gradients and Hessians wait to be summed. */
enum { ICCP_NEWTON_WAITING = 1024 };

/* On all threads. Chunks do not fail, and a loop without progress cannot be stopped. */
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

/* The order of elimination; and the parts in which the matrix is summed from then on. */
icc_status iccp_newton_order(const iccp_assembly *assembly, iccp_ldlt *factor, const iccp_env *env);
icc_status iccp_newton_divide(iccp_assembly *assembly, const iccp_ldlt *factor,
                              const iccp_env *env);

/* The gradient and the Hessian at the images as they are, unless they have been summed ahead: by
 * this thread alone, before there are parts. */
void iccp_newton_sum(iccp_newton *newton, iccp_energy energy, double epsilon);
void iccp_newton_sum_ahead(iccp_newton *newton, iccp_energy energy);

/* Whether one simplex has more than half of the Dirichlet energy. Sets the terms. */
bool iccp_newton_has_worst(const iccp_newton *newton);

#endif
