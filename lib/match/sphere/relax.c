/* Moves two drawings on the sphere so that the map between the surfaces stretches less. It uses
 * Newton's method in the plane for one vertex at a time, on both sides in turn. J. Schreiner, A.
 * Asirvatham, E. Praun, H. Hoppe, Inter-Surface Mapping, 2004, move vertices by line searches in
 * the same way. Derivatives are computed by differences, because the common pieces of triangles
 * change as a vertex moves. */
#include "match/sphere/relax.h"

#include "base/minmax.h"
#include "match/sphere/drawn_finder.h"
#include "match/surface/direction.h"
#include "match/surface/kernel_room.h"
#include "match/surface/newton_step.h"

#include <string.h>

/* Trial lengths of a step; each is `shorter` times the one before. */
enum { TRIALS = 5 };
static const double shorter = 0.4;

/* A vertex may jump if its triangles have a mean energy above this, unless that is severe. */
static const double bad = 20;

/* Rounds end when one lowers the energy by less than this share. */
static const double little = 0.003;

/* Step of differences, as a share of the distance to the nearest edge of the ring. */
static const double aside = 0.05;

icc_status iccp_relaxation_create(iccp_relaxation *r, const iccp_drawn_surface side[2],
                                  const uint8_t *const is_fixed[2], const iccp_memory *memory)
{
    size_t most = 0;
    *r = (iccp_relaxation){.side = {side[0], side[1]}, .is_fixed = {is_fixed[0], is_fixed[1]}};
    bool has_memory = true;
    for (int s = 0; s < 2; ++s) {
        const iccp_half_edges *const m = side[s].m, *const o = side[1 - s].m;
        most = m->most_neighbours > most ? m->most_neighbours : most;
        has_memory &=
            iccp_composed_star_create(&r->star[s], m->most_neighbours, o->n_faces, memory);
        r->hint[s] = iccp_alloc(memory, m->n_vertices, sizeof *r->hint[s]);
        for (size_t v = 0; v < m->n_vertices && r->hint[s] != NULL; ++v)
            r->hint[s][v] = ICCP_NO_EDGE;
        has_memory &= r->hint[s] != NULL;
        uint32_t v = 0;
        while (o->degree[v] == 0)
            ++v;
        r->last[s] = o->out[v] / 3;
    }
    r->room = iccp_alloc(memory, 2 * (ICCP_ROOM_CORNERS + most), sizeof *r->room);
    return has_memory && r->room != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_relaxation_free(iccp_relaxation *r, const iccp_memory *memory)
{
    for (int s = 0; s < 2; ++s) {
        iccp_composed_star_free(&r->star[s]);
        iccp_free(memory, r->hint[s]);
    }
    iccp_free(memory, r->room);
}

static bool holds(const iccp_composed_star *star, const double p[3])
{
    for (size_t i = 0; i < star->n; ++i)
        if (iccp_direction_sign(p, star->ring[i], star->ring[i + 1]) <= 0)
            return false;
    return true;
}

static double energy_at(iccp_composed_star *star, double x, double y)
{
    return iccp_composed_star_energy(star, (const double[]){x, y, 1}, HUGE_VAL);
}

/* Computes the derivatives by differences. */
static double expand(double gradient[2], double hessian[3], iccp_composed_star *star)
{
    const double h = aside * star->radius;
    const double here = energy_at(star, 0, 0);
    const double ahead[2] = {energy_at(star, h, 0), energy_at(star, 0, h)};
    const double behind[2] = {energy_at(star, -h, 0), energy_at(star, 0, -h)};
    const double across = energy_at(star, h, h);
    for (int k = 0; k < 2; ++k) {
        gradient[k] = (ahead[k] - behind[k]) / (2 * h);
        hessian[2 * k] = (ahead[k] - 2 * here + behind[k]) / (h * h);
    }
    hessian[1] = (across - ahead[0] - ahead[1] + here) / (h * h);
    return here;
}

/* The energy with the vertex at direction q; or HUGE_VAL if it is `most` or more, or if the star
 * does not hold q. */
static double energy_towards(iccp_composed_star *star, double q[3], double most)
{
    double seen[3];
    iccp_direction(q, q);
    if (!holds(star, q))
        return HUGE_VAL;
    iccp_composed_star_see(seen, star, q);
    return iccp_composed_star_energy(star, seen, most);
}

/* Looks for a better place in the whole room that the ring leaves a vertex: at its middle, and on
 * the way from there to each corner. The bodies t02 to t04 and the fox t08 need this. */
static double jump(iccp_relaxation *r, iccp_composed_star *star, double p[3], double least)
{
    const size_t n = iccp_kernel_room(r->room, star->p, star->n, star->ring);
    double middle[3];
    iccp_kernel_room_middle(middle, r->room, n);
    for (size_t i = 0; i <= 2 * n && n >= 3; ++i) {
        double q[3];
        const double share = i < n ? 0.5 : 0.85;
        for (int k = 0; k < 3; ++k)
            q[k] = i < 2 * n ? middle[k] + share * (r->room[i % n][k] - middle[k]) : middle[k];
        const double now = energy_towards(star, q, least);
        if (now < least) {
            least = now;
            memcpy(p, q, sizeof q);
        }
    }
    return least;
}

/* Moves one vertex. Adds its star's energy to *energy and its fall to *gain. A vertex stays if its
 * star is too large to be seen from it. */
static icc_status move(iccp_relaxation *r, double longer, int s, uint32_t v, double *energy,
                       double *gain)
{
    const iccp_drawn_surface *const one = &r->side[s], *const other = &r->side[1 - s];
    iccp_composed_star *const star = &r->star[s];
    double *const p = one->directions + 3 * (size_t)v;
    uint32_t *const hint = &r->hint[s][v];
    double gradient[2], hessian[3], step[2];
    *hint = r->last[s] =
        iccp_drawn_walk(other->m, other->directions, *hint == ICCP_NO_EDGE ? r->last[s] : *hint, p);
    const icc_status status = iccp_composed_star_gather(star, one, v, other, *hint);
    if (status != ICC_OK)
        return status == ICC_ERR_RESOLUTION ? ICC_OK : status;
    const double here = expand(gradient, hessian, star);
    /* Later energies leave no weight where they exceed the least one. */
    const double worst = (star->is_severe ? iccp_severely_bad : bad) * star->weight;
    *energy += here;
    iccp_newton_step(step, gradient, hessian, star->farthest);
    step[0] *= longer;
    step[1] *= longer;
    double least = here;
    for (int n = 0; n < TRIALS; ++n) {
        double q[3];
        for (int k = 0; k < 3; ++k)
            q[k] = star->p[k] + step[0] * star->axis[0][k] + step[1] * star->axis[1][k];
        const double now = energy_towards(star, q, least);
        if (now < least) {
            memcpy(p, q, sizeof q);
            least = now;
            break;
        }
        step[0] *= shorter;
        step[1] *= shorter;
    }
    if (least > worst && star->n <= ICCP_JUMP_NEIGHBOURS)
        least = jump(r, star, p, least);
    *gain += here - least;
    return ICC_OK;
}

icc_status iccp_relax(iccp_relaxation *r, double longer, bool is_severe, double *left,
                      const iccp_env *env)
{
    icc_status status = ICC_OK;
    *left = HUGE_VAL;
    for (int s = 0; s < 2; ++s)
        r->star[s].is_severe = is_severe;
    for (size_t round = 0; status == ICC_OK; ++round) {
        const iccp_env part = iccp_round(env, round, 4);
        double energy = 0, gain = 0;
        for (int s = 0; s < 2; ++s) {
            const iccp_half_edges *const m = r->side[s].m;
            for (uint32_t v = 0; v < m->n_vertices && status == ICC_OK; ++v) {
                if (m->degree[v] > 0 && !(r->is_fixed[s] != NULL && r->is_fixed[s][v] != 0))
                    status = move(r, longer, s, v, &energy, &gain);
                if (v % 256 == 0 && status == ICC_OK)
                    status = iccp_progress(&part, "match", 0);
            }
        }
        *left = energy - gain;
        if (!(gain > little * energy))
            break;
    }
    return status;
}
