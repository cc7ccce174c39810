/* Elimination tree, postorder and column counts. Sources: J. Liu, The role of elimination trees in
 * sparse factorization, SIAM J. Matrix Anal. Appl. 11, 1990 (tree and postorder); J. Gilbert, E.
 * Ng, B. Peyton, An efficient algorithm to compute row and column counts for sparse Cholesky
 * factorization, SIAM J. Matrix Anal. Appl. 15, 1994 (counts). */
#include "math/etree.h"

#include <string.h>

#define NONE ICCP_NO_PARENT

/* Columns between two calls of the progress callback. */
enum { COLUMNS_PER_REPORT = 1 << 16 };

icc_status iccp_etree_progress(const iccp_etree *tree, int pass, size_t k, const iccp_env *env)
{
    if (k % COLUMNS_PER_REPORT != 0)
        return ICC_OK;
    return iccp_progress(env, "solve",
                         (pass + (double)k / (double)tree->matrix->n) / ICCP_N_PASSES);
}

static void number(const iccp_etree *t)
{
    for (uint32_t k = 0; k < t->matrix->n; ++k)
        t->position[t->order[k]] = k;
}

/* Shortens the paths to the roots of the present forest as it goes. */
static icc_status find_parents(const iccp_etree *t, uint32_t *ancestor, const iccp_env *env)
{
    const iccp_symmetric *m = t->matrix;
    icc_status status = ICC_OK;
    for (uint32_t k = 0; k < m->n && status == ICC_OK; ++k) {
        const uint32_t row = t->order[k];
        status = iccp_etree_progress(t, ICCP_PASS_TREE, k, env);
        t->parent[k] = ancestor[k] = NONE;
        for (size_t p = m->first[row]; p < m->first[row + 1]; ++p)
            for (uint32_t i = t->position[m->column[p]], next; i < k; i = next) {
                next = ancestor[i];
                ancestor[i] = k;
                if (next == NONE)
                    t->parent[i] = k;
            }
    }
    return status;
}

/* place[v] is when a postorder visits column v. Children keep their order. */
static void postorder(size_t n, const uint32_t *parent, uint32_t *place, uint32_t *child,
                      uint32_t *sibling, uint32_t *stack)
{
    uint32_t root = NONE, n_placed = 0;
    for (size_t v = 0; v < n; ++v)
        child[v] = NONE;
    for (uint32_t v = (uint32_t)n; v-- > 0;) {
        uint32_t *list = parent[v] == NONE ? &root : &child[parent[v]];
        sibling[v] = *list;
        *list = v;
    }
    for (; root != NONE; root = sibling[root]) {
        size_t height = 0;
        stack[height++] = root;
        while (height > 0) {
            const uint32_t v = stack[height - 1], next = child[v];
            if (next == NONE) {
                place[v] = n_placed++;
                --height;
            } else {
                child[v] = sibling[next];
                stack[height++] = next;
            }
        }
    }
}

static void renumber(const iccp_etree *t, const uint32_t *place, uint32_t *work)
{
    const size_t n = t->matrix->n;
    memcpy(work, t->order, n * sizeof *work);
    for (size_t v = 0; v < n; ++v)
        t->order[place[v]] = work[v];
    memcpy(work, t->parent, n * sizeof *work);
    for (size_t v = 0; v < n; ++v)
        t->parent[place[v]] = work[v] == NONE ? NONE : place[work[v]];
    number(t);
}

icc_status iccp_etree_build(const iccp_etree *tree, const iccp_env *env)
{
    const size_t n = tree->matrix->n;
    uint32_t *work = iccp_alloc(&env->memory, n, 4 * sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    number(tree);
    const icc_status status = find_parents(tree, work, env);
    if (status == ICC_OK) {
        postorder(n, tree->parent, work, work + n, work + 2 * n, work + 3 * n);
        renumber(tree, work, work + n);
    }
    iccp_free(&env->memory, work);
    return status;
}

/* State of the column counts. In a postorder the descendants of column j are the columns from
 * first[j] to j. */
typedef struct counting {
    uint32_t *first;    /* by column */
    uint32_t *latest;   /* by row: first[] of the most recent leaf of its subtree */
    uint32_t *leaf;     /* by row: that leaf */
    uint32_t *ancestor; /* by column: sets with a known common ancestor, as a forest */
} counting;

static uint32_t find_root(uint32_t *ancestor, uint32_t v)
{
    uint32_t root = v;
    while (ancestor[root] != root)
        root = ancestor[root];
    for (uint32_t next; v != root; v = next) {
        next = ancestor[v];
        ancestor[v] = root;
    }
    return root;
}

/* Row i of the factor is a subtree. Column j is one of its leaves unless the row contains a
 * descendant of j. Every leaf adds a path, which ends where it meets the path of the previous
 * leaf. */
static void count_leaf(const counting *c, uint32_t *delta, uint32_t i, uint32_t j)
{
    if (c->leaf[i] != NONE && c->first[j] <= c->latest[i])
        return;
    ++delta[j];
    if (c->leaf[i] != NONE)
        --delta[find_root(c->ancestor, c->leaf[i])];
    c->latest[i] = c->first[j];
    c->leaf[i] = j;
}

/* Computes the differences between each column's count and the sum of its children's. As unsigned
 * numbers these may wrap around, but the sums do not. */
static icc_status count_differences(const iccp_etree *t, const counting *c, uint32_t *delta,
                                    const iccp_env *env)
{
    const iccp_symmetric *m = t->matrix;
    icc_status status = ICC_OK;
    for (uint32_t j = 0; j < m->n; ++j) {
        c->first[j] = c->ancestor[j] = j;
        c->leaf[j] = NONE;
        delta[j] = 0;
    }
    for (uint32_t j = 0; j < m->n; ++j) {
        if (c->first[j] == j)
            delta[j] = 1;
        if (t->parent[j] != NONE && c->first[t->parent[j]] > c->first[j])
            c->first[t->parent[j]] = c->first[j];
    }
    for (uint32_t j = 0; j < m->n && status == ICC_OK; ++j) {
        const uint32_t row = t->order[j];
        status = iccp_etree_progress(t, ICCP_PASS_COUNT, j, env);
        if (t->parent[j] != NONE)
            --delta[t->parent[j]];
        for (size_t p = m->first[row]; p < m->first[row + 1]; ++p)
            if (t->position[m->column[p]] > j)
                count_leaf(c, delta, t->position[m->column[p]], j);
        if (t->parent[j] != NONE)
            c->ancestor[j] = t->parent[j];
    }
    return status;
}

icc_status iccp_etree_count(const iccp_etree *tree, uint32_t *count, const iccp_env *env)
{
    const size_t n = tree->matrix->n;
    uint32_t *work = iccp_alloc(&env->memory, n, 4 * sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    const counting c = {work, work + n, work + 2 * n, work + 3 * n};
    const icc_status status = count_differences(tree, &c, count, env);
    for (size_t j = 0; j < n && status == ICC_OK; ++j)
        if (tree->parent[j] != NONE)
            count[tree->parent[j]] += count[j];
    iccp_free(&env->memory, work);
    return status;
}
