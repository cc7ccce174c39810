/* Charts, maps and messages of a job. job_cages.c has the first steps. */
#include "job/job.h"

#include "base/system.h"
#include "cage/cage_degrees.h"
#include "cage/cage_features.h"
#include "cage/cage_ties.h"
#include "job/fill.h"
#include "job/fit_cages.h"
#include "job/match_cages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The share of the remaining time that making a chart or a map takes. */
static const double MADE = 0.8;

void job_start(job *j, const args *a)
{
    size_t processors = system_processors();
    *j = (job){.own = *a, .started = seconds_now()};
    j->args = &j->own;
    j->both = a->source != NULL && a->target != NULL && strcmp(a->source, a->target) == 0;
    progress_start(&j->bar, a->quiet);
    j->env = (icc_env){.size = sizeof j->env, .user = &j->bar, .progress = progress_show};
    j->env.threads = a->threads > 0 ? a->threads : processors < 1024 ? (int32_t)processors : 1;
}

void job_end(job *j)
{
    progress_end(&j->bar);
    if (j->fit == NULL)
        icc_map_free(j->map);
    icc_fit_free(j->fit);
    icc_chart_free(j->chart);
    icc_match_free(j->match);
    for (size_t side = 0; side < 2; side++) {
        icc_domain_free(j->made[side]);
        cage_free(&j->cages[side]);
    }
}

const char *job_file(const job *j, int side)
{
    const args *a = j->args;
    return side == 2 && a->target != NULL ? a->target : a->source != NULL ? a->source : a->handles;
}

const char *job_side(side_text out, const job *j, int side)
{
    bool solid = side > 0 && j->cages[side - 1].dim == 3 && j->cages[side - 1].n_features > 0;
    const char *role = !j->both && !solid ? ""
                       : side == 1        ? "source: "
                       : side == 2        ? "target: "
                                          : "";
    snprintf(out, sizeof(side_text), "%s", role);
    return out;
}

const char *job_message(const icc_error *err)
{
    static const char *const sides[] = {"", "source: ", "target: "};
    const char *text = err->message[0] != '\0' ? err->message : icc_status_name(err->status);
    const char *side = err->side == 1 || err->side == 2 ? sides[err->side] : "";
    return strncmp(text, side, strlen(side)) == 0 ? text + strlen(side) : text;
}

/* In the plane edge i begins at vertex i. In other dimensions the index is that of a facet, unless
 * the message is about a vertex. */
static size_t line_at_fault(const cage *c, const icc_error *err)
{
    const char *text = job_message(err);
    if (err->item == ICC_ITEM_FEATURE && err->index >= 0) {
        const cage_feature *f = cage_find_feature(c, (size_t)err->index);
        return f != NULL ? f->line : 0;
    }
    if (err->item == ICC_ITEM_TIE)
        return 0;
    bool of_grid = (err->status == ICC_ERR_RESOLUTION && err->item != ICC_ITEM_FACET) ||
                   err->status == ICC_ERR_SOLVER;
    bool of_face = c->dim != 2 && c->n_facets > 0 && strncmp(text, "vertex", 6) != 0 &&
                   strncmp(text, "two surfaces share vertex", 25) != 0;
    size_t n = of_face ? c->n_facets : c->n;
    if (of_grid || err->index < 0 || (uint64_t)err->index >= n)
        return 0;
    return (of_face ? c->facet_lines : c->lines)[err->index];
}

/* The options that help if cages have opposite orientations, or "". */
static const char *unlike_turn(const job *j, const icc_error *err)
{
    return strstr(err->message, "turn the same way") == NULL ? ""
           : !j->args->flips_cages                           ? " (--match auto)"
                                   : " (--y-down=source or --y-down=target; else --match auto)";
}

int job_failed_with(job *j, const icc_error *err, const char *hint)
{
    progress_end(&j->bar);
    const cage *c = &j->cages[err->side == 2];
    char translated[512];
    side_text where;
    features_translate(translated, sizeof translated, c, job_message(err));
    const char *flipped = c->flipped && strchr(translated, '(') != NULL ? " (with y reversed)" : "";
    return failed(job_file(j, err->side), line_at_fault(c, err), "%s%s%s%s%s",
                  job_side(where, j, err->side), translated, flipped, unlike_turn(j, err), hint);
}

int job_failed(job *j, const icc_error *err)
{
    bool of_filling = err->status == ICC_ERR_RESOLUTION && err->item == ICC_ITEM_FACET;
    bool may_choose = of_filling && j->args->method == 0 && !j->args->fill;
    return job_failed_with(j, err, may_choose ? " (--method field takes a grid instead)" : "");
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
    int result = fill_domains(j);
    if (result != DONE)
        return result;
    if (cage_outlines(&j->cages[0]) > 1)
        return failed(j->args->source, 0, "the shape has %zu parts; only maps take several%s%s",
                      cage_outlines(&j->cages[0]),
                      j->args->may_pair ? ", and --target FILE is missing" : "",
                      cage_cut_text(&j->cages[0]));
    if (j->cages[0].n_features > 0)
        return failed(j->args->source, 0,
                      "a cage with holes, lines or points inside has maps, but no chart%s",
                      j->args->may_pair ? "; --target FILE is missing" : "");
    double began = seconds_now();
    icc_chart_options options = chart_options(j);
    icc_error err = {.size = sizeof err, .index = -1};
    progress_expect(&j->bar, MADE);
    if (icc_chart_create(&j->chart, j->domains[0], &options, &j->env, &err) != ICC_OK)
        return job_failed(j, &err);
    j->seconds_made = seconds_now() - began;
    return DONE;
}

static int make_own_map(job *j)
{
    icc_chart_options chart = chart_options(j);
    icc_map_options options = {.size = sizeof options, .kind = j->args->map, .chart = &chart};
    options.iterations = j->args->improve > 0 ? j->args->improve : j->args->improve == 0 ? -1 : 0;
    if (j->args->slides)
        options.slide = j->args->slide != 0 ? j->args->slide : ICC_SLIDE_INSIDE;
    if (j->args->n_target_maximum > 0)
        options.target_maximum = j->args->target_maximum;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_tie *ties = ties_list(&j->cages[0], &j->cages[1]);
    options.n_ties = j->cages[0].n_ties;
    options.ties = ties;
    icc_status status =
        icc_map_create(&j->map, j->domains[0], j->domains[1], &options, &j->env, &err);
    free(ties);
    return status == ICC_OK ? DONE : job_failed(j, &err);
}

int job_make_map(job *j)
{
    int result = fill_domains(j);
    if (result != DONE)
        return result;
    double began = seconds_now();
    progress_expect(&j->bar, MADE);
    if (j->map == NULL)
        result = j->args->reach > 0 ? fit_cages(j) : make_own_map(j);
    j->seconds_made = seconds_now() - began;
    return result;
}

int job_start_carrier(job *j, carrier *c)
{
    bool inverse = j->args->inverse;
    carrier_start(c, inverse, &j->env);
    c->flipped[0] = j->cages[inverse].flipped;
    c->flipped[1] = j->cages[!inverse].flipped;
    icc_status ran = carrier_add(c, j->map, j->domains[inverse], j->domains[!inverse]);
    carrier_set_snap(c, j->args->snap);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}

const char *job_bound(const job *j)
{
    bool is_fit = strcmp(j->args->command, "fit") == 0;
    return !is_fit ? "the cage" : j->args->outline != NULL ? "the outline" : "the frame";
}

const char *job_bound_hint(const job *j)
{
    bool has_frame = strcmp(j->args->command, "fit") == 0 && j->args->outline == NULL;
    return has_frame ? " (--box or --margin makes the frame larger)" : "";
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
    char unreached[64] = "";
    if (n_failed > n_outside + n_illegal || j->fit == NULL)
        snprintf(unreached, sizeof unreached, ", %zu that the curves do not reach",
                 n_failed - n_outside - n_illegal);
    note("%zu of %zu %s have no image: %zu outside %s%s%s%s", n_failed, n, what, n_outside,
         job_bound(j), unreached, illegal, n_outside > 0 ? job_bound_hint(j) : "");
    return PARTIAL;
}

/* The vertices of the source. The command match counts those of features, too. */
static size_t n_vertices(const job *j)
{
    return strcmp(j->args->command, "match") == 0 ? j->matched.n_vertices : j->cages[0].n;
}

inside_counts inside_count(const cage *c, const icc_domain_info *info)
{
    const size_t n_outer = c->n_facets > 0 || c->dim != 2 ? c->n_facets : c->n;
    inside_counts own = {0, 0};
    if (info->n_features > 0 && info->n_vertices >= c->n && info->n_facets >= n_outer)
        own = (inside_counts){info->n_vertices - c->n, info->n_facets - n_outer};
    return own;
}

/* Writes what the source has inside, and how that meets. The counts of the cage itself leave it
 * out. */
static void report_inside(json *out, const job *j)
{
    const cage *c = &j->cages[0];
    icc_domain_info info = {.size = sizeof info};
    const bool has_domain =
        j->domains[0] != NULL && icc_domain_get_info(j->domains[0], &info) == ICC_OK;
    if (c->n_features == 0 && info.n_features == 0)
        return;
    json_open(out, "inside", '{');
    json_count(out, "holes", cage_count(c, ICC_FEATURE_HOLE));
    /* The regions of a mesh are not those of its cage. */
    json_count(out, "regions",
               c->n_features > 0 ? cage_count(c, ICC_FEATURE_REGION) : info.n_regions);
    json_count(out, "lines", cage_count(c, ICC_FEATURE_LINE));
    json_count(out, "points", cage_count(c, ICC_FEATURE_POINT));
    if (has_domain) {
        const inside_counts own = inside_count(c, &info);
        json_count(out, "vertices", own.n_vertices);
        json_count(out, "facets", own.n_facets);
        json_count(out, "junctions", info.n_junctions);
        json_count(out, "pieces", info.n_pieces);
        json_count(out, "faces", info.n_faces);
    }
    json_close(out, '}');
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
        json_count(&r->json, "vertices", n_vertices(j));
    }
    if (cage_outlines(&j->cages[0]) > 1)
        json_count(&r->json, "polygons", cage_outlines(&j->cages[0]));
    report_inside(&r->json, j);
    if (j->matched.size > 0)
        match_report(&r->json, &j->matched);
    if (j->cages[0].n_facets > 0)
        json_count(&r->json, "facets", j->cages[0].n_facets);
    if (j->describe != NULL)
        j->describe(&r->json, j);
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
