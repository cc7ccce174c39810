/* The georeferencer's files (QGIS, QgsGCPList): lines that begin with # name the reference system,
 * then a heading, then a row for each pair of points, with commas between. The second point comes
 * first. Before version 3.26 the columns of the first point are called pixelX and pixelY. */
#include "job/landmark_file.h"

#include "base/file.h"
#include "base/number.h"

#include <stdlib.h>
#include <string.h>

enum { MAP_X, MAP_Y, SOURCE_X, SOURCE_Y, ENABLED, N_COLUMNS };

static const char *skip_line(const char *p, size_t *line)
{
    p += strcspn(p, "\n");
    *line += *p == '\n';
    return p + (*p == '\n');
}

/* The line after the heading, or NULL if these are other landmarks. */
static const char *find_rows(const char *text, size_t *line)
{
    const char *p = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
    *line = 1;
    while (*p == '#' || *p == '\r' || *p == '\n')
        p = skip_line(p, line);
    bool heads = strncmp(p, "mapX,mapY,sourceX,sourceY", 25) == 0 ||
                 strncmp(p, "mapX,mapY,pixelX,pixelY", 23) == 0;
    return heads ? skip_line(p, line) : NULL;
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

static bool read_rows(table *out, const char *p, size_t line, problem *wrong)
{
    *out = (table){.columns = 4};
    for (; *p != '\0'; p = skip_line(p, &line)) {
        double row[N_COLUMNS];
        if (p[strspn(p, " \t\r")] == '\n' || p[strspn(p, " \t\r")] == '\0')
            continue;
        if (!read_row(p, line, row, wrong))
            return false;
        if (!(row[ENABLED] > 0))
            continue;
        memcpy(table_add_row(out, line),
               (double[]){row[SOURCE_X], row[SOURCE_Y], row[MAP_X], row[MAP_Y]}, 4 * sizeof *row);
        out->n++;
    }
    return true;
}

bool landmarks_decode(table *out, const char *text, size_t n, size_t dim, problem *wrong)
{
    const table_form form = {.columns = 2 * dim,
                             .what = dim == 2
                                         ? "landmarks are `x y x' y'`, one pair per line"
                                         : "landmarks are `x y z x' y' z'`, one pair per line"};
    size_t line;
    const char *rows = dim == 2 ? find_rows(text, &line) : NULL;
    return rows != NULL && strlen(text) == n ? read_rows(out, rows, line, wrong)
                                             : table_read(out, text, n, &form, wrong);
}

int landmarks_read(table *out, const char *name, size_t dim)
{
    size_t n;
    problem wrong;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    bool good = landmarks_decode(out, text, n, dim, &wrong);
    free(text);
    if (good)
        return DONE;
    table_free(out);
    return failed(name, wrong.line, "%s", wrong.text);
}
