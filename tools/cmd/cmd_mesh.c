/* libicc mesh: carries the vertices of a mesh along, and tells what became of its triangles or
 * tetrahedra. */
#include "cmd/commands.h"

#include "job/job.h"
#include "base/allocate.h"
#include "mesh/mesh_file.h"
#include "mesh/tally.h"

#include <stdlib.h>
#include <string.h>

/* What the library says of a mesh as a whole, which may have its images repaired; from target to source it has
 * nothing to say. */
static int certify(job *j, const mesh_file *m, double *images, icc_certificate *certificate)
{
    icc_error err = {.size = sizeof err, .index = -1};
    size_t n = m->dim == 2 ? m->n_triangles : m->n_tetrahedra;
    if (j->args->inverse || n == 0)
        return DONE;
    certificate->size = sizeof *certificate;
    icc_status ran = (j->args->repair_mesh ? icc_map_repair : icc_map_certify)(
        j->map, m->n_vertices, m->points, n, m->dim == 2 ? m->triangles : m->tetrahedra, images,
        certificate, &j->env, &err);
    progress_end(&j->bar);
    return ran == ICC_OK ? DONE : job_failed(j, &err);
}

static void print_tally(const job *j, const char *text, const icc_certificate *certificate)
{
    const char *verdict = certificate->size == 0   ? ""
                          : certificate->certified ? "; mesh and image are certified one-to-one"
                          : certificate->boundary_simple ? "; not certified"
                                                         : "; not certified, nor is the boundary "
                                                           "simple before and after";
    if (strcmp(j->args->operands[1], "-") == 0)
        note("%s%s", text, verdict);
    else
        printf("%s%s\n", text, verdict);
}

static int report_tally(const job *j, const mesh_file *m, const double *images, const tally *t,
                        size_t n_failed, const icc_certificate *certificate)
{
    char text[256];
    tally_print(t, m, text, sizeof text);
    if (!j->args->json) {
        print_tally(j, text, certificate);
        return DONE;
    }
    report r;
    if (!report_open(&r, j))
        return FAILED;
    json_count(&r.json, "points", m->n_vertices);
    json_count(&r.json, "without_image", n_failed);
    tally_report(t, m, images, &r.json);
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
    double *images = need(n, m->dim * sizeof *images);
    icc_status *status = need(n, sizeof *status);
    icc_status ran = (j->args->inverse ? icc_map_apply_inverse : icc_map_apply)(
        j->map, n, m->points, images, status, &n_failed, &j->env);
    icc_certificate certificate = {0};
    int result = ran == ICC_OK ? certify(j, m, images, &certificate) : job_failed_status(j, ran);
    progress_end(&j->bar);
    if (result == DONE)
        result = write_mesh(j, m, images);
    if (result == DONE) {
        tally t = tally_count(m, images);
        result = report_tally(j, m, images, &t, n_failed, &certificate);
    }
    if (result == DONE)
        result = job_partial(j, n, status, "vertices");
    free(images);
    free(status);
    return result;
}

static int read_and_map(job *j)
{
    const char *name = j->args->operands[0];
    size_t n;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    mesh_file m;
    problem wrong;
    int result = mesh_read(&m, job_dim(j), text, n, &wrong)
                     ? map_mesh(j, &m)
                     : failed(name, wrong.line, "%s", wrong.text);
    mesh_free(&m);
    free(text);
    return result;
}

static int check_dimension(job *j)
{
    int result = job_read_cages(j);
    if (result == DONE && job_dim(j) != 2 && job_dim(j) != 3)
        return failed(j->args->source, 0, "%zu dimensions; meshes have 2 or 3", job_dim(j));
    return result;
}

int run_mesh(const args *a)
{
    job j;
    job_start(&j, a);
    int result = check_dimension(&j);
    if (result == DONE)
        result = job_make_map(&j);
    if (result == DONE)
        result = read_and_map(&j);
    job_end(&j);
    return result;
}
