/* What can be done with a polygon with features: asked, copied, saved; and what refuses it. */
#include "features.h"

#include "base/blob.h"
#include "domain/domain_file.h"
#include "domain/features.h"
#include "domain/network.h"
#include "icc/kernel.h"
#include "icc/stages.h"

#include "../../faulty.h"
#include "../../suite.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* A sound one, with all kinds of features. */
static const picture PLATE = {4,
                              {{0, 5, {{0, 0}, {24, 0}, {24, 24}, {12, 20}, {0, 24}}},
                               {ICC_FEATURE_LINE, 3, {{2, 2}, {6, 6}, {10, 2}}},
                               {ICC_FEATURE_HOLE, 4, {{14, 4}, {14, 8}, {20, 8}, {20, 4}}},
                               {ICC_FEATURE_POINT, 1, {{12, 12}}},
                               {ICC_FEATURE_HOLE, 3, {{3, 12}, {9, 12}, {6, 16}}}}};

static icc_domain *make(const picture *p, double scale, double x, double y)
{
    request q;
    icc_domain *domain;
    icc_error err;
    request_picture(&q, p, scale, x, y);
    ck_assert_msg(create(&domain, &q, NULL, &err) == ICC_OK, "%s", err.message);
    return domain;
}

static void reverse(chain *c)
{
    const chain old = *c;
    for (int i = 0; i < c->n; ++i)
        c->at[i] = old.at[c->n - 1 - i];
}

/* ------------------------------------------------------------------ reports */

START_TEST(info_and_boundary)
{
    icc_domain *domain = make(&PLATE, 1, 0, 0);
    icc_domain_info info = {.size = sizeof info};
    request q;
    double vertices[2 * 16];
    uint32_t facets[2 * 16];
    static const size_t first[] = {5, 8, 12, 13};
    static const uint32_t hole[] = {8, 9, 9, 10, 10, 11, 11, 8, 13, 14, 14, 15, 15, 13};
    request_picture(&q, &PLATE, 1, 0, 0);
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert_uint_eq(info.n_vertices, 16);
    ck_assert_uint_eq(info.n_facets, 5 + 4 + 3);
    ck_assert_uint_eq(info.n_features, 4);
    ck_assert_int_eq(info.orientation, 1);
    ck_assert(info.measure == 24 * 22 - 24 - 12);
    ck_assert(info.lower[0] == 0 && info.lower[1] == 0 && info.upper[0] == 24 &&
              info.upper[1] == 24);
    ck_assert_int_eq(icc_domain_get_boundary(domain, vertices, facets), ICC_OK);
    ck_assert_mem_eq(vertices, q.vertices, sizeof vertices);
    ck_assert_mem_eq(facets + 10, hole, sizeof hole);
    for (uint32_t k = 0; k < 5; ++k)
        ck_assert(facets[2 * k] == k && facets[2 * k + 1] == (k + 1) % 5);
    for (size_t f = 0; f < 4; ++f) {
        icc_feature_info feature = {.size = sizeof feature};
        ck_assert_int_eq(icc_domain_get_feature(domain, f, &feature), ICC_OK);
        ck_assert_int_eq(feature.kind, PLATE.chains[f + 1].kind);
        ck_assert_uint_eq(feature.n_vertices, (size_t)PLATE.chains[f + 1].n);
        ck_assert_uint_eq(feature.first_vertex, first[f]);
        ck_assert_uint_eq(feature.first_facet, f == 1 ? 5 : f == 3 ? 9 : 0);
        ck_assert_int_eq(feature.orientation, f == 1 ? -1 : f == 3);
    }
    icc_feature_info feature = {.size = sizeof feature};
    ck_assert_int_eq(icc_domain_get_feature(domain, 4, &feature), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_get_feature(domain, 0, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_get_feature(NULL, 0, &feature), ICC_ERR_ARGUMENT);
    icc_domain_free(domain);
}
END_TEST

/* Behind the boundary, domain->facets has lines and points: every place of every feature. */
START_TEST(places)
{
    icc_domain *domain = make(&PLATE, 1, 0, 0);
    const iccp_features *features = domain->features;
    ck_assert_uint_eq(features->n_places, 12 + 2 + 1);
    ck_assert_uint_eq(features->n_outer, 5);
    ck_assert(features->n_holes == 2 && features->n_lines == 1 && features->n_points == 1);
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *feature = &features->item[f];
        const chain *c = &PLATE.chains[f + 1];
        ck_assert_uint_eq(feature->n_facets, (uint32_t)count_edges(c));
        for (uint32_t e = 0; e < feature->n_facets; ++e)
            for (int end = 0; end < 2; ++end) {
                const double bary[2] = {end == 0, end == 1};
                const spot expected = corner(c, (int)e + end);
                double at[2];
                iccp_domain_facet_point(domain, feature->first_facet + e, bary, at);
                iccp_frame_out(&domain->frame, 2, at, at);
                ck_assert(at[0] == (double)expected.x && at[1] == (double)expected.y);
            }
    }
    icc_domain_free(domain);
}
END_TEST

/* No features: the domain of icc_domain_create(). */
START_TEST(no_features)
{
    static const double outer[] = {0, 0, 2, 0, 2, 1};
    icc_domain *domain;
    icc_domain_info info = {.size = sizeof info};
    icc_feature_info feature = {.size = sizeof feature};
    ck_assert_int_eq(icc_domain_create_features(&domain, 3, outer, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert(info.n_features == 0 && info.measure == 1 && domain->locator != NULL);
    ck_assert_int_eq(icc_domain_get_feature(domain, 0, &feature), ICC_ERR_ARGUMENT);
    icc_domain_free(domain);
}
END_TEST

/* ----------------------------------------------------------------- locating */

/* Whether the domain is on one side of an edge only. */
static bool is_rim(const picture *p, spot a, spot b)
{
    return (count_left(p, a, b) > 0) != (count_left(p, b, a) > 0);
}

static int32_t slow_where(const picture *p, spot at)
{
    bool on_edge = false;
    for (int i = 0; i <= p->n; ++i)
        for (int e = 0; e < count_edges(&p->chains[i]); ++e) {
            const spot a = corner(&p->chains[i], e), b = corner(&p->chains[i], e + 1);
            on_edge |= on(a, b, at);
            if (is_ring(&p->chains[i]) && on(a, b, at) && is_rim(p, a, b))
                return ICC_BOUNDARY;
        }
    return on_edge || count_left(p, at, at) > 0 ? ICC_INSIDE : ICC_OUTSIDE;
}

static double distance_to(const double *a, const double *b, const double *p)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]}, w[2] = {p[0] - a[0], p[1] - a[1]};
    double t = (w[0] * d[0] + w[1] * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(w[0] - t * d[0], w[1] - t * d[1]);
}

/* All points of the grid and the middles of its cells, whose coordinates are doubled here. */
static void check_points(const icc_domain *domain, const picture *doubled, double scale, double x,
                         double y)
{
    static double vertices[2 * MAX_CHAIN * (MAX_FEATURES + 1)];
    static uint32_t facets[2 * MAX_CHAIN * (MAX_FEATURES + 1)];
    icc_domain_info info = {.size = sizeof info};
    ck_assert(icc_domain_get_info(domain, &info) == ICC_OK);
    ck_assert(icc_domain_get_boundary(domain, vertices, facets) == ICC_OK);
    for (int i = -2; i < 2 * SIDE + 3; ++i)
        for (int j = -2; j < 2 * SIDE + 3; ++j) {
            const double p[2] = {scale * i + x, scale * j + y};
            const int32_t expected = slow_where(doubled, (spot){i, j});
            int32_t where[2];
            uint32_t facet;
            double bary[2], nearest = HUGE_VAL, at[2];
            ck_assert(icc_domain_locate(domain, 1, p, &where[0], &facet, bary, NULL) == ICC_OK);
            ck_assert(icc_domain_locate(domain, 1, p, &where[1], NULL, NULL, NULL) == ICC_OK);
            ck_assert(where[0] == expected && where[1] == expected && facet < info.n_facets);
            for (size_t f = 0; f < info.n_facets; ++f)
                if (iccp_network_is_rim(domain->features->network, (uint32_t)f))
                    nearest = fmin(nearest, distance_to(vertices + 2 * facets[2 * f],
                                                        vertices + 2 * facets[2 * f + 1], p));
            for (int k = 0; k < 2; ++k)
                at[k] = bary[0] * vertices[2 * facets[2 * facet] + (uint32_t)k] +
                        bary[1] * vertices[2 * facets[2 * facet + 1] + (uint32_t)k];
            const double tolerance = 1e-13 * (scale * SIDE + fabs(x) * 1e-2);
            ck_assert(fabs(hypot(at[0] - p[0], at[1] - p[1]) - nearest) <= tolerance);
        }
}

static picture twice(const picture *p)
{
    picture doubled = *p;
    for (int i = 0; i <= p->n; ++i)
        for (int k = 0; k < p->chains[i].n; ++k)
            doubled.chains[i].at[k] = (spot){2 * p->chains[i].at[k].x, 2 * p->chains[i].at[k].y};
    return doubled;
}

START_TEST(locating)
{
    static const double scales[] = {1, 0x1p-10, 0x1p20}, offsets[] = {0, 1e9};
    random_source r = {2};
    picture p = PLATE;
    for (int round = 0; round < share_of(200); ++round) {
        const picture doubled = twice(&p);
        const double scale = scales[round % 3], offset = offsets[round % 2];
        icc_domain *domain = make(&doubled, scale, offset, -offset);
        check_points(domain, &doubled, scale, offset, -offset);
        icc_domain_free(domain);
        do
            random_picture(&p, &r);
        while (!is_sound(&p));
    }
}
END_TEST

/* Other starts, senses, sizes and places: the same domain. */
START_TEST(invariance)
{
    icc_domain_info info = {.size = sizeof info};
    for (int reversed = 0; reversed < 32; ++reversed) {
        picture p = PLATE;
        for (int i = 0; i <= p.n; ++i)
            if (reversed >> i & 1)
                reverse(&p.chains[i]);
        for (int k = -20; k <= 20; k += 10) {
            const double scale = ldexp(1, k);
            icc_domain *domain = make(&p, scale, 1e9, -1e9);
            ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
            ck_assert_int_eq(info.orientation, reversed & 1 ? -1 : 1);
            ck_assert(info.measure == scale * scale * (24 * 22 - 24 - 12));
            icc_feature_info hole = {.size = sizeof hole};
            ck_assert_int_eq(icc_domain_get_feature(domain, 3, &hole), ICC_OK);
            ck_assert_int_eq(hole.orientation, reversed & 16 ? -1 : 1);
            icc_domain_free(domain);
        }
    }
}
END_TEST

/* ------------------------------------------------------------------- bytes */

static size_t save(const icc_domain *domain, unsigned char *bytes, size_t capacity)
{
    icc_domain *written = (icc_domain *)domain;
    iccp_blob b;
    size_t n;
    iccp_blob_begin(&b, bytes, capacity, "TEST", 1);
    ck_assert_int_eq(iccp_domain_visit_any(&b, &written, NULL), ICC_OK);
    iccp_blob_end(&b, &n);
    ck_assert_uint_le(n, capacity);
    return n;
}

/* With the header put right. */
static icc_status load(icc_domain **out, unsigned char *bytes, size_t n, bool any)
{
    iccp_env env;
    iccp_blob b;
    size_t written;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    iccp_blob_begin(&b, bytes, n, "TEST", 1);
    b.at = n;
    iccp_blob_end(&b, &written);
    ck_assert_int_eq(iccp_blob_open(&b, bytes, n, "TEST", 1, &env.memory, NULL), ICC_OK);
    const icc_status status =
        any ? iccp_domain_visit_any(&b, out, &env) : iccp_domain_visit(&b, out, &env);
    if (status == ICC_OK && !iccp_blob_done(&b)) {
        icc_domain_free(*out);
        *out = NULL;
        return ICC_ERR_FORMAT;
    }
    return status;
}

enum { CAPACITY = 1024, HEADER = 24 };

START_TEST(saved)
{
    static unsigned char bytes[CAPACITY], again[CAPACITY];
    request q;
    icc_error err;
    icc_domain *domain, *other;
    request_picture(&q, &PLATE, 1, 0, 0);
    q.vertices[1] = -0.0;
    ck_assert_int_eq(create(&domain, &q, NULL, &err), ICC_OK);
    const size_t n = save(domain, bytes, CAPACITY);
    ck_assert_uint_eq(n, HEADER + 8 + 16 + 4 * 8 + 16 * 16);
    ck_assert_int_eq(load(&other, bytes, n, true), ICC_OK);
    ck_assert_uint_eq(save(other, again, CAPACITY), n);
    ck_assert_mem_eq(again, bytes, n);
    ck_assert_mem_eq(other->facets, domain->facets, 2 * 15 * sizeof *domain->facets);
    ck_assert_mem_eq(other->vertices, domain->vertices, 2 * 16 * sizeof *domain->vertices);
    ck_assert_mem_eq(other->features->item, domain->features->item,
                     4 * sizeof *domain->features->item);
    icc_domain_free(other);
    /* What cannot have features does not take them. */
    ck_assert_int_eq(load(&other, bytes, n, false), ICC_ERR_FORMAT);
    ck_assert_ptr_null(other);
    icc_domain_free(domain);
}
END_TEST

/* Every single change of a number is refused, or is another domain. */
START_TEST(forged)
{
    static const uint32_t values[] = {0, 1, 2, 3, 4, 5, 1000, INT32_MAX, UINT32_MAX};
    static unsigned char bytes[CAPACITY], again[CAPACITY];
    icc_domain *domain = make(&PLATE, 1, 0, 0), *other;
    const size_t n = save(domain, bytes, CAPACITY);
    icc_domain_free(domain);
    for (size_t at = HEADER; at < n; at += 4)
        for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
            memcpy(again, bytes, n);
            for (int byte = 0; byte < 4; ++byte)
                again[at + (size_t)byte] = (unsigned char)(values[i] >> (8 * byte));
            const bool same_bytes = memcmp(again + HEADER, bytes + HEADER, n - HEADER) == 0;
            const icc_status status = load(&other, again, n, true);
            ck_assert(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_BOUNDARY ||
                      status == ICC_ERR_OUTSIDE);
            ck_assert((other != NULL) == (status == ICC_OK));
            ck_assert(status == ICC_OK || !same_bytes);
            /* A line of three vertices may become a hole, but counts are what they are. */
            ck_assert(status != ICC_OK || same_bytes || at >= HEADER + 8 + 16);
            icc_domain_free(other);
        }
    for (size_t size = HEADER; size < n; ++size) {
        memcpy(again, bytes, n);
        ck_assert_int_ne(load(&other, again, size, true), ICC_OK);
        ck_assert_ptr_null(other);
    }
}
END_TEST

/* ---------------------------------------------------------------- refusals */

static void check_refusal(icc_status status, const icc_error *err)
{
    ck_assert_int_eq(status, ICC_ERR_UNSUPPORTED);
    ck_assert_msg(strstr(err->message, "holes, lines or points") != NULL, "%s", err->message);
}

START_TEST(refusals)
{
    icc_domain *domain = make(&PLATE, 1, 0, 0);
    icc_error err = {.size = sizeof err};
    for (int32_t method = 0; method <= ICC_METHOD_DISC; ++method) {
        const icc_chart_options options = {.size = sizeof options, .method = method};
        icc_chart *chart;
        check_refusal(icc_chart_create(&chart, domain, &options, NULL, &err), &err);
        ck_assert_ptr_null(chart);
    }
    icc_grid *grid;
    check_refusal(icc_grid_create(&grid, domain, 0, NULL, &err), &err);
    ck_assert_ptr_null(grid);
    const icc_domain *const regions[] = {domain};
    icc_shape *shape;
    check_refusal(icc_shape_create(&shape, 2, 1, regions, 0, NULL, 0, NULL, NULL, &err), &err);
    ck_assert_ptr_null(shape);
    ck_assert_int_eq(err.index, 0);
    ck_assert_int_eq(err.item, ICC_ITEM_REGION);
    icc_domain_free(domain);
}
END_TEST

static void exchange(picture *p, int f, int g)
{
    const chain c = p->chains[f];
    p->chains[f] = p->chains[g];
    p->chains[g] = c;
}

/* A map from one to the other. */
static icc_status map_between(const picture *from, const picture *to, icc_error *err)
{
    icc_domain *source = make(from, 1, 0, 0), *target = make(to, 1, 0, 0);
    icc_map *map;
    *err = (icc_error){.size = sizeof *err, .index = -1};
    const icc_status status = icc_map_create(&map, source, target, NULL, NULL, err);
    ck_assert((map != NULL) == (status == ICC_OK));
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

static void check_unlike(const picture *to, int64_t feature, const char *message)
{
    icc_error err;
    ck_assert_int_eq(map_between(&PLATE, to, &err), ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.side, 2);
    ck_assert_int_eq(err.index, feature);
    ck_assert_int_eq(err.item, feature >= 0 ? ICC_ITEM_FEATURE : ICC_ITEM_NONE);
    ck_assert_msg(strstr(err.message, message) != NULL, "%s", err.message);
}

/* Features i of both sides are alike, whatever their order; counts of vertices and facets alone do
 * not tell. */
START_TEST(correspondence)
{
    icc_error err;
    picture p = PLATE;
    reverse(&p.chains[2]);
    check_unlike(&p, 1, "turn the same way");
    p = PLATE;
    exchange(&p, 1, 4);
    check_unlike(&p, 0, "is a hole of 3 vertices, but in the source a line of 3");
    p = PLATE;
    exchange(&p, 2, 4);
    check_unlike(&p, 1, "is a hole of 3 vertices, but in the source a hole of 4");
    const picture split = {5,
                           {PLATE.chains[0],
                            {ICC_FEATURE_POINT, 1, {{2, 2}}},
                            {ICC_FEATURE_LINE, 2, {{6, 6}, {10, 2}}},
                            PLATE.chains[2],
                            PLATE.chains[3],
                            PLATE.chains[4]}};
    check_unlike(&split, 0,
                 "target: feature 0 (a point) has no partner in the source, which has 4 features "
                 "instead of 5");
    ck_assert_int_eq(map_between(&split, &PLATE, &err), ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.side, 1);
    ck_assert_ptr_nonnull(strstr(err.message, "source: feature 0 (a point) has no partner in the"));
    for (int f = 1; f <= PLATE.n; ++f)
        for (int g = f; g <= PLATE.n; ++g) {
            p = PLATE;
            exchange(&p, f, g);
            ck_assert_msg(map_between(&p, &p, &err) == ICC_OK, "%s", err.message);
        }
}
END_TEST

static icc_status create_one(int32_t kind, size_t n, const double *vertices, icc_error *err)
{
    static const double outer[] = {0, 0, 9, 0, 9, 9, 0, 9};
    const icc_feature features[2] = {
        {sizeof(icc_feature), ICC_FEATURE_POINT, 1, (const double[]){8, 8}, 0, 0, NULL},
        {sizeof(icc_feature), kind, n, vertices, 0, 0, NULL}};
    icc_domain *domain = (icc_domain *)&err;
    const icc_status status = icc_domain_create_features(&domain, 4, outer, 2, features, NULL, err);
    ck_assert((domain != NULL) == (status == ICC_OK));
    icc_domain_free(domain);
    return status;
}

START_TEST(arguments)
{
    static const double some[] = {1, 1, 2, 1, 2, 2};
    static const struct {
        int32_t kind;
        size_t n;
    } wrong[] = {{0, 1},
                 {4, 1},
                 {-1, 1},
                 {1, 2},
                 {1, 0},
                 {2, 1},
                 {2, 0},
                 {3, 0},
                 {3, 2},
                 {1, SIZE_MAX},
                 {2, SIZE_MAX / 2},
                 {1, (size_t)(UINT64_C(1) << 40)}};
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        ck_assert_int_eq(create_one(wrong[i].kind, wrong[i].n, some, &err), ICC_ERR_ARGUMENT);
        ck_assert_int_eq(err.item, ICC_ITEM_FEATURE);
        ck_assert_int_eq(err.index, 1);
        ck_assert_ptr_nonnull(strstr(err.message, "feature 1"));
    }
    ck_assert_int_eq(create_one(1, 3, NULL, &err), ICC_ERR_ARGUMENT);
    for (int32_t kind = 1; kind <= 3; ++kind)
        ck_assert_int_eq(create_one(kind, (size_t)(4 - kind), some, &err), ICC_OK);
    const icc_feature feature = {sizeof feature, ICC_FEATURE_POINT, 1, some, 0, 0, NULL};
    ck_assert_int_eq(icc_domain_create_features(NULL, 3, some, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_features(&domain, 3, NULL, 1, &feature, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_features(&domain, 3, some, 1, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_features(&domain, 3, some, SIZE_MAX, &feature, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_features(&domain, SIZE_MAX, some, 1, &feature, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_features(&domain, 2, some, 1, &feature, NULL, &err),
                     ICC_ERR_BOUNDARY);
}
END_TEST

/* Callers of another version, whose features are larger. */
START_TEST(sizes)
{
    typedef struct later {
        icc_feature known;
        double unknown;
    } later;
    static const double outer[] = {0, 0, 9, 0, 9, 9, 0, 9}, points[] = {1, 1, 2, 2};
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    later two[2] = {{{sizeof(later), ICC_FEATURE_POINT, 1, points, 0, 0, NULL}, 0},
                    {{sizeof(later), ICC_FEATURE_POINT, 1, points + 2, 0, 0, NULL}, 0}};
    const icc_feature *features = &two[0].known;
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, outer, 2, features, NULL, &err),
                     ICC_OK);
    icc_domain_free(domain);
    two[1].unknown = 1;
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, outer, 2, features, NULL, &err),
                     ICC_ERR_VERSION);
    two[1].unknown = 0;
    two[1].known.size = sizeof(icc_feature);
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, outer, 2, features, NULL, &err),
                     ICC_ERR_ARGUMENT);
    two[0].known.size = 0;
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, outer, 2, features, NULL, &err),
                     ICC_ERR_ARGUMENT);
}
END_TEST

/* ------------------------------------------------------------------- radius */

static const double SQUARE[] = {0, 0, 10, 0, 10, 10, 0, 10};

/* Two points, the second one with a radius, then a line. */
static icc_status create_sized(icc_domain **out, double radius, const icc_env *env, icc_error *err)
{
    static const double at[] = {2, 2, 5, 7, 8, 2, 9, 2};
    const icc_feature features[] = {
        {sizeof(icc_feature), ICC_FEATURE_POINT, 1, at, 0, 0, NULL},
        {sizeof(icc_feature), ICC_FEATURE_POINT, 1, at + 2, radius, 0, NULL},
        {sizeof(icc_feature), ICC_FEATURE_LINE, 2, at + 4, 0, 0, NULL}};
    return icc_domain_create_features(out, 4, SQUARE, 3, features, env, err);
}

static icc_status create_sized_once(const icc_env *env, icc_error *err, void *unused)
{
    icc_domain *domain;
    (void)unused;
    const icc_status status = create_sized(&domain, 2, env, err);
    icc_domain_free(domain);
    return status;
}

START_TEST(circles)
{
    icc_domain *small, *large;
    icc_domain_info info = {.size = sizeof info};
    icc_feature_info rim = {.size = sizeof rim};
    icc_map *map;
    icc_map_info made = {.size = sizeof made};
    double vertices[2 * (4 + 4 + 16)];
    ck_assert_int_eq(create_sized(&small, 1, NULL, NULL), ICC_OK);
    ck_assert_int_eq(create_sized(&large, 2.5, NULL, NULL), ICC_OK);
    icc_domain_get_info(small, &info);
    ck_assert_uint_eq(info.n_features, 4);
    ck_assert_uint_eq(info.n_vertices, 4 + 4 + 16);
    ck_assert_int_eq(icc_domain_get_feature(small, 3, &rim), ICC_OK);
    ck_assert_int_eq(rim.kind, ICC_FEATURE_LINE);
    ck_assert_uint_eq(rim.first_vertex, 8);
    ck_assert_uint_eq(rim.n_vertices, 16);
    ck_assert_int_eq(icc_domain_get_boundary(small, vertices, NULL), ICC_OK);
    ck_assert(vertices[16] == 6 && vertices[17] == 7);
    for (int i = 0; i < 16; ++i) {
        const double angle = atan2(vertices[17 + 2 * i] - 7, vertices[16 + 2 * i] - 5);
        ck_assert(fabs(hypot(vertices[16 + 2 * i] - 5, vertices[17 + 2 * i] - 7) - 1) < 1e-15);
        ck_assert(fabs(remainder(angle - i * acos(-1) / 8, 2 * acos(-1))) < 1e-15);
    }
    ck_assert_int_eq(icc_map_create(&map, small, large, NULL, NULL, NULL), ICC_OK);
    icc_map_get_info(map, &made);
    ck_assert_int_eq(made.certified, 1);
    ck_assert_uint_eq(made.n_points, 2);
    const double on[] = {6, 7, 5, 8, 5, 7, 2, 2}, expected[] = {7.5, 7, 5, 9.5, 5, 7, 2, 2};
    double images[8];
    ck_assert_int_eq(icc_map_apply(map, 4, on, images, NULL, NULL, NULL), ICC_OK);
    for (int i = 0; i < 8; ++i)
        ck_assert_msg(fabs(images[i] - expected[i]) < 1e-14, "%d: %.17g", i, images[i]);
    icc_map_free(map);
    icc_domain_free(small);
    icc_domain_free(large);
    faulty_sweep(create_sized_once, NULL);
}
END_TEST

START_TEST(wrong_circles)
{
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    const double wrong[] = {-1, -0x1p-1074, NAN, INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        ck_assert_int_eq(create_sized(&domain, wrong[i], NULL, &err), ICC_ERR_ARGUMENT);
        ck_assert_int_eq(err.item, ICC_ITEM_FEATURE);
        ck_assert_int_eq(err.index, 1);
        ck_assert_ptr_null(domain);
    }
    const icc_feature line = {sizeof line, ICC_FEATURE_LINE, 2, SQUARE, 1, 0, NULL};
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, SQUARE, 1, &line, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(create_sized(&domain, 3.5, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.index, 3);
    ck_assert_int_ne(create_sized(&domain, DBL_MAX, NULL, &err), ICC_OK);
    /* It must surround its point visibly. */
    ck_assert_int_eq(create_sized(&domain, 0x1p-1074, NULL, &err), ICC_ERR_BOUNDARY);
}
END_TEST

/* --------------------------------------------------------- memory, progress */

/* Makes one, or gets an error that says what is wrong with it. */
static icc_status make_once(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *domain;
    const icc_status status = create(&domain, argument, env, err);
    icc_domain_free(domain);
    return status == ICC_ERR_BOUNDARY ? ICC_OK : status;
}

START_TEST(memory_and_cancel)
{
    request q;
    picture p = PLATE;
    request_picture(&q, &p, 1, 0, 0);
    faulty_sweep(make_once, &q);
    p.chains[4].at[0] = (spot){12, 12};
    request_picture(&q, &p, 1, 0, 0);
    faulty_sweep(make_once, &q);
    p.chains[2].at[3] = (spot){17, 10};
    request_picture(&q, &p, 1, 0, 0);
    faulty_sweep(make_once, &q);
}
END_TEST

int main(void)
{
    TCase *checks = tcase_create("features_use");
    tcase_add_test(checks, info_and_boundary);
    tcase_add_test(checks, places);
    tcase_add_test(checks, no_features);
    tcase_add_test(checks, locating);
    tcase_add_test(checks, invariance);
    tcase_add_test(checks, saved);
    tcase_add_test(checks, forged);
    tcase_add_test(checks, refusals);
    tcase_add_test(checks, correspondence);
    tcase_add_test(checks, arguments);
    tcase_add_test(checks, sizes);
    tcase_add_test(checks, circles);
    tcase_add_test(checks, wrong_circles);
    tcase_add_test(checks, memory_and_cancel);
    tcase_set_timeout(checks, 120);
    Suite *suite = suite_create("features_use");
    suite_add_tcase(suite, checks);
    return suite_run(suite);
}
