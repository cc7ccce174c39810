/* libicc warp: a picture inside a cage follows it. */
#include "cmd/commands.h"

#include "base/system.h"
#include "job/job.h"
#include "picture/picture_file.h"
#include "plot/coverage.h"
#include "plot/picture_begin.h"
#include "plot/picture_warp.h"

typedef struct warp {
    job *job;
    picture from, to;
    picture_style style; /* of `to` */
    size_t n_failed;
} warp;

static int read_picture(warp *w)
{
    const args *a = w->job->args;
    int result = picture_read(&w->from, a->operands[0]);
    return result == DONE ? picture_begin(&w->to, &w->style, &w->from, a, a->operands[1]) : result;
}

/* Warps and writes, unless every pixel must have an image and some have none. */
static int warp_picture(warp *w)
{
    icc_error err = {.size = sizeof err, .index = -1};
    double began = seconds_now();
    progress_expect(&w->job->bar, 0.9);
    icc_status ran = picture_warp(w->job->map, &w->from, &w->to, &w->n_failed, &w->job->env, &err);
    double seconds = seconds_now() - began;
    progress_end(&w->job->bar);
    const args *a = w->job->args;
    if (ran == ICC_OK && w->n_failed > 0 && a->outside == OUTSIDE_FAIL)
        return failed(a->operands[0], 0,
                      "%zu of %zu pixels have no image in the source, so nothing is written",
                      w->n_failed, w->to.width * w->to.height);
    int result =
        ran == ICC_OK ? picture_save(&w->to, &w->style, a->operands[1]) : job_failed(w->job, &err);
    if (result == DONE)
        result = report_points(w->job, w->to.width * w->to.height, w->n_failed, seconds);
    if (result != DONE || w->n_failed == 0)
        return result;
    note("%zu of %zu pixels have no image in the source: the curves do not reach them", w->n_failed,
         w->to.width * w->to.height);
    return PARTIAL;
}

int warp_apply(job *j)
{
    warp w = {.job = j};
    int result = job_read_plane(j, "warp");
    if (result == DONE)
        result = read_picture(&w);
    if (result == DONE)
        result = job_make_map(j);
    if (result == DONE)
        coverage_tell(j, w.from.width, w.from.height);
    if (result == DONE)
        result = warp_picture(&w);
    picture_free(&w.from);
    picture_free(&w.to);
    return result;
}

int run_warp(const args *a)
{
    job j;
    job_start(&j, a);
    int result = warp_apply(&j);
    job_end(&j);
    return result;
}
