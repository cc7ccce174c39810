/* libicc check: checks that the cages are boundaries, and that the map between them can be
 * certified. For a mask or a surface alone, it only does the first.
 *
 * Defects go to stdout, one in a line. The verdict goes to stderr. --repair writes the cages
 * without superfluous vertices, which a defect names. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "job/output_name.h"
#include "report/check_job.h"

#include <stdlib.h>

static bool in_plane(const check *c)
{
    return job_dim(&c->job) == 2 && c->job.cages[0].cells == NULL;
}

static int verdict_on_defects(check *c)
{
    if (c->job.args->json && check_report(c) != DONE)
        return FAILED;
    bool first = c->defects[0].n > 0 || c->defects[1].n == 0;
    return failed(job_file(&c->job, first ? 1 : 2), 0, "%zu defect%s%s; see the list", c->n_defects,
                  c->n_defects == 1 ? "" : "s",
                  first && c->defects[1].n > 0 ? " in both cages" : "");
}

/* Gets the certificates of the chart, or of the map and its charts. */
static void ask(check *c)
{
    bool pair = c->job.args->target != NULL;
    c->certified = true;
    for (size_t side = 0; side < (pair ? 2 : 1); side++) {
        const icc_chart *chart = !pair       ? c->job.chart
                                 : side == 0 ? icc_map_source_chart(c->job.map)
                                             : icc_map_target_chart(c->job.map);
        c->charts[side] = chart_facts_of(chart);
        c->certified = c->certified && (chart == NULL || c->charts[side].common.certified);
    }
    if (!pair)
        return;
    c->map.size = sizeof c->map;
    c->made.size = sizeof c->made;
    icc_map_get_info(c->job.map, &c->map);
    icc_map_get_report(c->job.map, &c->made);
    c->certified = c->certified && c->map.certified;
}

/* Makes the chart, or both charts and the map. The library certifies what it can. */
static int certify(check *c)
{
    bool pair = c->job.args->target != NULL;
    int result = pair ? job_make_map(&c->job) : job_make_chart(&c->job);
    progress_end(&c->job.bar);
    if (result == DONE)
        ask(c);
    return result;
}

static void print_found(const check *c)
{
    check_print_verdict(c);
    check_print_domains(c);
    check_print_certificates(c);
}

static int verdict_on_method(check *c)
{
    int result = check_domain_only(c) ? job_make_domains(&c->job) : certify(c);
    progress_end(&c->job.bar);
    if (result == DONE && c->job.args->boundary != NULL)
        result = check_write_boundary(c);
    if (result != DONE)
        return result;
    if (c->job.args->json && check_report(c) != DONE)
        return FAILED;
    if (!c->job.args->json)
        print_found(c);
    char text[240];
    if (check_domain_only(c) && c->job.args->require != 0)
        return failed(c->job.args->source, 0,
                      "valid, but there is no map or chart to certify; give --target, or for a "
                      "surface --method foliation");
    return c->certified || check_domain_only(c)
               ? DONE
               : failed(c->job.args->source, 0, "%s", check_reason(text, c));
}

/* The formats in which --repair writes. */
static const char *repaired_formats(const check *c)
{
    return c->job.cages[0].cells != NULL ? "NumPy"
           : !in_plane(c)                ? SURFACES
           : c->job.args->target != NULL ? "GeoJSON, JSON"
                                         : "text, GeoJSON, JSON";
}

/* Checks that the cages fit the options. */
static int check_options(const check *c)
{
    const args *a = c->job.args;
    bool mask = c->job.cages[0].cells != NULL;
    bool cutout = c->job.cages[0].of_picture;
    if (a->boundary != NULL && !mask && !cutout)
        return failed(a->source, 0,
                      "this is neither a mask nor a picture; --boundary needs one of them");
    if (cutout && a->boundary != NULL && !output_is_json(a->boundary) &&
        c->job.cages[0].n_features > 0)
        return failed(a->source, 0,
                      "the picture has several parts or holes, which lines of `x y` cannot hold; "
                      "name the file of --boundary .geojson");
    if (a->repair != NULL && !in_plane(c) && !check_is_alone(c))
        return failed(a->source, 0,
                      "--repair is for cages in the plane, and for surfaces and masks without a "
                      "target");
    if (a->repair != NULL && c->job.cages[0].n_features > 0)
        return failed(a->source, 0, "--repair is for cages without holes, lines or points inside");
    return output_fits(a->command, a->boundary,
                       job_dim(&c->job) == 3           ? "text, " SURFACES
                       : c->job.cages[0].cells != NULL ? "text"
                                                       : "text, GeoJSON, JSON") == DONE
               ? output_fits(a->command, a->repair, repaired_formats(c))
               : MISUSED;
}

static int run(check *c)
{
    int result = job_read_cages(&c->job);
    if (result == DONE)
        result = check_options(c);
    if (result == DONE)
        result = check_find_defects(c);
    if (result != DONE)
        return result;
    bool refused = c->n_defects > 0 && c->job.args->repair == NULL;
    if (!c->job.args->json && refused)
        check_print_verdict(c);
    if (!c->job.args->json)
        check_print_defects(c);
    if (refused)
        return verdict_on_defects(c);
    if (c->job.args->repair != NULL)
        result = in_plane(c)                     ? check_repair(c)
                 : c->job.cages[0].cells == NULL ? check_repair_surface(c)
                                                 : check_repair_mask(c);
    return result == DONE ? verdict_on_method(c) : result;
}

static void free_defects(check *c)
{
    for (size_t side = 0; side < 2; side++)
        defects_free(&c->defects[side]);
}

int run_check(const args *a)
{
    check c = {0};
    job_start(&c.job, a);
    int result = run(&c);
    free_defects(&c);
    job_end(&c.job);
    return result;
}
