/* A graph on a surface by the cyclic order of the edges at each node, its faces being orbits:
 * J. Edmonds, A Combinatorial Representation for Polyhedral Surfaces, 1960. */
#include "surface/sphere_overlay.h"

#include "base/error.h"
#include "surface/paired_crossings.h"
#include "surface/shared_vertices.h"

/* Crossings, at most: darts, four more for each, are counted in 32 bits. */
static const size_t most_of_all = (size_t)1 << 28;

/* An edge is cut into pieces by its crossings. Piece k has two darts, 2 k along the way that the
 * edge was walked and 2 k + 1 back. */
typedef struct graph {
    iccp_drawing drawing[2];
    iccp_arc_walk walk[2];
    uint32_t *piece[2]; /* by half-edge that was walked: its first piece */
    iccp_paired_crossings paired;
    size_t n_pieces, n_first; /* those of the first drawing's edges come first */
    uint32_t *along;          /* by piece: its half-edge, as it was walked */
    uint32_t *origin;         /* by dart: its node */
    uint32_t *back;           /* by dart: the next one at the node, clockwise */
} graph;

static uint32_t reversed(uint32_t dart)
{
    return dart ^ 1;
}

/* ---- darts ---- */

/* The dart with which a half-edge begins. An edge of both drawings has the first one's. */
static uint32_t first_dart(const graph *g, int side, uint32_t h)
{
    if (side == 1 && g->walk[1].is_common[h])
        return first_dart(g, 0, g->walk[1].sector[h]);
    const uint32_t twin = g->drawing[side].m->twin[h];
    return g->walk[side].begin[h] != ICCP_NO_EDGE
               ? 2 * g->piece[side][h]
               : 2 * (g->piece[side][twin] + g->walk[side].n[h]) + 1;
}

static void number_pieces(graph *g)
{
    for (int side = 0; side < 2; ++side) {
        g->n_first = g->n_pieces;
        for (uint32_t h = 0; h < 3 * g->drawing[side].m->n_faces; ++h) {
            const bool counts =
                g->walk[side].begin[h] != ICCP_NO_EDGE && !(side == 1 && g->walk[1].is_common[h]);
            g->piece[side][h] = (uint32_t)g->n_pieces;
            if (counts)
                g->n_pieces += g->walk[side].n[h] + 1;
        }
    }
}

static void name_pieces(graph *g)
{
    for (int side = 0; side < 2; ++side)
        for (uint32_t h = 0; h < 3 * g->drawing[side].m->n_faces; ++h) {
            const bool counts =
                g->walk[side].begin[h] != ICCP_NO_EDGE && !(side == 1 && g->walk[1].is_common[h]);
            for (uint32_t k = 0; counts && k <= g->walk[side].n[h]; ++k)
                g->along[g->piece[side][h] + k] = h;
        }
}

/* `dart` comes clockwise after `before`, both from a node. */
static void put(graph *g, uint32_t before, uint32_t dart, uint32_t node)
{
    g->back[before] = dart;
    g->origin[before] = node;
}

/* Round a vertex of one drawing alone its own order; round one of both that of the second drawing,
 * with the first one's edges, but for those of both, in the angles where they lie. */
static void turn_round_vertices(graph *g)
{
    for (int side = 0; side < 2; ++side) {
        const iccp_drawing *const d = &g->drawing[side];
        for (uint32_t v = 0; v < d->m->n_vertices; ++v) {
            uint32_t h = d->m->out[v];
            if (h == ICCP_NO_EDGE || d->partner[v] != ICCP_NO_EDGE)
                continue;
            do {
                const uint32_t next = iccp_edge_turn(d->m, h);
                put(g, first_dart(g, side, next), first_dart(g, side, h), d->number[v]);
                h = next;
            } while (h != d->m->out[v]);
        }
    }
}

/* From half-edge h of the first drawing, counter-clockwise, those of it in the angle behind
 * `sector` are put behind dart `last`; the last dart then. */
static uint32_t turn_through(graph *g, uint32_t *h, uint32_t sector, uint32_t last, uint32_t node)
{
    while (g->walk[0].sector[*h] == sector) {
        if (!g->walk[0].is_common[*h]) {
            put(g, first_dart(g, 0, *h), last, node);
            last = first_dart(g, 0, *h);
        }
        *h = iccp_edge_turn(g->drawing[0].m, *h);
    }
    return last;
}

static void turn_round_common(graph *g)
{
    const iccp_half_edges *const a = g->drawing[0].m, *const b = g->drawing[1].m;
    for (uint32_t v = 0; v < a->n_vertices; ++v) {
        const uint32_t w = g->drawing[0].partner[v], node = g->drawing[0].number[v];
        if (w == ICCP_NO_EDGE || a->degree[v] == 0)
            continue;
        /* The first edge of the first drawing in its angle. */
        uint32_t h = a->out[v];
        for (uint32_t k = 0; k < a->degree[v]; ++k) {
            const uint32_t next = iccp_edge_turn(a, h);
            const bool begins = g->walk[0].sector[next] != g->walk[0].sector[h];
            h = next;
            if (begins)
                break;
        }
        const uint32_t first = g->walk[0].sector[h];
        uint32_t e = first, last = first_dart(g, 1, e);
        do {
            last = turn_through(g, &h, e, last, node);
            e = iccp_edge_turn(b, e);
            put(g, first_dart(g, 1, e), last, node);
            last = first_dart(g, 1, e);
        } while (e != first);
    }
}

/* Round a crossing: on along the first edge, left along the second, back, and right. */
static void turn_round_crossings(graph *g, size_t n_vertices)
{
    for (uint32_t p = 0; p < g->walk[0].n_crossed; ++p) {
        const uint32_t q = g->paired.place[p], node = (uint32_t)(n_vertices + p);
        const uint32_t h = g->paired.edge_of[0][p], e = g->paired.edge_of[1][q];
        const uint32_t on = 2 * (g->piece[0][h] + p - g->walk[0].begin[h] + 1);
        const uint32_t up = 2 * (g->piece[1][e] + q - g->walk[1].begin[e] + 1);
        const uint32_t back = reversed(on - 2), down = reversed(up - 2);
        const bool to_left = g->walk[0].crossed[p] == e;
        const uint32_t left = to_left ? up : down, right = to_left ? down : up;
        put(g, on, right, node);
        put(g, right, back, node);
        put(g, back, left, node);
        put(g, left, on, node);
    }
}

/* ---- faces ---- */

/* A dart of a face: the drawings' faces to its left, where it runs along their edges. */
static void look_left(uint32_t within[2], const graph *g, uint32_t dart)
{
    const int side = dart / 2 >= g->n_first;
    const uint32_t along = g->along[dart / 2];
    const uint32_t h = dart % 2 == 0 ? along : g->drawing[side].m->twin[along];
    within[side] = h / 3;
    if (side == 0 && g->walk[0].is_common[h])
        within[1] = g->walk[0].sector[h] / 3;
}

/* A corner of a face: the face of the other drawing that a vertex of one alone is in. */
static void look_round(uint32_t within[2], const iccp_sphere_overlay *overlay, const graph *g,
                       uint32_t node)
{
    const int side = node >= overlay->n_vertices[0];
    const uint32_t v = node - (uint32_t)(side == 1 ? overlay->n_vertices[0] : 0);
    if (v < overlay->n_vertices[side] && g->drawing[side].partner[v] == ICCP_NO_EDGE)
        within[1 - side] = g->walk[side].face[v];
}

/* Follows the darts round each face, which is to their left. A face that has no edge of a drawing
 * is one of the other, whole: at least two of its corners are of that alone. */
static bool trace_faces(iccp_sphere_overlay *overlay, graph *g, uint8_t *is_done)
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
            dart = g->back[reversed(dart)];
        } while (!is_done[dart]);
        const size_t corners = n - overlay->begin[overlay->n_faces - 1];
        if (dart != first || corners < 3 || corners > ICCP_OVERLAY_CORNERS)
            return false;
        do {
            look_left(within, g, dart);
            dart = g->back[reversed(dart)];
        } while (dart != first);
        for (int side = 0; side < 2; ++side)
            overlay->within[side][overlay->n_faces - 1] = within[side];
    }
    overlay->begin[overlay->n_faces] = (uint32_t)n;
    return overlay->n_nodes + overlay->n_faces == g->n_pieces + 2;
}

static icc_status make_faces(iccp_sphere_overlay *overlay, graph *g, const iccp_env *env,
                             icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n_vertices = overlay->n_vertices[0] + overlay->n_vertices[1];
    number_pieces(g);
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
    name_pieces(g);
    turn_round_vertices(g);
    turn_round_common(g);
    turn_round_crossings(g, n_vertices);
    const bool is_sphere = trace_faces(overlay, g, is_done);
    iccp_free(memory, is_done);
    return is_sphere ? ICC_OK
                     : iccp_fail(err, ICC_ERR_CERTIFICATE,
                                 "the faces of two drawings on the sphere, cut by one another, do "
                                 "not make a sphere");
}

/* ---- from beginning to end ---- */

static icc_status overlay_all(iccp_sphere_overlay *overlay, graph *g, size_t most,
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

static void free_graph(graph *g, const iccp_memory *memory)
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
    graph g = {.drawing = {{.m = m[0], .directions = directions[0]},
                           {.m = m[1], .directions = directions[1]}}};
    *overlay = (iccp_sphere_overlay){.n_vertices = {m[0]->n_vertices, m[1]->n_vertices}};
    icc_status status = iccp_shared_vertices_find(g.drawing, &overlay->n_nodes, &env->memory);
    const size_t most = most_crossings < most_of_all ? most_crossings : most_of_all;
    status =
        status == ICC_OK ? overlay_all(overlay, &g, most, env, err) : iccp_explain(err, status);
    /* Where vertices are is kept. */
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
