/* Proposes a slide from the mesh of a map (docs/theory/features.md).
 *
 * In that mesh all vertices on a chain, except its stops, may now move along the chain. Each has
 * one unknown in Newton's equations (energy/newton.h): its rail is the direction of the chain
 * there. The steps tell how far it wants to go. On a curved chain a rail leaves the chain, so the
 * steps are only a model. Each vertex then goes that far along the chain itself. A curve through
 * the vertices gives each length of the chain before the map its length after it, and so the places
 * of all corners. A corner of the source may pass corners of the target in one step. */
#include "map/slide/slide_step.h"

#include "base/sort.h"
#include "map/energy/descent.h"
#include "map/slide/added_vertices.h"
#include "map/slide/merge_corners.h"

#include <string.h>

/* Steps of the model. With more, rails lead too far from curved chains. */
static const iccp_descent MODEL = {0, 3, 1e-3, 0, true};

/* A gap between neighbours keeps at least this share of its length. */
static const double LEAST_GAP = 0.1;

/* A vertex of the mesh on a chain, between knot and knot + 1. */
typedef struct item {
    size_t knot;
    double share; /* of the way to the next knot */
    uint32_t vertex;
    bool is_held;
} item;

typedef struct step {
    const iccp_slide *slide;
    const iccp_plmap *map;
    const iccp_slide_request *request;
    iccp_added_vertices added;
    uint8_t *is_held; /* by knot */
    double *length;   /* 2 for each knot: of the chain before it, in source and target */
    size_t n;
    item *item;         /* those on chains that may slide, along them */
    double *from;       /* of each item: the length of the chain up to it in the source, */
    double *to;         /* and in the target; later where it shall go */
    double *by;         /* of each item: how far it wants to go in the target */
    iccp_chain_way way; /* of the present chain */
    iccp_slide *out;
} step;

static size_t sides_of(const iccp_slide *slide, size_t chain)
{
    return slide->chains.first[chain + 1] - slide->chains.first[chain];
}

/* Whether a chain has corners that may slide. */
static bool may_slide(const step *s, size_t chain)
{
    const iccp_slide *slide = s->slide;
    const uint32_t side = slide->chains.half[slide->chains.first[chain]] / 2;
    return sides_of(slide, chain) > 1 &&
           (s->request->moves_rim || !iccp_network_is_rim(iccp_network_of(slide->given[0]), side));
}

/* ---- the vertices on the chains ---- */

/* Finds the lengths of the chains up to each knot. */
static void measure(step *s)
{
    const iccp_slide *slide = s->slide;
    for (size_t c = 0; c < slide->chains.n; ++c)
        for (int side = 0; side < 2; ++side) {
            double place[2], before[2], sum = 0;
            for (size_t k = slide->first[c]; k < slide->first[c + 1]; ++k) {
                iccp_knot_place(slide, c, &slide->knot[k], side, place);
                if (k > slide->first[c])
                    sum += iccp_vec_distance(2, before, place);
                s->length[2 * k + (size_t)side] = sum;
                memcpy(before, place, sizeof place);
            }
        }
}

static void mark_held(step *s)
{
    for (size_t v = 0; s->request->is_held != NULL && v < s->slide->given[0]->n_vertices; ++v) {
        const uint32_t knot = s->added.knot[s->added.vertex[v]];
        if (s->request->is_held[v] && knot != UINT32_MAX)
            s->is_held[knot] = 1;
    }
}

/* Finds the knot at or before a vertex of the mesh, and its share of the way to the next one.
 * Returns false if the vertex lies on no chain. */
static bool locate(const step *s, uint32_t v, item *at)
{
    const iccp_plmap *map = s->map;
    if (map->fixed[v] != ICCP_ON_NETWORK)
        return false;
    const uint32_t node = iccp_plmap_node(map, v);
    const uint32_t after = s->added.after[map->featured->facets[2 * (size_t)map->facet[v]]];
    const uint32_t knot = node != UINT32_MAX ? s->added.knot[node] : after / 2;
    *at = (item){knot, 0, v, node != UINT32_MAX && knot != UINT32_MAX && s->is_held[knot]};
    if (node == UINT32_MAX)
        at->share = after % 2 == 0 ? map->along[v] : 1 - map->along[v];
    return knot != UINT32_MAX;
}

static int along_chains(const void *a, const void *b)
{
    const item *p = a, *q = b;
    if (p->knot != q->knot)
        return p->knot < q->knot ? -1 : 1;
    return (p->share > q->share) - (p->share < q->share);
}

/* What may slide at a knot and behind it, up to the next one. */
enum { STAYS, BEHIND_IT, SLIDES };

static void mark_sliding(const step *s, uint8_t *slides)
{
    const iccp_slide *slide = s->slide;
    for (size_t c = 0; c < slide->chains.n; ++c) {
        const size_t first = slide->first[c], last = slide->first[c + 1] - 1;
        const bool any = may_slide(s, c);
        for (size_t k = first; k <= last; ++k)
            slides[k] = any ? SLIDES : STAYS;
        if (any)
            slides[first] = BEHIND_IT;
        slides[last] = STAYS;
    }
}

/* Lists the vertices on chains that may slide, without stops. `slides`: room for each knot. */
static void list_items(step *s, uint8_t *slides)
{
    mark_sliding(s, slides);
    for (uint32_t v = 0; v < s->map->n_vertices; ++v) {
        item at;
        if (locate(s, v, &at) &&
            (slides[at.knot] == SLIDES || (slides[at.knot] == BEHIND_IT && at.share > 0)))
            s->item[s->n++] = at;
    }
    iccp_sort(s->item, s->n, sizeof *s->item, along_chains);
    for (size_t i = 0; i < s->n; ++i) {
        const double *a = s->length + 2 * s->item[i].knot, share = s->item[i].share;
        s->from[i] = a[0] + share * (a[2] - a[0]);
        s->to[i] = a[1] + share * (a[3] - a[1]);
    }
}

/* Returns the end of the items of a chain that begin at `begin`. */
static size_t end_of(const step *s, size_t chain, size_t begin)
{
    size_t end = begin;
    while (end < s->n && s->item[end].knot < s->slide->first[chain + 1])
        ++end;
    return end;
}

/* ---- where they want to go ---- */

/* Between vertices that stay, lengths after the map become proportional to lengths before it. */
static void go_evenly(step *s, size_t chain, size_t begin, size_t end)
{
    const double *last = s->length + 2 * (s->slide->first[chain + 1] - 1);
    double from = 0, to = 0;
    for (size_t i = begin, first = begin; i <= end; ++i) {
        if (i < end && !s->item[i].is_held)
            continue;
        const double next_from = i < end ? s->from[i] : last[0];
        const double next_to = i < end ? s->to[i] : last[1];
        for (size_t k = first; k < i; ++k)
            s->by[k] = to + (s->from[k] - from) / (next_from - from) * (next_to - to) - s->to[k];
        from = next_from;
        to = next_to;
        first = i + 1;
    }
}

/* Sets the rails of a chain's vertices, and frees the vertices. A rail points from the image of the
 * vertex before to that of the next one. */
static void lay_rails(const step *s, size_t chain, size_t begin, size_t end, double *rail,
                      uint8_t *fixed)
{
    const iccp_slide *slide = s->slide;
    double stop[2][2];
    iccp_knot_place(slide, chain, &slide->knot[slide->first[chain]], 1, stop[0]);
    iccp_knot_place(slide, chain, &slide->knot[slide->first[chain + 1] - 1], 1, stop[1]);
    for (size_t i = begin; i < end; ++i) {
        const uint32_t v = s->item[i].vertex;
        const double *images = s->map->images;
        const double *a = i > begin ? images + 2 * (size_t)s->item[i - 1].vertex : stop[0];
        const double *b = i + 1 < end ? images + 2 * (size_t)s->item[i + 1].vertex : stop[1];
        const double length = iccp_vec_distance(2, a, b);
        if (s->item[i].is_held || !(length > 0))
            continue;
        rail[2 * (size_t)v] = (b[0] - a[0]) / length;
        rail[2 * (size_t)v + 1] = (b[1] - a[1]) / length;
        fixed[v] = ICCP_FREE;
    }
}

/* Takes the steps of the model. `room`: 4 numbers for each vertex of the mesh. `fixed`: one. */
static icc_status take_model(step *s, double *room, uint8_t *fixed, const iccp_env *env)
{
    const size_t n = 2 * s->map->n_vertices;
    double *images = room, *rail = room + n;
    iccp_simplicial_map model = iccp_plmap_simplicial(s->map);
    iccp_work work = iccp_work_unlimited();
    memcpy(images, s->map->images, n * sizeof *images);
    memcpy(fixed, s->map->fixed, s->map->n_vertices);
    for (size_t i = 0; i < n; ++i)
        rail[i] = 0;
    for (size_t c = 0, begin = 0; c < s->slide->chains.n; ++c) {
        const size_t end = end_of(s, c, begin);
        lay_rails(s, c, begin, end, rail, fixed);
        begin = end;
    }
    model.images = images;
    model.fixed = fixed;
    model.rail = rail;
    model.plan = NULL;
    const icc_status status = iccp_take_steps(&model, &MODEL, &work, NULL, env);
    for (size_t i = 0; i < s->n; ++i) {
        const size_t v = 2 * (size_t)s->item[i].vertex;
        s->by[i] = rail[v] * (images[v] - s->map->images[v]) +
                   rail[v + 1] * (images[v + 1] - s->map->images[v + 1]);
    }
    return status;
}

static icc_status go_down(step *s, const iccp_env *env)
{
    double *room = iccp_alloc(&env->memory, s->map->n_vertices, 4 * sizeof *room);
    uint8_t *fixed = iccp_alloc(&env->memory, s->map->n_vertices, sizeof *fixed);
    const icc_status status =
        room != NULL && fixed != NULL ? take_model(s, room, fixed, env) : ICC_ERR_MEMORY;
    iccp_free(&env->memory, room);
    iccp_free(&env->memory, fixed);
    return status;
}

/* Moves a chain's vertices by the same share of their ways, so that each gap stays long enough. */
static void move(step *s, size_t chain, size_t begin, size_t end)
{
    double share = s->request->share, to = 0, by = 0;
    const double last = s->length[2 * (s->slide->first[chain + 1] - 1) + 1];
    for (size_t i = begin; i <= end; ++i) {
        const double next = i < end ? s->to[i] : last, next_by = i < end ? s->by[i] : 0;
        const double closer = by - next_by, gap = (1 - LEAST_GAP) * (next - to);
        if (share * closer > gap)
            share = gap / closer;
        to = next;
        by = next_by;
    }
    for (size_t i = begin; i < end; ++i)
        s->to[i] += share * s->by[i];
}

/* ---- the new knots ---- */

/* Finds the lengths up to the corners of a chain, and the curve through its vertices. */
static void find_way(step *s, size_t chain, size_t begin, size_t end)
{
    const iccp_slide *slide = s->slide;
    double *curve = s->way.curve;
    size_t n = 0;
    s->way.n_sides = sides_of(slide, chain);
    for (size_t k = slide->first[chain]; k < slide->first[chain + 1]; ++k)
        for (size_t side = 0; side < 2; ++side)
            if (iccp_knot_is_corner(&slide->knot[k], (int)side))
                s->way.corner[2 * slide->knot[k].at[side] + side] = s->length[2 * k + side];
    memset(curve, 0, 2 * sizeof *curve);
    for (size_t i = begin; i < end; ++i) {
        curve[2 * ++n] = s->from[i];
        curve[2 * n + 1] = s->to[i];
    }
    memcpy(curve + 2 * ++n, s->length + 2 * (slide->first[chain + 1] - 1), 2 * sizeof *curve);
    s->way.n_points = n + 1;
}

static void copy_knot(step *s, size_t knot)
{
    s->out->knot[s->out->first[s->slide->chains.n]++] = s->slide->knot[knot];
}

/* Writes the knots of a chain. out->first[chains.n] counts the knots of all chains. */
static bool write_chain(step *s, size_t chain, size_t begin, size_t end)
{
    const iccp_slide *slide = s->slide;
    const size_t first = slide->first[chain], last = slide->first[chain + 1] - 1;
    bool is_good = true;
    copy_knot(s, first);
    if (may_slide(s, chain)) {
        find_way(s, chain, begin, end);
        is_good = iccp_merge_corners(s->out->knot, &s->out->first[slide->chains.n], &s->way);
    }
    for (size_t k = first + 1; k < last && !may_slide(s, chain); ++k)
        copy_knot(s, k);
    copy_knot(s, last);
    return is_good;
}

static bool write_all(step *s)
{
    const size_t n = s->slide->chains.n;
    bool is_good = true;
    for (size_t c = 0, begin = 0; is_good && c < n; ++c) {
        const size_t end = end_of(s, c, begin), so_far = s->out->first[n];
        move(s, c, begin, end);
        if (c > 0)
            s->out->first[c] = so_far;
        is_good = write_chain(s, c, begin, end);
        begin = end;
    }
    return is_good;
}

/* ---- all of it ---- */

static icc_status begin(step *s, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const iccp_slide *slide = s->slide;
    const size_t n_knots = slide->first[slide->chains.n], n = s->map->n_vertices;
    const size_t n_sides = iccp_network_of(slide->given[0])->n_sides;
    const icc_status status = iccp_added_vertices_create(&s->added, slide, memory);
    if (status != ICC_OK)
        return status;
    s->is_held = iccp_alloc_zero(memory, n_knots, 1);
    s->length = iccp_alloc(memory, n_knots, 2 * sizeof *s->length);
    s->item = iccp_alloc(memory, n, sizeof *s->item);
    s->from = iccp_alloc(memory, n, sizeof *s->from);
    s->to = iccp_alloc(memory, n, sizeof *s->to);
    s->by = iccp_alloc(memory, n, sizeof *s->by);
    s->way.corner = iccp_alloc(memory, n_sides + 1, 2 * sizeof *s->way.corner);
    s->way.curve = iccp_alloc(memory, n + 2, 2 * sizeof *s->way.curve);
    uint8_t *slides = iccp_alloc(memory, n_knots, 1);
    const bool is_there = s->is_held != NULL && s->length != NULL && s->item != NULL &&
                          s->from != NULL && s->to != NULL && s->by != NULL &&
                          s->way.corner != NULL && s->way.curve != NULL && slides != NULL;
    if (is_there) {
        measure(s);
        mark_held(s);
        list_items(s, slides);
    }
    iccp_free(memory, slides);
    return is_there ? ICC_OK : ICC_ERR_MEMORY;
}

static void release(step *s, const iccp_memory *memory)
{
    iccp_added_vertices_free(&s->added);
    iccp_free(memory, s->is_held);
    iccp_free(memory, s->length);
    iccp_free(memory, s->item);
    iccp_free(memory, s->from);
    iccp_free(memory, s->to);
    iccp_free(memory, s->by);
    iccp_free(memory, s->way.corner);
    iccp_free(memory, s->way.curve);
}

/* Finds how far each vertex wants to go. */
static icc_status find_ways(step *s, const iccp_env *env)
{
    if (s->request->way == ICCP_SLIDE_DOWN)
        return go_down(s, env);
    for (size_t c = 0, begin = 0; c < s->slide->chains.n; ++c) {
        const size_t end = end_of(s, c, begin);
        go_evenly(s, c, begin, end);
        for (size_t i = begin; i < end; ++i)
            s->by[i] = s->item[i].is_held ? 0 : s->by[i];
        begin = end;
    }
    return ICC_OK;
}

icc_status iccp_slide_propose(iccp_slide **out, const iccp_slide *slide, const iccp_plmap *map,
                              const iccp_slide_request *request, const iccp_env *env)
{
    step s = {.slide = slide, .map = map, .request = request, .added.memory = env->memory};
    const icc_domain *const *given = (const icc_domain *const *)slide->given;
    *out = NULL;
    icc_status status = begin(&s, env);
    const bool any = status == ICC_OK && s.n > 0;
    if (any)
        status = find_ways(&s, env);
    if (any && status == ICC_OK)
        status = iccp_slide_begin(&s.out, given[0], given[1],
                                  2 * iccp_network_of(given[0])->n_sides, &env->memory);
    if (any && status == ICC_OK && write_all(&s)) {
        *out = s.out;
        s.out = NULL;
    }
    iccp_slide_free(s.out);
    release(&s, &env->memory);
    return status;
}
