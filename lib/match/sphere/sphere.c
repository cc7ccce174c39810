/* Draws closed surfaces on the sphere. Based on: E. Praun, H. Hoppe, Spherical Parametrization and
 * Remeshing, 2003. The surface is made coarse until a tetrahedron is left. Then its vertices are
 * put back one by one, each where it sees all sides of the ring of its neighbours. There always is
 * such a place close to the vertex that it was collapsed to. A vertex only moves within the cone of
 * these places. So all faces stay positive, and each vertex's neighbours turn once around it. */
#include "match/sphere/sphere.h"

#include "base/error.h"
#include "base/minmax.h"
#include "match/sphere/decimate.h"
#include "match/sphere/drawn_star.h"
#include "match/sphere/sphere_certificate.h"
#include "match/surface/direction.h"
#include "match/surface/kernel_room.h"
#include "match/surface/newton_step.h"

#include <math.h>
#include <string.h>

/* All vertices are moved in sweeps whenever their number has grown by this factor. There are more
 * sweeps while vertices are few, which costs little and decides where limbs come to lie. */
static const double level = 1.5;
enum { FEW = 2000, SWEEPS_OF_FEW = 24, SWEEPS = 6 };

/* Most steps of a vertex in one turn, and most trial lengths of a step. */
enum { STEPS = 8, STEPS_WHEN_NEW = 4, HALVINGS = 6 };

/* A vertex takes another step if the last one left less than this share of its energy. */
static const double worthwhile = 0.9;

/* The last sweeps end when one lowers the energy by less than this share. */
static const double little = 1e-3;

typedef struct drawing {
    iccp_half_edges *m;
    const double *x;
    double *directions;
    const uint8_t *is_fixed; /* by vertex; or NULL */
    bool is_quiet;           /* only new vertices move */
    double scale;            /* the surface's area times the square of this is that of the sphere */
    iccp_drawn_star star;
    double (*room)[3];
} drawing;

static double *direction_of(const drawing *d, uint32_t vertex)
{
    return d->directions + 3 * (size_t)vertex;
}

static void gather(drawing *d, uint32_t vertex)
{
    iccp_drawn_star_gather(&d->star, d->m, vertex, d->x, d->scale, d->directions);
}

/* ---- moving ---- */

/* Moves a vertex, whose star has been gathered, by a step of Newton's method. The step is shortened
 * until the star holds the new place and the energy falls. Returns the new energy and adds its fall
 * to *gain. */
static double move(drawing *d, uint32_t vertex, double *gain)
{
    double *const p = direction_of(d, vertex);
    iccp_drawn_star_jet jet;
    double step[2], farthest = 0;
    for (size_t i = 0; i < d->star.n; ++i)
        farthest = iccp_max(farthest, iccp_vec_distance(3, p, d->star.ring[i]));
    iccp_drawn_star_expand(&jet, &d->star, p);
    iccp_newton_step(step, jet.gradient, jet.hessian, farthest);
    for (int n = 0; n < HALVINGS; ++n) {
        double q[3];
        for (int k = 0; k < 3; ++k)
            q[k] = p[k] + step[0] * jet.axis[0][k] + step[1] * jet.axis[1][k];
        iccp_direction(q, q);
        if (iccp_drawn_star_holds(&d->star, q)) {
            const double energy = iccp_drawn_star_energy(&d->star, q);
            if (energy < jet.value) {
                memcpy(p, q, sizeof q);
                *gain += jet.value - energy;
                return energy;
            }
        }
        step[0] *= 0.5;
        step[1] *= 0.5;
    }
    return jet.value;
}

/* Looks for a better place for a vertex whose star has been gathered. It tries the middle of the
 * vertex's room, as seen from an axis, and half the way from there to each corner. `least` is the
 * present energy. */
static double jump(drawing *d, uint32_t vertex, const double axis[3], double least)
{
    const size_t n = iccp_kernel_room(d->room, axis, d->star.n, d->star.ring);
    double middle[3];
    iccp_kernel_room_middle(middle, d->room, n);
    for (size_t i = 0; i <= n && n >= 3; ++i) {
        double p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = i < n ? 0.5 * (middle[k] + d->room[i][k]) : middle[k];
        iccp_direction(p, p);
        if (iccp_drawn_star_holds(&d->star, p)) {
            const double energy = iccp_drawn_star_energy(&d->star, p);
            if (energy < least) {
                least = energy;
                memcpy(direction_of(d, vertex), p, sizeof p);
            }
        }
    }
    return least;
}

/* Moves a vertex by several steps, as long as they help much. */
static double improve(drawing *d, uint32_t vertex, int n_steps, double *gain)
{
    double energy = HUGE_VAL;
    gather(d, vertex);
    for (int n = 0; n < n_steps; ++n) {
        const double before = energy;
        energy = move(d, vertex, gain);
        if (n > 0 && energy > worthwhile * before)
            break;
    }
    if (energy > iccp_severely_bad * d->star.weight && d->star.n <= ICCP_JUMP_NEIGHBOURS) {
        const double now = jump(d, vertex, direction_of(d, vertex), energy);
        if (now < energy) {
            *gain += energy - now;
            energy = move(d, vertex, gain);
        }
    }
    return energy;
}

static bool is_fixed(const drawing *d, uint32_t vertex)
{
    return d->is_fixed != NULL && d->is_fixed[vertex] != 0;
}

/* Does one sweep. *energy is the sum of the energies, and *gain their fall. */
static void move_all(drawing *d, double *energy, double *gain)
{
    *energy = *gain = 0;
    for (uint32_t v = 0; v < d->m->n_vertices; ++v)
        if (d->m->degree[v] > 0 && !is_fixed(d, v))
            *energy += improve(d, v, STEPS, gain);
}

/* ---- growing ---- */

/* Puts the last four vertices at the corners of a regular tetrahedron. */
static void begin(drawing *d)
{
    static const double corner[4][3] = {{1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, -1}};
    const iccp_half_edges *const m = d->m;
    uint32_t v = 0;
    while (m->degree[v] == 0)
        ++v;
    iccp_direction(direction_of(d, v), corner[0]);
    uint32_t h = m->out[v];
    for (int k = 1; k < 4; ++k, h = iccp_edge_turn(m, h))
        iccp_direction(direction_of(d, iccp_edge_end(m, h)), corner[k]);
}

/* Puts back the vertex that was removed last. Neighbours with very many neighbours wait for the
 * next sweep, so the work stays in proportion. */
static bool grow(drawing *d)
{
    const uint32_t u = iccp_edge_restore(d->m);
    double gain = 0;
    gather(d, u);
    if (jump(d, u, d->star.ring[0], HUGE_VAL) == HUGE_VAL)
        return false;
    improve(d, u, STEPS_WHEN_NEW, &gain);
    uint32_t h = d->m->out[u];
    do {
        const uint32_t v = iccp_edge_end(d->m, h);
        if (d->m->degree[v] <= ICCP_JUMP_NEIGHBOURS && !is_fixed(d, v) && !d->is_quiet)
            improve(d, v, STEPS_WHEN_NEW, &gain);
        h = iccp_edge_turn(d->m, h);
    } while (h != d->m->out[u]);
    improve(d, u, STEPS_WHEN_NEW, &gain);
    return true;
}

/* Puts vertices back until `until` are present. */
static icc_status grow_all(drawing *d, size_t until, const iccp_env *env, icc_error *err)
{
    size_t next = d->m->n_left + 1;
    double energy, gain;
    icc_status status = ICC_OK;
    while (d->m->n_left < until && status == ICC_OK) {
        if (!grow(d))
            return iccp_fail(err, ICC_ERR_RESOLUTION,
                             "directions on the sphere, multiples of 2^-51, are too coarse to draw "
                             "the surface: there is no room for vertex %lu",
                             (unsigned long)d->m->origin[d->m->collapsed[d->m->n_collapsed]]);
        if (d->m->n_left >= next && !d->is_quiet) {
            const int n_sweeps = d->m->n_left < FEW ? SWEEPS_OF_FEW : SWEEPS;
            for (int k = 0; k < n_sweeps; ++k)
                move_all(d, &energy, &gain);
            next = (size_t)(level * (double)d->m->n_left) + 1;
        }
        if (d->m->n_left % 256 == 0)
            status = iccp_progress(env, "match", 0.7 * (double)d->m->n_left / (double)until);
    }
    const iccp_env last = iccp_part(env, NULL, 0.7, 1);
    for (size_t k = 0; status == ICC_OK && !d->is_quiet; ++k) {
        const iccp_env part = iccp_round(&last, k, 4);
        move_all(d, &energy, &gain);
        if (!(gain > little * energy))
            break;
        status = iccp_progress(&part, "match", 1);
    }
    return iccp_explain(err, status);
}

/* ---- from beginning to end ---- */

double iccp_sphere_scale(const iccp_half_edges *m, const double *x)
{
    double twice = 0;
    for (size_t f = 0; f < m->n_faces; ++f) {
        const uint32_t *const v = m->origin + 3 * f;
        const double *const a = x + 3 * (size_t)v[0], *const b = x + 3 * (size_t)v[1];
        const double *const c = x + 3 * (size_t)v[2];
        double g[3], h[3], normal[3];
        for (int k = 0; k < 3; ++k) {
            g[k] = b[k] - a[k];
            h[k] = c[k] - a[k];
        }
        iccp_vec_cross(g, h, normal);
        twice += iccp_vec_norm(3, normal);
    }
    return sqrt(8 * 3.14159265358979323846 / twice);
}

icc_status iccp_sphere_check(const iccp_half_edges *m, const double *directions, icc_error *err)
{
    const iccp_sphere_certificate c = iccp_sphere_certify(m, directions);
    if (c.n_faces > 0 || c.n_stars > 0)
        return iccp_fail(err, ICC_ERR_CERTIFICATE,
                         "the drawing on the sphere is not one-to-one: %zu faces are not positive, "
                         "around %zu vertices the faces do not turn exactly once",
                         c.n_faces, c.n_stars);
    return ICC_OK;
}

icc_status iccp_sphere_grow(double *directions, iccp_half_edges *m, const double *x, double scale,
                            const uint8_t *is_fixed, bool is_quiet, size_t until,
                            const iccp_env *env, icc_error *err)
{
    drawing d = {.m = m,
                 .x = x,
                 .directions = directions,
                 .is_fixed = is_fixed,
                 .is_quiet = is_quiet,
                 .scale = scale};
    icc_status status = ICC_OK;
    if (m->n_left == 4 && is_fixed == NULL)
        begin(&d);
    d.room = iccp_alloc(&m->memory, 2 * (ICCP_ROOM_CORNERS + m->most_neighbours), sizeof *d.room);
    if (!iccp_drawn_star_create(&d.star, m->most_neighbours, &m->memory) || d.room == NULL)
        status = iccp_fail_memory(err);
    else
        status = grow_all(&d, until, env, err);
    iccp_drawn_star_free(&d.star, &m->memory);
    iccp_free(&m->memory, d.room);
    return status != ICC_OK || m->n_collapsed > 0 ? status : iccp_sphere_check(m, directions, err);
}

icc_status iccp_sphere_draw(double *directions, size_t n_vertices, const double *x, size_t n_faces,
                            const uint32_t *faces, const iccp_env *env, icc_error *err)
{
    const iccp_env first = iccp_part(env, NULL, 0, 0.25), rest = iccp_part(env, NULL, 0.25, 1);
    iccp_half_edges m;
    icc_status status = iccp_half_edges_create(&m, n_vertices, n_faces, faces, env, err);
    memset(directions, 0, 3 * n_vertices * sizeof *directions);
    if (status == ICC_OK) {
        const double scale = iccp_sphere_scale(&m, x);
        const size_t n = m.n_left;
        status = iccp_explain(err, iccp_decimate(&m, x, 4, &first));
        if (status == ICC_OK)
            status = iccp_sphere_grow(directions, &m, x, scale, NULL, false, n, &rest, err);
    }
    iccp_half_edges_free(&m);
    return status;
}
