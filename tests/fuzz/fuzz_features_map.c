/* Any bytes as two polygons with features that correspond: where both are domains, there is a map
 * between them, which is certified and takes the vertices of each to those of the other; or it is
 * refused for a reason.
 *
 * Bytes 0 and 1 choose how the coordinates of the source and of the target are read, see
 * coordinates.h; the lowest bit of byte 0, how far the map is improved. Then a chain after the
 * other, the outer ring first: a byte with the kind and the number of vertices, and four bytes for
 * each, two of the source and two of the target. */
#include "coordinates.h"
#include "fuzz.h"
#include "icc/icc.h"

#include <stddef.h>

enum { MAX_CHAINS = 10, MAX_VERTICES = 100 };

typedef struct input {
    size_t n_outer, n, n_vertices;
    double vertices[2][2 * MAX_VERTICES];
    icc_feature features[2][MAX_CHAINS];
} input;

/* Adds a chain of n vertices from four bytes each. */
static void add_chain(input *in, int32_t kind, size_t n, const uint8_t *data,
                      const uint8_t modes[2])
{
    for (int side = 0; side < 2; ++side) {
        double *own = in->vertices[side] + 2 * in->n_vertices;
        for (size_t i = 0; i < 2 * n; ++i)
            own[i] = coordinate(modes[side], data[4 * (i / 2) + 2 * (size_t)side + i % 2]);
        in->features[side][in->n] = (icc_feature){
            .size = sizeof(icc_feature), .kind = kind, .n_vertices = n, .vertices = own};
    }
    in->n += in->n_outer > 0;
    in->n_outer = in->n_outer > 0 ? in->n_outer : n;
    in->n_vertices += n;
}

static void read_input(input *in, const uint8_t *data, size_t size)
{
    static const size_t least[] = {0, 3, 2, 1, 3};
    in->n_outer = in->n = in->n_vertices = 0;
    for (size_t at = 2; at < size && in->n < MAX_CHAINS;) {
        const int32_t kind = in->n_outer == 0 ? ICC_FEATURE_HOLE : 1 + data[at] % 4;
        size_t n = kind == ICC_FEATURE_POINT ? 1 : least[kind] + data[at] / 4 % 8;
        ++at;
        n = n < (size - at) / 4 ? n : (size - at) / 4;
        if (n < least[kind] || n > MAX_VERTICES - in->n_vertices)
            return;
        add_chain(in, kind, n, data + at, data);
        at += 4 * n;
    }
}

/* Whether all numbers are the same; zeros may differ in their signs. */
static int are_same(size_t n, const double *a, const double *b)
{
    for (size_t i = 0; i < n; ++i)
        if (!(a[i] >= b[i] && a[i] <= b[i]))
            return 0;
    return 1;
}

static void check_map(const icc_map *map, const input *in)
{
    double found[2 * MAX_VERTICES];
    const size_t n = in->n_vertices;
    icc_map_info info = {.size = sizeof info};
    require(icc_map_get_info(map, &info) == ICC_OK);
    require(info.certified == 1 && info.kind == ICC_MAP_MESH && info.energy >= 4 - 1e-9);
    require(icc_map_apply(map, n, in->vertices[0], found, NULL, NULL, NULL) == ICC_OK);
    require(are_same(2 * n, found, in->vertices[1]));
    require(icc_map_apply_inverse(map, n, in->vertices[1], found, NULL, NULL, NULL) == ICC_OK);
    require(are_same(2 * n, found, in->vertices[0]));
}

/* What is saved is loaded, and saved again it is the same. */
static void check_saved(const icc_map *map)
{
    size_t n, again;
    icc_map *loaded;
    require(icc_map_save(map, 0, NULL, &n) == ICC_OK);
    uint8_t *bytes = malloc(2 * n);
    require(bytes != NULL && icc_map_save(map, n, bytes, &n) == ICC_OK);
    require(icc_map_load(&loaded, n, bytes, NULL, NULL) == ICC_OK);
    require(icc_map_save(loaded, n, bytes + n, &again) == ICC_OK);
    require(again == n && memcmp(bytes, bytes + n, n) == 0);
    icc_map_free(loaded);
    free(bytes);
}

/* A map's own ties make another map, unless rounding is in the way. */
static void check_ties(const icc_map *map, const icc_domain *source, const icc_domain *target)
{
    icc_map_info info = {.size = sizeof info};
    icc_tie ties[MAX_CHAINS] = {{0}};
    double *bends[MAX_CHAINS] = {NULL};
    icc_map *again;
    require(icc_map_get_info(map, &info) == ICC_OK && info.n_ties <= MAX_CHAINS);
    for (size_t k = 0; k < info.n_ties; ++k) {
        icc_tie_info tie = {.size = sizeof tie};
        require(icc_map_get_tie(map, k, &tie, NULL, NULL) == ICC_OK);
        bends[k] = malloc(2 * tie.n_target * sizeof **bends + 1);
        require(bends[k] != NULL && icc_map_get_tie(map, k, &tie, NULL, bends[k]) == ICC_OK);
        ties[k] = (icc_tie){.size = sizeof *ties,
                            .vertex = {tie.vertex[0], tie.vertex[1]},
                            .n_target = tie.n_target,
                            .target = bends[k]};
    }
    const icc_map_options options = {
        .size = sizeof options, .iterations = -1, .n_ties = info.n_ties, .ties = ties};
    const icc_status status = info.n_ties > 0
                                  ? icc_map_create(&again, source, target, &options, NULL, NULL)
                                  : ICC_ERR_RESOLUTION;
    require(status == ICC_OK || status == ICC_ERR_RESOLUTION || status == ICC_ERR_TOPOLOGY);
    if (status == ICC_OK)
        icc_map_free(again);
    for (size_t k = 0; k < info.n_ties; ++k)
        free(bends[k]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static input in;
    icc_domain *domain[2] = {NULL, NULL};
    icc_map *map = NULL;
    icc_error err = {.size = sizeof err};
    if (size < 2)
        return 0;
    read_input(&in, data, size);
    if (in.n == 0)
        return 0;
    for (int side = 0; side < 2; ++side)
        (void)icc_domain_create_features(&domain[side], in.n_outer, in.vertices[side], in.n,
                                         in.features[side], NULL, NULL);
    if (domain[0] != NULL && domain[1] != NULL) {
        const icc_map_options options = {.size = sizeof options,
                                         .iterations = data[0] & 1 ? 1 : -1};
        const icc_status status = icc_map_create(&map, domain[0], domain[1], &options, NULL, &err);
        require((map != NULL) == (status == ICC_OK));
        require(status == ICC_OK || err.message[0] != '\0');
        require(status == ICC_OK || status == ICC_ERR_BOUNDARY || status == ICC_ERR_TOPOLOGY ||
                status == ICC_ERR_RESOLUTION);
    }
    if (map != NULL) {
        check_map(map, &in);
        check_saved(map);
        check_ties(map, domain[0], domain[1]);
    }
    icc_map_free(map);
    icc_domain_free(domain[0]);
    icc_domain_free(domain[1]);
    return 0;
}
