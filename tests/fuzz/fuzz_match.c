/* Any bytes as two outlines that do not correspond: where both are domains, they are matched, with
 * every vertex of each in its order and with landmarks kept, or that is refused for a reason.
 *
 * Byte 0 chooses how the outlines are read (bits 0-3, see outlines.h), how many landmarks there are
 * (bits 4, 5) and which rotations are preferred (bits 6, 7); byte 1 how they are paired (bits 0-2),
 * whether near vertices are dropped (bit 3), and how both are placed (bits 4-7); byte 2, what part
 * of the rest is the source's. */
#include "outlines.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static icc_domain *read_domain(const uint8_t *data, size_t size, int how, int where, double *xy,
                               size_t *n)
{
    icc_domain *domain = NULL;
    *n = read_outline(data, size, how & 1, how & 2, xy);
    place_outline(*n, xy, where);
    (void)icc_domain_create(&domain, 2, *n, xy, 0, NULL, NULL, NULL);
    return domain;
}

/* Vertices that follow one another round the outline, bit for bit, in either sense for the target. */
static void check_side(const icc_domain *common, size_t n, const double *xy, size_t n_common,
                       const uint32_t *origin, int may_turn)
{
    static double vertices[2 * 8 * MAX_VERTICES];
    static uint32_t facets[2 * 8 * MAX_VERTICES];
    uint32_t before = UINT32_MAX;
    size_t n_found = 0, n_on = 0, n_back = 0;
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(common, &info) == ICC_OK && info.n_vertices == n_common);
    require(n_common <= 8 * MAX_VERTICES);
    require(icc_domain_get_boundary(common, vertices, facets) == ICC_OK);
    for (size_t i = 0; i < n_common; ++i) {
        if (origin[i] == UINT32_MAX)
            continue;
        require(origin[i] < n);
        require(memcmp(vertices + 2 * i, xy + 2 * origin[i], 2 * sizeof *xy) == 0);
        n_on += n_found > 0 && origin[i] == (before + 1) % n;
        n_back += n_found > 0 && before == (origin[i] + 1) % n;
        before = origin[i];
        ++n_found;
    }
    require(n_found == n);
    require(n_on == n - 1 || (may_turn && n_back == n - 1));
}

static void check_match(const icc_match *match, const size_t n[2], double *const xy[2],
                        size_t n_landmarks)
{
    static uint32_t origin[2][8 * MAX_VERTICES];
    icc_match_info info = {.size = sizeof info};
    require(icc_match_get_info(match, &info) == ICC_OK);
    require(info.n_vertices >= n[0] && info.n_vertices >= n[1]);
    require(info.n_vertices <= n[0] + n[1] + n_landmarks && info.n_landmarks == n_landmarks);
    require(info.n_vertices >= info.n_joined && info.least_slope > 0);
    require(info.most_slope >= info.least_slope && !(info.cost < 0) && !(info.sure < 0));
    require(icc_match_get_origins(match, origin[0], origin[1]) == ICC_OK);
    check_side(icc_match_source(match), n[0], xy[0], info.n_vertices, origin[0], 0);
    check_side(icc_match_target(match), n[1], xy[1], info.n_vertices, origin[1], 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static double outline[2][2 * MAX_VERTICES];
    double *const xy[2] = {outline[0], outline[1]};
    double landmarks[4 * 3] = {0};
    icc_domain *domain[2];
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    size_t n[2];
    if (size < 3)
        return 0;
    const size_t rest = size - 3, first = rest * data[2] / 255, n_landmarks = data[0] >> 4 & 3;
    domain[0] = read_domain(data + 3, first, data[0], data[1] >> 4, xy[0], &n[0]);
    domain[1] =
        read_domain(data + 3 + first, rest - first, data[0] >> 2, data[1] >> 6, xy[1], &n[1]);
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
            check_match(match, n, xy, n_landmarks);
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
