/* The closed surfaces of a boundary in space, and which of them lies in which.
 *
 * A ray along an axis crosses a surface an odd number of times if it starts inside. The surfaces
 * around a point lie one in another. So their lowest vertices rise from the outermost to the
 * innermost, and one ray finds the innermost. */
#include "domain/closed_surfaces.h"

#include "base/error.h"
#include "geometry/crossings.h"
#include "math/predicates.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* ------------------------------------------------------------------- pieces */

static const double *point(const iccp_facet_tree *tree, uint32_t v)
{
    return tree->vertices + 3 * (size_t)v;
}

bool iccp_surface_is_lower(const iccp_facet_tree *tree, uint32_t v, uint32_t w)
{
    const double *p = point(tree, v), *q = point(tree, w);
    return p[0] < q[0] || (p[0] == q[0] && (p[1] < q[1] || (p[1] == q[1] && p[2] < q[2])));
}

/* Finds the pieces. Returns their number. of_facet[] holds the piece of each facet that was
 * reached. */
static size_t find_pieces(iccp_surfaces *s, const iccp_complex *c, bool *reached, uint32_t *queue)
{
    size_t n = 0;
    memset(reached, 0, c->n_facets * sizeof *reached);
    for (size_t f = 0; f < c->n_facets; ++f) {
        if (reached[f])
            continue;
        const size_t n_reached = iccp_complex_flood(c, f, reached, queue);
        for (size_t i = 0; i < n_reached; ++i)
            s->of_facet[queue[i]] = (uint32_t)n;
        ++n;
    }
    return n;
}

/* Counts facets and vertices, and finds the lowest vertices. Every vertex belongs to one surface:
 * counted[] marks those that were met. */
static void describe(iccp_surfaces *s, const iccp_complex *c, const iccp_facet_tree *tree,
                     bool *counted)
{
    memset(counted, 0, c->n_vertices * sizeof *counted);
    for (uint32_t f = 0; f < c->n_facets; ++f) {
        iccp_surface *surface = &s->item[s->of_facet[f]];
        if (surface->n_facets++ == 0) {
            surface->first_facet = f;
            surface->lowest = c->facets[3 * (size_t)f];
        }
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t v = c->facets[3 * (size_t)f + i];
            surface->n_vertices += !counted[v];
            counted[v] = true;
            if (iccp_surface_is_lower(tree, v, surface->lowest))
                surface->lowest = v;
        }
    }
}

/* -------------------------------------------------------------- orientation */

/* Just beyond its lowest vertex, a plane cuts a surface in a polygon with one corner on each edge
 * from that vertex. Returns true if the corner on the edge from v to a precedes that on the edge to
 * b. Compares y / x, then z / x, where x is moved by infinitesimal shares of y and z, as the choice
 * of v implies. */
static bool corner_before(const double *v, const double *a, const double *b)
{
    int sign = iccp_cross_sign(a[1], v[1], b[0], v[0], b[1], v[1], a[0], v[0]);
    if (sign == 0)
        sign = iccp_cross_sign(a[1], v[1], b[2], v[2], b[1], v[1], a[2], v[2]);
    if (sign == 0)
        sign = iccp_cross_sign(a[2], v[2], b[0], v[0], b[2], v[2], a[0], v[0]);
    return sign < 0;
}

/* The first corner of a surface's polygon and its neighbours there, as vertices. */
typedef struct turn {
    uint32_t first, next, last;
} turn;

static void read_turn(turn *t, const iccp_facet_tree *tree, const uint32_t *facet, size_t i,
                      bool has_first)
{
    const double *v = point(tree, facet[i]);
    const uint32_t a = facet[(i + 1) % 3], b = facet[(i + 2) % 3];
    if (has_first) {
        t->last = b == t->first ? a : t->last;
    } else if (t->first == NONE || corner_before(v, point(tree, a), point(tree, t->first))) {
        t->first = a;
        t->next = b;
    }
}

/* Finds the orientation of each polygon at its first corner. For a simple polygon that is the
 * orientation of the whole. */
static void orient(iccp_surfaces *s, const iccp_facet_tree *tree, turn *turns)
{
    for (size_t k = 0; k < s->n; ++k)
        turns[k] = (turn){NONE, NONE, NONE};
    for (int round = 0; round < 2; ++round)
        for (size_t i = 0; i < 3 * tree->n; ++i) {
            const uint32_t k = s->of_facet[i / 3];
            if (tree->facets[i] == s->item[k].lowest)
                read_turn(&turns[k], tree, tree->facets + i - i % 3, i % 3, round == 1);
        }
    for (size_t k = 0; k < s->n; ++k)
        s->item[k].orientation =
            -iccp_orient3d(point(tree, s->item[k].lowest), point(tree, turns[k].first),
                           point(tree, turns[k].next), point(tree, turns[k].last));
}

/* ------------------------------------------------------------------ nesting */

uint32_t iccp_surfaces_around(iccp_surfaces *s, const iccp_facet_tree *tree, const double *p,
                              uint32_t except)
{
    iccp_ray ray;
    uint32_t facet, innermost = NONE;
    size_t n = 0;
    if (!iccp_ray_start(&ray, tree, p))
        return NONE;
    while (iccp_ray_next(&ray, &facet)) {
        const uint32_t k = s->of_facet[facet];
        if (s->state[k] == 0)
            s->crossed[n++] = k;
        s->state[k] = s->state[k] == 0 ? -1 : (int8_t)-s->state[k];
    }
    for (size_t i = 0; i < n; ++i) {
        const uint32_t k = s->crossed[i];
        if (s->state[k] < 0 && k != except &&
            (innermost == NONE ||
             iccp_surface_is_lower(tree, s->item[innermost].lowest, s->item[k].lowest)))
            innermost = k;
        s->state[k] = 0;
    }
    return innermost;
}

static icc_status nest(iccp_surfaces *s, const iccp_facet_tree *tree, const iccp_env *env)
{
    for (uint32_t k = 0; k < s->n; ++k) {
        if (iccp_progress(env, "check", (double)k / (double)s->n) != ICC_OK)
            return ICC_ERR_CANCELLED;
        iccp_surface *surface = &s->item[k];
        surface->around = iccp_surfaces_around(s, tree, point(tree, surface->lowest), k);
    }
    return ICC_OK;
}

/* --------------------------------------------------------------------- all */

void iccp_surfaces_free(iccp_surfaces *s, const iccp_memory *memory)
{
    iccp_free(memory, s->item);
    iccp_free(memory, s->of_facet);
    iccp_free(memory, s->crossed);
    iccp_free(memory, s->state);
}

static icc_status make_items(iccp_surfaces *s, const iccp_memory *memory)
{
    s->item = iccp_alloc_zero(memory, s->n, sizeof *s->item);
    s->crossed = iccp_alloc(memory, s->n, sizeof *s->crossed);
    s->state = iccp_alloc_zero(memory, s->n, sizeof *s->state);
    return s->item != NULL && s->crossed != NULL && s->state != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_surfaces_create(iccp_surfaces *s, const iccp_complex *c,
                                const iccp_facet_tree *tree, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_marks = c->n_facets > c->n_vertices ? c->n_facets : c->n_vertices;
    bool *marks = iccp_alloc(memory, n_marks, sizeof *marks);
    uint32_t *queue = iccp_alloc(memory, c->n_facets, sizeof *queue);
    turn *turns = NULL;
    *s = (iccp_surfaces){.of_facet = iccp_alloc(memory, c->n_facets, sizeof *s->of_facet)};
    icc_status status =
        marks != NULL && queue != NULL && s->of_facet != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        s->n = find_pieces(s, c, marks, queue);
        turns = iccp_alloc(memory, s->n, sizeof *turns);
        status = turns != NULL ? make_items(s, memory) : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK) {
        describe(s, c, tree, marks);
        orient(s, tree, turns);
        status = nest(s, tree, env);
    }
    iccp_free(memory, turns);
    iccp_free(memory, queue);
    iccp_free(memory, marks);
    if (status != ICC_OK)
        iccp_surfaces_free(s, memory);
    return status;
}

icc_status iccp_surfaces_check_void(const iccp_surfaces *s, uint32_t outer, uint32_t k,
                                    uint32_t around, icc_error *err)
{
    const unsigned long facet = s->item[k].first_facet, first = s->item[outer].first_facet;
    if (around == NONE)
        return iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_FACET, (int64_t)facet,
                            "the boundary has more than one component: the surface with face %lu "
                            "lies beside the surface with face %lu",
                            facet, first);
    if (around != outer)
        return iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_FACET, (int64_t)facet,
                            "the surface with face %lu lies in the void with face %lu", facet,
                            (unsigned long)s->item[around].first_facet);
    if (s->item[k].orientation == s->item[outer].orientation)
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)facet,
                            "the surface with face %lu lies in that with face %lu and is turned "
                            "the same way: exchange two vertices of each of its faces to make it "
                            "a void",
                            facet, first);
    return ICC_OK;
}
