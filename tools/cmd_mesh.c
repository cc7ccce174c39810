/* libicc mesh: carries the vertices of a mesh along, and tells what became of its triangles. */
#include "commands.h"

#include "job.h"
#include "memory.h"
#include "mesh_file.h"
#include "orient.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Triangles by what became of their orientation; those that had none before count by themselves. */
typedef struct tally {
    size_t kept, inverted, collapsed, flat_before, without_image;
} tally;

static const double *corner(const double *points, const uint32_t *triangle, size_t k)
{
    return points + 2 * (size_t)triangle[k];
}

static bool has_image(const double *points, const uint32_t *triangle)
{
    for (size_t k = 0; k < 3; k++)
        if (isnan(corner(points, triangle, k)[0]))
            return false;
    return true;
}

static int triangle_sign(const double *points, const uint32_t *triangle)
{
    return orientation(corner(points, triangle, 0), corner(points, triangle, 1),
                       corner(points, triangle, 2));
}

static tally count(const mesh_file *m, const double *images)
{
    tally t = {0};
    for (size_t i = 0; i < m->n_triangles; i++) {
        const uint32_t *triangle = m->triangles + 3 * i;
        if (!has_image(images, triangle)) {
            t.without_image++;
            continue;
        }
        int before = triangle_sign(m->points, triangle), after = triangle_sign(images, triangle);
        if (before == 0)
            t.flat_before++;
        else if (after == 0)
            t.collapsed++;
        else if (after == before)
            t.kept++;
        else
            t.inverted++;
    }
    return t;
}

/* What the library says of the mesh as a whole, which may have its images repaired; from target to
 * source it has nothing to say. */
static int certify(job *j, const mesh_file *m, double *images, icc_certificate *certificate)
{
    icc_error err = {.size = sizeof err, .index = -1};
    if (j->args->inverse || m->n_triangles == 0)
        return DONE;
    certificate->size = sizeof *certificate;
    icc_status ran = (j->args->repair_mesh ? icc_map_repair : icc_map_certify)(
        j->map, m->n_vertices, m->points, m->n_triangles, m->triangles, images, certificate,
        &j->env, &err);
    progress_end(&j->bar);
    return ran == ICC_OK ? DONE : job_failed(j, &err);
}

static void print_tally(const job *j, const char *text, const icc_certificate *certificate)
{
    const char *verdict = certificate->size == 0   ? ""
                          : certificate->certified ? "; mesh and image are certified one-to-one"
                          : certificate->boundary_simple ? "; not certified"
                                                         : "; not certified, nor is the boundary "
                                                           "one simple polygon before and after";
    if (strcmp(j->args->operands[1], "-") == 0)
        note("%s%s", text, verdict);
    else
        printf("%s%s\n", text, verdict);
}

static int report_tally(const job *j, const mesh_file *m, const tally *t, size_t n_failed,
                        const icc_certificate *certificate)
{
    char text[256];
    snprintf(text, sizeof text,
             "%zu triangles: %zu keep their orientation, %zu inverted, %zu collapsed, %zu flat "
             "before, %zu without image",
             m->n_triangles, t->kept, t->inverted, t->collapsed, t->flat_before, t->without_image);
    if (!j->args->json) {
        print_tally(j, text, certificate);
        return DONE;
    }
    report r;
    if (!report_open(&r, j))
        return FAILED;
    json_count(&r.json, "points", m->n_vertices);
    json_count(&r.json, "without_image", n_failed);
    json_open(&r.json, "triangles", '{');
    json_count(&r.json, "all", m->n_triangles);
    json_count(&r.json, "kept", t->kept);
    json_count(&r.json, "inverted", t->inverted);
    json_count(&r.json, "collapsed", t->collapsed);
    json_count(&r.json, "flat_before", t->flat_before);
    json_count(&r.json, "without_image", t->without_image);
    json_close(&r.json, '}');
    if (certificate->size > 0) {
        json_flag(&r.json, "boundary_simple", certificate->boundary_simple != 0);
        json_flag(&r.json, "certified", certificate->certified != 0);
    }
    return report_close(&r) ? DONE : FAILED;
}

static int write_mesh(const job *j, const mesh_file *m, const double *images)
{
    outfile file;
    if (!outfile_open(&file, j->args->operands[1]))
        return FAILED;
    mesh_write(m, images, file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

static int map_mesh(job *j, const mesh_file *m)
{
    size_t n = m->n_vertices, n_failed;
    double *images = need(n, 2 * sizeof *images);
    icc_status *status = need(n, sizeof *status);
    icc_status ran = (j->args->inverse ? icc_map_apply_inverse : icc_map_apply)(
        j->map, n, m->points, images, status, &n_failed, &j->env);
    icc_certificate certificate = {0};
    int result = ran == ICC_OK ? certify(j, m, images, &certificate) : job_failed_status(j, ran);
    progress_end(&j->bar);
    if (result == DONE)
        result = write_mesh(j, m, images);
    if (result == DONE) {
        tally t = count(m, images);
        result = report_tally(j, m, &t, n_failed, &certificate);
    }
    if (result == DONE)
        result = job_partial(j, n, status, "vertices");
    free(images);
    free(status);
    return result;
}

static int run_job(job *j, const args *a)
{
    int result = job_make_map(j);
    size_t n;
    char *text = result == DONE ? file_read(a->operands[0], &n) : NULL;
    if (text == NULL)
        return FAILED;
    mesh_file m;
    problem wrong;
    if (mesh_read(&m, text, n, &wrong))
        result = map_mesh(j, &m);
    else
        result = failed(a->operands[0], wrong.line, "%s", wrong.text);
    mesh_free(&m);
    free(text);
    return result;
}

int run_mesh(const args *a)
{
    job j;
    job_start(&j, a);
    int result = run_job(&j, a);
    job_end(&j);
    return result;
}
