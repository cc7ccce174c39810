/* A mesh with its simplices in another order: what is near in space is near in memory, whatever the
 * order that they were given in. */
#ifndef ICCP_ARRANGED_H
#define ICCP_ARRANGED_H

#include "geometry/simplices.h"

typedef struct iccp_arranged {
    iccp_simplices mesh; /* points are borrowed; corners of a simplex keep their order */
    uint32_t *order;     /* of each simplex: its number in the mesh that this one was made from */
} iccp_arranged;

/* O(n). On failure nothing is left allocated. */
icc_status iccp_arranged_create(iccp_arranged *a, const iccp_simplices *mesh, const iccp_env *env);
void iccp_arranged_free(iccp_arranged *a);

/* From a number for each side to the order of the mesh that this one was made from. */
void iccp_arranged_restore(const iccp_arranged *a, const double *of_sides, double *restored);

#endif
