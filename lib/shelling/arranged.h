/* A copy of a mesh with its simplices in another order, so that simplices near in space are near
 * in memory. Source: Morton's curve; see arranged.c. */
#ifndef ICCP_ARRANGED_H
#define ICCP_ARRANGED_H

#include "geometry/simplices.h"

typedef struct iccp_arranged {
    iccp_simplices mesh; /* points are borrowed; corners of a simplex keep their order */
    uint32_t *order;     /* the number of each simplex in the original mesh */
} iccp_arranged;

/* O(n). Leaves nothing allocated on failure. */
icc_status iccp_arranged_create(iccp_arranged *a, const iccp_simplices *mesh, const iccp_env *env);
void iccp_arranged_free(iccp_arranged *a);

/* Converts numbers for the sides of this mesh to the order of the original mesh. */
void iccp_arranged_restore(const iccp_arranged *a, const double *of_sides, double *restored);

#endif
