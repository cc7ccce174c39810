/* Derivatives of curves by their start. Source: the variational equation of x' = A x + b, which
 * is y' = A y; the same power series solves it (flow_step.h). When the curve moves, it meets an
 * end plane sooner or later, which changes the derivative of its end. */
#include "field/flow_jet.h"

#include "base/compiler.h"
#include "math/vec.h"

#include <math.h>

/* Terms of the change of the derivative y up to parameter s. The derivative of the place moves
 * with A y. */
static ICCP_INLINE int32_t expand(const iccp_flow_walk *w, int32_t dim, double s, const double *y,
                                  double change[ICCP_FLOW_TERMS][ICC_MAX_DIM])
{
    static const double NEGLIGIBLE = 1e-17; /* relative to y */
    const double *power = y;
    double most = 0;
    for (int32_t k = 0; k < dim; ++k)
        most += fabs(y[k]);
    for (int32_t j = 0; j < ICCP_FLOW_TERMS; ++j) {
        double size = 0;
        for (int32_t k = 0; k < dim; ++k) {
            double sum = w->radial ? -w->sign * power[k] : 0;
            for (int32_t i = 0; i < dim && !w->radial; ++i)
                sum += power[i] * w->column[i][k];
            change[j][k] = j > 0 ? sum * (s / j) : sum;
            size += fabs(change[j][k]);
        }
        if (w->radial || size * s <= NEGLIGIBLE * most)
            return j + 1;
        power = change[j];
    }
    return ICCP_FLOW_TERMS;
}

/* Nodes of Gauss-Legendre quadrature on [-1, 1]. */
enum { NODES = 7 };
static const double NODE[NODES] = {
    -0.949107912342758524526, -0.741531185599394439864, -0.405845151377397166907, 0,
    0.405845151377397166907,  0.741531185599394439864,  0.949107912342758524526};
static const double WEIGHT[NODES] = {0.129484966168869693271, 0.279705391489276667901,
                                     0.381830050505118944950, 0.417959183673469387755,
                                     0.381830050505118944950, 0.279705391489276667901,
                                     0.129484966168869693271};

/* The length changes by the integral of v . v' / |v|. This computes the integrals of s^j v / |v|
 * for all j < n, up to parameter s and in units of it. */
static ICCP_INLINE void directions(const iccp_flow_walk *w, int32_t dim, double s, int32_t n,
                                   double moment[ICCP_FLOW_TERMS][ICC_MAX_DIM])
{
    enum { PARTS = 2 };
    for (int32_t j = 0; j < n; ++j)
        for (int32_t k = 0; k < dim; ++k)
            moment[j][k] = 0;
    for (int i = 0; i < PARTS * NODES; ++i) {
        const double at = (2 * (i / NODES) + 1 + NODE[i % NODES]) / (2 * PARTS);
        double v[ICC_MAX_DIM];
        iccp_flow_velocity(w, s * at, v);
        double factor = WEIGHT[i % NODES] / (2 * PARTS) / iccp_vec_norm((size_t)dim, v);
        for (int32_t j = 0; j < n; ++j, factor *= at)
            for (int32_t k = 0; k < dim; ++k)
                moment[j][k] += factor * v[k];
    }
}

static ICCP_INLINE void jet_within(const iccp_flow_walk *walk, int32_t dim, double s,
                                   iccp_flow_jet *jet)
{
    double moment[ICCP_FLOW_TERMS][ICC_MAX_DIM];
    double change[ICC_MAX_DIM][ICCP_FLOW_TERMS][ICC_MAX_DIM];
    int32_t n[ICC_MAX_DIM], most = 0;
    for (int32_t c = 0; c < jet->n; ++c) {
        n[c] = expand(walk, dim, s, jet->place[c], change[c]);
        most = n[c] > most ? n[c] : most;
    }
    directions(walk, dim, s, most, moment);
    for (int32_t c = 0; c < jet->n; ++c)
        for (int32_t j = 0; j < n[c]; ++j) {
            jet->length[c] += s * iccp_vec_dot((size_t)dim, change[c][j], moment[j]);
            for (int32_t k = 0; k < dim; ++k)
                jet->place[c][k] += change[c][j][k] * (s / (j + 1));
        }
}

void iccp_flow_jet_within(const iccp_flow_walk *walk, double s, iccp_flow_jet *jet)
{
    const int32_t dim = walk->flow->grid->dim;
    if (dim == 3)
        jet_within(walk, 3, s, jet);
    else
        jet_within(walk, dim, s, jet);
}

void iccp_flow_jet_advance(const iccp_flow_walk *walk, double s, const double *lengths,
                           iccp_flow_jet *jet)
{
    const int32_t dim = walk->flow->grid->dim;
    double v[ICC_MAX_DIM];
    iccp_flow_velocity(walk, s, v);
    const double speed = iccp_vec_norm((size_t)dim, v);
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
    iccp_flow_velocity(walk, s, v);
    const double speed = iccp_vec_norm((size_t)dim, v);
    const double across = iccp_vec_dot((size_t)dim, v, normal);
    if (!(fabs(across) > 0))
        return false;
    for (int32_t c = 0; c < jet->n; ++c)
        lengths[c] = -iccp_vec_dot((size_t)dim, jet->place[c], normal) / across * speed;
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
