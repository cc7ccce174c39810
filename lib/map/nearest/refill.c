/* Maps a region of a plane map anew (docs/theory/plane-maps.md). Without holes and held vertices it
 * overlays triangulations of the rim and of its image, as for cages. Otherwise it makes a map of
 * two domains with features. Neither uses the folded images inside. */
#include "map/nearest/refill.h"

#include "domain/features.h"
#include "map/compatible/compatible.h"
#include "map/compatible/overlay_start.h"
#include "map/energy/schedule.h"
#include "map/nearest/insert_points.h"
#include "map/plane/feature_start.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* Returns ICC_OK for failures that leave the refill empty. */
static icc_status forgive(icc_status status)
{
    return status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE ||
                   status == ICC_ERR_RESOLUTION || status == ICC_ERR_CERTIFICATE
               ? ICC_OK
               : status;
}

static icc_status allocate_numbers(iccp_refill *f, size_t n, const iccp_memory *memory)
{
    f->vertex = iccp_alloc(memory, n, sizeof *f->vertex);
    if (f->vertex == NULL)
        return ICC_ERR_MEMORY;
    memset(f->vertex, 0xff, n * sizeof *f->vertex);
    return ICC_OK;
}

/* ---- a disc with nothing held inside ---- */

static icc_status fill_disc(iccp_refill *f, const iccp_rim *rim, const iccp_plmap *whole,
                            const iccp_env *env)
{
    const size_t n = rim->ring[0].n;
    iccp_overlay overlay = {.memory = env->memory};
    iccp_allowance allowance = iccp_allow(n);
    iccp_work work = {.left = allowance.relaxing};
    icc_status status = iccp_compatible_overlay(&overlay, n, rim->points, rim->images, env);
    if (status == ICC_OK)
        status = iccp_plmap_of_overlay(&f->map, n, &overlay, whole->stretch, &env->memory);
    iccp_overlay_free(&overlay);
    if (status == ICC_OK && !iccp_plmap_is_positive(&f->map))
        return ICC_ERR_CERTIFICATE;
    if (status == ICC_OK)
        status = iccp_overlay_relax(&f->map, &work, env);
    if (status == ICC_OK)
        status = allocate_numbers(f, f->map.n_vertices, &env->memory);
    for (size_t k = 0; status == ICC_OK && k < n; ++k)
        f->vertex[k] = rim->vertex[k];
    return status;
}

/* ---- with holes and held vertices ---- */

/* Makes the domain before the map, or after it. */
static icc_status make_domain(icc_domain **out, const iccp_rim *rim, const double *coordinates,
                              const iccp_env *env)
{
    const size_t n = rim->n_rings - 1 + rim->n_held;
    icc_feature *features = iccp_alloc_zero(&env->memory, n, sizeof *features);
    *out = NULL;
    if (features == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < n; ++k)
        features[k] =
            (icc_feature){.size = sizeof *features,
                          .kind = k < rim->n_rings - 1 ? ICC_FEATURE_HOLE : ICC_FEATURE_POINT,
                          .n_vertices = rim->ring[k + 1].n,
                          .vertices = coordinates + 2 * (size_t)rim->ring[k + 1].first};
    const icc_status status =
        iccp_domain_create_features(out, rim->ring[0].n, coordinates, n, features, env, NULL);
    iccp_free(&env->memory, features);
    return status;
}

/* Brings a map from the domains' local coordinates to those of the whole. Vertices of the domains
 * get their coordinates and numbers from the rim, and are fixed as those of the whole are. */
static icc_status bring_back(iccp_refill *f, const iccp_rim *rim, const iccp_plmap *whole,
                             icc_domain *const domain[2], const iccp_memory *memory)
{
    uint32_t *at = iccp_alloc(memory, domain[0]->n_vertices, sizeof *at);
    icc_status status =
        at != NULL ? allocate_numbers(f, f->map.n_vertices, memory) : ICC_ERR_MEMORY;
    if (status == ICC_OK && !iccp_plmap_find_vertices(&f->map, at))
        status = ICC_ERR_CERTIFICATE;
    for (size_t v = 0; status == ICC_OK && v < f->map.n_vertices; ++v) {
        iccp_frame_out(&domain[0]->frame, 2, f->map.points + 2 * v, f->map.points + 2 * v);
        iccp_frame_out(&domain[1]->frame, 2, f->map.images + 2 * v, f->map.images + 2 * v);
    }
    size_t i = 0;
    for (size_t k = 0; status == ICC_OK && k < rim->n_rings + rim->n_held; ++k)
        for (uint32_t j = rim->ring[k].first; j < rim->ring[k].first + rim->ring[k].n; ++j) {
            const size_t v = at[i++], own = rim->vertex[j];
            f->vertex[v] = (uint32_t)own;
            f->map.fixed[v] = k < rim->n_rings ? ICCP_ALONG : ICCP_ON_POINT;
            memcpy(f->map.points + 2 * v, whole->points + 2 * own, 2 * sizeof(double));
            memcpy(f->map.images + 2 * v, whole->images + 2 * own, 2 * sizeof(double));
        }
    f->map.stretch = whole->stretch;
    f->map.featured = NULL;
    iccp_free(memory, at);
    return status == ICC_OK && !iccp_plmap_is_positive(&f->map) ? ICC_ERR_CERTIFICATE : status;
}

static icc_status fill_features(iccp_refill *f, const iccp_rim *rim, const iccp_plmap *whole,
                                const iccp_work *vain, const iccp_env *env)
{
    const icc_map_options options = {.size = sizeof options};
    icc_domain *domain[2] = {NULL, NULL};
    iccp_feature_report report = {.cuts.memory = env->memory};
    icc_status status = make_domain(&domain[0], rim, rim->points, env);
    if (status == ICC_OK)
        status = make_domain(&domain[1], rim, rim->images, env);
    if (status == ICC_OK) {
        iccp_allowance allowance = iccp_allow(domain[0]->features->n_places);
        allowance.overlay.left = allowance.relaxing;
        allowance.vain = *vain;
        status = iccp_feature_start(&f->map, domain[0], domain[1], &options, &allowance, &report,
                                    env, NULL);
        f->vain = allowance.vain.spent;
        iccp_feature_report_free(&report);
    }
    if (status == ICC_OK)
        status = bring_back(f, rim, whole, domain, &env->memory);
    iccp_domain_release(domain[0]);
    iccp_domain_release(domain[1]);
    return status;
}

/* ---- vertices inside ---- */

/* Whether the map has the edges of the rim, and no others on its boundary. */
static bool has_rim(const iccp_refill *f, const iccp_rim *rim)
{
    size_t n = 0;
    for (size_t c = 0; c < 3 * f->map.corners.n_triangles; ++c)
        n += f->map.corners.twin[c] == ICCP_NO_NEIGHBOUR;
    return n == rim->n_points - rim->n_rings;
}

/* Lists the lost vertices that no vertex of the map has become. Returns their number. */
static size_t list_missing(uint32_t *missing, const iccp_refill *f, const iccp_lost *lost,
                           uint8_t *is_there)
{
    size_t n = 0;
    for (size_t v = 0; v < f->map.n_vertices; ++v) {
        const uint32_t own = f->vertex[v];
        if (own != NONE && lost->place[own] < lost->n && lost->inside[lost->place[own]] == own)
            is_there[lost->place[own]] = 1;
    }
    for (size_t i = 0; i < lost->n; ++i)
        if (!is_there[i])
            missing[n++] = lost->inside[i];
    return n;
}

/* Inserts n vertices that the region had. */
static icc_status insert(iccp_refill *f, size_t n, const uint32_t *missing, const iccp_plmap *whole,
                         const iccp_env *env)
{
    const size_t before = f->map.n_vertices;
    double *points = iccp_alloc(&env->memory, n, 2 * sizeof *points);
    uint32_t *number = iccp_alloc(&env->memory, n, sizeof *number);
    bool is_done = false;
    icc_status status = ICC_ERR_MEMORY;
    if (points != NULL && number != NULL) {
        for (size_t i = 0; i < n; ++i)
            memcpy(points + 2 * i, whole->points + 2 * (size_t)missing[i], 2 * sizeof *points);
        status = iccp_insert_points(&f->map, n, points, number, &is_done, env);
    }
    if (status == ICC_OK &&
        !iccp_enlarge(&env->memory, &f->vertex, before, before + n, sizeof *f->vertex))
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        memset(f->vertex + before, 0xff, n * sizeof *f->vertex);
    for (size_t i = 0; status == ICC_OK && is_done && i < n; ++i) {
        is_done = f->vertex[number[i]] == NONE;
        f->vertex[number[i]] = missing[i];
    }
    iccp_free(&env->memory, points);
    iccp_free(&env->memory, number);
    return status == ICC_OK && !is_done ? ICC_ERR_CERTIFICATE : status;
}

/* Gives the map all vertices that the region had. */
static icc_status bring_lost_back(iccp_refill *f, const iccp_lost *lost, const iccp_plmap *whole,
                                  const iccp_env *env)
{
    uint32_t *missing = iccp_alloc(&env->memory, lost->n, sizeof *missing);
    uint8_t *is_there = iccp_alloc_zero(&env->memory, lost->n, 1);
    icc_status status = missing != NULL && is_there != NULL
                            ? iccp_adopt_vertices(&f->map, f->vertex, lost, env)
                            : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = insert(f, list_missing(missing, f, lost, is_there), missing, whole, env);
    iccp_free(&env->memory, missing);
    iccp_free(&env->memory, is_there);
    return status;
}

icc_status iccp_refill_create(iccp_refill *refill, const iccp_rim *rim, const iccp_plmap *whole,
                              const iccp_finder *given, const uint32_t *place,
                              const iccp_work *vain, const iccp_env *env)
{
    const iccp_lost lost = {given, rim->vertex + rim->n_points + rim->n_held, place,
                            rim->n_inside - rim->n_held};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, env);
    *refill = (iccp_refill){.map.memory = env->memory};
    icc_status status = rim->n_rings == 1 && rim->n_held == 0
                            ? fill_disc(refill, rim, whole, &part[0])
                            : fill_features(refill, rim, whole, vain, &part[0]);
    if (status == ICC_OK && !has_rim(refill, rim))
        status = ICC_ERR_CERTIFICATE;
    if (status == ICC_OK)
        status = bring_lost_back(refill, &lost, whole, &part[1]);
    if (status != ICC_OK)
        iccp_refill_free(refill);
    return forgive(status);
}

void iccp_refill_free(iccp_refill *refill)
{
    const iccp_memory memory = refill->map.memory;
    iccp_plmap_free(&refill->map);
    iccp_free(&memory, refill->vertex);
    *refill = (iccp_refill){.map.memory = memory, .vain = refill->vain};
}
