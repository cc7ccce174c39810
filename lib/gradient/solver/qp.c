/* The quadratic program of constrained bi-Laplace functions. */
#include "gradient/solver/qp.h"

#include "base/minmax.h"

#include <math.h>

static icc_status find_leaves(iccp_qp *p, const iccp_env *env)
{
    const iccp_unknowns *unknowns = p->unknowns;
    uint8_t *has_child = iccp_alloc_zero(&env->memory, unknowns->n, sizeof *has_child);
    if (has_child == NULL)
        return ICC_ERR_MEMORY;
    p->n_leaves = unknowns->n - 1;
    for (size_t k = 1; k < unknowns->n; ++k)
        if (!has_child[unknowns->parent[k]]) {
            has_child[unknowns->parent[k]] = 1;
            p->n_leaves -= unknowns->parent[k] != 0;
        }
    p->leaf_unknown = iccp_alloc(&env->memory, p->n_leaves, sizeof *p->leaf_unknown);
    size_t j = 0;
    for (uint32_t k = 1; p->leaf_unknown != NULL && k < unknowns->n; ++k)
        if (!has_child[k])
            p->leaf_unknown[j++] = k;
    iccp_free(&env->memory, has_child);
    return p->leaf_unknown != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_qp_create(iccp_qp *qp, const iccp_unknowns *unknowns, int32_t function, double eta,
                          double leaf, const iccp_env *env)
{
    *qp = (iccp_qp){.unknowns = unknowns, .sigma = 1 + eta, .leaf = leaf};
    icc_status status = iccp_energy_create(&qp->a, unknowns, function, env);
    if (status == ICC_OK)
        status = find_leaves(qp, env);
    if (status != ICC_OK)
        iccp_qp_free(qp);
    return status;
}

void iccp_qp_free(iccp_qp *qp)
{
    iccp_free(&qp->a.memory, qp->leaf_unknown);
    qp->leaf_unknown = NULL;
    iccp_sparse_free(&qp->a);
}

double iccp_qp_least_root(const iccp_qp *qp, double *work)
{
    const iccp_unknowns *unknowns = qp->unknowns;
    for (size_t k = 0; k < unknowns->n; ++k)
        work[k] = qp->leaf;
    for (size_t k = unknowns->n; k-- > 1;)
        work[unknowns->parent[k]] = iccp_max(work[unknowns->parent[k]], qp->sigma * work[k]);
    return work[0];
}

void iccp_qp_slacks(const iccp_qp *qp, const double *f, bool is_direction, double *slack)
{
    const iccp_unknowns *unknowns = qp->unknowns;
    const double bound = is_direction ? 0.0 : qp->leaf;
    for (size_t k = 1; k < unknowns->n; ++k)
        slack[k - 1] = f[unknowns->parent[k]] - qp->sigma * f[k];
    for (size_t j = 0; j < qp->n_leaves; ++j)
        slack[unknowns->n - 1 + j] = f[qp->leaf_unknown[j]] - bound;
}

void iccp_qp_add_forces(const iccp_qp *qp, const double *y, double *out)
{
    const iccp_unknowns *unknowns = qp->unknowns;
    for (size_t k = 1; k < unknowns->n; ++k) {
        out[unknowns->parent[k]] += y[k - 1];
        out[k] -= qp->sigma * y[k - 1];
    }
    for (size_t j = 0; j < qp->n_leaves; ++j)
        out[qp->leaf_unknown[j]] += y[unknowns->n - 1 + j];
}
