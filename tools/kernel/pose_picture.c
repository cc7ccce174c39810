/* Poses pictures forwards. The regions of the shape are cut into small triangles. These are posed,
 * and each is drawn at its new place with the colours of its old one. Triangles that turn over are
 * drawn first, so that the rest hides them. */
#include "kernel/pose_job.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "base/system.h"
#include "picture/picture_file.h"
#include "plot/picture_begin.h"
#include "plot/picture_sample.h"

#include <icc/stages.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels between the vertices of the triangles inside. On the boundary they are twice as close. */
enum { STEP = 4 };

/* A region cut into counter-clockwise triangles. The first n_boundary vertices are its boundary. */
typedef struct patch {
    size_t n_boundary, n, room, n_triangles;
    double *rest, *posed; /* n * 2 */
    uint32_t *triangles;  /* n_triangles * 3 */
} patch;

typedef struct drawing {
    pose *pose;
    picture from, to;
    picture_style style; /* of `to` */
    size_t n_patches;
    patch *patches;
    double area, turned; /* of all triangles at rest, and of those that turn over */
} drawing;

/* ---------------------------------------------------------------- triangles */

static void add_vertex(patch *p, double x, double y)
{
    p->rest = grow(p->rest, &p->room, 2 * (p->n + 1), sizeof *p->rest);
    p->rest[2 * p->n] = x;
    p->rest[2 * p->n + 1] = y;
    p->n++;
}

static double area_of(const double *a, const double *b, const double *c)
{
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

static void add_boundary(patch *p, size_t n, const double *ring)
{
    for (size_t i = 0; i < n; i++) {
        const double *a = ring + 2 * i, *b = ring + 2 * ((i + 1) % n);
        double pieces = ceil(fmax(hypot(b[0] - a[0], b[1] - a[1]) * 2 / STEP, 1));
        for (double k = 0; k < pieces; k++)
            add_vertex(p, a[0] + (b[0] - a[0]) * k / pieces, a[1] + (b[1] - a[1]) * k / pieces);
    }
    p->n_boundary = p->n;
}

/* Finds the vertices of a lattice over the picture that are too close to the boundary: within half
 * a step of one of its vertices. So all others are farther from its edges than rounding. */
static bool *find_close(const patch *p, size_t columns, size_t rows)
{
    bool *close = need(columns * rows, sizeof *close);
    for (size_t i = 0; i < p->n_boundary; i++) {
        double x = floor(p->rest[2 * i] / STEP), y = floor(p->rest[2 * i + 1] / STEP);
        for (size_t k = 0; k < 4; k++) {
            double column = x + (double)(k % 2), row = y + (double)(k / 2);
            if (column >= 0 && row >= 0 && column < (double)columns && row < (double)rows &&
                hypot(column * STEP - p->rest[2 * i], row * STEP - p->rest[2 * i + 1]) <=
                    STEP / 2.0)
                close[(size_t)row * columns + (size_t)column] = true;
        }
    }
    return close;
}

static icc_status add_inside(patch *p, const drawing *d, const icc_domain *region)
{
    size_t columns = d->from.width / STEP + 1, rows = d->from.height / STEP + 1, n = columns * rows;
    bool *close = find_close(p, columns, rows);
    double *lattice = need(n, 2 * sizeof *lattice);
    int32_t *where = need(n, sizeof *where);
    for (size_t i = 0; i < n; i++) {
        lattice[2 * i] = (double)(i % columns * STEP);
        lattice[2 * i + 1] = (double)(i / columns * STEP);
    }
    icc_status status =
        icc_domain_locate(region, n, lattice, where, NULL, NULL, &d->pose->kernel.job.env);
    for (size_t i = 0; i < n && status == ICC_OK; i++)
        if (where[i] == ICC_INSIDE && !close[i])
            add_vertex(p, lattice[2 * i], lattice[2 * i + 1]);
    free(close);
    free(lattice);
    free(where);
    return status;
}

/* True if the region is far larger than the picture, so that its boundary would take too many
 * pieces. */
static bool is_huge(const drawing *d, size_t n, const double *ring)
{
    double length = 0;
    for (size_t i = 0; i < n; i++) {
        const double *a = ring + 2 * i, *b = ring + 2 * ((i + 1) % n);
        length += hypot(b[0] - a[0], b[1] - a[1]);
    }
    return !(length < 1e3 * (double)(d->from.width + d->from.height) + 1e6);
}

/* Makes triangles over one region from its boundary, n points of `ring`, and points inside. All are
 * posed by their own weights. Then draws the picture triangle by triangle. */
static int make_patch(drawing *d, const icc_domain *region, size_t n, const double *ring)
{
    job *j = &d->pose->kernel.job;
    if (is_huge(d, n, ring))
        return failed(job_file(j, 1), 0,
                      "the shape is far larger than the picture, %zu x %zu pixels", d->from.width,
                      d->from.height);
    patch *p = &d->patches[d->n_patches++];
    icc_error err = {.size = sizeof err, .index = -1};
    add_boundary(p, n, ring);
    err.status = add_inside(p, d, region);
    p->n_triangles = 2 * p->n - p->n_boundary - 2;
    p->triangles = need(p->n_triangles, 3 * sizeof *p->triangles);
    if (err.status == ICC_OK)
        err.status = icc_triangulate(p->n_boundary, p->n, p->rest, p->triangles, &j->env, &err);
    if (err.status != ICC_OK) {
        err.index = -1; /* of a vertex that is in no file */
        return job_failed(j, &err);
    }
    size_t n_failed;
    p->posed = need(p->n, 2 * sizeof *p->posed);
    return pose_points(d->pose, p->n, p->rest, p->posed, NULL, &n_failed);
}

static int make_patches(drawing *d)
{
    const kernel_job *k = &d->pose->kernel;
    const cage *source = &k->job.cages[0];
    d->patches = need(k->set.n_regions + 1, sizeof *d->patches);
    int result = DONE;
    if (k->job.domains[0] != NULL)
        result = make_patch(d, k->job.domains[0], source->n, source->points);
    for (size_t r = 0; r < k->set.n_regions && result == DONE; r++)
        result = make_patch(d, k->regions[r], k->set.regions[r].n, k->set.regions[r].points);
    return result;
}

/* ------------------------------------------------------------------ drawing */

/* The pixels from `low` to `high` whose centres may lie between a and b. */
static void span(double a, double b, size_t n, size_t *low, size_t *high)
{
    double first = fmin(fmax(ceil(a - 0.5), 0), (double)n),
           last = fmin(fmax(floor(b - 0.5) + 1, 0), (double)n);
    *low = (size_t)first;
    *high = last > first ? (size_t)last : *low;
}

/* Places on an edge belong to both sides, so that rounding opens no gaps. */
static const double slack = 1e-9;

/* Finds the place at rest of (x, y), if it lies in the posed triangle. */
static bool find_source(const patch *p, const uint32_t *corners, double x, double y, double out[2])
{
    const double *a = p->posed + 2 * corners[0], *b = p->posed + 2 * corners[1],
                 *c = p->posed + 2 * corners[2], at[2] = {x, y};
    double area = area_of(a, b, c), v = area_of(a, at, c) / area, w = area_of(a, b, at) / area;
    if (!(v >= -slack && w >= -slack && v + w <= 1 + slack))
        return false;
    for (size_t k = 0; k < 2; k++)
        out[k] = (1 - v - w) * p->rest[2 * corners[0] + k] + v * p->rest[2 * corners[1] + k] +
                 w * p->rest[2 * corners[2] + k];
    return true;
}

static bool is_in_picture(const picture *p, const double at[2])
{
    return at[0] >= -slack && at[1] >= -slack && at[0] <= (double)p->width + slack &&
           at[1] <= (double)p->height + slack;
}

static void draw_triangle(drawing *d, const patch *p, const uint32_t *corners)
{
    size_t low[2], high[2];
    const double *a = p->posed + 2 * corners[0], *b = p->posed + 2 * corners[1],
                 *c = p->posed + 2 * corners[2];
    for (size_t k = 0; k < 2; k++)
        span(fmin(a[k], fmin(b[k], c[k])), fmax(a[k], fmax(b[k], c[k])),
             k == 0 ? d->to.width : d->to.height, &low[k], &high[k]);
    for (size_t y = low[1]; y < high[1]; y++)
        for (size_t x = low[0]; x < high[0]; x++) {
            double source[2];
            if (find_source(p, corners, (double)x + 0.5, (double)y + 0.5, source) &&
                is_in_picture(&d->from, source))
                picture_sample(&d->from, source, &d->to, y * d->to.width + x);
        }
}

/* The orientation of the image: 1 as at rest. It is also 0 if a pose with huge numbers has
 * overflowed. */
static int image_sign(const patch *p, const uint32_t *corners)
{
    for (size_t k = 0; k < 6; k++)
        if (!isfinite(p->posed[2 * corners[k / 2] + k % 2]))
            return 0;
    return orientation(p->posed + 2 * corners[0], p->posed + 2 * corners[1],
                       p->posed + 2 * corners[2]);
}

/* Draws the triangles whose images have this sign. */
static void draw_triangles(drawing *d, int sign)
{
    for (size_t i = 0; i < d->n_patches; i++) {
        const patch *p = &d->patches[i];
        for (size_t t = 0; t < p->n_triangles; t++) {
            const uint32_t *corners = p->triangles + 3 * t;
            if (image_sign(p, corners) != sign)
                continue;
            double area = area_of(p->rest + 2 * corners[0], p->rest + 2 * corners[1],
                                  p->rest + 2 * corners[2]);
            d->area += area;
            d->turned += sign < 0 ? area : 0;
            draw_triangle(d, p, corners);
        }
    }
}

/* ------------------------------------------------------------------ results */

static int report_picture(drawing *d, double seconds)
{
    pose *p = d->pose;
    double folded = d->area > 0 ? d->turned / d->area : 0;
    char text[80];
    report r;
    snprintf(text, sizeof text, "%.2g %% of the shape is turned over", 100 * folded);
    if (!p->kernel.job.args->json) {
        if (folded > 0)
            pose_say(p, text);
        return DONE;
    }
    size_t n = d->n_patches > 0 ? d->patches[0].n : p->kernel.set.n_handles;
    const double *points = d->n_patches > 0 ? d->patches[0].rest : p->kernel.set.handles;
    if (pose_report_open(&r, p, n, points, 0, seconds) != DONE)
        return FAILED;
    json_number(&r.json, "folded", folded);
    return report_close(&r) ? DONE : FAILED;
}

static int draw_patches(drawing *d)
{
    int result = make_patches(d);
    if (result != DONE)
        return result;
    draw_triangles(d, -1);
    draw_triangles(d, 1);
    return DONE;
}

static int draw(drawing *d)
{
    double began = seconds_now();
    int result =
        d->pose->map != NULL ? pose_certified_picture(d->pose, &d->from, &d->to) : draw_patches(d);
    if (result != DONE)
        return result;
    double seconds = seconds_now() - began;
    result = picture_save(&d->to, &d->style, pose_output(d->pose));
    return result == DONE ? report_picture(d, seconds) : result;
}

static void free_patches(drawing *d)
{
    for (size_t i = 0; i < d->n_patches; i++) {
        free(d->patches[i].rest);
        free(d->patches[i].posed);
        free(d->patches[i].triangles);
    }
    free(d->patches);
}

int pose_picture(pose *p, const char *bytes, size_t n)
{
    const args *a = p->kernel.job.args;
    drawing d = {.pose = p};
    if (p->kernel.set.dim != 2)
        return failed(a->operands[0], 0, "this is a picture, but the handles are in space");
    if (p->kernel.job.domains[0] == NULL && p->kernel.set.n_regions == 0)
        return failed(a->operands[0], 0, "a picture needs a shape with a region, not only curves");
    int result = picture_take(&d.from, a->operands[0], bytes, n);
    if (result == DONE)
        result = picture_begin(&d.to, &d.style, &d.from, a, pose_output(p));
    if (result == DONE)
        result = draw(&d);
    picture_free(&d.from);
    picture_free(&d.to);
    free_patches(&d);
    return result;
}
