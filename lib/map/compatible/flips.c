/* Replaces an edge by the other diagonal of its two triangles where that lowers the energy: C.
 * Lawson, Software for C1 surface interpolation, 1977. */
#include "map/compatible/flips.h"

#include "base/threads.h"
#include "map/compatible/triangle_quality.h"

enum { PASSES = 5 };

/* Triangles in a chunk for one thread. */
enum { GRAIN = 256 };

/* A flip must lower the energy of its two triangles by this share. */
static const double LEAST_FALL = 1e-3;

/* A flip makes no triangle flatter than this, unless it replaces one that is at least as flat. Flat
 * triangles make Newton's steps short. */
static const double LEAST_FLIPPED_ROUNDNESS = 0.05;

/* Flipping the edge makes triangles x a y and y b x from x a b and y b a. */
static bool is_better_flipped(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t *v = map->corners.vertex, twin = map->corners.twin[corner];
    const uint32_t x = v[corner], y = v[twin], a = v[iccp_after(corner)],
                   b = v[iccp_before(corner)];
    if ((map->fixed[x] && map->fixed[y]) || iccp_plmap_is_line(map, corner) ||
        !iccp_quality_is_positive(map, x, a, y) || !iccp_quality_is_positive(map, y, b, x))
        return false;
    iccp_quality now = iccp_no_quality(), then = iccp_no_quality();
    iccp_quality_add(&now, map, x, a, b);
    iccp_quality_add(&now, map, y, b, a);
    iccp_quality_add(&then, map, x, a, y);
    iccp_quality_add(&then, map, y, b, x);
    return then.energy < (1 - LEAST_FALL) * now.energy &&
           then.roundness >= iccp_min(now.roundness, LEAST_FLIPPED_ROUNDNESS);
}

/* An edge is tested again only if one of its two triangles has changed since. Tests are numbered
 * from 1: one for each corner in each pass. */
typedef struct search {
    iccp_plmap *map;
    size_t *changed;    /* of each triangle: the test after which it changed last, or 0 */
    size_t *near;       /* of each triangle: the test after which it or a neighbour changed last */
    uint8_t *is_better; /* of each corner, for the mesh at the beginning; NULL: not known */
} search;

static icc_status look_ahead(void *argument, size_t begin, size_t end)
{
    const search *s = argument;
    const uint32_t *twin = s->map->corners.twin;
    for (size_t c = 3 * begin; c < 3 * end; ++c)
        s->is_better[c] =
            c < twin[c] && twin[c] != ICCP_NO_NEIGHBOUR && is_better_flipped(s->map, (uint32_t)c);
    return ICC_OK;
}

/* Returns is_better_flipped() at test number `look`, from an earlier test if that still holds. */
static bool is_better_now(const search *s, uint32_t corner, size_t look)
{
    const iccp_corners *c = &s->map->corners;
    const size_t own = s->changed[corner / 3], other = s->changed[c->twin[corner] / 3];
    const size_t per_pass = 3 * c->n_triangles, latest = own > other ? own : other;
    if (look <= per_pass && latest == 0 && s->is_better != NULL)
        return s->is_better[corner];
    return (look <= per_pass || latest >= look - per_pass) && is_better_flipped(s->map, corner);
}

static void flip(const search *s, uint32_t corner, size_t look)
{
    iccp_corners *c = &s->map->corners;
    const uint32_t pair[2] = {corner / 3, c->twin[corner] / 3};
    iccp_flip_edge(c, corner);
    for (int i = 0; i < 2; ++i) {
        s->changed[pair[i]] = s->near[pair[i]] = look;
        for (uint32_t k = 3 * pair[i]; k < 3 * pair[i] + 3; ++k)
            if (c->twin[k] != ICCP_NO_NEIGHBOUR)
                s->near[c->twin[k] / 3] = look;
    }
}

/* Whether no edge of a triangle has to be tested. `look`: the test of its first corner. */
static bool is_done(const search *s, size_t triangle, size_t look)
{
    const size_t per_pass = 3 * s->map->corners.n_triangles;
    if (look > per_pass)
        return s->near[triangle] < look - per_pass;
    if (s->is_better == NULL || s->near[triangle] > 0)
        return false;
    const uint8_t *better = s->is_better + 3 * triangle;
    return !better[0] && !better[1] && !better[2];
}

static size_t flip_all(const search *s)
{
    const iccp_corners *c = &s->map->corners;
    size_t n = 0, n_before = SIZE_MAX, look = 1;
    for (int pass = 0; pass < PASSES && n != n_before; ++pass) {
        n_before = n;
        for (uint32_t t = 0; t < c->n_triangles; ++t, look += 3)
            for (uint32_t k = 0; k < 3 && !is_done(s, t, look); ++k) {
                const uint32_t corner = 3 * t + k, twin = c->twin[corner];
                if (corner < twin && twin != ICCP_NO_NEIGHBOUR &&
                    is_better_now(s, corner, look + k)) {
                    flip(s, corner, look + k);
                    ++n;
                }
            }
    }
    return n;
}

/* With threads, all edges are tested at once beforehand. Results that flips do not outdate are
 * used. */
icc_status iccp_flip_edges(iccp_plmap *map, size_t *n_flips, const iccp_env *env)
{
    const size_t n = map->corners.n_triangles;
    iccp_env quiet = *env;
    search s = {.map = map, .changed = iccp_alloc_zero(&env->memory, n, 2 * sizeof *s.changed)};
    icc_status status = s.changed != NULL ? ICC_OK : ICC_ERR_MEMORY;
    s.near = s.changed != NULL ? s.changed + n : NULL;
    quiet.progress = NULL;
    *n_flips = 0;
    if (status == ICC_OK && iccp_has_threads(env)) {
        s.is_better = iccp_alloc(&env->memory, n, 3 * sizeof *s.is_better);
        status = s.is_better != NULL ? iccp_for_chunks(&quiet, "improve", n, GRAIN, look_ahead, &s)
                                     : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK)
        *n_flips = flip_all(&s);
    iccp_free(&env->memory, s.changed);
    iccp_free(&env->memory, s.is_better);
    return status;
}
