/* Triangular solves with a supernodal factor (see ldlt_factorise.c), strip by strip: what a strip of
 * rows needs of the columns before its own is one product, then come the few entries beside the
 * diagonal. */
#include "math/ldlt.h"
#include "math/panel.h"

#include <string.h>

#define STRIP ((size_t)ICCP_STRIP)

/* Side r of the right side within the work space: entry i at value[i * step]. */
typedef struct side {
    double *value;
    size_t step;
} side;

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Entry i of a panel's rows. */
static double *entry(const side *x, const iccp_panel *p, uint32_t first, const uint32_t *below,
                     size_t i)
{
    return x->value + (i < p->columns ? first + i : below[i - p->columns]) * x->step;
}

static void forward(const side *x, const iccp_panel *p, uint32_t first, const uint32_t *below)
{
    const double *own = x->value + first * x->step, *strip = p->value;
    for (size_t i = 0; i < p->rows; i += STRIP, strip += STRIP * p->columns) {
        const size_t depth = least(i, p->columns);
        double sum[ICCP_STRIP] = {0};
        for (size_t k = 0; k < depth; ++k)
            for (size_t r = 0; r < STRIP; ++r)
                sum[r] += strip[STRIP * k + r] * own[k * x->step];
        for (size_t r = 0; r < least(STRIP, p->rows - i); ++r) {
            for (size_t k = depth; k < least(i + r, p->columns); ++k)
                sum[r] += strip[STRIP * k + r] * own[k * x->step];
            *entry(x, p, first, below, i + r) -= sum[r];
        }
    }
}

static void backward(const side *x, const iccp_panel *p, uint32_t first, const uint32_t *below)
{
    double *own = x->value + first * x->step;
    for (size_t k = 0; k < p->columns; ++k)
        own[k * x->step] /= p->pivot[k];
    for (size_t i = (p->rows + STRIP - 1) / STRIP * STRIP; i > 0;) {
        i -= STRIP;
        const double *strip = p->value + i * p->columns;
        const size_t depth = least(i, p->columns);
        double y[ICCP_STRIP] = {0};
        for (size_t r = least(STRIP, p->rows - i); r-- > 0;) {
            y[r] = *entry(x, p, first, below, i + r);
            for (size_t k = depth; k < least(i + r, p->columns); ++k)
                own[k * x->step] -= strip[STRIP * k + r] * y[r];
        }
        for (size_t k = 0; k < depth; ++k, strip += STRIP)
            own[k * x->step] -= (strip[0] * y[0] + strip[1] * y[1]) +
                                (strip[2] * y[2] + strip[3] * y[3]);
    }
}

void iccp_ldlt_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work)
{
    const iccp_supernodes *nodes = &factor->nodes;
    const size_t n = factor->n;
    for (size_t k = 0; k < n; ++k)
        memcpy(work + k * n_rhs, b + factor->order[k] * n_rhs, n_rhs * sizeof *work);
    for (size_t s = 0; s < nodes->n; ++s) {
        const iccp_panel panel = iccp_panel_of(nodes, s, factor->value, factor->pivot);
        for (size_t r = 0; r < n_rhs; ++r)
            forward(&(side){work + r, n_rhs}, &panel, nodes->column[s],
                    nodes->row + nodes->first_row[s]);
    }
    for (size_t s = nodes->n; s-- > 0;) {
        const iccp_panel panel = iccp_panel_of(nodes, s, factor->value, factor->pivot);
        for (size_t r = 0; r < n_rhs; ++r)
            backward(&(side){work + r, n_rhs}, &panel, nodes->column[s],
                     nodes->row + nodes->first_row[s]);
    }
    for (size_t k = 0; k < n; ++k)
        memcpy(b + factor->order[k] * n_rhs, work + k * n_rhs, n_rhs * sizeof *work);
}
