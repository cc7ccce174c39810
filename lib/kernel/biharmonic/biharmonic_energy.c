/* Mixed finite elements for the squared Laplacian: A. Jacobson, E. Tosun, O. Sorkine, D. Zorin,
 * Mixed finite elements for variational surface modeling, Comput. Graph. Forum 29, 2010. The
 * Laplacian has rows for vertices on walls, too. So the derivative across a wall tends to 0 as the
 * mesh becomes finer. */
#include "kernel/biharmonic/biharmonic_energy.h"

#include "base/minmax.h"
#include "base/triangle_corners.h"
#include "mesh/laplacian.h"
#include "mesh/triangulate.h"

static const double *corner_point(const iccp_region_mesh *m, uint32_t corner)
{
    return m->points + 2 * (size_t)m->triangles[corner];
}

static double half_cotangent(const iccp_region_mesh *m, uint32_t corner)
{
    return iccp_half_cotangent(corner_point(m, corner), corner_point(m, iccp_after(corner)),
                               corner_point(m, iccp_before(corner)));
}

/* Returns the weight of the edge that a corner faces. It is limited, because a grid's sample close
 * to a wall makes triangles so thin that the matrix would lose all digits. */
static double edge_weight(const iccp_region_mesh *m, uint32_t corner)
{
    double w = half_cotangent(m, corner);
    if (m->twins[corner] != ICCP_NO_NEIGHBOUR)
        w += half_cotangent(m, m->twins[corner]);
    return iccp_min(iccp_max(w, -ICCP_MOST_WEIGHT), ICCP_MOST_WEIGHT);
}

/* Returns true for one of the two corners that face an edge. */
static bool counts(const iccp_region_mesh *m, uint32_t corner)
{
    return m->twins[corner] == ICCP_NO_NEIGHBOUR || m->twins[corner] > corner;
}

/* Fills in `first` of the Laplacian, so that each row has room for the diagonal, which comes first,
 * and for its edges. */
static void count_entries(const iccp_region_mesh *m, size_t *first)
{
    for (size_t i = 0; i <= m->n; ++i)
        first[i] = i < m->n;
    for (uint32_t c = 0; c < 3 * m->n_triangles; ++c)
        if (counts(m, c)) {
            ++first[m->triangles[iccp_after(c)]];
            ++first[m->triangles[iccp_before(c)]];
        }
    for (size_t i = 0, sum = 0; i <= m->n; ++i) {
        const size_t count = first[i];
        first[i] = sum;
        sum += count;
    }
}

static void add_entry(iccp_sparse *l, size_t *end, uint32_t row, uint32_t column, double weight)
{
    l->column[end[row]] = column;
    l->value[end[row]++] = -weight;
    l->value[l->first[row]] += weight;
}

static void fill(iccp_sparse *l, const iccp_region_mesh *m, size_t *end)
{
    for (uint32_t i = 0; i < m->n; ++i) {
        l->column[l->first[i]] = i;
        l->value[l->first[i]] = 0;
        end[i] = l->first[i] + 1;
    }
    for (uint32_t c = 0; c < 3 * m->n_triangles; ++c) {
        if (!counts(m, c))
            continue;
        const uint32_t a = m->triangles[iccp_after(c)], b = m->triangles[iccp_before(c)];
        const double weight = edge_weight(m, c);
        add_entry(l, end, a, b, weight);
        add_entry(l, end, b, a, weight);
    }
}

/* Computes the inverse of each vertex' share of the area. */
static void invert_areas(const iccp_region_mesh *m, double *inverse)
{
    for (size_t i = 0; i < m->n; ++i)
        inverse[i] = 0;
    for (size_t t = 0; t < m->n_triangles; ++t) {
        const double *p = corner_point(m, (uint32_t)(3 * t)),
                     *q = corner_point(m, (uint32_t)(3 * t + 1)),
                     *r = corner_point(m, (uint32_t)(3 * t + 2));
        const double area = 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
        for (size_t k = 0; k < 3; ++k)
            inverse[m->triangles[3 * t + k]] += iccp_max(area, 0) / 3;
    }
    for (size_t i = 0; i < m->n; ++i)
        inverse[i] = inverse[i] > 0 ? 1 / inverse[i] : 0;
}

icc_status iccp_biharmonic_energy(iccp_gram *energy, const iccp_region_mesh *mesh,
                                  const iccp_env *env)
{
    size_t *end = iccp_alloc(&env->memory, mesh->n + 1, sizeof *end);
    double *inverse = iccp_alloc(&env->memory, mesh->n, sizeof *inverse);
    iccp_sparse l = {.memory = env->memory};
    icc_status status = end != NULL && inverse != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        count_entries(mesh, end);
        status = iccp_sparse_create(&l, mesh->n, mesh->n, end[mesh->n], env);
    }
    if (status == ICC_OK) {
        for (size_t i = 0; i <= mesh->n; ++i)
            l.first[i] = end[i];
        fill(&l, mesh, end);
        invert_areas(mesh, inverse);
        status = iccp_gram_create(energy, &l, env);
    }
    if (status == ICC_OK)
        iccp_gram_fill(energy, &l, inverse);
    iccp_sparse_free(&l);
    iccp_free(&env->memory, end);
    iccp_free(&env->memory, inverse);
    return status;
}
