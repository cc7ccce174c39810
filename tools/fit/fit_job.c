/* A fit of control points. The library makes the map. Everything after it is done as for a map
 * between cages, so the boundary of the map's mesh becomes the cages. */
#include "fit/fit_job.h"

#include "base/allocate.h"
#include "base/system.h"
#include "cage/cage_features.h"
#include "cage/cage_readers.h"
#include "control/affine_fit.h"
#include "control/control_read.h"
#include "fit/fit_report.h"
#include "job/fit_cages.h"
#include "mesh/mesh_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The share of the remaining time that making a fit takes. */
static const double MADE = 0.8;

int fit_take_cages(job *j)
{
    icc_map_info info = {.size = sizeof info};
    icc_map_get_info(j->map, &info);
    mesh_file m[2] = {{.dim = 2, .form = MESH_LITTLE, .n_vertices = info.n_vertices}};
    m[0].n_triangles = info.n_simplices;
    m[0].points = need(info.n_vertices, 2 * sizeof *m->points);
    m[0].triangles = need(info.n_simplices, 3 * sizeof *m->triangles);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = info.n_vertices,
                     .vertices = m[0].points,
                     .n_cells = info.n_simplices,
                     .cells = m[0].triangles};
    m[1] = m[0];
    m[1].points = need(info.n_vertices, 2 * sizeof *m->points);
    icc_map_get_mesh(j->map, &mesh, m[1].points);
    problem wrong;
    int result = DONE;
    for (size_t side = 0; side < 2 && result == DONE; side++) {
        bool flipped = j->cages[side].flipped;
        const cage *like = side == 1 ? &j->cages[0] : NULL;
        if (!cage_take_mesh(&j->cages[side], &m[side], like, &wrong))
            result = failed(j->args->source, 0, "the map's boundary: %s", wrong.text);
        j->cages[side].flipped = flipped;
    }
    free(m[0].points);
    free(m[0].triangles);
    free(m[1].points);
    return result;
}

/* Pins of a figure are never turned over: limbs that cross or bend may look mirrored. */
static int read_points(fit_job *f, const char *name, bool are_pins)
{
    int result = control_read(&f->points, name);
    if (result == DONE && f->points.n == 0)
        result = failed(name, 0, "there are no control points%s",
                        f->points.n_disabled > 0 ? ": all of them are disabled" : "");
    if (result != DONE)
        return result;
    if (f->points.has_turns || f->points.n_bones > 0)
        return failed(name, 0,
                      "'libicc pose --pins' takes turns and bones of pins; here remove them");
    f->turned = !are_pins && affine_mirrors(&f->points);
    f->affine = need(f->points.n, 2 * sizeof *f->affine);
    f->residuals = need(f->points.n, 2 * sizeof *f->residuals);
    f->left_out = need(f->points.n, 2 * sizeof *f->left_out);
    affine_residuals(&f->points, f->affine);
    return DONE;
}

/* Reads the outline of a figure, which may have holes. */
static int read_outline(fit_job *f, const args *a)
{
    args own = *a;
    own.source = a->outline;
    own.json = false;
    own.y_down_side = f->turned ? SIDE_SOURCE : 0;
    job_start(&f->outline, &own);
    int result = job_read_plane(&f->outline, "--outline");
    const cage *c = &f->outline.cages[0];
    if (result == DONE && (c->n == 0 || c->n_features > cage_count(c, ICC_FEATURE_HOLE)))
        result = failed(a->outline, 0,
                        "--outline is an outline with holes; it has regions, lines or points "
                        "inside");
    return result == DONE ? job_make_domains(&f->outline) : result;
}

/* Points without tolerances that are to be smoothed all have the same. */
static double *tolerances(const fit_job *f)
{
    const args *a = f->job.args;
    double *out = need(f->points.n, sizeof *out);
    for (size_t i = 0; i < f->points.n; i++)
        out[i] = f->points.has_tolerances ? f->points.tolerances[i] : a->smooths ? 1 : 0;
    return out;
}

/* The line of the point at fault, or 0. */
static size_t line_at_fault(const fit_job *f, const icc_error *err)
{
    bool has_point =
        err->item == ICC_ITEM_POINT && err->index >= 0 && (uint64_t)err->index < f->points.n;
    return has_point ? f->points.lines[err->index] : 0;
}

static icc_status create(fit_job *f, const double *from, icc_error *err)
{
    job *j = &f->job;
    const args *a = j->args;
    bool has_outline = a->outline != NULL;
    double *own = tolerances(f), box[4];
    memcpy(box, a->box, sizeof box);
    if (f->turned) {
        box[1] = -a->box[3];
        box[3] = -a->box[1];
    }
    const icc_constraint points = {.size = sizeof points,
                                   .kind = ICC_CONSTRAINT_POINTS,
                                   .n = f->points.n,
                                   .source = from,
                                   .target = f->points.to,
                                   .tolerance = has_outline ? NULL : own};
    const icc_fit_options options = {.size = sizeof options,
                                     .model = has_outline ? ICC_FIT_ELASTIC : ICC_FIT_SPLINE,
                                     .box = a->n_box > 0 ? box : NULL,
                                     .margin = a->margin,
                                     .smoothing = a->exact ? -1 : a->smoothing,
                                     .reach = a->reach,
                                     .stiffness = a->stiffness};
    icc_status status = icc_fit_create(&j->fit, has_outline ? f->outline.domains[0] : NULL, NULL, 1,
                                       &points, &options, &j->env, err);
    free(own);
    return status;
}

/* Frees the fit and what was made from it. */
static void unmake(job *j)
{
    icc_fit_free(j->fit);
    j->fit = NULL;
    j->map = NULL;
    for (size_t side = 0; side < 2; side++) {
        icc_domain_free(j->made[side]);
        cage_free(&j->cages[side]);
        j->domains[side] = j->made[side] = NULL;
    }
    j->has_domains = false;
}

int fit_job_make(fit_job *f)
{
    job *j = &f->job;
    unmake(j);
    icc_error err = {.size = sizeof err, .index = -1};
    double began = seconds_now();
    double *from = need(f->points.n, 2 * sizeof *from);
    memcpy(from, f->points.from, f->points.n * 2 * sizeof *from);
    if (f->turned)
        points_flip_y(f->points.n, from);
    progress_expect(&j->bar, MADE);
    icc_status status = create(f, from, &err);
    free(from);
    if (status != ICC_OK)
        return fit_failed(j, j->args->source, line_at_fault(f, &err), &err);
    j->map = (icc_map *)(uintptr_t)icc_fit_map(j->fit);
    f->info.size = sizeof f->info;
    icc_fit_get_info(j->fit, &f->info);
    icc_fit_get_residuals(j->fit, f->residuals, f->left_out);
    j->cages[0].flipped = f->turned;
    j->seconds_made = seconds_now() - began;
    return fit_take_cages(j);
}

/* The job takes the points for its source and target, and has the operands after them. */
static void start_job(fit_job *f, const args *a)
{
    args own = *a;
    own.source = own.target = a->operands[0];
    own.operands++;
    own.n_operands--;
    if (own.target_crs == NULL && own.triangulation != NULL)
        own.target_crs = f->points.crs;
    job_start(&f->job, &own);
    f->job.describe = fit_describe;
}

int fit_job_start(fit_job *f, const args *a)
{
    *f = (fit_job){.turned = false};
    int result = read_points(f, a->operands[0], a->outline != NULL);
    start_job(f, a);
    if (result == DONE && a->outline != NULL)
        result = read_outline(f, a);
    f->job.seconds_read = seconds_now() - f->job.started;
    return result;
}

void fit_job_end(fit_job *f)
{
    job_end(&f->job);
    if (f->job.args->outline != NULL && f->outline.args != NULL)
        job_end(&f->outline);
    control_free(&f->points);
    free(f->affine);
    free(f->residuals);
    free(f->left_out);
}

/* True if targets in degrees lie on both sides of the antimeridian, and none near longitude 0. */
static bool crosses_antimeridian(const control_points *c)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    bool empty_middle = true;
    for (size_t i = 0; i < c->n; i++) {
        double x = c->to[2 * i];
        least = fmin(least, x);
        most = fmax(most, x);
        empty_middle =
            empty_middle && fabs(x) > 90 && fabs(x) <= 180 && fabs(c->to[2 * i + 1]) <= 90;
    }
    return empty_middle && most - least > 180;
}

int fit_job_tell(fit_job *f)
{
    const job *j = &f->job;
    progress_end(&f->job.bar);
    if (f->turned && f->points.n > 2)
        note("%s: y points down in the source only, so it is turned over%s", j->args->source,
             f->points.rows_down ? "" : "; files of the source keep their own y");
    if (crosses_antimeridian(&f->points))
        note("%s: longitudes go from near -180 to near 180; to cross the antimeridian, add 360 to "
             "those below 0",
             j->args->source);
    if (f->info.n_off == 0)
        return DONE;
    note(
        "%s: %zu of %zu points are not at their places, up to %g off, because the shape would fold "
        "or overlap on the way; --residuals lists them",
        j->args->source, f->info.n_off, f->points.n, f->info.most_off);
    return PARTIAL;
}
