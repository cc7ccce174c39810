/* Any bytes as a solid with features. What is refused is refused with a text that names what there
 * is. What is accepted is accepted in any order and turned either way, feature by feature as well,
 * knows its own vertices, and comes back from its bytes. Or any bytes as those of such a domain.
 *
 * Byte 0 chooses how the rest is read: with its lowest bit, as the bytes of a domain; else by
 * coordinates.h. The outer surface is a large box; with bit 6 it has a hole through it. Then one
 * feature after the other: a byte with the kind and the number of vertices, and three bytes for each
 * vertex of a line or point. A surface is a box, of two corners, or with a fourth byte a tetrahedron
 * of any four corners. */
#include "icc/icc.h"

#include "blobs.h"
#include "coordinates.h"
#include "domain/domain_file.h"
#include "domain/features.h"

#include <string.h>

enum { MAX_FEATURES = 16, MAX_VERTICES = 8 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Corner i of a box has the bits of i as coordinates. */
static const uint32_t BOX[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
static const uint32_t TETRAHEDRON[12] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};

typedef struct input {
    size_t n_outer, n_outer_facets, n;
    double outer[48];
    uint32_t outer_facets[96];
    icc_feature features[MAX_FEATURES];
    double vertices[MAX_FEATURES][3 * MAX_VERTICES];
    uint32_t facets[MAX_FEATURES][36];
} input;

static void make_outer(input *in, int mode)
{
    const int through = mode >> 6 & 1;
    in->n_outer = through ? 16 : 8;
    for (size_t i = 0; i < in->n_outer; ++i)
        for (size_t k = 0; k < 3; ++k) {
            const double most = k == 2 ? 9 : i < 8 ? 9 : 8.5;
            const double x = i >> k & 1 ? most : i < 8 || k == 2 ? -9 : 7.5;
            const double unit = (mode & 2) != 0 ? 3 : 1;
            const double at[2] = {coordinate(mode & 60, 8), coordinate(mode & 60, 9)};
            in->outer[3 * i + k] = at[0] + x / unit * (at[1] - at[0]);
        }
    in->n_outer_facets = 12;
    memcpy(in->outer_facets, BOX, sizeof BOX);
    if (!through)
        return;
    /* Sides of the hole, turned, then both rims: lower corners 0 to 3, upper 4 to 7 */
    static const uint32_t RING[4] = {0, 1, 3, 2};
    uint32_t *to = in->outer_facets;
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t a = RING[i], b = RING[(i + 1) % 4];
        const uint32_t faces[24] = {a,     b,     b + 4,  a,      b + 4,  a + 4, a + 8,  b + 12,
                                    b + 8, a + 8, a + 12, b + 12, a,      b + 8, b,      a,
                                    a + 8, b + 8, a + 4,  b + 4,  b + 12, a + 4, b + 12, a + 12};
        memcpy(to, faces, sizeof faces);
        to += 24;
    }
    in->n_outer_facets = 32;
}

/* Makes a box from two of its corners, or a tetrahedron from four corners. */
static void make_surface(input *in, const double *corners, int is_box)
{
    double *v = in->vertices[in->n];
    icc_feature *f = &in->features[in->n];
    if (is_box)
        for (size_t i = 0; i < 24; ++i)
            v[i] = corners[i / 3 >> i % 3 & 1 ? 3 + i % 3 : i % 3];
    else
        memcpy(v, corners, 12 * sizeof *v);
    memcpy(in->facets[in->n], is_box ? BOX : TETRAHEDRON, is_box ? sizeof BOX : sizeof TETRAHEDRON);
    f->n_vertices = is_box ? 8 : 4;
    f->n_facets = is_box ? 12 : 4;
    f->facets = in->facets[in->n];
}

static void read_input(input *in, const uint8_t *data, size_t size)
{
    make_outer(in, data[0]);
    in->n = 0;
    for (size_t at = 1; at < size && in->n < MAX_FEATURES;) {
        const int32_t kind = 1 + data[at] % 4;
        const int is_surface = kind == ICC_FEATURE_HOLE || kind == ICC_FEATURE_REGION;
        const int is_box = data[at] >> 2 & 1;
        const size_t n = is_surface                  ? (is_box ? 2 : 4)
                         : kind == ICC_FEATURE_POINT ? 1
                                                     : 2 + (data[at] >> 2) % 4;
        double corners[3 * MAX_VERTICES];
        if (++at + 3 * n > size)
            return;
        for (size_t i = 0; i < 3 * n; ++i)
            corners[i] = coordinate(data[0] & ~64, data[at++]);
        in->features[in->n] = (icc_feature){.size = sizeof(icc_feature),
                                            .kind = kind,
                                            .n_vertices = n,
                                            .vertices = in->vertices[in->n]};
        if (is_surface)
            make_surface(in, corners, is_box);
        else
            memcpy(in->vertices[in->n], corners, 3 * n * sizeof *corners);
        ++in->n;
    }
}

static int can_be_made(const input *in, size_t first, size_t n);

static icc_status make(icc_domain **out, const input *in, size_t first, size_t n)
{
    icc_error err = {.size = sizeof err};
    const icc_status status =
        icc_domain_create_solid(out, in->n_outer, in->outer, in->n_outer_facets, in->outer_facets,
                                n, in->features + first, NULL, &err);
    require((*out != NULL) == (status == ICC_OK));
    require(status == ICC_OK || status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE ||
            status == ICC_ERR_TOPOLOGY);
    if (status == ICC_OK)
        return status;
    const int of_feature = err.item == ICC_ITEM_FEATURE;
    require(err.message[0] != '\0' && of_feature == (strncmp(err.message, "feature ", 8) == 0));
    require(err.index < (int64_t)(of_feature ? n : in->n_outer_facets));
    require(of_feature || n == 0 || status == ICC_ERR_BOUNDARY);
    /* Rounding may have spoilt the outer surface, or a feature may have changed the frame */
    require(of_feature || n == 0 || !can_be_made(in, 0, 0) ||
            strstr(err.message, "2^-200") != NULL);
    return status;
}

static int can_be_made(const input *in, size_t first, size_t n)
{
    icc_domain *domain;
    const icc_status status = make(&domain, in, first, n);
    icc_domain_free(domain);
    return status == ICC_OK;
}

/* The features the other way round, each surface turned over, each line from its other end. */
static void reverse(input *to, const input *from)
{
    *to = *from;
    for (size_t f = 0; f < from->n; ++f) {
        const size_t g = from->n - 1 - f, n = from->features[f].n_vertices;
        to->features[g] = from->features[f];
        to->features[g].vertices = to->vertices[g];
        for (size_t i = 0; i < n; ++i)
            memcpy(to->vertices[g] + 3 * (n - 1 - i), from->vertices[f] + 3 * i,
                   3 * sizeof(double));
        for (size_t i = 0; i < 3 * from->features[f].n_facets; ++i)
            to->facets[g][i] = (uint32_t)n - 1 - from->facets[f][i];
        if (from->features[f].n_facets > 0)
            to->features[g].facets = to->facets[g];
        for (size_t i = 0; i < from->features[f].n_facets && f % 2 == 0; ++i) {
            const uint32_t swap = to->facets[g][3 * i];
            to->facets[g][3 * i] = to->facets[g][3 * i + 1];
            to->facets[g][3 * i + 1] = swap;
        }
    }
}

static size_t save(icc_domain *domain, uint8_t *bytes, size_t capacity)
{
    iccp_blob w;
    size_t n;
    iccp_blob_begin(&w, bytes, capacity, "FEAT", 1);
    require(iccp_domain_visit_any(&w, &domain, NULL) == ICC_OK);
    iccp_blob_end(&w, &n);
    require(n <= capacity);
    return n;
}

/* The bytes of a domain, which may be made up. */
static void check_bytes(const uint8_t *bytes, size_t n)
{
    static uint8_t again[LARGEST];
    iccp_env env;
    iccp_blob r;
    icc_domain *domain = NULL;
    require(iccp_env_read(&env, NULL, NULL) == ICC_OK);
    icc_status status = iccp_blob_open(&r, bytes, n, "FEAT", 1, &env.memory, NULL);
    if (status == ICC_OK)
        status = iccp_domain_visit_any(&r, &domain, &env);
    require(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION ||
            status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE || status == ICC_ERR_TOPOLOGY ||
            status == ICC_ERR_RESOLUTION);
    if (status == ICC_OK && iccp_blob_done(&r) && domain->features != NULL)
        require(save(domain, again, LARGEST) == n && memcmp(again, bytes, n) == 0);
    icc_domain_free(domain);
}

static void check_domain(const icc_domain *domain, const input *in)
{
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(domain, &info) == ICC_OK);
    require(info.n_features == in->n && info.measure >= 0);
    require(in->n == 0 || info.n_faces == info.n_regions + 1);
    for (size_t f = 0; f < in->n; ++f) {
        icc_feature_info feature = {.size = sizeof feature};
        require(icc_domain_get_feature(domain, f, &feature) == ICC_OK);
        require(feature.kind == in->features[f].kind &&
                feature.n_vertices == in->features[f].n_vertices &&
                feature.n_facets == in->features[f].n_facets && feature.around <= info.n_regions);
        for (size_t v = 0; v < feature.n_vertices; ++v) {
            int32_t where;
            uint32_t facet;
            double bary[3];
            require(icc_domain_locate(domain, 1, in->features[f].vertices + 3 * v, &where, &facet,
                                      bary, NULL) == ICC_OK);
            require(feature.kind == ICC_FEATURE_HOLE ? where == ICC_BOUNDARY
                                                     : where != ICC_OUTSIDE);
            require(facet < info.n_facets);
        }
        require(can_be_made(in, f, 1));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static input in, reversed;
    static uint8_t bytes[LARGEST];
    icc_domain *domain;
    if (size < 1 || size - 1 > LARGEST)
        return 0;
    if (data[0] & 1) {
        memcpy(bytes, data + 1, size - 1);
        if (size - 1 >= HEADER)
            put_right(bytes, size - 1, "FEAT");
        check_bytes(bytes, size - 1);
        return 0;
    }
    read_input(&in, data, size);
    const icc_status status = make(&domain, &in, 0, in.n);
    reverse(&reversed, &in);
    require(can_be_made(&reversed, 0, in.n) == (status == ICC_OK));
    if (domain != NULL) {
        check_domain(domain, &in);
        if (in.n > 0)
            check_bytes(bytes, save(domain, bytes, LARGEST));
    }
    icc_domain_free(domain);
    return 0;
}
