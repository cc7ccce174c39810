/* Writes the data of a map into the page of tools/plot/page.
 *
 * The data are one JSON object. Positions are floats before and after, cells are indices of 32
 * bits, both in base64 and least byte first. Each shape is moved so that the middle of its box is
 * the origin before it is rounded to floats: far from the origin, floats would not tell vertices
 * apart. */
#include "plot/plot_page.h"

#include "base/allocate.h"
#include "base/base64.h"
#include "base/system.h"
#include "report/reason.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char marker[] = "/*data*/";

/* The map and its domains, as the page shows them. */
typedef struct scene {
    job *job;
    icc_map_info info;
    double *points[2]; /* before and after */
    uint32_t *cells;
} scene;

/* ---- numbers ---- */

static void put_word(unsigned char *to, uint32_t word)
{
    for (size_t k = 0; k < 4; k++)
        to[k] = (unsigned char)(word >> (8 * k) & 255);
}

/* Writes 4 n bytes as a string of base64. */
static void write_base64(json *j, const char *name, const unsigned char *bytes, size_t n)
{
    char *text = base64_encode(bytes, 4 * n, &n);
    json_text(j, name, text);
    free(text);
}

static void write_indices(json *j, const char *name, const uint32_t *all, size_t n, uint32_t first)
{
    unsigned char *bytes = need(n + 1, 4);
    for (size_t i = 0; i < n; i++)
        put_word(bytes + 4 * i, all[i] + first);
    write_base64(j, name, bytes, n);
    free(bytes);
}

/* The middle and the longest side of the box of both shapes. */
static double measure(const scene *x, double middle[2][3])
{
    size_t dim = (size_t)x->info.dim;
    double longest = 0;
    for (size_t side = 0; side < 2; side++)
        for (size_t k = 0; k < dim; k++) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (size_t i = k; i < dim * x->info.n_vertices; i += dim) {
                low = fmin(low, x->points[side][i]);
                high = fmax(high, x->points[side][i]);
            }
            middle[side][k] = low / 2 + high / 2;
            longest = fmax(longest, high - low);
        }
    return longest;
}

static void write_points(json *j, const char *name, const scene *x, size_t side,
                         const double middle[3], double unit)
{
    size_t dim = (size_t)x->info.dim, n = dim * x->info.n_vertices;
    unsigned char *bytes = need(n + 1, 4);
    for (size_t i = 0; i < n; i++) {
        float value = (float)((x->points[side][i] - middle[i % dim]) / unit);
        uint32_t word;
        memcpy(&word, &value, sizeof word);
        put_word(bytes + 4 * i, word);
    }
    write_base64(j, name, bytes, n);
    free(bytes);
}

/* ---- the data ---- */

static void write_part(json *j, const cage_feature *f, size_t number, size_t first)
{
    char name[48];
    snprintf(name, sizeof name, "%s %zu", f->kind == ICC_FEATURE_HOLE ? "void" : "region", number);
    json_open(j, NULL, '{');
    json_text(j, "name", f->label != NULL ? f->label : name);
    json_text(j, "kind", f->kind == ICC_FEATURE_HOLE ? "void" : "region");
    write_indices(j, "facets", f->facets, 3 * f->n_facets, (uint32_t)first);
    json_close(j, '}');
}

/* The surfaces inside a solid. A map's first vertices are those of its domain: the outer ones, then
 * those of the features in their order. */
static void write_parts(json *j, const scene *x)
{
    const cage *c = &x->job->cages[0];
    size_t first = c->n, numbers[2] = {0, 0};
    json_open(j, "parts", '[');
    for (size_t i = 0; i < c->n_features && c->dim == 3; i++) {
        const cage_feature *f = &c->features[i];
        bool hole = f->kind == ICC_FEATURE_HOLE;
        if (hole || f->kind == ICC_FEATURE_REGION)
            write_part(j, f, ++numbers[hole], first);
        first += f->n;
    }
    json_close(j, ']');
}

static void write_words(json *j, const scene *x)
{
    char text[REASON_LENGTH + 200], reason[REASON_LENGTH];
    const char *kind = x->info.dim == 3 ? "tetrahedra" : "triangles";
    icc_map_report made = {.size = sizeof made};
    icc_map_get_report(x->job->map, &made);
    if (x->info.certified)
        snprintf(text, sizeof text,
                 "The map is linear on each of %zu %s. Exact signs prove that all of them keep "
                 "their orientation, so the map is one-to-one.",
                 x->info.n_simplices, kind);
    else
        snprintf(text, sizeof text, "The map has %zu %s. It is not certified: %s.",
                 x->info.n_simplices, kind, reason_of_map(reason, &x->info, &made));
    json_text(j, "words", text);
}

static void write_data(FILE *stream, const scene *x)
{
    static const char *const names[2] = {"before", "after"};
    size_t dim = (size_t)x->info.dim;
    double middle[2][3], longest = measure(x, middle), unit = longest > 0 ? longest : 1;
    json j = {.stream = stream, .first = true};
    json_open(&j, NULL, '{');
    json_count(&j, "dim", dim);
    json_text(&j, "source", job_file(x->job, 1));
    json_text(&j, "target", job_file(x->job, 2));
    json_flag(&j, "certified", x->info.certified != 0);
    json_flag(&j, "y_down", x->job->args->y_down);
    json_count(&j, "vertices", x->info.n_vertices);
    json_count(&j, "simplices", x->info.n_simplices);
    write_words(&j, x);
    write_parts(&j, x);
    for (size_t side = 0; side < 2; side++)
        write_points(&j, names[side], x, side, middle[side], unit);
    write_indices(&j, "cells", x->cells, (dim + 1) * x->info.n_simplices, 0);
    json_close(&j, '}');
}

/* Writes JSON so that no name in it ends the script that holds it. */
static void write_guarded(FILE *to, const char *text, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (text[i] == '<')
            fputs("\\u003c", to);
        else
            fputc(text[i], to);
}

static int write_page(const scene *x, const char *name)
{
    const char *page = (const char *)viewer_page, *middle = strstr(page, marker);
    collector data;
    outfile file;
    if (!collector_begin(&data))
        return failed(NULL, 0, "not enough memory for the page");
    write_data(data.stream, x);
    bool good = collector_end(&data);
    int result = !good ? failed(NULL, 0, "not enough memory for the page")
                       : (outfile_open(&file, name) ? DONE : FAILED);
    if (result == DONE) {
        fwrite(page, 1, (size_t)(middle - page), file.stream);
        write_guarded(file.stream, data.bytes, data.n);
        fputs(middle + strlen(marker), file.stream);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    free(data.bytes);
    return result;
}

/* ---- the map ---- */

static int take_map(scene *x)
{
    job *j = x->job;
    icc_map_get_info(j->map, &x->info);
    if (x->info.kind != ICC_MAP_MESH || x->info.dim > 3 || x->info.dim < 2)
        return misused(j->args->command,
                       "a page shows the cells of a mesh map in the plane or in space, and this "
                       "map has none; add --map mesh, or write OUT.svg");
    size_t dim = (size_t)x->info.dim;
    for (size_t side = 0; side < 2; side++)
        x->points[side] = need(x->info.n_vertices, dim * sizeof(double));
    x->cells = need(x->info.n_simplices, (dim + 1) * sizeof *x->cells);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = x->info.n_vertices,
                     .vertices = x->points[0],
                     .n_cells = x->info.n_simplices,
                     .cells = x->cells};
    icc_status ran = icc_map_get_mesh(j->map, &mesh, x->points[1]);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}

int plot_page(job *j)
{
    scene x = {.job = j, .info = {.size = sizeof x.info}};
    if (j->args->target == NULL && !j->both)
        return misused(j->args->command, "a page shows a map: add --target FILE");
    int result = job_make_map(j);
    if (result == DONE)
        result = take_map(&x);
    progress_end(&j->bar);
    if (result == DONE)
        result = write_page(&x, j->args->operands[0]);
    for (size_t side = 0; side < 2; side++)
        free(x.points[side]);
    free(x.cells);
    return result;
}
