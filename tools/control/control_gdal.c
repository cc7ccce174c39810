/* Ground control points of GDAL. A VRT lists them as elements <GCP Id Info Pixel Line X Y Z/>, and
 * gdal_translate takes them as options `-gcp pixel line x y [z]`. Pixels count from the upper left
 * corner of the picture, and lines run down.
 * https://gdal.org/en/stable/drivers/raster/vrt.html */
#include "control/control_readers.h"

#include "base/allocate.h"
#include "base/number.h"
#include "base/xml_tags.h"

#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\r\n\\\"'";

bool control_is_vrt(const char *text)
{
    const char *p = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
    p += strspn(p, " \t\r\n");
    return *p == '<' && (strstr(p, "<VRTDataset") != NULL || strstr(p, "<GCPList") != NULL);
}

static bool read_attribute(const tag *t, const char *name, double *value, size_t line,
                           problem *wrong)
{
    const char *end, *p = tag_attribute(t, name, strlen(name), &end);
    if (p == NULL)
        return spoilt(wrong, line, "the GCP has no attribute %s", name);
    char shown[32];
    const char *word = p;
    return (number_read(&p, value) == NUMBER_OK && p == end) ||
           spoilt(wrong, line, "%s=\"%s is not a finite number", name, quoted(shown, word));
}

static bool read_gcp(control_points *out, const tag *t, size_t line, problem *wrong)
{
    double from[2], to[2];
    if (!read_attribute(t, "Pixel", &from[0], line, wrong) ||
        !read_attribute(t, "Line", &from[1], line, wrong) ||
        !read_attribute(t, "X", &to[0], line, wrong) ||
        !read_attribute(t, "Y", &to[1], line, wrong))
        return false;
    control_add(out, from, to, line);
    const char *end, *name = tag_attribute(t, "Id", 2, &end);
    if (name != NULL)
        control_name(out, name, (size_t)(end - name));
    return true;
}

/* Keeps the name of the reference system, with its quotation marks as they were. */
static void take_projection(control_points *out, const tag *list)
{
    static const char mark[] = "&quot;";
    const char *end, *p = tag_attribute(list, "Projection", 10, &end);
    if (p == NULL || p == end || out->crs != NULL)
        return;
    char *to = out->crs = need((size_t)(end - p) + 1, 1);
    while (p < end) {
        bool is_mark = strncmp(p, mark, sizeof mark - 1) == 0;
        *to++ = is_mark ? '"' : *p;
        p += is_mark ? sizeof mark - 1 : 1;
    }
}

bool control_read_vrt(control_points *out, const char *text, problem *wrong)
{
    line_finder at = {text, 1};
    tag t;
    out->format = "a VRT of GDAL";
    out->rows_down = true;
    for (const char *p = text; tag_next(&t, p); p = t.end) {
        if (tag_is(&t, "GCPList") && !t.closes)
            take_projection(out, &t);
        if (tag_is(&t, "GCP") && !t.closes &&
            !read_gcp(out, &t, line_finder_at(&at, t.name), wrong))
            return false;
    }
    return out->n > 0 || spoilt(wrong, 0,
                                "this VRT has no ground control points, which are elements <GCP "
                                "Pixel=\"..\" Line=\"..\" X=\"..\" Y=\"..\"/>");
}

/* The text after the next option from p on, or NULL. */
static const char *next_option(const char *p)
{
    while ((p = strstr(p, "-gcp")) != NULL) {
        p += 4;
        if (*p != '\0' && strchr(blanks, *p) != NULL)
            return p;
    }
    return NULL;
}

bool control_has_gcp_options(const char *text)
{
    return next_option(text) != NULL;
}

bool control_read_gcp_options(control_points *out, const char *text, problem *wrong)
{
    line_finder at = {text, 1};
    out->format = "options -gcp of GDAL";
    out->rows_down = true;
    for (const char *p = next_option(text); p != NULL; p = next_option(p)) {
        double values[4];
        size_t line = line_finder_at(&at, p);
        for (size_t k = 0; k < 4; k++) {
            char shown[32];
            p += strspn(p, blanks);
            const char *word = p;
            if (number_read(&p, &values[k]) != NUMBER_OK ||
                (*p != '\0' && strchr(blanks, *p) == NULL))
                return spoilt(wrong, line,
                              "'%s' is not a finite number; an option is -gcp pixel line x y",
                              quoted(shown, word));
        }
        control_add(out, values, values + 2, line);
    }
    return true;
}
