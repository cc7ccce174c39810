/* Warps a picture by a mesh map, triangle by triangle.
 *
 * A mesh map's inverse is one affine map for each triangle of the target. So pictures are drawn
 * triangle by triangle and row by row, without a search for the triangle of a pixel.
 *
 * A triangle that shrinks the picture is sampled more finely, and its samples are gathered. A pixel
 * belongs to the triangle that contains its centre. Either that triangle paints it at once, or it
 * becomes the mean of the samples that all gathering triangles have in it. */
#include "map/picture/warp.h"

#include "base/threads.h"
#include "map/picture/boundary_pixels.h"
#include "map/picture/picture_values.h"
#include "map/picture/scan.h"
#include "map/picture/warp_points.h"
#include "map/plane/plane_kind.h"

/* Rows in a task (a band). The triangles that reach into a band are listed once. */
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
    size_t *first;     /* n_bands + 1: where each band's triangles begin in `entries` */
    uint32_t *entries; /* triangles, band after band */
} warp;

/* ---- triangles ---- */

static void place_vertices(warp *w)
{
    const iccp_plmap *pl = &iccp_plane_of(w->map)->pl;
    for (size_t v = 0; v < pl->n_vertices; ++v) {
        double from[2], to[2];
        iccp_frame_out(&w->map->source_domain->frame, 2, pl->points + 2 * v, from);
        iccp_frame_out(&w->map->target_domain->frame, 2, pl->images + 2 * v, to);
        w->places[v] = (iccp_place){to[0], to[1], from[0] - 0.5, from[1] - 0.5};
    }
}

static void scan_triangles(warp *w)
{
    const iccp_corners *corners = &iccp_plane_of(w->map)->pl.corners;
    for (size_t t = 0; t < corners->n_triangles; ++t) {
        const iccp_place *places[3];
        for (size_t k = 0; k < 3; ++k)
            places[k] = &w->places[corners->vertex[3 * t + k]];
        iccp_scan_create(&w->scans[t], places);
    }
}

/* Finds the bands that a triangle reaches: begin <= band < end. */
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

/* Counts the triangles of each band, adds up the counts and fills the lists from the back. So each
 * band has its triangles in order. */
static icc_status list_triangles(warp *w)
{
    const size_t n = iccp_plane_of(w->map)->pl.corners.n_triangles;
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
    const iccp_plmap *pl = &iccp_plane_of(w->map)->pl;
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

/* Rows [begin, end) of the target. */
typedef struct band {
    const warp *w;
    int32_t begin, end;
    iccp_gathered *gathered; /* one for each pixel; NULL if no triangle gathers */
} band;

static bool gathers(const iccp_scan *scan)
{
    return scan->columns > 1 || scan->rows > 1;
}

static iccp_gathered *gathered_at(const band *b, int32_t row, size_t column)
{
    return b->gathered + (size_t)(row - b->begin) * (size_t)b->w->target->width + column;
}

static uint8_t *pixel_at(const band *b, int32_t row, size_t column)
{
    const icc_picture *p = b->w->target;
    return (uint8_t *)p->pixels + (size_t)row * p->stride + column * b->w->pixel;
}

/* The runs of a triangle. All runs are found before any is sampled, because finding them one by one
 * between samples is slow. */
typedef struct runs {
    size_t n;
    iccp_run run[ROWS * ICCP_MOST_SAMPLES];
} runs;

/* Adds the samples of one triangle to their pixels. */
static void gather(const band *b, const iccp_scan *scan, runs *r)
{
    const size_t columns = (size_t)scan->columns;
    const float weight = 1 / (float)(scan->columns * scan->rows);
    r->n = iccp_scan_rows(scan, b->begin, b->end, scan->columns, scan->rows, b->w->target->width,
                          r->run);
    for (size_t k = 0; k < r->n; ++k) {
        const iccp_run *run = &r->run[k];
        iccp_sampler_gather(&b->w->source, &run->line, weight, run->begin % columns, columns,
                            gathered_at(b, run->row, run->begin / columns));
    }
}

/* Finds the pixels whose centres lie in a triangle. Each pixel has one such triangle. */
static void find_pixels(const band *b, const iccp_scan *scan, runs *r)
{
    r->n = iccp_scan_rows(scan, b->begin, b->end, 1, 1, b->w->target->width, r->run);
}

static void paint(const band *b, const iccp_scan *scan, runs *r)
{
    find_pixels(b, scan, r);
    for (size_t k = 0; k < r->n; ++k)
        iccp_sampler_paint(&b->w->source, &r->run[k].line,
                           pixel_at(b, r->run[k].row, r->run[k].begin));
}

/* Paints a pixel that lies in a thin triangle without samples: the sample at its centre. */
static void paint_centre(const band *b, const iccp_run *run, size_t column)
{
    const double k = (double)(column - run->begin);
    iccp_line line = {run->line.u, run->line.v, 0, 0, 1};
    if (k > 0) {
        line.u += k * run->line.du;
        line.v += k * run->line.dv;
    }
    iccp_sampler_paint(&b->w->source, &line, pixel_at(b, run->row, column));
}

/* Stores the means of the gathered samples in a run of pixels. */
static void store_run(const band *b, const iccp_run *run)
{
    const size_t end = run->begin + run->line.n;
    for (size_t i = run->begin, n; i < end; i += n) {
        const iccp_gathered *gathered = gathered_at(b, run->row, i);
        for (n = 0; i + n < end && gathered[n].weight > 0;)
            ++n;
        iccp_sampler_store(&b->w->source, gathered, n, pixel_at(b, run->row, i));
        if (n == 0) {
            paint_centre(b, run, i);
            n = 1;
        }
    }
}

static void store(const band *b, const iccp_scan *scan, runs *r)
{
    find_pixels(b, scan, r);
    for (size_t k = 0; k < r->n; ++k)
        store_run(b, &r->run[k]);
}

/* Paints rows [begin, end) of the target, all in one band. A triangle that does not gather writes
 * its pixels at once. The others first add up their samples. Each triangle is finished before the
 * next one, because its neighbouring rows come from nearby places in the source. Memory for
 * gathering is allocated only if a triangle needs it. */
static icc_status paint_band(void *argument, size_t begin, size_t end)
{
    const warp *w = argument;
    const uint32_t *first = w->entries + w->first[begin / ROWS];
    const uint32_t *last = w->entries + w->first[begin / ROWS + 1];
    band b = {w, (int32_t)begin, (int32_t)end, NULL};
    runs r;
    for (const uint32_t *e = first; e < last && b.gathered == NULL; ++e)
        if (gathers(&w->scans[*e])) {
            b.gathered = iccp_alloc_zero(w->memory, (end - begin) * (size_t)w->target->width,
                                         sizeof *b.gathered);
            if (b.gathered == NULL)
                return ICC_ERR_MEMORY;
        }
    for (const uint32_t *e = first; e < last; ++e)
        (gathers(&w->scans[*e]) ? gather : paint)(&b, &w->scans[*e], &r);
    for (const uint32_t *e = first; e < last; ++e)
        if (gathers(&w->scans[*e]))
            store(&b, &w->scans[*e], &r);
    iccp_free(w->memory, b.gathered);
    return ICC_OK;
}

/* Only pixels close to the boundary need the map's point location, and most pictures have none. */
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
    if (boundary.n > 0)
        status = iccp_mesh_map_ready(iccp_plane_of(map), true);
    if (status == ICC_OK)
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
    if (iccp_plane_of(map) == NULL || iccp_picture_has_values(source))
        return iccp_warp_points(map, source, target, n_failed, env);
    if (n_failed != NULL)
        *n_failed = 0;
    return warp_mesh(map, source, target, env);
}
