/* Cuts the faces out of a plane map that change with its target, and puts them back. */
#include "map/compatible/moving_part.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* Marks of triangles. */
enum { OUTSIDE, ACROSS, CHANGES };

static bool is_same_vertex(const icc_domain *a, const icc_domain *b, uint32_t facet, uint32_t end)
{
    const size_t i = 2 * (size_t)a->facets[2 * (size_t)facet + end];
    const size_t j = 2 * (size_t)b->facets[2 * (size_t)facet + end];
    return memcmp(a->vertices + i, b->vertices + j, 2 * sizeof *a->vertices) == 0;
}

bool iccp_stays(const iccp_plmap *map, size_t vertex, const icc_domain *old_target,
                const icc_domain *target)
{
    const uint32_t facet = map->facet[vertex];
    const double along = map->along[vertex];
    return map->fixed[vertex] != ICCP_ON_NETWORK ||
           ((!(along < 1) || is_same_vertex(old_target, target, facet, 0)) &&
            (!(along > 0) || is_same_vertex(old_target, target, facet, 1)));
}

static bool is_same_frame(const iccp_frame *a, const iccp_frame *b)
{
    return memcmp(a->shift, b->shift, 2 * sizeof *a->shift) == 0 &&
           memcmp(a->in, b->in, sizeof a->in) == 0;
}

/* ---- finding the part ---- */

typedef struct search {
    const iccp_plmap *map;
    const icc_domain *old_target, *target;
    uint8_t *mark;   /* of each triangle */
    uint8_t *moves;  /* of each vertex: 1 if it is fixed and moves */
    uint32_t *stack; /* triangles that change, whose neighbours have not been looked at */
    size_t n;        /* in the stack */
    size_t n_changes, n_across;
} search;

static void add(search *s, uint32_t triangle)
{
    s->n_across -= s->mark[triangle] == ACROSS;
    s->mark[triangle] = CHANGES;
    s->stack[s->n++] = triangle;
    ++s->n_changes;
}

/* Adds the triangles of the same face, and marks those across its sides. */
static void spread(search *s)
{
    const iccp_corners *c = &s->map->corners;
    while (s->n > 0) {
        const uint32_t t = s->stack[--s->n];
        for (uint32_t k = 3 * t; k < 3 * t + 3; ++k) {
            const uint32_t next = c->twin[k] / 3;
            if (c->twin[k] == ICCP_NO_NEIGHBOUR || s->mark[next] == CHANGES)
                continue;
            if (!iccp_plmap_is_line(s->map, k)) {
                add(s, next);
            } else if (s->mark[next] == OUTSIDE) {
                s->mark[next] = ACROSS;
                ++s->n_across;
            }
        }
    }
}

/* Marks the triangles at vertices that move, and all others of their faces. */
static void find_changes(search *s)
{
    const uint32_t *v = s->map->corners.vertex;
    for (size_t w = 0; w < s->map->n_vertices; ++w)
        s->moves[w] = !iccp_stays(s->map, w, s->old_target, s->target);
    for (uint32_t t = 0; t < s->map->corners.n_triangles; ++t)
        if (s->mark[t] != CHANGES &&
            (s->moves[v[3 * t]] || s->moves[v[3 * t + 1]] || s->moves[v[3 * t + 2]])) {
            add(s, t);
            spread(s);
        }
}

/* ---- cutting it out ---- */

/* Takes either the fixed or the free vertices of the part, in their order, and numbers them. The
 * free vertices of faces that stay are held, so they count as fixed. */
static void take_vertices(iccp_moving_part *part, const iccp_plmap *whole, const uint8_t *mark,
                          bool is_fixed, uint32_t *number)
{
    uint32_t n = (uint32_t)part->n_first;
    for (uint32_t v = 0; v < whole->n_vertices; ++v) {
        if (mark[v] == OUTSIDE || is_fixed != (mark[v] == ACROSS || whole->fixed[v] != ICCP_FREE))
            continue;
        iccp_plmap_copy_vertex(&part->map, n, whole, v);
        if (is_fixed && whole->fixed[v] == ICCP_FREE)
            part->map.fixed[n] = ICCP_ON_POINT;
        part->vertex[n] = v;
        number[v] = n++;
    }
    part->n_first = part->map.n_vertices = n;
}

/* Marks the vertices of the part: CHANGES if one of their triangles does, otherwise ACROSS. */
static void mark_vertices(const search *s, uint8_t *mark)
{
    const iccp_corners *c = &s->map->corners;
    memset(mark, OUTSIDE, s->map->n_vertices);
    for (size_t x = 0; x < 3 * c->n_triangles; ++x)
        if (mark[c->vertex[x]] < s->mark[x / 3])
            mark[c->vertex[x]] = s->mark[x / 3];
}

/* Numbers the triangles of the part in their order, in `triangle`. */
static void take_triangles(iccp_moving_part *part, const search *s, const uint32_t *number,
                           uint32_t *triangle)
{
    const iccp_corners *c = &s->map->corners;
    iccp_corners *own = &part->map.corners;
    uint32_t n = 0;
    for (size_t t = 0; t < c->n_triangles; ++t)
        triangle[t] = (part->is_inside[t] = s->mark[t] != OUTSIDE) ? n++ : NONE;
    for (size_t x = 0; x < 3 * c->n_triangles; ++x) {
        if (!part->is_inside[x / 3])
            continue;
        const size_t to = 3 * (size_t)triangle[x / 3] + x % 3;
        const uint32_t twin = c->twin[x];
        const bool has_twin = twin != ICCP_NO_NEIGHBOUR && part->is_inside[twin / 3];
        own->vertex[to] = number[c->vertex[x]];
        own->twin[to] = has_twin ? 3 * triangle[twin / 3] + twin % 3 : ICCP_NO_NEIGHBOUR;
    }
}

static icc_status cut_out(iccp_moving_part *part, const search *s, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const iccp_plmap *whole = s->map;
    const size_t n = s->n_changes + s->n_across, n_all = whole->corners.n_triangles;
    const size_t most = 3 * n < whole->n_vertices ? 3 * n : whole->n_vertices;
    uint32_t *number = iccp_alloc(memory, whole->n_vertices + n_all, sizeof *number);
    uint8_t *mark = iccp_alloc(memory, whole->n_vertices, 1);
    icc_status status = iccp_plmap_begin(&part->map, most, n, whole->stretch, memory);
    part->vertex = iccp_alloc(memory, most, sizeof *part->vertex);
    part->corners = iccp_alloc(memory, 3 * n, sizeof *part->corners);
    part->is_inside = iccp_alloc(memory, n_all, 1);
    if (number == NULL || mark == NULL || part->vertex == NULL || part->corners == NULL ||
        part->is_inside == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        part->map.featured = whole->featured;
        mark_vertices(s, mark);
        take_vertices(part, whole, mark, true, number);
        part->n_fixed = part->n_first;
        take_vertices(part, whole, mark, false, number);
        take_triangles(part, s, number, number + whole->n_vertices);
        part->n_triangles = n;
        if (n > 0)
            memcpy(part->corners, part->map.corners.vertex, 3 * n * sizeof *part->corners);
    }
    iccp_free(memory, number);
    iccp_free(memory, mark);
    return status;
}

icc_status iccp_moving_part_create(iccp_moving_part *part, const iccp_plmap *whole,
                                   const icc_domain *old_target, const icc_domain *target,
                                   const iccp_env *env)
{
    const size_t n = whole->corners.n_triangles;
    *part = (iccp_moving_part){.map.memory = env->memory,
                               .is_whole = !is_same_frame(&old_target->frame, &target->frame)};
    if (part->is_whole)
        return ICC_OK;
    search s = {.map = whole,
                .old_target = old_target,
                .target = target,
                .mark = iccp_alloc_zero(&env->memory, n, 1),
                .moves = iccp_alloc(&env->memory, whole->n_vertices, 1),
                .stack = iccp_alloc(&env->memory, n, sizeof *s.stack)};
    const bool has_room = s.mark != NULL && s.moves != NULL && s.stack != NULL;
    icc_status status = has_room ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        find_changes(&s);
    part->is_whole = s.n_changes == n;
    if (status == ICC_OK && !part->is_whole)
        status = cut_out(part, &s, env);
    iccp_free(&env->memory, s.mark);
    iccp_free(&env->memory, s.moves);
    iccp_free(&env->memory, s.stack);
    if (status != ICC_OK)
        iccp_moving_part_free(part);
    return status;
}

void iccp_moving_part_free(iccp_moving_part *part)
{
    const iccp_memory memory = part->map.memory;
    iccp_plmap_free(&part->map);
    iccp_free(&memory, part->vertex);
    iccp_free(&memory, part->corners);
    iccp_free(&memory, part->is_inside);
    *part = (iccp_moving_part){.map.memory = memory};
}

/* ---- putting it back ---- */

static bool has_first_mesh(const iccp_moving_part *part)
{
    const iccp_corners *c = &part->map.corners;
    return part->map.n_vertices == part->n_first && c->n_triangles == part->n_triangles &&
           memcmp(c->vertex, part->corners, 3 * c->n_triangles * sizeof *c->vertex) == 0;
}

/* Copies the points and images of the first n vertices of the part to `to`. `number`: of each
 * vertex of the whole map, its number in `to`. NULL: `to` is the whole map. */
static void copy_places(iccp_plmap *to, const iccp_moving_part *part, size_t n,
                        const uint32_t *number)
{
    for (size_t k = 0; k < n; ++k) {
        const size_t v = number != NULL ? number[part->vertex[k]] : part->vertex[k];
        memcpy(to->points + 2 * v, part->map.points + 2 * k, 2 * sizeof *to->points);
        memcpy(to->images + 2 * v, part->map.images + 2 * k, 2 * sizeof *to->images);
    }
}

/* Fills `fresh` with the vertices and triangles outside the part, and then with those of the part.
 * `number`: of each vertex of `whole`, NONE if it was a free vertex of the part, else 0. `own`:
 * room for the numbers of the part's vertices. */
static void merge(iccp_plmap *fresh, const iccp_moving_part *part, const iccp_plmap *whole,
                  uint32_t *number, uint32_t *own)
{
    const iccp_corners *outside = &whole->corners, *inside = &part->map.corners;
    uint32_t n = 0, *vertex = fresh->corners.vertex;
    for (size_t v = 0; v < whole->n_vertices; ++v)
        if (number[v] != NONE) {
            iccp_plmap_copy_vertex(fresh, n, whole, v);
            number[v] = n++;
        }
    copy_places(fresh, part, part->n_fixed, number);
    for (size_t k = 0; k < part->map.n_vertices; ++k) {
        own[k] = k < part->n_fixed ? number[part->vertex[k]] : n++;
        if (k >= part->n_fixed)
            iccp_plmap_copy_vertex(fresh, own[k], &part->map, k);
    }
    for (size_t x = 0; x < 3 * outside->n_triangles; ++x)
        if (!part->is_inside[x / 3])
            *vertex++ = number[outside->vertex[x]];
    for (size_t x = 0; x < 3 * inside->n_triangles; ++x)
        *vertex++ = own[inside->vertex[x]];
}

/* Makes the whole map anew, because the mesh of the part has changed. */
static icc_status put_back_mesh(const iccp_moving_part *part, iccp_plmap *whole,
                                const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_gone = part->n_first - part->n_fixed;
    iccp_plmap fresh;
    bool is_manifold = true;
    icc_status status = iccp_plmap_begin(
        &fresh, whole->n_vertices - n_gone + part->map.n_vertices - part->n_fixed,
        whole->corners.n_triangles - part->n_triangles + part->map.corners.n_triangles,
        whole->stretch, memory);
    uint32_t *number = iccp_alloc_zero(memory, whole->n_vertices, sizeof *number);
    uint32_t *own = iccp_alloc(memory, part->map.n_vertices, sizeof *own);
    if (number == NULL || own == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        fresh.featured = whole->featured;
        fresh.held = whole->held;
        for (size_t k = part->n_fixed; k < part->n_first; ++k)
            number[part->vertex[k]] = NONE;
        merge(&fresh, part, whole, number, own);
        status = iccp_find_twins(&fresh.corners, fresh.n_vertices, &is_manifold, env);
    }
    if (status == ICC_OK && !is_manifold)
        status = ICC_ERR_CERTIFICATE;
    if (status == ICC_OK) {
        const iccp_plmap old = *whole;
        *whole = fresh;
        fresh = old;
    }
    iccp_plmap_free(&fresh);
    iccp_free(memory, number);
    iccp_free(memory, own);
    return status;
}

icc_status iccp_moving_part_put_back(const iccp_moving_part *part, iccp_plmap *whole,
                                     const iccp_env *env)
{
    if (!has_first_mesh(part))
        return put_back_mesh(part, whole, env);
    copy_places(whole, part, part->n_first, NULL);
    return ICC_OK;
}
