/* Any bytes as two surfaces, as for fuzz_surface: where both are domains, they get common triangles, with
 * the bits of every vertex that is left, or that is refused for a reason.
 *
 * Byte 0 chooses the tolerance (bits 0, 1) and how many landmarks there are (bits 2, 3: none, one,
 * three, six; with bit 7 in other orders on both sides), and whether the source keeps its mesh (bit
 * 4); byte 1, what part of the rest is the source's. */
#include "bodies.h"
#include "fuzz.h"
#include "icc/icc.h"

enum { MOST_VERTICES = 1 << 15, MOST_LANDMARKS = 6 };

static icc_domain *read_body(surface *s, const uint8_t *data, size_t size)
{
    icc_domain *domain = NULL;
    if (size == 0)
        return NULL;
    choose(s, data[0] & 3);
    read_surface(s, data, size);
    (void)icc_domain_create(&domain, 3, s->n_vertices, s->vertices, s->n_faces, s->faces, NULL,
                            NULL);
    return domain;
}

static void check_side(const icc_domain *common, const surface *given, size_t n,
                       const uint32_t *origin, uint32_t *faces)
{
    static double vertices[3 * MOST_VERTICES];
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(common, &info) == ICC_OK);
    require(info.n_vertices == n && info.n_facets == 2 * n - 4 && info.orientation == 1);
    require(icc_domain_get_boundary(common, vertices, faces) == ICC_OK);
    for (size_t i = 0; i < n; ++i) {
        require(origin[i] == UINT32_MAX || origin[i] < given->n_vertices);
        require(origin[i] == UINT32_MAX || memcmp(vertices + 3 * i, given->vertices + 3 * origin[i],
                                                  3 * sizeof *vertices) == 0);
    }
}

/* All that have facets come first. */
static void check_kept(const surface *given, size_t n, const uint32_t *origin)
{
    static uint8_t is_used[MOST_VERTICES];
    size_t n_kept = 0;
    memset(is_used, 0, given->n_vertices);
    for (size_t c = 0; c < 3 * given->n_faces; ++c)
        is_used[given->faces[c]] = 1;
    for (uint32_t v = 0; v < given->n_vertices; ++v)
        if (is_used[v])
            require(n_kept < n && origin[n_kept++] == v);
    for (size_t i = n_kept; i < n; ++i)
        require(origin[i] == UINT32_MAX);
}

static void check_match(const icc_match *match, const surface *given,
                        const icc_match_options *options, size_t n_landmarks)
{
    const double tolerance = options->tolerance;
    static uint32_t origin[2][MOST_VERTICES], faces[2][6 * MOST_VERTICES];
    icc_match_info info = {.size = sizeof info};
    require(icc_match_get_info(match, &info) == ICC_OK);
    require(info.n_vertices >= 4 && info.n_vertices <= info.n_overlay);
    require(info.n_overlay <= MOST_VERTICES && info.n_landmarks == n_landmarks);
    require(info.off >= 0 && (tolerance < 0 || info.off <= tolerance));
    require(info.energy >= 3.99 && info.least_angle >= 0 && info.least_angle <= 60.01);
    require(icc_match_get_origins(match, origin[0], origin[1]) == ICC_OK);
    check_side(icc_match_source(match), &given[0], info.n_vertices, origin[0], faces[0]);
    check_side(icc_match_target(match), &given[1], info.n_vertices, origin[1], faces[1]);
    if (options->keep_source != 0)
        check_kept(&given[0], info.n_vertices, origin[0]);
    require(memcmp(faces[0], faces[1], 3 * (2 * info.n_vertices - 4) * sizeof **faces) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const double tolerances[4] = {1e-3, 0.03, 1e-6, -1};
    static surface given[2];
    double landmarks[6 * MOST_LANDMARKS];
    icc_domain *domain[2];
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    if (size < 4)
        return 0;
    const size_t rest = size - 2, first = rest * data[1] / 255;
    static const size_t counts[4] = {0, 1, 3, 6};
    const size_t n_landmarks = counts[data[0] >> 2 & 3];
    domain[0] = read_body(&given[0], data + 2, first);
    domain[1] = read_body(&given[1], data + 2 + first, rest - first);
    if (domain[0] != NULL && domain[1] != NULL) {
        for (size_t k = 0; k < n_landmarks; ++k)
            for (size_t side = 0; side < 2; ++side) {
                const size_t n = given[side].n_vertices;
                const size_t v = side == 1 && data[0] & 128 ? n - 1 - k : k * n / n_landmarks;
                memcpy(landmarks + 6 * k + 3 * side, given[side].vertices + 3 * v,
                       3 * sizeof *landmarks);
            }
        const icc_match_options options = {.size = sizeof options,
                                           .tolerance = tolerances[data[0] & 3],
                                           .keep_source = data[0] >> 4 & 1};
        const icc_status status = icc_match_create(&match, domain[0], domain[1], n_landmarks,
                                                   landmarks, &options, NULL, &err);
        require((match != NULL) == (status == ICC_OK));
        if (status == ICC_OK)
            check_match(match, given, &options, n_landmarks);
        else
            require((status == ICC_ERR_ARGUMENT || status == ICC_ERR_BOUNDARY ||
                     status == ICC_ERR_RESOLUTION) &&
                    err.message[0] != '\0');
    }
    icc_match_free(match);
    icc_domain_free(domain[0]);
    icc_domain_free(domain[1]);
    return 0;
}
