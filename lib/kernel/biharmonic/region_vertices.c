/* Cuts walls at the nodes on them, and into pieces about as long as the samples' spacing. So meshes
 * are as fine at the walls as inside, whatever the sampling. Blue noise divides walls by the same
 * rule (kernel/sampling/boundary_samples.h), so it adds no pieces. */
#include "kernel/biharmonic/region_vertices.h"

#include "base/error.h"
#include "base/sort.h"
#include "base/threads.h"
#include "geometry/away.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

enum { A_TASK = 256 };
static const double MOST_VERTICES = 1 << 24;

/* A node on the wall `facet`, and its position on it as a share. `facet` is the sort key. */
typedef struct mark {
    uint32_t facet, node;
    double share;
} mark;

typedef struct builder {
    iccp_region_vertices *v;
    const icc_shape *shape;
    const double *nodes;
    double spacing;   /* local */
    uint32_t *wall;   /* by node: the wall that it is on, or ICCP_NOWHERE */
    uint32_t *corner; /* by vertex of the walls: its number among all vertices, or ICCP_NOWHERE */
    mark *marks, *sorted;
    uint32_t *first; /* by facet: its first mark */
} builder;

static icc_status find_some(void *argument, size_t begin, size_t end)
{
    const builder *b = argument;
    for (size_t i = begin; i < end; ++i) {
        const iccp_spot spot = iccp_shape_spot(b->shape, b->nodes + 2 * i);
        memcpy(b->v->points + 2 * i, spot.at, 2 * sizeof *spot.at);
        b->v->region[i] = spot.region;
        b->wall[i] = spot.wall;
    }
    return ICC_OK;
}

static icc_status find_regions(const builder *b, size_t n, const iccp_env *env, icc_error *err)
{
    const icc_status status = iccp_for_chunks(env, "weights", n, A_TASK, find_some, (void *)b);
    for (size_t i = 0; status == ICC_OK && i < n; ++i)
        if (b->v->region[i] == ICCP_NOWHERE)
            return iccp_fail_at(err, ICC_ERR_UNSUPPORTED, ICC_ITEM_NODE, (int64_t)i,
                                "biharmonic weights need a region around every node; node %zu is "
                                "on a curve or beyond the shape",
                                i);
    return iccp_explain(err, status);
}

static const double *wall_end(const builder *b, uint32_t facet, size_t k)
{
    return b->shape->local + 2 * (size_t)b->shape->facets[2 * (size_t)facet + k];
}

/* Sorts the nodes on walls by wall. A node at the end of a wall becomes that corner. */
static void mark_walls(builder *b, size_t n)
{
    size_t n_marks = 0;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t f = b->wall[i];
        if (f == ICCP_NOWHERE)
            continue;
        const double *x = b->v->points + 2 * i, *ends[2] = {wall_end(b, f, 0), wall_end(b, f, 1)};
        const double from = iccp_vec_distance(2, x, ends[0]), to = iccp_vec_distance(2, x, ends[1]);
        if (from <= b->shape->tolerance)
            b->corner[b->shape->facets[2 * (size_t)f]] = (uint32_t)i;
        else if (to <= b->shape->tolerance)
            b->corner[b->shape->facets[2 * (size_t)f + 1]] = (uint32_t)i;
        else
            b->marks[n_marks++] = (mark){f, (uint32_t)i, from / (from + to)};
    }
    iccp_sort_by_count(b->sorted, b->first, b->shape->walls.n, b->marks, n_marks, sizeof *b->marks);
}

static uint32_t add_vertex(iccp_region_vertices *v, const double *place, uint32_t region)
{
    iccp_away_reach(2, place, v->points + 2 * v->n);
    v->region[v->n] = region;
    return (uint32_t)v->n++;
}

static uint32_t corner_of(builder *b, uint32_t facet, size_t k)
{
    uint32_t *corner = &b->corner[b->shape->facets[2 * (size_t)facet + k]];
    if (*corner == ICCP_NOWHERE)
        *corner = add_vertex(b->v, wall_end(b, facet, k), b->shape->owner[facet]);
    return *corner;
}

static void add_piece(iccp_region_vertices *v, uint32_t from, uint32_t to, uint32_t owner)
{
    v->pieces[2 * v->n_pieces] = from;
    v->pieces[2 * v->n_pieces + 1] = to;
    v->owner[v->n_pieces++] = owner;
}

/* Adds the pieces between two neighbouring vertices of a wall. */
static void divide(builder *b, uint32_t from, uint32_t to, uint32_t owner)
{
    iccp_region_vertices *v = b->v;
    const double *a = v->points + 2 * (size_t)from, *c = v->points + 2 * (size_t)to;
    const double n = floor(iccp_vec_distance(2, a, c) / b->spacing + 0.5);
    uint32_t last = from;
    for (double k = 1; k < n; ++k) {
        const double place[2] = {a[0] + k / n * (c[0] - a[0]), a[1] + k / n * (c[1] - a[1])};
        const uint32_t next = add_vertex(v, place, owner);
        add_piece(v, last, next, owner);
        last = next;
    }
    add_piece(v, last, to, owner);
}

static int by_share(const void *a, const void *b)
{
    const mark *x = a, *y = b;
    return x->share != y->share ? (x->share > y->share) - (x->share < y->share)
                                : (x->node > y->node) - (x->node < y->node);
}

static void cut_walls(builder *b)
{
    for (uint32_t f = 0; f < b->shape->walls.n; ++f) {
        mark *marks = b->sorted + b->first[f];
        const size_t n = b->first[f + 1] - b->first[f];
        uint32_t last = corner_of(b, f, 0);
        const uint32_t end = corner_of(b, f, 1), owner = b->shape->owner[f];
        iccp_sort(marks, n, sizeof *marks, by_share);
        for (size_t k = 0; k < n; ++k) {
            divide(b, last, marks[k].node, owner);
            last = marks[k].node;
        }
        divide(b, last, end, owner);
    }
}

/* Returns the largest number of vertices that are no nodes, and of pieces. */
static double most_new(const builder *b, size_t n)
{
    double most = (double)n + (double)b->shape->n_walled;
    for (uint32_t f = 0; f < b->shape->walls.n; ++f)
        most += 2 + iccp_vec_distance(2, wall_end(b, f, 0), wall_end(b, f, 1)) / b->spacing;
    return most;
}

static icc_status allocate(builder *b, size_t n, icc_error *err)
{
    iccp_region_vertices *v = b->v;
    const iccp_memory *memory = &v->memory;
    const double most = most_new(b, n);
    if (!((double)n + most <= MOST_VERTICES))
        return iccp_fail(err, ICC_ERR_RESOLUTION, "the walls would have more than %.0f vertices",
                         MOST_VERTICES);
    const size_t room = (size_t)most;
    v->points = iccp_alloc(memory, n + room, 2 * sizeof *v->points);
    v->region = iccp_alloc(memory, n + room, sizeof *v->region);
    v->pieces = iccp_alloc(memory, room, 2 * sizeof *v->pieces);
    v->owner = iccp_alloc(memory, room, sizeof *v->owner);
    b->wall = iccp_alloc(memory, n, sizeof *b->wall);
    b->corner = iccp_alloc(memory, b->shape->n_walled, sizeof *b->corner);
    b->marks = iccp_alloc(memory, n, sizeof *b->marks);
    b->sorted = iccp_alloc(memory, n, sizeof *b->sorted);
    b->first = iccp_alloc_zero(memory, b->shape->walls.n + 1, sizeof *b->first);
    if (v->points == NULL || v->region == NULL || v->pieces == NULL || v->owner == NULL ||
        b->wall == NULL || b->corner == NULL || b->marks == NULL || b->sorted == NULL ||
        b->first == NULL)
        return iccp_fail_memory(err);
    memset(b->corner, 0xff, b->shape->n_walled * sizeof *b->corner);
    return ICC_OK;
}

icc_status iccp_region_vertices_create(iccp_region_vertices *vertices, const icc_shape *shape,
                                       size_t n, const double *nodes, double spacing,
                                       const iccp_env *env, icc_error *err)
{
    *vertices = (iccp_region_vertices){.memory = env->memory, .n = n};
    builder b = {.v = vertices, .shape = shape, .nodes = nodes};
    b.spacing = spacing * shape->frame.in[0] * shape->frame.in[1];
    icc_status status = allocate(&b, n, err);
    if (status == ICC_OK)
        status = find_regions(&b, n, env, err);
    if (status == ICC_OK) {
        mark_walls(&b, n);
        cut_walls(&b);
    }
    iccp_free(&env->memory, b.wall);
    iccp_free(&env->memory, b.corner);
    iccp_free(&env->memory, b.marks);
    iccp_free(&env->memory, b.sorted);
    iccp_free(&env->memory, b.first);
    if (status != ICC_OK)
        iccp_region_vertices_free(vertices);
    return status;
}

void iccp_region_vertices_free(iccp_region_vertices *vertices)
{
    iccp_region_vertices *v = vertices;
    iccp_free(&v->memory, v->points);
    iccp_free(&v->memory, v->region);
    iccp_free(&v->memory, v->pieces);
    iccp_free(&v->memory, v->owner);
    *v = (iccp_region_vertices){.memory = v->memory};
}
