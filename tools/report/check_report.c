/* Prints the results of `libicc check` in words and as a report. */
#include "report/check_job.h"
#include "report/reason.h"

#include "cage/cage_features.h"
#include "job/option_table.h"

#include <math.h>
#include <stdio.h>

static const char *kind_name(int32_t kind)
{
    static const char *const names[] = {"unknown",  "not_finite", "repeated", "spike",
                                        "crossing", "touch",      "flat"};
    return kind >= ICC_DEFECT_NOT_FINITE && kind <= ICC_DEFECT_FLAT ? names[kind] : names[0];
}

void check_print_defects(const check *c)
{
    for (size_t side = 0; side < 2; side++) {
        const cage *at = &c->job.cages[side];
        for (size_t i = 0; i < c->defects[side].n; i++) {
            size_t line = at->lines[c->defects[side].items[2 * i]];
            char text[200];
            printf("%s:", job_file(&c->job, (int)side + 1));
            if (line > 0)
                printf("%zu:", line);
            printf(" %s\n", defect_text(text, &c->defects[side], i, at));
        }
        if (defects_may_be_more(&c->defects[side], at))
            printf("%s: there may be more defects; the list ends here, after %zu\n",
                   job_file(&c->job, (int)side + 1), c->defects[side].n);
    }
}

static void print_mask(const cage *mask, const icc_domain_info *info)
{
    size_t n = 1, n_inside = 0;
    printf("a mask of ");
    for (size_t k = 0; k < mask->dim; k++) {
        printf("%s%zu", k > 0 ? " x " : "", mask->shape[k]);
        n *= mask->shape[k];
    }
    for (size_t i = 0; i < n; i++)
        n_inside += mask->cells[i];
    printf(
        " cells, %zu of them inside, in one piece without holes; its boundary: %zu vertices, %zu "
        "facets\n",
        n_inside, info->n_vertices, info->n_facets);
}

/* Regions without an outer ring have no common orientation. */
static void print_plane(const cage *c, const icc_domain_info *info, size_t n_added)
{
    char rings[80], inside[120];
    printf("%s%s, %sarea %.12g%s", c->n > 0 ? "a simple polygon, " : "", cage_rings_text(rings, c),
           c->n == 0               ? ""
           : info->orientation > 0 ? "counter-clockwise, "
                                   : "clockwise, ",
           info->measure, cage_inside_text(inside, c));
    if (info->n_junctions > 0)
        printf("; %zu %s, %zu %s, %zu %s", info->n_junctions,
               info->n_junctions == 1 ? "junction" : "junctions", info->n_pieces,
               info->n_pieces == 1 ? "piece" : "pieces", info->n_faces,
               info->n_faces == 1 ? "face" : "faces");
    if (n_added > 0)
        printf("; %zu %s added to sides on which others lie", n_added,
               n_added == 1 ? "vertex was" : "vertices were");
    putchar('\n');
}

/* Counts what lies inside apart from the outer surface, as the report does. */
static void print_solid(const cage *c, const icc_domain_info *info)
{
    const inside_counts own = inside_count(c, info);
    char inside[120];
    cage_inside_text(inside, c);
    if (c->n_features == 0 && own.n_vertices > 0) /* of a mesh with region numbers */
        snprintf(inside, sizeof inside, ", with %zu region%s inside", info->n_regions,
                 info->n_regions == 1 ? "" : "s");
    printf(
        "a closed surface that does not meet itself, %zu vertices, %zu faces, %s, volume %.12g%s",
        info->n_vertices - own.n_vertices, info->n_facets - own.n_facets,
        info->orientation > 0 ? "facing outward" : "facing inward", info->measure, inside);
    if (own.n_vertices > 0)
        printf(": %zu vertices, %zu faces", own.n_vertices, own.n_facets);
    putchar('\n');
}

static void print_domain(const cage *c, const icc_domain_info *info, size_t n_added)
{
    if (c->cells != NULL)
        print_mask(c, info);
    else if (info->dim == 2)
        print_plane(c, info, n_added);
    else if (info->dim == 3)
        print_solid(c, info);
    else
        printf("a closed boundary, %zu vertices, %zu facets, measure %.12g%s\n", info->n_vertices,
               info->n_facets, info->measure,
               info->dim > 3 ? " (whether it meets itself is not checked beyond 3 dimensions)"
                             : "");
}

void check_print_domains(const check *c)
{
    if (c->job.matched.dim == 2 && c->job.matched.mirrored)
        puts("mirrored: the mirror image fits better; a map cannot mirror; is y down in one of "
             "them? (--y-down=source or --y-down=target)");
    if (c->job.matched.dim == 2 && isfinite(c->job.matched.cost))
        printf("matched: turned by %.3g degrees\n", c->job.matched.turn);
    for (size_t side = 0; side < 2; side++) {
        icc_domain_info info = {.size = sizeof info};
        if (c->job.domains[side] == NULL ||
            icc_domain_get_info(c->job.domains[side], &info) != ICC_OK)
            continue;
        printf("%s: ", job_file(&c->job, (int)side + 1));
        print_domain(&c->job.cages[side], &info, c->job.n_added);
    }
    if (check_domain_only(c) && c->job.cages[0].cells == NULL && !c->job.cages[0].of_picture)
        puts("only the surface was checked: --method foliation or field certifies a chart of its "
             "inside, --target a map");
}

static void print_chart(const char *file, const chart_facts *chart)
{
    const int32_t method = chart->common.method;
    printf("%s: %s chart certified: ", file, choice_name(methods, method));
    if (method == ICC_METHOD_FIELD)
        printf("every one of %zu grid vertices has a vector that points uphill on all sides, and "
               "curves enter everywhere along the boundary",
               chart->field.n_inside);
    else
        printf("%zu %s, none of them inverted", chart->mesh.n_simplices,
               elements_name(chart->common.dim));
    if (method == ICC_METHOD_FOLIATION)
        fputs("; every leaf runs from the boundary to the maximum", stdout);
    if (method == ICC_METHOD_FOLIATION && !chart->is_shelling)
        printf(" (%zu ties)", chart->foliation.n_ties);
    putchar('\n');
}

/* Prints why not everything is certified: the map's own reason, or that of the first chart that is
 * not certified. Avoids the words "not certified", with which the reasons further down begin. */
static void print_why(const check *c)
{
    char text[REASON_LENGTH];
    size_t side = c->charts[0].common.certified ? 1 : 0;
    if (c->map.kind != 0 && !c->map.certified && c->map.reason_side == 0)
        fputs(reason_of_map(text, &c->map, &c->made), stdout);
    else if (c->map.kind != 0)
        printf("the %s's chart: %s", cage_role_name(side == 0 ? CAGE_SOURCE : CAGE_TARGET),
               reason_of_chart(text, &c->charts[side]));
    else
        fputs(reason_of_chart(text, &c->charts[0]), stdout);
}

void check_print_verdict(const check *c)
{
    if (check_domain_only(c))
        return;
    fputs("one-to-one: ", stdout);
    if (c->certified)
        fputs("yes, certified", stdout);
    else {
        fputs("not proved: ", stdout);
        if (c->n_defects > 0)
            printf("%zu defect%s", c->n_defects, c->n_defects == 1 ? "" : "s");
        else
            print_why(c);
    }
    putchar('\n');
}

void check_print_certificates(const check *c)
{
    char text[REASON_LENGTH];
    for (size_t side = 0; side < 2; side++) {
        const char *file = job_file(&c->job, (int)side + 1);
        if (c->charts[side].common.certified)
            print_chart(file, &c->charts[side]);
        else if (c->charts[side].common.method == ICC_METHOD_FIELD)
            printf("%s: field chart not certified: %s\n", file,
                   reason_of_chart(text, &c->charts[side]));
    }
    if (c->made.n_unrepaired > 0)
        printf("map: %zu %s of the mesh stay inverted, so it is a curve map\n",
               c->made.n_unrepaired, elements_name(c->map.dim));
    if (c->map.kind != 0 && !c->map.certified)
        printf("map: %s, not certified: %s\n", choice_name(maps, c->map.kind),
               reason_of_map(text, &c->map, &c->made));
    if (!c->map.certified)
        return;
    printf("map: %s, certified one-to-one", choice_name(maps, c->map.kind));
    if (c->map.kind == ICC_MAP_MESH)
        printf(": all %zu %s keep their orientation, exactly, and both boundaries are simple",
               c->map.n_simplices, elements_name(c->map.dim));
    putchar('\n');
}

const char *check_reason(char text[240], const check *c)
{
    bool pair = c->map.kind != 0;
    if (c->charts[0].common.method == ICC_METHOD_GRADIENT)
        snprintf(text, 240,
                 "%s valid, but the method gradient is not certifiable: its curves merge ('libicc "
                 "info' says how much)",
                 pair ? "the cages are" : "the cage is");
    else
        snprintf(text, 240, "%s valid, but %s not certified; see the list",
                 pair ? "the cages are" : "the cage is", pair ? "the map is" : "the chart is");
    return text;
}

/* Reports what was checked and its certificate, with the reason if there is none. A domain alone
 * has none. */
static void report_certificates(const check *c, json *j)
{
    char text[REASON_LENGTH];
    if (c->charts[0].common.method != 0)
        json_text(j, "method", choice_name(methods, c->charts[0].common.method));
    if (c->map.kind != 0)
        json_text(j, "map", choice_name(maps, c->map.kind));
    if (c->charts[0].common.method == ICC_METHOD_FIELD)
        for (size_t side = 0; side < (c->map.kind != 0 ? 2 : 1); side++) {
            json_open(j, cage_role_name(side == 0 ? CAGE_SOURCE : CAGE_TARGET), '{');
            json_count(j, "inside_vertices", c->charts[side].field.n_inside);
            json_count(j, "stray_vertices", c->charts[side].field.n_stray);
            json_count(j, "infeasible_vertices", c->charts[side].field.n_infeasible);
            json_count(j, "contacts", c->charts[side].field.n_contacts);
            json_count(j, "not_inward", c->charts[side].field.n_not_inward);
            if (!c->charts[side].common.certified)
                json_text(j, "not_certified_because", reason_of_chart(text, &c->charts[side]));
            json_close(j, '}');
        }
    if (c->made.n_samples > 0) {
        json_count(j, "samples", c->made.n_samples);
        json_count(j, "samples_lost", c->made.n_lost);
        json_count(j, "samples_flat", c->made.n_flat);
    }
    if (c->map.kind != 0 && !c->map.certified)
        json_text(j, "not_certified_because", reason_of_map(text, &c->map, &c->made));
    else if (c->charts[0].common.method != 0 && !c->charts[0].common.certified)
        json_text(j, "not_certified_because", reason_of_chart(text, &c->charts[0]));
    if (!check_domain_only(c))
        json_flag(j, "certified", c->certified);
}

static void report_repair(const check *c, json *j)
{
    if (c->job.cages[0].cells != NULL)
        json_count(j, "filled_cells", c->n_filled);
    else if (c->job.cages[0].dim == 3) {
        json_count(j, "joined_vertices", c->n_joined);
        json_count(j, "repeated_faces", c->mended.n_repeated);
        json_count(j, "small_pieces", c->mended.n_crumbs);
        json_count(j, "turned_faces", c->mended.n_turned);
        json_count(j, "filled_holes", c->mended.n_holes);
    } else
        json_count(j, "dropped_vertices", c->n_dropped);
}

int check_report(const check *c)
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
        report_repair(c, &r.json);
    json_flag(&r.json, "valid", c->job.domains[0] != NULL);
    if (check_domain_only(c))
        json_text(&r.json, "checked", c->job.cages[0].cells != NULL ? "mask" : "surface");
    report_certificates(c, &r.json);
    return report_close(&r) ? DONE : FAILED;
}
