/* Solves the tied problem by factorisation. Each cluster of unknowns except the root's is one
 * variable u.
 *
 * Diagonal entries of P'LP are sums of squares, by s'Ls = sum of (s_u - s_v)^2 over neighbours u,
 * v. The accuracy of small components depends on how far the diagonal exceeds the rest of its row.
 * The difference of 2 dim |s|^2 and the products within the cluster would lose that. */
#include "base/clock.h"
#include "base/minmax.h"
#include "gradient/solver/dissection.h"
#include "gradient/solver/inequalities.h"
#include "gradient/solver/tied.h"
#include "math/ldlt.h"

#include <math.h>
#include <stdbool.h>

/* Clusters between two calls of the progress callback. */
enum { CLUSTERS_PER_REPORT = 1 << 16 };

typedef struct assembly {
    const iccp_unknowns *unknowns;
    const iccp_ties *ties;
    size_t n;           /* number of clusters */
    uint32_t *cluster;  /* by unknown: its cluster; ICCP_NONE: the root's */
    uint32_t *last;     /* by cluster: its last unknown */
    uint32_t *previous; /* by unknown: the previous one in its cluster; ICCP_NONE at its top */
    size_t *slot;       /* by cluster v: where entry (u, v) is, if that belongs to row u */
    size_t *first;      /* n + 1, as in iccp_symmetric, like the next two */
    uint32_t *column;
    double *value;
    double *diagonal; /* by cluster */
    double *known;    /* by cluster: the right-hand side */
} assembly;

/* Numbers the clusters by their tops and links their unknowns. */
static void find_clusters(assembly *a)
{
    const uint32_t *top = a->ties->top;
    a->n = 0;
    for (uint32_t k = 0; k < a->unknowns->n; ++k) {
        const bool is_top = top[k] == k;
        if (is_top)
            a->cluster[k] = k == 0 ? ICCP_NONE : (uint32_t)a->n++;
        const uint32_t u = a->cluster[k] = a->cluster[top[k]];
        if (u == ICCP_NONE)
            continue;
        a->previous[k] = is_top ? ICCP_NONE : a->last[u];
        a->last[u] = k;
    }
}

static size_t count_entries(const assembly *a)
{
    const size_t degree = (size_t)a->unknowns->n_neighbours;
    size_t n_entries = 0;
    for (size_t k = 0; k < a->unknowns->n; ++k)
        for (size_t d = 0; d < degree; ++d) {
            const uint32_t j = a->unknowns->neighbour[k * degree + d];
            n_entries += j != ICCP_NONE && a->cluster[j] != a->cluster[k];
        }
    return n_entries; /* includes those of the root, because an upper bound suffices */
}

static bool allocate(assembly *a, const iccp_env *env)
{
    const iccp_memory *m = &env->memory;
    const size_t n = a->n, n_entries = count_entries(a);
    a->slot = iccp_alloc_zero(m, n, sizeof *a->slot);
    a->first = iccp_alloc(m, n + 1, sizeof *a->first);
    a->column = iccp_alloc(m, n_entries, sizeof *a->column);
    a->value = iccp_alloc(m, n_entries, sizeof *a->value);
    a->diagonal = iccp_alloc_zero(m, n, sizeof *a->diagonal);
    a->known = iccp_alloc_zero(m, n, sizeof *a->known);
    return a->slot != NULL && a->first != NULL && a->column != NULL && a->value != NULL &&
           a->diagonal != NULL && a->known != NULL;
}

static void release(assembly *a, const iccp_env *env)
{
    void *const arrays[] = {a->cluster, a->last,  a->previous, a->slot, a->first,
                            a->column,  a->value, a->diagonal, a->known};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i)
        iccp_free(&env->memory, arrays[i]);
}

/* Subtracts x from the entry (u, v), which is added if the row has none yet. */
static void subtract(assembly *a, size_t u, uint32_t v, double x, size_t *end)
{
    size_t p = a->slot[v];
    if (p < a->first[u] || p >= *end || a->column[p] != v) {
        p = a->slot[v] = (*end)++;
        a->column[p] = v;
        a->value[p] = 0;
    }
    a->value[p] -= x;
}

/* Assembles row u of P'LP, which begins at first[u]. */
static void assemble_row(assembly *a, size_t u)
{
    const int32_t degree = a->unknowns->n_neighbours;
    const double *share = a->ties->share;
    size_t end = a->first[u];
    for (uint32_t k = a->last[u]; k != ICCP_NONE; k = a->previous[k])
        for (int32_t d = 0; d < degree; ++d) {
            const uint32_t j = a->unknowns->neighbour[k * (size_t)degree + (size_t)d];
            if (j != ICCP_NONE && a->cluster[j] == u) {
                const double step = share[k] - share[j];
                a->diagonal[u] += 0.5 * step * step; /* half, because it is met from either end */
                continue;
            }
            a->diagonal[u] += share[k] * share[k] * iccp_unknowns_slope(a->unknowns, k, d);
            if (j == ICCP_NONE)
                continue;
            if (a->cluster[j] == ICCP_NONE)
                a->known[u] += share[k] * share[j];
            else
                subtract(a, u, a->cluster[j], share[k] * share[j], &end);
        }
    a->first[u + 1] = end;
}

/* Assembles P'LP row by row. Clusters are linked first. The number of entries between them is an
 * upper bound for the arrays, and rows are filled one after another without gaps. */
static icc_status assemble(assembly *a, const iccp_env *env)
{
    const iccp_memory *m = &env->memory;
    const size_t n = a->unknowns->n;
    a->cluster = iccp_alloc(m, n, sizeof *a->cluster);
    a->last = iccp_alloc(m, n, sizeof *a->last);
    a->previous = iccp_alloc(m, n, sizeof *a->previous);
    if (a->cluster == NULL || a->last == NULL || a->previous == NULL)
        return ICC_ERR_MEMORY;
    find_clusters(a);
    if (!allocate(a, env))
        return ICC_ERR_MEMORY;
    a->first[0] = 0;
    icc_status status = ICC_OK;
    for (size_t u = 0; u < a->n && status == ICC_OK; ++u) {
        if (u % CLUSTERS_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)u / (double)a->n);
        assemble_row(a, u);
    }
    return status;
}

/* Copies x of the clusters into `f` of the unknowns. */
static void expand(const assembly *a, const iccp_scaled *x, const iccp_scaled *f)
{
    for (size_t k = 0; k < a->unknowns->n; ++k) {
        const uint32_t u = a->cluster[k];
        const double share = a->ties->share[k];
        if (u == ICCP_NONE)
            iccp_scaled_set(f, k, share, 0);
        else
            iccp_scaled_set(f, k, share * x->fraction[u], x->exponent[u]);
    }
}

/* Computes -P'L f, cluster by cluster. Differences of neighbours are exact, while those of the
 * terms of P'LP x would not be. */
static icc_status find_residual(const assembly *a, const iccp_scaled *x, const iccp_scaled *f,
                                const iccp_scaled *residual, const iccp_env *env)
{
    icc_status status = iccp_progress(env, "solve", 0);
    for (size_t u = 0; u < a->n && status == ICC_OK; ++u) {
        double sum = 0;
        if ((u + 1) % CLUSTERS_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)u / (double)a->n);
        for (uint32_t k = a->last[u]; k != ICCP_NONE; k = a->previous[k])
            sum -= a->ties->share[k] * iccp_laplacian_row(a->unknowns, f, k, x->exponent[u]);
        iccp_scaled_set(residual, u, sum, x->exponent[u]);
    }
    return status;
}

/* Checks by the residuals that every component is accurate. Entries of the factor that underflow
 * spoil whole regions. The bands of gradient/solver/dissection.c should prevent that. */
static bool is_accurate(const assembly *a, const iccp_scaled *x, const iccp_scaled *residual)
{
    for (size_t u = 0; u < a->n; ++u) {
        const double r = fabs(iccp_scaled_get(residual, u, x->exponent[u]));
        if (!(r <= ICCP_MOST_ERROR * a->diagonal[u] * x->fraction[u]))
            return false;
    }
    return true;
}

/* Computes x = A^-1 b, and once more for the residual. The components are accurate after the first
 * solve. But multipliers are sums over many entries of the residual, and gain two digits. */
static icc_status solve_twice(const assembly *a, const iccp_ldlt *factor, const iccp_scaled *x,
                              const iccp_scaled *d, const iccp_scaled *work, const iccp_scaled *f,
                              const iccp_env *env)
{
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){2, 1, 2}, env);
    for (size_t u = 0; u < a->n; ++u)
        iccp_scaled_set(x, u, a->known[u], 0);
    icc_status status = iccp_ldlt_solve_scaled(factor, x, work, &part[0]);
    if (status != ICC_OK)
        return status;
    expand(a, x, f);
    status = find_residual(a, x, f, d, &part[1]);
    if (status == ICC_OK && !is_accurate(a, x, d))
        status = ICC_ERR_SOLVER;
    if (status == ICC_OK)
        status = iccp_ldlt_solve_scaled(factor, d, work, &part[2]);
    if (status != ICC_OK)
        return status;
    for (size_t u = 0; u < a->n; ++u)
        iccp_scaled_set(x, u, x->fraction[u] + iccp_scaled_get(d, u, x->exponent[u]),
                        x->exponent[u]);
    expand(a, x, f);
    return ICC_OK;
}

static icc_status solve(const assembly *a, const iccp_ldlt *factor, const iccp_scaled *f,
                        const iccp_env *env)
{
    const size_t n = a->n;
    double *fraction = iccp_alloc(&env->memory, 3 * n, sizeof *fraction);
    int32_t *exponent = iccp_alloc(&env->memory, 3 * n, sizeof *exponent);
    icc_status status = ICC_ERR_MEMORY;
    if (fraction != NULL && exponent != NULL) {
        const iccp_scaled x = {fraction, exponent}, d = {fraction + n, exponent + n};
        const iccp_scaled work = {fraction + 2 * n, exponent + 2 * n};
        status = solve_twice(a, factor, &x, &d, &work, f, env);
    }
    iccp_free(&env->memory, fraction);
    iccp_free(&env->memory, exponent);
    return status;
}

/* Eliminates each cluster when its last unknown would be eliminated. This adds no fill. Clusters
 * are connected, so a path through earlier clusters is a path through earlier unknowns. */
static void contract_order(const assembly *a, const uint32_t *kept, uint32_t *order)
{
    size_t end = a->n;
    for (size_t u = 0; u < a->n; ++u)
        a->slot[u] = 0;
    for (size_t i = a->unknowns->n; i-- > 0;) {
        const uint32_t u = a->cluster[kept[i]];
        if (u != ICCP_NONE && a->slot[u]++ == 0)
            order[--end] = u;
    }
}

static icc_status analyse(const assembly *a, iccp_ldlt *factor, const iccp_symmetric *matrix,
                          const iccp_env *env)
{
    uint32_t *kept = a->ties->order;
    uint32_t *order = iccp_alloc(&env->memory, a->n, sizeof *order);
    uint32_t *fresh = iccp_alloc(&env->memory, kept == NULL ? a->unknowns->n : 0, sizeof *fresh);
    icc_status status = order != NULL && fresh != NULL ? ICC_OK : ICC_ERR_MEMORY;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, env);
    if (status == ICC_OK && (kept == NULL || kept[0] == ICCP_NONE))
        status = iccp_dissection(a->unknowns, kept == NULL ? fresh : kept, &part[0]);
    if (status == ICC_OK) {
        contract_order(a, kept == NULL ? fresh : kept, order);
        status = iccp_ldlt_analyse_ordered(factor, matrix, order, &part[1]);
    }
    iccp_free(&env->memory, order);
    iccp_free(&env->memory, fresh);
    return status;
}

/* Returns the time since the last call. */
static double lap(double *clock)
{
    const double before = *clock;
    *clock = iccp_seconds();
    return *clock - before;
}

icc_status iccp_tied_direct(const iccp_unknowns *unknowns, const iccp_ties *ties,
                            const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    assembly a = {.unknowns = unknowns, .ties = ties};
    iccp_ldlt factor = {.memory = env->memory};
    double clock = iccp_seconds();
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){1, 4, 8, 2}, env);
    icc_status status = assemble(&a, &part[0]);
    info->seconds_setup += lap(&clock);
    const iccp_symmetric matrix = {a.n, a.first, a.column, a.value, a.diagonal};
    if (status == ICC_OK)
        status = analyse(&a, &factor, &matrix, &part[1]);
    info->work = iccp_max(info->work, factor.work);
    info->seconds_order += lap(&clock);
    if (status == ICC_OK)
        status = iccp_ldlt_factorise(&factor, &matrix, &part[2]);
    info->seconds_factor += lap(&clock);
    if (status == ICC_OK)
        status = solve(&a, &factor, f, &part[3]);
    info->seconds_solve += lap(&clock);
    iccp_ldlt_free(&factor);
    release(&a, env);
    return status;
}
