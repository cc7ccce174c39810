/* Words by crossed edges, as in M. Dehn's proof that curves on surfaces can be told apart: inside a
 * domain cut into triangles by its own vertices, what lies over a triangulation without its
 * vertices is a tree of triangles, in which the shortest way between two is unique.
 *
 * A polyline is followed as if its bends were moved by an infinitesimal vector (1, e), e being
 * smaller still: after H. Edelsbrunner, E. P. Muecke, Simulation of simplicity, 1990. Then it meets
 * no vertex but its ends, and each of its bends lies within a triangle. */
#include "map/isotopy/word.h"

#include "base/budget.h"
#include "math/predicates.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* What it takes to cross an edge, in multiplications. */
enum { STEP = 40 };

/* ---- triangulations ---- */

icc_status iccp_net_create(iccp_net *net, const iccp_corners *mesh, size_t n_vertices,
                           const double *points, const iccp_walls *walls, const iccp_memory *memory)
{
    *net = (iccp_net){.mesh = mesh, .points = points, .walls = walls};
    net->corner = iccp_alloc(memory, n_vertices, sizeof *net->corner);
    if (net->corner == NULL)
        return ICC_ERR_MEMORY;
    memset(net->corner, 0xff, n_vertices * sizeof *net->corner);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c)
        net->corner[mesh->vertex[c]] = c;
    return ICC_OK;
}

void iccp_net_free(iccp_net *net, const iccp_memory *memory)
{
    iccp_free(memory, net->corner);
    *net = (iccp_net){0};
}

/* The corners at a vertex, clockwise as far as they go; then, from the first one on, again. */
static uint32_t clockwise_most(const iccp_net *net, uint32_t corner)
{
    uint32_t at = corner, twin;
    while ((twin = net->mesh->twin[iccp_before(at)]) != NONE && iccp_before(twin) != corner)
        at = iccp_before(twin);
    return at;
}

/* Counter-clockwise; NONE after the last one. */
static uint32_t next_at(const iccp_net *net, uint32_t corner, uint32_t first)
{
    const uint32_t twin = net->mesh->twin[iccp_after(corner)];
    return twin == NONE || iccp_after(twin) == first ? NONE : iccp_after(twin);
}

uint32_t iccp_net_edge(const iccp_net *net, uint32_t a, uint32_t b)
{
    const uint32_t *v = net->mesh->vertex, first = clockwise_most(net, net->corner[a]);
    for (uint32_t at = first; at != NONE; at = next_at(net, at, first)) {
        const bool is_first = v[iccp_after(at)] == b;
        if (!is_first && v[iccp_before(at)] != b)
            continue;
        const uint32_t facing = is_first ? iccp_before(at) : iccp_after(at);
        const uint32_t twin = net->mesh->twin[facing];
        return twin < facing ? twin : facing;
    }
    return NONE;
}

/* ---- words ---- */

icc_status iccp_word_add(iccp_word *word, uint32_t right, uint32_t left, const iccp_env *env)
{
    if (word->n > 0 && word->sides[2 * word->n - 2] == left &&
        word->sides[2 * word->n - 1] == right) {
        --word->n;
        return ICC_OK;
    }
    if (word->n == word->room) {
        const size_t room = 2 * word->room + 8;
        const icc_status status = iccp_budget_keep(env, 2 * sizeof *word->sides * (double)room);
        if (status != ICC_OK)
            return status;
        uint32_t *sides =
            iccp_grow(&env->memory, word->sides, 2 * word->n, 2 * room, sizeof *word->sides);
        if (sides == NULL)
            return ICC_ERR_MEMORY;
        word->sides = sides;
        word->room = room;
    }
    word->sides[2 * word->n] = right;
    word->sides[2 * word->n++ + 1] = left;
    return ICC_OK;
}

static bool ends_at(const iccp_word *word, size_t crossing, uint32_t vertex)
{
    return word->sides[2 * crossing] == vertex || word->sides[2 * crossing + 1] == vertex;
}

/* Edges at its own ends are turned past. */
static void strip(iccp_word *word)
{
    size_t n = 0;
    while (n < word->n && ends_at(word, n, word->ends[0]))
        ++n;
    word->n -= n;
    if (n > 0 && word->n > 0)
        memmove(word->sides, word->sides + 2 * n, 2 * word->n * sizeof *word->sides);
    while (word->n > 0 && ends_at(word, word->n - 1, word->ends[1]))
        --word->n;
}

icc_status iccp_words_begin(iccp_words *words, size_t n, const iccp_memory *memory)
{
    *words = (iccp_words){.memory = *memory, .n = n};
    words->word = iccp_alloc_zero(memory, n, sizeof *words->word);
    if (words->word != NULL)
        return ICC_OK;
    words->n = 0;
    return ICC_ERR_MEMORY;
}

void iccp_words_free(iccp_words *words)
{
    for (size_t i = 0; i < words->n; ++i)
        iccp_free(&words->memory, words->word[i].sides);
    iccp_free(&words->memory, words->word);
    *words = (iccp_words){.memory = words->memory};
}

bool iccp_words_same(const iccp_words *a, const iccp_words *b)
{
    bool same = a->n == b->n;
    for (size_t i = 0; same && i < a->n; ++i) {
        const iccp_word *x = &a->word[i], *y = &b->word[i];
        same = x->n == y->n && memcmp(x->ends, y->ends, sizeof x->ends) == 0 &&
               (x->n == 0 || memcmp(x->sides, y->sides, 2 * x->n * sizeof *x->sides) == 0);
    }
    return same;
}

/* ---- following polylines ---- */

/* Each end may be a bend, which is moved a little. */
typedef struct piece {
    const double *p, *q;
    bool moves[2];
} piece;

/* The sign of the cross product of (1, e) and b - a. */
static int lean(const double *a, const double *b)
{
    return b[1] > a[1] ? 1 : b[1] < a[1] ? -1 : (a[0] > b[0]) - (a[0] < b[0]);
}

/* +1 for what is left of a piece, -1 for what is right of it; 0 only at ends that are not moved. */
static int side_of(const piece *s, const double *x)
{
    const int sign = iccp_orient2d(s->p, s->q, x);
    if (sign != 0)
        return sign;
    if (s->moves[0])
        return s->moves[1] ? lean(s->p, s->q) : lean(x, s->q);
    if (s->moves[1])
        return lean(s->p, x);
    return memcmp(x, s->p, 2 * sizeof *x) != 0 && memcmp(x, s->q, 2 * sizeof *x) != 0;
}

/* Whether the end of a piece is left of the edge from a to b. */
static bool is_left(const piece *s, const double *a, const double *b)
{
    const int sign = iccp_orient2d(a, b, s->q);
    return sign > 0 || (sign == 0 && (!s->moves[1] || lean(a, b) < 0));
}

static const double *point_at(const iccp_net *net, uint32_t corner)
{
    return net->points + 2 * (size_t)net->mesh->vertex[corner];
}

/* The corner at a piece's beginning between whose sides the piece leaves; NONE: it does not. `to`:
 * a vertex that the piece may end at, or NONE. */
static uint32_t find_start(const iccp_net *net, const piece *s, uint32_t from, uint32_t to)
{
    const uint32_t *v = net->mesh->vertex, first = clockwise_most(net, net->corner[from]);
    for (uint32_t at = first; at != NONE; at = next_at(net, at, first))
        if (v[iccp_after(at)] == to || v[iccp_before(at)] == to)
            return at;
    for (uint32_t at = first; at != NONE; at = next_at(net, at, first))
        if (side_of(s, point_at(net, iccp_after(at))) < 0 &&
            side_of(s, point_at(net, iccp_before(at))) > 0)
            return at;
    return NONE;
}

static bool has_vertex(const iccp_net *net, uint32_t triangle, uint32_t vertex)
{
    const uint32_t *v = net->mesh->vertex + 3 * (size_t)triangle;
    return v[0] == vertex || v[1] == vertex || v[2] == vertex;
}

/* The corner that faces the edge by which a piece leaves a triangle; NONE: it ends there. */
static uint32_t find_exit(const iccp_net *net, const piece *s, uint32_t triangle)
{
    for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const double *a = point_at(net, iccp_after(c)), *b = point_at(net, iccp_before(c));
        if (side_of(s, a) < 0 && side_of(s, b) > 0 && !is_left(s, a, b))
            return c;
    }
    return NONE;
}

/* Follows one piece from a triangle on, which becomes the one that it ends in. */
static icc_status follow_piece(iccp_word *word, const iccp_net *net, const piece *s, uint32_t to,
                               uint32_t *triangle, const iccp_env *env)
{
    const uint32_t *v = net->mesh->vertex;
    for (size_t k = 0; k <= net->mesh->n_triangles; ++k) {
        const icc_status spent = iccp_budget_work(env, STEP);
        if (spent != ICC_OK)
            return spent;
        if (to != NONE && has_vertex(net, *triangle, to))
            return ICC_OK;
        const uint32_t c = find_exit(net, s, *triangle);
        if (c == NONE)
            return to == NONE ? ICC_OK : ICC_ERR_TOPOLOGY;
        const uint32_t twin = net->mesh->twin[c], a = v[iccp_after(c)], b = v[iccp_before(c)];
        if (twin == NONE || (net->walls != NULL && iccp_walls_have(net->walls, a, b)))
            return ICC_ERR_TOPOLOGY;
        const icc_status status = iccp_word_add(word, a, b, env);
        if (status != ICC_OK)
            return status;
        *triangle = twin / 3;
    }
    return ICC_ERR_TOPOLOGY;
}

icc_status iccp_word_read(iccp_word *word, const iccp_net *net, uint32_t from, uint32_t to,
                          size_t n, const double *bends, const iccp_env *env)
{
    const double *last = net->points + 2 * (size_t)to;
    piece s = {.p = net->points + 2 * (size_t)from};
    uint32_t triangle = NONE;
    icc_status status = ICC_OK;
    word->n = 0;
    word->ends[0] = from;
    word->ends[1] = to;
    for (size_t k = 0; status == ICC_OK && k <= n; ++k) {
        const uint32_t end = k == n ? to : NONE;
        s.q = k < n ? bends + 2 * k : last;
        s.moves[0] = k > 0;
        s.moves[1] = k < n;
        if (k > 0 && k < n && s.p[0] == s.q[0] && s.p[1] == s.q[1])
            continue;
        if (k == 0) {
            const uint32_t corner = find_start(net, &s, from, end);
            if (corner == NONE)
                return ICC_ERR_TOPOLOGY;
            triangle = corner / 3;
        }
        status = follow_piece(word, net, &s, end, &triangle, env);
        s.p = s.q;
    }
    strip(word);
    return status;
}

/* ---- cuts ---- */

icc_status iccp_words_of_cuts(iccp_words *words, const iccp_cuts *cuts, const iccp_net *target,
                              const iccp_env *env)
{
    icc_status status = iccp_words_begin(words, cuts->n, &env->memory);
    for (size_t i = 0; status == ICC_OK && i < cuts->n; ++i) {
        const size_t first = cuts->first[i], n = cuts->first[i + 1] - first;
        status = iccp_word_read(&words->word[i], target, cuts->ends[2 * i], cuts->ends[2 * i + 1],
                                n, n > 0 ? cuts->points[1] + 2 * first : NULL, env);
    }
    if (status != ICC_OK)
        iccp_words_free(words);
    return status;
}

/* The middles of the images of edges that a word of the mesh crosses: between these a path within
 * images of triangles crosses the same edges. */
static icc_status list_middles(iccp_polyline *line, const iccp_word *word, const iccp_plmap *map,
                               const iccp_env *env)
{
    icc_status status = ICC_OK;
    line->n = 0;
    for (size_t k = 0; status == ICC_OK && k < word->n; ++k) {
        const double *a = map->images + 2 * (size_t)word->sides[2 * k];
        const double *b = map->images + 2 * (size_t)word->sides[2 * k + 1];
        const double middle[2] = {0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1]};
        status = iccp_polyline_add(line, middle, &env->memory);
    }
    return status;
}

/* `vertex`: of the mesh, at each of the source. */
static icc_status read_images(iccp_words *words, const iccp_cuts *cuts, const iccp_plmap *map,
                              const uint32_t *vertex, const iccp_net *mesh, const iccp_net *target,
                              const iccp_env *env)
{
    iccp_word before = {.n = 0};
    iccp_polyline line = {0};
    icc_status status = ICC_OK;
    for (size_t i = 0; status == ICC_OK && i < cuts->n; ++i) {
        const uint32_t *ends = cuts->ends + 2 * i;
        const size_t first = cuts->first[i], n = cuts->first[i + 1] - first;
        status = iccp_word_read(&before, mesh, vertex[ends[0]], vertex[ends[1]], n,
                                n > 0 ? cuts->points[0] + 2 * first : NULL, env);
        if (status == ICC_OK)
            status = list_middles(&line, &before, map, env);
        if (status == ICC_OK)
            status =
                iccp_word_read(&words->word[i], target, ends[0], ends[1], line.n, line.points, env);
    }
    iccp_free(&env->memory, before.sides);
    iccp_polyline_free(&line, &env->memory);
    return status;
}

icc_status iccp_words_of_images(iccp_words *words, const iccp_cuts *cuts, const iccp_plmap *map,
                                const icc_domain *source, const iccp_net *target,
                                const iccp_env *env)
{
    uint32_t *vertex = iccp_alloc(&env->memory, source->n_vertices, sizeof *vertex);
    iccp_net mesh;
    icc_status status = iccp_words_begin(words, cuts->n, &env->memory);
    if (status == ICC_OK && vertex == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK && !iccp_plmap_find_vertices(map, source, vertex))
        status = ICC_ERR_TOPOLOGY;
    if (status == ICC_OK) {
        status =
            iccp_net_create(&mesh, &map->corners, map->n_vertices, map->points, NULL, &env->memory);
        if (status == ICC_OK)
            status = read_images(words, cuts, map, vertex, &mesh, target, env);
        iccp_net_free(&mesh, &env->memory);
    }
    iccp_free(&env->memory, vertex);
    if (status != ICC_OK)
        iccp_words_free(words);
    return status;
}
