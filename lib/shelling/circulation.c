#include "shelling/circulation.h"

#include "shelling/element.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Of what a simplex receives: the least that the greedy flux sends through each of its sides. */
static const double LEAST_SHARE = 0.02;

/* Of the mean flux density in the simplices at a facet: what the fitted flux keeps there at least, where the
 * greedy one has twice as much. */
static const double LEAST_DENSITY = 0.02;

/* Over-relaxation of the sweeps: below 2, no step raises the energy. */
static const double FACTOR = 1.5;

/* Flux is kept above this, so that it never underflows to 0 along ever smaller shares. */
static const double LEAST_FLUX = 1e-290;

/* Rings between looks at the progress callback, and simplices. */
enum { RINGS_PER_REPORT = 1 << 16, SIMPLICES_PER_REPORT = 1 << 16 };

/* What flows through a simplex, by the reference, over the sum of the areas of its sides. */
static double density(const iccp_circulation *c, size_t simplex)
{
    const size_t n_corners = c->mesh->dim + 1;
    double flux = 0, area = 0;
    for (size_t s = n_corners * simplex; s < n_corners * (simplex + 1); ++s) {
        flux += fabs(c->reference[s]);
        area += iccp_element_area(c->mesh, s);
    }
    return flux / area;
}

icc_status iccp_circulation_create(iccp_circulation *circulation, const iccp_simplices *mesh,
                                   uint32_t centre, const double *inflow, const double *reference,
                                   const iccp_env *env)
{
    iccp_circulation *c = circulation;
    *c = (iccp_circulation){
        .mesh = mesh, .centre = centre, .inflow = inflow, .reference = reference};
    icc_status status = iccp_rings_create(&c->rings, mesh, centre, env);
    if (status != ICC_OK)
        return status;
    c->weight = iccp_alloc(&env->memory, c->rings.n_facets, sizeof *c->weight);
    c->least = iccp_alloc(&env->memory, c->rings.n_facets, sizeof *c->least);
    if (c->weight == NULL || c->least == NULL) {
        iccp_circulation_free(c);
        return ICC_ERR_MEMORY;
    }
    for (size_t f = 0; f < c->rings.n_facets; ++f) {
        const uint32_t side = c->rings.side[f], other = mesh->across[side];
        c->weight[f] = iccp_element_conductance(mesh, side);
        c->least[f] = LEAST_DENSITY * iccp_element_area(mesh, side) * 0.5 *
                      (density(c, iccp_simplex_of(mesh, side)) +
                       density(c, iccp_simplex_of(mesh, other)));
    }
    return ICC_OK;
}

void iccp_circulation_free(iccp_circulation *circulation)
{
    const iccp_memory memory = circulation->rings.memory;
    iccp_free(&memory, circulation->weight);
    iccp_free(&memory, circulation->least);
    iccp_rings_free(&circulation->rings);
    circulation->weight = NULL;
    circulation->least = NULL;
}

/* What a simplex receives leaves it through its sides to smaller rank as `wish` has it, but at least a share
 * of all through each. Flux here only ever is added up, so that rounding is all that is amiss. */
static void send_on(const iccp_circulation *c, const uint32_t *rank, size_t simplex, const double *wish,
                    double least, double *flux)
{
    const size_t dim = c->mesh->dim, first = (dim + 1) * simplex;
    double received = 0, sum = 0, share[ICC_MAX_DIM + 1];
    bool leaves[ICC_MAX_DIM + 1];
    for (size_t i = 0; i <= dim; ++i) {
        const uint32_t other = c->mesh->across[first + i];
        leaves[i] = (other & ICCP_RIM) == 0 &&
                    rank[iccp_simplex_of(c->mesh, other)] < rank[simplex];
        received -= leaves[i] ? 0 : flux[first + i];
    }
    for (size_t i = 0; i <= dim; ++i) {
        share[i] = leaves[i] ? fmax(wish[first + i], least * received) : 0;
        sum += share[i];
    }
    for (size_t i = 0; i <= dim; ++i)
        if (leaves[i]) {
            flux[first + i] = fmax(received * (share[i] / sum), LEAST_FLUX);
            flux[c->mesh->across[first + i]] = -flux[first + i];
        }
}

/* All that comes from the boundary goes to the star. */
static icc_status send_all(const iccp_circulation *c, const uint32_t *rank, const double *wish,
                           double least, double *flux, const iccp_env *env)
{
    const iccp_simplices *mesh = c->mesh;
    uint32_t *order = iccp_alloc(&env->memory, mesh->n_simplices, sizeof *order);
    uint32_t last = 0;
    icc_status status = order != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (uint32_t t = 0; t < mesh->n_simplices && order != NULL; ++t) {
        order[rank[t]] = t;
        last = rank[t] > last ? rank[t] : last;
    }
    for (uint32_t r = last; r > 0 && status == ICC_OK; --r) {
        if (r % SIMPLICES_PER_REPORT == 0)
            status = iccp_progress(env, "fluxes", 1 - (double)r / (double)last);
        send_on(c, rank, order[r], wish, least, flux);
    }
    iccp_free(&env->memory, order);
    return status;
}

icc_status iccp_circulation_greedy(const iccp_circulation *c, const uint32_t *rank, double *flux,
                                   const iccp_env *env)
{
    for (size_t s = 0; s < (c->mesh->dim + 1) * c->mesh->n_simplices; ++s) {
        const uint32_t other = c->mesh->across[s];
        flux[s] = (other & ICCP_RIM) != 0 ? -c->inflow[other & ~ICCP_RIM] : 0;
    }
    return send_all(c, rank, c->reference, LEAST_SHARE, flux, env);
}

/* A facet during the sweeps: flux from the smaller of its sides, what that shall be, the weight of the
 * difference, and the least modulus. The sign never changes. */
typedef struct gate {
    double flux, wish, weight, least;
} gate;

static void open_gates(const iccp_circulation *c, const double *flux, gate *gates)
{
    for (size_t f = 0; f < c->rings.n_facets; ++f) {
        const uint32_t side = c->rings.side[f];
        gates[f] = (gate){flux[side], c->reference[side], 1 / c->weight[f],
                          fmin(c->least[f], 0.5 * fabs(flux[side]))};
    }
}

/* The best circulation is a mean of the differences; it may go too far by some. */
static void relax_ring(gate *gates, const uint32_t *step, size_t n_steps)
{
    double sum = 0, weight = 0, low = -HUGE_VAL, high = HUGE_VAL;
    for (size_t k = 0; k < n_steps; ++k) {
        const gate *g = gates + step[k] / 2;
        const double sign = step[k] % 2 == 0 ? 1 : -1, flux = sign * g->flux;
        sum += g->weight * (sign * g->wish - flux);
        weight += g->weight;
        if (flux > 0)
            low = fmax(low, g->least - flux);
        else
            high = fmin(high, -g->least - flux);
    }
    const double round = fmin(fmax(FACTOR * sum / weight, low), high);
    for (size_t k = 0; k < n_steps; ++k) {
        gate *g = gates + step[k] / 2;
        const double flux = g->flux + (step[k] % 2 == 0 ? round : -round);
        /* Rounding must not turn it round. */
        g->flux = copysign(fmax(copysign(1, g->flux) * flux, g->least), g->flux);
    }
}

static icc_status sweep(const iccp_rings *rings, gate *gates, const iccp_env *env)
{
    for (size_t r = 0; r < rings->n; ++r) {
        if (r % RINGS_PER_REPORT == 0) {
            const icc_status status = iccp_progress(env, "fluxes", (double)r / (double)rings->n);
            if (status != ICC_OK)
                return status;
        }
        relax_ring(gates, rings->step + rings->first[r], rings->first[r + 1] - rings->first[r]);
    }
    return ICC_OK;
}

icc_status iccp_circulation_relax(const iccp_circulation *c, const uint32_t *rank, size_t n_sweeps,
                                  double *flux, const iccp_env *env)
{
    gate *gates = iccp_alloc(&env->memory, c->rings.n_facets, sizeof *gates);
    if (gates == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_OK;
    open_gates(c, flux, gates);
    for (size_t k = 0; k < n_sweeps && status == ICC_OK; ++k)
        status = sweep(&c->rings, gates, env);
    for (size_t f = 0; f < c->rings.n_facets; ++f)
        flux[c->rings.side[f]] = gates[f].flux;
    iccp_free(&env->memory, gates);
    for (size_t f = 0; f < c->rings.n_facets; ++f)
        flux[c->mesh->across[c->rings.side[f]]] = -flux[c->rings.side[f]];
    /* Where little is left of what there was, the rounding of that shows. */
    return status == ICC_OK ? send_all(c, rank, flux, 0, flux, env) : status;
}

double iccp_circulation_energy(const iccp_circulation *c, const double *flux)
{
    double energy = 0;
    for (size_t f = 0; f < c->rings.n_facets; ++f) {
        const double off = flux[c->rings.side[f]] - c->reference[c->rings.side[f]];
        energy += off * off / c->weight[f];
    }
    return energy;
}

double iccp_circulation_divergence(const iccp_circulation *c, const double *flux)
{
    const size_t n_corners = c->mesh->dim + 1;
    double worst = 0;
    for (size_t t = 0; t < c->mesh->n_simplices; ++t) {
        double sum = 0, leaving = 0;
        if (iccp_element_has(c->mesh, t, c->centre))
            continue;
        for (size_t s = n_corners * t; s < n_corners * (t + 1); ++s) {
            sum += flux[s];
            leaving += fmax(flux[s], 0);
        }
        worst = fmax(worst, fabs(sum) / leaving);
    }
    return worst;
}
