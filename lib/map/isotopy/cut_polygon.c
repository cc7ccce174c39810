/* Cuts a domain open to one polygon. The inside of the domain is triangulated with walls, cuts and
 * diagonals between vertices. It is then parted along all walls and cuts. The result is one
 * polygon, because the cuts join the components to a tree. */
#include "map/isotopy/cut_polygon.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* All points of one side: the domain's vertices, then the bends. */
static double *list_points(const iccp_domain_pair *domains, int side, const iccp_cuts *cuts,
                           const iccp_memory *memory)
{
    const size_t n_bends = cuts->first[cuts->n];
    double *points = iccp_alloc(memory, domains->n + n_bends, 2 * sizeof *points);
    if (points == NULL)
        return NULL;
    memcpy(points, domains->domain[side]->vertices, 2 * domains->n * sizeof *points);
    if (n_bends > 0)
        memcpy(points + 2 * domains->n, cuts->points[side], 2 * n_bends * sizeof *points);
    return points;
}

/* Collects the walls of the domain and the pieces of the cuts. */
static icc_status list_walls(iccp_walls *walls, const iccp_domain_pair *domains,
                             const iccp_cuts *cuts, const iccp_memory *memory)
{
    const size_t n_bends = cuts->first[cuts->n], n = domains->n_walls + n_bends + cuts->n;
    uint32_t *pairs = iccp_alloc(memory, n, 2 * sizeof *pairs), *pair = pairs;
    if (pairs == NULL)
        return ICC_ERR_MEMORY;
    memcpy(pairs, domains->pairs, 2 * domains->n_walls * sizeof *pairs);
    pair += 2 * domains->n_walls;
    for (size_t i = 0; i < cuts->n; ++i) {
        *pair++ = cuts->ends[2 * i];
        for (uint32_t bend = cuts->first[i]; bend < cuts->first[i + 1]; ++bend)
            for (int twice = 0; twice < 2; ++twice)
                *pair++ = (uint32_t)domains->n + bend;
        *pair++ = cuts->ends[2 * i + 1];
    }
    const icc_status status = iccp_walls_create(walls, domains->n + n_bends, n, pairs, memory);
    iccp_free(memory, pairs);
    return status;
}

typedef struct round_trip {
    const iccp_corners *mesh; /* its vertices are the domain's vertices and the bends */
    const iccp_walls *walls;
    uint32_t *number; /* of each corner of the mesh: the polygon's corner there */
    uint32_t *edge;   /* of each corner of the mesh: the polygon's edge that it faces */
} round_trip;

static bool is_wall(const round_trip *w, uint32_t corner)
{
    const uint32_t *v = w->mesh->vertex;
    return iccp_walls_have(w->walls, v[iccp_after(corner)], v[iccp_before(corner)]);
}

/* Goes from the edge that a corner faces to the next edge of the polygon. Sets the polygon's corner
 * for all corners of the mesh between these two edges. */
static uint32_t next_edge(const round_trip *w, uint32_t facing, uint32_t number)
{
    for (;;) {
        const uint32_t other = iccp_after(facing);
        w->number[iccp_before(facing)] = number;
        if (is_wall(w, other))
            return other;
        facing = w->mesh->twin[other];
    }
}

/* Returns the corner inside the domain that faces the first edge of the outer ring. */
static uint32_t find_begin(const iccp_corners *mesh, const icc_domain *domain)
{
    const uint32_t a = domain->orientation > 0 ? 0 : 1, b = 1 - a;
    uint32_t c = 0;
    while (mesh->vertex[iccp_after(c)] != a || mesh->vertex[iccp_before(c)] != b)
        ++c;
    return c;
}

/* Walks once around the polygon. ICC_ERR_TOPOLOGY if the walk does not meet all corners of the
 * mesh's triangles, which means that the cuts do not make one polygon. */
static icc_status go_round(const round_trip *w, iccp_cut_polygon *p, uint32_t begin)
{
    uint32_t facing = begin, n = 0;
    memset(w->edge, 0xff, 3 * w->mesh->n_triangles * sizeof *w->edge);
    do {
        if (n == p->n)
            return ICC_ERR_TOPOLOGY;
        p->vertex[n] = w->mesh->vertex[iccp_after(facing)];
        w->edge[facing] = n++;
        facing = next_edge(w, facing, n < p->n ? n : 0);
    } while (facing != begin);
    return n == p->n ? ICC_OK : ICC_ERR_TOPOLOGY;
}

/* Parts the triangles along the polygon's edges. Replaces their vertices by the polygon's
 * corners. */
static void part(const round_trip *w, iccp_cut_polygon *p, const double *points)
{
    for (size_t c = 0; c < 3 * w->mesh->n_triangles; ++c) {
        const uint32_t twin = w->mesh->twin[c];
        p->mesh.vertex[c] = w->number[c];
        p->mesh.twin[c] = w->edge[c] == NONE ? twin : NONE;
        if (w->edge[c] != NONE)
            p->partner[w->edge[c]] = twin != NONE ? w->edge[twin] : NONE;
    }
    for (size_t i = 0; i < p->n; ++i)
        memcpy(p->points + 2 * i, points + 2 * (size_t)p->vertex[i], 2 * sizeof *points);
}

static icc_status open_up(iccp_cut_polygon *p, const iccp_corners *mesh, const icc_domain *domain,
                          const iccp_walls *walls, const double *points)
{
    const iccp_memory *memory = &p->memory;
    const size_t n_corners = 3 * mesh->n_triangles;
    round_trip w = {mesh, walls, iccp_alloc(memory, n_corners, sizeof *w.number),
                    iccp_alloc(memory, n_corners, sizeof *w.edge)};
    p->n = (uint32_t)mesh->n_triangles + 2;
    p->vertex = iccp_alloc(memory, p->n, sizeof *p->vertex);
    p->partner = iccp_alloc(memory, p->n, sizeof *p->partner);
    p->points = iccp_alloc(memory, p->n, 2 * sizeof *p->points);
    p->mesh.n_triangles = mesh->n_triangles;
    p->mesh.vertex = iccp_alloc(memory, n_corners, sizeof *p->mesh.vertex);
    p->mesh.twin = iccp_alloc(memory, n_corners, sizeof *p->mesh.twin);
    icc_status status = ICC_ERR_MEMORY;
    if (w.number != NULL && w.edge != NULL && p->vertex != NULL && p->partner != NULL &&
        p->points != NULL && p->mesh.vertex != NULL && p->mesh.twin != NULL)
        status = go_round(&w, p, find_begin(mesh, domain));
    if (status == ICC_OK)
        part(&w, p, points);
    iccp_free(memory, w.number);
    iccp_free(memory, w.edge);
    return status;
}

icc_status iccp_cut_polygon_create(iccp_cut_polygon *polygon, const iccp_domain_pair *domains,
                                   int side, const iccp_cuts *cuts, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const icc_domain *domain = domains->domain[side];
    double *points = list_points(domains, side, cuts, memory);
    iccp_walls walls = {0};
    iccp_corners mesh = {0};
    *polygon = (iccp_cut_polygon){.memory = *memory};
    icc_status status = ICC_ERR_MEMORY;
    if (points != NULL)
        status = list_walls(&walls, domains, cuts, memory);
    if (status == ICC_OK)
        status = iccp_triangulate_inside(&mesh, domain, domains->n + cuts->first[cuts->n], points,
                                         &walls, env);
    if (status == ICC_OK)
        status = open_up(polygon, &mesh, domain, &walls, points);
    else if (status != ICC_ERR_MEMORY && status != ICC_ERR_CANCELLED)
        status = ICC_ERR_CERTIFICATE;
    iccp_free(memory, mesh.vertex);
    iccp_free(memory, mesh.twin);
    iccp_walls_free(&walls, memory);
    iccp_free(memory, points);
    if (status != ICC_OK)
        iccp_cut_polygon_free(polygon);
    return status;
}

void iccp_cut_polygon_free(iccp_cut_polygon *p)
{
    const iccp_memory *memory = &p->memory;
    iccp_free(memory, p->vertex);
    iccp_free(memory, p->partner);
    iccp_free(memory, p->points);
    iccp_free(memory, p->mesh.vertex);
    iccp_free(memory, p->mesh.twin);
    *p = (iccp_cut_polygon){.memory = p->memory};
}
