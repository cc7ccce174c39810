/* Assembly and factorisation of the glued problem. Diagonal entries are sums of squares, by
 * s'Ls = sum of (s_u - s_v)^2 over neighbours: in the difference of 2 dim |s|^2 and the products inside of a
 * cluster their last digits would be lost, and with them the accuracy of small components (A. Alfa,
 * J. Xue, Q. Ye, Accurate computation of the smallest eigenvalue of a diagonally dominant M-matrix,
 * Math. Comp. 71, 2002, on why these decide). */
#include "base/clock.h"
#include "field/glued.h"
#include "math/ldlt.h"
#include "math/ordering.h"

/* Clusters, other than the root's, are the unknowns of the system. */
typedef struct system {
    const iccp_rows *rows;
    const iccp_gluing *gluing;
    size_t n;
    uint32_t *unknown; /* of each row's cluster; ICCP_NONE: the root's, where the value is known */
    uint32_t *head;    /* the last row of each cluster */
    uint32_t *next;    /* the next row of the same cluster, downwards; ICCP_NONE after the top */
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
    size_t *slot;      /* where a column's entry of the current row is, if that entry says so too */
    double *known;     /* right side */
} system;

static void *get(const iccp_env *env, size_t n, size_t size)
{
    return iccp_alloc(&env->memory, n, size);
}

/* Numbers the clusters and lists their rows; returns the number of entries off the diagonal blocks. */
static size_t find_clusters(system *s)
{
    const iccp_rows *rows = s->rows;
    const uint32_t *top = s->gluing->top;
    size_t n_entries = 0;
    s->n = 0;
    for (uint32_t k = 0; k < rows->n; ++k) {
        if (top[k] != k)
            s->unknown[k] = s->unknown[top[k]];
        else
            s->unknown[k] = k == 0 ? ICCP_NONE : (uint32_t)s->n++;
        const uint32_t u = s->unknown[k];
        if (u == ICCP_NONE)
            continue;
        s->next[k] = top[k] == k ? ICCP_NONE : s->head[u];
        s->head[u] = k;
    }
    for (size_t k = 0; k < rows->n; ++k)
        for (int32_t d = 0; d < rows->n_neighbours; ++d) {
            const uint32_t j = rows->neighbour[k * (size_t)rows->n_neighbours + (size_t)d];
            n_entries += j != ICCP_NONE && top[j] != top[k];
        }
    return n_entries;
}
