/* Measures what a change of common triangles does. It may change their shape, the stretch from one
 * surface to the other (match/surface/stretch.h), the distance from the given surfaces
 * (match/common_mesh/covering.h) and intersections (match/common_mesh/clearance.h). */
#include "match/common_mesh/shape_patch.h"

#include "base/minmax.h"
#include "match/surface/corner_angle.h"
#include "match/surface/stretch.h"

#include <string.h>

/* A change may raise the mean energy by the factor `calm`. If the least angle has a sine below
 * `thin`, the factor grows in inverse proportion, up to `most_calm`. Without that, the fox t08
 * keeps 10 % more vertices. A surface that keeps its vertices has so many thin triangles that this
 * would cost too much, without a gain. */
static const double calm = 1.01, thin = 0.13, most_calm = 4, most_calm_if_kept = 1.2;

/* At thin triangles, sides may become longer, too: their squared length may exceed the longest one
 * before by this factor. Otherwise a thin triangle at a long side could not be removed. */
static const double longer2 = 1.5;

/* Added to sine^2 before 1 / sine^2 is taken. */
static const double least_sine2 = 1e-12;

bool iccp_patch_may_unite(const iccp_patch_state *s, int side_of_u, uint32_t u, uint32_t v)
{
    const uint32_t one = s->at[0][u], other = s->at[0][v];
    if (side_of_u >= 0 && (s->keep[v] >> side_of_u & 1) != 0)
        return false;
    return s->cells == NULL || (side_of_u == 0 ? iccp_kept_cells_may_go(s->cells, other, one)
                                               : iccp_kept_cells_may_go(s->cells, one, other));
}

bool iccp_patch_may_move(const iccp_patch_state *s, uint32_t v, uint32_t sides, uint32_t place)
{
    const uint32_t from = s->at[0][v];
    return s->cells == NULL || (sides & 1) == 0 ||
           (iccp_kept_cells_may_go(s->cells, from, place) &&
            iccp_kept_cells_may_go(s->cells, place, from));
}

bool iccp_patch_may_flip(const iccp_patch_state *s, const uint32_t corners[4])
{
    uint32_t places[4];
    for (int i = 0; i < 4; ++i)
        places[i] = s->at[0][corners[i]];
    return s->cells == NULL || iccp_kept_cells_share(s->cells, places);
}

void iccp_patch_add_ring(const iccp_patch_state *s, iccp_patch *p, uint32_t v, uint32_t but,
                         uint32_t as)
{
    const iccp_half_edges *const m = &s->m;
    uint32_t h = m->out[v];
    for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h)) {
        uint32_t corner[3] = {v, iccp_edge_end(m, h), m->origin[iccp_before(h)]};
        if (corner[1] == but || corner[2] == but)
            continue;
        iccp_patch_triangles *t = &p->before;
        for (int i = 0; i < 2; ++i) {
            t->number[t->n] = h / 3;
            memcpy(t->corner[t->n++], corner, sizeof corner);
            if (corner[1] == as || corner[2] == as)
                break;
            corner[0] = as;
            t = &p->after;
        }
    }
}

/* The corners on one side of triangle k, with vertices at their present or at their future
 * places. */
static iccp_corners corners_of(const iccp_patch_state *s, const iccp_patch *p,
                               const iccp_patch_triangles *t, int side, uint32_t k)
{
    iccp_corners c;
    for (int i = 0; i < 3; ++i) {
        const uint32_t v = t->corner[k][i];
        c.at[i] = t == &p->after && v == p->vertex ? iccp_patch_point(s, side, p->place[side])
                                                   : s->x[side] + 3 * (size_t)v;
    }
    return c;
}

static bool look(const iccp_patch_state *s, const iccp_patch *p, const iccp_patch_triangles *t,
                 double least, double most, iccp_patch_shape *shape)
{
    *shape = (iccp_patch_shape){.least = HUGE_VAL};
    for (int side = 0; side < 2; ++side)
        for (uint32_t k = 0; k < t->n; ++k) {
            const iccp_corners c = corners_of(s, p, t, side, k);
            const double sine = iccp_least_sine(c.at[0], c.at[1], c.at[2]);
            shape->least = iccp_min(shape->least, sine);
            shape->sum += 1 / (sine * sine + least_sine2);
            if (shape->least < least || shape->sum > most)
                return false;
            for (int i = 0; i < 3; ++i)
                shape->longest2[side] = iccp_max(shape->longest2[side],
                                                 iccp_vec_distance2(3, c.at[i], c.at[(i + 1) % 3]));
        }
    return true;
}

iccp_patch_shape iccp_patch_before(const iccp_patch_state *s, const iccp_patch *p)
{
    iccp_patch_shape shape;
    (void)look(s, p, &p->before, 0, HUGE_VAL, &shape);
    return shape;
}

bool iccp_patch_after(const iccp_patch_state *s, const iccp_patch *p,
                      const iccp_patch_shape *before, double least, double most,
                      iccp_patch_shape *after)
{
    const double grown2 = s->caution < ICCP_PATCH_SHORT && before->least < thin ? longer2 : 1;
    bool is_good = look(s, p, &p->after, least, most, after);
    for (int side = 0; side < 2; ++side)
        is_good = is_good && after->longest2[side] <=
                                 iccp_max(s->edge2[side], grown2 * before->longest2[side]);
    return is_good;
}

void iccp_patch_add_energy(double sum[2], const iccp_corners *c, const iccp_corners *d,
                           double scale)
{
    const iccp_stretch t = iccp_stretch_of(c->at, d->at, scale);
    const double weight = t.twice[0] + t.twice[1];
    sum[0] += weight * t.energy;
    sum[1] += weight;
}

static double energy_of(const iccp_patch_state *s, const iccp_patch *p,
                        const iccp_patch_triangles *t)
{
    double sum[2] = {0, 0};
    for (uint32_t k = 0; k < t->n; ++k) {
        const iccp_corners c = corners_of(s, p, t, 0, k), d = corners_of(s, p, t, 1, k);
        iccp_patch_add_energy(sum, &c, &d, s->scale);
    }
    return sum[0] / sum[1];
}

/* Puts the vertex that moves, if any, at a place. */
static void put(iccp_patch_state *s, const iccp_patch *p, int side, uint32_t place)
{
    if (p->vertex != ICCP_NO_EDGE)
        memcpy(s->x[side] + 3 * (size_t)p->vertex, iccp_patch_point(s, side, place),
               3 * sizeof(double));
}

bool iccp_patch_allowed(iccp_patch_state *s, const iccp_patch *p, double least_before)
{
    const iccp_patch_triangles *const t = &p->after;
    const double most = s->cells != NULL ? most_calm_if_kept : most_calm;
    const double more =
        s->caution == ICCP_PATCH_CALM ? 1 : iccp_max(calm, iccp_min(most, thin / least_before));
    bool is_allowed = energy_of(s, p, t) <= more * energy_of(s, p, &p->before);
    for (int side = 0; side < 2 && is_allowed; ++side) {
        iccp_corners c[ICCP_PATCH_TRIANGLES];
        for (uint32_t k = 0; k < t->n; ++k)
            c[k] = corners_of(s, p, t, side, k);
        is_allowed =
            iccp_covering_allows(&s->covering[side], p->before.n, p->before.number, t->n, c);
    }
    for (int side = 0; side < 2 && is_allowed; ++side) {
        put(s, p, side, p->place[side]);
        is_allowed = iccp_clearance_allows(&s->clearance[side], p->before.n, p->before.number, t->n,
                                           t->corner);
        if (p->vertex != ICCP_NO_EDGE)
            put(s, p, side, s->at[side][p->vertex]);
    }
    return is_allowed;
}

void iccp_patch_apply(iccp_patch_state *s, const iccp_patch *p)
{
    const iccp_patch_triangles *const t = &p->after;
    for (int side = 0; side < 2; ++side) {
        iccp_corners c[ICCP_PATCH_TRIANGLES];
        for (uint32_t k = 0; k < t->n; ++k)
            c[k] = corners_of(s, p, t, side, k);
        iccp_covering_replace(&s->covering[side], p->before.n, p->before.number, t->n, c,
                              t->number);
        put(s, p, side, p->place[side]);
        if (p->vertex != ICCP_NO_EDGE)
            s->at[side][p->vertex] = p->place[side];
        iccp_clearance_replace(&s->clearance[side], t->n, t->number, t->corner);
    }
}
