/* A fit of a figure or a mesh: its told vertices go to their targets, and the rest follows as
 * rigidly as it can. */
#include "fit/elastic_fit.h"

#include "base/minmax.h"
#include "fit/elastic_shape.h"
#include "map/given_mesh.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* A sliding vertex is on its line if it is off by at most this share of the shape's size, which is
 * rounding. */
static const double ON_LINE = 1e-12;

/* Returns whether a held vertex is at its target. Then its image gets the caller's bits. */
static bool settle_held(const icc_fit *fit, size_t item, const double *target, double *image)
{
    const double *local = fit->images + 2 * (size_t)fit->told.vertex[item];
    for (size_t k = 0; k < 2; ++k)
        if (local[k] < target[k] || local[k] > target[k])
            return false;
    memcpy(image, fit->told.target + 2 * item, 2 * sizeof *image);
    return true;
}

/* Writes how far a sliding vertex is off its line. `place`: a point of the line, local. */
static bool is_on_line(const icc_fit *fit, size_t item, const double *place, double *residual)
{
    const iccp_elastic_shape *s = fit->shape;
    const size_t v = 2 * (size_t)fit->told.vertex[item];
    const double *d = s->direction + v, *image = fit->images + v;
    const double off =
        ((image[1] - place[1]) * d[0] - (image[0] - place[0]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    residual[0] = -off * d[1] * s->frame.out[0] * s->frame.out[1];
    residual[1] = off * d[0] * s->frame.out[0] * s->frame.out[1];
    return iccp_hypot(off * d[0], off * d[1]) <= ON_LINE;
}

/* Converts the images to the caller's coordinates, and notes which items are off. `targets`: local,
 * of all vertices. */
static void give_back(icc_fit *fit, const double *targets, double *images)
{
    const iccp_elastic_shape *s = fit->shape;
    const iccp_told *told = &fit->told;
    double sum = 0;
    for (size_t v = 0; v < s->n_points; ++v)
        iccp_frame_out(&s->frame, 2, fit->images + 2 * v, images + 2 * v);
    for (size_t i = 0; i < told->n; ++i) {
        const size_t v = 2 * (size_t)told->vertex[i];
        double *residual = fit->residuals + 2 * i;
        bool is_there;
        if (told->kind[i] == ICC_CONSTRAINT_SLIDING) {
            is_there = is_on_line(fit, i, targets + v, residual);
        } else {
            is_there = settle_held(fit, i, targets + v, images + v);
            for (size_t k = 0; k < 2; ++k)
                residual[k] = images[v + k] - told->target[2 * i + k];
            sum += residual[0] * residual[0] + residual[1] * residual[1];
        }
        fit->info.n_off += !is_there;
        if (!is_there)
            fit->info.most_off = iccp_max(fit->info.most_off, iccp_hypot(residual[0], residual[1]));
    }
    fit->info.residual = sqrt(sum / (double)told->n);
}

static icc_status make_map(icc_fit *fit, const double *targets, const iccp_env *env, icc_error *err)
{
    const iccp_elastic_shape *s = fit->shape;
    double *images = iccp_alloc(&env->memory, s->n_points, 2 * sizeof *images);
    if (images == NULL)
        return ICC_ERR_MEMORY;
    give_back(fit, targets, images);
    const iccp_given_mesh mesh = {.n_vertices = s->n_points,
                                  .points = s->given,
                                  .images = images,
                                  .n_triangles = s->n_triangles,
                                  .triangles = s->triangles,
                                  .n_held = s->n_inner,
                                  .held = s->inner};
    const icc_status status = iccp_map_of_mesh(&fit->map, &mesh, env, err);
    iccp_free(&env->memory, images);
    return status;
}

icc_status iccp_elastic_fit(icc_fit *fit, const iccp_env *env, icc_error *err)
{
    const iccp_elastic_shape *s = fit->shape;
    iccp_elastic_report report = {0};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){8, 1}, env);
    for (size_t i = 0; i < 2 * fit->told.n; ++i)
        fit->left_out[i] = NAN;
    double *targets = iccp_alloc(&env->memory, s->n_points, 2 * sizeof *targets);
    if (targets == NULL)
        return ICC_ERR_MEMORY;
    iccp_elastic_shape_aim(s, &fit->told, targets);
    icc_status status =
        fit->is_moved
            ? iccp_elastic_drag(s->elastic, targets, fit->images, fit->off, &report, &part[0], err)
            : iccp_elastic_solve(s->elastic, targets, fit->images, &report, &part[0], err);
    fit->info.n_iterations = report.n_iterations;
    fit->info.left_out = fit->info.affine_residual = NAN;
    if (status == ICC_OK)
        status = make_map(fit, targets, &part[1], err);
    iccp_free(&env->memory, targets);
    return status;
}
