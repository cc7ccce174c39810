/* Writes cages as text or GeoJSON. */
#include "job/cage_file.h"

#include "base/file.h"
#include "cage/surface_write.h"
#include "job/output_name.h"

#include <string.h>

void positions_write(FILE *stream, const cage *c, size_t n, const double *points, bool closed)
{
    fputc('[', stream);
    for (size_t i = 0; i < n + closed; i++) {
        const double *p = points + 2 * (i % n);
        fprintf(stream, "%s[%.17g, %.17g]", i > 0 ? ",\n  " : "", p[0], cage_given_y(c, p));
    }
    fputc(']', stream);
}

void cage_write_polygon(FILE *stream, const cage *c, cage_role role)
{
    fprintf(stream,
            "{\"type\": \"Feature\", \"properties\": {\"role\": \"%s\"}, \"geometry\": "
            "{\"type\": \"Polygon\", \"coordinates\": [",
            cage_role_name(role));
    positions_write(stream, c, c->n, c->points, true);
    for (size_t i = 0; i < c->n_features; i++)
        if (c->features[i].kind == ICC_FEATURE_HOLE) {
            fputs(",\n ", stream);
            positions_write(stream, c, c->features[i].n, c->features[i].points, true);
        }
    fputs("]}}", stream);
}

/* Writes the lines and points inside, with the numbers that pair them. */
static void write_inside(FILE *stream, const cage *c, cage_role role)
{
    for (size_t i = 0; i < c->n_features; i++) {
        const cage_feature *f = &c->features[i];
        bool line = f->kind == ICC_FEATURE_LINE;
        if (!line && f->kind != ICC_FEATURE_POINT)
            continue;
        fprintf(stream,
                ",\n{\"type\": \"Feature\", \"properties\": {\"role\": \"%s\", \"feature\": %lld",
                cage_role_name(role), (long long)f->number);
        if (f->radius > 0)
            fprintf(stream, ", \"radius\": %.17g", f->radius);
        fprintf(stream, "}, \"geometry\": {\"type\": \"%s\", \"coordinates\": ",
                line ? "LineString" : "Point");
        if (line)
            positions_write(stream, c, f->n, f->points, false);
        else
            fprintf(stream, "[%.17g, %.17g]", f->points[0], cage_given_y(c, f->points));
        fputs("}}", stream);
    }
}

static void write_cage(FILE *stream, const cage *c, cage_role role)
{
    cage_write_polygon(stream, c, role);
    write_inside(stream, c, role);
}

static void write_collection(FILE *stream, const cage *source, const cage *target)
{
    fputs("{\"type\": \"FeatureCollection\", \"features\": [\n", stream);
    if (source != NULL)
        write_cage(stream, source, CAGE_SOURCE);
    fputs(source != NULL && target != NULL ? ",\n" : "", stream);
    if (target != NULL)
        write_cage(stream, target, CAGE_TARGET);
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
