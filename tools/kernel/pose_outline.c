/* Cuts an outline where the pose bends it, and checks that the result is simple. */
#include "kernel/pose_outline.h"

#include "base/allocate.h"
#include "geo/clip_rings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How often an edge is cut in two, and each part of it again. */
enum { MOST_CUTS = 7 };

double ring_size(size_t n, const double *ring)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 2 * n; i++) {
        lower[i % 2] = fmin(lower[i % 2], ring[i]);
        upper[i % 2] = fmax(upper[i % 2], ring[i]);
    }
    return fmax(upper[0] - lower[0], upper[1] - lower[1]);
}

static void add(posed_outline *o, const double *rest, size_t edge)
{
    o->rest = grow(o->rest, &o->room_rest, 2 * (o->n + 1), sizeof *o->rest);
    o->edges = grow(o->edges, &o->room_edges, o->n + 1, sizeof *o->edges);
    memcpy(o->rest + 2 * o->n, rest, 2 * sizeof *rest);
    o->edges[o->n++] = edge;
}

static int pose_all(posed_outline *o, pose *p)
{
    size_t n_failed;
    o->posed = grow(o->posed, &o->room_posed, 2 * o->n, sizeof *o->posed);
    return pose_points(p, o->n, o->rest, o->posed, NULL, &n_failed);
}

/* ------------------------------------------------------------------ handles */

/* A handle on an edge, at the place `share` along it. */
typedef struct stop {
    uint32_t edge;
    double share;
    const double *at;
} stop;

static int by_place(const void *a, const void *b)
{
    const stop *p = a, *q = b;
    if (p->edge != q->edge)
        return p->edge < q->edge ? -1 : 1;
    return p->share < q->share ? -1 : p->share > q->share;
}

/* Finds the handles between the ends of an edge. Those at its ends are vertices already. */
static size_t find_stops(stop *stops, const handle_set *set, const double *bary,
                         const uint32_t *edges, const bool *on_ring)
{
    size_t n = 0;
    for (size_t h = 0; h < set->n_handles; h++)
        if (on_ring[h] && bary[2 * h] > 1e-12 && bary[2 * h + 1] > 1e-12)
            stops[n++] = (stop){edges[h], bary[2 * h + 1], set->handles + 2 * h};
    qsort(stops, n, sizeof *stops, by_place);
    return n;
}

static int start(posed_outline *o, pose *p, const icc_domain *region, size_t n, const double *ring,
                 bool *on_ring)
{
    const handle_set *set = &p->kernel.set;
    int32_t *where = need(set->n_handles, sizeof *where);
    uint32_t *edges = need(set->n_handles, sizeof *edges);
    double *bary = need(set->n_handles, 2 * sizeof *bary);
    stop *stops = need(set->n_handles, sizeof *stops);
    icc_status status = icc_domain_locate(region, set->n_handles, set->handles, where, edges, bary,
                                          &p->kernel.job.env);
    for (size_t h = 0; h < set->n_handles; h++)
        on_ring[h] = where[h] == ICC_BOUNDARY;
    size_t n_stops = find_stops(stops, set, bary, edges, on_ring);
    for (size_t i = 0, k = 0; i < n && status == ICC_OK; i++) {
        add(o, ring + 2 * i, i);
        for (; k < n_stops && stops[k].edge == i; k++)
            add(o, stops[k].at, i);
    }
    free(where);
    free(edges);
    free(bary);
    free(stops);
    return status == ICC_OK ? pose_all(o, p) : job_failed_status(&p->kernel.job, status);
}

/* ------------------------------------------------------------------- pieces */

static void between(const double *a, const double *b, double share, double out[2])
{
    for (size_t c = 0; c < 2; c++)
        out[c] = a[c] + share * (b[c] - a[c]);
}

/* True if the pose takes one of three points of piece i farther from its place on the straight
 * piece than the tolerance. `images` are the posed points. */
static bool bends(const posed_outline *o, size_t i, const double *images, double tolerance)
{
    const double *a = o->posed + 2 * i, *b = o->posed + 2 * ((i + 1) % o->n);
    for (size_t k = 0; k < 3; k++) {
        double at[2];
        between(a, b, (double)(k + 1) / 4, at);
        if (hypot(at[0] - images[2 * k], at[1] - images[2 * k + 1]) > tolerance)
            return true;
    }
    return false;
}

/* Cuts bent pieces in two. *cut becomes true if there were any. */
static int cut_pieces(posed_outline *o, pose *p, double tolerance, bool *cut)
{
    double *at = need(o->n, 6 * sizeof *at), *images = need(o->n, 6 * sizeof *images);
    posed_outline finer = {0};
    size_t n_failed;
    for (size_t i = 0; i < 3 * o->n; i++)
        between(o->rest + 2 * (i / 3), o->rest + 2 * ((i / 3 + 1) % o->n), (double)(i % 3 + 1) / 4,
                at + 2 * i);
    int result = pose_points(p, 3 * o->n, at, images, NULL, &n_failed);
    for (size_t i = 0; i < o->n && result == DONE; i++) {
        add(&finer, o->rest + 2 * i, o->edges[i]);
        if (bends(o, i, images + 6 * i, tolerance))
            add(&finer, at + 6 * i + 2, o->edges[i]);
    }
    *cut = finer.n > o->n;
    if (result == DONE)
        result = pose_all(&finer, p);
    posed_outline_free(o);
    *o = finer;
    free(at);
    free(images);
    return result;
}

int posed_outline_make(posed_outline *out, pose *p, const icc_domain *region, size_t n,
                       const double *ring, double tolerance, bool *on_ring)
{
    *out = (posed_outline){0};
    bool cut = true;
    int result = start(out, p, region, n, ring, on_ring);
    for (size_t k = 0; k < MOST_CUTS && cut && result == DONE; k++)
        result = cut_pieces(out, p, tolerance, &cut);
    return result;
}

void posed_outline_free(posed_outline *o)
{
    free(o->rest);
    free(o->posed);
    free(o->edges);
    *o = (posed_outline){0};
}

/* -------------------------------------------------------------------- check */

bool posed_outline_is_simple(const posed_outline *o, const pose *p)
{
    size_t n_defects;
    return icc_boundary_defects(o->n, o->posed, 0, NULL, NULL, &n_defects, &p->kernel.job.env,
                                NULL) == ICC_OK &&
           n_defects == 0 && ring_area(o->n, o->posed, 2) * ring_area(o->n, o->rest, 2) > 0;
}

int posed_outline_check(const posed_outline *o, pose *p)
{
    const char *name = p->kernel.job.args->pose;
    int32_t kind;
    uint32_t item[2];
    size_t n_defects;
    icc_error err = {.size = sizeof err, .index = -1};
    if (icc_boundary_defects(o->n, o->posed, 1, &kind, item, &n_defects, &p->kernel.job.env,
                             &err) != ICC_OK)
        return job_failed(&p->kernel.job, &err);
    if (n_defects == 0 && ring_area(o->n, o->posed, 2) * ring_area(o->n, o->rest, 2) > 0)
        return DONE;
    if (n_defects == 0)
        return failed(name, 0, "the pose turns the outline over");
    const char *advice = "a map that is one-to-one needs a simple one; move the handles less";
    if (kind == ICC_DEFECT_NOT_FINITE || kind == ICC_DEFECT_FLAT)
        return failed(name, 0, "the posed outline %s",
                      kind == ICC_DEFECT_FLAT ? "has no area" : "is beyond the range of numbers");
    if (o->edges[item[0]] == o->edges[item[1]])
        return failed(name, 0, "the posed outline meets itself on edge %zu: %s", o->edges[item[0]],
                      advice);
    return failed(name, 0, "the posed outline meets itself, edge %zu and edge %zu: %s",
                  o->edges[item[0]], o->edges[item[1]], advice);
}
