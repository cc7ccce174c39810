/* Solves the assignment problem by shortest augmenting paths: R. Jonker and A. Volgenant, A
 * shortest augmenting path algorithm for dense and sparse linear assignment problems, 1987. */
#include "match/assignment.h"

#include <math.h>

#define NONE UINT32_MAX

typedef struct search {
    const iccp_spot *a, *b;
    size_t n;                   /* spots of b; a may have fewer */
    double *u, *v, *least;      /* duals of both sides; least reduced cost to each spot of b */
    uint32_t *row, *from, *way; /* of each spot of b: its partner; the spot before it on the path */
    unsigned char *is_done;
} search;

double iccp_spot_distance(const iccp_spot *a, const iccp_spot *b)
{
    const double x = a->at[0] - b->at[0], y = a->at[1] - b->at[1];
    const double s = a->size - b->size, c = a->count - b->count;
    return x * x + y * y + s * s + c * c;
}

/* Finds the shortest alternating path from a's spot i to a spot of b without a partner (Dijkstra on
 * reduced costs), and exchanges partners along it. `way` keeps the order in which b's spots were
 * reached. */
static void augment(search *s, uint32_t i)
{
    size_t n_reached = 0;
    uint32_t last = NONE, row = i;
    double length = 0;
    for (size_t j = 0; j < s->n; ++j) {
        s->least[j] = HUGE_VAL;
        s->is_done[j] = 0;
    }
    for (;;) {
        uint32_t best = NONE;
        for (uint32_t j = 0; j < s->n; ++j) {
            if (s->is_done[j])
                continue;
            const double to =
                length + (iccp_spot_distance(&s->a[row], &s->b[j]) - s->u[row] - s->v[j]);
            if (to < s->least[j]) {
                s->least[j] = to;
                s->from[j] = last;
            }
            if (best == NONE || s->least[j] < s->least[best])
                best = j;
        }
        length = s->least[best];
        last = best;
        if (s->row[best] == NONE)
            break;
        s->is_done[best] = 1;
        s->way[n_reached++] = best;
        row = s->row[best];
    }
    s->u[i] += length;
    for (size_t k = 0; k < n_reached; ++k) {
        const uint32_t j = s->way[k];
        s->u[s->row[j]] += length - s->least[j];
        s->v[j] -= length - s->least[j];
    }
    for (uint32_t j = last; j != NONE; j = s->from[j])
        s->row[j] = s->from[j] != NONE ? s->row[s->from[j]] : i;
}

/* Moves spot j to place row[j], along each cycle. */
static void reorder(const search *s, iccp_spot *b)
{
    for (uint32_t j = 0; j < s->n; ++j)
        while (s->row[j] != j) {
            const uint32_t to = s->row[j];
            const iccp_spot swap = b[to];
            b[to] = b[j];
            b[j] = swap;
            s->row[j] = s->row[to];
            s->row[to] = to;
        }
}

/* Finds the partner of each of n spots of a: s->row. The caller frees the search, even after an
 * error. */
static icc_status solve(search *s, size_t n, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    s->u = iccp_alloc_zero(memory, s->n, 3 * sizeof *s->u);
    s->row = iccp_alloc(memory, s->n, 3 * sizeof *s->row);
    s->is_done = iccp_alloc(memory, s->n, 1);
    if (s->u == NULL || s->row == NULL || s->is_done == NULL)
        return ICC_ERR_MEMORY;
    s->v = s->u + s->n;
    s->least = s->v + s->n;
    s->from = s->row + s->n;
    s->way = s->from + s->n;
    for (size_t j = 0; j < s->n; ++j)
        s->row[j] = NONE;
    icc_status status = ICC_OK;
    for (uint32_t i = 0; i < n && status == ICC_OK; ++i) {
        augment(s, i);
        status = iccp_progress(env, NULL, (double)(i + 1) / (double)n);
    }
    return status;
}

static void release(search *s, const iccp_memory *memory)
{
    iccp_free(memory, s->u);
    iccp_free(memory, s->row);
    iccp_free(memory, s->is_done);
}

icc_status iccp_assign(const iccp_spot *a, iccp_spot *b, size_t n, const iccp_env *env)
{
    search s = {.a = a, .b = b, .n = n};
    const icc_status status = solve(&s, n, env);
    if (status == ICC_OK)
        reorder(&s, b);
    release(&s, &env->memory);
    return status;
}

icc_status iccp_assign_some(uint32_t *partner, const iccp_spot *a, size_t n, const iccp_spot *b,
                            size_t m, const iccp_env *env)
{
    search s = {.a = a, .b = b, .n = m};
    const icc_status status = solve(&s, n, env);
    for (uint32_t j = 0; j < m && status == ICC_OK; ++j)
        if (s.row[j] != NONE)
            partner[s.row[j]] = j;
    release(&s, &env->memory);
    return status;
}

bool iccp_can_exchange(size_t *i, size_t *k, const iccp_spot *a, const iccp_spot *b, size_t n,
                       double least, double sure)
{
    for (*i = 0; *i < n; ++*i)
        for (*k = 0; *k < *i; ++*k) {
            const double is =
                iccp_spot_distance(&a[*i], &b[*i]) + iccp_spot_distance(&a[*k], &b[*k]);
            const double other =
                iccp_spot_distance(&a[*i], &b[*k]) + iccp_spot_distance(&a[*k], &b[*i]);
            if (other + least < sure * (is + least))
                return true;
        }
    return false;
}
