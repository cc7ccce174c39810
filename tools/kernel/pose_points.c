/* Poses points in batches. */
#include "kernel/pose_job.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points that are bound at once. This limits the memory for their weights. */
enum { BATCH = 8192 };

static bool is_finite(size_t dim, const double *point)
{
    for (size_t c = 0; c < dim; c++)
        if (!isfinite(point[c]))
            return false;
    return true;
}

/* Poses the n finite points in place. */
static icc_status pose_finite(pose *p, size_t n, double *points, double *jacobians, icc_error *err)
{
    const icc_env *env = &p->kernel.job.env;
    icc_binding *binding;
    icc_status status =
        icc_binding_create(&binding, p->kernel.weights, n, points, jacobians != NULL, env, err);
    if (status == ICC_OK)
        status = icc_binding_pose(binding, p->transforms, points, jacobians, env);
    icc_binding_free(binding);
    return status;
}

/* Poses the finite points of a batch and puts their images in place. */
static icc_status pose_batch(pose *p, size_t n, const double *points, double *images,
                             double *jacobians, double *work, size_t *n_failed, icc_error *err)
{
    size_t dim = p->kernel.set.dim, squared = dim * dim, n_finite = 0;
    double *slopes = jacobians != NULL ? work + dim * n : NULL;
    for (size_t i = 0; i < n; i++)
        if (is_finite(dim, points + dim * i))
            memcpy(work + dim * n_finite++, points + dim * i, dim * sizeof *work);
    icc_status status = n_finite > 0 ? pose_finite(p, n_finite, work, slopes, err) : ICC_OK;
    *n_failed += n - n_finite;
    for (size_t i = 0, from = 0; i < n && status == ICC_OK; i++) {
        bool finite = is_finite(dim, points + dim * i);
        for (size_t c = 0; c < dim; c++)
            images[dim * i + c] = finite ? work[dim * from + c] : NAN;
        for (size_t c = 0; jacobians != NULL && c < squared; c++)
            jacobians[squared * i + c] = finite ? slopes[squared * from + c] : NAN;
        from += finite;
    }
    return status;
}

int pose_points(pose *p, size_t n, const double *points, double *images, double *jacobians,
                size_t *n_failed)
{
    size_t dim = p->kernel.set.dim;
    if (p->map != NULL)
        return pose_certified_points(p, n, points, images, jacobians, n_failed);
    double *work = need(BATCH, dim * (dim + 1) * sizeof *work);
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status status = ICC_OK;
    *n_failed = 0;
    for (size_t i = 0; i < n && status == ICC_OK; i += BATCH)
        status =
            pose_batch(p, n - i < BATCH ? n - i : BATCH, points + dim * i, images + dim * i,
                       jacobians != NULL ? jacobians + dim * dim * i : NULL, work, n_failed, &err);
    free(work);
    progress_end(&p->kernel.job.bar);
    err.status = status;
    return status == ICC_OK ? DONE : job_failed(&p->kernel.job, &err);
}

static double determinant(size_t dim, const double *j)
{
    return dim == 2 ? j[0] * j[3] - j[1] * j[2]
                    : j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) +
                          j[2] * (j[3] * j[7] - j[4] * j[6]);
}

turned pose_count_turned(size_t dim, size_t n, const double *jacobians)
{
    turned t = {0, 0, 0};
    for (size_t i = 0; i < n; i++) {
        double d = determinant(dim, jacobians + dim * dim * i);
        t.kept += d > 0;
        t.inverted += d < 0;
        t.collapsed += !(d > 0 || d < 0 || isnan(d));
    }
    return t;
}
