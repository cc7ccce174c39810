/* Reduces two surfaces to the same few triangles, and draws these on the sphere. Based on: V.
 * Kraevoy, A. Sheffer, Cross-Parameterization and Compatible Remeshing of 3D Models, 2004, for a
 * base that both surfaces have in common. Here both surfaces are made coarse along their paths
 * until only the base is left. The base is drawn on the sphere once. */
#include "match/sphere/landmark_base.h"

#include "base/error.h"
#include "match/sphere/decimate.h"
#include "match/sphere/landmark_paths.h"
#include "match/sphere/sphere.h"

#include <math.h>
#include <string.h>

/* Starts are tried until no path is longer on one surface than on the other by more than this
 * factor. If none succeeds, the best start is taken. For even paths the start matters little, so
 * the first one is taken. */
static const double good_ratio = 1.5;
enum { TRIES = 6 };

/* Returns true if both surfaces, which have only landmarks left, have the same triangles. */
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

/* Removes vertices that were added to edges for paths, if no path uses them. */
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

/* Paths that begin at different landmarks may pass a limb on different sides. The ratio of their
 * lengths shows this. Paths from a later landmark are taken for t01 with 2 landmarks and t07 with
 * 4. */
static icc_status find_paths(iccp_split_surface s[2], const iccp_half_edges *const given[2],
                             const double *const x[2], const double scale[2], size_t n,
                             const uint32_t *const vertices[2], double most_ratio,
                             uint32_t (*ends)[2], uint8_t *joined, double *worst,
                             const iccp_env *env, icc_error *err)
{
    const bool is_even = most_ratio < HUGE_VAL;
    const size_t tries = is_even ? 0 : n < TRIES ? n : TRIES;
    double least = most_ratio;
    uint32_t best = 0, root = 0;
    iccp_paths_report report;
    icc_status status = ICC_OK;
    for (size_t k = 0; k <= tries; ++k, ++root) {
        const iccp_env part = iccp_round(env, k, 1);
        if (k == tries)
            root = best;
        for (int side = 0; side < 2; ++side) {
            iccp_split_surface_free(&s[side]);
            if (!iccp_split_surface_create(&s[side], given[side], x[side], &env->memory))
                return iccp_fail_memory(err);
        }
        status = iccp_landmark_paths(s, n, vertices, scale, root, is_even,
                                     k == tries ? most_ratio : least, ends, joined, &report, &part);
        if (status == ICC_OK && report.worst < least) {
            least = report.worst;
            best = root;
        }
        if ((status == ICC_OK && least < good_ratio) ||
            (status != ICC_OK && status != ICC_ERR_RESOLUTION))
            break;
    }
    *worst = report.worst;
    if (status != ICC_ERR_RESOLUTION)
        return iccp_explain(err, status);
    status = iccp_fail_at(err, status, ICC_ITEM_POINT, report.landmark,
                          "the paths between landmarks take too many vertices: these are not in "
                          "corresponding places");
    return iccp_fail_side(err, status, report.side + 1);
}

/* Draws the base by the shape of the first surface. */
static icc_status draw(iccp_landmark_base *b, double scale, size_t n,
                       const uint32_t *const vertices[2], const iccp_env *env, icc_error *err)
{
    for (int side = 0; side < 2; ++side) {
        b->directions[side] =
            iccp_alloc_zero(&env->memory, b->s[side].n_vertices, 3 * sizeof *b->directions[side]);
        if (b->directions[side] == NULL)
            return iccp_fail_memory(err);
    }
    icc_status status = iccp_explain(err, iccp_decimate(&b->m[0], b->s[0].x, 4, env));
    if (status == ICC_OK)
        status = iccp_sphere_grow(b->directions[0], &b->m[0], b->s[0].x, scale, NULL, false, n, env,
                                  err);
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        memcpy(b->directions[1] + 3 * (size_t)vertices[1][k],
               b->directions[0] + 3 * (size_t)vertices[0][k], 3 * sizeof(double));
    return status;
}

icc_status iccp_landmark_base_create(iccp_landmark_base *b, const iccp_half_edges *const given[2],
                                     const double *const x[2], const double scale[2], size_t n,
                                     const uint32_t *const vertices[2], double most_ratio,
                                     const iccp_env *env, icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    iccp_env parts[3];
    *b = (iccp_landmark_base){.s = {{.memory = *memory}, {.memory = *memory}},
                              .m = {{.memory = *memory}, {.memory = *memory}}};
    iccp_split(parts, 3, (const double[]){4, 4, 1}, env);
    uint32_t(*const ends)[2] = iccp_alloc(memory, 3 * n - 6, sizeof *ends);
    uint8_t *const joined = iccp_alloc(memory, n * n, sizeof *joined);
    icc_status status = ends == NULL || joined == NULL
                            ? iccp_fail_memory(err)
                            : find_paths(b->s, given, x, scale, n, vertices, most_ratio, ends,
                                         joined, &b->worst, &parts[0], err);
    if (status == ICC_OK)
        status = shrink(b->m, b->s, n, (const uint32_t(*)[2])ends, joined, &parts[1], err);
    if (status == ICC_OK && !is_same_base(b->m, b->s, n, vertices))
        status = iccp_fail(err, ICC_ERR_CERTIFICATE,
                           "two surfaces that are shrunk to their landmarks differ");
    if (status == ICC_OK)
        status = draw(b, scale[0], n, vertices, &parts[2], err);
    iccp_free(memory, ends);
    iccp_free(memory, joined);
    return status;
}

void iccp_landmark_base_free(iccp_landmark_base *b, const iccp_memory *memory)
{
    for (int side = 0; side < 2; ++side) {
        iccp_half_edges_free(&b->m[side]);
        iccp_split_surface_free(&b->s[side]);
        iccp_free(memory, b->directions[side]);
        b->directions[side] = NULL;
    }
}
