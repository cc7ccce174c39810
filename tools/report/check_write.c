/* Writes the files of `libicc check`: repaired cages, and the boundaries of masks. */
#include "report/check_job.h"

#include "base/allocate.h"
#include "cage/mend.h"
#include "cage/surface_write.h"
#include "cage/weld.h"
#include "job/cage_file.h"
#include "job/output_name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Marks the vertices that repeat another or end a spike. */
static size_t mark_superfluous(const check *c, unsigned char *drop)
{
    size_t n = 0;
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < c->defects[side].n; i++) {
            int32_t kind = c->defects[side].kinds[i];
            if (kind != ICC_DEFECT_REPEATED && kind != ICC_DEFECT_SPIKE)
                continue;
            uint32_t vertex =
                c->defects[side].items[2 * i + 1]; /* the later one of two repeated vertices */
            n += drop[vertex] == 0;
            drop[vertex] = 1;
        }
    return n;
}

static void drop_vertices(cage *c, const unsigned char *drop)
{
    size_t kept = 0;
    for (size_t i = 0; i < c->n; i++) {
        if (drop[i])
            continue;
        memmove(c->points + 2 * kept, c->points + 2 * i, 2 * sizeof *c->points);
        c->lines[kept++] = c->lines[i];
    }
    c->n = kept;
}

/* Drops the same vertices from both cages, so that they still correspond, until none is
 * superfluous. A spike whose tip is dropped may leave a repeated vertex. */
static int drop_superfluous(check *c)
{
    for (;;) {
        size_t n = c->job.cages[0].n;
        unsigned char *drop = need(n, 1);
        size_t n_marked = mark_superfluous(c, drop);
        bool enough = n >= n_marked + 3;
        for (size_t side = 0; side < 2 && enough; side++)
            if (c->job.cages[side].n > 0)
                drop_vertices(&c->job.cages[side], drop);
        free(drop);
        if (!enough)
            return failed(c->job.args->source, 0,
                          "fewer than 3 vertices would be left after the repair");
        c->n_dropped += n_marked;
        if (n_marked == 0)
            return DONE;
        if (check_find_defects(c) != DONE)
            return FAILED;
    }
}

int check_repair(check *c)
{
    size_t n_found = c->n_defects;
    int result = drop_superfluous(c);
    if (result != DONE)
        return result;
    if (c->n_defects > 0)
        return failed(c->job.args->source, 0,
                      "%zu of %zu defects remain when %zu vertices are dropped, so nothing was "
                      "written; mend the crossings by hand",
                      c->n_defects, n_found, c->n_dropped);
    const cage *target = &c->job.cages[1];
    return cages_write(c->job.args->repair, &c->job.cages[0], target->n > 0 ? target : NULL);
}

/* Version 1 of the format: the header is padded so that the data begin at a multiple of 64
 * bytes. */
static void write_npy(FILE *stream, const cage *c)
{
    char header[256];
    int used =
        snprintf(header, sizeof header, "{'descr': '|u1', 'fortran_order': True, 'shape': (");
    size_t n = 1;
    for (size_t k = 0; k < c->dim; k++) {
        used += snprintf(header + used, sizeof header - (size_t)used, "%zu,%s", c->shape[k],
                         k + 1 < c->dim ? " " : "");
        n *= c->shape[k];
    }
    used += snprintf(header + used, sizeof header - (size_t)used, "), }");
    while ((used + 11) % 64 != 0)
        header[used++] = ' ';
    header[used++] = '\n';
    fwrite("\x93NUMPY\1\0", 1, 8, stream);
    fputc(used % 256, stream);
    fputc(used / 256, stream);
    fwrite(header, 1, (size_t)used, stream);
    fwrite(c->cells, 1, n, stream);
}

int check_repair_mask(check *c)
{
    cage *mask = &c->job.cages[0];
    icc_error err = {.size = sizeof err, .index = -1};
    outfile file;
    if (icc_mask_repair((int32_t)mask->dim, mask->shape, mask->cells, &c->n_filled, &c->job.env,
                        &err) != ICC_OK)
        return job_failed(&c->job, &err);
    int result = job_make_domains(&c->job);
    progress_end(&c->job.bar);
    if (result != DONE || !outfile_open(&file, c->job.args->repair))
        return FAILED;
    write_npy(file.stream, mask);
    return outfile_close(&file) ? DONE : FAILED;
}

static void write_row(FILE *stream, size_t dim, const double *at)
{
    for (size_t k = 0; k < dim; k++)
        fprintf(stream, "%s%.17g", k > 0 ? " " : "", at[k]);
    fputc('\n', stream);
}

/* Writes a surface in the format of the name, or as `format`. With neither, and in other dimensions
 * than 3, it writes one vertex in a line. */
static int write_boundary(const cage *c, const char *name, const char *format)
{
    const char *found = c->dim == 3 ? output_format(name) : NULL;
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    if (found != NULL && strcmp(found, "text") != 0)
        format = found;
    if (format != NULL)
        surface_write(file.stream, c, format);
    for (size_t i = 0; i < c->n && format == NULL; i++)
        write_row(file.stream, c->dim, c->points + i * c->dim);
    return outfile_close(&file) ? DONE : FAILED;
}

/* Writes the outline of a picture, or the boundary of a mask, and prints that arrays count rows first but pictures x. */
int check_write_boundary(check *c)
{
    const cage *mask = &c->job.cages[0];
    const char *name = c->job.args->boundary;
    if (mask->of_picture)
        return cages_write(name, mask, NULL);
    int result = write_boundary(mask, name, NULL);
    if (result == DONE && mask->dim == 2)
        note("%s: the first coordinate is the row (axis 0 of the array), and the second is the "
             "column; for warp and pose swap them, because in pictures x comes first",
             name);
    else if (result == DONE)
        note("%s: x is axis 0 of the array%s", name,
             mask->dim == 3   ? ", y axis 1, z axis 2"
             : mask->dim == 1 ? ""
                              : ", and so on");
    return result;
}

int check_repair_surface(check *c)
{
    cage *surface = &c->job.cages[0];
    c->n_joined = weld(surface, c->job.args->weld);
    int result = mend_surface(surface, c->job.args->source, &c->mended);
    if (result == DONE)
        result = job_make_domains(&c->job);
    progress_end(&c->job.bar);
    return result == DONE ? write_boundary(&c->job.cages[0], c->job.args->repair, "OBJ") : result;
}
