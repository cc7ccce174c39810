/* Pairs two borders as outlines: a border from node to node is a line with both ends held, an
 * island a ring. The number of samples grows with the number of vertices, so that many short
 * borders cost no more than a few long ones. */
#include "match/coverage/border_vertices.h"

#include "base/threads.h"
#include "match/outline/arc.h"
#include "match/outline/one_to_one.h"
#include "match/outline/pins.h"
#include "match/outline/union_outline.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* Samples on each vertex of the longer border, and the least number. Of two simplifications of 48
 * states, 4 on each joined 820 vertices, and 8 or 16 joined 832. */
enum { SAMPLES_EACH = 8, LEAST_SAMPLES = 16 };

void iccp_border_vertices_free(iccp_border_vertices *vertices, const iccp_memory *memory)
{
    for (size_t b = 0; b < vertices->n && vertices->line != NULL; ++b)
        for (int e = 0; e < 2; ++e)
            iccp_free(memory, vertices->line[b].point[e]);
    iccp_free(memory, vertices->line);
}

typedef struct task {
    iccp_border_vertices *vertices;
    const iccp_layer_pairing *pairing;
    const bool *is_wanted;
    bool by_arc;
    const iccp_memory *memory;
    const iccp_env *env; /* of one border: reports nothing */
} task;

/* Makes the outline of a border. The source's is moved to where the target's should be. */
static icc_status outline_of(iccp_outline *outline, const iccp_layer_graph *graph,
                             const iccp_border *border, const iccp_plane_affine *affine,
                             const iccp_memory *memory)
{
    const size_t n = border->n + (border->is_island ? 0 : 1);
    double *const points = iccp_alloc(memory, n, 2 * sizeof *points);
    if (points == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < n; ++k) {
        const double *const p = graph->layer->place + 2 * (size_t)graph->at[border->first + k];
        memcpy(points + 2 * k, p, 2 * sizeof *p);
        if (affine != NULL)
            iccp_plane_affine_move(affine, p, points + 2 * k);
    }
    const icc_status status =
        iccp_outline_create_points(outline, n, points, border->is_island, memory);
    iccp_free(memory, points);
    return status;
}

static size_t samples_for(const iccp_outline *a, const iccp_outline *b)
{
    const size_t most = a->end > 0 ? ICCP_MATCH_SAMPLES / 2 : ICCP_MATCH_SAMPLES;
    const size_t n = SAMPLES_EACH * (a->n > b->n ? a->n : b->n) / (a->end > 0 ? 2 : 1);
    return n < LEAST_SAMPLES ? LEAST_SAMPLES : n < most ? n : most;
}

/* Pairs lines, on the way forth by shape, and on the way back the same. */
static icc_status pair_lines(iccp_pairing_knots *knots, const iccp_outline *a,
                             const iccp_outline *b, bool by_arc, const iccp_memory *memory)
{
    const double begin[2] = {0, 0}, end[2] = {a->share[a->end], b->share[b->end]};
    icc_status status = ICC_OK;
    if (by_arc)
        memcpy(knots->knot + 2 * knots->n++, begin, sizeof begin);
    else
        status = iccp_elastic_open(knots, a, b, begin, end, samples_for(a, b), memory);
    const size_t n = knots->n;
    memcpy(knots->knot + 2 * knots->n++, end, sizeof end);
    for (size_t k = n; k-- > 1;) {
        knots->knot[2 * knots->n] = 1 - knots->knot[2 * k];
        knots->knot[2 * knots->n++ + 1] = 1 - knots->knot[2 * k + 1];
    }
    return status;
}

/* Chooses a vertex of the source and one of the target where the pairing of two rings begins: those
 * that a pairing by arc length takes closest to each other. */
static void find_begin(double *begin, const iccp_outline *a, const iccp_outline *b)
{
    const double start = iccp_arc_start(a, b);
    double least = HUGE_VAL;
    for (size_t k = 0; k < a->n; ++k) {
        const double image = iccp_outline_wrap(a->share[k] + start);
        double along;
        const size_t edge = iccp_outline_edge(b, image, &along);
        const size_t near = along < 0.5 ? edge : edge + 1;
        const double d = fabs(b->share[near] - image);
        if (d < least) {
            least = d;
            begin[0] = a->share[k];
            begin[1] = iccp_outline_wrap(b->share[near]);
        }
    }
}

static icc_status pair_rings(iccp_pairing_knots *knots, const iccp_outline *a,
                             const iccp_outline *b, bool by_arc, const iccp_memory *memory)
{
    double begin[2];
    find_begin(begin, a, b);
    if (!by_arc)
        return iccp_elastic_open(knots, a, b, begin, (const double[]){1, 1}, samples_for(a, b),
                                 memory);
    memcpy(knots->knot + 2 * knots->n++, begin, sizeof begin);
    return ICC_OK;
}

/* Pairs two outlines, and makes their vertices common. */
static icc_status pair(iccp_union_outline *common, const iccp_outline *outline, bool by_arc,
                       const iccp_env *env)
{
    const iccp_outline *const a = &outline[0], *const b = &outline[1];
    const iccp_memory *const memory = &env->memory;
    const double ends[4] = {0, 0, a->share[a->end], b->share[b->end]};
    const size_t n_ends = a->end > 0 ? 2 : 0;
    iccp_pairing_knots knots = {0};
    knots.knot = iccp_alloc(memory, 4 * ICCP_MATCH_SAMPLES + 512, 2 * sizeof *knots.knot);
    icc_status status = knots.knot != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = n_ends > 0 ? pair_lines(&knots, a, b, by_arc, memory)
                            : pair_rings(&knots, a, b, by_arc, memory);
    if (status == ICC_OK && !by_arc)
        status = iccp_pin(&knots, a, b, n_ends, ends, env);
    if (status == ICC_OK)
        status = iccp_union_outline_create(common, &knots, a, b, n_ends, ends, 0, memory);
    if (status == ICC_OK && !by_arc)
        iccp_one_to_one(common, a, b, n_ends, ends);
    iccp_free(memory, knots.knot);
    return status;
}

/* A vertex of a border in the caller's coordinates, or a point of one of its sides. */
static void point_of(double *point, const iccp_layer_graph *graph, const iccp_border *border,
                     const iccp_outline *outline, uint32_t vertex, double share)
{
    const uint32_t *const at = graph->at + border->first;
    if (vertex != NONE) {
        iccp_layer_given(graph->layer, at[vertex], point);
        return;
    }
    double along, p[2], q[2];
    const size_t k = iccp_outline_edge(outline, share, &along);
    iccp_layer_given(graph->layer, at[k], p);
    iccp_layer_given(graph->layer, at[k + 1], q);
    for (int e = 0; e < 2; ++e)
        point[e] = p[e] + along * (q[e] - p[e]);
}

/* Lists the common vertices from the first vertex of the border on. */
static icc_status read(iccp_common_line *line, const task *t, uint32_t b,
                       const iccp_outline *outline, const iccp_union_outline *common)
{
    size_t first = 0;
    for (size_t k = 0; k < common->n; ++k)
        if (common->vertex[2 * k] == 0)
            first = k;
    for (int e = 0; e < 2; ++e) {
        line->point[e] = iccp_alloc(t->memory, common->n + 1, 2 * sizeof *line->point[e]);
        if (line->point[e] == NULL)
            return ICC_ERR_MEMORY;
    }
    for (size_t k = 0; k <= common->n; ++k) {
        const size_t at = (first + k) % common->n;
        for (size_t e = 0; e < 2; ++e) {
            const iccp_layer_graph *const graph = t->pairing->graph[e];
            point_of(line->point[e] + 2 * line->n, graph,
                     &graph->border[e == 0 ? b : t->pairing->border[b]], &outline[e],
                     common->vertex[2 * at + e], common->share[2 * at + e]);
        }
        ++line->n;
        line->n_joined +=
            k < common->n && common->vertex[2 * at] != NONE && common->vertex[2 * at + 1] != NONE;
        if (outline[0].end > 0 && common->vertex[2 * at] == outline[0].end)
            break;
    }
    return ICC_OK;
}

static icc_status pair_border(const task *t, uint32_t b)
{
    iccp_outline outline[2] = {{0}, {0}};
    iccp_union_outline common = {0};
    icc_status status = ICC_OK;
    for (int e = 0; e < 2 && status == ICC_OK; ++e) {
        const iccp_layer_graph *const graph = t->pairing->graph[e];
        status = outline_of(&outline[e], graph, &graph->border[e == 0 ? b : t->pairing->border[b]],
                            e == 0 ? &t->pairing->affine : NULL, t->memory);
    }
    if (status == ICC_OK)
        status = pair(&common, outline, t->by_arc, t->env);
    if (status == ICC_OK)
        status = read(&t->vertices->line[b], t, b, outline, &common);
    iccp_union_outline_free(&common, t->memory);
    iccp_outline_free(&outline[0], t->memory);
    iccp_outline_free(&outline[1], t->memory);
    return status;
}

static icc_status run(void *argument, size_t begin, size_t end)
{
    const task *const t = argument;
    icc_status status = ICC_OK;
    for (size_t b = begin; b < end && status == ICC_OK; ++b)
        if (t->is_wanted[b] && t->pairing->border[b] != NONE)
            status = pair_border(t, (uint32_t)b);
    return status;
}

icc_status iccp_border_vertices_create(iccp_border_vertices *vertices,
                                       const iccp_layer_pairing *pairing, const bool *is_wanted,
                                       bool by_arc, const iccp_env *env)
{
    const iccp_env quiet = {.memory = env->memory};
    task t = {vertices, pairing, is_wanted, by_arc, &env->memory, &quiet};
    *vertices = (iccp_border_vertices){.n = pairing->graph[0]->n_borders};
    vertices->line = iccp_alloc_zero(&env->memory, vertices->n, sizeof *vertices->line);
    if (vertices->line == NULL)
        return ICC_ERR_MEMORY;
    return iccp_for_chunks(env, NULL, vertices->n, 1, run, &t);
}
