/* Runs the program tetgen (Si, TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator, 2015),
 * if it is installed, in a private folder. -Y keeps the surface unchanged, so the first vertices of
 * the result are those of the input. */
#include "cage/filling.h"

#include "base/allocate.h"
#include "base/system.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -p: fill a surface; -Y: without new vertices on it; -q1.4: radius-edge ratio; -F: no files of
 * faces; -Q: quiet. */
#define OPTIONS "-pYq1.4FQ"

static const char *const leftovers[] = {"cage.off",    "cage.1.node", "cage.1.ele",
                                        "cage.1.edge", "cage.1.face", "cage.1.smesh"};

bool filling_can_make(void)
{
    return system_has_program("tetgen");
}

static FILE *open_in(const char *folder, const char *name, const char *mode)
{
    size_t room = strlen(folder) + strlen(name) + 2;
    char *path = need(room, 1);
    snprintf(path, room, "%s/%s", folder, name);
    FILE *file = fopen(path, mode);
    free(path);
    return file;
}

static bool write_surface(const cage *c, const char *folder, problem *wrong)
{
    FILE *file = open_in(folder, leftovers[0], "w");
    if (file == NULL)
        return spoilt(wrong, 0, "%s: %s", folder, strerror(errno));
    fprintf(file, "OFF\n%zu %zu 0\n", c->n, c->n_facets);
    for (size_t i = 0; i < c->n; i++)
        fprintf(file, "%.17g %.17g %.17g\n", c->points[3 * i], c->points[3 * i + 1],
                c->points[3 * i + 2]);
    for (size_t i = 0; i < c->n_facets; i++)
        fprintf(file, "3 %u %u %u\n", (unsigned)c->facets[3 * i], (unsigned)c->facets[3 * i + 1],
                (unsigned)c->facets[3 * i + 2]);
    bool good = ferror(file) == 0;
    good = fclose(file) == 0 && good;
    return good || spoilt(wrong, 0, "%s: %s", folder, strerror(errno));
}

static bool run(const char *folder, problem *wrong)
{
    size_t room = strlen(folder) + sizeof "/cage.off";
    char *path = need(room, 1), program[] = "tetgen", options[] = OPTIONS;
    snprintf(path, room, "%s/cage.off", folder);
    char *arguments[] = {program, options, path, NULL};
    int state = system_run(arguments);
    free(path);
    if (state < 0)
        return spoilt(wrong, 0, "tetgen: %s", strerror(errno));
    return state == 0 || spoilt(wrong, 0, "tetgen cannot fill the surface");
}

/* Reads a line of `n` numbers after the number of the item, which counts from `base`. */
static bool read_row(FILE *file, size_t i, unsigned long base, size_t n, double *row)
{
    unsigned long number;
    if (fscanf(file, "%lu", &number) != 1 || number != i + base)
        return false;
    for (size_t k = 0; k < n; k++)
        if (fscanf(file, "%lf", &row[k]) != 1)
            return false;
    return true;
}

/* Vertices and tetrahedra count from 0, because those of OFF files do. */
static bool read_points(FILE *file, const cage *c, filling *out)
{
    if (fscanf(file, "%zu %*d %*d %*d", &out->n_points) != 1 || out->n_points < c->n ||
        out->n_points > UINT32_MAX / 2)
        return false;
    out->points = need(out->n_points, 3 * sizeof *out->points);
    for (size_t i = 0; i < out->n_points; i++)
        if (!read_row(file, i, 0, 3, out->points + 3 * i))
            return false;
    memcpy(out->points, c->points, 3 * c->n * sizeof *out->points);
    return true;
}

static bool read_corners(FILE *file, filling *out)
{
    if (fscanf(file, "%zu %*d %*d", &out->n) != 1 || out->n > UINT32_MAX / 4)
        return false;
    out->corners = need(out->n, 4 * sizeof *out->corners);
    for (size_t i = 0; i < out->n; i++) {
        double row[4];
        if (!read_row(file, i, 0, 4, row))
            return false;
        for (size_t k = 0; k < 4; k++) {
            if (!(row[k] >= 0 && row[k] < (double)out->n_points))
                return false;
            out->corners[4 * i + k] = (uint32_t)row[k];
        }
    }
    return true;
}

static bool read_result(filling *out, const cage *c, const char *folder)
{
    FILE *points = open_in(folder, "cage.1.node", "r");
    FILE *corners = open_in(folder, "cage.1.ele", "r");
    bool good = points != NULL && corners != NULL && read_points(points, c, out) &&
                read_corners(corners, out);
    if (points != NULL)
        fclose(points);
    if (corners != NULL)
        fclose(corners);
    return good;
}

static void remove_folder(const char *folder)
{
    size_t room = strlen(folder) + 32;
    char *path = need(room, 1);
    for (size_t i = 0; i < sizeof leftovers / sizeof *leftovers; i++) {
        snprintf(path, room, "%s/%s", folder, leftovers[i]);
        remove(path);
    }
    system_remove_folder(folder);
    free(path);
}

bool filling_make(filling *out, const cage *c, problem *wrong)
{
    char *folder = system_make_temporary_folder();
    *out = (filling){.dim = 3};
    bool good = folder != NULL || spoilt(wrong, 0, "no temporary folder: %s", strerror(errno));
    if (good) {
        good = write_surface(c, folder, wrong) && run(folder, wrong);
        if (good && !read_result(out, c, folder))
            good = spoilt(wrong, 0, "tetgen has left no mesh that can be read");
        remove_folder(folder);
    }
    free(folder);
    if (good)
        filling_take_facets(out, c);
    else
        filling_free(out);
    return good;
}
