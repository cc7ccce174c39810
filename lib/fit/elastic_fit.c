/* A fit of a figure or a mesh: its told vertices go to their targets, and the rest follows as
 * rigidly as it can. */
#include "fit/elastic_fit.h"

#include "fit/elastic_shape.h"
#include "map/given_mesh.h"

#include <math.h>

/* Converts the images to the caller's coordinates. Items that were reached get the caller's
 * bits. */
static void give_back(icc_fit *fit, double *images)
{
    const iccp_elastic_shape *s = fit->shape;
    const iccp_told *told = &fit->told;
    double sum = 0;
    for (size_t v = 0; v < s->n_points; ++v)
        iccp_frame_out(&s->frame, 2, fit->images + 2 * v, images + 2 * v);
    for (size_t i = 0; i < told->n; ++i) {
        const size_t v = 2 * (size_t)told->vertex[i];
        double target[2];
        iccp_frame_in(&s->frame, 2, told->target + 2 * i, target);
        for (size_t k = 0; k < 2; ++k) {
            if (told->kind[i] == ICC_CONSTRAINT_SLIDING)
                break;
            if (!(fit->images[v + k] < target[k]) && !(fit->images[v + k] > target[k]))
                images[v + k] = told->target[2 * i + k];
            fit->residuals[2 * i + k] = images[v + k] - told->target[2 * i + k];
            sum += fit->residuals[2 * i + k] * fit->residuals[2 * i + k];
        }
    }
    fit->info.residual = sqrt(sum / (double)told->n);
}

static icc_status make_map(icc_fit *fit, const iccp_env *env, icc_error *err)
{
    const iccp_elastic_shape *s = fit->shape;
    double *images = iccp_alloc(&env->memory, s->n_points, 2 * sizeof *images);
    if (images == NULL)
        return ICC_ERR_MEMORY;
    give_back(fit, images);
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
    for (size_t i = 0; i < 2 * fit->told.n; ++i) {
        fit->residuals[i] = 0;
        fit->left_out[i] = NAN;
    }
    double *targets = iccp_alloc(&env->memory, s->n_points, 2 * sizeof *targets);
    if (targets == NULL)
        return ICC_ERR_MEMORY;
    iccp_elastic_shape_aim(s, &fit->told, targets);
    icc_status status =
        fit->is_moved
            ? iccp_elastic_drag(s->elastic, targets, fit->images, fit->off, &report, &part[0], err)
            : iccp_elastic_solve(s->elastic, targets, fit->images, &report, &part[0], err);
    iccp_free(&env->memory, targets);
    fit->info.n_off = report.n_off;
    fit->info.most_off = report.most_off * s->frame.out[0] * s->frame.out[1];
    fit->info.n_iterations = report.n_iterations;
    fit->info.left_out = fit->info.affine_residual = NAN;
    return status == ICC_OK ? make_map(fit, &part[1], err) : status;
}
