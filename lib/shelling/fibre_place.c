#include "shelling/fibre.h"

#include <string.h>

enum { MAX = ICC_MAX_DIM };

void iccp_fibres_offset(const iccp_fibres *fibres, const iccp_fibre_place *place, size_t corner,
                        double *offset)
{
    const size_t dim = fibres->dim, n = dim + 1;
    const uint32_t *v = fibres->corners + n * place->simplex;
    const double *origin = fibres->points + dim * v[corner];
    const double sum = iccp_fibre_sum(place->bary, n);
    memset(offset, 0, MAX * sizeof *offset);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < dim; ++k)
            offset[k] += place->bary[i] / sum * (fibres->points[dim * v[i] + k] - origin[k]);
}

/* From the corner with the greatest weight, so that corners come out exactly. */
void iccp_fibres_point(const iccp_fibres *fibres, const iccp_fibre_place *place, double *point)
{
    const size_t dim = fibres->dim;
    double offset[MAX];
    size_t from = 0;
    for (size_t i = 1; i <= dim; ++i)
        from = place->bary[i] > place->bary[from] ? i : from;
    iccp_fibres_offset(fibres, place, from, offset);
    const double *origin =
        fibres->points + dim * fibres->corners[(dim + 1) * place->simplex + from];
    for (size_t k = 0; k < dim; ++k)
        point[k] = origin[k] + offset[k];
}

/* The quotient rule, as the coordinates need not sum to 1. */
void iccp_fibres_movement(const iccp_fibres *fibres, const iccp_fibre_place *place,
                          const iccp_fibre_jet *jet, double movement[MAX][MAX])
{
    const size_t dim = fibres->dim, n = dim + 1;
    const uint32_t *v = fibres->corners + n * place->simplex;
    const double sum = iccp_fibre_sum(place->bary, n);
    double point[MAX];
    iccp_fibres_point(fibres, place, point);
    memset(movement, 0, MAX * sizeof movement[0]);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < dim; ++k) {
            const double arm = (fibres->points[dim * v[i] + k] - point[k]) / sum;
            for (size_t p = 0; p < jet->n; ++p)
                movement[k][p] += arm * jet->bary[i][p];
        }
}

void iccp_fibres_enter(const iccp_fibres *fibres, uint32_t facet, const uint32_t *vertices,
                       const double *bary, iccp_fibre_place *place)
{
    const size_t dim = fibres->dim, n = dim + 1;
    place->simplex = fibres->rim[facet] / (uint32_t)n;
    const uint32_t *v = fibres->corners + n * place->simplex;
    for (size_t i = 0; i < n; ++i) {
        place->bary[i] = 0;
        for (size_t k = 0; k < dim; ++k)
            if (vertices[k] == v[i])
                place->bary[i] = bary[k] + 0.0; /* -0 becomes 0 */
    }
}

void iccp_fibres_facet(const iccp_fibres *fibres, const iccp_fibre_place *place,
                       const uint32_t *vertices, double *bary)
{
    const size_t dim = fibres->dim, n = dim + 1;
    const uint32_t *v = fibres->corners + n * place->simplex;
    for (size_t k = 0; k < dim; ++k)
        for (size_t i = 0; i < n; ++i)
            if (vertices[k] == v[i])
                bary[k] = place->bary[i];
}
