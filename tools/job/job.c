#define _POSIX_C_SOURCE 200809L

#include "job/job.h"

#include "cage/cage_defects.h"
#include "cage/cage_read.h"
#include "cage/weld.h"
#include "job/correspond.h"
#include "job/fill.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What making a chart or a map takes of the time that is left then. */
static const double MADE = 0.8;

void job_start(job *j, const args *a)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    *j = (job){.args = a, .started = seconds_now()};
    progress_start(&j->bar, a->quiet);
    j->env = (icc_env){.size = sizeof j->env, .user = &j->bar, .progress = progress_show};
    j->env.threads = a->threads > 0                        ? a->threads
                     : processors > 0 && processors < 1024 ? (int32_t)processors
                                                           : 1;
}

void job_end(job *j)
{
    progress_end(&j->bar);
    icc_map_free(j->map);
    icc_chart_free(j->chart);
    for (size_t side = 0; side < 2; side++) {
        icc_domain_free(j->domains[side]);
        cage_free(&j->cages[side]);
    }
}

const char *job_file(const job *j, int side)
{
    const args *a = j->args;
    return side == 2 && a->target != NULL ? a->target : a->source != NULL ? a->source : a->handles;
}

/* In the plane edge i begins at vertex i. Beyond, the index is that of a facet, unless the message
 * is about a vertex. */
static size_t line_at_fault(const cage *c, const icc_error *err)
{
    bool of_grid = err->status == ICC_ERR_RESOLUTION || err->status == ICC_ERR_SOLVER;
    bool of_face = c->dim != 2 && c->n_facets > 0 && strncmp(err->message, "vertex", 6) != 0 &&
                   strncmp(err->message, "two surfaces share vertex", 25) != 0;
    size_t n = of_face ? c->n_facets : c->n;
    if (of_grid || err->index < 0 || (uint64_t)err->index >= n)
        return 0;
    return (of_face ? c->facet_lines : c->lines)[err->index];
}

static int failed_with(job *j, const icc_error *err, const char *hint)
{
    progress_end(&j->bar);
    size_t line = line_at_fault(&j->cages[err->side == 2], err);
    const char *message = err->message[0] != '\0' ? err->message : icc_status_name(err->status);
    return failed(job_file(j, err->side), line, "%s%s", message, hint);
}

int job_failed(job *j, const icc_error *err)
{
    return failed_with(j, err, "");
}

int job_failed_status(job *j, icc_status status)
{
    icc_error err = {.size = sizeof err, .status = status, .index = -1};
    return job_failed(j, &err);
}

size_t job_dim(const job *j)
{
    return j->cages[0].dim;
}

static int read_cage(job *j, size_t side)
{
    const char *name = job_file(j, (int)side + 1);
    size_t n;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    problem wrong;
    bool good = side == 0 ? cage_read(&j->cages[0], CAGE_SOURCE, 2, text, n, &wrong)
                          : cage_read(&j->cages[1], CAGE_TARGET, job_dim(j), text, n, &wrong);
    free(text);
    return good ? DONE : failed(name, wrong.line, "%s", wrong.text);
}

/* Points of options must have as many coordinates as the cage. */
static int check_points(const job *j)
{
    const args *a = j->args;
    const struct {
        const char *name;
        size_t n;
    } points[] = {{"maximum", a->n_maximum}, {"target-maximum", a->n_target_maximum}};
    for (size_t i = 0; i < 2; i++)
        if (points[i].n > 0 && points[i].n != job_dim(j))
            return misused(a->command, "--%s has %zu coordinates, but the cage %zu", points[i].name,
                           points[i].n, job_dim(j));
    return DONE;
}

int job_read_cages(job *j)
{
    if (job_dim(j) > 0)
        return DONE;
    int result = read_cage(j, 0);
    if (result == DONE)
        result = check_points(j);
    if (result == DONE && j->args->target != NULL)
        result = read_cage(j, 1);
    if (result == DONE && j->args->target != NULL)
        result = correspond(j);
    j->seconds_read = seconds_now() - j->started;
    return result;
}

int job_read_plane(job *j, const char *what)
{
    int result = job_read_cages(j);
    if (result == DONE && job_dim(j) != 2)
        result = failed(j->args->source, 0, "%zu dimension%s; %s needs cages in the plane",
                        job_dim(j), job_dim(j) == 1 ? "" : "s", what);
    return result;
}

/* A boundary that is no boundary: names the first defect by its line, and counts the others. */
static int failed_boundary(job *j, size_t side, const icc_error *err)
{
    const cage *c = &j->cages[side];
    defect_list list;
    size_t n_all;
    if (defects_find(&list, c, 1, &n_all, &j->env, NULL) != ICC_OK || list.n == 0)
        return job_failed(j, err);
    progress_end(&j->bar);
    char text[200], more[80] = "";
    if (n_all > 1)
        snprintf(more, sizeof more, " (%zu defects in all; 'libicc check' lists them)", n_all);
    failed(job_file(j, (int)side + 1), c->lines[list.items[0]], "%s%s",
           defect_text(text, &list, 0, c), more);
    defects_free(&list);
    return FAILED;
}

/* A surface that is none: perhaps only because its faces do not share their vertices. */
static int failed_surface(job *j, size_t side, const icc_error *err)
{
    char hint[120] = "";
    size_t n = weld_count(&j->cages[side]);
    if (n > 0)
        snprintf(hint, sizeof hint,
                 "; %zu vertices coincide with others: 'libicc check --repair OUT.obj' joins them",
                 n);
    return failed_with(j, err, hint);
}

static int make_domain(job *j, size_t side)
{
    const cage *c = &j->cages[side];
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status status = c->cells != NULL && c->n == 0
                            ? icc_domain_create_mask(&j->domains[side], (int32_t)c->dim, c->shape,
                                                     c->cells, &j->env, &err)
                            : icc_domain_create(&j->domains[side], (int32_t)c->dim, c->n, c->points,
                                                c->n_facets, c->facets, &j->env, &err);
    if (status == ICC_OK)
        return DONE;
    err.side = (int32_t)side + 1;
    return status == ICC_ERR_BOUNDARY && c->dim == 2 ? failed_boundary(j, side, &err)
           : c->cells == NULL && c->n_facets > 0     ? failed_surface(j, side, &err)
                                                     : job_failed(j, &err);
}

/* The domain of a mask knows what its boundary is. */
static int make_source(job *j)
{
    int result = make_domain(j, 0);
    if (result != DONE || j->cages[0].cells == NULL)
        return result;
    cage_take_boundary(&j->cages[0], j->domains[0]);
    return correspond(j);
}

/* Reports what has been left out only after success, so that an error is one line. */
static void note_heights(const job *j)
{
    for (size_t side = 0; side < 2; side++)
        if (j->cages[side].n_heights > 0)
            note("%s: heights are left out; a cage in the plane has x and y",
                 job_file(j, (int)side + 1));
}

int job_make_domains(job *j)
{
    if (j->domains[0] != NULL)
        return DONE;
    int result = job_read_cages(j);
    if (result == DONE)
        result = make_source(j);
    if (result == DONE && j->args->target != NULL)
        result = make_domain(j, 1);
    if (result == DONE)
        result = fill_domains(j);
    if (result == DONE)
        note_heights(j);
    return result;
}

static icc_chart_options chart_options(const job *j)
{
    const args *a = j->args;
    return (icc_chart_options){
        .size = sizeof(icc_chart_options),
        .method = a->method,
        .function = a->functions[j->function].function,
        .tree = a->tree,
        .cells = a->cells,
        .maximum = a->n_maximum > 0 ? a->maximum : NULL,
        .constraints = a->functions[j->function].constraints,
        .solver = a->solver,
        .min_fall = a->min_fall,
    };
}

int job_make_chart(job *j)
{
    int result = job_make_domains(j);
    if (result != DONE)
        return result;
    double began = seconds_now();
    icc_chart_options options = chart_options(j);
    icc_error err = {.size = sizeof err, .index = -1};
    progress_expect(&j->bar, MADE);
    if (icc_chart_create(&j->chart, j->domains[0], &options, &j->env, &err) != ICC_OK)
        return job_failed(j, &err);
    j->seconds_made = seconds_now() - began;
    return DONE;
}

int job_make_map(job *j)
{
    int result = job_make_domains(j);
    if (result != DONE)
        return result;
    double began = seconds_now();
    icc_chart_options chart = chart_options(j);
    icc_map_options options = {.size = sizeof options, .kind = j->args->map, .chart = &chart};
    options.iterations = j->args->improve > 0 ? j->args->improve : j->args->improve == 0 ? -1 : 0;
    if (j->args->n_target_maximum > 0)
        options.target_maximum = j->args->target_maximum;
    icc_error err = {.size = sizeof err, .index = -1};
    progress_expect(&j->bar, MADE);
    if (icc_map_create(&j->map, j->domains[0], j->domains[1], &options, &j->env, &err) != ICC_OK)
        return job_failed(j, &err);
    j->seconds_made = seconds_now() - began;
    return DONE;
}

int job_start_carrier(job *j, carrier *c)
{
    bool inverse = j->args->inverse;
    icc_status ran = carrier_start(c, j->map, j->domains[inverse], j->domains[!inverse], inverse,
                                   j->args->snap, &j->env);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}

int job_partial(job *j, size_t n, const icc_status *status, const char *what)
{
    size_t n_failed = 0, n_outside = 0, n_illegal = 0;
    for (size_t i = 0; i < n; i++) {
        n_failed += status[i] != ICC_OK;
        n_outside += status[i] == ICC_ERR_OUTSIDE;
        n_illegal += status[i] == ICC_ERR_ARGUMENT;
    }
    progress_end(&j->bar);
    if (n_failed == 0)
        return DONE;
    char illegal[64] = "";
    if (n_illegal > 0)
        snprintf(illegal, sizeof illegal, ", %zu not finite or out of range", n_illegal);
    note("%zu of %zu %s have no image: %zu outside the cage, %zu that the curves do not reach%s",
         n_failed, n, what, n_outside, n_failed - n_outside - n_illegal, illegal);
    return PARTIAL;
}

bool report_open(report *r, const job *j)
{
    if (!outfile_open(&r->file, j->args->json_file))
        return false;
    r->json = (json){.stream = r->file.stream, .first = true};
    json_open(&r->json, NULL, '{');
    json_text(&r->json, "command", j->args->command);
    json_text(&r->json, "version", icc_version());
    if (j->args->source != NULL)
        json_text(&r->json, "source", j->args->source);
    if (j->args->handles != NULL)
        json_text(&r->json, "handles", j->args->handles);
    if (j->args->target != NULL)
        json_text(&r->json, "target", j->args->target);
    if (job_dim(j) > 0) {
        json_count(&r->json, "dimension", job_dim(j));
        json_count(&r->json, "vertices", j->cages[0].n);
    }
    if (j->cages[0].n_facets > 0)
        json_count(&r->json, "facets", j->cages[0].n_facets);
    return true;
}

bool report_close(report *r)
{
    json_close(&r->json, '}');
    return outfile_close(&r->file);
}

void report_times(report *r, const job *j, double apply)
{
    json_open(&r->json, "seconds", '{');
    json_number(&r->json, "read", j->seconds_read);
    json_number(&r->json, "make", j->seconds_made);
    json_number(&r->json, "apply", apply);
    json_close(&r->json, '}');
}

int report_points(const job *j, size_t n, size_t n_failed, double seconds)
{
    report r;
    if (!j->args->json)
        return DONE;
    if (!report_open(&r, j))
        return FAILED;
    json_count(&r.json, "points", n);
    json_count(&r.json, "without_image", n_failed);
    report_times(&r, j, seconds);
    return report_close(&r) ? DONE : FAILED;
}
