/* Assembles the gradient and the Hessian of an energy, simplex by simplex, over the free points of
 * a simplicial map. */
#ifndef ICCP_ASSEMBLY_H
#define ICCP_ASSEMBLY_H

#include "map/energy/simplicial_map.h"
#include "math/symmetric.h"

/* Rows dim i to dim i + dim - 1 of the Hessian belong to free point i. Each row holds the other
 * entries of the point's own block, then dim columns for each neighbour. */
typedef struct iccp_assembly {
    iccp_memory memory;
    size_t dim;
    const uint32_t *corners; /* of the map */
    size_t n_free, n_elements;
    uint32_t *free_point; /* n_free */
    uint32_t *slot;       /* of each point of the map: its number among the free points, or
                             UINT32_MAX */
    uint32_t *simplex;    /* n_elements: the simplices with a free corner */
    uint32_t *neighbour;  /* of each element, for the dim (dim + 1) ordered pairs of corners (a,
                             b): the number of b among the neighbours of a, or UINT32_MAX */
    size_t *first;        /* the Hessian, as in iccp_symmetric */
    uint32_t *column;
    double *value, *diagonal;
    double *gradient; /* dim n_free */
    uint32_t *part;   /* of each free point; NULL if all are in one part */
    size_t n_parts;
    size_t *first_element; /* n_parts + 1: where each part's elements begin in `element` */
    uint32_t *element;     /* elements with a corner in the part, in rising order */
    bool borrows;          /* only value, diagonal and gradient are its own; the rest belongs to
                              another assembly */
} iccp_assembly;

/* Finds the pattern; there are no sums yet. The free points are those with movable[v] != 0 that are
 * not fixed. If `movable` is NULL, all points that are not fixed are free. */
icc_status iccp_assembly_create(iccp_assembly *assembly, const iccp_simplicial_map *map,
                                const uint8_t *movable, const iccp_env *env);
void iccp_assembly_free(iccp_assembly *assembly);

/* Allocates the sums, unless they are there. On failure the assembly can only be freed. */
icc_status iccp_assembly_make_room(iccp_assembly *assembly);

/* Makes an assembly with sums for another map of the same mesh with the same free points. It
 * borrows `pattern`, which must live longer. The pattern is only read, so several assemblies may
 * share it. */
icc_status iccp_assembly_share(iccp_assembly *assembly, const iccp_assembly *pattern,
                               const iccp_simplicial_map *map, const iccp_memory *memory);

/* Prepares for a factorisation that eliminates row i at position[i]. From now on, each row holds
 * only its own block and its entries in later rows, which are all that the factorisation reads.
 * With `n_parts` > 1 the rows are divided into parts of about equal size, which can be summed at
 * the same time. */
icc_status iccp_assembly_divide(iccp_assembly *assembly, const uint32_t *position, size_t n_parts,
                                const iccp_env *env);

/* Stands for all rows, in place of a part. */
#define ICCP_ALL_PARTS SIZE_MAX

/* A sum has three steps. begin() clears the sums of free points [begin, end). add() adds an element
 * to the rows of a part in which it has a corner. end() adds a little to the diagonal, so that a
 * Hessian without its negative curvature is regular. */
void iccp_assembly_begin(iccp_assembly *assembly, size_t begin, size_t end);
void iccp_assembly_add(iccp_assembly *assembly, size_t part, size_t element,
                       const iccp_local *local);
void iccp_assembly_end(iccp_assembly *assembly);

static inline iccp_symmetric iccp_assembly_hessian(const iccp_assembly *s)
{
    return (iccp_symmetric){s->dim * s->n_free, s->first, s->column, s->value, s->diagonal};
}

#endif
