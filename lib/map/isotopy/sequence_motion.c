/* Moves paths along with vertices in a kinetic triangulation, as in L. Guibas, D. Russel, An
 * empirical comparison of techniques for updating Delaunay triangulations, 2004. It stays valid
 * until a triangle would become flat. Well before that, edges flip towards the Delaunay
 * triangulation. A flip changes the crossings of a path only inside its two triangles. Walls never
 * flip. */
#include "map/isotopy/sequence_motion.h"

#include "base/minmax.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* Length of a step, as a share of the way to the first flat triangle. */
static const double SHARE_OF_FLAT = 0.7;

/* Limits: steps of one motion, halvings of one step, passes over the edges after a step. */
enum { MOST_PARTS = 200, MOST_HALVINGS = 20, MOST_PASSES = 60 };

/* ---- the triangulation ---- */

icc_status iccp_moving_triangulation_create(iccp_moving_triangulation *m,
                                            const iccp_triangulation *triangulation, size_t n,
                                            const double *points, const iccp_memory *memory)
{
    const size_t n_corners = 3 * triangulation->mesh->n_triangles;
    *m = (iccp_moving_triangulation){.memory = *memory,
                                     .mesh = {iccp_alloc(memory, n_corners, sizeof(uint32_t)),
                                              iccp_alloc(memory, n_corners, sizeof(uint32_t)),
                                              triangulation->mesh->n_triangles},
                                     .points = iccp_alloc(memory, n, 2 * sizeof *points)};
    icc_status status = ICC_ERR_MEMORY;
    if (m->mesh.vertex != NULL && m->mesh.twin != NULL && m->points != NULL) {
        memcpy(m->mesh.vertex, triangulation->mesh->vertex, n_corners * sizeof(uint32_t));
        memcpy(m->mesh.twin, triangulation->mesh->twin, n_corners * sizeof(uint32_t));
        memcpy(m->points, points, 2 * n * sizeof *points);
        status = iccp_triangulation_create(&m->triangulation, &m->mesh, n, m->points,
                                           triangulation->walls, memory);
    }
    if (status != ICC_OK)
        iccp_moving_triangulation_free(m);
    return status;
}

void iccp_moving_triangulation_free(iccp_moving_triangulation *m)
{
    iccp_free(&m->memory, m->mesh.vertex);
    iccp_free(&m->memory, m->mesh.twin);
    iccp_free(&m->memory, m->points);
    iccp_triangulation_free(&m->triangulation, &m->memory);
    *m = (iccp_moving_triangulation){.memory = m->memory};
}

/* ---- flips ---- */

/* The edge from a to c becomes the edge from b to d. Seen from a, b is on its right and d on its
 * left. */
typedef struct flip {
    uint32_t a, b, c, d;
} flip;

static bool is_pair(uint32_t x, uint32_t y, uint32_t a, uint32_t b)
{
    return (x == a && y == b) || (x == b && y == a);
}

/* Tells in which of the new triangles an edge lies: -1 in that of a, +1 in that of c, 0 in
 * neither. */
static int side_of_edge(const flip *f, const uint32_t sides[2])
{
    if (is_pair(sides[0], sides[1], f->a, f->b) || is_pair(sides[0], sides[1], f->a, f->d))
        return -1;
    return is_pair(sides[0], sides[1], f->c, f->b) || is_pair(sides[0], sides[1], f->c, f->d);
}

static int side_of_vertex(const flip *f, uint32_t v)
{
    return v == f->a ? -1 : v == f->c;
}

/* Adds a crossing of the new edge if the path goes from one new triangle to the other. */
static icc_status add_new(iccp_sequence *to, const flip *f, int before, int after,
                          const iccp_env *env)
{
    if (before * after >= 0)
        return ICC_OK;
    return before < 0 ? iccp_sequence_add(to, f->b, f->d, env)
                      : iccp_sequence_add(to, f->d, f->b, env);
}

static icc_status rewrite(iccp_sequence *to, const iccp_sequence *sequence, const flip *f,
                          const iccp_env *env)
{
    int before = side_of_vertex(f, sequence->ends[0]);
    icc_status status = ICC_OK;
    to->n = 0;
    memcpy(to->ends, sequence->ends, sizeof to->ends);
    for (size_t k = 0; status == ICC_OK && k < sequence->n; ++k) {
        const uint32_t *sides = sequence->sides + 2 * k;
        if (is_pair(sides[0], sides[1], f->a, f->c))
            continue;
        const int after = side_of_edge(f, sides);
        status = add_new(to, f, before, after, env);
        if (status == ICC_OK)
            status = iccp_sequence_add(to, sides[0], sides[1], env);
        before = after;
    }
    return status == ICC_OK ? add_new(to, f, before, side_of_vertex(f, sequence->ends[1]), env)
                            : status;
}

static icc_status rewrite_all(iccp_sequences *sequences, const flip *f, iccp_sequence *room,
                              const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (size_t i = 0; status == ICC_OK && i < sequences->n; ++i) {
        status = rewrite(room, &sequences->sequence[i], f, env);
        if (status == ICC_OK) {
            const iccp_sequence old = sequences->sequence[i];
            sequences->sequence[i] = *room;
            *room = old;
        }
    }
    return status;
}

static bool should_flip(const iccp_moving_triangulation *m, uint32_t corner, flip *f)
{
    const uint32_t *v = m->mesh.vertex, twin = m->mesh.twin[corner];
    if (twin == NONE)
        return false;
    *f = (flip){v[iccp_after(corner)], v[twin], v[iccp_before(corner)], v[corner]};
    if (m->triangulation.walls != NULL && iccp_walls_have(m->triangulation.walls, f->a, f->c))
        return false;
    const double *a = m->points + 2 * (size_t)f->a, *b = m->points + 2 * (size_t)f->b;
    const double *c = m->points + 2 * (size_t)f->c, *d = m->points + 2 * (size_t)f->d;
    return iccp_incircle(d, a, c, b) > 0 && iccp_orient2d(a, b, d) > 0 &&
           iccp_orient2d(c, d, b) > 0;
}

static icc_status flip_edges(iccp_sequences *sequences, iccp_moving_triangulation *m,
                             iccp_sequence *room, size_t *n_flips, const iccp_env *env)
{
    icc_status status = ICC_OK;
    *n_flips = 0;
    for (uint32_t c = 0; status == ICC_OK && c < 3 * m->mesh.n_triangles; ++c) {
        flip f;
        if (!should_flip(m, c, &f))
            continue;
        const uint32_t pair[2] = {3 * (c / 3), 3 * (m->mesh.twin[c] / 3)};
        iccp_flip_edge(&m->mesh, c);
        for (int t = 0; t < 2; ++t)
            for (uint32_t k = pair[t]; k < pair[t] + 3; ++k)
                iccp_fans_note(&m->triangulation.fans, &m->mesh, k);
        status = rewrite_all(sequences, &f, room, env);
        ++*n_flips;
    }
    return status;
}

/* ---- motion ---- */

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* Returns the first time after now when a triangle becomes flat, or HUGE_VAL. Its sides p and q
 * grow by u and v during the whole motion. */
static double flat_at(const double p[2], const double q[2], const double u[2], const double v[2])
{
    const double a = cross(u, v), b = cross(p, v) + cross(u, q), c = cross(p, q);
    const double root = b * b - 4 * a * c;
    if (!(root >= 0))
        return HUGE_VAL;
    /* c is positive. This is the smaller positive root, computed without cancellation. */
    if (b < 0)
        return 2 * c / (-b + sqrt(root));
    return a < 0 ? (-b - sqrt(root)) / (2 * a) : HUGE_VAL;
}

/* The share of the remaining way after which a triangle first becomes flat. */
static double first_flat(const iccp_moving_triangulation *m, const double *places)
{
    double least = HUGE_VAL;
    for (size_t t = 0; t < m->mesh.n_triangles; ++t) {
        const uint32_t *v = m->mesh.vertex + 3 * t;
        double p[2][2], u[2][2];
        for (size_t d = 0; d < 2; ++d)
            for (size_t k = 0; k < 2; ++k) {
                const size_t i = 2 * (size_t)v[0] + d, j = 2 * (size_t)v[k + 1] + d;
                p[k][d] = m->points[j] - m->points[i];
                u[k][d] = (places[j] - m->points[j]) - (places[i] - m->points[i]);
            }
        least = iccp_min(least, flat_at(p[0], p[1], u[0], u[1]));
    }
    return least;
}

static bool all_positive(const iccp_moving_triangulation *m)
{
    for (size_t t = 0; t < m->mesh.n_triangles; ++t) {
        const uint32_t *v = m->mesh.vertex + 3 * t;
        if (iccp_orient2d(m->points + 2 * (size_t)v[0], m->points + 2 * (size_t)v[1],
                          m->points + 2 * (size_t)v[2]) <= 0)
            return false;
    }
    return true;
}

/* Moves the vertices as far as no triangle becomes flat. *share is the part of the remaining way,
 * or 0 if no step is possible. `old` has room for the points. */
static void go(iccp_moving_triangulation *m, size_t n, const double *places, double *old,
               double *share)
{
    const double first = first_flat(m, places);
    *share = first > 1 / SHARE_OF_FLAT ? 1 : SHARE_OF_FLAT * first;
    memcpy(old, m->points, 2 * n * sizeof *old);
    for (int k = 0; k < MOST_HALVINGS; ++k, *share *= 0.5) {
        for (size_t i = 0; i < 2 * n; ++i)
            m->points[i] = *share < 1 ? old[i] + *share * (places[i] - old[i]) : places[i];
        if (all_positive(m))
            return;
    }
    memcpy(m->points, old, 2 * n * sizeof *old);
    *share = 0;
}

/* Takes the longest possible steps. After each step, edges flip until none needs to. */
static icc_status move(iccp_sequences *sequences, iccp_moving_triangulation *m, size_t n,
                       const double *places, double *old, iccp_sequence *room, bool *arrived,
                       const iccp_env *env)
{
    icc_status status = ICC_OK;
    double share = all_positive(m) ? 1 : 0;
    for (int part = 0; status == ICC_OK && part < MOST_PARTS && share > 0 && !*arrived; ++part) {
        size_t n_flips = 1;
        go(m, n, places, old, &share);
        *arrived = share >= 1;
        for (int pass = 0; status == ICC_OK && pass < MOST_PASSES && n_flips > 0 && !*arrived;
             ++pass)
            status = flip_edges(sequences, m, room, &n_flips, env);
    }
    return status;
}

icc_status iccp_sequences_move(iccp_sequences *sequences, iccp_moving_triangulation *moving,
                               const double *places, bool *arrived, const iccp_env *env)
{
    size_t n = 0;
    for (size_t c = 0; c < 3 * moving->mesh.n_triangles; ++c)
        n = moving->mesh.vertex[c] >= n ? (size_t)moving->mesh.vertex[c] + 1 : n;
    double *old = iccp_alloc(&env->memory, n, 2 * sizeof *old);
    iccp_sequence room = {.n = 0};
    icc_status status = ICC_ERR_MEMORY;
    *arrived = false;
    if (old != NULL)
        status = move(sequences, moving, n, places, old, &room, arrived, env);
    iccp_free(&env->memory, old);
    iccp_free(&sequences->memory, room.sides);
    return status;
}
