/* Any bytes as a polygon with features. What is refused is refused with a text that names what there
 * is; what is accepted is accepted in any order too, piece by piece as well, knows its own vertices,
 * and comes back from its bytes. Or any bytes as those of such a domain.
 *
 * Byte 0 chooses how the rest is read: with its lowest bit, as the bytes of a domain; else by
 * coordinates.h. Then a chain after the other, the outer ring first: a byte with the kind and the
 * number of vertices, and two bytes for each. A hole whose byte is 128 or more is a region. */
#include "icc/icc.h"

#include "blobs.h"
#include "coordinates.h"
#include "domain/domain_file.h"

#include <string.h>

enum { MAX_CHAINS = 24, MAX_VERTICES = 512 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct input {
    size_t n_outer, n, n_vertices;
    double vertices[2 * MAX_VERTICES];
    icc_feature features[MAX_CHAINS];
} input;

static void read_input(input *in, const uint8_t *data, size_t size)
{
    static const size_t least[] = {0, 3, 2, 1, 3};
    in->n_outer = in->n = in->n_vertices = 0;
    for (size_t at = 1; at < size && in->n < MAX_CHAINS;) {
        int32_t kind = in->n_outer == 0 ? ICC_FEATURE_HOLE : 1 + data[at] % 3;
        if (in->n_outer > 0 && kind == ICC_FEATURE_HOLE && data[at] >= 128)
            kind = ICC_FEATURE_REGION;
        size_t n = kind == ICC_FEATURE_POINT ? 1 : least[kind] + data[at] / 4 % 16;
        ++at;
        n = n < (size - at) / 2 ? n : (size - at) / 2;
        if (n < least[kind] || n > MAX_VERTICES - in->n_vertices)
            return;
        double *own = in->vertices + 2 * in->n_vertices;
        for (size_t i = 0; i < 2 * n; ++i)
            own[i] = coordinate(data[0], data[at++]);
        in->n_vertices += n;
        if (in->n_outer == 0)
            in->n_outer = n;
        else
            in->features[in->n++] = (icc_feature){sizeof(icc_feature), kind, n, own, 0, 0, NULL};
    }
}

static icc_status make(icc_domain **out, const input *in, size_t first, size_t n)
{
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_domain_create_features(out, in->n_outer, in->vertices, n,
                                                         in->features + first, NULL, &err);
    require((*out != NULL) == (status == ICC_OK));
    require(status == ICC_OK || status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE);
    if (status == ICC_OK)
        return status;
    const int of_feature = err.item == ICC_ITEM_FEATURE;
    require(err.message[0] != '\0' && err.index < (int64_t)(of_feature ? n : in->n_outer));
    require(of_feature == (strncmp(err.message, "feature ", 8) == 0));
    require(status == ICC_ERR_BOUNDARY || of_feature);
    return status;
}

static int can_be_made(const input *in, size_t first, size_t n)
{
    icc_domain *domain;
    const icc_status status = make(&domain, in, first, n);
    icc_domain_free(domain);
    return status == ICC_OK;
}

/* The other way round, chains and their vertices. */
static void reverse(input *to, const input *from)
{
    static double vertices[2 * MAX_VERTICES];
    *to = *from;
    for (size_t f = 0; f <= from->n; ++f) {
        const double *old = f < from->n ? from->features[f].vertices : from->vertices;
        const size_t n = f < from->n ? from->features[f].n_vertices : from->n_outer;
        double *own = vertices + (old - from->vertices);
        for (size_t i = 0; i < 2 * n; ++i)
            own[i] = old[2 * (n - 1 - i / 2) + i % 2];
        if (f < from->n) {
            to->features[from->n - 1 - f] = from->features[f];
            to->features[from->n - 1 - f].vertices = own;
        }
    }
    memcpy(to->vertices, vertices, sizeof vertices);
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

static icc_status load(icc_domain **out, const uint8_t *bytes, size_t n)
{
    iccp_env env;
    iccp_blob r;
    *out = NULL;
    require(iccp_env_read(&env, NULL, NULL) == ICC_OK);
    icc_status status = iccp_blob_open(&r, bytes, n, "FEAT", 1, &env.memory, NULL);
    if (status == ICC_OK)
        status = iccp_domain_visit_any(&r, out, &env);
    if (status == ICC_OK && iccp_blob_done(&r))
        return ICC_OK;
    icc_domain_free(*out);
    *out = NULL;
    return status == ICC_OK ? ICC_ERR_FORMAT : status;
}

/* The bytes of a domain, which may be made up. */
static void check_bytes(const uint8_t *bytes, size_t n)
{
    static uint8_t again[LARGEST];
    icc_domain *domain;
    const icc_status status = load(&domain, bytes, n);
    require(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION ||
            status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE || status == ICC_ERR_TOPOLOGY ||
            status == ICC_ERR_RESOLUTION);
    if (domain != NULL && domain->features != NULL)
        require(save(domain, again, LARGEST) == n && memcmp(again, bytes, n) == 0);
    icc_domain_free(domain);
}

static void check_domain(icc_domain *domain, const input *in)
{
    static uint8_t bytes[LARGEST];
    icc_domain_info info = {.size = sizeof info};
    int has_regions = 0;
    require(icc_domain_get_info(domain, &info) == ICC_OK);
    require(info.n_vertices == in->n_vertices && info.n_features == in->n && info.measure >= 0);
    require(in->n == 0 || (info.n_pieces > 0 && info.n_faces > 0));
    for (size_t f = 0; f < in->n; ++f)
        has_regions |= in->features[f].kind == ICC_FEATURE_REGION;
    for (size_t f = 0; f < in->n; ++f) {
        icc_feature_info feature = {.size = sizeof feature};
        require(icc_domain_get_feature(domain, f, &feature) == ICC_OK);
        require(feature.kind == in->features[f].kind &&
                feature.n_vertices == in->features[f].n_vertices);
        require((feature.orientation != 0) ==
                (feature.kind == ICC_FEATURE_HOLE || feature.kind == ICC_FEATURE_REGION));
        for (size_t v = 0; v < feature.n_vertices; ++v) {
            int32_t where;
            uint32_t facet;
            double bary[2];
            require(icc_domain_locate(domain, 1, in->features[f].vertices + 2 * v, &where, &facet,
                                      bary, NULL) == ICC_OK);
            /* A region may hide the side of a hole */
            require(feature.kind != ICC_FEATURE_HOLE || has_regions || where == ICC_BOUNDARY);
            require(where != ICC_OUTSIDE && facet < info.n_facets);
        }
        /* A feature may lie in a region that lies outside the outer ring */
        require(has_regions || can_be_made(in, f, 1));
    }
    if (in->n > 0)
        check_bytes(bytes, save(domain, bytes, LARGEST));
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
    if (domain != NULL)
        check_domain(domain, &in);
    icc_domain_free(domain);
    return 0;
}
