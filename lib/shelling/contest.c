/* The reference flux tells a good order: the less of it an order turns round, the nearer to it a flux along
 * the order can come. Which rule and which weight do best differs from mesh to mesh, so all are tried. */
#include "shelling/contest.h"

#include "base/error.h"
#include "base/threads.h"

#include <math.h>

enum { N_BETAS = 7, N_RUNS = 2 * N_BETAS };

/* On 16 meshes the best one was one of 16 to 1024: the greater, the less flux is reversed, until, the earlier
 * the more simplices there are, simplices that had to wait for long are closed in. */
static const double BETA[N_BETAS] = {4, 8, 16, 32, 64, 256, 1024};

/* The energy was within 2 % then of what it was after 100. */
static const size_t SWEEPS = 50;

/* When no order is complete: how often those simplices that were left get ahead of others, and how far, of
 * the potential's range. Growth that stopped short on real meshes was complete after 2 to 4 times. */
enum { N_ROUNDS = 12 };
static const double ADVANCE = 0.01;

typedef struct contest {
    iccp_order_wish wish;
    iccp_faces faces;
    iccp_circulation circulation;
    iccp_env quiet;          /* for other threads than the caller's */
    double energy[N_RUNS];   /* HUGE_VAL for an order that was not complete */
} contest;

typedef icc_status (*order_rule)(const iccp_order_wish *wish, uint32_t *rank, size_t *n_left,
                                 const iccp_env *env);

static order_rule rule_of(size_t run)
{
    return run < N_BETAS ? iccp_order_peel : iccp_order_grow;
}

static iccp_order_wish wish_of(const contest *c, size_t run)
{
    iccp_order_wish wish = c->wish;
    wish.beta = BETA[run % N_BETAS];
    return wish;
}

/* The greedy flux will do to compare: an order whose energy was least then was within 10 % of the least after
 * 100 sweeps, too. */
static icc_status compete(contest *c, size_t run)
{
    const iccp_simplices *mesh = c->wish.mesh;
    const iccp_env *env = &c->quiet;
    const iccp_order_wish wish = wish_of(c, run);
    uint32_t *rank = iccp_alloc(&env->memory, mesh->n_simplices, sizeof *rank);
    double *flux = iccp_alloc(&env->memory, (mesh->dim + 1) * mesh->n_simplices, sizeof *flux);
    size_t n_left = 0;
    icc_status status = ICC_ERR_MEMORY;
    if (rank != NULL && flux != NULL)
        status = rule_of(run)(&wish, rank, &n_left, env);
    c->energy[run] = HUGE_VAL;
    if (status == ICC_OK && n_left == 0) {
        status = iccp_circulation_greedy(&c->circulation, rank, flux, env);
        if (status == ICC_OK)
            c->energy[run] = iccp_circulation_energy(&c->circulation, flux);
    }
    iccp_free(&env->memory, rank);
    iccp_free(&env->memory, flux);
    return status;
}

static icc_status compete_all(void *argument, size_t begin, size_t end)
{
    icc_status status = ICC_OK;
    for (size_t run = begin; run < end && status == ICC_OK; ++run)
        status = compete(argument, run);
    return status;
}

/* The run that does best, or N_RUNS. */
static size_t find_best(const contest *c, size_t *n_finished)
{
    size_t best = N_RUNS;
    *n_finished = 0;
    for (size_t run = 0; run < N_RUNS; ++run) {
        *n_finished += c->energy[run] < HUGE_VAL;
        if (c->energy[run] < (best < N_RUNS ? c->energy[best] : HUGE_VAL))
            best = run;
    }
    return best;
}

/* Gives the simplices that were left a start over the others. */
static void advance_left(const contest *c, bool peeling, const uint32_t *rank, double *bias)
{
    const size_t n = c->wish.mesh->n_simplices;
    double range = 0;
    for (size_t s = 0; s < n; ++s)
        range = fmax(range, c->wish.potential[s]);
    for (size_t s = 0; s < n; ++s)
        if (rank[s] == UINT32_MAX)
            bias[s] += (peeling ? ADVANCE : -ADVANCE) * range;
}

/* One rule, again and again. */
static icc_status insist(const contest *c, size_t run, uint32_t *rank, size_t *n_left,
                         const iccp_env *env)
{
    iccp_order_wish wish = wish_of(c, run);
    double *bias = iccp_alloc_zero(&env->memory, wish.mesh->n_simplices, sizeof *bias);
    wish.bias = bias;
    icc_status status = bias != NULL ? ICC_OK : ICC_ERR_MEMORY;
    *n_left = 1;
    for (int round = 0; round < N_ROUNDS && status == ICC_OK && *n_left > 0; ++round) {
        status = rule_of(run)(&wish, rank, n_left, env);
        if (status == ICC_OK)
            advance_left(c, run < N_BETAS, rank, bias);
    }
    iccp_free(&env->memory, bias);
    return status;
}

/* Finds the best order again, or any with a good deal of patience. */
static icc_status find_order(const contest *c, size_t *run, uint32_t *rank, const iccp_env *env,
                             icc_error *err)
{
    size_t n_left = 0, n_least = SIZE_MAX;
    if (*run < N_RUNS) {
        const iccp_order_wish wish = wish_of(c, *run);
        return rule_of(*run)(&wish, rank, &n_left, env);
    }
    for (*run = 0; *run < N_RUNS; *run += N_BETAS) {
        const icc_status status = insist(c, *run, rank, &n_left, env);
        if (status != ICC_OK || n_left == 0)
            return status;
        n_least = n_left < n_least ? n_left : n_least;
    }
    return iccp_fail(err, ICC_ERR_TOPOLOGY, -1,
                     "no order was found that builds up the domain from the maximum: at best %zu of the "
                     "%zu simplices are left; try another maximum or a finer mesh",
                     n_least, c->wish.mesh->n_simplices);
}

static size_t count_reversed(const iccp_circulation *c, const uint32_t *rank)
{
    size_t n = 0;
    for (size_t f = 0; f < c->rings.n_facets; ++f) {
        const uint32_t side = c->rings.side[f];
        const size_t here = iccp_simplex_of(c->mesh, side);
        const size_t there = iccp_simplex_of(c->mesh, c->mesh->across[side]);
        n += c->reference[side] > 0 ? rank[here] < rank[there] : rank[here] > rank[there];
    }
    return n;
}

static icc_status hold(contest *c, uint32_t *rank, double *flux, iccp_contest_info *info,
                       const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_for_chunks(env, "orders", N_RUNS, 1, compete_all, c);
    if (status != ICC_OK)
        return status;
    *info = (iccp_contest_info){.n_orders = N_RUNS};
    size_t run = find_best(c, &info->n_finished);
    status = find_order(c, &run, rank, env, err);
    if (status == ICC_OK)
        status = iccp_circulation_greedy(&c->circulation, rank, flux, env);
    if (status == ICC_OK)
        status = iccp_circulation_relax(&c->circulation, rank, SWEEPS, flux, env);
    if (status != ICC_OK)
        return status;
    info->peeled = run < N_BETAS;
    info->beta = BETA[run % N_BETAS];
    info->energy = iccp_circulation_energy(&c->circulation, flux);
    info->divergence = iccp_circulation_divergence(&c->circulation, flux);
    info->n_reversed = count_reversed(&c->circulation, rank);
    return ICC_OK;
}

icc_status iccp_contest(const iccp_simplices *mesh, uint32_t centre, const double *inflow,
                        const double *reference, const double *potential, uint32_t *rank, double *flux,
                        iccp_contest_info *info, const iccp_env *env, icc_error *err)
{
    contest c = {.quiet = *env, .circulation.rings.memory = env->memory};
    c.quiet.progress = NULL;
    c.wish = (iccp_order_wish){.mesh = mesh,
                               .faces = &c.faces,
                               .centre = centre,
                               .flux = reference,
                               .potential = potential};
    icc_status status = iccp_faces_create(&c.faces, mesh, env);
    if (status == ICC_OK)
        status = iccp_circulation_create(&c.circulation, mesh, centre, inflow, reference, env);
    if (status == ICC_OK)
        status = hold(&c, rank, flux, info, env, err);
    iccp_circulation_free(&c.circulation);
    iccp_faces_free(&c.faces);
    return iccp_explain(err, status);
}
