/* Reads poses from JSON. The transform of a handle is either given, or made of a linear map about
 * the handle, a rotation, and a translation, in this order. */
#include "kernel/handle_set.h"

#include "base/allocate.h"
#include "base/foreign.h"
#include "base/json_in.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct pose_file {
    size_t dim, n_handles;
    const double *handles;
    double *transforms;
    problem *wrong;
} pose_file;

/* Reads dim rows of `columns` numbers to rows of dim + 1. */
static bool read_rows(const pose_file *p, const json_item *list, const char *where, size_t columns,
                      double *to)
{
    double *rows;
    size_t n;
    bool good = json_points(list, where, columns, &n, &rows, p->wrong);
    if (good && n != p->dim)
        good = spoilt(p->wrong, 0, "%s has %zu rows instead of %zu", where, n, p->dim);
    for (size_t k = 0; good && k < p->dim; k++)
        memcpy(to + (p->dim + 1) * k, rows + columns * k, columns * sizeof *to);
    free(rows);
    return good;
}

static bool read_transforms(const pose_file *p, const json_item *list)
{
    size_t n, i = 0;
    if (!json_list(list, "transforms", &n, p->wrong))
        return false;
    if (n != p->n_handles)
        return spoilt(p->wrong, 0, "there are %zu transforms, but %zu handles", n, p->n_handles);
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item)) {
        char where[64];
        snprintf(where, sizeof where, "transforms[%zu]", i);
        if (!read_rows(p, item, where, p->dim + 1, p->transforms + p->dim * (p->dim + 1) * i++))
            return false;
    }
    return true;
}

/* x -> h + A (x - h) */
static bool read_matrix(const pose_file *p, const json_item *matrix, const char *where,
                        const double *handle, double *transform)
{
    char name[64];
    snprintf(name, sizeof name, "%s.matrix", where);
    if (matrix == NULL)
        return true;
    if (!read_rows(p, matrix, name, p->dim, transform))
        return false;
    for (size_t k = 0; k < p->dim; k++) {
        double *row = transform + (p->dim + 1) * k, offset = handle[k];
        for (size_t l = 0; l < p->dim; l++)
            offset -= row[l] * handle[l];
        row[p->dim] = offset;
    }
    return true;
}

static bool read_turn(const pose_file *p, const json_item *move, const char *where,
                      const double *handle, double *transform)
{
    static const double degree = 3.14159265358979323846 / 180;
    char turn[64], axis[64];
    double angle, tip[3] = {0, 0, 1};
    const json_item *given = json_get(move, "axis");
    snprintf(turn, sizeof turn, "%s.turn", where);
    snprintf(axis, sizeof axis, "%s.axis", where);
    if (given != NULL && (p->dim == 2 || json_get(move, "turn") == NULL))
        return spoilt(p->wrong, 0, "%s goes with a turn in space", axis);
    if (json_get(move, "turn") == NULL)
        return true;
    if (!json_real(json_get(move, "turn"), turn, &angle, p->wrong))
        return false;
    if (p->dim == 3 && !json_reals(given, axis, 3, tip, p->wrong))
        return false;
    return icc_pose_turn((int32_t)p->dim, transform, handle, tip, angle * degree) == ICC_OK ||
           spoilt(p->wrong, 0, "%s has no direction", axis);
}

static bool read_offset(const pose_file *p, const json_item *offset, const char *where,
                        double *transform)
{
    char name[64];
    double by[3];
    snprintf(name, sizeof name, "%s.move", where);
    if (offset == NULL)
        return true;
    return json_reals(offset, name, p->dim, by, p->wrong) &&
           icc_pose_move((int32_t)p->dim, transform, by) == ICC_OK;
}

static bool read_move(const pose_file *p, const json_item *move, size_t i, bool *moved)
{
    static const char *const members[] = {"handle", "move", "turn", "axis", "matrix", NULL};
    char where[48], name[64];
    uint32_t handle;
    snprintf(where, sizeof where, "moves[%zu]", i);
    snprintf(name, sizeof name, "%s.handle", where);
    if (!json_is_object(move, where, members, p->wrong) ||
        !json_index(json_get(move, "handle"), name, "handle", p->n_handles, &handle, p->wrong))
        return false;
    if (moved[handle])
        return spoilt(p->wrong, 0, "%s moves handle %lu again", where, (unsigned long)handle);
    moved[handle] = true;
    const double *at = p->handles + p->dim * handle;
    double *transform = p->transforms + p->dim * (p->dim + 1) * handle;
    return read_matrix(p, json_get(move, "matrix"), where, at, transform) &&
           read_turn(p, move, where, at, transform) &&
           read_offset(p, json_get(move, "move"), where, transform);
}

static bool read_moves(const pose_file *p, const json_item *list)
{
    size_t n, i = 0;
    if (!json_list(list, "moves", &n, p->wrong))
        return false;
    bool *moved = need(p->n_handles, sizeof *moved), good = true;
    for (const json_item *move = json_first(list); move != NULL && good; move = json_next(move))
        good = read_move(p, move, i++, moved);
    free(moved);
    return good;
}

static bool read_file(const pose_file *p, const json_item *file)
{
    static const char *const members[] = {"transforms", "moves", NULL};
    const json_item *transforms = json_get(file, "transforms"), *moves = json_get(file, "moves");
    if (!json_is_object(file, "the file", members, p->wrong))
        return false;
    if ((transforms == NULL) == (moves == NULL))
        return spoilt(p->wrong, 0, "the file must have either \"transforms\" or \"moves\"");
    return transforms != NULL ? read_transforms(p, transforms) : read_moves(p, moves);
}

/* Large numbers may overflow while transforms are composed. */
static bool check_finite(const pose_file *p)
{
    size_t n = p->dim * (p->dim + 1);
    for (size_t i = 0; i < n * p->n_handles; i++)
        if (!isfinite(p->transforms[i]))
            return spoilt(p->wrong, 0, "the transform of handle %zu has numbers that are too large",
                          i / n);
    return true;
}

double *pose_read(size_t dim, size_t n_handles, const double *handles, const char *text, size_t n,
                  problem *wrong)
{
    json_tree file = {0};
    bool good = !foreign_told(text, n, wrong) && json_tree_read(&file, text, n, wrong);
    pose_file p = {.dim = dim, .n_handles = n_handles, .handles = handles, .wrong = wrong};
    p.transforms = need(n_handles, dim * (dim + 1) * sizeof *p.transforms);
    good = good && icc_pose_reset((int32_t)dim, n_handles, p.transforms) == ICC_OK &&
           read_file(&p, file.root) && check_finite(&p);
    json_tree_free(&file);
    if (good)
        return p.transforms;
    free(p.transforms);
    return NULL;
}
