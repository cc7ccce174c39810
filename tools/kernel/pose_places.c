/* Spreads places inside a shape where the pose does not fold. */
#include "kernel/pose_places.h"

#include "base/allocate.h"
#include "geo/clip_rings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* APART: distance of places, as a share of the shape's size. NEAR: they are this share of it away
 * from the outline and from folds. FOLDED: places that shrink to less than this share of the mean
 * count as folded. */
static const double APART = 1 / 12.0, NEAR = 0.5, FOLDED = 0.05;

/* The largest factor by which the pose may change the distance of two places, apart from overall
 * growth. */
static const double STRETCH = 2;

/* ------------------------------------------------------------------ samples */

int posed_samples_make(posed_samples *out, pose *p)
{
    icc_sampling_info info = {.size = sizeof info};
    icc_sampling_get_info(p->kernel.sampling, &info);
    size_t n_edge = info.kind == ICC_SAMPLING_BLUE ? info.n_edge : 0, n_failed;
    double *all = need(info.n_samples, 2 * sizeof *all);
    icc_sampling_get_points(p->kernel.sampling, all);
    *out = (posed_samples){.n = info.n_samples - n_edge};
    out->rest = need(out->n, 2 * sizeof(double));
    out->posed = need(out->n, 2 * sizeof(double));
    out->growth = need(out->n, sizeof(double));
    memcpy(out->rest, all + 2 * n_edge, out->n * 2 * sizeof *all);
    double *slopes = need(out->n, 4 * sizeof *slopes);
    int result = pose_points(p, out->n, out->rest, out->posed, slopes, &n_failed);
    for (size_t i = 0; i < out->n; i++)
        out->growth[i] = slopes[4 * i] * slopes[4 * i + 3] - slopes[4 * i + 1] * slopes[4 * i + 2];
    free(slopes);
    free(all);
    return result;
}

void posed_samples_free(posed_samples *s)
{
    free(s->rest);
    free(s->posed);
    free(s->growth);
    *s = (posed_samples){0};
}

/* ------------------------------------------------------------------- places */

void posed_places_add(posed_places *out, const double *rest, const double *posed, size_t handle)
{
    out->places[0] = grow(out->places[0], &out->room_rest, 2 * (out->n + 1), sizeof *rest);
    out->places[1] = grow(out->places[1], &out->room_posed, 2 * (out->n + 1), sizeof *posed);
    out->handles = grow(out->handles, &out->room_handles, out->n + 1, sizeof *out->handles);
    memcpy(out->places[0] + 2 * out->n, rest, 2 * sizeof *rest);
    memcpy(out->places[1] + 2 * out->n, posed, 2 * sizeof *posed);
    out->handles[out->n++] = handle;
}

void posed_places_free(posed_places *places)
{
    free(places->places[0]);
    free(places->places[1]);
    free(places->handles);
    *places = (posed_places){0};
}

/* True if a sample is far enough from all places and moves in a similar way. A handle that jumps
 * does not take places near it along. */
static bool fits(const posed_places *places, const double *rest, const double *posed, double apart,
                 double scale)
{
    for (size_t i = 0; i < places->n; i++) {
        const double *a = places->places[0] + 2 * i, *b = places->places[1] + 2 * i;
        double before = hypot(a[0] - rest[0], a[1] - rest[1]),
               after = hypot(b[0] - posed[0], b[1] - posed[1]) / scale;
        if (before < apart || after > STRETCH * before || before > STRETCH * after)
            return false;
    }
    return true;
}

static bool is_away_from_folds(const posed_samples *s, size_t i, double least, double distance)
{
    for (size_t k = 0; k < s->n; k++)
        if (!(s->growth[k] > least) && hypot(s->rest[2 * k] - s->rest[2 * i],
                                             s->rest[2 * k + 1] - s->rest[2 * i + 1]) < distance)
            return false;
    return true;
}

/* The depth of each point inside the ring, or 0 for points outside. */
static icc_status find_depths(double *depths, size_t n_ring, const double *ring, size_t n,
                              const double *points, const icc_env *env)
{
    icc_domain *domain = NULL;
    int32_t *where = need(n, sizeof *where);
    uint32_t *facets = need(n, sizeof *facets);
    double *bary = need(n, 2 * sizeof *bary);
    icc_status status = icc_domain_create(&domain, 2, n_ring, ring, 0, NULL, env, NULL);
    if (status == ICC_OK)
        status = icc_domain_locate(domain, n, points, where, facets, bary, env);
    for (size_t i = 0; i < n && status == ICC_OK; i++) {
        const double *a = ring + 2 * facets[i], *b = ring + 2 * ((facets[i] + 1) % n_ring);
        double at[2];
        for (size_t c = 0; c < 2; c++)
            at[c] = bary[2 * i] * a[c] + bary[2 * i + 1] * b[c] - points[2 * i + c];
        depths[i] = where[i] == ICC_INSIDE ? hypot(at[0], at[1]) : 0;
    }
    icc_domain_free(domain);
    free(where);
    free(facets);
    free(bary);
    return status;
}

static void choose(posed_places *out, const posed_samples *s, const double *depths[2], double apart,
                   double growth)
{
    double near = NEAR * apart, scale = sqrt(growth);
    for (size_t i = 0; i < s->n; i++)
        if (s->growth[i] > FOLDED * growth && depths[0][i] > near &&
            STRETCH * depths[1][i] > near * scale &&
            fits(out, s->rest + 2 * i, s->posed + 2 * i, apart, scale) &&
            is_away_from_folds(s, i, FOLDED * growth, near))
            posed_places_add(out, s->rest + 2 * i, s->posed + 2 * i, SIZE_MAX);
}

int posed_places_follow(posed_places *out, pose *p, const posed_samples *s,
                        const posed_outline *ring)
{
    const icc_env *env = &p->kernel.job.env;
    double *depths[2] = {need(s->n, sizeof(double)), need(s->n, sizeof(double))};
    double growth = ring_area(ring->n, ring->posed, 2) / ring_area(ring->n, ring->rest, 2);
    icc_status status = find_depths(depths[0], ring->n, ring->rest, s->n, s->rest, env);
    if (status == ICC_OK)
        status = find_depths(depths[1], ring->n, ring->posed, s->n, s->posed, env);
    if (status == ICC_OK)
        choose(out, s, (const double *[]){depths[0], depths[1]},
               APART * ring_size(ring->n, ring->rest), growth);
    free(depths[0]);
    free(depths[1]);
    return status == ICC_OK ? DONE : job_failed_status(&p->kernel.job, status);
}
