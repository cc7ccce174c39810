/* What objects say of themselves and answer to fixed questions, as one number each. Times are left
 * out. */
#ifndef TESTS_GOLDEN_OUTCOMES_H
#define TESTS_GOLDEN_OUTCOMES_H

#include "../flat_mesh.h"
#include "../reports.h"
#include "digest.h"
#include "fixtures.h"

#include <icc/kernel.h>

enum { N_ASKED = 120, N_COORDINATES = N_ASKED * ICC_MAX_DIM };

/* Points that fill a box and a little more. */
static inline void points_of_box(int32_t dim, const double *lower, const double *upper,
                                 double *points)
{
    random_source r = {51};
    for (size_t i = 0; i < N_ASKED; ++i)
        for (int32_t k = 0; k < dim; ++k) {
            const double more = (upper[k] - lower[k]) / 64;
            points[(size_t)dim * i + (size_t)k] =
                random_between(&r, lower[k] - more, upper[k] + more);
        }
}

static inline void points_of_domain(const icc_domain *domain, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    (void)icc_domain_get_info(domain, &info);
    points_of_box(info.dim, info.lower, info.upper, points);
}

static inline void digest_domain(digest *d, const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    double points[N_COORDINATES], bary[N_COORDINATES];
    int32_t where[N_ASKED];
    uint32_t facet[N_ASKED];
    (void)icc_domain_get_info(domain, &info);
    const size_t dim = (size_t)info.dim;
    digest_i32(d, 1, &info.dim);
    digest_i32(d, 1, &info.orientation);
    digest_size(d, info.n_vertices);
    digest_size(d, info.n_facets);
    digest_f64(d, dim, info.lower);
    digest_f64(d, dim, info.upper);
    digest_f64(d, 1, &info.measure);
    points_of_domain(domain, points);
    must(icc_domain_locate(domain, N_ASKED, points, where, facet, bary, NULL), "locate", NULL);
    digest_i32(d, N_ASKED, where);
    digest_u32(d, N_ASKED, facet);
    digest_f64(d, N_ASKED * dim, bary);
}

/* ---- charts ---- */

static inline void digest_gradient_info(digest *d, const icc_chart *chart)
{
    icc_gradient_info g = {.size = sizeof g};
    if (icc_chart_get_gradient_info(chart, &g) != ICC_OK)
        return;
    const size_t counts[] = {g.n_grid,   g.n_inside,      g.n_tree,     g.n_unreachable,
                             g.n_maxima, g.n_minima,      g.n_saddles,  g.n_cousin_violations,
                             g.n_edges,  g.n_compression, g.n_expansion};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        digest_size(d, counts[k]);
    digest_f64(d, 1, &g.moved);
}

static inline void digest_field_info(digest *d, const icc_chart *chart)
{
    icc_field_info f = {.size = sizeof f};
    if (icc_chart_get_field_info(chart, &f) != ICC_OK)
        return;
    const size_t counts[] = {f.n_grid,   f.n_inside,  f.n_stray,      f.n_tree,     f.n_maxima,
                             f.n_minima, f.n_saddles, f.n_infeasible, f.n_contacts, f.n_not_inward};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        digest_size(d, counts[k]);
}

static inline void digest_mesh_info(digest *d, const icc_chart *chart)
{
    icc_foliation_info f = {.size = sizeof f};
    icc_shelling_info s = {.size = sizeof s};
    icc_disc_info c = {.size = sizeof c};
    (void)icc_chart_get_foliation_info(chart, &f);
    (void)icc_chart_get_shelling_info(chart, &s);
    (void)icc_chart_get_disc_info(chart, &c);
    const size_t counts[] = {f.n_mesh_vertices, f.n_mesh_simplices, f.n_ties,
                             s.n_mesh_vertices, s.n_mesh_simplices, s.n_reversed,
                             c.n_mesh_vertices, c.n_mesh_simplices};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        digest_size(d, counts[k]);
    const double numbers[] = {f.harmonic_share, s.harmonic_share, s.order_beta, s.flux_energy,
                              s.flux_divergence};
    digest_f64(d, sizeof numbers / sizeof *numbers, numbers);
}

static inline void digest_chart_info(digest *d, const icc_chart *chart)
{
    icc_chart_info info = {.size = sizeof info};
    (void)icc_chart_get_info(chart, &info);
    const int32_t numbers[] = {info.dim, info.method, info.certified, info.reason, info.cells};
    digest_i32(d, sizeof numbers / sizeof *numbers, numbers);
    digest_f64(d, (size_t)info.dim, info.maximum);
    digest_f64(d, 1, &info.spacing);
    digest_gradient_info(d, chart);
    digest_field_info(d, chart);
    digest_mesh_info(d, chart);
}

static inline void digest_report(digest *d, const icc_chart *chart)
{
    icc_chart_report r = {.size = sizeof r};
    must(icc_chart_get_report(chart, 300, &r, NULL, NULL), "report", NULL);
    const double shares[] = {r.unreachable, r.uncovered, r.collapsed, r.not_inward};
    digest_f64(d, sizeof shares / sizeof *shares, shares);
}

static inline void digest_curve(digest *d, const icc_chart *chart, size_t dim, const double *point)
{
    enum { LONGEST = 2000 };
    static double curve[LONGEST * ICC_MAX_DIM];
    size_t n = 0;
    const icc_status status = icc_chart_trace(chart, point, LONGEST, curve, &n, NULL, NULL);
    digest_i32(d, 1, &status);
    if (status != ICC_OK)
        return;
    digest_size(d, n);
    digest_f64(d, (n < LONGEST ? n : LONGEST) * dim, curve);
}

/* Coordinates of points, the way back, and some curves. */
static inline void digest_chart(digest *d, const icc_chart *chart)
{
    double points[N_COORDINATES], bary[N_COORDINATES], t[N_ASKED], back[N_COORDINATES];
    uint32_t facet[N_ASKED];
    icc_status status[N_ASKED];
    icc_domain_info info = {.size = sizeof info};
    (void)icc_domain_get_info(icc_chart_domain(chart), &info);
    const size_t dim = (size_t)info.dim;
    digest_domain(d, icc_chart_domain(chart));
    digest_chart_info(d, chart);
    digest_report(d, chart);
    points_of_domain(icc_chart_domain(chart), points);
    must(icc_chart_encode(chart, N_ASKED, points, facet, bary, t, status, NULL, NULL), "encode",
         NULL);
    digest_u32(d, N_ASKED, facet);
    digest_f64(d, N_ASKED * dim, bary);
    digest_f64(d, N_ASKED, t);
    digest_i32(d, N_ASKED, status);
    must(icc_chart_decode(chart, N_ASKED, facet, bary, t, back, status, NULL, NULL), "decode",
         NULL);
    digest_f64(d, N_ASKED * dim, back);
    digest_i32(d, N_ASKED, status);
    for (size_t i = 0; i < N_ASKED; i += 20)
        digest_curve(d, chart, dim, points + dim * i);
}

/* ---- maps ---- */

static inline icc_map_info info_of_map(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    (void)icc_map_get_info(map, &info);
    return info;
}

static inline void digest_map_info(digest *d, const icc_map_info *info, const icc_map_report *made)
{
    const int32_t numbers[] = {info->dim,      info->kind,   info->certified,
                               made->n_levels, info->reason, info->reason_side};
    const size_t counts[] = {info->n_vertices,   info->n_simplices,  made->n_inverted,
                             made->n_unrepaired, made->n_iterations, made->n_samples,
                             made->n_lost,       made->n_flat};
    const double energies[] = {made->energy_start, info->energy};
    digest_i32(d, sizeof numbers / sizeof *numbers, numbers);
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        digest_size(d, counts[k]);
    digest_f64(d, sizeof energies / sizeof *energies, energies);
}

/* The mesh, and the box of its vertices. */
static inline void digest_map_mesh(digest *d, const icc_map *map, const icc_map_info *info,
                                   double *lower, double *upper)
{
    const size_t dim = (size_t)info->dim, n = info->n_vertices * dim;
    double *numbers = mesh_alloc(2 * n, sizeof *numbers);
    uint32_t *corners = mesh_alloc(info->n_simplices * (dim + 1), sizeof *corners);
    must(flat_get_mesh(map, numbers, numbers + n, corners), "mesh", NULL);
    digest_f64(d, 2 * n, numbers);
    digest_u32(d, info->n_simplices * (dim + 1), corners);
    for (size_t i = 0; i < n; ++i) {
        double *low = lower + i % dim, *up = upper + i % dim;
        *low = i < dim || numbers[i] < *low ? numbers[i] : *low;
        *up = i < dim || numbers[i] > *up ? numbers[i] : *up;
    }
    free(numbers);
    free(corners);
}

/* Images of points, derivatives, and the way back. */
static inline void digest_images(digest *d, const icc_map *map, size_t dim, const double *points)
{
    static double jacobians[N_COORDINATES * ICC_MAX_DIM];
    double images[N_COORDINATES], back[N_COORDINATES];
    icc_status status[N_ASKED];
    must(icc_map_apply(map, N_ASKED, points, images, status, NULL, NULL), "apply", NULL);
    digest_f64(d, N_ASKED * dim, images);
    digest_i32(d, N_ASKED, status);
    must(icc_map_jacobian(map, N_ASKED, points, jacobians, status, NULL, NULL), "jacobian", NULL);
    digest_f64(d, N_ASKED * dim * dim, jacobians);
    digest_i32(d, N_ASKED, status);
    must(icc_map_apply_inverse(map, N_ASKED, images, back, status, NULL, NULL), "inverse", NULL);
    digest_f64(d, N_ASKED * dim, back);
    digest_i32(d, N_ASKED, status);
}

static inline void digest_map(digest *d, const icc_map *map)
{
    const icc_map_info info = info_of_map(map);
    double points[N_COORDINATES], lower[ICC_MAX_DIM], upper[ICC_MAX_DIM];
    const icc_map_report made = report_of(map);
    digest_map_info(d, &info, &made);
    if (info.kind == ICC_MAP_MESH) {
        digest_map_mesh(d, map, &info, lower, upper);
        points_of_box(info.dim, lower, upper, points);
    } else {
        points_of_domain(icc_chart_domain(icc_map_source_chart(map)), points);
    }
    digest_images(d, map, (size_t)info.dim, points);
}

/* ---- kernel coordinates ---- */

static inline void digest_sampling(digest *d, const icc_sampling *sampling)
{
    icc_sampling_info info = {.size = sizeof info};
    (void)icc_sampling_get_info(sampling, &info);
    const size_t dim = (size_t)info.dim;
    double *points = mesh_alloc(info.n_samples * dim, sizeof *points);
    (void)icc_sampling_get_points(sampling, points);
    const double numbers[] = {info.spacing, info.nearest, info.sigma};
    digest_i32(d, 1, &info.kind);
    digest_size(d, info.n_samples);
    digest_size(d, info.n_edge);
    digest_f64(d, sizeof numbers / sizeof *numbers, numbers);
    digest_f64(d, info.n_samples * dim, points);
    free(points);
}

/* At the nodes, and with derivatives at points of the box of -1 and 1. */
static inline void digest_weights(digest *d, const icc_weights *weights)
{
    static const double LOWER[3] = {-1, -1, -1}, UPPER[3] = {1, 1, 1};
    icc_weights_info info = {.size = sizeof info};
    (void)icc_weights_get_info(weights, &info);
    const size_t dim = (size_t)info.dim, m = info.n_handles, n = info.n_nodes * m;
    double *values = mesh_alloc(2 * n + (1 + dim) * N_ASKED * m, sizeof *values);
    double *here = values + 2 * n, *slopes = here + N_ASKED * m, points[N_COORDINATES];
    icc_status *status = mesh_alloc(info.n_nodes, sizeof *status);
    (void)icc_weights_get_nodes(weights, NULL, values, values + n, status);
    points_of_box(info.dim, LOWER, UPPER, points);
    must(icc_weights_evaluate(weights, N_ASKED, points, here, slopes, NULL, NULL, NULL), "weights",
         NULL);
    digest_size(d, info.n_nodes);
    digest_size(d, info.n_infeasible);
    digest_size(d, info.n_entries);
    digest_f64(d, 1, &info.sigma);
    digest_f64(d, 1, &info.definiteness);
    digest_f64(d, 2 * n + (1 + dim) * N_ASKED * m, values);
    digest_i32(d, info.n_nodes, status);
    free(values);
    free(status);
}

/* One handle moved, one turned. */
static inline void digest_binding(digest *d, const icc_binding *binding)
{
    size_t n, m;
    int32_t dim32;
    (void)icc_binding_get_counts(binding, &n, &m, &dim32);
    const size_t dim = (size_t)dim32;
    static const double AXIS[3] = {1, 2, 3}, OFFSET[3] = {.25, -.5, .125};
    double *transforms = mesh_alloc(m * dim * (dim + 1), sizeof *transforms);
    double *handles = mesh_alloc(m * dim, sizeof *handles);
    double *images = mesh_alloc(n * dim * (1 + dim), sizeof *images);
    (void)icc_binding_get_weights(binding, handles, NULL);
    (void)icc_pose_reset(dim32, m, transforms);
    (void)icc_pose_move(dim32, transforms, OFFSET);
    must(icc_pose_turn(dim32, transforms + dim * (dim + 1), handles + dim, AXIS, .75), "turn",
         NULL);
    must(icc_binding_pose(binding, transforms, images, images + n * dim, NULL), "pose", NULL);
    digest_f64(d, m * dim * (dim + 1), transforms);
    digest_f64(d, n * dim * (1 + dim), images);
    free(transforms);
    free(handles);
    free(images);
}

#endif
