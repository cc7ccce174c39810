/* Maps a region of a plane map anew (docs/theory/plane-maps.md). Without holes and held vertices it
 * overlays triangulations of the rim and of its image, as for cages. Otherwise it makes a map of
 * two domains with features. Neither uses the folded images inside. */
#include "map/nearest/refill.h"

#include "domain/features.h"
#include "domain/network_same.h"
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
                   status == ICC_ERR_RESOLUTION || status == ICC_ERR_CERTIFICATE ||
                   status == ICC_ERR_TOPOLOGY
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

/* The features of a region: the rings of holes, then held points, then held edges as lines. */
typedef struct contents {
    size_t n_vertices, n;
    uint32_t *place; /* of each vertex: its place in iccp_rim::vertex */
    icc_feature *features;
    double *coordinates; /* 2 n_vertices: those of the domain that is made */
} contents;

static void free_contents(contents *c, const iccp_memory *memory)
{
    iccp_free(memory, c->place);
    iccp_free(memory, c->features);
    iccp_free(memory, c->coordinates);
}

static void add_feature(contents *c, int32_t kind, size_t n, const uint32_t *places)
{
    c->features[c->n++] = (icc_feature){.size = sizeof *c->features,
                                        .kind = kind,
                                        .n_vertices = n,
                                        .vertices = c->coordinates + 2 * c->n_vertices};
    memcpy(c->place + c->n_vertices, places, n * sizeof *places);
    c->n_vertices += n;
}

/* Lists the rings, the held vertices without held edges, and the held edges. `places`: all numbers
 * in rising order. `is_end` has zeros. */
static void list_contents(contents *c, const iccp_rim *rim, const uint32_t *places, uint8_t *is_end)
{
    for (size_t k = 0; k < 2 * rim->n_edges; ++k)
        is_end[rim->edges[k]] = 1;
    memcpy(c->place, places + rim->ring[0].first, rim->ring[0].n * sizeof *places);
    c->n_vertices = rim->ring[0].n;
    for (size_t k = 1; k < rim->n_rings + rim->n_held; ++k)
        if (k < rim->n_rings || !is_end[rim->ring[k].first])
            add_feature(c, k < rim->n_rings ? ICC_FEATURE_HOLE : ICC_FEATURE_POINT, rim->ring[k].n,
                        places + rim->ring[k].first);
    for (size_t k = 0; k < rim->n_edges; ++k)
        add_feature(c, ICC_FEATURE_LINE, 2, rim->edges + 2 * k);
}

static icc_status make_contents(contents *c, const iccp_rim *rim, const iccp_memory *memory)
{
    const size_t n_places = rim->n_points + rim->n_held, most = n_places + 2 * rim->n_edges;
    *c = (contents){.place = iccp_alloc(memory, most, sizeof *c->place),
                    .features = iccp_alloc(memory, rim->n_rings + rim->n_held + rim->n_edges,
                                           sizeof *c->features),
                    .coordinates = iccp_alloc(memory, most, 2 * sizeof *c->coordinates)};
    uint32_t *places = iccp_alloc(memory, n_places, sizeof *places);
    uint8_t *is_end = iccp_alloc_zero(memory, n_places, 1);
    const bool ready = c->place != NULL && c->features != NULL && c->coordinates != NULL &&
                       places != NULL && is_end != NULL;
    for (uint32_t k = 0; ready && k < n_places; ++k)
        places[k] = k;
    if (ready)
        list_contents(c, rim, places, is_end);
    iccp_free(memory, places);
    iccp_free(memory, is_end);
    return ready ? ICC_OK : ICC_ERR_MEMORY;
}

/* Makes the domain before the map, or after it. */
static icc_status make_domain(icc_domain **out, const contents *c, const iccp_rim *rim,
                              const double *coordinates, const iccp_env *env)
{
    for (size_t i = 0; i < c->n_vertices; ++i)
        memcpy(c->coordinates + 2 * i, coordinates + 2 * (size_t)c->place[i],
               2 * sizeof *coordinates);
    return iccp_domain_create_features(out, rim->ring[0].n, c->coordinates, c->n, c->features, env,
                                       NULL);
}

/* Lists the edges of the map that are parts of held ones. */
static icc_status list_held(iccp_refill *f, const iccp_memory *memory)
{
    const iccp_corners *corners = &f->map.corners;
    uint32_t *ends = iccp_alloc(memory, corners->n_triangles, 3 * sizeof *ends);
    size_t n = 0;
    if (ends == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c)
        if (corners->twin[c] != ICCP_NO_NEIGHBOUR && corners->twin[c] > c &&
            iccp_plmap_is_line(&f->map, c)) {
            ends[2 * n] = corners->vertex[iccp_after(c)];
            ends[2 * n++ + 1] = corners->vertex[iccp_before(c)];
        }
    const icc_status status = iccp_edge_set_add(&f->held, n, ends);
    iccp_free(memory, ends);
    return status;
}

/* Brings a map from the domains' local coordinates to those of the whole. Vertices of the domains
 * get their coordinates and numbers from the rim, and are fixed as those of the whole are. */
static icc_status bring_back(iccp_refill *f, const iccp_rim *rim, const contents *inside,
                             const iccp_plmap *whole, icc_domain *const domain[2],
                             const iccp_memory *memory)
{
    uint32_t *at = iccp_alloc(memory, domain[0]->n_vertices, sizeof *at);
    icc_status status =
        at != NULL ? allocate_numbers(f, f->map.n_vertices, memory) : ICC_ERR_MEMORY;
    if (status == ICC_OK && !iccp_plmap_find_vertices(&f->map, at))
        status = ICC_ERR_CERTIFICATE;
    if (status == ICC_OK && rim->n_edges > 0)
        status = list_held(f, memory);
    for (size_t v = 0; status == ICC_OK && v < f->map.n_vertices; ++v) {
        iccp_frame_out(&domain[0]->frame, 2, f->map.points + 2 * v, f->map.points + 2 * v);
        iccp_frame_out(&domain[1]->frame, 2, f->map.images + 2 * v, f->map.images + 2 * v);
        if (f->map.fixed[v] == ICCP_ON_NETWORK)
            f->map.fixed[v] = ICCP_ON_POINT;
    }
    for (size_t i = 0; status == ICC_OK && i < inside->n_vertices; ++i) {
        const size_t v = at[i], own = rim->vertex[inside->place[i]];
        f->vertex[v] = (uint32_t)own;
        f->map.fixed[v] = inside->place[i] < rim->n_points ? ICCP_ALONG : ICCP_ON_POINT;
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
    contents inside;
    icc_status status = make_contents(&inside, rim, &env->memory);
    if (status == ICC_OK)
        status = make_domain(&domain[0], &inside, rim, rim->points, env);
    if (status == ICC_OK)
        status = make_domain(&domain[1], &inside, rim, rim->images, env);
    if (status == ICC_OK && rim->n_edges > 0)
        status = iccp_network_same(domain[0], domain[1], NULL);
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
        status = bring_back(f, rim, &inside, whole, domain, &env->memory);
    iccp_domain_release(domain[0]);
    iccp_domain_release(domain[1]);
    free_contents(&inside, &env->memory);
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
    *refill = (iccp_refill){.map.memory = env->memory, .held.memory = env->memory};
    icc_status status = rim->n_rings == 1 && rim->n_held + rim->n_edges == 0
                            ? fill_disc(refill, rim, whole, &part[0])
                            : fill_features(refill, rim, whole, vain, &part[0]);
    if (status == ICC_OK && !has_rim(refill, rim))
        status = ICC_ERR_CERTIFICATE;
    refill->map.held = &refill->held;
    if (status == ICC_OK)
        status = bring_lost_back(refill, &lost, whole, &part[1]);
    refill->map.held = NULL;
    if (status != ICC_OK)
        iccp_refill_free(refill);
    return forgive(status);
}

void iccp_refill_free(iccp_refill *refill)
{
    const iccp_memory memory = refill->map.memory;
    iccp_plmap_free(&refill->map);
    iccp_free(&memory, refill->vertex);
    iccp_edge_set_free(&refill->held);
    *refill = (iccp_refill){.map.memory = memory, .held.memory = memory, .vain = refill->vain};
}
