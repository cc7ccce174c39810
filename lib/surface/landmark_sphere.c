/* Based on: V. Kraevoy, A. Sheffer, Cross-Parameterization and Compatible Remeshing of 3D Models,
 * 2004, for a base that both surfaces have in common; here both are made coarse along its paths
 * until nothing else is left, it is drawn on the sphere once, and both grow from there, each moved
 * on the other, so that every face is positive at any time. */
#include "surface/landmark_sphere.h"

#include "base/error.h"
#include "base/minmax.h"
#include "surface/decimate.h"
#include "surface/landmark_paths.h"
#include "surface/relax.h"
#include "surface/sphere.h"

#include <string.h>

/* Each drawing is first moved on the other when there are so many vertices, of a base and for each
 * landmark; then whenever there are so many times as many, oftener while there are no more than
 * MANY, which costs little and decides how limbs come to lie; in so many rounds at most. */
enum { FEW = 120, FEW_EACH = 12, MANY = 6000, ROUNDS_OF_FEW = 200, ROUNDS = 30 };
static const double finer = 1.6, finer_of_few = 1.3;

/* While there are few both ways are tried: with steps as long as later, and with shorter ones. A
 * limb may come to lie beside its partner with either, and never comes back. */
static const double lengths[2] = {ICCP_LONGER, 1.25};

/* Landmarks where paths may begin are tried until no path is so many times as long on one surface
 * as on the other, or the best one of so many is taken. */
static const double good_ratio = 1.5;
enum { TRIES = 6 };

/* Whether both surfaces, of which landmarks alone are left, have the same triangles. */
static bool is_same_base(const iccp_half_edges m[2], const iccp_split_surface s[2], size_t n,
                         const uint32_t *const vertices[2])
{
    for (size_t k = 0; k < n; ++k) {
        const uint32_t v = vertices[0][k], w = vertices[1][k];
        if (m[0].degree[v] != m[1].degree[w])
            return false;
        uint32_t h = m[0].out[v], g = m[1].out[w];
        const uint32_t first = s[0].holder[iccp_edge_end(&m[0], h)];
        uint32_t turns = 0;
        while (s[1].holder[iccp_edge_end(&m[1], g)] != first && turns++ < m[1].degree[w])
            g = iccp_edge_turn(&m[1], g);
        for (uint32_t i = 0; i < m[0].degree[v]; ++i) {
            if (s[0].holder[iccp_edge_end(&m[0], h)] != s[1].holder[iccp_edge_end(&m[1], g)])
                return false;
            h = iccp_edge_turn(&m[0], h);
            g = iccp_edge_turn(&m[1], g);
        }
    }
    return true;
}

/* Takes away what has been put into edges to make room for paths, where no path has come. */
static void unite(iccp_split_surface *s, const iccp_decimate_web *web)
{
    for (uint32_t v = (uint32_t)s->n_vertices; v-- > s->n_given;)
        if (s->holder[v] == ICCP_NO_EDGE && !iccp_share_path(web, s->halves[v][0], s->halves[v][1]))
            (void)iccp_split_unite(s, v);
}

static icc_status shrink(iccp_half_edges m[2], iccp_split_surface s[2], size_t n,
                         const uint32_t (*ends)[2], const uint8_t *joined, const iccp_env *env,
                         icc_error *err)
{
    for (int side = 0; side < 2; ++side) {
        const iccp_env part = iccp_part(env, NULL, 0.5 * side, 0.5 * side + 0.5);
        const iccp_decimate_web web = {s[side].holder, s[side].path, n, ends, joined};
        unite(&s[side], &web);
        icc_status status = iccp_half_edges_create(&m[side], s[side].n_vertices, s[side].n_faces,
                                                   s[side].origin, env, err);
        if (status != ICC_OK)
            return status;
        status = iccp_decimate_along(&m[side], s[side].x, &web, &part);
        if (status == ICC_ERR_RESOLUTION)
            return iccp_fail(err, status, "a surface cannot be shrunk to its landmarks");
        if (status != ICC_OK)
            return iccp_explain(err, status);
    }
    return ICC_OK;
}

/* Moves drawings of few vertices, from where they are, in several ways; the best one stays. */
static icc_status relax_few(iccp_relaxation *r, const iccp_env *env)
{
    enum { N = sizeof lengths / sizeof *lengths };
    const iccp_memory *const memory = &env->memory;
    double *kept[2], least = HUGE_VAL;
    size_t n[2];
    icc_status status = ICC_OK;
    for (int side = 0; side < 2; ++side) {
        n[side] = 3 * r->side[side].m->n_vertices;
        kept[side] = iccp_alloc(memory, 2 * n[side], sizeof *kept[side]);
        if (kept[side] == NULL)
            status = ICC_ERR_MEMORY;
        else
            memcpy(kept[side], r->side[side].directions, n[side] * sizeof *kept[side]);
    }
    /* Behind the directions at the beginning, the best ones so far. */
    for (size_t k = 0; k < N && status == ICC_OK; ++k) {
        const iccp_env part =
            iccp_part(env, NULL, (double)k / (double)N, (double)(k + 1) / (double)N);
        double energy;
        for (int side = 0; side < 2; ++side)
            memcpy(r->side[side].directions, kept[side], n[side] * sizeof *kept[side]);
        status = iccp_relax(r, lengths[k], ROUNDS_OF_FEW, &energy, &part);
        for (int side = 0; side < 2 && energy < least; ++side)
            memcpy(kept[side] + n[side], r->side[side].directions, n[side] * sizeof *kept[side]);
        least = iccp_min(least, energy);
    }
    for (int side = 0; side < 2; ++side) {
        if (least < HUGE_VAL)
            memcpy(r->side[side].directions, kept[side] + n[side], n[side] * sizeof *kept[side]);
        iccp_free(memory, kept[side]);
    }
    return status;
}

/* Both drawings get more and more vertices, and each is moved on the other whenever there are so
 * many times as many: how limbs come to lie is decided while there are few. */
static icc_status grow_together(iccp_relaxation *r, iccp_half_edges m[2], size_t n,
                                const iccp_env *env, icc_error *err)
{
    const size_t all[2] = {m[0].n_left + m[0].n_collapsed, m[1].n_left + m[1].n_collapsed};
    const double most = iccp_max((double)all[0], (double)all[1]);
    double level = iccp_max(FEW, FEW_EACH * (double)n), before = 0, left;
    icc_status status = ICC_OK;
    for (bool is_first = true; status == ICC_OK; is_first = false) {
        const double share = iccp_min(1, level / most);
        const iccp_env part = iccp_part(env, NULL, before, share);
        for (int side = 0; side < 2 && status == ICC_OK; ++side) {
            const iccp_drawn_surface *const d = &r->side[side];
            const size_t until = level < (double)all[side] ? (size_t)level : all[side];
            status = iccp_sphere_grow(d->directions, &m[side], d->x, d->scale, r->is_fixed[side],
                                      !is_first, until, &part, err);
        }
        if (status == ICC_OK)
            status = iccp_explain(err, is_first ? relax_few(r, &part)
                                                : iccp_relax(r, ICCP_LONGER, ROUNDS, &left, &part));
        if (!(share < 1))
            break;
        before = share;
        level *= level < MANY ? finer_of_few : finer;
    }
    for (int side = 0; side < 2 && status == ICC_OK; ++side)
        status = iccp_sphere_check(&m[side], r->side[side].directions, err);
    return status;
}

/* The base is drawn by the first surface, and both grow from it. */
static icc_status grow(double *const directions[2], iccp_half_edges m[2], const double scale[2],
                       const iccp_split_surface s[2], size_t n, const uint32_t *const vertices[2],
                       uint8_t *const is_fixed[2], const iccp_env *env, icc_error *err)
{
    iccp_env parts[2];
    iccp_drawn_surface side[2];
    iccp_split(parts, 2, (const double[]){1, 40}, env);
    icc_status status = iccp_explain(err, iccp_decimate(&m[0], s[0].x, 4, env));
    if (status == ICC_OK)
        status = iccp_sphere_grow(directions[0], &m[0], s[0].x, scale[0], NULL, false, n, &parts[0],
                                  err);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; k < n; ++k) {
        memcpy(directions[1] + 3 * (size_t)vertices[1][k],
               directions[0] + 3 * (size_t)vertices[0][k], 3 * sizeof(double));
        is_fixed[0][vertices[0][k]] = is_fixed[1][vertices[1][k]] = 1;
    }
    for (int k = 0; k < 2; ++k)
        side[k] = (iccp_drawn_surface){&m[k], s[k].x, directions[k], scale[k]};
    iccp_relaxation r;
    status = iccp_explain(
        err, iccp_relaxation_create(&r, side, (const uint8_t *const[]){is_fixed[0], is_fixed[1]},
                                    &env->memory));
    if (status == ICC_OK)
        status = grow_together(&r, m, n, &parts[1], err);
    iccp_relaxation_free(&r, &env->memory);
    return status;
}

/* Paths that begin at one landmark or another may go round different sides of a limb on the two
 * surfaces, which shows in their lengths. */
static icc_status find_paths(iccp_split_surface s[2], const iccp_half_edges *const given[2],
                             const double *const x[2], const double scale[2], size_t n,
                             const uint32_t *const vertices[2], uint32_t (*ends)[2],
                             uint8_t *joined, const iccp_env *env, icc_error *err)
{
    const size_t tries = n < TRIES ? n : TRIES;
    double least = HUGE_VAL;
    uint32_t best = 0, root = 0;
    icc_status status = ICC_OK;
    for (size_t k = 0; k <= tries; ++k, ++root) {
        const iccp_env part = iccp_round(env, k, 1);
        double worst;
        if (k == tries)
            root = best;
        for (int side = 0; side < 2; ++side) {
            iccp_split_surface_free(&s[side]);
            if (!iccp_split_surface_create(&s[side], given[side], x[side], &env->memory))
                return iccp_fail_memory(err);
        }
        status = iccp_landmark_paths(s, n, vertices, scale, root, k == tries ? HUGE_VAL : least,
                                     ends, joined, &worst, &part);
        if (status == ICC_OK && worst < least) {
            least = worst;
            best = root;
        }
        if ((status == ICC_OK && least < good_ratio) ||
            (status != ICC_OK && status != ICC_ERR_RESOLUTION))
            break;
    }
    return status == ICC_ERR_RESOLUTION
               ? iccp_fail(err, status,
                           "the paths between landmarks take too many vertices: these are not in "
                           "corresponding places")
               : iccp_explain(err, status);
}

icc_status iccp_landmark_sphere_draw(double *directions[2], iccp_half_edges m[2],
                                     iccp_split_surface s[2], const iccp_half_edges *const given[2],
                                     const double *const x[2], size_t n,
                                     const uint32_t *const vertices[2], const iccp_env *env,
                                     icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    iccp_env parts[3];
    const double scale[2] = {iccp_sphere_scale(given[0], x[0]), iccp_sphere_scale(given[1], x[1])};
    uint8_t *is_fixed[2] = {NULL, NULL};
    iccp_split(parts, 3, (const double[]){1, 1, 8}, env);
    uint32_t(*const ends)[2] = iccp_alloc(memory, 3 * n - 6, sizeof *ends);
    uint8_t *const joined = iccp_alloc(memory, n * n, sizeof *joined);
    icc_status status = ends == NULL || joined == NULL ? iccp_fail_memory(err)
                                                       : find_paths(s, given, x, scale, n, vertices,
                                                                    ends, joined, &parts[0], err);
    if (status == ICC_OK)
        status = shrink(m, s, n, (const uint32_t(*)[2])ends, joined, &parts[1], err);
    if (status == ICC_OK && !is_same_base(m, s, n, vertices))
        status = iccp_fail(err, ICC_ERR_CERTIFICATE,
                           "two surfaces that are shrunk to their landmarks differ");
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        const size_t n_vertices = s[side].n_vertices;
        directions[side] = iccp_alloc_zero(memory, n_vertices, 3 * sizeof *directions[side]);
        is_fixed[side] = iccp_alloc_zero(memory, n_vertices, sizeof *is_fixed[side]);
        if (directions[side] == NULL || is_fixed[side] == NULL)
            status = iccp_fail_memory(err);
    }
    if (status == ICC_OK)
        status = grow(directions, m, scale, s, n, vertices, is_fixed, &parts[2], err);
    iccp_free(memory, ends);
    iccp_free(memory, joined);
    for (int side = 0; side < 2; ++side)
        iccp_free(memory, is_fixed[side]);
    return status;
}
