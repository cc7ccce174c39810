/* Numbers the faces of a mesh, for the rules of docs/theory/charts-space.md, "foliations of
 * simplices". All simplices that have a face know it by the same number.
 *
 * A face of a simplex is a set of its corners, in which bit i stands for corner i. Only faces of
 * dimension 0 to dim - 2 are numbered: two simplices with such a face need not share a facet. */
#ifndef ICCP_FACES_H
#define ICCP_FACES_H

#include "geometry/simplices.h"
#include "icc/base.h"

typedef struct iccp_faces {
    iccp_memory memory;
    size_t n_faces;
    size_t per_simplex;
    uint8_t place[2 << ICC_MAX_DIM]; /* the number of a set of corners among the faces of its
                                        simplex */
    uint32_t *number;                /* per_simplex numbers for each simplex */
} iccp_faces;

/* Fails with ICC_ERR_MEMORY, also if there are too many faces for 32 bits, or with
 * ICC_ERR_CANCELLED. O(n). */
icc_status iccp_faces_create(iccp_faces *faces, const iccp_simplices *mesh, const iccp_env *env);
void iccp_faces_free(iccp_faces *faces);

static inline uint32_t iccp_face(const iccp_faces *faces, size_t simplex, unsigned corners)
{
    return faces->number[faces->per_simplex * simplex + faces->place[corners]];
}

/* The number of corners in a set. */
static inline size_t iccp_set_size(unsigned set)
{
    size_t n = 0;
    for (; set != 0; set &= set - 1)
        ++n;
    return n;
}

#endif
