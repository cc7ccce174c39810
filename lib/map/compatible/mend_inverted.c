/* Edges are flipped as long as that leaves fewer triangles inverted. Those that are left get
 * patches: polygons of a few triangles without vertices inside, which are simple before and after
 * the map. Overlays replace them. A patch grows from an inverted triangle over the triangles that
 * it must have: those that overlap an inverted one. */
#include "map/compatible/mend_inverted.h"

#include "geometry/segment.h"
#include "map/compatible/patch_overlays.h"
#include "math/predicates.h"

#include <string.h>

/* How many pairs of a patch's edges or triangles may be compared in the search for patches, as a
 * multiple of the number of vertices. */
enum { EFFORT = 64 };

static const uint32_t NONE = UINT32_MAX;

/* ---- signs ---- */

static const double *places_of(const iccp_plmap *map, int side)
{
    return side == 0 ? map->points : map->images;
}

static bool is_positive(const iccp_plmap *map, int side, uint32_t a, uint32_t b, uint32_t c)
{
    const double *places = places_of(map, side);
    return iccp_orient2d(places + 2 * (size_t)a, places + 2 * (size_t)b, places + 2 * (size_t)c) >
           0;
}

static bool is_sound_on(const iccp_plmap *map, int side, uint32_t triangle)
{
    return side == 0 ? iccp_plmap_positive_point(map, triangle)
                     : iccp_plmap_positive_image(map, triangle);
}

static bool is_sound(const iccp_plmap *map, uint32_t triangle)
{
    return is_sound_on(map, 0, triangle) && is_sound_on(map, 1, triangle);
}

/* ---- flips ---- */

/* Whether flipping the edge that a corner faces leaves fewer triangles inverted. */
static bool helps(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t *v = map->corners.vertex, twin = map->corners.twin[corner];
    if (!iccp_plmap_may_flip(map, corner))
        return false;
    const uint32_t x = v[corner], y = v[twin], a = v[iccp_after(corner)],
                   b = v[iccp_before(corner)];
    int gain = 0;
    for (int side = 0; side < 2; ++side)
        gain += is_positive(map, side, x, a, y) + is_positive(map, side, y, b, x) -
                is_positive(map, side, x, a, b) - is_positive(map, side, y, b, a);
    return gain > 0;
}

/* The triangles that are to be looked at, each at most once at a time. */
typedef struct waiting {
    uint32_t *triangle;
    bool *is_in;
    size_t n;
} waiting;

static void wait(waiting *w, const iccp_plmap *map, uint32_t triangle)
{
    if (!w->is_in[triangle] && !is_sound(map, triangle)) {
        w->is_in[triangle] = true;
        w->triangle[w->n++] = triangle;
    }
}

/* Flips an edge. The two triangles beside it, and those beside them, are looked at again. */
static void flip(waiting *w, iccp_plmap *map, uint32_t corner)
{
    const iccp_corners *mesh = &map->corners;
    const uint32_t pair[2] = {corner / 3, mesh->twin[corner] / 3};
    iccp_flip_edge(&map->corners, corner);
    for (int i = 0; i < 2; ++i) {
        wait(w, map, pair[i]);
        for (uint32_t c = 3 * pair[i]; c < 3 * pair[i] + 3; ++c)
            if (mesh->twin[c] != ICCP_NO_NEIGHBOUR)
                wait(w, map, mesh->twin[c] / 3);
    }
}

/* Each flip leaves fewer triangles inverted, so there are no more flips than that. */
static icc_status flip_inverted(iccp_plmap *map, const iccp_memory *memory)
{
    const size_t n = map->corners.n_triangles;
    waiting w = {iccp_alloc(memory, n, sizeof *w.triangle),
                 iccp_alloc_zero(memory, n, sizeof *w.is_in), 0};
    const bool ok = w.triangle != NULL && w.is_in != NULL;
    for (uint32_t t = 0; ok && t < n; ++t)
        wait(&w, map, t);
    while (ok && w.n > 0) {
        const uint32_t t = w.triangle[--w.n];
        w.is_in[t] = false;
        for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
            if (!is_sound(map, t) && helps(map, c))
                flip(&w, map, c);
    }
    iccp_free(memory, w.triangle);
    iccp_free(memory, w.is_in);
    return ok ? ICC_OK : ICC_ERR_MEMORY;
}

/* ---- patches ---- */

/* A patch that grows, as a polygon: edge k goes from vertex[k] to the next one and faces corner[k],
 * which is inside. */
typedef struct growth {
    const iccp_plmap *map;
    uint32_t *patch_of;        /* of each triangle: its patch, or NONE */
    uint32_t *vertex, *corner; /* n */
    uint32_t *age;             /* n: when edge k was added */
    uint32_t *heir;            /* of each triangle: the patch that dissolved its patch, or NONE */
    uint32_t *met;             /* of each vertex: the last patch that has it, or NONE */
    uint32_t *inverted;        /* n_inverted triangles of the patch */
    uint32_t n, n_inverted, n_patches, clock;
    bool is_over; /* no patch was dissolved since the triangles were looked at */
    double left;  /* pairs of edges or triangles that may still be compared */
} growth;

static icc_status reserve(growth *g, const iccp_plmap *map, const iccp_memory *memory)
{
    const size_t n = map->n_vertices, n_triangles = map->corners.n_triangles;
    *g = (growth){.map = map,
                  .patch_of = iccp_alloc(memory, n_triangles, sizeof *g->patch_of),
                  .vertex = iccp_alloc(memory, n, sizeof *g->vertex),
                  .corner = iccp_alloc(memory, n, sizeof *g->corner),
                  .age = iccp_alloc(memory, n, sizeof *g->age),
                  .met = iccp_alloc(memory, n, sizeof *g->met),
                  .heir = iccp_alloc(memory, n_triangles, sizeof *g->heir),
                  .inverted = iccp_alloc(memory, n_triangles, sizeof *g->inverted),
                  .left = EFFORT * (double)n};
    if (g->patch_of == NULL || g->vertex == NULL || g->corner == NULL || g->age == NULL ||
        g->met == NULL || g->inverted == NULL || g->heir == NULL)
        return ICC_ERR_MEMORY;
    memset(g->patch_of, 0xff, n_triangles * sizeof *g->patch_of);
    memset(g->heir, 0xff, n_triangles * sizeof *g->heir);
    memset(g->met, 0xff, n * sizeof *g->met);
    return ICC_OK;
}

static void release(growth *g, const iccp_memory *memory)
{
    iccp_free(memory, g->patch_of);
    iccp_free(memory, g->vertex);
    iccp_free(memory, g->corner);
    iccp_free(memory, g->age);
    iccp_free(memory, g->met);
    iccp_free(memory, g->inverted);
    iccp_free(memory, g->heir);
}

/* Whether the polygon is simple and counter-clockwise on one side, exactly. */
static bool is_simple(growth *g, int side)
{
    const uint32_t n = g->n;
    const double *places = places_of(g->map, side);
    uint32_t lowest = 0;
    g->left -= 0.5 * n * n;
    for (uint32_t k = 0; k < n; ++k) {
        const double *here = places + 2 * (size_t)g->vertex[k];
        const double *next = places + 2 * (size_t)g->vertex[(k + 1) % n];
        const double *last = places + 2 * (size_t)g->vertex[(k + n - 1) % n];
        if (iccp_point_folds(here, last, next))
            return false;
        if (iccp_point_less(here, places + 2 * (size_t)g->vertex[lowest]))
            lowest = k;
        for (uint32_t other = k + 2; other < n && (other + 1) % n != k; ++other)
            if (iccp_segments_meet(here, next, places + 2 * (size_t)g->vertex[other],
                                   places + 2 * (size_t)g->vertex[(other + 1) % n]) != 0)
                return false;
    }
    return is_positive(g->map, side, g->vertex[(lowest + n - 1) % n], g->vertex[lowest],
                       g->vertex[(lowest + 1) % n]);
}

/* Gives up a patch that the present one grows into, which shall have all of its triangles. */
static void dissolve(growth *g, uint32_t patch)
{
    const size_t n = g->map->corners.n_triangles;
    for (size_t t = 0; t < n; ++t)
        if (g->patch_of[t] == patch) {
            g->patch_of[t] = NONE;
            g->heir[t] = g->n_patches;
        }
    g->is_over = false;
    g->left -= (double)n;
}

static void take(growth *g, uint32_t triangle)
{
    if (g->patch_of[triangle] != NONE)
        dissolve(g, g->patch_of[triangle]);
    g->patch_of[triangle] = g->n_patches;
    if (!is_sound(g->map, triangle))
        g->inverted[g->n_inverted++] = triangle;
}

/* Returns the triangle beyond an edge if the patch may grow over it, or NONE. */
static uint32_t beyond(const growth *g, uint32_t k)
{
    const uint32_t twin = g->map->corners.twin[g->corner[k]];
    return twin != ICCP_NO_NEIGHBOUR && g->met[g->map->corners.vertex[twin]] != g->n_patches &&
                   !iccp_plmap_is_line(g->map, twin)
               ? twin / 3
               : NONE;
}

/* Grows over an edge. */
static void add(growth *g, uint32_t k)
{
    const uint32_t twin = g->map->corners.twin[g->corner[k]];
    const size_t n = g->n - k;
    memmove(g->vertex + k + 1, g->vertex + k, n * sizeof *g->vertex);
    memmove(g->corner + k + 1, g->corner + k, n * sizeof *g->corner);
    memmove(g->age + k + 1, g->age + k, n * sizeof *g->age);
    ++g->n;
    g->vertex[k + 1] = g->map->corners.vertex[twin];
    g->corner[k] = iccp_after(twin);
    g->corner[k + 1] = iccp_before(twin);
    g->age[k] = g->age[k + 1] = ++g->clock;
    g->met[g->vertex[k + 1]] = g->n_patches;
    take(g, twin / 3);
}

/* Whether the line of an edge of triangle `a` separates the two on one side. */
static bool is_apart(const iccp_plmap *map, int side, uint32_t a, uint32_t b)
{
    const uint32_t *v = map->corners.vertex + 3 * (size_t)a,
                   *w = map->corners.vertex + 3 * (size_t)b;
    const double *places = places_of(map, side);
    const bool is_sound = is_sound_on(map, side, a);
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t ends[2] = {v[k], v[(k + 1) % 3]};
        const double *from = places + 2 * (size_t)ends[!is_sound];
        const double *to = places + 2 * (size_t)ends[is_sound];
        bool is = true;
        for (uint32_t i = 0; i < 3 && is; ++i)
            is = iccp_orient2d(from, to, places + 2 * (size_t)w[i]) <= 0;
        if (is)
            return true;
    }
    return false;
}

/* Whether two triangles overlap on the side where the first one is inverted. */
static bool overlap(const iccp_plmap *map, uint32_t inverted, uint32_t other)
{
    bool do_overlap = false;
    for (int side = 0; side < 2; ++side)
        do_overlap = do_overlap ||
                     (!is_sound_on(map, side, inverted) && !is_apart(map, side, inverted, other) &&
                      !is_apart(map, side, other, inverted));
    return do_overlap;
}

/* Whether the patch must have a triangle: one that is inverted, or overlaps an inverted one of the
 * patch, or one that it inherits. */
static bool is_needed(growth *g, uint32_t triangle)
{
    bool is = g->heir[triangle] == g->n_patches || !is_sound(g->map, triangle);
    for (uint32_t i = 0; i < g->n_inverted && !is; ++i)
        is = overlap(g->map, g->inverted[i], triangle);
    g->left -= g->n_inverted;
    return is;
}

/* Grows over one edge: one beyond which a triangle is needed, or the oldest if the patch is not
 * simple. *done: whether it is. Returns false if the patch cannot grow. */
static bool grow(growth *g, bool *done)
{
    uint32_t oldest = NONE;
    for (uint32_t k = 0; k < g->n; ++k) {
        const uint32_t triangle = beyond(g, k);
        if (triangle == NONE)
            continue;
        if (is_needed(g, triangle)) {
            add(g, k);
            return true;
        }
        if (oldest == NONE || g->age[k] < g->age[oldest])
            oldest = k;
    }
    *done = is_simple(g, 0) && is_simple(g, 1);
    if (!*done && oldest != NONE)
        add(g, oldest);
    return *done || oldest != NONE;
}

/* Makes the patch of an inverted triangle. Returns false if there seems to be none. */
static bool enclose(growth *g, uint32_t triangle)
{
    bool done = false;
    g->n = 3;
    g->n_inverted = 0;
    take(g, triangle);
    for (uint32_t k = 0; k < 3; ++k) {
        g->vertex[k] = g->map->corners.vertex[3 * triangle + k];
        g->corner[k] = 3 * triangle + (k + 2) % 3;
        g->age[k] = ++g->clock;
        g->met[g->vertex[k]] = g->n_patches;
    }
    while (!done && g->left > 0)
        if (!grow(g, &done))
            return false;
    ++g->n_patches;
    return done;
}

/* Makes patches for all inverted triangles. Those of dissolved patches are looked at again. */
static bool enclose_all(growth *g)
{
    bool done = true;
    for (g->is_over = false; done && !g->is_over;) {
        g->is_over = true;
        for (uint32_t t = 0; done && t < g->map->corners.n_triangles; ++t)
            if (g->patch_of[t] == NONE && !is_sound(g->map, t))
                done = enclose(g, t);
    }
    return done;
}

/* Numbers the patches that are left anew. */
static icc_status number_patches(growth *g, const iccp_memory *memory)
{
    uint32_t *number = iccp_alloc(memory, g->n_patches, sizeof *number), n = 0;
    if (number == NULL)
        return ICC_ERR_MEMORY;
    memset(number, 0xff, g->n_patches * sizeof *number);
    for (size_t t = 0; t < g->map->corners.n_triangles; ++t)
        if (g->patch_of[t] != NONE) {
            uint32_t *own = &number[g->patch_of[t]];
            *own = *own == NONE ? n++ : *own;
            g->patch_of[t] = *own;
        }
    g->n_patches = n;
    iccp_free(memory, number);
    return ICC_OK;
}

/* Replaces the triangles that are still inverted and some beside them by overlays. *done becomes
 * false if that is not possible. */
static icc_status overlay_inverted(iccp_plmap *map, bool *done, iccp_work *work,
                                   const iccp_env *env)
{
    growth g;
    icc_status status = reserve(&g, map, &env->memory);
    *done = status == ICC_OK && enclose_all(&g);
    if (*done && g.n_patches > 0) {
        status = number_patches(&g, &env->memory);
        if (status == ICC_OK)
            status =
                iccp_overlay_triangles(map, g.n_patches, g.patch_of, SIZE_MAX, done, work, env);
        *done = status == ICC_OK && iccp_plmap_is_positive(map);
    }
    release(&g, &env->memory);
    return status;
}

icc_status iccp_mend_inverted(iccp_plmap *map, bool *done, iccp_work *work, const iccp_env *env)
{
    const icc_status status = flip_inverted(map, &env->memory);
    *done = false;
    return status == ICC_OK ? overlay_inverted(map, done, work, env) : status;
}
