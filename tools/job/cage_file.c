/* Writes cages as text or GeoJSON. */
#include "job/cage_file.h"

#include "base/file.h"
#include "cage/surface_write.h"
#include "job/output_name.h"

#include <string.h>

static void write_positions(FILE *stream, const cage *c, size_t n, const double *points,
                            bool closed)
{
    fputc('[', stream);
    for (size_t i = 0; i < n + closed; i++) {
        const double *p = points + 2 * (i % n);
        fprintf(stream, "%s[%.17g, %.17g]", i > 0 ? ",\n  " : "", p[0], cage_given_y(c, p));
    }
    fputc(']', stream);
}

/* Begins a feature with a role, after those before it. */
static void begin(FILE *stream, const char *role, bool first)
{
    fprintf(stream, "%s{\"type\": \"Feature\", \"properties\": {\"role\": \"%s\"",
            first ? "" : ",\n", role);
}

/* Writes the outer ring and its holes. */
static void write_polygon(FILE *stream, const cage *c, cage_role role)
{
    begin(stream, cage_role_name(role), true);
    fputs("}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": [", stream);
    write_positions(stream, c, c->n, c->points, true);
    for (size_t i = 0; i < c->n_features; i++)
        if (c->features[i].kind == ICC_FEATURE_HOLE && c->features[i].item == 0) {
            fputs(",\n ", stream);
            write_positions(stream, c, c->features[i].n, c->features[i].points, true);
        }
    fputs("]}}", stream);
}

/* Writes n rings of a region or outline. Each that is no hole begins a polygon. */
static void write_region(FILE *stream, const cage *c, size_t n, const cage_feature *rings,
                         cage_role role, bool first)
{
    bool many = false;
    for (size_t i = 1; i < n; i++)
        many = many || rings[i].kind != ICC_FEATURE_HOLE;
    begin(stream, cage_role_name(role), first);
    if (!rings->of_outline)
        fprintf(stream, ", \"feature\": %lld", (long long)rings->number);
    fprintf(stream, "}, \"geometry\": {\"type\": \"%sPolygon\", \"coordinates\": [%s",
            many ? "Multi" : "", many ? "[" : "");
    for (size_t i = 0; i < n; i++) {
        if (i > 0)
            fputs(rings[i].kind == ICC_FEATURE_HOLE ? ",\n " : "],\n [", stream);
        write_positions(stream, c, rings[i].n, rings[i].points, true);
    }
    fprintf(stream, "]%s}}", many ? "]" : "");
}

void cage_write_feature(FILE *stream, const cage *c, const cage_feature *f, cage_role role,
                        bool first)
{
    bool point = f->kind == ICC_FEATURE_POINT;
    char name[16];
    snprintf(name, sizeof name, "%s%s", cage_role_name(role), f->kind == CAGE_TIE ? "-tie" : "");
    begin(stream, name, first);
    fprintf(stream, ", \"feature\": %lld", (long long)f->number);
    if (f->radius > 0)
        fprintf(stream, ", \"radius\": %.17g", f->radius);
    fprintf(stream, "}, \"geometry\": {\"type\": \"%s\", \"coordinates\": ",
            point ? "Point" : "LineString");
    if (point)
        fprintf(stream, "[%.17g, %.17g]", f->points[0], cage_given_y(c, f->points));
    else
        write_positions(stream, c, f->n, f->points, false);
    fputs("}}", stream);
}

void cage_write(FILE *stream, const cage *c, cage_role role)
{
    bool first = true;
    if (c->n > 0) {
        write_polygon(stream, c, role);
        first = false;
    }
    for (size_t i = 0, n; i < c->n_features; i += n) {
        const cage_feature *f = &c->features[i];
        n = 1;
        if (f->kind == ICC_FEATURE_HOLE) /* has been written */
            continue;
        while (i + n < c->n_features && f[n].ring > 0 && f->kind == ICC_FEATURE_REGION)
            n++;
        if (f->kind == ICC_FEATURE_REGION)
            write_region(stream, c, n, f, role, first);
        else
            cage_write_feature(stream, c, f, role, first);
        first = false;
    }
}

static void write_collection(FILE *stream, const cage *source, const cage *target)
{
    fputs("{\"type\": \"FeatureCollection\", \"features\": [\n", stream);
    if (source != NULL)
        cage_write(stream, source, CAGE_SOURCE);
    fputs(source != NULL && target != NULL ? ",\n" : "", stream);
    if (target != NULL)
        cage_write(stream, target, CAGE_TARGET);
    fputs("\n]}\n", stream);
}

int cages_write(const char *name, const cage *source, const cage *target)
{
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    const cage *one = source != NULL ? source : target;
    if (one->dim == 3)
        surface_write(file.stream, one, output_format(name) != NULL ? output_format(name) : "OBJ");
    else if ((source != NULL && target != NULL) || output_is_json(name))
        write_collection(file.stream, source, target);
    else
        for (size_t i = 0; i < one->n; i++)
            fprintf(file.stream, "%.17g %.17g\n", one->points[2 * i],
                    cage_given_y(one, one->points + 2 * i));
    return outfile_close(&file) ? DONE : FAILED;
}
