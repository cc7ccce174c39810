/* Fill-reducing ordering: minimum degree on a quotient graph. Sources: P. Amestoy, T. Davis, I.
 * Duff, An approximate minimum degree ordering algorithm, SIAM J. Matrix Anal. Appl. 17, 1996; A.
 * George, J. Liu, The evolution of the minimum degree ordering algorithm, SIAM Review 31, 1989.
 * Where degrees have become large, minimum fill: E. Rothberg, S. Eisenstat, Node selection
 * strategies for bottom-up sparse matrix ordering, SIAM J. Matrix Anal. Appl. 19, 1998.
 *
 * Elimination joins all neighbours of a variable. The graph does not store these edges. Instead it
 * keeps the eliminated variable as an element: the list of the variables that it has joined. The
 * list of a variable holds its elements first and then its remaining neighbours. Variables with
 * equal lists are eliminated together, and one of them represents all. */
#include "math/ordering.h"

#include "base/minmax.h"
#include "math/etree.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define NONE UINT32_MAX

/* Marks the beginning of a list while lists are moved. In node::last it marks the first variable of
 * its cost, which has no variable before it. */
#define HEAD ((uint32_t)1 << 31)

/* Variables with more neighbours are eliminated last. In units of sqrt(n), and also the least
 * number. */
static const double DENSE = 10;
enum { LEAST_DENSE = 16 };

/* Up to this degree, or three times the mean, variables are eliminated by degree. By fill from the
 * beginning, plane grids and meshes took a tenth more multiplications. Their long lists took four
 * times as long, because distant eliminations absorb little. Solids and walls take a fifth to a
 * third less than by degree throughout (tests/bench/bench_ordering). */
enum { SMALL_DEGREE = 32 };

/* Most buckets that lists are hashed into for comparison. */
enum { MOST_BUCKETS = 1 << 14 };

/* Eliminations between two calls of the progress callback. */
enum { ELEMENTS_PER_REPORT = 1 << 15 };

/* A variable or an element. */
typedef struct node {
    uint32_t begin, length; /* its list; an empty list means that the node no longer exists */
    uint32_t n_elements;    /* of a variable: elements in its list, which come first */
    int32_t size;           /* of a variable: how many it represents; negative in the new element */
    uint32_t degree;        /* variables of an element; for a variable, a bound of its neighbours */
    /* Neighbours in the list of the same cost. In a bucket: the next variable, and the hash. For an
     * absorbed element: the one that absorbed it. */
    uint32_t next, last;
    /* For an element: the stamp plus the number of its variables outside the new one. 0 if it no
     * longer exists. */
    uint32_t mark;
} node;

typedef struct graph {
    const iccp_env *env;
    size_t n;
    node *node;
    uint32_t *list, end, room; /* the lists of all nodes, up to `end` */
    uint32_t *head;            /* by cost, n: the first variable with it, or NONE */
    uint32_t *bucket;          /* by hash: the first variable with it, or NONE */
    uint32_t *ring;            /* by variable: the next one that is eliminated with it */
    uint32_t mask;             /* number of buckets - 1 */
    uint32_t stamp, most;      /* marks below the stamp are old; the largest element's size */
    uint32_t small;            /* up to this degree, the degree is the cost */
    uint32_t least;            /* no variable has a smaller cost */
    uint32_t n_left;           /* variables that are not eliminated yet */
} graph;

/* ------------------------------------------------------------------- lists */

static void link_cost(graph *g, uint32_t i, uint32_t cost)
{
    node *v = &g->node[i];
    v->last = cost | HEAD;
    v->next = g->head[cost];
    if (v->next != NONE)
        g->node[v->next].last = i;
    g->head[cost] = i;
    g->least = cost < g->least ? cost : g->least;
}

static void unlink_cost(graph *g, uint32_t i)
{
    const node *v = &g->node[i];
    if (v->next != NONE)
        g->node[v->next].last = v->last;
    if ((v->last & HEAD) == 0)
        g->node[v->last].next = v->next;
    else
        g->head[v->last ^ HEAD] = v->next;
}

/* Variable j is eliminated together with i from now on. */
static void join_rings(graph *g, uint32_t i, uint32_t j)
{
    const uint32_t next = g->ring[i];
    g->ring[i] = g->ring[j];
    g->ring[j] = next;
}

/* Closes the gaps between lists. Meanwhile the first entry of each list is kept in its node. */
static void compact(graph *g)
{
    uint32_t to = 0;
    for (uint32_t i = 0; i < g->n; ++i) {
        node *v = &g->node[i];
        if (v->length == 0)
            continue;
        const uint32_t begin = v->begin;
        v->begin = g->list[begin];
        g->list[begin] = i | HEAD;
    }
    for (uint32_t from = 0; from < g->end;) {
        if ((g->list[from] & HEAD) == 0) {
            ++from;
            continue;
        }
        node *v = &g->node[g->list[from] ^ HEAD];
        g->list[to] = v->begin;
        v->begin = to++;
        for (uint32_t k = 1; k < v->length; ++k)
            g->list[to++] = g->list[from + k];
        from += v->length;
    }
    g->end = to;
}

/* ------------------------------------------------------------- elimination */

/* Moves the variables of a list that are not yet in the new element to list[to..]. Returns the
 * end. */
static uint32_t take(graph *g, uint32_t begin, uint32_t length, uint32_t to, uint32_t *degree)
{
    for (uint32_t k = begin; k < begin + length; ++k) {
        const uint32_t i = g->list[k];
        node *v = &g->node[i];
        if (v->size <= 0)
            continue;
        *degree += (uint32_t)v->size;
        v->size = -v->size;
        unlink_cost(g, i);
        g->list[to++] = i;
    }
    return to;
}

static void absorb_element(node *e, uint32_t p)
{
    e->length = e->mark = 0;
    e->next = p;
}

/* Turns variable p into an element and absorbs the elements that p belonged to. If there are none,
 * the new list takes the place of p's list. */
static void form_element(graph *g, uint32_t p)
{
    node *v = &g->node[p];
    uint32_t most = v->length - v->n_elements;
    for (uint32_t k = 0; k < v->n_elements; ++k)
        most += g->node[g->list[v->begin + k]].length;
    if (v->n_elements > 0 && g->room - g->end < (most < g->n_left ? most : g->n_left))
        compact(g);
    const uint32_t begin = v->n_elements > 0 ? g->end : v->begin;
    uint32_t end = begin, degree = 0;
    for (uint32_t k = 0; k < v->n_elements; ++k) {
        node *e = &g->node[g->list[v->begin + k]];
        end = take(g, e->begin, e->length, end, &degree);
        absorb_element(e, p);
    }
    end = take(g, v->begin + v->n_elements, v->length - v->n_elements, end, &degree);
    if (v->n_elements > 0)
        g->end = end;
    v->begin = begin;
    v->length = end - begin;
    v->degree = degree;
    v->next = NONE;
    v->mark = g->stamp;
}

/* Marks each element that shares variables with the new one. The mark tells how many other
 * variables it has. */
static void count_outside(const graph *g, uint32_t p)
{
    const node *element = &g->node[p];
    for (uint32_t k = element->begin; k < element->begin + element->length; ++k) {
        const node *v = &g->node[g->list[k]];
        const uint32_t size = (uint32_t)-v->size, *list = g->list + v->begin;
        for (uint32_t q = 0; q < v->n_elements; ++q) {
            node *e = &g->node[list[q]];
            if (e->mark >= g->stamp)
                e->mark -= size;
            else if (e->mark != 0)
                e->mark = g->stamp + e->degree - size;
        }
    }
}

/* The rest of a variable's list without everything that the new element covers. */
typedef struct leftover {
    uint32_t length, n_elements, degree, hash;
} leftover;

static leftover shorten(const graph *g, uint32_t p, const node *v)
{
    uint32_t *list = g->list + v->begin;
    leftover r = {0, 0, 0, 0};
    for (uint32_t q = 0; q < v->n_elements; ++q) {
        node *e = &g->node[list[q]];
        const uint32_t outside = e->mark - g->stamp;
        if (e->mark == 0)
            continue;
        if (outside == 0) {
            absorb_element(e, p);
            continue;
        }
        r.degree += outside;
        r.hash += list[q];
        list[r.length++] = list[q];
    }
    r.n_elements = r.length;
    for (uint32_t q = v->n_elements; q < v->length; ++q) {
        const int32_t size = g->node[list[q]].size;
        if (size <= 0)
            continue;
        r.degree += (uint32_t)size;
        r.hash += list[q];
        list[r.length++] = list[q];
    }
    return r;
}

/* If variable i has no neighbours outside the new element p, it is eliminated with p. Otherwise p
 * becomes first in its list, and i enters the hash bucket of the rest. */
static void update(graph *g, uint32_t p, uint32_t i)
{
    node *v = &g->node[i];
    const leftover r = shorten(g, p, v);
    if (r.length == 0) {
        g->node[p].degree -= (uint32_t)-v->size;
        g->n_left -= (uint32_t)-v->size;
        v->size = 0;
        v->length = 0;
        join_rings(g, p, i);
        return;
    }
    uint32_t *list = g->list + v->begin, *bucket = &g->bucket[r.hash & g->mask];
    list[r.length] = list[r.n_elements];
    list[r.n_elements] = list[0];
    list[0] = p;
    v->n_elements = r.n_elements + 1;
    v->length = r.length + 1;
    v->degree = r.degree < v->degree ? r.degree : v->degree;
    v->last = r.hash;
    v->next = *bucket;
    *bucket = i;
}

/* ------------------------------------------------------ equal variables */

static void new_stamp(graph *g, uint32_t step)
{
    g->stamp += step;
    if (g->stamp < UINT32_MAX - 2 * (uint32_t)g->n)
        return;
    for (size_t i = 0; i < g->n; ++i)
        if (g->node[i].mark != 0)
            g->node[i].mark = 1;
    g->stamp = 2;
}

/* Returns true if all entries of v's list have the stamp, except the first, which all variables of
 * the new element share. */
static bool is_stamped(const graph *g, const node *v)
{
    const uint32_t *list = g->list + v->begin;
    for (uint32_t q = 1; q < v->length; ++q)
        if (g->node[list[q]].mark != g->stamp)
            return false;
    return true;
}

static void put_stamp(graph *g, const node *v)
{
    const uint32_t *list = g->list + v->begin;
    new_stamp(g, 1);
    for (uint32_t q = 1; q < v->length; ++q)
        g->node[list[q]].mark = g->stamp;
}

/* Lets variable i represent the later variables in its bucket that have the same list. */
static void absorb_equals(graph *g, uint32_t i)
{
    node *v = &g->node[i], *before = v;
    bool is_put = false;
    for (uint32_t j = v->next, next; j != NONE; j = next) {
        node *w = &g->node[j];
        next = w->next;
        if (w->last == v->last && w->length == v->length && w->n_elements == v->n_elements) {
            if (!is_put)
                put_stamp(g, v);
            is_put = true;
            if (is_stamped(g, w)) {
                v->size += w->size;
                w->size = 0;
                w->length = 0;
                join_rings(g, i, j);
                before->next = next;
                continue;
            }
        }
        before = w;
    }
}

static void find_equals(graph *g, uint32_t p)
{
    const node *element = &g->node[p];
    new_stamp(g, g->most);
    for (uint32_t k = element->begin; k < element->begin + element->length; ++k) {
        const node *v = &g->node[g->list[k]];
        if (v->size == 0)
            continue;
        uint32_t i = g->bucket[v->last & g->mask];
        g->bucket[v->last & g->mask] = NONE;
        for (; i != NONE; i = g->node[i].next)
            absorb_equals(g, i);
    }
    new_stamp(g, 1);
}

/* --------------------------------------------------------------- the whole */

/* Returns the cost of eliminating variable v. Small degrees are their own cost. For larger ones the
 * cost follows from how many pairs of neighbours are not joined yet; the new element has joined
 * `joined` of the neighbours.
 *
 * The total fill (approximate minimum fill) gives wider supernodes. The fill for each represented
 * variable (mean fill) gives less work. Dividing by the root of their number gives the fastest
 * factors. */
static uint32_t cost_of(const graph *g, const node *v, uint32_t joined)
{
    if (v->degree <= g->small)
        return v->degree;
    const double all = v->degree, fill = all * (all - 1) - joined * (joined - 1.0);
    const double cost = g->small + sqrt(iccp_max(0, fill) / sqrt(v->size));
    return cost < (double)g->n - 1 ? (uint32_t)cost : (uint32_t)g->n - 1;
}

/* Finishes element p and sets the degrees and costs of its variables. */
static void finish_element(graph *g, uint32_t p)
{
    node *element = &g->node[p];
    uint32_t *list = g->list + element->begin, length = 0;
    for (uint32_t k = 0; k < element->length; ++k) {
        node *v = &g->node[list[k]];
        if (v->size == 0)
            continue;
        v->size = -v->size;
        const uint32_t others = g->n_left - (uint32_t)v->size;
        const uint32_t degree = v->degree + element->degree - (uint32_t)v->size;
        v->degree = degree < others ? degree : others;
        link_cost(g, list[k], cost_of(g, v, element->degree - (uint32_t)v->size));
        list[length++] = list[k];
    }
    if (element->begin + element->length == g->end)
        g->end = element->begin + length;
    element->length = length;
    element->mark = length > 0 ? element->mark : 0;
}

static uint32_t next_pivot(graph *g)
{
    while (g->head[g->least] == NONE)
        ++g->least;
    const uint32_t p = g->head[g->least];
    unlink_cost(g, p);
    return p;
}

/* Eliminates the next variable with all that it represents, and returns it. */
static uint32_t eliminate(graph *g)
{
    const uint32_t p = next_pivot(g);
    g->n_left -= (uint32_t)g->node[p].size;
    g->node[p].size = 0;
    form_element(g, p);
    g->most = g->node[p].degree > g->most ? g->node[p].degree : g->most;
    count_outside(g, p);
    const uint32_t begin = g->node[p].begin, length = g->node[p].length;
    for (uint32_t k = begin; k < begin + length; ++k)
        update(g, p, g->list[k]);
    find_equals(g, p);
    finish_element(g, p);
    return p;
}

/* Writes the order: each element's variables follow directly after those of the elements that it
 * absorbed, in the order of rows. That is the same elimination, but related rows stay together.
 *
 * Elements come before those that absorb them. So the first loops sum the sizes of whole subtrees
 * forwards into `length`. Then each subtree gets its place within its parent, with `degree` as the
 * running total. The last loop makes the places absolute, backwards. */
static void place_elements(const graph *g, uint32_t n, const uint32_t *element, uint32_t *order)
{
    node root = {0};
    for (uint32_t k = 0; k < n; ++k)
        g->node[element[k]].length = g->node[element[k]].degree = 0;
    for (uint32_t k = 0; k < n; ++k) {
        node *e = &g->node[element[k]];
        uint32_t i = element[k];
        do {
            ++e->length;
            i = g->ring[i];
        } while (i != element[k]);
        (e->next == NONE ? &root : &g->node[e->next])->length += e->length;
    }
    for (uint32_t i = 0; i < g->n; ++i) {
        node *e = &g->node[i];
        if (e->length == 0)
            continue;
        node *into = e->next == NONE ? &root : &g->node[e->next];
        e->begin = into->degree;
        into->degree += e->length;
    }
    for (uint32_t k = n; k-- > 0;) {
        node *e = &g->node[element[k]];
        e->begin += e->next == NONE ? 0 : g->node[e->next].begin;
        uint32_t i = element[k], end = e->begin + e->length;
        do {
            order[--end] = i;
            i = g->ring[i];
        } while (i != element[k]);
    }
}

/* Leaves variables with many neighbours out of the graph, and puts them last. */
static size_t place_dense(const graph *g, const iccp_symmetric *m, uint32_t *order)
{
    const double limit = iccp_max(LEAST_DENSE, DENSE * sqrt((double)m->n));
    size_t n_dense = 0;
    for (size_t i = m->n; i-- > 0;) {
        const bool is_dense = (double)(m->first[i + 1] - m->first[i]) > limit;
        g->node[i] = (node){.size = is_dense ? 0 : 1, .mark = 1};
        if (is_dense)
            order[m->n - ++n_dense] = (uint32_t)i;
    }
    return n_dense;
}

static void load(graph *g, const iccp_symmetric *m)
{
    for (uint32_t i = 0; i < m->n; ++i)
        g->head[i] = NONE;
    for (uint32_t b = 0; b <= g->mask; ++b)
        g->bucket[b] = NONE;
    for (uint32_t i = 0; i < m->n; ++i) {
        node *v = &g->node[i];
        g->ring[i] = i;
        if (v->size == 0)
            continue;
        v->begin = g->end;
        for (size_t p = m->first[i]; p < m->first[i + 1]; ++p)
            if (g->node[m->column[p]].size > 0)
                g->list[g->end++] = m->column[p];
        v->length = v->degree = g->end - v->begin;
        link_cost(g, i, cost_of(g, v, 0));
    }
}

static icc_status report(const graph *g, size_t n)
{
    const double share = 1 - (double)g->n_left / (double)n;
    return iccp_progress(g->env, "solve", (ICCP_PASS_ORDER + share) / ICCP_N_PASSES);
}

static icc_status run(graph *g, const iccp_symmetric *m, uint32_t *order)
{
    icc_status status = ICC_OK;
    g->n_left = (uint32_t)(m->n - place_dense(g, m, order));
    g->stamp = 2;
    load(g, m);
    const size_t n = g->n_left;
    uint32_t n_elements = 0;
    while (g->n_left > 0 && status == ICC_OK) {
        if (n_elements % ELEMENTS_PER_REPORT == 0)
            status = report(g, n);
        order[n_elements++] = eliminate(g);
    }
    if (status == ICC_OK) {
        memcpy(g->head, order, n_elements * sizeof *order);
        place_elements(g, n_elements, g->head, order);
    }
    return status;
}

icc_status iccp_ordering(const iccp_symmetric *matrix, uint32_t *order, const iccp_env *env)
{
    const size_t n = matrix->n, n_entries = matrix->first[n], room = n_entries + n_entries / 5 + n;
    const iccp_memory *memory = &env->memory;
    if (room >= HEAD)
        return ICC_ERR_RESOLUTION;
    graph g = {.env = env, .n = n, .room = (uint32_t)room, .mask = 1, .small = SMALL_DEGREE};
    if (n > 0 && n_entries / n > SMALL_DEGREE / 3)
        g.small = (uint32_t)(3 * n_entries / n);
    while (g.mask + 1 < n && g.mask + 1 < MOST_BUCKETS)
        g.mask = 2 * g.mask + 1;
    g.node = iccp_alloc(memory, n, sizeof *g.node);
    g.list = iccp_alloc(memory, room, sizeof *g.list);
    g.head = iccp_alloc(memory, n, sizeof *g.head);
    g.bucket = iccp_alloc(memory, (size_t)g.mask + 1, sizeof *g.bucket);
    g.ring = iccp_alloc(memory, n, sizeof *g.ring);
    icc_status status = ICC_ERR_MEMORY;
    if (g.node != NULL && g.list != NULL && g.head != NULL && g.bucket != NULL && g.ring != NULL)
        status = run(&g, matrix, order);
    iccp_free(memory, g.node);
    iccp_free(memory, g.list);
    iccp_free(memory, g.head);
    iccp_free(memory, g.bucket);
    iccp_free(memory, g.ring);
    return status;
}
