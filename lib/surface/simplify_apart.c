#include "surface/simplify_apart.h"

#include "base/minmax.h"
#include "domain/facet_tree.h"
#include "domain/simplicial.h"
#include "domain/triangles.h"

#include <string.h>

/* Rounds, in each of which more vertices stay, until nothing goes. */
enum { ROUNDS = 12 };

typedef struct rounds {
    const iccp_common_surface *whole;
    const iccp_half_edges *const *given;
    const double *const *x;
    iccp_simplify_limits limits;
    uint8_t *keep;    /* by vertex of the whole */
    uint8_t *is_bad;  /* by vertex of what is left */
    uint32_t *became; /* by vertex of the whole */
    bool any;         /* something is bad */
    double off;
} rounds;

static icc_status copy(iccp_common_surface *to, const iccp_common_surface *c,
                       const iccp_memory *memory)
{
    bool has_memory = true;
    *to = (iccp_common_surface){.n_vertices = c->n_vertices, .n_faces = c->n_faces};
    to->faces = iccp_alloc(memory, c->n_faces, 3 * sizeof *to->faces);
    for (int side = 0; side < 2; ++side) {
        to->x[side] = iccp_alloc(memory, c->n_vertices, 3 * sizeof *to->x[side]);
        to->origin[side] = iccp_alloc(memory, c->n_vertices, sizeof *to->origin[side]);
        to->within[side] = iccp_alloc(memory, c->n_faces, sizeof *to->within[side]);
        has_memory = has_memory && to->x[side] != NULL && to->origin[side] != NULL &&
                     to->within[side] != NULL;
    }
    if (!has_memory || to->faces == NULL)
        return ICC_ERR_MEMORY;
    memcpy(to->faces, c->faces, 3 * c->n_faces * sizeof *to->faces);
    for (int side = 0; side < 2; ++side) {
        memcpy(to->x[side], c->x[side], 3 * c->n_vertices * sizeof *to->x[side]);
        memcpy(to->origin[side], c->origin[side], c->n_vertices * sizeof *to->origin[side]);
        memcpy(to->within[side], c->within[side], c->n_faces * sizeof *to->within[side]);
    }
    return ICC_OK;
}

/* ---- what meets ---- */

/* Marks the corners of triangles that meet others, or have no area; whether there are any. */
static bool mark_meeting(const iccp_facet_tree *tree, uint8_t *is_bad)
{
    bool any = false;
    for (size_t place = 0; place < tree->n; ++place) {
        const uint32_t f = iccp_facet_at(tree, place);
        const uint32_t *const s = tree->facets + 3 * (size_t)f;
        iccp_facet_query query;
        uint32_t g = f;
        if (!iccp_simplicial_has_area(tree, f)) {
            any = true;
            is_bad[s[0]] = is_bad[s[1]] = is_bad[s[2]] = 1;
            continue;
        }
        iccp_facet_query_start_after(&query, tree, place);
        while (iccp_facet_query_next(&query, &g)) {
            const uint32_t *const t = tree->facets + 3 * (size_t)g;
            if (!iccp_simplicial_has_area(tree, g) || !iccp_triangles_meet(tree->vertices, s, t))
                continue;
            any = true;
            for (int i = 0; i < 3; ++i)
                is_bad[s[i]] = is_bad[t[i]] = 1;
        }
    }
    return any;
}

/* Looks for what meets on either side; whether there is memory. */
static bool look_for_meeting(rounds *r, const iccp_common_surface *c, const iccp_memory *memory)
{
    bool has_memory = true;
    for (int side = 0; side < 2 && has_memory; ++side) {
        iccp_facet_tree tree;
        iccp_facet_tree_create(&tree, 3, c->x[side], c->n_faces, c->faces, memory);
        has_memory = tree.boxes != NULL;
        if (has_memory && mark_meeting(&tree, r->is_bad))
            r->any = true;
        iccp_facet_tree_free(&tree, memory);
    }
    return has_memory;
}

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

/* Looks how far the surfaces are off; whether there is memory. */
static bool measure(rounds *r, const iccp_common_surface *c, const iccp_memory *memory)
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
                if (is_far(r, side, &now, r->whole->x[side] + 3 * v))
                    r->keep[v] = r->any = 1;
        }
        iccp_facet_tree_free(&given, memory);
        iccp_facet_tree_free(&now, memory);
    }
    return has_memory;
}

/* ---- rounds ---- */

/* Simplifies until nothing meets and all is near enough; *is_done if that has come about. */
static icc_status run(rounds *r, iccp_common_surface *c, bool *is_done, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    icc_status status = ICC_OK;
    *is_done = false;
    for (size_t k = 0; k < ROUNDS && !*is_done && status == ICC_OK; ++k) {
        const iccp_env part = iccp_round(env, k, 1);
        iccp_common_surface_free(c, memory);
        status = copy(c, r->whole, memory);
        if (status == ICC_OK)
            status = iccp_simplify(c, r->became, r->given, r->x, &r->limits, &part);
        if (status != ICC_OK)
            continue;
        memset(r->is_bad, 0, r->whole->n_vertices);
        r->any = false;
        if (!look_for_meeting(r, c, memory) || !measure(r, c, memory))
            status = ICC_ERR_MEMORY;
        for (size_t v = 0; v < r->whole->n_vertices; ++v)
            if (r->is_bad[r->became[v]] != 0)
                r->keep[v] = 1;
        *is_done = !r->any;
    }
    return status;
}

icc_status iccp_simplify_apart(iccp_common_surface *common, double *off,
                               const iccp_half_edges *const given[2], const double *const x[2],
                               const iccp_simplify_limits *limits, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n = common->n_vertices;
    rounds r = {.whole = common, .given = given, .x = x, .limits = *limits};
    iccp_common_surface coarse = {0};
    bool is_done = false;
    icc_status status = ICC_ERR_MEMORY;
    r.keep = iccp_alloc_zero(memory, n, sizeof *r.keep);
    r.is_bad = iccp_alloc(memory, n, sizeof *r.is_bad);
    r.became = iccp_alloc(memory, n, sizeof *r.became);
    if (r.keep != NULL && r.is_bad != NULL && r.became != NULL) {
        if (limits->keep != NULL)
            memcpy(r.keep, limits->keep, n * sizeof *r.keep);
        r.limits.keep = r.keep;
        status = run(&r, &coarse, &is_done, env);
    }
    if (status == ICC_OK && is_done) {
        iccp_common_surface_free(common, memory);
        *common = coarse;
        *off = r.off;
    } else {
        iccp_common_surface_free(&coarse, memory);
        *off = 0;
    }
    iccp_free(memory, r.keep);
    iccp_free(memory, r.is_bad);
    iccp_free(memory, r.became);
    return status;
}
