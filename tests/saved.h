/* Charts and maps that were saved and loaded, compared with the first ones: bit for bit. */
#ifndef TESTS_SAVED_H
#define TESTS_SAVED_H

#include "flat_mesh.h"
#include "infos.h"
#include "random.h"
#include "reports.h"

#include "base/blob.h"

#include <check.h>
#include <icc/icc.h>
#include <stdlib.h>
#include <string.h>

enum { SAVED_POINTS = 160 };

typedef struct bytes {
    size_t n;
    unsigned char *data;
} bytes;

static inline void *saved_alloc(size_t n)
{
    void *memory = calloc(n + 1, 1);
    ck_assert_ptr_nonnull(memory);
    return memory;
}

static inline bytes chart_bytes(const icc_chart *chart)
{
    bytes b = {0};
    size_t again;
    ck_assert_int_eq(icc_chart_save(chart, 0, NULL, &b.n), ICC_OK);
    b.data = saved_alloc(b.n);
    ck_assert_int_eq(icc_chart_save(chart, b.n, b.data, &again), ICC_OK);
    ck_assert_uint_eq(again, b.n);
    return b;
}

static inline bytes map_bytes(const icc_map *map)
{
    bytes b = {0};
    size_t again;
    ck_assert_int_eq(icc_map_save(map, 0, NULL, &b.n), ICC_OK);
    b.data = saved_alloc(b.n);
    ck_assert_int_eq(icc_map_save(map, b.n, b.data, &again), ICC_OK);
    ck_assert_uint_eq(again, b.n);
    return b;
}

/* With length and checksum put right; the version stays, which is less than 256. */
static inline void repair_bytes(bytes *b, const char *kind)
{
    iccp_blob w;
    size_t n;
    iccp_blob_begin(&w, b->data, b->n, kind, b->data[8]);
    w.at = b->n;
    iccp_blob_end(&w, &n);
}

static inline void put64(bytes *b, size_t at, uint64_t value)
{
    for (size_t i = 0; i < 8 && at + i < b->n; ++i)
        b->data[at + i] = (unsigned char)(value >> 8 * i);
}

/* Copies the bytes with content that is made up: one number or one bit is another, and the checksum
 * is right. */
static inline void make_up_content(bytes *changed, const bytes *b, const char *kind,
                                   random_source *r)
{
    static const uint64_t VALUES[] = {0,
                                      1,
                                      UINT64_MAX,
                                      (uint64_t)1 << 32,
                                      (uint64_t)1 << 63,
                                      0x7ff8000000000000u,
                                      0x7ff0000000000000u,
                                      0x7fefffffffffffffu,
                                      0x3ff0000000000000u,
                                      1000000};
    const size_t at = 24 + 4 * (size_t)random_below(r, (int)(b->n - 24) / 4);
    memcpy(changed->data, b->data, b->n);
    if (random_below(r, 2) == 0)
        put64(changed, at, VALUES[random_below(r, 10)]);
    else
        changed->data[at + (size_t)random_below(r, 4)] ^= (unsigned char)(1 << random_below(r, 8));
    repair_bytes(changed, kind);
}

/* Loads an object, and frees it. */
typedef icc_status load_call(const bytes *b, icc_error *err);

/* Neither a part of the bytes is loaded, nor what has another bit. */
static inline void check_damage(bytes *b, load_call *load)
{
    icc_error err = {.size = sizeof err};
    for (size_t n = 0; n < b->n; n += n < 100 ? 1 : 37)
        ck_assert_int_eq(load(&(bytes){n, b->data}, &err), ICC_ERR_FORMAT);
    for (size_t i = 0; i < b->n; ++i) {
        b->data[i] ^= 0x10;
        err.message[0] = '\0';
        ck_assert_int_eq(load(b, &err), ICC_ERR_FORMAT);
        ck_assert(err.message[0] != '\0');
        b->data[i] ^= 0x10;
    }
}

static inline void ck_assert_same(const void *a, const void *b, size_t size, const char *what)
{
    ck_assert_msg(memcmp(a, b, size) == 0, "%s differs", what);
}

/* Random points in the box of a domain and around it, some of its vertices, and middles of two. */
static inline void saved_points(const icc_domain *domain, uint64_t seed, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    random_source r = {seed};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    const size_t dim = (size_t)info.dim;
    double *vertices = saved_alloc(info.n_vertices * dim * sizeof *vertices);
    ck_assert_int_eq(icc_domain_get_boundary(domain, vertices, NULL), ICC_OK);
    for (size_t i = 0; i < SAVED_POINTS; ++i) {
        const double *a = vertices + dim * (size_t)random_below(&r, (int)info.n_vertices);
        const double *b = vertices + dim * (size_t)random_below(&r, (int)info.n_vertices);
        for (size_t k = 0; k < dim; ++k) {
            const double more = 0.05 * (info.upper[k] - info.lower[k]);
            const double x = random_between(&r, info.lower[k] - more, info.upper[k] + more);
            points[dim * i + k] = i % 8 == 0 ? a[k] : i % 8 == 1 ? 0.5 * a[k] + 0.5 * b[k] : x;
        }
    }
    free(vertices);
}

static inline void same_domain(const icc_domain *a, const icc_domain *b)
{
    icc_domain_info x = {.size = sizeof x}, y = {.size = sizeof y};
    ck_assert_int_eq(icc_domain_get_info(a, &x), ICC_OK);
    ck_assert_int_eq(icc_domain_get_info(b, &y), ICC_OK);
    ck_assert_same(&x, &y, sizeof x, "info of the domain");
    const size_t n = x.n_vertices * (size_t)x.dim, n_ends = x.n_facets * (size_t)x.dim;
    double *vertices = saved_alloc(2 * n * sizeof *vertices);
    uint32_t *facets = saved_alloc(2 * n_ends * sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(a, vertices, facets), ICC_OK);
    ck_assert_int_eq(icc_domain_get_boundary(b, vertices + n, facets + n_ends), ICC_OK);
    ck_assert_same(vertices, vertices + n, n * sizeof *vertices, "boundary");
    ck_assert_same(facets, facets + n_ends, n_ends * sizeof *facets, "facets");
    free(vertices);
    free(facets);
    double points[SAVED_POINTS * ICC_MAX_DIM], bary[2][SAVED_POINTS * ICC_MAX_DIM] = {{0}};
    int32_t where[2][SAVED_POINTS];
    uint32_t facet[2][SAVED_POINTS];
    saved_points(a, 7, points);
    ck_assert_int_eq(icc_domain_locate(a, SAVED_POINTS, points, where[0], facet[0], bary[0], NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_domain_locate(b, SAVED_POINTS, points, where[1], facet[1], bary[1], NULL),
                     ICC_OK);
    ck_assert_same(where[0], where[1], sizeof where[0], "where");
    ck_assert_same(facet[0], facet[1], sizeof facet[0], "nearest facet");
    ck_assert_same(bary[0], bary[1], sizeof bary[0], "nearest point");
}

/* Everything that a chart says of itself, but for times; what its method does not have is 0. */
typedef struct chart_facts {
    icc_chart_info common;
    icc_gradient_info gradient;
    icc_field_info field;
    icc_foliation_info foliation;
    icc_shelling_info shelling;
    icc_disc_info disc;
    size_t n_mesh_vertices, n_mesh_boundary, n_mesh_simplices;
} chart_facts;

static inline void read_facts(const icc_chart *chart, chart_facts *s)
{
    memset(s, 0, sizeof *s);
    s->common.size = sizeof s->common;
    s->gradient.size = sizeof s->gradient;
    s->field.size = sizeof s->field;
    s->foliation.size = sizeof s->foliation;
    s->shelling.size = sizeof s->shelling;
    s->disc.size = sizeof s->disc;
    ck_assert_int_eq(icc_chart_get_info(chart, &s->common), ICC_OK);
    int n_methods = 0;
    n_methods += icc_chart_get_gradient_info(chart, &s->gradient) == ICC_OK;
    n_methods += icc_chart_get_field_info(chart, &s->field) == ICC_OK;
    n_methods += icc_chart_get_foliation_info(chart, &s->foliation) == ICC_OK;
    n_methods += icc_chart_get_shelling_info(chart, &s->shelling) == ICC_OK;
    n_methods += icc_chart_get_disc_info(chart, &s->disc) == ICC_OK;
    ck_assert_int_eq(n_methods, 1);
    s->n_mesh_vertices =
        s->foliation.n_mesh_vertices + s->shelling.n_mesh_vertices + s->disc.n_mesh_vertices;
    s->n_mesh_boundary =
        s->foliation.n_mesh_boundary + s->shelling.n_mesh_boundary + s->disc.n_mesh_boundary;
    s->n_mesh_simplices =
        s->foliation.n_mesh_simplices + s->shelling.n_mesh_simplices + s->disc.n_mesh_simplices;
}

static inline chart_facts facts_of(const icc_chart *chart)
{
    chart_facts s;
    read_facts(chart, &s);
    return s;
}

typedef struct coordinates {
    uint32_t facet[SAVED_POINTS];
    double bary[SAVED_POINTS * ICC_MAX_DIM], t[SAVED_POINTS];
    icc_status status[SAVED_POINTS];
    double back[SAVED_POINTS * ICC_MAX_DIM], elsewhere[SAVED_POINTS * ICC_MAX_DIM];
    uint32_t facet_back[SAVED_POINTS];
    double bary_back[SAVED_POINTS * ICC_MAX_DIM], t_back[SAVED_POINTS];
    size_t n_failed;
} coordinates;

/* Coordinates of points and the points of them; points of coordinates that are made up, and the
 * coordinates of these. */
static inline void find_coordinates(const icc_chart *chart, const double *points, coordinates *c)
{
    icc_domain_info info = {.size = sizeof info};
    random_source r = {11};
    uint32_t facet[SAVED_POINTS];
    double bary[SAVED_POINTS * ICC_MAX_DIM], t[SAVED_POINTS];
    memset(c, 0, sizeof *c);
    ck_assert_int_eq(icc_domain_get_info(icc_chart_domain(chart), &info), ICC_OK);
    ck_assert_int_eq(icc_chart_encode(chart, SAVED_POINTS, points, c->facet, c->bary, c->t,
                                      c->status, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(
        icc_chart_decode(chart, SAVED_POINTS, c->facet, c->bary, c->t, c->back, NULL, NULL, NULL),
        ICC_OK);
    for (int i = 0; i < SAVED_POINTS; ++i) {
        double sum = 0;
        facet[i] = (uint32_t)random_below(&r, (int)info.n_facets);
        t[i] = i % 16 == 0 ? 0 : random_unit(&r);
        for (int k = 0; k < info.dim; ++k)
            sum += bary[info.dim * i + k] = random_unit(&r) + 1e-3;
        for (int k = 0; k < info.dim; ++k)
            bary[info.dim * i + k] /= sum;
    }
    ck_assert_int_eq(
        icc_chart_decode(chart, SAVED_POINTS, facet, bary, t, c->elsewhere, NULL, NULL, NULL),
        ICC_OK);
    ck_assert_int_eq(icc_chart_encode(chart, SAVED_POINTS, c->elsewhere, c->facet_back,
                                      c->bary_back, c->t_back, NULL, &c->n_failed, NULL),
                     ICC_OK);
}

static inline void same_curves(const icc_chart *a, const icc_chart *b, const double *points,
                               int dim)
{
    enum { LONGEST = 4096 };
    double *curves = saved_alloc(2 * LONGEST * ICC_MAX_DIM * sizeof *curves);
    for (int i = 0; i < SAVED_POINTS; i += 8) {
        size_t n = 0, m = 0;
        double *other = curves + LONGEST * ICC_MAX_DIM;
        const icc_status status =
            icc_chart_trace(a, points + dim * i, LONGEST, curves, &n, NULL, NULL);
        ck_assert_int_eq(icc_chart_trace(b, points + dim * i, LONGEST, other, &m, NULL, NULL),
                         status);
        ck_assert_uint_eq(n, m);
        ck_assert_uint_le(n, LONGEST);
        ck_assert_same(curves, other, n * (size_t)dim * sizeof *curves, "curve");
    }
    free(curves);
}

static inline void same_chart(const icc_chart *a, const icc_chart *b)
{
    static coordinates x, y;
    double points[SAVED_POINTS * ICC_MAX_DIM];
    chart_facts facts, other;
    read_facts(a, &facts);
    read_facts(b, &other);
    same_domain(icc_chart_domain(a), icc_chart_domain(b));
    ck_assert_same(&facts, &other, sizeof facts, "info of the chart");
    saved_points(icc_chart_domain(a), 5, points);
    find_coordinates(a, points, &x);
    find_coordinates(b, points, &y);
    ck_assert_uint_lt(x.n_failed, SAVED_POINTS);
    ck_assert_same(&x, &y, sizeof x, "coordinates");
    same_curves(a, b, points, facts.common.dim);
}

/* ---- maps ---- */

/* How it was made, but for the seconds. */
static inline icc_map_report map_making(const icc_map *map)
{
    icc_map_report report = report_of(map);
    report.seconds = report.seconds_repair = report.seconds_improve = report.seconds_certify = 0;
    return report;
}

typedef struct images {
    double there[SAVED_POINTS * ICC_MAX_DIM], back[SAVED_POINTS * ICC_MAX_DIM];
    double jacobians[SAVED_POINTS * ICC_MAX_DIM * ICC_MAX_DIM];
    icc_status status[3][SAVED_POINTS];
    size_t n_failed;
} images;

static inline void find_images(const icc_map *map, const double *points, images *i)
{
    memset(i, 0, sizeof *i);
    ck_assert_int_eq(
        icc_map_apply(map, SAVED_POINTS, points, i->there, i->status[0], &i->n_failed, NULL),
        ICC_OK);
    ck_assert_int_eq(
        icc_map_apply_inverse(map, SAVED_POINTS, points, i->back, i->status[1], NULL, NULL),
        ICC_OK);
    ck_assert_int_eq(
        icc_map_jacobian(map, SAVED_POINTS, points, i->jacobians, i->status[2], NULL, NULL),
        ICC_OK);
}

static inline void same_mesh(const icc_map *a, const icc_map *b, const icc_map_info *info)
{
    const size_t dim = (size_t)info->dim, n = info->n_vertices * dim,
                 n_ends = (dim + 1) * info->n_simplices;
    double *numbers = saved_alloc(4 * n * sizeof *numbers);
    uint32_t *corners = saved_alloc(2 * n_ends * sizeof *corners);
    ck_assert_int_eq(flat_get_mesh(a, numbers, numbers + n, corners), ICC_OK);
    ck_assert_int_eq(flat_get_mesh(b, numbers + 2 * n, numbers + 3 * n, corners + n_ends), ICC_OK);
    ck_assert_same(numbers, numbers + 2 * n, 2 * n * sizeof *numbers, "mesh of the map");
    ck_assert_same(corners, corners + n_ends, n_ends * sizeof *corners, "corners of the map");
    free(numbers);
    free(corners);
}

static inline void same_map(const icc_map *a, const icc_map *b, const icc_domain *source)
{
    static images x, y;
    double points[SAVED_POINTS * ICC_MAX_DIM];
    const icc_map_info info = info_of_map(a), other = info_of_map(b);
    ck_assert_same(&info, &other, sizeof info, "info of the map");
    const icc_map_report made = map_making(a), made_too = map_making(b);
    ck_assert_same(&made, &made_too, sizeof made, "report of the map");
    saved_points(source, 5, points);
    find_images(a, points, &x);
    find_images(b, points, &y);
    ck_assert_uint_lt(x.n_failed, SAVED_POINTS);
    ck_assert_same(&x, &y, sizeof x, "images");
    ck_assert((icc_map_source_chart(a) == NULL) == (icc_map_source_chart(b) == NULL));
    if (icc_map_source_chart(a) != NULL) {
        same_chart(icc_map_source_chart(a), icc_map_source_chart(b));
        same_chart(icc_map_target_chart(a), icc_map_target_chart(b));
    }
    if (info.kind == ICC_MAP_MESH)
        same_mesh(a, b, &info);
}

#endif
