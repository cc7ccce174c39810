/* Searches the rotation of one drawing on a grid of quaternions, and refines the best ones. */
#include "match/sphere/rotation.h"

#include "base/minmax.h"
#include "match/sphere/decimate.h"
#include "match/sphere/drawn_finder.h"
#include "match/sphere/sphere_certificate.h"
#include "match/surface/corner_angle.h"
#include "match/surface/direction.h"
#include "match/surface/drawn_place.h"
#include "match/surface/stretch.h"

#include <string.h>

/* Vertices of the first surface that are compared. */
enum { SAMPLES = 150 };

/* Rotations are quaternions on the surface of a tesseract: one coordinate is 1, and the others take
 * STEPS values each. They are about 40 degrees apart. The BEST ones are refined in ROUNDS rounds of
 * ever smaller turns. One that was ninth on the grid becomes the best for t05 and t01. */
enum { STEPS = 5, BEST = 12, ROUNDS = 24 };
static const double first_turn = 0.2, last_turn = 1e-3;

/* The energy of a triangle is cut off here, because stronger stretch tells nothing. */
static const double most = 1000;

/* Cost of a pair of directions at distance 1. */
static const double apart = 1e4;

typedef struct search {
    iccp_half_edges coarse; /* of the first surface */
    const double *first, *second, *x[2];
    size_t n_pairs;
    const uint32_t *pairs[2];
    double scale[2]; /* makes both areas 1 */
    const iccp_half_edges *m;
    iccp_drawn_finder finder; /* of the second */
    double (*image)[3];       /* by vertex of the first */
} search;

typedef struct turn {
    double energy, q[4];
} turn;

static void rotate(double out[3], const double q[4], const double p[3])
{
    const double length = iccp_vec_dot(4, q, q);
    double u[3], v[3];
    iccp_vec_cross(q + 1, p, u);
    for (int k = 0; k < 3; ++k)
        u[k] += q[0] * p[k];
    iccp_vec_cross(q + 1, u, v);
    for (int k = 0; k < 3; ++k)
        out[k] = p[k] + 2 * v[k] / length;
}

static double total_area(const iccp_half_edges *m, const double *x)
{
    double sum = 0;
    for (size_t f = 0; f < m->n_faces; ++f) {
        const uint32_t *const v = m->origin + 3 * f;
        double normal[3];
        iccp_triangle_normal(normal, x + 3 * (size_t)v[0], x + 3 * (size_t)v[1],
                             x + 3 * (size_t)v[2]);
        sum += 0.5 * iccp_vec_norm(3, normal);
    }
    return sum;
}

/* The place on the second surface of a direction of its drawing, scaled. */
static void find_image(const search *s, const double p[3], double image[3])
{
    const uint32_t face = iccp_drawn_find(&s->finder, p);
    const double *corner[3];
    double weight[3];
    for (uint32_t i = 0; i < 3; ++i)
        corner[i] = s->finder.directions + 3 * (size_t)s->m->origin[3 * face + i];
    iccp_drawn_weights(weight, p, corner);
    for (int k = 0; k < 3; ++k) {
        image[k] = 0;
        for (uint32_t i = 0; i < 3; ++i)
            image[k] += s->scale[1] * weight[i] *
                        s->x[1][3 * (size_t)s->m->origin[3 * face + i] + (size_t)k];
    }
}

/* The mean squared distance of pairs of vertices. */
static double distance_of_pairs(const search *s, const double q[4])
{
    double sum = 0;
    for (size_t k = 0; k < s->n_pairs; ++k) {
        double p[3];
        rotate(p, q, s->first + 3 * (size_t)s->pairs[0][k]);
        sum += iccp_vec_distance2(3, p, s->second + 3 * (size_t)s->pairs[1][k]);
    }
    return s->n_pairs > 0 ? sum / (double)s->n_pairs : 0;
}

/* The mean energy over the faces left of the first surface, plus the cost of pairs. */
static double energy_of(const search *s, const double q[4])
{
    double sum = 0, weights = 0;
    const iccp_half_edges *const m = &s->coarse;
    for (size_t v = 0; v < m->n_vertices; ++v)
        if (m->degree[v] > 0) {
            double p[3];
            rotate(p, q, s->first + 3 * v);
            find_image(s, p, s->image[v]);
        }
    for (uint32_t v = 0; v < m->n_vertices; ++v) {
        uint32_t h = m->out[v];
        for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h)) {
            const uint32_t corner[3] = {v, iccp_edge_end(m, h), m->origin[iccp_before(h)]};
            if (corner[1] < v || corner[2] < v)
                continue;
            double from[3][3], normal[3], areas = 0;
            const double *a[3], *b[3];
            for (int i = 0; i < 3; ++i) {
                for (int c = 0; c < 3; ++c)
                    from[i][c] = s->scale[0] * s->x[0][3 * (size_t)corner[i] + (size_t)c];
                a[i] = from[i];
                b[i] = s->image[corner[i]];
            }
            iccp_triangle_normal(normal, a[0], a[1], a[2]);
            areas += iccp_vec_norm(3, normal);
            iccp_triangle_normal(normal, b[0], b[1], b[2]);
            areas += iccp_vec_norm(3, normal);
            sum += areas * iccp_stretch_energy(a, b, most);
            weights += areas;
        }
    }
    return sum / weights + apart * distance_of_pairs(s, q);
}

/* Keeps the best rotations, in order. */
static void offer(turn *best, size_t *n, const turn *t)
{
    if (*n == BEST && best[BEST - 1].energy <= t->energy)
        return;
    size_t k = *n < BEST ? (*n)++ : BEST - 1;
    for (; k > 0 && best[k - 1].energy > t->energy; --k)
        best[k] = best[k - 1];
    best[k] = *t;
}

static icc_status search_grid(const search *s, turn *best, size_t *n_best, const iccp_env *env)
{
    enum { CELLS = STEPS * STEPS * STEPS };
    icc_status status = ICC_OK;
    for (int cell = 0; cell < 4 * CELLS && status == ICC_OK; ++cell) {
        turn t;
        for (int k = 1, rest = cell % CELLS; k < 4; ++k, rest /= STEPS)
            t.q[(cell / CELLS + k) % 4] = 2.0 * (rest % STEPS) / (STEPS - 1) - 1;
        t.q[cell / CELLS] = 1;
        t.energy = energy_of(s, t.q);
        offer(best, n_best, &t);
        status = iccp_progress(env, "match", 0.7 * cell / (4 * CELLS));
    }
    return status;
}

/* Turns a little about each axis, both ways. Halves the angle whenever nothing helps. */
static void improve(const search *s, turn *t)
{
    double size = first_turn;
    for (int round = 0; round < ROUNDS && size > last_turn; ++round) {
        bool has_moved = false;
        for (int k = 0; k < 6; ++k) {
            double r[4] = {1, 0, 0, 0};
            r[1 + k / 2] = k % 2 == 0 ? size : -size;
            turn next = {.q = {r[0] * t->q[0] - iccp_vec_dot(3, r + 1, t->q + 1), 0, 0, 0}};
            iccp_vec_cross(r + 1, t->q + 1, next.q + 1);
            for (int i = 1; i < 4; ++i)
                next.q[i] += r[0] * t->q[i] + r[i] * t->q[0];
            const double length = iccp_vec_norm(4, next.q);
            for (int i = 0; i < 4; ++i)
                next.q[i] /= length;
            next.energy = energy_of(s, next.q);
            if (next.energy < t->energy) {
                *t = next;
                has_moved = true;
            }
        }
        if (!has_moved)
            size *= 0.5;
    }
}

/* Turns all directions, unless the drawing is then not one-to-one. */
static void apply(double *first, double *turned, const iccp_half_edges *m, const double q[4])
{
    memset(turned, 0, 3 * m->n_vertices * sizeof *turned);
    for (size_t v = 0; v < m->n_vertices; ++v)
        if (m->degree[v] > 0) {
            double p[3];
            rotate(p, q, first + 3 * v);
            iccp_direction(turned + 3 * v, p);
        }
    const iccp_sphere_certificate c = iccp_sphere_certify(m, turned);
    if (c.n_faces == 0 && c.n_stars == 0)
        memcpy(first, turned, 3 * m->n_vertices * sizeof *turned);
}

static icc_status find(search *s, double *first, double *turned, const iccp_half_edges *m,
                       const iccp_env *env)
{
    turn best[BEST] = {{0, {1, 0, 0, 0}}};
    size_t n_best = 0;
    icc_status status = search_grid(s, best, &n_best, env);
    for (size_t k = 0; k < n_best && status == ICC_OK; ++k) {
        improve(s, &best[k]);
        status = iccp_progress(env, "match", 0.7 + 0.3 * (double)k / BEST);
    }
    size_t least = 0;
    for (size_t k = 1; k < n_best; ++k)
        if (best[k].energy < best[least].energy)
            least = k;
    if (status == ICC_OK)
        apply(first, turned, m, best[least].q);
    return status;
}

icc_status iccp_rotation_find(double *first, const double *second,
                              const iccp_half_edges *const m[2], const double *const x[2],
                              size_t n_pairs, const uint32_t *const pairs[2], const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    search s = {.first = first,
                .second = second,
                .x = {x[0], x[1]},
                .n_pairs = n_pairs,
                .pairs = {pairs[0], pairs[1]},
                .m = m[1]};
    double *const turned = iccp_alloc(memory, m[0]->n_vertices, 3 * sizeof *turned);
    s.image = iccp_alloc(memory, m[0]->n_vertices, sizeof *s.image);
    for (int side = 0; side < 2; ++side)
        s.scale[side] = 1 / sqrt(total_area(m[side], x[side]));
    icc_status status =
        iccp_half_edges_create(&s.coarse, m[0]->n_vertices, m[0]->n_faces, m[0]->origin, env, NULL);
    if (turned == NULL || s.image == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK && m[0]->n_left > SAMPLES)
        status = iccp_decimate(&s.coarse, x[0], SAMPLES, env);
    if (status == ICC_OK)
        status = iccp_drawn_finder_create(&s.finder, m[1], second, memory);
    if (status == ICC_OK)
        status = find(&s, first, turned, m[0], env);
    iccp_drawn_finder_free(&s.finder, memory);
    iccp_half_edges_free(&s.coarse);
    iccp_free(memory, turned);
    iccp_free(memory, s.image);
    return status;
}
