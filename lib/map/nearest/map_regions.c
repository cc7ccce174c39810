/* Maps all folded regions of a plane map anew, and glues the new maps in. */
#include "map/nearest/map_regions.h"

#include "base/threads.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

icc_status iccp_pieces_create(iccp_pieces *pieces, iccp_plmap *map, const iccp_env *env)
{
    const size_t n = map->corners.n_triangles;
    const iccp_planar mesh = {.n_vertices = map->n_vertices,
                              .n_triangles = n,
                              .triangles = map->corners.vertex,
                              .twins = map->corners.twin};
    *pieces = (iccp_pieces){.map = map};
    iccp_finder_init(&pieces->given, &mesh, map->points, 0, ICCP_FEW_POINTS, &env->memory);
    icc_status status = iccp_regions_create(&pieces->regions, map, env);
    pieces->piece_of = iccp_alloc(&env->memory, n, sizeof *pieces->piece_of);
    pieces->place = iccp_alloc_zero(&env->memory, map->n_vertices, sizeof *pieces->place);
    if (status == ICC_OK && (pieces->piece_of == NULL || pieces->place == NULL))
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        memset(pieces->piece_of, 0xff, n * sizeof *pieces->piece_of);
    return status == ICC_OK ? iccp_finder_ready(&pieces->given) : status;
}

void iccp_pieces_free(iccp_pieces *pieces)
{
    const iccp_memory memory = pieces->regions.memory;
    for (size_t k = 0; k < pieces->n; ++k)
        iccp_refill_free(&pieces->item[k].refill);
    iccp_free(&memory, pieces->item);
    iccp_free(&memory, pieces->piece_of);
    iccp_free(&memory, pieces->place);
    iccp_finder_free(&pieces->given);
    iccp_regions_free(&pieces->regions);
}

/* ---- mapping regions anew ---- */

typedef struct filling {
    const iccp_pieces *p;
    const iccp_rim *rims;
    size_t first; /* piece of the first rim */
    iccp_env env;
} filling;

static icc_status fill_some(void *argument, size_t begin, size_t end)
{
    const filling *f = argument;
    icc_status status = ICC_OK;
    for (size_t k = begin; status == ICC_OK && k < end; ++k)
        status = iccp_refill_create(&f->p->item[f->first + k].refill, &f->rims[k], f->p->map,
                                    &f->p->given, f->p->place, &f->p->vain, &f->env);
    return status;
}

/* Fills n pieces: several on all threads, each on one thread; a single one by itself. */
static icc_status fill_pieces(iccp_pieces *p, const iccp_rim *rims, size_t first, size_t n,
                              const iccp_env *env)
{
    filling f = {p, rims, first, *env};
    if (n == 1)
        return fill_some(&f, 0, 1);
    f.env = iccp_quiet(env);
    f.env.threads = 1;
    f.env.parallel_for = NULL;
    f.env.team = NULL;
    return iccp_for_chunks(env, "repair", n, 1, fill_some, &f);
}

static bool is_filled(const iccp_pieces *p, const iccp_region *region)
{
    const uint32_t k = p->piece_of[region->first];
    return k != NONE && p->item[k].n == region->n && p->item[k].refill.map.n_vertices > 0;
}

static icc_status begin_piece(iccp_pieces *p, const iccp_region *region)
{
    if (p->n == p->room) {
        const size_t room = 2 * p->room + 8;
        if (!iccp_enlarge(&p->regions.memory, &p->item, p->n, room, sizeof *p->item))
            return ICC_ERR_MEMORY;
        p->room = room;
    }
    p->piece_of[region->first] = (uint32_t)p->n;
    p->item[p->n++] =
        (iccp_piece){region->first,
                     region->n,
                     {.map.memory = p->regions.memory, .held.memory = p->regions.memory}};
    return ICC_OK;
}

/* Lists the rim of a region, and gives the vertices inside their places. */
static icc_status begin_rim(iccp_pieces *p, iccp_rim *rim, size_t region, const iccp_env *env)
{
    const icc_status status = iccp_rim_create(rim, &p->regions, region, &env->memory);
    for (size_t i = rim->n_held; status == ICC_OK && i < rim->n_inside; ++i)
        p->place[rim->vertex[rim->n_points + i]] = (uint32_t)(i - rim->n_held);
    return status;
}

/* Maps all regions anew that are new or have grown. *is_done becomes false if one of them has to
 * grow. */
static icc_status fill_regions(iccp_pieces *p, bool *is_done, const iccp_env *env)
{
    iccp_regions *r = &p->regions;
    const size_t first = p->n;
    iccp_rim *rims = iccp_alloc(&env->memory, r->n, sizeof *rims);
    size_t n = 0;
    icc_status status = rims != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t k = 0; status == ICC_OK && k < r->n; ++k)
        if (!is_filled(p, &r->item[k])) {
            status = begin_piece(p, &r->item[k]);
            if (status == ICC_OK)
                status = begin_rim(p, &rims[n++], k, env);
        }
    if (status == ICC_OK && n > 0)
        status = fill_pieces(p, rims, first, n, env);
    for (size_t k = 0; k < n; ++k)
        iccp_rim_free(&rims[k], &env->memory);
    iccp_free(&env->memory, rims);
    for (size_t k = first; k < p->n; ++k)
        iccp_work_charge(&p->vain, p->item[k].refill.vain);
    *is_done = true;
    for (size_t k = 0; status == ICC_OK && k < r->n; ++k)
        if (!is_filled(p, &r->item[k])) {
            *is_done = false;
            r->is_stuck |= p->vain.left < 0;
            status = iccp_regions_widen(r, k);
        }
    return status;
}

/* Lets regions grow until all are filled, or one is everything and cannot be. */
icc_status iccp_pieces_fill(iccp_pieces *pieces, const iccp_env *env)
{
    iccp_pieces *p = pieces;
    bool is_done = false;
    icc_status status = ICC_OK;
    for (size_t round = 0; status == ICC_OK && !is_done && !p->regions.is_stuck; ++round) {
        const iccp_env part = iccp_round(env, round, 1);
        iccp_env half[2];
        iccp_split(half, 2, (const double[]){1, 2}, &part);
        status = iccp_regions_settle(&p->regions, &half[0]);
        if (status == ICC_OK && !p->regions.is_stuck)
            status = fill_regions(p, &is_done, &half[1]);
    }
    return status;
}

/* ---- gluing ---- */

static iccp_refill *refill_of(const iccp_pieces *p, size_t region)
{
    return &p->item[p->piece_of[p->regions.item[region].first]].refill;
}

/* Appends the vertices, triangles and held edges of a region that was mapped anew. */
static icc_status append(iccp_plmap *result, iccp_refill *f, uint32_t *number)
{
    uint32_t *corner = result->corners.vertex + 3 * result->corners.n_triangles;
    for (size_t v = 0; v < f->map.n_vertices; ++v) {
        number[v] = f->vertex[v];
        if (number[v] == NONE) {
            number[v] = (uint32_t)result->n_vertices++;
            iccp_plmap_copy_vertex(result, number[v], &f->map, v);
            if (f->map.fixed[v] != ICCP_ON_POINT)
                result->fixed[number[v]] = ICCP_FREE;
        } else
            memcpy(result->images + 2 * (size_t)number[v], f->map.images + 2 * v,
                   2 * sizeof(double));
    }
    for (size_t c = 0; c < 3 * f->map.corners.n_triangles; ++c)
        *corner++ = number[f->map.corners.vertex[c]];
    result->corners.n_triangles += f->map.corners.n_triangles;
    for (size_t k = 0; k < 2 * f->held.n; ++k)
        f->held.ends[k] = number[f->held.ends[k]];
    return f->held.n > 0 ? iccp_edge_set_add(result->held, f->held.n, f->held.ends) : ICC_OK;
}

/* Counts what the new maps bring. */
typedef struct counts {
    size_t n_new, n_triangles; /* new vertices, and triangles */
    size_t most;               /* vertices of the largest new map */
} counts;

static counts count(const iccp_pieces *p)
{
    counts n = {0};
    for (size_t k = 0; k < p->regions.n; ++k) {
        const iccp_refill *f = refill_of(p, k);
        for (size_t v = 0; v < f->map.n_vertices; ++v)
            n.n_new += f->vertex[v] == NONE;
        n.n_triangles += f->map.corners.n_triangles;
        n.most = f->map.n_vertices > n.most ? f->map.n_vertices : n.most;
    }
    return n;
}

/* Copies the vertices and the triangles that stay. */
static void copy_kept(iccp_plmap *result, const iccp_pieces *p)
{
    const iccp_plmap *map = p->map;
    result->n_vertices = map->n_vertices;
    result->corners.n_triangles = 0;
    for (size_t v = 0; v < map->n_vertices; ++v)
        iccp_plmap_copy_vertex(result, v, map, v);
    for (size_t t = 0; t < map->corners.n_triangles; ++t)
        if (p->regions.region[t] == NONE)
            memcpy(result->corners.vertex + 3 * result->corners.n_triangles++,
                   map->corners.vertex + 3 * t, 3 * sizeof(uint32_t));
}

/* Makes the whole map of what stays and of the new maps. */
static icc_status join(iccp_plmap *result, const iccp_pieces *p, size_t *n_kept,
                       const iccp_env *env)
{
    const iccp_plmap *map = p->map;
    const counts n = count(p);
    bool is_manifold = true;
    uint32_t *number = iccp_alloc(&env->memory, n.most, sizeof *number);
    if (number == NULL)
        return ICC_ERR_MEMORY;
    icc_status status =
        iccp_plmap_begin(result, map->n_vertices + n.n_new,
                         map->corners.n_triangles + n.n_triangles, map->stretch, &env->memory);
    if (status == ICC_OK) {
        copy_kept(result, p);
        *n_kept = result->corners.n_triangles;
        result->held = map->held;
    }
    for (size_t k = 0; status == ICC_OK && k < p->regions.n; ++k)
        status = append(result, refill_of(p, k), number);
    if (status == ICC_OK)
        status = iccp_find_twins(&result->corners, result->n_vertices, &is_manifold, env);
    iccp_free(&env->memory, number);
    return status == ICC_OK && !is_manifold ? ICC_ERR_CERTIFICATE : status;
}

/* Finds the model's images of the vertices that `result` has in addition. */
static icc_status extend_model(double **model, const iccp_pieces *p, const iccp_plmap *result,
                               const iccp_env *env)
{
    const size_t n = p->map->n_vertices;
    if (!iccp_enlarge(&env->memory, model, n, result->n_vertices, 2 * sizeof **model))
        return ICC_ERR_MEMORY;
    for (size_t v = n; v < result->n_vertices; ++v) {
        iccp_found found;
        double *own = *model + 2 * v;
        memcpy(own, result->images + 2 * v, 2 * sizeof *own);
        if (iccp_finder_find(&p->given, result->points + 2 * v, &found) != ICC_OK)
            continue;
        const uint32_t *corner = p->map->corners.vertex + 3 * (size_t)found.triangle;
        for (size_t d = 0; d < 2; ++d)
            own[d] = found.bary[0] * (*model)[2 * (size_t)corner[0] + d] +
                     found.bary[1] * (*model)[2 * (size_t)corner[1] + d] +
                     found.bary[2] * (*model)[2 * (size_t)corner[2] + d];
    }
    return ICC_OK;
}

icc_status iccp_pieces_glue(iccp_pieces *pieces, size_t *n_kept, double **model,
                            const iccp_env *env)
{
    iccp_plmap result = {.memory = env->memory};
    icc_status status = join(&result, pieces, n_kept, env);
    if (status == ICC_OK)
        status = extend_model(model, pieces, &result, env);
    if (status != ICC_OK) {
        iccp_plmap_free(&result);
        return status;
    }
    iccp_plmap_free(pieces->map);
    *pieces->map = result;
    return ICC_OK;
}
