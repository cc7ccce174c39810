/* Poses that are one-to-one. Kernel coordinates give the images of the outline, of the handles
 * inside, and of other places inside where they do not fold. A certified map of the shape with all
 * of these as its points does the rest. */
#include "kernel/pose_job.h"

#include "base/allocate.h"
#include "job/args.h"
#include "kernel/pose_outline.h"
#include "kernel/pose_places.h"
#include "plot/picture_warp.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The tolerance for bends of the outline, as a share of the shape's size, unless an option gives
 * one. */
static const double TOLERANCE = 1e-3;

/* If the outline meets itself, small loops may disappear when it is followed less closely. The
 * tolerance grows by this factor each time, up to this share. */
static const double COARSER = 4, COARSEST = 0.2;

/* The shape must be one region, because a map goes from one polygon to another. */
int pose_certified_check(const pose *p)
{
    const handle_set *set = &p->kernel.set;
    const char *name = p->kernel.job.args->handles;
    size_t n_regions = (p->kernel.job.domains[0] != NULL) + set->n_regions;
    if (set->dim != 2)
        return failed(name, 0, "the handles are in space; --certified is for the plane");
    if (set->n_segments > 0)
        return failed(name, 0, "--certified poses one region; leave the curves out");
    if (n_regions != 1)
        return failed(name, 0, "--certified poses one region, but there are %zu", n_regions);
    return DONE;
}

/* ---------------------------------------------------------------------- map */

/* Adds the handles that are not on the outline, at rest and posed. */
static void take_handles(posed_places *in, const pose *p, const bool *on_ring)
{
    for (size_t h = 0; h < p->kernel.set.n_handles; h++) {
        const double *at = p->kernel.set.handles + 2 * h, *t = p->transforms + 6 * h;
        const double image[2] = {t[0] * at[0] + t[1] * at[1] + t[2],
                                 t[3] * at[0] + t[4] * at[1] + t[5]};
        if (!on_ring[h])
            posed_places_add(in, at, image, h);
    }
}

/* Reports why the handles cannot be points of a map, by their numbers. */
static int failed_handle(pose *p, const posed_places *in, const icc_error *err)
{
    progress_end(&p->kernel.job.bar);
    if (err->item != ICC_ITEM_FEATURE || err->index < 0 || (size_t)err->index >= in->n)
        return failed(p->kernel.job.args->pose, 0, "%s", job_message(err));
    const char *why = err->status == ICC_ERR_OUTSIDE    ? "is not inside the posed outline"
                      : err->status == ICC_ERR_TOPOLOGY ? "is where another one or a corner is"
                                                        : job_message(err);
    return failed(p->kernel.job.args->pose, 0,
                  "handle %zu, posed, %s; --certified needs all of them inside and apart",
                  in->handles[err->index], why);
}

static icc_status make_sides(icc_domain *sides[2], const pose *p, const posed_outline *ring,
                             const posed_places *in, icc_error *err)
{
    const double *rings[2] = {ring->rest, ring->posed};
    icc_feature *points = need(in->n, sizeof *points);
    icc_status status = ICC_OK;
    for (size_t side = 0; side < 2 && status == ICC_OK; side++) {
        for (size_t i = 0; i < in->n; i++)
            points[i] = (icc_feature){.size = sizeof *points,
                                      .kind = ICC_FEATURE_POINT,
                                      .n_vertices = 1,
                                      .vertices = in->places[side] + 2 * i};
        status = icc_domain_create_features(&sides[side], ring->n, rings[side], in->n, points,
                                            &p->kernel.job.env, err);
    }
    free(points);
    return status;
}

/* Makes the map of the outline and the places inside. It is accepted if it is certified and its
 * energy is at most `times` the present one. */
static icc_status try_map(pose *p, const posed_outline *ring, const posed_places *in, double times,
                          icc_error *err)
{
    icc_domain *sides[2] = {NULL, NULL};
    icc_map *map = NULL;
    icc_map_info info = {.size = sizeof info};
    icc_status status = make_sides(sides, p, ring, in, err);
    if (status == ICC_OK)
        status = icc_map_create(&map, sides[0], sides[1], NULL, &p->kernel.job.env, err);
    if (status == ICC_OK)
        icc_map_get_info(map, &info);
    if (status == ICC_OK && info.kind == ICC_MAP_MESH && info.certified &&
        (p->map == NULL || info.energy <= times * p->energy)) {
        pose_certified_free(p);
        memcpy(p->sides, sides, sizeof sides);
        p->map = map;
        p->energy = info.energy;
        p->n_followed = in->n;
        return ICC_OK;
    }
    icc_map_free(map);
    icc_domain_free(sides[0]);
    icc_domain_free(sides[1]);
    return status;
}

/* Places of the pose are followed unless this raises the energy by more than this factor, compared
 * with the map of the handles alone. Places close to folds can get entangled. */
static const double DEAR = 1.5;

static int make_map(pose *p, const posed_samples *samples, const posed_outline *ring,
                    const bool *on_ring)
{
    posed_places in = {0};
    icc_error err = {.size = sizeof err, .index = -1};
    take_handles(&in, p, on_ring);
    size_t n_handles = in.n;
    progress_expect(&p->kernel.job.bar, 0.9);
    icc_status status = try_map(p, ring, &in, 1, &err);
    int result = status != ICC_OK ? failed_handle(p, &in, &err)
                 : p->map == NULL ? failed(p->kernel.job.args->pose, 0,
                                           "no map to the posed outline could be certified")
                                  : posed_places_follow(&in, p, samples, ring);
    if (result == DONE && in.n > n_handles)
        (void)try_map(p, ring, &in, DEAR, NULL);
    if (result == DONE)
        p->n_followed -= n_handles;
    posed_places_free(&in);
    progress_end(&p->kernel.job.bar);
    return result;
}

/* ------------------------------------------------------------- how far off */

/* Compares the map with the pose by the weights alone. */
static int compare(pose *p, const posed_samples *s)
{
    size_t n_failed, n_folded = 0, n_both = 0;
    double *mapped = need(s->n, 2 * sizeof *mapped);
    int result = pose_points(p, s->n, s->rest, mapped, NULL, &n_failed);
    for (size_t i = 0; i < s->n && result == DONE; i++) {
        double off =
            hypot(s->posed[2 * i] - mapped[2 * i], s->posed[2 * i + 1] - mapped[2 * i + 1]);
        n_folded += !(s->growth[i] > 0);
        if (isnan(off))
            continue;
        n_both++;
        p->off_mean += off;
        p->off_most = fmax(p->off_most, off);
    }
    p->off_mean /= n_both > 0 ? (double)n_both : 1;
    p->folded = s->n > 0 ? (double)n_folded / (double)s->n : 0;
    free(mapped);
    return result;
}

static int make_outline(posed_outline *out, pose *p, const icc_domain *region, size_t n,
                        const double *ring, bool *on_ring)
{
    double given = p->kernel.job.args->tolerance, size = ring_size(n, ring);
    double tolerance = given > 0 ? given : TOLERANCE * size;
    int result = posed_outline_make(out, p, region, n, ring, tolerance, on_ring);
    while (result == DONE && !(given > 0) && tolerance < COARSEST * size &&
           !posed_outline_is_simple(out, p)) {
        tolerance *= COARSER;
        p->outline_off = tolerance;
        posed_outline_free(out);
        result = posed_outline_make(out, p, region, n, ring, tolerance, on_ring);
    }
    return result == DONE ? posed_outline_check(out, p) : result;
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
    posed_samples samples = {0};
    int result = make_outline(&posed, p, region, n, ring, on_ring);
    if (result == DONE)
        result = posed_samples_make(&samples, p);
    if (result == DONE)
        result = make_map(p, &samples, &posed, on_ring);
    if (result == DONE) {
        carrier_start(&p->carrier, false, &k->job.env);
        icc_status ran = carrier_add(&p->carrier, p->map, p->sides[0], p->sides[1]);
        carrier_set_snap(&p->carrier, -1);
        result = ran == ICC_OK ? compare(p, &samples) : job_failed_status(&p->kernel.job, ran);
    }
    posed_samples_free(&samples);
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
             "certified one-to-one: %zu triangles, through %zu places of the pose; by weights "
             "alone %.2g %% of the shape is turned over, and is %.3g away on average, %.3g at most",
             info.n_simplices, p->n_followed, 100 * p->folded, p->off_mean, p->off_most);
    pose_say(p, text);
    if (p->outline_off > 0) {
        snprintf(text, sizeof text,
                 "the posed outline meets itself unless it is followed less closely: by up to %.3g",
                 p->outline_off);
        pose_say(p, text);
    }
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
    json_count(out, "followed", p->n_followed);
    if (p->outline_off > 0)
        json_number(out, "outline_off", p->outline_off);
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
    p->map = NULL;
    p->sides[0] = p->sides[1] = NULL;
}
