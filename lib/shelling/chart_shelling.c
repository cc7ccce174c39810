/* Creates charts of method foliation on the caller's mesh.
 *
 * Source: M. Campen, C. Silva, D. Zorin, Bijective Maps from Simplicial Foliations, ACM
 * Transactions on Graphics 35, 2016. See docs/theory/charts-space.md, "foliations of simplices". */
#include "shelling/chart_shelling.h"

#include "base/clock.h"
#include "base/error.h"
#include "shelling/arranged.h"
#include "shelling/best_order.h"
#include "shelling/centres.h"
#include "shelling/reference.h"
#include "shelling/shelling_certificate.h"
#include "shelling/shelling_split.h"
#include "shelling/shelling_state.h"

/* The share of the flux through the boundary that is harmonic. The rest goes by area. With a
 * larger share the median energy of maps falls, but so does their least determinant
 * (bench_tets). */
static const double HARMONIC_SHARE = 0.6;

/* One or two domains for which charts are being made. */
typedef struct job {
    size_t n;
    const icc_domain *const *domain;
    const icc_chart_options *options;
    iccp_simplices *split[2]; /* owned: meshes that got a vertex inside; NULL if the domain's has
                                 one */
    const iccp_simplices *mesh[2];
    uint32_t centre[2];
    double seconds; /* time to find the centres */
} job;

/* The arrays from which the order of one mesh is made, and the result. */
typedef struct work {
    double *inflow, *reference, *potential, *flux;
    uint32_t *rank;
} work;

/* Adds to the message which of two domains caused the error. */
static icc_status blame(const job *j, size_t k, icc_status status, icc_error *err)
{
    (void)iccp_explain(err, status);
    return j->n > 1 ? iccp_fail_side(err, status, (int32_t)k + 1) : status;
}

/* ---- centres ---- */

static icc_status make_inner(job *j, size_t k, const iccp_env *env, icc_error *err)
{
    const icc_domain *domain = j->domain[k];
    icc_status status = ICC_OK;
    j->mesh[k] = domain->mesh;
    if (domain->mesh->n_points == domain->mesh->n_boundary) {
        status = iccp_split_deepest(&j->split[k], domain, env, err);
        j->mesh[k] = j->split[k];
    }
    return status == ICC_OK ? ICC_OK : blame(j, k, status, err);
}

static icc_status choose_given(job *j, size_t k, icc_error *err)
{
    double local[ICC_MAX_DIM];
    const icc_domain *domain = j->domain[k];
    iccp_frame_in(&domain->frame, domain->dim, j->options[k].maximum, local);
    if (iccp_domain_locate(domain, local, true, NULL, NULL) != ICC_INSIDE) {
        (void)iccp_fail(err, ICC_ERR_OUTSIDE, "the maximum is not inside the domain");
        return blame(j, k, ICC_ERR_OUTSIDE, err);
    }
    j->centre[k] = iccp_nearest_centre(j->mesh[k], local);
    return ICC_OK;
}

/* If only the target's centre is given, pairs the domains in the opposite direction. */
static icc_status pair(job *j, const iccp_env *env)
{
    const bool given[2] = {j->options[0].maximum != NULL, j->options[1].maximum != NULL};
    const size_t from = given[1] ? 1 : 0;
    const icc_domain *const domain[2] = {j->domain[from], j->domain[1 - from]};
    const iccp_simplices *const mesh[2] = {j->mesh[from], j->mesh[1 - from]};
    uint32_t centre[2];
    const icc_status status =
        iccp_paired_centres(domain, mesh, given[from] ? &j->centre[from] : NULL, centre, env);
    if (status == ICC_OK) {
        j->centre[from] = centre[0];
        j->centre[1 - from] = centre[1];
    }
    return status;
}

/* Chooses the centres. A mesh without a vertex inside gets one. Each centre is the caller's, the
 * deepest vertex, or a vertex that suits both domains of a pair. */
static icc_status choose_centres(job *j, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    icc_status status = ICC_OK;
    size_t n_given = 0;
    for (size_t k = 0; status == ICC_OK && k < j->n; ++k) {
        status = make_inner(j, k, env, err);
        if (status == ICC_OK && j->options[k].maximum != NULL) {
            status = choose_given(j, k, err);
            ++n_given;
        }
    }
    if (status == ICC_OK && n_given < j->n) {
        status = j->n == 1 ? iccp_deepest_centre(j->domain[0], j->mesh[0], &j->centre[0], env)
                           : pair(j, env);
        if (status != ICC_OK)
            (void)iccp_fail(err, status, "the equations of the harmonic map cannot be solved");
    }
    j->seconds = iccp_seconds() - start;
    return iccp_explain(err, status);
}

/* ---- one chart ---- */

static void work_free(work *w, const iccp_memory *memory)
{
    iccp_free(memory, w->inflow);
    iccp_free(memory, w->reference);
    iccp_free(memory, w->potential);
    iccp_free(memory, w->flux);
    iccp_free(memory, w->rank);
}

/* Makes ranks and fluxes from a mesh in three steps. They are the inflow through the boundary,
 * the harmonic flux with that inflow, and the order that reverses the least of that flux. */
static icc_status find_order(work *w, const iccp_simplices *mesh, uint32_t centre, icc_chart *chart,
                             const iccp_env *env, icc_error *err)
{
    icc_shelling_info *info = &chart->own.shelling;
    const size_t n = mesh->n_simplices;
    iccp_best_order_info best_order = {0};
    const double start = iccp_seconds();
    w->inflow = iccp_alloc(&env->memory, mesh->n_facets, sizeof *w->inflow);
    w->reference = iccp_alloc(&env->memory, n, (mesh->dim + 1) * sizeof *w->reference);
    w->flux = iccp_alloc(&env->memory, n, (mesh->dim + 1) * sizeof *w->flux);
    w->potential = iccp_alloc(&env->memory, n, sizeof *w->potential);
    w->rank = iccp_alloc(&env->memory, n, sizeof *w->rank);
    if (w->inflow == NULL || w->reference == NULL || w->flux == NULL || w->potential == NULL ||
        w->rank == NULL)
        return ICC_ERR_MEMORY;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 4, 6}, env);
    icc_status status = iccp_inflow(mesh, centre, HARMONIC_SHARE, w->inflow, &part[0]);
    if (status == ICC_OK)
        status = iccp_reference_flux(mesh, centre, w->inflow, w->reference, w->potential, &part[1]);
    const double solved = iccp_seconds();
    if (status != ICC_OK)
        (void)iccp_fail(err, status, "the equations of the harmonic flux cannot be solved");
    if (status == ICC_OK)
        status = iccp_best_order(mesh, centre, w->inflow, w->reference, w->potential, w->rank,
                                 w->flux, &best_order, &part[2], err);
    info->harmonic_share = HARMONIC_SHARE;
    chart->timings.solve = solved - start;
    chart->timings.order = iccp_seconds() - solved;
    info->order_peeled = best_order.peeled;
    info->n_orders = (int32_t)best_order.n_finished;
    info->order_beta = best_order.beta;
    info->n_reversed = best_order.n_reversed;
    info->flux_energy = best_order.energy;
    info->flux_divergence = best_order.divergence;
    return status;
}

/* Replaces the fluxes by directions. A side by which leaves enter gets its share of the entering
 * flux. A side by which they leave gets minus its share of the leaving flux. */
static void find_directions(const iccp_simplices *mesh, double *flux)
{
    const size_t n = mesh->dim + 1;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        double in = 0, out = 0;
        for (size_t i = 0; i < n; ++i) {
            in += flux[n * s + i] < 0 ? -flux[n * s + i] : 0;
            out += flux[n * s + i] > 0 ? flux[n * s + i] : 0;
        }
        for (size_t i = 0; i < n; ++i)
            flux[n * s + i] /= flux[n * s + i] > 0 ? -out : -in;
    }
}

/* Certifies the ranks and directions that the leaves will follow, independent of how they were
 * made. */
static icc_status certify(icc_chart *chart, const iccp_simplices *mesh, uint32_t centre,
                          const work *w, const iccp_env *env, icc_error *err)
{
    iccp_shelling_certificate found;
    const double start = iccp_seconds();
    const icc_status status =
        iccp_certify_shelling(&found, mesh, chart->domain->facets, centre, w->rank, w->flux, env);
    chart->timings.certify = iccp_seconds() - start;
    if (status != ICC_OK)
        return status;
    chart->info.certified = iccp_shelling_certificate_holds(&found);
    if (chart->info.certified)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_CERTIFICATE,
                     "the foliation cannot be certified: %zu inverted simplices, %zu faults of "
                     "topology, %zu simplices out of order, %zu irregular faces, %zu directions "
                     "against the order",
                     found.n_inverted, found.n_topology, found.n_order, found.n_irregular,
                     found.n_directions);
}

/* Makes the order, its directions, their certificate, and the leaves. The directions replace the
 * reference flux after they have been put into the mesh's own order. */
static icc_status make_leaves(icc_chart *chart, const iccp_simplices *mesh, uint32_t centre,
                              const iccp_env *env, icc_error *err)
{
    iccp_shelling_state *state = chart->state;
    work w = {0};
    iccp_arranged arranged;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){8, 2, 1}, env);
    icc_status status = iccp_arranged_create(&arranged, mesh, env);
    if (status != ICC_OK)
        return status;
    status = find_order(&w, &arranged.mesh, centre, chart, &part[0], err);
    if (status == ICC_OK) {
        find_directions(&arranged.mesh, w.flux);
        status = certify(chart, &arranged.mesh, centre, &w, &part[1], err);
    }
    const double start = iccp_seconds();
    if (status == ICC_OK) {
        iccp_arranged_restore(&arranged, w.flux, w.reference);
        status = iccp_leafn_create(&state->leaves, mesh, centre, w.reference,
                                   chart->domain->band.reach, &part[2]);
    }
    chart->timings.mesh = iccp_seconds() - start;
    iccp_arranged_free(&arranged);
    work_free(&w, &env->memory);
    return status;
}

static icc_status make_chart(job *j, size_t k, icc_chart **out, const iccp_env *env, icc_error *err)
{
    iccp_simplices *own = j->split[k];
    j->split[k] = NULL;
    const icc_status status = iccp_shelling_begin(out, j->domain[k], own, j->centre[k], env);
    if (status != ICC_OK)
        return status;
    (*out)->timings.centre = j->seconds / (double)j->n;
    return make_leaves(*out, j->mesh[k], j->centre[k], env, err);
}

icc_status iccp_chart_shelling_create(size_t n, icc_chart **out, const icc_domain *const *domain,
                                      const icc_chart_options *options, const iccp_env *env,
                                      icc_error *err)
{
    job j = {.n = n, .domain = domain, .options = options};
    for (size_t k = 0; k < n; ++k)
        out[k] = NULL;
    iccp_env part[3];
    iccp_split(part, n + 1, (const double[]){1, 2, 2}, env);
    icc_status status = choose_centres(&j, &part[0], err);
    for (size_t k = 0; status == ICC_OK && k < n; ++k) {
        status = make_chart(&j, k, &out[k], &part[k + 1], err);
        if (status != ICC_OK)
            (void)blame(&j, k, status, err);
    }
    for (size_t k = 0; k < n; ++k) {
        iccp_simplices_free(j.split[k]);
        if (status != ICC_OK) {
            iccp_chart_release(out[k]);
            out[k] = NULL;
        }
    }
    return status;
}
