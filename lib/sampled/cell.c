/* Bounds of a cell's coefficients in plain arithmetic. */
#include "sampled/cell.h"

#include "base/minmax.h"

#include <float.h>
#include <math.h>

/* Magnitudes of a cell for which bounds hold without a look at single products. */
#define LARGEST 0x1p200
#define SMALLEST 0x1p-200
/* More than the underflow of the 64 determinants of factors below LARGEST: 2^-1074 * 2^200, and
 * 2^14 for their number. */
#define UNDERFLOW 0x1p-860
/* Errors in units of the unit roundoff times the size: each edge is off by 3, the products by 5,
 * the sum of 8 determinants by 8, and the size itself by as much. Together they are below 32. */
#define ROUNDINGS 32

typedef struct edge {
    double v[3], size[3];
} edge;

double iccp_cell_weight(const iccp_cell *cell, size_t coefficient)
{
    double weight = 1;
    for (size_t k = 0; k < 3 && cell->degree == 2; ++k, coefficient /= 3)
        weight *= coefficient % 3 == 1 ? 0.5 : 1;
    return weight;
}

static void set_edge(iccp_cell *cell, const icc_field *field, size_t axis, size_t e,
                     const double from[3], const double to[3])
{
    const size_t dim = (size_t)field->dim;
    for (size_t k = 0; k < dim; ++k) {
        double *term = cell->term[axis][e][k];
        term[0] = to[k];
        term[1] = -from[k];
        term[2] = field->displacement ? field->step[dim * axis + k] : 0;
    }
}

/* Puts a zero bit at position `axis`: the first corner of an edge along it. */
static size_t first_corner(size_t axis, size_t e)
{
    const size_t low = e & (((size_t)1 << axis) - 1);
    return (e - low) * 2 + low;
}

bool iccp_cell_read(iccp_cell *cell, const icc_field *field, const size_t *i, int sign)
{
    const size_t dim = (size_t)field->dim;
    double value[8][3] = {{0}};
    bool finite = true;
    memset(cell, 0, sizeof *cell);
    cell->sign = sign;
    cell->degree = dim - 1;
    cell->n = dim == 2 ? 4 : ICCP_CELL_MOST;
    cell->n_corners = (size_t)1 << dim;
    for (size_t corner = 0; corner < cell->n_corners; ++corner) {
        size_t at[3] = {0};
        for (size_t k = 0; k < dim; ++k)
            at[k] = i[k] + (corner >> k & 1);
        iccp_sample_read(field, iccp_sample_at(field, at), value[corner]);
        for (size_t k = 0; k < dim; ++k)
            finite = finite && isfinite(value[corner][k]);
    }
    for (size_t axis = 0; axis < dim; ++axis) {
        cell->n_edges[axis] = cell->n_corners / 2;
        for (size_t e = 0; e < cell->n_edges[axis]; ++e) {
            const size_t from = first_corner(axis, e);
            set_edge(cell, field, axis, e, value[from], value[from + ((size_t)1 << axis)]);
        }
    }
    if (dim == 2) {
        cell->n_edges[2] = 1;
        cell->term[2][0][2][0] = 1;
    }
    return finite;
}

bool iccp_cell_read_grid(iccp_cell *cell, const icc_field *field)
{
    const size_t dim = (size_t)field->dim;
    bool finite = true;
    memset(cell, 0, sizeof *cell);
    cell->sign = 1;
    cell->n = cell->n_corners = cell->degree = 1;
    cell->term[2][0][2][0] = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
        cell->n_edges[axis] = 1;
        for (size_t k = 0; k < dim && axis < dim; ++k) {
            cell->term[axis][0][k][0] = field->step[dim * axis + k];
            finite = finite && isfinite(field->step[dim * axis + k]);
        }
    }
    return finite;
}

/* Rounds an edge. Its size bounds what rounding errors are relative to. */
static void round_edge(edge *out, double term[3][ICCP_CELL_TERMS], double *largest)
{
    for (size_t k = 0; k < 3; ++k) {
        const double difference = term[k][0] + term[k][1];
        out->v[k] = term[k][2] + difference;
        out->size[k] = fabs(term[k][2]) + fabs(difference);
        *largest = iccp_max(*largest, out->size[k]);
    }
}

/* Adds the determinants of two edges with all edges of the third axis. */
static void add_determinants(iccp_cell_bounds *out, const iccp_cell *cell, edge e[3][4], size_t a,
                             size_t b)
{
    const edge *p = &e[0][a], *q = &e[1][b];
    double cross[3], size[3];
    for (size_t k = 0; k < 3; ++k) {
        const size_t l = (k + 1) % 3, m = (k + 2) % 3;
        cross[k] = p->v[l] * q->v[m] - p->v[m] * q->v[l];
        size[k] = p->size[l] * q->size[m] + p->size[m] * q->size[l];
    }
    for (size_t c = 0; c < cell->n_edges[2]; ++c) {
        const edge *r = &e[2][c];
        const size_t to = iccp_cell_coefficient(cell, a, b, c);
        out->lower[to] += cross[0] * r->v[0] + cross[1] * r->v[1] + cross[2] * r->v[2];
        out->upper[to] += size[0] * r->size[0] + size[1] * r->size[1] + size[2] * r->size[2];
    }
}

bool iccp_cell_bound(iccp_cell_bounds *out, const iccp_cell *cell)
{
    iccp_cell copy = *cell;
    edge e[3][4];
    double largest = 0;
    memset(out, 0, sizeof *out);
    for (size_t axis = 0; axis < 3; ++axis)
        for (size_t i = 0; i < cell->n_edges[axis]; ++i)
            round_edge(&e[axis][i], copy.term[axis][i], &largest);
    if (!(largest < LARGEST) || (largest < SMALLEST && largest > 0))
        return false;
    for (size_t a = 0; a < cell->n_edges[0]; ++a)
        for (size_t b = 0; b < cell->n_edges[1]; ++b)
            add_determinants(out, cell, e, a, b);
    for (size_t i = 0; i < cell->n; ++i) {
        const double weight = iccp_cell_weight(cell, i);
        const double value = cell->sign * weight * out->lower[i];
        const double off = ROUNDINGS * DBL_EPSILON / 2 * weight * out->upper[i] + UNDERFLOW;
        out->lower[i] = value - off;
        out->upper[i] = value + off;
    }
    return true;
}
