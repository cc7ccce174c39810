#include "tally.h"

#include "orient.h"

#include <math.h>

static bool has_image(const mesh_file *m, const double *points, const uint32_t *corners)
{
    for (size_t k = 0; k < m->dim * (m->dim + 1); k++)
        if (!isfinite(points[m->dim * corners[k / m->dim] + k % m->dim]))
            return false;
    return true;
}

static int element_sign(const mesh_file *m, const double *points, const uint32_t *corners)
{
    const double *at[4] = {NULL, NULL, NULL, NULL};
    for (size_t k = 0; k <= m->dim; k++)
        at[k] = points + m->dim * corners[k];
    return m->dim == 2 ? orientation(at[0], at[1], at[2])
                       : orientation_3d(at[0], at[1], at[2], at[3]);
}

tally tally_count(const mesh_file *m, const double *images)
{
    tally t = {.all = m->dim == 2 ? m->n_triangles : m->n_tetrahedra};
    const uint32_t *elements = m->dim == 2 ? m->triangles : m->tetrahedra;
    for (size_t i = 0; i < t.all; i++) {
        const uint32_t *corners = elements + (m->dim + 1) * i;
        if (!has_image(m, images, corners)) {
            t.without_image++;
            continue;
        }
        int before = element_sign(m, m->points, corners), after = element_sign(m, images, corners);
        if (before == 0)
            t.flat_before++;
        else if (after == 0)
            t.collapsed++;
        else if (after == before)
            t.kept++;
        else
            t.inverted++;
    }
    return t;
}

void tally_print(const tally *t, const mesh_file *m, char *text, size_t room)
{
    snprintf(text, room,
             "%zu %s: %zu keep their orientation, %zu inverted, %zu collapsed, %zu flat "
             "before, %zu without image",
             t->all, elements_name((int32_t)m->dim), t->kept, t->inverted, t->collapsed, t->flat_before,
             t->without_image);
}

void tally_report(const tally *t, const mesh_file *m, json *out)
{
    json_open(out, elements_name((int32_t)m->dim), '{');
    json_count(out, "all", t->all);
    json_count(out, "kept", t->kept);
    json_count(out, "inverted", t->inverted);
    json_count(out, "collapsed", t->collapsed);
    json_count(out, "flat_before", t->flat_before);
    json_count(out, "without_image", t->without_image);
    json_close(out, '}');
}
