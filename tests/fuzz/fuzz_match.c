/* Any bytes as two outlines that do not correspond: where both are domains, they are matched, with
 * every vertex of each in its order and with landmarks kept, or that is refused for a reason.
 *
 * Byte 0 chooses how the outlines are read (bits 0-3, see outlines.h), how many landmarks there are
 * (bits 4, 5) and which rotations are preferred (bits 6, 7); byte 1 how they are paired (bits 0-2),
 * whether near vertices are dropped (bit 3), and how both are placed (bits 4-7); byte 2, what part
 * of the rest is the source's; byte 3, how many holes, lines and points there are in the middle of
 * the source (bits 0-3) and of the target (bits 4-7; with bit 7 as many), if they fit. */
#include "outlines.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MAX_FEATURES = 15, MAX_FEATURE = 6, MOST_VERTICES = 8 * MAX_VERTICES + 4096 };

/* Small holes, lines and points round the middle, a kind after the other, each with as many vertices
 * as a byte says. `xy` has room for them behind the outline. How many vertices. */
static size_t read_features(icc_feature *features, size_t n, const uint8_t *data, size_t size,
                            int where, double *xy)
{
    static const size_t least[] = {3, 2, 1}, most[] = {MAX_FEATURE, MAX_FEATURE, 1};
    double *at = xy;
    for (size_t f = 0; f < n; ++f) {
        const size_t kind = f % 3, byte = f < size ? data[f] : f;
        const size_t count = byte % MAX_FEATURE + 1 > most[kind]    ? most[kind]
                             : byte % MAX_FEATURE + 1 < least[kind] ? least[kind]
                                                                    : byte % MAX_FEATURE + 1;
        const double x = (double)(f & 3) / 128 - .012 + (double)(byte & 3) / 2048;
        const double y = (double)(f >> 2) / 128 - .012 + (double)(byte >> 2 & 3) / 2048;
        for (size_t k = 0; k < count; ++k) {
            const double a = 6.28318530717958647692 * (double)k / (double)(count + (kind == 1));
            at[2 * k] = x + cos(a) / 1024;
            at[2 * k + 1] = y + sin(a) / 1024;
        }
        place_outline(count, at, where);
        features[f] = (icc_feature){.size = sizeof(icc_feature),
                                    .kind = ICC_FEATURE_HOLE + (int32_t)kind,
                                    .n_vertices = count,
                                    .vertices = at,
                                    .radius = kind == 2 && f % 2 == 1 ? 1e-3 : 0};
        at += 2 * count;
    }
    return (size_t)(at - xy) / 2;
}

/* With features if they fit. `n_outer` of all n vertices. */
static icc_domain *read_domain(const uint8_t *data, size_t size, int how, int where,
                               size_t n_features, double *xy, size_t *n_outer, size_t *n)
{
    icc_feature features[MAX_FEATURES];
    icc_domain *domain = NULL;
    *n = *n_outer = read_outline(data, size, how & 1, how & 2, xy);
    place_outline(*n, xy, where);
    const size_t n_inside =
        read_features(features, n_features, data, size, where, xy + 2 * *n_outer);
    if (icc_domain_create_features(&domain, *n, xy, n_features, features, NULL, NULL) == ICC_OK)
        *n += n_inside;
    else
        (void)icc_domain_create(&domain, 2, *n, xy, 0, NULL, NULL, NULL);
    return domain;
}

/* Vertices that follow one another round the outline, bit for bit, in either sense for the target;
 * those inside, each once. Circles have vertices of their own behind them. */
static void check_side(const icc_domain *common, size_t n, size_t n_inside, const double *xy,
                       size_t n_common, const uint32_t *origin, int may_turn)
{
    static double vertices[2 * MOST_VERTICES];
    static uint32_t facets[2 * MOST_VERTICES];
    uint32_t before = UINT32_MAX;
    size_t n_found = 0, n_on = 0, n_back = 0, n_found_inside = 0;
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(common, &info) == ICC_OK && info.n_vertices == n_common);
    require(n_common <= MOST_VERTICES);
    require(icc_domain_get_boundary(common, vertices, facets) == ICC_OK);
    for (size_t i = 0; i < n_common; ++i) {
        if (origin[i] == UINT32_MAX)
            continue;
        if (origin[i] >= n + n_inside)
            continue;
        require(memcmp(vertices + 2 * i, xy + 2 * origin[i], 2 * sizeof *xy) == 0);
        if (origin[i] >= n) {
            ++n_found_inside;
            continue;
        }
        n_on += n_found > 0 && origin[i] == (before + 1) % n;
        n_back += n_found > 0 && before == (origin[i] + 1) % n;
        before = origin[i];
        ++n_found;
    }
    require(n_found == n && n_found_inside == n_inside);
    require(n_on == n - 1 || (may_turn && n_back == n - 1));
}

static void check_match(const icc_match *match, const size_t n[2], const size_t n_inside[2],
                        double *const xy[2], size_t n_landmarks)
{
    static uint32_t origin[2][MOST_VERTICES];
    icc_match_info info = {.size = sizeof info};
    require(icc_match_get_info(match, &info) == ICC_OK);
    require(info.n_vertices >= n[0] && info.n_vertices >= n[1]);
    require(info.n_landmarks == n_landmarks && info.n_vertices <= MOST_VERTICES);
    require(n_inside[0] > 0 || info.n_vertices <= n[0] + n[1] + n_landmarks);
    require(info.n_vertices >= info.n_joined && info.least_slope > 0);
    require(info.most_slope >= info.least_slope && !(info.cost < 0) && !(info.sure < 0));
    require(icc_match_get_origins(match, origin[0], origin[1]) == ICC_OK);
    check_side(icc_match_source(match), n[0], n_inside[0], xy[0], info.n_vertices, origin[0], 0);
    check_side(icc_match_target(match), n[1], n_inside[1], xy[1], info.n_vertices, origin[1], 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static double outline[2][2 * (MAX_VERTICES + MAX_FEATURES * MAX_FEATURE)];
    double *const xy[2] = {outline[0], outline[1]};
    double landmarks[4 * 3] = {0};
    icc_domain *domain[2];
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    size_t n[2], n_all[2];
    if (size < 4)
        return 0;
    const size_t rest = size - 4, first = rest * data[2] / 255, n_landmarks = data[0] >> 4 & 3;
    domain[0] =
        read_domain(data + 4, first, data[0], data[1] >> 4, data[3] & 15, xy[0], &n[0], &n_all[0]);
    domain[1] = read_domain(data + 4 + first, rest - first, data[0] >> 2, data[1] >> 6,
                            data[3] & 128 ? data[3] & 15 : data[3] >> 4, xy[1], &n[1], &n_all[1]);
    if (domain[0] != NULL && domain[1] != NULL) {
        for (size_t k = 0; k < n_landmarks; ++k)
            for (size_t s = 0; s < 2; ++s)
                memcpy(landmarks + 4 * k + 2 * s, xy[s] + 2 * (k * n[s] / 3), 2 * sizeof(double));
        /* By shape it takes a third of a second without landmarks. */
        const icc_match_options options = {.size = sizeof options,
                                           .between = (data[1] & 7) == 7 ? ICC_BETWEEN_ELASTIC
                                                                         : ICC_BETWEEN_ARC,
                                           .turning = (data[0] >> 6) % 3,
                                           .least_sure = 1,
                                           .drop = data[1] & 8 ? 0.01 : 0};
        const icc_status status = icc_match_create(&match, domain[0], domain[1], n_landmarks,
                                                   landmarks, &options, NULL, &err);
        require((match != NULL) == (status == ICC_OK));
        if (status == ICC_OK)
            check_match(match, n, (const size_t[]){n_all[0] - n[0], n_all[1] - n[1]}, xy,
                        n_landmarks);
        else
            require((status == ICC_ERR_ARGUMENT || status == ICC_ERR_BOUNDARY ||
                     status == ICC_ERR_AMBIGUOUS) &&
                    err.message[0] != '\0');
    }
    icc_match_free(match);
    icc_domain_free(domain[0]);
    icc_domain_free(domain[1]);
    return 0;
}
