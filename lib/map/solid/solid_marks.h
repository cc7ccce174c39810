/* What a map in space must keep: fixed points, and marked faces and edges of the mesh. */
#ifndef ICCP_SOLID_MARKS_H
#define ICCP_SOLID_MARKS_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* The first n_fixed points of the mesh are fixed: the vertices of the domain, and then the
 * points on its lines. The facets of the boundary and of regions are marked, with their edges, and
 * the pieces of lines. */
typedef struct iccp_solid_marks {
    iccp_memory memory;
    size_t n_fixed;
    size_t n_facets;        /* marked facets, those of the boundary first */
    const uint32_t *facets; /* dim points of each; borrowed */
    size_t n_edges;
    uint32_t *edges; /* 2 points of each piece of a line */
    /* By fixed point, unless there are no features: the facets and pieces at it */
    uint32_t *first_facet, *facet, *first_edge, *edge;
} iccp_solid_marks;

/* Lists the marks of a mesh that fills the domain. Its points on lines follow the vertices, in the
 * order of on_line[]. The domain must live longer. */
icc_status iccp_solid_marks_create(iccp_solid_marks *marks, const icc_domain *domain,
                                   const iccp_simplices *mesh, const iccp_memory *memory);
void iccp_solid_marks_free(iccp_solid_marks *marks);

/* Returns true for an inner edge or an inner face that must stay. Marks of the boundary are not
 * found in a domain without features. */
bool iccp_solid_keeps_edge(const iccp_solid_marks *marks, uint32_t a, uint32_t b);
bool iccp_solid_keeps_face(const iccp_solid_marks *marks, const uint32_t face[3]);

#endif
