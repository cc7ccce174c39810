/* Any bytes as a saved chart, map or match. The first byte says which; with its lowest bit the header is
 * put right, so that the content is looked at. What is accepted answers, and saved again it is the
 * same. There is little memory and patience: made-up options of a chart on a grid cost what they
 * cost when it is made. */
#include "icc/icc.h"

#include "blobs.h"

#include <math.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { N_POINTS = 24 };

/* The steps that a chart on a grid takes when it is made again end here. */
static int32_t lose_patience(void *user, const char *stage, double share)
{
    (void)stage;
    require(share >= 0 && share <= 1);
    return ++*(size_t *)user > 400;
}

/* Memory for small things only. */
static void *alloc_little(void *user, size_t size)
{
    (void)user;
    return size < (size_t)1 << 24 ? malloc(size) : NULL;
}

static void dealloc(void *user, void *memory)
{
    (void)user;
    free(memory);
}

static void find_points(const icc_domain *domain, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(domain, &info) == ICC_OK);
    double share = 0.5;
    for (int i = 0; i < N_POINTS; ++i)
        for (int k = 0; k < info.dim; ++k) {
            share = fmod(share + 0.6180339887498949, 1);
            points[info.dim * i + k] = info.lower[k] + share * (info.upper[k] - info.lower[k]);
        }
}

static void check_answers(const icc_chart *chart)
{
    double points[N_POINTS * ICC_MAX_DIM], bary[N_POINTS * ICC_MAX_DIM], t[N_POINTS];
    uint32_t facet[N_POINTS];
    icc_status status[N_POINTS];
    find_points(icc_chart_domain(chart), points);
    require(icc_chart_encode(chart, N_POINTS, points, facet, bary, t, status, NULL, NULL) ==
            ICC_OK);
    for (int i = 0; i < N_POINTS; ++i)
        require(status[i] != ICC_OK || (t[i] >= 0 && t[i] <= 1));
    require(icc_chart_decode(chart, N_POINTS, facet, bary, t, points, NULL, NULL, NULL) == ICC_OK);
}

static void check_status(icc_status status, const void *made)
{
    require(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION ||
            status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED);
    require((made != NULL) == (status == ICC_OK));
}

static void check_chart(const uint8_t *bytes, size_t size, const icc_env *env)
{
    icc_chart *chart;
    size_t n;
    const icc_status status = icc_chart_load(&chart, size, bytes, env, NULL);
    check_status(status, chart);
    if (chart == NULL)
        return;
    uint8_t *again = malloc(size);
    require(again != NULL);
    require(icc_chart_save(chart, size, again, &n) == ICC_OK);
    require(n == size && memcmp(again, bytes, size) == 0);
    check_answers(chart);
    free(again);
    icc_chart_free(chart);
}

/* As many numbers as the chart says, and finite. */
static void check_ties(const icc_map *map, size_t n)
{
    for (size_t k = 0; k < n; ++k) {
        icc_tie_info info = {.size = sizeof info};
        require(icc_map_get_tie(map, k, &info, NULL, NULL) == ICC_OK);
        double *bends = malloc((2 * info.n_target + 1) * sizeof *bends);
        require(bends != NULL);
        require(icc_map_get_tie(map, k, &info, NULL, bends) == ICC_OK);
        for (size_t i = 0; i < 2 * info.n_target; ++i)
            require(isfinite(bends[i]));
        require(isfinite(info.length[0]) && isfinite(info.length[1]));
        free(bends);
    }
}

static void check_map(const uint8_t *bytes, size_t size, const icc_env *env)
{
    icc_map *map;
    size_t n;
    icc_map_info info = {.size = sizeof info};
    const icc_status status = icc_map_load(&map, size, bytes, env, NULL);
    check_status(status, map);
    if (map == NULL)
        return;
    /* An older version becomes the present one when it is saved. Its number is at byte 8. */
    require(icc_map_save(map, 0, NULL, &n) == ICC_OK);
    uint8_t *again = malloc(n);
    require(again != NULL);
    require(icc_map_save(map, n, again, &n) == ICC_OK);
    require(again[8] != bytes[8] || (n == size && memcmp(again, bytes, size) == 0));
    require(icc_map_get_info(map, &info) == ICC_OK);
    if (icc_map_source_chart(map) != NULL) {
        double points[N_POINTS * ICC_MAX_DIM];
        check_answers(icc_map_source_chart(map));
        check_answers(icc_map_target_chart(map));
        find_points(icc_chart_domain(icc_map_source_chart(map)), points);
        require(icc_map_apply(map, N_POINTS, points, points, NULL, NULL, NULL) == ICC_OK);
    }
    check_ties(map, info.n_ties);
    free(again);
    icc_map_free(map);
}

static void check_match(const uint8_t *bytes, size_t size, const icc_env *env)
{
    icc_match *match;
    double points[N_POINTS * 3];
    size_t n;
    const icc_status status = icc_match_load(&match, size, bytes, env, NULL);
    check_status(status, match);
    if (match == NULL)
        return;
    uint8_t *again = malloc(size);
    require(again != NULL);
    require(icc_match_save(match, size, again, &n) == ICC_OK);
    require(n == size && memcmp(again, bytes, size) == 0);
    find_points(icc_match_source(match), points);
    require(icc_match_apply(match, N_POINTS, points, points, NULL, NULL) == ICC_OK);
    require(icc_match_apply_inverse(match, N_POINTS, points, points, NULL, NULL) == ICC_OK);
    free(again);
    icc_match_free(match);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t bytes[LARGEST];
    size_t n_reports = 0;
    const icc_env env = {.size = sizeof env,
                         .user = &n_reports,
                         .alloc = alloc_little,
                         .dealloc = dealloc,
                         .progress = lose_patience};
    if (size < 1 + HEADER || size - 1 > LARGEST)
        return 0;
    const int which = data[0] >> 1 & 3; /* 0, 1, else */
    memcpy(bytes, data + 1, size - 1);
    if (data[0] & 1)
        put_right(bytes, size - 1, which == 0 ? "CHRT" : which == 1 ? "MAP_" : "MTCH");
    if (which == 0)
        check_chart(bytes, size - 1, &env);
    else if (which == 1)
        check_map(bytes, size - 1, &env);
    else
        check_match(bytes, size - 1, &env);
    return 0;
}
