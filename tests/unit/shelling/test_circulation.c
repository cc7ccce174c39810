/* Rings and positive fluxes. Orders are made here, by electric networks with wires of random
 * strength: no simplex is higher or lower than all around it, which is all that fluxes ask for. */
#include "base/error.h"
#include "shelling/circulation.h"

#include "../../fluxes.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

/* ------------------------------------------------------------------ orders */

typedef struct height {
    double value;
    uint32_t simplex;
} height;

static int compare_heights(const void *a, const void *b)
{
    const height *x = a, *y = b;
    if (x->value < y->value || y->value < x->value)
        return x->value < y->value ? -1 : 1;
    return x->simplex < y->simplex ? -1 : 1;
}

/* Ranks by the potential of a network, 0 in the star and 1 beyond the boundary; `wire` of each side
 * is the same from both. */
static void rank_by_network(const flux_case *c, const double *wire, uint32_t *rank)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n_corners = mesh->dim + 1, n = mesh->n_simplices;
    height *h = mesh_alloc(n, sizeof *h);
    double *value = mesh_alloc(n, sizeof *value);
    double change = 1;
    for (size_t t = 0; t < n; ++t)
        value[t] = flux_in_star(c, t) ? 0 : 1;
    for (int pass = 0; pass < 400 && change > 1e-12; ++pass) {
        change = 0;
        for (size_t i = 0; i < n; ++i) {
            const size_t t = pass % 2 == 0 ? i : n - 1 - i;
            double sum = 0, total = 0;
            for (size_t s = n_corners * t; s < n_corners * (t + 1); ++s) {
                const uint32_t other = mesh->across[s];
                sum += wire[s] *
                       ((other & ICCP_ON_BOUNDARY) != 0 ? 1 : value[iccp_simplex_of(mesh, other)]);
                total += wire[s];
            }
            if (flux_in_star(c, t))
                continue;
            change = fmax(change, fabs(value[t] - sum / total) / value[t]);
            value[t] = sum / total;
        }
    }
    for (uint32_t t = 0; t < n; ++t)
        h[t] = (height){value[t], t};
    qsort(h, n, sizeof *h, compare_heights);
    for (uint32_t i = 0, next = 1; i < n; ++i)
        rank[h[i].simplex] = flux_in_star(c, h[i].simplex) ? 0 : next++;
    free(h);
    free(value);
}

static void random_wires(const iccp_simplices *mesh, double spread, random_source *r, double *wire)
{
    for (uint32_t s = 0; s < flux_sides(mesh); ++s) {
        const uint32_t other = mesh->across[s];
        wire[s] = exp(random_between(r, -spread, spread));
        if ((other & ICCP_ON_BOUNDARY) == 0 && other < s)
            wire[s] = wire[other];
    }
}

/* Of the simplices next to one outside the star, one has smaller rank and one greater, or lies
 * beyond the boundary. */
static bool is_sound(const flux_case *c, const uint32_t *rank)
{
    const size_t n_corners = c->mesh->dim + 1;
    for (size_t t = 0; t < c->mesh->n_simplices; ++t) {
        bool up = false, down = false;
        for (size_t s = n_corners * t; s < n_corners * (t + 1); ++s) {
            const uint32_t other = c->mesh->across[s];
            const bool rim = (other & ICCP_ON_BOUNDARY) != 0;
            up = up || rim || rank[iccp_simplex_of(c->mesh, other)] > rank[t];
            down = down || (!rim && rank[iccp_simplex_of(c->mesh, other)] < rank[t]);
        }
        if (!flux_in_star(c, t) && !(up && down))
            return false;
    }
    return true;
}

/* ------------------------------------------------------------ what is shared */

typedef struct setting {
    flux_case c;
    double *inflow, *reference, *potential, *flux, *wire;
    uint32_t *rank;
    iccp_circulation circulation;
} setting;

static setting set_up(int k)
{
    const iccp_env env = default_env();
    setting s = {.c = flux_number(k)};
    const iccp_simplices *mesh = s.c.mesh;
    s.inflow = mesh_alloc(mesh->n_facets, sizeof(double));
    s.reference = mesh_alloc(flux_sides(mesh), sizeof(double));
    s.flux = mesh_alloc(flux_sides(mesh), sizeof(double));
    s.wire = mesh_alloc(flux_sides(mesh), sizeof(double));
    s.potential = mesh_alloc(mesh->n_simplices, sizeof(double));
    s.rank = mesh_alloc(mesh->n_simplices, sizeof(uint32_t));
    ck_assert_int_eq(iccp_inflow(mesh, s.c.centre, 0.5, s.inflow, &env), ICC_OK);
    ck_assert_int_eq(
        iccp_reference_flux(mesh, s.c.centre, s.inflow, s.reference, s.potential, &env), ICC_OK);
    ck_assert_int_eq(
        iccp_circulation_create(&s.circulation, mesh, s.c.centre, s.inflow, s.reference, &env),
        ICC_OK);
    return s;
}

static void take_down(setting *s)
{
    iccp_circulation_free(&s->circulation);
    free(s->inflow);
    free(s->reference);
    free(s->flux);
    free(s->wire);
    free(s->potential);
    free(s->rank);
    flux_free(&s->c);
}

/* A random order; the wider the spread, the less it has to do with the reference. */
static bool draw_order(setting *s, double spread, random_source *r)
{
    random_wires(s->c.mesh, spread, r, s->wire);
    rank_by_network(&s->c, s->wire, s->rank);
    return is_sound(&s->c, s->rank);
}

static void check_flux(const setting *s, const char *when)
{
    const iccp_simplices *mesh = s->c.mesh;
    flux_check(&s->c, s->inflow, s->flux);
    for (uint32_t side = 0; side < flux_sides(mesh); ++side) {
        const uint32_t other = mesh->across[side];
        if ((other & ICCP_ON_BOUNDARY) != 0)
            continue;
        const uint32_t here = s->rank[iccp_simplex_of(mesh, side)];
        const uint32_t there = s->rank[iccp_simplex_of(mesh, other)];
        if (here > there)
            ck_assert_msg(s->flux[side] > 0, "%s, %s: flux %g", s->c.name, when, s->flux[side]);
    }
    const double divergence = iccp_circulation_divergence(&s->circulation, s->flux);
    ck_assert_msg(divergence <= 2e-15, "%s, %s: divergence %g", s->c.name, when, divergence);
}

/* ------------------------------------------------------------------- links */

typedef struct face {
    uint32_t corner[ICC_MAX_DIM - 1];
} face;

static int compare_numbers(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return x < y ? -1 : x > y;
}

static int compare_faces(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(face));
}

/* The faces of a simplex without two of its corners; those on the facet of one of the two only,
 * with `on` < dim + 1. */
static size_t list_faces(const iccp_simplices *mesh, size_t simplex, size_t on, face *faces)
{
    const size_t n_corners = mesh->dim + 1;
    size_t n = 0;
    for (size_t a = 0; a < n_corners; ++a)
        for (size_t b = a + 1; b < n_corners; ++b) {
            size_t m = 0;
            if (on < n_corners && a != on && b != on)
                continue;
            memset(&faces[n], 0, sizeof *faces);
            for (size_t i = 0; i < n_corners; ++i)
                if (i != a && i != b)
                    faces[n].corner[m++] = mesh->corners[n_corners * simplex + i];
            qsort(faces[n++].corner, m, sizeof(uint32_t), compare_numbers);
        }
    return n;
}

static size_t drop_copies(face *faces, size_t n)
{
    size_t n_left = 0;
    qsort(faces, n, sizeof *faces, compare_faces);
    for (size_t i = 0; i < n; ++i)
        if (n_left == 0 || compare_faces(&faces[n_left - 1], &faces[i]) != 0)
            faces[n_left++] = faces[i];
    return n_left;
}

/* All faces, less those on the boundary, less those at the centre, which is not on the boundary. */
static size_t count_links(const flux_case *c)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n_corners = mesh->dim + 1, most = n_corners * mesh->dim / 2 * mesh->n_simplices;
    face *all = mesh_alloc(most, sizeof *all), *rim = mesh_alloc(2 * most, sizeof *rim);
    size_t n_all = 0, n_rim = 0, n_central = 0;
    for (uint32_t s = 0; s < flux_sides(mesh); ++s)
        if ((mesh->across[s] & ICCP_ON_BOUNDARY) != 0)
            n_rim += list_faces(mesh, iccp_simplex_of(mesh, s), s % n_corners, rim + n_rim);
    for (size_t t = 0; t < mesh->n_simplices; ++t)
        n_all += list_faces(mesh, t, n_corners, all + n_all);
    n_all = drop_copies(all, n_all);
    n_rim = drop_copies(rim, n_rim);
    for (size_t i = 0; i < n_all; ++i) {
        bool is_central = false;
        for (size_t k = 0; k + 1 < mesh->dim; ++k)
            is_central = is_central || all[i].corner[k] == c->centre;
        n_central += is_central;
    }
    free(all);
    free(rim);
    return n_all - n_rim - n_central;
}

/* Every inner face has its link, and a link takes nothing from any simplex nor gives it
 * anything. */
START_TEST(rings_are_cycles)
{
    size_t n_links = 0;
    for (int k = 0; k <= FLUX_CASES; ++k) {
        flux_case c = flux_number(k);
        const iccp_env env = default_env();
        iccp_links links;
        double *balance = calloc(c.mesh->n_simplices, sizeof *balance);
        ck_assert_ptr_nonnull(balance);
        ck_assert_int_eq(iccp_links_create(&links, c.mesh, c.centre, &env), ICC_OK);
        ck_assert_msg(links.n == count_links(&c), "%s: %zu rings of %zu", c.name, links.n,
                      count_links(&c));
        for (size_t r = 0; r < links.n; ++r) {
            double star = 0;
            ck_assert_msg(links.first[r + 1] - links.first[r] >= 2, "%s: ring %zu", c.name, r);
            for (int pass = 0; pass < 2; ++pass)
                for (size_t p = links.first[r]; p < links.first[r + 1]; ++p) {
                    const uint32_t side = links.side[links.step[p] / 2],
                                   other = c.mesh->across[side];
                    const double on = links.step[p] % 2 == 0 ? 1 : -1;
                    const size_t t[2] = {iccp_simplex_of(c.mesh, side),
                                         iccp_simplex_of(c.mesh, other)};
                    ck_assert_msg(side < other, "%s: ring %zu", c.name, r);
                    for (int i = 0; i < 2; ++i) {
                        const double amount = i == 0 ? on : -on;
                        if (pass == 1)
                            ck_assert_msg(!(fabs(balance[t[i]]) > 0) || flux_in_star(&c, t[i]),
                                          "%s: ring %zu", c.name, r);
                        else
                            balance[t[i]] += amount;
                        star += pass == 0 && flux_in_star(&c, t[i]) ? amount : 0;
                    }
                }
            ck_assert_msg(!(fabs(star) > 0), "%s: ring %zu", c.name, r);
            for (size_t p = links.first[r]; p < links.first[r + 1]; ++p) {
                const uint32_t side = links.side[links.step[p] / 2];
                balance[iccp_simplex_of(c.mesh, side)] = 0;
                balance[iccp_simplex_of(c.mesh, c.mesh->across[side])] = 0;
            }
        }
        n_links += links.n;
        iccp_links_free(&links);
        free(balance);
        flux_free(&c);
    }
    ck_assert_uint_gt(n_links, 50000);
}
END_TEST

/* ------------------------------------------------------------------ fluxes */

START_TEST(fluxes_are_positive_and_without_sources)
{
    const double spreads[] = {0, 2, 6};
    int n_orders = 0;
    for (int k = 0; k < FLUX_CASES; ++k) {
        const iccp_env env = default_env();
        setting s = set_up(k);
        random_source r = {(uint64_t)k};
        for (int i = 0; i < 3; ++i) {
            if (!draw_order(&s, spreads[i], &r))
                continue;
            ++n_orders;
            ck_assert_int_eq(iccp_circulation_greedy(&s.circulation, s.rank, s.flux, &env), ICC_OK);
            check_flux(&s, "greedy");
            for (size_t n = 1; n <= 16; n *= 4) {
                ck_assert_int_eq(iccp_circulation_relax(&s.circulation, s.rank, n, s.flux, &env),
                                 ICC_OK);
                check_flux(&s, "relaxed");
            }
        }
        take_down(&s);
    }
    ck_assert_int_gt(n_orders, 2 * FLUX_CASES);
}
END_TEST

START_TEST(energy_never_rises)
{
    double fallen = 0;
    for (int k = 0; k < FLUX_CASES; ++k) {
        const iccp_env env = default_env();
        setting s = set_up(k);
        random_source r = {(uint64_t)k + 7};
        if (draw_order(&s, 2, &r)) {
            ck_assert_int_eq(iccp_circulation_greedy(&s.circulation, s.rank, s.flux, &env), ICC_OK);
            double before = iccp_circulation_energy(&s.circulation, s.flux);
            const double first = before;
            for (int i = 0; i < 12; ++i) {
                ck_assert_int_eq(iccp_circulation_relax(&s.circulation, s.rank, 1, s.flux, &env),
                                 ICC_OK);
                const double after = iccp_circulation_energy(&s.circulation, s.flux);
                ck_assert_msg(after <= before * (1 + 1e-12), "%s: %.17g to %.17g", s.c.name, before,
                              after);
                before = after;
            }
            fallen += first > 0 ? (first - before) / first : 0;
        }
        take_down(&s);
    }
    ck_assert_double_gt(fallen, 4);
}
END_TEST

/* Along an order that the reference never runs against, the fit is the reference, but for where
 * that is less than the least flux, and what follows from it: 18 times as much in a corridor, 9
 * elsewhere. */
START_TEST(reference_is_found_again)
{
    int n_found = 0;
    for (int k = 0; k < FLUX_CASES; ++k) {
        const iccp_env env = default_env();
        setting s = set_up(k);
        const iccp_simplices *mesh = s.c.mesh;
        const size_t n_corners = mesh->dim + 1;
        /* Those first from which all flux goes to what has a rank. */
        uint32_t next = 1;
        for (size_t t = 0; t < mesh->n_simplices; ++t)
            s.rank[t] = flux_in_star(&s.c, t) ? 0 : UINT32_MAX;
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            for (size_t t = 0; t < mesh->n_simplices; ++t) {
                bool ready = s.rank[t] == UINT32_MAX;
                for (size_t i = n_corners * t; i < n_corners * (t + 1) && ready; ++i)
                    ready = s.reference[i] <= 0 ||
                            s.rank[iccp_simplex_of(mesh, mesh->across[i])] != UINT32_MAX;
                if (ready)
                    s.rank[t] = next++;
                goes_on = goes_on || ready;
            }
        }
        size_t n_ranked = 0;
        for (size_t t = 0; t < mesh->n_simplices; ++t)
            n_ranked += s.rank[t] != UINT32_MAX;
        if (n_ranked == mesh->n_simplices && is_sound(&s.c, s.rank) && s.circulation.links.n > 0) {
            double size = 0, off = 0, missing = 0;
            ck_assert_int_eq(iccp_circulation_greedy(&s.circulation, s.rank, s.flux, &env), ICC_OK);
            check_flux(&s, "greedy");
            ck_assert_int_eq(iccp_circulation_relax(&s.circulation, s.rank, 400, s.flux, &env),
                             ICC_OK);
            check_flux(&s, "relaxed");
            for (size_t f = 0; f < s.circulation.links.n_facets; ++f) {
                const uint32_t side = s.circulation.links.side[f];
                size += fabs(s.reference[side]);
                off += fabs(s.flux[side] - s.reference[side]);
                missing += fmax(s.circulation.least[f] - fabs(s.reference[side]), 0);
            }
            ck_assert_msg(off <= 30 * missing + 1e-6 * size,
                          "%s: off by %g, %g of %g cannot be had", s.c.name, off, missing, size);
            ++n_found;
        }
        take_down(&s);
    }
    ck_assert_int_ge(n_found, 8);
}
END_TEST

/* No circulation round a single link is left that would lower the energy. */
START_TEST(sweeps_end_at_the_least_energy)
{
    for (int k = FLUX_CUBE; k < FLUX_CASES; k += FLUX_KINDS) {
        const iccp_env env = default_env();
        setting s = set_up(k);
        random_source r = {3};
        const iccp_links *links = &s.circulation.links;
        double gain = 0;
        ck_assert(draw_order(&s, 1, &r));
        ck_assert_int_eq(iccp_circulation_greedy(&s.circulation, s.rank, s.flux, &env), ICC_OK);
        double *least = mesh_alloc(links->n_facets, sizeof *least);
        for (size_t f = 0; f < links->n_facets; ++f)
            least[f] = fmin(s.circulation.least[f], 0.5 * fabs(s.flux[links->side[f]]));
        ck_assert_int_eq(iccp_circulation_relax(&s.circulation, s.rank, 1000, s.flux, &env),
                         ICC_OK);
        for (size_t q = 0; q < links->n; ++q) {
            double sum = 0, weight = 0, low = -1, high = 1;
            for (size_t p = links->first[q]; p < links->first[q + 1]; ++p) {
                const uint32_t f = links->step[p] / 2, side = links->side[f];
                const double on = links->step[p] % 2 == 0 ? 1 : -1, flux = on * s.flux[side];
                sum += (on * s.reference[side] - flux) / s.circulation.weight[f];
                weight += 1 / s.circulation.weight[f];
                if (flux > 0)
                    low = fmax(low, fmin(least[f] - flux, 0));
                else
                    high = fmin(high, fmax(-least[f] - flux, 0));
            }
            const double round = fmin(fmax(sum / weight, low), high);
            gain += round * (2 * sum - round * weight);
        }
        const double energy = iccp_circulation_energy(&s.circulation, s.flux);
        ck_assert_msg(gain <= 1e-4 * energy, "%s: %g of %g", s.c.name, gain, energy);
        free(least);
        take_down(&s);
    }
}
END_TEST

/* ---------------------------------------------------------------- failures */

static icc_status fit(const icc_env *given, icc_error *err, void *argument)
{
    const setting *s = argument;
    iccp_env env;
    iccp_circulation c;
    icc_status status = iccp_env_read(&env, given, err);
    if (status == ICC_OK)
        status = iccp_circulation_create(&c, s->c.mesh, s->c.centre, s->inflow, s->reference, &env);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    status = iccp_circulation_greedy(&c, s->rank, s->flux, &env);
    if (status == ICC_OK)
        status = iccp_circulation_relax(&c, s->rank, 3, s->flux, &env);
    iccp_circulation_free(&c);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing)
{
    setting s = set_up(FLUX_KINDS + FLUX_CUBE);
    random_source r = {5};
    ck_assert(draw_order(&s, 1, &r));
    faulty_sweep(fit, &s);
    take_down(&s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("circulation");
    TCase *test = tcase_create("circulation");
    tcase_add_test(test, rings_are_cycles);
    tcase_add_test(test, fluxes_are_positive_and_without_sources);
    tcase_add_test(test, energy_never_rises);
    tcase_add_test(test, reference_is_found_again);
    tcase_add_test(test, sweeps_end_at_the_least_energy);
    tcase_add_test(test, failures_leave_nothing);
    suite_add_tcase(suite, test);
    return suite_run(suite);
}
