/* Poses that are one-to-one. Kernel coordinates say where the outline goes and where the handles do; the rest is a certified map of the shape to what the posed outline bounds, with the handles
 * inside as its points. */
#include "kernel/pose_job.h"

#include "base/allocate.h"
#include "job/args.h"
#include "kernel/pose_outline.h"
#include "plot/picture_warp.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lines of the outline may be off by a thousandth of the shape's size unless an option says
 * otherwise. */
static double choose_tolerance(const pose *p, size_t n, const double *ring)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 2 * n; i++) {
        lower[i % 2] = fmin(lower[i % 2], ring[i]);
        upper[i % 2] = fmax(upper[i % 2], ring[i]);
    }
    double given = p->kernel.job.args->tolerance;
    return given > 0 ? given : fmax(upper[0] - lower[0], upper[1] - lower[1]) / 1000;
}

/* The shape must be one region: a map goes from one polygon to another. */
int pose_certified_check(const pose *p)
{
    const handle_set *set = &p->kernel.set;
    const char *name = p->kernel.job.args->handles;
    size_t n_regions = (p->kernel.job.domains[0] != NULL) + set->n_regions;
    if (set->dim != 2)
        return failed(name, 0, "the handles are in space; --certified is for the plane");
    if (set->n_segments > 0)
        return failed(name, 0, "--certified poses one region, and does without curves");
    if (n_regions != 1)
        return failed(name, 0, "--certified poses one region, but there are %zu", n_regions);
    return DONE;
}

/* ---------------------------------------------------------------------- map */

typedef struct inner_handles {
    size_t n;
    size_t *handles; /* their numbers */
    double *places[2];
    icc_feature *features[2];
} inner_handles;

/* The handles that are not on the outline, at rest and where their transforms take them. */
static inner_handles take_inside(const pose *p, const bool *on_ring)
{
    const handle_set *set = &p->kernel.set;
    inner_handles in = {.handles = need(set->n_handles, sizeof *in.handles)};
    for (size_t side = 0; side < 2; side++) {
        in.places[side] = need(set->n_handles, 2 * sizeof(double));
        in.features[side] = need(set->n_handles, sizeof(icc_feature));
    }
    for (size_t h = 0; h < set->n_handles; h++) {
        if (on_ring[h])
            continue;
        const double *at = set->handles + 2 * h, *t = p->transforms + 6 * h;
        for (size_t side = 0; side < 2; side++)
            in.features[side][in.n] = (icc_feature){.size = sizeof(icc_feature),
                                                    .kind = ICC_FEATURE_POINT,
                                                    .n_vertices = 1,
                                                    .vertices = in.places[side] + 2 * in.n};
        for (size_t c = 0; c < 2; c++) {
            in.places[0][2 * in.n + c] = at[c];
            in.places[1][2 * in.n + c] = t[3 * c] * at[0] + t[3 * c + 1] * at[1] + t[3 * c + 2];
        }
        in.handles[in.n++] = h;
    }
    return in;
}

static void free_inside(inner_handles *in)
{
    free(in->handles);
    for (size_t side = 0; side < 2; side++) {
        free(in->places[side]);
        free(in->features[side]);
    }
}

/* What keeps the handles from being points of a map, by their numbers. */
static int failed_handle(pose *p, const inner_handles *in, const icc_error *err)
{
    const char *name = p->kernel.job.args->pose;
    if (err->item != ICC_ITEM_FEATURE || err->index < 0 || (size_t)err->index >= in->n)
        return job_failed(&p->kernel.job, err);
    size_t handle = in->handles[err->index];
    const char *why = err->status == ICC_ERR_OUTSIDE    ? "is not inside the posed outline"
                      : err->status == ICC_ERR_BOUNDARY ? "is where another one is"
                                                        : err->message;
    progress_end(&p->kernel.job.bar);
    return failed(name, 0, "handle %zu, posed, %s: --certified takes both inside and apart", handle,
                  why);
}

static int make_map(pose *p, const posed_outline *ring, const inner_handles *in)
{
    const icc_env *env = &p->kernel.job.env;
    const double *rings[2] = {ring->rest, ring->posed};
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status status = ICC_OK;
    for (size_t side = 0; side < 2 && status == ICC_OK; side++)
        status = icc_domain_create_features(&p->sides[side], ring->n, rings[side], in->n,
                                            in->features[side], env, &err);
    if (status != ICC_OK)
        return failed_handle(p, in, &err);
    icc_domain_info info[2] = {{.size = sizeof *info}, {.size = sizeof *info}};
    for (size_t side = 0; side < 2; side++)
        icc_domain_get_info(p->sides[side], &info[side]);
    if (info[0].orientation != info[1].orientation)
        return failed(p->kernel.job.args->pose, 0, "the pose turns the outline over");
    progress_expect(&p->kernel.job.bar, 0.9);
    status = icc_map_create(&p->map, p->sides[0], p->sides[1], NULL, env, &err);
    progress_end(&p->kernel.job.bar);
    if (status != ICC_OK)
        return failed_handle(p, in, &err);
    icc_map_info made = {.size = sizeof made};
    icc_map_get_info(p->map, &made);
    return made.certified ? DONE
                          : failed(p->kernel.job.args->pose, 0,
                                   "no map to the posed outline could be certified");
}

/* ------------------------------------------------------------- how far off */

/* Compares the map with the pose at the samples of the shape. */
static int compare(pose *p)
{
    icc_sampling_info info = {.size = sizeof info};
    icc_sampling_get_info(p->kernel.sampling, &info);
    size_t n = info.n_samples, n_failed;
    double *at = need(n, 2 * sizeof *at), *posed = need(n, 2 * sizeof *posed),
           *mapped = need(n, 2 * sizeof *mapped), *slopes = need(n, 4 * sizeof *slopes);
    icc_map *map = p->map;
    icc_sampling_get_points(p->kernel.sampling, at);
    p->map = NULL;
    int result = pose_points(p, n, at, posed, slopes, &n_failed);
    p->map = map;
    if (result == DONE)
        result = pose_points(p, n, at, mapped, NULL, &n_failed);
    turned t = pose_count_turned(2, n, slopes);
    size_t n_both = 0;
    for (size_t i = 0; i < n && result == DONE; i++) {
        double off = hypot(posed[2 * i] - mapped[2 * i], posed[2 * i + 1] - mapped[2 * i + 1]);
        if (isnan(off))
            continue;
        n_both++;
        p->off_mean += off;
        p->off_most = fmax(p->off_most, off);
    }
    p->off_mean /= n_both > 0 ? (double)n_both : 1;
    p->folded = n > 0 ? (double)(t.inverted + t.collapsed) / (double)n : 0;
    free(at);
    free(posed);
    free(mapped);
    free(slopes);
    return result;
}

int pose_certified_make(pose *p)
{
    const kernel_job *k = &p->kernel;
    const cage *source = &k->job.cages[0];
    const icc_domain *region = k->job.domains[0] != NULL ? k->job.domains[0] : k->regions[0];
    size_t n = k->job.domains[0] != NULL ? source->n : k->set.regions[0].n;
    const double *ring = k->job.domains[0] != NULL ? source->points : k->set.regions[0].points;
    bool *on_ring = need(k->set.n_handles, sizeof *on_ring);
    posed_outline posed;
    int result =
        posed_outline_make(&posed, p, region, n, ring, choose_tolerance(p, n, ring), on_ring);
    if (result == DONE)
        result = posed_outline_check(&posed, p);
    inner_handles in = take_inside(p, on_ring);
    if (result == DONE)
        result = make_map(p, &posed, &in);
    if (result == DONE) {
        icc_status ran =
            carrier_start(&p->carrier, p->map, p->sides[0], p->sides[1], false, -1, &k->job.env);
        result = ran == ICC_OK ? compare(p) : job_failed_status(&p->kernel.job, ran);
    }
    free_inside(&in);
    posed_outline_free(&posed);
    free(on_ring);
    return result;
}

/* ------------------------------------------------------------------- using it */

int pose_certified_points(pose *p, size_t n, const double *points, double *images,
                          double *jacobians, size_t *n_failed)
{
    icc_status *status = need(n, sizeof *status);
    icc_status ran = carrier_map(&p->carrier, n, points, images, status, NULL);
    if (ran == ICC_OK && jacobians != NULL)
        ran = icc_map_jacobian(p->map, n, points, jacobians, NULL, NULL, &p->kernel.job.env);
    *n_failed = 0;
    for (size_t i = 0; i < n && ran == ICC_OK; i++)
        *n_failed += status[i] != ICC_OK;
    free(status);
    return ran == ICC_OK ? DONE : job_failed_status(&p->kernel.job, ran);
}

int pose_certified_picture(pose *p, const picture *from, picture *to)
{
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status ran = picture_warp(p->map, from, to, NULL, &p->kernel.job.env, &err);
    progress_end(&p->kernel.job.bar);
    return ran == ICC_OK ? DONE : job_failed(&p->kernel.job, &err);
}

void pose_certified_say(const pose *p)
{
    icc_map_info info = {.size = sizeof info};
    char text[240];
    if (p->map == NULL || p->kernel.job.args->json)
        return;
    icc_map_get_info(p->map, &info);
    snprintf(text, sizeof text,
             "certified one-to-one: %zu triangles; the pose itself turns over %.2g %% of the "
             "shape, and is %.3g away on average, %.3g at most",
             info.n_simplices, 100 * p->folded, p->off_mean, p->off_most);
    pose_say(p, text);
}

void pose_certified_report(const pose *p, json *out)
{
    icc_map_info info = {.size = sizeof info};
    if (p->map == NULL)
        return;
    icc_map_get_info(p->map, &info);
    json_open(out, "certified", '{');
    json_count(out, "triangles", info.n_simplices);
    json_number(out, "energy", info.energy);
    json_number(out, "folded_pose", p->folded);
    json_number(out, "off_mean", p->off_mean);
    json_number(out, "off_most", p->off_most);
    json_close(out, '}');
}

void pose_certified_free(pose *p)
{
    carrier_free(&p->carrier);
    icc_map_free(p->map);
    icc_domain_free(p->sides[0]);
    icc_domain_free(p->sides[1]);
}
