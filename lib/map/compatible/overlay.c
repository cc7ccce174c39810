/* Makes the overlay of two triangulated polygons: B. Aronov, R. Seidel, D. Souvaine, On compatible
 * triangulations of simple polygons, 1993.
 *
 * All diagonals of both polygons are drawn in one convex polygon. The order of their ends tells
 * which of them cross, and in which order. So integers decide everything. Each crossing becomes a
 * vertex. These vertices may lie anywhere on the diagonals if their order is kept: the cells
 * between the diagonals are convex in both polygons. So they are spread evenly.
 *
 * The code walks along the source's diagonals through the target's triangles. Then it cuts each
 * triangle along the pieces of diagonals that run through it. */
#include "map/compatible/overlay.h"

#include "base/sort.h"

#include <string.h>

/* Polygons with n corners can have n^2 crossings. More than these are refused. */
enum { MOST_CROSSINGS = 100000, MOST_CROSSINGS_PER_CORNER = 100, CHORDS_PER_REPORT = 1024 };

/* The crossing of a source diagonal and a target diagonal. It becomes vertex n + its index. */
typedef struct crossing {
    uint32_t edge; /* of the target: the smaller of the two corners that face it */
    uint32_t vertex;
    uint64_t along; /* grows from the first end of that edge to the second */
} crossing;

/* The piece of a source diagonal in one triangle of the target, between two vertices of the
 * result. */
typedef struct piece {
    uint32_t triangle, from, to, span;
} piece;

typedef struct overlay {
    const iccp_memory *memory;
    uint32_t n;
    iccp_ngon side[2]; /* source, target */
    uint32_t *corner;  /* n: from find_starts() */
    crossing *crossings;
    piece *pieces;
    size_t n_crossings, crossing_room, n_pieces, piece_room;
    double *points, *images; /* of the result */
    uint32_t *first;         /* of each target edge, by corner: its first crossing; then the end */
    uint32_t *place, *next;  /* of each vertex on the border of the current triangle */
    uint32_t *border;
    iccp_corners result;
} overlay;

/* Whether x comes after a and before b around the polygon. */
static bool is_between(const overlay *o, uint32_t a, uint32_t x, uint32_t b)
{
    const uint32_t n = o->n, to_x = (x + n - a) % n, to_b = (b + n - a) % n;
    return to_x > 0 && to_x < to_b;
}

/* ---- walking ---- */

static icc_status push_piece(overlay *o, uint32_t triangle, uint32_t from, uint32_t to)
{
    if (o->n_pieces == o->piece_room) {
        const size_t room = 2 * o->piece_room + 256;
        piece *pieces = iccp_grow(o->memory, o->pieces, o->n_pieces, room, sizeof *pieces);
        if (pieces == NULL)
            return ICC_ERR_MEMORY;
        o->pieces = pieces;
        o->piece_room = room;
    }
    o->pieces[o->n_pieces++] = (piece){triangle, from, to, 0};
    return ICC_OK;
}

static icc_status push_crossing(overlay *o, const crossing *c)
{
    if (o->n_crossings == MOST_CROSSINGS + MOST_CROSSINGS_PER_CORNER * (size_t)o->n)
        return ICC_ERR_RESOLUTION;
    if (o->n_crossings == o->crossing_room) {
        const size_t room = 2 * o->crossing_room + 256;
        crossing *all = iccp_grow(o->memory, o->crossings, o->n_crossings, room, sizeof *all);
        if (all == NULL)
            return ICC_ERR_MEMORY;
        o->crossings = all;
        o->crossing_room = room;
    }
    o->crossings[o->n_crossings++] = *c;
    return ICC_OK;
}

/* Returns the target's corner at i whose opposite edge the diagonal from i to j crosses first.
 * ICCP_NO_NEIGHBOUR if i and j are joined by an edge. */
static uint32_t leaving_corner(const overlay *o, uint32_t i, uint32_t j)
{
    const uint32_t *v = o->side[1].triangles;
    uint32_t c = o->corner[i];
    while (v[iccp_before(c)] != j && !is_between(o, v[iccp_after(c)], j, v[iccp_before(c)]))
        c = iccp_after(o->side[1].twins[iccp_after(c)]);
    return v[iccp_before(c)] == j ? ICCP_NO_NEIGHBOUR : c;
}

/* The crossing of source diagonal i j with the target's edge that a corner faces. Diagonals that
 * cross the same edge do not cross each other. So they are ordered by a sum of two numbers of
 * steps from the edge's first end. One leads to one end of the diagonal, the other leads the other
 * way around to its other end. */
static crossing crossing_of(const overlay *o, uint32_t corner, uint32_t i, uint32_t j)
{
    const uint32_t twin = o->side[1].twins[corner], edge = corner < twin ? corner : twin;
    const uint32_t a = o->side[1].triangles[iccp_after(edge)],
                   b = o->side[1].triangles[iccp_before(edge)];
    const uint32_t inner = is_between(o, a, i, b) ? i : j, outer = inner == i ? j : i, n = o->n;
    const uint64_t along = (uint64_t)((inner + n - a) % n) + (a + n - outer) % n;
    return (crossing){edge, n + (uint32_t)o->n_crossings, along};
}

/* Walks from i to j through the target's triangles, each time across the edge that has j on its far
 * side. Records a crossing at each edge and a piece in each triangle. */
static icc_status walk(overlay *o, uint32_t i, uint32_t j)
{
    uint32_t corner = leaving_corner(o, i, j), from = i;
    icc_status status = ICC_OK;
    while (status == ICC_OK && corner != ICCP_NO_NEIGHBOUR) {
        const crossing c = crossing_of(o, corner, i, j);
        const uint32_t twin = o->side[1].twins[corner], tip = o->side[1].triangles[twin];
        status = push_crossing(o, &c);
        if (status == ICC_OK)
            status = push_piece(o, corner / 3, from, c.vertex);
        from = c.vertex;
        if (tip == j) {
            corner = ICCP_NO_NEIGHBOUR;
            if (status == ICC_OK)
                status = push_piece(o, twin / 3, from, j);
        } else {
            const uint32_t first = o->side[1].triangles[iccp_before(twin)];
            corner = is_between(o, first, j, tip) ? iccp_after(twin) : iccp_before(twin);
        }
    }
    return status;
}

/* ---- places of the points ---- */

static void spread(double *points, uint32_t a, uint32_t b, size_t rank, size_t n, uint32_t vertex)
{
    const double share = (double)(rank + 1) / (double)(n + 1);
    for (size_t d = 0; d < 2; ++d) {
        const double from = points[2 * (size_t)a + d], to = points[2 * (size_t)b + d];
        points[2 * (size_t)vertex + d] = from + share * (to - from);
    }
}

static icc_status walk_all(overlay *o, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (uint32_t c = 0; status == ICC_OK && c < 3 * (o->n - 2); ++c) {
        if (o->side[0].twins[c] == ICCP_NO_NEIGHBOUR || o->side[0].twins[c] < c)
            continue;
        if (c % CHORDS_PER_REPORT == 0)
            status = iccp_progress(env, "mesh", (double)c / (3.0 * o->n));
        if (status == ICC_OK)
            status =
                walk(o, o->side[0].triangles[iccp_after(c)], o->side[0].triangles[iccp_before(c)]);
    }
    return status;
}

/* Corners keep their places. Crossings are spread along their source diagonals. */
static icc_status place_points(overlay *o)
{
    const size_t n = o->n + o->n_crossings;
    o->points = iccp_alloc(o->memory, n, 2 * sizeof *o->points);
    o->images = iccp_alloc(o->memory, n, 2 * sizeof *o->images);
    if (o->points == NULL || o->images == NULL)
        return ICC_ERR_MEMORY;
    memcpy(o->points, o->side[0].points, o->n * 2 * sizeof *o->points);
    memcpy(o->images, o->side[1].points, o->n * 2 * sizeof *o->images);
    /* The pieces of a source diagonal follow one another: m crossings, m + 1 pieces. */
    for (size_t p = 0; p < o->n_pieces;) {
        size_t m = 0;
        while (o->pieces[p + m].to >= o->n)
            ++m;
        for (size_t k = 0; k < m; ++k)
            spread(o->points, o->pieces[p].from, o->pieces[p + m].to, k, m, o->pieces[p + k].to);
        p += m + 1;
    }
    return ICC_OK;
}

static int by_place(const void *a, const void *b)
{
    const crossing *x = a, *y = b;
    return (x->along > y->along) - (x->along < y->along);
}

/* Sorts crossings by target edge, and along each edge. */
static icc_status sort_crossings(overlay *o)
{
    const size_t n_corners = 3 * ((size_t)o->n - 2);
    crossing *sorted = iccp_alloc(o->memory, o->n_crossings, sizeof *sorted);
    o->first = iccp_alloc_zero(o->memory, n_corners + 1, sizeof *o->first);
    if (sorted == NULL || o->first == NULL) {
        iccp_free(o->memory, sorted);
        return ICC_ERR_MEMORY;
    }
    iccp_sort_by_count(sorted, o->first, n_corners, o->crossings, o->n_crossings, sizeof *sorted);
    iccp_free(o->memory, o->crossings);
    o->crossings = sorted;
    for (size_t c = 0; c < n_corners; ++c)
        if (o->first[c + 1] > o->first[c])
            iccp_sort(sorted + o->first[c], o->first[c + 1] - o->first[c], sizeof *sorted,
                      by_place);
    return ICC_OK;
}

static icc_status place_images(overlay *o)
{
    const size_t n_corners = 3 * ((size_t)o->n - 2);
    const icc_status status = sort_crossings(o);
    if (status != ICC_OK)
        return status;
    for (uint32_t c = 0; c < n_corners; ++c) {
        const uint32_t a = o->side[1].triangles[iccp_after(c)],
                       b = o->side[1].triangles[iccp_before(c)];
        const size_t begin = o->first[c], n = o->first[c + 1] - begin;
        for (size_t k = 0; k < n; ++k)
            spread(o->images, a, b, k, n, o->crossings[begin + k].vertex);
    }
    return ICC_OK;
}

/* ---- cutting ---- */

/* The vertices along the edges of a triangle, counter-clockwise. */
static uint32_t list_border(overlay *o, uint32_t triangle)
{
    uint32_t n = 0;
    for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const uint32_t faces = iccp_before(c), twin = o->side[1].twins[faces];
        const bool reversed = twin != ICCP_NO_NEIGHBOUR && twin < faces;
        const uint32_t begin = o->first[reversed ? twin : faces];
        const uint32_t end = o->first[(reversed ? twin : faces) + 1];
        o->border[n++] = o->side[1].triangles[c];
        for (uint32_t k = 0; k < end - begin; ++k)
            o->border[n++] = o->crossings[reversed ? end - 1 - k : begin + k].vertex;
    }
    for (uint32_t k = 0; k < n; ++k) {
        o->place[o->border[k]] = k;
        o->next[k] = k + 1;
    }
    return n;
}

/* Adds the triangles of a convex cell: the border from place `from` to place `to`. */
static void emit_cell(overlay *o, uint32_t from, uint32_t to)
{
    for (uint32_t k = o->next[from]; k != to; k = o->next[k]) {
        uint32_t *v = o->result.vertex + 3 * o->result.n_triangles++;
        v[0] = o->border[from];
        v[1] = o->border[k];
        v[2] = o->border[o->next[k]];
    }
    o->next[from] = to;
}

static int by_span(const void *a, const void *b)
{
    const piece *x = a, *y = b;
    return (x->span > y->span) - (x->span < y->span);
}

/* Sorts pieces by triangle. first[t]: where those of triangle t begin. */
static icc_status sort_pieces(overlay *o, uint32_t *first)
{
    piece *sorted = iccp_alloc(o->memory, o->n_pieces, sizeof *sorted);
    if (sorted == NULL)
        return ICC_ERR_MEMORY;
    iccp_sort_by_count(sorted, first, o->n - 2, o->pieces, o->n_pieces, sizeof *sorted);
    iccp_free(o->memory, o->pieces);
    o->pieces = sorted;
    return ICC_OK;
}

/* Cuts a triangle into cells. The cell behind the shortest piece comes first, so all pieces behind
 * a longer one are gone when its turn comes. */
static void cut_triangle(overlay *o, uint32_t triangle, piece *pieces, size_t n)
{
    const uint32_t n_border = list_border(o, triangle);
    for (size_t k = 0; k < n; ++k) {
        const uint32_t a = o->place[pieces[k].from], b = o->place[pieces[k].to];
        pieces[k].from = a < b ? a : b;
        pieces[k].to = a < b ? b : a;
        pieces[k].span = pieces[k].to - pieces[k].from;
    }
    iccp_sort(pieces, n, sizeof *pieces, by_span);
    for (size_t k = 0; k < n; ++k)
        emit_cell(o, pieces[k].from, pieces[k].to);
    emit_cell(o, 0, n_border - 1);
}

/* Cuts the target's triangles one by one. */
static icc_status cut_all(overlay *o, const iccp_env *env)
{
    const size_t n_vertices = o->n + o->n_crossings;
    const size_t n_triangles = 2 * n_vertices - o->n - 2;
    o->place = iccp_alloc(o->memory, n_vertices, sizeof *o->place);
    o->next = iccp_alloc(o->memory, n_vertices, sizeof *o->next);
    o->border = iccp_alloc(o->memory, n_vertices, sizeof *o->border);
    o->result.vertex = iccp_alloc(o->memory, n_triangles, 3 * sizeof(uint32_t));
    o->result.twin = iccp_alloc(o->memory, n_triangles, 3 * sizeof(uint32_t));
    if (o->place == NULL || o->next == NULL || o->border == NULL || o->result.vertex == NULL ||
        o->result.twin == NULL)
        return ICC_ERR_MEMORY;
    uint32_t *first = iccp_alloc_zero(o->memory, o->n - 1, sizeof *first);
    icc_status status = first != NULL ? sort_pieces(o, first) : ICC_ERR_MEMORY;
    for (uint32_t t = 0; status == ICC_OK && t < o->n - 2; ++t)
        cut_triangle(o, t, o->pieces + first[t], first[t + 1] - first[t]);
    iccp_free(o->memory, first);
    if (status != ICC_OK)
        return status;
    bool is_manifold;
    status = iccp_find_twins(&o->result, n_vertices, &is_manifold, env);
    return status == ICC_OK && !is_manifold ? ICC_ERR_TOPOLOGY : status;
}

/* ---- all of it ---- */

/* Finds where walks begin: for each vertex, its corner in the target triangle at the boundary edge
 * that follows it. */
static icc_status find_starts(overlay *o)
{
    const iccp_ngon *target = &o->side[1];
    o->corner = iccp_alloc(o->memory, o->n, sizeof *o->corner);
    if (o->corner == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t c = 0; c < 3 * (o->n - 2); ++c)
        if (target->twins[c] == ICCP_NO_NEIGHBOUR)
            o->corner[target->triangles[iccp_after(c)]] = iccp_after(c);
    return ICC_OK;
}

static void release(overlay *o)
{
    iccp_free(o->memory, o->corner);
    iccp_free(o->memory, o->crossings);
    iccp_free(o->memory, o->pieces);
    iccp_free(o->memory, o->first);
    iccp_free(o->memory, o->place);
    iccp_free(o->memory, o->next);
    iccp_free(o->memory, o->border);
}

icc_status iccp_overlay_create(iccp_overlay *out, uint32_t n, const iccp_ngon *source,
                               const iccp_ngon *target, const iccp_env *env)
{
    overlay o = {.memory = &env->memory, .n = n, .side = {*source, *target}};
    icc_status status = find_starts(&o);
    if (status == ICC_OK)
        status = walk_all(&o, env);
    if (status == ICC_OK)
        status = place_points(&o);
    if (status == ICC_OK)
        status = place_images(&o);
    if (status == ICC_OK)
        status = cut_all(&o, env);
    *out = (iccp_overlay){env->memory, (size_t)o.n + o.n_crossings, o.points, o.images, o.result};
    release(&o);
    if (status != ICC_OK)
        iccp_overlay_free(out);
    return status;
}

void iccp_overlay_free(iccp_overlay *o)
{
    iccp_free(&o->memory, o->points);
    iccp_free(&o->memory, o->images);
    iccp_free(&o->memory, o->corners.vertex);
    iccp_free(&o->memory, o->corners.twin);
    *o = (iccp_overlay){.memory = o->memory};
}
