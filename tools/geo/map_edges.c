/* Exact signs decide what crosses. A segment that runs through a vertex is cut there, and gets the
 * vertex' own image. */
#include "geo/map_edges.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "geo/crossing.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cuts this close, as a share of the segment, are one. That is some thousand roundings: edges that
 * meet in a vertex beside the segment are crossed so close to each other. */
static const double SAME_SHARE = 1e-12;

static int by_ends(const void *a, const void *b)
{
    const uint32_t *x = a, *y = b;
    return x[0] != y[0] ? (x[0] > y[0]) - (x[0] < y[0]) : (x[1] > y[1]) - (x[1] < y[1]);
}

/* Lists each edge of the triangles once, smaller vertex first. Returns their number. */
static size_t list_edges(size_t n_triangles, const uint32_t *triangles, uint32_t (*out)[2])
{
    size_t n = 0, n_kept = 0;
    for (size_t t = 0; t < n_triangles; t++)
        for (size_t k = 0; k < 3; k++) {
            uint32_t a = triangles[3 * t + k], b = triangles[3 * t + (k + 1) % 3];
            out[n][0] = a < b ? a : b;
            out[n++][1] = a < b ? b : a;
        }
    qsort(out, n, sizeof *out, by_ends);
    for (size_t i = 0; i < n; i++)
        if (i == 0 || by_ends(out[i], out[i - 1]) != 0)
            memmove(out[n_kept++], out[i], sizeof *out);
    return n_kept;
}

/* Adds an end of an edge. y is reversed where the map's domain has it so. */
static void put_end(double *out, const double *vertex, bool flipped)
{
    out[0] = vertex[0];
    out[1] = flipped ? 0 - vertex[1] : vertex[1];
}

static bool add_edges(map_edges *out, size_t *room, const carrier *c, const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    if (icc_map_get_info(map, &info) != ICC_OK || info.kind != ICC_MAP_MESH)
        return false;
    double *sides[2] = {need(info.n_vertices, 2 * sizeof(double)),
                        need(info.n_vertices, 2 * sizeof(double))};
    uint32_t *triangles = need(info.n_simplices, 3 * sizeof *triangles),
             (*edges)[2] = need(info.n_simplices, 3 * sizeof *edges);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = info.n_vertices,
                     .vertices = sides[0],
                     .n_cells = info.n_simplices,
                     .cells = triangles};
    bool good = icc_map_get_mesh(map, &mesh, sides[1]) == ICC_OK;
    size_t n = good ? list_edges(info.n_simplices, triangles, edges) : 0, room_images = *room;
    out->ends = grow(out->ends, room, out->n + n, 4 * sizeof *out->ends);
    out->images = grow(out->images, &room_images, out->n + n, 4 * sizeof *out->images);
    for (size_t i = 0; i < 2 * n; i++) {
        size_t vertex = edges[i / 2][i % 2];
        put_end(out->ends + 4 * out->n + 2 * i, sides[c->inverse] + 2 * vertex, c->flipped[0]);
        put_end(out->images + 4 * out->n + 2 * i, sides[!c->inverse] + 2 * vertex, c->flipped[1]);
    }
    out->n += n;
    free(sides[0]);
    free(sides[1]);
    free(triangles);
    free(edges);
    return good;
}

bool map_edges_make(map_edges *out, const carrier *c)
{
    size_t room = 0;
    bool good = true;
    *out = (map_edges){0};
    for (size_t m = 0; m < c->n_maps && good; m++)
        good = add_edges(out, &room, c, c->maps[m].map);
    if (good)
        segment_tree_make(&out->tree, out->n, out->ends, 8 * DBL_EPSILON * c->largest);
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
