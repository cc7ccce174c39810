/* A fit of a figure or a mesh: its told vertices go to their targets, and the rest follows as
 * rigidly as it can. */
#include "fit/elastic_fit.h"

#include "base/error.h"
#include "fit/elastic_shape.h"
#include "map/given_mesh.h"
#include "mesh/corners.h"

#include <math.h>
#include <string.h>

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

/* Lists the held vertices inside as points of the map. */
static icc_status list_points(const iccp_elastic_shape *s, uint32_t **vertices,
                              iccp_given_feature **features, size_t *n, const iccp_env *env)
{
    uint8_t *outline = iccp_alloc_zero(&env->memory, s->n_points, 1);
    iccp_corners corners = {s->triangles, NULL, s->n_triangles};
    bool is_manifold;
    corners.twin = iccp_alloc(&env->memory, s->n_triangles, 3 * sizeof *corners.twin);
    *vertices = iccp_alloc(&env->memory, s->n_points, sizeof **vertices);
    *features = iccp_alloc(&env->memory, s->n_points, sizeof **features);
    icc_status status =
        outline != NULL && corners.twin != NULL && *vertices != NULL && *features != NULL
            ? iccp_find_twins(&corners, s->n_points, &is_manifold, env)
            : ICC_ERR_MEMORY;
    for (uint32_t c = 0; status == ICC_OK && c < 3 * s->n_triangles; ++c)
        if (corners.twin[c] == ICCP_NO_NEIGHBOUR)
            outline[s->triangles[iccp_after(c)]] = 1;
    *n = 0;
    for (uint32_t v = 0; status == ICC_OK && v < s->n_points; ++v)
        if (s->hold[v] == ICCP_HELD && !outline[v]) {
            (*vertices)[*n] = v;
            (*features)[*n] = (iccp_given_feature){ICC_FEATURE_POINT, 1, *vertices + *n};
            ++*n;
        }
    iccp_free(&env->memory, outline);
    iccp_free(&env->memory, corners.twin);
    return status;
}

static icc_status make_map(icc_fit *fit, const iccp_env *env, icc_error *err)
{
    const iccp_elastic_shape *s = fit->shape;
    uint32_t *vertices = NULL;
    iccp_given_feature *features = NULL;
    size_t n_features = 0;
    double *images = iccp_alloc(&env->memory, s->n_points, 2 * sizeof *images);
    icc_status status =
        images != NULL ? list_points(s, &vertices, &features, &n_features, env) : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        give_back(fit, images);
        const iccp_given_mesh mesh = {.n_vertices = s->n_points,
                                      .points = s->given,
                                      .images = images,
                                      .n_triangles = s->n_triangles,
                                      .triangles = s->triangles,
                                      .n_features = n_features,
                                      .features = features};
        status = iccp_map_of_mesh(&fit->map, &mesh, env, err);
    }
    iccp_free(&env->memory, images);
    iccp_free(&env->memory, vertices);
    iccp_free(&env->memory, features);
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
