/* Checks that rings bound a plane region. Rings that do not meet wind around a point as often as
 * rings around it turn left, minus the rings that turn right. So they bound a region on their left
 * under one condition: the outermost ones turn left, and every other one turns against the ring
 * around it. */
#include "domain/outlines.h"

#include "base/error.h"
#include "geometry/simple.h"
#include "icc/icc.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* Removes the ring through a vertex from `next` and lists it. Returns its length, or 0 if it does
 * not close. */
static size_t take_ring(uint32_t *next, uint32_t first, uint32_t *ring)
{
    size_t n = 0;
    uint32_t v = first;
    while (next[v] != NONE) {
        const uint32_t after = next[v];
        next[v] = NONE;
        ring[n++] = v;
        v = after;
    }
    return v == first ? n : 0;
}

static icc_status list_rings(iccp_outlines *o, size_t n_vertices, uint32_t *next)
{
    uint32_t n = 0;
    for (uint32_t v = 0; v < n_vertices; ++v) {
        if (next[v] == NONE)
            continue;
        const size_t n_own = take_ring(next, v, o->vertex + n);
        if (n_own < 3)
            return ICC_ERR_BOUNDARY;
        o->ring[o->n++] = (iccp_chain){n, (uint32_t)n_own, true};
        n += (uint32_t)n_own;
        o->vertex[n++] = v;
    }
    o->n_points = n;
    return n > 0 ? ICC_OK : ICC_ERR_BOUNDARY;
}

icc_status iccp_outlines_create(iccp_outlines *o, size_t n_vertices, uint32_t *next,
                                const iccp_memory *memory)
{
    *o = (iccp_outlines){.memory = *memory};
    o->ring = iccp_alloc(memory, n_vertices / 3 + 1, sizeof *o->ring);
    o->vertex = iccp_alloc(memory, n_vertices + n_vertices / 3 + 1, sizeof *o->vertex);
    return o->ring != NULL && o->vertex != NULL ? list_rings(o, n_vertices, next) : ICC_ERR_MEMORY;
}

void iccp_outlines_free(iccp_outlines *o)
{
    const iccp_memory memory = o->memory;
    iccp_free(&memory, o->ring);
    iccp_free(&memory, o->vertex);
}

/* ---- the check ---- */

static icc_status fail_defect(const iccp_outlines *o, const iccp_defect *found, icc_error *err)
{
    unsigned long v[4];
    const uint32_t at[4] = {found->a, found->a + 1, found->b, found->b + 1};
    for (int k = 0; k < 4; ++k)
        v[k] = at[k] < o->n_points ? o->vertex[at[k]] : 0;
    if (found->kind == ICC_DEFECT_REPEATED)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "vertices %lu and %lu are in the same place", v[0],
                         v[2]);
    if (found->kind == ICC_DEFECT_SPIKE)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "at vertex %lu it runs back over itself", v[0]);
    return iccp_fail(err, ICC_ERR_BOUNDARY, "edges (%lu, %lu) and (%lu, %lu) meet", v[0], v[1],
                     v[2], v[3]);
}

static icc_status check_places(const iccp_outlines *o, const iccp_chain_place *place,
                               icc_error *err)
{
    for (size_t k = 0; k < o->n; ++k) {
        const uint32_t around = place[k].around, v = o->vertex[o->ring[k].first];
        if (place[k].orientation != (around == ICCP_NO_CHAIN ? 1 : -place[around].orientation))
            return iccp_fail(err, ICC_ERR_BOUNDARY,
                             "the ring through vertex %lu turns the wrong way beside the others",
                             (unsigned long)v);
    }
    return ICC_OK;
}

/* Checks rings whose points are listed. For a single ring the quick test nearly always suffices. */
static icc_status check_points(const iccp_outlines *o, const double *points,
                               iccp_chain_place *place, const iccp_env *env, icc_error *err)
{
    const iccp_chains chains = {o->n_points, points, o->n, o->ring};
    iccp_simple quick = {.answer = ICCP_UNDECIDED};
    iccp_defect found;
    icc_status status = ICC_OK;
    if (o->n == 1)
        status = iccp_simple_find(&quick, points, o->ring[0].n, env);
    if (status != ICC_OK || quick.answer == ICCP_SIMPLE)
        return status;
    status = iccp_sweep_chains(&found, place, &chains, env);
    if (status == ICC_OK && found.kind != 0)
        return fail_defect(o, &found, err);
    return status == ICC_OK && o->n > 1 ? check_places(o, place, err) : status;
}

icc_status iccp_outlines_check(const iccp_outlines *o, const double *points, const iccp_env *env,
                               icc_error *err)
{
    const iccp_memory *memory = &env->memory;
    double *own = iccp_alloc(memory, o->n_points, 2 * sizeof *own);
    iccp_chain_place *place = iccp_alloc(memory, o->n, sizeof *place);
    icc_status status = ICC_ERR_MEMORY;
    if (own != NULL && place != NULL) {
        for (size_t k = 0; k < o->n_points; ++k)
            memcpy(own + 2 * k, points + 2 * (size_t)o->vertex[k], 2 * sizeof *points);
        status = check_points(o, own, place, env, err);
    }
    iccp_free(memory, own);
    iccp_free(memory, place);
    return status;
}
