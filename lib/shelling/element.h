/* Geometry of the simplices of a mesh: volumes, gradients, areas and conductances. */
#ifndef ICCP_ELEMENT_H
#define ICCP_ELEMENT_H

#include "geometry/simplices.h"

#include <stdbool.h>

/* Returns the positive volume of a simplex. Writes the gradients of its barycentric coordinates:
 * dim + 1 rows of dim numbers. An almost flat simplex counts as slightly thicker. */
double iccp_element_gradients(const iccp_simplices *mesh, size_t simplex, double *gradient);

/* The area of the facet at a side, for example the length of an edge of a triangle. */
double iccp_element_area(const iccp_simplices *mesh, size_t side);

/* The conductance of a facet: its area over the distance of the barycentres of its two
 * simplices, or of the simplex and the domain's facet. Both sides give the same value up to
 * rounding. */
double iccp_element_conductance(const iccp_simplices *mesh, size_t side);

/* Returns true if a simplex belongs to the star of a vertex. */
static inline bool iccp_element_has(const iccp_simplices *mesh, size_t simplex, uint32_t vertex)
{
    const uint32_t *corner = mesh->corners + (mesh->dim + 1) * simplex;
    for (size_t i = 0; i <= mesh->dim; ++i)
        if (corner[i] == vertex)
            return true;
    return false;
}

#endif
