/* The free points of a simplicial map, and gradient and Hessian of an energy over them, assembled
 * simplex by simplex. */
#ifndef ICCP_ASSEMBLY_H
#define ICCP_ASSEMBLY_H

#include "map/energy/simplicial_map.h"
#include "math/symmetric.h"

/* Of the Hessian, rows dim i to dim i + dim - 1 belong to free point i: they hold the other entries
 * of its own block, then dim columns for each neighbour. */
typedef struct iccp_assembly {
    iccp_memory memory;
    size_t dim;
    const uint32_t *corners; /* of the map */
    size_t n_free, n_elements;
    uint32_t *free_point; /* n_free */
    uint32_t *slot;       /* of each point of the map among the free ones, or UINT32_MAX */
    uint32_t *simplex;    /* n_elements: those with a free corner */
    uint32_t *neighbour;  /* of each element, for the dim (dim + 1) ordered pairs of corners (a, b):
                             which neighbour of a is b, or UINT32_MAX */
    size_t *first;        /* the Hessian, as in iccp_symmetric */
    uint32_t *column;
    double *value, *diagonal;
    double *gradient; /* dim n_free */
    uint32_t *part;   /* of each free point; NULL: all are in one part */
    size_t n_parts;
    size_t *first_element; /* n_parts + 1: where the parts' elements begin in `element` */
    uint32_t *element;     /* those with a corner in a part, rising */
    bool borrows;          /* everything but value, diagonal and gradient belongs to another one */
} iccp_assembly;

/* For the points with movable[v] != 0 that are not fixed; all of them when `movable` is NULL. */
icc_status iccp_assembly_create(iccp_assembly *assembly, const iccp_simplicial_map *map,
                                const uint8_t *movable, const iccp_env *env);
void iccp_assembly_free(iccp_assembly *assembly);

/* Leaves the pattern alone, to be shared: */
void iccp_assembly_drop_sums(iccp_assembly *assembly);

/* For another map of the same mesh with the same free points as the one that `pattern` is for,
 * which must live longer; it is only read, and several may share it. */
icc_status iccp_assembly_share(iccp_assembly *assembly, const iccp_assembly *pattern,
                               const iccp_simplicial_map *map, const iccp_memory *memory);

/* Prepares for a factorisation that eliminates row i at position[i]: of two entries only the one in
 * the row that comes first is summed from now on, the other stays 0. With `n_parts` > 1 the rows
 * are divided among parts, about as many in each, that can be summed at the same time. */
icc_status iccp_assembly_divide(iccp_assembly *assembly, const uint32_t *position, size_t n_parts,
                                const iccp_env *env);

/* Instead of a part: all rows. */
#define ICCP_ALL_PARTS SIZE_MAX

/* Begins the sums of free points [begin, end); adds an element to the rows of a part, in which it
 * has a corner; and adds to the diagonal what keeps a Hessian without its negative curvature
 * regular. */
void iccp_assembly_begin(iccp_assembly *assembly, size_t begin, size_t end);
void iccp_assembly_add(iccp_assembly *assembly, size_t part, size_t element,
                       const iccp_local *local);
void iccp_assembly_end(iccp_assembly *assembly);

static inline iccp_symmetric iccp_assembly_hessian(const iccp_assembly *s)
{
    return (iccp_symmetric){s->dim * s->n_free, s->first, s->column, s->value, s->diagonal};
}

#endif
