/* Forces segments into a Delaunay triangulation. Based on: M. V. Anglada, An improved incremental
 * algorithm for constructing restricted Delaunay triangulations, Computers & Graphics 21, 1997. It
 * removes the triangles that an edge crosses and triangulates the two polygons on either side of
 * the edge.
 *
 * The order is that of J. R. Shewchuk, B. C. Brown, Fast segment insertion and incremental
 * construction of constrained Delaunay triangulations, Computational Geometry 48, 2015. Vertices
 * are cut off at random and put back in reverse order, each followed by flips around it. The time
 * is proportional to the number of triangles. With one fixed order it can be the square.
 *
 * Every vertex of these polygons sees the edge. Therefore each convex vertex except the ends of the
 * edge can be cut off, whatever was cut off before. A vertex inside its triangle would have to see
 * the edge across the triangle's sides. */
#include "mesh/constrain.h"

#include "base/error.h"
#include "math/predicates.h"

#include <assert.h>

enum side { LEFT, RIGHT };

/* An edge that crosses n triangles has n + 3 links. */
enum { EXTRA = 3 };

/* Marks an index of a link where corners are stored. */
static const uint32_t LINK = (uint32_t)1 << 31;

/* A vertex of the chains on either side of the inserted edge, with the edge that leads to it from
 * the previous vertex. */
typedef struct chain_link {
    uint32_t side; /* LEFT or RIGHT */
    uint32_t vertex;
    uint32_t previous, next; /* the links before and after it on its side */
    /* The corner beyond the edge. If the chain runs along both sides of an edge between crossed
     * triangles: LINK plus the other link. */
    uint32_t outer;
    bool queued;
} chain_link;

typedef struct cutter {
    iccp_trimesh *mesh;
    uint32_t from, to;   /* the edge that is being inserted */
    uint32_t *corner_of; /* one corner of each vertex */
    uint32_t *triangles; /* triangles that the edge crosses */
    uint8_t *waiting;    /* by triangle: true until its vertex is put back */
    chain_link *links;   /* the first is `from`, for both sides; the last two are `to` */
    uint32_t *queue;     /* links that may be ready to be cut off, each at most once */
    uint32_t n_triangles, n_links;
    uint32_t room;    /* room for this many triangles, and EXTRA more of the others */
    uint32_t last[2]; /* last link on each side so far */
    uint64_t random;
    icc_error *err;
} cutter;

static uint32_t vertex_at(const cutter *k, uint32_t corner)
{
    return k->mesh->corners[corner].vertex;
}

/* Returns on which side of the edge a vertex lies: +1 left, -1 right. */
static int side_of(const cutter *k, uint32_t vertex)
{
    return iccp_orient2d(iccp_point(k->mesh, k->from), iccp_point(k->mesh, k->to),
                         iccp_point(k->mesh, vertex));
}

static icc_status fail_touch(const cutter *k, uint32_t vertex)
{
    const unsigned long from = k->from, to = k->to, point = vertex;
    if (vertex < k->mesh->n_boundary)
        return iccp_fail_at(k->err, ICC_ERR_BOUNDARY, ICC_ITEM_POINT, vertex,
                            "vertex %lu lies on the polygon's edge from vertex %lu to %lu", point,
                            from, to);
    return iccp_fail_at(
        k->err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, vertex,
        "point %lu is not inside the polygon: it lies on the edge from vertex %lu to %lu", point,
        from, to);
}

static icc_status fail_cross(const cutter *k, uint32_t a, uint32_t b)
{
    return iccp_fail_at(k->err, ICC_ERR_BOUNDARY, ICC_ITEM_POINT, k->from,
                        "the polygon crosses itself: its edges %lu-%lu and %lu-%lu",
                        (unsigned long)k->from, (unsigned long)k->to, (unsigned long)a,
                        (unsigned long)b);
}

/* Looks for the edge around both of its ends at once. It ends with the end of fewer triangles. */
static bool is_present(const cutter *k)
{
    const uint32_t first = k->corner_of[k->from], other_first = k->corner_of[k->to];
    uint32_t corner = first, other = other_first;
    do {
        if (vertex_at(k, iccp_after(corner)) == k->to || vertex_at(k, iccp_after(other)) == k->from)
            return true;
        corner = iccp_around(k->mesh, corner);
        other = iccp_around(k->mesh, other);
    } while (corner != first && other != other_first);
    return false;
}

/* For a vertex on the edge's line: returns true if it lies on the same side of the edge's beginning
 * as its end. */
static bool is_ahead(const cutter *k, uint32_t vertex)
{
    const double *from = iccp_point(k->mesh, k->from), *to = iccp_point(k->mesh, k->to);
    const double *p = iccp_point(k->mesh, vertex);
    const int axis = from[0] < to[0] || from[0] > to[0] ? 0 : 1;
    return (from[axis] < to[axis]) == (from[axis] < p[axis]);
}

/* Finds the corner at the beginning of the edge whose triangle the edge enters. */
static icc_status find_start(const cutter *k, uint32_t *start)
{
    const uint32_t ghost = k->mesh->n_points;
    uint32_t corner = k->corner_of[k->from];
    for (;; corner = iccp_around(k->mesh, corner)) {
        const uint32_t right = vertex_at(k, iccp_after(corner));
        const uint32_t left = vertex_at(k, iccp_before(corner));
        const int side = right == ghost ? 1 : side_of(k, right);
        if (side == 0 && is_ahead(k, right))
            return fail_touch(k, right);
        if (side < 0 && left != ghost && side_of(k, left) > 0)
            break;
    }
    *start = corner;
    return ICC_OK;
}

/* Makes room for one more triangle and its link. */
static bool reserve(cutter *k, const iccp_memory *memory)
{
    if (k->n_triangles < k->room)
        return true;
    const size_t room = 2 * (size_t)k->room;
    uint32_t *triangles = iccp_grow(memory, k->triangles, k->room, room, sizeof *triangles);
    if (triangles == NULL)
        return false;
    k->triangles = triangles;
    chain_link *links = iccp_grow(memory, k->links, k->n_links, room + EXTRA, sizeof *links);
    if (links == NULL)
        return false;
    k->links = links;
    uint32_t *queue = iccp_grow(memory, k->queue, 0, room + EXTRA, sizeof *queue);
    if (queue == NULL)
        return false;
    k->queue = queue;
    k->room = (uint32_t)room;
    return true;
}

static void add_link(cutter *k, uint32_t side, uint32_t vertex, uint32_t outer)
{
    const uint32_t index = k->n_links++;
    k->links[index] = (chain_link){side, vertex, k->last[side], 0, outer, false};
    k->links[k->last[side]].next = index;
    k->last[side] = index;
}

/* Follows the edge from the first triangle that it enters to its end, and collects the triangles
 * and the chains. */
static icc_status collect(cutter *k, uint32_t corner, const iccp_memory *memory)
{
    const iccp_corner *const c = k->mesh->corners;
    k->n_triangles = 0;
    k->triangles[k->n_triangles++] = corner / 3;
    k->n_links = 0;
    k->last[LEFT] = k->last[RIGHT] = 0;
    add_link(k, LEFT, k->from, 0);
    add_link(k, LEFT, vertex_at(k, iccp_before(corner)), c[iccp_after(corner)].twin);
    add_link(k, RIGHT, vertex_at(k, iccp_after(corner)), c[iccp_before(corner)].twin);
    for (;;) {
        const uint32_t right = vertex_at(k, iccp_after(corner));
        const uint32_t left = vertex_at(k, iccp_before(corner));
        if (iccp_is_wall(k->mesh, left, right))
            return fail_cross(k, left, right);
        const uint32_t twin = c[corner].twin, apex = c[twin].vertex;
        const int side = apex == k->to ? 0 : side_of(k, apex);
        if (side == 0 && apex != k->to)
            return fail_touch(k, apex);
        if (!reserve(k, memory))
            return iccp_fail_memory(k->err);
        k->triangles[k->n_triangles++] = twin / 3;
        if (side >= 0)
            add_link(k, LEFT, apex, c[iccp_before(twin)].twin);
        if (side <= 0)
            add_link(k, RIGHT, apex, c[iccp_after(twin)].twin);
        if (side == 0)
            return ICC_OK;
        corner = side > 0 ? iccp_after(twin) : iccp_before(twin);
    }
}

/* Finds the edges that a chain runs along twice. Meanwhile the corners inside the chains, which are
 * about to be removed, point to their links. */
static void pair_links(cutter *k)
{
    iccp_corner *const c = k->mesh->corners;
    for (uint32_t i = 1; i < k->n_links; ++i) {
        const uint32_t inner = c[k->links[i].outer].twin;
        if ((inner & LINK) == 0) {
            c[inner].twin = LINK | i;
            continue;
        }
        k->links[i].outer = inner;
        k->links[inner & ~LINK].outer = LINK | i;
    }
}

/* Makes a corner of a new triangle face the edge of a link. */
static void attach(cutter *k, uint32_t corner, uint32_t index)
{
    const uint32_t outer = k->links[index].outer;
    if ((outer & LINK) != 0)
        k->links[outer & ~LINK].outer = corner;
    else
        iccp_link_twins(k->mesh, corner, outer);
}

/* Returns true if the chain turns towards the edge at a link. */
static bool is_convex(const cutter *k, const chain_link *l)
{
    const double *a = iccp_point(k->mesh, k->links[l->previous].vertex);
    const double *b = iccp_point(k->mesh, l->vertex);
    const double *c = iccp_point(k->mesh, k->links[l->next].vertex);
    return iccp_orient2d(a, b, c) == (l->side == LEFT ? -1 : 1);
}

/* Makes a triangle from a link and its two neighbours, its own vertex first, and joins the
 * neighbours. */
static void cut_off(cutter *k, uint32_t triangle, uint32_t index)
{
    iccp_corner *const c = k->mesh->corners;
    const chain_link *const l = &k->links[index];
    chain_link *const previous = &k->links[l->previous], *const next = &k->links[l->next];
    const uint32_t corner = 3 * triangle;
    const uint32_t at_previous = corner + 1 + l->side, at_next = corner + 2 - l->side;
    c[corner].vertex = l->vertex;
    c[at_previous].vertex = previous->vertex;
    c[at_next].vertex = next->vertex;
    attach(k, at_previous, l->next);
    attach(k, at_next, index);
    next->outer = corner;
    next->previous = l->previous;
    previous->next = l->next;
}

/* Queues all vertices between the ends in random order. Returns their number. */
static uint32_t shuffle(cutter *k)
{
    uint32_t n = 0;
    for (uint32_t i = 1; i + 2 < k->n_links; ++i, ++n) {
        /* Knuth's MMIX generator */
        k->random = k->random * 6364136223846793005u + 1442695040888963407u;
        const uint32_t place = (uint32_t)((k->random >> 32) * (n + 1) >> 32);
        k->queue[n] = k->queue[place];
        k->queue[place] = i;
        k->links[i].queued = true;
    }
    return n;
}

/* Triangulates both sides of the edge, in the places of the removed triangles. */
static void cut_all(cutter *k)
{
    chain_link *const l = k->links;
    const uint32_t n_places = shuffle(k);
    uint32_t head = 0, n_queued = n_places, n_used = 0;
    for (; n_queued > 0; --n_queued, head = head + 1 < n_places ? head + 1 : 0) {
        const uint32_t index = k->queue[head];
        l[index].queued = false;
        if (!is_convex(k, &l[index]))
            continue;
        cut_off(k, k->triangles[n_used++], index);
        const uint32_t near[2] = {l[index].previous, l[index].next};
        for (int i = 0; i < 2; ++i) {
            const bool is_end = near[i] == 0 || l[near[i]].next == 0;
            if (is_end || l[near[i]].queued)
                continue;
            l[near[i]].queued = true;
            k->queue[(head + n_queued++) % n_places] = near[i];
        }
    }
    assert(n_used == k->n_triangles);
    iccp_link_twins(k->mesh, l[k->last[LEFT]].outer, l[k->last[RIGHT]].outer);
}

static bool must_flip(const cutter *k, uint32_t corner)
{
    const iccp_trimesh *const mesh = k->mesh;
    const uint32_t twin = mesh->corners[corner].twin, beyond = vertex_at(k, twin);
    const uint32_t from = vertex_at(k, iccp_after(corner));
    const uint32_t to = vertex_at(k, iccp_before(corner));
    return beyond != mesh->n_points && !k->waiting[twin / 3] && !iccp_is_wall(mesh, from, to) &&
           iccp_incircle(iccp_point(mesh, vertex_at(k, corner)), iccp_point(mesh, from),
                         iccp_point(mesh, to), iccp_point(mesh, beyond)) > 0;
}

/* Goes around the vertex at a corner, from one neighbour on its chain to the other. Flips the edges
 * that it faces while they are not Delaunay. */
static void legalise(cutter *k, uint32_t corner)
{
    const uint32_t last = vertex_at(k, iccp_before(corner));
    for (;;) {
        if (must_flip(k, corner))
            iccp_flip(k->mesh, corner);
        else if (vertex_at(k, iccp_before(corner)) != last)
            corner = iccp_around(k->mesh, corner);
        else
            return;
    }
}

/* Puts the vertices back. Triangles beyond the chains stay, because they were Delaunay and still
 * are. */
static void put_back(cutter *k)
{
    for (uint32_t i = 0; i < k->n_triangles; ++i)
        k->waiting[k->triangles[i]] = 1;
    for (uint32_t i = k->n_triangles; i-- > 0;) {
        k->waiting[k->triangles[i]] = 0;
        legalise(k, 3 * k->triangles[i]);
    }
    for (uint32_t i = 0; i < 3 * k->n_triangles; ++i) {
        const uint32_t corner = 3 * k->triangles[i / 3] + i % 3;
        k->corner_of[vertex_at(k, corner)] = corner;
    }
}

static icc_status insert_edge(cutter *k, const iccp_memory *memory)
{
    if (is_present(k))
        return ICC_OK;
    uint32_t start = 0;
    icc_status status = find_start(k, &start);
    if (status == ICC_OK)
        status = collect(k, start, memory);
    if (status != ICC_OK)
        return status;
    pair_links(k);
    cut_all(k);
    put_back(k);
    return ICC_OK;
}

/* Inserts the walls that begin at vertex i: one edge of a polygon, or the walls to larger
 * vertices. */
static icc_status insert_at(cutter *k, uint32_t i, const iccp_memory *memory)
{
    const iccp_walls *const walls = k->mesh->walls;
    icc_status status = ICC_OK;
    k->from = i;
    if (walls == NULL) {
        k->to = i + 1 < k->mesh->n_boundary ? i + 1 : 0;
        return insert_edge(k, memory);
    }
    for (uint32_t j = walls->first[i]; status == ICC_OK && j < walls->first[i + 1]; ++j) {
        k->to = walls->other[j];
        status = k->to > i ? insert_edge(k, memory) : ICC_OK;
    }
    return status;
}

static icc_status insert_all(cutter *k, const iccp_env *env)
{
    enum { REPORT = 1024 };
    const uint32_t n = k->mesh->walls != NULL ? k->mesh->n_points : k->mesh->n_boundary;
    for (uint32_t corner = 0; corner < 3 * k->mesh->n_triangles; ++corner)
        if (vertex_at(k, corner) != k->mesh->n_points)
            k->corner_of[vertex_at(k, corner)] = corner;
    for (uint32_t i = 0; i < n; ++i) {
        if (i % REPORT == 0 && iccp_progress(env, "mesh", (double)i / (double)n) != ICC_OK)
            return ICC_ERR_CANCELLED;
        const icc_status status = insert_at(k, i, &env->memory);
        if (status != ICC_OK)
            return status;
    }
    return ICC_OK;
}

/* Inserts the walls one at a time. The arrays for the crossed region are reused, and grow as
 * needed. */
icc_status iccp_constrain(iccp_trimesh *mesh, const iccp_env *env, icc_error *err)
{
    enum { ROOM = 64 };
    const iccp_memory *const memory = &env->memory;
    cutter k = {.mesh = mesh, .room = ROOM, .err = err};
    k.corner_of = iccp_alloc(memory, mesh->n_points, sizeof *k.corner_of);
    k.waiting = iccp_alloc_zero(memory, mesh->n_triangles, sizeof *k.waiting);
    k.triangles = iccp_alloc(memory, ROOM, sizeof *k.triangles);
    k.links = iccp_alloc(memory, ROOM + EXTRA, sizeof *k.links);
    k.queue = iccp_alloc(memory, ROOM + EXTRA, sizeof *k.queue);
    icc_status status;
    if (k.corner_of == NULL || k.waiting == NULL || k.triangles == NULL || k.links == NULL ||
        k.queue == NULL)
        status = iccp_fail_memory(err);
    else
        status = insert_all(&k, env);
    iccp_free(memory, k.queue);
    iccp_free(memory, k.links);
    iccp_free(memory, k.triangles);
    iccp_free(memory, k.waiting);
    iccp_free(memory, k.corner_of);
    return status;
}
