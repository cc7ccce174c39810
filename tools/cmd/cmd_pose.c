/* libicc pose: points, meshes and pictures follow their handles. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/number.h"
#include "base/system.h"
#include "job/attached.h"
#include "job/output_name.h"
#include "job/point_file.h"
#include "kernel/pose_job.h"
#include "mesh/mesh_file.h"
#include "mesh/tally.h"
#include "picture/picture_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int partial(const pose *p, size_t n_failed, size_t n, const char *what)
{
    if (n_failed == 0)
        return DONE;
    note("%zu of %zu %s have no image: they are %s", n_failed, n, what,
         p->map != NULL ? "outside the shape" : "not finite");
    return PARTIAL;
}

static int read_pose(pose *p, size_t dim, size_t n_handles, const double *handles)
{
    const char *name = p->kernel.job.args->pose;
    size_t n;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    problem wrong;
    p->transforms = pose_read(dim, n_handles, handles, text, n, &wrong);
    free(text);
    return p->transforms != NULL ? DONE : failed(name, wrong.line, "%s", wrong.text);
}

/* ------------------------------------------------------------------- points */

/* Poses points in their order. --json also counts how many keep their orientation, which needs a
 * Jacobian for each. */
static int write_points(pose *p, const table *points)
{
    size_t dim = p->kernel.set.dim, n_failed;
    bool counts = p->kernel.job.args->json;
    double *images = need(points->n, dim * sizeof *images);
    double *jacobians = counts ? need(points->n, dim * dim * sizeof *jacobians) : NULL;
    double began = seconds_now();
    int result = pose_points(p, points->n, points->values, images, jacobians, &n_failed);
    double seconds = seconds_now() - began;
    if (result == DONE)
        result = rows_write(pose_output(p), points->n, dim, images);
    if (result == DONE && counts) {
        report r;
        turned t = pose_count_turned(dim, points->n, jacobians);
        result = pose_report_open(&r, p, points->n, points->values, n_failed, seconds);
        if (result == DONE) {
            json_count(&r.json, "orientation_kept", t.kept);
            json_count(&r.json, "inverted", t.inverted);
            json_count(&r.json, "collapsed", t.collapsed);
            result = report_close(&r) ? DONE : FAILED;
        }
    }
    free(images);
    free(jacobians);
    return result == DONE ? partial(p, n_failed, points->n, "points") : result;
}

static int pose_rows(pose *p, const char *text, size_t n)
{
    table points;
    problem wrong;
    table_form form = rows_of_points(p->kernel.set.dim);
    int result = table_read(&points, text, n, &form, &wrong)
                     ? write_points(p, &points)
                     : failed(p->kernel.job.args->operands[0], wrong.line, "%s", wrong.text);
    table_free(&points);
    return result;
}

/* ------------------------------------------------------------------- meshes */

/* All vertices of the mesh were finite. Their images may not be, or may not fit the numbers of the
 * file, to which they are rounded. */
static int check_images(pose *p, const mesh_file *m, double *images)
{
    size_t vertex;
    for (size_t i = 0; i < m->n_vertices * m->dim; i++)
        if (!isfinite(images[i]))
            return failed(p->kernel.job.args->operands[0], 0,
                          "vertex %zu %s, so nothing was written", i / m->dim,
                          p->map != NULL ? "is outside the shape"
                                         : "goes beyond the range of numbers");
    return mesh_round(m, images, &vertex)
               ? DONE
               : failed(p->kernel.job.args->operands[0], 0,
                        "the image of vertex %zu is too large for %s, so nothing was written",
                        vertex, m->format);
}

static int report_mesh(pose *p, const mesh_file *m, const tally *counts, size_t n_failed,
                       double seconds)
{
    char text[512];
    report r;
    if (!p->kernel.job.args->json) {
        for (size_t i = 0; tally_line(counts, m, i, text, sizeof text); i++)
            pose_say(p, text);
        return DONE;
    }
    if (pose_report_open(&r, p, m->n_vertices, m->points, n_failed, seconds) != DONE)
        return FAILED;
    tally_report(counts, m, &r.json);
    return report_close(&r) ? DONE : FAILED;
}

static int write_images(const pose *p, const mesh_file *m, const double *images)
{
    outfile file;
    if (!outfile_open(&file, pose_output(p)))
        return FAILED;
    mesh_write(m, images, file.name, file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

/* Prints which elements are inverted. With --require this is a failure. */
static int tell_mesh(const pose *p, const mesh_file *m, const tally *t)
{
    const args *a = p->kernel.job.args;
    tally_tell(t, m, a->operands[0],
               a->certified ? "the mesh is too coarse for the map there"
                            : "the pose folds there, or the mesh is too coarse for it");
    return tally_spoilt(t) == 0 ? DONE
           : a->require == 0
               ? PARTIAL
               : failed(a->operands[0], 0, "elements are inverted, so nothing was written");
}

/* Writes a mesh, unless --require forbids it, and prints the signs of its elements. */
static int finish_mesh(pose *p, const mesh_file *m, const double *images, size_t n_failed,
                       double seconds)
{
    tally t;
    tally_make(&t, m, images);
    int result = DONE;
    if (p->kernel.job.args->require == 0 || tally_spoilt(&t) == 0)
        result = write_images(p, m, images);
    if (result == DONE)
        result = report_mesh(p, m, &t, n_failed, seconds);
    if (result == DONE)
        result = tell_mesh(p, m, &t);
    tally_free(&t);
    return result;
}

/* Poses the vertices of a mesh and writes it with the same elements. */
static int write_mesh(pose *p, const mesh_file *m)
{
    size_t n_failed;
    double *images = need(m->n_vertices, m->dim * sizeof *images);
    double began = seconds_now();
    int result = pose_points(p, m->n_vertices, m->points, images, NULL, &n_failed);
    double seconds = seconds_now() - began;
    if (result == DONE)
        result = check_images(p, m, images);
    if (result == DONE)
        result = finish_mesh(p, m, images, n_failed, seconds);
    free(images);
    return result == DONE ? partial(p, n_failed, m->n_vertices, "vertices") : result;
}

static int pose_mesh(pose *p, const char *text, size_t n)
{
    mesh_file m;
    problem wrong;
    const char *name = p->kernel.job.args->operands[0];
    bool good = mesh_read(&m, p->kernel.set.dim, text, n, &wrong);
    int result = good ? write_mesh(p, &m) : FAILED;
    if (good && result != FAILED)
        good = attached_left(&m, name, &wrong);
    if (!good)
        result = failed(name, wrong.line, "%s", wrong.text);
    mesh_free(&m);
    return result;
}

/* ------------------------------------------------------------------ command */

/* A file of points begins with a number, or is empty. */
static bool is_points(const char *text)
{
    double number;
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3;
    text += strspn(text, " \t\r\n");
    while (*text == '#' && strncmp(text, "# vtk", 5) != 0) {
        text += strcspn(text, "\n");
        text += strspn(text, " \t\r\n");
    }
    return *text == '\0' || number_read(&text, &number) != NUMBER_BAD;
}

static bool is_picture(const char *bytes, size_t n)
{
    return picture_told(bytes, n) != PICTURE_NONE;
}

static int pose_input(pose *p, const char *text, size_t n)
{
    return is_picture(text, n) ? pose_picture(p, text, n)
           : is_points(text)   ? pose_rows(p, text, n)
                               : pose_mesh(p, text, n);
}

/* Files are read first, so that a mistake is reported at once, including a result's name that does
 * not fit its format. */
static int pose_shape(pose *p)
{
    const handle_set *set = &p->kernel.set;
    bool certified = p->kernel.job.args->certified;
    size_t n = 0;
    char *text = NULL;
    int result = kernel_job_read(&p->kernel);
    if (result == DONE && p->kernel.job.args->require != 0 && !certified)
        result = failed(p->kernel.job.args->pose, 0,
                        "poses by weights are not certified; --certified makes them one-to-one");
    if (result == DONE && certified)
        result = pose_certified_check(p);
    if (result == DONE)
        result = read_pose(p, set->dim, set->n_handles, set->handles);
    if (result == DONE) {
        text = file_read_shape(p->kernel.job.args->operands[0], &n);
        result = text == NULL ? FAILED
                              : output_fits("pose", pose_output(p),
                                            is_picture(text, n) ? PICTURES
                                            : is_points(text)   ? "text"
                                                                : mesh_format(text, n));
    }
    if (result == DONE)
        result = kernel_job_make(&p->kernel);
    if (result == DONE && certified)
        result = pose_certified_make(p);
    if (result == DONE)
        result = pose_input(p, text, n);
    if (result == DONE || result == PARTIAL)
        pose_certified_say(p);
    free(text);
    return result;
}

/* Poses the points of a saved binding, which needs neither the shape nor the handles' file. */
static int write_bound(pose *p, const icc_binding *binding)
{
    job *j = &p->kernel.job;
    size_t n, n_handles;
    int32_t dim;
    icc_binding_get_counts(binding, &n, &n_handles, &dim);
    double *handles = need(n_handles, (size_t)dim * sizeof *handles),
           *images = need(n, (size_t)dim * sizeof *images);
    icc_binding_get_weights(binding, handles, NULL);
    int result = read_pose(p, (size_t)dim, n_handles, handles);
    double began = seconds_now();
    icc_status status = ICC_OK;
    if (result == DONE)
        status = icc_binding_pose(binding, p->transforms, images, NULL, &j->env);
    double seconds = seconds_now() - began;
    progress_end(&j->bar);
    if (status != ICC_OK)
        result = failed(j->args->binding, 0, "%s", icc_status_name(status));
    if (result == DONE)
        result = rows_write(pose_output(p), n, (size_t)dim, images);
    if (result == DONE)
        result = report_points(j, n, 0, seconds);
    free(handles);
    free(images);
    return result;
}

static int pose_binding(pose *p)
{
    if (p->kernel.job.args->require != 0)
        return failed(p->kernel.job.args->binding, 0, "poses by weights are not certified");
    const char *name = p->kernel.job.args->binding;
    size_t n;
    char *bytes = file_read(name, &n);
    if (bytes == NULL)
        return FAILED;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_binding *binding;
    icc_status status = icc_binding_load(&binding, n, bytes, &p->kernel.job.env, &err);
    free(bytes);
    int result = status == ICC_OK ? write_bound(p, binding) : failed(name, 0, "%s", err.message);
    icc_binding_free(binding);
    return result;
}

int run_pose(const args *a)
{
    if (a->pins != NULL)
        return run_pins(a);
    pose p = {.transforms = NULL};
    kernel_job_start(&p.kernel, a);
    int result = a->binding != NULL ? pose_binding(&p) : pose_shape(&p);
    free(p.transforms);
    pose_certified_free(&p);
    kernel_job_end(&p.kernel);
    return result;
}
