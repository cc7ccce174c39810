/* The georeferencer's files (QGIS, QgsGCPList): lines that begin with # name the reference system
 * of the map, then a heading, then a row for each pair of points, with commas between. The point on
 * the map comes first. Before version 3.26 the columns of the picture are called pixelX and pixelY.
 * Rows of the picture are counted downwards from 0, so y is at most 0 inside and points up. */
#include "control/control_readers.h"

#include "base/allocate.h"
#include "base/number.h"

#include <string.h>

enum { MAP_X, MAP_Y, SOURCE_X, SOURCE_Y, ENABLED, N_COLUMNS };

static const char *skip_line(const char *p, size_t *line)
{
    p += strcspn(p, "\n");
    *line += *p == '\n';
    return p + (*p == '\n');
}

/* The heading, or NULL if the text is another one. */
static const char *find_heading(const char *text, size_t *line)
{
    const char *p = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
    *line = 1;
    while (*p == '#' || *p == '\r' || *p == '\n')
        p = skip_line(p, line);
    bool heads = strncmp(p, "mapX,mapY,sourceX,sourceY", 25) == 0 ||
                 strncmp(p, "mapX,mapY,pixelX,pixelY", 23) == 0;
    return heads ? p : NULL;
}

bool control_is_qgis(const char *text)
{
    size_t line;
    return find_heading(text, &line) != NULL;
}

/* Keeps the name of the reference system, which stands in a line before the heading. */
static void take_system(control_points *out, const char *text, const char *heading)
{
    const char *p = strstr(text, "#CRS:");
    if (p == NULL || p >= heading)
        return;
    p += 5 + strspn(p + 5, " \t");
    size_t n = strcspn(p, "\r\n");
    while (n > 0 && (p[n - 1] == ' ' || p[n - 1] == '\t'))
        n--;
    if (n == 0)
        return;
    out->crs = need(n + 1, 1);
    memcpy(out->crs, p, n);
}

/* Reads one row. The columns after the first ones tell how well QGIS fits it. */
static bool read_row(const char *p, size_t line, double row[N_COLUMNS], problem *wrong)
{
    char shown[32];
    for (int k = 0; k < N_COLUMNS; k++) {
        p += strspn(p, " \t");
        const char *word = p;
        if (number_read(&p, &row[k]) != NUMBER_OK)
            return spoilt(wrong, line, "'%s' is not a finite number", quoted(shown, word));
        p += strspn(p, " \t\r");
        bool last = k == N_COLUMNS - 1;
        if (*p != ',' && !(last && (*p == '\n' || *p == '\0')))
            return spoilt(wrong, line,
                          "a row begins with mapX, mapY, sourceX, sourceY, enable, with commas "
                          "between");
        p += *p == ',';
    }
    return true;
}

bool control_read_qgis(control_points *out, const char *text, problem *wrong)
{
    size_t line;
    const char *p = find_heading(text, &line);
    out->format = "control points of QGIS";
    take_system(out, text, p);
    for (p = skip_line(p, &line); *p != '\0'; p = skip_line(p, &line)) {
        double row[N_COLUMNS];
        if (p[strspn(p, " \t\r")] == '\n' || p[strspn(p, " \t\r")] == '\0')
            continue;
        if (!read_row(p, line, row, wrong))
            return false;
        if (row[ENABLED] > 0)
            control_add(out, row + SOURCE_X, row + MAP_X, line);
        out->n_disabled += !(row[ENABLED] > 0);
    }
    return true;
}
