/* Derivatives of a map at the vertices of a mesh, for its normals and tangents. */
#include "job/attached.h"

#include "base/allocate.h"
#include "mesh/affine_map.h"
#include "mesh/mesh_vectors.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------- places */

static bool map_points(void *data, size_t n, const double *points, double *images, size_t *n_failed)
{
    job *j = data;
    size_t dim = job_dim(j);
    icc_status *status = need(n, sizeof *status);
    icc_status ran = (j->args->inverse ? icc_map_apply_inverse : icc_map_apply)(
        j->map, n, points, images, status, n_failed, &j->env);
    for (size_t i = 0; i < n && ran == ICC_OK; i++)
        if (status[i] != ICC_OK)
            memcpy(images + dim * i, points + dim * i, dim * sizeof *images);
    free(status);
    return ran == ICC_OK || job_failed_status(j, ran) == DONE;
}

/* -------------------------------------------------------------- derivatives */

/* The search for derivatives at points, some of which are still missing. */
typedef struct search {
    job *j;
    size_t dim, n;
    size_t *left; /* n of them */
    double *at, *found, *sources;
    icc_status *status;
    double size, centre[3]; /* of the box of the points */
} search;

static void find_box(search *s, size_t n, const double *points)
{
    double extent = 0;
    for (size_t k = 0; k < s->dim; k++) {
        double lower = HUGE_VAL, upper = -HUGE_VAL;
        for (size_t i = 0; i < n; i++) {
            lower = fmin(lower, points[s->dim * i + k]);
            upper = fmax(upper, points[s->dim * i + k]);
        }
        s->centre[k] = lower + (upper - lower) / 2;
        extent = fmax(extent, upper - lower);
    }
    s->size = extent;
}

/* The place where each round computes a point's derivative: at the point, beside it against its
 * direction, beside it along its direction, and towards the middle of all points. The step is as
 * small as the resolution of floats. */
static void step(const search *s, size_t round, const double *point, const double *direction,
                 double *out)
{
    double d[3] = {0, 0, 0};
    for (size_t k = 0; k < s->dim; k++)
        d[k] = round < 3 ? direction[k] : s->centre[k] - point[k];
    if (round < 3 && s->j->cages[s->j->args->inverse].flipped)
        d[1] = -d[1];
    double length = round == 0 ? 0 : (round == 1 ? -1 : 1) * (double)FLT_EPSILON * s->size;
    if (!affine_set_length(d, length))
        memset(d, 0, sizeof d);
    for (size_t k = 0; k < s->dim; k++)
        out[k] = point[k] + d[k];
}

/* Turns the derivative of the map into that of the inverse map. */
static void invert(size_t dim, double *derivative)
{
    double whole[12], back[12];
    bool good = carry_derivative(whole, dim, derivative) && affine_invert(back, whole);
    for (size_t i = 0; i < dim * dim; i++)
        derivative[i] = good ? back[i / dim * 4 + i % dim] : (double)NAN;
}

/* Computes all missing derivatives, and keeps those that it finds. */
static icc_status look(search *s, double *derivatives)
{
    job *j = s->j;
    size_t square = s->dim * s->dim, n_left = 0;
    const double *at = j->args->inverse ? s->sources : s->at;
    icc_status ran = ICC_OK;
    if (j->args->inverse)
        ran = icc_map_apply_inverse(j->map, s->n, s->at, s->sources, s->status, NULL, &j->env);
    for (size_t i = 0; i < s->n && j->args->inverse; i++)
        if (s->status[i] != ICC_OK)
            memcpy(s->sources + s->dim * i, s->at + s->dim * i, s->dim * sizeof *s->at);
    icc_status *before = need(s->n, sizeof *before);
    if (j->args->inverse)
        memcpy(before, s->status, s->n * sizeof *before);
    if (ran == ICC_OK)
        ran = icc_map_jacobian(j->map, s->n, at, s->found, s->status, NULL, &j->env);
    for (size_t i = 0; i < s->n && ran == ICC_OK; i++) {
        double *found = s->found + square * i;
        if (s->status[i] == ICC_OK && j->args->inverse)
            invert(s->dim, found);
        if (s->status[i] == ICC_OK && before[i] == ICC_OK && isfinite(found[0]))
            memcpy(derivatives + square * s->left[i], found, square * sizeof *found);
        else
            s->left[n_left++] = s->left[i];
    }
    s->n = n_left;
    free(before);
    return ran;
}

/* Turns a derivative between files whose y is reversed, too. */
static void reverse_y(const job *j, double *derivative)
{
    size_t dim = job_dim(j), inverse = j->args->inverse;
    for (size_t k = 0; k < dim; k++) {
        if (j->cages[inverse].flipped)
            derivative[dim * k + 1] = -derivative[dim * k + 1];
        if (j->cages[!inverse].flipped)
            derivative[dim + k] = -derivative[dim + k];
    }
}

static bool derive_points(void *data, size_t n, const double *points, const double *directions,
                          double *derivatives)
{
    job *j = data;
    size_t dim = job_dim(j);
    search s = {.j = j,
                .dim = dim,
                .n = n,
                .left = need(n, sizeof(size_t)),
                .at = need(n, dim * sizeof(double)),
                .sources = need(n, dim * sizeof(double)),
                .found = need(n, dim * dim * sizeof(double)),
                .status = need(n, sizeof(icc_status))};
    icc_status ran = ICC_OK;
    find_box(&s, n, points);
    for (size_t i = 0; i < n; i++)
        s.left[i] = i;
    for (size_t i = 0; i < n * dim * dim; i++)
        derivatives[i] = (double)NAN;
    for (size_t round = 0; round < 4 && s.n > 0 && ran == ICC_OK; round++) {
        for (size_t i = 0; i < s.n; i++)
            step(&s, round, points + dim * s.left[i], directions + 3 * s.left[i], s.at + dim * i);
        ran = look(&s, derivatives);
    }
    for (size_t i = 0; i < n; i++)
        reverse_y(j, derivatives + dim * dim * i);
    free(s.left);
    free(s.at);
    free(s.sources);
    free(s.found);
    free(s.status);
    return ran == ICC_OK || job_failed_status(j, ran) == DONE;
}

/* --------------------------------------------------------------------- all */

int attached_carry(job *j, mesh_file *m, const double *images, const icc_status *status,
                   mesh_carried *out)
{
    const mesh_mover mover = {j, map_points, derive_points};
    double *places = need(m->n_vertices, m->dim * sizeof *places);
    problem wrong;
    for (size_t i = 0; i < m->n_vertices; i++)
        memcpy(places + m->dim * i, (status[i] == ICC_OK ? images : m->points) + m->dim * i,
               m->dim * sizeof *places);
    bool good = mesh_carry(m, places, &mover, out, &wrong);
    if (good && j->args->rotates_vectors)
        good = mesh_rotate_vectors(m, &mover, &out->rotated, &wrong);
    out->other = out->other && out->rotated.n_arrays == 0;
    free(places);
    progress_end(&j->bar);
    return good                    ? DONE
           : wrong.text[0] != '\0' ? failed(j->args->operands[0], wrong.line, "%s", wrong.text)
                                   : FAILED;
}

int attached_beyond(const job *j, const mesh_carried *c)
{
    if (c->n_beyond == 0)
        return DONE;
    note("%s: morph targets move %zu vertices to places without an image, %s", j->args->operands[0],
         c->n_beyond,
         j->args->outside == OUTSIDE_KEEP
             ? "and these stay there"
             : "so nothing was written; --outside keep leaves them there");
    return PARTIAL;
}

void attached_tell(const char *file, const mesh_carried *c)
{
    if (c->n_stay > 0)
        note("%s: %zu of %zu normals and tangents stay as they are, because the map has no "
             "derivative there",
             file, c->n_stay, c->n_vectors);
    if (c->rotated.n_stay > 0)
        note("%s: %zu of %zu vectors stay as they are, because the map has no derivative there",
             file, c->rotated.n_stay, c->rotated.n_vectors);
    if (c->shared >= 0.05)
        note("%s: normals of several vertices become the mean of their images, off by up to %.1f "
             "degrees; save with a normal for each vertex",
             file, c->shared);
    if (c->other)
        note("%s: some normals or tangents stay as they are", file);
    if (c->skins && c->why == NULL)
        note("%s: skins stay as they are (joints and inverse bind matrices)", file);
    if (c->skins && c->why != NULL)
        note("%s: skins[%zu] stays as it is (joints and inverse bind matrices): %s", file, c->skin,
             c->why);
    if (c->n_copies > 0)
        note("%s: nodes draw one mesh at several places, so %zu %s", file, c->n_copies,
             c->n_copies == 1 ? "copy of a mesh was made" : "copies of meshes were made");
    if (c->n_out > 0)
        note("%s: %zu of %zu joints have no image and stay where they are", file, c->n_out,
             c->n_joints);
    if (c->animations)
        note("%s: animations of nodes stay as they are", file);
}

bool attached_left(mesh_file *m, const char *file, problem *wrong)
{
    mesh_carried c;
    if (!mesh_carry(m, NULL, NULL, &c, wrong))
        return false;
    if (c.n_morphed > 0)
        note("%s: morph targets stay as they are", file);
    c.other = c.other || c.n_vectors > 0;
    attached_tell(file, &c);
    return true;
}
