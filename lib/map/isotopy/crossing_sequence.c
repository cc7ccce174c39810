/* Finds and compares sequences of crossings. Paths are compared by the edges that they cross, as in
 * M. Dehn's proof that curves on surfaces can be told apart (1912). The triangulation has no
 * vertices inside the domain. So its universal cover is a tree of triangles, where only one
 * shortest path joins two triangles.
 *
 * A polyline is followed as if its bends were moved by an infinitesimal vector (1, e), where e is
 * smaller still: H. Edelsbrunner, E. P. Muecke, Simulation of simplicity, 1990. So the polyline
 * meets no vertex but its ends, and each bend lies inside a triangle. */
#include "map/isotopy/crossing_sequence.h"

#include "base/budget.h"
#include "math/predicates.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* Work for crossing one edge, in multiplications. */
enum { STEP = 40 };

/* ---- triangulations ---- */

icc_status iccp_triangulation_create(iccp_triangulation *triangulation, const iccp_corners *mesh,
                                     size_t n_vertices, const double *points,
                                     const iccp_walls *walls, const iccp_memory *memory)
{
    *triangulation = (iccp_triangulation){.mesh = mesh, .points = points, .walls = walls};
    return iccp_fans_create(&triangulation->fans, mesh, n_vertices, memory);
}

void iccp_triangulation_free(iccp_triangulation *triangulation, const iccp_memory *memory)
{
    iccp_fans_free(&triangulation->fans, memory);
    *triangulation = (iccp_triangulation){0};
}

/* ---- sequences ---- */

icc_status iccp_sequence_add(iccp_sequence *sequence, uint32_t right, uint32_t left,
                             const iccp_env *env)
{
    if (sequence->n > 0 && sequence->sides[2 * sequence->n - 2] == left &&
        sequence->sides[2 * sequence->n - 1] == right) {
        --sequence->n;
        return ICC_OK;
    }
    if (sequence->n == sequence->room) {
        const size_t room = 2 * sequence->room + 8;
        const icc_status status = iccp_budget_keep(env, 2 * sizeof *sequence->sides * (double)room);
        if (status != ICC_OK)
            return status;
        uint32_t *sides = iccp_grow(&env->memory, sequence->sides, 2 * sequence->n, 2 * room,
                                    sizeof *sequence->sides);
        if (sides == NULL)
            return ICC_ERR_MEMORY;
        sequence->sides = sides;
        sequence->room = room;
    }
    sequence->sides[2 * sequence->n] = right;
    sequence->sides[2 * sequence->n++ + 1] = left;
    return ICC_OK;
}

static bool ends_at(const iccp_sequence *sequence, size_t crossing, uint32_t vertex)
{
    return sequence->sides[2 * crossing] == vertex || sequence->sides[2 * crossing + 1] == vertex;
}

/* Drops crossings of edges that end at the path's own end points. Rotating a path around its end
 * point does not change its class. */
static void strip(iccp_sequence *sequence)
{
    size_t n = 0;
    while (n < sequence->n && ends_at(sequence, n, sequence->ends[0]))
        ++n;
    sequence->n -= n;
    if (n > 0 && sequence->n > 0)
        memmove(sequence->sides, sequence->sides + 2 * n,
                2 * sequence->n * sizeof *sequence->sides);
    while (sequence->n > 0 && ends_at(sequence, sequence->n - 1, sequence->ends[1]))
        --sequence->n;
}

icc_status iccp_sequences_begin(iccp_sequences *sequences, size_t n, const iccp_memory *memory)
{
    *sequences = (iccp_sequences){.memory = *memory, .n = n};
    sequences->sequence = iccp_alloc_zero(memory, n, sizeof *sequences->sequence);
    if (sequences->sequence != NULL)
        return ICC_OK;
    sequences->n = 0;
    return ICC_ERR_MEMORY;
}

void iccp_sequences_free(iccp_sequences *sequences)
{
    for (size_t i = 0; i < sequences->n; ++i)
        iccp_free(&sequences->memory, sequences->sequence[i].sides);
    iccp_free(&sequences->memory, sequences->sequence);
    *sequences = (iccp_sequences){.memory = sequences->memory};
}

bool iccp_sequences_same(const iccp_sequences *a, const iccp_sequences *b)
{
    bool same = a->n == b->n;
    for (size_t i = 0; same && i < a->n; ++i) {
        const iccp_sequence *x = &a->sequence[i], *y = &b->sequence[i];
        same = x->n == y->n && memcmp(x->ends, y->ends, sizeof x->ends) == 0 &&
               (x->n == 0 || memcmp(x->sides, y->sides, 2 * x->n * sizeof *x->sides) == 0);
    }
    return same;
}

/* ---- following polylines ---- */

/* A straight piece of a polyline. An end that is a bend is moved by the infinitesimal vector. */
typedef struct piece {
    const double *p, *q;
    bool moves[2];
} piece;

/* The sign of the cross product of (1, e) and b - a. */
static int lean(const double *a, const double *b)
{
    return b[1] > a[1] ? 1 : b[1] < a[1] ? -1 : (a[0] > b[0]) - (a[0] < b[0]);
}

/* +1 if x is left of a piece, -1 if it is right of it. The result is 0 only at ends that are not
 * moved. */
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

/* Returns true if the end of a piece is left of the edge from a to b. */
static bool is_left(const piece *s, const double *a, const double *b)
{
    const int sign = iccp_orient2d(a, b, s->q);
    return sign > 0 || (sign == 0 && (!s->moves[1] || lean(a, b) < 0));
}

static const double *point_at(const iccp_triangulation *triangulation, uint32_t corner)
{
    return triangulation->points + 2 * (size_t)triangulation->mesh->vertex[corner];
}

/* Returns the corner at the piece's first vertex whose triangle the piece enters, or NONE. `to` is
 * a vertex where the piece may end, or NONE. */
static uint32_t find_start(const iccp_triangulation *triangulation, const piece *s, uint32_t from,
                           uint32_t to)
{
    const iccp_corners *mesh = triangulation->mesh;
    const iccp_fans *fans = &triangulation->fans;
    const iccp_turn first = iccp_turn_begin(fans, mesh, from);
    for (iccp_turn at = first; at.corner != NONE; iccp_turn_next(&at, fans, mesh))
        if (mesh->vertex[iccp_after(at.corner)] == to || mesh->vertex[iccp_before(at.corner)] == to)
            return at.corner;
    for (iccp_turn at = first; at.corner != NONE; iccp_turn_next(&at, fans, mesh))
        if (side_of(s, point_at(triangulation, iccp_after(at.corner))) < 0 &&
            side_of(s, point_at(triangulation, iccp_before(at.corner))) > 0)
            return at.corner;
    return NONE;
}

static bool has_vertex(const iccp_triangulation *triangulation, uint32_t triangle, uint32_t vertex)
{
    const uint32_t *v = triangulation->mesh->vertex + 3 * (size_t)triangle;
    return v[0] == vertex || v[1] == vertex || v[2] == vertex;
}

/* Returns the corner that faces the edge by which a piece leaves a triangle. NONE means that the
 * piece ends there. */
static uint32_t find_exit(const iccp_triangulation *triangulation, const piece *s,
                          uint32_t triangle)
{
    for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const double *a = point_at(triangulation, iccp_after(c)),
                     *b = point_at(triangulation, iccp_before(c));
        if (side_of(s, a) < 0 && side_of(s, b) > 0 && !is_left(s, a, b))
            return c;
    }
    return NONE;
}

/* Follows one piece from a triangle on. *triangle becomes the triangle where the piece ends. */
static icc_status follow_piece(iccp_sequence *sequence, const iccp_triangulation *triangulation,
                               const piece *s, uint32_t to, uint32_t *triangle, const iccp_env *env)
{
    const uint32_t *v = triangulation->mesh->vertex;
    for (size_t k = 0; k <= triangulation->mesh->n_triangles; ++k) {
        const icc_status spent = iccp_budget_work(env, STEP);
        if (spent != ICC_OK)
            return spent;
        if (to != NONE && has_vertex(triangulation, *triangle, to))
            return ICC_OK;
        const uint32_t c = find_exit(triangulation, s, *triangle);
        if (c == NONE)
            return to == NONE ? ICC_OK : ICC_ERR_TOPOLOGY;
        const uint32_t twin = triangulation->mesh->twin[c], a = v[iccp_after(c)],
                       b = v[iccp_before(c)];
        if (twin == NONE ||
            (triangulation->walls != NULL && iccp_walls_have(triangulation->walls, a, b)))
            return ICC_ERR_TOPOLOGY;
        const icc_status status = iccp_sequence_add(sequence, a, b, env);
        if (status != ICC_OK)
            return status;
        *triangle = twin / 3;
    }
    return ICC_ERR_TOPOLOGY;
}

icc_status iccp_sequence_read(iccp_sequence *sequence, const iccp_triangulation *triangulation,
                              uint32_t from, uint32_t to, size_t n, const double *bends,
                              const iccp_env *env)
{
    const double *last = triangulation->points + 2 * (size_t)to;
    piece s = {.p = triangulation->points + 2 * (size_t)from};
    uint32_t triangle = NONE;
    icc_status status = ICC_OK;
    sequence->n = 0;
    sequence->ends[0] = from;
    sequence->ends[1] = to;
    for (size_t k = 0; status == ICC_OK && k <= n; ++k) {
        const uint32_t end = k == n ? to : NONE;
        s.q = k < n ? bends + 2 * k : last;
        s.moves[0] = k > 0;
        s.moves[1] = k < n;
        if (k > 0 && k < n && s.p[0] == s.q[0] && s.p[1] == s.q[1])
            continue;
        if (k == 0) {
            const uint32_t corner = find_start(triangulation, &s, from, end);
            if (corner == NONE)
                return ICC_ERR_TOPOLOGY;
            triangle = corner / 3;
        }
        status = follow_piece(sequence, triangulation, &s, end, &triangle, env);
        s.p = s.q;
    }
    strip(sequence);
    return status;
}

/* ---- cuts ---- */

icc_status iccp_sequences_of_cuts(iccp_sequences *sequences, const iccp_cuts *cuts,
                                  const iccp_triangulation *target, const iccp_env *env)
{
    icc_status status = iccp_sequences_begin(sequences, cuts->n, &env->memory);
    for (size_t i = 0; status == ICC_OK && i < cuts->n; ++i) {
        const size_t first = cuts->first[i], n = cuts->first[i + 1] - first;
        status = iccp_sequence_read(&sequences->sequence[i], target, cuts->ends[2 * i],
                                    cuts->ends[2 * i + 1], n,
                                    n > 0 ? cuts->points[1] + 2 * first : NULL, env);
    }
    if (status != ICC_OK)
        iccp_sequences_free(sequences);
    return status;
}

/* Lists the middles of the images of the edges that a sequence of the map's mesh crosses. The
 * polyline through them crosses the same image edges, because each of its pieces stays in the image
 * of one triangle. */
static icc_status list_middles(iccp_polyline *line, const iccp_sequence *sequence,
                               const iccp_plmap *map, const iccp_env *env)
{
    icc_status status = ICC_OK;
    line->n = 0;
    for (size_t k = 0; status == ICC_OK && k < sequence->n; ++k) {
        const double *a = map->images + 2 * (size_t)sequence->sides[2 * k];
        const double *b = map->images + 2 * (size_t)sequence->sides[2 * k + 1];
        const double middle[2] = {0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1]};
        status = iccp_polyline_add(line, middle, &env->memory);
    }
    return status;
}

/* `vertex`: for each vertex of the source, the mesh's vertex there. */
static icc_status read_images(iccp_sequences *sequences, const iccp_cuts *cuts,
                              const iccp_plmap *map, const uint32_t *vertex,
                              const iccp_triangulation *mesh, const iccp_triangulation *target,
                              const iccp_env *env)
{
    iccp_sequence before = {.n = 0};
    iccp_polyline line = {0};
    icc_status status = ICC_OK;
    for (size_t i = 0; status == ICC_OK && i < cuts->n; ++i) {
        const uint32_t *ends = cuts->ends + 2 * i;
        const size_t first = cuts->first[i], n = cuts->first[i + 1] - first;
        status = iccp_sequence_read(&before, mesh, vertex[ends[0]], vertex[ends[1]], n,
                                    n > 0 ? cuts->points[0] + 2 * first : NULL, env);
        if (status == ICC_OK)
            status = list_middles(&line, &before, map, env);
        if (status == ICC_OK)
            status = iccp_sequence_read(&sequences->sequence[i], target, ends[0], ends[1], line.n,
                                        line.points, env);
    }
    iccp_free(&env->memory, before.sides);
    iccp_polyline_free(&line, &env->memory);
    return status;
}

icc_status iccp_sequences_of_images(iccp_sequences *sequences, const iccp_cuts *cuts,
                                    const iccp_plmap *map, const icc_domain *source,
                                    const iccp_triangulation *target, const iccp_env *env)
{
    uint32_t *vertex = iccp_alloc(&env->memory, source->n_vertices, sizeof *vertex);
    iccp_triangulation mesh;
    icc_status status = iccp_sequences_begin(sequences, cuts->n, &env->memory);
    if (status == ICC_OK && vertex == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK && !iccp_plmap_find_vertices(map, vertex))
        status = ICC_ERR_TOPOLOGY;
    if (status == ICC_OK) {
        status = iccp_triangulation_create(&mesh, &map->corners, map->n_vertices, map->points, NULL,
                                           &env->memory);
        if (status == ICC_OK)
            status = read_images(sequences, cuts, map, vertex, &mesh, target, env);
        iccp_triangulation_free(&mesh, &env->memory);
    }
    iccp_free(&env->memory, vertex);
    if (status != ICC_OK)
        iccp_sequences_free(sequences);
    return status;
}
