/* Inserts vertices into a one-to-one plane map: L. Guibas, D. Knuth, M. Sharir, Randomized
 * incremental construction of Delaunay and Voronoi diagrams, 1992. Every triangle has a list of the
 * points in it that are still to come. Flips are made only where they keep the map one-to-one, so
 * the mesh is Delaunay only where the map lets it be. */
#include "map/nearest/insert_points.h"

#include "base/random.h"
#include "map/compatible/triangle_quality.h"
#include "math/predicates.h"
#include "mesh/edge_set.h"
#include "mesh/finder.h"

#include <string.h>

/* A flip must leave both triangles at least this share of the smaller ratio of areas, after and
 * before the map, of the two that it replaces. */
static const double LEAST_SHARE = 0.2;

/* A flip makes no triangle of the source flatter than this, unless it replaces one that is at least
 * as flat. See iccp_roundness(). */
static const double LEAST_ROUNDNESS = 0.05;

/* A point so near to an edge, as a share of its triangle's height, is put on the edge. Then the
 * edge goes, so rounding of the image does not matter. */
static const double NEXT_TO_EDGE = 1e-6;

/* If rounding spoils the image of a point, the image moves to the middle of the triangle or edge,
 * by these shares of the way. */
enum { ATTEMPTS = 5 };
static const double SHARE[ATTEMPTS] = {0, 1e-12, 1e-8, 1e-4, 1};

static const uint32_t NONE = UINT32_MAX;

typedef struct insertion {
    iccp_plmap *map;
    size_t n;
    const double *points;
    uint32_t *head;  /* of each triangle: the first point in it, or NONE */
    uint32_t *next;  /* of each point: the next one in the same triangle */
    uint32_t *where; /* of each point: its triangle */
    uint32_t *stack; /* corners at the new vertex whose edges are still to be tested */
    size_t n_stack;
} insertion;

/* ---- flips ---- */

/* The ratio of the areas after and before the map of the triangle of three vertices. */
static double ratio_of(const iccp_plmap *map, uint32_t a, uint32_t b, uint32_t c)
{
    const double *at[2] = {map->points, map->images};
    double twice[2];
    for (int k = 0; k < 2; ++k) {
        const double *p = at[k] + 2 * (size_t)a, *q = at[k] + 2 * (size_t)b,
                     *r = at[k] + 2 * (size_t)c;
        twice[k] = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    }
    return twice[1] / twice[0];
}

/* The roundness before the map of the flatter one of triangles a b c and d e f. */
static double roundness_of(const iccp_plmap *map, const uint32_t v[6])
{
    const double *p[6];
    for (int k = 0; k < 6; ++k)
        p[k] = map->points + 2 * (size_t)v[k];
    return iccp_min(iccp_roundness(p[0], p[1], p[2]), iccp_roundness(p[3], p[4], p[5]));
}

bool iccp_may_flip_to_delaunay(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t *v = map->corners.vertex, twin = map->corners.twin[corner];
    const uint32_t x = v[corner], y = v[twin], a = v[iccp_after(corner)],
                   b = v[iccp_before(corner)];
    const double *p = map->points;
    if ((map->fixed[x] == ICCP_ON_POINT && map->fixed[y] == ICCP_ON_POINT) ||
        iccp_edge_set_has(map->held, a, b))
        return false;
    if (iccp_incircle(p + 2 * (size_t)x, p + 2 * (size_t)a, p + 2 * (size_t)b, p + 2 * (size_t)y) <=
            0 ||
        !iccp_quality_is_positive(map, x, a, y) || !iccp_quality_is_positive(map, y, b, x) ||
        roundness_of(map, (const uint32_t[]){x, a, y, y, b, x}) <
            iccp_min(LEAST_ROUNDNESS, roundness_of(map, (const uint32_t[]){x, a, b, y, b, a})))
        return false;
    const double least = LEAST_SHARE * iccp_min(ratio_of(map, x, a, b), ratio_of(map, y, b, a));
    return ratio_of(map, x, a, y) >= least && ratio_of(map, y, b, x) >= least;
}

/* ---- lists of points ---- */

static void put(insertion *s, uint32_t triangle, uint32_t i)
{
    s->where[i] = triangle;
    s->next[i] = s->head[triangle];
    s->head[triangle] = i;
}

static uint32_t take_list(insertion *s, uint32_t triangle)
{
    const uint32_t first = s->head[triangle];
    s->head[triangle] = NONE;
    return first;
}

/* The side of the line from vertex a to vertex b on which a point lies: 1 on the left. */
static int side_of(const insertion *s, uint32_t a, uint32_t b, uint32_t i)
{
    const double *p = s->map->points;
    return iccp_orient2d(p + 2 * (size_t)a, p + 2 * (size_t)b, s->points + 2 * (size_t)i);
}

/* Puts the points of a list into triangle t if they are on the left of the line from a to b, and
 * into triangle u otherwise. Point `but` is left out. */
static void deal(insertion *s, uint32_t list, uint32_t a, uint32_t b, uint32_t t, uint32_t u,
                 uint32_t but)
{
    for (uint32_t i = list, next; i != NONE; i = next) {
        next = s->next[i];
        if (i != but)
            put(s, side_of(s, a, b, i) >= 0 ? t : u, i);
    }
}

/* ---- one point ---- */

static void flip(insertion *s, uint32_t corner)
{
    iccp_corners *c = &s->map->corners;
    const uint32_t twin = c->twin[corner], t = corner / 3, u = twin / 3;
    const uint32_t lists[2] = {take_list(s, t), take_list(s, u)};
    iccp_flip_edge(c, corner);
    for (int k = 0; k < 2; ++k)
        deal(s, lists[k], c->vertex[twin], c->vertex[corner], t, u, NONE);
    s->stack[s->n_stack++] = iccp_before(twin);
    s->stack[s->n_stack++] = corner;
}

static void flip_around(insertion *s)
{
    while (s->n_stack > 0) {
        const uint32_t corner = s->stack[--s->n_stack];
        if (s->map->corners.twin[corner] != ICCP_NO_NEIGHBOUR &&
            iccp_may_flip_to_delaunay(s->map, corner))
            flip(s, corner);
    }
}

static void insert_inside(insertion *s, uint32_t t, uint32_t i, uint32_t m)
{
    iccp_corners *c = &s->map->corners;
    const uint32_t list = take_list(s, t), second = (uint32_t)c->n_triangles, third = second + 1;
    iccp_cut_triangle(c, t, m);
    const uint32_t *v = c->vertex + 3 * (size_t)t, last = c->vertex[3 * (size_t)second + 1];
    s->head[second] = s->head[third] = NONE;
    for (uint32_t k = list, next; k != NONE; k = next) {
        next = s->next[k];
        if (k == i)
            continue;
        const int a = side_of(s, m, v[0], k), b = side_of(s, m, v[1], k);
        if (a >= 0 && b <= 0)
            put(s, t, k);
        else
            put(s, b >= 0 && side_of(s, m, last, k) <= 0 ? second : third, k);
    }
    const uint32_t at[3] = {3 * t + 2, 3 * second + 2, 3 * third + 2};
    memcpy(s->stack, at, sizeof at);
    s->n_stack = 3;
    flip_around(s);
}

/* Whether a triangle of the source contains a point. */
static bool contains(const insertion *s, uint32_t triangle, uint32_t i)
{
    const uint32_t *v = s->map->corners.vertex + 3 * (size_t)triangle;
    return side_of(s, v[0], v[1], i) >= 0 && side_of(s, v[1], v[2], i) >= 0 &&
           side_of(s, v[2], v[0], i) >= 0;
}

/* Puts vertex m in the place of the edge that a corner faces, on it or next to it. */
static void insert_on_edge(insertion *s, uint32_t corner, uint32_t i, uint32_t m)
{
    iccp_corners *c = &s->map->corners;
    const uint32_t twin = c->twin[corner], fresh = (uint32_t)c->n_triangles;
    const uint32_t triangles[4] = {corner / 3, fresh, twin / 3, fresh + 1};
    const uint32_t lists[2] = {take_list(s, corner / 3), take_list(s, twin / 3)};
    iccp_cut_edge(c, corner, m);
    s->head[fresh] = s->head[fresh + 1] = NONE;
    for (int k = 0; k < 2; ++k)
        for (uint32_t other = lists[k], next; other != NONE; other = next) {
            int at = 0;
            next = s->next[other];
            while (at < 3 && !contains(s, triangles[at], other))
                ++at;
            if (other != i)
                put(s, triangles[at], other);
        }
    for (int k = 0; k < 4; ++k)
        for (uint32_t at = 3 * triangles[k]; at < 3 * triangles[k] + 3; ++at)
            if (c->vertex[at] == m)
                s->stack[s->n_stack++] = at;
    flip_around(s);
}

/* Computes the barycentric coordinates of a point in a triangle of the source. */
static void find_weights(const insertion *s, uint32_t t, uint32_t i, double weight[3])
{
    const double *p = s->points + 2 * (size_t)i;
    double sum = 0;
    for (uint32_t k = 0; k < 3; ++k) {
        weight[k] = iccp_area2d(p, iccp_plmap_point(s->map, iccp_after(3 * t + k)),
                                iccp_plmap_point(s->map, iccp_before(3 * t + k)));
        sum += weight[k];
    }
    for (uint32_t k = 0; k < 3; ++k)
        weight[k] /= sum;
}

/* Finds the image of a point from its weights, and a share of the way to the middle of the
 * triangle, or of the edge that corner `on` faces. */
static void interpolate(const iccp_plmap *map, uint32_t t, uint32_t on, const double weight[3],
                        double share, double image[2])
{
    image[0] = image[1] = 0;
    for (uint32_t k = 0; k < 3; ++k) {
        const double middle = on == NONE ? 1.0 / 3 : 3 * t + k == on ? 0 : 0.5;
        for (int d = 0; d < 2; ++d)
            image[d] +=
                ((1 - share) * weight[k] + share * middle) * iccp_plmap_image(map, 3 * t + k)[d];
    }
}

/* Whether a new vertex leaves all triangles positive, if it replaces triangle t, or the edge that
 * corner `on` faces. `of`: the coordinates of the vertices, before or after the map. */
static bool fits(const insertion *s, uint32_t t, uint32_t on, const double *of, const double *at)
{
    const iccp_corners *c = &s->map->corners;
    const uint32_t sides[2] = {t, on != NONE ? c->twin[on] / 3 : t};
    bool is = true;
    for (int k = 0; k < 1 + (on != NONE); ++k)
        for (uint32_t x = 3 * sides[k]; x < 3 * sides[k] + 3; ++x)
            is &= x == on || (on != NONE && x == c->twin[on]) ||
                  iccp_orient2d(of + 2 * (size_t)c->vertex[iccp_after(x)],
                                of + 2 * (size_t)c->vertex[iccp_before(x)], at) > 0;
    return is;
}

/* Whether the edge that a corner faces must stay. */
static bool is_held(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t *v = map->corners.vertex;
    return iccp_edge_set_has(map->held, v[iccp_after(corner)], v[iccp_before(corner)]);
}

/* Finds the edge that a point is to replace: a corner that faces it, or NONE. */
static uint32_t find_edge(const insertion *s, uint32_t t, uint32_t i, const double weight[3])
{
    for (uint32_t k = 0; k < 3; ++k)
        if (weight[k] < NEXT_TO_EDGE && s->map->corners.twin[3 * t + k] != ICCP_NO_NEIGHBOUR &&
            !is_held(s->map, 3 * t + k) &&
            fits(s, t, 3 * t + k, s->map->points, s->points + 2 * (size_t)i))
            return 3 * t + k;
    return NONE;
}

/* Returns the vertex of triangle t that is at point i, or NONE. */
static uint32_t find_same(const insertion *s, uint32_t t, uint32_t i)
{
    for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
        if (memcmp(iccp_plmap_point(s->map, c), s->points + 2 * (size_t)i, 2 * sizeof(double)) == 0)
            return s->map->corners.vertex[c];
    return NONE;
}

static void set_vertex(iccp_plmap *map, uint32_t m, const double *point, const double *image)
{
    memcpy(map->points + 2 * (size_t)m, point, 2 * sizeof *point);
    memcpy(map->images + 2 * (size_t)m, image, 2 * sizeof *image);
    map->fixed[m] = ICCP_FREE;
    map->facet[m] = 0;
    map->along[m] = 0;
}

/* Inserts point i as vertex m. Sets *vertex to the vertex that was there already, or to m. Returns
 * false if rounding is in the way. */
static bool insert(insertion *s, uint32_t i, uint32_t m, uint32_t *vertex)
{
    iccp_plmap *map = s->map;
    const uint32_t t = s->where[i], same = find_same(s, t, i);
    const double *point = s->points + 2 * (size_t)i;
    double weight[3], image[2];
    *vertex = same != NONE ? same : m;
    if (same != NONE)
        return true;
    find_weights(s, t, i, weight);
    const uint32_t on = find_edge(s, t, i, weight);
    int attempt = 0;
    do
        interpolate(map, t, on, weight, SHARE[attempt], image);
    while (!fits(s, t, on, map->images, image) && ++attempt < ATTEMPTS);
    if (!fits(s, t, on, map->images, image) || !fits(s, t, on, map->points, point))
        return false;
    set_vertex(map, m, point, image);
    if (on != NONE)
        insert_on_edge(s, on, i, m);
    else
        insert_inside(s, t, i, m);
    return true;
}

/* ---- all points ---- */

/* Finds the triangle of each point. */
static icc_status place_points(insertion *s, bool *is_done, const iccp_env *env)
{
    const iccp_plmap *map = s->map;
    const iccp_planar mesh = {.n_vertices = map->n_vertices,
                              .n_triangles = map->corners.n_triangles,
                              .triangles = map->corners.vertex,
                              .twins = map->corners.twin};
    iccp_finder finder;
    iccp_finder_init(&finder, &mesh, map->points, 0, ICCP_FEW_POINTS, &env->memory);
    icc_status status = iccp_finder_ready(&finder);
    for (uint32_t i = 0; status == ICC_OK && *is_done && i < s->n; ++i) {
        iccp_found found;
        const icc_status own = iccp_finder_find(&finder, s->points + 2 * (size_t)i, &found);
        if (own == ICC_ERR_TRACE)
            *is_done = false;
        else if (own != ICC_OK)
            status = own;
        else
            put(s, found.triangle, i);
    }
    iccp_finder_free(&finder);
    return status;
}

/* Makes room for n vertices more. */
static icc_status make_room(iccp_plmap *map, size_t n, const iccp_memory *memory)
{
    iccp_plmap larger;
    const size_t n_vertices = map->n_vertices, n_triangles = map->corners.n_triangles;
    const icc_status status =
        iccp_plmap_begin(&larger, n_vertices + n, n_triangles + 2 * n, map->stretch, memory);
    if (status != ICC_OK)
        return status;
    larger.n_vertices = n_vertices;
    larger.corners.n_triangles = n_triangles;
    iccp_plmap_fill(&larger, map->points, map->images, map->corners.vertex, map->corners.twin);
    memcpy(larger.fixed, map->fixed, n_vertices * sizeof *map->fixed);
    memcpy(larger.facet, map->facet, n_vertices * sizeof *map->facet);
    memcpy(larger.along, map->along, n_vertices * sizeof *map->along);
    larger.held = map->held;
    iccp_plmap_free(map);
    *map = larger;
    return ICC_OK;
}

static void shuffle(uint32_t *order, size_t n)
{
    uint64_t state = n;
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t k = (uint32_t)(iccp_random(&state) % (i + 1));
        order[i] = order[k];
        order[k] = i;
    }
}

static icc_status insert_all(insertion *s, uint32_t *order, uint32_t *number, bool *is_done,
                             const iccp_env *env)
{
    iccp_plmap *map = s->map;
    const size_t n_triangles = map->corners.n_triangles + 2 * s->n;
    memset(s->head, 0xff, n_triangles * sizeof *s->head);
    icc_status status = place_points(s, is_done, env);
    shuffle(order, s->n);
    for (size_t k = 0; status == ICC_OK && *is_done && k < s->n; ++k) {
        const uint32_t m = (uint32_t)map->n_vertices;
        if (k % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "repair", (double)k / (double)s->n);
        *is_done = insert(s, order[k], m, &number[order[k]]);
        map->n_vertices += *is_done && number[order[k]] == m;
    }
    return status;
}

icc_status iccp_insert_points(iccp_plmap *map, size_t n, const double *points, uint32_t *number,
                              bool *is_done, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_triangles = map->corners.n_triangles + 2 * n;
    uint32_t *order = iccp_alloc(memory, n, sizeof *order);
    insertion s = {.map = map,
                   .n = n,
                   .points = points,
                   .head = iccp_alloc(memory, n_triangles, sizeof *s.head),
                   .next = iccp_alloc(memory, n, sizeof *s.next),
                   .where = iccp_alloc(memory, n, sizeof *s.where),
                   .stack = iccp_alloc(memory, 2 * n_triangles + 6, sizeof *s.stack)};
    icc_status status = ICC_ERR_MEMORY;
    *is_done = true;
    if (order != NULL && s.head != NULL && s.next != NULL && s.where != NULL && s.stack != NULL)
        status = make_room(map, n, memory);
    if (status == ICC_OK)
        status = insert_all(&s, order, number, is_done, env);
    iccp_free(memory, order);
    iccp_free(memory, s.head);
    iccp_free(memory, s.next);
    iccp_free(memory, s.where);
    iccp_free(memory, s.stack);
    return status;
}
