/* Kernels and their matrix. Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), sections 3.1
 * and 6.1; H. Wendland, Piecewise polynomial, positive definite and compactly supported radial
 * functions of minimal degree, 1995: the function of smoothness C2 for dimensions up to 3. */
#include "kernel/weights/kernel_matrix.h"

#include "base/error.h"
#include "base/threads.h"

#include <math.h>

/* In sigma: with this radius, Wendland's function is about as wide as the Gaussian. */
static const double WENDLAND_REACH = 3;
/* Limits of the matrix: entries, 12 bytes each, and entries per node, of which the default kernel
 * has 26 in 2-D. The larger limit applies. */
static const size_t MOST_ENTRIES = (size_t)1 << 27, MOST_NEAR = 256;

iccp_radial iccp_radial_make(int32_t kind, double sigma, double cutoff)
{
    return (iccp_radial){kind, sigma, sigma * (kind == ICC_KERNEL_GAUSS ? cutoff : WENDLAND_REACH)};
}

typedef struct assembly {
    const iccp_cells *cells;
    const iccp_radial *radial;
    iccp_kernel_matrix *out;
    bool count_only;
} assembly;

/* Counts the entries of row i from one run of points, and writes them from `at` on. */
static size_t scan_run(const assembly *a, size_t i, size_t begin, size_t end, size_t at)
{
    const size_t dim = a->cells->dim;
    const double *points = a->cells->points, *x = points + dim * i;
    size_t n = 0;
    for (size_t p = begin; p < end; ++p) {
        const uint32_t j = a->cells->order[p];
        double distance2 = 0;
        for (size_t k = 0; k < dim; ++k)
            distance2 += (x[k] - points[dim * j + k]) * (x[k] - points[dim * j + k]);
        if (j == i || !(distance2 < a->radial->reach * a->radial->reach))
            continue;
        if (!a->count_only) {
            a->out->column[at + n] = j;
            a->out->value[at + n] = iccp_radial_value(a->radial, distance2);
        }
        ++n;
    }
    return n;
}

/* Counts the entries of row i, and writes them from `at` on unless only counting. Consecutive cells
 * along the first axis are one run of points. */
static size_t scan_row(const assembly *a, size_t i, size_t at)
{
    const iccp_cells *cells = a->cells;
    const size_t *shape = cells->shape;
    iccp_cell_box box;
    size_t n = 0;
    (void)iccp_cells_box(cells, cells->points + cells->dim * i, a->radial->reach, &box);
    for (size_t z = box.from[2]; z <= box.to[2]; ++z)
        for (size_t y = box.from[1]; y <= box.to[1]; ++y) {
            const uint32_t *run = cells->first + shape[0] * (y + shape[1] * z);
            n += scan_run(a, i, run[box.from[0]], run[box.to[0] + 1], at + n);
        }
    return n;
}

static icc_status count_rows(void *argument, size_t begin, size_t end)
{
    const assembly *a = argument;
    for (size_t i = begin; i < end; ++i)
        a->out->first[i + 1] = scan_row(a, i, 0);
    return ICC_OK;
}

static icc_status fill_rows(void *argument, size_t begin, size_t end)
{
    const assembly *a = argument;
    for (size_t i = begin; i < end; ++i) {
        (void)scan_row(a, i, a->out->first[i]);
        a->out->diagonal[i] = 1;
    }
    return ICC_OK;
}

/* Makes two passes over the cells. The first counts the entries of each row, which determines where
 * rows begin. It refuses too many entries before memory is allocated. The second writes the
 * entries. */
static icc_status fill(assembly *a, const iccp_env *env, icc_error *err)
{
    iccp_kernel_matrix *out = a->out;
    const size_t n = a->cells->n;
    icc_status status = iccp_for_chunks(env, "weights", n, ICCP_NODES_A_TASK, count_rows, a);
    out->first[0] = 0;
    for (size_t i = 0; status == ICC_OK && i < n; ++i)
        out->first[i + 1] += out->first[i];
    if (status == ICC_OK && out->first[n] > MOST_ENTRIES && out->first[n] / n > MOST_NEAR)
        return iccp_fail(err, ICC_ERR_SOLVER,
                         "sigma is too large: within its reach each of %zu nodes has %zu others", n,
                         out->first[n] / n);
    if (status != ICC_OK)
        return status;
    out->column = iccp_alloc(&out->memory, out->first[n], sizeof *out->column);
    out->value = iccp_alloc(&out->memory, out->first[n], sizeof *out->value);
    if (out->column == NULL || out->value == NULL)
        return ICC_ERR_MEMORY;
    a->count_only = false;
    return iccp_for_chunks(env, "weights", n, ICCP_NODES_A_TASK, fill_rows, a);
}

icc_status iccp_kernel_matrix_create(iccp_kernel_matrix *out, const iccp_cells *cells,
                                     const iccp_radial *radial, const iccp_env *env, icc_error *err)
{
    const size_t n = cells->n;
    *out = (iccp_kernel_matrix){.memory = env->memory};
    out->first = iccp_alloc(&out->memory, n + 1, sizeof *out->first);
    out->diagonal = iccp_alloc(&out->memory, n, sizeof *out->diagonal);
    assembly a = {cells, radial, out, true};
    icc_status status = out->first != NULL && out->diagonal != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = fill(&a, env, err);
    if (status != ICC_OK)
        iccp_kernel_matrix_free(out);
    else
        out->matrix = (iccp_symmetric){n, out->first, out->column, out->value, out->diagonal};
    return status;
}

void iccp_kernel_matrix_free(iccp_kernel_matrix *matrix)
{
    iccp_free(&matrix->memory, matrix->first);
    iccp_free(&matrix->memory, matrix->column);
    iccp_free(&matrix->memory, matrix->value);
    iccp_free(&matrix->memory, matrix->diagonal);
    *matrix = (iccp_kernel_matrix){.memory = matrix->memory};
}
