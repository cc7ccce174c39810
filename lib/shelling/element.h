/* Geometry of the simplices of a mesh. */
#ifndef ICCP_ELEMENT_H
#define ICCP_ELEMENT_H

#include "geometry/simplices.h"

#include <stdbool.h>

/* The volume of a simplex, positive, and the gradients of its barycentric coordinates: dim + 1 rows
 * of dim numbers. Simplices that are all but flat count as a little thicker. */
double iccp_element_gradients(const iccp_simplices *mesh, size_t simplex, double *gradient);

/* The area of the facet at a side: length of an edge of a triangle, and so on. */
double iccp_element_area(const iccp_simplices *mesh, size_t side);

/* That over the distance of the barycentres of the simplices at the facet, or from the simplex to
 * the domain's facet. The same from both sides but for rounding. */
double iccp_element_conductance(const iccp_simplices *mesh, size_t side);

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
