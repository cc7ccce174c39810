/* Charts and maps of method field: what the certificate promises, in several dimensions. */
#include <check.h>
#include <icc/stages.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "map/curves/curves.h"

#include "../determinant.h"
#include "../domains.h"
#include "../infos.h"
#include "../npy.h"
#include "../obj.h"
#include "../random.h"
#include "../reports.h"
#include "../suite.h"
#include "../surfaces.h"

enum { N_POINTS = 150 };

/* A boundary of any dimension up to 6, and another position of its vertices. */
typedef struct pair {
    int32_t dim;
    size_t n_vertices, n_facets;
    double *from, *to;
    uint32_t *facets;
    icc_domain *source, *target;
} pair;

/* Turns, bends and stretches a point of a shape of size about 1. */
static void deform(int32_t dim, const double *x, double *y)
{
    const double angle = 0.5 * x[dim - 1], c = cos(angle), s = sin(angle);
    memcpy(y, x, (size_t)dim * sizeof *y);
    y[0] = 1.2 * (c * x[0] - s * x[1]);
    y[1] = s * x[0] + c * x[1] + 0.2 * x[0] * x[0];
    for (int32_t k = 2; k < dim; ++k)
        y[k] = x[k] + 0.1 * sin(2 * x[0]);
}

static void make_target(pair *p)
{
    icc_error err = {.size = sizeof err};
    p->to = malloc(p->n_vertices * (size_t)p->dim * sizeof *p->to);
    for (size_t v = 0; v < p->n_vertices; ++v)
        deform(p->dim, p->from + (size_t)p->dim * v, p->to + (size_t)p->dim * v);
    ck_assert_msg(icc_domain_create(&p->target, p->dim, p->n_vertices, p->to, p->n_facets,
                                    p->facets, NULL, &err) == ICC_OK,
                  "%s", err.message);
}

static void pair_free(pair *p)
{
    icc_domain_free(p->source);
    icc_domain_free(p->target);
    free(p->from);
    free(p->to);
    free(p->facets);
}

static void pair_of_surface(pair *p, const surface *s)
{
    icc_error err = {.size = sizeof err};
    *p = (pair){.dim = 3, .n_vertices = s->n_vertices, .n_facets = s->n_faces};
    p->from = malloc(s->n_vertices * 3 * sizeof *p->from);
    p->facets = malloc(s->n_faces * 3 * sizeof *p->facets);
    memcpy(p->from, s->vertices, s->n_vertices * 3 * sizeof *p->from);
    memcpy(p->facets, s->faces, s->n_faces * 3 * sizeof *p->facets);
    ck_assert_msg(icc_domain_create(&p->source, 3, p->n_vertices, p->from, p->n_facets, p->facets,
                                    NULL, &err) == ICC_OK,
                  "%s", err.message);
    make_target(p);
}

/* A mask, scaled to a size of about 1. */
static void pair_of_mask(pair *p, int32_t dim, const size_t *shape, const uint8_t *cells)
{
    icc_error err = {.size = sizeof err};
    icc_domain_info info = {.size = sizeof info};
    *p = (pair){.dim = dim};
    ck_assert_msg(icc_domain_create_mask(&p->source, dim, shape, cells, NULL, &err) == ICC_OK, "%s",
                  err.message);
    ck_assert_int_eq(icc_domain_get_info(p->source, &info), ICC_OK);
    p->n_vertices = info.n_vertices;
    p->n_facets = info.n_facets;
    p->from = malloc(p->n_vertices * (size_t)dim * sizeof *p->from);
    p->facets = malloc(p->n_facets * (size_t)dim * sizeof *p->facets);
    ck_assert_int_eq(icc_domain_get_boundary(p->source, p->from, p->facets), ICC_OK);
    make_target(p);
}

static icc_map *make_map(const pair *p, int32_t cells)
{
    icc_error err = {.size = sizeof err};
    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_FIELD, .cells = cells};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    icc_map *map;
    ck_assert_msg(icc_map_create(&map, p->source, p->target, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return map;
}

static double largest_difference(size_t n, const double *a, const double *b)
{
    double largest = 0;
    for (size_t i = 0; i < n; ++i)
        largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

/* There and back, for points that have images: how many do not, or do not come back. */
static size_t count_lost(random_source *r, const pair *p, const icc_map *map, double tolerance)
{
    const size_t dim = (size_t)p->dim;
    double points[N_POINTS * ICC_MAX_DIM], images[N_POINTS * ICC_MAX_DIM],
        back[N_POINTS * ICC_MAX_DIM];
    int32_t where[N_POINTS];
    size_t lost = 0;
    for (size_t i = 0; i < N_POINTS; ++i)
        domain_random_point(r, p->source, points + dim * i);
    ck_assert_int_eq(icc_map_apply(map, N_POINTS, points, images, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_apply_inverse(map, N_POINTS, images, back, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_locate(p->target, N_POINTS, images, where, NULL, NULL, NULL),
                     ICC_OK);
    for (size_t i = 0; i < N_POINTS; ++i)
        lost += where[i] != ICC_INSIDE ||
                !(largest_difference(dim, points + dim * i, back + dim * i) <= tolerance);
    return lost;
}

/* Boundary points go where their barycentric coordinates say. */
static void check_boundary(random_source *r, const pair *p, const icc_map *map)
{
    const size_t dim = (size_t)p->dim;
    for (int i = 0; i < N_POINTS; ++i) {
        const uint32_t *facet = p->facets + dim * (size_t)random_below(r, (int)p->n_facets);
        double bary[ICC_MAX_DIM], sum = 0, x[ICC_MAX_DIM] = {0}, y[ICC_MAX_DIM] = {0},
                                  z[ICC_MAX_DIM];
        for (size_t k = 0; k < dim; ++k)
            sum += bary[k] = random_unit(r);
        for (size_t k = 0; k < dim; ++k)
            for (size_t c = 0; c < dim; ++c) {
                x[c] += bary[k] / sum * p->from[dim * facet[k] + c];
                y[c] += bary[k] / sum * p->to[dim * facet[k] + c];
            }
        icc_status status;
        ck_assert_int_eq(icc_map_apply(map, 1, x, z, &status, NULL, NULL), ICC_OK);
        /* A point may be rounded to the outside, but not by more than the tolerance of a
         * boundary. */
        ck_assert_int_eq(status, ICC_OK);
        ck_assert(largest_difference(dim, y, z) < 1e-9);
    }
}

static icc_field_info field_info_of(const icc_chart *chart)
{
    icc_field_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_chart_get_field_info(chart, &info), ICC_OK);
    return info;
}

/* The certificates are what the counts say. */
static bool is_certified(const icc_map *map)
{
    const icc_chart *const charts[2] = {icc_map_source_chart(map), icc_map_target_chart(map)};
    icc_map_info whole = {.size = sizeof whole};
    bool certified = true;
    for (int k = 0; k < 2; ++k) {
        const icc_chart_info info = info_of_chart(charts[k]);
        const icc_field_info own = field_info_of(charts[k]);
        ck_assert_int_eq(info.method, ICC_METHOD_FIELD);
        ck_assert(info.certified ==
                  (own.n_infeasible == 0 && own.n_not_inward == 0 && own.n_stray == 0));
        ck_assert((info.reason == ICC_REASON_NONE) == (info.certified == 1));
        ck_assert(own.n_not_inward <= own.n_contacts && own.n_contacts > 0);
        certified = certified && info.certified;
    }
    ck_assert_int_eq(icc_map_get_info(map, &whole), ICC_OK);
    /* Nothing here is so thin that digits would be lost between two charts. */
    ck_assert_int_eq(whole.certified, certified);
    ck_assert((whole.reason == ICC_REASON_NONE) == certified &&
              (whole.reason_side == 0) == certified);
    ck_assert_uint_eq(report_of(map).n_lost, 0);
    return certified;
}

/* Everything on a curve has its boundary point, and t rises along it. */
static void check_curve(const icc_chart *chart, const double *point, int32_t dim)
{
    enum { ROOM = 4000 };
    static double curve[ROOM * ICC_MAX_DIM];
    size_t n;
    uint32_t facet, first_facet;
    double bary[ICC_MAX_DIM], first[ICC_MAX_DIM], t, last = -1, start[ICC_MAX_DIM];
    icc_status status;
    ck_assert_int_eq(icc_chart_trace(chart, point, ROOM, curve, &n, NULL, NULL), ICC_OK);
    ck_assert(n >= 2 && n <= ROOM);
    ck_assert_int_eq(
        icc_chart_encode(chart, 1, point, &first_facet, first, &t, &status, NULL, NULL), ICC_OK);
    ck_assert_int_eq(status, ICC_OK);
    t = 0;
    ck_assert_int_eq(
        icc_chart_decode(chart, 1, &first_facet, first, &t, start, &status, NULL, NULL), ICC_OK);
    ck_assert(largest_difference((size_t)dim, start, curve) < 1e-9);
    for (size_t i = 1; i + 1 < n; ++i) {
        const double *x = curve + (size_t)dim * i;
        double from[ICC_MAX_DIM];
        ck_assert_int_eq(icc_chart_encode(chart, 1, x, &facet, bary, &t, &status, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        ck_assert(t > last - 1e-9);
        last = t;
        t = 0;
        ck_assert_int_eq(icc_chart_decode(chart, 1, &facet, bary, &t, from, &status, NULL, NULL),
                         ICC_OK);
        /* Curves come together uphill: a place there tells less about where it came from. */
        ck_assert(last > 0.9 || largest_difference((size_t)dim, start, from) < 1e-6);
    }
    const icc_chart_info info = info_of_chart(chart);
    ck_assert(largest_difference((size_t)dim, info.maximum, curve + (size_t)dim * (n - 1)) < 1e-12);
}

/* Positive, and what differences say but where a kink lies between. */
static void check_jacobians(random_source *r, const pair *p, const icc_map *map)
{
    const size_t dim = (size_t)p->dim;
    const double h = 1e-6;
    int n_close = 0;
    for (int i = 0; i < N_POINTS; ++i) {
        double x[ICC_MAX_DIM], jacobian[ICC_MAX_DIM * ICC_MAX_DIM], worst = 0, largest = 0;
        icc_status status;
        domain_random_point(r, p->source, x);
        ck_assert_int_eq(icc_map_jacobian(map, 1, x, jacobian, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        ck_assert(determinant(p->dim, jacobian) > 0);
        for (size_t j = 0; j < dim; ++j) {
            double low[ICC_MAX_DIM], high[ICC_MAX_DIM], y[ICC_MAX_DIM], z[ICC_MAX_DIM];
            memcpy(low, x, sizeof x);
            memcpy(high, x, sizeof x);
            low[j] -= h;
            high[j] += h;
            (void)icc_map_apply(map, 1, low, y, NULL, NULL, NULL);
            (void)icc_map_apply(map, 1, high, z, NULL, NULL, NULL);
            for (size_t k = 0; k < dim; ++k) {
                worst = fmax(worst, fabs((z[k] - y[k]) / (2 * h) - jacobian[dim * k + j]));
                largest = fmax(largest, fabs(jacobian[dim * k + j]));
            }
        }
        n_close += worst < 1e-5 * largest;
    }
    ck_assert_int_ge(n_close, N_POINTS * 95 / 100);
}

static void check_certified_map(random_source *r, const pair *p, const icc_map *map)
{
    ck_assert_uint_eq(count_lost(r, p, map, 1e-8), 0);
    check_boundary(r, p, map);
    check_jacobians(r, p, map);
    for (int i = 0; i < 5; ++i) {
        double x[ICC_MAX_DIM];
        domain_random_point(r, p->source, x);
        check_curve(icc_map_source_chart(map), x, p->dim);
    }
}

/* Points that are mapped together get the bits of points that are mapped one by one, failures
 * included. */
static void check_batch(random_source *r, const pair *p, const icc_map *map)
{
    static double points[N_POINTS * ICC_MAX_DIM], images[N_POINTS * ICC_MAX_DIM];
    static icc_status statuses[N_POINTS];
    const size_t dim = (size_t)p->dim;
    iccp_env env;
    iccp_path path;
    for (size_t i = 0; i < N_POINTS; ++i)
        domain_random_point(r, p->source, points + dim * i);
    points[dim * 20] = NAN;
    points[dim * 30] = 1e3;
    memcpy(points + dim * 40, p->from, dim * sizeof *points);
    ck_assert_int_eq(icc_map_apply(map, N_POINTS, points, images, statuses, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    iccp_path_init(&path, &env.memory);
    for (size_t i = 0; i < N_POINTS; ++i) {
        double image[ICC_MAX_DIM];
        const icc_status status =
            iccp_curves_point(icc_map_source_chart(map), icc_map_target_chart(map),
                              points + dim * i, image, NULL, &path);
        ck_assert_int_eq(statuses[i], status);
        if (status == ICC_OK)
            ck_assert_mem_eq(images + dim * i, image, dim * sizeof *image);
        else
            ck_assert(isnan(images[dim * i]));
    }
    ck_assert_int_eq(statuses[20], ICC_ERR_ARGUMENT);
    ck_assert_int_eq(statuses[30], ICC_ERR_OUTSIDE);
    iccp_path_clear(&path);
}

static surface shape;

START_TEST(certified_surfaces)
{
    random_source r = {11};
    int n_certified = 0;
    for (int round = 0; round < 6; ++round) {
        pair p;
        surface_star(&shape, 1 + round % 3, round < 3 ? 0 : 0.25, &r);
        pair_of_surface(&p, &shape);
        icc_map *map = make_map(&p, 20 + 4 * round);
        if (is_certified(map)) {
            ++n_certified;
            check_certified_map(&r, &p, map);
        } else {
            ck_assert_uint_le(count_lost(&r, &p, map, 1e-8), N_POINTS / 10);
        }
        icc_map_free(map);
        pair_free(&p);
    }
    ck_assert_int_ge(n_certified, 4);
}
END_TEST

/* The same boundary before and after: nothing moves. */
START_TEST(identity)
{
    random_source r = {12};
    pair p;
    surface_star(&shape, 2, 0.1, &r);
    pair_of_surface(&p, &shape);
    const icc_chart_options chart = {.size = sizeof chart, .method = ICC_METHOD_FIELD, .cells = 24};
    const icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, p.source, p.source, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_chart(icc_map_source_chart(map)).method, ICC_METHOD_FIELD);
    const icc_chart_info a = info_of_chart(icc_map_source_chart(map));
    const icc_chart_info b = info_of_chart(icc_map_target_chart(map));
    for (int i = 0; i < N_POINTS; ++i) {
        double x[3], y[3];
        domain_random_point(&r, p.source, x);
        ck_assert_int_eq(icc_map_apply(map, 1, x, y, NULL, NULL, NULL), ICC_OK);
        ck_assert(memcmp(a.maximum, b.maximum, sizeof a.maximum) != 0 ||
                  largest_difference(3, x, y) < 1e-10);
    }
    icc_map_free(map);
    pair_free(&p);
}
END_TEST

/* Faces listed the other way round: the same map. */
START_TEST(orientation_does_not_matter)
{
    random_source r = {13};
    pair p, q;
    surface_star(&shape, 2, 0.1, &r);
    pair_of_surface(&p, &shape);
    for (size_t f = 0; f < shape.n_faces; ++f) {
        const uint32_t first = shape.faces[3 * f];
        shape.faces[3 * f] = shape.faces[3 * f + 1];
        shape.faces[3 * f + 1] = first;
    }
    pair_of_surface(&q, &shape);
    icc_map *a = make_map(&p, 20), *b = make_map(&q, 20);
    ck_assert(is_certified(a) == is_certified(b));
    for (int i = 0; i < N_POINTS; ++i) {
        double x[3], y[3], z[3];
        domain_random_point(&r, p.source, x);
        ck_assert_int_eq(icc_map_apply(a, 1, x, y, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_apply(b, 1, x, z, NULL, NULL, NULL), ICC_OK);
        ck_assert(largest_difference(3, y, z) < 1e-9);
    }
    icc_map *wrong;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_map_create(&wrong, p.source, q.target, NULL, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert(wrong == NULL && err.side == 2);
    icc_map_free(a);
    icc_map_free(b);
    pair_free(&p);
    pair_free(&q);
}
END_TEST

/* Three cells round a corner, in every dimension. */
/* Bytes in use, and the most there have been. */
typedef struct meter {
    size_t now, most;
} meter;

enum { HEADER = 16 }; /* bytes before each block: its size, and what keeps it aligned */

static void *meter_alloc(void *user, size_t size)
{
    meter *m = user;
    char *block = malloc(size + HEADER);
    if (block == NULL)
        return NULL;
    memcpy(block, &size, sizeof size);
    m->now += size;
    m->most = m->now > m->most ? m->now : m->most;
    return block + HEADER;
}

static void meter_dealloc(void *user, void *memory)
{
    size_t size;
    memcpy(&size, (char *)memory - HEADER, sizeof size);
    ((meter *)user)->now -= size;
    free((char *)memory - HEADER);
}

/* What icc_chart_create() says. */
START_TEST(memory_is_as_stated)
{
    static surface s;
    surface_octahedron(&s);
    icc_domain *domain;
    ck_assert_int_eq(
        icc_domain_create(&domain, 3, s.n_vertices, s.vertices, s.n_faces, s.faces, NULL, NULL),
        ICC_OK);
    meter m = {0};
    const icc_env env = {
        .size = sizeof env, .user = &m, .alloc = meter_alloc, .dealloc = meter_dealloc};
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_FIELD, .cells = 64};
    icc_chart *chart;
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, &env, NULL), ICC_OK);
    const icc_field_info info = field_info_of(chart);
    const double vertices = (double)info.n_grid, rim = 150.0 * (double)info.n_contacts;
    ck_assert_double_le((double)m.now, 40 * vertices);
    ck_assert_double_le((double)m.most, 70 * vertices + rim);
    icc_chart_free(chart);
    ck_assert_uint_eq(m.now, 0);
    icc_domain_free(domain);
}
END_TEST

START_TEST(masks)
{
    random_source r = {14};
    for (int32_t dim = 2; dim <= 4; ++dim) {
        size_t shape_of[ICC_MAX_DIM], n = 1;
        uint8_t cells[16] = {0};
        pair p;
        for (int32_t k = 0; k < dim; ++k) {
            shape_of[k] = k < 2 ? 2 : 1;
            n *= shape_of[k];
        }
        for (size_t i = 0; i < n; ++i)
            cells[i] = i != 3;
        pair_of_mask(&p, dim, shape_of, cells);
        icc_map *map = make_map(&p, dim == 4 ? 8 : 16);
        const bool certified = is_certified(map);
        const size_t lost = count_lost(&r, &p, map, 1e-7);
        if (certified)
            ck_assert_uint_eq(lost, 0);
        ck_assert_uint_le(lost, N_POINTS / 20);
        check_boundary(&r, &p, map);
        check_batch(&r, &p, map);
        icc_map_free(map);
        pair_free(&p);
    }
}
END_TEST

/* Parts closer to each other than the grid's vertices: two plates, joined at one end. */
static int in_clip(int x, int y, int z)
{
    return x >= 0 && x < 8 && y >= 0 && y < 8 && z >= 0 && z < 5 && (z != 2 || x == 0);
}

START_TEST(thin_gaps)
{
    random_source r = {15};
    pair p;
    surface_cells(&shape, 8, in_clip);
    for (size_t v = 0; v < shape.n_vertices; ++v) {
        /* Two cells of the grid below: its vertices in the gap belong to both plates. */
        double *x = shape.vertices + 3 * v;
        x[2] = x[2] < 2.5 ? x[2] : x[2] - 0.7;
        for (int k = 0; k < 3; ++k)
            x[k] = x[k] / 8 + 0.001 * x[(k + 1) % 3];
    }
    pair_of_surface(&p, &shape);
    icc_map *map = make_map(&p, 60);
    ck_assert_uint_le(count_lost(&r, &p, map, 1e-8), N_POINTS / 50);
    const icc_chart *chart = icc_map_target_chart(map);
    icc_chart_report measures = {.size = sizeof measures};
    ck_assert_int_eq(icc_chart_get_report(chart, 1000, &measures, NULL, NULL), ICC_OK);
    ck_assert(measures.unreachable <= 0.02 && measures.not_inward <= 0.05);
    ck_assert(info_of_chart(chart).certified ||
              (measures.n_points > 100 && measures.n_boundary == 1000));
    ck_assert(measures.uncovered <= 0 && measures.collapsed <= 0);
    icc_map_free(map);
    pair_free(&p);
}
END_TEST

START_TEST(what_is_not_available_is_named)
{
    random_source r = {16};
    pair p;
    icc_error err = {.size = sizeof err};
    icc_map *map;
    icc_chart *chart;
    surface_star(&shape, 1, 0, &r);
    pair_of_surface(&p, &shape);
    const icc_chart_options grid = {.size = sizeof grid, .method = ICC_METHOD_FIELD, .cells = 12};
    const icc_map_options mesh = {.size = sizeof mesh, .kind = ICC_MAP_MESH, .chart = &grid};
    ck_assert_int_eq(icc_map_create(&map, p.source, p.target, &mesh, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    ck_assert(map == NULL && strstr(err.message, "kind 2") != NULL);
    for (int32_t method = ICC_METHOD_FOLIATION; method <= ICC_METHOD_DISC; method += 2) {
        const icc_chart_options options = {.size = sizeof options, .method = method};
        ck_assert_int_eq(icc_chart_create(&chart, p.source, &options, NULL, &err),
                         ICC_ERR_UNSUPPORTED);
        ck_assert(chart == NULL && strstr(err.message, "dimension 3") != NULL);
    }
    const double outside[3] = {2, 0, 0};
    const icc_chart_options wrong = {.size = sizeof wrong, .maximum = outside};
    ck_assert_int_eq(icc_chart_create(&chart, p.source, &wrong, NULL, &err), ICC_ERR_OUTSIDE);
    const double inside[3] = {0.2, 0.1, -0.1};
    const icc_chart_options right = {.size = sizeof right, .maximum = inside, .cells = 20};
    ck_assert_int_eq(icc_chart_create(&chart, p.source, &right, NULL, &err), ICC_OK);
    const icc_chart_info info = info_of_chart(chart);
    ck_assert(largest_difference(3, info.maximum, inside) <= 0.5 * info.spacing + 1e-12);
    ck_assert_ptr_nonnull(icc_chart_function(chart));
    icc_chart_free(chart);
    /* The first facet that differs. */
    const uint32_t first = p.facets[3 * 5];
    for (int k = 0; k < 2; ++k)
        p.facets[15 + k] = p.facets[16 + k];
    p.facets[17] = first;
    icc_domain *turned;
    ck_assert_int_eq(
        icc_domain_create(&turned, 3, p.n_vertices, p.to, p.n_facets, p.facets, NULL, &err),
        ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, p.source, turned, NULL, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert(err.index == 5 && err.side == 2 && strstr(err.message, "facet 5") != NULL);
    icc_domain_free(turned);
    pair_free(&p);
}
END_TEST

/* A ring about a hole, cut through by a slit that coarse grids do not see. */
static int in_ring_of_5(int x, int y, int z)
{
    const int hole = x == 2 && y == 2, slit = x == 2 && y > 2;
    return x >= 0 && x < 5 && y >= 0 && y < 5 && z >= 0 && z < 2 && !hole && !slit;
}

static int in_ring_of_3(int x, int y, int z)
{
    return x >= 0 && x < 3 && y >= 0 && y < 3 && z >= 0 && z < 1 && (x != 1 || y == 0);
}

/* Moves the walls of the slit, from x to x + 1 above y, to x + 0.55 and so much further. */
static icc_domain *narrow_slit(int (*in)(int x, int y, int z), double x, double y, double width)
{
    icc_domain *domain;
    surface_cells(&shape, 8, in);
    for (size_t v = 0; v < shape.n_vertices; ++v) {
        double *p = shape.vertices + 3 * v;
        if (p[1] > y && p[0] >= x && p[0] <= x + 1)
            p[0] = x + 0.55 + width * (p[0] - x);
    }
    ck_assert_int_eq(icc_domain_create(&domain, 3, shape.n_vertices, shape.vertices, shape.n_faces,
                                       shape.faces, NULL, NULL),
                     ICC_OK);
    return domain;
}

typedef struct listener {
    size_t n_lines;
    char line[200];
} listener;

static void listen(void *user, const char *message)
{
    listener *l = user;
    ++l->n_lines;
    snprintf(l->line, sizeof l->line, "%s", message);
}

/* The grid is refined where its vertices inside are no ball, and once only. */
START_TEST(slits_thinner_than_the_grid)
{
    listener heard = {0};
    const icc_env env = {.size = sizeof env, .user = &heard, .log = listen};
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_FIELD, .cells = 5};
    const icc_chart_options coarse = {
        .size = sizeof options, .method = ICC_METHOD_FIELD, .cells = 3};
    icc_chart_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    icc_chart *chart;
    icc_domain *domain = narrow_slit(in_ring_of_5, 2, 2.9, 0.8);
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, &env, &err), ICC_OK);
    ck_assert_int_eq(icc_chart_get_info(chart, &info), ICC_OK);
    ck_assert_int_eq(info.cells, 10);
    ck_assert_uint_eq(field_info_of(chart).n_stray, 0);
    ck_assert_uint_eq(heard.n_lines, 1);
    ck_assert(strstr(heard.line, "10 are tried") != NULL);
    icc_chart_free(chart);
    icc_domain_free(domain);

    domain = narrow_slit(in_ring_of_3, 1, 1.9, 0.01);
    heard.n_lines = 0;
    ck_assert_int_eq(icc_chart_create(&chart, domain, &coarse, &env, &err), ICC_ERR_TOPOLOGY);
    ck_assert_ptr_null(chart);
    ck_assert_uint_eq(heard.n_lines, 1);
    icc_domain_free(domain);
}
END_TEST

/* Real surfaces and masks, where they lie beside this tree. */
START_TEST(real_shapes)
{
    static const char *const NAMES[] = {"t01_cube_bend", "t06_spikes_sphere"};
    random_source r = {17};
    for (int i = 0; i < 2; ++i) {
        char path[1024];
        obj source, target;
        pair p = {.dim = 3};
        (void)snprintf(path, sizeof path, "%s/3d/%s.src.obj", TEST_SHARED_DATA, NAMES[i]);
        if (!obj_read(&source, path))
            return;
        (void)snprintf(path, sizeof path, "%s/3d/%s.tgt.obj", TEST_SHARED_DATA, NAMES[i]);
        ck_assert(obj_read(&target, path));
        p.n_vertices = source.n_vertices;
        p.n_facets = source.n_faces;
        p.from = source.vertices;
        p.to = target.vertices;
        p.facets = source.faces;
        ck_assert_int_eq(
            icc_domain_create(&p.source, 3, p.n_vertices, p.from, p.n_facets, p.facets, NULL, NULL),
            ICC_OK);
        ck_assert_int_eq(
            icc_domain_create(&p.target, 3, p.n_vertices, p.to, p.n_facets, p.facets, NULL, NULL),
            ICC_OK);
        icc_map *map = make_map(&p, 32);
        ck_assert(is_certified(map));
        ck_assert_uint_eq(count_lost(&r, &p, map, 1e-8), 0);
        check_boundary(&r, &p, map);
        check_jacobians(&r, &p, map);
        icc_map_free(map);
        pair_free(&p);
        obj_free(&(obj){.vertices = NULL, .faces = target.faces});
    }
}
END_TEST

/* A few contacts that are not inward deny the certificate to the grid by default only; a number of
 * cells that was asked for stays, but for one. */
START_TEST(other_grids_are_tried)
{
    const icc_chart_options open = {.size = sizeof open, .method = ICC_METHOD_FIELD};
    icc_chart_options asked = open;
    icc_chart_info info = {.size = sizeof info};
    icc_domain *domain;
    icc_chart *chart;
    obj source;
    if (!obj_read(&source, TEST_SHARED_DATA "/3d/t05_spot_twist.src.obj"))
        return;
    ck_assert_int_eq(icc_domain_create(&domain, 3, source.n_vertices, source.vertices,
                                       source.n_faces, source.faces, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_chart_create(&chart, domain, &open, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_get_info(chart, &info), ICC_OK);
    ck_assert_int_eq(info.certified, 1);
    ck_assert_uint_eq(field_info_of(chart).n_not_inward, 0);
    icc_chart_free(chart);
    asked.cells = 78;
    ck_assert_int_eq(icc_chart_create(&chart, domain, &asked, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_get_info(chart, &info), ICC_OK);
    ck_assert_int_eq(info.certified, 0);
    ck_assert_int_eq(info.reason, ICC_REASON_NOT_INWARD);
    ck_assert_int_eq(info.cells, 78);
    icc_chart_free(chart);
    icc_domain_free(domain);
    obj_free(&source);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("field");
    TCase *tests = tcase_create("field");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, certified_surfaces);
    tcase_add_test(tests, identity);
    tcase_add_test(tests, orientation_does_not_matter);
    tcase_add_test(tests, memory_is_as_stated);
    tcase_add_test(tests, masks);
    tcase_add_test(tests, thin_gaps);
    tcase_add_test(tests, slits_thinner_than_the_grid);
    tcase_add_test(tests, what_is_not_available_is_named);
    tcase_add_test(tests, real_shapes);
    tcase_add_test(tests, other_grids_are_tried);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
