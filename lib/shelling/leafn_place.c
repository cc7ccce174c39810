/* Converts the places of leafn.h to points, facets and movements. */
#include "shelling/leafn.h"

#include <string.h>

enum { MAX = ICC_MAX_DIM };

void iccp_leafn_offset(const iccp_leaves *leaves, const iccp_leafn_place *place, size_t corner,
                       double *offset)
{
    const size_t dim = leaves->dim, n = dim + 1;
    const uint32_t *v = leaves->corners + n * place->simplex;
    const double *origin = leaves->points + dim * v[corner];
    const double sum = iccp_leafn_sum(place->bary, n);
    memset(offset, 0, MAX * sizeof *offset);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < dim; ++k)
            offset[k] += place->bary[i] / sum * (leaves->points[dim * v[i] + k] - origin[k]);
}

/* Starts from the corner with the greatest weight, so that corners are exact. */
void iccp_leafn_point(const iccp_leaves *leaves, const iccp_leafn_place *place, double *point)
{
    const size_t dim = leaves->dim;
    double offset[MAX];
    size_t from = 0;
    for (size_t i = 1; i <= dim; ++i)
        from = place->bary[i] > place->bary[from] ? i : from;
    iccp_leafn_offset(leaves, place, from, offset);
    const double *origin =
        leaves->points + dim * leaves->corners[(dim + 1) * place->simplex + from];
    for (size_t k = 0; k < dim; ++k)
        point[k] = origin[k] + offset[k];
}

/* Uses the quotient rule, because the coordinates need not sum to 1. */
void iccp_leafn_movement(const iccp_leaves *leaves, const iccp_leafn_place *place,
                         const iccp_leafn_jet *jet, double movement[MAX][MAX])
{
    const size_t dim = leaves->dim, n = dim + 1;
    const uint32_t *v = leaves->corners + n * place->simplex;
    const double sum = iccp_leafn_sum(place->bary, n);
    double point[MAX];
    iccp_leafn_point(leaves, place, point);
    memset(movement, 0, MAX * sizeof movement[0]);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < dim; ++k) {
            const double arm = (leaves->points[dim * v[i] + k] - point[k]) / sum;
            for (size_t p = 0; p < jet->n; ++p)
                movement[k][p] += arm * jet->bary[i][p];
        }
}

void iccp_leafn_enter(const iccp_leaves *leaves, uint32_t facet, const uint32_t *vertices,
                      const double *bary, iccp_leafn_place *place)
{
    const size_t dim = leaves->dim, n = dim + 1;
    place->simplex = leaves->boundary_side[facet] / (uint32_t)n;
    const uint32_t *v = leaves->corners + n * place->simplex;
    for (size_t i = 0; i < n; ++i) {
        place->bary[i] = 0;
        for (size_t k = 0; k < dim; ++k)
            if (vertices[k] == v[i])
                place->bary[i] = bary[k] + 0.0; /* turns -0 into 0 */
    }
}

void iccp_leafn_facet(const iccp_leaves *leaves, const iccp_leafn_place *place,
                      const uint32_t *vertices, double *bary)
{
    const size_t dim = leaves->dim, n = dim + 1;
    const uint32_t *v = leaves->corners + n * place->simplex;
    for (size_t k = 0; k < dim; ++k)
        for (size_t i = 0; i < n; ++i)
            if (vertices[k] == v[i])
                bary[k] = place->bary[i];
}
