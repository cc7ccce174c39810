/* How domains with features are cut open: the triangulations, the path search, the drawing of cuts,
 * the polygons that the cuts leave, and the map that closes them again. Checked by brute force in
 * exact arithmetic. */
#include "geometry/segment.h"
#include "map/isotopy/close_cuts.h"
#include "map/plane/feature_start.h"
#include "map/plane/plane_certificate.h"
#include "math/predicates.h"

#include "../../../default_env.h"
#include "../../../feature_mixes.h"
#include "../../../feature_pairs.h"
#include "../../../share.h"
#include "../../../suite.h"

#include <stdlib.h>

enum { N_MIXES = 60 };

typedef struct pair {
    icc_domain *domain[2];
} pair;

/* Of the plans, then of random mixes that have features. */
static pair pair_number(int k)
{
    pair p;
    if (k < 2 * N_PLANS) {
        plan plans[2];
        plans_number(k / 2, &plans[k % 2], &plans[1 - k % 2]);
        return (pair){{plan_domain(&plans[0]), plan_domain(&plans[1])}};
    }
    for (uint64_t seed = (uint64_t)k;; seed += 1000) {
        feature_mix m;
        mix_create(&m, seed);
        memcpy(p.domain, m.domain, sizeof p.domain);
        if (m.n_features > 0)
            return p;
        mix_free(&m);
    }
}

static void free_pair(pair *p)
{
    icc_domain_free(p->domain[0]);
    icc_domain_free(p->domain[1]);
}

static const double *vertex_of(const icc_domain *domain, uint32_t vertex)
{
    return domain->vertices + 2 * (size_t)vertex;
}

/* ---- triangulations ---- */

static void check_triangulation(const iccp_domain_pair *s, int side)
{
    const icc_domain *domain = s->domain[side];
    const iccp_corners *mesh = &s->mesh[side];
    double area = 0;
    size_t n_open = 0, n_walls = 0;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->vertex[iccp_after(c)], b = mesh->vertex[iccp_before(c)];
        const uint32_t own = mesh->vertex[c], twin = mesh->twin[c];
        const double *corner[3] = {vertex_of(domain, own), vertex_of(domain, a),
                                   vertex_of(domain, b)};
        const bool is_wall = iccp_walls_have(&s->walls, a, b);
        if (c % 3 == 0) {
            ck_assert_int_gt(iccp_orient2d(corner[0], corner[1], corner[2]), 0);
            area += 0.5 * iccp_area2d(corner[0], corner[1], corner[2]);
        }
        n_open += twin == ICCP_NO_NEIGHBOUR;
        n_walls += is_wall;
        ck_assert(is_wall || twin != ICCP_NO_NEIGHBOUR);
        if (twin == ICCP_NO_NEIGHBOUR)
            continue;
        ck_assert(mesh->twin[twin] == c && mesh->vertex[iccp_after(twin)] == b &&
                  mesh->vertex[iccp_before(twin)] == a);
        if (!is_wall)
            ck_assert_int_le(iccp_incircle(corner[0], corner[1], corner[2],
                                           vertex_of(domain, mesh->vertex[twin])),
                             0);
    }
    ck_assert_double_eq_tol(area, domain->measure, 1e-9 * domain->measure);
    ck_assert_uint_eq(n_open, domain->n_facets);
    /* Lines are met from both sides. */
    ck_assert_uint_eq(n_walls, domain->n_facets + 2 * (s->n_walls - domain->n_facets));
}

START_TEST(pairs_are_triangulated)
{
    const iccp_env env = default_env();
    for (int k = 0; k < 2 * N_PLANS + share_of(N_MIXES); ++k) {
        pair p = pair_number(k);
        const iccp_features *features = p.domain[0]->features;
        iccp_domain_pair s;
        ck_assert_int_eq(iccp_domain_pair_create(&s, p.domain[0], p.domain[1], &env), ICC_OK);
        ck_assert(s.n == p.domain[0]->n_vertices && s.n_components == features->n + 1);
        ck_assert_uint_eq(s.n_walls, features->n_places - features->n_points);
        for (size_t v = 0; v < s.n; ++v) {
            const size_t c = s.component[v];
            const bool is_outer = v < features->n_outer;
            ck_assert((c == 0) == is_outer);
            ck_assert(is_outer || (v >= features->item[c - 1].first &&
                                   v < features->item[c - 1].first + features->item[c - 1].n));
        }
        check_triangulation(&s, 0);
        check_triangulation(&s, 1);
        iccp_domain_pair_free(&s);
        free_pair(&p);
    }
}
END_TEST

/* ---- path search ---- */

/* A square with a wall in its middle and a point on either side of it. */
static plan walled(void)
{
    plan p = plan_square(8);
    plan_feature(&p, ICC_FEATURE_LINE, 2, (const double[]){4, 1, 4, 7});
    plan_point(&p, 2, 4);
    plan_point(&p, 6, 4);
    return p;
}

/* Round the wall by one of its ends; not across it, nor, once a path leads from the wall to the edge
 * of the square, past that. */
START_TEST(paths_go_round)
{
    const iccp_env env = default_env();
    const plan p = walled();
    icc_domain *domain = plan_domain(&p);
    iccp_domain_pair domains;
    iccp_path_search search;
    iccp_found_path found = {0};
    ck_assert_int_eq(iccp_domain_pair_create(&domains, domain, domain, &env), ICC_OK);
    ck_assert_int_eq(iccp_path_search_create(&search, &domains, 0, &env), ICC_OK);
    const size_t n_bare = search.mesh.n_triangles;
    for (int round = 0; round < 2; ++round) {
        /* Neighbours: straight. */
        ck_assert_int_eq(iccp_path_search_find(&search, 6, ICCP_ANY_SECTOR, 4, ICCP_ANY_SECTOR,
                                               HUGE_VAL, &found),
                         ICC_OK);
        ck_assert(found.is_straight && found.n == 1);
        ck_assert_int_eq(iccp_path_search_find(&search, 6, ICCP_ANY_SECTOR, 7, ICCP_ANY_SECTOR,
                                               HUGE_VAL, &found),
                         ICC_OK);
        const double there = found.length;
        ck_assert(!found.is_straight && found.n >= 2 && there < HUGE_VAL);
        ck_assert(found.sector[0] == ICCP_WHOLE_SECTOR && found.sector[1] == ICCP_WHOLE_SECTOR);
        for (size_t k = 0; k < found.n; ++k) {
            const uint32_t c = found.corner[k];
            ck_assert(!iccp_walls_have(&domains.walls, search.mesh.vertex[iccp_after(c)],
                                       search.mesh.vertex[iccp_before(c)]));
        }
        /* No longer than it may be. */
        ck_assert_int_eq(iccp_path_search_find(&search, 6, ICCP_ANY_SECTOR, 7, ICCP_ANY_SECTOR,
                                               0.9 * there, &found),
                         ICC_OK);
        ck_assert(!(found.length < HUGE_VAL));
        /* From each end of the wall to the edge of the square. */
        for (uint32_t end = 4; end < 6; ++end) {
            ck_assert_int_eq(iccp_path_search_find(&search, end, ICCP_ANY_SECTOR, end == 4 ? 0 : 2,
                                                   ICCP_ANY_SECTOR, HUGE_VAL, &found),
                             ICC_OK);
            ck_assert(found.length < HUGE_VAL);
            ck_assert_int_eq(iccp_path_search_lay(&search, &found), ICC_OK);
            ck_assert_int_eq(iccp_path_search_find(&search, 6, ICCP_WHOLE_SECTOR, 7,
                                                   ICCP_WHOLE_SECTOR, HUGE_VAL, &found),
                             ICC_OK);
            ck_assert((found.length < HUGE_VAL) == (end == 4));
            ck_assert(end == 5 || found.length >= there);
        }
        ck_assert_uint_eq(search.n_paths, 2);
        ck_assert_uint_gt(search.mesh.n_triangles, n_bare);
        iccp_path_search_reset(&search);
        ck_assert(search.n_paths == 0 && search.mesh.n_triangles == n_bare);
    }
    iccp_found_path_free(&found, &env.memory);
    iccp_path_search_free(&search);
    iccp_domain_pair_free(&domains);
    icc_domain_free(domain);
}
END_TEST

/* The shortest line between two lanes, and no bend where none is needed. */
START_TEST(lines_are_short)
{
    const iccp_env env = default_env();
    const plan p = walled();
    icc_domain *domain = plan_domain(&p);
    iccp_domain_pair domains;
    iccp_path_search search;
    iccp_lanes lanes;
    iccp_found_path found = {0};
    iccp_polyline line = {0};
    ck_assert_int_eq(iccp_domain_pair_create(&domains, domain, domain, &env), ICC_OK);
    ck_assert_int_eq(iccp_path_search_create(&search, &domains, 0, &env), ICC_OK);
    static const uint32_t ends[2][2] = {{6, 7}, {6, 4}};
    for (int k = 0; k < 2; ++k) {
        ck_assert_int_eq(iccp_path_search_find(&search, ends[k][0], ICCP_ANY_SECTOR, ends[k][1],
                                               ICCP_ANY_SECTOR, HUGE_VAL, &found),
                         ICC_OK);
        ck_assert_int_eq(iccp_path_search_lay(&search, &found), ICC_OK);
    }
    ck_assert_int_eq(iccp_lanes_create(&lanes, &search), ICC_OK);
    for (size_t v = 0; v < search.n_vertices - domains.n; ++v)
        ck_assert(lanes.share[2 * v] > 0 && lanes.share[2 * v] < lanes.share[2 * v + 1] &&
                  lanes.share[2 * v + 1] < 1);
    for (size_t k = 0; k < 2; ++k) {
        line.n = 0;
        ck_assert_int_eq(iccp_shorten_path(&line, &search, &lanes, k), ICC_OK);
        ck_assert_mem_eq(line.points, vertex_of(domain, ends[k][0]), 2 * sizeof *line.points);
        ck_assert_mem_eq(line.points + 2 * (line.n - 1), vertex_of(domain, ends[k][1]),
                         2 * sizeof *line.points);
        /* Round the end of the wall with a bend or two, or straight to it. */
        ck_assert(k == 0 ? line.n >= 3 && line.n <= 4 : line.n == 2);
        for (size_t i = 0; k == 0 && i + 1 < line.n; ++i)
            ck_assert_int_eq(iccp_segments_meet(line.points + 2 * i, line.points + 2 * i + 2,
                                                vertex_of(domain, 4), vertex_of(domain, 5)),
                             0);
    }
    iccp_polyline_free(&line, &env.memory);
    iccp_lanes_free(&lanes, &env.memory);
    iccp_found_path_free(&found, &env.memory);
    iccp_path_search_free(&search);
    iccp_domain_pair_free(&domains);
    icc_domain_free(domain);
}
END_TEST

/* ---- cuts ---- */

/* The pieces of all cuts on a side: places of their ends, and which points these are. */
typedef struct pieces {
    size_t n;
    const double **ends;
    uint32_t *name;
} pieces;

static pieces pieces_of(const iccp_cuts *cuts, const iccp_domain_pair *s, int side)
{
    const size_t room = cuts->n + cuts->first[cuts->n];
    pieces p = {0, malloc(2 * room * sizeof *p.ends), malloc(2 * room * sizeof *p.name)};
    ck_assert(p.ends != NULL && p.name != NULL);
    for (size_t i = 0; i < cuts->n; ++i) {
        uint32_t from = cuts->ends[2 * i];
        for (uint32_t b = cuts->first[i]; b <= cuts->first[i + 1]; ++b) {
            const uint32_t to = b < cuts->first[i + 1] ? (uint32_t)s->n + b : cuts->ends[2 * i + 1];
            const uint32_t ends[2] = {from, to};
            for (size_t e = 0; e < 2; ++e) {
                p.name[2 * p.n + e] = ends[e];
                p.ends[2 * p.n + e] = ends[e] < s->n ? vertex_of(s->domain[side], ends[e])
                                                     : cuts->points[side] + 2 * (ends[e] - s->n);
            }
            ++p.n;
            from = to;
        }
    }
    ck_assert_uint_eq(p.n, room);
    return p;
}

/* Two segments may have no more than a named end in common. */
static bool are_apart(const double *const *x, const uint32_t *x_name, const double *const *y,
                      const uint32_t *y_name)
{
    const int32_t how = iccp_segments_meet(x[0], x[1], y[0], y[1]);
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b)
            if (x_name[a] == y_name[b])
                return how != ICC_DEFECT_CROSSING && !iccp_segment_has(x[0], x[1], y[1 - b]) &&
                       !iccp_segment_has(y[0], y[1], x[1 - a]);
    return how == 0;
}

static void check_apart(const iccp_cuts *cuts, const iccp_domain_pair *s, int side)
{
    pieces p = pieces_of(cuts, s, side);
    size_t n_meeting = 0;
    for (size_t i = 0; i < p.n; ++i) {
        for (size_t k = i + 1; k < p.n; ++k)
            n_meeting += !are_apart(p.ends + 2 * i, p.name + 2 * i, p.ends + 2 * k, p.name + 2 * k);
        for (size_t w = 0; w < s->n_walls; ++w) {
            const double *wall[2] = {vertex_of(s->domain[side], s->pairs[2 * w]),
                                     vertex_of(s->domain[side], s->pairs[2 * w + 1])};
            n_meeting += !are_apart(p.ends + 2 * i, p.name + 2 * i, wall, s->pairs + 2 * w);
        }
    }
    ck_assert_uint_eq(n_meeting, 0);
    free(p.ends);
    free(p.name);
}

/* A tree of all components. */
static void check_tree(const iccp_cuts *cuts, const iccp_domain_pair *s)
{
    uint32_t group[PLAN_FEATURES + MIX_FEATURES + 1];
    ck_assert_uint_eq(cuts->n, s->n_components - 1);
    for (uint32_t c = 0; c < s->n_components; ++c)
        group[c] = c;
    for (size_t i = 0; i < cuts->n; ++i) {
        const uint32_t a = group[s->component[cuts->ends[2 * i]]];
        const uint32_t b = group[s->component[cuts->ends[2 * i + 1]]];
        ck_assert_uint_ne(a, b);
        for (uint32_t c = 0; c < s->n_components; ++c)
            group[c] = group[c] == a ? b : group[c];
    }
}

/* Goes round once, each edge of a ring once and each of a line or cut twice, the inside on the
 * left; its triangles fill it. */
static void check_polygon(const iccp_cut_polygons *p, const iccp_cuts *cuts,
                          const iccp_domain_pair *s, int side)
{
    const icc_domain *domain = s->domain[side];
    size_t n_open = 0;
    double area = 0, filled = 0;
    for (uint32_t i = 0; i < p->n; ++i) {
        const uint32_t next = i + 1 < p->n ? i + 1 : 0, other = p->partner[i];
        const double *a = p->points + 2 * (size_t)i, *b = p->points + 2 * (size_t)next;
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        n_open += other == ICCP_NO_NEIGHBOUR;
        if (other == ICCP_NO_NEIGHBOUR) {
            ck_assert(iccp_walls_have(&s->walls, p->vertex[i], p->vertex[next]));
            continue;
        }
        ck_assert_uint_eq(p->partner[other], i);
        ck_assert(p->vertex[other] == p->vertex[next] &&
                  p->vertex[other + 1 < p->n ? other + 1 : 0] == p->vertex[i]);
    }
    for (size_t t = 0; t < p->mesh.n_triangles; ++t) {
        const uint32_t *v = p->mesh.vertex + 3 * t;
        filled += 0.5 * iccp_area2d(p->points + 2 * (size_t)v[0], p->points + 2 * (size_t)v[1],
                                    p->points + 2 * (size_t)v[2]);
        ck_assert_int_gt(iccp_orient2d(p->points + 2 * (size_t)v[0], p->points + 2 * (size_t)v[1],
                                       p->points + 2 * (size_t)v[2]),
                         0);
    }
    ck_assert_uint_eq(n_open, domain->n_facets);
    ck_assert_uint_eq(p->n, p->mesh.n_triangles + 2);
    ck_assert_uint_eq(p->n, domain->n_facets + 2 * (s->n_walls - domain->n_facets) +
                                2 * (cuts->n + cuts->first[cuts->n]));
    ck_assert_double_eq_tol(area, domain->measure, 1e-9 * domain->measure);
    ck_assert_double_eq_tol(filled, domain->measure, 1e-9 * domain->measure);
}

/* The overlay of both polygons, closed: a certified map, with every vertex on its partner and lines
 * made of edges. */
static void check_closed(const iccp_cut_polygons polygon[2], const iccp_domain_pair *s)
{
    const iccp_env env = default_env();
    const icc_domain *source = s->domain[0], *target = s->domain[1];
    const iccp_ngon ngon[2] = {iccp_cut_polygon_ngon(&polygon[0], 0),
                               iccp_cut_polygon_ngon(&polygon[1], 0)};
    iccp_overlay overlay;
    iccp_plmap map;
    uint32_t vertex[MIX_VERTICES + PLAN_VERTICES];
    size_t n_pieces = 0;
    ck_assert_int_eq(iccp_overlay_create(&overlay, polygon[0].n, &ngon[0], &ngon[1], &env), ICC_OK);
    ck_assert_int_eq(iccp_close_cuts(&map, &overlay, &polygon[0], s, &env), ICC_OK);
    ck_assert_uint_eq(map.corners.n_triangles, overlay.corners.n_triangles);
    if (iccp_plmap_certify(&map, &env, NULL) == ICC_OK) {
        ck_assert(iccp_plmap_find_vertices(&map, vertex));
        for (uint32_t v = 0; v < source->n_vertices; ++v) {
            const size_t at = 2 * (size_t)vertex[v];
            ck_assert_mem_eq(map.points + at, vertex_of(source, v), 2 * sizeof *map.points);
            ck_assert_mem_eq(map.images + at, vertex_of(target, v), 2 * sizeof *map.images);
        }
        for (uint32_t c = 0; c < 3 * map.corners.n_triangles; ++c)
            n_pieces += iccp_plmap_is_line(&map, c);
        ck_assert_uint_eq(n_pieces, s->n_rim + 2 * (s->n_walls - s->n_rim));
    }
    iccp_plmap_free(&map);
    iccp_overlay_free(&overlay);
}

START_TEST(cuts_leave_polygons)
{
    enum { TREES = 4 };
    const iccp_env env = default_env();
    int n_made = 0, n_tried = 0;
    for (int k = 0; k < 2 * N_PLANS + share_of(N_MIXES); ++k) {
        pair p = pair_number(k);
        iccp_domain_pair s;
        iccp_cutter cutter;
        ck_assert_int_eq(iccp_domain_pair_create(&s, p.domain[0], p.domain[1], &env), ICC_OK);
        ck_assert_int_eq(iccp_cutter_create(&cutter, &s, &env), ICC_OK);
        for (uint64_t tree = 0; tree < TREES; ++tree) {
            iccp_cuts c;
            iccp_cut_polygons polygon[2];
            ck_assert_int_eq(iccp_cuts_create(&c, &cutter, tree, &env), ICC_OK);
            check_tree(&c, &s);
            for (int side = 0; side < 2; ++side)
                ck_assert(c.length[side] >= c.straight[side] * (1 - 1e-12));
            ++n_tried;
            /* Rounding may prevent an answer for long detours. */
            icc_status status[2];
            for (int side = 0; side < 2; ++side)
                status[side] = iccp_cut_polygons_create(&polygon[side], &s, side, &c, &env);
            if (status[0] == ICC_OK && status[1] == ICC_OK) {
                for (int side = 0; side < 2; ++side) {
                    check_apart(&c, &s, side);
                    check_polygon(&polygon[side], &c, &s, side);
                }
                ck_assert_uint_eq(polygon[0].n_polygons, 1);
                ck_assert(iccp_cut_polygons_same(&polygon[0], &polygon[1]));
                if (tree == 0)
                    check_closed(polygon, &s);
                ++n_made;
            }
            for (int side = 0; side < 2; ++side)
                if (status[side] == ICC_OK)
                    iccp_cut_polygons_free(&polygon[side]);
            iccp_cuts_free(&c);
        }
        iccp_cutter_free(&cutter);
        iccp_domain_pair_free(&s);
        free_pair(&p);
    }
    ck_assert_int_ge(100 * n_made, 95 * n_tried);
}
END_TEST

/* Cuts that meet a wall, or each other, or that make no tree, leave no polygon. */
START_TEST(no_polygon)
{
    const iccp_env env = default_env();
    const plan p = walled();
    icc_domain *domain = plan_domain(&p);
    iccp_domain_pair s;
    iccp_cut_polygons polygon;
    static const uint32_t ends[3][6] = {{0, 4, 6, 7, 7, 1},  /* across the wall */
                                        {0, 4, 6, 2, 7, 0},  /* across it, too */
                                        {0, 4, 3, 5, 0, 6}}; /* a ring, and point 7 left out */
    static const icc_status expected[3] = {ICC_ERR_CERTIFICATE, ICC_ERR_CERTIFICATE,
                                           ICC_ERR_TOPOLOGY};
    ck_assert_int_eq(iccp_domain_pair_create(&s, domain, domain, &env), ICC_OK);
    for (int k = 0; k < 3; ++k) {
        iccp_cuts c;
        ck_assert_int_eq(iccp_cuts_begin(&c, 3, &env.memory), ICC_OK);
        memcpy(c.ends, ends[k], sizeof ends[k]);
        ck_assert_int_eq(iccp_cut_polygons_create(&polygon, &s, 0, &c, &env), expected[k]);
        iccp_cuts_free(&c);
    }
    iccp_domain_pair_free(&s);
    icc_domain_free(domain);
}
END_TEST

/* ---- the start ---- */

static bool is_same(const iccp_plmap *a, const iccp_plmap *b)
{
    return a->n_vertices == b->n_vertices && a->corners.n_triangles == b->corners.n_triangles &&
           memcmp(a->points, b->points, 2 * a->n_vertices * sizeof *a->points) == 0 &&
           memcmp(a->images, b->images, 2 * a->n_vertices * sizeof *a->images) == 0;
}

/* One-to-one, the same each time, and no worse with more work. */
START_TEST(starts_are_maps)
{
    const iccp_env env = default_env();
    const icc_map_options options = {.size = sizeof options};
    for (int k = 0; k < 2 * N_PLANS; ++k) {
        pair p = pair_number(k);
        iccp_plmap map[3];
        for (int i = 0; i < 3; ++i) {
            iccp_feature_report report;
            iccp_allowance work = {.search.left = i < 2 ? 1e5 : 1,
                                   .vain = iccp_work_unlimited(),
                                   .overlay.left = i < 2 ? 1e5 : 0};
            ck_assert_int_eq(iccp_feature_start(&map[i], p.domain[0], p.domain[1], &options, &work,
                                                &report, &env, NULL),
                             ICC_OK);
            ck_assert_uint_eq(report.cuts.n, p.domain[0]->features->n);
            ck_assert(report.n_trees >= 1 && (i < 2 || report.n_trees == 1));
            ck_assert_int_eq(iccp_plmap_certify(&map[i], &env, NULL), ICC_OK);
            iccp_feature_report_free(&report);
        }
        ck_assert(is_same(&map[0], &map[1]));
        ck_assert_double_le(iccp_plmap_energy(&map[0]), iccp_plmap_energy(&map[2]) * (1 + 1e-9));
        for (int i = 0; i < 3; ++i)
            iccp_plmap_free(&map[i]);
        free_pair(&p);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cuts");
    TCase *c = tcase_create("cuts");
    tcase_add_test(c, pairs_are_triangulated);
    tcase_add_test(c, paths_go_round);
    tcase_add_test(c, lines_are_short);
    tcase_add_test(c, cuts_leave_polygons);
    tcase_add_test(c, no_polygon);
    tcase_add_test(c, starts_are_maps);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
