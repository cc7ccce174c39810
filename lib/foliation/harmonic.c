/* The harmonic map of a mesh to the unit disc.
 *
 * Sources: W. Tutte, How to draw a graph, 1963. M. Floater, Parametrization and smooth
 * approximation of surface triangulations, 1997. With positive weights and a convex boundary the
 * map is one-to-one. */
#include "foliation/harmonic.h"

#include "base/clock.h"
#include "base/error.h"
#include "geometry/locate.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

icc_status iccp_harmonic_create(iccp_harmonic *base, const icc_domain *domain,
                                const uint32_t *pieces, int32_t cells, const iccp_env *env,
                                icc_error *err)
{
    const double start = iccp_seconds();
    memset(base, 0, sizeof *base);
    base->cells = cells;
    icc_status status = iccp_planar_create(&base->mesh, domain, pieces, cells, env, err);
    base->seconds_mesh = iccp_seconds() - start;
    if (status == ICC_OK && base->mesh.n_vertices == base->mesh.n_boundary) {
        iccp_harmonic_free(base);
        status =
            iccp_fail(err, ICC_ERR_RESOLUTION, "the mesh has no vertex inside: use more cells");
    }
    return status;
}

icc_status iccp_harmonic_factorise(iccp_harmonic *base, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    icc_status status =
        iccp_laplacian_create(&base->laplacian, &base->mesh, ICCP_NO_NEIGHBOUR, &part[0]);
    if (status == ICC_OK)
        status = iccp_spd_create(&base->solver, &base->laplacian.matrix, &part[1]);
    if (status != ICC_OK)
        (void)iccp_fail(err, status, "the mesh's equations cannot be factorised");
    base->seconds_solve = iccp_seconds() - start;
    return status;
}

void iccp_harmonic_describe(const iccp_harmonic *base, const icc_domain *domain,
                            icc_chart_info *info)
{
    const double *scale = domain->frame.out;
    info->cells = base->cells;
    info->spacing = iccp_planar_step(domain, base->cells) * scale[0] * scale[1];
}

void iccp_harmonic_drop_factor(iccp_harmonic *base)
{
    iccp_ldlt_free(&base->solver);
    iccp_laplacian_free(&base->laplacian);
}

void iccp_harmonic_free(iccp_harmonic *base)
{
    iccp_harmonic_drop_factor(base);
    iccp_planar_free(&base->mesh);
}

iccp_planar iccp_harmonic_move_mesh(iccp_harmonic *base)
{
    const iccp_planar mesh = base->mesh;
    base->mesh = (iccp_planar){.memory = mesh.memory};
    return mesh;
}

icc_status iccp_harmonic_disc(const iccp_harmonic *base, const double *turns, double *image,
                              const iccp_env *env)
{
    const iccp_laplacian *l = &base->laplacian;
    const size_t n_boundary = base->mesh.n_boundary;
    double *inner = image + 2 * n_boundary;
    for (size_t k = 0; k < n_boundary; ++k)
        iccp_cis_turns(turns[k], image + 2 * k);
    for (size_t i = 0; i < l->matrix.n; ++i) {
        inner[2 * i] = inner[2 * i + 1] = 0;
        for (size_t p = l->boundary_first[i]; p < l->boundary_first[i + 1]; ++p)
            for (size_t d = 0; d < 2; ++d)
                inner[2 * i + d] +=
                    l->boundary_weight[p] * image[2 * (size_t)l->boundary_vertex[p] + d];
    }
    return iccp_spd_solve(&base->solver, 2, inner, env);
}

void iccp_add_arc_length(const iccp_planar *mesh, double weight, double *turns)
{
    const size_t n = mesh->n_boundary;
    double total = 0, before = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (size_t k = 0; k < n; ++k) {
            const double *p = mesh->points + 2 * k, *q = mesh->points + 2 * ((k + 1) % n);
            const double length = iccp_hypot(q[0] - p[0], q[1] - p[1]);
            if (pass == 0) {
                total += length;
            } else {
                turns[k] += weight * before / total;
                before += length;
            }
        }
}

uint32_t iccp_deepest_vertex(const iccp_planar *mesh, const icc_domain *domain)
{
    uint32_t best = ICCP_NO_NEIGHBOUR;
    double depth = -1;
    for (size_t v = mesh->n_boundary; v < mesh->n_vertices; ++v) {
        double t, distance2;
        (void)iccp_boxtree_nearest(&iccp_locator_trees(domain->locator)->edges,
                                   mesh->points + 2 * v, &t, &distance2);
        if (distance2 > depth) {
            depth = distance2;
            best = (uint32_t)v;
        }
    }
    return best;
}

uint32_t iccp_nearest_vertex(const iccp_planar *mesh, const double *points, const double p[2])
{
    uint32_t best = ICCP_NO_NEIGHBOUR;
    double least = HUGE_VAL;
    for (size_t v = mesh->n_boundary; v < mesh->n_vertices; ++v) {
        const double dx = points[2 * v] - p[0], dy = points[2 * v + 1] - p[1];
        if (dx * dx + dy * dy < least) {
            least = dx * dx + dy * dy;
            best = (uint32_t)v;
        }
    }
    return best;
}
