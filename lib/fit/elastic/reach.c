/* Bending as part of an energy of images. The matrix of second derivatives joins vertices with a
 * common neighbour, so the pattern of the Hessian needs them as well. */
#include "fit/elastic/reach.h"

#include "base/sort.h"
#include "base/triangle_corners.h"
#include "fit/spline/bending.h"
#include "mesh/triangulate.h"

#include <string.h>

/* ---- links ---- */

typedef struct ring {
    const uint32_t *corners;
    const uint32_t *triangles; /* of the vertex in the middle */
    uint32_t n;
    uint32_t middle;
} ring;

/* Returns the vertex of triangle k of a ring that comes after the middle, or before it. */
static uint32_t ring_vertex(const ring *r, uint32_t k, bool before)
{
    const uint32_t *v = r->corners + 3 * (size_t)r->triangles[k];
    const uint32_t at = v[0] == r->middle ? 0 : v[1] == r->middle ? 1 : 2;
    return v[(at + (before ? 2 : 1)) % 3];
}

/* Lists the pairs of vertices of a ring that are not neighbours in it. Around an inner vertex each
 * vertex of the ring comes first in one triangle. */
static void link_ring(iccp_reach *reach, const ring *r)
{
    for (uint32_t i = 0; i < r->n; ++i)
        for (uint32_t j = i + 1; j < r->n; ++j) {
            const uint32_t p = ring_vertex(r, i, false), q = ring_vertex(r, j, false);
            const uint32_t link[3] = {p, r->middle, q};
            if (ring_vertex(r, i, true) != q && ring_vertex(r, j, true) != p)
                memcpy(reach->links + 3 * reach->n_links++, link, sizeof link);
        }
}

static icc_status make_links(iccp_reach *reach, size_t n_points, size_t n_triangles,
                             const uint32_t *corners, const uint32_t *twins)
{
    const iccp_memory *memory = &reach->memory;
    uint32_t *around = iccp_alloc(memory, n_triangles, 3 * sizeof *around);
    uint32_t *first = iccp_alloc_zero(memory, n_points + 1, sizeof *first);
    uint8_t *is_boundary = iccp_alloc_zero(memory, n_points, 1);
    size_t room = 0;
    if (around != NULL && first != NULL && is_boundary != NULL) {
        iccp_list_groups(around, first, n_points, corners, n_triangles, 3);
        for (uint32_t c = 0; c < 3 * n_triangles; ++c)
            if (twins[c] == ICCP_NO_NEIGHBOUR)
                is_boundary[corners[iccp_after(c)]] = is_boundary[corners[iccp_before(c)]] = 1;
        for (size_t v = 0; v < n_points; ++v)
            if (!is_boundary[v])
                room += (size_t)(first[v + 1] - first[v]) * (first[v + 1] - first[v]) / 2;
        reach->links = iccp_alloc(memory, room, 3 * sizeof *reach->links);
    }
    for (uint32_t v = 0; reach->links != NULL && v < n_points; ++v) {
        const ring r = {corners, around + first[v], first[v + 1] - first[v], v};
        if (!is_boundary[v])
            link_ring(reach, &r);
    }
    iccp_free(memory, around);
    iccp_free(memory, first);
    iccp_free(memory, is_boundary);
    return reach->links != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_reach_create(iccp_reach *reach, double length, size_t n_points,
                             const double *points, size_t n_triangles, const uint32_t *corners,
                             const uint32_t *twins, const iccp_env *env)
{
    const iccp_bending_mesh mesh = {n_points, n_triangles, points, corners, twins, {1, 0, 0, 1}};
    *reach = (iccp_reach){.memory = env->memory, .gram.memory = env->memory};
    if (!(length > 0))
        return ICC_OK;
    reach->factor = length * length;
    const icc_status status = iccp_bending_energy(&reach->gram, &mesh, env);
    return status == ICC_OK ? make_links(reach, n_points, n_triangles, corners, twins) : status;
}

void iccp_reach_free(iccp_reach *reach)
{
    const iccp_memory memory = reach->memory;
    iccp_gram_free(&reach->gram);
    iccp_free(&memory, reach->links);
    *reach = (iccp_reach){.memory = memory, .gram.memory = memory};
}

/* ---- energy ---- */

/* Row i of Q times the images. */
static void multiply(const iccp_gram *q, const double *images, size_t i, double *product)
{
    for (size_t d = 0; d < 2; ++d)
        product[d] = q->diagonal[i] * images[2 * i + d];
    for (size_t e = q->first[i]; e < q->first[i + 1]; ++e)
        for (size_t d = 0; d < 2; ++d)
            product[d] += q->value[e] * images[2 * (size_t)q->column[e] + d];
}

double iccp_reach_energy(const iccp_reach *reach, const double *images)
{
    double sum = 0;
    for (size_t i = 0; reach->factor > 0 && i < reach->gram.matrix.n; ++i) {
        double product[2];
        multiply(&reach->gram, images, i, product);
        sum += images[2 * i] * product[0] + images[2 * i + 1] * product[1];
    }
    return reach->factor * sum;
}

void iccp_reach_gradient(const iccp_reach *reach, const double *images, size_t vertex,
                         double *gradient)
{
    multiply(&reach->gram, images, vertex, gradient);
    for (size_t d = 0; d < 2; ++d)
        gradient[d] *= 2 * reach->factor;
}

void iccp_reach_find(const iccp_reach *reach, const iccp_assembly *assembly, uint32_t *place)
{
    const iccp_gram *q = &reach->gram;
    for (size_t i = 0; reach->factor > 0 && i < q->matrix.n; ++i) {
        const size_t first = assembly->first[2 * i] + 1;
        const uint32_t *column = assembly->column + first;
        const size_t n = (assembly->first[2 * i + 1] - first) / 2;
        for (size_t e = q->first[i]; e < q->first[i + 1]; ++e) {
            uint32_t k = 0;
            while (k < n && column[2 * k] != 2 * q->column[e])
                ++k;
            place[e] = k < n ? k : UINT32_MAX;
        }
    }
}
