/* L. A. Freitag, C. Ollivier-Gooch, Tetrahedral mesh improvement using swapping and smoothing,
 * 1997. Dynamic programming finds the best replacement of the tetrahedra around an edge: G. T.
 * Klincsek, Minimal triangulations of polygonal domains, 1980. Here quality is the energy of the
 * map. */
#include "map/solid/solid_flips.h"

#include <math.h>
#include <string.h>

/* The longest ring that is flipped. */
enum { RING = 8 };

enum { PASSES = 8 };

/* Passes end when one makes fewer flips than this share of the tetrahedra. */
static const double FEW = 1e-4;

/* A flip lowers the energy of its tetrahedra by this share at least. */
static const double LEAST_FALL = 1e-3;

/* The value of the two tetrahedra that a triangle of the ring makes with the ends of the edge. */
static double pair_value(const iccp_solid_edit *edit, uint32_t a, uint32_t b, uint32_t x,
                         uint32_t y, uint32_t z)
{
    double volume;
    const double value = iccp_solid_value(edit, (const uint32_t[4]){a, x, y, z}, &volume);
    return value < HUGE_VAL
               ? value + iccp_solid_value(edit, (const uint32_t[4]){b, x, z, y}, &volume)
               : value;
}

/* best[x][y]: the least value of the part of the ring from x to y. split[x][y]: the third corner of
 * the triangle at its edge x-y. */
typedef struct triangulation {
    double best[RING][RING];
    uint8_t split[RING][RING];
} triangulation;

static void triangulate(const iccp_solid_edit *edit, uint32_t a, uint32_t b, const iccp_ring *ring,
                        double limit, triangulation *t)
{
    for (size_t x = 0; x + 1 < ring->n; ++x)
        t->best[x][x + 1] = 0;
    for (size_t gap = 2; gap < ring->n; ++gap)
        for (size_t x = 0; x + gap < ring->n; ++x) {
            const size_t y = x + gap;
            double *best = &t->best[x][y];
            *best = HUGE_VAL;
            for (size_t z = x + 1; z < y; ++z) {
                const double parts = t->best[x][z] + t->best[z][y];
                if (!(parts < *best) || !(parts < limit))
                    continue;
                const double all =
                    parts + pair_value(edit, a, b, ring->point[x], ring->point[z], ring->point[y]);
                if (all < *best) {
                    *best = all;
                    t->split[x][y] = (uint8_t)z;
                }
            }
        }
}

/* Adds the tetrahedra for the part of the ring from x to y, from the largest triangle on. */
static void fill(iccp_solid_edit *edit, uint32_t a, uint32_t b, const iccp_ring *ring,
                 const triangulation *t)
{
    size_t stack[RING][2] = {{0, ring->n - 1}}, n = 1;
    while (n > 0) {
        const size_t x = stack[--n][0], y = stack[n][1];
        if (y - x < 2)
            continue;
        const size_t z = t->split[x][y];
        const uint32_t *p = ring->point;
        iccp_solid_add(edit, (const uint32_t[4]){a, p[x], p[z], p[y]});
        iccp_solid_add(edit, (const uint32_t[4]){b, p[x], p[y], p[z]});
        stack[n][0] = x;
        stack[n++][1] = z;
        stack[n][0] = z;
        stack[n++][1] = y;
    }
}

/* Adds up the values of the present tetrahedra. Returns true if less is possible at all. The value
 * of an isometry is 6 times the volume. */
static bool add_values(const iccp_solid_edit *edit, size_t n, const uint32_t *simplices,
                       double *limit)
{
    double sum = 0, all = 0, volume;
    for (size_t k = 0; k < n; ++k) {
        sum += iccp_solid_value(edit, edit->map->mesh->corners + 4 * (size_t)simplices[k], &volume);
        all += volume;
    }
    *limit = (1 - LEAST_FALL) * sum;
    return 6 * all < *limit;
}

/* Returns true for the first new tetrahedron around an edge. Only that one tries the edge. */
static bool is_first(const iccp_solid_edit *edit, const iccp_ring *ring, uint32_t simplex)
{
    for (size_t k = 0; k < ring->n; ++k)
        if (ring->simplex[k] < simplex && edit->is_new[ring->simplex[k]])
            return false;
    return true;
}

static icc_status try_edge(iccp_solid_edit *edit, uint32_t simplex, uint32_t a, uint32_t b,
                           size_t *n_flips)
{
    iccp_ring ring;
    triangulation t;
    double limit;
    if (iccp_solid_keeps_edge(&edit->marks, a, b) || !iccp_solid_ring(edit, a, b, &ring) ||
        ring.n > RING || !is_first(edit, &ring, simplex) || !iccp_ring_is_there(edit, &ring) ||
        !add_values(edit, ring.n, ring.simplex, &limit))
        return ICC_OK;
    triangulate(edit, a, b, &ring, limit, &t);
    if (!(t.best[0][ring.n - 1] < limit))
        return ICC_OK;
    const icc_status status = iccp_solid_reserve(edit, 0, 2 * (ring.n - 2));
    if (status != ICC_OK)
        return status;
    fill(edit, a, b, &ring, &t);
    for (size_t k = 0; k < ring.n; ++k)
        edit->is_gone[ring.simplex[k]] = 1;
    ++*n_flips;
    return ICC_OK;
}

/* Tries the face opposite `corner`, with d on its other side: three tetrahedra around the edge from
 * the corner to d replace the two. */
static icc_status try_face(iccp_solid_edit *edit, uint32_t simplex, size_t corner, size_t *n_flips)
{
    const uint32_t *corners = edit->map->mesh->corners, *v = corners + 4 * (size_t)simplex;
    uint32_t pair[2] = {simplex, 0}, after[3][4];
    double limit, sum = 0, volume;
    const uint32_t face[3] = {v[(corner + 1) % 4], v[(corner + 2) % 4], v[(corner + 3) % 4]};
    if (iccp_solid_keeps_face(&edit->marks, face))
        return ICC_OK;
    if (!iccp_solid_across(edit, simplex, corner, &pair[1]) || edit->is_gone[pair[1]] ||
        (pair[1] < simplex && edit->is_new[pair[1]]) || !add_values(edit, 2, pair, &limit))
        return ICC_OK;
    const uint32_t *w = corners + 4 * (size_t)pair[1];
    uint32_t d = w[0];
    for (size_t k = 1; d == v[0] || d == v[1] || d == v[2] || d == v[3]; ++k)
        d = w[k];
    for (size_t k = 0, n = 0; k < 4; ++k) {
        if (k == corner)
            continue;
        memcpy(after[n], v, sizeof after[n]);
        after[n][k] = d;
        sum += iccp_solid_value(edit, after[n++], &volume);
        if (!(sum < limit))
            return ICC_OK;
    }
    const icc_status status = iccp_solid_reserve(edit, 0, 3);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; k < 3; ++k)
        iccp_solid_add(edit, after[k]);
    edit->is_gone[pair[0]] = edit->is_gone[pair[1]] = 1;
    ++*n_flips;
    return ICC_OK;
}

/* Tries all edges before all faces. */
static icc_status flip_once(iccp_solid_edit *edit, size_t *n_flips)
{
    icc_status status = ICC_OK;
    for (uint32_t s = 0; status == ICC_OK && s < edit->n_simplices; ++s)
        for (size_t e = 0; e < 6 && status == ICC_OK && edit->is_new[s] && !edit->is_gone[s]; ++e) {
            static const uint8_t ENDS[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
            const uint32_t *v = edit->map->mesh->corners + 4 * (size_t)s;
            status = try_edge(edit, s, v[ENDS[e][0]], v[ENDS[e][1]], n_flips);
        }
    for (uint32_t s = 0; status == ICC_OK && s < edit->n_simplices; ++s)
        for (size_t c = 0; c < 4 && status == ICC_OK && edit->is_new[s] && !edit->is_gone[s]; ++c)
            status = try_face(edit, s, c, n_flips);
    return status;
}

/* The next pass only looks at new tetrahedra. */
icc_status iccp_solid_flip(iccp_solid_edit *edit, size_t *n_flips, const iccp_env *env)
{
    icc_status status = ICC_OK;
    *n_flips = 0;
    memset(edit->is_new, 1, edit->map->mesh->n_simplices);
    for (int pass = 0; status == ICC_OK && pass < PASSES; ++pass) {
        size_t n = 0;
        status = iccp_progress(env, "improve", (double)pass / PASSES);
        if (status == ICC_OK)
            status = iccp_solid_edit_begin(edit);
        if (status != ICC_OK)
            break;
        status = flip_once(edit, &n);
        memset(edit->is_new, 0, edit->n_simplices);
        iccp_solid_edit_end(edit);
        *n_flips += n;
        if ((double)n <= FEW * (double)edit->map->mesh->n_simplices)
            break;
    }
    return status;
}
