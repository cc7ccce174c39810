/* libicc map --geojson: maps the geometries of a GeoJSON file (RFC 7946). */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/system.h"
#include "geo/geo_carry.h"
#include "job/job.h"
#include "job/output_name.h"
#include "job/require.h"
#include "job/ties_file.h"
#include "job/triangulation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NAMED = 10, NAME_ROOM = 128 };

static geo_policy policy_of(const args *a)
{
    return a->outside == OUTSIDE_KEEP   ? GEO_KEEP
           : a->outside == OUTSIDE_CLIP ? GEO_CLIP
           : a->outside == OUTSIDE_FAIL ? GEO_FAIL
                                        : GEO_NULL;
}

/* Ids that users chose are cut short, between UTF-8 characters. */
static void name_fault(char out[NAME_ROOM], const geo_fault *fault, const char *text)
{
    size_t n = fault->id.end - fault->id.begin;
    const char *id = text + fault->id.begin, *dots = n > 48 ? ".." : "";
    n = n > 48 ? 48 : n;
    while (n > 0 && ((unsigned char)id[n] & 0xc0) == 0x80)
        n--;
    if (!fault->feature)
        snprintf(out, NAME_ROOM, "the geometry in line %zu", fault->line);
    else if (n == 0)
        snprintf(out, NAME_ROOM, "feature %u (line %zu)", (unsigned)fault->number, fault->line);
    else
        snprintf(out, NAME_ROOM, "feature %u (id %.*s%s)", (unsigned)fault->number, (int)n, id,
                 dots);
}

/* Lists the first geometries that are not carried in one line. */
static void name_faults(const geo_result *r, const char *text, char *out, size_t room)
{
    size_t used = 0;
    for (size_t i = 0; i < r->n_faults && i < MAX_NAMED; i++) {
        char name[NAME_ROOM];
        name_fault(name, &r->faults[i], text);
        used += (size_t)snprintf(out + used, room - used, "%s%s: %s", i > 0 ? ", " : "", name,
                                 r->faults[i].fate);
    }
    if (r->n_faults > MAX_NAMED)
        snprintf(out + used, room - used, " and %zu more, which --json=FILE lists",
                 r->n_faults - MAX_NAMED);
}

static void report_fault(json *j, const geo_fault *fault, const char *text)
{
    json_open(j, NULL, '{');
    if (fault->feature)
        json_count(j, "feature", fault->number);
    if (geo_has(fault->id))
        json_raw(j, "id", text + fault->id.begin, fault->id.end - fault->id.begin);
    json_count(j, "line", fault->line);
    json_count(j, "without_image", fault->n_without);
    json_text(j, "result", fault->fate);
    json_close(j, '}');
}

static int report_all(const job *j, const geo_result *r, const char *text, double seconds)
{
    report out;
    if (!j->args->json)
        return DONE;
    if (!report_open(&out, j))
        return FAILED;
    json_count(&out.json, "points", r->n_positions);
    json_count(&out.json, "without_image", r->n_without);
    json_count(&out.json, "features", r->n_features);
    json_open(&out.json, "not_carried", '[');
    for (size_t i = 0; i < r->n_faults; i++)
        report_fault(&out.json, &r->faults[i], text);
    json_close(&out.json, ']');
    json_flag(&out.json, "exact_lines", r->exact);
    json_count(&out.json, "shared_sides", r->n_shared);
    json_count(&out.json, "vertices_put_in", r->n_put_in);
    report_times(&out, j, seconds);
    return report_close(&out) ? DONE : FAILED;
}

/* Writes the result, unless it is refused or would destroy the only copy of geometries that are not
 * carried. The report comes first, so that a failure leaves the file as it was. */
static int finish(const job *j, geo_result *r, const char *text, size_t n, double seconds)
{
    const char *in = j->args->operands[0], *to = j->args->operands[1];
    char names[MAX_NAMED * (NAME_ROOM + 16) + 64] = "";
    bool lost = r->n_faults > 0, over = file_is_same(in, to);
    name_faults(r, text, names, sizeof names);
    int result = report_all(j, r, text, seconds);
    if (result == DONE && lost && j->args->outside == OUTSIDE_FAIL)
        return failed(in, 0, "not all of it lies in %s, so nothing is written: %s", job_bound(j),
                      names);
    if (result == DONE && lost && over)
        return failed(
            in, 0,
            "would be overwritten, and not all of it can be carried: %s; write to another file",
            names);
    if (result == DONE)
        result = triangulation_write(j);
    if (result == DONE)
        result = ties_write(j);
    outfile file;
    if (result != DONE || !outfile_open(&file, to))
        return FAILED;
    edits_write(&r->edits, text, n, file.stream);
    if (!outfile_close(&file))
        return FAILED;
    if (over)
        note("%s: the layer is replaced by its image", to);
    if (r->n_jumps > 0)
        note("%s: the longitudes of %zu lines or rings jump by more than 180 degrees; they are "
             "taken the long way round, not over the antimeridian",
             in, r->n_jumps);
    result = triangulation_tell(j);
    if (!lost)
        return result;
    note("%zu of %zu features are not carried as they were, %zu of %zu positions have no image: "
         "%s%s",
         r->n_faults, r->n_features, r->n_without, r->n_positions, names, job_bound_hint(j));
    return PARTIAL;
}

static double size_of(const job *j)
{
    icc_domain_info info = {.size = sizeof info};
    icc_domain_get_info(j->domains[!j->args->inverse], &info);
    return fmax(info.upper[0] - info.lower[0], info.upper[1] - info.lower[1]);
}

/* By default lines are accurate to 0.001 of the result's size. */
static double choose_tolerance(const job *j)
{
    double size = size_of(j);
    return j->args->tolerance > 0 ? j->args->tolerance : size / 1000;
}

/* Refuses --exact if the map has no triangles. */
static int check_exact(const job *j)
{
    icc_map_info info = {.size = sizeof info};
    icc_map_get_info(j->map, &info);
    if (j->args->exact_lines && info.kind != ICC_MAP_MESH)
        return failed(j->args->source, 0,
                      "--exact needs the triangles of a mesh map, but this is a curve map; "
                      "--tolerance makes its lines as accurate as you need");
    return DONE;
}

/* Reads the text, carries it with the job's map, and writes the result. */
static int carry_file(job *j)
{
    const char *name = j->args->operands[0];
    size_t n;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    carrier c;
    geo_result r = {0};
    problem wrong;
    double began = seconds_now();
    geo_options options = {.policy = policy_of(j->args),
                           .tolerance = choose_tolerance(j),
                           .exact = j->args->exact_lines,
                           .drop = j->args->tolerance};
    int result = job_start_carrier(j, &c);
    if (result == DONE && !geo_carry(&r, &c, &options, text, n, &wrong)) {
        progress_end(&j->bar);
        result = failed(name, wrong.line, "%s", wrong.text);
    }
    progress_end(&j->bar);
    if (result == DONE && r.sequence)
        result = output_fits(j->args->command, j->args->operands[1], "GeoJSONSeq");
    if (result == DONE)
        result = finish(j, &r, text, n, seconds_now() - began);
    geo_result_free(&r);
    carrier_free(&c);
    free(text);
    return result;
}

int geojson_apply(job *j)
{
    int result = job_read_plane(j, "--geojson");
    if (result == DONE)
        result = ties_check(j);
    if (result == DONE)
        result = job_make_map(j);
    if (result == DONE)
        result = require_maps(j);
    if (result == DONE)
        result = check_exact(j);
    return result == DONE ? carry_file(j) : result;
}
