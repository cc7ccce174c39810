/* Matches two closed surfaces in space. Both surfaces are drawn on the sphere (match/sphere_pair.h)
 * and cut by each other (match/common_mesh/sphere_overlay.h), which gives them the same triangles.
 * Then vertices that are not needed are removed (match/common_mesh/simplify_apart.h). */
#include "match/surfaces.h"

#include "base/error.h"
#include "base/minmax.h"
#include "match/common_mesh/simplify_apart.h"
#include "match/sphere/landmark_paths.h"
#include "match/sphere_pair.h"
#include "match/surface/corner_angle.h"
#include "match/surface/stretch.h"
#include "math/elementary.h"

/* As a share of the diagonal. */
static const double default_tolerance = 1e-3;

/* The longest new edge. It is this share of the diagonal, or `times_given` times the mean length of
 * given edges, or the longest given edge if the source is kept. The map between the surfaces bends
 * at vertices only, so long edges would make it coarse. */
static const double longest_edge = 0.05, times_given = 2;

/* The most crossings of the two drawings, for each vertex. A map of low distortion has 3. */
enum { MOST_CROSSINGS = 200 };

static double diagonal_of(const iccp_body *b)
{
    return iccp_vec_distance(3, b->domain->lower, b->domain->upper);
}

static double edge_length(const iccp_body *b, uint32_t h)
{
    return iccp_vec_distance(3, b->x + 3 * (size_t)b->m.origin[h],
                             b->x + 3 * (size_t)iccp_edge_end(&b->m, h));
}

static double mean_given(const iccp_body *b)
{
    double sum = 0;
    for (uint32_t h = 0; h < 3 * b->m.n_faces; ++h)
        sum += edge_length(b, h);
    return sum / (3 * (double)b->m.n_faces);
}

static double longest_given(const iccp_body *b)
{
    double longest = 0;
    for (uint32_t h = 0; h < 3 * b->m.n_faces; ++h)
        longest = iccp_max(longest, edge_length(b, h));
    return longest;
}

static icc_status cut(iccp_common_surface *common, const iccp_body bodies[2], const iccp_env *env,
                      icc_error *err)
{
    const iccp_half_edges *const m[2] = {&bodies[0].m, &bodies[1].m};
    const double *const directions[2] = {bodies[0].directions, bodies[1].directions};
    const double *const x[2] = {bodies[0].x, bodies[1].x};
    const size_t most = MOST_CROSSINGS * (m[0]->n_left + m[1]->n_left);
    iccp_sphere_overlay overlay;
    icc_status status = iccp_sphere_overlay_create(&overlay, m, directions, most, env, err);
    if (status == ICC_OK)
        status = iccp_common_surface_create(common, &overlay, m, directions, x, &env->memory, err);
    iccp_sphere_overlay_free(&overlay, &env->memory);
    for (int side = 0; side < 2; ++side)
        for (size_t v = 0; v < common->n_vertices; ++v) {
            const iccp_frame *const frame = &bodies[side].domain->frame;
            double *const p = common->x[side] + 3 * v;
            /* Vertices in the middle of edges were not given. */
            if (common->origin[side][v] >= bodies[side].domain->n_vertices)
                common->origin[side][v] = ICCP_NO_EDGE;
            /* New vertices are rounded as the caller will see them. So intersections that the
             * caller would see are found here. */
            if (common->origin[side][v] == ICCP_NO_EDGE) {
                iccp_frame_out(frame, 3, p, p);
                iccp_frame_in(frame, 3, p, p);
            }
        }
    return status;
}

/* ---- report ---- */

static void gather_corners(const double *p[2][3], const iccp_common_surface *c, size_t face)
{
    for (int side = 0; side < 2; ++side)
        for (size_t i = 0; i < 3; ++i)
            p[side][i] = c->x[side] + 3 * (size_t)c->faces[3 * face + i];
}

/* Energy, slopes and angles of the common triangles. The stretch is known once the areas are. */
static void measure(icc_match_info *info, const iccp_common_surface *c)
{
    const double *p[2][3];
    double area[2] = {0, 0}, normal[3], least_sine = 1, sum = 0;
    for (size_t f = 0; f < c->n_faces; ++f) {
        gather_corners(p, c, f);
        for (int side = 0; side < 2; ++side) {
            iccp_triangle_normal(normal, p[side][0], p[side][1], p[side][2]);
            area[side] += iccp_vec_norm(3, normal);
            least_sine = iccp_min(least_sine, iccp_least_sine(p[side][0], p[side][1], p[side][2]));
        }
    }
    const double scale = sqrt(area[0] / area[1]);
    for (size_t f = 0; f < c->n_faces; ++f) {
        gather_corners(p, c, f);
        const iccp_stretch t = iccp_stretch_of(p[0], p[1], scale);
        const double slope = t.twice[1] / t.twice[0];
        sum += t.twice[0] * t.energy;
        info->least_slope = f == 0 ? slope : iccp_min(info->least_slope, slope);
        info->most_slope = f == 0 ? slope : iccp_max(info->most_slope, slope);
    }
    info->energy = sum / area[0];
    info->least_angle =
        360 * iccp_atan2_turns(least_sine, sqrt(iccp_max(0, 1 - least_sine * least_sine)));
}

static void fill_in(icc_match_info *info, const iccp_common_surface *c, double off)
{
    info->dim = 3;
    info->cost = info->second = info->sure = HUGE_VAL;
    info->n_vertices = c->n_vertices;
    info->off = off;
    for (size_t v = 0; v < c->n_vertices; ++v)
        info->n_joined += c->origin[0][v] != ICCP_NO_EDGE && c->origin[1][v] != ICCP_NO_EDGE;
    measure(info, c);
}

/* Makes a domain from a common surface, in the caller's coordinates. Given vertices keep the bits
 * with which they were given. */
static icc_status make_domain(icc_domain **out, iccp_common_surface *c, int side,
                              const iccp_body *b, const iccp_env *env, icc_error *err)
{
    for (size_t v = 0; v < c->n_vertices; ++v) {
        double *const p = c->x[side] + 3 * v;
        if (c->origin[side][v] != ICCP_NO_EDGE)
            iccp_domain_given(b->domain, c->origin[side][v], p);
        else
            iccp_frame_out(&b->domain->frame, 3, p, p);
    }
    const icc_status status =
        iccp_domain_create(out, 3, c->n_vertices, c->x[side], c->n_faces, c->faces, env, err);
    return status == ICC_OK ? status : iccp_fail_side(err, status, side + 1);
}

/* ---- from beginning to end ---- */

/* Keeps landmarks on both sides, and all vertices of the source if it is to be kept. */
static void find_kept(uint8_t *keep, const iccp_common_surface *c, size_t n_landmarks,
                      const uint32_t *landmarks, bool keep_source)
{
    for (size_t v = 0; v < c->n_vertices; ++v) {
        keep[v] = keep_source && c->origin[0][v] != ICCP_NO_EDGE;
        for (size_t k = 0; k < n_landmarks && c->origin[1][v] != ICCP_NO_EDGE; ++k)
            if (c->origin[0][v] == landmarks[k])
                keep[v] = 3;
    }
}

/* Leaves as few vertices as needed, besides those to be kept. If the source is kept, the target
 * alone decides how many are needed. */
static icc_status simplify(iccp_common_surface *common, double *off, const iccp_body bodies[2],
                           size_t n_landmarks, double tolerance, bool keep_source,
                           const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    const double most_off = tolerance > 0 ? tolerance : default_tolerance;
    iccp_kept_cells cells = {NULL, NULL};
    uint8_t *const keep = iccp_alloc(memory, common->n_vertices, sizeof *keep);
    iccp_simplify_limits limits = {.keep = keep, .cells = keep_source ? &cells : NULL};
    icc_status status = keep != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        find_kept(keep, common, n_landmarks, bodies[0].landmarks, keep_source);
    if (status == ICC_OK && keep_source &&
        !iccp_kept_cells_create(&cells, common, bodies[0].domain->facets, bodies[0].split.part_of,
                                memory))
        status = ICC_ERR_MEMORY;
    for (int side = 0; side < 2; ++side) {
        const double diagonal = diagonal_of(&bodies[side]);
        const double given = keep_source
                                 ? longest_given(&bodies[0]) * diagonal / diagonal_of(&bodies[0])
                                 : mean_given(&bodies[side]);
        limits.off[side] = most_off * diagonal;
        limits.edge[side] = iccp_max(longest_edge * diagonal, times_given * given);
    }
    if (status == ICC_OK)
        status = iccp_simplify_apart(
            common, off, (const iccp_half_edges *const[]){&bodies[0].m, &bodies[1].m},
            (const double *const[]){bodies[0].x, bodies[1].x}, &limits, tolerance < 0, env);
    iccp_kept_cells_free(&cells, memory);
    iccp_free(memory, keep);
    *off *= most_off;
    return status;
}

static icc_status run(icc_match *match, iccp_body bodies[2], iccp_common_surface *common,
                      size_t n_landmarks, const double *landmarks, const icc_match_options *options,
                      const iccp_env *env, icc_error *err)
{
    const double tolerance = options->tolerance == 0 ? default_tolerance : options->tolerance;
    iccp_env parts[4];
    iccp_split(parts, 4, (const double[]){10, 2, 20, 1}, env);
    for (int k = 0; k < 4; ++k)
        parts[k].stage = "match";
    double off = 0;
    icc_status status = iccp_sphere_pair_draw(bodies, n_landmarks, landmarks, &parts[0], err);
    if (status == ICC_OK)
        status = cut(common, bodies, &parts[1], err);
    if (status != ICC_OK)
        return status;
    match->info.n_overlay = common->n_vertices;
    status = iccp_explain(err, simplify(common, &off, bodies, n_landmarks, tolerance,
                                        options->keep_source != 0, &parts[2]));
    if (status != ICC_OK)
        return status;
    fill_in(&match->info, common, off);
    match->info.n_landmarks = n_landmarks;
    match->n = common->n_vertices;
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        status = make_domain(&match->domain[side], common, side, &bodies[side], &parts[3], err);
        match->origin[side] = common->origin[side];
        common->origin[side] = NULL;
    }
    return status;
}

icc_status iccp_match_surfaces(icc_match *match, const icc_domain *source, const icc_domain *target,
                               size_t n_landmarks, const double *landmarks,
                               const icc_match_options *options, const iccp_env *env,
                               icc_error *err)
{
    if (n_landmarks > ICCP_MOST_SURFACE_LANDMARKS)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, ICCP_MOST_SURFACE_LANDMARKS,
                            "%zu landmarks in space are too many; at most %d", n_landmarks,
                            ICCP_MOST_SURFACE_LANDMARKS);
    iccp_body bodies[2] = {{0}, {0}};
    iccp_common_surface common = {0};
    icc_status status = iccp_sphere_pair_create(bodies, source, target, env, err);
    if (status == ICC_OK)
        status = run(match, bodies, &common, n_landmarks, landmarks, options, env, err);
    iccp_common_surface_free(&common, &env->memory);
    iccp_sphere_pair_free(bodies, &env->memory);
    return status;
}
