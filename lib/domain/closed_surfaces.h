/* The closed surfaces of a boundary in space, and which of them lies in which. */
#ifndef ICCP_CLOSED_SURFACES_H
#define ICCP_CLOSED_SURFACES_H

#include "domain/complex.h"
#include "geometry/facet_tree.h"

/* A closed connected surface. */
typedef struct iccp_surface {
    uint32_t first_facet; /* the smallest number of its facets */
    uint32_t n_facets, n_vertices;
    uint32_t lowest;     /* its first vertex by x, then y, then z */
    uint32_t around;     /* the next surface around it, or UINT32_MAX */
    int32_t orientation; /* +1 if its facets are listed as seen from outside, else -1 */
} iccp_surface;

typedef struct iccp_surfaces {
    size_t n;
    iccp_surface *item;
    uint32_t *of_facet; /* by facet */
    /* Work of iccp_surfaces_around(): surfaces that a ray crosses. By surface: -1 if it crosses it
     * an odd number of times, 1 for an even number, 0 if not at all */
    uint32_t *crossed;
    int8_t *state;
} iccp_surfaces;

/* Finds the surfaces of a joined complex of dimension 3 that passed iccp_complex_check_vertices().
 * They are numbered in the order of their first facets. The tree is over the facets, of which none
 * meet. Exact. Returns ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. */
icc_status iccp_surfaces_create(iccp_surfaces *surfaces, const iccp_complex *c,
                                const iccp_facet_tree *tree, const iccp_env *env);
void iccp_surfaces_free(iccp_surfaces *surfaces, const iccp_memory *memory);

/* Returns true if vertex v comes before w by x, then y, then z. */
bool iccp_surface_is_lower(const iccp_facet_tree *tree, uint32_t v, uint32_t w);

/* Number of handles: L. Euler, V - E + F = 2 - 2 genus. */
static inline size_t iccp_surface_genus(const iccp_surface *surface)
{
    return (2 + (size_t)surface->n_facets / 2 - surface->n_vertices) / 2;
}

/* Returns the innermost surface around a local point that lies on no surface but `except`, or
 * UINT32_MAX if there is none. */
uint32_t iccp_surfaces_around(iccp_surfaces *surfaces, const iccp_facet_tree *tree,
                              const double *point, uint32_t except);

/* Refuses surface k if it is not that of a void in the surface `outer`. `around` is the next
 * surface around it that counts. */
icc_status iccp_surfaces_check_void(const iccp_surfaces *surfaces, uint32_t outer, uint32_t k,
                                    uint32_t around, icc_error *err);

#endif
