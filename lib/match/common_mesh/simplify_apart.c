/* Simplifies a common surface in rounds. Vertices that cause intersections or errors are kept in
 * the next round. */
#include "match/common_mesh/simplify_apart.h"

#include "base/minmax.h"
#include "geometry/facet_tree.h"
#include "match/common_mesh/intersections.h"
#include "match/common_mesh/optimise_shape.h"

#include <string.h>

/* Rounds in which ever more vertices are kept, until no triangles meet. */
enum { ROUNDS = 12 };

/* Rounds of mending the whole surface. The first one moves the surface as little as possible. Each
 * allows `farther` times the distance of the one before, up to the limit. */
enum { MENDS = 7 };
static const double farther = 10;

/* Shape optimisation may raise the map's mean energy by this factor. */
static const double most_rise = 1.03;

typedef struct rounds {
    const iccp_common_surface *whole;
    const iccp_half_edges *const *given;
    const double *const *x;
    iccp_simplify_limits limits;
    uint8_t *keep;    /* by vertex of the whole */
    uint8_t *is_bad;  /* by vertex of the result */
    uint32_t *became; /* by vertex of the whole */
    uint8_t *flawed;  /* by vertex of the whole: it meets others there; known once that has been
                         checked */
    bool knows_flaws, has_flaws;
    bool any; /* some vertex is bad */
    double off;
} rounds;

/* ---- distances ---- */

/* Returns true if a point is too far from the surface of a tree. */
static bool is_far(rounds *r, int side, const iccp_facet_tree *tree, const double *p)
{
    double bary[3], distance2;
    (void)iccp_facet_tree_nearest(tree, p, bary, &distance2);
    const double share = sqrt(distance2) / r->limits.off[side];
    r->off = iccp_max(r->off, share);
    return share > 1;
}

/* Tests the middles of the triangles and of their sides. */
static void look_at_middles(rounds *r, const iccp_facet_tree *given, const iccp_common_surface *c,
                            int side)
{
    for (size_t f = 0; f < c->n_faces; ++f) {
        const uint32_t *const v = c->faces + 3 * f;
        double middle[4][3];
        bool far_off = false;
        for (size_t k = 0; k < 3; ++k) {
            double p[3];
            for (int i = 0; i < 3; ++i)
                p[i] = c->x[side][3 * (size_t)v[i] + k];
            for (int i = 0; i < 3; ++i)
                middle[i][k] = 0.5 * (p[i] + p[(i + 1) % 3]);
            middle[3][k] = (p[0] + p[1] + p[2]) / 3;
        }
        for (int i = 0; i < 4; ++i)
            far_off = is_far(r, side, given, middle[i]) || far_off;
        for (int i = 0; i < 3 && far_off; ++i)
            r->is_bad[v[i]] = 1;
        r->any = r->any || far_off;
    }
}

/* Measures how far the surfaces are from each other. *any_more becomes true if more vertices must
 * be kept. Returns false if there is no memory. */
static bool measure(rounds *r, const iccp_common_surface *c, bool *any_more,
                    const iccp_memory *memory)
{
    bool has_memory = true;
    r->off = 0;
    for (int side = 0; side < 2 && has_memory; ++side) {
        iccp_facet_tree given, now;
        iccp_facet_tree_create(&given, 3, r->x[side], r->given[side]->n_faces,
                               r->given[side]->origin, memory);
        iccp_facet_tree_create(&now, 3, c->x[side], c->n_faces, c->faces, memory);
        has_memory = given.boxes != NULL && now.boxes != NULL;
        if (has_memory) {
            look_at_middles(r, &given, c, side);
            for (size_t v = 0; v < r->whole->n_vertices; ++v)
                if (is_far(r, side, &now, r->whole->x[side] + 3 * v)) {
                    *any_more = *any_more || r->keep[v] == 0;
                    r->keep[v] = r->any = 1;
                }
        }
        iccp_facet_tree_free(&given, memory);
        iccp_facet_tree_free(&now, memory);
    }
    return has_memory;
}

/* ---- rounds ---- */

static icc_status simplify(rounds *r, iccp_common_surface *c, const iccp_env *env)
{
    iccp_common_surface_free(c, &env->memory);
    icc_status status = iccp_common_surface_copy(c, r->whole, &env->memory);
    if (status == ICC_OK)
        status = iccp_simplify(c, r->became, r->given, r->x, &r->limits, env);
    if (status != ICC_OK)
        return status;
    memset(r->is_bad, 0, r->whole->n_vertices);
    r->any = false;
    return iccp_intersections_mark(r->is_bad, &r->any, c, &env->memory) ? ICC_OK : ICC_ERR_MEMORY;
}

/* Looks for intersections on the whole surfaces, which rounding may have caused. */
static icc_status look_for_flaws(rounds *r, const iccp_memory *memory)
{
    if (r->knows_flaws)
        return ICC_OK;
    r->knows_flaws = true;
    return iccp_intersections_mark(r->flawed, &r->has_flaws, r->whole, memory) ? ICC_OK
                                                                               : ICC_ERR_MEMORY;
}

/* Simplifies until no triangles meet and everything is close enough. *is_done tells if this
 * succeeded. */
static icc_status run(rounds *r, iccp_common_surface *c, bool *is_done, const iccp_env *env)
{
    icc_status status = ICC_OK;
    bool any_more = true;
    for (size_t k = 0; k < ROUNDS && !*is_done && any_more && status == ICC_OK; ++k) {
        const iccp_env part = iccp_round(env, k, 1);
        status = simplify(r, c, &part);
        if (status == ICC_OK && r->any)
            status = look_for_flaws(r, &env->memory);
        any_more = false;
        if (status == ICC_OK && !measure(r, c, &any_more, &env->memory))
            status = ICC_ERR_MEMORY;
        for (size_t v = 0; v < r->whole->n_vertices && status == ICC_OK; ++v)
            if (r->is_bad[r->became[v]] != 0 && r->flawed[v] == 0 && r->keep[v] == 0)
                r->keep[v] = any_more = true;
        *is_done = !r->any;
    }
    return status;
}

/* Exchanges c and `fine` if `fine` is close enough, as measured. */
static icc_status take_if_near(rounds *r, iccp_common_surface *c, iccp_common_surface *fine,
                               const iccp_memory *memory)
{
    const double off = r->off;
    bool any_more;
    if (!measure(r, fine, &any_more, memory))
        return ICC_ERR_MEMORY;
    if (r->off <= 1) {
        const iccp_common_surface coarse = *c;
        *c = *fine;
        *fine = coarse;
    } else {
        r->off = off;
    }
    return ICC_OK;
}

/* Optimises the shape of the result. If the energy rises too much, it starts again with more
 * caution, as for t08 without landmarks. If that does not help, the result stays as it was. */
static icc_status optimise(rounds *r, iccp_common_surface *c, const uint8_t *keep,
                           const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    uint8_t *const stays = iccp_alloc_zero(memory, c->n_vertices, sizeof *stays);
    uint32_t *const became = iccp_alloc(memory, c->n_vertices, sizeof *became);
    iccp_simplify_limits limits = r->limits;
    icc_status status = stays != NULL && became != NULL ? ICC_OK : ICC_ERR_MEMORY;
    limits.keep = stays;
    for (size_t v = 0; v < r->whole->n_vertices && keep != NULL && status == ICC_OK; ++v)
        if (keep[v] != 0)
            stays[r->became[v]] = keep[v];
    double rise = HUGE_VAL;
    for (iccp_patch_caution k = ICCP_PATCH_BOLD;
         k <= ICCP_PATCH_CALM && rise > most_rise && status == ICC_OK; ++k) {
        const iccp_env part = iccp_round(env, k, 1);
        iccp_common_surface fine;
        status = iccp_common_surface_copy(&fine, c, memory);
        if (status == ICC_OK)
            status = iccp_optimise_shape(&fine, became, &rise, k, r->whole, r->became, r->given,
                                         r->x, &limits, &part);
        if (status == ICC_OK && rise <= most_rise)
            status = take_if_near(r, c, &fine, memory);
        iccp_common_surface_free(&fine, memory);
    }
    iccp_free(memory, stays);
    iccp_free(memory, became);
    return status;
}

/* Vertices that are still bad count as flawed, and so do their neighbours in the whole. */
static void widen(rounds *r)
{
    const iccp_common_surface *const c = r->whole;
    for (size_t f = 0; f < c->n_faces; ++f) {
        const uint32_t *const v = c->faces + 3 * f;
        const uint8_t is_bad =
            r->is_bad[r->became[v[0]]] | r->is_bad[r->became[v[1]]] | r->is_bad[r->became[v[2]]];
        for (int i = 0; i < 3; ++i)
            r->flawed[v[i]] |= is_bad;
    }
}

/* Removes those vertices of the whole where triangles meet, then more around them as long as
 * triangles meet, and no others. If no triangles of the whole meet, it changes nothing. A
 * surface in tests/unit/match/test_match_surfaces.c needs this. */
static icc_status mend(rounds *r, const uint8_t *keep, iccp_common_surface *c, bool *is_done,
                       const iccp_env *env)
{
    const size_t n = r->whole->n_vertices;
    const double most[2] = {r->limits.off[0], r->limits.off[1]};
    double share = 1;
    bool any_more;
    icc_status status = look_for_flaws(r, &env->memory);
    if (status != ICC_OK || !r->has_flaws)
        return status;
    for (int k = 1; k < MENDS; ++k)
        share /= farther;
    for (size_t k = 0; k < MENDS && !*is_done && status == ICC_OK; ++k, share *= farther) {
        const iccp_env part = iccp_round(env, k, 1);
        for (size_t v = 0; v < n; ++v)
            r->keep[v] = r->flawed[v] == 0 || (keep != NULL && keep[v] != 0);
        for (int side = 0; side < 2; ++side)
            r->limits.off[side] = share * most[side];
        status = simplify(r, c, &part);
        *is_done = status == ICC_OK && !r->any;
        if (status == ICC_OK)
            widen(r);
    }
    for (int side = 0; side < 2; ++side)
        r->limits.off[side] = most[side];
    if (*is_done && !measure(r, c, &any_more, &env->memory))
        status = ICC_ERR_MEMORY;
    *is_done = *is_done && r->off <= 1;
    return status;
}

icc_status iccp_simplify_apart(iccp_common_surface *common, double *off,
                               const iccp_half_edges *const given[2], const double *const x[2],
                               const iccp_simplify_limits *limits, bool only_flaws,
                               const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n = common->n_vertices;
    rounds r = {.whole = common, .given = given, .x = x, .limits = *limits};
    iccp_common_surface coarse = {0};
    bool is_done = false;
    icc_status status = ICC_ERR_MEMORY;
    r.keep = iccp_alloc_zero(memory, n, sizeof *r.keep);
    r.is_bad = iccp_alloc(memory, n, sizeof *r.is_bad);
    r.flawed = iccp_alloc_zero(memory, n, sizeof *r.flawed);
    r.became = iccp_alloc(memory, n, sizeof *r.became);
    if (r.keep != NULL && r.is_bad != NULL && r.flawed != NULL && r.became != NULL) {
        if (limits->keep != NULL)
            memcpy(r.keep, limits->keep, n * sizeof *r.keep);
        r.limits.keep = r.keep;
        status = only_flaws ? ICC_OK : run(&r, &coarse, &is_done, env);
        if (status == ICC_OK && is_done)
            status = optimise(&r, &coarse, limits->keep, env);
        else if (status == ICC_OK)
            status = mend(&r, limits->keep, &coarse, &is_done, env);
    }
    *off = 0;
    if (status == ICC_OK && is_done) {
        iccp_common_surface_free(common, memory);
        *common = coarse;
        *off = r.off;
    } else {
        iccp_common_surface_free(&coarse, memory);
    }
    iccp_free(memory, r.keep);
    iccp_free(memory, r.is_bad);
    iccp_free(memory, r.flawed);
    iccp_free(memory, r.became);
    return status;
}
