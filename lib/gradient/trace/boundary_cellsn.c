/* Finds the cells that a boundary passes through. Facets are cut in half across their longest edge
 * until the box of each piece is no wider than a cell. */
#include "gradient/trace/boundary_cellsn.h"

#include "base/minmax.h"

#include <math.h>
#include <string.h>

/* Facets are also entered into cells that they miss by less than this, in cells. It exceeds the
 * rounding of lattice coordinates by far, and costs almost nothing. So a boundary along the grid is
 * in the cells on both of its sides. */
static const double SLACK = 1e-9;

enum {
    FACETS_PER_REPORT = 1 << 12,
    /* About every dim halvings a piece becomes half as long. Facets are at most 2^14 cells long. */
    MOST_PIECES = 16 * ICC_MAX_DIM
};

typedef struct piece {
    double corner[ICC_MAX_DIM][ICC_MAX_DIM];
} piece;

static void to_lattice(const icc_grid *grid, const double *local, double *lattice)
{
    for (int k = 0; k < grid->dim; ++k)
        lattice[k] = (local[k] - grid->origin[k]) / grid->spacing;
}

static void to_local(const icc_grid *grid, const double *lattice, double *local)
{
    for (int k = 0; k < grid->dim; ++k)
        local[k] = lattice[k] * grid->spacing + grid->origin[k];
}

static bool has(const iccp_boundary_cellsn *cells, uint32_t cell)
{
    return cells->bits[cell / 64] >> (cell % 64) & 1;
}

/* Marks all cells that the box of a piece meets. */
static void mark_box(iccp_boundary_cellsn *cells, const double *lower, const double *upper)
{
    const icc_grid *grid = cells->grid;
    size_t first[ICC_MAX_DIM], last[ICC_MAX_DIM], at[ICC_MAX_DIM], cell = 0;
    for (int k = 0; k < grid->dim; ++k) {
        const double end = (double)grid->shape[k] - 2;
        first[k] = at[k] = (size_t)iccp_max(0, iccp_min(end, floor(lower[k] - SLACK)));
        last[k] = (size_t)iccp_max(0, iccp_min(end, floor(upper[k] + SLACK)));
        cell += at[k] * grid->stride[k];
    }
    for (int k = 0; k < grid->dim;) {
        cells->bits[cell / 64] |= (uint64_t)1 << (cell % 64);
        for (k = 0; k < grid->dim; ++k) {
            cell += grid->stride[k];
            if (++at[k] <= last[k])
                break;
            cell -= (at[k] - first[k]) * grid->stride[k];
            at[k] = first[k];
        }
    }
}

/* Finds the longest edge of a piece, from corner i to corner j. */
static void longest_edge(int dim, const piece *p, int *i, int *j)
{
    double longest = -1;
    for (int a = 0; a < dim; ++a)
        for (int b = a + 1; b < dim; ++b) {
            double square = 0;
            for (int k = 0; k < dim; ++k)
                square += (p->corner[a][k] - p->corner[b][k]) * (p->corner[a][k] - p->corner[b][k]);
            if (square > longest) {
                longest = square;
                *i = a;
                *j = b;
            }
        }
}

/* Computes the bounding box and returns its longest side. */
static double find_box(int dim, const piece *p, double *lower, double *upper)
{
    double longest = 0;
    for (int k = 0; k < dim; ++k) {
        lower[k] = upper[k] = p->corner[0][k];
        for (int i = 1; i < dim; ++i) {
            lower[k] = iccp_min(lower[k], p->corner[i][k]);
            upper[k] = iccp_max(upper[k], p->corner[i][k]);
        }
        longest = iccp_max(longest, upper[k] - lower[k]);
    }
    return longest;
}

/* Halves pieces depth first. If the piece on top of the stack is small enough, its cells are
 * marked. Otherwise it is cut in two, and one half replaces it. So the height of the stack is the
 * number of times a piece was halved. If the stack is full, the box of a piece that is too large is
 * marked, which is safe. */
static void mark_facet(iccp_boundary_cellsn *cells, uint32_t facet)
{
    const int dim = cells->grid->dim;
    piece pieces[MOST_PIECES];
    int n = 1;
    for (int i = 0; i < dim; ++i) {
        const uint32_t v = cells->domain->facets[(size_t)dim * facet + (size_t)i];
        to_lattice(cells->grid, cells->domain->vertices + (size_t)dim * v, pieces[0].corner[i]);
    }
    while (n > 0) {
        piece *p = &pieces[n - 1], *q = p + 1;
        double lower[ICC_MAX_DIM], upper[ICC_MAX_DIM];
        if (find_box(dim, p, lower, upper) <= 1 || n == MOST_PIECES) {
            mark_box(cells, lower, upper);
            --n;
            continue;
        }
        int i = 0, j = 0;
        longest_edge(dim, p, &i, &j);
        *q = *p;
        for (int k = 0; k < dim; ++k)
            p->corner[i][k] = q->corner[j][k] = 0.5 * (p->corner[i][k] + p->corner[j][k]);
        ++n;
    }
}

icc_status iccp_boundary_cellsn_create(iccp_boundary_cellsn *cells, const icc_domain *domain,
                                       const icc_grid *grid, const iccp_env *env)
{
    *cells = (iccp_boundary_cellsn){.memory = env->memory, .domain = domain, .grid = grid};
    cells->bits = iccp_alloc_zero(&env->memory, grid->n_vertices / 64 + 1, sizeof *cells->bits);
    if (cells->bits == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_OK;
    for (size_t f = 0; status == ICC_OK && f < domain->n_facets; ++f) {
        if (f % FACETS_PER_REPORT == 0)
            status = iccp_progress(env, "grid", (double)f / (double)domain->n_facets);
        mark_facet(cells, (uint32_t)f);
    }
    return status;
}

void iccp_boundary_cellsn_free(iccp_boundary_cellsn *cells)
{
    iccp_free(&cells->memory, cells->bits);
    cells->bits = NULL;
}

bool iccp_boundary_cellsn_cross(const iccp_boundary_cellsn *cells, uint32_t cell,
                                const double *from, const double *to, iccp_boundary_hitn *hit)
{
    double ends[2][ICC_MAX_DIM];
    if (!has(cells, cell))
        return false;
    to_local(cells->grid, from, ends[0]);
    to_local(cells->grid, to, ends[1]);
    if (!iccp_domain_cross(cells->domain, ends[0], ends[1], &hit->share, &hit->facet, hit->bary))
        return false;
    for (int k = 0; k < cells->grid->dim; ++k)
        hit->point[k] = from[k] + hit->share * (to[k] - from[k]);
    return true;
}

bool iccp_boundary_cellsn_touch(const iccp_boundary_cellsn *cells, const double *point,
                                iccp_boundary_hitn *hit)
{
    double local[ICC_MAX_DIM];
    to_local(cells->grid, point, local);
    hit->share = 1;
    memcpy(hit->point, point, (size_t)cells->grid->dim * sizeof *point);
    return iccp_domain_locate(cells->domain, local, true, &hit->facet, hit->bary) == ICC_BOUNDARY;
}

/* Computes the determinant by elimination, and overwrites the matrix. */
static double determinant(int n, double a[ICC_MAX_DIM][ICC_MAX_DIM])
{
    double det = 1;
    for (int c = 0; c < n; ++c) {
        int pivot = c;
        for (int r = c + 1; r < n; ++r)
            pivot = fabs(a[r][c]) > fabs(a[pivot][c]) ? r : pivot;
        if (!(fabs(a[pivot][c]) > 0))
            return 0;
        for (int k = c; k < n; ++k) {
            const double swap = a[c][k];
            a[c][k] = pivot != c ? -a[pivot][k] : swap;
            a[pivot][k] = pivot != c ? swap : a[pivot][k];
        }
        det *= a[c][c];
        for (int r = c + 1; r < n; ++r)
            for (int k = n; k-- > c;)
                a[r][k] -= a[r][c] / a[c][c] * a[c][k];
    }
    return det;
}

/* The determinant of a vector that leads out of the domain and the facet's edges has the sign of
 * the orientation. So component k of the outward normal is the cofactor of that vector's component
 * k. */
void iccp_facet_inward(const icc_domain *domain, uint32_t facet, double *inward)
{
    const int dim = domain->dim;
    const double *corners[ICC_MAX_DIM];
    iccp_facet_corners(&domain->tree, facet, corners);
    for (int k = 0; k < dim; ++k) {
        double minor[ICC_MAX_DIM][ICC_MAX_DIM];
        for (int i = 0; i + 1 < dim; ++i)
            for (int j = 0; j + 1 < dim; ++j) {
                const int axis = j < k ? j : j + 1;
                minor[i][j] = corners[i + 1][axis] - corners[0][axis];
            }
        inward[k] = (k % 2 == 0 ? -1 : 1) * domain->orientation * determinant(dim - 1, minor);
    }
}
