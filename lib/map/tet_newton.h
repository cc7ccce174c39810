/* Newton's method for the images of some vertices of a tetrahedral mesh: what map/newton.h has for
 * triangles, for the untangling energy only. */
#ifndef ICCP_TET_NEWTON_H
#define ICCP_TET_NEWTON_H

#include "domain/simplices.h"
#include "map/tet_distortion.h"
#include "math/symmetric.h"

/* Doubles of work space per unknown: the residual, the preconditioned one, a direction and its product, and
 * the factors of the point's block. */
enum { ICCP_TET_WORK = 6 };

typedef struct iccp_tet_newton {
    iccp_memory memory;
    const iccp_simplices *mesh;
    double *images; /* 3 for each point of the mesh */
    size_t n_free, n_elements;
    uint32_t *free_point; /* n_free */
    uint32_t *slot;       /* of each point among the free ones, or UINT32_MAX */
    uint32_t *simplex;    /* n_elements: simplices with a free corner */
    iccp_tet *element;    /* n_elements */
    uint32_t *neighbour;  /* 12 n_elements: which neighbour corner b is of corner a */
    size_t *first;        /* the Hessian; rows 3 i to 3 i + 2 belong to free point i */
    uint32_t *column;
    double *value, *diagonal;
    double *gradient, *step; /* 3 n_free */
    double *saved;           /* 3 n_free: images to come back to */
    double *work;
} iccp_tet_newton;

/* The number of a corner among the free points, or UINT32_MAX. */
static inline uint32_t iccp_tet_slot(const iccp_tet_newton *s, uint32_t simplex, uint32_t corner)
{
    return s->slot[s->mesh->corners[4 * (size_t)simplex + corner]];
}

static inline void iccp_tet_images(const iccp_tet_newton *s, size_t element, const double *image[4])
{
    const uint32_t *v = s->mesh->corners + 4 * (size_t)s->simplex[element];
    for (int k = 0; k < 4; ++k)
        image[k] = s->images + 3 * (size_t)v[k];
}

/* Pair p = 0..11 of different corners. */
static inline void iccp_tet_pair(uint32_t p, uint32_t *a, uint32_t *b)
{
    *a = p / 3;
    *b = p % 3 + (p % 3 >= p / 3);
}

/* For inner points with movable[v] != 0; all of them when `movable` is NULL. The mesh is multiplied by
 * `stretch`. */
icc_status iccp_tet_newton_create(iccp_tet_newton *newton, const iccp_simplices *mesh,
                                  double *images, const uint8_t *movable, double stretch,
                                  const iccp_env *env);
void iccp_tet_newton_free(iccp_tet_newton *newton);

double iccp_tet_newton_energy(const iccp_tet_newton *newton, double epsilon);

/* The smallest determinant, and how many are not positive. */
double iccp_tet_newton_least(const iccp_tet_newton *newton, size_t *n_bad);

/* Computes a step and the energy's slope along it. */
icc_status iccp_tet_newton_solve(iccp_tet_newton *newton, double epsilon, double *slope,
                                 const iccp_env *env);

/* Moves along the step as far as the energy falls enough. Returns the new energy; `before` when nothing
 * could be done. */
double iccp_tet_newton_move(iccp_tet_newton *newton, double epsilon, double before, double slope);

#endif
