/* Overlays two drawings on the sphere. The faces of a graph on a surface are the orbits of its
 * darts (match/common_mesh/overlay_darts.h). */
#include "match/common_mesh/sphere_overlay.h"

#include "base/error.h"
#include "match/common_mesh/overlay_darts.h"
#include "match/common_mesh/shared_vertices.h"

/* The most crossings. Darts, four more for each crossing, are counted in 32 bits. */
static const size_t most_of_all = (size_t)1 << 28;

/* ---- faces ---- */

/* Finds the drawings' faces on the left of a dart that runs along their edges. */
static void look_left(uint32_t within[2], const iccp_overlay_darts *g, uint32_t dart)
{
    const int side = dart / 2 >= g->n_first;
    const uint32_t along = g->along[dart / 2];
    const uint32_t h = dart % 2 == 0 ? along : g->drawing[side].m->twin[along];
    within[side] = h / 3;
    if (side == 0 && g->walk[0].is_common[h])
        within[1] = g->walk[0].sector[h] / 3;
}

/* Finds the face of the other drawing that contains a corner, if the corner is a vertex of one
 * drawing alone. */
static void look_round(uint32_t within[2], const iccp_sphere_overlay *overlay,
                       const iccp_overlay_darts *g, uint32_t node)
{
    const int side = node >= overlay->n_vertices[0];
    const uint32_t v = node - (uint32_t)(side == 1 ? overlay->n_vertices[0] : 0);
    if (v < overlay->n_vertices[side] && g->drawing[side].partner[v] == ICCP_NO_EDGE)
        within[1 - side] = g->walk[side].face[v];
}

/* Follows the darts around each face, which lies on their left. A face without an edge of one
 * drawing is a whole face of the other. At least two of its corners belong to that one alone. */
static bool trace_faces(iccp_sphere_overlay *overlay, iccp_overlay_darts *g, uint8_t *is_done)
{
    size_t n = 0;
    for (uint32_t first = 0; first < 2 * g->n_pieces; ++first) {
        uint32_t dart = first;
        if (is_done[first])
            continue;
        uint32_t within[2] = {0, 0};
        overlay->begin[overlay->n_faces++] = (uint32_t)n;
        do {
            is_done[dart] = 1;
            look_round(within, overlay, g, g->origin[dart]);
            overlay->corner[n++] = g->origin[dart];
            dart = g->back[iccp_dart_reversed(dart)];
        } while (!is_done[dart]);
        const size_t corners = n - overlay->begin[overlay->n_faces - 1];
        if (dart != first || corners < 3 || corners > ICCP_OVERLAY_CORNERS)
            return false;
        do {
            look_left(within, g, dart);
            dart = g->back[iccp_dart_reversed(dart)];
        } while (dart != first);
        for (int side = 0; side < 2; ++side)
            overlay->within[side][overlay->n_faces - 1] = within[side];
    }
    overlay->begin[overlay->n_faces] = (uint32_t)n;
    return overlay->n_nodes + overlay->n_faces == g->n_pieces + 2;
}

static icc_status make_faces(iccp_sphere_overlay *overlay, iccp_overlay_darts *g,
                             const iccp_env *env, icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n_vertices = overlay->n_vertices[0] + overlay->n_vertices[1];
    iccp_overlay_number_pieces(g);
    g->origin = iccp_alloc(memory, g->n_pieces, 2 * sizeof *g->origin);
    g->back = iccp_alloc(memory, g->n_pieces, 2 * sizeof *g->back);
    overlay->begin = iccp_alloc(memory, g->n_pieces, sizeof *overlay->begin);
    overlay->corner = iccp_alloc(memory, g->n_pieces, 2 * sizeof *overlay->corner);
    for (int side = 0; side < 2; ++side)
        overlay->within[side] = iccp_alloc(memory, g->n_pieces, sizeof *overlay->within[side]);
    g->along = iccp_alloc(memory, g->n_pieces, sizeof *g->along);
    overlay->crossing = iccp_alloc(memory, overlay->n_crossings, sizeof *overlay->crossing);
    uint8_t *const is_done = iccp_alloc_zero(memory, g->n_pieces, 2);
    if (g->origin == NULL || g->back == NULL || g->along == NULL || overlay->begin == NULL ||
        overlay->corner == NULL || overlay->crossing == NULL || overlay->within[0] == NULL ||
        overlay->within[1] == NULL || is_done == NULL) {
        iccp_free(memory, is_done);
        return iccp_fail_memory(err);
    }
    for (size_t p = 0; p < overlay->n_crossings; ++p) {
        overlay->crossing[p][0] = g->paired.edge_of[0][p];
        overlay->crossing[p][1] = g->walk[0].crossed[p];
    }
    iccp_overlay_turn(g, n_vertices);
    const bool is_sphere = trace_faces(overlay, g, is_done);
    iccp_free(memory, is_done);
    return is_sphere ? ICC_OK
                     : iccp_fail(err, ICC_ERR_CERTIFICATE,
                                 "the faces of two drawings on the sphere, cut by one another, do "
                                 "not make a sphere");
}

/* ---- from beginning to end ---- */

static icc_status overlay_all(iccp_sphere_overlay *overlay, iccp_overlay_darts *g, size_t most,
                              const iccp_env *env, icc_error *err)
{
    icc_status status = ICC_OK;
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        const iccp_env part = iccp_part(env, NULL, 0.5 * side, 0.5 * side + 0.5);
        g->piece[side] =
            iccp_alloc(&env->memory, g->drawing[side].m->n_faces, 3 * sizeof *g->piece[side]);
        status = g->piece[side] == NULL
                     ? iccp_fail_memory(err)
                     : iccp_arc_walk_create(&g->walk[side], &g->drawing[side],
                                            &g->drawing[1 - side], most, &part, err);
    }
    if (status == ICC_OK)
        status = iccp_paired_crossings_create(&g->paired, g->drawing, g->walk, env, err);
    overlay->n_crossings = g->walk[0].n_crossed;
    overlay->n_nodes += overlay->n_crossings;
    return status == ICC_OK ? make_faces(overlay, g, env, err) : status;
}

static void free_graph(iccp_overlay_darts *g, const iccp_memory *memory)
{
    for (int side = 0; side < 2; ++side) {
        iccp_arc_walk_free(&g->walk[side], memory);
        iccp_free(memory, g->drawing[side].number);
        iccp_free(memory, g->drawing[side].partner);
        iccp_free(memory, g->piece[side]);
    }
    iccp_paired_crossings_free(&g->paired, memory);
    iccp_free(memory, g->along);
    iccp_free(memory, g->origin);
    iccp_free(memory, g->back);
}

icc_status iccp_sphere_overlay_create(iccp_sphere_overlay *overlay,
                                      const iccp_half_edges *const m[2],
                                      const double *const directions[2], size_t most_crossings,
                                      const iccp_env *env, icc_error *err)
{
    iccp_overlay_darts g = {.drawing = {{.m = m[0], .directions = directions[0]},
                                        {.m = m[1], .directions = directions[1]}}};
    *overlay = (iccp_sphere_overlay){.n_vertices = {m[0]->n_vertices, m[1]->n_vertices}};
    icc_status status = iccp_shared_vertices_find(g.drawing, &overlay->n_nodes, &env->memory);
    const size_t most = most_crossings < most_of_all ? most_crossings : most_of_all;
    status =
        status == ICC_OK ? overlay_all(overlay, &g, most, env, err) : iccp_explain(err, status);
    /* The caller keeps the places of the vertices. */
    overlay->partner = g.drawing[0].partner;
    g.drawing[0].partner = NULL;
    for (int side = 0; side < 2; ++side) {
        overlay->face[side] = g.walk[side].face;
        g.walk[side].face = NULL;
    }
    free_graph(&g, &env->memory);
    return status;
}

void iccp_sphere_overlay_free(iccp_sphere_overlay *overlay, const iccp_memory *memory)
{
    iccp_free(memory, overlay->crossing);
    iccp_free(memory, overlay->begin);
    iccp_free(memory, overlay->corner);
    iccp_free(memory, overlay->partner);
    for (int side = 0; side < 2; ++side) {
        iccp_free(memory, overlay->face[side]);
        iccp_free(memory, overlay->within[side]);
    }
    *overlay = (iccp_sphere_overlay){0};
}
