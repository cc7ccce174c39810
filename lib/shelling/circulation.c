/* Fits a flux along an order to a reference flux. The sweeps are Gauss-Seidel relaxation of the
 * flux problem of networks in the space of cycles, with bounds as in projected relaxation.
 *
 * Sources: D. Young, Iterative Solution of Large Linear Systems, 1971. C. Cryer, SIAM J. Control
 * 9, 1971. */
#include "shelling/circulation.h"

#include "base/minmax.h"
#include "shelling/element.h"

#include <math.h>
#include <stdbool.h>

/* The least share of what a simplex receives that the greedy flux sends through each side. */
static const double LEAST_SHARE = 0.02;

/* The least flux density that the fitted flux keeps at a facet, relative to the mean density in
 * its two simplices. If the greedy flux has less than twice this density there, half of the
 * greedy flux is kept. */
static const double LEAST_DENSITY = 0.02;

/* Over-relaxation of the sweeps. Below 2 no step raises the energy. */
static const double FACTOR = 1.5;

/* Flux stays above this, so that it never underflows to 0 along ever smaller shares. */
static const double LEAST_FLUX = 1e-290;

/* Links, and simplices, between calls of the progress callback. */
enum { LINKS_PER_REPORT = 1 << 16, SIMPLICES_PER_REPORT = 1 << 16 };

/* How many links ahead the sweeps prefetch. Values of 4 to 16 were equally fast. */
enum { LINKS_AHEAD = 8 };

/* The density of a simplex: what flows through it by the reference, over the total area of its
 * sides. */
static void find_densities(const iccp_circulation *c, double *density)
{
    const size_t n_corners = c->mesh->dim + 1;
    for (size_t t = 0; t < c->mesh->n_simplices; ++t) {
        double flux = 0, area = 0;
        for (size_t s = n_corners * t; s < n_corners * (t + 1); ++s) {
            flux += fabs(c->reference[s]);
            area += iccp_element_area(c->mesh, s);
        }
        density[t] = flux / area;
    }
}

/* Sets for each facet the weight of a difference from the reference there, and the least flux. */
static icc_status weigh_facets(iccp_circulation *c, const iccp_env *env)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n = c->links.n_facets;
    double *density = iccp_alloc(&env->memory, mesh->n_simplices, sizeof *density);
    c->weight = iccp_alloc(&env->memory, n, sizeof *c->weight);
    c->least = iccp_alloc(&env->memory, n, sizeof *c->least);
    const bool good = density != NULL && c->weight != NULL && c->least != NULL;
    if (good)
        find_densities(c, density);
    for (size_t f = 0; f < n && good; ++f) {
        const uint32_t side = c->links.side[f], other = mesh->across[side];
        const double mean =
            0.5 * (density[iccp_simplex_of(mesh, side)] + density[iccp_simplex_of(mesh, other)]);
        c->weight[f] = iccp_element_conductance(mesh, side);
        c->least[f] = LEAST_DENSITY * mean * iccp_element_area(mesh, side);
    }
    iccp_free(&env->memory, density);
    return good ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_circulation_create(iccp_circulation *circulation, const iccp_simplices *mesh,
                                   uint32_t centre, const double *inflow, const double *reference,
                                   const iccp_env *env)
{
    iccp_circulation *c = circulation;
    *c = (iccp_circulation){
        .mesh = mesh, .centre = centre, .inflow = inflow, .reference = reference};
    icc_status status = iccp_links_create(&c->links, mesh, centre, env);
    if (status == ICC_OK)
        status = weigh_facets(c, env);
    if (status != ICC_OK)
        iccp_circulation_free(c);
    return status;
}

void iccp_circulation_free(iccp_circulation *circulation)
{
    const iccp_memory memory = circulation->links.memory;
    iccp_free(&memory, circulation->weight);
    iccp_free(&memory, circulation->least);
    iccp_links_free(&circulation->links);
    circulation->weight = NULL;
    circulation->least = NULL;
}

/* Sends on what a simplex receives through its sides to smaller rank, in proportion to `wanted`.
 * Each of these sides gets at least the share `least`. The function only adds up flux, so the
 * only errors are those of rounding. */
static void send_on(const iccp_circulation *c, const uint32_t *rank, size_t simplex,
                    const double *wanted, double least, double *flux)
{
    const size_t dim = c->mesh->dim, first = (dim + 1) * simplex;
    double received = 0, sum = 0, share[ICC_MAX_DIM + 1];
    bool leaves[ICC_MAX_DIM + 1];
    for (size_t i = 0; i <= dim; ++i) {
        const uint32_t other = c->mesh->across[first + i];
        leaves[i] = (other & ICCP_ON_BOUNDARY) == 0 &&
                    rank[iccp_simplex_of(c->mesh, other)] < rank[simplex];
        received -= leaves[i] ? 0 : flux[first + i];
    }
    for (size_t i = 0; i <= dim; ++i) {
        share[i] = leaves[i] ? iccp_max(wanted[first + i], least * received) : 0;
        sum += share[i];
    }
    for (size_t i = 0; i <= dim; ++i)
        if (leaves[i]) {
            flux[first + i] = iccp_max(received * (share[i] / sum), LEAST_FLUX);
            flux[c->mesh->across[first + i]] = -flux[first + i];
        }
}

/* Sends everything that enters through the boundary to the star. */
static icc_status send_all(const iccp_circulation *c, const uint32_t *rank, const double *wanted,
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
            status = iccp_progress(env, "order", 1 - (double)r / (double)last);
        send_on(c, rank, order[r], wanted, least, flux);
    }
    iccp_free(&env->memory, order);
    return status;
}

icc_status iccp_circulation_greedy(const iccp_circulation *c, const uint32_t *rank, double *flux,
                                   const iccp_env *env)
{
    for (size_t s = 0; s < (c->mesh->dim + 1) * c->mesh->n_simplices; ++s) {
        const uint32_t other = c->mesh->across[s];
        flux[s] = (other & ICCP_ON_BOUNDARY) != 0 ? -c->inflow[other & ~ICCP_ON_BOUNDARY] : 0;
    }
    return send_all(c, rank, c->reference, LEAST_SHARE, flux, env);
}

/* A facet during the sweeps: the flux from the smaller of its sides, the wanted flux, the weight
 * of the difference, and the least modulus. The flux never changes its sign. */
typedef struct gate {
    double flux, wanted, weight, least;
} gate;

/* Loads the fluxes in the order of the facets, so that a sweep reads one array. A facet that
 * starts with little flux may fall to half of it. */
static void open_gates(const iccp_circulation *c, const double *flux, gate *gates)
{
    for (size_t f = 0; f < c->links.n_facets; ++f) {
        const uint32_t side = c->links.side[f];
        gates[f] = (gate){flux[side], c->reference[side], 1 / c->weight[f],
                          iccp_min(c->least[f], 0.5 * fabs(flux[side]))};
    }
}

/* Adds the best circulation round a link: the weighted mean of the differences, over-relaxed.
 * Fluxes along the circulation limit it in one direction, fluxes against it in the other,
 * because each must keep its least modulus. */
static void relax_link(gate *gates, const uint32_t *step, size_t n_steps)
{
    double sum = 0, weight = 0, room_back = HUGE_VAL, room_on = HUGE_VAL;
    for (size_t k = 0; k < n_steps; ++k) {
        const gate *g = gates + step[k] / 2;
        const double sign = step[k] % 2 == 0 ? 1 : -1;
        const double along = sign * g->flux, room = fabs(along) - g->least;
        sum += g->weight * sign * (g->wanted - g->flux);
        weight += g->weight;
        const double back = along > 0 ? room : HUGE_VAL, on = along > 0 ? HUGE_VAL : room;
        room_back = back < room_back ? back : room_back;
        room_on = on < room_on ? on : room_on;
    }
    const double best = FACTOR * sum / weight;
    const double round = best < -room_back ? -room_back : best > room_on ? room_on : best;
    for (size_t k = 0; k < n_steps; ++k) {
        gate *g = gates + step[k] / 2;
        const double flux = g->flux + (step[k] % 2 == 0 ? round : -round);
        const double size = g->flux > 0 ? flux : -flux;
        /* Keeps the sign in spite of rounding. */
        g->flux = copysign(size > g->least ? size : g->least, g->flux);
    }
}

/* One Gauss-Seidel sweep over all links. Neighbours in the mesh are seldom neighbours in memory,
 * so gates are prefetched some links ahead. */
static icc_status sweep(const iccp_links *links, gate *gates, const iccp_env *env)
{
    for (size_t r = 0; r < links->n; ++r) {
        const size_t ahead = r + LINKS_AHEAD < links->n ? r + LINKS_AHEAD : links->n - 1;
        for (size_t k = links->first[ahead]; k < links->first[ahead + 1]; ++k)
            ICCP_PREFETCH(gates + links->step[k] / 2);
        if (r % LINKS_PER_REPORT == 0) {
            const icc_status status = iccp_progress(env, "order", (double)r / (double)links->n);
            if (status != ICC_OK)
                return status;
        }
        relax_link(gates, links->step + links->first[r], links->first[r + 1] - links->first[r]);
    }
    return ICC_OK;
}

/* Circulations do not change the divergence, and the greedy flux has only that of rounding.
 * Sending everything through once more removes the rounding errors that the sweeps add. */
icc_status iccp_circulation_relax(const iccp_circulation *c, const uint32_t *rank, size_t n_sweeps,
                                  double *flux, const iccp_env *env)
{
    gate *gates = iccp_alloc(&env->memory, c->links.n_facets, sizeof *gates);
    if (gates == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_OK;
    open_gates(c, flux, gates);
    for (size_t k = 0; k < n_sweeps && status == ICC_OK; ++k) {
        const iccp_env part =
            iccp_part(env, NULL, (double)k / (double)n_sweeps, (double)(k + 1) / (double)n_sweeps);
        status = sweep(&c->links, gates, &part);
    }
    for (size_t f = 0; f < c->links.n_facets; ++f)
        flux[c->links.side[f]] = gates[f].flux;
    iccp_free(&env->memory, gates);
    for (size_t f = 0; f < c->links.n_facets; ++f)
        flux[c->mesh->across[c->links.side[f]]] = -flux[c->links.side[f]];
    /* If little is left of a large flux, the rounding errors of the large flux are noticeable. */
    return status == ICC_OK ? send_all(c, rank, flux, 0, flux, env) : status;
}

double iccp_circulation_energy(const iccp_circulation *c, const double *flux)
{
    double energy = 0;
    for (size_t f = 0; f < c->links.n_facets; ++f) {
        const double off = flux[c->links.side[f]] - c->reference[c->links.side[f]];
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
            leaving += iccp_max(flux[s], 0);
        }
        worst = iccp_max(worst, fabs(sum) / leaving);
    }
    return worst;
}
