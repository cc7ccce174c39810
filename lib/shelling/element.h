/* Geometry of the simplices of a mesh. */
#ifndef ICCP_ELEMENT_H
#define ICCP_ELEMENT_H

#include "domain/simplices.h"

#include <stdbool.h>

/* The volume of a simplex, not less than a tiny positive number, and the gradients of its barycentric
 * coordinates: dim + 1 rows of dim numbers. The facet opposite corner i has dim * volume * |row i| for
 * its area. */
double iccp_element_gradients(const iccp_simplices *mesh, size_t simplex, double *gradient);

/* The area of the facet opposite a corner, from these. */
double iccp_element_area(size_t dim, double volume, const double *gradient, size_t corner);

void iccp_element_barycentre(const iccp_simplices *mesh, size_t simplex, double *point);

/* The distance between two points. */
double iccp_element_distance(size_t dim, const double *a, const double *b);

/* Whether a simplex belongs to the star of a vertex. */
static inline bool iccp_element_has(const iccp_simplices *mesh, size_t simplex, uint32_t vertex)
{
    const uint32_t *corner = mesh->corners + (mesh->dim + 1) * simplex;
    for (size_t i = 0; i <= mesh->dim; ++i)
        if (corner[i] == vertex)
            return true;
    return false;
}

#endif
