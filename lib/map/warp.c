/* Through the mesh the inverse of a map is one affine map for each triangle of the target, so
 * pictures are drawn triangle by triangle, row by row, without looking for the triangle of a pixel.
 *
 * Where a triangle shrinks the picture its rows are sampled more finely and gathered. A pixel
 * belongs to the triangle that holds its centre: either it is painted by that triangle at once, or
 * it is the mean of what all triangles that gather have in it. */
#include "map/warp.h"

#include "base/threads.h"
#include "map/boundary_pixels.h"
#include "map/scan.h"
#include "map/warp_points.h"

#include <string.h>

/* Rows in a task; the triangles that come into them are listed once. */
enum { ROWS = 8 };

typedef struct warp {
    const icc_map *map;
    const icc_picture *target;
    iccp_sampler source;
    size_t pixel; /* bytes */
    const iccp_memory *memory;
    iccp_place *places; /* of each vertex */
    iccp_scan *scans;   /* of each triangle */
    size_t n_bands;
    size_t *first;     /* n_bands + 1: where a band's triangles begin in `entries` */
    uint32_t *entries; /* triangles, band after band */
} warp;

/* ---- triangles ---- */

static void place_vertices(warp *w)
{
    const iccp_plmap *pl = &w->map->mesh->pl;
    for (size_t v = 0; v < pl->n_vertices; ++v) {
        double from[2], to[2];
        iccp_frame_out(&w->map->source_domain->frame, 2, pl->points + 2 * v, from);
        iccp_frame_out(&w->map->target_domain->frame, 2, pl->images + 2 * v, to);
        w->places[v] = (iccp_place){to[0], to[1], from[0] - 0.5, from[1] - 0.5};
    }
}

static void scan_triangles(warp *w)
{
    const iccp_corners *corners = &w->map->mesh->pl.corners;
    for (size_t t = 0; t < corners->n_triangles; ++t) {
        const iccp_place *places[3];
        for (size_t k = 0; k < 3; ++k)
            places[k] = &w->places[corners->vertex[3 * t + k]];
        iccp_scan_create(&w->scans[t], places);
    }
}

/* The bands that a triangle comes into: begin <= band < end. */
static void find_bands(const warp *w, size_t triangle, size_t *begin, size_t *end)
{
    const iccp_scan *scan = &w->scans[triangle];
    const double height = w->target->height;
    *begin = *end = 0;
    if (!(scan->top > 0 && scan->whole.start.y < height))
        return;
    *begin = scan->whole.start.y > 0 ? (size_t)scan->whole.start.y / ROWS : 0;
    *end = scan->top < height ? (size_t)scan->top / ROWS + 1 : w->n_bands;
}

/* Counts, sums up, and fills from the back, so that each band has its triangles in order. */
static icc_status list_triangles(warp *w)
{
    const size_t n = w->map->mesh->pl.corners.n_triangles;
    size_t begin, end;
    for (size_t t = 0; t < n; ++t)
        for (find_bands(w, t, &begin, &end); begin < end; ++begin)
            ++w->first[begin];
    for (size_t b = 1; b <= w->n_bands; ++b)
        w->first[b] += w->first[b - 1];
    w->entries = iccp_alloc(w->memory, w->first[w->n_bands], sizeof *w->entries);
    if (w->entries == NULL)
        return ICC_ERR_MEMORY;
    for (size_t t = n; t-- > 0;)
        for (find_bands(w, t, &begin, &end); begin < end; ++begin)
            w->entries[--w->first[begin]] = (uint32_t)t;
    return ICC_OK;
}

static icc_status prepare(warp *w)
{
    const iccp_plmap *pl = &w->map->mesh->pl;
    w->n_bands = ((size_t)w->target->height + ROWS - 1) / ROWS;
    w->places = iccp_alloc(w->memory, pl->n_vertices, sizeof *w->places);
    w->scans = iccp_alloc(w->memory, pl->corners.n_triangles, sizeof *w->scans);
    w->first = iccp_alloc_zero(w->memory, w->n_bands + 1, sizeof *w->first);
    if (w->places == NULL || w->scans == NULL || w->first == NULL)
        return ICC_ERR_MEMORY;
    place_vertices(w);
    scan_triangles(w);
    return list_triangles(w);
}

static void clear(warp *w)
{
    iccp_free(w->memory, w->places);
    iccp_free(w->memory, w->scans);
    iccp_free(w->memory, w->first);
    iccp_free(w->memory, w->entries);
}

/* ---- rows ---- */

/* One row of the target. What is gathered is zero outside [begin, end). */
typedef struct row {
    int32_t number;
    uint8_t *pixels;
    iccp_gathered *gathered; /* one for each pixel; NULL when no triangle gathers */
    size_t begin, end;
} row;

static bool gathers(const iccp_scan *scan)
{
    return scan->columns > 1 || scan->rows > 1;
}

static void widen(row *r, size_t begin, size_t end)
{
    r->begin = begin < r->begin ? begin : r->begin;
    r->end = end > r->end ? end : r->end;
}

/* Adds the samples of one triangle in this row to their pixels. */
static void gather(const warp *w, const iccp_scan *scan, row *r)
{
    const size_t columns = (size_t)scan->columns;
    const float weight = 1 / (float)(scan->columns * scan->rows);
    iccp_line line;
    for (int32_t k = 0; k < scan->rows; ++k) {
        const double y = ((double)r->number * scan->rows + k + 0.5) / scan->rows;
        const size_t begin = (size_t)iccp_scan_row(scan, y, scan->columns, w->target->width, &line);
        if (line.n == 0)
            continue;
        iccp_sampler_gather(&w->source, &line, weight, begin % columns, columns,
                            r->gathered + begin / columns);
        widen(r, begin / columns, (begin + line.n - 1) / columns + 1);
    }
}

/* A pixel in whose triangle, a thin one, there was no sample. */
static void paint_centre(const warp *w, const row *r, size_t column, uint8_t *to)
{
    double place[2] = {(double)column + 0.5, r->number + 0.5}, local[2], image[2];
    iccp_frame_in(&w->map->target_domain->frame, 2, place, local);
    if (iccp_mesh_map_point(w->map->mesh, true, local, image, NULL) != ICC_OK)
        return;
    iccp_frame_out(&w->map->source_domain->frame, 2, image, place);
    const iccp_line line = {place[0] - 0.5, place[1] - 0.5, 0, 0, 1};
    iccp_sampler_paint(&w->source, &line, to);
}

/* The pixels whose centres one triangle holds, in this row. */
static int32_t find_pixels(const warp *w, const iccp_scan *scan, const row *r, iccp_line *line)
{
    return (int32_t)iccp_scan_row(scan, r->number + 0.5, 1, w->target->width, line);
}

static void paint(const warp *w, const iccp_scan *scan, const row *r)
{
    iccp_line line;
    const size_t begin = (size_t)find_pixels(w, scan, r, &line);
    if (line.n > 0)
        iccp_sampler_paint(&w->source, &line, r->pixels + begin * w->pixel);
}

/* The means of what has been gathered in the pixels of one triangle. */
static void store(const warp *w, const iccp_scan *scan, const row *r)
{
    iccp_line line;
    const size_t begin = (size_t)find_pixels(w, scan, r, &line), end = begin + line.n;
    for (size_t i = begin, n; i < end; i += n) {
        for (n = 0; i + n < end && r->gathered[i + n].weight > 0;)
            ++n;
        iccp_sampler_store(&w->source, r->gathered + i, n, r->pixels + i * w->pixel);
        if (n == 0) {
            paint_centre(w, r, i, r->pixels + i * w->pixel);
            n = 1;
        }
    }
}

/* Whether a triangle comes into a row. */
static bool meets(const iccp_scan *scan, const row *r)
{
    return scan->top > r->number && scan->whole.start.y < (double)r->number + 1;
}

/* Paints one row from the triangles of its band. Each triangle that does not gather writes its
 * pixels at once, each centre being in one triangle only; the others add up before they write. */
static void paint_row(const warp *w, size_t band, row *r)
{
    r->begin = (size_t)w->target->width;
    r->end = 0;
    for (size_t e = w->first[band]; e < w->first[band + 1]; ++e) {
        const iccp_scan *scan = &w->scans[w->entries[e]];
        if (meets(scan, r) && gathers(scan))
            gather(w, scan, r);
        else if (meets(scan, r))
            paint(w, scan, r);
    }
    for (size_t e = w->first[band]; e < w->first[band + 1] && r->gathered != NULL; ++e) {
        const iccp_scan *scan = &w->scans[w->entries[e]];
        if (meets(scan, r) && gathers(scan))
            store(w, scan, r);
    }
    if (r->begin < r->end)
        memset(r->gathered + r->begin, 0, (r->end - r->begin) * sizeof *r->gathered);
}

/* Rows [begin, end) of the target, all in one band. Room for what is gathered is made only if a
 * triangle needs it. */
static icc_status paint_band(void *argument, size_t begin, size_t end)
{
    const warp *w = argument;
    const size_t band = begin / ROWS;
    row r = {.gathered = NULL};
    for (size_t e = w->first[band]; e < w->first[band + 1] && r.gathered == NULL; ++e)
        if (gathers(&w->scans[w->entries[e]])) {
            r.gathered = iccp_alloc_zero(w->memory, (size_t)w->target->width, sizeof *r.gathered);
            if (r.gathered == NULL)
                return ICC_ERR_MEMORY;
        }
    for (size_t i = begin; i < end; ++i) {
        r.number = (int32_t)i;
        r.pixels = (uint8_t *)w->target->pixels + i * w->target->stride;
        paint_row(w, band, &r);
    }
    iccp_free(w->memory, r.gathered);
    return ICC_OK;
}

static icc_status warp_mesh(const icc_map *map, const icc_picture *source,
                            const icc_picture *target, const iccp_env *env)
{
    warp w = {.map = map,
              .target = target,
              .pixel = (size_t)(target->channels * target->bytes),
              .memory = &env->memory};
    iccp_sampler_init(&w.source, source);
    iccp_boundary_pixels boundary;
    icc_status status = iccp_boundary_pixels_create(&boundary, map->target_domain, target, env);
    if (status != ICC_OK)
        return status;
    status = prepare(&w);
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "warp", (size_t)target->height, ROWS, paint_band, &w);
    if (status == ICC_OK)
        iccp_boundary_pixels_decide(&boundary, map, &w.source, target);
    clear(&w);
    iccp_boundary_pixels_free(&boundary);
    return status;
}

icc_status iccp_map_warp(const icc_map *map, const icc_picture *source, const icc_picture *target,
                         size_t *n_failed, const iccp_env *env)
{
    if (map->mesh == NULL)
        return iccp_warp_points(map, source, target, n_failed, env);
    if (n_failed != NULL)
        *n_failed = 0;
    return warp_mesh(map, source, target, env);
}
