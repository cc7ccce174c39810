/* The variational equation of x' = A x + b is y' = A y, solved by the same power series. Where a curve ends
 * on a plane, it does so sooner or later as it moves. */
#include "trace/flow_jet.h"

#include <math.h>

/* The place moves with the speed A y. */
static void linear_part(const iccp_flow_walk *w, double a[ICC_MAX_DIM][ICC_MAX_DIM])
{
    const int32_t dim = w->flow->grid->dim;
    const int8_t *axis = w->place.simplex.axis;
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k) {
            if (w->n_terms > 2)
                a[axis[i]][k] = w->corner[i + 1][k] - w->corner[i][k];
            else
                a[i][k] = i == k ? -w->sign : 0;
        }
}

/* Of n terms, ICC_MAX_DIM numbers each. */
static void polynomial(const iccp_flow_walk *w, int32_t n, const double *terms, double s,
                       double *value)
{
    const int32_t dim = w->flow->grid->dim;
    for (int32_t k = 0; k < dim; ++k)
        value[k] = terms[(n - 1) * ICC_MAX_DIM + k];
    for (int32_t j = n - 1; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            value[k] = value[k] * s + terms[j * ICC_MAX_DIM + k];
}

static double product(int32_t dim, const double *a, const double *b)
{
    double sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        sum += a[k] * b[k];
    return sum;
}

/* The derivative of the length: the integral of v . v' / |v|. */
static double lengthen(const iccp_flow_walk *w, double s, const double *change)
{
    enum { PARTS = 2, NODES = 7 };
    static const double node[NODES] = {-0.949107912342758524526, -0.741531185599394439864,
                                       -0.405845151377397166907, 0,
                                       0.405845151377397166907,  0.741531185599394439864,
                                       0.949107912342758524526};
    static const double weight[NODES] = {0.129484966168869693271, 0.279705391489276667901,
                                         0.381830050505118944950, 0.417959183673469387755,
                                         0.381830050505118944950, 0.279705391489276667901,
                                         0.129484966168869693271};
    const int32_t dim = w->flow->grid->dim, n = w->n_terms - 1;
    double sum = 0, v[ICC_MAX_DIM], dv[ICC_MAX_DIM];
    for (int p = 0; p < PARTS; ++p)
        for (int i = 0; i < NODES; ++i) {
            const double at = s * (2 * p + 1 + node[i]) / (2 * PARTS);
            polynomial(w, n, w->speed[0], at, v);
            polynomial(w, n, change, at, dv);
            const double speed = sqrt(product(dim, v, v));
            sum += speed > 0 ? weight[i] * product(dim, v, dv) / speed : 0;
        }
    return sum * s / (2 * PARTS);
}

void iccp_flow_jet_within(const iccp_flow_walk *walk, double s, iccp_flow_jet *jet)
{
    const int32_t dim = walk->flow->grid->dim;
    double a[ICC_MAX_DIM][ICC_MAX_DIM];
    linear_part(walk, a);
    for (int32_t c = 0; c < jet->n; ++c) {
        double term[ICCP_FLOW_TERMS + 1][ICC_MAX_DIM], change[ICCP_FLOW_TERMS + 1][ICC_MAX_DIM];
        for (int32_t k = 0; k < dim; ++k)
            term[0][k] = jet->place[c][k];
        for (int32_t j = 0; j + 1 < walk->n_terms; ++j)
            for (int32_t k = 0; k < dim; ++k) {
                change[j][k] = 0;
                for (int32_t i = 0; i < dim; ++i)
                    change[j][k] += term[j][i] * a[i][k];
                term[j + 1][k] = change[j][k] / (j + 1);
            }
        jet->length[c] += lengthen(walk, s, change[0]);
        polynomial(walk, walk->n_terms, term[0], s, jet->place[c]);
    }
}

void iccp_flow_jet_advance(const iccp_flow_walk *walk, double s, const double *lengths,
                           iccp_flow_jet *jet)
{
    const int32_t dim = walk->flow->grid->dim;
    double v[ICC_MAX_DIM];
    polynomial(walk, walk->n_terms - 1, walk->speed[0], s, v);
    const double speed = sqrt(product(dim, v, v));
    for (int32_t c = 0; c < jet->n; ++c) {
        for (int32_t k = 0; k < dim; ++k)
            jet->place[c][k] += v[k] / speed * lengths[c];
        jet->length[c] += lengths[c];
    }
}

bool iccp_flow_jet_onto(const iccp_flow_walk *walk, double s, const double *normal,
                        iccp_flow_jet *jet)
{
    const int32_t dim = walk->flow->grid->dim;
    double v[ICC_MAX_DIM], lengths[ICC_MAX_DIM];
    polynomial(walk, walk->n_terms - 1, walk->speed[0], s, v);
    const double speed = sqrt(product(dim, v, v)), across = product(dim, v, normal);
    if (!(fabs(across) > 0))
        return false;
    for (int32_t c = 0; c < jet->n; ++c)
        lengths[c] = -product(dim, jet->place[c], normal) / across * speed;
    iccp_flow_jet_advance(walk, s, lengths, jet);
    return true;
}

bool iccp_flow_jet_pass(const iccp_flow_walk *walk, iccp_flow_jet *jet)
{
    const int8_t *axis = walk->place.simplex.axis;
    const int32_t dim = walk->flow->grid->dim, i = walk->exit;
    double normal[ICC_MAX_DIM] = {0};
    iccp_flow_jet_within(walk, walk->end, jet);
    if (i == ICCP_FLOW_WITHIN)
        return true;
    if (i > 0)
        normal[axis[i - 1]] = 1;
    if (i < dim)
        normal[axis[i]] = -1;
    return iccp_flow_jet_onto(walk, walk->end, normal, jet);
}
