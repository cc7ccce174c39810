/* libicc mesh: maps the vertices of a mesh, and reports the signs of its elements. It can also fill
 * a surface with tetrahedra (cmd_fill.c). The exit code tells if an element is inverted or a vertex
 * lies outside the cage. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "fit/mesh_fit.h"
#include "job/attached.h"
#include "job/job.h"
#include "job/output_name.h"
#include "job/triangulation.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_flat.h"
#include "mesh/tally.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Gets the library's certificate of a mesh as a whole, whose images may be repaired first. There is
 * none from target to source, nor for a mesh with elements of other kinds. */
static int certify(job *j, const mesh_file *m, double *images, icc_certificate *certificate)
{
    icc_error err = {.size = sizeof err, .index = -1};
    size_t n = m->dim == 2 ? m->n_triangles : m->n_tetrahedra;
    bool whole = tally_is_simplicial(m);
    if (j->args->inverse || n == 0 || !(whole || j->args->repair_mesh))
        return DONE;
    bool has_images = j->args->moves != NULL || j->args->nearest != NULL;
    certificate->size = sizeof *certificate;
    const icc_mesh mesh = {.size = sizeof mesh,
                           .dim = (int32_t)m->dim,
                           .n_vertices = m->n_vertices,
                           .vertices = m->points,
                           .n_cells = n,
                           .cells = m->dim == 2 ? m->triangles : m->tetrahedra};
    icc_status ran = (j->args->repair_mesh ? icc_map_repair : icc_map_certify)(
        j->map, &mesh, has_images ? NULL : images, certificate, &j->env, &err);
    /* The nearest map has a finer mesh, in which these elements may still be inverted. */
    if (ran == ICC_OK && j->args->nearest != NULL && !certificate->certified)
        ran = icc_map_repair(j->map, &mesh, images, certificate, &j->env, &err);
    progress_end(&j->bar);
    certificate->size = whole ? certificate->size : 0;
    return ran == ICC_OK ? DONE : job_failed(j, &err);
}

/* Rounds images to the precision of the format, because the report is about these. If that changes
 * them, the library's certificate does not apply. */
static int round_images(const job *j, const mesh_file *m, double *images,
                        icc_certificate *certificate)
{
    size_t vertex;
    if (m->floats)
        certificate->size = 0;
    return mesh_round(m, images, &vertex)
               ? DONE
               : failed(j->args->operands[0], 0, "the image of vertex %zu is too large for %s",
                        vertex, m->format);
}

static const char *verdict(const mesh_file *m, const icc_certificate *certificate)
{
    return certificate->size > 0 && certificate->certified
               ? "; mesh and image are certified one-to-one"
           : certificate->size > 0 ? "; not certified"
           : m->dim == 3 && (m->n_tetrahedra == 0 || !tally_is_simplicial(m))
               ? "; only tetrahedra can be certified"
           : !tally_is_simplicial(m) ? "; only triangles and polygons can be certified"
                                     : "";
}

/* Prints a line for each kind of element. The first also has the verdict. */
static void print_tally(const job *j, const mesh_file *m, const tally *t,
                        const icc_certificate *certificate)
{
    char text[512], repaired[128] = "";
    if (t->n_tangled > 0)
        snprintf(repaired, sizeof repaired, "; %zu %s inverted before untangling, %zu repaired",
                 t->n_tangled, t->n_tangled == 1 ? "was" : "were", t->n_repaired);
    for (size_t i = 0; tally_line(t, m, i, text, sizeof text); i++) {
        const char *mended = i == 0 ? repaired : "";
        const char *more = i == 0 ? verdict(m, certificate) : "";
        const char *why = i == 0 && !certificate->boundary_simple ? certificate->message : "";
        const char *colon = why[0] != 0 ? ": " : "";
        if (strcmp(j->args->operands[1], "-") == 0)
            note("%s%s%s%s%s", text, mended, more, colon, why);
        else
            printf("%s%s%s%s%s\n", text, mended, more, colon, why);
    }
}

static void print_rotated(const job *j, const mesh_rotated *r)
{
    char text[128];
    if (!j->args->rotates_vectors)
        return;
    snprintf(text, sizeof text, "%zu vectors in %zu arrays: %zu rotated, %zu not rotated",
             r->n_vectors, r->n_arrays, r->n_vectors - r->n_stay, r->n_stay);
    if (strcmp(j->args->operands[1], "-") == 0)
        note("%s", text);
    else
        printf("%s\n", text);
}

/* Reports one object with --json, otherwise lines of text. */
static int report_tally(const job *j, const mesh_file *m, const tally *t, size_t n_failed,
                        const icc_certificate *certificate, const mesh_rotated *rotated)
{
    if (!j->args->json) {
        print_tally(j, m, t, certificate);
        print_rotated(j, rotated);
        return DONE;
    }
    report r;
    if (!report_open(&r, j))
        return FAILED;
    json_count(&r.json, "points", m->n_vertices);
    json_count(&r.json, "without_image", n_failed);
    if (m->dim == 3)
        json_count(&r.json, "faces", m->n_faces);
    tally_report(t, m, &r.json);
    if (j->args->rotates_vectors) {
        json_count(&r.json, "vectors", rotated->n_vectors);
        json_count(&r.json, "vectors_not_rotated", rotated->n_stay);
    }
    if (certificate->size > 0) {
        json_flag(&r.json, "boundary_simple", certificate->boundary_simple != 0);
        json_flag(&r.json, "certified", certificate->certified != 0);
        if (!certificate->certified)
            json_text(&r.json, "why_not", certificate->message);
    }
    return report_close(&r) ? DONE : FAILED;
}

/* Vertices without an image stay where they are. */
static int write_mesh(const job *j, const mesh_file *m, const double *images,
                      const icc_status *status)
{
    outfile file;
    if (!outfile_open(&file, j->args->operands[1]))
        return FAILED;
    const bool inverse = j->args->inverse;
    double *places = need(m->n_vertices, m->dim * sizeof *places);
    for (size_t i = 0; i < m->n_vertices; i++) {
        memcpy(places + m->dim * i, (status[i] == ICC_OK ? images : m->points) + m->dim * i,
               m->dim * sizeof *places);
        if (j->cages[status[i] == ICC_OK ? !inverse : inverse].flipped)
            points_flip_y(1, places + m->dim * i);
    }
    mesh_write(m, places, file.name, file.stream);
    free(places);
    return outfile_close(&file) ? DONE : FAILED;
}

/* Prints how many vertices have no image, which one is the first, and what has been done about
 * it. */
static int tell_outside(job *j, const mesh_file *m, const icc_status *status, size_t n_failed)
{
    size_t first = 0;
    while (first < m->n_vertices && status[first] == ICC_OK)
        first++;
    progress_end(&j->bar);
    if (n_failed == 0)
        return DONE;
    note(j->args->outside == OUTSIDE_KEEP
             ? "%s: %zu of %zu vertices have no image and stay where they are; the first is vertex "
               "%zu (from 0), %s"
             : "%s: %zu of %zu vertices have no image, so nothing was written; the first is vertex "
               "%zu (from 0), %s; --outside keep leaves them where they are",
         j->args->operands[0], n_failed, m->n_vertices, first,
         status[first] == ICC_ERR_OUTSIDE ? "outside the cage" : "where no curve reaches it");
    return PARTIAL;
}

/* Why elements with a corner inside are inverted. */
static const char *why_inner(const job *j, const icc_certificate *certificate)
{
    return j->args->inverse        ? "the mesh is too coarse for the map there"
           : !j->args->repair_mesh ? "the mesh is too coarse for the map there; "
                                     "--untangle moves inner vertices"
           : certificate->size > 0 && !certificate->boundary_simple
               ? certificate->message
               : "no places were found for the inner vertices";
}

/* Prints the faults of a mesh that was written. */
static int tell(job *j, const mesh_file *m, const icc_status *status, size_t n_failed,
                const tally *t, const icc_certificate *certificate, const mesh_carried *attached)
{
    tally_tell(t, m, j->args->operands[0], why_inner(j, certificate));
    attached_tell(j->args->operands[0], attached);
    int result = tell_outside(j, m, status, n_failed);
    if (result == DONE)
        result = attached_beyond(j, attached);
    return result == DONE && tally_spoilt(t) > 0 ? PARTIAL : result;
}

/* Prints why --require forbids writing a mesh. */
static int refuse(const job *j, const mesh_file *m, const tally *t,
                  const icc_certificate *certificate)
{
    tally_tell(t, m, j->args->operands[0], why_inner(j, certificate));
    return failed(j->args->operands[0], 0,
                  "the mesh and its image are not certified%s, so nothing was written",
                  j->args->inverse         ? " from target to source"
                  : m->floats              ? " where images are rounded to floats"
                  : certificate->size == 0 ? verdict(m, certificate)
                                           : "");
}

/* Writes the mesh, unless --require forbids it, and reports. A vertex outside the cage stops the
 * output unless --outside keep asks for it, but the report always names it. */
static int finish(job *j, const mesh_file *m, const double *images, const icc_status *status,
                  size_t n_failed, const tally *t, const icc_certificate *certificate,
                  const mesh_carried *attached)
{
    bool writes = n_failed + attached->n_beyond == 0 || j->args->outside == OUTSIDE_KEEP;
    bool refused = j->args->require != 0 && (certificate->size == 0 || !certificate->certified);
    int result = writes && !refused ? write_mesh(j, m, images, status) : DONE;
    if (result == DONE && writes && !refused)
        result = triangulation_write(j);
    if (result == DONE && (writes || j->args->json))
        result = report_tally(j, m, t, n_failed, certificate, &attached->rotated);
    return result != DONE ? result
           : !writes
               ? n_failed > 0 ? tell_outside(j, m, status, n_failed) : attached_beyond(j, attached)
           : refused ? refuse(j, m, t, certificate)
                     : tell(j, m, status, n_failed, t, certificate, attached);
}

/* Counts elements, then finishes. A certificate is about triangles, so an inverted larger face
 * cancels it. */
static int count_and_finish(job *j, const mesh_file *m, const double *images,
                            const icc_status *status, size_t n_failed, icc_certificate *certificate,
                            const mesh_carried *attached, const tally *plain)
{
    tally t;
    tally_make(&t, m, images);
    if (j->args->repair_mesh && plain->fates != NULL)
        tally_compare(&t, plain, m);
    certificate->certified = certificate->certified && tally_spoilt(&t) == 0;
    int result = finish(j, m, images, status, n_failed, &t, certificate, attached);
    tally_free(&t);
    return result;
}

/* Certifies the simplices, and carries normals and similar data before anything is written. */
static int carry_mesh(job *j, mesh_file *m, double *images, const icc_status *status,
                      size_t n_failed)
{
    icc_certificate certificate = {0};
    tally plain = {0};
    if (j->args->repair_mesh)
        tally_make(&plain, m, images);
    int result = certify(j, m, images, &certificate);
    if (result == DONE)
        result = round_images(j, m, images, &certificate);
    progress_end(&j->bar);
    mesh_carried attached = {0};
    if (result == DONE && (n_failed == 0 || j->args->outside == OUTSIDE_KEEP))
        result = attached_carry(j, m, images, status, &attached);
    if (result == DONE)
        result = count_and_finish(j, m, images, status, n_failed, &certificate, &attached, &plain);
    tally_free(&plain);
    return result;
}

static int map_mesh(job *j, mesh_file *m)
{
    size_t n = m->n_vertices, n_failed = 0;
    double *images = need(n, m->dim * sizeof *images);
    icc_status *status = need(n, sizeof *status);
    icc_status ran = (j->args->inverse ? icc_map_apply_inverse : icc_map_apply)(
        j->map, n, m->points, images, status, &n_failed, &j->env);
    int result =
        ran == ICC_OK ? carry_mesh(j, m, images, status, n_failed) : job_failed_status(j, ran);
    free(images);
    free(status);
    return result;
}

/* Moves a mesh without a cage: --fit and --nearest. */
static int move_mesh(job *j, mesh_file *m)
{
    int result = output_fits(j->args->command, j->args->operands[1], m->format);
    if (result != DONE)
        return result;
    double *images = need(m->n_vertices, 2 * sizeof *images);
    icc_status *status = need(m->n_vertices, sizeof *status); /* all are ICC_OK */
    int made = (j->args->moves != NULL ? mesh_fit : mesh_nearest)(j, m, images);
    if (made == PARTIAL && j->args->require != 0)
        result = FAILED;
    else if (made == DONE || made == PARTIAL)
        result = carry_mesh(j, m, images, status, 0);
    free(images);
    free(status);
    return made == DONE || result != DONE ? result : made;
}

/* The output has the format of the input, and its name must agree. */
static int make_and_map(job *j, mesh_file *m)
{
    int result = output_fits(j->args->command, j->args->operands[1], m->format);
    if (j->cages[j->args->inverse].flipped)
        points_flip_y(m->n_vertices, m->points);
    if (result == DONE)
        result = job_make_map(j);
    return result == DONE ? map_mesh(j, m) : result;
}

/* The mesh is read before the map is made, so that a mistake is reported at once. */
static int read_and_map(job *j)
{
    const char *name = j->args->operands[0];
    size_t n;
    char *text = file_read_shape(name, &n);
    if (text == NULL)
        return FAILED;
    mesh_file m;
    problem wrong;
    size_t n_heights;
    bool moves = j->args->moves != NULL || j->args->nearest != NULL;
    bool good = moves ? mesh_read_in_own_space(&m, text, n, &n_heights, &wrong)
                      : mesh_read(&m, job_dim(j), text, n, &wrong);
    int result = !good   ? failed(name, wrong.line, "%s", wrong.text)
                 : moves ? move_mesh(j, &m)
                         : make_and_map(j, &m);
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
    if (a->fill)
        return run_fill(a);
    job j;
    job_start(&j, a);
    int result = a->moves != NULL || a->nearest != NULL ? DONE : check_dimension(&j);
    if (result == DONE && a->source != NULL)
        result = triangulation_check(&j);
    if (result == DONE)
        result = read_and_map(&j);
    job_end(&j);
    return result;
}
