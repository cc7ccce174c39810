/* Checks that a boundary is a manifold in one piece. */
#include "domain/complex.h"

#include "base/compiler.h"
#include "base/error.h"

#include <stdbool.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* State of a flood, which reaches everything connected to its start. Corner i of facet f has the
 * number dim f + i. */
typedef struct flood {
    const iccp_complex *c;
    bool *reached;   /* by corner */
    uint32_t *queue; /* room for all corners */
    uint32_t *at;    /* by vertex: a facet there, or NONE */
} flood;

static ICCP_INLINE uint32_t corner_of(const iccp_complex *c, uint32_t dim, uint32_t facet,
                                      uint32_t vertex)
{
    uint32_t i = 0;
    while (c->facets[dim * facet + i] != vertex)
        ++i;
    return dim * facet + i;
}

/* Reaches the corners at one vertex that are connected across ridges at it. `dim` is that of the
 * complex, as an argument so that the compiler can avoid divisions. */
static ICCP_INLINE void flood_vertex(flood *f, uint32_t dim, uint32_t first)
{
    const iccp_complex *c = f->c;
    const uint32_t vertex = c->facets[first];
    size_t n = 0, done = 0;
    f->queue[n++] = first;
    f->reached[first] = true;
    while (done < n) {
        const uint32_t corner = f->queue[done++], facet = corner / dim;
        for (uint32_t i = 0; i < dim; ++i) {
            if (dim * facet + i == corner)
                continue;
            const uint32_t other = c->across[dim * facet + i];
            const uint32_t next = corner_of(c, dim, other, vertex);
            if (!f->reached[next]) {
                f->reached[next] = true;
                f->queue[n++] = next;
            }
        }
    }
}

/* A vertex is a corner of several facets. A flood from one of these corners must reach them all. If
 * it leaves out a corner at a known vertex, two fans of facets meet at that vertex only. */
static ICCP_INLINE icc_status check_vertices(flood *f, uint32_t dim, icc_error *err)
{
    const iccp_complex *c = f->c;
    for (size_t v = 0; v < c->n_vertices; ++v)
        f->at[v] = NONE;
    memset(f->reached, 0, c->dim * c->n_facets * sizeof *f->reached);
    for (uint32_t corner = 0; corner < c->dim * c->n_facets; ++corner) {
        if (f->reached[corner])
            continue;
        const uint32_t v = c->facets[corner], facet = corner / dim;
        const char *name = iccp_complex_facet(c->dim);
        if (f->at[v] != NONE)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, v,
                                "two surfaces share vertex %lu: %ss %lu and %lu there are not "
                                "connected round it",
                                (unsigned long)v, name, (unsigned long)f->at[v],
                                (unsigned long)facet);
        f->at[v] = facet;
        flood_vertex(f, dim, corner);
    }
    return ICC_OK;
}

size_t iccp_complex_flood(const iccp_complex *c, size_t first, bool *reached, uint32_t *queue)
{
    size_t n = 0, done = 0;
    queue[n++] = (uint32_t)first;
    reached[first] = true;
    while (done < n) {
        const size_t facet = queue[done++];
        for (size_t i = 0; i < c->dim; ++i) {
            const uint32_t other = c->across[c->dim * facet + i];
            if (!reached[other]) {
                reached[other] = true;
                queue[n++] = other;
            }
        }
    }
    return n;
}

static icc_status check_connected(flood *f, icc_error *err)
{
    const iccp_complex *c = f->c;
    const char *name = iccp_complex_facet(c->dim);
    memset(f->reached, 0, c->n_facets * sizeof *f->reached);
    const size_t n = iccp_complex_flood(c, 0, f->reached, f->queue);
    size_t other = 0;
    while (other < c->n_facets && f->reached[other])
        ++other;
    if (other == c->n_facets)
        return ICC_OK;
    return iccp_fail_at(
        err, ICC_ERR_TOPOLOGY, ICC_ITEM_FACET, (int64_t)other,
        "the boundary has more than one component: %s %zu is not connected to %s 0 (%zu %ss are)",
        name, other, name, n, name);
}

/* Checks the whole shape, or only the facets around each vertex. */
static icc_status check(const iccp_complex *c, bool whole, const iccp_env *env, icc_error *err)
{
    const iccp_memory *memory = &env->memory;
    flood f = {.c = c};
    f.reached = iccp_alloc(memory, c->dim * c->n_facets, sizeof *f.reached);
    f.queue = iccp_alloc(memory, c->dim * c->n_facets, sizeof *f.queue);
    f.at = iccp_alloc(memory, c->n_vertices, sizeof *f.at);
    icc_status status = ICC_OK;
    if (f.reached == NULL || f.queue == NULL || f.at == NULL)
        status = iccp_fail_memory(err);
    if (status == ICC_OK)
        status =
            c->dim == 3 ? check_vertices(&f, 3, err) : check_vertices(&f, (uint32_t)c->dim, err);
    if (status == ICC_OK && whole)
        status = check_connected(&f, err);
    iccp_free(memory, f.at);
    iccp_free(memory, f.queue);
    iccp_free(memory, f.reached);
    return status;
}

icc_status iccp_complex_check_vertices(const iccp_complex *c, const iccp_env *env, icc_error *err)
{
    return check(c, false, env, err);
}

icc_status iccp_complex_check_connected(const iccp_complex *c, const iccp_env *env, icc_error *err)
{
    return check(c, true, env, err);
}
