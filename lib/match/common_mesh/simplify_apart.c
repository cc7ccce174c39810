#include "match/common_mesh/simplify_apart.h"

#include "base/minmax.h"
#include "geometry/facet_tree.h"
#include "match/common_mesh/intersections.h"
#include "match/common_mesh/optimise_shape.h"

#include <string.h>

/* In each of which more vertices stay, until nothing goes. */
enum { ROUNDS = 12 };

/* Where the whole is mended vertices go as little off as they can: so many times as far in each
 * round as in the one before, up to what is allowed. */
enum { MENDS = 7 };
static const double farther = 10;

/* The mean energy of the map becomes at most so many times what it was by touching up. */
static const double most_rise = 1.03;

typedef struct rounds {
    const iccp_common_surface *whole;
    const iccp_half_edges *const *given;
    const double *const *x;
    iccp_simplify_limits limits;
    uint8_t *keep;    /* by vertex of the whole */
    uint8_t *is_bad;  /* by vertex of what is left */
    uint32_t *became; /* by vertex of the whole */
    uint8_t *flawed;  /* by vertex of the whole: it is bad there, once that has been looked at */
    bool knows_flaws, has_flaws;
    bool any; /* something is bad */
    double off;
} rounds;

/* ---- what is far off ---- */

/* Whether a point is too far from the surface of a tree. */
static bool is_far(rounds *r, int side, const iccp_facet_tree *tree, const double *p)
{
    double bary[3], distance2;
    (void)iccp_facet_tree_nearest(tree, p, bary, &distance2);
    const double share = sqrt(distance2) / r->limits.off[side];
    r->off = iccp_max(r->off, share);
    return share > 1;
}

/* The middles of the triangles and of their sides. */
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

/* Looks how far the surfaces are off; *any_more if more has to stay. Whether there is memory. */
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

/* Rounding may have brought together what is on the whole surfaces. */
static icc_status look_for_flaws(rounds *r, const iccp_memory *memory)
{
    if (r->knows_flaws)
        return ICC_OK;
    r->knows_flaws = true;
    return iccp_intersections_mark(r->flawed, &r->has_flaws, r->whole, memory) ? ICC_OK
                                                                               : ICC_ERR_MEMORY;
}

/* Simplifies until nothing meets and all is near enough; *is_done if that has come about. */
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

/* Puts `fine` in the place of c, and c in its, if it is near enough as measured. */
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

/* Touches up what is done, and anew, with more and more caution, if the energy rises too much; if
 * it still does it stays as it was. */
static icc_status touch_up(rounds *r, iccp_common_surface *c, const uint8_t *keep,
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

/* What is still bad, and what is next to it in the whole, is flawed, too. */
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

/* Takes away of the whole what meets there, and more round it as long as something meets, and
 * nothing else. The whole stays where nothing does. */
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
            status = touch_up(&r, &coarse, limits->keep, env);
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
