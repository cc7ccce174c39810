/* libicc map --geojson: carries the geometries of a GeoJSON file (RFC 7946) along.
 *
 * Everything but coordinates stays as it is, except that bounding boxes are dropped, since they would
 * be wrong. So is what has no image: points and polygons become empty, which readers take for none,
 * and lines are cut. */
#include "cmd/commands.h"

#include "cmd/densify.h"
#include "base/allocate.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct carriage {
    job job;
    double tolerance;
    int result;                          /* DONE until something fails */
    const char *type;                    /* of the geometry at hand */
    bool curtailed;                      /* a part of it has no image */
    size_t n_positions, n_without_image; /* of those in the file */
    size_t n_curtailed;                  /* geometries */
} carriage;

/* ------------------------------------------------------------- coordinates */

static void read_position(carriage *c, const cJSON *position, polyline *line)
{
    double point[3];
    for (int k = 0; k < 3; k++) {
        const cJSON *item = cJSON_IsArray(position) ? cJSON_GetArrayItem(position, k) : NULL;
        point[k] = cJSON_IsNumber(item) ? item->valuedouble : NAN;
        if ((k < 2 || item != NULL) && !isfinite(point[k]) && c->result == DONE)
            c->result = failed(c->job.args->operands[0], 0,
                               "position %zu, in a %s, is not two or three finite numbers",
                               c->n_positions, c->type);
    }
    polyline_add(line, point);
    c->n_positions++;
}

static size_t count_missing(const polyline *line)
{
    size_t n = 0;
    for (size_t i = 0; i < line->n; i++)
        n += isnan(line->images[2 * i]) ? 1 : 0;
    return n;
}

/* Maps a list of positions. With a tolerance they are a line. */
static polyline carry_positions(carriage *c, const cJSON *positions, double tolerance)
{
    polyline line = {0};
    const cJSON *position;
    cJSON_ArrayForEach(position, positions) read_position(c, position, &line);
    if (c->result == DONE)
        c->result = polyline_map(&line, &c->job);
    if (c->result == DONE)
        c->n_without_image += count_missing(&line);
    if (c->result == DONE && tolerance > 0)
        c->result = polyline_densify(&line, &c->job, tolerance);
    if (c->result != DONE)
        polyline_free(&line);
    c->curtailed = c->curtailed || count_missing(&line) > 0;
    return line;
}

static cJSON *position_item(const polyline *line, size_t i)
{
    double z = line->points[3 * i + 2],
           numbers[3] = {line->images[2 * i], line->images[2 * i + 1], z};
    return cJSON_CreateDoubleArray(numbers, isnan(z) ? 2 : 3);
}

/* The vertices from `first` up to `end` that have an image. */
static cJSON *list_item(const polyline *line, size_t first, size_t end)
{
    cJSON *list = cJSON_CreateArray();
    for (size_t i = first; i < end; i++)
        if (!isnan(line->images[2 * i]))
            cJSON_AddItemToArray(list, position_item(line, i));
    return list;
}

static cJSON *carry_point(carriage *c, const cJSON *position)
{
    polyline line = {0};
    read_position(c, position, &line);
    if (c->result == DONE)
        c->result = polyline_map(&line, &c->job);
    c->curtailed = c->result == DONE && count_missing(&line) > 0;
    c->n_without_image += c->curtailed;
    cJSON *item =
        c->result == DONE && !c->curtailed ? position_item(&line, 0) : cJSON_CreateArray();
    polyline_free(&line);
    return item;
}

static cJSON *carry_points(carriage *c, const cJSON *positions)
{
    polyline line = carry_positions(c, positions, 0);
    cJSON *item = list_item(&line, 0, line.n);
    polyline_free(&line);
    return item;
}

/* Adds the parts of a line that have an image to a list. */
static void carry_line(carriage *c, const cJSON *positions, cJSON *parts)
{
    polyline line = carry_positions(c, positions, c->tolerance);
    for (size_t i = 0, end; i < line.n; i = end + 1) {
        for (end = i; end < line.n && !isnan(line.images[2 * end]);)
            end++;
        if (end > i + 1)
            cJSON_AddItemToArray(parts, list_item(&line, i, end));
    }
    polyline_free(&line);
}

/* Empty when a part of any ring has no image. */
static cJSON *carry_polygon(carriage *c, const cJSON *rings)
{
    cJSON *list = cJSON_CreateArray();
    const cJSON *ring;
    bool whole = true;
    cJSON_ArrayForEach(ring, rings)
    {
        polyline line = carry_positions(c, ring, c->tolerance);
        whole = whole && count_missing(&line) == 0;
        cJSON_AddItemToArray(list, list_item(&line, 0, line.n));
        polyline_free(&line);
    }
    if (whole)
        return list;
    cJSON_Delete(list);
    return cJSON_CreateArray();
}

/* -------------------------------------------------------------- geometries */

static void replace(cJSON *object, const char *name, cJSON *item)
{
    cJSON_ReplaceItemInObjectCaseSensitive(object, name, item);
}

/* A line that falls apart becomes several. */
static void carry_line_string(carriage *c, cJSON *geometry, const cJSON *positions)
{
    cJSON *parts = cJSON_CreateArray();
    carry_line(c, positions, parts);
    if (cJSON_GetArraySize(parts) > 1) {
        replace(geometry, "type", cJSON_CreateString("MultiLineString"));
        replace(geometry, "coordinates", parts);
        return;
    }
    cJSON *only = cJSON_DetachItemFromArray(parts, 0);
    replace(geometry, "coordinates", only != NULL ? only : cJSON_CreateArray());
    cJSON_Delete(parts);
}

static void carry_parts(carriage *c, cJSON *geometry, const cJSON *coordinates, bool polygons)
{
    cJSON *parts = cJSON_CreateArray();
    const cJSON *part;
    cJSON_ArrayForEach(part, coordinates)
    {
        cJSON *polygon = polygons ? carry_polygon(c, part) : NULL;
        if (!polygons)
            carry_line(c, part, parts);
        else if (cJSON_GetArraySize(polygon) > 0)
            cJSON_AddItemToArray(parts, polygon);
        else
            cJSON_Delete(polygon);
    }
    replace(geometry, "coordinates", parts);
}

static bool is_type(const char *type, const char *name)
{
    return strcmp(type, name) == 0;
}

static void carry_geometry(carriage *c, cJSON *geometry, const char *type)
{
    const cJSON *coordinates = cJSON_GetObjectItemCaseSensitive(geometry, "coordinates");
    char shown[32];
    c->type = type;
    c->curtailed = false;
    if (!cJSON_IsArray(coordinates))
        c->result =
            failed(c->job.args->operands[0], 0, "a '%s' has no coordinates", quoted(shown, type));
    else if (cJSON_GetArraySize(coordinates) == 0)
        return;
    else if (is_type(type, "Point"))
        replace(geometry, "coordinates", carry_point(c, coordinates));
    else if (is_type(type, "MultiPoint"))
        replace(geometry, "coordinates", carry_points(c, coordinates));
    else if (is_type(type, "LineString"))
        carry_line_string(c, geometry, coordinates);
    else if (is_type(type, "MultiLineString"))
        carry_parts(c, geometry, coordinates, false);
    else if (is_type(type, "Polygon"))
        replace(geometry, "coordinates", carry_polygon(c, coordinates));
    else if (is_type(type, "MultiPolygon"))
        carry_parts(c, geometry, coordinates, true);
    else
        c->result =
            failed(c->job.args->operands[0], 0, "'%s' is no type of GeoJSON", quoted(shown, type));
    c->n_curtailed += c->curtailed;
}

/* An object of any type. cJSON reads at most 1000 levels, so the recursion is bounded. */
static void carry_object(carriage *c, cJSON *object)
{
    static const char *const lists[] = {"features", "geometries"};
    const char *type = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, "type"));
    cJSON_DeleteItemFromObjectCaseSensitive(object, "bbox");
    if (type == NULL)
        c->result = failed(c->job.args->operands[0], 0, "this is not GeoJSON: a type is missing");
    else if (is_type(type, "FeatureCollection") || is_type(type, "GeometryCollection")) {
        cJSON *list = cJSON_GetObjectItemCaseSensitive(object, lists[*type == 'G']), *item;
        cJSON_ArrayForEach(item, list) if (c->result == DONE) carry_object(c, item);
    } else if (is_type(type, "Feature")) {
        cJSON *geometry = cJSON_GetObjectItemCaseSensitive(object, "geometry");
        if (cJSON_IsObject(geometry))
            carry_object(c, geometry);
    } else
        carry_geometry(c, object, type);
}

/* ------------------------------------------------------------ file to file */

/* As few digits as give the same double again. */
static void write_number(FILE *stream, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.15g", value);
    if (strtod(text, NULL) < value || strtod(text, NULL) > value)
        snprintf(text, sizeof text, "%.17g", value);
    fputs(isfinite(value) ? text : "null", stream);
}

/* In one line, but for the members of lists of objects. */
static void write_item(FILE *stream, const cJSON *item)
{
    if (cJSON_IsString(item))
        json_string(stream, item->valuestring);
    else if (cJSON_IsNumber(item))
        write_number(stream, item->valuedouble);
    else if (!cJSON_IsArray(item) && !cJSON_IsObject(item))
        fputs(cJSON_IsTrue(item) ? "true" : cJSON_IsFalse(item) ? "false" : "null", stream);
    else {
        bool object = cJSON_IsObject(item);
        const cJSON *child;
        fputc(object ? '{' : '[', stream);
        cJSON_ArrayForEach(child, item)
        {
            if (child != item->child)
                fputs(", ", stream);
            if (cJSON_IsObject(child) && !object)
                fputc('\n', stream);
            if (object) {
                json_string(stream, child->string);
                fputs(": ", stream);
            }
            write_item(stream, child);
        }
        fputc(object ? '}' : ']', stream);
    }
}

static int write_file(const carriage *c, const cJSON *root)
{
    outfile file;
    if (!outfile_open(&file, c->job.args->operands[1]))
        return FAILED;
    write_item(file.stream, root);
    fputc('\n', file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

static cJSON *read_file(const char *name)
{
    size_t n;
    const char *end = NULL;
    char *text = file_read(name, &n);
    if (text == NULL)
        return NULL;
    cJSON *root = cJSON_ParseWithLengthOpts(text, n + 1, &end, 1);
    if (root == NULL)
        failed(name, line_of(text, end),
               end >= text + n ? "the JSON ends early" : "this is not valid JSON");
    free(text);
    return root;
}

static int verdict(carriage *c, double began)
{
    int result = report_points(&c->job, c->n_positions, c->n_without_image, seconds_now() - began);
    if (result != DONE || c->n_curtailed == 0)
        return result;
    note("%zu of %zu positions have no image; %zu geometries are cut or empty", c->n_without_image,
         c->n_positions, c->n_curtailed);
    return PARTIAL;
}

/* Lines may be off by a thousandth of the result's size unless told otherwise. */
static double choose_tolerance(const job *j)
{
    icc_domain_info info = {.size = sizeof info};
    icc_domain_get_info(j->domains[!j->args->inverse], &info);
    double size = fmax(info.upper[0] - info.lower[0], info.upper[1] - info.lower[1]);
    return j->args->tolerance > 0 ? j->args->tolerance : size / 1000;
}

static void *allocate(size_t n)
{
    return need(n, 1);
}

int run_geojson(const args *a)
{
    cJSON_Hooks hooks = {.malloc_fn = allocate, .free_fn = free};
    cJSON_InitHooks(&hooks);
    carriage c = {0};
    job_start(&c.job, a);
    c.result = job_read_plane(&c.job, "--geojson");
    if (c.result == DONE)
        c.result = job_make_map(&c.job);
    cJSON *root = c.result == DONE ? read_file(a->operands[0]) : NULL;
    if (root != NULL) {
        double began = seconds_now();
        c.tolerance = choose_tolerance(&c.job);
        carry_object(&c, root);
        progress_end(&c.job.bar);
        if (c.result == DONE)
            c.result = write_file(&c, root);
        if (c.result == DONE)
            c.result = verdict(&c, began);
    } else if (c.result == DONE)
        c.result = FAILED;
    cJSON_Delete(root);
    job_end(&c.job);
    return c.result;
}
