/* Merges vertices by edge collapse: H. Hoppe et al., Mesh optimization, 1993. Exact signs before
 * and after the map guard it, and so does the energy.
 *
 * A vertex is merged into the neighbour that leaves the least energy. Vertices wait in a queue. The
 * neighbours of a merged vertex join the queue again, so the work is proportional to the merges. */
#include "map/compatible/coarsen.h"

#include "map/compatible/triangle_quality.h"

#include <string.h>

/* Vertices with more neighbours are not merged. */
enum { MOST_NEIGHBOURS = 64, LOOKS_PER_REPORT = 1 << 14 };

/* A merge makes no triangle flatter than this, unless it replaces one that is at least as flat. */
static const double LEAST_MERGED_ROUNDNESS = 1e-4;

typedef struct coarsening {
    const iccp_memory *memory;
    iccp_plmap *map;
    /* The energy around a vertex may rise by the share `rise` plus the amount `worth`, or up to the
     * density `mean` */
    double rise, worth, mean;
    double longest;   /* no new edge is longer than this */
    uint32_t *corner; /* of each vertex that is left: a corner at it */
    uint32_t *queue;  /* a ring of n_vertices: n_queued vertices from `first` on */
    size_t first, n_queued;
    uint8_t *is_queued, *is_gone; /* of each vertex */
    uint8_t *is_unused;           /* of each triangle */
    uint32_t *number;             /* of each triangle: its number in the end */
} coarsening;

/* The triangles around an inner vertex, counter-clockwise. */
typedef struct star {
    size_t n;
    uint32_t corner[MOST_NEIGHBOURS];   /* at the vertex */
    uint32_t ring[2 * MOST_NEIGHBOURS]; /* the neighbours in this order, twice */
} star;

static bool find_star(const iccp_corners *c, uint32_t corner, star *s)
{
    uint32_t at = corner;
    s->n = 0;
    do {
        if (s->n == MOST_NEIGHBOURS)
            return false;
        s->corner[s->n] = at;
        s->ring[s->n++] = c->vertex[iccp_after(at)];
        at = iccp_after(c->twin[iccp_after(at)]);
    } while (at != corner);
    memcpy(s->ring + s->n, s->ring, s->n * sizeof *s->ring);
    return true;
}

/* ---- the queue ---- */

static void enqueue(coarsening *o, uint32_t vertex)
{
    if (o->is_queued[vertex] || o->map->fixed[vertex])
        return;
    o->is_queued[vertex] = 1;
    o->queue[(o->first + o->n_queued++) % o->map->n_vertices] = vertex;
}

static uint32_t dequeue(coarsening *o)
{
    const uint32_t vertex = o->queue[o->first];
    o->first = (o->first + 1) % o->map->n_vertices;
    --o->n_queued;
    o->is_queued[vertex] = 0;
    return vertex;
}

/* ---- merging ---- */

/* Whether the vertex may merge into ring vertex j, by the signs and edges of the new triangles. */
static bool may_merge(const coarsening *o, const star *s, size_t j)
{
    const iccp_plmap *map = o->map;
    const uint32_t *ring = s->ring + j, to = ring[0];
    const bool is_bounded = o->longest < HUGE_VAL;
    for (size_t k = 1; k + 1 < s->n; ++k)
        if ((k > 1 &&
             ((map->fixed[to] && map->fixed[ring[k]]) ||
              (is_bounded && iccp_plmap_length2(map, to, ring[k]) > o->longest * o->longest))) ||
            !iccp_quality_is_positive(map, to, ring[k], ring[k + 1]))
            return false;
    return true;
}

/* The energy of the new triangles; HUGE_VAL if it is above `most` or one is flatter than
 * `least`. */
static double energy_merged(const coarsening *o, const star *s, size_t j, double most, double least)
{
    iccp_quality merged = iccp_no_quality();
    const uint32_t *ring = s->ring + j;
    for (size_t k = 1; k + 1 < s->n; ++k) {
        iccp_quality_add(&merged, o->map, ring[0], ring[k], ring[k + 1]);
        if (!(merged.energy <= most && merged.roundness >= least))
            return HUGE_VAL;
    }
    return merged.energy;
}

/* The best ring vertex to merge into, or s->n if there is none. There is none for most vertices, so
 * cheap tests come first. */
static size_t best_neighbour(const coarsening *o, uint32_t vertex, const star *s)
{
    bool may[MOST_NEIGHBOURS];
    size_t n_may = 0, best = s->n;
    for (size_t j = 0; j < s->n; ++j)
        n_may += may[j] = may_merge(o, s, j);
    if (n_may == 0)
        return s->n;
    iccp_quality now = iccp_no_quality();
    for (size_t k = 0; k < s->n; ++k)
        iccp_quality_add(&now, o->map, vertex, s->ring[k], s->ring[k + 1]);
    const double least = iccp_min(now.roundness, LEAST_MERGED_ROUNDNESS);
    double most = iccp_max((1 + o->rise) * now.energy + o->worth, o->mean * now.area);
    for (size_t j = 0; j < s->n; ++j) {
        const double energy = may[j] ? energy_merged(o, s, j, most, least) : HUGE_VAL;
        if (energy < HUGE_VAL && (best == s->n || energy < most)) {
            most = energy;
            best = j;
        }
    }
    return best;
}

static void merge(coarsening *o, uint32_t vertex, const star *s, size_t j)
{
    iccp_corners *c = &o->map->corners;
    const size_t before = (j + s->n - 1) % s->n;
    iccp_collapse_edge(c, s->corner[j]);
    o->is_gone[vertex] = 1;
    o->is_unused[s->corner[j] / 3] = o->is_unused[s->corner[before] / 3] = 1;
    for (size_t k = 0; k < s->n; ++k) {
        const uint32_t t = 3 * (s->corner[k] / 3);
        for (uint32_t x = t; x < t + 3 && k != j && k != before; ++x)
            o->corner[c->vertex[x]] = x;
        enqueue(o, s->ring[k]);
    }
}

/* Merges vertices until the queue is empty. At first it holds all of them. */
static icc_status merge_all(coarsening *o, size_t *n_gone, const iccp_env *env)
{
    const size_t n_vertices = o->map->n_vertices;
    icc_status status = ICC_OK;
    for (uint32_t v = 0; v < n_vertices; ++v)
        enqueue(o, v);
    for (size_t n_looks = 0; status == ICC_OK && o->n_queued > 0; ++n_looks) {
        star s;
        const uint32_t v = dequeue(o);
        const size_t best =
            find_star(&o->map->corners, o->corner[v], &s) ? best_neighbour(o, v, &s) : s.n;
        if (best < s.n) {
            merge(o, v, &s, best);
            ++*n_gone;
        }
        if (n_looks % LOOKS_PER_REPORT == 0)
            status = iccp_progress(env, "improve", (double)*n_gone / (double)n_vertices);
    }
    return status;
}

/* ---- what is left ---- */

static void close_up_triangles(coarsening *o)
{
    iccp_corners *c = &o->map->corners;
    uint32_t n = 0;
    for (uint32_t t = 0; t < c->n_triangles; ++t)
        if (!o->is_unused[t])
            o->number[t] = n++;
    for (uint32_t t = 0; t < c->n_triangles; ++t)
        for (size_t k = 0; k < 3 && !o->is_unused[t]; ++k) {
            const size_t from = 3 * (size_t)t + k, to = 3 * (size_t)o->number[t] + k;
            const uint32_t twin = c->twin[from];
            c->vertex[to] = c->vertex[from];
            c->twin[to] = twin == ICCP_NO_NEIGHBOUR ? twin : 3 * o->number[twin / 3] + twin % 3;
        }
    c->n_triangles = n;
}

/* Uses `corner` for the new numbers. */
static void close_up_vertices(coarsening *o)
{
    iccp_plmap *map = o->map;
    uint32_t n = 0;
    for (uint32_t v = 0; v < map->n_vertices; ++v) {
        if (o->is_gone[v])
            continue;
        memmove(map->points + 2 * (size_t)n, map->points + 2 * (size_t)v, 2 * sizeof(double));
        memmove(map->images + 2 * (size_t)n, map->images + 2 * (size_t)v, 2 * sizeof(double));
        map->fixed[n] = map->fixed[v];
        map->facet[n] = map->facet[v];
        map->along[n] = map->along[v];
        o->corner[v] = n++;
    }
    map->n_vertices = n;
    for (size_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        map->corners.vertex[c] = o->corner[map->corners.vertex[c]];
}

/* ---- all of it ---- */

static icc_status begin(coarsening *o)
{
    const iccp_corners *c = &o->map->corners;
    const size_t n = o->map->n_vertices;
    o->corner = iccp_alloc(o->memory, n, sizeof *o->corner);
    o->queue = iccp_alloc(o->memory, n, sizeof *o->queue);
    o->is_queued = iccp_alloc_zero(o->memory, n, 1);
    o->is_gone = iccp_alloc_zero(o->memory, n, 1);
    o->is_unused = iccp_alloc_zero(o->memory, c->n_triangles, 1);
    o->number = iccp_alloc(o->memory, c->n_triangles, sizeof *o->number);
    if (o->corner == NULL || o->queue == NULL || o->is_queued == NULL || o->is_gone == NULL ||
        o->is_unused == NULL || o->number == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t x = 0; x < 3 * c->n_triangles; ++x)
        o->corner[c->vertex[x]] = x;
    return ICC_OK;
}

static void release(coarsening *o)
{
    iccp_free(o->memory, o->corner);
    iccp_free(o->memory, o->queue);
    iccp_free(o->memory, o->is_queued);
    iccp_free(o->memory, o->is_gone);
    iccp_free(o->memory, o->is_unused);
    iccp_free(o->memory, o->number);
}

static icc_status coarsen(coarsening *o, size_t *n_gone, const iccp_env *env)
{
    *n_gone = 0;
    icc_status status = begin(o);
    if (status == ICC_OK)
        status = merge_all(o, n_gone, env);
    if (*n_gone > 0) {
        close_up_triangles(o);
        close_up_vertices(o);
    }
    release(o);
    return status;
}

icc_status iccp_coarsen(iccp_plmap *map, double rise, size_t *n_gone, const iccp_env *env)
{
    coarsening o = {.memory = &env->memory,
                    .map = map,
                    .rise = rise,
                    .mean = iccp_plmap_energy(map),
                    .longest = HUGE_VAL};
    return coarsen(&o, n_gone, env);
}

icc_status iccp_coarsen_within(iccp_plmap *map, double rise, double longest, size_t *n_gone,
                               const iccp_env *env)
{
    coarsening o = {.memory = &env->memory, .map = map, .rise = rise, .longest = longest};
    return coarsen(&o, n_gone, env);
}

icc_status iccp_coarsen_worthless(iccp_plmap *map, double worth, size_t *n_gone,
                                  const iccp_env *env)
{
    coarsening o = {.memory = &env->memory, .map = map, .worth = worth, .longest = HUGE_VAL};
    return coarsen(&o, n_gone, env);
}
