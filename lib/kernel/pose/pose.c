/* Linear blend skinning. Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), (3.37) and
 * (3.44). With weights that sum to 1 the image is
 *      sum of w_j T_j x  =  x + sum of w_j (T_j x - x).
 * The code computes the right-hand side. So the rest pose is exact, and weights that do not quite
 * sum to 1 do not pull towards the origin. */
#include "kernel/pose/pose.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* Points per task. */
enum { GRAIN = 512 };

typedef struct posing {
    const icc_binding *b;
    const double *transforms;
    double *images, *jacobians;
} posing;

/* blend = sum of w_j (T_j - identity). */
static void blend_transforms(const posing *p, const double *weights, double *blend)
{
    const size_t dim = p->b->dim, size = dim * (dim + 1);
    memset(blend, 0, size * sizeof *blend);
    for (size_t j = 0; j < p->b->n_handles; ++j) {
        const double *transform = p->transforms + size * j;
        for (size_t k = 0; k < size; ++k)
            blend[k] += weights[j] * (transform[k] - (k % (dim + 2) == 0));
    }
}

static double moved(size_t dim, const double *row, const double *x)
{
    double sum = row[dim];
    for (size_t k = 0; k < dim; ++k)
        sum += row[k] * x[k];
    return sum;
}

/* jacobian += sum of (T_j x - x) (gradient of w_j)'. */
static void add_gradients(const posing *p, size_t i, double *jacobian)
{
    const icc_binding *b = p->b;
    const size_t dim = b->dim;
    const double *x = b->points + dim * i;
    for (size_t j = 0; j < b->n_handles; ++j) {
        const double *transform = p->transforms + dim * (dim + 1) * j;
        const double *gradient = b->gradients + dim * (b->n_handles * i + j);
        for (size_t r = 0; r < dim; ++r) {
            const double shift = moved(dim, transform + (dim + 1) * r, x) - x[r];
            for (size_t c = 0; c < dim; ++c)
                jacobian[dim * r + c] += shift * gradient[c];
        }
    }
}

static icc_status pose_some(void *argument, size_t begin, size_t end)
{
    const posing *p = argument;
    const size_t dim = p->b->dim;
    for (size_t i = begin; i < end; ++i) {
        const double *x = p->b->points + dim * i;
        double blend[12];
        blend_transforms(p, p->b->weights + p->b->n_handles * i, blend);
        for (size_t r = 0; r < dim; ++r)
            p->images[dim * i + r] = x[r] + moved(dim, blend + (dim + 1) * r, x);
        if (p->jacobians == NULL)
            continue;
        double *jacobian = p->jacobians + dim * dim * i;
        for (size_t k = 0; k < dim * dim; ++k)
            jacobian[k] = blend[(dim + 1) * (k / dim) + k % dim] + (k % (dim + 1) == 0);
        add_gradients(p, i, jacobian);
    }
    return ICC_OK;
}

icc_status iccp_binding_pose(const icc_binding *binding, const double *transforms, double *images,
                             double *jacobians, const iccp_env *env)
{
    posing p = {binding, transforms, images, jacobians};
    return iccp_for_chunks(env, "warp", binding->n, GRAIN, pose_some, &p);
}

/* ---- transforms of handles ---- */

void iccp_pose_reset(size_t dim, size_t n_handles, double *transforms)
{
    const size_t size = dim * (dim + 1);
    for (size_t k = 0; k < size * n_handles; ++k)
        transforms[k] = k % size % (dim + 2) == 0;
}

void iccp_pose_move(size_t dim, double *transform, const double *offset)
{
    for (size_t r = 0; r < dim; ++r)
        transform[(dim + 1) * r + dim] += offset[r];
}

/* The matrix of a rotation about the origin; in space by O. Rodrigues' formula. */
static void turn_matrix(size_t dim, const double *axis, double angle, double matrix[9])
{
    double z[2];
    iccp_cis(angle, z);
    const double c = z[0], s = z[1];
    if (dim == 2) {
        memcpy(matrix, (double[4]){c, -s, s, c}, 4 * sizeof *matrix);
        return;
    }
    const double greatest = iccp_max(fabs(axis[0]), iccp_max(fabs(axis[1]), fabs(axis[2])));
    const double a[3] = {axis[0] / greatest, axis[1] / greatest, axis[2] / greatest};
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (size_t i = 0; i < 3; ++i) {
        const size_t next = (i + 1) % 3, last = (i + 2) % 3;
        for (size_t j = 0; j < 3; ++j)
            matrix[3 * i + j] = (1 - c) * (a[i] / length) * (a[j] / length);
        matrix[4 * i] += c;
        matrix[3 * i + next] -= s * (a[last] / length);
        matrix[3 * i + last] += s * (a[next] / length);
    }
}

void iccp_pose_turn(size_t dim, double *transform, const double *handle, const double *axis,
                    double angle)
{
    double matrix[9], turned[12], at[3];
    turn_matrix(dim, axis, angle, matrix);
    for (size_t r = 0; r < dim; ++r)
        at[r] = moved(dim, transform + (dim + 1) * r, handle);
    for (size_t r = 0; r < dim; ++r)
        for (size_t c = 0; c <= dim; ++c) {
            double sum = c == dim ? at[r] : 0;
            for (size_t k = 0; k < dim; ++k)
                sum +=
                    matrix[dim * r + k] * (transform[(dim + 1) * k + c] - (c == dim ? at[k] : 0));
            turned[(dim + 1) * r + c] = sum;
        }
    memcpy(transform, turned, dim * (dim + 1) * sizeof *transform);
}
