/* Messages and reports of `libicc pose`, for points, meshes and pictures. */
#include "kernel/pose_job.h"

#include "base/allocate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *pose_output(const pose *p)
{
    const args *a = p->kernel.job.args;
    return a->operands[a->n_operands - 1];
}

void pose_say(const pose *p, const char *text)
{
    if (strcmp(pose_output(p), "-") == 0)
        note("%s", text);
    else
        printf("%s\n", text);
}

int pose_report_open(report *r, pose *p, size_t n, const double *points, size_t n_failed,
                     double seconds)
{
    size_t dim = p->kernel.set.dim, n_finite = 0;
    double *finite = need(n, dim * sizeof *finite);
    for (size_t i = 0; i < n; i++) {
        double sum = 0;
        for (size_t c = 0; c < dim; c++)
            sum += 0 * points[dim * i + c];
        if (!isnan(sum))
            memcpy(finite + dim * n_finite++, points + dim * i, dim * sizeof *finite);
    }
    int result = kernel_report_open(r, &p->kernel, n_finite, finite);
    free(finite);
    if (result != DONE)
        return result;
    json_count(&r->json, "points", n);
    json_count(&r->json, "without_image", n_failed);
    json_number(&r->json, "seconds_pose", seconds);
    pose_certified_report(p, &r->json);
    return DONE;
}
