/* The table of residuals. It has three columns of distances in the target, because a mistake shows in
 * the first two only: a map that goes through all points has no residuals, wrong as they may be. */
#include "fit/fit_report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_MOST = 32 };

static double length_at(const double *vectors, size_t i)
{
    return hypot(vectors[2 * i], vectors[2 * i + 1]);
}

/* Copies the name of a point, or its number from 1, cut short between UTF-8 characters. */
static const char *name_of(char out[NAME_MOST], const control_points *c, size_t i)
{
    if (c->names[i] == NULL)
        snprintf(out, NAME_MOST, "%zu", i + 1);
    else
        snprintf(out, NAME_MOST, "%s", c->names[i]);
    size_t n = strlen(out);
    if (c->names[i] != NULL && strlen(c->names[i]) > n) {
        while (n > 0 && ((unsigned char)c->names[i][n] & 0xc0) == 0x80)
            n--;
        out[n] = '\0';
    }
    return out;
}

static size_t n_characters(const char *text)
{
    size_t n = 0;
    for (; *text != '\0'; text++)
        n += ((unsigned char)*text & 0xc0) != 0x80;
    return n;
}

/* The point with the largest value, or n if none has one. */
static size_t largest(size_t n, const double *vectors)
{
    size_t at = n;
    for (size_t i = 0; i < n; i++)
        if (!isnan(vectors[2 * i]) && (at == n || length_at(vectors, i) > length_at(vectors, at)))
            at = i;
    return at;
}

static double root_mean_square(size_t n, const double *vectors)
{
    double sum = 0;
    for (size_t i = 0; i < 2 * n; i++)
        sum += vectors[i] * vectors[i] / (double)n;
    return sqrt(sum);
}

static void print_largest(const fit_job *f, const char *key, const double *vectors)
{
    const control_points *c = &f->points;
    size_t i = largest(c->n, vectors);
    char name[NAME_MOST];
    if (i < c->n)
        printf("%s%.6g, point %s (line %zu)\n", key, length_at(vectors, i), name_of(name, c, i),
               c->lines[i]);
}

/* Prints what has been done about folds. */
static void print_map(const fit_job *f)
{
    const icc_fit_info *x = &f->info;
    icc_map_info map = {.size = sizeof map};
    icc_map_get_info(f->job.map, &map);
    printf("one-to-one  %s; ", map.certified ? "yes, certified" : "not proved");
    if (x->model == ICC_FIT_ELASTIC)
        printf("%s\n", x->n_off == 0 ? "all points are at their places"
                                     : "some points are not at their places");
    else if (x->repair == ICC_REPAIR_NONE)
        printf("nothing folded\n");
    else if (x->repair == ICC_REPAIR_PATCHES)
        printf("the smooth map folded (%zu triangles), and %zu patch%s with %.3g %% of the area "
               "%s mapped anew\n",
               x->n_folded, x->n_patches, x->n_patches == 1 ? "" : "es", 100 * x->changed,
               x->n_patches == 1 ? "was" : "were");
    else
        printf("the smooth map folded (%zu triangles), and all of it was mapped anew\n",
               x->n_folded);
}

static void print_summary(const fit_job *f)
{
    const icc_fit_info *x = &f->info;
    const control_points *c = &f->points;
    printf("points      %zu, from %s", c->n, c->format);
    printf(c->n_disabled > 0 ? "; %zu disabled\n" : "\n", c->n_disabled);
    if (!isnan(x->left_out) && x->model == ICC_FIT_SPLINE)
        printf("accuracy    %.6g, root mean square of the column 'left out'\n", x->left_out);
    print_largest(f, "            largest: ", f->left_out);
    printf("affine      %.6g, root mean square\n", root_mean_square(c->n, f->affine));
    print_largest(f, "            largest: ", f->affine);
    printf("residual    %.6g, root mean square\n", x->residual);
    if (x->model == ICC_FIT_SPLINE)
        printf("margin      %.6g of the longest side%s\n", x->margin,
               f->job.args->margin > 0 ? "" : ", chosen by leaving each point out");
    if (x->model == ICC_FIT_SPLINE && x->smoothing > 0)
        printf("smoothing   %.6g%s\n", x->smoothing,
               f->job.args->smoothing > 0 ? "" : ", chosen by leaving each point out");
    print_map(f);
}

static void print_distance(const double *vectors, size_t i)
{
    if (isnan(vectors[2 * i]))
        printf(" %12s", "-");
    else
        printf(" %12.6g", length_at(vectors, i));
}

void fit_print(const fit_job *f)
{
    const control_points *c = &f->points;
    char name[NAME_MOST];
    size_t width = 5;
    for (size_t i = 0; i < c->n; i++) {
        size_t own = n_characters(name_of(name, c, i));
        width = own > width ? own : width;
    }
    print_summary(f);
    printf("\n%-*s %6s %12s %12s %12s\n", (int)width, "point", "line", "affine", "left out",
           "residual");
    for (size_t i = 0; i < c->n; i++) {
        size_t own = n_characters(name_of(name, c, i));
        printf("%s%*s %6zu", name, (int)(width - own), "", c->lines[i]);
        print_distance(f->affine, i);
        print_distance(f->left_out, i);
        print_distance(f->residuals, i);
        putchar('\n');
    }
}

/* ---------------------------------------------------------------------- JSON */

static void describe_points(json *out, const fit_job *f)
{
    const control_points *c = &f->points;
    json_open(out, "residuals", '[');
    for (size_t i = 0; i < c->n; i++) {
        json_open(out, NULL, '{');
        if (c->names[i] != NULL)
            json_text(out, "name", c->names[i]);
        json_count(out, "line", c->lines[i]);
        json_number(out, "affine", length_at(f->affine, i));
        json_number(out, "left_out", length_at(f->left_out, i));
        json_number(out, "residual", length_at(f->residuals, i));
        json_close(out, '}');
    }
    json_close(out, ']');
}

void fit_describe(json *out, const job *j)
{
    static const char *const repairs[] = {"none", "patches", "whole"};
    const fit_job *f = (const fit_job *)(const void *)j;
    const icc_fit_info *x = &f->info;
    icc_map_info map = {.size = sizeof map};
    icc_map_get_info(j->map, &map);
    json_open(out, "fit", '{');
    json_text(out, "model", x->model == ICC_FIT_SPLINE ? "spline" : "elastic");
    json_text(out, "format", f->points.format);
    json_flag(out, "certified", map.certified != 0);
    json_flag(out, "turned", f->turned);
    json_count(out, "disabled", f->points.n_disabled);
    json_number(out, "left_out", x->left_out);
    json_number(out, "affine", root_mean_square(f->points.n, f->affine));
    json_number(out, "residual", x->residual);
    if (x->model == ICC_FIT_SPLINE) {
        json_number(out, "margin", x->margin);
        json_number(out, "smoothing", x->smoothing);
        json_text(out, "repair", repairs[x->repair]);
        json_count(out, "folded", x->n_folded);
        json_count(out, "patches", x->n_patches);
        json_number(out, "changed", x->changed);
    } else {
        json_count(out, "not_reached", x->n_off);
        json_number(out, "most_off", x->most_off);
    }
    describe_points(out, f);
    json_close(out, '}');
}

int fit_report(const fit_job *f)
{
    report r;
    if (!report_open(&r, &f->job))
        return FAILED;
    report_times(&r, &f->job, 0);
    return report_close(&r) ? DONE : FAILED;
}
