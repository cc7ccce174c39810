#include "map/higher/stars.h"

#include <string.h>

/* Counts or writes the simplices of each star. `at` is where the next one belongs. */
static void visit(const iccp_simplices *mesh, uint32_t *at, uint32_t *simplex)
{
    const size_t n_corners = mesh->dim + 1;
    for (size_t side = 0; side < n_corners * mesh->n_simplices; ++side) {
        if (mesh->corners[side] < mesh->n_boundary)
            continue;
        uint32_t *place = &at[mesh->corners[side] - mesh->n_boundary];
        if (simplex != NULL)
            simplex[*place] = (uint32_t)(side / n_corners);
        ++*place;
    }
}

icc_status iccp_stars_create(iccp_stars *stars, const iccp_simplices *mesh,
                             const iccp_memory *memory)
{
    const size_t n = mesh->n_points - mesh->n_boundary;
    *stars = (iccp_stars){.first_vertex = mesh->n_boundary, .n_vertices = n};
    stars->first = iccp_alloc_zero(memory, n + 2, sizeof *stars->first);
    if (stars->first == NULL)
        return ICC_ERR_MEMORY;
    visit(mesh, stars->first + 2, NULL);
    for (size_t v = 2; v <= n + 1; ++v)
        stars->first[v] += stars->first[v - 1];
    stars->simplex = iccp_alloc(memory, stars->first[n + 1], sizeof *stars->simplex);
    if (stars->simplex == NULL) {
        iccp_stars_free(stars, memory);
        return ICC_ERR_MEMORY;
    }
    visit(mesh, stars->first + 1, stars->simplex);
    return ICC_OK;
}

void iccp_stars_free(iccp_stars *stars, const iccp_memory *memory)
{
    iccp_free(memory, stars->first);
    iccp_free(memory, stars->simplex);
    stars->first = stars->simplex = NULL;
}
