/* Reads charts. The certificate needs an order of the simplices, and any order is suitable in
 * which leaves pass only to smaller rank. So the order is not saved but made from the
 * directions. Source: A. B. Kahn, Topological Sorting of Large Networks, 1962. */
#include "shelling/shelling_file.h"

#include "domain/domain_file.h"
#include "shelling/element.h"
#include "shelling/shelling_certificate.h"
#include "shelling/shelling_state.h"

#include <math.h>

/* Tolerance: the rates out of a simplex, and those into it, sum to 1 up to rounding. */
static const double ROUNDING = 1e-9;

typedef struct order {
    const iccp_simplices *mesh;
    const double *direction;
    uint32_t *rank;
    uint32_t *n_ahead; /* of each simplex: sides by which leaves pass to simplices that have no rank
                          yet */
    uint32_t *queue;
} order;

/* Ranks the simplices. Returns false if leaves run in circles. */
static bool find_ranks(const order *o, uint32_t centre)
{
    const iccp_simplices *mesh = o->mesh;
    const size_t n = mesh->dim + 1;
    size_t n_queue = 0;
    uint32_t n_ranks = 0;
    for (uint32_t s = 0; s < mesh->n_simplices; ++s) {
        o->n_ahead[s] = 0;
        for (size_t i = 0; i < n; ++i)
            o->n_ahead[s] += o->direction[n * s + i] < 0;
        if (iccp_element_has(mesh, s, centre)) {
            o->n_ahead[s] = 0;
            o->rank[s] = 0;
            o->queue[n_queue++] = s;
        }
    }
    for (size_t done = 0; done < n_queue; ++done)
        for (size_t i = 0; i < n; ++i) {
            const uint32_t side = mesh->across[n * o->queue[done] + i];
            const size_t s = (side & ICCP_ON_BOUNDARY) != 0 ? SIZE_MAX : side / n;
            if (s == SIZE_MAX || o->n_ahead[s] == 0 || !(o->direction[side] < 0) ||
                --o->n_ahead[s] > 0)
                continue;
            o->rank[s] = ++n_ranks;
            o->queue[n_queue++] = (uint32_t)s;
        }
    return n_queue == mesh->n_simplices;
}

/* Checks the rates in the star, which are all written as 1. */
static bool are_ones(size_t n, const double *rate)
{
    for (size_t i = 0; i < n; ++i)
        if (!(rate[i] >= 1 && rate[i] <= 1))
            return false;
    return true;
}

/* Checks rates of barycentric coordinates, per unit of flux in and out. */
static bool are_rates(size_t n, const double *rate)
{
    double in = 0, out = 0;
    for (size_t i = 0; i < n; ++i) {
        in += rate[i] > 0 ? rate[i] : 0;
        out += rate[i] > 0 ? 0 : -rate[i];
    }
    return fabs(in - 1) <= ROUNDING && fabs(out - 1) <= ROUNDING;
}

static bool are_directions(const order *o, uint32_t centre)
{
    const size_t n = o->mesh->dim + 1;
    for (size_t s = 0; s < o->mesh->n_simplices; ++s) {
        const double *rate = o->direction + n * s;
        if (!(iccp_element_has(o->mesh, s, centre) ? are_ones(n, rate) : are_rates(n, rate)))
            return false;
    }
    return true;
}

static icc_status certify(const order *o, const icc_domain *domain, uint32_t centre,
                          const iccp_env *env)
{
    iccp_shelling_certificate found;
    if (!are_directions(o, centre) || !find_ranks(o, centre))
        return ICC_ERR_FORMAT;
    const icc_status status =
        iccp_certify_shelling(&found, o->mesh, domain->facets, centre, o->rank, o->direction, env);
    return status != ICC_OK || iccp_shelling_certificate_holds(&found) ? status : ICC_ERR_FORMAT;
}

/* Certifies the directions with an order made for them, and makes the leaves. */
static icc_status read_leaves(icc_chart *chart, const iccp_simplices *mesh, uint32_t centre,
                              iccp_blob *b, const iccp_env *env)
{
    iccp_shelling_state *state = chart->state;
    const size_t n = mesh->n_simplices;
    double *direction;
    iccp_blob_array_f64(b, (mesh->dim + 1) * n, &direction);
    const order o = {mesh, direction, iccp_blob_alloc(b, n, sizeof *o.rank),
                     iccp_blob_alloc(b, n, sizeof *o.n_ahead),
                     iccp_blob_alloc(b, n, sizeof *o.queue)};
    icc_status status = b->status;
    if (status == ICC_OK)
        status = certify(&o, chart->domain, centre, env);
    if (status == ICC_OK)
        status = iccp_leafn_create(&state->leaves, mesh, centre, direction,
                                   chart->domain->band.reach, env);
    chart->info.certified = status == ICC_OK;
    iccp_free(&env->memory, direction);
    iccp_free(&env->memory, o.rank);
    iccp_free(&env->memory, o.n_ahead);
    iccp_free(&env->memory, o.queue);
    return status;
}

static void copy_facts(icc_shelling_info *info, const icc_shelling_info *facts)
{
    info->order_peeled = facts->order_peeled;
    info->n_orders = facts->n_orders;
    info->n_reversed = facts->n_reversed;
    info->harmonic_share = facts->harmonic_share;
    info->order_beta = facts->order_beta;
    info->flux_energy = facts->flux_energy;
    info->flux_divergence = facts->flux_divergence;
}

icc_status iccp_chart_shelling_read(icc_chart **out, const icc_domain *domain, iccp_blob *b,
                                    const iccp_env *env, icc_error *err)
{
    (void)err;
    icc_shelling_info facts = {0};
    iccp_simplices *own;
    uint64_t centre;
    *out = NULL;
    icc_status status = iccp_shelling_visit_head(b, &facts, &own, &centre, domain);
    const iccp_simplices *mesh = own != NULL ? own : domain->mesh;
    if (status == ICC_OK && (centre < mesh->n_boundary || centre >= mesh->n_points))
        status = ICC_ERR_FORMAT;
    if (status != ICC_OK) {
        iccp_simplices_free(own);
        return status;
    }
    status = iccp_shelling_begin(out, domain, own, (uint32_t)centre, env);
    if (status == ICC_OK) {
        copy_facts(&(*out)->own.shelling, &facts);
        status = read_leaves(*out, mesh, (uint32_t)centre, b, env);
    }
    if (status != ICC_OK) {
        iccp_chart_release(*out);
        *out = NULL;
    }
    return status;
}
