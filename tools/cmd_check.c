/* libicc check: are the cages boundaries, and can the map between them be certified?
 *
 * Defects go to stdout, one per line; the verdict goes to stderr. --repair writes the cages without
 * the vertices that a defect names as superfluous. */
#include "commands.h"

#include "defect.h"
#include "job.h"
#include "memory.h"
#include "options.h"

#include <stdlib.h>
#include <string.h>

typedef struct check {
    job job;
    defect_list defects[2];
    size_t n_defects;
    size_t n_dropped; /* by --repair */
    icc_chart_info charts[2];
    icc_map_info map; /* of kind 0 without a target */
    bool certified;   /* all there is */
} check;

static const char *kind_name(int32_t kind)
{
    static const char *const names[] = {"unknown",  "not_finite", "repeated", "spike",
                                        "crossing", "touch",      "flat"};
    return kind >= ICC_DEFECT_NOT_FINITE && kind <= ICC_DEFECT_FLAT ? names[kind] : names[0];
}

static int find_defects(check *c)
{
    c->n_defects = 0;
    for (size_t side = 0; side < 2; side++) {
        icc_error err = {.size = sizeof err, .index = -1, .side = (int32_t)side + 1};
        defects_free(&c->defects[side]);
        if (c->job.cages[side].n == 0)
            continue;
        if (defects_find(&c->defects[side], &c->job.cages[side], 0, NULL, &c->job.env, &err) !=
            ICC_OK)
            return job_failed(&c->job, &err);
        c->n_defects += c->defects[side].n;
    }
    progress_end(&c->job.bar);
    return DONE;
}

static void print_defects(const check *c)
{
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < c->defects[side].n; i++) {
            const cage *at = &c->job.cages[side];
            size_t line = at->lines[c->defects[side].items[2 * i]];
            char text[200];
            printf("%s:", job_file(&c->job, (int)side + 1));
            if (line > 0)
                printf("%zu:", line);
            printf(" %s\n", defect_text(text, &c->defects[side], i, at));
        }
}

static void print_domains(const check *c)
{
    for (size_t side = 0; side < 2; side++) {
        icc_domain_info info = {.size = sizeof info};
        if (c->job.domains[side] == NULL ||
            icc_domain_get_info(c->job.domains[side], &info) != ICC_OK)
            continue;
        printf("%s: a simple polygon, %zu vertices, %s, area %.17g\n",
               job_file(&c->job, (int)side + 1), info.n_vertices,
               info.orientation > 0 ? "counter-clockwise" : "clockwise", info.measure);
    }
}

static void print_chart(const char *file, const icc_chart_info *chart)
{
    printf("%s: %s chart certified: %zu triangles, none of them inverted", file,
           choice_name(methods, chart->method), chart->n_mesh_triangles);
    if (chart->method == ICC_METHOD_FOLIATION)
        printf("; every leaf runs from the boundary to the maximum (%zu ties)", chart->n_ties);
    putchar('\n');
}

static void print_certificates(const check *c)
{
    for (size_t side = 0; side < 2; side++)
        if (c->charts[side].certified)
            print_chart(job_file(&c->job, (int)side + 1), &c->charts[side]);
    if (c->map.n_unrepaired > 0)
        printf("map: %zu triangles of the mesh could not be repaired, so it is of kind curves\n",
               c->map.n_unrepaired);
    if (!c->map.certified)
        return;
    printf("map: %s, certified one-to-one", choice_name(maps, c->map.kind));
    if (c->map.kind == ICC_MAP_MESH)
        printf(
            ": all %zu triangles keep their orientation, exactly, and both boundaries are simple",
            c->map.n_triangles);
    putchar('\n');
}

static void report_certificates(const check *c, json *j)
{
    if (c->charts[0].method != 0)
        json_text(j, "method", choice_name(methods, c->charts[0].method));
    if (c->map.kind != 0)
        json_text(j, "map", choice_name(maps, c->map.kind));
    json_flag(j, "certified", c->certified);
}

static int write_report(const check *c)
{
    report r;
    if (!report_open(&r, &c->job))
        return FAILED;
    json_open(&r.json, "defects", '[');
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < c->defects[side].n; i++) {
            const uint32_t *item = c->defects[side].items + 2 * i;
            json_open(&r.json, NULL, '{');
            json_text(&r.json, "cage", cage_role_name(side == 0 ? CAGE_SOURCE : CAGE_TARGET));
            json_text(&r.json, "kind", kind_name(c->defects[side].kinds[i]));
            json_count(&r.json, "a", item[0]);
            json_count(&r.json, "b", item[1]);
            if (c->job.cages[side].lines[item[0]] > 0)
                json_count(&r.json, "line", c->job.cages[side].lines[item[0]]);
            json_close(&r.json, '}');
        }
    json_close(&r.json, ']');
    if (c->job.args->repair != NULL)
        json_count(&r.json, "dropped_vertices", c->n_dropped);
    report_certificates(c, &r.json);
    return report_close(&r) ? DONE : FAILED;
}

/* ------------------------------------------------------------------ repair */

/* Marks the vertices that repeat another or end a spike. */
static size_t mark_superfluous(const check *c, unsigned char *drop)
{
    size_t n = 0;
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < c->defects[side].n; i++) {
            int32_t kind = c->defects[side].kinds[i];
            if (kind != ICC_DEFECT_REPEATED && kind != ICC_DEFECT_SPIKE)
                continue;
            uint32_t vertex =
                c->defects[side].items[2 * i + 1]; /* of two repeated ones the later */
            n += drop[vertex] == 0;
            drop[vertex] = 1;
        }
    return n;
}

static void drop_vertices(cage *c, const unsigned char *drop)
{
    size_t kept = 0;
    for (size_t i = 0; i < c->n; i++) {
        if (drop[i])
            continue;
        memmove(c->points + 2 * kept, c->points + 2 * i, 2 * sizeof *c->points);
        c->lines[kept++] = c->lines[i];
    }
    c->n = kept;
}

/* Drops vertices in both cages alike, so that they go on to correspond, until none is superfluous:
 * a spike whose tip is gone may leave a repeated vertex behind. */
static int drop_superfluous(check *c)
{
    for (;;) {
        size_t n = c->job.cages[0].n;
        unsigned char *drop = need(n, 1);
        size_t n_marked = mark_superfluous(c, drop);
        bool enough = n >= n_marked + 3;
        for (size_t side = 0; side < 2 && enough; side++)
            if (c->job.cages[side].n > 0)
                drop_vertices(&c->job.cages[side], drop);
        free(drop);
        if (!enough)
            return failed(c->job.args->source, 0,
                          "fewer than 3 vertices would be left after the repair");
        c->n_dropped += n_marked;
        if (n_marked == 0)
            return DONE;
        if (find_defects(c) != DONE)
            return FAILED;
    }
}

static void write_feature(FILE *stream, const cage *c, cage_role role)
{
    fprintf(stream,
            "{\"type\": \"Feature\", \"properties\": {\"role\": \"%s\"},\n \"geometry\": "
            "{\"type\": \"Polygon\", "
            "\"coordinates\": [[",
            cage_role_name(role));
    for (size_t i = 0; i <= c->n; i++) {
        const double *p = c->points + 2 * (i % c->n);
        fprintf(stream, "%s\n  [%.17g, %.17g]", i > 0 ? "," : "", p[0], p[1]);
    }
    fputs("]]}}", stream);
}

/* One cage as text; two, or a name that ends in .geojson or .json, as a FeatureCollection. */
static int write_cages(const check *c)
{
    const cage *cages = c->job.cages;
    const char *name = c->job.args->repair, *dot = strrchr(name, '.');
    bool geojson = cages[1].n > 0 ||
                   (dot != NULL && (strcmp(dot, ".geojson") == 0 || strcmp(dot, ".json") == 0));
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    for (size_t i = 0; !geojson && i < cages[0].n; i++)
        fprintf(file.stream, "%.17g %.17g\n", cages[0].points[2 * i], cages[0].points[2 * i + 1]);
    if (geojson) {
        fputs("{\"type\": \"FeatureCollection\", \"features\": [\n", file.stream);
        write_feature(file.stream, &cages[0], CAGE_SOURCE);
        if (cages[1].n > 0) {
            fputs(",\n", file.stream);
            write_feature(file.stream, &cages[1], CAGE_TARGET);
        }
        fputs("\n]}\n", file.stream);
    }
    return outfile_close(&file) ? DONE : FAILED;
}

static int repair(check *c)
{
    size_t n_found = c->n_defects;
    int result = drop_superfluous(c);
    if (result != DONE)
        return result;
    if (c->n_defects > 0)
        return failed(c->job.args->source, 0,
                      "%zu of %zu defects remain when %zu vertices are dropped, so nothing was "
                      "written; mend the crossings by hand",
                      c->n_defects, n_found, c->n_dropped);
    return write_cages(c);
}

/* ---------------------------------------------------------------- the whole */

static int verdict_on_defects(check *c)
{
    if (c->job.args->json && write_report(c) != DONE)
        return FAILED;
    bool first = c->defects[0].n > 0;
    return failed(job_file(&c->job, first ? 1 : 2), 0, "%zu defect%s%s; see the list", c->n_defects,
                  c->n_defects == 1 ? "" : "s",
                  first && c->defects[1].n > 0 ? " in both cages" : "");
}

/* Makes the chart, or both charts and the map; the library certifies what it can. */
static int certify(check *c)
{
    bool pair = c->job.args->target != NULL;
    int result = pair ? job_make_map(&c->job) : job_make_chart(&c->job);
    progress_end(&c->job.bar);
    if (result != DONE)
        return result;
    c->certified = true;
    for (size_t side = 0; side < (pair ? 2 : 1); side++) {
        c->charts[side].size = sizeof c->charts[side];
        icc_chart_get_info(!pair       ? c->job.chart
                           : side == 0 ? icc_map_source_chart(c->job.map)
                                       : icc_map_target_chart(c->job.map),
                           &c->charts[side]);
        c->certified = c->certified && c->charts[side].certified;
    }
    if (!pair)
        return DONE;
    c->map.size = sizeof c->map;
    icc_map_get_info(c->job.map, &c->map);
    c->certified = c->certified && c->map.certified;
    return DONE;
}

static int verdict_on_method(check *c)
{
    int result = certify(c);
    if (result != DONE)
        return result;
    if (c->job.args->json && write_report(c) != DONE)
        return FAILED;
    if (!c->job.args->json) {
        print_domains(c);
        print_certificates(c);
    }
    if (c->certified)
        return DONE;
    return failed(c->job.args->source, 0,
                  "the cages are valid, but the method gradient is not certifiable: its curves "
                  "merge ('libicc info' tells how much)");
}

static int run(check *c)
{
    int result = job_read_cages(&c->job);
    if (result == DONE)
        result = find_defects(c);
    if (result != DONE)
        return result;
    if (!c->job.args->json)
        print_defects(c);
    if (c->n_defects > 0 && c->job.args->repair == NULL)
        return verdict_on_defects(c);
    if (c->job.args->repair != NULL)
        result = repair(c);
    return result == DONE ? verdict_on_method(c) : result;
}

int run_check(const args *a)
{
    check c = {0};
    job_start(&c.job, a);
    int result = run(&c);
    for (size_t side = 0; side < 2; side++)
        defects_free(&c.defects[side]);
    job_end(&c.job);
    return result;
}
