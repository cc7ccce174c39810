/* A pocket is a stuck tetrahedron with some rings of neighbours. Its region before the map and its
 * region after the map must be bounded by spheres that do not intersect themselves. Then it is a
 * small pair of surfaces like any other. Both are filled anew, and a map from one to the other
 * replaces the old one. */
#include "map/solid/solid_pockets.h"

#include "fill/fill_domain.h"
#include "map/energy/mesh_repair.h"
#include "map/solid/solid_edit.h"
#include "map/solid/solid_ways.h"

#include <string.h>

/* Limits: tetrahedra in a pocket, and stuck tetrahedra for which pockets are worth trying. */
enum { FEWEST_TETS = 16, MOST_TETS = 4096, MOST_STUCK = 40 };

static const uint32_t OUTSIDE = UINT32_MAX;

typedef struct pocket {
    const iccp_solid_map *map;
    size_t n, n_rim, n_faces; /* tetrahedra; points and faces on the boundary */
    uint32_t *tet;
    uint8_t *is_in;   /* of each tetrahedron of the mesh */
    uint32_t *number; /* of each point */
    uint32_t *point;  /* the points on the boundary */
    uint32_t *faces;
    double *before, *after; /* of the points on the boundary */
} pocket;

static void forget(pocket *p)
{
    iccp_free(&p->map->memory, p->faces);
    iccp_free(&p->map->memory, p->before);
    iccp_free(&p->map->memory, p->after);
    p->faces = NULL;
    p->before = p->after = NULL;
}

static void free_pocket(pocket *p)
{
    const iccp_memory *memory = &p->map->memory;
    forget(p);
    iccp_free(memory, p->tet);
    iccp_free(memory, p->is_in);
    iccp_free(memory, p->number);
    iccp_free(memory, p->point);
}

static icc_status alloc_pocket(pocket *p, const iccp_solid_map *map)
{
    const iccp_simplices *mesh = map->mesh;
    const iccp_memory *memory = &map->memory;
    *p = (pocket){.map = map};
    p->tet = iccp_alloc(memory, mesh->n_simplices, sizeof *p->tet);
    p->is_in = iccp_alloc(memory, mesh->n_simplices, sizeof *p->is_in);
    p->number = iccp_alloc(memory, mesh->n_points, sizeof *p->number);
    p->point = iccp_alloc(memory, mesh->n_points, sizeof *p->point);
    return p->tet != NULL && p->is_in != NULL && p->number != NULL && p->point != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* ---- choosing the tetrahedra ---- */

static void add(pocket *p, size_t tet)
{
    if (p->is_in[tet] != 0)
        return;
    p->is_in[tet] = 1;
    p->tet[p->n++] = (uint32_t)tet;
    for (size_t i = 0; i < 4; ++i)
        p->number[p->map->mesh->corners[4 * tet + i]] = 0;
}

static bool has_edge(const pocket *p, uint32_t a, uint32_t b)
{
    const iccp_simplices *mesh = p->map->mesh;
    for (size_t k = 0; k < p->n; ++k) {
        int n = 0;
        for (size_t i = 0; i < 4; ++i) {
            const uint32_t v = mesh->corners[4 * (size_t)p->tet[k] + i];
            n += v == a || v == b;
        }
        if (n == 2)
            return true;
    }
    return false;
}

/* Returns true if the pocket stays a ball when a tetrahedron next to it is added. The part that
 * their common sides do not contain, a point or an edge, must not be in the pocket. */
static bool fits(const pocket *p, size_t tet)
{
    const uint32_t *v = p->map->mesh->corners + 4 * tet, *across = p->map->mesh->across + 4 * tet;
    size_t n = 0, opposite[4];
    for (size_t i = 0; i < 4; ++i)
        if ((across[i] & ICCP_ON_BOUNDARY) == 0 && p->is_in[across[i] / 4] != 0)
            opposite[n++] = i;
    return n == 1   ? p->number[v[opposite[0]]] == OUTSIDE
           : n == 2 ? !has_edge(p, v[opposite[0]], v[opposite[1]])
                    : n == 3;
}

/* Adds neighbours in the order of their discovery until there are n tetrahedra. It ends when a
 * round adds nothing. */
static void grow(pocket *p, size_t n)
{
    const iccp_simplices *mesh = p->map->mesh;
    for (size_t before = 0; before < p->n && p->n < n;) {
        before = p->n;
        for (size_t k = 0; k < 4 * before && p->n < n; ++k) {
            const uint32_t across = mesh->across[4 * (size_t)p->tet[k / 4] + k % 4];
            if ((across & ICCP_ON_BOUNDARY) == 0 && p->is_in[across / 4] == 0 &&
                fits(p, across / 4))
                add(p, across / 4);
        }
    }
}

static void start(pocket *p, size_t tet)
{
    memset(p->is_in, 0, p->map->mesh->n_simplices * sizeof *p->is_in);
    memset(p->number, 0xff, p->map->mesh->n_points * sizeof *p->number);
    p->n = 0;
    add(p, tet);
}

static bool is_rim(const pocket *p, size_t side)
{
    const uint32_t across = p->map->mesh->across[side];
    return (across & ICCP_ON_BOUNDARY) != 0 || p->is_in[across / 4] == 0;
}

/* ---- its boundary ---- */

static icc_status alloc_boundary(pocket *p)
{
    const iccp_memory *memory = &p->map->memory;
    p->n_faces = 0;
    for (size_t k = 0; k < 4 * p->n; ++k)
        p->n_faces += is_rim(p, 4 * (size_t)p->tet[k / 4] + k % 4);
    p->faces = iccp_alloc(memory, p->n_faces, 3 * sizeof *p->faces);
    p->before = iccp_alloc(memory, 3 * p->n_faces, 3 * sizeof *p->before);
    p->after = iccp_alloc(memory, 3 * p->n_faces, 3 * sizeof *p->after);
    return p->faces != NULL && p->before != NULL && p->after != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Lists the faces by numbers of their points in the order of discovery, and the points' places
 * before and after the map. */
static void list_boundary(pocket *p)
{
    const iccp_simplices *mesh = p->map->mesh;
    uint32_t *out = p->faces;
    memset(p->number, 0xff, mesh->n_points * sizeof *p->number);
    p->n_rim = 0;
    for (size_t k = 0; k < 4 * p->n; ++k) {
        const size_t side = 4 * (size_t)p->tet[k / 4] + k % 4;
        uint32_t v[3];
        if (!is_rim(p, side))
            continue;
        iccp_simplices_side(mesh, side, v);
        for (size_t i = 0; i < 3; ++i) {
            if (p->number[v[i]] == OUTSIDE) {
                p->number[v[i]] = (uint32_t)p->n_rim;
                p->point[p->n_rim++] = v[i];
            }
            *out++ = p->number[v[i]];
        }
    }
    for (size_t v = 0; v < p->n_rim; ++v) {
        memcpy(p->before + 3 * v, mesh->points + 3 * (size_t)p->point[v], 3 * sizeof *p->before);
        memcpy(p->after + 3 * v, p->map->images + 3 * (size_t)p->point[v], 3 * sizeof *p->after);
    }
}

/* ---- replacing the pocket ---- */

/* Renumbers the points without those inside the pocket. */
static size_t renumber(pocket *p)
{
    const iccp_simplices *mesh = p->map->mesh;
    size_t n = 0;
    memset(p->number, 0xff, mesh->n_points * sizeof *p->number);
    for (size_t c = 0; c < 4 * mesh->n_simplices; ++c)
        if (p->is_in[c / 4] == 0)
            p->number[mesh->corners[c]] = 0;
    for (size_t v = 0; v < p->n_rim; ++v)
        p->number[p->point[v]] = 0;
    for (size_t v = 0; v < mesh->n_points; ++v)
        if (p->number[v] != OUTSIDE)
            p->number[v] = (uint32_t)n++;
    return n;
}

/* Joins the tetrahedra outside the pocket with their replacements inside. */
static void join(const iccp_solid_map *map, const pocket *p, const icc_domain *before,
                 const icc_domain *after, const iccp_simplices *part, const double *part_images,
                 iccp_simplices *mesh, double *images)
{
    const iccp_simplices *old = map->mesh;
    const size_t n_kept = mesh->n_points - (part->n_points - p->n_rim);
    for (size_t v = 0; v < old->n_points; ++v)
        if (p->number[v] != OUTSIDE) {
            const size_t at = p->number[v];
            memcpy(mesh->points + 3 * at, old->points + 3 * v, 3 * sizeof *images);
            memcpy(images + 3 * at, map->images + 3 * v, 3 * sizeof *images);
        }
    for (size_t v = p->n_rim; v < part->n_points; ++v) {
        const size_t at = n_kept + v - p->n_rim;
        iccp_frame_out(&before->frame, 3, part->points + 3 * v, mesh->points + 3 * at);
        iccp_frame_out(&after->frame, 3, part_images + 3 * v, images + 3 * at);
    }
    uint32_t *out = mesh->corners;
    for (size_t c = 0; c < 4 * old->n_simplices; ++c)
        if (p->is_in[c / 4] == 0)
            *out++ = p->number[old->corners[c]];
    for (size_t c = 0; c < 4 * part->n_simplices; ++c) {
        const uint32_t v = part->corners[c];
        *out++ = v < p->n_rim ? p->number[p->point[v]] : (uint32_t)(n_kept + v - p->n_rim);
    }
}

/* Returns true if fewer tetrahedra are inverted and none is flat before the map. A tetrahedron that
 * was positive in the coordinates of two other domains may not be so after rounding to the map's.
 * The falling number ensures that the loop over pockets ends. */
static bool is_better(const iccp_simplices *mesh, double *images, const iccp_solid_map *map)
{
    const iccp_simplicial_map before = iccp_simplicial_map_of(mesh, mesh->points);
    const iccp_simplicial_map after = iccp_simplicial_map_of(mesh, images);
    return iccp_simplicial_count_inverted(&before) == 0 &&
           iccp_simplicial_count_inverted(&after) < iccp_solid_count_inverted(map);
}

/* Replaces the pocket by `part`, a mesh with images in the coordinates of two other domains. Does
 * nothing if this is no improvement. */
static icc_status splice(iccp_solid_map *map, pocket *p, const icc_domain *before,
                         const icc_domain *after, const iccp_simplices *part,
                         const double *part_images, bool *done)
{
    const iccp_simplices *old = map->mesh;
    const size_t n_kept = renumber(p);
    iccp_simplices *mesh = iccp_alloc_zero(&map->memory, 1, sizeof *mesh);
    if (mesh == NULL)
        return ICC_ERR_MEMORY;
    *mesh = (iccp_simplices){.memory = map->memory,
                             .dim = 3,
                             .n_points = n_kept + part->n_points - p->n_rim,
                             .n_boundary = old->n_boundary,
                             .n_simplices = old->n_simplices - p->n + part->n_simplices};
    mesh->points = iccp_alloc(&map->memory, mesh->n_points, 3 * sizeof *mesh->points);
    mesh->corners = iccp_alloc(&map->memory, mesh->n_simplices, 4 * sizeof *mesh->corners);
    double *images = iccp_alloc(&map->memory, mesh->n_points, 3 * sizeof *images);
    const bool has_memory = mesh->points != NULL && mesh->corners != NULL && images != NULL;
    if (has_memory) {
        join(map, p, before, after, part, part_images, mesh, images);
        iccp_mesh_round(mesh, images);
        *done = is_better(mesh, images, map);
    }
    if (*done) {
        iccp_solid_take(map, mesh, images);
        return ICC_OK;
    }
    iccp_simplices_free(mesh);
    iccp_free(&map->memory, images);
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}

/* ---- the loop over pockets ---- */

/* Fills the region inside the boundary. NULL if doubles cannot fill it. */
static icc_status fill(icc_domain **filled, const pocket *p, const double *vertices,
                       const iccp_env *env)
{
    icc_domain *surface = NULL;
    *filled = NULL;
    icc_status status =
        iccp_domain_create(&surface, 3, p->n_rim, vertices, p->n_faces, p->faces, env, NULL);
    if (status == ICC_OK)
        status = iccp_domain_fill_for_map(filled, surface, env, NULL);
    iccp_domain_release(surface);
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ? status : ICC_OK;
}

/* Maps the gathered pocket anew and puts it in place. *done tells if this succeeded. */
static icc_status put_in_place(iccp_solid_map *map, pocket *p, const icc_domain *source,
                               iccp_solid_solve *solve, bool *done, const iccp_env *env)
{
    icc_domain *before = NULL, *after = NULL;
    iccp_simplices *part = NULL;
    double *images = NULL;
    iccp_env stage[3];
    iccp_split(stage, 3, (const double[]){1, 1, 4}, env);
    icc_status status = alloc_boundary(p);
    if (status == ICC_OK) {
        list_boundary(p);
        status = fill(&after, p, p->after, &stage[0]);
    }
    if (status == ICC_OK && after != NULL)
        status = fill(&before, p, p->before, &stage[1]);
    if (status == ICC_OK && before != NULL)
        status = solve(&part, &images, before, after, &stage[2]);
    if (status == ICC_OK && part != NULL)
        status = splice(map, p, before, after, part, images, done);
    if (status == ICC_OK && *done) {
        iccp_log(env, "a pocket of %zu tetrahedra is mended", p->n);
        status = iccp_solid_check(map, source, env);
    }
    iccp_domain_release(before);
    iccp_domain_release(after);
    iccp_simplices_free(part);
    iccp_free(&env->memory, images);
    forget(p);
    return status;
}

/* Tries pockets around a tetrahedron that grow more and more. */
static icc_status mend(iccp_solid_map *map, size_t tet, const icc_domain *source,
                       iccp_solid_solve *solve, bool *done, const iccp_env *env)
{
    pocket p;
    icc_status status = alloc_pocket(&p, map);
    size_t n = FEWEST_TETS;
    *done = false;
    for (size_t k = 0; status == ICC_OK && !*done && n <= MOST_TETS; ++k, n *= 2) {
        const iccp_env part = iccp_round(env, k, 4);
        start(&p, tet);
        grow(&p, n);
        status = put_in_place(map, &p, source, solve, done, &part);
        if (!*done && p.n < n)
            break;
    }
    free_pocket(&p);
    return status;
}

icc_status iccp_solid_mend_pockets(iccp_solid_map *map, const icc_domain *source,
                                   iccp_solid_solve *solve, const iccp_env *env)
{
    bool done = iccp_solid_count_inverted(map) <= MOST_STUCK;
    icc_status status = ICC_OK;
    for (size_t k = 0; status == ICC_OK && done; ++k) {
        const iccp_env part = iccp_round(env, k, 4);
        const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
        size_t tet = 0;
        while (tet < map->mesh->n_simplices && iccp_simplicial_is_positive(&simplicial, tet))
            ++tet;
        if (tet == map->mesh->n_simplices)
            break;
        status = mend(map, tet, source, solve, &done, &part);
    }
    return status;
}
