/* Exact signs decide what crosses. A segment that runs through a vertex is cut there, and gets the
 * vertex' own image. */
#include "geo/map_edges.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "geo/crossing.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Cuts this close, as a share of the segment, are one. That is some thousand roundings: edges that
 * meet in a vertex beside the segment are crossed so close to each other. */
static const double SAME_SHARE = 1e-12;

/* An edge of triangles, smaller vertex first. */
typedef struct mesh_edge {
    uint32_t ends[2];
    bool border; /* of one triangle only */
} mesh_edge;

static int by_ends(const void *a, const void *b)
{
    const uint32_t *x = ((const mesh_edge *)a)->ends, *y = ((const mesh_edge *)b)->ends;
    return x[0] != y[0] ? (x[0] > y[0]) - (x[0] < y[0]) : (x[1] > y[1]) - (x[1] < y[1]);
}

/* Lists each edge of the triangles once. Returns their number. */
static size_t list_edges(size_t n_triangles, const uint32_t *triangles, mesh_edge *out)
{
    size_t n = 0, n_kept = 0;
    for (size_t t = 0; t < n_triangles; t++)
        for (size_t k = 0; k < 3; k++) {
            uint32_t a = triangles[3 * t + k], b = triangles[3 * t + (k + 1) % 3];
            out[n++] = (mesh_edge){{a < b ? a : b, a < b ? b : a}, true};
        }
    qsort(out, n, sizeof *out, by_ends);
    for (size_t i = 0; i < n; i++)
        if (i > 0 && by_ends(&out[i], &out[n_kept - 1]) == 0)
            out[n_kept - 1].border = false;
        else
            out[n_kept++] = out[i];
    return n_kept;
}

/* Copies a vertex. y is reversed where the map's domain has it so. */
static void put_end(double *out, const double *vertex, bool flipped)
{
    out[0] = vertex[0];
    out[1] = flipped ? 0 - vertex[1] : vertex[1];
}

/* The mesh of a map: vertices of both sides, in the order of the carrier. */
typedef struct map_mesh {
    double *vertices[2];
    uint32_t *triangles;
    size_t n_triangles;
} map_mesh;

static bool take_mesh(map_mesh *out, const icc_map *map, bool inverse)
{
    icc_map_info info = {.size = sizeof info};
    *out = (map_mesh){0};
    if (icc_map_get_info(map, &info) != ICC_OK || info.kind != ICC_MAP_MESH)
        return false;
    for (size_t side = 0; side < 2; side++)
        out->vertices[side] = need(info.n_vertices, 2 * sizeof(double));
    out->triangles = need(info.n_simplices, 3 * sizeof *out->triangles);
    out->n_triangles = info.n_simplices;
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = info.n_vertices,
                     .vertices = out->vertices[inverse],
                     .n_cells = info.n_simplices,
                     .cells = out->triangles};
    return icc_map_get_mesh(map, &mesh, out->vertices[!inverse]) == ICC_OK;
}

static void add_edges(map_edges *out, size_t room[2], noding *x, const map_mesh *mesh)
{
    const carrier *c = x->cage;
    mesh_edge *edges = need(mesh->n_triangles, 3 * sizeof *edges);
    size_t n = list_edges(mesh->n_triangles, mesh->triangles, edges);
    out->ends = grow(out->ends, &room[0], out->n + n, 4 * sizeof *out->ends);
    out->images = grow(out->images, &room[1], out->n + n, 4 * sizeof *out->images);
    for (size_t i = 0; i < n; i++) {
        double *ends = out->ends + 4 * out->n, *images = out->images + 4 * out->n, shares[2];
        for (size_t k = 0; k < 2; k++) {
            size_t vertex = edges[i].ends[k];
            put_end(ends + 2 * k, mesh->vertices[0] + 2 * vertex, c->flipped[0]);
            put_end(images + 2 * k, mesh->vertices[1] + 2 * vertex, c->flipped[1]);
        }
        bool on_cage = edges[i].border &&
                       noding_common_edge(x, ends, ends + 2, &shares[0], &shares[1]) != GEO_NOWHERE;
        out->n += !on_cage;
    }
    free(edges);
}

bool map_edges_make(map_edges *out, noding *x)
{
    size_t room[2] = {0, 0};
    bool good = true;
    *out = (map_edges){0};
    for (size_t m = 0; m < x->cage->n_maps && good; m++) {
        map_mesh mesh;
        good = take_mesh(&mesh, x->cage->maps[m].map, x->cage->inverse);
        if (good)
            add_edges(out, room, x, &mesh);
        free(mesh.vertices[0]);
        free(mesh.vertices[1]);
        free(mesh.triangles);
    }
    if (good)
        segment_tree_make(&out->tree, out->n, out->ends, 8 * DBL_EPSILON * x->cage->largest);
    return good;
}

void map_edges_free(map_edges *edges)
{
    segment_tree_free(&edges->tree);
    free(edges->ends);
    free(edges->images);
    free(edges->cuts);
    *edges = (map_edges){0};
}

/* Adds the place at a share of an edge. */
static void add_cut(map_edges *e, const double a[2], const double b[2], uint32_t edge, double share)
{
    const double *ends = e->ends + 4 * (size_t)edge, *images = e->images + 4 * (size_t)edge;
    edge_cut cut;
    for (size_t k = 0; k < 2; k++) {
        cut.point[k] = share < 1 ? ends[k] + share * (ends[2 + k] - ends[k]) : ends[2 + k];
        cut.image[k] = share < 1 ? images[k] + share * (images[2 + k] - images[k]) : images[2 + k];
    }
    cut.share = point_distance(a, cut.point) / point_distance(a, b);
    e->cuts = grow(e->cuts, &e->room_cuts, e->n_cuts + 1, sizeof *e->cuts);
    e->cuts[e->n_cuts++] = cut;
}

/* True if p, which is on the line a b, is between a and b. */
static bool is_between(const double a[2], const double b[2], const double p[2])
{
    return point_before(a, p) && point_before(p, b);
}

/* Adds the cuts of the segment a b, a before b, with one edge. */
static void cut_edge(map_edges *e, const double a[2], const double b[2], uint32_t edge)
{
    const double *p = e->ends + 4 * (size_t)edge, *q = p + 2;
    int sign_p = orientation(a, b, p), sign_q = orientation(a, b, q);
    if (sign_p == 0 && is_between(a, b, p))
        add_cut(e, a, b, edge, 0);
    if (sign_q == 0 && is_between(a, b, q))
        add_cut(e, a, b, edge, 1);
    if (sign_p * sign_q < 0 && orientation(p, q, a) * orientation(p, q, b) < 0)
        add_cut(e, a, b, edge, crossing_share(a, b, p, q));
}

/* By shares. Cuts in one place are in any order, as long as it is always the same one. */
static int by_share(const void *a, const void *b)
{
    const edge_cut *x = a, *y = b;
    const double *p = &x->share, *q = &y->share;
    if (*p < *q || *q < *p)
        return *p < *q ? -1 : 1;
    return point_before(x->image, y->image) ? -1 : point_before(y->image, x->image) ? 1 : 0;
}

void map_edges_cut(map_edges *edges, const double a[2], const double b[2])
{
    bool swapped = point_before(b, a);
    const double *from = swapped ? b : a, *to = swapped ? a : b;
    size_t n = 0;
    edges->n_cuts = 0;
    segment_tree_ask(&edges->tree, from, to);
    for (size_t i = 0; i < edges->tree.n_found; i++)
        cut_edge(edges, from, to, edges->tree.found[i]);
    if (edges->n_cuts > 1)
        qsort(edges->cuts, edges->n_cuts, sizeof *edges->cuts, by_share);
    double last = 0;
    for (size_t i = 0; i < edges->n_cuts; i++) {
        edge_cut cut = edges->cuts[i];
        if (cut.share - last > SAME_SHARE && cut.share < 1 - SAME_SHARE) {
            edges->cuts[n++] = cut;
            last = cut.share;
        }
    }
    edges->n_cuts = n;
}
