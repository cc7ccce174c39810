/* libicc fit: a map from control points alone, or of a figure by pins. What it does with the map is
 * what map and warp do. Without any of that it prints how far each point is off. */
#include "cmd/commands.h"

#include "fit/fit_job.h"
#include "fit/fit_report.h"
#include "fit/rectify.h"
#include "job/require.h"
#include "job/triangulation.h"

#include <math.h>
#include <stdio.h>

/* A picture has pixels on both sides. */
static int check_pixels(const fit_job *f)
{
    return f->turned ? failed(f->job.args->source, 0,
                              "--warp needs pixels on both sides, with y down; here y points up in "
                              "the target. --rectify writes a picture in the target's coordinates")
                     : DONE;
}

static bool has_output(const args *a)
{
    return a->geojson || a->warps || a->rectifies || a->points != NULL;
}

/* Writes the triangulation, if that is all there is to write. */
static int write_map(fit_job *f)
{
    int result = job_make_domains(&f->job);
    if (result == DONE)
        result = require_maps(&f->job);
    if (result == DONE)
        result = triangulation_write(&f->job);
    return result == DONE ? triangulation_tell(&f->job) : result;
}

static int apply(fit_job *f)
{
    const args *a = f->job.args;
    return a->rectifies        ? rectify(f)
           : a->geojson        ? geojson_apply(&f->job)
           : a->warps          ? check_pixels(f) == DONE ? warp_apply(&f->job) : FAILED
           : a->points != NULL ? map_apply(&f->job)
                               : write_map(f);
}

/* Prints the table on request, or if nothing else is written. */
static int print(const fit_job *f)
{
    const args *a = f->job.args;
    bool alone = !has_output(a);
    if (alone && a->json && fit_report(f) != DONE)
        return FAILED;
    if (a->residuals || (alone && !a->json && a->triangulation == NULL && a->drawing == NULL))
        fit_print(f);
    return DONE;
}

int run_fit(const args *a)
{
    fit_job f;
    int result = fit_job_start(&f, a);
    if (result == DONE && !a->rectifies)
        result = fit_job_make(&f);
    progress_end(&f.job.bar);
    if (result == DONE)
        result = apply(&f);
    if ((result == DONE || result == PARTIAL) && a->drawing != NULL &&
        plot_apply(&f.job, a->drawing) != DONE)
        result = FAILED;
    if (result == DONE || result == PARTIAL) {
        int told = fit_job_tell(&f);
        int printed = print(&f);
        result = printed != DONE ? printed : told != DONE ? told : result;
    }
    fit_job_end(&f);
    return result;
}
