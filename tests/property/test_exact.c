/* The map of a foliation is one-to-one, without a "nearly": computed in rational numbers every
 * point comes back as itself, bit by bit. The library's own meshes and labels are taken as they
 * are; the share of the way is measured in |dx| + |dy|, which needs no square root; every decision
 * is that of foliation/leaf2.c. With arc length in place of it, the library's doubles are compared
 * as well. */
#include "foliation/harmonic.h"
#include "foliation/psi.h"
#include "geometry/locate.h"
#include "icc/icc.h"

#include "../hard_shapes.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <gmp.h>
#include <stdlib.h>

/* ---- numbers ---- */

typedef struct vec {
    mpq_t x[2];
} vec;

static void vec_init(vec *p)
{
    mpq_init(p->x[0]);
    mpq_init(p->x[1]);
}

static void vec_clear(vec *p)
{
    mpq_clear(p->x[0]);
    mpq_clear(p->x[1]);
}

static void vec_set(vec *p, const vec *q)
{
    mpq_set(p->x[0], q->x[0]);
    mpq_set(p->x[1], q->x[1]);
}

static void vec_set_doubles(vec *p, const double q[2])
{
    mpq_set_d(p->x[0], q[0]);
    mpq_set_d(p->x[1], q[1]);
}

/* p = a + share (b - a) */
static void vec_between(vec *p, const vec *a, const vec *b, const mpq_t share)
{
    for (int k = 0; k < 2; ++k) {
        mpq_t step;
        mpq_init(step);
        mpq_sub(step, b->x[k], a->x[k]);
        mpq_mul(step, step, share);
        mpq_add(p->x[k], a->x[k], step);
        mpq_clear(step);
    }
}

/* sum += |p - q| in the sum norm; *arc grows by the Euclidean distance, in doubles. */
static void add_length(mpq_t sum, double *arc, const vec *p, const vec *q)
{
    double d[2];
    for (int k = 0; k < 2; ++k) {
        mpq_t step;
        mpq_init(step);
        mpq_sub(step, p->x[k], q->x[k]);
        d[k] = mpq_get_d(step);
        mpq_abs(step, step);
        mpq_add(sum, sum, step);
        mpq_clear(step);
    }
    *arc += hypot(d[0], d[1]);
}

/* As two doubles, since GMP's integers may have 32 bits only. */
static void set_units(mpq_t q, int64_t units)
{
    const int64_t rest = units % ((int64_t)1 << 32);
    mpq_t low;
    mpq_init(low);
    mpq_set_d(low, (double)rest);
    mpq_set_d(q, (double)(units - rest));
    mpq_add(q, q, low);
    mpq_clear(low);
}

/* ---- the foliation ---- */

typedef struct foliation {
    icc_domain *domain;
    iccp_harmonic base;
    iccp_psi psi;
    uint32_t *rim; /* the corner that faces boundary edge k */
    vec *points;   /* of the mesh */
} foliation;

static void foliation_init(foliation *f, icc_domain *domain, const uint32_t *pieces, int32_t cells,
                           const double *maximum)
{
    iccp_env env;
    double local[2];
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    f->domain = domain;
    ck_assert_int_eq(iccp_harmonic_create(&f->base, domain, pieces, cells, &env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_harmonic_factorise(&f->base, &env, NULL), ICC_OK);
    const iccp_planar *mesh = &f->base.mesh;
    iccp_frame_in(&domain->frame, 2, maximum, local);
    const uint32_t centre = iccp_nearest_vertex(mesh, mesh->points, local);
    ck_assert_int_eq(
        iccp_psi_create(&f->psi, mesh, &f->base.laplacian, &f->base.solver, centre, 0.5, &env),
        ICC_OK);
    f->rim = malloc(mesh->n_boundary * sizeof *f->rim);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c)
        if (mesh->twins[c] == ICCP_NO_NEIGHBOUR)
            f->rim[mesh->triangles[iccp_after(c)]] = c;
    f->points = malloc(mesh->n_vertices * sizeof *f->points);
    for (size_t v = 0; v < mesh->n_vertices; ++v) {
        vec_init(&f->points[v]);
        vec_set_doubles(&f->points[v], mesh->points + 2 * v);
    }
}

static void foliation_clear(foliation *f)
{
    for (size_t v = 0; v < f->base.mesh.n_vertices; ++v)
        vec_clear(&f->points[v]);
    free(f->points);
    free(f->rim);
    iccp_psi_free(&f->psi);
    iccp_harmonic_free(&f->base);
}

/* Where a leaf crosses the half-edge that a corner faces; see foliation/leaf2.h. */
typedef struct crossing {
    uint32_t corner;
    mpq_t below, above;
} crossing;

static void crossing_init(crossing *c)
{
    mpq_init(c->below);
    mpq_init(c->above);
}

static void crossing_clear(crossing *c)
{
    mpq_clear(c->below);
    mpq_clear(c->above);
}

static void crossing_point(const foliation *f, const crossing *c, vec *p)
{
    const uint32_t *v = f->base.mesh.triangles;
    mpq_t share;
    mpq_init(share);
    mpq_add(share, c->below, c->above);
    mpq_div(share, c->below, share);
    vec_between(p, &f->points[v[iccp_after(c->corner)]], &f->points[v[iccp_before(c->corner)]],
                share);
    mpq_clear(share);
}

static bool go_up(const foliation *f, crossing *c)
{
    const iccp_planar *mesh = &f->base.mesh;
    const uint32_t after = iccp_after(c->corner);
    if (mesh->triangles[c->corner] == f->psi.centre)
        return false;
    mpq_t opposite;
    mpq_init(opposite);
    set_units(opposite, f->psi.rise[after]);
    mpq_add(opposite, opposite, c->above);
    if (mpq_sgn(opposite) < 0) {
        c->corner = mesh->twins[after];
        mpq_neg(c->below, opposite);
    } else {
        c->corner = mesh->twins[iccp_before(c->corner)];
        mpq_set(c->above, opposite);
    }
    mpq_clear(opposite);
    return true;
}

static bool go_down(const foliation *f, crossing *c)
{
    const uint32_t twin = f->base.mesh.twins[c->corner];
    if (twin == ICCP_NO_NEIGHBOUR)
        return false;
    const uint32_t after = iccp_after(twin);
    mpq_t opposite;
    mpq_init(opposite);
    set_units(opposite, f->psi.rise[after]);
    mpq_sub(opposite, opposite, c->below);
    if (mpq_sgn(opposite) >= 0) {
        c->corner = after;
        mpq_set(c->above, opposite);
    } else {
        c->corner = iccp_before(twin);
        mpq_neg(c->below, opposite);
    }
    mpq_clear(opposite);
    return true;
}

/* The barycentric coordinates of p in a triangle; false when it is not in it. */
static bool find_bary(const foliation *f, const vec *p, uint32_t triangle, mpq_t bary[3])
{
    const uint32_t *v = f->base.mesh.triangles + 3 * (size_t)triangle;
    bool inside = true;
    mpq_t d[4], sum;
    mpq_init(sum);
    for (int k = 0; k < 4; ++k)
        mpq_init(d[k]);
    for (int k = 0; k < 3; ++k) {
        const vec *a = &f->points[v[(k + 1) % 3]], *b = &f->points[v[(k + 2) % 3]];
        mpq_sub(d[0], a->x[0], p->x[0]);
        mpq_sub(d[1], b->x[1], p->x[1]);
        mpq_sub(d[2], a->x[1], p->x[1]);
        mpq_sub(d[3], b->x[0], p->x[0]);
        mpq_mul(d[0], d[0], d[1]);
        mpq_mul(d[2], d[2], d[3]);
        mpq_sub(bary[k], d[0], d[2]);
        mpq_add(sum, sum, bary[k]);
        inside = inside && mpq_sgn(bary[k]) >= 0;
    }
    for (int k = 0; inside && k < 3; ++k)
        mpq_div(bary[k], bary[k], sum);
    for (int k = 0; k < 4; ++k)
        mpq_clear(d[k]);
    mpq_clear(sum);
    return inside;
}

/* A quick look in doubles, on the safe side. */
static bool is_near(const foliation *f, const double p[2], uint32_t triangle)
{
    const uint32_t *v = f->base.mesh.triangles + 3 * (size_t)triangle;
    for (int k = 0; k < 2; ++k) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int c = 0; c < 3; ++c) {
            low = fmin(low, f->base.mesh.points[2 * (size_t)v[c] + (size_t)k]);
            high = fmax(high, f->base.mesh.points[2 * (size_t)v[c] + (size_t)k]);
        }
        if (p[k] < low - 1e-12 || p[k] > high + 1e-12)
            return false;
    }
    return true;
}

/* The leaf through a point of a star triangle; false when it belongs to the next one. */
static bool leaf_in_star(const foliation *f, uint32_t corner, mpq_t bary[3], crossing *down)
{
    mpq_t sum, rise;
    mpq_init(sum);
    mpq_init(rise);
    const uint32_t a = iccp_after(corner) % 3, b = iccp_before(corner) % 3;
    mpq_add(sum, bary[a], bary[b]);
    const bool there = mpq_sgn(sum) > 0 && mpq_sgn(bary[b]) > 0;
    if (there) {
        set_units(rise, f->psi.rise[corner]);
        down->corner = corner;
        mpq_div(down->below, bary[b], sum);
        mpq_mul(down->below, down->below, rise);
        mpq_sub(down->above, rise, down->below);
    }
    mpq_clear(sum);
    mpq_clear(rise);
    return there;
}

/* The leaf through a point of another triangle; false when it passes below the triangle. */
static bool leaf_in_triangle(const foliation *f, uint32_t triangle, mpq_t bary[3], crossing *down,
                             crossing *up)
{
    const uint32_t first = 3 * triangle;
    const int64_t label[3] = {0, f->psi.rise[first + 2], -f->psi.rise[first + 1]};
    mpq_t own, height[3];
    int n_found = 0;
    mpq_init(own);
    for (int k = 0; k < 3; ++k) {
        mpq_init(height[k]);
        set_units(height[k], label[k]);
        mpq_mul(height[k], height[k], bary[k]);
        mpq_add(own, own, height[k]);
    }
    for (int k = 0; k < 3; ++k) {
        set_units(height[k], label[k]);
        mpq_sub(height[k], height[k], own);
    }
    for (uint32_t k = 0; k < 3; ++k) {
        const mpq_ptr a = height[(k + 1) % 3], b = height[(k + 2) % 3];
        if (mpq_sgn(a) < 0 && mpq_sgn(b) >= 0) {
            down->corner = first + k;
            mpq_neg(down->below, a);
            mpq_set(down->above, b);
            ++n_found;
        } else if (mpq_sgn(a) >= 0 && mpq_sgn(b) < 0) {
            up->corner = f->base.mesh.twins[first + k];
            mpq_neg(up->below, b);
            mpq_set(up->above, a);
            ++n_found;
        }
    }
    mpq_clear(own);
    for (int k = 0; k < 3; ++k)
        mpq_clear(height[k]);
    return n_found == 2;
}

/* The leaf through p; `in_star` tells whether it is straight from `down` on. */
static void find_leaf(const foliation *f, const vec *p, crossing *down, crossing *up, bool *in_star)
{
    const iccp_planar *mesh = &f->base.mesh;
    const double near[2] = {mpq_get_d(p->x[0]), mpq_get_d(p->x[1])};
    mpq_t bary[3];
    bool found = false;
    for (int k = 0; k < 3; ++k)
        mpq_init(bary[k]);
    for (uint32_t t = 0; !found && t < mesh->n_triangles; ++t) {
        if (!is_near(f, near, t) || !find_bary(f, p, t, bary))
            continue;
        *in_star = false;
        for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
            if (mesh->triangles[c] == f->psi.centre) {
                *in_star = true;
                found = leaf_in_star(f, c, bary, down);
            }
        if (!*in_star)
            found = leaf_in_triangle(f, t, bary, down, up);
    }
    for (int k = 0; k < 3; ++k)
        mpq_clear(bary[k]);
    ck_assert(found);
}

/* Boundary edge, how far along it, share of the way: exact, and with arc length. */
typedef struct coords {
    uint32_t edge;
    mpq_t lambda, t;
    double arc_t;
} coords;

/* Lengths from p by `next` to the end of the leaf. */
static void walk(const foliation *f, crossing *c, const vec *p,
                 bool (*next)(const foliation *, crossing *), bool to_centre, mpq_t length,
                 double *arc)
{
    vec from, to;
    vec_init(&from);
    vec_init(&to);
    vec_set(&from, p);
    do {
        crossing_point(f, c, &to);
        add_length(length, arc, &from, &to);
        vec_set(&from, &to);
    } while (next(f, c));
    if (to_centre)
        add_length(length, arc, &from, &f->points[f->psi.centre]);
    vec_clear(&from);
    vec_clear(&to);
}

static void encode(const foliation *f, const vec *p, coords *out)
{
    crossing down, up;
    bool in_star = false;
    mpq_t length[2];
    double arc[2] = {0, 0};
    for (int k = 0; k < 2; ++k)
        mpq_init(length[k]);
    crossing_init(&down);
    crossing_init(&up);
    find_leaf(f, p, &down, &up, &in_star);
    if (in_star)
        add_length(length[1], &arc[1], p, &f->points[f->psi.centre]);
    else
        walk(f, &up, p, go_up, true, length[1], &arc[1]);
    walk(f, &down, p, go_down, false, length[0], &arc[0]);
    out->edge = f->base.mesh.triangles[iccp_after(down.corner)];
    mpq_add(out->lambda, down.below, down.above);
    mpq_div(out->lambda, down.below, out->lambda);
    mpq_add(out->t, length[0], length[1]);
    mpq_div(out->t, length[0], out->t);
    out->arc_t = arc[0] / (arc[0] + arc[1]);
    crossing_clear(&down);
    crossing_clear(&up);
    for (int k = 0; k < 2; ++k)
        mpq_clear(length[k]);
}

static void start(const foliation *f, const coords *in, crossing *c)
{
    c->corner = f->rim[in->edge];
    set_units(c->above, f->psi.rise[c->corner]);
    mpq_mul(c->below, in->lambda, c->above);
    mpq_sub(c->above, c->above, c->below);
}

static void decode(const foliation *f, const coords *in, vec *p)
{
    crossing c;
    mpq_t wanted, before, length;
    double arc = 0;
    vec from, to;
    crossing_init(&c);
    mpq_init(wanted);
    mpq_init(before);
    mpq_init(length);
    vec_init(&from);
    vec_init(&to);
    start(f, in, &c);
    crossing_point(f, &c, &from);
    walk(f, &c, &from, go_up, true, wanted, &arc);
    mpq_mul(wanted, wanted, in->t);
    start(f, in, &c);
    for (bool more = true; more; vec_set(&from, &to)) {
        more = go_up(f, &c);
        if (more)
            crossing_point(f, &c, &to);
        else
            vec_set(&to, &f->points[f->psi.centre]);
        mpq_set(before, length);
        add_length(length, &arc, &from, &to);
        if (mpq_cmp(length, wanted) < 0)
            continue;
        mpq_sub(wanted, wanted, before);
        mpq_sub(length, length, before);
        if (mpq_sgn(length) > 0)
            mpq_div(wanted, wanted, length);
        vec_between(p, &from, &to, wanted);
        break;
    }
    crossing_clear(&c);
    mpq_clear(wanted);
    mpq_clear(before);
    mpq_clear(length);
    vec_clear(&from);
    vec_clear(&to);
}

/* ---- tests ---- */

static void check_point(const foliation f[2], const vec *p, const icc_chart *chart)
{
    coords there = {0}, back = {0};
    vec q, r;
    mpq_inits(there.lambda, there.t, back.lambda, back.t, NULL);
    vec_init(&q);
    vec_init(&r);
    encode(&f[0], p, &there);
    decode(&f[1], &there, &q);
    encode(&f[1], &q, &back);
    decode(&f[0], &back, &r);
    ck_assert_uint_eq(there.edge, back.edge);
    ck_assert(mpq_equal(there.lambda, back.lambda) && mpq_equal(there.t, back.t));
    ck_assert(mpq_equal(p->x[0], r.x[0]) && mpq_equal(p->x[1], r.x[1]));
    /* The library, in doubles and with arc length. */
    const double local[2] = {mpq_get_d(p->x[0]), mpq_get_d(p->x[1])};
    double point[2], bary[2], t;
    uint32_t facet;
    icc_status status;
    iccp_frame_out(&f[0].domain->frame, 2, local, point);
    ck_assert_int_eq(icc_chart_encode(chart, 1, point, &facet, bary, &t, &status, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(status, ICC_OK);
    ck_assert_double_le(fabs(t - there.arc_t), 1e-9);
    const double along =
        iccp_planar_along(&f[0].base.mesh, f[0].domain, there.edge, mpq_get_d(there.lambda));
    if (facet == f[0].base.mesh.facet[there.edge])
        ck_assert_double_le(fabs(bary[1] - along), 1e-9);
    else /* next to a corner */
        ck_assert(fmin(along, 1 - along) < 1e-9 && fmin(bary[0], bary[1]) < 1e-9);
    mpq_clears(there.lambda, there.t, back.lambda, back.t, NULL);
    vec_clear(&q);
    vec_clear(&r);
}

/* Vertices and middles of edges, where leaves change triangles; the centre's own have no leaf. */
static void check_mesh_points(const foliation f[2], const icc_chart *chart)
{
    const iccp_planar *mesh = &f[0].base.mesh;
    mpq_t half;
    vec p;
    mpq_init(half);
    mpq_set_d(half, 0.5);
    vec_init(&p);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; c += 1 + 3 * (uint32_t)mesh->n_triangles / 50) {
        const uint32_t a = mesh->triangles[iccp_after(c)];
        const uint32_t b = mesh->triangles[iccp_before(c)];
        if (mesh->twins[c] == ICCP_NO_NEIGHBOUR)
            continue;
        vec_between(&p, &f[0].points[a], &f[0].points[b], half);
        check_point(f, &p, chart);
        if (b != f[0].psi.centre && b >= mesh->n_boundary)
            check_point(f, &f[0].points[b], chart);
    }
    mpq_clear(half);
    vec_clear(&p);
}

static void check_pair(const shape *source, const shape *target, int32_t cells, int n)
{
    const shape *shapes[2] = {source, target};
    icc_domain *domain[2];
    icc_map *map;
    foliation f[2];
    uint32_t pieces[SHAPE_MAX];
    for (int k = 0; k < 2; ++k)
        ck_assert_int_eq(
            icc_domain_create(&domain[k], 2, shapes[k]->n, shapes[k]->xy, 0, NULL, NULL, NULL),
            ICC_OK);
    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_FOLIATION, .cells = cells};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    ck_assert_int_eq(icc_map_create(&map, domain[0], domain[1], &options, NULL, NULL), ICC_OK);
    iccp_planar_pieces(pieces, domain[0], domain[1], cells);
    for (int k = 0; k < 2; ++k) {
        const icc_chart *chart_k = k ? icc_map_target_chart(map) : icc_map_source_chart(map);
        icc_chart_info info = {.size = sizeof info};
        icc_foliation_info own = {.size = sizeof own};
        (void)icc_chart_get_info(chart_k, &info);
        (void)icc_chart_get_foliation_info(chart_k, &own);
        ck_assert(info.certified == 1 && own.harmonic_share >= 0.5 && info.cells == cells);
        foliation_init(&f[k], domain[k], pieces, cells, info.maximum);
    }
    random_source r = {12};
    vec p;
    vec_init(&p);
    for (int i = 0; i < n;) {
        double local[2];
        for (int k = 0; k < 2; ++k)
            local[k] = random_between(&r, domain[0]->lower[k], domain[0]->upper[k]);
        if (iccp_domain_locate(domain[0], local, true, NULL, NULL) != ICC_INSIDE)
            continue;
        vec_set_doubles(&p, local);
        check_point(f, &p, icc_map_source_chart(map));
        ++i;
    }
    check_mesh_points(f, icc_map_source_chart(map));
    vec_clear(&p);
    icc_map_free(map);
    for (int k = 0; k < 2; ++k) {
        foliation_clear(&f[k]);
        icc_domain_free(domain[k]);
    }
}

START_TEST(points_come_back_exactly)
{
    const shape square = shape_square(), dart = shape_dart(), l = shape_l();
    const shape square6 = shape_of(6, (double[]){0, 0, 1, 0, 1, .5, 1, 1, .5, 1, 0, 1});
    const shape star = shape_star(5, 0.4, 0.1), twisted = shape_star(5, 0.5, 0.7);
    switch (_i) {
    case 0:
        check_pair(&l, &square6, 20, share_of(200));
        break;
    case 1:
        check_pair(&square, &dart, 20, share_of(200));
        break;
    default:
        check_pair(&star, &twisted, 20, share_of(200));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("exact maps");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 200);
    tcase_add_loop_test(tests, points_come_back_exactly, 0, 3);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
