/* The mixed Hessian energy: O. Stein, A. Jacobson, M. Wardetzky, E. Grinspun, A smoothness energy
 * without boundary distortion for curved surfaces, ACM Trans. Graph. 39, 2020, here in the plane.
 * Integration by parts gives the second derivatives around each inner vertex i from the gradients
 * of its triangles f: H_i = -(1 / M_i) sum_f A_f grad(phi_i) grad(u)_f'. M_i is a third of the area
 * around i. The energy is the sum of M_i |H_i|^2. Vertices of the boundary have none, which leaves
 * the boundary free. */
#include "fit/spline/bending.h"

#include "base/sort.h"
#include "base/triangle_corners.h"
#include "mesh/triangulate.h"

#include <string.h>

/* Second derivatives of a function: xx, xy, yx, yy. The mixed ones differ on a mesh. */
enum { PARTS = 4 };

typedef struct builder {
    const iccp_bending_mesh *mesh;
    const iccp_memory *memory;
    double *gradient;  /* 6 n_triangles: of the hat function of each corner */
    double *area;      /* n_triangles: twice the area */
    uint32_t *around;  /* triangles at each vertex, one vertex after the other */
    uint32_t *first;   /* n_vertices + 1: where they begin */
    bool *is_boundary; /* n_vertices */
    uint32_t *at;      /* n_vertices: see add_row() */
    double *inverse;   /* n_vertices: 1 / M_i */
    double *part;      /* PARTS for each entry of `rows` */
    iccp_sparse rows;  /* row i: the vertices that H_i depends on */
} builder;

/* Computes the gradients of a triangle's hat functions in the metric. */
static void find_gradients(const builder *b, size_t t)
{
    const double *m = b->mesh->metric;
    double p[3][2];
    for (int k = 0; k < 3; ++k) {
        const double *v = b->mesh->points + 2 * (size_t)b->mesh->triangles[3 * t + (size_t)k];
        p[k][0] = m[0] * v[0] + m[1] * v[1];
        p[k][1] = m[2] * v[0] + m[3] * v[1];
    }
    const double area =
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    b->area[t] = area;
    for (int k = 0; k < 3; ++k) {
        const double *from = p[(k + 1) % 3], *to = p[(k + 2) % 3];
        b->gradient[6 * t + 2 * (size_t)k] = (from[1] - to[1]) / area;
        b->gradient[6 * t + 2 * (size_t)k + 1] = (to[0] - from[0]) / area;
    }
}

static icc_status prepare(builder *b)
{
    const iccp_bending_mesh *m = b->mesh;
    b->gradient = iccp_alloc(b->memory, m->n_triangles, 6 * sizeof *b->gradient);
    b->area = iccp_alloc(b->memory, m->n_triangles, sizeof *b->area);
    b->around = iccp_alloc(b->memory, m->n_triangles, 3 * sizeof *b->around);
    b->first = iccp_alloc_zero(b->memory, m->n_vertices + 1, sizeof *b->first);
    b->is_boundary = iccp_alloc_zero(b->memory, m->n_vertices, sizeof *b->is_boundary);
    b->at = iccp_alloc(b->memory, m->n_vertices, sizeof *b->at);
    b->inverse = iccp_alloc(b->memory, m->n_vertices, sizeof *b->inverse);
    if (b->gradient == NULL || b->area == NULL || b->around == NULL || b->first == NULL ||
        b->is_boundary == NULL || b->at == NULL || b->inverse == NULL)
        return ICC_ERR_MEMORY;
    for (size_t t = 0; t < m->n_triangles; ++t)
        find_gradients(b, t);
    iccp_list_groups(b->around, b->first, m->n_vertices, m->triangles, m->n_triangles, 3);
    for (uint32_t c = 0; c < 3 * m->n_triangles; ++c)
        if (m->twins[c] == ICCP_NO_NEIGHBOUR) {
            b->is_boundary[m->triangles[iccp_after(c)]] = true;
            b->is_boundary[m->triangles[iccp_before(c)]] = true;
        }
    memset(b->at, 0xff, m->n_vertices * sizeof *b->at);
    return ICC_OK;
}

/* An inner vertex has as many neighbours as triangles. */
static icc_status make_room(builder *b, const iccp_env *env)
{
    const size_t n = b->mesh->n_vertices;
    size_t count = 0;
    for (size_t i = 0; i < n; ++i)
        if (!b->is_boundary[i])
            count += 1 + b->first[i + 1] - b->first[i];
    const icc_status status = iccp_sparse_create(&b->rows, n, n, count, env);
    if (status != ICC_OK)
        return status;
    b->part = iccp_alloc_zero(b->memory, count, PARTS * sizeof *b->part);
    return b->part != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Adds the derivatives at vertex i from one of its triangles. at[v] is the entry of vertex v in the
 * row, if it lies in the row. */
static void add_triangle(builder *b, uint32_t i, uint32_t t, size_t begin, size_t *end)
{
    const uint32_t *v = b->mesh->triangles + 3 * (size_t)t;
    const double *g = b->gradient + 6 * (size_t)t;
    const double *own = g + (v[0] == i ? 0 : v[1] == i ? 2 : 4), area = 0.5 * b->area[t];
    for (size_t k = 0; k < 3; ++k) {
        uint32_t e = b->at[v[k]];
        if (e < begin || e >= *end) {
            e = b->at[v[k]] = (uint32_t)(*end)++;
            b->rows.column[e] = v[k];
        }
        double *part = b->part + PARTS * (size_t)e;
        for (size_t c = 0; c < PARTS; ++c)
            part[c] -= area * own[c / 2] * g[2 * k + c % 2];
    }
}

/* The values of the rows are the numbers of their entries, so that each column of the Gram matrix
 * finds its own parts. */
static void fill_rows(builder *b)
{
    size_t end = 0;
    b->rows.first[0] = 0;
    for (uint32_t i = 0; i < b->mesh->n_vertices; ++i) {
        const size_t begin = end;
        double area = 0;
        for (uint32_t k = b->first[i]; !b->is_boundary[i] && k < b->first[i + 1]; ++k) {
            add_triangle(b, i, b->around[k], begin, &end);
            area += b->area[b->around[k]] / 6;
        }
        b->inverse[i] = area > 0 ? 1 / area : 0;
        for (size_t e = begin; e < end; ++e)
            b->rows.value[e] = (double)e;
        b->rows.first[i + 1] = end;
    }
}

static double product(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/* Like iccp_gram_fill(), with PARTS numbers for each entry. */
static void fill_energy(iccp_gram *energy, const builder *b)
{
    double *sum = energy->sum; /* zero between rows */
    for (size_t j = 0; j < b->mesh->n_vertices; ++j) {
        for (size_t q = energy->row_first[j]; q < energy->row_first[j + 1]; ++q) {
            const size_t i = energy->row[q];
            const double *own = b->part + PARTS * (size_t)energy->row_value[q];
            for (size_t p = b->rows.first[i]; p < b->rows.first[i + 1]; ++p)
                sum[b->rows.column[p]] += b->inverse[i] * product(own, b->part + PARTS * p);
        }
        energy->diagonal[j] = sum[j];
        sum[j] = 0;
        for (size_t p = energy->first[j]; p < energy->first[j + 1]; ++p) {
            energy->value[p] = sum[energy->column[p]];
            sum[energy->column[p]] = 0;
        }
    }
}

static void free_builder(builder *b)
{
    iccp_free(b->memory, b->gradient);
    iccp_free(b->memory, b->area);
    iccp_free(b->memory, b->around);
    iccp_free(b->memory, b->first);
    iccp_free(b->memory, b->is_boundary);
    iccp_free(b->memory, b->at);
    iccp_free(b->memory, b->inverse);
    iccp_free(b->memory, b->part);
    iccp_sparse_free(&b->rows);
}

icc_status iccp_bending_energy(iccp_gram *energy, const iccp_bending_mesh *mesh,
                               const iccp_env *env)
{
    builder b = {.mesh = mesh, .memory = &env->memory, .rows = {.memory = env->memory}};
    *energy = (iccp_gram){.memory = env->memory};
    icc_status status = prepare(&b);
    if (status == ICC_OK)
        status = make_room(&b, env);
    if (status == ICC_OK) {
        fill_rows(&b);
        status = iccp_gram_create(energy, &b.rows, env);
    }
    if (status == ICC_OK)
        fill_energy(energy, &b);
    free_builder(&b);
    return status;
}
