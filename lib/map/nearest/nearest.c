/* Makes any plane map one-to-one.
 *
 * The folded regions are cut out and mapped anew, without the images inside them. That gives a
 * valid start whose class is that of the given map wherever it was one-to-one. From there, Newton's
 * method goes back towards the given images, as far as triangles stay positive. If the whole is one
 * folded region, it is mapped anew as a whole. */
#include "map/nearest/nearest.h"

#include "base/error.h"
#include "domain/outlines.h"
#include "icc/fit.h"
#include "map/energy/schedule.h"
#include "map/nearest/affine_frame.h"
#include "map/nearest/approach.h"
#include "map/nearest/insert_points.h"
#include "map/nearest/map_regions.h"

#include <math.h>
#include <string.h>

/* ROUNDS: of steps, each after passes of flips. PASSES: of flips at most. */
enum { ROUNDS = 2, PASSES = 5 };

/* Around the regions, rings of triangles move, too: at least LEAST_RINGS, and then as many as it
 * takes until they have as many triangles as the regions, but at most MOST_RINGS. */
enum { LEAST_RINGS = 3, MOST_RINGS = 20 };

/* An affine frame grows by this factor until all held images are inside, or WIDENINGS times. */
static const double WIDER = 1.25;
enum { WIDENINGS = 24 };

/* ---- the boundary ---- */

/* Returns ICC_ERR_BOUNDARY unless the images of the boundary bound a plane region. */
static icc_status check_boundary(const iccp_plmap *map, const iccp_env *env, icc_error *err)
{
    uint32_t *next = iccp_alloc(&env->memory, map->n_vertices, sizeof *next);
    iccp_outlines outlines = {.memory = env->memory};
    icc_status status = ICC_ERR_MEMORY;
    if (next != NULL) {
        (void)iccp_link_boundary(&map->corners, map->n_vertices, next);
        status = iccp_outlines_create(&outlines, map->n_vertices, next, &env->memory);
    }
    if (status == ICC_OK)
        status = iccp_outlines_check(&outlines, map->images, env, err);
    iccp_outlines_free(&outlines);
    iccp_free(&env->memory, next);
    return status;
}

/* ---- the start ---- */

/* Returns the work that may be in vain: as much as a whole map of the held images may cost. It ends
 * attempts to map points that are too tangled for doubles. */
static iccp_work allow_vain_work(const iccp_plmap *map)
{
    size_t n_fixed = 0;
    for (size_t v = 0; v < map->n_vertices; ++v)
        n_fixed += map->fixed[v] != ICCP_FREE;
    return (iccp_work){.left = iccp_allow(n_fixed).all};
}

/* Maps everything anew inside an affine image of the boundary. */
static icc_status fill_frame(iccp_pieces *pieces, const iccp_env *env)
{
    const iccp_affine_frame frame = iccp_affine_frame_find(pieces->map);
    double scale = 1;
    icc_status status = ICC_OK;
    pieces->regions.is_stuck = true;
    pieces->vain = allow_vain_work(pieces->map);
    for (int k = 0;
         status == ICC_OK && pieces->regions.is_stuck && pieces->vain.left > 0 && k < WIDENINGS;
         ++k) {
        iccp_affine_frame_set(&frame, scale, pieces->map);
        iccp_regions_take_all(&pieces->regions);
        status = iccp_pieces_fill(pieces, env);
        scale *= WIDER;
    }
    return status == ICC_OK && pieces->regions.is_stuck ? ICC_ERR_CERTIFICATE : status;
}

static void report_pieces(iccp_nearest_facts *facts, const iccp_pieces *pieces, bool is_whole)
{
    const iccp_simplicial_map map = iccp_plmap_simplicial(pieces->map);
    double area[2] = {0, 0};
    for (size_t t = 0; t < map.n_simplices; ++t) {
        double element[ICCP_ELEMENT(2)];
        iccp_simplicial_element(&map, t, element);
        area[pieces->regions.region[t] != UINT32_MAX] += element[0];
    }
    facts->n_patches = pieces->regions.n;
    facts->changed = area[1] / (area[0] + area[1]);
    facts->repair = is_whole || !(area[0] > 0) ? ICC_REPAIR_WHOLE : ICC_REPAIR_PATCHES;
}

/* Makes a one-to-one map with other images inside the folded regions. */
static icc_status start(iccp_plmap *map, bool needs_frame, bool boundary_moves, size_t *n_kept,
                        double **model, iccp_nearest_facts *facts, const iccp_env *env)
{
    iccp_pieces pieces;
    icc_status status = iccp_pieces_create(&pieces, map, env);
    if (status == ICC_OK && !needs_frame) {
        pieces.vain = allow_vain_work(map);
        status = iccp_pieces_fill(&pieces, env);
        needs_frame = pieces.regions.is_stuck;
        if (status == ICC_OK && needs_frame && !boundary_moves)
            status = ICC_ERR_CERTIFICATE;
    }
    if (status == ICC_OK && needs_frame)
        status = fill_frame(&pieces, env);
    if (status == ICC_OK) {
        report_pieces(facts, &pieces, needs_frame);
        status = iccp_pieces_glue(&pieces, n_kept, model, env);
    }
    iccp_pieces_free(&pieces);
    return status == ICC_OK && !iccp_plmap_is_positive(map) ? ICC_ERR_CERTIFICATE : status;
}

/* ---- back towards the model ---- */

/* Flips edges between triangles from number `first` on. */
static void flip_edges(iccp_plmap *map, size_t first)
{
    iccp_corners *c = &map->corners;
    size_t n = 1;
    for (int pass = 0; pass < PASSES && n > 0; ++pass) {
        n = 0;
        for (uint32_t k = 3 * (uint32_t)first; k < 3 * c->n_triangles; ++k)
            if (c->twin[k] != ICCP_NO_NEIGHBOUR && c->twin[k] >= 3 * first &&
                iccp_may_flip_to_delaunay(map, k)) {
                iccp_flip_edge(c, k);
                ++n;
            }
    }
}

/* Marks the vertices of the triangles from number `first` on, and of rings around them. */
static void mark_movable(uint8_t *movable, const iccp_plmap *map, size_t first)
{
    const uint32_t *v = map->corners.vertex;
    const size_t n = map->corners.n_triangles;
    memset(movable, 0, map->n_vertices);
    for (size_t c = 3 * first; c < 3 * n; ++c)
        movable[v[c]] = 1;
    size_t n_around = 0;
    for (int ring = 1; ring <= MOST_RINGS && (ring <= LEAST_RINGS || n_around < n - first);
         ++ring) {
        n_around = 0;
        for (size_t t = 0; t < first; ++t) {
            const uint32_t *own = v + 3 * t;
            const bool is_near = (movable[own[0]] != 0 && movable[own[0]] <= ring) ||
                                 (movable[own[1]] != 0 && movable[own[1]] <= ring) ||
                                 (movable[own[2]] != 0 && movable[own[2]] <= ring);
            n_around += is_near;
            for (size_t k = 0; is_near && k < 3; ++k)
                if (movable[own[k]] == 0)
                    movable[own[k]] = (uint8_t)(ring + 1);
        }
    }
}

/* Makes both areas the same, so that the energy measures shape alone. */
static double stretch_of(const iccp_plmap *map)
{
    iccp_simplicial_map s = iccp_plmap_simplicial(map);
    double area[2] = {0, 0};
    s.stretch = 1;
    for (size_t t = 0; t < s.n_simplices; ++t) {
        double element[ICCP_ELEMENT(2)], j[4];
        const double *image[3];
        iccp_simplicial_element(&s, t, element);
        iccp_simplicial_images(2, &s, t, image);
        area[0] += element[0];
        area[1] += element[0] * iccp_element_jacobian(2, element, image, j);
    }
    return sqrt(area[1] / area[0]);
}

static icc_status approach(iccp_plmap *map, size_t first, const double *model, bool boundary_moves,
                           iccp_nearest_facts *facts, const iccp_env *env)
{
    uint8_t *marks = iccp_alloc(&env->memory, map->n_vertices, 2), *movable = marks;
    icc_status status = marks != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t k = 0; status == ICC_OK && k < ROUNDS; ++k) {
        const iccp_env part = iccp_round(env, k, 1);
        uint8_t *fixed = marks + map->n_vertices;
        flip_edges(map, first);
        mark_movable(movable, map, first);
        for (size_t v = 0; v < map->n_vertices; ++v)
            fixed[v] =
                map->fixed[v] == ICCP_ON_POINT || (map->fixed[v] != ICCP_FREE && !boundary_moves);
        iccp_simplicial_map s = iccp_plmap_simplicial(map);
        s.fixed = fixed;
        s.plan = NULL;
        s.stretch = stretch_of(map);
        s.model = model;
        status = iccp_approach(&s, movable, k == 0, &facts->n_iterations, &part);
    }
    iccp_free(&env->memory, marks);
    return status;
}

/* Goes back towards the model. If the boundary meets itself then, it goes back to where it was. */
static icc_status improve(iccp_plmap *map, size_t n_kept, const double *model, bool boundary_moves,
                          iccp_nearest_facts *facts, const iccp_env *env)
{
    iccp_plmap begin = {.memory = env->memory};
    if (!boundary_moves)
        return approach(map, n_kept, model, false, facts, env);
    icc_status status = iccp_plmap_copy(&begin, map, &env->memory);
    if (status == ICC_OK)
        status = approach(map, n_kept, model, true, facts, env);
    if (status == ICC_OK)
        status = check_boundary(map, env, NULL);
    if (status == ICC_ERR_BOUNDARY) {
        const iccp_plmap other = *map;
        *map = begin;
        begin = other;
        status = approach(map, n_kept, model, false, facts, env);
    }
    iccp_plmap_free(&begin);
    return status;
}

/* ---- all of it ---- */

static icc_status repair(iccp_plmap *map, bool needs_frame, bool boundary_moves,
                         iccp_nearest_facts *facts, const iccp_env *env)
{
    double *model = iccp_alloc(&env->memory, map->n_vertices, 2 * sizeof *model);
    size_t n_kept = 0;
    iccp_env part[2];
    if (model == NULL)
        return ICC_ERR_MEMORY;
    memcpy(model, map->images, 2 * map->n_vertices * sizeof *model);
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = start(map, needs_frame, boundary_moves, &n_kept, &model, facts, &part[0]);
    if (status == ICC_OK)
        status = improve(map, n_kept, model, boundary_moves, facts, &part[1]);
    iccp_free(&env->memory, model);
    return status == ICC_OK && !iccp_plmap_is_positive(map) ? ICC_ERR_CERTIFICATE : status;
}

icc_status iccp_nearest(iccp_plmap *map, bool boundary_moves, iccp_nearest_facts *facts,
                        const iccp_env *env, icc_error *err)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    *facts = (iccp_nearest_facts){.repair = ICC_REPAIR_NONE};
    facts->n_folded = iccp_simplicial_count_at_once(&simplicial, env);
    icc_status status = check_boundary(map, env, boundary_moves ? NULL : err);
    const bool needs_frame = status == ICC_ERR_BOUNDARY;
    if (status == ICC_OK && facts->n_folded == 0)
        return ICC_OK;
    if (status == ICC_OK || (needs_frame && boundary_moves))
        status = repair(map, needs_frame, boundary_moves, facts, env);
    if (status == ICC_ERR_CERTIFICATE)
        (void)iccp_fail(err, status,
                        "no one-to-one map was found. Images of held vertices must lie inside that "
                        "of the boundary, and apart, and must not be too tangled");
    return status;
}
